// The swap page: what other propellants make of the valve over the temperature, from the study
// "propellants". Charts of pressure force, break-away and least return with one temperature cursor
// through all of them, and a card for each propellant: its figures there, the verdict, and where on
// the scale the stem returns. A small page shows one chart and short cards.
#pragma once

#include "app/base/canvas.h"
#include "engine/valve/studies/study.h"

enum { SB_PROPELLANTS = 4, SB_PROPELLANTS_CHARTS = 3, SB_PROPELLANTS_RETURN = 2 };

typedef struct {
  double temperature; // of the cursor [K]
  unsigned hidden;    // bit k: propellant k is not shown
  int chart;          // of a small page
} SbPropellantsLook;

// Where the parts go; a chart or card that is not shown has no width.
typedef struct {
  bool small;
  SbRect chart[SB_PROPELLANTS_CHARTS], plot[SB_PROPELLANTS_CHARTS];
  SbRect card[SB_PROPELLANTS], button[SB_PROPELLANTS]; // where "Choose" goes
  SbRect foot;
} SbPropellantsLayout;

void sb_propellants_layout(SbPropellantsLayout *out, SbRect rect, const SbPropellantsLook *look);

// The look of a page that nobody has touched: all propellants, at the model's temperature.
SbPropellantsLook sb_propellants_look(const SbModel *model);

// `model` is that of the study. Pure: the same picture from the same study on any surface.
void sb_propellants_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbStudy *study,
                         const SbModel *model, const SbPropellantsLook *look);

// Temperature [K] under a point of a chart, within the study's range; NaN: no chart is there.
double sb_propellants_at(const SbPropellantsLayout *layout, const SbStudy *study, double x,
                         double y);

// Index of a propellant in sb_fluids, and its name.
int sb_propellants_fluid(int propellant);
const char *sb_propellants_name(int propellant);

// One sentence on each propellant at the cursor, for people who do not see it (g_free).
char *sb_propellants_text(const SbStudy *study, const SbModel *model,
                          const SbPropellantsLook *look);

// The page Propellants: results of the valve with other propellants against temperature, from the
// study "propellants". Charts of pressure force, break-away force and minimum return force have one
// temperature cursor, and each propellant has a card with its figures at the cursor, the verdict,
// and the temperatures at which the stem returns. A small page shows one chart and short cards.
// Rectangles are in pixels.
#pragma once

#include "app/draw/canvas.h"
#include "engine/valve/studies/study.h"

// Number of propellants, of charts, and index of the chart of the return force.
enum { SB_PROPELLANTS = 4, SB_PROPELLANTS_CHARTS = 3, SB_PROPELLANTS_RETURN = 2 };

// State of the page.
typedef struct {
  double temperature; // of the cursor [K]
  unsigned hidden;    // bit 1 << k: propellant k is not shown
  int chart;          // index of the chart that a small page shows
} SbPropellantsLook;

// Positions of the parts; a chart or card that is not shown has width 0.
typedef struct {
  bool small;                          // it is a small page
  SbRect chart[SB_PROPELLANTS_CHARTS]; // with title and axes
  SbRect plot[SB_PROPELLANTS_CHARTS];  // area of the curves
  SbRect card[SB_PROPELLANTS];
  SbRect button[SB_PROPELLANTS]; // for the button "Choose" of each card
  SbRect foot;                   // notes
} SbPropellantsLayout;

// Writes the positions for a page in `rect`.
void sb_propellants_layout(SbPropellantsLayout *out, SbRect rect, const SbPropellantsLook *look);

// Returns the initial state: all propellants, cursor at the model's temperature.
SbPropellantsLook sb_propellants_look(const SbModel *model);

// Draws the page into `rect`. `model` is that for which the study was computed. The picture depends
// only on the arguments.
void sb_propellants_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbStudy *study,
                         const SbModel *model, const SbPropellantsLook *look);

// Returns the temperature at the pixel (x, y) of a chart or near it [K], within the study's range;
// NaN: there is no chart, or the study has no results.
double sb_propellants_at(const SbPropellantsLayout *layout, const SbStudy *study, double x,
                         double y);

// Returns the index in sb_fluids of a propellant, 0 to SB_PROPELLANTS - 1.
int sb_propellants_fluid(int propellant);

// Returns the name of a propellant. Static.
const char *sb_propellants_name(int propellant);

// Returns translated sentences, one a line, on each propellant that is not hidden, at the cursor,
// and on the modulus, for accessibility.
char *sb_propellants_text(const SbStudy *study, const SbModel *model,
                          const SbPropellantsLook *look);

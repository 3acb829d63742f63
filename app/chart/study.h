// A study drawn: its panels side by side, the table below them, the notes at the foot. One chart
// for every study: names, units and scales are the study's own.
#pragma once

#include "app/base/canvas.h"
#include "engine/valve/studies/study.h"

// Draws the study into `rect`, each panel and the table on a ground of its own. Pure: the same
// picture from the same study on any surface.
void sb_study_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbStudy *study);

// Where the parts go. `table` has no height without a table; `notes` likewise.
typedef struct {
  SbRect panel[SB_STUDY_PANELS];
  SbRect table, notes;
} SbStudyLayout;

void sb_study_layout(SbStudyLayout *out, SbRect rect, const SbStudy *study);

// The table alone, within `rect`.
void sb_study_table_draw(SbCanvas *canvas, SbRect rect, const SbStudy *study);

// Height that the table wants [px].
double sb_study_table_height(const SbStudy *study);

// What the study shows in words and numbers, for people who do not see it and for the clipboard:
// the table (or, without one, the curves) as tab-separated lines. Owned by the caller (g_free).
char *sb_study_text(const SbStudy *study);

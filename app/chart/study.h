// The chart of a drawn study: its panels next to each other, the table below them, the notes at the
// foot. Names, units and scales are those of the study. Rectangles are in pixels.
#pragma once

#include "app/draw/canvas.h"
#include "engine/valve/studies/study.h"

// Draws the study into `rect`, each panel and the table with its own background. The picture
// depends only on the arguments.
void sb_study_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbStudy *study);

// Positions of the parts.
typedef struct {
  SbRect panel[SB_STUDY_PANELS]; // by panel of the study; others are zero
  SbRect table, notes;           // height 0: none
} SbStudyLayout;

// Writes the positions with which sb_study_draw() draws.
void sb_study_layout(SbStudyLayout *out, SbRect rect, const SbStudy *study);

// Draws only the table into `rect`.
void sb_study_table_draw(SbCanvas *canvas, SbRect rect, const SbStudy *study);

// Returns the height of the table [px]; 0: no table.
double sb_study_table_height(const SbStudy *study);

// Returns the title, the table (if there is one; tab-separated) and the notes as lines, translated,
// for the clipboard and for accessibility. Curves are not included.
char *sb_study_text(const SbStudy *study);

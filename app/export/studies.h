// Studies outside the program: a page as PNG, SVG or PDF, tables as CSV, the JSON document's part.
#pragma once

#include "app/base/canvas.h"
#include "app/base/unit.h"
#include "app/export/json.h"
#include "engine/valve/studies/study.h"

#include <stdio.h>

// What stands around a study on its page; borrowed, all may be NULL but `model`.
typedef struct {
  const SbModel *model;
  const char *title;    // of the scene
  const char *subtitle; // names of the files
  const char *hash;     // of the parameters
  const char *scene;    // text that restores the scene, for PNG and SVG
  const char *ending;   // see SbStill
  const char *stale;    // why the study no longer fits the scene
  bool dark;
  double width, height; // logical pixels; 0: the size it is made for
  double scale;         // PNG pixels per logical pixel; 0 counts as 1
} SbStudyPage;

// Size that the page is made for: wide enough for the table, high enough for panels and table.
void sb_study_page_size(double *width, double *height, const SbStudy *study);

// Draws the page: header, study, footer with models, errors and warnings. As other pages it shrinks
// as a whole down to 0.8, then its parts get less room.
void sb_study_page_draw(cairo_t *cr, SbRect rect, const SbStudy *study, const SbStudyPage *page);

// Writes the page by the ending of `path`. SB_APP_ERROR_INPUT (size, ending) or SB_APP_ERROR_IO.
bool sb_study_still(const SbStudy *study, const SbStudyPage *page, const char *path,
                    GError **error);

// Every point of every curve: panel, unit, series, abscissa, value; SI. Gaps are left out.
void sb_csv_study(FILE *stream, const SbStudy *study);

// The table, SI, a line per row; a row with a unit of its own names it.
void sb_csv_study_table(FILE *stream, const SbStudy *study);

// An object with the whole study, for the key "studies".
void sb_json_study(SbJson *json, const SbStudy *study);

// Puts why values of study `index` in "studies" are null, by their paths, into the object
// "reasons".
void sb_json_study_reasons(SbJson *json, const SbStudy *study, size_t index);

// Its abscissa and panels alone, the keys "x" and "panels" of the open object.
void sb_json_study_curves(SbJson *json, const SbStudy *study);

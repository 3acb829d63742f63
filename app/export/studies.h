// A study (engine/valve/studies/study.h) as a page in PNG, SVG or PDF, as tables in CSV, and as a
// part of JSON documents. In CSV errors of writing are left in the stream (ferror()).
#pragma once

#include "app/base/unit.h"
#include "app/draw/canvas.h"
#include "app/table/json.h"
#include "engine/valve/studies/study.h"

#include <stdio.h>

// What the page of a study shows in addition to the study. Borrowed; all members but `model` may be
// zero.
typedef struct {
  const SbModel *model; // that the study was made from
  const char *title;    // of the scene
  const char *subtitle; // names of the files
  const char *hash;     // of the parameters
  const char *scene;    // text that restores the scene, for PNG and SVG
  const char *ending;   // format of a `path` without an ending, ".png"; NULL: by the path
  const char *stale;    // why the study no longer matches the scene; NULL: it matches
  bool dark;            // theme
  double width, height; // [logical pixels]; both 0: enough for panels and table
  double scale;         // of a PNG: device pixels per logical pixel; 0: 1
} SbStudyPage;

// Draws the page into `rect` [logical pixels]: header, study, footer with models, errors and
// warnings. In a smaller `rect` the page is scaled down to 0.8; below that its parts get less room.
void sb_study_page_draw(cairo_t *cr, SbRect rect, const SbStudy *study, const SbStudyPage *page);

// Writes the page into the file `path`, in the format of page->ending or of the ending of `path`.
// Returns false with SB_APP_ERROR_INPUT (size, ending) or SB_APP_ERROR_IO; an earlier file is
// intact then.
bool sb_study_still(const SbStudy *study, const SbStudyPage *page, const char *path,
                    GError **error);

// Writes a heading and a row for each point of each curve: panel, unit, series, abscissa, value
// [SI]. Points without a value are left out.
void sb_csv_study(FILE *stream, const SbStudy *study);

// Writes the study's table: a heading with SI units, then its rows; the column "unit of the row" is
// filled for rows with a unit of their own.
void sb_csv_study_table(FILE *stream, const SbStudy *study);

// Writes the study as an object, an element of the open array "studies".
void sb_json_study(SbJson *json, const SbStudy *study);

// Writes into the open object "reasons" why values are null: members whose key is the path of the
// values, "studies[INDEX].panels[0].series[0].y". `index`: of the study in "studies", from 0.
void sb_json_study_reasons(SbJson *json, const SbStudy *study, size_t index);

// Writes the members "x" (abscissa) and "panels" of the open object.
void sb_json_study_curves(SbJson *json, const SbStudy *study);

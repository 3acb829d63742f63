// The frame of an exported picture: title and key figures above the views; models, errors and
// warnings below them.
#pragma once

#include "app/chart/data.h"
#include "app/draw/canvas.h"

// Heights of the two strips [px].
#define SB_PAGE_HEADER 88.0
#define SB_PAGE_FOOTER 56.0

// A page: its full rectangle, and the body between header and footer, in the page's own units.
typedef struct {
  SbRect whole, body;
} SbPage;

// Saves the context, moves and scales it so that a page designed for `width` x `height` fills
// `rect` [px], and paints the background. A small page is not scaled below a readable size; its
// body is then smaller than designed. The caller ends the page with cairo_restore().
SbPage sb_page_begin(cairo_t *cr, SbRect rect, double width, double height, const SbTheme *theme);

// In the functions below `rect` is the `whole` of the page, in the page's own units.

// Returns the height of the footer: on a narrow page warnings have their own line.
double sb_page_footer_height(SbRect rect);

// Draws title, state, subtitle with the run's conditions, and (unless SB_CHART_WHOLE) the values of
// the frame at the playhead, inside the margins of the page.
void sb_page_header_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags);

// Draws models, error estimates, warnings, version, run and frame at the foot of the page.
void sb_page_footer_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags);

// The texts of a page's foot, none of them NULL.
typedef struct {
  const char *models, *errors;
  const char *version;        // and run or frame
  const SbWarnings *warnings; // NULL: none
} SbPageFoot;

// Draws the foot of the page with these texts, with the height of sb_page_footer_height().
void sb_page_foot_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbPageFoot *foot);

// Writes the models of a run to out[size]: "fit karaszkiewicz · film thesis · ..."; empty without a
// model (run->model NULL).
void sb_page_models_text(char *out, size_t size, const SbChartRun *run);

// Writes the conditions of a run to out[size]: "canister 0.55 MPa · 20 mm/min · chamber-filled";
// empty without a model.
void sb_page_conditions_text(char *out, size_t size, const SbChartRun *run);

// Writes the absolute errors of break-away force and return margin, as `sealbench run` prints them,
// to out[size]: "Break-away force ± 0.09 N · Return margin ± 0.20 N"; of the sliding plate those of
// its short table. `summary` is NULL until the run has ended; the text then says so.
void sb_page_errors_text(char *out, size_t size, const SbSummary *summary);

// Returns the texts of models and errors as the comment of a picture's or report's file. `summary`
// as in sb_page_errors_text().
char *sb_page_comment(const SbChartRun *run, const SbSummary *summary);

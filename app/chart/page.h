// What stands around the views of an exported picture: title and key figures above; models, errors
// and warnings below.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/data.h"

// Heights of the two strips [px].
#define SB_PAGE_HEADER 88.0
#define SB_PAGE_FOOTER 56.0

// A page begun: its whole and the body between header and footer, in the page's own units.
typedef struct {
  SbRect whole, body;
} SbPage;

// Saves the context, moves and scales it so that a page that likes `width` x `height` fills `rect`,
// and paints the ground. A small page is not shrunk below what is still readable; then the body is
// less than it likes. The caller restores the context.
SbPage sb_page_begin(cairo_t *cr, SbRect rect, double width, double height, const SbTheme *theme);

// Height of the footer on this page: a narrow one gives the warnings a line of their own.
double sb_page_footer_height(SbRect rect);

// Title, state, subtitle with the run's conditions behind it, and (unless SB_CHART_WHOLE) the
// read-outs of the frame, inside the page margins of `rect` (the whole page).
void sb_page_header_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags);

// Models, error estimates, warnings, version, run and frame at the foot of `rect`.
void sb_page_footer_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags);

// The foot of a page whose texts are already known.
typedef struct {
  const char *models, *errors;
  const char *version;        // and what run or frame this is
  const SbWarnings *warnings; // NULL: none
} SbPageFoot;

// Draws it at the foot of `rect`, with the height that sb_page_footer_height() tells.
void sb_page_foot_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbPageFoot *foot);

// "fit karaszkiewicz . film thesis . surface greenwood-tripp . motion quasi-static", into `out`.
void sb_page_models_text(char *out, size_t size, const SbChartRun *run);

// "canister 0.55 MPa . 20 mm/min . chamber-filled", into `out`; empty without a model.
void sb_page_conditions_text(char *out, size_t size, const SbChartRun *run);

// "load 0.17 %, film 0.3 %; energy closure: rounding only (discretisation, ...)", into `out`.
void sb_page_errors_text(char *out, size_t size, const SbChartRun *run);

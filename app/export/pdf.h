// A PDF in memory: a cairo surface with the document's texts, and its bytes. Equal drawings make
// equal bytes: the file has no time other than that of the environment variable SOURCE_DATE_EPOCH.
// Use: sb_pdf_begin(), draw on `surface`, sb_pdf_finish() in every case.
#pragma once

#include "app/base/error.h"

#include <cairo.h>
#include <stdbool.h>
#include <stdio.h>

// Points of paper (1/72 inch) per logical pixel (1/96 inch).
#define SB_PDF_POINTS 0.75

// A PDF that is being drawn.
typedef struct {
  // To draw on, with cairo_create(); its user unit is a point. The caller scales by SB_PDF_POINTS
  // to draw in logical pixels, and ends each page by cairo_show_page(). Owned by the SbPdf.
  cairo_surface_t *surface;
  GByteArray *bytes; // internal
} SbPdf;

// Texts of the document's metadata, copied; each may be NULL.
typedef struct {
  const char *title, *comment, *hash; // title (NULL: "Sealbench"), subject, keywords
} SbPdfTexts;

// Begins a PDF whose first page is width by height logical pixels. A failure is reported by
// sb_pdf_finish().
void sb_pdf_begin(SbPdf *out, double width, double height, const SbPdfTexts *texts);

// Writes the PDF into `stream` (NULL: discards it) and frees it; the caller has destroyed its cairo
// contexts. Returns false with SB_APP_ERROR_IO if the drawing failed; errors of writing are left in
// the stream (ferror()).
bool sb_pdf_finish(SbPdf *pdf, FILE *stream, GError **error);

// Returns the UTC time of SOURCE_DATE_EPOCH in the `format` of g_date_time_format(); "" if the
// variable is not set.
char *sb_pdf_date(const char *format);

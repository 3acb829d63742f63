// A PDF in memory: its surface with the document's texts, and its bytes. Equal drawings make equal
// bytes: no time, but the one that the environment asks for (SOURCE_DATE_EPOCH).
#pragma once

#include "app/base/error.h"

#include <cairo.h>
#include <stdbool.h>
#include <stdio.h>

// Points of paper to a logical pixel: 72 per inch over 96.
#define SB_PDF_POINTS 0.75

typedef struct {
  cairo_surface_t *surface;
  GByteArray *bytes;
} SbPdf;

// Texts of the document; each may be NULL.
typedef struct {
  const char *title, *comment, *hash;
} SbPdfTexts;

// Begins one whose first page has this size in logical pixels. To be finished in any case.
void sb_pdf_begin(SbPdf *out, double width, double height, const SbPdfTexts *texts);

// Writes it into `stream` (NULL: nowhere) if everything was drawn (SB_APP_ERROR_IO), and frees it.
// Failures to write show in the stream.
bool sb_pdf_finish(SbPdf *pdf, FILE *stream, GError **error);

// The day that SOURCE_DATE_EPOCH asks for, by `format` of g_date_time_format(); "" without one.
// Owned by the caller.
char *sb_pdf_date(const char *format);

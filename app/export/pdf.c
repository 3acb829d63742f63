// PDF by cairo into memory, so that the file is written in one go.
#include "app/export/pdf.h"

#include "app/base/identity.h"

#include <cairo-pdf.h>

static cairo_status_t append_bytes(void *closure, const unsigned char *data, unsigned length) {
  g_byte_array_append(closure, data, length);
  return CAIRO_STATUS_SUCCESS;
}

char *sb_pdf_date(const char *format) {
  const char *given = g_getenv("SOURCE_DATE_EPOCH");
  gint64 seconds = 0;
  GDateTime *time = NULL;
  if (given != NULL && g_ascii_string_to_signed(given, 10, 0, G_MAXINT64, &seconds, NULL)) {
    time = g_date_time_new_from_unix_utc(seconds);
  }
  char *text = time != NULL ? g_date_time_format(time, format) : g_strdup("");
  g_clear_pointer(&time, g_date_time_unref);
  return text;
}

void sb_pdf_begin(SbPdf *out, double width, double height, const SbPdfTexts *texts) {
  out->bytes = g_byte_array_new();
  out->surface = cairo_pdf_surface_create_for_stream(append_bytes, out->bytes,
                                                     width * SB_PDF_POINTS, height * SB_PDF_POINTS);
  g_autofree char *creator = sb_identity_text();
  g_autofree char *date = sb_pdf_date("%Y-%m-%dT%H:%M:%SZ");
  cairo_pdf_surface_set_metadata(out->surface, CAIRO_PDF_METADATA_CREATE_DATE, date);
  cairo_pdf_surface_set_metadata(out->surface, CAIRO_PDF_METADATA_CREATOR, creator);
  cairo_pdf_surface_set_metadata(out->surface, CAIRO_PDF_METADATA_TITLE,
                                 texts->title != NULL ? texts->title : "Sealbench");
  if (texts->comment != NULL) {
    cairo_pdf_surface_set_metadata(out->surface, CAIRO_PDF_METADATA_SUBJECT, texts->comment);
  }
  if (texts->hash != NULL) {
    cairo_pdf_surface_set_metadata(out->surface, CAIRO_PDF_METADATA_KEYWORDS, texts->hash);
  }
}

bool sb_pdf_finish(SbPdf *pdf, FILE *stream, GError **error) {
  cairo_surface_finish(pdf->surface);
  const cairo_status_t status = cairo_surface_status(pdf->surface);
  if (status != CAIRO_STATUS_SUCCESS) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "the pages could not be drawn: %s",
                cairo_status_to_string(status));
  } else if (stream != NULL) {
    fwrite(pdf->bytes->data, 1, pdf->bytes->len, stream);
  }
  cairo_surface_destroy(pdf->surface);
  g_byte_array_unref(pdf->bytes);
  *pdf = (SbPdf){0};
  return status == CAIRO_STATUS_SUCCESS;
}

// Still pictures. PNG through libpng, because cairo cannot write text chunks: 8-bit RGB (the page
// is opaque) with iTXt chunks Title, Software, Comment, sealbench-hash and sealbench-scene, and its
// physical size. SVG and PDF by cairo into memory, so that the file is written in one go; the SVG
// gets the same texts as a metadata element, the PDF as document information. A logical pixel is
// 1/96 inch on paper. Leaves out transparency and colour profiles (sRGB is meant, and said in PNG).
#include "app/export/still.h"

#include "app/base/identity.h"
#include "app/base/output.h"
#include "app/document/picture.h"
#include "app/export/pdf.h"
#include "engine/valve/sealbench.h"

#include <cairo-svg.h>
#include <errno.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <string.h>

#define HASH_KEY "sealbench-hash"

static bool fail_cairo(GError **error, cairo_status_t status) {
  g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "the picture could not be drawn: %s",
              cairo_status_to_string(status));
  return false;
}

// Draws on a surface and says whether everything went well.
static bool draw_on(cairo_surface_t *surface, const SbStill *still, double scale, GError **error) {
  cairo_t *cr = cairo_create(surface);
  cairo_scale(cr, scale, scale);
  still->draw(cr, still->width, still->height, still->user);
  cairo_status_t status = cairo_status(cr);
  cairo_destroy(cr);
  if (status != CAIRO_STATUS_SUCCESS) {
    return fail_cairo(error, status);
  }
  return true;
}

// ---------------------------------------------------------------------------------------------------
// PNG

// libpng reports by a callback that must not return: `text` says what was wrong, `back` is where it
// goes on.
typedef struct {
  jmp_buf back;
  char text[160];
} Failure;

static void png_failed(png_structp png, png_const_charp text) {
  Failure *failure = png_get_error_ptr(png);
  g_strlcpy(failure->text, text, sizeof failure->text);
  longjmp(failure->back, 1);
}

static void png_warned(png_structp png, png_const_charp text) {}

static void png_write_bytes(png_structp png, png_bytep data, png_size_t length) {
  FILE *stream = png_get_io_ptr(png);
  if (fwrite(data, 1, length, stream) != length) {
    png_error(png, g_strerror(errno));
  }
}

static void png_flush_bytes(png_structp png) {}

static int add_still_text(png_text *text, int count, const char *key, const char *value) {
  if (value && value[0]) {
    // The library wants pointers to char but only reads them.
    text[count] = (png_text){.compression = strlen(value) > 400 ? PNG_ITXT_COMPRESSION_zTXt
                                                                : PNG_ITXT_COMPRESSION_NONE,
                             .key = (char *)(gintptr)key,
                             .text = (char *)(gintptr)value,
                             .itxt_length = strlen(value)};
    count++;
  }
  return count;
}

// Only plain variables live across the jump; all are set before it.
static bool encode_png(FILE *stream, cairo_surface_t *surface, const SbStill *still, double scale,
                       const char *software, png_byte *row, GError **error) {
  Failure failure = {.text = ""};
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, png_failed, png_warned);
  png_infop info = png ? png_create_info_struct(png) : NULL;
  if (!info) {
    png_destroy_write_struct(&png, NULL);
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "no memory for the picture");
    return false;
  }
  if (setjmp(failure.back)) {
    png_destroy_write_struct(&png, &info);
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s", failure.text);
    return false;
  }
  int width = cairo_image_surface_get_width(surface);
  int height = cairo_image_surface_get_height(surface);
  int stride = cairo_image_surface_get_stride(surface);
  const unsigned char *pixels = cairo_image_surface_get_data(surface);
  png_set_write_fn(png, stream, png_write_bytes, png_flush_bytes);
  png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, 8, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_uint_32 per_metre = (png_uint_32)lround(96 * scale / 0.0254);
  png_set_pHYs(png, info, per_metre, per_metre, PNG_RESOLUTION_METER);
  png_text text[5];
  memset(text, 0, sizeof text);
  int count = add_still_text(text, 0, "Title", still->title);
  count = add_still_text(text, count, "Software", software);
  count = add_still_text(text, count, "Comment", still->comment);
  count = add_still_text(text, count, HASH_KEY, still->hash);
  count = add_still_text(text, count, SB_PICTURE_SCENE_KEY, still->scene);
  png_set_text(png, info, text, count);
  png_write_info(png, info);
  for (int y = 0; y < height; y++) {
    const guint32 *from = (const guint32 *)(const void *)(pixels + (size_t)y * (size_t)stride);
    for (int x = 0; x < width; x++) {
      row[3 * x] = (png_byte)(from[x] >> 16);
      row[3 * x + 1] = (png_byte)(from[x] >> 8);
      row[3 * x + 2] = (png_byte)from[x];
    }
    png_write_row(png, row);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

static bool put_png(FILE *stream, const SbStill *still, GError **error) {
  double scale = still->scale > 0 ? still->scale : 1;
  double width = round(still->width * scale), height = round(still->height * scale);
  if (width > SB_STILL_MAX || height > SB_STILL_MAX) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "a picture of %.0fx%.0f pixels is too large (at most %d a side)", width, height,
                SB_STILL_MAX);
    return false;
  }
  cairo_surface_t *surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
  bool good = true;
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) {
    good = fail_cairo(error, cairo_surface_status(surface));
  } else {
    cairo_surface_set_device_scale(surface, scale, scale);
    good = draw_on(surface, still, 1, error);
  }
  if (good) {
    cairo_surface_flush(surface);
    g_autofree char *software = sb_identity_text();
    g_autofree png_byte *row = g_malloc(3 * (size_t)width);
    good = encode_png(stream, surface, still, scale, software, row, error);
  }
  cairo_surface_destroy(surface);
  return good;
}

// ---------------------------------------------------------------------------------------------------
// SVG and PDF

static cairo_status_t append_still_bytes(void *closure, const unsigned char *data,
                                         unsigned length) {
  g_byte_array_append(closure, data, length);
  return CAIRO_STATUS_SUCCESS;
}

// The texts as elements that any reader of SVG skips and we can find.
static char *svg_metadata(const SbStill *still) {
  const SbEngineIdentity *engine = sb_engine_identity();
  GString *out = g_string_new("\n");
  g_autofree char *title = g_markup_escape_text(still->title ? still->title : "Sealbench", -1);
  g_autofree char *comment = g_markup_escape_text(still->comment ? still->comment : "", -1);
  g_autofree char *scene = g_markup_escape_text(still->scene ? still->scene : "", -1);
  g_autofree char *hash = g_markup_escape_text(still->hash ? still->hash : "", -1);
  g_string_append_printf(out, "<title>%s</title>\n<desc>%s</desc>\n", title, comment);
  g_string_append_printf(out,
                         "<metadata><sealbench xmlns=\"urn:sealbench\" version=\"%s\" "
                         "engine=\"%s\" commit=\"%s\" hash=\"%s\">%s</sealbench></metadata>",
                         engine->version, engine->source,
                         engine->commit != NULL ? engine->commit : "", hash, scene);
  return g_string_free(out, FALSE);
}

static bool put_svg(FILE *stream, const SbStill *still, GError **error) {
  GByteArray *bytes = g_byte_array_new();
  cairo_surface_t *surface =
      cairo_svg_surface_create_for_stream(append_still_bytes, bytes, still->width, still->height);
  cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
  bool good = draw_on(surface, still, 1, error);
  cairo_surface_finish(surface);
  if (good && cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) {
    good = fail_cairo(error, cairo_surface_status(surface));
  }
  cairo_surface_destroy(surface);
  if (good) {
    // Behind the opening tag of the document.
    g_byte_array_append(bytes, (const guint8 *)"", 1);
    const char *text = (const char *)bytes->data, *tag = strstr(text, "<svg");
    const char *end = tag ? strchr(tag, '>') : NULL;
    g_autoptr(GString) out = g_string_new(NULL);
    if (end) {
      g_autofree char *metadata = svg_metadata(still);
      g_string_append_len(out, text, end + 1 - text);
      g_string_append(out, metadata);
      g_string_append(out, end + 1);
    } else {
      g_string_append(out, text);
    }
    fwrite(out->str, 1, out->len, stream);
  }
  g_byte_array_unref(bytes);
  return good;
}

static bool put_pdf(FILE *stream, const SbStill *still, GError **error) {
  SbPdf pdf;
  const SbPdfTexts texts = {still->title, still->comment, still->hash};
  sb_pdf_begin(&pdf, still->width, still->height, &texts);
  const bool drawn = draw_on(pdf.surface, still, SB_PDF_POINTS, error);
  return sb_pdf_finish(&pdf, drawn ? stream : NULL, drawn ? error : NULL) && drawn;
}

bool sb_still_put(FILE *stream, const SbStill *still, const char *ending, GError **error) {
  if (!(still->width >= SB_STILL_MIN && still->height >= SB_STILL_MIN &&
        still->width <= SB_STILL_MAX && still->height <= SB_STILL_MAX)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "a picture of %.0fx%.0f is not possible (%d to %d a side)", still->width,
                still->height, SB_STILL_MIN, SB_STILL_MAX);
    return false;
  }
  if (sb_output_ends_in(ending, ".png")) {
    return put_png(stream, still, error);
  }
  if (sb_output_ends_in(ending, ".svg")) {
    return put_svg(stream, still, error);
  }
  if (sb_output_ends_in(ending, ".pdf")) {
    return put_pdf(stream, still, error);
  }
  g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: the ending must be .png, .svg or .pdf",
              ending);
  return false;
}

bool sb_still_write(const SbStill *still, const char *path, GError **error) {
  SbOutput file;
  if (!sb_output_begin(&file, path, error)) {
    return false;
  }
  // What a full stream stopped is the file's failure; committing finds its reason.
  if (!sb_still_put(file.stream, still, still->ending != NULL ? still->ending : path, error) &&
      ferror(file.stream) == 0) {
    sb_output_abort(&file);
    return false;
  }
  if (error != NULL) {
    g_clear_error(error);
  }
  return sb_output_commit(&file, error);
}

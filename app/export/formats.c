// The table of file formats. See formats.h.
#include "app/export/formats.h"

#include "app/base/output.h"

#include <glib.h>
#include <glib/gi18n.h>

static const SbExportFormat formats[] = {
    {".png", N_("Picture, PNG"), SB_FORMAT_PICTURE, 0},
    {".svg", N_("Drawing, SVG"), SB_FORMAT_DRAWING, 0},
    {".pdf", N_("Drawing, PDF"), SB_FORMAT_DRAWING, 0},
    {".mp4", N_("Movie, MP4"), SB_FORMAT_FILM, SB_MOVIE_MP4},
    {".webp", N_("Animation, WebP"), SB_FORMAT_FILM, SB_MOVIE_WEBP},
    {".apng", N_("Animation, APNG"), SB_FORMAT_FILM, SB_MOVIE_APNG},
    {".gif", N_("Animation, GIF"), SB_FORMAT_FILM, SB_MOVIE_GIF},
};

const SbExportFormat *sb_export_formats(size_t *count) {
  *count = G_N_ELEMENTS(formats);
  return formats;
}

const SbExportFormat *sb_export_format(const char *path) {
  for (size_t i = 0; i < G_N_ELEMENTS(formats); i++) {
    if (sb_output_ends_in(path, formats[i].ending)) {
      return &formats[i];
    }
  }
  return NULL;
}

char *sb_export_endings(unsigned kinds, size_t skip, const char *between, const char *last) {
  GString *list = g_string_new(NULL);
  int left = 0;
  for (size_t i = 0; i < G_N_ELEMENTS(formats); i++) {
    left += (kinds >> formats[i].kind & 1) != 0;
  }
  for (size_t i = 0; i < G_N_ELEMENTS(formats); i++) {
    if ((kinds >> formats[i].kind & 1) != 0) {
      left--;
      g_string_append_printf(list, "%s%s", formats[i].ending + skip,
                             left > 1    ? between
                             : left == 1 ? last
                                         : "");
    }
  }
  return g_string_free(list, FALSE);
}

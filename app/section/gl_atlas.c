// Lines in shelves: a line goes onto the open shelf if it is not taller and there is room, else a
// new shelf opens below. Each line has a texel of margin.
#include "app/section/gl_atlas.h"

#include <cairo.h>
#include <glib.h>
#include <math.h>
#include <pango/pangocairo.h>
#include <string.h>

enum { START_SIZE = 1024, SIZE_MAX_PX = 8192 };

struct SbGlAtlas {
  const SbGlApi *gl;
  SbText *text;
  GHashTable *lines; // key string -> SbGlLine
  GString *key;
  GLuint texture;
  int size;
  int shelf_x, shelf_y, shelf_height;
};

static void make_texture(SbGlAtlas *atlas) {
  const SbGlApi *gl = atlas->gl;
  if (atlas->texture == 0) {
    gl->GenTextures(1, &atlas->texture);
  }
  gl->BindTexture(GL_TEXTURE_2D, atlas->texture);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl->TexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas->size, atlas->size, 0, GL_RED, GL_UNSIGNED_BYTE,
                 NULL);
}

SbGlAtlas *sb_gl_atlas_create(const SbGlApi *gl) {
  SbGlAtlas *atlas = g_new0(SbGlAtlas, 1);
  atlas->gl = gl;
  atlas->text = sb_text_create();
  atlas->lines = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
  atlas->key = g_string_new(NULL);
  atlas->size = START_SIZE;
  make_texture(atlas);
  return atlas;
}

void sb_gl_atlas_destroy(SbGlAtlas *atlas) {
  if (atlas == NULL) {
    return;
  }
  atlas->gl->DeleteTextures(1, &atlas->texture);
  g_hash_table_unref(atlas->lines);
  g_string_free(atlas->key, TRUE);
  sb_text_destroy(atlas->text);
  g_free(atlas);
}

void sb_gl_atlas_clear(SbGlAtlas *atlas, bool grow) {
  g_hash_table_remove_all(atlas->lines);
  atlas->shelf_x = atlas->shelf_y = atlas->shelf_height = 0;
  if (grow && atlas->size < SIZE_MAX_PX) {
    atlas->size *= 2;
    make_texture(atlas);
  }
}

GLuint sb_gl_atlas_texture(const SbGlAtlas *atlas) {
  return atlas->texture;
}

// Room of width x height texels; false if there is none.
static bool allot(SbGlAtlas *atlas, int width, int height, int *u, int *v) {
  if (width > atlas->size || height > atlas->size) {
    return false;
  }
  if (atlas->shelf_x + width > atlas->size || height > atlas->shelf_height) {
    // A taller line may raise the open shelf while nothing is on it.
    atlas->shelf_y += atlas->shelf_x > 0 ? atlas->shelf_height : 0;
    atlas->shelf_x = 0;
    atlas->shelf_height = height;
  }
  if (atlas->shelf_y + height > atlas->size) {
    return false;
  }
  *u = atlas->shelf_x;
  *v = atlas->shelf_y;
  atlas->shelf_x += width;
  return true;
}

bool sb_gl_atlas_line(SbGlAtlas *atlas, const char *text, double size, int weight, SbGlLine *line) {
  g_string_printf(atlas->key, "%d %d %s", (int)lround(64 * size), weight, text);
  const SbGlLine *known = g_hash_table_lookup(atlas->lines, atlas->key->str);
  if (known != NULL) {
    *line = *known;
    return true;
  }
  double baseline, advance;
  PangoLayout *layout = sb_text_layout(atlas->text, text, size, weight, &baseline, &advance);
  PangoRectangle ink;
  pango_layout_get_pixel_extents(layout, &ink, NULL);
  const int margin = 2;
  // Ink relative to the anchor at the baseline's left end. Shelves keep a common height per size.
  int left = ink.x - margin;
  int ascent = MAX((int)ceil(size * 1.05), (int)ceil(baseline) - ink.y) + margin;
  int below = MAX((int)ceil(size * 0.35), ink.y + ink.height - (int)floor(baseline)) + margin;
  SbGlLine made = {.width = ink.width > 0 ? ink.width + 2 * margin : 0,
                   .height = ascent + below,
                   .left = left,
                   .ascent = ascent,
                   .advance = advance};
  if (ink.width > 0) {
    if (!allot(atlas, made.width, made.height, &made.u, &made.v)) {
      return false;
    }
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, made.width, made.height);
    cairo_t *cr = cairo_create(surface);
    cairo_move_to(cr, -left, ascent - baseline);
    // Outlines instead of cairo's glyph cache, which would put each glyph on a whole pixel.
    pango_cairo_layout_path(cr, layout);
    cairo_fill(cr);
    cairo_destroy(cr);
    cairo_surface_flush(surface);
    const SbGlApi *gl = atlas->gl;
    gl->BindTexture(GL_TEXTURE_2D, atlas->texture);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->PixelStorei(GL_UNPACK_ROW_LENGTH, cairo_image_surface_get_stride(surface));
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, made.u, made.v, made.width, made.height, GL_RED,
                      GL_UNSIGNED_BYTE, cairo_image_surface_get_data(surface));
    gl->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    cairo_surface_destroy(surface);
  }
  g_hash_table_insert(atlas->lines, g_strdup(atlas->key->str), g_memdup2(&made, sizeof made));
  *line = made;
  return true;
}

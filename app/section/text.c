// Pango layouts for single lines. Widths sit in a direct-mapped table keyed by a hash; a collision
// only costs a new layout.
#include "app/section/text.h"

#include <glib.h>
#include <pango/pangocairo.h>
#include <string.h>

enum { WIDTHS = 512, KEY_MAX = 96 };

typedef struct {
  char key[KEY_MAX];
  double size, width;
  int weight;
} Width;

struct SbText {
  PangoContext *context;
  PangoLayout *layout;
  PangoAttrList *attributes;
  PangoFontDescription *font;
  Width width[WIDTHS];
};

SbText *sb_text_create(void) {
  SbText *text = g_new0(SbText, 1);
  text->context = pango_font_map_create_context(pango_cairo_font_map_get_default());
  cairo_font_options_t *options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  pango_cairo_context_set_font_options(text->context, options);
  cairo_font_options_destroy(options);
  pango_cairo_context_set_resolution(text->context, 72);
  pango_context_set_round_glyph_positions(text->context, FALSE);
  text->layout = pango_layout_new(text->context);
  text->attributes = pango_attr_list_new();
  pango_attr_list_insert(text->attributes, pango_attr_font_features_new("tnum=1"));
  text->font = pango_font_description_from_string("Inter, Cantarell, DejaVu Sans");
  return text;
}

void sb_text_destroy(SbText *text) {
  if (text == NULL) {
    return;
  }
  g_object_unref(text->layout);
  g_object_unref(text->context);
  pango_attr_list_unref(text->attributes);
  pango_font_description_free(text->font);
  g_free(text);
}

PangoLayout *sb_text_layout(SbText *text, const char *string, double size, int weight,
                            double *baseline, double *width) {
  pango_font_description_set_absolute_size(text->font, size * PANGO_SCALE);
  pango_font_description_set_weight(text->font, (PangoWeight)weight);
  pango_layout_set_font_description(text->layout, text->font);
  pango_layout_set_attributes(text->layout, text->attributes);
  pango_layout_set_text(text->layout, string, -1);
  if (baseline != NULL) {
    *baseline = (double)pango_layout_get_baseline(text->layout) / PANGO_SCALE;
  }
  if (width != NULL) {
    PangoRectangle logical;
    pango_layout_get_extents(text->layout, NULL, &logical);
    *width = (double)logical.width / PANGO_SCALE;
  }
  return text->layout;
}

double sb_text_width(SbText *text, const char *string, double size, int weight) {
  guint slot = (g_str_hash(string) * 31u + (guint)(size * 16) * 7u + (guint)weight) % WIDTHS;
  Width *known = &text->width[slot];
  if (known->size == size && known->weight == weight && strcmp(known->key, string) == 0) {
    return known->width;
  }
  double width;
  sb_text_layout(text, string, size, weight, NULL, &width);
  if (strlen(string) < KEY_MAX) {
    g_strlcpy(known->key, string, KEY_MAX);
    known->size = size;
    known->weight = weight;
    known->width = width;
  }
  return width;
}

// Pictures and tables of studies: golden pictures with partners that must fail, the CSV and the
// layout.
#include "app/study/view.h"
#include "tests/app/picture.h"

#include "app/chart/propellants.h"
#include "app/chart/study.h"
#include "app/export/studies.h"
#include "engine/valve/figures/figures.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// A study of known shape: three curves that end apart, a gap, dots, logarithmic and linear panels,
// a mark, a table. `factor` scales one curve.
static SbStudy *synthetic(double factor) {
  SbStudy *study = g_new0(SbStudy, 1);
  study->kind = SB_STUDY_SQUEEZE;
  study->complete = true;
  study->x = (SbStudyAxis){"sliding speed", "m/s", "mm/s", true};
  study->panel_count = 2;
  study->panel[0].y = (SbStudyAxis){"film", "m", "nm", true};
  study->panel[1].y = (SbStudyAxis){"load", "N", "N", false};
  static const struct {
    const char *name;
    SbStudyStyle style;
    double scale, power;
  } curves[] = {{"solved", SB_STUDY_CURVE, 1, 0.6},
                {"half as strong", SB_STUDY_CURVE, 0.5, 0.6},
                {"a law", SB_STUDY_REFERENCE, 1.1, 0.65},
                {"measured", SB_STUDY_DOTS, 1.05, 0.6}};
  for (size_t p = 0; p < 2; p++) {
    study->panel[p].series_count = G_N_ELEMENTS(curves);
    for (size_t s = 0; s < G_N_ELEMENTS(curves); s++) {
      SbStudySeries *series = &study->panel[p].series[s];
      g_strlcpy(series->name, curves[s].name, sizeof series->name);
      series->style = curves[s].style;
      series->count = curves[s].style == SB_STUDY_DOTS ? 5 : 41;
      for (size_t i = 0; i < series->count; i++) {
        double t = (double)i / (double)(series->count - 1);
        double speed = 1e-4 * pow(1e3, t);
        double y = curves[s].scale * pow(speed / 1e-3, curves[s].power) * (s == 0 ? factor : 1);
        series->x[i] = speed;
        series->y[i] = p == 0 ? 5e-9 * y : 3 + y;
      }
    }
  }
  // The law ends early and has a hole.
  for (size_t i = 28; i < 41; i++) {
    study->panel[1].series[2].y[i] = NAN;
  }
  study->panel[1].series[2].y[10] = NAN;
  study->mark_count = 1;
  study->mark[0] = (SbStudyMark){1e-3, "test"};
  g_strlcpy(study->row_heading, "case", sizeof study->row_heading);
  study->column_count = 3;
  study->column[0] = (SbStudyColumn){"load", "N", "N", 3, false};
  study->column[1] = (SbStudyColumn){"load against ring", "1", "%", 3, true};
  study->column[2] = (SbStudyColumn){"contact width of the whole ring", "m", "mm", 3, false};
  study->row_count = 3;
  study->row[0] = (SbStudyRow){"first", "", "", {12.395, 0.0831, 0.8886e-3}};
  study->row[1] = (SbStudyRow){"second", "", "", {-4.37, -0.2, NAN}};
  study->row[2] = (SbStudyRow){"U*", "1", "", {1.57994e-7, 0, 3.2e7}};
  g_strlcpy(study->models, "solved, a law", sizeof study->models);
  g_strlcpy(study->validity, "everywhere that it was drawn", sizeof study->validity);
  study->error = 1.2e-3;
  study->note_count = 1;
  g_strlcpy(study->note[0], "A note on what the numbers say.", sizeof study->note[0]);
  sb_warn(&study->warnings, "test", 0, "the law is used outside its range");
  return study;
}

static cairo_surface_t *draw(const SbStudy *study, int width, int height, bool dark) {
  cairo_surface_t *surface = picture_new(width, height, 1);
  cairo_t *cr = cairo_create(surface);
  SbStudyPage page = {
      .title = "Synthetic", .subtitle = "a.scene", .hash = "0123456789abcdef", .dark = dark};
  sb_study_page_draw(cr, (SbRect){0, 0, width, height}, study, &page);
  cairo_destroy(cr);
  return surface;
}

static void test_pictures(void) {
  SbStudy *study = synthetic(1), *wrong = synthetic(1.02);
  for (int dark = 0; dark < 2; dark++) {
    const char *name = dark ? "study-dark" : "study";
    cairo_surface_t *good = draw(study, 1280, 720, dark), *bad = draw(wrong, 1280, 720, dark);
    picture_check(good, name);
    g_assert_true(picture_rejects(bad, name));
    cairo_surface_destroy(good);
    cairo_surface_destroy(bad);
  }
  g_free(wrong);
  // Small and without anything at all: no crash, still a picture.
  cairo_surface_t *small = draw(study, 320, 240, false);
  g_assert_cmpint(cairo_surface_status(small), ==, CAIRO_STATUS_SUCCESS);
  picture_show(small, "study-small");
  cairo_surface_destroy(small);
  memset(study, 0, sizeof *study);
  cairo_surface_t *empty = draw(study, 640, 480, true);
  g_assert_cmpint(cairo_surface_status(empty), ==, CAIRO_STATUS_SUCCESS);
  cairo_surface_destroy(empty);
  g_free(study);
}

// The text for eyes that cannot see: digits, signs, powers, units.
static void test_text(void) {
  SbStudy *study = synthetic(1);
  g_autofree char *text = sb_study_text(study);
  g_assert_nonnull(strstr(text, "case\tload / N\tload against ring / %"));
  g_assert_nonnull(strstr(text, "first\t12.4\t+8.31\t0.889\n"));
  g_assert_nonnull(strstr(text, "second\t\xe2\x88\x92"
                                "4.37\t\xe2\x88\x92"
                                "20.0\t\xe2\x80\x93\n"));
  g_assert_nonnull(strstr(text, "1.58\xc2\xb7"
                                "10\xe2\x81\xbb\xe2\x81\xb7"));
  g_free(study);
}

static char *written(void (*put)(FILE *, const SbStudy *), const SbStudy *study) {
  char *text = NULL;
  size_t size = 0;
  FILE *stream = open_memstream(&text, &size);
  put(stream, study);
  fclose(stream);
  return text;
}

static void test_tables(void) {
  SbStudy *study = synthetic(1);
  char *csv = written(sb_csv_study, study);
  g_assert_true(g_str_has_prefix(csv, "panel,unit,series,sliding speed [m/s],value\n"
                                      "film,m,solved,0.0001,"));
  g_auto(GStrv) lines = g_strsplit(csv, "\n", -1);
  // Two panels of 3 x 41 + 5 points, less 14 gaps, and the heading.
  g_assert_cmpuint(g_strv_length(lines), ==, 2 * (3 * 41 + 5) - 14 + 1 + 1);
  g_assert_null(strstr(csv, "nan"));
  free(csv);
  csv = written(sb_csv_study_table, study);
  g_assert_cmpstr(csv, ==,
                  "case,unit of the row,load [N],load against ring [1],contact width of the whole "
                  "ring [m]\n"
                  "first,,12.395,0.0831,0.0008886\n"
                  "second,,-4.37,-0.2,\n"
                  "U*,1,1.57994e-07,0,32000000\n");
  free(csv);
  g_free(study);
}

// Nothing of a page lies over anything else, whatever the number of panels.
// Number of pixels of a picture that are not its ground outside a rectangle.
static size_t outside(cairo_surface_t *picture, SbRect rect, guint32 ground) {
  cairo_surface_flush(picture);
  size_t found = 0;
  const unsigned char *data = cairo_image_surface_get_data(picture);
  int stride = cairo_image_surface_get_stride(picture);
  for (int y = 0; y < cairo_image_surface_get_height(picture); y++) {
    const guint32 *row = (const guint32 *)(const void *)(data + (size_t)y * (size_t)stride);
    for (int x = 0; x < cairo_image_surface_get_width(picture); x++) {
      bool within = x >= rect.x - 1 && x < rect.x + rect.width + 1 && y >= rect.y - 1 &&
                    y < rect.y + rect.height + 1;
      found += !within && (row[x] & 0xffffff) != ground;
    }
  }
  return found;
}

// A card keeps its numbers, names and titles to itself: one tiny value on a logarithmic axis, long
// names of curves, a title longer than the plot, a card without values, wide and narrow.
static void test_inside_the_card(void) {
  static const double value[][2] = {{3.6e-9, 3.6e-9}, {3.6e-9, 5e-9}, {1e-14, 1e-2},
                                    {4e7, 4.1e7},     {0, 0},         {0.2, 1.9}};
  for (int which = 0; which < 2 * (int)G_N_ELEMENTS(value); which++) {
    SbStudy *study = g_new0(SbStudy, 1);
    study->x = (SbStudyAxis){"squeeze of the free section", "1", "%", false};
    study->panel_count = 1;
    SbStudyPanel *panel = &study->panel[0];
    panel->y = (SbStudyAxis){"leak at rest", "1", "", which % 2 == 0};
    g_strlcpy(panel->empty, "no leak: every contact is closed", sizeof panel->empty);
    panel->series_count = 2;
    for (int s = 0; s < 2; s++) {
      SbStudySeries *series = &panel->series[s];
      g_strlcpy(series->name, s == 0 ? "karaszkiewicz, 0.055 MPa" : "karaszkiewicz, 0.55 MPa",
                sizeof series->name);
      series->count = 2;
      for (int i = 0; i < 2; i++) {
        series->x[i] = 0.07 + 0.33 * i;
        series->y[i] = value[which / 2][i] * (value[which / 2][i] > 0 ? 1 + 0.1 * s : NAN);
      }
    }
    for (int width = 210; width <= 450; width += 40) {
      cairo_surface_t *picture = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 900, 340);
      cairo_t *cr = cairo_create(picture);
      cairo_set_source_rgb(cr, 1, 0, 1);
      cairo_paint(cr);
      SbRect rect = {200, 40, width, 260};
      sb_study_draw(cr, rect, sb_theme(false), study);
      cairo_destroy(cr);
      size_t found = outside(picture, rect, 0xff00ff);
      g_test_message("values %d, width %d: %zu pixels outside", which, width, found);
      g_assert_cmpuint(found, ==, 0);
      cairo_surface_destroy(picture);
    }
    g_free(study);
  }
}

static void test_layout(void) {
  SbStudy *study = synthetic(1);
  for (size_t panels = 0; panels <= SB_STUDY_PANELS; panels++) {
    for (int wide = 0; wide < 2; wide++) {
      study->panel_count = panels;
      SbRect rect = {10, 20, wide ? 1500 : 500, wide ? 500 : 900};
      SbStudyLayout layout;
      sb_study_layout(&layout, rect, study);
      SbRect parts[SB_STUDY_PANELS + 2];
      size_t count = 0;
      for (size_t i = 0; i < panels; i++) {
        parts[count++] = layout.panel[i];
      }
      parts[count++] = layout.table;
      parts[count++] = layout.notes;
      for (size_t i = 0; i < count; i++) {
        g_assert_cmpfloat(parts[i].x, >=, rect.x);
        g_assert_cmpfloat(parts[i].y, >=, rect.y);
        g_assert_cmpfloat(parts[i].x + parts[i].width, <=, rect.x + rect.width + 1e-9);
        g_assert_cmpfloat(parts[i].y + parts[i].height, <=, rect.y + rect.height + 1e-9);
        for (size_t k = 0; k < i; k++) {
          bool apart = parts[i].x >= parts[k].x + parts[k].width ||
                       parts[k].x >= parts[i].x + parts[i].width ||
                       parts[i].y >= parts[k].y + parts[k].height ||
                       parts[k].y >= parts[i].y + parts[i].height;
          g_assert_true(apart);
        }
      }
    }
  }
  g_free(study);
}

// Ground of the region where the stem does not return, in pixels of a page.
static int pixels_of(cairo_surface_t *surface, SbColor color) {
  cairo_surface_flush(surface);
  const unsigned char *data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  const unsigned wanted = (unsigned)lround(255 * color.r) << 16 |
                          (unsigned)lround(255 * color.g) << 8 | (unsigned)lround(255 * color.b);
  int count = 0;
  for (int y = 0; y < cairo_image_surface_get_height(surface); y++) {
    for (int x = 0; x < cairo_image_surface_get_width(surface); x++) {
      unsigned pixel;
      memcpy(&pixel, data + y * stride + 4 * x, sizeof pixel);
      count += (pixel & 0xFFFFFFu) == wanted;
    }
  }
  return count;
}

static cairo_surface_t *swap_page(const SbStudy *study, const SbModel *model,
                                  const SbPropellantsLook *look, int width, int height) {
  cairo_surface_t *surface = picture_new(width, height, 1);
  cairo_t *cr = cairo_create(surface);
  sb_propellants_draw(cr, (SbRect){0, 0, width, height}, sb_theme(false), study, model, look);
  cairo_destroy(cr);
  return surface;
}

// The swap page: where the stem stays is there if it stays somewhere, and nowhere else; the pointer
// finds the temperature it stands on; a small page shows one chart and short cards; in words it
// says what the cards say, and a limit of the scene stands for 2 N.
static void test_swap(void) {
  SbParams params;
  SbModel *model;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_FLUID_NAME, 1, NULL), ==, SB_OK);
  SbLimits limits = {.count = 1};
  limits.item[0] = (SbLimit){sb_figure_find("cycle.force_return_margin_N"), 3, INFINITY};
  g_assert_cmpint(sb_model_create(&model, &params, NULL, &limits, NULL), ==, SB_OK);
  SbStudy *study = g_new(SbStudy, 1);
  g_assert_cmpint(sb_study_make(study, SB_STUDY_PROPELLANTS, model, NULL, NULL), ==, SB_OK);
  SbPropellantsLook look = sb_propellants_look(model);
  g_assert_cmpfloat(look.temperature, ==, 293.15);
  const SbColor stays = sb_theme(false)->role[SB_ROLE_ERROR_GROUND];
  for (int small = 0; small < 2; small++) {
    const int width = small ? 1024 : 1600, height = small ? 560 : 860;
    cairo_surface_t *page = swap_page(study, model, &look, width, height);
    picture_show(page, small ? "swap-small" : "swap");
    g_assert_cmpint(pixels_of(page, stays), >, 2000);
    cairo_surface_destroy(page);
    SbPropellantsLayout layout;
    sb_propellants_layout(&layout, (SbRect){0, 0, width, height}, &look);
    for (int i = 0; i < SB_PROPELLANTS_CHARTS; i++) {
      const SbRect r = layout.plot[i];
      g_assert_true((r.width > 0) == (!small || i == SB_PROPELLANTS_RETURN));
      if (r.width > 0) {
        const double middle = sb_propellants_at(&layout, study, r.x + r.width / 2, r.y + 20);
        g_assert_cmpfloat(fabs(middle - 288.15), <, 1e-6); // of -20 to 50
      }
    }
    g_assert_true(isnan(sb_propellants_at(&layout, study, 2, height - 2)));
  }
  g_autofree char *text = sb_propellants_text(study, model, &look);

  // No line breaks between a number and its unit.
  g_auto(GStrv) parts = g_strsplit(text, "\u00a0", -1);
  g_autofree char *plain = g_strjoinv(" ", parts);
  g_assert_nonnull(strstr(plain, "HFA-134a: does not return, \u22121.382 N at 20 \u00b0C; from "
                                 "24 \u00b0C, 3 N from 30 \u00b0C."));
  // Without a measurement the modulus is constant, and the page and the study state this.
  g_assert_nonnull(strstr(plain, "Modulus: 0 % at 20 °C against 20 °C (inferred)."));
  g_assert_nonnull(strstr(study->note[2], "inferred"));
  bool told = false;
  for (size_t i = 0; i < study->warnings.count; i++) {
    told = told || strcmp(study->warnings.item[i].code, "modulus-temperature") == 0;
  }
  g_assert_true(told);
  look.temperature = 243.15;
  look.hidden = 1 << 2;
  g_autofree char *cold = sb_propellants_text(study, model, &look);
  g_assert_nonnull(strstr(cold, "HFA-227ea: delivers nothing"));
  g_assert_null(strstr(cold, "HFA-152a"));
  // A valve that always returns has no such region.
  for (size_t s = 0; s < study->panel[SB_PROPELLANTS_RETURN].series_count; s++) {
    SbStudySeries *series = &study->panel[SB_PROPELLANTS_RETURN].series[s];
    for (size_t i = 0; i < series->count; i++) {
      series->y[i] += 20;
    }
  }
  cairo_surface_t *page = swap_page(study, model, &look, 1600, 860);
  g_assert_cmpint(pixels_of(page, stays), ==, 0);
  cairo_surface_destroy(page);
  g_free(study);
  sb_model_destroy(model);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/study/pictures", test_pictures);
  g_test_add_func("/study/text", test_text);
  g_test_add_func("/study/tables", test_tables);
  g_test_add_func("/study/inside-the-card", test_inside_the_card);
  g_test_add_func("/study/layout", test_layout);
  g_test_add_func("/study/swap", test_swap);
  return g_test_run();
}

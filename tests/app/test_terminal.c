// What terminals show: cells, their colours, curves in them, and pictures as a terminal gets them.
#include "app/section/draw_cairo.h"
#include "app/terminal/charts.h"
#include "app/terminal/picture.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static const SbPen own = {SB_CELL_OWN, SB_CELL_OWN, 0};

static char *line_of(int columns, bool ascii, const char *text) {
  SbCells cells;
  sb_cells_init(&cells, columns, 1, ascii);
  sb_cells_text(&cells, 0, 0, columns, text, own);
  char *out = sb_cells_to_text(&cells);
  sb_cells_finish(&cells);
  return g_strchomp(out);
}

// A line is cut with an ellipsis; in ASCII every sign has a stand-in of one column; what has no
// column of its own stays out, so that nothing moves what follows it.
static void test_text(void) {
  static const struct {
    int columns;
    bool ascii;
    const char *text, *shown;
  } cases[] = {
      {20, false, "✗ −1.1 N at 10 °C", "✗ −1.1 N at 10 °C"},
      {20, true, "✗ −1.1 N at 10 °C", "x -1.1 N at 10 C"},
      {6, false, "Section", "Secti…"},
      {6, true, "Section", "Secti."},
      {9, false, "a\033[2Jb\tc\r\n", "a[2Jbc"},
      {9, false, "e\xcc\x81\xe2\x80\x89x", "e x"},
      {9, false, "\xe6\xbc\xa2z", "?z"},
      {9, true, "Größe", "Gro?e"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autofree char *shown = line_of(cases[i].columns, cases[i].ascii, cases[i].text);
    g_assert_cmpstr(shown, ==, cases[i].shown);
  }
  // Whatever the sizes, nothing is written beyond them.
  SbCells cells;
  sb_cells_init(&cells, 7, 3, false);
  sb_cells_text(&cells, -3, 1, 100, "abcdefghijklmnop", own);
  sb_cells_text(&cells, 0, 9, 100, "abc", own);
  sb_cells_fill(&cells, (SbCellRect){-5, -5, 100, 6}, '#', own);
  sb_cells_bar(&cells, 5, 2, 1000, own);
  sb_cells_bar(&cells, 2, 2, -1000, own);
  sb_cells_frame(&cells, (SbCellRect){-2, -2, 40, 40}, own);
  g_assert_cmpint(sb_cells_paragraph(&cells, (SbCellRect){0, 0, 3, 2}, "ab cd ef gh", own), ==, 2);
  sb_cells_finish(&cells);
}

static void test_colors(void) {
  g_assert_cmpint(sb_colors_nearest(SB_COLORS_16, 0xff0000), ==, 9);
  g_assert_cmpint(sb_colors_nearest(SB_COLORS_16, 0x010101), ==, 0);
  g_assert_cmpint(sb_colors_nearest(SB_COLORS_256, 0xff0000), ==, 196);
  g_assert_cmpint(sb_colors_nearest(SB_COLORS_256, 0x808080), ==, 244);
  static const struct {
    const char *no, *more, *term;
    SbColors colors;
  } cases[] = {{NULL, "truecolor", "xterm-256color", SB_COLORS_TRUE},
               {"", NULL, "xterm-256color", SB_COLORS_256},
               {NULL, NULL, "linux", SB_COLORS_16},
               {"1", "truecolor", "xterm", SB_COLORS_NONE},
               {NULL, "truecolor", "dumb", SB_COLORS_NONE}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    const char *const names[] = {"NO_COLOR", "COLORTERM", "TERM"};
    const char *const values[] = {cases[i].no, cases[i].more, cases[i].term};
    for (int k = 0; k < 3; k++) {
      if (values[k] != NULL) {
        g_setenv(names[k], values[k], TRUE);
      } else {
        g_unsetenv(names[k]);
      }
    }
    g_assert_cmpint(sb_colors_of_environment(), ==, cases[i].colors);
  }
}

// A line from corner to corner meets both, in order, and nothing of it is outside; a gap stays one.
static void test_plot(void) {
  SbCells cells;
  sb_cells_init(&cells, 12, 6, false);
  const SbScale x = {.lo = 0, .hi = 10}, y = {.lo = 0, .hi = 1};
  SbPlot plot;
  sb_plot_init(&plot, &cells, (SbCellRect){1, 1, 10, 4}, &x, &y);
  const double px[] = {-10, 20, NAN, 0, 10}, py[] = {-1, 2, 0, 1, 1};
  sb_plot_curve(&plot, px, py, 5, &(SbPlotLine){.ink = 0xff0000, .rank = 2});
  sb_plot_finish(&plot);
  int column, row;
  g_assert_true(sb_plot_cell(&plot, 0, 0, &column, &row));
  g_assert_cmpint(column, ==, 1);
  g_assert_cmpint(row, ==, 4);
  g_assert_false(sb_plot_cell(&plot, 11, 0, &column, &row));
  for (int line = 0; line < 6; line++) {
    int dots = 0;
    for (int i = 0; i < 12; i++) {
      const bool in = sb_cells_at(&cells, i, line) > 0x2800;
      g_assert_false(in && (i < 1 || i > 10 || line < 1 || line > 4));
      dots += in;
    }
    g_assert_cmpint(dots, ==, line < 1 || line > 4 ? 0 : line == 1 ? 10 : dots);
    g_assert_true(line < 1 || line > 4 || dots > 0);
  }
  sb_cells_finish(&cells);
}

// A histogram's bars hold every value, those beyond a limit in the colour of errors.
static void test_histogram(void) {
  SbCells cells;
  SbCellTheme theme;
  double value[101];
  sb_cell_theme(&theme, false);
  for (int i = 0; i < 100; i++) {
    value[i] = i;
  }
  value[100] = NAN;
  sb_cells_init(&cells, 60, 10, false);
  sb_chart_histogram(&cells, (SbCellRect){0, 0, 60, 10}, &theme, "Force / N", value, 101, -INFINITY,
                     49);
  int bad = 0, good = 0;
  for (int i = 0; i < 600; i++) {
    const SbCell *cell = &cells.cell[i];
    const bool bar = cell->glyph > 0x2580 && cell->glyph <= 0x2588;
    bad += bar && cell->pen.ink == theme.role[SB_ROLE_ERROR];
    good += bar && cell->pen.ink == theme.role[SB_ROLE_FLUID];
  }
  g_assert_cmpint(bad, >, 0);
  g_assert_cmpint(ABS(bad - good), <=, good / 5);
  g_autofree char *text = sb_cells_to_text(&cells);
  g_assert_nonnull(strstr(text, "101 samples, 1 without a value"));
  sb_cells_finish(&cells);
}

// Pixels ----------------------------------------------------------------------------------------

// Decodes what DEC's terminals take: colours #n;2;r;g;b in per cent, repeats !n, $ and -.
static void decode_sixel(uint32_t *out, int width, int height, const char *text) {
  uint32_t palette[1024] = {0};
  int x = 0, y = 0;
  uint32_t color = 0;
  const char *at = strchr(strstr(text, "\033P"), 'q') + 1;
  while (*at != '\0' && *at != '\033') {
    const char kind = *at++;
    long number[5] = {0};
    int count = 0;
    if (kind == '#' || kind == '!' || kind == '"') {
      for (; g_ascii_isdigit(*at) && count < 5; count++) {
        number[count] = strtol(at, (char **)&at, 10);
        at += *at == ';' ? 1 : 0;
      }
    }
    if (kind == '#') {
      if (count == 5 && number[1] == 2) {
        palette[number[0] % 1024] = (uint32_t)(number[2] * 255 / 100) << 16 |
                                    (uint32_t)(number[3] * 255 / 100) << 8 |
                                    (uint32_t)(number[4] * 255 / 100);
      }
      color = palette[number[0] % 1024];
    } else if (kind == '$') {
      x = 0;
    } else if (kind == '-') {
      x = 0;
      y += 6;
    } else if (kind == '!' || (kind >= '?' && kind <= '~')) {
      const int repeat = kind == '!' ? (int)number[0] : 1;
      const int bits = (kind == '!' ? *at++ : kind) - '?';
      for (int i = 0; i < repeat; i++, x++) {
        for (int k = 0; k < 6; k++) {
          if ((bits >> k & 1) != 0 && x < width && y + k < height) {
            out[(y + k) * width + x] = color;
          }
        }
      }
    }
  }
}

// A picture with lines, areas and text, and one that differs in a place.
static void make_list(SbDrawList *list, double at) {
  sb_draw_list_init(list);
  sb_draw_list_clear(list, 160, 60, (SbColor){0.1, 0.1, 0.12, 1});
  sb_draw_rect(list, 10, 10, 60, 40, (SbColor){0.1, 0.3, 0.5, 1});
  sb_draw_disc(list, at, 32, 16, (SbColor){0.9, 0.5, 0.2, 1});
  sb_draw_line(list, 0, 56, 160, 56, 2, (SbColor){0.9, 0.9, 0.9, 1});
  sb_draw_text(list, 80, 12, 10, 400, SB_MIDDLE, (SbColor){1, 1, 1, 1}, "Outer seal");
}

enum { WIDTH = 160, HEIGHT = 60 };

// Mean difference of a channel, 0 to 255, between the list by cairo and decoded sixels.
static double difference(const uint32_t *decoded, const SbDrawList *list, SbText *text) {
  cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
  cairo_t *cr = cairo_create(surface);
  sb_draw_list_to_cairo(list, text, cr);
  cairo_destroy(cr);
  cairo_surface_flush(surface);
  const unsigned char *data = cairo_image_surface_get_data(surface);
  double sum = 0;
  for (int i = 0; i < WIDTH * HEIGHT; i++) {
    const uint32_t *row =
        (const uint32_t *)(const void *)(data +
                                         (size_t)(i / WIDTH) *
                                             (size_t)cairo_image_surface_get_stride(surface));
    for (int k = 0; k < 3; k++) {
      sum += abs((int)(row[i % WIDTH] >> 8 * k & 255) - (int)(decoded[i] >> 8 * k & 255));
    }
  }
  cairo_surface_destroy(surface);
  return sum / (3.0 * WIDTH * HEIGHT);
}

static void test_sixel(void) {
  SbDrawList list, other;
  SbText *text = sb_text_create();
  make_list(&list, 110);
  make_list(&other, 118);
  GString *bytes = sb_picture_pixels(&list, text, SB_PICTURES_SIXEL, 20, 4, 8, 16);
  g_autofree uint32_t *decoded = g_new0(uint32_t, WIDTH * HEIGHT);
  decode_sixel(decoded, WIDTH, HEIGHT, bytes->str);
  // Sixels have colours in per cent, and chafa's are v * 100 / 256 without a fraction: up to 3.6
  // below what they stand for.
  const double same = difference(decoded, &list, text), moved = difference(decoded, &other, text);
  g_test_message("mean difference %.2f, of the other picture %.2f", same, moved);
  g_assert_cmpfloat(same, <, 3.6);
  g_assert_cmpfloat(moved, >, 2 * same);
  g_string_free(bytes, TRUE);
  sb_draw_list_finish(&list);
  sb_draw_list_finish(&other);
  sb_text_destroy(text);
}

// Half blocks have the picture's own colours, and its text in characters.
static void test_blocks(void) {
  SbDrawList list;
  SbCells cells;
  SbText *text = sb_text_create();
  make_list(&list, 110);
  sb_cells_init(&cells, 20, 4, false);
  sb_picture_blocks(&cells, (SbCellRect){0, 0, 20, 4}, &list, text);
  g_autofree char *shown = sb_cells_to_text(&cells);
  g_assert_nonnull(strstr(shown, "Outer seal"));
  const SbCell *blue = &cells.cell[1 * 20 + 4], *orange = &cells.cell[2 * 20 + 13];
  g_assert_cmphex(blue->glyph, ==, 0x2580);
  // To cairo's rounding.
  const uint32_t want[] = {sb_cell_color((SbColor){0.1, 0.3, 0.5, 1}),
                           sb_cell_color((SbColor){0.9, 0.5, 0.2, 1})};
  for (int k = 0; k < 24; k += 8) {
    g_assert_cmpint(abs((int)(blue->pen.ink >> k & 255) - (int)(want[0] >> k & 255)), <=, 1);
    g_assert_cmpint(abs((int)(orange->pen.ink >> k & 255) - (int)(want[1] >> k & 255)), <=, 1);
  }
  sb_cells_finish(&cells);
  sb_draw_list_finish(&list);
  sb_text_destroy(text);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/terminal/text", test_text);
  g_test_add_func("/terminal/colors", test_colors);
  g_test_add_func("/terminal/plot", test_plot);
  g_test_add_func("/terminal/histogram", test_histogram);
  g_test_add_func("/terminal/sixel", test_sixel);
  g_test_add_func("/terminal/blocks", test_blocks);
  return g_test_run();
}

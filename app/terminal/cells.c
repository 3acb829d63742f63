// The grid of cells. See cells.h.
#include "app/terminal/cells.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// Stand-ins -------------------------------------------------------------------------------------

// Signs that the program itself writes; '\0': left out.
static const struct {
  uint32_t sign;
  char stand_in;
} signs[] = {
    {0x2713, '+'}, {0x2717, 'x'}, {0x26a0, '!'}, {0x2212, '-'}, {0x2013, '-'},  {0x2014, '-'},
    {0x00b7, '.'}, {0x2026, '.'}, {0x00b0, 0},   {0x00b5, 'u'}, {0x03bc, 'u'},  {0x00b1, '~'},
    {0x2009, ' '}, {0x202f, ' '}, {0x00a0, ' '}, {0x00d7, 'x'}, {0x25be, 'v'},  {0x25b8, '>'},
    {0x25cf, 'o'}, {0x25b6, '>'}, {0x25bc, 'V'}, {0x2501, '='}, {0x2191, '^'},  {0x2193, 'v'},
    {0x2190, '<'}, {0x2192, '>'}, {0x23ce, 'E'}, {0x2423, '_'}, {0x258e, '|'},  {0x2502, '|'},
    {0x2500, '-'}, {0x201c, '"'}, {0x201d, '"'}, {0x201e, '"'}, {0x2019, '\''}, {0x00b2, '2'},
    {0x00b3, '3'}, {0x03bb, 'l'}, {0x03c3, 's'}, {0x03c4, 't'}, {0x03b7, 'n'},  {0x03bd, 'v'},
    {0x03b1, 'a'}, {0x03b2, 'b'}, {0x0394, 'D'}, {0x2011, '-'}, {0x25cb, 'o'},  {0x25c6, '*'},
};

static uint32_t stand_in(uint32_t glyph) {
  for (size_t i = 0; i < G_N_ELEMENTS(signs); i++) {
    if (signs[i].sign == glyph) {
      return (uint32_t)signs[i].stand_in;
    }
  }
  if (glyph > 0x2500 && glyph < 0x2580) {
    return '+'; // corners and crossings of lines
  }
  if (glyph >= 0x2580 && glyph < 0x25a0) {
    return '#'; // blocks
  }
  if (glyph > 0x2800 && glyph < 0x2900) {
    // Braille: where in the cell the dots are.
    const bool top = (glyph & 0x1b) != 0, bottom = (glyph & 0xe4) != 0;
    return top && bottom ? ':' : top ? '\'' : '.';
  }
  // Letters without their accents.
  gunichar base[G_UNICHAR_MAX_DECOMPOSITION_LENGTH];
  if (g_unichar_fully_decompose(glyph, FALSE, base, G_N_ELEMENTS(base)) > 0 && base[0] < 0x7f) {
    return base[0];
  }
  return '?';
}

// What stands in a cell for a character; 0: nothing does.
static uint32_t glyph_of(const SbCells *cells, uint32_t glyph) {
  if (glyph < 0x20 || (glyph >= 0x7f && glyph < 0xa0) || g_unichar_iszerowidth(glyph)) {
    return 0;
  }
  if (glyph >= 0x7f && cells->ascii) {
    return stand_in(glyph);
  }
  // Thin spaces have no column of their own width.
  if (glyph == 0x2009 || glyph == 0x202f || glyph == 0xa0) {
    return ' ';
  }
  return g_unichar_iswide(glyph) ? '?' : glyph;
}

// Writing ---------------------------------------------------------------------------------------

void sb_cells_init(SbCells *cells, int columns, int rows, bool ascii) {
  *cells = (SbCells){.columns = CLAMP(columns, 1, SB_CELLS_COLUMNS_MAX),
                     .rows = CLAMP(rows, 1, SB_CELLS_ROWS_MAX),
                     .ascii = ascii};
  cells->cell = g_new(SbCell, (size_t)cells->columns * (size_t)cells->rows);
  sb_cells_fill(cells, (SbCellRect){0, 0, cells->columns, cells->rows}, ' ',
                (SbPen){SB_CELL_OWN, SB_CELL_OWN, 0});
}

void sb_cells_finish(SbCells *cells) {
  g_clear_pointer(&cells->cell, g_free);
}

uint32_t sb_cell_color(SbColor color) {
  const double part[] = {color.r, color.g, color.b};
  uint32_t rgb = 0;
  for (int i = 0; i < 3; i++) {
    rgb = rgb << 8 | (uint32_t)lround(255 * fmin(fmax(part[i], 0), 1));
  }
  return rgb;
}

static SbCell *cell_at(const SbCells *cells, int x, int y) {
  return x >= 0 && y >= 0 && x < cells->columns && y < cells->rows
             ? &cells->cell[(size_t)y * (size_t)cells->columns + (size_t)x]
             : NULL;
}

static void put(SbCells *cells, int x, int y, uint32_t glyph, SbPen pen) {
  SbCell *cell = cell_at(cells, x, y);
  if (cell != NULL) {
    const uint32_t ground = pen.ground == SB_CELL_OWN ? cell->pen.ground : pen.ground;
    *cell = (SbCell){glyph, {pen.ink, ground, pen.style}};
  }
}

void sb_cells_put(SbCells *cells, int x, int y, uint32_t glyph, SbPen pen) {
  glyph = glyph_of(cells, glyph);
  if (glyph != 0) {
    put(cells, x, y, glyph, pen);
  }
}

uint32_t sb_cells_at(const SbCells *cells, int x, int y) {
  const SbCell *cell = cell_at(cells, x, y);
  return cell != NULL ? cell->glyph : 0;
}

void sb_cells_fill(SbCells *cells, SbCellRect rect, uint32_t glyph, SbPen pen) {
  const int right = MIN(rect.x + rect.width, cells->columns);
  const int bottom = MIN(rect.y + rect.height, cells->rows);
  for (int y = MAX(rect.y, 0); y < bottom; y++) {
    for (int x = MAX(rect.x, 0); x < right; x++) {
      *cell_at(cells, x, y) = (SbCell){glyph, pen};
    }
  }
}

int sb_cells_width(const SbCells *cells, const char *text) {
  int width = 0;
  for (const char *at = text; *at != '\0'; at = g_utf8_next_char(at)) {
    width += glyph_of(cells, g_utf8_get_char(at)) != 0;
  }
  return width;
}

int sb_cells_text(SbCells *cells, int x, int y, int width, const char *text, SbPen pen) {
  if (width <= 0) {
    return 0;
  }
  const bool cut = sb_cells_width(cells, text) > width;
  int taken = 0;
  for (const char *at = text; *at != '\0' && taken < width; at = g_utf8_next_char(at)) {
    uint32_t glyph = glyph_of(cells, g_utf8_get_char(at));
    if (glyph == 0) {
      continue;
    }
    if (cut && taken == width - 1) {
      glyph = glyph_of(cells, 0x2026);
    }
    put(cells, x + taken, y, glyph, pen);
    taken++;
  }
  return taken;
}

void sb_cells_text_right(SbCells *cells, int x, int y, int width, const char *text, SbPen pen) {
  const int taken = MIN(sb_cells_width(cells, text), width);
  sb_cells_text(cells, x + width - taken, y, taken, text, pen);
}

int sb_cells_paragraph(SbCells *cells, SbCellRect rect, const char *text, SbPen pen) {
  int line = 0;
  const char *at = text;
  while (*at != '\0' && line < rect.height) {
    // As many words as fit, at least a piece of one.
    const char *end = at, *look = at;
    int width = 0;
    while (*look != '\0' && *look != '\n' && width < rect.width) {
      look = g_utf8_next_char(look);
      width++;
      if (*look == ' ' || *look == '\n' || *look == '\0') {
        end = look;
      }
    }
    if (end == at || *look == '\0' || *look == '\n') {
      end = look;
    }
    // The last line that there is takes the rest, cut.
    g_autofree char *piece =
        line == rect.height - 1 ? g_strdup(at) : g_strndup(at, (gsize)(end - at));
    g_strdelimit(piece, "\n", ' ');
    sb_cells_text(cells, rect.x, rect.y + line, rect.width, piece, pen);
    line++;
    at = end;
    while (*at == ' ' || *at == '\n') {
      at++;
      if (at[-1] == '\n') {
        break;
      }
    }
  }
  return line;
}

void sb_cells_bar(SbCells *cells, int x, int y, int length, SbPen pen) {
  if (cells->ascii) {
    length = length > 0 ? (length + 4) / 8 * 8 : -((4 - length) / 8 * 8);
  }
  if (length >= 0) {
    for (; length >= 8; length -= 8) {
      sb_cells_put(cells, x++, y, 0x2588, pen);
    }
    if (length > 0) {
      sb_cells_put(cells, x, y, 0x2590 - (uint32_t)length, pen); // from the left, in eighths
    }
    return;
  }
  for (length = -length; length >= 8; length -= 8) {
    sb_cells_put(cells, --x, y, 0x2588, pen);
  }
  if (length > 0) {
    sb_cells_put(cells, --x, y, length >= 4 ? 0x2590 : 0x2595, pen); // half or an eighth
  }
}

void sb_cells_frame(SbCells *cells, SbCellRect rect, SbPen pen) {
  const int right = rect.x + rect.width - 1, bottom = rect.y + rect.height - 1;
  for (int x = rect.x + 1; x < right; x++) {
    sb_cells_put(cells, x, rect.y, 0x2500, pen);
    sb_cells_put(cells, x, bottom, 0x2500, pen);
  }
  for (int y = rect.y + 1; y < bottom; y++) {
    sb_cells_put(cells, rect.x, y, 0x2502, pen);
    sb_cells_put(cells, right, y, 0x2502, pen);
  }
  sb_cells_put(cells, rect.x, rect.y, 0x250c, pen);
  sb_cells_put(cells, right, rect.y, 0x2510, pen);
  sb_cells_put(cells, rect.x, bottom, 0x2514, pen);
  sb_cells_put(cells, right, bottom, 0x2518, pen);
}

// Colours ---------------------------------------------------------------------------------------

SbColors sb_colors_of_environment(void) {
  const char *no = g_getenv("NO_COLOR"), *term = g_getenv("TERM"), *more = g_getenv("COLORTERM");
  if ((no != NULL && no[0] != '\0') || term == NULL || term[0] == '\0' ||
      strcmp(term, "dumb") == 0 || g_str_has_prefix(term, "vt")) {
    return SB_COLORS_NONE; // no-color.org
  }
  if ((more != NULL && (strcmp(more, "truecolor") == 0 || strcmp(more, "24bit") == 0)) ||
      strstr(term, "direct") != NULL || strstr(term, "kitty") != NULL) {
    return SB_COLORS_TRUE;
  }
  return strstr(term, "256color") != NULL ? SB_COLORS_256 : SB_COLORS_16;
}

bool sb_cells_ascii_environment(void) {
  // POSIX: the first of these that is set and not empty.
  static const char *const names[] = {"LC_ALL", "LC_CTYPE", "LANG"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    const char *value = g_getenv(names[i]);
    if (value != NULL && value[0] != '\0') {
      g_autofree char *low = g_ascii_strdown(value, -1);
      return strstr(low, "utf-8") == NULL && strstr(low, "utf8") == NULL;
    }
  }
  return true;
}

// A colour of the palette that terminals share: xterm's 16, the cube, the greys.
static uint32_t palette(int index) {
  static const uint32_t basic[16] = {0x000000, 0xcd0000, 0x00cd00, 0xcdcd00, 0x0000ee, 0xcd00cd,
                                     0x00cdcd, 0xe5e5e5, 0x7f7f7f, 0xff0000, 0x00ff00, 0xffff00,
                                     0x5c5cff, 0xff00ff, 0x00ffff, 0xffffff};
  if (index < 16) {
    return basic[index];
  }
  if (index >= 232) {
    const uint32_t grey = (uint32_t)(8 + 10 * (index - 232));
    return grey << 16 | grey << 8 | grey;
  }
  static const uint32_t level[6] = {0, 95, 135, 175, 215, 255};
  index -= 16;
  return level[index / 36] << 16 | level[index / 6 % 6] << 8 | level[index % 6];
}

static int distance(uint32_t a, uint32_t b) {
  static const int weight[3] = {3, 6, 1}; // of red, green and blue to the eye, roughly
  int sum = 0;
  for (int i = 0; i < 3; i++) {
    const int difference = (int)(a >> (16 - 8 * i) & 255) - (int)(b >> (16 - 8 * i) & 255);
    sum += weight[i] * difference * difference;
  }
  return sum;
}

int sb_colors_nearest(SbColors colors, uint32_t rgb) {
  // The first 16 are the user's own where there are more.
  const int first = colors == SB_COLORS_16 ? 0 : 16, last = colors == SB_COLORS_16 ? 16 : 256;
  static struct {
    uint32_t rgb;
    int colors, index;
  } seen[256];
  const uint32_t slot = (rgb * 2654435761u) >> 24;
  if (seen[slot].colors == (int)colors && seen[slot].rgb == rgb && seen[slot].index > 0) {
    return seen[slot].index;
  }
  int best = first;
  for (int i = first + 1; i < last; i++) {
    best = distance(rgb, palette(i)) < distance(rgb, palette(best)) ? i : best;
  }
  seen[slot].rgb = rgb;
  seen[slot].colors = (int)colors;
  seen[slot].index = best;
  return best;
}

// Out -------------------------------------------------------------------------------------------

static int line_length(const SbCells *cells, int y) {
  int length = cells->columns;
  while (length > 0 && sb_cells_at(cells, length - 1, y) == ' ') {
    length--;
  }
  return length;
}

char *sb_cells_to_text(const SbCells *cells) {
  GString *text = g_string_new(NULL);
  for (int y = 0; y < cells->rows; y++) {
    const int length = line_length(cells, y);
    for (int x = 0; x < length; x++) {
      g_string_append_unichar(text, sb_cells_at(cells, x, y));
    }
    g_string_append_c(text, '\n');
  }
  return g_string_free(text, FALSE);
}

static void append_color(GString *text, SbColors colors, uint32_t rgb, int base) {
  if (rgb == SB_CELL_OWN) {
    return;
  }
  if (colors == SB_COLORS_TRUE) {
    g_string_append_printf(text, ";%d;2;%u;%u;%u", base + 8, rgb >> 16, rgb >> 8 & 255, rgb & 255);
  } else if (colors == SB_COLORS_256) {
    g_string_append_printf(text, ";%d;5;%d", base + 8, sb_colors_nearest(colors, rgb));
  } else {
    const int index = sb_colors_nearest(colors, rgb);
    g_string_append_printf(text, ";%d", index < 8 ? base + index : base + 60 + index - 8);
  }
}

void sb_cells_print(const SbCells *cells, SbColors colors, FILE *stream) {
  if (colors == SB_COLORS_NONE) {
    g_autofree char *text = sb_cells_to_text(cells);
    fputs(text, stream);
    return;
  }
  g_autoptr(GString) text = g_string_new(NULL);
  for (int y = 0; y < cells->rows; y++) {
    const int length = line_length(cells, y);
    const SbPen own = {SB_CELL_OWN, SB_CELL_OWN, 0};
    SbPen now = own;
    for (int x = 0; x < length; x++) {
      const SbCell *cell = cell_at(cells, x, y);
      const SbPen pen = cell->glyph == ' ' && cell->pen.ground == SB_CELL_OWN ? own : cell->pen;
      if (pen.ink != now.ink || pen.ground != now.ground || pen.style != now.style) {
        g_string_append(text, "\033[0");
        g_string_append(text, pen.style & SB_CELL_BOLD ? ";1" : "");
        append_color(text, colors, pen.ink, 30);
        append_color(text, colors, pen.ground, 40);
        g_string_append_c(text, 'm');
        now = pen;
      }
      g_string_append_unichar(text, cell->glyph);
    }
    const bool plain = now.ink == own.ink && now.ground == own.ground && now.style == 0;
    g_string_append(text, plain ? "\n" : "\033[0m\n");
  }
  fputs(text->str, stream);
}

// Output of the terminal: the queue of bytes, which is written as the line accepts them, and the
// cells and pixels that differ from the shown ones.
#include "app/terminal/screen_private.h"

#include <errno.h>
#include <glib-unix.h>
#include <string.h>
#include <unistd.h>

enum {
  SLOW_US = 150000,    // a line that takes longer for one picture of the screen is slow
  QUEUE_MAX = 8 << 20, // bytes that wait; a terminal that takes none of them is gone
};

// Out -------------------------------------------------------------------------------------------

static gboolean on_writable(int fd, GIOCondition condition, gpointer data);

void sb_screen_write(SbScreen *screen) {
  guint done = 0;
  bool gone = false;
  while (done < screen->queue->len) {
    const ssize_t written =
        write(screen->tty, screen->queue->data + done, screen->queue->len - done);
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      gone = errno != EAGAIN && errno != EWOULDBLOCK;
      break;
    }
    done += (guint)written;
  }
  g_byte_array_remove_range(screen->queue, 0, done);
  if (gone || screen->queue->len > QUEUE_MAX) {
    g_byte_array_set_size(screen->queue, 0);
    screen->client.end(screen->client.data);
  }
  if (screen->queue->len == 0) {
    screen->slow = screen->since != 0 && g_get_monotonic_time() - screen->since > SLOW_US;
    screen->since = 0;
  } else if (screen->out == 0) {
    screen->out = g_unix_fd_add(screen->tty, G_IO_OUT | G_IO_ERR | G_IO_HUP, on_writable, screen);
  }
}

static gboolean on_writable(int fd, GIOCondition condition, gpointer data) {
  SbScreen *screen = data;
  sb_screen_write(screen);
  if (screen->queue->len > 0) {
    return G_SOURCE_CONTINUE;
  }
  screen->out = 0;
  screen->client.draw(screen->client.data); // what was left out meanwhile
  return G_SOURCE_REMOVE;
}

static void push(SbScreen *screen, const void *bytes, size_t length) {
  if (length > 0) {
    screen->since = screen->since == 0 ? g_get_monotonic_time() : screen->since;
    g_byte_array_append(screen->queue, bytes, (guint)length);
  }
}

void sb_screen_push_text(SbScreen *screen, const char *text) {
  push(screen, text, strlen(text));
}

void sb_screen_on_output(TickitTerm *term, const char *bytes, size_t length, void *data) {
  if (bytes != NULL) {
    push(data, bytes, length);
  }
}

// Showing ---------------------------------------------------------------------------------------

static void set_color(SbScreen *screen, TickitPenAttr attribute, uint32_t rgb) {
  if (rgb == SB_CELL_OWN || screen->colors == SB_COLORS_NONE) {
    tickit_pen_set_colour_attr(screen->pen, attribute, -1);
    return;
  }
  const SbColors palette = screen->colors == SB_COLORS_TRUE ? SB_COLORS_256 : screen->colors;
  tickit_pen_set_colour_attr(screen->pen, attribute, sb_colors_nearest(palette, rgb));
  if (screen->colors == SB_COLORS_TRUE) {
    tickit_pen_set_colour_attr_rgb8(
        screen->pen, attribute,
        (TickitPenRGB8){(uint8_t)(rgb >> 16), (uint8_t)(rgb >> 8), (uint8_t)rgb});
  }
}

static void set_pen(SbScreen *screen, const SbPen *pen) {
  set_color(screen, TICKIT_PEN_FG, pen->ink);
  set_color(screen, TICKIT_PEN_BG, pen->ground);
  tickit_pen_set_bool_attr(screen->pen, TICKIT_PEN_BOLD, (pen->style & SB_CELL_BOLD) != 0);
  tickit_pen_set_bool_attr(screen->pen, TICKIT_PEN_REVERSE, (pen->style & SB_CELL_REVERSE) != 0);
  tickit_pen_set_int_attr(screen->pen, TICKIT_PEN_UNDER, (pen->style & SB_CELL_UNDERLINE) != 0);
  tickit_term_setpen(screen->term, screen->pen);
}

// Without colours a blank is a blank, whatever its ink.
static bool same_cell(const SbCell *a, const SbCell *b) {
  return a->glyph == b->glyph && a->pen.ground == b->pen.ground && a->pen.style == b->pen.style &&
         (a->glyph == ' ' || a->pen.ink == b->pen.ink);
}

static bool same_pen(const SbPen *a, const SbPen *b) {
  return a->ink == b->ink && a->ground == b->ground && a->style == b->style;
}

static void send_cells(SbScreen *screen, const SbCells *cells) {
  enum { BRIDGE = 4 }; // cells that are sent again rather than jumped over
  const SbPen *set = NULL;
  for (int y = 0; y < cells->rows; y++) {
    const size_t line = (size_t)y * (size_t)cells->columns;
    const SbCell *next = &cells->cell[line];
    SbCell *old = &screen->shown.cell[line];
    int at = -1; // where the terminal's cursor is in this line
    for (int x = 0; x < cells->columns; x++) {
      if (!screen->unknown && same_cell(&next[x], &old[x])) {
        continue;
      }
      if (at < 0 || x - at > BRIDGE) {
        tickit_term_goto(screen->term, y, x);
        at = x;
      }
      for (; at <= x; at++) {
        char text[8];
        if (set == NULL || !same_pen(set, &next[at].pen)) {
          set = &next[at].pen;
          set_pen(screen, set);
        }
        const int length = g_unichar_to_utf8(next[at].glyph, text);
        tickit_term_printn(screen->term, text, (size_t)length);
        old[at] = next[at];
      }
    }
  }
}

static bool same_rect(const SbCellRect *a, const SbCellRect *b) {
  return a->x == b->x && a->y == b->y && a->width == b->width && a->height == b->height;
}

// What was drawn by pixels goes when the cells under it are sent again.
static void remove_pixels(SbScreen *screen) {
  if (screen->pixels == NULL) {
    return;
  }
  sb_screen_push_text(screen, sb_picture_removal(screen->pictures));
  const SbCellRect *at = &screen->pixels_at;
  sb_cells_fill(&screen->shown, *at, 0, (SbPen){0, 0, 0});
  g_string_free(screen->pixels, TRUE);
  screen->pixels = NULL;
}

void sb_screen_show(SbScreen *screen, const SbCells *cells, const GString *pixels,
                    SbCellRect rect) {
  if (!screen->taken || cells->columns != screen->columns || cells->rows != screen->rows) {
    return;
  }
  if (screen->shown.columns != cells->columns || screen->shown.rows != cells->rows) {
    sb_cells_finish(&screen->shown);
    sb_cells_init(&screen->shown, cells->columns, cells->rows, screen->ascii);
    screen->unknown = true;
  }
  const bool other = screen->pixels == NULL || pixels == NULL ||
                     !same_rect(&rect, &screen->pixels_at) ||
                     !g_string_equal(pixels, screen->pixels);
  if (pixels == NULL || (screen->pixels != NULL && !same_rect(&rect, &screen->pixels_at))) {
    remove_pixels(screen);
  }
  if (screen->unknown) {
    tickit_term_setpen(screen->term, screen->pen);
    tickit_term_clear(screen->term);
  }
  send_cells(screen, cells);
  tickit_term_flush(screen->term);
  if (pixels != NULL && (other || screen->unknown)) {
    char place[32];
    g_snprintf(place, sizeof place, "\033[%d;%dH", rect.y + 1, rect.x + 1);
    sb_screen_push_text(screen, place);
    push(screen, pixels->str, pixels->len);
    if (screen->pixels != NULL) {
      g_string_free(screen->pixels, TRUE);
    }
    screen->pixels = g_string_new_len(pixels->str, (gssize)pixels->len);
    screen->pixels_at = rect;
  }
  screen->unknown = false;
  const bool cursor = screen->cursor_x >= 0;
  tickit_term_setctl_int(screen->term, TICKIT_TERMCTL_CURSORVIS, cursor);
  if (cursor) {
    tickit_term_goto(screen->term, screen->cursor_y, screen->cursor_x);
  }
  tickit_term_flush(screen->term);
  sb_screen_write(screen);
}

void sb_screen_cursor(SbScreen *screen, int x, int y) {
  screen->cursor_x = x;
  screen->cursor_y = y;
}

void sb_screen_redraw(SbScreen *screen) {
  remove_pixels(screen);
  screen->unknown = true;
  screen->client.draw(screen->client.data);
}

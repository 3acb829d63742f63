// The terminal. See screen.h. Signals are written into a pipe that the main loop reads; what a
// crash needs, the modes and a few bytes, stands ready for a handler that may call nothing else.
#include "app/terminal/screen.h"

#include <errno.h>
#include <fcntl.h>
#include <glib-unix.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <tickit.h>
#include <unistd.h>

enum {
  SLOW_US = 150000,    // a line that takes longer for one picture of the screen is slow
  REPLY_MAX = 256,     // bytes of an answer of the terminal
  ESCAPE_MS = 50,      // how long a lone Escape waits for what may follow it
  QUEUE_MAX = 8 << 20, // bytes that wait; a terminal that takes none of them is gone
};

struct SbScreen {
  SbScreenClient client;
  TickitTerm *term;
  TickitPen *pen;
  int tty;    // a description of its own: its flags are nobody else's
  bool taken; // raw mode, alternate screen
  int columns, rows, cell_width, cell_height;
  bool ascii, asked; // asked: pictures are chosen by what the terminal answers
  SbColors colors;
  SbPictures pictures;
  SbCells shown; // what the terminal has
  bool unknown;  // what it has is not known
  GByteArray *queue;
  gint64 since; // when the queue began to fill [us]
  bool slow;
  guint in, out, signals, escape;
  char reply[REPLY_MAX]; // beginning of an answer
  size_t reply_length;
  GString *pixels; // on the screen
  SbCellRect pixels_at;
  int cursor_x, cursor_y;
};

// Whatever happens ------------------------------------------------------------------------------

// For handlers: plain memory.
static struct {
  volatile sig_atomic_t tty; // -1: nothing to give back
  struct termios modes;
  int pipe[2];
} rescue = {.tty = -1, .pipe = {-1, -1}};

// Colours, cursor, mouse, margins, the other screen: harmless where a terminal is not in them.
static const char LEAVE[] = "\033[0m\033[?25h\033[?1000l\033[?1002l\033[?1003l\033[?1006l\033[?69l"
                            "\033[?1049l\033>";

static void give_back(void) {
  const int tty = rescue.tty;
  if (tty >= 0) {
    rescue.tty = -1;
    // What does not go through at once is lost: a terminal that takes nothing shows nothing.
    const ssize_t written = write(tty, LEAVE, sizeof LEAVE - 1);
    (void)written;
    tcsetattr(tty, TCSANOW, &rescue.modes);
  }
}

static void on_crash(int number) {
  give_back();
  signal(number, SIG_DFL);
  raise(number);
}

static void on_signal(int number) {
  const int error = errno;
  const unsigned char byte = (unsigned char)number;
  const ssize_t written = write(rescue.pipe[1], &byte, 1);
  (void)written;
  errno = error;
}

static const int crashes[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGQUIT};
static const int others[] = {SIGWINCH, SIGCONT, SIGTSTP, SIGHUP, SIGTERM, SIGINT};

static void catch_signals(bool on) {
  struct sigaction action = {.sa_handler = on_crash};
  sigemptyset(&action.sa_mask);
  for (size_t i = 0; i < G_N_ELEMENTS(crashes); i++) {
    struct sigaction former;
    // A sanitizer has handlers of its own, which tell more; it is left to them, and atexit gives
    // the terminal back.
    if (on && sigaction(crashes[i], NULL, &former) == 0 && former.sa_handler != SIG_DFL &&
        former.sa_handler != on_crash) {
      continue;
    }
    action.sa_handler = on ? on_crash : SIG_DFL;
    sigaction(crashes[i], &action, NULL);
  }
  action.sa_flags = SA_RESTART;
  for (size_t i = 0; i < G_N_ELEMENTS(others); i++) {
    action.sa_handler = on ? on_signal : SIG_DFL;
    sigaction(others[i], &action, NULL);
  }
}

// Out -------------------------------------------------------------------------------------------

static gboolean on_writable(int fd, GIOCondition condition, gpointer data);

// Writes what the line takes now.
static void write_some(SbScreen *screen) {
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
  write_some(screen);
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

static void push_text(SbScreen *screen, const char *text) {
  push(screen, text, strlen(text));
}

// Of libtickit; without bytes it is about to end.
static void on_output(TickitTerm *term, const char *bytes, size_t length, void *data) {
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
  push_text(screen, sb_picture_removal(screen->pictures));
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
    push_text(screen, place);
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
  write_some(screen);
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

// In --------------------------------------------------------------------------------------------

static void find_size(SbScreen *screen) {
  struct winsize size = {0};
  if (ioctl(screen->tty, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    size = (struct winsize){.ws_col = 80, .ws_row = 24};
  }
  screen->columns = MIN((int)size.ws_col, SB_CELLS_COLUMNS_MAX);
  screen->rows = MIN((int)size.ws_row, SB_CELLS_ROWS_MAX);
  if (size.ws_xpixel >= 4 * size.ws_col && size.ws_ypixel >= 4 * size.ws_row) {
    screen->cell_width = MIN(size.ws_xpixel / size.ws_col, 64);
    screen->cell_height = MIN(size.ws_ypixel / size.ws_row, 128);
  }
  tickit_term_set_size(screen->term, screen->rows, screen->columns);
}

static int on_tickit_key(TickitTerm *term, TickitEventFlags flags, void *info, void *data) {
  static const struct {
    const char *name;
    SbKeyKind kind;
  } names[] = {
      {"Up", SB_KEY_UP},         {"Down", SB_KEY_DOWN},      {"Left", SB_KEY_LEFT},
      {"Right", SB_KEY_RIGHT},   {"PageUp", SB_KEY_PAGE_UP}, {"PageDown", SB_KEY_PAGE_DOWN},
      {"Home", SB_KEY_HOME},     {"End", SB_KEY_END},        {"Enter", SB_KEY_ENTER},
      {"Escape", SB_KEY_ESCAPE}, {"Tab", SB_KEY_TAB},        {"Backspace", SB_KEY_BACKSPACE},
      {"DEL", SB_KEY_BACKSPACE}, {"Delete", SB_KEY_DELETE},  {"Space", SB_KEY_CHARACTER}};
  SbScreen *screen = data;
  const TickitKeyEventInfo *event = info;
  SbKey key = {.control = (event->mod & TICKIT_MOD_CTRL) != 0,
               .shift = (event->mod & TICKIT_MOD_SHIFT) != 0,
               .alt = (event->mod & TICKIT_MOD_ALT) != 0};
  if (event->type == TICKIT_KEYEV_TEXT) {
    const gunichar character = g_utf8_get_char_validated(event->str, -1);
    if (character < 0x110000) {
      key.character = character;
      screen->client.key(screen->client.data, &key);
    }
    return 1;
  }
  // "C-S-Left": the name is behind the last dash that is not itself one.
  const char *name = strrchr(event->str, '-');
  name = name != NULL && name[1] != '\0' ? name + 1 : event->str;
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    if (strcmp(name, names[i].name) == 0) {
      key.kind = names[i].kind == SB_KEY_TAB && key.shift ? SB_KEY_BACK_TAB : names[i].kind;
      key.character = names[i].kind == SB_KEY_CHARACTER ? ' ' : 0;
      screen->client.key(screen->client.data, &key);
      return 1;
    }
  }
  if (name[1] == '\0' && key.control) {
    key.character = (uint32_t)g_ascii_tolower(name[0]);
    screen->client.key(screen->client.data, &key);
  }
  return 1;
}

static int on_tickit_mouse(TickitTerm *term, TickitEventFlags flags, void *info, void *data) {
  SbScreen *screen = data;
  const TickitMouseEventInfo *event = info;
  SbKey key = {.x = event->col, .y = event->line, .shift = (event->mod & TICKIT_MOD_SHIFT) != 0};
  if (event->type == TICKIT_MOUSEEV_WHEEL) {
    key.kind = event->button == TICKIT_MOUSEWHEEL_UP ? SB_KEY_WHEEL_UP : SB_KEY_WHEEL_DOWN;
  } else if ((event->type == TICKIT_MOUSEEV_PRESS || event->type == TICKIT_MOUSEEV_DRAG) &&
             event->button == 1) {
    key.kind = SB_KEY_PRESS;
  } else {
    return 1;
  }
  screen->client.key(screen->client.data, &key);
  return 1;
}

// What the terminal says of itself: "ESC [ ? 62 ; 4 c" with a 4 among the numbers takes sixels, and
// "ESC [ 6 ; H ; W t" is the size of a cell [px].
static void take_reply(SbScreen *screen) {
  const char *reply = screen->reply;
  const char last = reply[screen->reply_length - 1];
  if (last == 'c' && reply[2] == '?') {
    g_autofree char *numbers = g_strndup(reply + 3, screen->reply_length - 4);
    g_auto(GStrv) each = g_strsplit(numbers, ";", 0);
    if (screen->asked && g_strv_contains((const char *const *)each, "4")) {
      screen->pictures = SB_PICTURES_SIXEL;
      screen->client.draw(screen->client.data);
    }
  } else if (last == 't') {
    int height = 0, width = 0;
    screen->reply[screen->reply_length - 1] = '\0';
    if (sscanf(reply, "\033[6;%d;%d", &height, &width) == 2 && width >= 4 && width <= 64 &&
        height >= 4 && height <= 128) {
      screen->cell_width = width;
      screen->cell_height = height;
      screen->client.draw(screen->client.data);
    }
  }
}

// Takes a byte for an answer, if it is one's beginning or goes on with it: those that libtickit has
// not asked for. Keys never look like that: CSI ? ... c and CSI 6 ; ... t.
static bool is_reply_so_far(const char *text, size_t length) {
  static const char start[] = "\033[";
  if (length <= 2) {
    return memcmp(text, start, length) == 0;
  }
  const char kind = text[2];
  if (kind != '?' && kind != '6') {
    return false;
  }
  if (length == 4 && kind == '6' && text[3] != ';') {
    return false; // ESC [ 6 ~: Page Down
  }
  for (size_t i = 3; i + 1 < length; i++) {
    if (!g_ascii_isdigit(text[i]) && text[i] != ';') {
      return false;
    }
  }
  const char last = text[length - 1];
  return length < 4 || g_ascii_isdigit(last) || last == ';' || last == (kind == '?' ? 'c' : 't');
}

static void pass_on(SbScreen *screen, const char *bytes, size_t length) {
  tickit_term_input_push_bytes(screen->term, bytes, length);
}

static void end_reply(SbScreen *screen) {
  pass_on(screen, screen->reply, screen->reply_length);
  screen->reply_length = 0;
}

static gboolean on_escape(gpointer data) {
  SbScreen *screen = data;
  screen->escape = 0;
  end_reply(screen);
  // What libtickit holds back for the same reason.
  while (screen->taken && tickit_term_input_check_timeout_msec(screen->term) > 0) {
    g_usleep(1000);
  }
  return G_SOURCE_REMOVE;
}

static gboolean on_readable(int fd, GIOCondition condition, gpointer data) {
  SbScreen *screen = data;
  char bytes[1024];
  const ssize_t count = read(fd, bytes, sizeof bytes);
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) {
    screen->in = 0;
    screen->client.end(screen->client.data);
    return G_SOURCE_REMOVE;
  }
  for (ssize_t i = 0; i < count && screen->taken; i++) {
    screen->reply[screen->reply_length++] = bytes[i];
    if (!is_reply_so_far(screen->reply, screen->reply_length) ||
        screen->reply_length == REPLY_MAX - 1) {
      end_reply(screen);
    } else if (screen->reply_length > 3 && (bytes[i] == 'c' || bytes[i] == 't')) {
      take_reply(screen);
      screen->reply_length = 0;
    }
  }
  if (screen->escape != 0) {
    g_source_remove(screen->escape);
    screen->escape = 0;
  }
  if (screen->taken &&
      (screen->reply_length > 0 || tickit_term_input_check_timeout_msec(screen->term) > 0)) {
    screen->escape = g_timeout_add(ESCAPE_MS, on_escape, screen);
  }
  return G_SOURCE_CONTINUE;
}

// Taking and giving -----------------------------------------------------------------------------

static void take(SbScreen *screen) {
  struct termios modes;
  if (tcgetattr(screen->tty, &modes) == 0) {
    rescue.modes = modes;
    cfmakeraw(&modes);
    tcsetattr(screen->tty, TCSANOW, &modes);
    rescue.tty = screen->tty;
  }
  screen->taken = true;
  screen->unknown = true;
  tickit_term_setctl_int(screen->term, TICKIT_TERMCTL_ALTSCREEN, 1);
  tickit_term_setctl_int(screen->term, TICKIT_TERMCTL_CURSORVIS, 0);
  tickit_term_setctl_int(screen->term, TICKIT_TERMCTL_MOUSE, TICKIT_TERM_MOUSEMODE_DRAG);
  tickit_term_flush(screen->term);
  find_size(screen);
  write_some(screen);
}

// Writes what waits, as far as the line takes it within a moment.
static void drain(SbScreen *screen) {
  for (int i = 0; i < 20 && screen->queue->len > 0; i++) {
    const ssize_t written = write(screen->tty, screen->queue->data, screen->queue->len);
    if (written > 0) {
      g_byte_array_remove_range(screen->queue, 0, (guint)written);
    } else {
      g_usleep(5000);
    }
  }
  g_byte_array_set_size(screen->queue, 0);
  screen->since = 0;
}

static void leave(SbScreen *screen) {
  if (!screen->taken) {
    return;
  }
  screen->taken = false;
  if (screen->pixels != NULL) {
    push_text(screen, sb_picture_removal(screen->pictures));
    g_string_free(screen->pixels, TRUE);
    screen->pixels = NULL;
  }
  // Half a picture must not swallow what follows it.
  tickit_term_setctl_int(screen->term, TICKIT_TERMCTL_MOUSE, TICKIT_TERM_MOUSEMODE_OFF);
  tickit_term_setctl_int(screen->term, TICKIT_TERMCTL_CURSORVIS, 1);
  tickit_term_setctl_int(screen->term, TICKIT_TERMCTL_ALTSCREEN, 0);
  tickit_term_flush(screen->term);
  drain(screen);
  give_back();
}

void sb_screen_suspend(SbScreen *screen) {
  leave(screen);
  struct sigaction own = {.sa_handler = SIG_DFL}, former;
  sigemptyset(&own.sa_mask);
  sigaction(SIGTSTP, &own, &former);
  kill(0, SIGTSTP); // and whoever else is in the job
  // Here again once the shell continues it.
  sigaction(SIGTSTP, &former, NULL);
  take(screen);
  screen->client.draw(screen->client.data);
}

static gboolean on_pipe(int fd, GIOCondition condition, gpointer data) {
  SbScreen *screen = data;
  unsigned char numbers[64];
  const ssize_t count = read(fd, numbers, sizeof numbers);
  bool size = false, end = false, stop = false, cont = false;
  for (ssize_t i = 0; i < count; i++) {
    size |= numbers[i] == SIGWINCH;
    stop |= numbers[i] == SIGTSTP;
    cont |= numbers[i] == SIGCONT;
    end |= numbers[i] == SIGHUP || numbers[i] == SIGTERM || numbers[i] == SIGINT;
  }
  if (end) {
    screen->client.end(screen->client.data);
  } else if (stop) {
    sb_screen_suspend(screen);
  } else if (cont || size) {
    if (cont) {
      // Stopped by SIGSTOP, which nobody hears: the shell has had its modes since.
      leave(screen);
      take(screen);
    }
    find_size(screen);
    screen->client.draw(screen->client.data);
  }
  return G_SOURCE_CONTINUE;
}

static bool make_pipe(void) {
  return g_unix_open_pipe(rescue.pipe, FD_CLOEXEC, NULL) &&
         g_unix_set_fd_nonblocking(rescue.pipe[0], TRUE, NULL) &&
         g_unix_set_fd_nonblocking(rescue.pipe[1], TRUE, NULL);
}

// Whether libtickit can drive a type of terminal. It aborts the process if the type's terminfo
// lacks a sequence that it needs, so a child process tries.
static bool can_drive(const char *type) {
  const pid_t child = fork();
  if (child == 0) {
    const struct rlimit none = {0, 0};
    const int null = open("/dev/null", O_WRONLY);
    setrlimit(RLIMIT_CORE, &none);
    dup2(null, STDERR_FILENO);
    (void)tickit_term_build(&(struct TickitTermBuilder){.termtype = type, .open = TICKIT_NO_OPEN});
    _exit(0);
  }
  int status = 0;
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return child < 0 || WIFEXITED(status);
}

bool sb_screen_is_possible(GError **error) {
  const char *type = g_getenv("TERM");
  if (!isatty(STDIN_FILENO) || !isatty(STDOUT_FILENO) || type == NULL || can_drive(type)) {
    return true; // or sb_screen_open() says what is missing
  }
  sb_app_error_input(error,
                     "a terminal of type \"%s\" (TERM) cannot show the workbench; use another "
                     "one, such as xterm-256color, or `sealbench open` or `sealbench run`",
                     type);
  return false;
}

static void build_terminal(SbScreen *screen) {
  // With 24 bits a terminal takes xterm's sequences, whatever its name; libtickit knows the others
  // by their terminfo, or takes them for an xterm where they have none.
  const char *type = g_getenv("TERM");
  const struct TickitTermBuilder builder = {
      .termtype = screen->colors == SB_COLORS_TRUE || type == NULL ? "xterm" : type,
      .open = TICKIT_NO_OPEN,
      .output_func = on_output,
      .output_func_user = screen,
      .output_buffersize = 4096,
  };
  screen->term = tickit_term_build(&builder);
  if (screen->term == NULL) {
    screen->term = tickit_term_build(&(struct TickitTermBuilder){.termtype = "xterm",
                                                                 .open = TICKIT_NO_OPEN,
                                                                 .output_func = on_output,
                                                                 .output_func_user = screen,
                                                                 .output_buffersize = 4096});
  }
  tickit_term_set_utf8(screen->term, !screen->ascii);
  const TickitTermCtl rgb = tickit_termctl_lookup("xterm.cap_rgb8");
  if (rgb > 0 && screen->colors == SB_COLORS_TRUE) {
    tickit_term_setctl_int(screen->term, rgb, 1);
  }
}

SbScreen *sb_screen_open(const SbScreenWishes *wishes, const SbScreenClient *client,
                         GError **error) {
  const char *name = isatty(STDIN_FILENO) && isatty(STDOUT_FILENO) ? ttyname(STDIN_FILENO) : NULL;
  const int tty = name != NULL ? open(name, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC) : -1;
  if (tty < 0 || !make_pipe()) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO,
                "standard input and output are not a terminal; `sealbench open` starts the window, "
                "`sealbench run` computes without either");
    if (tty >= 0) {
      close(tty);
    }
    return NULL;
  }
  SbScreen *screen = g_new0(SbScreen, 1);
  screen->client = *client;
  screen->tty = tty;
  screen->queue = g_byte_array_new();
  screen->colors = wishes->colors;
  screen->ascii = wishes->ascii;
  screen->asked = wishes->pictures == SB_PICTURES_AUTO && screen->colors != SB_COLORS_NONE;
  screen->pictures = wishes->pictures == SB_PICTURES_AUTO
                         ? sb_pictures_of_environment(screen->colors, screen->ascii)
                         : wishes->pictures;
  screen->asked = screen->asked && !sb_pictures_are_pixels(screen->pictures);
  screen->cell_width = 8;
  screen->cell_height = 16;
  screen->cursor_x = -1;
  build_terminal(screen);
  screen->pen = tickit_pen_new();
  tickit_term_bind_event(screen->term, TICKIT_TERM_ON_KEY, 0, on_tickit_key, screen);
  tickit_term_bind_event(screen->term, TICKIT_TERM_ON_MOUSE, 0, on_tickit_mouse, screen);
  sb_cells_init(&screen->shown, 1, 1, screen->ascii);
  catch_signals(true);
  static bool registered;
  if (!registered) {
    registered = atexit(give_back) == 0;
  }
  screen->signals = g_unix_fd_add(rescue.pipe[0], G_IO_IN, on_pipe, screen);
  screen->in = g_unix_fd_add(tty, G_IO_IN | G_IO_HUP | G_IO_ERR, on_readable, screen);
  take(screen);
  if (screen->asked) {
    push_text(screen, "\033[c\033[16t");
  }
  write_some(screen);
  return screen;
}

void sb_screen_close(SbScreen *screen) {
  if (screen == NULL) {
    return;
  }
  leave(screen);
  const guint sources[] = {screen->in, screen->out, screen->signals, screen->escape};
  for (size_t i = 0; i < G_N_ELEMENTS(sources); i++) {
    if (sources[i] != 0) {
      g_source_remove(sources[i]);
    }
  }
  catch_signals(false);
  close(rescue.pipe[0]);
  close(rescue.pipe[1]);
  tickit_pen_unref(screen->pen);
  tickit_term_unref(screen->term);
  close(screen->tty);
  g_byte_array_unref(screen->queue);
  sb_cells_finish(&screen->shown);
  g_free(screen);
}

// Questions -------------------------------------------------------------------------------------

int sb_screen_columns(const SbScreen *screen) {
  return screen->columns;
}

int sb_screen_rows(const SbScreen *screen) {
  return screen->rows;
}

bool sb_screen_ascii(const SbScreen *screen) {
  return screen->ascii;
}

SbColors sb_screen_colors(const SbScreen *screen) {
  return screen->colors;
}

SbPictures sb_screen_pictures(const SbScreen *screen) {
  return screen->pictures;
}

void sb_screen_cell_size(const SbScreen *screen, int *width, int *height) {
  *width = screen->cell_width;
  *height = screen->cell_height;
}

bool sb_screen_is_behind(const SbScreen *screen) {
  return screen->queue->len > 0;
}

bool sb_screen_is_slow(const SbScreen *screen) {
  return screen->slow;
}

// Input of the terminal: size, keys, mouse, and its replies to queries.
#include "app/terminal/screen_private.h"

#include <errno.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { ESCAPE_MS = 50 }; // how long a lone Escape waits for what may follow it

void sb_screen_find_size(SbScreen *screen) {
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

int sb_screen_on_key(TickitTerm *term, TickitEventFlags flags, void *info, void *data) {
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

int sb_screen_on_mouse(TickitTerm *term, TickitEventFlags flags, void *info, void *data) {
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

gboolean sb_screen_on_readable(int fd, GIOCondition condition, gpointer data) {
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
        screen->reply_length == SB_SCREEN_REPLY - 1) {
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

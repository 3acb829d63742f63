// The terminal. See screen.h. Signals are written into a pipe that the main loop reads; what a
// crash needs, the modes and a few bytes, stands ready for a handler that may call nothing else.
#include "app/terminal/screen.h"

#include "app/terminal/screen_private.h"

#include <errno.h>
#include <fcntl.h>
#include <glib-unix.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

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
  sb_screen_find_size(screen);
  sb_screen_write(screen);
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
    sb_screen_push_text(screen, sb_picture_removal(screen->pictures));
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
    sb_screen_find_size(screen);
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
      .output_func = sb_screen_on_output,
      .output_func_user = screen,
      .output_buffersize = 4096,
  };
  screen->term = tickit_term_build(&builder);
  if (screen->term == NULL) {
    screen->term = tickit_term_build(&(struct TickitTermBuilder){.termtype = "xterm",
                                                                 .open = TICKIT_NO_OPEN,
                                                                 .output_func = sb_screen_on_output,
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
  tickit_term_bind_event(screen->term, TICKIT_TERM_ON_KEY, 0, sb_screen_on_key, screen);
  tickit_term_bind_event(screen->term, TICKIT_TERM_ON_MOUSE, 0, sb_screen_on_mouse, screen);
  sb_cells_init(&screen->shown, 1, 1, screen->ascii);
  catch_signals(true);
  static bool registered;
  if (!registered) {
    registered = atexit(give_back) == 0;
  }
  screen->signals = g_unix_fd_add(rescue.pipe[0], G_IO_IN, on_pipe, screen);
  screen->in = g_unix_fd_add(tty, G_IO_IN | G_IO_HUP | G_IO_ERR, sb_screen_on_readable, screen);
  take(screen);
  if (screen->asked) {
    sb_screen_push_text(screen, "\033[c\033[16t");
  }
  sb_screen_write(screen);
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

// Shared by the files of the screen: screen.c (start, signals, end), screen_output.c and
// screen_input.c. Main thread only.
#pragma once

#include "app/terminal/screen.h"

#include <glib.h>
#include <tickit.h>

// Maximum length of a reply of the terminal, in bytes.
enum { SB_SCREEN_REPLY = 256 };

// The screen.
struct SbScreen {
  SbScreenClient client;
  TickitTerm *term;            // owned
  TickitPen *pen;              // owned
  int tty;                     // descriptor of the terminal, opened for the screen alone; owned
  bool taken;                  // raw mode, alternate screen
  int columns, rows;           // size of the screen [cells]
  int cell_width, cell_height; // size of a cell [px]
  bool ascii;                  // only ASCII characters are sent
  bool asked;                  // the terminal's reply chooses the kind of pictures
  SbColors colors;
  SbPictures pictures;
  SbCells shown;                  // cells that the terminal shows
  bool unknown;                   // what the terminal shows is not known
  GByteArray *queue;              // bytes that are not written yet, owned
  gint64 since;                   // when the queue began to fill [us]; 0: it is empty
  bool slow;                      // see sb_screen_is_slow()
  guint in, out, signals, escape; // GLib sources; 0: none
  char reply[SB_SCREEN_REPLY];    // beginning of a reply of the terminal
  size_t reply_length;            // its length in bytes
  GString *pixels;                // picture on the screen, owned; NULL: none
  SbCellRect pixels_at;           // its cells
  int cursor_x, cursor_y;         // cell of the cursor; cursor_x < 0: hidden
};

// ---- Output (screen_output.c) ----

// Queues the bytes of a text.
void sb_screen_push_text(SbScreen *screen, const char *text);

// Writes as many queued bytes as the line accepts now; the main loop writes the remaining ones. If
// the terminal is gone or accepts nothing, discards them and calls the client's `end`.
void sb_screen_write(SbScreen *screen);

// A TickitTermOutputFunc that queues the bytes; `data` is the SbScreen. `bytes` may be NULL: then
// the terminal is about to be destroyed and nothing is done.
void sb_screen_on_output(TickitTerm *term, const char *bytes, size_t length, void *data);

// ---- Input (screen_input.c) ----

// Reads the size of the terminal, and of its cells if it is known, from the system.
void sb_screen_find_size(SbScreen *screen);

// A TickitTermEventFn for keys that calls the client's `key`; `data` is the SbScreen. Returns 1.
int sb_screen_on_key(TickitTerm *term, TickitEventFlags flags, void *info, void *data);

// A TickitTermEventFn for the mouse that calls the client's `key`; `data` is the SbScreen. Returns
// 1.
int sb_screen_on_mouse(TickitTerm *term, TickitEventFlags flags, void *info, void *data);

// A GUnixFDSourceFunc: reads bytes of `fd`, takes out the replies to queries and passes the others
// to libtickit. `data` is the SbScreen. Calls the client's `end` and removes the source at the end
// of input.
gboolean sb_screen_on_readable(int fd, GIOCondition condition, gpointer data);

// The terminal as a full screen: raw mode, keys and mouse, size, and the differences from what it
// shows. The terminal's earlier screen returns at the end, also after a crash or a signal.
//
// Text, keys and types of terminals are handled by libtickit: it supports 24-bit colours without a
// terminfo entry of their own, runs in GLib's main loop and passes every byte to a function. The
// bytes are queued here and written as the terminal accepts them, so that a slow line blocks
// nothing. Main thread; callbacks run in the default main context.
#pragma once

#include "app/base/error.h"
#include "app/terminal/picture.h"

typedef struct SbScreen SbScreen;

// Kind of an input.
typedef enum {
  SB_KEY_CHARACTER, // a letter, digit, sign or blank: SbKey.character; Ctrl+C and Ctrl+Z too
  SB_KEY_UP,
  SB_KEY_DOWN,
  SB_KEY_LEFT,
  SB_KEY_RIGHT,
  SB_KEY_PAGE_UP,
  SB_KEY_PAGE_DOWN,
  SB_KEY_HOME,
  SB_KEY_END,
  SB_KEY_ENTER,
  SB_KEY_ESCAPE,
  SB_KEY_TAB,
  SB_KEY_BACK_TAB,
  SB_KEY_BACKSPACE,
  SB_KEY_DELETE,
  SB_KEY_PRESS, // left mouse button pressed, or moved while it is pressed
  SB_KEY_WHEEL_UP,
  SB_KEY_WHEEL_DOWN
} SbKeyKind;

// A key press or a mouse event.
typedef struct {
  SbKeyKind kind;
  uint32_t character;       // of SB_KEY_CHARACTER: Unicode; with `control` a small letter; else 0
  bool control, shift, alt; // modifiers that were pressed; of a mouse event only `shift` is known
  int x, y;                 // cell of a mouse event: column and row; of a key 0
} SbKey;

// What the caller requests of the terminal.
typedef struct {
  SbColors colors;     // colours to use, such as sb_colors_of_environment()
  SbPictures pictures; // SB_PICTURES_AUTO: by the environment and the terminal's reply
  bool ascii;          // send only ASCII characters
} SbScreenWishes;

// Callbacks; the structure is copied, all functions must be set. They may call the functions of the
// screen, except: none calls sb_screen_close(); `draw` calls neither sb_screen_suspend() nor
// sb_screen_redraw(); `end` only records the request, and the main loop then closes the screen.
typedef struct {
  void (*key)(void *data, const SbKey *key); // a key or mouse event
  // Draw everything by sb_screen_show(): the size of screen or cells or the kind of pictures has
  // changed, the program continues, or a slow terminal has accepted all bytes.
  void (*draw)(void *data);
  void (*end)(void *data); // the program should end: the terminal is gone, or a signal came
  void *data;
} SbScreenClient;

// Returns whether libtickit can drive the terminal's type (environment variable TERM); false with
// SB_APP_ERROR_INPUT if not. Also true if there is no terminal; sb_screen_open() then fails. Starts
// a child process: call it before sb_screen_open() and before other threads are started.
bool sb_screen_is_possible(GError **error);

// Takes over the terminal of standard input and output and shows an empty screen. Returns NULL with
// SB_APP_ERROR_IO if they are no terminal. One screen at a time. `draw` is not called: the caller
// draws first. Freed by sb_screen_close().
SbScreen *sb_screen_open(const SbScreenWishes *wishes, const SbScreenClient *client,
                         GError **error);

// Restores the terminal as it was and frees the screen. `screen` may be NULL.
void sb_screen_close(SbScreen *screen);

// Returns the width of the screen in columns.
int sb_screen_columns(const SbScreen *screen);

// Returns the height of the screen in rows.
int sb_screen_rows(const SbScreen *screen);

// Returns whether only ASCII characters are sent.
bool sb_screen_ascii(const SbScreen *screen);

// Returns the colours in use: those of SbScreenWishes.
SbColors sb_screen_colors(const SbScreen *screen);

// Returns the kind of pictures in use, never SB_PICTURES_AUTO. It can change before `draw` is
// called.
SbPictures sb_screen_pictures(const SbScreen *screen);

// Writes the size of a cell [px]; 8 x 16 if the terminal does not report it.
void sb_screen_cell_size(const SbScreen *screen, int *width, int *height);

// Returns whether bytes are queued that the terminal has not accepted. The caller then draws later.
bool sb_screen_is_behind(const SbScreen *screen);

// Returns whether the terminal accepted the last pictures slowly; the caller then omits animations.
bool sb_screen_is_slow(const SbScreen *screen);

// Shows a grid of sb_screen_columns() x sb_screen_rows() cells: sends the cells that differ from
// the ones shown. `pixels` (NULL: none, `rect` is not used) are the bytes of a picture over the
// cells of `rect` (sb_picture_pixels()), sent if they or `rect` differ from the last ones. A grid
// of another size is ignored.
void sb_screen_show(SbScreen *screen, const SbCells *cells, const GString *pixels, SbCellRect rect);

// Sets the cell in which the cursor blinks from the next sb_screen_show() on; x < 0 hides it.
void sb_screen_cursor(SbScreen *screen, int x, int y);

// Restores the terminal and stops the program as Ctrl-Z does. Returns when the shell continues it,
// after the screen was taken over again and `draw` was called.
void sb_screen_suspend(SbScreen *screen);

// Calls `draw` and sends all cells, whatever the terminal shows.
void sb_screen_redraw(SbScreen *screen);

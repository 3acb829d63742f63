// A terminal as a whole screen: raw mode, keys and mouse, size, what changed since the last
// picture, and the way back to the shell's screen, whatever happens.
//
// Text, keys and the terminal's kinds are libtickit's: it has colours of 24 bits without a terminfo
// entry of their own (ncurses needs one, which few systems have), leaves the main loop to GLib, and
// hands every byte to a function. So the bytes queue here, are written as the line takes them, and
// a slow line holds up nothing: while it is behind, no picture is made.
#pragma once

#include "app/base/error.h"
#include "app/terminal/picture.h"

typedef struct SbScreen SbScreen;

typedef enum {
  SB_KEY_CHARACTER, // `character`
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
  SB_KEY_PRESS, // of the mouse, at (x, y)
  SB_KEY_WHEEL_UP,
  SB_KEY_WHEEL_DOWN
} SbKeyKind;

typedef struct {
  SbKeyKind kind;
  uint32_t character; // with `control`: a small letter
  bool control, shift, alt;
  int x, y;
} SbKey;

typedef struct {
  SbColors colors;
  SbPictures pictures; // SB_PICTURES_AUTO: what the terminal tells
  bool ascii;
} SbScreenWishes;

typedef struct {
  void (*key)(void *data, const SbKey *key);
  void (*draw)(void *data); // the size has changed, or the screen is the program's again
  void (*end)(void *data);  // the terminal is gone, or somebody asks the program to end
  void *data;
} SbScreenClient;

// Whether the terminal's type (TERM) has what the workbench needs; SB_APP_ERROR_INPUT if not. Call
// it before there are threads: a child process tries.
bool sb_screen_is_possible(GError **error);

// Takes over the terminal of standard input and output. SB_APP_ERROR_IO where there is none. One at
// a time. Owned by the caller.
SbScreen *sb_screen_open(const SbScreenWishes *wishes, const SbScreenClient *client,
                         GError **error);

// Gives it back as it was. Takes NULL.
void sb_screen_close(SbScreen *screen);

int sb_screen_columns(const SbScreen *screen);
int sb_screen_rows(const SbScreen *screen);
bool sb_screen_ascii(const SbScreen *screen);
SbColors sb_screen_colors(const SbScreen *screen);
SbPictures sb_screen_pictures(const SbScreen *screen);
void sb_screen_cell_size(const SbScreen *screen, int *width, int *height); // [px]

// Whether what was sent is not taken yet; and whether pictures that move should be left out because
// the line took long for the last ones.
bool sb_screen_is_behind(const SbScreen *screen);
bool sb_screen_is_slow(const SbScreen *screen);

// Shows the grid: sends the cells that differ from what is shown. `pixels` (may be NULL) is a
// picture over the cells of `rect`, sent where its bytes differ from the last ones.
void sb_screen_show(SbScreen *screen, const SbCells *cells, const GString *pixels, SbCellRect rect);

// Where the cursor stands and blinks; x < 0: nowhere.
void sb_screen_cursor(SbScreen *screen, int x, int y);

// Stops the program as Ctrl-Z does; it goes on here.
void sb_screen_suspend(SbScreen *screen);

// Sends everything again.
void sb_screen_redraw(SbScreen *screen);

// Shared by library.c (scenes) and library_catalogue.c (catalogues).
#pragma once

#include "include/sealbench.h"

#include "engine/valve/sealbench.h"

#include <locale.h>

// A quantity of a frame.
typedef struct {
  SbFigureInfo info;
  size_t offset; // of its member in SbFrame
  bool single;   // the member is a float
} SbFrameQuantity;

// Returns the quantity of a key ("force_N"); NULL: there is none. Static. Needs no set-up.
const SbFrameQuantity *sb_catalogue_quantity(const char *key);

// Fills the catalogues, creates sb_catalogue_locale and switches off the error handler of GSL, at
// the first call. May be called concurrently.
void sb_catalogue_set_up(void);

// Texts and numbers are the same in every locale of the program: while a function of the library
// runs, its thread has this one. Set by sb_catalogue_set_up().
extern locale_t sb_catalogue_locale;

// Gives the calling thread the locale *before. For SB_IN_OWN_LOCALE.
void sb_catalogue_restore_locale(locale_t *before);

// Declares `before_`, the locale that the thread has. Until the end of the scope the thread has
// sb_catalogue_locale, afterwards `before_` again. Call sb_catalogue_set_up() before.
#define SB_IN_OWN_LOCALE                                                                           \
  __attribute__((cleanup(sb_catalogue_restore_locale), unused)) locale_t before_ =                 \
      uselocale(sb_catalogue_locale)

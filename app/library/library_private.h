// Shared by library.c (scenes), library_catalogue.c (catalogues) and library_verdict.c (answers).
#pragma once

#include "include/sealbench.h"

#include "app/run/cases.h"
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

// The answers of a verdict as the caller sees them, with the strings that they point to. All zero:
// not judged.
typedef struct {
  size_t count; // 0 or SB_VERDICT_COUNT
  SbSceneVerdict answer[SB_VERDICT_COUNT];
  char *reason[SB_VERDICT_COUNT], *of_case[SB_VERDICT_COUNT]; // owned; NULL: none
} SbAnswers;

// Replaces the answers by copies of `worst`.
void sb_answers_take(SbAnswers *answers, const SbCaseVerdict worst[SB_VERDICT_COUNT]);

// Frees the strings; afterwards all is zero.
void sb_answers_clear(SbAnswers *answers);

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

// Answers to many questions about one base: those that a store has are taken from it, the others
// are computed side by side on threads and put there.
//
// Every sample's answer depends on the base and on the sample alone
// (engine/valve/answer/evaluate.h), not on threads, shards, other samples or interruptions.
#pragma once

#include "app/study/store.h"

#include "engine/valve/sealbench.h"

#include <stdint.h>

enum { SB_QUESTION_PARAMETERS = 96, SB_QUESTION_NONE = -1 };

typedef struct SbAnswerPool SbAnswerPool;

// What is asked. Everything is borrowed.
typedef struct {
  const SbModel *base;
  const char *base_sha256;    // of the base's values, for the key
  const SbParamId *parameter; // [parameters]; SB_QUESTION_NONE: a variable that overrides nothing
  size_t parameters;          // at most SB_QUESTION_PARAMETERS
  const int *figure;          // [figures], figures.def
  size_t figures;
  const double *value; // [samples][parameters], SI; NaN: as in the base
  size_t samples;
  size_t shard, shards;     // samples of this number modulo `shards` alone, from 0; shards 0: all
  int jobs;                 // threads, at least 1
  const SbAnswerPool *pool; // who computes; NULL: threads of this process
  SbStore *store;           // NULL: nothing is kept
  // What the samples start from, instead of the base's answer. `cold`: from nothing.
  const SbEvaluator *start;
  bool cold;
  // Told each answer on the thread that computed it, several at the same time; may be NULL. The
  // evaluator has the model and the summary.
  void (*seen)(void *data, size_t sample, SbStatus status, const SbReport *report,
               const SbEvaluator *evaluator);
  void (*progress)(void *data, size_t done, size_t of); // from the calling thread
  bool (*cancelled)(void *data);                        // the same
  void *data;
} SbQuestions;

enum { SB_ANSWER_MISSING = 255 }; // not computed: of another shard, or cancelled

typedef struct {
  size_t samples, figures;
  uint8_t *status;      // [samples], SbStatus or SB_ANSWER_MISSING
  double *value;        // [samples][figures], NaN: none
  GHashTable *reason;   // sample -> char *, of those that failed
  GHashTable *warnings; // sample -> char *, codes of validity separated by ";", of those with any
  size_t computed;      // of this call
  double seconds;       // it took for them
} SbAnswers;

// The base's answer, from whose rings the samples' start; NULL where it has none that are solved.
// Owned; the same in every process.
SbEvaluator *sb_answer_start(const SbQuestions *asked);

// The codes of warnings, each once, in their order; NULL without any. Owned by the caller:
// g_free().
char *sb_warning_codes(const SbWarnings *warnings, const char *separator);

// Answers one sample into out->value[figures], which the caller has set, and fills the other
// members; the strings are owned by the caller.
SbStatus sb_answer(SbStoredAnswer *out, SbEvaluator *evaluator, const SbQuestions *asked,
                   const SbEvaluator *start, size_t sample, bool (*cancelled)(void *data),
                   void *data);

// Where a pool puts its answers, from the one thread that has the store.
typedef struct SbAnswerSink SbAnswerSink;

// Place of a sample's figures [figures].
double *sb_answer_place(SbAnswerSink *sink, size_t sample);

// Takes the answer to a sample, whose figures are in their place. Takes over its strings; its
// `value` is not used.
void sb_answer_take(SbAnswerSink *sink, size_t sample, SbStoredAnswer answer);

// Whether to go on: no failure of the store, nobody cancelled. Tells the progress.
bool sb_answer_goes_on(SbAnswerSink *sink);

struct SbAnswerPool {
  // Computes samples until all are taken or it need not go on.
  void (*compute)(SbAnswerSink *sink, const SbQuestions *asked, const uint32_t *todo, size_t count);
  // Not NULL: this process answers what another one's pool asks, and has no store.
  void (*serve)(const SbQuestions *asked);
};

// Fills *out, to be released in any case. False with SB_APP_ERROR_IO (store), _CANCELLED (what was
// finished is in the store), _INPUT (too large for the memory).
bool sb_answers_get(SbAnswers *out, const SbQuestions *questions, GError **error);
void sb_answers_release(SbAnswers *answers);

// Results of many samples of one model: those that a store has are read from it; the others are
// computed on threads and stored.
//
// The result of a sample is that of `sealbench run` for the same valve, but for rounding: it does
// not depend on threads, shards, other samples or interruptions.
#pragma once

#include "app/study/store.h"

#include "engine/valve/sealbench.h"

#include <stdint.h>

// Largest number of parameters; SbQuestions.parameter of a variable of a study, which overrides
// nothing.
enum { SB_QUESTION_PARAMETERS = 96, SB_QUESTION_NONE = -1 };

// A set of other processes that compute samples; the caller fills it (see below).
typedef struct SbAnswerPool SbAnswerPool;

// The request. Everything is borrowed for the call.
typedef struct {
  const SbModel *base;
  const char *base_sha256;    // hash of the base's values, part of the key in the store
  const SbParamId *parameter; // [parameters]; SB_QUESTION_NONE: a variable
  size_t parameters;          // at most SB_QUESTION_PARAMETERS
  const int *figure;          // [figures]: indices of sb_figure()
  size_t figures;
  const double *value; // [samples][parameters] [SI; index of a choice]; NaN: the base's value
  size_t samples;
  size_t shard, shards;     // compute only the samples i with i % shards == shard; shards 0: all
  int jobs;                 // number of threads, at least 1
  const SbAnswerPool *pool; // what computes; NULL: `jobs` threads of this process
  SbStore *store;           // NULL: nothing is stored
  size_t work_used;         // solver steps of output.work_limit that no sample may use
  // Every sample solves all contacts, also those that its thread has just solved: its number of
  // solver steps then depends on the sample alone.
  bool separate;
  // Receives each computed result in the thread that computed it, also of several threads at the
  // same time; may be NULL. `evaluator` has the sample's model and summary.
  void (*seen)(void *data, size_t sample, SbStatus status, const SbReport *report,
               const SbEvaluator *evaluator);
  void (*progress)(void *data, size_t done, size_t of); // in the calling thread; may be NULL
  bool (*cancelled)(void *data);                        // in the calling thread; may be NULL
  void *data;
} SbQuestions;

// Size of a buffer that is enough for the reason of each sample [bytes].
enum { SB_ANSWER_REASON = 8192 };

// SbAnswers.status of a sample that was not computed: of another shard, or cancelled.
enum { SB_ANSWER_MISSING = 255 };

// The results. Freed by sb_answers_release().
typedef struct {
  size_t samples, figures;
  uint8_t *status;    // [samples]: SbStatus or SB_ANSWER_MISSING
  double *value;      // [samples][figures] [SI]; NaN: none
  GHashTable *reason; // GSIZE_TO_POINTER(sample) -> char *, of samples that failed or that have no
                      // value of a figure
  GHashTable *warnings; // the same -> char *, validity codes separated by ";", of samples with any
  size_t computed;      // samples that this call computed
  double seconds;       // time that they took [s]
} SbAnswers;

// Sets the list of questions->store (sb_store_set_list(); NULL: does nothing): the names of the
// parameters and the paths of the figures. `name`: [questions->parameters] names; NULL: the keys of
// the parameters, none of which is SB_QUESTION_NONE. Returns false with SB_APP_ERROR_IO.
bool sb_answers_set_list(const SbQuestions *questions, const char *const *name, GError **error);

// Computes or reads the results, and commits the store. Samples of other shards are only read from
// the store. If there is a store, the caller has set its list to these parameters and figures
// (sb_answers_set_list() or sb_store_set_list()). Call sb_answers_release() in any case. Returns
// false with SB_APP_ERROR_IO (the store), SB_APP_ERROR_CANCELLED (what was finished is in *out and
// in the store) or SB_APP_ERROR_INPUT (too many samples for the memory). A sample that fails does
// not make the call fail: its status states it.
bool sb_answers_get(SbAnswers *out, const SbQuestions *questions, GError **error);

// Frees what the results own.
void sb_answers_release(SbAnswers *answers);

// Returns the validity codes of warnings, each once, in their order; NULL if there are none.
char *sb_warning_codes(const SbWarnings *warnings, const char *separator);

// ---- For pools: how sb_answers_get() distributes the work ----

// Computes one sample: writes its figures to out->value[figures], which the caller has set, and
// fills the other members, whose strings are freed by g_free(). `evaluator`
// (sb_evaluator_create()) is the work memory of the calling thread, one for each thread, for any
// number of samples. `cancelled` (may be NULL) is called with `data`. Returns out->status.
SbStatus sb_answer(SbStoredAnswer *out, SbEvaluator *evaluator, const SbQuestions *asked,
                   size_t sample, bool (*cancelled)(void *data), void *data);

// Receives the results of a pool, in the thread that called sb_answers_get(), which has the store.
typedef struct SbAnswerSink SbAnswerSink;

// Returns where the figures of a sample are to be written, [figures]. Any thread; each sample is
// written by one thread.
double *sb_answer_place(SbAnswerSink *sink, size_t sample);

// Records and stores the result of a sample, whose figures were written before. The sink owns the
// strings of `answer` from now on; answer.value is not used.
void sb_answer_take(SbAnswerSink *sink, size_t sample, SbStoredAnswer answer);

// Reports the progress and commits the store about once a second. Returns false if the pool must
// stop: the store failed, or the request was cancelled.
bool sb_answer_poll(SbAnswerSink *sink);

// A pool. Both functions belong to the process that calls sb_answers_get().
struct SbAnswerPool {
  // Computes the samples todo[count], passes each to sb_answer_take(), and calls
  // sb_answer_poll() regularly. Returns when all are done or it must stop.
  void (*compute)(SbAnswerSink *sink, const SbQuestions *asked, const uint32_t *todo, size_t count);
  // Not NULL: this process computes samples that the pool of another process requests, until that
  // one ends; it has no store. All its answers are then SB_ANSWER_MISSING.
  void (*serve)(const SbQuestions *asked);
};

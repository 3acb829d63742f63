// Answers to many questions about one base: those that a store has are taken from it, the others
// are computed side by side on threads and put there.
//
// Every sample's answer depends on the base and on the sample alone (engine/valve/evaluate.h), not
// on threads, shards, other samples or interruptions.
#pragma once

#include "app/study/store.h"

#include "engine/valve/sealbench.h"

#include <stdint.h>

enum { SB_QUESTION_PARAMETERS = 64 };

// What is asked. Everything is borrowed.
typedef struct {
  const SbModel *base;
  const char *base_sha256;    // of the base's values, for the key
  const SbParamId *parameter; // [parameters]
  size_t parameters;          // at most SB_QUESTION_PARAMETERS
  const int *figure;          // [figures], figures.def
  size_t figures;
  const double *value; // [samples][parameters], SI
  size_t samples;
  size_t shard, shards; // samples of this number modulo `shards` alone, from 0; shards 0: all
  int jobs;             // threads, at least 1
  SbStore *store;
  void (*progress)(void *data, size_t done, size_t of); // from the calling thread
  bool (*cancelled)(void *data);                        // the same
  void *data;
} SbQuestions;

enum { SB_ANSWER_MISSING = 255 }; // not computed: of another shard, or cancelled

typedef struct {
  size_t samples, figures;
  uint8_t *status;    // [samples], SbStatus or SB_ANSWER_MISSING
  double *value;      // [samples][figures], NaN: none
  GHashTable *reason; // sample -> char *, of those that failed
  size_t computed;    // of this call
  double seconds;     // it took for them
} SbAnswers;

// Fills *out, to be released in any case. False with SB_APP_ERROR_IO (store), _CANCELLED (what was
// finished is in the store), _INPUT (too large for the memory).
bool sb_answers_get(SbAnswers *out, const SbQuestions *questions, GError **error);
void sb_answers_release(SbAnswers *answers);

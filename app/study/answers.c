// A pool of threads, each with an evaluator of its own, and the one thread that has the store.
#include "app/study/answers.h"

#include "app/base/error.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { JOBS_MAX = 256 };

struct SbAnswerSink {
  const SbQuestions *asked;
  SbAnswers *out;
  GChecksum *common; // what the keys of all samples begin with
  size_t todo, taken;
  // Without a store: the first sample that asks the same [samples], and by its key.
  size_t *same;
  GHashTable *first;
  double committed; // when
  bool failed;      // the store
  GError **error;
};

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

// ---- One answer ----

static bool has_override(const SbQuestions *asked, size_t k, double value) {
  return (int)asked->parameter[k] >= 0 && !isnan(value);
}

char *sb_warning_codes(const SbWarnings *warnings, const char *separator) {
  GString *text = g_string_new(NULL);
  for (size_t i = 0; warnings != NULL && i < warnings->count; i++) {
    size_t first = 0;
    while (strcmp(warnings->item[first].code, warnings->item[i].code) != 0) {
      first++;
    }
    if (first == i) {
      g_string_append_printf(text, "%s%s", text->len > 0 ? separator : "", warnings->item[i].code);
    }
  }
  return g_string_free(text, text->len == 0);
}

// Returns why requested figures of a valve that was computed have no value, as "FIGURE, FIGURE:
// REASON; FIGURE: REASON", shorter than SB_ANSWER_REASON; NULL: all have one.
static char *missing_reasons(const SbStoredAnswer *answer, const SbQuestions *asked,
                             const SbEvaluator *evaluator) {
  GString *text = NULL;
  const char *last = "";
  for (size_t k = 0; k < asked->figures; k++) {
    const int figure = asked->figure[k];
    const char *reason = isnan(answer->value[k]) ? sb_evaluator_reason(evaluator, figure) : NULL;
    if (reason == NULL) {
      continue;
    }
    if (text != NULL && text->len > SB_ANSWER_REASON - 2 * SB_TEXT) {
      g_string_append(text, ", and more");
      break;
    }
    if (text == NULL) {
      text = g_string_new(NULL);
    } else if (strcmp(reason, last) == 0) {
      g_string_append(text, ", ");
    } else {
      g_string_append_printf(text, ": %s; ", last);
    }
    g_string_append(text, sb_figure(figure)->path);
    last = reason;
  }
  if (text == NULL) {
    return NULL;
  }
  g_string_append_printf(text, ": %s", last);
  return g_string_free(text, FALSE);
}

SbStatus sb_answer(SbStoredAnswer *out, SbEvaluator *evaluator, const SbQuestions *asked,
                   size_t sample, bool (*cancelled)(void *data), void *data) {
  SbOverride override[SB_QUESTION_PARAMETERS];
  size_t overrides = 0;
  for (size_t k = 0; k < asked->parameters; k++) {
    const double to = asked->value[sample * asked->parameters + k];
    if (has_override(asked, k, to)) {
      override[overrides++] = (SbOverride){asked->parameter[k], to};
    }
  }
  const SbQuestion question = {.base = asked->base,
                               .override = override,
                               .override_count = overrides,
                               .figure = asked->figure,
                               .figure_count = asked->figures,
                               .work_used = asked->work_used,
                               .cancelled = cancelled,
                               .data = data};
  SbReport report = {0};
  if (asked->separate) {
    sb_evaluator_forget(evaluator);
  }
  const SbStatus status = sb_evaluator_ask(out->value, evaluator, &question, &report);
  if (asked->seen != NULL) { // each its own sample
    asked->seen(asked->data, sample, status, &report, evaluator);
  }
  out->status = status;
  out->reason = status == SB_OK ? missing_reasons(out, asked, evaluator) : NULL;
  const SbSummary *summary = sb_evaluator_summary(evaluator);
  out->warnings = summary != NULL ? sb_warning_codes(&summary->warnings, ";") : NULL;
  if (status != SB_OK) {
    const char *key = sb_input_key(report.input);
    const bool unnamed = strstr(report.text, key) == NULL;
    out->reason = unnamed ? g_strdup_printf("%s: %s", key, report.text)
                          : g_strdup(report.text[0] != '\0' ? report.text : sb_status_text(status));
  }
  return status;
}

// SHA-256 of what an answer depends on: the engine, the base, the parameters' names and values,
// the figures' names.
static void common_key(GChecksum *sum, const SbQuestions *asked) {
  g_checksum_update(sum, (const guchar *)sb_engine_identity()->source, -1);
  g_checksum_update(sum, (const guchar *)"\n", 1);
  g_checksum_update(sum, (const guchar *)asked->base_sha256, -1);
  for (size_t k = 0; k < asked->parameters; k++) {
    if ((int)asked->parameter[k] >= 0) {
      g_checksum_update(sum, (const guchar *)"\n", 1);
      g_checksum_update(sum, (const guchar *)sb_param(asked->parameter[k])->key, -1);
    }
  }
  for (size_t k = 0; k < asked->figures; k++) {
    g_checksum_update(sum, (const guchar *)"\n", 1);
    g_checksum_update(sum, (const guchar *)sb_figure(asked->figure[k])->path, -1);
  }
}

static void sample_key(guint8 key[SB_STORE_KEY], const GChecksum *common, const SbQuestions *asked,
                       size_t sample) {
  GChecksum *sum = g_checksum_copy(common);
  gsize length = SB_STORE_KEY;
  for (size_t k = 0; k < asked->parameters; k++) {
    const double *value = asked->value + sample * asked->parameters + k;
    const double none = NAN;
    if ((int)asked->parameter[k] >= 0) {
      g_checksum_update(sum, (const guchar *)(isnan(*value) ? &none : value), sizeof *value);
    }
  }
  g_checksum_get_digest(sum, key, &length);
  g_checksum_free(sum);
}

// ---- Where answers go ----

double *sb_answer_place(SbAnswerSink *sink, size_t sample) {
  return sink->out->value + sample * sink->asked->figures;
}

// Takes over the answer's strings. answer->reason becomes the one string that all samples with this
// reason share, borrowed.
static void set_answer(SbAnswers *out, size_t sample, SbStoredAnswer *answer) {
  out->status[sample] = (uint8_t)answer->status;
  if (answer->reason != NULL) {
    char *shared = g_ref_string_new_intern(answer->reason);
    g_free(answer->reason);
    answer->reason = shared;
    g_hash_table_insert(out->reason, GSIZE_TO_POINTER(sample), shared);
  }
  if (answer->warnings != NULL) {
    g_hash_table_insert(out->warnings, GSIZE_TO_POINTER(sample), answer->warnings);
  }
}

void sb_answer_take(SbAnswerSink *sink, size_t sample, SbStoredAnswer answer) {
  const SbQuestions *asked = sink->asked;
  guint8 key[SB_STORE_KEY];
  sample_key(key, sink->common, asked, sample);
  answer.value = sb_answer_place(sink, sample);
  set_answer(sink->out, sample, &answer);
  sink->taken++;
  if (!sink->failed && asked->store != NULL) {
    const double *parameter = asked->value + sample * asked->parameters;
    sink->failed = !sb_store_put(asked->store, key, parameter, &answer, sink->error);
  }
}

bool sb_answer_poll(SbAnswerSink *sink) {
  const SbQuestions *asked = sink->asked;
  if (!sink->failed && asked->store != NULL && now() > sink->committed + 1) {
    sink->failed = !sb_store_commit(asked->store, sink->error);
    sink->committed = now();
  }
  if (asked->progress != NULL) {
    asked->progress(asked->data, asked->samples - sink->todo + sink->taken, asked->samples);
  }
  return !sink->failed && (asked->cancelled == NULL || !asked->cancelled(asked->data));
}

// ---- Threads ----

typedef struct {
  const SbQuestions *asked;
  SbAnswerSink *sink;
  const uint32_t *todo; // samples to compute
  size_t count;
  atomic_bool stop;
  atomic_size_t next; // of them
  pthread_mutex_t lock;
  pthread_cond_t ready;
  // Under the lock:
  struct {
    uint32_t sample;
    SbStoredAnswer answer;
  } * done; // [count] in the order in which they were answered
  size_t finished;
  int running;
} Threads;

static bool is_stopped(void *data) {
  return atomic_load(&((Threads *)data)->stop);
}

static void answer_one(Threads *pool, SbEvaluator *evaluator, uint32_t sample) {
  SbStoredAnswer answer = {.value = sb_answer_place(pool->sink, sample)};
  const SbStatus status = sb_answer(&answer, evaluator, pool->asked, sample, is_stopped, pool);
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    atomic_store(&pool->stop, true);
    for (size_t i = 0; i < pool->asked->figures; i++) {
      answer.value[i] = NAN;
    }
    g_free(answer.reason);
    g_free(answer.warnings);
    return;
  }
  pthread_mutex_lock(&pool->lock);
  pool->done[pool->finished].sample = sample;
  pool->done[pool->finished++].answer = answer;
  pthread_cond_signal(&pool->ready);
  pthread_mutex_unlock(&pool->lock);
}

static void *work(void *data) {
  Threads *pool = data;
  SbEvaluator *evaluator = NULL;
  if (sb_evaluator_create(&evaluator, NULL) == SB_OK) {
    size_t at;
    while (!is_stopped(pool) && (at = atomic_fetch_add(&pool->next, 1)) < pool->count) {
      answer_one(pool, evaluator, pool->todo[at]);
    }
  }
  sb_evaluator_destroy(evaluator);
  pthread_mutex_lock(&pool->lock);
  pool->running--;
  pthread_cond_signal(&pool->ready);
  pthread_mutex_unlock(&pool->lock);
  return NULL;
}

// Hands answers on as they come. With the lock held.
static void collect(Threads *pool) {
  size_t taken = 0;
  while (pool->running > 0 || taken < pool->finished) {
    if (taken == pool->finished) {
      struct timespec until;
      clock_gettime(CLOCK_MONOTONIC, &until);
      until.tv_nsec += 50000000;
      until.tv_sec += until.tv_nsec / 1000000000;
      until.tv_nsec %= 1000000000;
      pthread_cond_timedwait(&pool->ready, &pool->lock, &until);
    }
    const size_t to = pool->finished;
    pthread_mutex_unlock(&pool->lock);
    for (; taken < to; taken++) {
      sb_answer_take(pool->sink, pool->done[taken].sample, pool->done[taken].answer);
    }
    if (!sb_answer_poll(pool->sink)) {
      atomic_store(&pool->stop, true);
    }
    pthread_mutex_lock(&pool->lock);
  }
}

static void compute_on_threads(SbAnswerSink *sink, const SbQuestions *asked, const uint32_t *todo,
                               size_t count) {
  Threads pool = {.asked = asked, .sink = sink, .todo = todo, .count = count};
  pthread_t thread[JOBS_MAX];
  const int jobs = CLAMP((int)MIN((size_t)asked->jobs, count), 1, JOBS_MAX);
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
  pthread_mutex_init(&pool.lock, NULL);
  pthread_cond_init(&pool.ready, &attributes);
  pthread_condattr_destroy(&attributes);
  pool.done = g_malloc_n(count, sizeof *pool.done);
  int started = 0;
  pthread_mutex_lock(&pool.lock);
  while (started < jobs && pthread_create(&thread[started], NULL, work, &pool) == 0) {
    started++;
    pool.running++;
  }
  collect(&pool);
  pthread_mutex_unlock(&pool.lock);
  for (int i = 0; i < started; i++) {
    pthread_join(thread[i], NULL);
  }
  g_free(pool.done);
  pthread_cond_destroy(&pool.ready);
  pthread_mutex_destroy(&pool.lock);
}

// ---- Many ----

static bool is_ours(const SbQuestions *asked, size_t sample) {
  return asked->shards == 0 || sample % asked->shards == asked->shard;
}

// Whether no earlier sample asks the same; without a store, which would tell.
static bool is_first(SbAnswerSink *sink, const guint8 key[SB_STORE_KEY], size_t sample) {
  GBytes *whole = g_bytes_new(key, SB_STORE_KEY);
  gpointer before = NULL;
  if (g_hash_table_lookup_extended(sink->first, whole, NULL, &before)) {
    g_bytes_unref(whole);
  } else {
    before = GSIZE_TO_POINTER(sample);
    g_hash_table_insert(sink->first, whole, before);
  }
  sink->same[sample] = GPOINTER_TO_SIZE(before);
  return sink->same[sample] == sample;
}

// Takes what the store has and lists the rest.
static void look_up(SbAnswerSink *sink, uint32_t *todo) {
  const SbQuestions *asked = sink->asked;
  for (size_t i = 0; i < asked->samples; i++) {
    guint8 key[SB_STORE_KEY];
    SbStoredAnswer answer = {.value = sb_answer_place(sink, i)};
    sample_key(key, sink->common, asked, i);
    if (asked->store != NULL && sb_store_get(asked->store, key, &answer)) {
      set_answer(sink->out, i, &answer);
    } else if (is_ours(asked, i) && (sink->same == NULL || is_first(sink, key, i))) {
      todo[sink->todo++] = (uint32_t)i;
    }
  }
}

// Gives samples that ask the same as an earlier one its answer.
static void repeat(SbAnswerSink *sink) {
  SbAnswers *out = sink->out;
  for (size_t i = 0; i < out->samples; i++) {
    const size_t from = sink->same[i];
    if (from == i) {
      continue;
    }
    SbStoredAnswer answer = {
        .status = out->status[from],
        .reason = g_strdup(g_hash_table_lookup(out->reason, GSIZE_TO_POINTER(from))),
        .warnings = g_strdup(g_hash_table_lookup(out->warnings, GSIZE_TO_POINTER(from)))};
    set_answer(out, i, &answer);
    memcpy(sb_answer_place(sink, i), sb_answer_place(sink, from),
           out->figures * sizeof *out->value);
  }
}

static bool compute(SbAnswerSink *sink, const uint32_t *todo) {
  const SbQuestions *asked = sink->asked;
  const double start = now();
  sink->committed = start;
  if (asked->store != NULL && !sb_store_open_for_writing(asked->store, sink->error)) {
    return false;
  }
  (asked->pool != NULL ? asked->pool->compute : compute_on_threads)(sink, asked, todo, sink->todo);
  sink->out->computed = sink->taken;
  sink->out->seconds = now() - start;
  if ((asked->store != NULL && !sb_store_commit(asked->store, sink->failed ? NULL : sink->error)) ||
      sink->failed) {
    return false;
  }
  if (sink->taken < sink->todo) {
    g_set_error(sink->error, SB_APP_ERROR, SB_APP_ERROR_CANCELLED, "interrupted%s",
                asked->store != NULL ? ": what was finished is in the store" : "");
  }
  return sink->taken == sink->todo;
}

bool sb_answers_set_list(const SbQuestions *asked, const char *const *name, GError **error) {
  g_autofree const char **parameter = g_new0(const char *, asked->parameters + 1);
  g_autofree const char **figure = g_new0(const char *, asked->figures + 1);
  for (size_t i = 0; i < asked->parameters; i++) {
    parameter[i] = name != NULL ? name[i] : sb_param(asked->parameter[i])->key;
  }
  for (size_t i = 0; i < asked->figures; i++) {
    figure[i] = sb_figure(asked->figure[i])->path;
  }
  return asked->store == NULL || sb_store_set_list(asked->store, parameter, figure, error);
}

bool sb_answers_get(SbAnswers *out, const SbQuestions *asked, GError **error) {
  *out = (SbAnswers){.samples = asked->samples, .figures = asked->figures};
  out->reason = g_hash_table_new_full(NULL, NULL, NULL, (GDestroyNotify)g_ref_string_release);
  out->warnings = g_hash_table_new_full(NULL, NULL, NULL, g_free);
  out->status = malloc(asked->samples + 1);
  out->value = malloc((asked->samples * asked->figures + 1) * sizeof *out->value);
  uint32_t *todo = malloc((asked->samples + 1) * sizeof *todo);
  if (out->status == NULL || out->value == NULL || todo == NULL) {
    free(todo);
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "there is no memory for %zu figures of %zu samples", asked->figures,
                asked->samples);
    return false;
  }
  memset(out->status, SB_ANSWER_MISSING, asked->samples);
  for (size_t i = 0; i < asked->samples * asked->figures; i++) {
    out->value[i] = NAN;
  }
  SbAnswerSink sink = {
      .asked = asked, .out = out, .common = g_checksum_new(G_CHECKSUM_SHA256), .error = error};
  if (asked->store == NULL) {
    sink.same = g_new0(size_t, asked->samples + 1);
    sink.first =
        g_hash_table_new_full(g_bytes_hash, g_bytes_equal, (GDestroyNotify)g_bytes_unref, NULL);
  }
  common_key(sink.common, asked);
  look_up(&sink, todo);
  const bool good = sink.todo == 0 || compute(&sink, todo);
  if (sink.same != NULL) {
    repeat(&sink);
    g_hash_table_unref(sink.first);
    g_free(sink.same);
  }
  g_checksum_free(sink.common);
  free(todo);
  return good;
}

void sb_answers_release(SbAnswers *answers) {
  free(answers->status);
  free(answers->value);
  if (answers->reason != NULL) {
    g_hash_table_unref(answers->reason);
    g_hash_table_unref(answers->warnings);
  }
  *answers = (SbAnswers){0};
}

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

typedef struct {
  const SbQuestions *asked;
  SbAnswers *out;
  uint32_t *todo; // samples to compute
  size_t count;
  atomic_bool stop;
  atomic_size_t next; // of them
  pthread_mutex_t lock;
  pthread_cond_t ready;
  // Under the lock:
  uint32_t *done; // [count] samples answered, in the order in which they were
  char **reason;  // [count] of each, or NULL
  size_t finished;
  int running;
} Pool;

static bool is_stopped(void *data) {
  return atomic_load(&((Pool *)data)->stop);
}

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

// Why a sample failed; NULL for one that did not.
static char *reason_of(SbStatus status, const SbReport *report) {
  if (status == SB_OK) {
    return NULL;
  }
  return report->parameter[0] != '\0' && strstr(report->text, report->parameter) == NULL
             ? g_strdup_printf("%s: %s", report->parameter, report->text)
             : g_strdup(report->text[0] != '\0' ? report->text : sb_status_text(status));
}

static void answer_one(Pool *pool, SbEvaluator *evaluator, uint32_t sample) {
  const SbQuestions *asked = pool->asked;
  SbOverride override[SB_QUESTION_PARAMETERS];
  SbQuestion question = {.base = asked->base,
                         .override = override,
                         .override_count = asked->parameters,
                         .figure = asked->figure,
                         .figure_count = asked->figures,
                         .cancelled = is_stopped,
                         .data = pool};
  for (size_t k = 0; k < asked->parameters; k++) {
    override[k] = (SbOverride){asked->parameter[k], asked->value[sample * asked->parameters + k]};
  }
  SbReport report = {0};
  double *value = pool->out->value + sample * asked->figures;
  const SbStatus status = sb_evaluator_ask(value, evaluator, &question, &report);
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    atomic_store(&pool->stop, status == SB_ERROR_MEMORY || is_stopped(pool));
    for (size_t i = 0; i < asked->figures; i++) {
      value[i] = NAN;
    }
    return;
  }
  char *reason = reason_of(status, &report);
  pthread_mutex_lock(&pool->lock);
  pool->out->status[sample] = (uint8_t)status;
  pool->reason[pool->finished] = reason;
  pool->done[pool->finished++] = sample;
  pthread_cond_signal(&pool->ready);
  pthread_mutex_unlock(&pool->lock);
}

static void *work(void *data) {
  Pool *pool = data;
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

// SHA-256 of what an answer depends on: the program, the base, the parameters' names and values,
// the figures' names.
static void common_key(GChecksum *sum, const SbQuestions *asked) {
  g_checksum_update(sum, (const guchar *)sb_version(), -1);
  g_checksum_update(sum, (const guchar *)"\n", 1);
  g_checksum_update(sum, (const guchar *)asked->base_sha256, -1);
  for (size_t k = 0; k < asked->parameters; k++) {
    g_checksum_update(sum, (const guchar *)"\n", 1);
    g_checksum_update(sum, (const guchar *)sb_param(asked->parameter[k])->key, -1);
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
  g_checksum_update(sum, (const guchar *)(asked->value + sample * asked->parameters),
                    (gssize)(asked->parameters * sizeof(double)));
  g_checksum_get_digest(sum, key, &length);
  g_checksum_free(sum);
}

static bool is_ours(const SbQuestions *asked, size_t sample) {
  return asked->shards == 0 || sample % asked->shards == asked->shard;
}

// Takes what the store has and lists the rest.
static void look_up(Pool *pool, const GChecksum *common) {
  const SbQuestions *asked = pool->asked;
  for (size_t i = 0; i < asked->samples; i++) {
    guint8 key[SB_STORE_KEY];
    SbStoredAnswer answer = {.value = pool->out->value + i * asked->figures};
    sample_key(key, common, asked, i);
    if (sb_store_get(asked->store, key, &answer)) {
      pool->out->status[i] = (uint8_t)answer.status;
      if (answer.reason != NULL) {
        g_hash_table_insert(pool->out->reason, GSIZE_TO_POINTER(i), answer.reason);
      }
    } else if (is_ours(asked, i)) {
      pool->todo[pool->count++] = (uint32_t)i;
    }
  }
}

// Puts what has been answered since `from` into the store; false on its failure.
static bool put(Pool *pool, size_t from, size_t to, const GChecksum *common, GError **error) {
  const SbQuestions *asked = pool->asked;
  for (size_t i = from; i < to; i++) {
    const size_t sample = pool->done[i];
    guint8 key[SB_STORE_KEY];
    const SbStoredAnswer answer = {.status = (SbStatus)pool->out->status[sample],
                                   .reason = pool->reason[i],
                                   .value = pool->out->value + sample * asked->figures};
    sample_key(key, common, asked, sample);
    if (pool->reason[i] != NULL) {
      g_hash_table_insert(pool->out->reason, GSIZE_TO_POINTER(sample), pool->reason[i]);
      pool->reason[i] = NULL; // the table's
    }
    if (!sb_store_put(asked->store, key, asked->value + sample * asked->parameters, &answer,
                      error)) {
      return false;
    }
  }
  return true;
}

// Waits for answers, stores them, tells the progress, looks for a cancel. With the lock held.
static bool collect(Pool *pool, const GChecksum *common, GError **error) {
  const SbQuestions *asked = pool->asked;
  const size_t before = asked->samples - pool->count;
  size_t stored = 0;
  double committed = now();
  bool good = true;
  while (pool->running > 0 || stored < pool->finished) {
    if (stored == pool->finished) {
      struct timespec until;
      clock_gettime(CLOCK_MONOTONIC, &until);
      until.tv_nsec += 50000000;
      until.tv_sec += until.tv_nsec / 1000000000;
      until.tv_nsec %= 1000000000;
      pthread_cond_timedwait(&pool->ready, &pool->lock, &until);
    }
    const size_t to = pool->finished;
    pthread_mutex_unlock(&pool->lock);
    good = good && put(pool, stored, to, common, error);
    stored = to;
    if (good && now() > committed + 1) {
      good = sb_store_commit(asked->store, error);
      committed = now();
    }
    if (asked->progress != NULL) {
      asked->progress(asked->data, before + to, asked->samples);
    }
    if (!good || (asked->cancelled != NULL && asked->cancelled(asked->data))) {
      atomic_store(&pool->stop, true);
    }
    pthread_mutex_lock(&pool->lock);
  }
  return good;
}

static bool compute(Pool *pool, const GChecksum *common, GError **error) {
  pthread_t thread[JOBS_MAX];
  const int jobs = CLAMP((int)MIN((size_t)pool->asked->jobs, pool->count), 1, JOBS_MAX);
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
  pthread_mutex_init(&pool->lock, NULL);
  pthread_cond_init(&pool->ready, &attributes);
  pthread_condattr_destroy(&attributes);
  pool->done = g_new(uint32_t, pool->count);
  pool->reason = g_new0(char *, pool->count);
  const double start = now();
  int started = 0;
  pthread_mutex_lock(&pool->lock);
  while (started < jobs && pthread_create(&thread[started], NULL, work, pool) == 0) {
    started++;
    pool->running++;
  }
  bool good = collect(pool, common, error);
  pthread_mutex_unlock(&pool->lock);
  for (int i = 0; i < started; i++) {
    pthread_join(thread[i], NULL);
  }
  pool->out->computed = pool->finished;
  pool->out->seconds = now() - start;
  for (size_t i = 0; i < pool->count; i++) {
    g_free(pool->reason[i]);
  }
  g_free(pool->reason);
  g_free(pool->done);
  pthread_cond_destroy(&pool->ready);
  pthread_mutex_destroy(&pool->lock);
  good = sb_store_commit(pool->asked->store, good ? error : NULL) && good;
  if (good && pool->finished < pool->count) {
    const bool cancelled = atomic_load(&pool->stop) || started > 0;
    g_set_error(error, SB_APP_ERROR, cancelled ? SB_APP_ERROR_CANCELLED : SB_APP_ERROR_IO, "%s",
                cancelled ? "interrupted: what was finished is in the store"
                          : "no thread could be started");
    good = false;
  }
  return good;
}

bool sb_answers_get(SbAnswers *out, const SbQuestions *asked, GError **error) {
  *out = (SbAnswers){.samples = asked->samples, .figures = asked->figures};
  out->reason = g_hash_table_new_full(NULL, NULL, NULL, g_free);
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
  GChecksum *common = g_checksum_new(G_CHECKSUM_SHA256);
  common_key(common, asked);
  Pool pool = {.asked = asked, .out = out, .todo = todo};
  look_up(&pool, common);
  const bool good = pool.count == 0 || compute(&pool, common, error);
  g_checksum_free(common);
  free(todo);
  return good;
}

void sb_answers_release(SbAnswers *answers) {
  free(answers->status);
  free(answers->value);
  if (answers->reason != NULL) {
    g_hash_table_unref(answers->reason);
  }
  *answers = (SbAnswers){0};
}

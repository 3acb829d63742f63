// Answers to a study file's questions for the commands that use them: points, store, computation
// with progress and interrupts.
#include "app/cli/cli.h"

#include "app/document/shipped.h"
#include "app/export/study_results.h"

#include <glib/gstdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

_Static_assert((int)SB_VARY_MAX <= (int)SB_QUESTION_PARAMETERS,
               "a request must have space for all varied parameters");

static const SbAnswerPool *answer_pool;

void sb_cli_set_pool(const SbAnswerPool *pool) {
  answer_pool = pool;
}

bool sb_cli_answers_elsewhere(void) {
  return answer_pool != NULL && answer_pool->serve != NULL;
}

// Whether the store of a study goes to the folder of the study: not to that of the installed
// program, and not where nothing can be written.
static bool is_beside(const char *path) {
  g_autofree char *folder = g_path_get_dirname(path), *shipped = sb_shipped_folder();
  g_autofree char *full = realpath(folder, NULL);
  g_autofree char *of_program = shipped != NULL ? realpath(shipped, NULL) : NULL;
  const bool installed = full != NULL && of_program != NULL && g_str_has_prefix(full, of_program) &&
                         strchr("/", full[strlen(of_program)]) != NULL;
  return !installed && g_access(folder, W_OK) == 0;
}

char *sb_cli_store_path(const char *given, const SbStudyFile *study) {
  if (given != NULL || study->path == NULL) {
    return g_strdup(given);
  }
  g_autofree char *base = g_path_get_basename(study->path);
  const char *path = is_beside(study->path) ? study->path : base;
  const bool ending = g_str_has_suffix(path, ".study");
  return g_strdup_printf("%.*s.store", (int)strlen(path) - (ending ? 6 : 0), path);
}

static bool set_list(SbStore *store, const SbStudyFile *study, GError **error) {
  const char *name[SB_VARY_MAX];
  for (guint i = 0; i < study->vary->len; i++) {
    name[i] = sb_vary_name(&g_array_index(study->vary, SbVary, i));
  }
  const SbQuestions asked = {.store = store,
                             .parameters = study->vary->len,
                             .figure = (const int *)(const void *)study->figures->data,
                             .figures = study->figures->len};
  return sb_answers_set_list(&asked, name, error);
}

// Opens the store; what is damaged is reported, saved where it can be, and computed again.
static SbStore *open_store(const char *path, const SbStudyFile *study, GError **error) {
  SbStore *store = sb_store_open(path, error);
  SbStoreHealth health = {0};
  if (store != NULL && path != NULL) {
    sb_store_health(&health, store);
  }
  if (health.damaged > 0 || health.structure != NULL) {
    if (health.damaged > 0) {
      (void)sb_cli_fail("%s: %" G_GUINT64_FORMAT " of %" G_GUINT64_FORMAT
                        " rows are damaged and will be computed again: %s",
                        path, health.damaged, health.rows, health.first);
    }
    if (health.structure != NULL) {
      (void)sb_cli_fail("%s; what is missing will be computed again", health.structure);
    }
    if (!sb_store_repair(store, error)) {
      sb_store_discard(store);
      store = NULL;
    }
  }
  // Names that are damaged are written again with the list.
  if (store != NULL && (!set_list(store, study, error) ||
                        (health.unnamed > 0 && !sb_store_open_for_writing(store, error)))) {
    sb_store_discard(store);
    store = NULL;
  }
  sb_store_health_release(&health);
  return store;
}

static void on_answers_progress(void *data, size_t done, size_t of) {
  sb_progress_update(data, of > 0 ? (double)done / (double)of : 1);
}

// Exit code of samples that failed: of a solver 2; a design that cannot be is an answer.
static int judge_answers(const SbAnswers *answers) {
  size_t count[256] = {0};
  for (size_t i = 0; i < answers->samples; i++) {
    count[answers->status[i]]++;
  }
  const size_t unsolved = count[SB_ERROR_NOT_CONVERGED];
  const size_t impossible = sb_study_failed(answers) - unsolved;
  if (impossible > 0) {
    sb_cli_note("%zu of %zu samples are infeasible: their values are inconsistent", impossible,
                answers->samples);
  }
  if (unsolved > 0) {
    sb_cli_fail("in %zu of %zu samples a solver did not converge", unsolved, answers->samples);
  }
  return unsolved > 0 ? SB_EXIT_NOT_CONVERGED : SB_EXIT_DONE;
}

static int solve_answers(const SbStudyFile *study, const SbCliAsk *ask, SbStore *store,
                         const double *value, const SbStudyDrawn *drawn, SbCliAnswered answered,
                         void *data) {
  SbParamId parameter[SB_VARY_MAX];
  for (guint i = 0; i < study->vary->len; i++) {
    parameter[i] = g_array_index(study->vary, SbVary, i).id;
  }
  SbProgress progress;
  const SbQuestions asked = {
      .base = study->base,
      .base_sha256 = study->base_sha256,
      .parameter = parameter,
      .parameters = study->vary->len,
      .figure = (const int *)(const void *)study->figures->data,
      .figures = study->figures->len,
      .value = value,
      .samples = study->samples,
      .shard = ask->shard,
      .shards = ask->shards,
      .jobs = ask->threads,
      .pool = answer_pool,
      .store = store,
      .progress = on_answers_progress,
      .cancelled = sb_cli_interrupted,
      .data = &progress,
  };
  if (answer_pool != NULL && answer_pool->serve != NULL) {
    answer_pool->serve(&asked);
    return SB_EXIT_DONE;
  }
  SbAnswers answers;
  GError *error = NULL;
  sb_progress_start(&progress, "study ");
  sb_cli_catch_interrupts();
  const bool good = sb_answers_get(&answers, &asked, &error);
  sb_progress_end(&progress);
  int code = SB_EXIT_DONE;
  if (!good) {
    code = error->code == SB_APP_ERROR_CANCELLED ? SB_EXIT_INTERRUPTED : SB_EXIT_DONE;
    const int failed = sb_cli_error(error);
    code = code == SB_EXIT_INTERRUPTED ? code : failed;
  }
  if (answers.computed > 0) {
    sb_cli_note("%zu samples in %.3g s, %.3g a second", answers.computed, answers.seconds,
                (double)answers.computed / answers.seconds);
  }
  if (good || code == SB_EXIT_INTERRUPTED) {
    g_autofree char *cpus = sb_store_cpus(store);
    const SbCliAnswers of = {study, value, drawn, &answers, cpus, ask->store};
    const int written = answered(data, &of);
    const int judged = judge_answers(&answers);
    code = MAX(code, MAX(written, judged));
  }
  sb_answers_release(&answers);
  return code;
}

// The points of the method. An exit code.
static int lay_out(double **value, double **unit, SbReliability *reliability,
                   const SbStudyFile *study, int threads) {
  SbReport report = {0};
  SbStatus status;
  if (study->method == SB_METHOD_RELIABILITY) {
    sb_cli_catch_interrupts();
    status = sb_reliability_search(reliability, study, threads, sb_cli_interrupted, NULL, &report);
    status =
        status == SB_OK ? sb_reliability_points(value, unit, study, reliability, &report) : status;
    if (status != SB_OK) {
      sb_reliability_release(reliability);
    }
  } else {
    status = sb_study_file_points(value, unit, study, &report);
  }
  if (status == SB_ERROR_CANCELLED) {
    (void)sb_cli_fail("interrupted before the first sample");
    return SB_EXIT_INTERRUPTED;
  }
  return sb_cli_status(status, &report);
}

int sb_cli_answer(const SbStudyFile *study, const SbCliAsk *ask, SbCliAnswered answered,
                  void *data) {
  GError *error = NULL;
  if (!sb_cli_has_memory(study->base)) {
    return SB_EXIT_IO;
  }
  double *value = NULL, *unit = NULL;
  SbReliability reliability = {0};
  if (study->samples == 0) {
    return sb_cli_fail("%s: study.samples: is missing: how many samples there are",
                       study->path != NULL ? study->path : "standard input");
  }
  int code = lay_out(&value, &unit, &reliability, study, ask->threads);
  if (code != SB_EXIT_DONE) {
    return code;
  }
  SbStore *store = open_store(sb_cli_answers_elsewhere() ? NULL : ask->store, study, &error);
  if (store == NULL) {
    code = sb_cli_error(error);
  } else {
    const SbStudyDrawn drawn = {unit, study->method == SB_METHOD_RELIABILITY ? &reliability : NULL};
    code = solve_answers(study, ask, store, value, &drawn, answered, data);
  }
  error = NULL;
  if (!sb_store_close(store, &error)) {
    const int failed = sb_cli_error(error);
    code = MAX(code, failed);
  }
  sb_reliability_release(&reliability);
  free(value);
  free(unit);
  return code;
}

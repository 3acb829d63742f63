// The thread of a design question. See design_job.h. The answer is written under the lock: cells of
// the map as they come, other parts when they are whole.
#include "app/session/design_job.h"

#include "app/run/process.h"
#include "app/session/worker.h"
#include "app/study/answers.h"
#include "app/study/effects.h"
#include "app/study/slopes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  POINTS_CLOSED = 33, // each way, where a valve takes under a millisecond
  POINTS_OWN = 17,
  COARSE = 8, // cells of the first pass, each way, in points
  VALVES_CLOSED = 2000,
  VALVES_OWN = 200,
};

struct SbDesignJob {
  SbWorker worker;
  GMutex lock; // guards the answer, `paused` and the time
  GCond resumed;
  bool paused, search;
  SbStore *store;
  SbDesignAnswer *answer; // the thread's, read under the lock
  int figure[SB_DESIGN_FIGURES];
  size_t valves;
  gint part;      // atomic
  gint64 begun;   // of the map [us]
  size_t *sample; // point of the map of each sample asked for
  int jobs;
  char *why;
};

static void lock(SbDesignJob *job) {
  g_mutex_lock(&job->lock);
}

static void unlock(SbDesignJob *job) {
  g_mutex_unlock(&job->lock);
}

// Waits while it is held; from any thread.
static bool is_cancelled(void *data) {
  SbDesignJob *job = data;
  lock(job);
  while (job->paused && !sb_worker_cancelled(&job->worker)) {
    g_cond_wait(&job->resumed, &job->lock);
  }
  unlock(job);
  return sb_worker_cancelled(&job->worker);
}

static void begin(SbDesignJob *job, SbDesignPart part, double share) {
  g_atomic_int_set(&job->part, (gint)part);
  sb_worker_set_progress(&job->worker, share);
}

// The map -----------------------------------------------------------------------------------------

static void put(SbDesignJob *job, size_t point, SbStatus status, const double *value) {
  SbDesignMap *map = &job->answer->map;
  if (map->status[point] != SB_ANSWER_MISSING) {
    return;
  }
  bool any = false;
  for (size_t i = 0; i < map->figures; i++) {
    map->value[point * map->figures + i] = value[i];
    any = any || isfinite(value[i]);
  }
  map->status[point] = (unsigned char)status;
  map->done++;
  map->refused += !any;
  map->seconds = (double)(g_get_monotonic_time() - job->begun) * 1e-6;
}

static void on_point(void *data, size_t sample, SbStatus status, const SbReport *report,
                     const SbEvaluator *evaluator) {
  SbDesignJob *job = data;
  double value[SB_DESIGN_FIGURES];
  (void)report;
  for (size_t i = 0; i < job->answer->map.figures; i++) {
    value[i] =
        status == SB_OK ? sb_figure_value(sb_evaluator_summary(evaluator), job->figure[i]) : NAN;
  }
  lock(job);
  put(job, job->sample[sample], status, value);
  const SbDesignMap *map = &job->answer->map;
  const double share = (double)map->done / (double)(map->n * map->n);
  unlock(job);
  sb_worker_set_progress(&job->worker, (job->search ? 0.4 : 0.9) * share);
  (void)is_cancelled(job); // a job that is held stays here
}

static double along(const SbDesignMap *map, int axis, size_t at) {
  return map->low[axis] + (map->high[axis] - map->low[axis]) * (double)at / (double)(map->n - 1);
}

// Every `step`-th point each way.
static bool ask_points(SbDesignJob *job, size_t step, GError **error) {
  SbDesignMap *map = &job->answer->map;
  const size_t each = (map->n - 1) / step + 1, count = each * each;
  g_autofree double *value = g_new(double, 2 * count);
  for (size_t i = 0; i < count; i++) {
    const size_t across = i % each * step, up = i / each * step;
    job->sample[i] = up * map->n + across;
    value[2 * i] = along(map, 0, across);
    value[2 * i + 1] = along(map, 1, up);
  }
  const SbStudyFile *study = job->answer->study;
  const SbQuestions asked = {.base = study->base,
                             .base_sha256 = study->base_sha256,
                             .parameter = map->axis,
                             .parameters = 2,
                             .figure = job->figure,
                             .figures = map->figures,
                             .value = value,
                             .samples = count,
                             .jobs = job->jobs,
                             .store = job->store,
                             .seen = on_point,
                             .cancelled = is_cancelled,
                             .data = job};
  SbAnswers answers = {0};
  const bool good =
      sb_answers_set_list(&asked, NULL, error) && sb_answers_get(&answers, &asked, error);
  lock(job);
  for (size_t i = 0; good && i < answers.samples; i++) {
    if (answers.status[i] != SB_ANSWER_MISSING) {
      put(job, job->sample[i], (SbStatus)answers.status[i], answers.value + i * answers.figures);
    }
  }
  unlock(job);
  sb_answers_release(&answers);
  return good;
}

// Designs -----------------------------------------------------------------------------------------

static void place_on_map(SbDesignPlace *at, const SbDesignAnswer *answer) {
  for (int axis = 0; axis < 2; axis++) {
    at->axis[axis] = sb_model_value(answer->study->base, answer->map.axis[axis]);
    for (guint k = 0; k < answer->study->vary->len; k++) {
      if (g_array_index(answer->study->vary, SbVary, k).id == answer->map.axis[axis]) {
        at->axis[axis] = at->value[k];
      }
    }
  }
}

// What the parameters with tolerances and the main ones do to each figure.
static SbStatus take_effects(SbDesignPlace *at, SbDesignJob *job, SbReport *report) {
  const SbStudyFile *study = job->answer->study;
  SbOverride override[SB_VARY_MAX];
  SbParamId id[SB_PARAM_COUNT];
  size_t count = 0;
  const int kind = sb_model_number(study->base, SB_P_VALVE_KIND);
  for (guint k = 0; k < study->vary->len; k++) {
    override[k] = (SbOverride){g_array_index(study->vary, SbVary, k).id, at->value[k]};
  }
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    if (param->kind == SB_PARAM_REAL && param->parent < 0 &&
        (sb_param_is_main((SbParamId)i, kind) || sb_param_tolerance((SbParamId)i) >= 0)) {
      id[count++] = (SbParamId)i;
    }
  }
  SbEvaluator *evaluator = NULL;
  SbGradient *gradient = NULL;
  const SbQuestion question = {.base = study->base,
                               .override = override,
                               .override_count = study->vary->len,
                               .figure = job->figure,
                               .figure_count = job->answer->map.figures,
                               .cancelled = is_cancelled,
                               .data = job};
  SbStatus status = sb_evaluator_create(&evaluator, report);
  status = status == SB_OK
               ? sb_gradient_create(&gradient, evaluator, &question, id, count, NULL, report)
               : status;
  g_autofree SbEffect *effect = g_new(SbEffect, count + 1);
  for (size_t i = 0; gradient != NULL && i < job->answer->map.figures; i++) {
    const size_t found = sb_effects(effect, gradient, i, study->base);
    at->figure[i] = sb_gradient_value(gradient, i);
    at->error[i] = sb_gradient_value_error(gradient, i);
    at->effects[i] = MIN(found, SB_DESIGN_EFFECTS);
    at->variance[i] = 0;
    for (size_t k = 0; k < found; k++) {
      const SbParamId of = sb_gradient_parameter(gradient, effect[k].parameter);
      at->variance[i] += effect[k].tolerance ? effect[k].change * effect[k].change / 9 : 0;
      if (k < SB_DESIGN_EFFECTS) {
        at->effect[i][k].id = of;
        at->effect[i][k].step = effect[k].step;
        at->effect[i][k].change = effect[k].change;
        at->effect[i][k].tolerance = effect[k].tolerance;
      }
    }
  }
  sb_gradient_destroy(gradient);
  sb_evaluator_destroy(evaluator);
  return status == SB_ERROR_NOT_CONVERGED ? SB_OK : status;
}

// Valves drawn from the tolerances about a design.
static bool draw_valves(SbDesignPlace *at, SbDesignJob *job, GError **error) {
  const SbStudyFile *study = job->answer->study;
  const size_t figures = job->answer->map.figures;
  if (study->design.tolerances->len == 0) {
    return true;
  }
  g_autoptr(SbStudyFile) about = sb_study_file_about(study, at->value, job->valves);
  about->method = SB_METHOD_MONTE_CARLO;
  double *value = NULL;
  SbReport report = {0};
  SbStatus status = sb_study_file_points(&value, NULL, about, &report);
  SbParamId id[SB_VARY_MAX];
  for (guint k = 0; k < about->vary->len; k++) {
    id[k] = g_array_index(about->vary, SbVary, k).id;
  }
  const SbQuestions asked = {.base = study->base,
                             .base_sha256 = study->base_sha256,
                             .parameter = id,
                             .parameters = about->vary->len,
                             .figure = job->figure,
                             .figures = figures,
                             .value = value,
                             .samples = job->valves,
                             .jobs = job->jobs,
                             .store = job->store,
                             .cancelled = is_cancelled,
                             .data = job};
  SbAnswers answers = {0};
  const bool good = status == SB_OK && sb_answers_set_list(&asked, NULL, error) &&
                    sb_answers_get(&answers, &asked, error);
  if (status != SB_OK) {
    g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, report.text);
  }
  if (good) {
    size_t fails = 0, known = 0;
    at->sample = g_memdup2(answers.value, answers.samples * figures * sizeof *answers.value);
    at->samples = answers.samples;
    for (size_t i = 0; i < answers.samples; i++) {
      bool beyond = false, missing = false;
      for (size_t l = 0; l < study->limits.count; l++) {
        const SbLimit *limit = &study->limits.item[l];
        const int column = sb_study_column_of(study, limit->figure);
        const double figure = at->sample[i * figures + (size_t)column];
        beyond = beyond || figure < limit->low || figure > limit->high;
        missing = missing || isnan(figure);
      }
      fails += beyond;
      known += beyond || !missing;
    }
    at->fails = known > 0 ? (double)fails / (double)known : NAN;
  }
  sb_answers_release(&answers);
  free(value);
  return good;
}

// The present design's figures alone, before anything long.
static SbStatus take_present(SbDesignJob *job, SbReport *report) {
  const SbStudyFile *study = job->answer->study;
  SbDesignPlace at = {.known = true, .fails = NAN};
  SbEvaluator *evaluator = NULL;
  SbStatus status = sb_evaluator_create(&evaluator, report);
  if (status == SB_OK) {
    const SbSlopesAsked asked = {.base = study->base,
                                 .figure = job->figure,
                                 .figures = job->answer->map.figures,
                                 .cancelled = is_cancelled,
                                 .data = job};
    status = sb_slopes(at.figure, NULL, evaluator, &asked, NULL, report);
    const SbSummary *summary = sb_evaluator_summary(evaluator);
    for (size_t i = 0; summary != NULL && i < job->answer->map.figures; i++) {
      at.error[i] = sb_figure_error(summary, job->figure[i]);
    }
  }
  sb_evaluator_destroy(evaluator);
  for (guint k = 0; k < study->vary->len; k++) {
    at.value[k] = sb_model_value(study->base, g_array_index(study->vary, SbVary, k).id);
  }
  place_on_map(&at, job->answer);
  lock(job);
  job->answer->place[SB_DESIGN_PRESENT] = at;
  unlock(job);
  return status;
}

static SbStatus search(SbDesignJob *job, SbReport *report) {
  const SbStudyFile *study = job->answer->study;
  SbDesign found;
  const SbStatus status = sb_design_search(&found, study, job->jobs, is_cancelled, job, report);
  lock(job);
  job->answer->found = found;
  job->answer->searched = status == SB_OK;
  SbDesignPlace *at = &job->answer->place[SB_DESIGN_BEST];
  if (status == SB_OK && found.found) {
    *at = (SbDesignPlace){.known = true, .fails = NAN};
    memcpy(at->value, found.value, study->vary->len * sizeof *at->value);
    memcpy(at->figure, found.figure, job->answer->map.figures * sizeof *at->figure);
    memcpy(at->error, found.error, job->answer->map.figures * sizeof *at->error);
    place_on_map(at, job->answer);
  }
  unlock(job);
  return status;
}

// A part of a place is made on a copy, which then takes its place.
static bool about_place(SbDesignJob *job, int place, SbDesignPart part, SbReport *report,
                        GError **error) {
  SbDesignPlace *copy = g_new(SbDesignPlace, 1);
  *copy = job->answer->place[place]; // this thread alone writes it
  bool good = true;
  if (copy->known && part == SB_DESIGN_PART_TOLERANCES) {
    const SbStatus status = take_effects(copy, job, report);
    good = status == SB_OK;
  } else if (copy->known) {
    good = draw_valves(copy, job, error);
  }
  lock(job);
  job->answer->place[place] = *copy;
  unlock(job);
  g_free(copy);
  return good;
}

static void work_design_job(void *owner) {
  SbDesignJob *job = owner;
  SbReport report = {0};
  g_autoptr(GError) error = NULL;
  sb_process_work_behind();
  begin(job, SB_DESIGN_PART_MAP, 0);
  bool good = take_present(job, &report) == SB_OK;
  good = good && ask_points(job, COARSE, &error) && ask_points(job, 1, &error);
  if (good && job->search) {
    begin(job, SB_DESIGN_PART_SEARCH, 0.4);
    good = search(job, &report) == SB_OK;
  }
  for (int k = 0; good && k < 2 * SB_DESIGN_PLACES; k++) {
    const bool first = k < SB_DESIGN_PLACES;
    const SbDesignPart part = first ? SB_DESIGN_PART_TOLERANCES : SB_DESIGN_PART_VALVES;
    begin(job, part, 0.7 + 0.075 * k);
    if (first || job->search) {
      good = about_place(job, k % SB_DESIGN_PLACES, part, &report, &error);
    }
  }
  if (!good) {
    const bool cancelled = sb_worker_cancelled(&job->worker);
    job->why = cancelled              ? g_strdup("")
               : error != NULL        ? g_strdup(error->message)
               : *report.text != '\0' ? g_strdup(report.text)
                                      : g_strdup(sb_status_text(report.status));
  }
}

SbDesignJob *sb_design_job_start(SbStudyFile *study, const SbDesignAsk *ask, SbStore *store,
                                 bool search, void (*done)(void *data), void *data) {
  SbDesignJob *job = g_new0(SbDesignJob, 1);
  SbDesignAnswer *answer = g_new0(SbDesignAnswer, 1);
  SbDesignMap *map = &answer->map;
  g_mutex_init(&job->lock);
  g_cond_init(&job->resumed);
  job->search = search;
  job->store = store;
  job->jobs = (int)g_get_num_processors();
  job->begun = g_get_monotonic_time();
  job->valves = ask->closed ? VALVES_CLOSED : VALVES_OWN;
  job->answer = answer;
  answer->study = study;
  map->n = ask->closed ? POINTS_CLOSED : POINTS_OWN;
  map->figures = MIN(study->figures->len, SB_DESIGN_FIGURES);
  for (size_t i = 0; i < map->figures; i++) {
    job->figure[i] = g_array_index(study->figures, int, i);
  }
  for (int axis = 0; axis < 2; axis++) {
    const SbDesignRange *range = &ask->range[ask->axis[axis]];
    map->axis[axis] = range->id;
    map->low[axis] = range->low;
    map->high[axis] = range->high;
  }
  const size_t points = map->n * map->n;
  map->value = g_new(double, points * map->figures);
  for (size_t i = 0; i < points * map->figures; i++) {
    map->value[i] = NAN;
  }
  map->status = g_malloc(points);
  memset(map->status, SB_ANSWER_MISSING, points);
  job->sample = g_new(size_t, points);
  sb_worker_start(&job->worker, "design", work_design_job, job, done, data);
  return job;
}

const SbDesignAnswer *sb_design_job_lock(SbDesignJob *job) {
  lock(job);
  return job->answer;
}

void sb_design_job_unlock(SbDesignJob *job) {
  unlock(job);
}

SbDesignPart sb_design_job_part(SbDesignJob *job) {
  return (SbDesignPart)g_atomic_int_get(&job->part);
}

void sb_design_job_pause(SbDesignJob *job, bool on) {
  lock(job);
  job->paused = on;
  g_cond_broadcast(&job->resumed);
  unlock(job);
}

void sb_design_job_cancel(SbDesignJob *job) {
  sb_worker_cancel(&job->worker);
  sb_design_job_pause(job, false);
}

SbDesignAnswer *sb_design_job_take(SbDesignJob *job, char **why) {
  *why = g_steal_pointer(&job->why);
  return g_steal_pointer(&job->answer);
}

void sb_design_job_free(SbDesignJob *job) {
  if (job == NULL) {
    return;
  }
  sb_design_job_cancel(job);
  sb_worker_finish(&job->worker);
  sb_design_answer_free(job->answer);
  g_free(job->sample);
  g_free(job->why);
  g_mutex_clear(&job->lock);
  g_cond_clear(&job->resumed);
  g_free(job);
}

// The installed interface (include/sealbench.h) over documents, runs and the evaluator.
//
// Statuses are the engine's, numbered alike. All memory that callers see belongs to the scene.
#include "include/sealbench.h"

#include "app/base/device.h"
#include "app/document/document.h"
#include "app/document/shipped.h"
#include "app/library/library_private.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

_Static_assert((int)SB_SCENE_ERROR_INPUT == (int)SB_ERROR_INPUT &&
                   (int)SB_SCENE_ERROR_RANGE == (int)SB_ERROR_RANGE &&
                   (int)SB_SCENE_ERROR_INFEASIBLE == (int)SB_ERROR_INFEASIBLE &&
                   (int)SB_SCENE_ERROR_NOT_CONVERGED == (int)SB_ERROR_NOT_CONVERGED &&
                   (int)SB_SCENE_ERROR_CANCELLED == (int)SB_ERROR_CANCELLED &&
                   (int)SB_SCENE_ERROR_MEMORY == (int)SB_ERROR_MEMORY &&
                   (int)SB_SCENE_ERROR_IO == (int)SB_ERROR_IO,
               "the statuses of the library are the engine's");

_Static_assert(SB_LIBRARY_VERSION_MAJOR == SB_PROJECT_MAJOR &&
                   SB_LIBRARY_VERSION_MINOR == SB_PROJECT_MINOR &&
                   SB_LIBRARY_VERSION_MICRO == SB_PROJECT_MICRO,
               "the header's version is the project's");

struct SbScene {
  SbDocument *document;
  GPtrArray *issues; // of the file, of SbIssue
  GPtrArray *lines;  // of them, of char *
  char key[64];      // of the parameter at fault in the last failure, or empty
  char *message;     // of that failure
  char *text;        // last value given as text
  char *path;        // of the file that was opened; NULL: none
  SbRun *run;        // NULL before the first
  SbEvaluator *evaluator;
  SbAnswers answers;
  void (*progress)(void *data, double fraction);
  int (*cancelled)(void *data);
  void *data;
  locale_t caller; // locale of the thread that computes, for its callbacks
};

// ---- Failures ----

static SbSceneStatus G_GNUC_PRINTF(4, 5)
    fail(SbScene *scene, SbSceneStatus status, const char *key, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  char *message = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_free(scene->message);
  scene->message = message;
  g_strlcpy(scene->key, key, sizeof scene->key);
  return status;
}

static SbSceneStatus report(SbScene *scene, SbStatus status, const SbReport *from) {
  if (status == SB_OK) {
    return SB_SCENE_OK;
  }
  return fail(scene, (SbSceneStatus)status, sb_input_key(from->input), "%s",
              from->text[0] != '\0' ? from->text : sb_status_text(status));
}

// Id of a parameter, or -1 with the message.
static int find_parameter(SbScene *scene, const char *key) {
  int id = sb_param_find(key);
  if (id < 0) {
    fail(scene, SB_SCENE_ERROR_INPUT, key, "there is no parameter \"%s\"", key);
  }
  return id;
}

static int find_figure(SbScene *scene, const char *path) {
  int index = sb_figure_find(path);
  if (index < 0) {
    fail(scene, SB_SCENE_ERROR_INPUT, path, "there is no figure \"%s\"", path);
  }
  return index;
}

// ---- Scenes ----

// Takes the document, NULL if nothing could be made of the file.
static SbSceneStatus take(SbScene **out, SbDocument *document, GPtrArray *issues, bool readable) {
  SbScene *scene = g_new0(SbScene, 1);
  *out = scene;
  scene->issues = issues;
  scene->lines = g_ptr_array_new_with_free_func(g_free);
  scene->message = g_strdup("");
  for (guint i = 0; i < issues->len; i++) {
    g_ptr_array_add(scene->lines, sb_issue_line(issues->pdata[i]));
  }
  bool good = document != NULL && issues->len == 0;
  scene->document = document != NULL ? document : sb_document_new_refused(issues);
  if (sb_evaluator_create(&scene->evaluator, NULL) != SB_OK) {
    sb_scene_close(scene);
    *out = NULL;
    return SB_SCENE_ERROR_MEMORY;
  }
  if (good) {
    return SB_SCENE_OK;
  }
  const SbIssue *first = issues->pdata[0];
  return fail(scene, readable ? SB_SCENE_ERROR_INPUT : SB_SCENE_ERROR_IO,
              first->key != NULL ? first->key : "", "%s", (const char *)scene->lines->pdata[0]);
}

SbSceneStatus sb_scene_open(SbScene **out, const char *path) {
  sb_catalogue_set_up();
  SB_IN_OWN_LOCALE;
  GPtrArray *issues = sb_issues_new();
  g_autofree char *file = sb_shipped_resolve(path, SB_SHIPPED_FOR_RUN);
  SbDocument *document = sb_document_load(file, issues);
  bool readable = document != NULL || access(file, R_OK) == 0;
  SbSceneStatus status = take(out, document, issues, readable);
  if (*out != NULL) {
    (*out)->path = g_steal_pointer(&file);
  }
  return status;
}

SbSceneStatus sb_scene_parse(SbScene **out, const char *text, size_t length, const char *folder) {
  sb_catalogue_set_up();
  SB_IN_OWN_LOCALE;
  GPtrArray *issues = sb_issues_new();
  return take(out, sb_document_parse(text, length, "text", folder, issues), issues, true);
}

SbSceneStatus sb_scene_new(SbScene **out) {
  sb_catalogue_set_up();
  SB_IN_OWN_LOCALE;
  return take(out, sb_document_new(), sb_issues_new(), true);
}

void sb_scene_close(SbScene *scene) {
  if (scene == NULL) {
    return;
  }
  sb_run_destroy(scene->run);
  sb_evaluator_destroy(scene->evaluator);
  sb_answers_clear(&scene->answers);
  sb_document_free(scene->document);
  g_ptr_array_unref(scene->issues);
  g_ptr_array_unref(scene->lines);
  g_free(scene->message);
  g_free(scene->text);
  g_free(scene->path);
  g_free(scene);
}

const char *sb_scene_message(const SbScene *scene) {
  return scene->message;
}

const char *sb_scene_message_key(const SbScene *scene) {
  return scene->key;
}

const char *sb_scene_issue(const SbScene *scene, size_t index) {
  return index < scene->lines->len ? scene->lines->pdata[index] : NULL;
}

const char *sb_scene_path(const SbScene *scene) {
  return scene->path;
}

const char *sb_scene_title(const SbScene *scene) {
  return sb_document_title(scene->document);
}

const char *sb_scene_text(SbScene *scene) {
  SB_IN_OWN_LOCALE;
  g_free(scene->text);
  scene->text = sb_document_to_text(scene->document, NULL);
  return scene->text;
}

// ---- Parameters ----

// A change that the document refused.
static SbSceneStatus refused(SbScene *scene, const char *key, GError *error) {
  SbSceneStatus status = fail(scene, SB_SCENE_ERROR_INPUT, key, "%s: %s", key, error->message);
  g_error_free(error);
  return status;
}

SbSceneStatus sb_scene_set_text(SbScene *scene, const char *key, const char *text) {
  SB_IN_OWN_LOCALE;
  GError *error = NULL;
  int id = find_parameter(scene, key);
  if (id < 0) {
    return SB_SCENE_ERROR_INPUT;
  }
  return sb_document_set(scene->document, (SbParamId)id, text, &error) ? SB_SCENE_OK
                                                                       : refused(scene, key, error);
}

SbSceneStatus sb_scene_set(SbScene *scene, const char *key, double value) {
  SB_IN_OWN_LOCALE;
  GError *error = NULL;
  int id = find_parameter(scene, key);
  if (id < 0) {
    return SB_SCENE_ERROR_INPUT;
  }
  // In range or not, told with the number as it is, not in the unit shown.
  SbParams ignored;
  SbReport why;
  sb_params_init(&ignored);
  SbStatus status = sb_params_set(&ignored, (SbParamId)id, value, &why);
  if (status != SB_OK) {
    return fail(scene, (SbSceneStatus)status, key, "%s: %s", key, why.text);
  }
  return sb_document_set_value(scene->document, (SbParamId)id, value, false, &error)
             ? SB_SCENE_OK
             : refused(scene, key, error);
}

SbSceneStatus sb_scene_unset(SbScene *scene, const char *key) {
  SB_IN_OWN_LOCALE;
  int id = find_parameter(scene, key);
  if (id < 0) {
    return SB_SCENE_ERROR_INPUT;
  }
  sb_document_unset(scene->document, (SbParamId)id);
  return SB_SCENE_OK;
}

SbSceneStatus sb_scene_get(SbScene *scene, const char *key, double *value) {
  SB_IN_OWN_LOCALE;
  int id = find_parameter(scene, key);
  *value = id < 0 ? NAN : sb_document_value(scene->document, (SbParamId)id);
  return id < 0 ? SB_SCENE_ERROR_INPUT : SB_SCENE_OK;
}

const char *sb_scene_get_text(SbScene *scene, const char *key) {
  SB_IN_OWN_LOCALE;
  int id = find_parameter(scene, key);
  g_free(scene->text);
  scene->text = id < 0 ? NULL : sb_document_text(scene->document, (SbParamId)id);
  return scene->text;
}

// ---- Runs ----

void sb_scene_callbacks(SbScene *scene, void (*progress)(void *data, double fraction),
                        int (*cancelled)(void *data), void *data) {
  scene->progress = progress;
  scene->cancelled = cancelled;
  scene->data = data;
}

// What part of a computation the hooks see: from `begun`, `share` of the whole.
typedef struct {
  const SbScene *scene;
  double begun, share;
} Part;

static void on_progress(void *data, double fraction, size_t frames) {
  const Part *part = data;
  const SbScene *scene = part->scene;
  if (scene->progress != NULL) {
    const locale_t own = uselocale(scene->caller);
    scene->progress(scene->data, part->begun + part->share * fraction);
    (void)uselocale(own);
  }
}

static bool is_cancelled(void *data) {
  const SbScene *scene = ((const Part *)data)->scene;
  if (scene->cancelled == NULL) {
    return false;
  }
  const locale_t own = uselocale(scene->caller);
  const bool cancelled = scene->cancelled(scene->data) != 0;
  (void)uselocale(own);
  return cancelled;
}

// The values in force as a model.
static SbSceneStatus compile(SbScene *scene, SbModel **model) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  if (sb_document_compile(scene->document, model, issues)) {
    return SB_SCENE_OK;
  }
  const SbIssue *first = issues->pdata[0];
  g_autofree char *line = sb_issue_line(first);
  return fail(scene, SB_SCENE_ERROR_INPUT, first->key != NULL ? first->key : "", "%s", line);
}

// The run of the scene itself, `share` of the whole computation, for a caller with this locale.
static SbSceneStatus compute(SbScene *scene, locale_t caller, double share) {
  scene->caller = caller;
  sb_answers_clear(&scene->answers);
  g_autoptr(SbModel) model = NULL;
  SbPlan plan;
  SbReport why = {0};
  SbSceneStatus compiled = compile(scene, &model);
  if (compiled != SB_SCENE_OK) {
    return compiled;
  }
  sb_plan_make(&plan, model);
  plan.profiles = sb_device(model)->stem;
  plan.section_fields = false;
  SbStatus status = scene->run == NULL ? sb_run_create(&scene->run, model, &plan, &why)
                                       : sb_run_renew(scene->run, model, &plan, &why);
  if (status != SB_OK) {
    sb_run_destroy(scene->run);
    scene->run = NULL;
    return report(scene, status, &why);
  }
  Part part = {scene, 0, share};
  const SbRunHooks hooks = {.progress = on_progress, .cancelled = is_cancelled, .data = &part};
  return report(scene, sb_run_execute(scene->run, &hooks, &why), &why);
}

SbSceneStatus sb_scene_run(SbScene *scene) {
  SB_IN_OWN_LOCALE;
  return compute(scene, before_, 1);
}

SbSceneStatus sb_scene_judge(SbScene *scene) {
  SB_IN_OWN_LOCALE;
  const double own = 1 / (1 + (double)sb_document_case_count(scene->document));
  const SbSceneStatus run = compute(scene, before_, own);
  if (scene->run == NULL || run == SB_SCENE_ERROR_CANCELLED) {
    return run;
  }
  Part part = {scene, own, 1 - own};
  const SbRunHooks hooks = {.progress = on_progress, .cancelled = is_cancelled, .data = &part};
  SbCaseVerdict worst[SB_VERDICT_COUNT];
  g_autoptr(GPtrArray) problems = g_ptr_array_new_with_free_func(g_free);
  SbStatus cases =
      sb_cases_judge(worst, sb_run_summary(scene->run)->verdict, scene->document, &hooks, problems);
  sb_answers_take(&scene->answers, worst);
  if (run != SB_SCENE_OK || cases == SB_OK) {
    return run;
  }
  return fail(scene, (SbSceneStatus)cases, "", "%s",
              problems->len > 0 ? (const char *)problems->pdata[problems->len - 1]
                                : sb_status_text(cases));
}

const SbSceneVerdict *sb_scene_verdict(const SbScene *scene, size_t index) {
  return index < scene->answers.count ? &scene->answers.answer[index] : NULL;
}

// Writes what `of` returns for a figure of the last run.
static SbSceneStatus read_run(SbScene *scene, const char *path,
                              double (*of)(const SbSummary *summary, int index), double *out) {
  SB_IN_OWN_LOCALE;
  const int index = find_figure(scene, path);
  *out = NAN;
  if (index >= 0 && scene->run == NULL) {
    return fail(scene, SB_SCENE_ERROR_INPUT, path, "there has been no run yet");
  }
  *out = index < 0 ? NAN : of(sb_run_summary(scene->run), index);
  return index < 0 ? SB_SCENE_ERROR_INPUT : SB_SCENE_OK;
}

SbSceneStatus sb_scene_figure(SbScene *scene, const char *path, double *value) {
  return read_run(scene, path, sb_figure_value, value);
}

static double stated_error(const SbSummary *summary, int index) {
  return sb_figure_error_reason(summary, index) == NULL ? sb_figure_error(summary, index) : NAN;
}

SbSceneStatus sb_scene_error(SbScene *scene, const char *path, double *error) {
  return read_run(scene, path, stated_error, error);
}

const char *sb_scene_reason(const SbScene *scene, const char *path) {
  const int index = sb_figure_find(path);
  if (index < 0 || scene->run == NULL) {
    return index < 0 ? NULL : "there has been no run yet";
  }
  return sb_figure_reason(sb_run_summary(scene->run), index);
}

static const SbWarning *warning_of(const SbSummary *summary, size_t index) {
  return summary != NULL && index < summary->warnings.count ? &summary->warnings.item[index] : NULL;
}

const char *sb_scene_warning(const SbScene *scene, size_t index) {
  const SbWarning *of = warning_of(scene->run != NULL ? sb_run_summary(scene->run) : NULL, index);
  return of != NULL ? of->text : NULL;
}

const char *sb_scene_warning_code(const SbScene *scene, size_t index) {
  const SbWarning *of = warning_of(scene->run != NULL ? sb_run_summary(scene->run) : NULL, index);
  return of != NULL ? of->code : NULL;
}

size_t sb_scene_frame_count(const SbScene *scene) {
  size_t count = 0;
  if (scene->run != NULL) {
    sb_run_frames(scene->run, &count);
  }
  return count;
}

SbSceneStatus sb_scene_frames(SbScene *scene, const char *quantity, double *out) {
  SB_IN_OWN_LOCALE;
  size_t count = 0;
  const SbFrame *frames = scene->run != NULL ? sb_run_frames(scene->run, &count) : NULL;
  const SbFrameQuantity *of = sb_catalogue_quantity(quantity);
  if (of == NULL) {
    return fail(scene, SB_SCENE_ERROR_INPUT, quantity, "frames have no quantity \"%s\"", quantity);
  }
  for (size_t i = 0; i < count; i++) {
    const char *at = (const char *)&frames[i] + of->offset;
    out[i] = of->single ? (double)*(const float *)at : *(const double *)at;
  }
  return SB_SCENE_OK;
}

SbSceneStatus sb_scene_profile(SbScene *scene, size_t frame, const char *seal,
                               SbSceneProfile *out) {
  SB_IN_OWN_LOCALE;
  size_t count = 0;
  const SbFrame *frames = scene->run != NULL ? sb_run_frames(scene->run, &count) : NULL;
  *out = (SbSceneProfile){0};
  int index;
  for (index = 0; index < SB_SEAL_COUNT && strcmp(sb_seal_name(index), seal) != 0; index++) {
  }
  if (index == SB_SEAL_COUNT) {
    return fail(scene, SB_SCENE_ERROR_INPUT, "", "there is no seal \"%s\": outer or inner", seal);
  }
  if (frame >= count) {
    return fail(scene, SB_SCENE_ERROR_INPUT, "", "there is no frame %zu of %zu", frame, count);
  }
  const SbContactProfile *profile = sb_run_profile(scene->run, frames[frame].seal[index].profile);
  if (profile != NULL) {
    *out = (SbSceneProfile){
        profile->count, profile->x, profile->pressure, profile->film, profile->asperity_pressure,
        profile->model};
  }
  return SB_SCENE_OK;
}

// ---- Evaluation ----

SbSceneStatus sb_scene_evaluate(SbScene *scene, const char *const *keys, const double *values,
                                size_t count, const char *const *figures, size_t figure_count,
                                double *out) {
  SB_IN_OWN_LOCALE;
  scene->caller = before_;
  g_autoptr(SbModel) model = NULL;
  SbReport why = {0};
  g_autofree SbOverride *overrides = g_new(SbOverride, count + 1);
  g_autofree int *indices = g_new(int, figure_count + 1);
  for (size_t i = 0; i < figure_count; i++) {
    out[i] = NAN;
  }
  for (size_t i = 0; i < count; i++) {
    int id = find_parameter(scene, keys[i]);
    if (id < 0) {
      return SB_SCENE_ERROR_INPUT;
    }
    overrides[i] = (SbOverride){(SbParamId)id, values[i]};
  }
  for (size_t i = 0; i < figure_count; i++) {
    indices[i] = find_figure(scene, figures[i]);
    if (indices[i] < 0) {
      return SB_SCENE_ERROR_INPUT;
    }
  }
  SbSceneStatus compiled = compile(scene, &model);
  if (compiled != SB_SCENE_OK) {
    return compiled;
  }
  Part part = {scene, 0, 1};
  const SbQuestion question = {.base = model,
                               .override = overrides,
                               .override_count = count,
                               .figure = indices,
                               .figure_count = figure_count,
                               .cancelled = is_cancelled,
                               .data = &part};
  return report(scene, sb_evaluator_ask(out, scene->evaluator, &question, &why), &why);
}

const char *sb_scene_evaluation_warning(const SbScene *scene, size_t index) {
  const SbWarning *of = warning_of(sb_evaluator_summary(scene->evaluator), index);
  return of != NULL ? of->text : NULL;
}

const char *sb_scene_evaluation_warning_code(const SbScene *scene, size_t index) {
  const SbWarning *of = warning_of(sb_evaluator_summary(scene->evaluator), index);
  return of != NULL ? of->code : NULL;
}

const char *sb_scene_evaluation_reason(const SbScene *scene, const char *path) {
  int index = sb_figure_find(path);
  return index >= 0 ? sb_evaluator_reason(scene->evaluator, index) : NULL;
}

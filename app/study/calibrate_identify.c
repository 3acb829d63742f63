// What samples say of parameters, and the fitted scene; see calibrate.h.
#include "app/study/calibrate.h"

#include "app/base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *sb_identifiable_name(SbIdentifiable identifiable) {
  static const char *const names[] = {"yes", "with-other", "no"};
  return names[identifiable];
}

static double quantile(const double *sorted, size_t count, double share) {
  const double place = share * (double)(count - 1);
  const size_t low = (size_t)place;
  return sorted[low] + (place - (double)low) * (sorted[MIN(low + 1, count - 1)] - sorted[low]);
}

static void find_moments(SbCalibration *out) {
  const size_t p = out->parameters, count = out->samples;
  double *column = g_new(double, count + 1), *mean = g_new0(double, p + 1);
  for (size_t j = 0; j < p; j++) {
    SbCalibrated *of = &out->parameter[j];
    of->deviation = of->interval[0] = of->interval[1] = NAN;
    if (count < 2) {
      continue;
    }
    double square = 0;
    for (size_t i = 0; i < count; i++) {
      column[i] = out->sample[i * p + j];
      mean[j] += column[i] / (double)count;
    }
    for (size_t i = 0; i < count; i++) {
      square += (column[i] - mean[j]) * (column[i] - mean[j]);
    }
    of->deviation = sqrt(square / (double)(count - 1));
    qsort(column, count, sizeof *column, sb_number_compare);
    of->interval[0] = quantile(column, count, 0.025);
    of->interval[1] = quantile(column, count, 0.975);
  }
  out->correlation = g_new(double, p *p + 1);
  for (size_t j = 0; j < p; j++) {
    for (size_t k = 0; k < p; k++) {
      double sum = 0;
      for (size_t i = 0; i < count; i++) {
        sum += (out->sample[i * p + j] - mean[j]) * (out->sample[i * p + k] - mean[k]);
      }
      const double both = out->parameter[j].deviation * out->parameter[k].deviation;
      out->correlation[j * p + k] = j == k ? 1 : sum / (double)(count - 1) / both;
    }
  }
  for (size_t j = 0; j < p; j++) {
    SbCalibrated *of = &out->parameter[j];
    of->identifiable =
        of->interval[1] - of->interval[0] < SB_IDENTIFIABLE_FRACTION * (of->prior[1] - of->prior[0])
            ? SB_IDENTIFIABLE_YES
            : SB_IDENTIFIABLE_NO;
    for (size_t k = 0; k < p; k++) {
      if (k != j && fabs(out->correlation[j * p + k]) > SB_IDENTIFIABLE_CORRELATION) {
        of->identifiable = SB_IDENTIFIABLE_WITH_OTHER;
      }
    }
  }
  g_free(column);
  g_free(mean);
}

// The experiment that would part two.
static const char *experiment(const SbCalibrated *a, const SbCalibrated *b) {
  const SbParamGroup of[] = {sb_param_group(a->id), sb_param_group(b->id)};
  bool friction = true, size = false, life = true;
  for (int i = 0; i < 2; i++) {
    friction = friction && (of[i] == SB_PARAMS_FRICTION || of[i] == SB_PARAMS_SURFACE);
    size = size || of[i] == SB_PARAMS_SEAL || of[i] == SB_PARAMS_GLAND;
    life = life && of[i] == SB_PARAMS_LIFE;
  }
  return life ? "loops of the first and of much later actuations would part them"
         : friction
             ? "a loop at another squeeze, or of a ring with another modulus, would part them"
         : size ? "the force on one ring in compression, or its sizes measured, would part them"
                : "loops at another pressure or speed would part them";
}

static char *make_sentence(const SbCalibration *out) {
  const size_t p = out->parameters;
  GString *text = g_string_new(NULL);
  if (out->samples == 0) {
    g_string_append(text, "The values are the best found so far; there is no posterior and no "
                          "interval.");
    return g_string_free(text, FALSE);
  }
  for (size_t j = 0; j < p; j++) {
    for (size_t k = j + 1; k < p; k++) {
      const double rho = out->correlation[j * p + k];
      if (fabs(rho) > SB_IDENTIFIABLE_CORRELATION) {
        g_string_append_printf(text,
                               "%s%s and %s are correlated (%.2f): these data identify their "
                               "combined effect, not each of them; %s.",
                               text->len > 0 ? " " : "", out->parameter[j].name,
                               out->parameter[k].name, rho,
                               experiment(&out->parameter[j], &out->parameter[k]));
      }
    }
  }
  for (size_t j = 0; j < p; j++) {
    if (out->parameter[j].identifiable == SB_IDENTIFIABLE_NO) {
      g_string_append_printf(text,
                             "%s%s is hardly narrower than its prior: the value is not changed.",
                             text->len > 0 ? " " : "", out->parameter[j].name);
    }
  }
  if (text->len == 0) {
    g_string_append(text, "All parameters are identifiable from these data.");
  }
  return g_string_free(text, FALSE);
}

void sb_calibration_identify(SbCalibration *out) {
  find_moments(out);
  out->sentence = make_sentence(out);
}

// ---- The fitted files ----

// Whether a fitted parameter replaces the value of the scene. Without a posterior the best values
// found so far do.
static bool replaces(const SbCalibration *of, const SbCalibrated *fitted) {
  return of->samples == 0 || fitted->identifiable != SB_IDENTIFIABLE_NO;
}

// The parameter that has this value of a curve; NULL: the curve's `set` has it. The last override
// of a parameter is in force, and those of parameters follow those of `set`.
static const SbCalibrated *fitted_of(const SbCalibration *of, size_t curve, size_t i) {
  const SbOverride *value = &of->curve[curve].value[i];
  for (size_t j = 0; j < of->parameters; j++) {
    const SbCalibrated *one = &of->parameter[j];
    const bool here = one->curve < 0 || one->curve == (int)curve;
    if (one->id == value->id && here && one->estimate == value->value) {
      return one;
    }
  }
  return NULL;
}

static void add_origin(GString *origin, const SbCalibration *of, const SbCalibrated *fitted) {
  g_autofree char *estimate = sb_param_format(fitted->id, fitted->estimate);
  const char *key = sb_param(fitted->id)->key;
  if (of->samples == 0) {
    g_string_append_printf(origin, "# %s: %s (without an interval)\n", key, estimate);
    return;
  }
  g_autofree char *low = sb_param_format(fitted->id, fitted->interval[0]);
  g_autofree char *high = sb_param_format(fitted->id, fitted->interval[1]);
  g_string_append_printf(origin, "# %s: %s (95 %%: %s to %s), identifiable: %s\n", key, estimate,
                         low, high, sb_identifiable_name(fitted->identifiable));
}

// Sets a curve's values in a document and adds to `origin` where they come from; without `set`
// those of the parameters alone.
static bool put_values(SbDocument *document, GString *origin, const SbCalibration *of, size_t curve,
                       bool set, GError **error) {
  for (size_t i = 0; i < of->curve[curve].values; i++) {
    const SbOverride *value = &of->curve[curve].value[i];
    const SbCalibrated *fitted = fitted_of(of, curve, i);
    if (fitted != NULL) {
      add_origin(origin, of, fitted);
    }
    if ((fitted != NULL ? replaces(of, fitted) : set) &&
        !sb_document_set_value(document, value->id, value->value, false, error)) {
      return false;
    }
  }
  return true;
}

static GString *origin_of(const SbCalibration *of, const SbStudyFile *study, size_t curve) {
  const SbData *data = study->data->pdata[curve];
  const SbComparison *after = of->curve[curve].after;
  g_autofree char *measured = g_canonicalize_filename(data->path, NULL);
  g_autofree char *asked = g_path_get_basename(study->path != NULL ? study->path : "-");
  GString *origin = g_string_new(NULL);
  g_string_append_printf(origin, "\n# Calibrated with %s from %s; residuals %.3g N.\n", asked,
                         measured, after != NULL ? after->rms : NAN);
  if (of->partial) {
    g_string_append(origin, "# The calibration was interrupted: these are its best values.\n");
  }
  return origin;
}

// The document's text for a file at `path`, then the origin; frees `origin`.
static char *finish(const SbDocument *document, const char *path, GString *origin) {
  g_autofree char *text = sb_document_to_text(document, path);
  char *whole = g_strconcat(text, origin->str, NULL);
  g_string_free(origin, TRUE);
  return whole;
}

static SbDocument *copy_scene(const SbStudyFile *study, GError **error) {
  const char *path = sb_document_path(study->scene);
  g_autofree char *own = sb_document_to_text(study->scene, path);
  g_autofree char *folder = path != NULL ? g_path_get_dirname(path) : NULL;
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) scene = sb_document_parse(own, strlen(own), "scene", folder, issues);
  if (scene == NULL || issues->len > 0) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "the scene cannot be written again");
    return NULL;
  }
  return g_steal_pointer(&scene);
}

char *sb_calibration_scene(const SbCalibration *of, const SbStudyFile *study, size_t curve,
                           const char *path, GError **error) {
  g_autoptr(SbDocument) scene = copy_scene(study, error);
  if (scene == NULL) {
    return NULL;
  }
  GString *origin = origin_of(of, study, curve);
  if (!put_values(scene, origin, of, curve, true, error)) {
    g_string_free(origin, TRUE);
    return NULL;
  }
  if (sb_document_data_count(scene) == 0) {
    const SbData *data = study->data->pdata[curve];
    g_autofree char *measured = g_canonicalize_filename(data->path, NULL);
    g_autofree char *keys = sb_measured_keys(of->curve[curve].measured);
    g_string_append_printf(origin, "\n[data]\nfile = %s\n%s", measured, keys);
  }
  return finish(scene, path, origin);
}

// The valve of the study's scene: its valve file, the defaults without one, or the document itself
// where the study names a valve.
static SbDocument *copy_valve(const SbStudyFile *study, GError **error) {
  if (sb_document_kind(study->scene) == SB_DOCUMENT_VALVE) {
    return copy_scene(study, error);
  }
  const char *path = sb_document_valve_path(study->scene);
  if (path == NULL) {
    return sb_document_new();
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) valve = sb_document_load(path, issues);
  if (valve == NULL || issues->len > 0) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: the valve cannot be read again",
                path);
    return NULL;
  }
  return g_steal_pointer(&valve);
}

char *sb_calibration_valve(const SbCalibration *of, const SbStudyFile *study, size_t curve,
                           const char *path, GError **error) {
  g_autoptr(SbDocument) valve = copy_valve(study, error);
  if (valve == NULL) {
    return NULL;
  }
  GString *origin = origin_of(of, study, curve);
  if (!put_values(valve, origin, of, curve, false, error)) {
    g_string_free(origin, TRUE);
    return NULL;
  }
  return finish(valve, path, origin);
}

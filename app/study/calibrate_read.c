// What the file of a calibration states: values, actuation and rows of each curve, and the
// coordinates of the fit; see calibrate_private.h.
#include "app/study/calibrate_private.h"

#include "app/base/number.h"
#include "engine/numeric/sampling.h"

#include <math.h>
#include <string.h>

typedef SbCalibrateCurve Curve;
typedef SbCalibrateWork Work;

static bool has_word(const char *list, const char *word) {
  g_auto(GStrv) words = g_strsplit_set(list != NULL ? list : "", ",;", -1);
  for (char **one = words; *one != NULL; one++) {
    if (strcmp(g_strstrip(*one), word) == 0) {
      return true;
    }
  }
  return false;
}

static bool read_set(Curve *curve, GPtrArray *issues) {
  const char *text = curve->data->text[SB_DATA_SET];
  g_auto(GStrv) words = g_strsplit(text != NULL ? text : "", ";", -1);
  for (char **word = words; *word != NULL; word++) {
    if (*g_strstrip(*word) == '\0') {
      continue;
    }
    g_auto(GStrv) parts = g_strsplit(*word, "=", 2);
    const int id = sb_param_find(g_strstrip(parts[0]));
    double value = 0;
    g_autoptr(GError) error = NULL;
    if (id < 0 || parts[1] == NULL || curve->sets == SB_VARY_MAX) {
      sb_data_add_issue(curve->data, SB_DATA_SET, "KEY=VALUE; KEY=VALUE", issues,
                        "\"%s\" sets no parameter", *word);
      return false;
    }
    if (!sb_param_parse(&value, (SbParamId)id, g_strstrip(parts[1]), &error)) {
      sb_data_add_issue(curve->data, SB_DATA_SET, NULL, issues, "%s: %s", parts[0], error->message);
      return false;
    }
    curve->set[curve->sets++] = (SbOverride){(SbParamId)id, value};
  }
  return true;
}

static double set_value(const Curve *curve, const Work *work, SbParamId id) {
  for (size_t i = 0; i < curve->sets; i++) {
    if (curve->set[i].id == id) {
      return curve->set[i].value;
    }
  }
  return sb_model_value(work->study->base, id);
}

// Which actuation of the valve the cycle in use is, as life.first_actuation of its runs.
static bool read_actuation(Curve *curve, GPtrArray *issues) {
  const char *text = curve->data->text[SB_DATA_ACTUATION];
  const SbMeasured *m = curve->measured;
  const double most = sb_param(SB_P_LIFE_FIRST_ACTUATION)->max;
  double first = 0;
  if (text == NULL) {
    return true;
  }
  if (!sb_number_parse(&first, text) || first != floor(first) || first < 1 ||
      !(first + (double)m->first <= most)) {
    g_autofree char *allowed = g_strdup_printf("1 to %.0f", most);
    sb_data_add_issue(curve->data, SB_DATA_ACTUATION, allowed, issues,
                      "\"%s\" is not a number of an actuation since new", text);
    return false;
  }
  if (m->first != m->last) {
    sb_data_add_issue(
        curve->data, SB_DATA_CYCLE, NULL, issues,
        "treats %zu cycles as one, but each is an actuation of its own: name some, as "
        "in cycle = 1, 10, %u",
        m->last - m->first + 1, m->cycle->len);
    return false;
  }
  if (curve->sets == SB_VARY_MAX) {
    sb_data_add_issue(curve->data, SB_DATA_SET, NULL, issues, "sets more than %d parameters",
                      SB_VARY_MAX - 1);
    return false;
  }
  curve->set[curve->sets++] = (SbOverride){SB_P_LIFE_FIRST_ACTUATION, first + (double)m->first};
  return true;
}

bool sb_calibrate_read_curve(Curve *curve, const Work *work, GPtrArray *issues) {
  bool ratio = false;
  for (size_t k = 0; k < work->study->vary->len; k++) {
    ratio |= sb_calibrate_vary(work, k)->id == SB_P_FRICTION_STATIC_RATIO;
  }
  if (!read_set(curve, issues)) {
    return false;
  }
  const double speed = sb_data_drive_speed(set_value(curve, work, SB_P_DRIVE_KIND),
                                           set_value(curve, work, SB_P_DRIVE_SPEED));
  curve->measured = sb_measured_read(curve->data, speed, NULL, 0, issues);
  if (curve->measured == NULL || !read_actuation(curve, issues)) {
    return false;
  }
  curve->point = sb_measured_points(&curve->points, curve->measured, SB_CALIBRATION_POINTS);
  curve->breakaway = ratio && curve->measured->stage[SB_STAGE_B].found;
  if (curve->points < 10) {
    sb_data_add_issue(curve->data, SB_DATA_FILE, "at least 10", issues,
                      "has %zu rows of a sliding stem", curve->points);
    return false;
  }
  if (ratio && !curve->breakaway) {
    sb_data_add_issue(curve->data, SB_DATA_FILE, NULL, issues,
                      "has no break-away to fit friction.static_ratio to: %s",
                      curve->measured->stage[SB_STAGE_B].reason);
    return false;
  }
  return true;
}

bool sb_calibrate_check_vary(const Work *work, GPtrArray *issues) {
  for (size_t k = 0; k < work->study->vary->len; k++) {
    const SbVary *vary = sb_calibrate_vary(work, k);
    const bool real = vary->id != SB_VARY_VARIABLE && sb_param(vary->id)->kind == SB_PARAM_REAL;
    if (!real || vary->by != NULL || vary->distribution.kind == SB_DISTRIBUTION_LEVELS) {
      g_autofree char *key = g_strconcat("vary.", sb_vary_name(vary), NULL);
      sb_issues_add(issues, work->study->path, vary->line, key, "uniform, loguniform, normal",
                    "has no prior: bounds or a distribution of a real parameter");
      return false;
    }
  }
  return true;
}

// The coordinate of the zero that an earlier curve has from the same rows of its file; SIZE_MAX:
// there is none.
static size_t zero_before(const Work *work, size_t c) {
  const Curve *curve = &work->curve[c];
  for (size_t k = 0; k < c; k++) {
    const SbMeasured *one = work->curve[k].measured;
    if (strcmp(work->curve[k].data->path, curve->data->path) == 0 &&
        one->no_load_row == curve->measured->no_load_row) {
      return work->curve[k].zero;
    }
  }
  return SIZE_MAX;
}

bool sb_calibrate_lay_out(Work *work, GPtrArray *issues) {
  const size_t varied = work->study->vary->len;
  size_t shared[SB_VARY_MAX];
  for (size_t k = 0; k < varied; k++) {
    shared[k] = SIZE_MAX;
  }
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    for (size_t k = 0; k < varied; k++) {
      const bool own =
          has_word(curve->data->text[SB_DATA_OWN], sb_vary_name(sb_calibrate_vary(work, k)));
      if (own || shared[k] == SIZE_MAX) {
        if (work->coordinates + (1 + SB_CALIBRATE_NUMERIC) * work->curves >=
            SB_INFERENCE_COORDINATES) {
          sb_data_add_issue(curve->data, SB_DATA_OWN, NULL, issues,
                            "there are more than the %d parameters that can be fitted",
                            SB_INFERENCE_COORDINATES);
          return false;
        }
        work->vary[work->coordinates] = k;
        work->owner[work->coordinates] = own ? (int)c : -1;
        curve->at[k] = work->coordinates++;
        shared[k] = own ? shared[k] : curve->at[k];
      } else {
        curve->at[k] = shared[k];
      }
    }
  }
  work->parameters = work->coordinates;
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    curve->zero = SIZE_MAX;
    if (curve->measured->no_load_deviation > 0) {
      const size_t before = zero_before(work, c);
      curve->zero = before != SIZE_MAX ? before : work->coordinates++;
    }
    curve->numeric = SIZE_MAX;
    if (work->tangent) {
      curve->numeric = work->coordinates;
      work->coordinates += SB_CALIBRATE_NUMERIC;
    }
    curve->first = work->residuals;
    work->residuals += curve->points + curve->breakaway;
  }
  return true;
}

double sb_calibrate_variate(const SbDistribution *of, double value) {
  if (of->kind == SB_DISTRIBUTION_NORMAL) {
    return fmin(fmax((value - of->a) / of->b, -3), 3);
  }
  const double p = of->kind == SB_DISTRIBUTION_UNIFORM ? (value - of->a) / (of->b - of->a)
                                                       : log(value / of->a) / log(of->b / of->a);
  return p > 0.001 && p < 0.999 ? sb_normal_quantile(p) : 0;
}

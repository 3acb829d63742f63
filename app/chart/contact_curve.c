// See contact_curve.h.
#include "app/chart/contact_curve.h"

#include "engine/film/film.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { SCHEMATIC_POINTS = 97 };

bool sb_contact_touches(const SbSealFrame *seal) {
  return seal && seal->contact_right > seal->contact_left && seal->load > 0;
}

static void schematic(SbContactCurve *out, const SbSealFrame *seal, const SbModel *model,
                      int index) {
  out->count = SCHEMATIC_POINTS;
  double half = 0.5 * (seal->contact_right - seal->contact_left);
  double middle = 0.5 * (seal->contact_right + seal->contact_left);
  double radius = model ? sb_model_seal(model, index)->radius : 0.8e-3;
  for (int i = 0; i < SCHEMATIC_POINTS; i++) {
    double xi = -1.6 + 3.2 * i / (SCHEMATIC_POINTS - 1);
    double inside = fmax(1 - xi * xi, 0),
           side = xi < 0 ? sb_seal_step_left(seal) : sb_seal_step_right(seal);
    out->x[i] = middle + xi * half;
    out->pressure[i] = fabs(xi) < 1 ? fmax(seal->pressure_peak * sqrt(inside), side) : side;
    out->film[i] = seal->film_central > 0
                       ? seal->film_central + half * half / fmax(radius, 1e-6) * sb_film_dry_gap(xi)
                       : 0;
  }
}

void sb_contact_curve_init(SbContactCurve *out, const SbChartRun *run, const SbSealFrame *seal,
                           int index) {
  const SbContactProfile *kept = run->profile ? run->profile(run->source, seal->profile) : NULL;
  size_t capacity = kept && kept->count > 1 ? kept->count : SCHEMATIC_POINTS;
  out->x = g_new0(double, 4 * capacity);
  out->pressure = out->x + capacity;
  out->film = out->x + 2 * capacity;
  out->asperity = out->x + 3 * capacity;
  out->asperities = false;
  out->model = NULL;
  if (kept && kept->count > 1) {
    out->count = kept->count;
    out->model = kept->model;
    memcpy(out->x, kept->x, kept->count * sizeof(double));
    memcpy(out->pressure, kept->pressure, kept->count * sizeof(double));
    memcpy(out->film, kept->film, kept->count * sizeof(double));
    for (size_t i = 0; kept->asperity_pressure && i < kept->count; i++) {
      out->asperity[i] = kept->asperity_pressure[i];
      out->asperities = out->asperities || out->asperity[i] > 0;
    }
  } else {
    schematic(out, seal, run->model, index);
  }
}

void sb_contact_curve_finish(SbContactCurve *curve) {
  g_free(curve->x);
}

void sb_contact_curve_extend(const SbContactCurve *curve, const SbSealFrame *seal, double *left,
                             double *right) {
  double slack = 2e-3 * seal->pressure_peak;
  for (size_t i = curve->count; i-- > 0;) {
    if (curve->x[i] < *left) {
      if (curve->pressure[i] <= sb_seal_step_left(seal) + slack) {
        break;
      }
      *left = curve->x[i];
    }
  }
  for (size_t i = 0; i < curve->count; i++) {
    if (curve->x[i] > *right) {
      if (curve->pressure[i] <= sb_seal_step_right(seal) + slack) {
        break;
      }
      *right = curve->x[i];
    }
  }
}

double sb_contact_curve_at(const SbContactCurve *curve, const double *value, double x) {
  for (size_t i = 1; i < curve->count; i++) {
    if (curve->x[i] >= x) {
      double d = curve->x[i] - curve->x[i - 1];
      double t = d > 0 ? (x - curve->x[i - 1]) / d : 1;
      return value[i - 1] + CLAMP(t, 0, 1) * (value[i] - value[i - 1]);
    }
  }
  return curve->count > 0 ? value[curve->count - 1] : 0;
}

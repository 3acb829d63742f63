// Bands of the model's loops before and after a calibration; see calibrate_private.h.
#include "app/study/calibrate_private.h"

#include "app/base/number.h"

#include <math.h>
#include <stdlib.h>

typedef SbCalibrateWork Work;

enum { BAND_DRAWS = 60 };

// Forces of the runs at one place of every curve: [curve][way][piece][draw].
static size_t draw_place(size_t curve, int way, int piece) {
  return ((curve * 2 + (size_t)way) * SB_MEASURED_BAND + (size_t)piece) * BAND_DRAWS;
}

static void take_draw(double *force, const Work *work, const SbMeasuredBand *band, size_t draw) {
  for (size_t c = 0; c < work->curves; c++) {
    for (int way = 0; way < 2; way++) {
      for (int piece = 0; piece < SB_MEASURED_BAND; piece++) {
        const double s = band[c].end * (piece + 0.5) / SB_MEASURED_BAND;
        force[draw_place(c, way, piece) + draw] = sb_loop_force(&work->curve[c].loop, way, s);
      }
    }
  }
}

// What holds 95 % of the draws; NaN where half of them have no force.
static void find_bands(SbMeasuredBand *band, const Work *work, double *force, size_t draws) {
  for (size_t c = 0; c < work->curves; c++) {
    for (int i = 0; i < 2 * SB_MEASURED_BAND; i++) {
      const int way = i / SB_MEASURED_BAND, piece = i % SB_MEASURED_BAND;
      double *of = force + draw_place(c, way, piece);
      size_t count = 0;
      for (size_t k = 0; k < draws; k++) {
        if (isfinite(of[k])) {
          of[count++] = of[k];
        }
      }
      qsort(of, count, sizeof *of, sb_number_compare);
      const size_t cut = count / 40;
      double *pair = band[c].force[way][piece];
      pair[0] = 2 * count > draws ? of[cut] : NAN;
      pair[1] = 2 * count > draws ? of[count - 1 - cut] : NAN;
    }
  }
}

// How far the solved residuals at z lie from those of the tangent, to the sums.
static void add_tangent(double *square, double *count, const Work *work, const SbInference *found,
                        const double *residual, const double *z) {
  const size_t n = work->coordinates;
  for (size_t c = 0; c < work->curves; c++) {
    const SbCalibrateCurve *curve = &work->curve[c];
    for (size_t i = curve->first; i < curve->first + curve->points; i++) {
      double linear = found->residual[i];
      for (size_t j = 0; j < n; j++) {
        linear += found->jacobian[i * n + j] * (z[j] - found->z[j]);
      }
      *square += (residual[i] - linear) * (residual[i] - linear);
      ++*count;
    }
  }
}

bool sb_calibrate_draws(SbCalibration *out, Work *work, const SbInference *found, bool prior) {
  const size_t draws = out->tangent ? SB_CALIBRATION_CHECKS : BAND_DRAWS;
  const size_t n = work->coordinates;
  g_autofree double *force = g_new(double, draw_place(work->curves, 0, 0));
  g_autofree double *residual = g_new(double, work->residuals + 1);
  double square = 0, count = 0;
  g_autofree SbMeasuredBand *band = g_new(SbMeasuredBand, work->curves);
  for (size_t c = 0; c < work->curves; c++) {
    band[c].end = 0;
    for (size_t i = 0; i < work->curve[c].points; i++) {
      band[c].end = fmax(band[c].end, work->curve[c].point[i].displacement);
    }
  }
  bool good = true;
  for (size_t k = 0; k < draws && good; k++) {
    double z[SB_INFERENCE_COORDINATES] = {0};
    for (size_t j = 0; j < n; j++) {
      z[j] = prior ? sb_normal_quantile(sb_random(work->study->seed + 1, k, (uint32_t)j))
                   : found->sample[k * found->samples / draws * n + j];
    }
    good = sb_calibrate_evaluate(work, residual, z);
    take_draw(force, work, band, k);
    if (good && out->tangent && !prior) {
      add_tangent(&square, &count, work, found, residual, z);
    }
  }
  if (good) {
    find_bands(band, work, force, draws);
    for (size_t c = 0; c < work->curves; c++) {
      *(prior ? &out->curve[c].prior : &out->curve[c].posterior) = band[c];
    }
  }
  if (out->tangent && !prior) {
    out->check_rms = sqrt(square / count);
  }
  return good;
}

// The loop is written down branch by branch with the figures of the target picture: break-away
// 28.7 N, 27.4 N, 22.5 N after the land edge, stop 35 N, return 6.5 N and 1.6 N. Profiles are
// rounded parabolas with a step of fluid pressure.
#include "tests/app/synthetic.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static const SbContactProfile *profile(const void *source, uint32_t index) {
  const Synthetic *run = source;
  return index < 2 ? &run->profile[index] : NULL;
}

static void make_profile(Synthetic *run, int seal) {
  const double left = seal == SB_OUTER ? -0.18e-3 : -0.278e-3;
  const double right = seal == SB_OUTER ? 0.56e-3 : 0.282e-3;
  const double peak = seal == SB_OUTER ? 1.18e6 : 0.58e6, fluid = seal == SB_OUTER ? 0.55e6 : 0;
  const double film = seal == SB_OUTER ? 0.82e-9 : 1.00e-9;
  for (int i = 0; i <= 200; i++) {
    double x = -1.0e-3 + 2.0e-3 * i / 200, mid = 0.5 * (left + right), half = 0.5 * (right - left);
    double u = (x - mid) / half, inside = fmax(1 - u * u, 0);
    double p = peak * pow(inside, 0.45);
    run->x[seal][i] = x;
    run->pressure[seal][i] = x < left || (u < 0 && p < fluid) ? (x > right ? 0 : fluid) : p;
    double gap = fmax(fabs(u) - 1, 0) * half;
    run->film[seal][i] = film * (u > 0.9 && u < 1 ? 0.80 : 1) + 0.9 * pow(gap / 0.8e-3, 1.5) * 1e-4;
  }
  run->profile[seal] = (SbContactProfile){.count = 201,
                                          .x = run->x[seal],
                                          .pressure = run->pressure[seal],
                                          .film = run->film[seal],
                                          .asperity_pressure = NULL,
                                          .model = "synthetic",
                                          .film_model = "synthetic"};
}

static void seal_frame(SbFrame *f, int seal, bool slides, double friction) {
  SbSealFrame *s = &f->seal[seal];
  *s = (SbSealFrame){.land_fraction = 1, .profile = (uint32_t)seal};
  s->pressure_left = seal == SB_OUTER ? 0.55e6F : 0;
  s->contact_left = seal == SB_OUTER ? -0.18e-3 : -0.278e-3;
  s->contact_right = seal == SB_OUTER ? 0.56e-3 : 0.282e-3;
  s->load = seal == SB_OUTER ? 11.9 : 3.4;
  s->pressure_peak = seal == SB_OUTER ? 1.18e6 : 0.58e6;
  s->film_central = slides ? (seal == SB_OUTER ? 0.82e-9 : 1.0e-9) : 0;
  s->film_min = 0.8 * s->film_central;
  s->lambda = s->film_central / 1e-6;
  s->friction = friction;
  s->friction_boundary = 0.98 * friction;
  s->friction_viscous = 0.02 * friction;
}

static void open_inner(SbFrame *f) {
  SbSealFrame *s = &f->seal[SB_INNER];
  *s = (SbSealFrame){.land_fraction = 0, .pressure_left = 0.55e6F, .pressure_right = 0.55e6F};
}

void synthetic_init(Synthetic *out, size_t frames, double scale) {
  memset(out, 0, sizeof *out);
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_model_create(&out->model, &params, NULL, NULL, NULL), ==, SB_OK);
  make_profile(out, SB_OUTER);
  make_profile(out, SB_INNER);

  const double v = 20e-3 / 60, k = 100e3, p = 14.5;
  const double both = p + 12.9 * scale, one = p + 8.0 * scale, peak = p + 14.2 * scale;
  const double back_one = p - 8.0 * scale, back_both = p - 12.9 * scale;
  const double stroke = 6.6e-3, edge = 3.3e-3, top = 35;
  // Times of the events A, B, C, D, top, E, F, rest, end.
  double t[9];
  t[0] = 0;
  t[1] = t[0] + peak / k / v;
  t[2] = t[1] + edge / v;
  t[3] = t[2] + (stroke - edge) / v;
  t[4] = t[3] + (top - one) / k / v;
  t[5] = t[4] + (top - back_one) / k / v + 0.5;
  t[6] = t[5] + (stroke - edge) / v;
  t[7] = t[6] + edge / v;
  t[8] = t[7] + fmax(back_both, 0) / k / v;

  out->frames = g_new0(SbFrame, frames + 16);
  out->frames[0].pressure_force = p;
  seal_frame(&out->frames[0], SB_OUTER, false, 0);
  seal_frame(&out->frames[0], SB_INNER, false, 0);
  size_t n = 1;
  for (int phase = 0; phase < 8; phase++) {
    size_t steps = MAX((size_t)((double)frames * (t[phase + 1] - t[phase]) / t[8]), 4);
    if (n + steps > frames + 15) {
      steps = frames + 15 - n;
    }
    for (size_t i = 0; i < steps; i++) {
      // The last frame of a phase sits on its closing event.
      double u = (double)(i + 1) / (double)steps, time = t[phase] + u * (t[phase + 1] - t[phase]);
      SbFrame *f = &out->frames[n];
      *f = (SbFrame){.time = time, .pressure_force = p, .velocity = 0};
      double moved = v * (time - t[phase]);
      switch (phase) {
      case 0:
        f->stage = SB_STAGE_A;
        f->force = k * v * time;
        break;
      case 1:
        f->stage = SB_STAGE_B;
        f->displacement = moved;
        f->force = both + (peak - both) * exp(-moved / 4e-6);
        f->velocity = v;
        break;
      case 2:
        f->stage = SB_STAGE_C;
        f->displacement = edge + moved;
        f->force = one + (both - one) * fmax(1 - moved / 40e-6, 0);
        f->velocity = v;
        break;
      case 3:
        f->stage = SB_STAGE_D;
        f->displacement = stroke;
        f->force = one + k * moved;
        break;
      case 4:
        f->stage = SB_STAGE_D;
        f->displacement = stroke;
        f->force = fmax(top - k * moved, back_one);
        break;
      case 5:
        f->stage = SB_STAGE_E;
        f->displacement = stroke - moved;
        f->force = back_one;
        f->velocity = -v;
        break;
      case 6:
        f->stage = SB_STAGE_F;
        f->displacement = edge - moved;
        f->force = back_both;
        f->velocity = -v;
        break;
      default:
        f->stage = SB_STAGE_F;
        f->displacement = 0;
        f->force = back_both * (1 - u);
        break;
      }
      f->on_event = i + 1 == steps && phase != 3 && phase < 6;
      bool slides = f->velocity != 0;
      double sign = phase < 4 ? 1 : -1;
      seal_frame(f, SB_OUTER, slides, sign * 8.0 * scale);
      seal_frame(f, SB_INNER, slides, sign * 4.9 * scale);
      if (phase >= 2 && phase <= 5) {
        open_inner(f);
      }
      n++;
    }
  }
  out->count = n;
  out->trace = sb_trace_create(out->model);
  sb_trace_extend(out->trace, out->frames, n, 0);

  SbSummary *s = &out->summary;
  s->status = SB_OK;
  s->converged = true;
  s->force_peak = top;
  s->force_breakaway = peak;
  s->force_press = peak;
  s->force_return_min = s->force_return_margin = back_both;
  s->returns = back_both > 0;
  s->outcome = s->returns ? SB_OUTCOME_RETURNED : SB_OUTCOME_STUCK;
  s->duration = t[8];
  memcpy(s->stage, sb_trace_marks(out->trace), sizeof s->stage);
  s->energy.loop = 0.138 * scale;
  s->energy.closure = 2e-4;
  s->frames = n;
  s->error_force = s->error_energy = NAN;
  s->error_film = 3e-3;
  s->error_load = 1.7e-3;
  s->wall_s = 0.38;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    s->seal[i].film_central = i == SB_OUTER ? 0.82e-9 : 1.0e-9;
    s->seal[i].film_min = i == SB_OUTER ? 0.66e-9 : 0.79e-9;
    s->seal[i].lambda = 1e-3 * s->seal[i].film_central / 1e-9;
  }
  sb_warn(&s->warnings, "film-below-continuum", sb_input(SB_P_FLUID_VISCOSITY),
          "film 0.66 nm is below the continuum limit, about 2 nm: formal result");
  sb_warn(&s->warnings, "boundary-regime", 0, "\xce\xbb = 0.001, boundary regime");
}

void synthetic_clear(Synthetic *run) {
  g_free(run->frames);
  sb_model_destroy(run->model);
  sb_trace_destroy(run->trace);
}

void synthetic_data(SbChartData *out, const Synthetic *run, double time) {
  *out = (SbChartData){.title = "Piston valve, one actuation",
                       .subtitle = "piston.valve  \xc2\xb7  thesis-cycle.scene",
                       .hash = "4f21c09a77"};
  out->run = (SbChartRun){.state = SB_CHART_DONE,
                          .frames = run->frames,
                          .count = run->count,
                          .trace = run->trace,
                          .model = run->model,
                          .summary = &run->summary,
                          .profile = profile,
                          .source = run};
  while (out->playhead + 1 < run->count && run->frames[out->playhead + 1].time <= time) {
    out->playhead++;
  }
}

// Too little squeeze leaks: pressure of the rubber on the bore, leak at rest and leakage per stroke
// over the squeeze, at the canister's pressure on the outer seal and at a tenth of it.
//
// Leak at rest by percolation and the critical constriction (leak/percolation.h): nil while the
// rubber's own mean pressure, net load over width, is above the closing pressure of the roughness.
// A ring seals by itself the better the higher the pressure, so the low one is the one that leaks.
// Leakage per stroke: what the film carries out, q = pi D h L/2 (leak/stroke.h). As in the study of
// the squeeze the bore moves and the groove floor stays. The scene's fitment model is set beside
// the disc and the ring: Karaszkiewicz' mean pressure does not vanish with the squeeze, so that
// model never leaks at rest and cannot show this.
#include "engine/contact/rough/percolation.h"
#include "engine/film/stroke.h"
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS = 39, RING_POINTS = 20, FINE = 9 };

double sb_study_leak_cost(const SbModel *model) {
  double film = sb_cost_film(model->film);
  return 2 * (2 * (RING_POINTS + FINE) + 11) * SB_COST_RING + POINTS * SB_COST_DISC +
         5 * POINTS * film;
}

typedef struct {
  double pressure, leak, stroke;
} Figures;

static SbStatus solve(SbStudy *out, Figures *figures, const SbModel *scene, SbFitModel fit,
                      double squeeze, SbSealPressure pressure, const SbSpectrum *spectrum,
                      SbSlidingMemory *memory, SbReport *report) {
  SbModel model = *scene;
  double floor = model.bore_diameter - 2 * model.radial_space;
  model.fit = fit;
  model.radial_space = model.seal[SB_OUTER].section_diameter * (1 - squeeze);
  model.bore_diameter = floor + 2 * model.radial_space;
  model.bore_circumference = M_PI * model.bore_diameter;
  *figures = (Figures){NAN, NAN, NAN};
  sb_sliding_memory_forget(memory);
  // Finer than the roughness theory deserves; a ring that barely touches is costly.
  model.tolerance = fmax(model.tolerance, fit == SB_FIT_RING ? 1e-2 : 1e-3);
  // A ring that does not touch by itself lets the fluid past before any pressure could press it on.
  SbSliding free;
  SbStatus touch =
      sb_study_sliding(out, &free, &model, SB_OUTER, (SbSealPressure){0, 0}, 0, memory, report);
  if (touch != SB_OK || !(free.contact_right > free.contact_left)) {
    return touch;
  }
  // At rest first: where the film has no solution the contact still has one.
  SbSliding state, moving = {0};
  SbStatus status = sb_study_sliding(out, &state, &model, SB_OUTER, pressure, 0, memory, report);
  if (status == SB_OK && state.contact_right > state.contact_left && state.load_net > 0) {
    status =
        sb_study_sliding(out, &moving, &model, SB_OUTER, pressure, model.speed, memory, report);
  }
  if (status != SB_OK || isnan(state.load)) {
    return status;
  }
  double width = state.contact_right - state.contact_left;
  if (!(width > 0)) {
    return SB_OK; // no contact, no seal: no leak by roughness can be told
  }
  figures->pressure = fmax(state.load_net, 0) / width;
  figures->stroke = moving.film_central > 0
                        ? sb_leak_stroke(model.bore_diameter, moving.film_central, model.stroke)
                        : NAN;
  SbPercolationProblem problem = {
      .spectrum = spectrum,
      .modulus = model.seal[SB_OUTER].reduced_modulus,
      .contact_pressure = figures->pressure,
      .viscosity = model.viscosity,
      .pressure_drop = fabs(pressure.left - pressure.right),
      .width = width,
      .circumference = model.bore_circumference,
  };
  SbPercolation leak;
  status = sb_percolation_solve(&leak, &problem, report);
  // A constriction wider than this is an open gap, not a contact with channels.
  if (status == SB_OK && leak.constriction_gap < SB_PERCOLATION_OPEN_GAP * model.sigma) {
    figures->leak = leak.leak_rate;
  }
  return status;
}

// What a curve of pressure says: where the ring touches and where channels open.
static void tell(SbStudy *out, const SbStudySeries *series, double closing) {
  double touches = NAN, closes = NAN;
  for (size_t i = 0; i < series->count; i++) {
    bool known = isfinite(series->y[i]);
    touches = known && isnan(touches) ? series->x[i] : touches;
    if (known && series->y[i] >= closing && isnan(closes)) {
      closes = series->x[i];
      // On a straight line from the point before, if that had a value.
      if (i > 0 && series->y[i - 1] < closing) {
        double share = (closing - series->y[i - 1]) / (series->y[i] - series->y[i - 1]);
        closes = series->x[i - 1] + share * (series->x[i] - series->x[i - 1]);
      }
    }
  }
  if (isnan(touches)) {
    sb_study_note(out, "%s: does not touch in this range.", series->name);
  } else if (isnan(closes)) {
    sb_study_note(out, "%s: leaks at rest over the whole range.", series->name);
  } else if (closes > touches) {
    sb_study_note(out, "%s: touches from %.1f %% of squeeze, closed from %.1f %%.", series->name,
                  100 * touches, 100 * closes);
  } else if (touches > series->x[0]) {
    sb_study_note(out, "%s: touches from %.1f %% of squeeze and is closed as soon as it touches.",
                  series->name, 100 * touches);
  } else {
    sb_study_note(out, "%s: closed over the whole range.", series->name);
  }
}

// One curve: a fitment model at a share of the canister's pressure.
typedef struct {
  SbFitModel fit;
  double share;
} Line;

enum { LINES = 5 };

// The scene's own model first, then disc and ring, each once; the scene's and the ring at a tenth
// of the pressure too.
static int choose_lines(Line *line, const SbModel *model) {
  SbFitModel own = model->fit;
  int count = 0;
  line[count++] = (Line){own, 1};
  if (own != SB_FIT_DISC) {
    line[count++] = (Line){SB_FIT_DISC, 1};
  }
  if (own != SB_FIT_RING) {
    line[count++] = (Line){SB_FIT_RING, 1};
    line[count++] = (Line){own, 0.1};
  }
  line[count++] = (Line){SB_FIT_RING, 0.1};
  return count;
}

static double line_cost(const Line *line) {
  return line->fit == SB_FIT_RING ? RING_POINTS * SB_COST_RING : POINTS * SB_COST_DISC;
}

static void line_name(char *name, size_t size, const Line *line, const SbModel *model) {
  sb_text(name, size, "%s, %.2g MPa", sb_fit_model_name(line->fit),
          line->share * model->canister_pressure * 1e-6);
}

// Everything that one study of the leak needs at hand.
typedef struct {
  SbStudy *out;
  const SbModel *model;
  const SbSpectrum *spectrum;
  SbSlidingMemory *memory;
  const SbStudyHooks *hooks;
  const Line *line;
  int count;
} Leak;

static SbSealPressure across(const SbModel *model, double share) {
  return (SbSealPressure){model->canister_pressure * share, 0};
}

// Solves points `first` to `first + count` of a curve; the progress goes from `begun` on by
// `share`.
static SbStatus solve_points(const Leak *leak, const Line *line, const double *at, Figures *figures,
                             int first, int count, double begun, double share, SbReport *report) {
  SbStatus status = SB_OK;
  for (int i = 0; status == SB_OK && i < count; i++) {
    status = solve(leak->out, &figures[first + i], leak->model, line->fit, at[first + i],
                   across(leak->model, line->share), leak->spectrum, leak->memory, report);
    if (status == SB_OK) {
      status = sb_study_step(leak->hooks, begun + share * (i + 1) / count, report);
    }
  }
  return status;
}

// Between which squeezes a ring begins to touch and its channels to close; false if it is closed
// over the whole range or never.
static bool find_opening(double *from, double *to, const double *at, const Figures *figures,
                         int count, double closing) {
  for (int i = 0; i < count; i++) {
    if (figures[i].pressure >= closing) {
      *to = at[i];
      int k = i;
      while (k > 0 && figures[k - 1].pressure > 0) {
        k--;
      }
      *from = k > 0 ? at[k - 1] : at[0];
      return i > 0;
    }
  }
  return false;
}

// Into the series, by rising squeeze.
static void put_points(SbStudySeries *p, SbStudySeries *q, SbStudySeries *v, const double *at,
                       const Figures *figures, int count) {
  double last = -INFINITY;
  for (int n = 0; n < count; n++) {
    int next = -1;
    for (int i = 0; i < count; i++) {
      if (at[i] > last + 1e-9 && (next < 0 || at[i] < at[next])) {
        next = i;
      }
    }
    if (next < 0) {
      return;
    }
    last = at[next];
    sb_study_point(p, last, figures[next].pressure);
    sb_study_point(q, last, figures[next].leak > 0 ? figures[next].leak : NAN);
    sb_study_point(v, last, figures[next].stroke);
  }
}

static SbStatus draw(const Leak *leak, double closing, SbReport *report) {
  SbStudy *out = leak->out;
  SbStudyPanel *pressure =
      sb_study_panel(out, "pressure of the rubber on the bore", "Pa", "MPa", false);
  SbStudyPanel *rest = sb_study_panel(out, "leak at rest", "m3/s", "\xc2\xb5l/h", true);
  SbStudyPanel *stroke = sb_study_panel(out, "carried out per stroke", "m3", "nl", false);
  sb_text(rest->empty, sizeof rest->empty, "no leak: every contact is closed");
  double lo = leak->model->study.squeeze_min, hi = leak->model->study.squeeze_max;
  double total = 0, done = 0;
  for (int m = 0; m < leak->count; m++) {
    total += line_cost(&leak->line[m]);
  }
  SbStatus status = SB_OK;
  for (int m = 0; status == SB_OK && m < leak->count; m++) {
    const Line *line = &leak->line[m];
    char name[40];
    line_name(name, sizeof name, line, leak->model);
    SbStudySeries *p = sb_study_series(pressure, SB_STUDY_CURVE, "%s", name);
    SbStudySeries *q = sb_study_series(rest, SB_STUDY_CURVE, "%s", name);
    SbStudySeries *v = sb_study_series(stroke, SB_STUDY_CURVE, "%s", name);
    double at[POINTS + FINE];
    Figures figures[POINTS + FINE];
    int points = line->fit == SB_FIT_RING ? RING_POINTS : POINTS;
    for (int i = 0; i < points; i++) {
      at[i] = lo + (hi - lo) * i / (points - 1.0);
    }
    status = solve_points(leak, line, at, figures, 0, points, 0.7 * done / total,
                          0.5 * line_cost(line) / total, report);
    // Once more where it begins to touch and to close: the leak lies between.
    double from, to;
    if (status == SB_OK && find_opening(&from, &to, at, figures, points, closing)) {
      for (int i = 0; i < FINE; i++) {
        at[points + i] = from + (to - from) * (i + 1.0) / (FINE + 1);
      }
      status = solve_points(leak, line, at, figures, points, FINE,
                            0.7 * (done + 0.7 * line_cost(line)) / total,
                            0.2 * line_cost(line) / total, report);
      points += FINE;
    }
    done += line_cost(line);
    put_points(p, q, v, at, figures, points);
    tell(out, p, closing);
  }
  SbStudySeries *limit = sb_study_series(pressure, SB_STUDY_REFERENCE, "channels close");
  sb_study_point(limit, lo, closing);
  sb_study_point(limit, hi, closing);
  return status;
}

// Rows by squeeze at the canister's pressure, then by pressure as designed; the lines at full
// pressure are the columns.
static SbStatus table(const Leak *leak, SbReport *report) {
  double design = leak->model->seal[SB_OUTER].squeeze;
  const struct {
    double squeeze, share;
  } rows[] = {{0.022, 1},  {0.05, 1},   {0.07, 1},    {0.10, 1},   {design, 1},  {0.20, 1},
              {0.05, 0.1}, {0.07, 0.1}, {0.075, 0.1}, {0.10, 0.1}, {design, 0.1}};
  enum { ROWS = sizeof rows / sizeof rows[0] };
  SbStudy *out = leak->out;
  sb_text(out->row_heading, sizeof out->row_heading, "squeeze, pressure");
  for (int m = 0; m < leak->count; m++) {
    if (leak->line[m].share < 1) {
      continue;
    }
    static const char *const quantity[] = {"pressure", "leak at rest", "per stroke"};
    static const char *const unit[][2] = {{"Pa", "MPa"}, {"m3/s", "\xc2\xb5l/h"}, {"m3", "nl"}};
    for (int q = 0; q < 3; q++) {
      char text[40];
      sb_text(text, sizeof text, "%s %s", quantity[q], sb_fit_model_name(leak->line[m].fit));
      sb_study_column(out, text, unit[q][0], unit[q][1]);
    }
  }
  SbStatus status = SB_OK;
  for (int r = 0; status == SB_OK && r < ROWS; r++) {
    double s = rows[r].squeeze;
    SbSealPressure pressure = across(leak->model, rows[r].share);
    SbStudyRow *row =
        sb_study_row(out, NULL, NULL, "%.3g %%, %.2g MPa", 100 * s, pressure.left * 1e-6);
    int column = 0;
    for (int m = 0; status == SB_OK && m < leak->count; m++) {
      if (leak->line[m].share < 1) {
        continue;
      }
      Figures f;
      status = solve(out, &f, leak->model, leak->line[m].fit, s, pressure, leak->spectrum,
                     leak->memory, report);
      row->value[column++] = f.pressure;
      row->value[column++] = f.leak;
      row->value[column++] = f.stroke;
    }
    if (status == SB_OK) {
      status = sb_study_step(leak->hooks, 0.7 + 0.3 * (r + 1) / ROWS, report);
    }
  }
  return status;
}

SbStatus sb_study_leak(SbStudy *out, const SbModel *model, const SbStudyHooks *hooks,
                       SbReport *report) {
  SbSpectrum spectrum;
  SbStatus status = sb_spectrum_from_asperities(&spectrum, model->sigma, model->sigma_over_beta,
                                                model->gt_product, report);
  // Where channels close does not depend on the contact: any will do.
  SbPercolation closed = {0};
  SbPercolationProblem any = {.spectrum = &spectrum,
                              .modulus = model->seal[SB_OUTER].reduced_modulus,
                              .viscosity = model->viscosity,
                              .width = 1,
                              .circumference = 1,
                              .contact_pressure = 1e9};
  if (status == SB_OK) {
    status = sb_percolation_solve(&closed, &any, report);
  }
  SbSlidingMemory *memory = NULL;
  if (status == SB_OK) {
    status = sb_sliding_memory_create(&memory, report);
  }
  Line line[LINES];
  Leak leak = {out, model, &spectrum, memory, hooks, line, choose_lines(line, model)};
  if (status == SB_OK) {
    sb_study_axis(&out->x, "squeeze of the free section", "1", "%", false);
    status = draw(&leak, closed.closing_pressure, report);
  }
  if (status == SB_OK) {
    status = table(&leak, report);
  }
  sb_sliding_memory_destroy(memory);
  if (status != SB_OK) {
    return status;
  }
  double design = model->seal[SB_OUTER].squeeze;
  sb_study_mark(out, design, "as designed, %.1f %%", 100 * design);
  bool own = model->fit != SB_FIT_DISC && model->fit != SB_FIT_RING;
  sb_text(out->models, sizeof out->models,
          "fit %s%sdisc, ring; percolation by Persson's contact; film as the scene's",
          own ? sb_fit_model_name(model->fit) : "", own ? ", " : "");
  sb_text(out->validity, sizeof out->validity,
          "mean contact pressure, liquid without vapour; gaps below 3 "
          "\xcf\x83; no figure where the ring does not touch by itself");
  sb_study_note(out,
                "Roughness %.3g \xc2\xb5m; channels close at %.3g MPa of solid pressure. Stroke "
                "%.3g mm at %.4g mm/s. Karaszkiewicz holds from 7 to 25 %%.",
                model->sigma * 1e6, closed.closing_pressure * 1e-6, model->stroke * 1e3,
                model->speed * 1e3);
  return SB_OK;
}

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
#include "engine/valve/studies/study_private.h"

#include <math.h>

enum { POINTS = 39, RING_POINTS = 20, FINE = 9, ROWS = 11 };

double sb_study_leak_cost(const SbModel *model) {
  double film = sb_cost_film(model->film);
  return 2 * (2 * (RING_POINTS + FINE) + 11) * SB_COST_RING + POINTS * SB_COST_DISC +
         5 * POINTS * film;
}

typedef struct {
  double pressure, leak, stroke;
} Figures;

// One curve: a fitment model at a share of the canister's pressure.
typedef struct {
  SbFitModel fit;
  double share;
} Line;

static Figures solve(SbStudyWork *work, const Line *line, double squeeze) {
  static const char *const paths[] = {"seals.outer.leakage_static_m3_per_s",
                                      "seals.outer.leakage_per_stroke_m3"};
  static const char *const width[] = {"seals.outer.contact_width_m"};
  enum { COUNT = SB_STUDY_SQUEEZED + 3 };
  SbOverride override[COUNT];
  sb_study_squeezed(override, work, squeeze);
  override[3] = (SbOverride){SB_P_MODELS_FIT, line->fit};
  // Finer than the roughness theory deserves; a ring that barely touches is costly.
  override[4] = (SbOverride){SB_P_OUTPUT_TOLERANCE,
                             fmax(work->scene->tolerance, line->fit == SB_FIT_RING ? 1e-2 : 1e-3)};
  // A ring that does not touch by itself lets the fluid past before any pressure could press it on.
  override[5] = (SbOverride){SB_P_CANISTER_PRESSURE, 0};
  double free, value[2] = {NAN, NAN};
  sb_study_ask(work, &free, width, 1, override, COUNT);
  if (!(free > 0)) {
    return (Figures){NAN, NAN, NAN};
  }
  override[5].value = line->share * work->scene->canister_pressure;
  sb_study_ask(work, value, paths, 2, override, COUNT);
  const SbSummary *summary = sb_evaluator_summary(work->evaluator);
  double pressure = summary != NULL ? summary->seal[SB_OUTER].contact_pressure : NAN;
  return (Figures){isnan(pressure) ? NAN : fmax(pressure, 0), value[0], value[1]};
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

static int points_of(const Line *line) {
  return line->fit == SB_FIT_RING ? RING_POINTS : POINTS;
}

static void line_name(char *name, size_t size, const Line *line, const SbModel *model) {
  sb_text(name, size, "%s, %.2g MPa", sb_fit_model_name(line->fit),
          line->share * model->canister_pressure * 1e-6);
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
static void put_points(SbStudy *out, const double *at, const Figures *figures, int count) {
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
    const Figures *f = &figures[next];
    sb_study_put(out, last, (const double[]){f->pressure, f->leak > 0 ? f->leak : NAN, f->stroke});
  }
}

static void draw(SbStudyWork *work, const Line *lines, int count, double closing) {
  SbStudy *out = work->out;
  SbStudyPanel *pressure =
      sb_study_panel(out, "pressure of the rubber on the bore", "Pa", "MPa", false);
  SbStudyPanel *rest = sb_study_panel(out, "leak at rest", "m3/s", "\xc2\xb5l/h", true);
  sb_study_panel(out, "carried out per stroke", "m3", "nl", false);
  sb_text(rest->empty, sizeof rest->empty, "no leak: every contact is closed");
  double lo = work->scene->study.squeeze_min, hi = work->scene->study.squeeze_max;
  for (const Line *line = lines; line < lines + count; line++) {
    char name[40];
    line_name(name, sizeof name, line, work->scene);
    sb_study_curve(out, SB_STUDY_CURVE, name);
    double at[POINTS + FINE];
    Figures figures[POINTS + FINE];
    int points = points_of(line);
    for (int i = 0; i < points; i++) {
      at[i] = lo + (hi - lo) * i / (points - 1.0);
      figures[i] = solve(work, line, at[i]);
    }
    // Once more where it begins to touch and to close: the leak lies between.
    double from, to;
    if (find_opening(&from, &to, at, figures, points, closing)) {
      for (int i = 0; i < FINE; i++) {
        at[points] = from + (to - from) * (i + 1.0) / (FINE + 1);
        figures[points] = solve(work, line, at[points]);
        points++;
      }
    }
    put_points(out, at, figures, points);
    tell(out, &pressure->series[pressure->series_count - 1], closing);
  }
  SbStudySeries *limit = sb_study_series(pressure, SB_STUDY_REFERENCE, "channels close");
  sb_study_point(limit, lo, closing);
  sb_study_point(limit, hi, closing);
}

// Rows by squeeze at the canister's pressure, then by pressure as designed; the lines at full
// pressure are the columns.
static void table(SbStudyWork *work, const Line *lines, int count) {
  double design = work->scene->seal[SB_OUTER].squeeze;
  const struct {
    double squeeze, share;
  } rows[ROWS] = {{0.022, 1},  {0.05, 1},   {0.07, 1},    {0.10, 1},   {design, 1},  {0.20, 1},
                  {0.05, 0.1}, {0.07, 0.1}, {0.075, 0.1}, {0.10, 0.1}, {design, 0.1}};
  SbStudy *out = work->out;
  sb_text(out->row_heading, sizeof out->row_heading, "squeeze, pressure");
  for (int m = 0; m < count; m++) {
    if (lines[m].share < 1) {
      continue;
    }
    static const char *const quantity[] = {"pressure", "leak at rest", "per stroke"};
    static const char *const unit[][2] = {{"Pa", "MPa"}, {"m3/s", "\xc2\xb5l/h"}, {"m3", "nl"}};
    for (int q = 0; q < 3; q++) {
      char text[40];
      sb_text(text, sizeof text, "%s %s", quantity[q], sb_fit_model_name(lines[m].fit));
      sb_study_column(out, text, unit[q][0], unit[q][1]);
    }
  }
  for (int r = 0; r < ROWS; r++) {
    SbStudyRow *row = sb_study_row(out, NULL, NULL, "%.3g %%, %.2g MPa", 100 * rows[r].squeeze,
                                   rows[r].share * work->scene->canister_pressure * 1e-6);
    double *cell = row->value;
    for (const Line *line = lines; line < lines + count; line++) {
      if (line->share < 1) {
        continue;
      }
      Figures f = solve(work, &(Line){line->fit, rows[r].share}, rows[r].squeeze);
      *cell++ = f.pressure;
      *cell++ = f.leak;
      *cell++ = f.stroke;
    }
  }
}

void sb_study_leak(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  SbSpectrum spectrum;
  SbReport report;
  SbStatus status = sb_spectrum_from_asperities(&spectrum, model->sigma, model->sigma_over_beta,
                                                model->gt_product, &report);
  // Where channels close does not depend on the contact: any will do.
  SbPercolation closed = {0};
  SbPercolationProblem any = {.spectrum = &spectrum,
                              .modulus = model->seal[SB_OUTER].reduced_modulus,
                              .viscosity = model->viscosity,
                              .width = 1,
                              .circumference = 1,
                              .contact_pressure = 1e9};
  if (status == SB_OK) {
    status = sb_percolation_solve(&closed, &any, &report);
  }
  if (!sb_study_goes_on(work, status, &report)) {
    return;
  }
  sb_study_fix_outer(work);
  Line lines[LINES];
  int count = choose_lines(lines, model);
  sb_study_axis(&out->x, "squeeze of the free section", "1", "%", false);
  draw(work, lines, count, closed.closing_pressure);
  table(work, lines, count);
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
}

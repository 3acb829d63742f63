// Too little squeeze leaks: pressure of the rubber on the bore, leakage at rest and leakage per
// stroke as functions of the squeeze, at the canister's pressure on the outer seal and at a tenth
// of it.
//
// Leakage at rest by percolation and the critical constriction (contact/rough/percolation.h): zero
// while the rubber's own mean pressure, net load divided by width, is above the closing pressure of
// the roughness. A ring seals better at higher pressure, so it leaks at the low one. Leakage per
// stroke: volume carried out by the film, q = pi D h L/2 (film/laws.h). As in the study of the
// squeeze the bore changes and the groove floor does not. The scene's fit model is compared with
// disc and ring: Karaszkiewicz' mean pressure does not vanish with the squeeze, so that model never
// leaks at rest and cannot show this. The grid is assets/studies/leak.study.
#include "engine/contact/rough/percolation.h"
#include "engine/valve/studies/study_private.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <string.h>

enum {
  POINTS = SB_LEAK_POINTS,
  RING_POINTS = SB_LEAK_RING_POINTS,
  FINE = SB_LEAK_FINE,
  ROWS = SB_LEAK_ROWS,
  LINES = SB_LEAK_LINES
};
enum { PRESSURE, LEAK, STROKE, WIDTH, FIGURES = 3 };

// Lines of assets/studies/leak.study: the ring, the disc, the scene's own model, each without
// pressure, then at shares of the canister's.
enum { RING, DISC, OWN };
static const double shares[] = {1, 0.1};
enum { SHARES = 2 };

static int line_of(int fit, int share) {
  return fit * (1 + SHARES) + 1 + share;
}

static int fit_of(int line) {
  return line / (1 + SHARES);
}

static const char *name_of(const SbModel *scene, int line) {
  static const SbFitModel fits[] = {SB_FIT_RING, SB_FIT_DISC};
  return sb_fit_kind(fit_of(line) == OWN ? scene->fit : fits[fit_of(line)])->name;
}

// The fluid passes a ring without contact before any pressure could press it on.
static bool is_no_case(SbStudyWork *work, int line, double squeeze) {
  return line % (1 + SHARES) > 0 &&
         !(sb_study_at(work, line_of(fit_of(line), -1), squeeze)[WIDTH] > 0);
}

static void derive(double *value, SbStudyWork *work, int line, double squeeze) {
  (void)work, (void)line, (void)squeeze;
  value[PRESSURE] = isnan(value[PRESSURE]) ? NAN : fmax(value[PRESSURE], 0);
}

// Returns the first of `count` pressures that is at least `least`; `count`: none.
static size_t first_at_least(const double *y, size_t count, double least) {
  size_t i = 0;
  while (i < count && !(y[i] >= least)) {
    i++;
  }
  return i;
}

// Evaluates a curve of pressure: where the ring has contact and where channels open.
static void note_closing(SbStudy *out, const SbStudySeries *series, double closing) {
  const double *x = series->x, *y = series->y;
  const size_t first = first_at_least(y, series->count, 0);
  const size_t closed = first_at_least(y, series->count, closing);
  if (first == series->count) {
    sb_study_note(out, "%s: no contact in this range.", series->name);
  } else if (closed == series->count) {
    sb_study_note(out, "%s: leaks at rest over the whole range.", series->name);
  } else if (closed > first) {
    // On a straight line from the point before, which has a value.
    const double before = fmin(y[closed - 1], closing); // a gap leaves the place as it is
    const double share = (y[closed] - closing) / (y[closed] - before);
    sb_study_note(out, "%s: in contact from %.1f %% of squeeze, closed from %.1f %%.", series->name,
                  100 * x[first], 100 * (x[closed] - share * (x[closed] - x[closed - 1])));
  } else if (first > 0) {
    sb_study_note(out,
                  "%s: in contact from %.1f %% of squeeze, and closed as soon as it is in contact.",
                  series->name, 100 * x[first]);
  } else {
    sb_study_note(out, "%s: closed over the whole range.", series->name);
  }
}

#define SHARE 0.8 // of the work that the grid is, the finer places aside

// Abscissas of a line: even ones, and more between the first contact of the ring and the closing of
// its channels, where leakage changes.
static int choose_places(double at[POINTS + FINE], SbStudyWork *work, int line, double closing) {
  int even = fit_of(line) == RING ? RING_POINTS : POINTS, count = 0;
  double pressure[POINTS];
  for (int i = 0; i < even; i++) {
    at[i] = sb_study_place(work, i, even);
    pressure[i] = sb_study_at(work, line, at[i])[PRESSURE];
  }
  const int closed = (int)first_at_least(pressure, (size_t)even, closing);
  if (closed == 0 || closed == even) {
    return even;
  }
  int open = closed - 1;
  while (open > 0 && pressure[open] > 0) {
    open--;
  }
  double from = at[open], to = at[closed];
  SbStudyPlace fine[2 * FINE];
  for (int i = 0; i < FINE; i++) {
    at[even + i] = from + (to - from) * (i + 1.0) / (FINE + 1);
    fine[i] = (SbStudyPlace){line_of(fit_of(line), -1), at[even + i], NULL};
    fine[FINE + i] = (SbStudyPlace){line, at[even + i], NULL};
  }
  sb_study_more(work, fine, 2 * FINE, SHARE, 1);
  gsl_sort(at, 1, (size_t)(even + FINE));
  for (int i = 0; i < even + FINE; i++) {
    if (count == 0 || at[i] > at[count - 1] + 1e-9) {
      at[count++] = at[i];
    }
  }
  return count;
}

// A curve for each line, the scene's own model, disc and ring, each once, then the scene's and the
// ring at a tenth of the pressure too; at full pressure columns of the table.
static void draw(SbStudyWork *work, double closing) {
  static const char *const column[][2] = {
      {"pressure", "MPa"}, {SB_LABEL("leak at rest"), "\xc2\xb5l/h"}, {"per stroke", "nl"}};
  SbStudy *out = work->out;
  SbStudyPanel *pressure = &out->panel[PRESSURE], *rest = &out->panel[LEAK];
  sb_text(rest->empty, sizeof rest->empty, SB_LABEL("no leak: every contact is closed"));
  const SbFitKind *fit = sb_fit_kind(work->scene->fit);
  const int own = fit->section ? RING : fit->body ? DISC : OWN;
  const int lines[LINES] = {line_of(own, 0), line_of(DISC, 0), line_of(RING, 0), line_of(own, 1),
                            line_of(RING, 1)};
  unsigned drawn = 0;
  for (int l = 0; l < LINES; l++) {
    const int line = lines[l], share = line % (1 + SHARES) - 1;
    if ((drawn >> line & 1) != 0) {
      continue;
    }
    drawn |= 1U << line;
    const char *model = name_of(work->scene, line);
    char name[40];
    sb_text(name, sizeof name, "%s, %.2g MPa", model,
            shares[share] * work->scene->canister_pressure * 1e-6);
    double at[POINTS + FINE];
    int points = choose_places(at, work, line, closing);
    sb_study_curves(work, SB_STUDY_CURVE, name, line, at, points);
    SbStudySeries *leak = &rest->series[rest->series_count - 1];
    for (int i = 0; i < points; i++) {
      leak->y[i] = leak->y[i] > 0 ? leak->y[i] : NAN;
    }
    note_closing(out, &pressure->series[pressure->series_count - 1], closing);
    for (int q = 0; q < FIGURES && share == 0; q++) {
      char text[64];
      sb_text(text, sizeof text, "%s %s [%s]", column[q][0], model, column[q][1]);
      sb_study_column(work, text, 0, line, q);
    }
  }
  sb_study_level(work, pressure, SB_LABEL("channels close"), closing);
}

// Rows by squeeze at the canister's pressure, then at its tenth; the models at full pressure are
// the columns.
static void table(SbStudyWork *work) {
  double design = work->scene->seal[SB_OUTER].squeeze;
  const struct {
    double squeeze;
    int share;
  } rows[ROWS] = {{0.022, 0}, {0.05, 0}, {0.07, 0},  {0.10, 0}, {design, 0}, {0.20, 0},
                  {0.05, 1},  {0.07, 1}, {0.075, 1}, {0.10, 1}, {design, 1}};
  for (int r = 0; r < ROWS; r++) {
    SbStudyRow *row = sb_study_row(work->out, "%.3g %%, %.2g MPa", 100 * rows[r].squeeze,
                                   shares[rows[r].share] * work->scene->canister_pressure * 1e-6);
    sb_study_cells(row->value, work, rows[r].squeeze, rows[r].share);
  }
}

static void make(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  SbSpectrum spectrum;
  SbReport report;
  SbStatus status = sb_spectrum_from_asperities(&spectrum, model->sigma, model->sigma_over_beta,
                                                model->gt_product, &report);
  if (!sb_study_goes_on(work, status, &report)) {
    return;
  }
  const double closing =
      sb_percolation_closing_pressure(&spectrum, model->seal[SB_OUTER].reduced_modulus);
  draw(work, closing);
  table(work);
  double design = model->seal[SB_OUTER].squeeze;
  sb_study_mark(work, design, SB_LABEL("as designed") ", %.1f %%", 100 * design);
  bool own = !sb_fit_kind(model->fit)->body;
  sb_message(out->models, sizeof out->models,
             "fit %s%sdisc, ring; percolation by Persson's contact; film as the scene's",
             own ? sb_fit_kind(model->fit)->name : "", own ? ", " : "");
  sb_study_note(out,
                "Roughness %.3g \xc2\xb5m; channels close at %.3g MPa of solid pressure. Stroke "
                "%.3g mm at %.4g mm/s. Karaszkiewicz is valid from 7 to 25 %%.",
                model->sigma * 1e6, closing * 1e-6, model->stroke * 1e3, model->speed * 1e3);
}

const SbStudyDesign sb_study_leak = {
    .x = SB_QUANTITY("squeeze of the free section", "%"),
    .panel = {SB_QUANTITY("pressure of the rubber on the bore", "MPa"),
              SB_QUANTITY("leak at rest", "\xc2\xb5l/h"),
              SB_QUANTITY("carried out per stroke", "nl")},
    .logarithmic = {false, true, false},
    .range = offsetof(SbStudyRange, squeeze_min),
    .row_heading = SB_LABEL("squeeze, pressure"),
    .validity = "mean contact pressure, liquid without vapour; gaps below 3 \xcf\x83; no value "
                "where the ring has no contact without pressure",
    .grid = true,
    .share = SHARE,
    .is_no_case = is_no_case,
    .derive = derive,
    .make = make,
};

// Effects of another propellant and of the temperature on the valve: pressure force, break-away,
// return margin and dose of each propellant against the canister's temperature; where the stem
// begins to return; and the part of the change from 20 degC that each of four effects causes alone:
// the vapour pressure; the liquid's viscosity and density, which the film has; the rubber's
// modulus; the expansion of ring, radial space and bore.
//
// Every point is a complete quasi-static cycle (assets/studies/propellants.study) with the
// propellant saturated, whatever liquid the scene has. Effects are computed one at a time with all
// else as at 20 degC; the remainder of their sum is their interaction. Not modelled: swell by
// another propellant, cooling by evaporation.
//
// Solved rings, for which a cycle takes seconds, are solved at some pressures only (study.rings).
// At each, the friction (break-away and return margin without the pressure force) is compared with
// that of closed forms. A ring's load divided by E d^2 depends on its squeeze, its friction
// coefficients and p/E. The ratio is interpolated in p/E (monotone cubic, Steffen 1990), and the
// closed forms account for all other effects of temperature and propellant. Six points are closest
// where the friction of a return changes most, at p/E below 0.15. The reported error is the largest
// change when one of the inner points is omitted, so with gaps twice as wide; two more points are
// solved if it is above 10 %. Beyond the ends the ratio is constant, with a warning.
#include "engine/fluid/fluid.h"
#include "engine/valve/model/motion_kind.h"
#include "engine/valve/states/contact_law.h"
#include "engine/valve/studies/study_private.h"

#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FORCE, BREAKAWAY, RETURN, DOSE, FIGURES, MODULUS = FIGURES, STRAIN = FIGURES }; // or p/E
// A line is a fluid, and what of it is at the temperature: all, or one of the parts.
enum { ALL, PRESSURE, FILM, RUBBER, EXPANSION, PARTS, SOLVED = PARTS };
_Static_assert((int)PARTS == (int)SB_PROPELLANTS_PARTS, "other parts");
// A full cycle at 15 temperatures, every 5 degC of the default range; where it costs little 29.
enum { POINTS = SB_PROPELLANTS_POINTS, CYCLES = 15, FIRST = 6, MORE = 2, MOST = 8 };
enum { FLUIDS = SB_PROPELLANTS_FLUIDS, TABLE = SB_PROPELLANTS_TABLE };

// Propellants come first behind the fluid without figures. The grid of
// assets/studies/propellants.study has all of each.
static int line_of(int fluid, int part) {
  return part * FLUIDS + fluid - 1;
}

static int fluid_of(int line) {
  return line % FLUIDS + 1;
}

static int part_of(int line) {
  return line / FLUIDS;
}

static double of_fluid(const SbModel *scene, SbParamId id, int fluid, double T) {
  SbParams params = scene->params;
  SbParamDefault derived;
  params.given[SB_P_FLUID_NAME] = params.given[SB_P_CANISTER_TEMPERATURE] = true;
  params.value[SB_P_FLUID_NAME] = fluid;
  params.value[SB_P_CANISTER_TEMPERATURE] = T;
  sb_params_default(&derived, &params, id);
  return derived.value;
}

// Returns whether cycles with solved rings are compared with closed forms.
static bool interpolates(const SbModel *scene) {
  return sb_fit_kind(scene->fit)->section;
}

// Data of a row of an effect, or of closed forms instead of rings, in addition to the grid's
// columns.
static const SbParamId extra[] = {SB_P_CANISTER_PRESSURE,
                                  SB_P_FLUID_VISCOSITY,
                                  SB_P_FLUID_DENSITY,
                                  SB_P_SEAL_OUTER_MODULUS,
                                  SB_P_SEAL_INNER_MODULUS,
                                  SB_P_SEAL_OUTER_SECTION_DIAMETER,
                                  SB_P_SEAL_INNER_SECTION_DIAMETER,
                                  SB_P_SEAL_OUTER_INNER_DIAMETER,
                                  SB_P_SEAL_INNER_INNER_DIAMETER,
                                  SB_P_GLAND_RADIAL_SPACE,
                                  SB_P_BORE_DIAMETER,
                                  SB_P_MODELS_FIT,
                                  SB_P_MODELS_FILM,
                                  SB_P_MODELS_ASPERITIES,
                                  SB_P_MODELS_ADHESION,
                                  SB_P_MODELS_INLET,
                                  SB_P_MODELS_FILM_TIME,
                                  SB_P_MODELS_VISCOSITY};

static void set(double *row, const SbStudyWork *work, SbParamId id, double value) {
  row[sb_study_grid_column(work, sb_param(id)->key)] = value;
}

static void fill(double *row, const SbStudyWork *work, int line, double x) {
  const SbModel *base = &work->base;
  const int fluid = fluid_of(line), part = part_of(line) == SOLVED ? ALL : part_of(line);
  const double T0 = SB_SIZES_TEMPERATURE, of_pressure = part == ALL || part == PRESSURE ? x : T0;
  const double of_film = part == ALL || part == FILM ? x : T0;
  set(row, work, SB_P_FLUID_NAME, fluid);
  set(row, work, SB_P_CANISTER_TEMPERATURE, part == ALL ? x : T0);
  set(row, work, SB_P_CANISTER_PRESSURE,
      of_fluid(base, SB_P_CANISTER_PRESSURE, fluid, of_pressure));
  set(row, work, SB_P_FLUID_VISCOSITY, of_fluid(base, SB_P_FLUID_VISCOSITY, fluid, of_film));
  set(row, work, SB_P_FLUID_DENSITY, of_fluid(base, SB_P_FLUID_DENSITY, fluid, of_film));
  SbModel *then = NULL;
  const SbOverride warm = {SB_P_CANISTER_TEMPERATURE, x};
  if ((part == RUBBER || part == EXPANSION) &&
      sb_model_derive(&then, base, &warm, 1, NULL) == SB_OK) {
    const SbSealModel *outer = &then->seal[SB_OUTER], *inner = &then->seal[SB_INNER];
    const double grown = 1 + then->rubber.thermal_expansion * (x - T0);
    if (part == RUBBER) {
      set(row, work, SB_P_SEAL_OUTER_MODULUS, outer->stored.modulus * outer->storage.stiffening);
      set(row, work, SB_P_SEAL_INNER_MODULUS, inner->stored.modulus * inner->storage.stiffening);
    } else {
      set(row, work, SB_P_SEAL_OUTER_SECTION_DIAMETER, outer->stored.section_diameter * grown);
      set(row, work, SB_P_SEAL_INNER_SECTION_DIAMETER, inner->stored.section_diameter * grown);
      set(row, work, SB_P_SEAL_OUTER_INNER_DIAMETER, outer->stored.inner_diameter * grown);
      set(row, work, SB_P_SEAL_INNER_INNER_DIAMETER, inner->stored.inner_diameter * grown);
      set(row, work, SB_P_GLAND_RADIAL_SPACE, then->radial_space);
      set(row, work, SB_P_BORE_DIAMETER, then->bore_diameter);
    }
  } else if (part == RUBBER || part == EXPANSION) {
    set(row, work, SB_P_CANISTER_TEMPERATURE, x); // refused as there
  }
  sb_model_destroy(then);
  if (interpolates(work->scene) && part_of(line) != SOLVED) {
    set(row, work, SB_P_MODELS_FIT, SB_FIT_KARASZKIEWICZ);
    set(row, work, SB_P_MODELS_FILM, SB_FILM_THESIS);
    set(row, work, SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_BESIDE);
    set(row, work, SB_P_MODELS_ADHESION, SB_MODEL_ADHESION_OFF);
    set(row, work, SB_P_MODELS_INLET, 0);
    set(row, work, SB_P_MODELS_FILM_TIME, 0);
    set(row, work, SB_P_MODELS_VISCOSITY, 0);
  }
}

// Rings that are solved at some pressures only are interpolated over those that were not solved.
static bool is_bridged(const SbStudyWork *work, int line) {
  return interpolates(work->scene) && !work->scene->study.rings_solved && part_of(line) == SOLVED;
}

static void derive(double *value, SbStudyWork *work, int line, double x) {
  (void)line, (void)x;
  const double across = work->scene->stem_diameter;
  value[STRAIN] = value[FORCE] / (M_PI / 4 * across * across) / value[MODULUS];
}

// Ratios of friction over p/E: of the break-away, of the return margin.
enum { WAYS = 2 };
typedef struct {
  size_t count;
  double least, largest; // pressure's force [N]
  double strain[CYCLES], ratio[WAYS][CYCLES];
} Ratios;

static double friction(const double *value, int way) {
  return way == 0 ? value[BREAKAWAY] - value[FORCE] : value[FORCE] - value[RETURN];
}

// Adds what was solved of a fluid at T, in the order of p/E; left out: what was not solved, and one
// at the same place.
static void add(Ratios *out, SbStudyWork *work, int fluid, double T) {
  const double *solved = sb_study_at(work, line_of(fluid, SOLVED), T);
  const double *closed = sb_study_at(work, line_of(fluid, ALL), T);
  const double strain = solved[STRAIN];
  double ratio[WAYS];
  for (int way = 0; way < WAYS; way++) {
    const double by_closed = friction(closed, way);
    ratio[way] = by_closed > 0 ? friction(solved, way) / by_closed : 1;
    if (!isfinite(ratio[way])) {
      return;
    }
  }
  size_t at = out->count;
  while (at > 0 && out->strain[at - 1] > strain) {
    at--;
  }
  const double last = at > 0 ? out->strain[at - 1] : -INFINITY;
  if (out->count == CYCLES || strain - last < 1e-6 * fabs(strain)) {
    return;
  }
  out->least = out->count == 0 ? solved[FORCE] : fmin(out->least, solved[FORCE]);
  out->largest = out->count == 0 ? solved[FORCE] : fmax(out->largest, solved[FORCE]);
  const size_t behind = out->count++ - at;
  memmove(out->strain + at + 1, out->strain + at, behind * sizeof(double));
  out->strain[at] = strain;
  for (int way = 0; way < WAYS; way++) {
    memmove(out->ratio[way] + at + 1, out->ratio[way] + at, behind * sizeof(double));
    out->ratio[way][at] = ratio[way];
  }
}

static double ratio_at(const Ratios *ratios, int way, double strain) {
  const size_t count = ratios->count;
  if (count == 0) {
    return NAN;
  }
  const double *x = ratios->strain, *y = ratios->ratio[way];
  strain = fmin(fmax(strain, x[0]), x[count - 1]);
  if (count < 3) { // a straight line, or one value
    return count == 1 ? y[0] : y[0] + (y[1] - y[0]) * (strain - x[0]) / (x[1] - x[0]);
  }
  gsl_interp *interp = gsl_interp_alloc(gsl_interp_steffen, count);
  double out = NAN;
  if (interp != NULL && gsl_interp_init(interp, x, y, count) == 0) {
    (void)gsl_interp_eval_e(interp, x, y, strain, NULL, &out);
  }
  gsl_interp_free(interp);
  return out;
}

// Results of closed forms, with the solved rings' friction.
static void correct(double *value, const Ratios *ratios) {
  value[BREAKAWAY] = value[FORCE] + friction(value, 0) * ratio_at(ratios, 0, value[STRAIN]);
  value[RETURN] = value[FORCE] - friction(value, 1) * ratio_at(ratios, 1, value[STRAIN]);
}

// Relative error that the interpolation has at the pressures in between if each is left out.
static double left_out(const Ratios *ratios) {
  double worst = NAN;
  for (size_t i = 1; i + 1 < ratios->count; i++) {
    Ratios rest = *ratios;
    const size_t behind = --rest.count - i;
    memmove(rest.strain + i, rest.strain + i + 1, behind * sizeof(double));
    for (int way = 0; way < WAYS; way++) {
      memmove(rest.ratio[way] + i, rest.ratio[way] + i + 1, behind * sizeof(double));
      const double error = ratio_at(&rest, way, ratios->strain[i]) / ratios->ratio[way][i] - 1;
      worst = fmax(worst, fabs(error));
    }
  }
  return worst;
}

// Solves rings at as many pressures as it takes; the error that interpolation leaves.
static double solve_rings(Ratios *out, SbStudyWork *work) {
  // By the fluid and the fraction of the range: over the default range p/E = -0.01, 0.04, 0.07,
  // 0.15, 0.25 and 0.44; then 0.02 and 0.34. Fluids differ from point to point, so that the
  // reported error includes effects other than that of p/E.
  static const struct {
    int fluid;
    double share;
  } place[MOST] = {{2, 0},    {4, 0.25}, {3, 0.31}, {2, 0.68},
                   {3, 0.75}, {1, 1},    {4, 0.14}, {1, 0.86}};
  double error = NAN;
  for (int from = 0, until = FIRST; until <= MOST; from = until, until += MORE) {
    SbStudyPlace of[2 * FIRST];
    const size_t count = (size_t)(until - from);
    for (size_t i = 0; i < count; i++) {
      const int fluid = place[from + (int)i].fluid;
      const double T = work->lo + (work->hi - work->lo) * place[from + (int)i].share;
      of[i] = (SbStudyPlace){line_of(fluid, SOLVED), T, fill};
      of[count + i] = (SbStudyPlace){line_of(fluid, ALL), T, fill};
    }
    sb_study_more(work, of, 2 * count, 0.9 * from / MOST, 0.9 * until / MOST);
    for (size_t i = 0; i < count; i++) {
      add(out, work, fluid_of(of[i].line), of[i].x);
    }
    error = left_out(out);
    if (work->status != SB_OK || error < 0.1) {
      break;
    }
  }
  return error;
}

// Gives all that closed forms answered the friction of solved rings.
static void correct_all(SbStudyWork *work, const Ratios ratios[FLUIDS + 1]) {
  bool held[2] = {false, false}; // beyond the pressures that were solved: of all, of a part
  for (size_t i = 0; i < work->answers; i++) {
    const Ratios *of = &ratios[fluid_of(work->answer[i].line)];
    if (part_of(work->answer[i].line) != SOLVED) {
      const double strain = work->answer[i].value[STRAIN];
      const bool part = part_of(work->answer[i].line) != ALL;
      if (of->count > 0 &&
          (strain < of->strain[0] - 1e-9 || strain > of->strain[of->count - 1] + 1e-9)) {
        held[part] = true;
      }
      correct(work->answer[i].value, of);
    }
  }
  if (held[0]) {
    sb_warn(&work->out->warnings, "friction-held", sb_input(SB_P_STUDY_RINGS),
            "some pressures are outside the range in which rings were solved: the friction there "
            "is that of closed forms times the ratio at the nearest pressure");
  }
  if (held[1]) {
    sb_study_note(work->out,
                  "Some single effects (pressure, film, rubber or expansion alone) are "
                  "outside the solved range of p/E: their friction uses the ratio of the "
                  "nearest solved one.");
  }
}

#define SHARE 0.6 // of the work that the grid is, the parts aside

// Returns whether a cycle is so cheap that the full grid is computed.
static bool is_closed(const SbModel *scene) {
  return !sb_fit_kind(scene->fit)->points && !sb_film_kind(scene->film)->coupled &&
         !sb_contact_law(scene)->shares;
}

// Every answer that the charts and the table need, in as few full cycles as do.
static void ask_all(SbStudyWork *work, int points, const double table[TABLE]) {
  const bool rings = interpolates(work->scene), every = work->scene->study.rings_solved;
  SbStudyPlace place[FLUIDS * (POINTS + TABLE * PARTS)] = {{0, 0, NULL}};
  Ratios ratios[FLUIDS + 1] = {0};
  size_t count = 0;
  for (int fluid = 1; rings && every && fluid <= FLUIDS; fluid++) {
    for (int i = 0; i < CYCLES; i++) {
      place[count++] =
          (SbStudyPlace){line_of(fluid, SOLVED), sb_study_place(work, i, CYCLES), fill};
      place[count++] = (SbStudyPlace){line_of(fluid, ALL), sb_study_place(work, i, CYCLES), fill};
    }
  }
  if (count > 0) {
    sb_study_more(work, place, count, 0.15, 0.9);
  }
  for (size_t i = 0; i < count; i += 2) {
    const int fluid = fluid_of(place[i].line);
    add(&ratios[fluid], work, fluid, place[i].x);
  }
  SbStudy *out = work->out;
  if (rings && !every) {
    const double error = solve_rings(&ratios[0], work);
    const Ratios *of = &ratios[0];
    for (int fluid = 1; fluid <= FLUIDS; fluid++) {
      ratios[fluid] = *of;
    }
    const double across = work->scene->stem_diameter, area = M_PI / 4 * across * across;
    if (isfinite(error)) {
      sb_message(out->models, sizeof out->models,
                 "rings solved at %zu pressures, %.2f to %.2f MPa, interpolated within %.2g %%",
                 of->count, 1e-6 * of->least / area, 1e-6 * of->largest / area, 100 * error);
      out->error = fmax(out->error, error);
    } else if (work->bridged[0] != '\0') {
      sb_study_gap(out, work->bridged_at, work->bridged); // too few are left
    }
  }
  count = 0;
  for (int fluid = 1; fluid <= FLUIDS; fluid++) {
    for (int i = 0; i < points; i++) {
      place[count++] =
          (SbStudyPlace){line_of(fluid, ALL), sb_study_place(work, i, points), rings ? fill : NULL};
    }
    for (int i = 0; i < TABLE * PARTS; i++) {
      place[count++] = (SbStudyPlace){line_of(fluid, i % PARTS), table[i / PARTS],
                                      rings || i % PARTS != ALL ? fill : NULL};
    }
  }
  sb_study_more(work, place, count, rings ? 0.9 : is_closed(work->scene) ? SHARE : 0, 1);
  if (rings) {
    correct_all(work, ratios);
  }
}

// Where a propellant's return margin rises through zero; NaN: nowhere in the range.
static double begins(SbStudyWork *work, int fluid, int points) {
  for (int i = 1; i < points; i++) {
    const double x0 = sb_study_place(work, i - 1, points), x1 = sb_study_place(work, i, points);
    const double y0 = sb_study_at(work, line_of(fluid, ALL), x0)[RETURN];
    const double y1 = sb_study_at(work, line_of(fluid, ALL), x1)[RETURN];
    if (y0 <= 0 && y1 > 0) {
      return x0 + (x1 - x0) * y0 / (y0 - y1);
    }
  }
  return NAN;
}

// Notes what the rubber's modulus does over the range, and where this comes from.
static void note_modulus(SbStudyWork *work) {
  SbModulusChange low, high;
  sb_model_modulus(&low, work->scene, work->lo);
  sb_model_modulus(&high, work->scene, work->hi);
  sb_study_note(work->out,
                "Modulus against 20 °C: %+.3g %% at %.0f °C, %+.3g %% at %.0f °C; %s: %s.",
                100 * (low.factor - 1), work->lo - 273.15, 100 * (high.factor - 1),
                work->hi - 273.15, low.tag, low.source);
  sb_model_warn_modulus(work->scene, work->hi, &work->out->warnings);
}

static void make(SbStudyWork *work) {
  static const double table[TABLE] = {263.15, 273.15, 293.15, 313.15, 323.15};
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  if (!sb_motion_kind(model)->valve) {
    work->status = sb_fail_input(work->report, SB_ERROR_INFEASIBLE, sb_input(SB_P_MODELS_MOTION),
                                 "the rig has no valve and no propellant");
    return;
  }
  const bool cheap = is_closed(model) || interpolates(model);
  const int points = cheap && !model->study.rings_solved ? POINTS : CYCLES;
  static const char *const limited[FIGURES] = {NULL, "cycle.force_breakaway_N",
                                               "cycle.force_return_margin_N", "cycle.dose_mass_kg"};
  for (size_t i = 0; i < model->limits.count; i++) {
    const SbLimit *limit = &model->limits.item[i];
    for (int p = BREAKAWAY; p < FIGURES; p++) {
      if (sb_figure_find(limited[p]) == limit->figure) {
        out->panel[p].limit_low = limit->low;
        out->panel[p].limit_high = limit->high;
      }
    }
  }
  ask_all(work, points, table);
  char starts[SB_TEXT / 2] = "";
  for (int fluid = 1; fluid <= FLUIDS; fluid++) {
    const char *label = sb_fluids[fluid].label;
    sb_study_curves(work, SB_STUDY_CURVE, label, line_of(fluid, ALL), NULL, points);
    const double from = begins(work, fluid, points);
    const size_t used = strlen(starts);
    if (isfinite(from)) {
      snprintf(starts + used, sizeof starts - used, "%s%s %.1f", used > 0 ? ", " : "", label,
               from - 273.15);
    } else {
      const bool well = sb_study_at(work, line_of(fluid, ALL), work->lo)[RETURN] > 0;
      snprintf(starts + used, sizeof starts - used, "%s%s %s", used > 0 ? ", " : "", label,
               well ? "in all of the range" : "nowhere in the range");
    }
    for (int i = 0; i < TABLE; i++) {
      const double x = table[i];
      const double *all = sb_study_at(work, line_of(fluid, ALL), x);
      const double still = sb_study_at(work, line_of(fluid, ALL), SB_SIZES_TEMPERATURE)[RETURN];
      SbStudyRow *row = sb_study_row(out, "%s, %.0f °C", label, x - 273.15);
      memcpy(row->value, all, FIGURES * sizeof *all);
      row->value[FIGURES] = all[RETURN] - still;
      for (int part = PRESSURE; part < PARTS; part++) {
        row->value[FIGURES + part] = sb_study_at(work, line_of(fluid, part), x)[RETURN] - still;
      }
    }
  }
  sb_study_note(out, "The stem comes back from, in °C: %s.", starts);
  sb_study_note(out, "\"by\": change of the return margin from 20 °C, all else as there.");
  note_modulus(work);
  sb_study_mark(work, model->temperature, SB_LABEL("this scene"));
  if (out->models[0] == '\0') {
    sb_message(out->models, sizeof out->models, "fit %s, film %s, a cycle at each temperature",
               sb_fit_kind(model->fit)->name, sb_film_kind(model->film)->name);
  }
}

enum { ANSWERS = FLUIDS * (POINTS + TABLE * PARTS) };

const SbStudyDesign sb_study_propellants = {
    .x = SB_QUANTITY("canister temperature", "°C"),
    .panel = {SB_QUANTITY("pressure force", "N"), SB_QUANTITY("break-away force", "N"),
              SB_QUANTITY("return margin", "N"), SB_QUANTITY("dose", "mg")},
    .range = offsetof(SbStudyRange, temperature_min),
    .row_heading = SB_LABEL("propellant"),
    .column = {SB_QUANTITY("pressure force", "N"), SB_QUANTITY("break-away", "N"),
               SB_QUANTITY("return margin", "N"), SB_QUANTITY("dose", "mg"),
               SB_QUANTITY("change", "N"), SB_QUANTITY("by pressure", "N"),
               SB_QUANTITY("by film", "N"), SB_QUANTITY("by rubber", "N"),
               SB_QUANTITY("by expansion", "N")},
    .validity = "saturated propellant; the range of its figures, -40 to 80 °C, and above the "
                "rubber's glass transition",
    .grid = true,
    .share = SHARE,
    .asks_grid = is_closed,
    .extra = extra,
    .extras = sizeof extra / sizeof extra[0],
    .derive = derive,
    .is_bridged = is_bridged,
    .make = make,
};

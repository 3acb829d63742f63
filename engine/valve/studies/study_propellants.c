// What another propellant and the temperature make of the valve: pressure force, break-away, least
// return force and dose of each propellant over the canister's temperature, where the stem begins
// to come back, and what of the change from 20 degC each of four ways makes alone: the vapour
// pressure; the liquid's viscosity and density, which the film has; the rubber's modulus; the
// expansion of ring, radial space and bore.
//
// Every point is a whole quasi-static cycle, the propellant saturated, whatever liquid the scene
// has. Parts are taken one at a time with all else as at 20 degC; what is left of their sum is how
// they act on each other. Leaves out: swell by another propellant, and what evaporation cools.
#include "engine/fluid/fluid.h"
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FORCE, BREAKAWAY, RETURN, DOSE, FIGURES };
// A line is a fluid, and what of it is at the temperature: all, or one of the parts.
enum { ALL, PRESSURE, FILM, RUBBER, EXPANSION, PARTS };
enum { POINTS = 13, FLUIDS = 4, TABLE = 5 };

// Propellants come first behind the fluid without figures.
static int line_of(int fluid, int part) {
  return part * (FLUIDS + 1) + fluid;
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

static void solve(double *value, SbStudyWork *work, int line, double x) {
  static const char *const paths[] = {"cycle.force_breakaway_N", "cycle.force_return_min_N",
                                      "cycle.dose_mass_kg"};
  enum { SIZES = 7 };
  const SbModel *base = &work->base;
  const int fluid = line % (FLUIDS + 1), part = line / (FLUIDS + 1);
  const double T0 = SB_SIZES_TEMPERATURE, of_pressure = part == ALL || part == PRESSURE ? x : T0;
  const double of_film = part == ALL || part == FILM ? x : T0;
  SbOverride override[SIZES + 6] = {
      {SB_P_FLUID_NAME, fluid},
      {SB_P_CANISTER_TEMPERATURE, part == ALL ? x : T0},
      {SB_P_CANISTER_PRESSURE, of_fluid(base, SB_P_CANISTER_PRESSURE, fluid, of_pressure)},
      {SB_P_FLUID_VISCOSITY, of_fluid(base, SB_P_FLUID_VISCOSITY, fluid, of_film)},
      {SB_P_FLUID_DENSITY, of_fluid(base, SB_P_FLUID_DENSITY, fluid, of_film)}};
  size_t count = 5;
  SbReport report;
  SbModel *then = NULL;
  const SbOverride warm = {SB_P_CANISTER_TEMPERATURE, x};
  if ((part == RUBBER || part == EXPANSION) &&
      sb_model_derive(&then, base, &warm, 1, &report) != SB_OK) {
    return;
  }
  const SbSealModel *ring = then != NULL ? then->seal : NULL;
  if (part == RUBBER) {
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      override[count++] =
          (SbOverride){seal == SB_OUTER ? SB_P_SEAL_OUTER_MODULUS : SB_P_SEAL_INNER_MODULUS,
                       ring[seal].stored.modulus * ring[seal].storage.stiffening};
    }
  } else if (part == EXPANSION) {
    const double grown = 1 + then->rubber.thermal_expansion * (x - T0);
    const SbOverride sizes[] = {
        {SB_P_SEAL_OUTER_SECTION_DIAMETER, ring[SB_OUTER].stored.section_diameter * grown},
        {SB_P_SEAL_INNER_SECTION_DIAMETER, ring[SB_INNER].stored.section_diameter * grown},
        {SB_P_SEAL_OUTER_INNER_DIAMETER, ring[SB_OUTER].stored.inner_diameter * grown},
        {SB_P_SEAL_INNER_INNER_DIAMETER, ring[SB_INNER].stored.inner_diameter * grown},
        {SB_P_GLAND_RADIAL_SPACE, then->radial_space},
        {SB_P_BORE_DIAMETER, then->bore_diameter}};
    memcpy(override + count, sizes, sizeof sizes);
    count += sizeof sizes / sizeof sizes[0];
  }
  sb_model_destroy(then);
  sb_study_ask(work, value + BREAKAWAY, paths, 3, override, count);
  const SbModel *model = sb_evaluator_model(work->evaluator);
  value[FORCE] = model != NULL ? model->pressure_force : NAN;
}

// Where a propellant's least return force rises through zero; NaN: nowhere in the range.
static double begins(SbStudyWork *work, int fluid) {
  for (int i = 1; i < POINTS; i++) {
    const double x0 = sb_study_place(work, i - 1, POINTS), x1 = sb_study_place(work, i, POINTS);
    const double y0 = sb_study_at(work, line_of(fluid, ALL), x0)[RETURN];
    const double y1 = sb_study_at(work, line_of(fluid, ALL), x1)[RETURN];
    if (y0 <= 0 && y1 > 0) {
      return x0 + (x1 - x0) * y0 / (y0 - y1);
    }
  }
  return NAN;
}

static void make(SbStudyWork *work) {
  static const double celsius[TABLE] = {-10, 0, 20, 40, 50};
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  if (model->motion == SB_MODEL_MOTION_RIG) {
    work->status = sb_fail_parameter(work->report, SB_ERROR_INFEASIBLE, "models.motion",
                                     "the rig has no valve and no propellant");
    return;
  }
  char starts[160] = "";
  for (int fluid = 1; fluid <= FLUIDS; fluid++) {
    const char *label = sb_fluids[fluid].label;
    sb_study_curves(work, SB_STUDY_CURVE, label, line_of(fluid, ALL), NULL, POINTS);
    const double from = begins(work, fluid);
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
      const double x = celsius[i] + 273.15;
      const double *all = sb_study_at(work, line_of(fluid, ALL), x);
      const double still = sb_study_at(work, line_of(fluid, ALL), SB_SIZES_TEMPERATURE)[RETURN];
      SbStudyRow *row = sb_study_row(out,
                                     "%s, %.0f \xc2\xb0"
                                     "C",
                                     label, celsius[i]);
      memcpy(row->value, all, FIGURES * sizeof *all);
      row->value[FIGURES] = all[RETURN] - still;
      for (int part = PRESSURE; part < PARTS; part++) {
        row->value[FIGURES + part] = sb_study_at(work, line_of(fluid, part), x)[RETURN] - still;
      }
    }
  }
  sb_study_note(out,
                "The stem comes back from, in \xc2\xb0"
                "C: %s.",
                starts);
  sb_study_note(out, "\"by\": change of the least return force from 20 \xc2\xb0"
                     "C, all else as there.");
  sb_study_mark(work, model->temperature, "this scene");
  sb_text(out->models, sizeof out->models, "fit %s, film %s, quasi-static cycle of the machine",
          sb_fit_model_name(model->fit), sb_film_model_name(model->film));
}

enum { CYCLES = FLUIDS * (POINTS + TABLE * PARTS) };

const SbStudyDesign sb_study_propellants = {
    .x = "canister temperature [\xc2\xb0"
         "C]",
    .panel = {"pressure force [N]", "break-away force [N]", "least return force [N]", "dose [mg]"},
    .range = offsetof(SbStudyRange, temperature_min),
    .row_heading = "propellant",
    .column = {"pressure force [N]", "break-away [N]", "least return [N]", "dose [mg]",
               "change [N]", "by pressure [N]", "by film [N]", "by rubber [N]", "by expansion [N]"},
    .validity = "saturated propellant; the range of its figures, -40 to 80 \xc2\xb0"
                "C, and above the "
                "rubber's glass transition",
    .solves = {.fits = 2 * CYCLES, .films = 10 * CYCLES, .cycles = CYCLES},
    .solve = solve,
    .make = make,
};

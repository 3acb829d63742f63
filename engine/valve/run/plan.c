// Decides what a scene computes: its views and figures pull in fields, and nothing else is
// computed.
//
// Predicted cost is the number of solves (`expected`) times a typical time of one (cost.h).
// Predicted error is what the solvers usually reach at the tolerance, which is less than that where
// a mesh of few unknowns is already better; closed forms have none of discretisation. The counters
// in a run's results are the proof of the plan.
#include "engine/valve/run/plan.h"

#include "engine/contact/fit.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/model/model.h"
#include "engine/valve/model/motion_kind.h"
#include "engine/valve/run/cost.h"
#include "engine/valve/run/frame.h"
#include "engine/valve/run/rig.h"
#include "engine/valve/run/study_cost.h"
#include "engine/valve/run/valve_type.h"
#include "engine/valve/states/contact_law.h"
#include "engine/valve/states/speed_states.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// Profiles of a cycle: of the outer seal in three chamber states, of the inner in two; sliding in
// both directions, and at rest.
enum { PROFILE_STATES = 15, CHAMBERS = 3 };

// Times that a motion is run to find its own speed, where no machine gives one.
enum { OWN_SPEED_ROUNDS = 2 };

// States solved for other speeds, if films are solved: two for each seal and direction near a
// machine's speed, or over decades.
enum { NEAR_STATES = 8, SPEED_STATES = 40 };

// Steps of a seal's film through a cycle: fronts that cross the contact set them, hardly the
// frames.
enum { FILM_STEPS = 500 };

// Adds a field that is computed, or one that is skipped, of which only name and reason are
// reported.
static void SB_PRINTF(7, 8) add(SbPlan *plan, bool wanted, const char *name, const char *model,
                                double cost, double error, const char *format, ...) {
  size_t *count = wanted ? &plan->field_count : &plan->skipped_count;
  assert(*count < SB_PLAN_ITEMS_MAX);
  SbPlanItem *item = &(wanted ? plan->field : plan->skipped)[(*count)++];
  sb_text(item->name, sizeof item->name, "%s", name);
  sb_text(item->model, sizeof item->model, "%s", wanted ? model : "");
  item->cost_s = wanted ? cost : 0;
  item->error = wanted ? error : 0;
  va_list arguments;
  va_start(arguments, format);
  sb_message_v(item->reason, sizeof item->reason, format, arguments);
  va_end(arguments);
}

// Names of those bits of a mask whose parameter is `id`, "profiles, section".
static void mask_names(SbParamId id, unsigned mask, char *text, size_t size) {
  size_t used = 0;
  text[0] = '\0';
  for (int i = 0; i < sb_param_choice_count(sb_param(id)); i++) {
    char name[32];
    sb_param_choice_name(sb_param(id), i, name, sizeof name);
    if ((mask & (1u << i)) != 0) {
      sb_message(text + used, size - used, "%s%s", used > 0 ? ", " : "", name);
      used = strlen(text);
    }
  }
}

// Typical error estimate of a fitment's load, relative, at the model's tolerance.
static double fit_error(const SbModel *model) {
  return sb_fit_load_error(model->fit, model->tolerance);
}

// Typical error estimate of a film, relative, at the model's tolerance.
static double film_error(const SbModel *model) {
  if (sb_contact_law(model)->shares) {
    return 0.03 * model->tolerance;
  }
  if (!sb_film_kind(model->film)->coupled) {
    return 0;
  }
  // The ring's film depends on its contact's ends.
  return sb_fit_kind(model->fit)->section ? 6 * fit_error(model) : 0.01 * model->tolerance;
}

// Returns whether a seal slides in this state of the chamber; the inner one has left the land in
// one.
static bool slides(int seal, int chamber) {
  return seal == SB_OUTER || chamber != (int)SB_CHAMBER_OPEN;
}

// Fitments of a cycle: a seal's next chamber state at the same pressure difference needs none.
static int count_fits(const SbModel *model) {
  int count = 0;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    double last = NAN;
    for (int chamber = 0; chamber < CHAMBERS; chamber++) {
      SbSealPressure p = sb_model_seal_pressure(model, seal, (SbChamber)chamber);
      if (slides(seal, chamber) && p.left - p.right != last) {
        last = p.left - p.right;
        count++;
      }
    }
  }
  return count;
}

static bool finds_speed(const SbModel *model) {
  return sb_motion_kind(model)->inertia && model->drive != SB_MODEL_DRIVE_MACHINE;
}

static void plan_rig(SbPlan *plan, const SbModel *model) {
  size_t samples = sb_rig_samples(&model->rig);
  add(plan, true, "thread force and plate", "rig", (double)samples * SB_COST_SAMPLE, 0,
      "the coefficients come from its %zu samples", samples);
  add(plan, true, "real contact area", "greenwood-tripp", SB_COST_ROUGH, 0,
      "the coefficient by the valve's surface model at the plate's load");
  add(plan, false, "contact load and width", "", 0, 0, "the rig gives its load; there is no valve");
  add(plan, false, "film", "", 0, 0, "the rig's friction is its input");
}

// Studies are requested one by one; the others share a line.
static void plan_studies(SbPlan *plan, const SbModel *model, unsigned studies) {
  const unsigned all = (1u << SB_STUDY_COUNT) - 1;
  plan->studies = studies;
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    if ((studies & (1u << i)) != 0) {
      char item[40];
      sb_text(item, sizeof item, "study %s", sb_study_name((SbStudyKind)i));
      add(plan, true, item, "several", sb_study_cost((SbStudyKind)i, model), model->tolerance,
          "output.studies requests it");
    }
  }
  if ((studies & all) != all) {
    char others[128];
    mask_names(SB_P_OUTPUT_STUDIES, ~studies, others, sizeof others);
    add(plan, false, "studies", "", 0, 0, "output.studies does not request %s", others);
  }
}

// One row of the plan: what it computes and why, or why not; a row without that text is left out.
typedef struct {
  bool wanted;
  const char *name, *model;
  double cost, error;
  const char *why, *why_not;
} Row;

// Numbers of solves. A ring slides in both directions at each pressure difference, fitted again
// with its film until the friction that drags it is that of this film, and is at rest at each.
static SbCounters expect(const SbPlan *plan, const SbModel *model) {
  const SbContactLaw *law = sb_contact_law(model);
  const SbFitKind *fit = sb_fit_kind(model->fit);
  const bool disc = fit->points && !fit->section;
  const size_t rounds = finds_speed(model) && !plan->ring ? OWN_SPEED_ROUNDS : 1;
  const size_t fits = (size_t)count_fits(model),
               way = law->shares ? 5 : 3; // rounds of both directions
  const size_t drags = plan->ring ? way * fits : 0;
  const size_t films = drags + (plan->ring ? 0 : 2 * fits);
  const size_t each = plan->ring || (fit->body && !law->shares) ? 2 : 1;
  // Rows over the land's edge and the free ring; of a gasket valve the free gasket alone.
  const size_t rows = sb_valve_type(model)->drawn_over_edge ? 2 * SB_RUN_EDGES : 0;
  const size_t edges = plan->over_edge ? rows + 1 : 0;
  const size_t shapes = SB_RUN_MOTIONS * fits + edges;
  const size_t nodes = law->closed_film ? plan->inertia ? SPEED_STATES : 0
                       : plan->reynolds ? plan->inertia ? SPEED_STATES : NEAR_STATES
                                        : 0;
  SbCounters out = {.fit_solves = drags + fits,
                    .disc_solves = disc ? fits : 0,
                    .ring_solves = drags + (plan->ring ? fits : 0) + edges,
                    .speed_nodes = nodes,
                    .film_steps = plan->film_history ? SB_SEAL_COUNT * FILM_STEPS : 0,
                    .field_evaluations = plan->section_fields ? shapes : 0,
                    .profile_evaluations = plan->profiles ? rounds * PROFILE_STATES : 0};
  out.reynolds_solves = plan->reynolds ? rounds * films * each + out.speed_nodes : 0;
  return out;
}

// Returns the depth of the shelf that a figure needs.
static SbShelfDepth shelf_of(const SbFigure *figure) {
  switch (figure->part) {
  case SB_PART_SHELF_TIME:
    return SB_SHELF_OVER_TIME;
  case SB_PART_SHELF:
  case SB_PART_ESTIMATE_SHELF:
    return SB_SHELF_RATES;
  default:
    return SB_SHELF_NOTHING;
  }
}

// Depth of the shelf that views and limits require.
static SbShelfDepth shelf_wished(const SbModel *model, unsigned views) {
  SbShelfDepth depth =
      ((views | model->views) & SB_VIEW_SHELF) != 0 ? SB_SHELF_OVER_TIME : SB_SHELF_NOTHING;
  for (size_t i = 0; i < model->limits.count; i++) {
    const SbShelfDepth one = shelf_of(sb_figure(model->limits.item[i].figure));
    depth = one > depth ? one : depth;
  }
  return depth;
}

// Predicted processor times [s] of the parts of a run of the valve.
typedef struct {
  double states; // films and friction of all states
  double ring;   // solved rings
  double motion; // motion of one actuation
  double speeds; // films at other speeds
  double life;   // actuations of a life
} Costs;

static void valve_costs(Costs *out, const SbPlan *plan, const SbModel *model) {
  const SbContactLaw *law = sb_contact_law(model);
  const bool coupled = law->shares, finds = finds_speed(model);
  const bool inertia = sb_motion_kind(model)->inertia;
  const bool solved = sb_film_kind(model->film)->coupled, body = sb_fit_kind(model->fit)->body;
  const SbCounters *n = &plan->expected;
  const int fits = count_fits(model);
  const double on_body = plan->reynolds && body ? SB_COST_FILM_FITTED : 0;
  const double film = coupled ? SB_COST_FILM_MIXED : sb_cost_film(model->film);
  const double films = solved || coupled ? (double)(n->reynolds_solves - n->speed_nodes)
                                         : 2.0 * fits * (finds ? OWN_SPEED_ROUNDS : 1);
  const double at_speed = sb_cost_speed_state(model);
  // Each film on the half-plane has one on the fitted body in addition.
  out->states = law->closed_film          ? 2.0 * fits * SB_COST_ROUGH
                : on_body > 0 && !coupled ? films / 2 * (film + on_body)
                                          : films * at_speed;
  const double rests = fits; // of rings
  const double dragged = (double)n->fit_solves - rests;
  out->ring = sb_cost_ring_share(model->tolerance) *
              (rests * SB_COST_RING + dragged * SB_COST_RING_DRAGGED);
  out->motion = !inertia ? 0
                : finds  ? (1 + OWN_SPEED_ROUNDS) * SB_COST_DYNAMICS_OWN
                         : SB_COST_DYNAMICS;
  out->speeds = (double)n->speed_nodes * at_speed;
  // Whole runs of a life with coupled asperities: some twenty (measured: 10 at a tolerance of 1 %,
  // 56 at 0.1 %).
  enum { LIVED = 20 };
  const double lived = model->life_actuations < LIVED ? model->life_actuations : LIVED;
  out->life = coupled ? lived * (out->states + out->speeds + out->ring + out->motion)
                      : model->life_actuations * (inertia ? SB_COST_DYNAMICS : SB_COST_ACTUATION);
}

// Reasons of the rows that name choices and numbers of the model.
typedef struct {
  char law[32], motion[32]; // choices of models.film and models.motion
  char fit[160], ring[160], film[160], life[160], profiles[160], sections[160];
  char frames[48], joints[80];
} Texts;

static void valve_texts(Texts *out, const SbModel *model, unsigned drawn, unsigned sections,
                        int shapes) {
  char profiles_by[96], sections_by[96];
  sb_model_choice_name(model, SB_P_MODELS_FILM, out->law, sizeof out->law);
  sb_model_choice_name(model, SB_P_MODELS_MOTION, out->motion, sizeof out->motion);
  mask_names(SB_P_OUTPUT_VIEWS, drawn, profiles_by, sizeof profiles_by);
  mask_names(SB_P_OUTPUT_VIEWS, sections, sections_by, sizeof sections_by);
  sb_message(out->fit, sizeof out->fit,
             "friction and film need them; %d pressure differences over two seals",
             count_fits(model));
  sb_message(out->ring, sizeof out->ring, "models.fit = %s already gives load and width",
             sb_fit_kind(model->fit)->name);
  sb_message(out->film, sizeof out->film, "models.film = %s is sufficient for the friction",
             out->law);
  sb_message(out->life, sizeof out->life, "%d actuations while the roughness runs in; %s",
             model->life_actuations,
             sb_contact_law(model)->shares
                 ? "films between coupled asperities are solved at some of them"
                 : "fitment and film are the first's");
  sb_message(out->profiles, sizeof out->profiles, "drawn by %s; each seal's states and at rest",
             profiles_by);
  sb_message(out->sections, sizeof out->sections,
             "drawn by %s: %d shapes, those of the states and over the land's edge", sections_by,
             shapes);
  sb_text(out->frames, sizeof out->frames, "figures of the cycle, %d frames", model->frames);
  sb_text(out->joints, sizeof out->joints, "models.motion = bodies requests them, %d joints",
          SB_VALVE_JOINTS);
}

static const char *film_reason(const SbPlan *plan, const SbModel *model) {
  const SbContactLaw *law = sb_contact_law(model);
  return law->reason != NULL ? law->reason
         : plan->reynolds && sb_fit_kind(model->fit)->body
             ? "boundary friction, viscous friction and leakage require it; on the half-plane and "
               "on the fitted ring"
             : "boundary friction, viscous friction and leakage require it";
}

// Adds a row for each part of a run of the valve.
static void add_valve_rows(SbPlan *plan, const SbModel *model, const Costs *costs,
                           const Texts *texts, bool draws_section) {
  const SbContactLaw *law = sb_contact_law(model);
  const char *film = law->film != NULL ? law->film : texts->law;
  const bool inertia = sb_motion_kind(model)->inertia;
  const SbCounters *n = &plan->expected;
  const char *fit = sb_fit_kind(model->fit)->name;
  const double fit_off = fit_error(model), film_off = film_error(model);
  const Row rows[] = {
      {true, "contact load and width", fit,
       plan->ring ? costs->ring : (double)n->fit_solves * sb_cost_fit(model->fit), fit_off,
       texts->fit, NULL},
      {plan->ring, "ring", "", 0, 0, NULL, texts->ring},
      {true, "film", film, costs->states, film_off, film_reason(plan, model), NULL},
      {plan->reynolds, "film over speed", film, costs->speeds, SB_SPEED_TOLERANCE,
       "film and friction of every frame are those of its own speed", NULL},
      {plan->reynolds, "reynolds film", "", 0, 0, NULL, law->closed_film ? NULL : texts->film},
      {plan->film_history, "film history", "finite volumes",
       (double)n->film_steps * SB_COST_FILM_STEP, 0.03,
       "models.film_time = transient; the motion uses the friction of the steady film",
       model->film_history ? "models.film has no history, only reynolds"
                           : "models.film_time = steady: every frame has the film of its speed"},
      {true, "real contact area", sb_rough_model_name(model->surface),
       2.0 * count_fits(model) * SB_COST_ROUGH, 0, "boundary friction needs it", NULL},
      {true, "leak at rest", "percolation", SB_SEAL_COUNT * SB_COST_LEAK, 0,
       "part of each seal's figures", NULL},
      {true, "force and displacement", texts->motion,
       model->cycles * costs->motion + model->frames * SB_COST_FRAME,
       fmax(fit_off, inertia ? model->motion_tolerance : 0), texts->frames, NULL},
      {plan->life, "life", texts->motion, costs->life, 0, texts->life, "life.actuations = 1"},
      {plan->shelf != SB_SHELF_NOTHING, "loss on the shelf", plan->ring ? "ring" : "slab",
       plan->ring ? 5 * SB_COST_RING : SB_COST_CLOSED, plan->ring ? fit_off : 0,
       "the view shelf or a limit needs it", "no view, limit or study needs it"},
      {plan->bodies, "joint reactions", "constrained bodies", 0.1 + model->frames * 1e-4, 0,
       texts->joints, "not requested: one coordinate gives the same motion"},
      {plan->profiles, "contact profiles", plan->reynolds ? "reynolds" : fit,
       (double)n->profile_evaluations * (plan->reynolds ? SB_COST_FILM_PROFILE : SB_COST_CLOSED),
       fmax(fit_off, film_off), texts->profiles, "no view draws them"},
      {plan->section_fields, "interior fields", "ring",
       (int)n->field_evaluations * SB_COST_RING_SHAPE, fit_off, texts->sections,
       !draws_section ? "no view draws a section"
                      : "only models.fit = ring has them: the rings are drawn schematically"},
  };
  for (const Row *row = rows; row < rows + sizeof rows / sizeof rows[0]; row++) {
    const char *reason = row->wanted ? row->why : row->why_not;
    if (reason != NULL) {
      add(plan, row->wanted, row->name, row->model, row->cost, row->error, "%s", reason);
    }
  }
}

// Plans what the valve's views and figures need: profiles over x if they are drawn, and section
// fields only if the fit model has a section.
static void plan_valve(SbPlan *plan, const SbModel *model, const SbPlanWishes *wishes) {
  const unsigned views = wishes->views;
  const unsigned sections = views & (SB_VIEW_SECTION | SB_VIEW_DASHBOARD);
  const unsigned drawn = sections | (views & SB_VIEW_PROFILES);
  plan->film_history = plan->reynolds && model->film_history;
  plan->bodies = sb_motion_kind(model)->joints;
  plan->profiles = drawn != 0;
  plan->section_fields = sections != 0 && plan->ring;
  plan->shelf = shelf_wished(model, views);
  plan->permeation = plan->section_fields &&
                     (model->look.field == SB_FIELD_PERMEATION || plan->shelf != SB_SHELF_NOTHING);
  plan->over_edge = plan->section_fields && !wishes->coarse;

  plan->expected = expect(plan, model);
  Costs costs;
  Texts texts;
  valve_costs(&costs, plan, model);
  valve_texts(&texts, model, drawn, sections, (int)plan->expected.field_evaluations);
  add_valve_rows(plan, model, &costs, &texts, sections != 0);
}

// Returns the part of the plan that depends on the model only.
static SbPlan basis(const SbModel *model, bool life) {
  return (SbPlan){.ring = sb_fit_kind(model->fit)->section,
                  .reynolds = sb_contact_solves_film(model),
                  .life = life && model->life_actuations > 1,
                  .inertia = sb_motion_kind(model)->inertia,
                  .frames = model->frames,
                  .frame_films = true};
}

void sb_plan_figures(SbPlan *out, const SbModel *model, const int *figures, size_t count,
                     const SbModel *as_run) {
  const SbShelfDepth most =
      as_run != NULL ? shelf_wished(as_run, as_run->views) : SB_SHELF_OVER_TIME;
  *out = basis(model, true);
  bool errors = false; // of films at the frames' speeds, too
  for (size_t i = 0; i < count; i++) {
    const SbFigure *figure = sb_figure(figures[i]);
    const int seal = figure->seal == SB_INNER ? SB_INNER : SB_OUTER;
    // Friction drags a solved ring: its contact depends on the film.
    SbSealDepth needs =
        out->ring && figure->needs == SB_DEPTH_FITMENT ? SB_DEPTH_SLIDING : figure->needs;
    out->seal[seal] = needs > out->seal[seal] ? needs : out->seal[seal];
    out->film_laws = out->film_laws || figure->part == SB_PART_LAWS;
    errors = errors || sb_figure_is_estimate(figure);
    const SbShelfDepth shelf = shelf_of(figure) < most ? shelf_of(figure) : most;
    out->shelf = shelf > out->shelf ? shelf : out->shelf;
    if (figure->part == SB_PART_ESTIMATE_HISTORY) {
      out->film_history = out->reynolds && model->film_history;
    }
  }
  // Films at a speed that the motion decides need the motion.
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    out->motion = out->motion || out->seal[seal] == SB_DEPTH_WHOLE ||
                  (out->seal[seal] > SB_DEPTH_FITMENT && finds_speed(model));
  }
  if (!out->inertia && !out->film_history) {
    out->frames = 2; // for display only; the smallest possible number
    out->frame_films = errors;
  }
  if (out->motion) {
    out->seal[SB_OUTER] = out->seal[SB_INNER] = SB_DEPTH_WHOLE;
  }
}

void sb_plan_make(SbPlan *out, const SbModel *model) {
  sb_plan_wished(out, model, &(SbPlanWishes){model->views, model->studies, .life = true});
}

double sb_plan_cost(const SbPlan *plan) {
  double cost = 0;
  for (size_t i = 0; i < plan->field_count; i++) {
    cost += plan->field[i].cost_s;
  }
  return cost;
}

void sb_plan_wished(SbPlan *out, const SbModel *model, const SbPlanWishes *wishes) {
  *out = basis(model, wishes->life);
  if (wishes->resting) {
    out->inertia = false;
    out->frames = 2;
  }
  out->seal[SB_OUTER] = out->seal[SB_INNER] = SB_DEPTH_WHOLE;
  out->film_laws = out->motion = true;
  if (sb_motion_kind(model)->valve) {
    plan_valve(out, model, wishes);
  } else {
    out->ring = out->reynolds = false;
    plan_rig(out, model);
  }
  plan_studies(out, model, wishes->studies);
}

// Decides what a scene computes: its views and figures pull in fields, and nothing else is
// computed.
//
// Predicted cost is the number of solves times a typical time of one solve on one core, as
// `sealbench bench` measures it; predicted error is the tolerance for solvers and 0 for closed
// forms, whose own (model) error no discretisation shows. The counters in a run's results are the
// proof of the plan.
#include "engine/plan.h"

#include "engine/elastic/fit.h"
#include "engine/study/study.h"

#include <stdarg.h>
#include <stdio.h>

// Typical seconds per solve.
static const double cost_closed_form = 2e-6;
static const double cost_disc = 3e-3;
static const double cost_ring = 250e-3;
static const double cost_reynolds = 5e-3;
static const double cost_film_history = 2.0; // of a seal: fronts crossing the contact set its steps
static const double cost_film_step = 2e-3;   // of a frame besides
static const double cost_mixed = 2e-2;       // two of them, sliding and at rest
static const double cost_frame = 3e-7;

// Sliding states of a cycle: the outer seal in three chamber states, the inner in two, both ways.
enum { FIT_STATES = 5, FILM_STATES = 10 };

static void SB_PRINTF(7, 8)
    add(SbPlanItem *items, size_t *count, const char *name, const char *model, double cost,
        double error, const char *format, ...) {
  if (*count == SB_PLAN_ITEMS_MAX) {
    return;
  }
  SbPlanItem *item = &items[(*count)++];
  snprintf(item->name, sizeof item->name, "%s", name);
  snprintf(item->model, sizeof item->model, "%s", model);
  item->cost_s = cost;
  item->error = error;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(item->reason, sizeof item->reason, format, arguments);
  va_end(arguments);
}

// Names of the views that want something, "profiles, section".
static void view_names(unsigned views, char *text, size_t size) {
  static const char *const names[] = {"hysteresis", "profiles", "section",
                                      "dashboard",  "rig",      "life"};
  size_t used = 0;
  text[0] = '\0';
  for (unsigned i = 0; i < sizeof names / sizeof names[0]; i++) {
    if ((views & (1u << i)) != 0 && used < size) {
      used += (size_t)snprintf(text + used, size - used, "%s%s", used > 0 ? ", " : "", names[i]);
    }
  }
}

static void plan_fit(SbPlan *plan, const SbModel *model) {
  SbFitModel fit = (SbFitModel)model->fit;
  bool closed = fit != SB_FIT_DISC && fit != SB_FIT_DISC_THESIS && fit != SB_FIT_RING;
  double cost = closed ? cost_closed_form : fit == SB_FIT_RING ? cost_ring : cost_disc;
  plan->ring = fit == SB_FIT_RING;
  add(plan->field, &plan->field_count, "contact load and width", sb_fit_model_name(fit),
      FIT_STATES * cost, closed ? 0 : model->tolerance,
      "friction and film need them; %d pressure states of two seals", FIT_STATES);
  if (!plan->ring) {
    add(plan->skipped, &plan->skipped_count, "ring", "", 0, 0,
        "models.fit = %s already gives load and width", sb_fit_model_name(fit));
  }
}

static void plan_film(SbPlan *plan, const SbModel *model) {
  char name[32];
  if (model->asperities == SB_MODEL_ASPERITIES_COUPLED) {
    plan->reynolds = true;
    add(plan->field, &plan->field_count, "film", "reynolds with asperities",
        FILM_STATES * cost_mixed, model->tolerance,
        "models.asperities = coupled: film and asperities share the load");
    return;
  }
  plan->reynolds = model->film == SB_MODEL_FILM_REYNOLDS;
  sb_param_choice_name(sb_param(SB_P_MODELS_FILM), (int)model->film, name, sizeof name);
  add(plan->field, &plan->field_count, "film", name,
      FILM_STATES * (plan->reynolds ? cost_reynolds : cost_closed_form),
      plan->reynolds ? model->tolerance : 0,
      "boundary share, viscous friction and leakage need it");
  if (!plan->reynolds) {
    add(plan->skipped, &plan->skipped_count, "reynolds film", "", 0, 0,
        "models.film = %s meets what the friction needs", name);
  }
  plan->film_history = plan->reynolds && model->film_history;
  if (plan->film_history) {
    add(plan->field, &plan->field_count, "film history", "finite volumes",
        SB_SEAL_COUNT * (cost_film_history + model->frames * cost_film_step), 0.03,
        "models.film_time = transient; friction keeps to the steady film");
  } else {
    add(plan->skipped, &plan->skipped_count, "film history", "", 0, 0, "%s",
        model->film_history ? "models.film has no history, only reynolds"
                            : "models.film_time = steady: every frame has the film of its speed");
  }
}

static void plan_bodies(SbPlan *plan, const SbModel *model) {
  plan->bodies = model->motion == SB_MODEL_MOTION_BODIES;
  if (plan->bodies) {
    add(plan->field, &plan->field_count, "joint reactions", "constrained bodies",
        0.15 + model->frames * 2e-4, 0, "models.motion = bodies asks for them, %d joints",
        SB_VALVE_JOINTS);
  } else {
    add(plan->skipped, &plan->skipped_count, "joint reactions", "", 0, 0,
        "nobody asks for them: one coordinate gives the same motion");
  }
}

static void plan_rig(SbPlan *plan, const SbModel *model) {
  size_t samples = sb_rig_samples(&model->rig);
  add(plan->field, &plan->field_count, "thread force and plate", "rig",
      (double)samples * cost_frame, 0, "the coefficients come from its %zu samples", samples);
  add(plan->field, &plan->field_count, "real contact area", "greenwood-tripp", cost_closed_form, 0,
      "what the valve's surface model says under the plate's load");
  add(plan->skipped, &plan->skipped_count, "contact load and width", "", 0, 0,
      "the rig gives its load; there is no valve");
  add(plan->skipped, &plan->skipped_count, "film", "", 0, 0, "the rig's friction is its input");
}

// Studies are asked for one by one; the others share a line.
static void plan_studies(SbPlan *plan, const SbModel *model) {
  char others[160] = "";
  size_t used = 0;
  plan->studies = model->studies;
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    const char *name = sb_study_name((SbStudyKind)i);
    if ((model->studies & (1u << i)) != 0) {
      char item[40];
      snprintf(item, sizeof item, "study %s", name);
      add(plan->field, &plan->field_count, item, "several", sb_study_cost((SbStudyKind)i, model),
          model->tolerance, "output.studies asks for it");
    } else if (used < sizeof others) {
      used +=
          (size_t)snprintf(others + used, sizeof others - used, "%s%s", used > 0 ? ", " : "", name);
    }
  }
  if (used > 0) {
    add(plan->skipped, &plan->skipped_count, "studies", "", 0, 0,
        "output.studies does not ask for %s", others);
  }
}

void sb_plan_make(SbPlan *out, const SbModel *model) {
  *out = (SbPlan){0};
  if (model->motion == SB_MODEL_MOTION_RIG) {
    plan_rig(out, model);
    plan_studies(out, model);
    return;
  }
  plan_fit(out, model);
  plan_film(out, model);
  char surface[32];
  sb_param_choice_name(sb_param(SB_P_MODELS_SURFACE), (int)model->surface, surface, sizeof surface);
  add(out->field, &out->field_count, "real contact area", surface, FILM_STATES * cost_closed_form,
      0, "boundary friction needs it");
  char motion[32];
  sb_param_choice_name(sb_param(SB_P_MODELS_MOTION), (int)model->motion, motion, sizeof motion);
  add(out->field, &out->field_count, "force and displacement", motion, model->frames * cost_frame,
      0, "figures of the cycle, %d frames", model->frames);
  plan_bodies(out, model);

  if (model->life_actuations > 1) {
    double each = model->motion == SB_MODEL_MOTION_QUASI_STATIC ? 1e-4 : 5e-3;
    add(out->field, &out->field_count, "life", motion, model->life_actuations * each, 0,
        "%d actuations while the roughness runs in; fitment and film are the first's",
        model->life_actuations);
  } else {
    add(out->skipped, &out->skipped_count, "life", "", 0, 0, "life.actuations = 1");
  }

  // Profiles over x, for whoever draws them.
  char who[80];
  unsigned drawn = SB_VIEW_PROFILES | SB_VIEW_SECTION | SB_VIEW_DASHBOARD;
  out->profiles = (model->views & drawn) != 0;
  view_names(model->views & drawn, who, sizeof who);
  if (out->profiles) {
    add(out->field, &out->field_count, "contact profiles",
        out->reynolds ? "reynolds" : "closed form", FILM_STATES * 2e-5,
        out->reynolds ? model->tolerance : 0, "drawn by %s", who);
  } else {
    add(out->skipped, &out->skipped_count, "contact profiles", "", 0, 0, "no view draws them");
  }

  // Interior fields, only for a drawn section and only where the fitment model has an interior.
  unsigned sections = model->views & (SB_VIEW_SECTION | SB_VIEW_DASHBOARD);
  bool interior = model->fit == SB_FIT_RING;
  view_names(sections, who, sizeof who);
  out->section_fields = sections != 0 && interior;
  if (out->section_fields) {
    add(out->field, &out->field_count, "interior fields", "ring", 2e-3, model->tolerance,
        "drawn by %s, at drawn frames only", who);
  } else {
    add(out->skipped, &out->skipped_count, "interior fields", "", 0, 0, "%s",
        sections == 0 ? "no view draws a section"
                      : "the closed-form fitment has no interior: the section is schematic");
  }
  plan_studies(out, model);
}

// See contradiction.h.
#include "engine/valve/run/contradiction.h"

#include "engine/valve/figures/figures.h"
#include "engine/valve/model/model.h"
#include "engine/valve/model/motion_kind.h"
#include "engine/valve/run/valve_type.h"

#include <math.h>

// Rounding of a sum of forces, relative and absolute [N].
static const double rounding = 1e-6, rounding_force = 1e-9;

typedef struct {
  char *text;
  size_t size;
  const SbSummary *summary;
  const SbModel *model;
} Check;

static double value_of(const Check *check, const char *path) {
  return sb_figure_value(check->summary, sb_figure_find(path));
}

// A force that exceeds another which bounds it; unknown ones do not.
static bool exceeds(double force, double bound) {
  return force > bound + rounding * fabs(bound) + rounding_force;
}

static bool differ(double a, double b) {
  return isnan(a) != isnan(b) || fabs(a - b) > rounding * fmax(fabs(a), fabs(b));
}

// The outcome against the figures that follow from it.
static bool outcome_contradicts(const Check *check) {
  const SbSummary *s = check->summary;
  const char *name = sb_outcome_name(s->outcome);
  const bool stuck = s->outcome == SB_OUTCOME_STUCK, never = s->outcome == SB_OUTCOME_NEVER_MOVED;
  const bool strokes = s->outcome == SB_OUTCOME_RETURNED || s->outcome == SB_OUTCOME_HELD;
  const SbStage emptied = sb_valve_type(check->model)->fills_at_rest ? SB_STAGE_D : SB_STAGE_F;
  const char *wrong = NULL;
  if (s->returns != (s->outcome == SB_OUTCOME_RETURNED) ||
      (isfinite(s->returned) && (s->returned > 0) != s->returns)) {
    wrong = "cycle.returns";
  } else if (isfinite(s->stuck_at) != stuck) {
    wrong = "cycle.stuck_at_m";
  } else if (stuck && s->force_return_margin > 0) {
    wrong = "cycle.force_return_margin_N";
  } else if (never && (isfinite(s->force_return_min) || isfinite(s->force_return_margin))) {
    wrong = "cycle.force_return_min_N";
  } else if (!strokes && isfinite(s->leakage_carried)) {
    wrong = "cycle.leakage_carried_all_actuations_m3";
  } else if (!strokes && (isfinite(s->leakage_per_cycle) || isfinite(s->leakage_net))) {
    wrong = "cycle.leakage_per_cycle_m3";
  } else if ((stuck || never) && isfinite(s->dose_mass) && !s->stage[emptied].reached) {
    wrong = "cycle.dose_mass_kg";
  } else if (isfinite(s->force_return_margin) && s->stage[SB_STAGE_D].reached &&
             s->stage[SB_STAGE_E].reached &&
             s->stage[SB_STAGE_E].time > s->stage[SB_STAGE_D].time + 1e-6 && !(s->dwell > 0)) {
    wrong = "cycle.force_return_margin_N"; // it has the friction of no dwell
  }
  if (wrong != NULL) {
    sb_text(check->text, check->size, "%s = %g contradicts the outcome %s", wrong,
            value_of(check, wrong), name != NULL ? name : "unknown");
  }
  return wrong != NULL;
}

// A seal that the fluid opens against its leak, and an open outer seal against the leakages.
static bool seal_contradicts(const Check *check) {
  const SbSummary *s = check->summary;
  const bool open = s->seal[SB_OUTER].leak_state == SB_LEAK_OPEN;
  if (open && (isfinite(s->leakage_per_cycle) || isfinite(s->leakage_carried))) {
    sb_text(check->text, check->size, "a leakage of films is known, but the outer seal is open");
    return true;
  }
  for (int seal = 0; seal < SB_SEAL_COUNT && s->status == SB_OK; seal++) {
    const SbLeakState state = s->seal[seal].leak_state;
    const SbContact *back = &s->contact[seal].back;
    const bool opened =
        s->seal[seal].opened || (back->known && back->load > 0 && isnan(back->friction));
    if (opened && (state == SB_LEAK_CLOSED || state == SB_LEAK_PERCOLATING)) {
      sb_text(check->text, check->size, "the fluid opens the %s seal, but its leak is %s",
              sb_seal_name(seal), sb_leak_state_name(state));
      return true;
    }
    if (state == SB_LEAK_OPEN && s->verdict[SB_VERDICT_SEALS].ok != SB_ANSWER_NO) {
      sb_text(check->text, check->size, "the %s seal is open, but the verdict is not no",
              sb_seal_name(seal));
      return true;
    }
  }
  return false;
}

// Largest area of the loop of one press with the summary's peak force [J]: a machine's platen or a
// finger moves in once, to the stop and what it and the machine yield.
static double largest_loop(const Check *check) {
  const SbModel *model = check->model;
  const double peak = check->summary->force_peak, hold = fmax(model->reversal_force, 1.1 * peak);
  return 1.01 * peak * (model->stroke + hold / model->stiffness + 2 * hold / model->stop_stiffness);
}

// Forces against the peak, and the energy of one cycle.
static bool motion_contradicts(const Check *check) {
  const SbSummary *s = check->summary;
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    const SbStageMark *mark = &s->stage[i];
    const char *name = sb_stage_name((SbStage)i);
    if (mark->reached && exceeds(mark->force, s->force_peak)) {
      sb_text(check->text, check->size, "the force at stage %s, %.9g N, is above the peak, %.9g N",
              name, mark->force, s->force_peak);
      return true;
    }
  }
  const bool presses =
      check->model->drive == SB_MODEL_DRIVE_MACHINE || check->model->drive == SB_MODEL_DRIVE_HAND;
  if (presses && sb_motion_kind(check->model)->valve &&
      exceeds(s->energy.loop, largest_loop(check))) {
    sb_text(check->text, check->size, "the loop's area, %.9g J, is that of more than one cycle",
            s->energy.loop);
    return true;
  }
  if (exceeds(s->force_press, s->force_peak) || exceeds(s->force_breakaway, s->force_press)) {
    sb_text(check->text, check->size, "break-away %.9g N, press force %.9g N and peak %.9g N",
            s->force_breakaway, s->force_press, s->force_peak);
    return true;
  }
  return false;
}

// Fractions outside 0 to 1.
static bool fraction_contradicts(const Check *check) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const double value = sb_figure_value(check->summary, i);
    if (sb_figure(i)->quantity == SB_FIGURE_QUANTITY_FRACTION &&
        (value < -1e-9 || value > 1 + 1e-7)) {
      sb_text(check->text, check->size, "%s = %.9g is not between 0 and 1", sb_figure(i)->path,
              value);
      return true;
    }
  }
  return false;
}

// Figures that the run states twice.
static bool twice_contradicts(const Check *check) {
  static const char *const seals[][2] = {
      {"load_N", "contact.in_stroke.load_N"},
      {"contact_width_m", "contact.in_stroke.contact_width_m"},
      {"pressure_peak_Pa", "contact.in_stroke.pressure_peak_Pa"},
      {"film_min_m", "contact.in_stroke.film_min_m"},
      {"film_central_m", "contact.in_stroke.film_central_m"},
      {"real_area_share", "contact.in_stroke.real_area_share"},
  };
  const SbSummary *s = check->summary;
  if (s->stage[SB_STAGE_B].reached && differ(s->force_breakaway, s->stage[SB_STAGE_B].force) &&
      s->status == SB_OK && sb_motion_kind(check->model)->valve) {
    sb_text(check->text, check->size, "break-away %.9g N, but stage B %.9g N", s->force_breakaway,
            s->stage[SB_STAGE_B].force);
    return true;
  }
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (size_t i = 0; i < sizeof seals / sizeof *seals; i++) {
      char path[2][64];
      double value[2];
      for (int k = 0; k < 2; k++) {
        sb_text(path[k], sizeof path[k], "seals.%s.%s", sb_seal_name(seal), seals[i][k]);
        value[k] = value_of(check, path[k]);
      }
      if (s->contact[seal].in_stroke.known && differ(value[0], value[1])) {
        sb_text(check->text, check->size, "%s = %.9g, but %s = %.9g", path[0], value[0], path[1],
                value[1]);
        return true;
      }
    }
    if (s->seal[seal].film_min > s->seal[seal].film_central * 1.001) {
      sb_text(check->text, check->size, "the %s seal's minimum film is above its central one",
              sb_seal_name(seal));
      return true;
    }
  }
  return false;
}

// An answer against the figure that decides it.
static bool verdict_contradicts(const Check *check) {
  const int margin = sb_figure_find("cycle.force_return_margin_N");
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    const SbVerdict *v = &check->summary->verdict[kind];
    const double value = v->figure >= 0 ? sb_figure_value(check->summary, v->figure) : NAN;
    bool wrong = v->figure >= 0 && isfinite(v->value) && value != v->value;
    wrong = wrong || (v->ok == SB_ANSWER_UNKNOWN && v->reason[0] == '\0');
    if (kind == SB_VERDICT_RETURNS && v->ok == SB_ANSWER_YES) {
      wrong = wrong || check->summary->outcome != SB_OUTCOME_RETURNED ||
              check->summary->force_return_margin < 0;
    }
    if (v->figure == margin && isnan(v->limit) && v->ok == SB_ANSWER_NO) {
      wrong = wrong || !(v->value <= 0);
    }
    for (size_t i = 0; i < check->model->limits.count; i++) {
      const SbLimit *limit = &check->model->limits.item[i];
      const double held = sb_figure_value(check->summary, limit->figure);
      const bool broken = held < limit->low || held > limit->high;
      const bool of_kind = (int)sb_figure(limit->figure)->verdict == kind;
      wrong = wrong || (of_kind && broken && v->ok == SB_ANSWER_YES);
    }
    if (wrong) {
      sb_text(check->text, check->size,
              "the verdict \"%s\" (answer %d) contradicts its figure %s = %g",
              sb_verdict_name((SbVerdictKind)kind), (int)v->ok,
              v->figure >= 0 ? sb_figure(v->figure)->path : "(none)", v->value);
      return true;
    }
  }
  return false;
}

bool sb_summary_contradiction(char *text, size_t size, const SbSummary *summary,
                              const SbModel *model) {
  const Check check = {text, size, summary, model};
  text[0] = '\0';
  return outcome_contradicts(&check) || seal_contradicts(&check) || motion_contradicts(&check) ||
         fraction_contradicts(&check) || twice_contradicts(&check) || verdict_contradicts(&check);
}

// The verdict on a valve: six criteria, each decided by the figure that is worst against its limit.
//
// A seal seals if it has contact, the contact pressure of the rubber exceeds the part that the
// fluid carries, its peak pressure is above the fluid's, and friction does not jam it. Channels
// between asperities are judged by the limit of leakage. A criterion without a limit has no answer,
// except the first one and the return, which need none.
#include "engine/valve/figures/figures.h"

#include "engine/contact/closed_forms.h"
#include "engine/valve/model/model.h"
#include "engine/valve/model/motion_kind.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *sb_verdict_name(SbVerdictKind kind) {
  static const char *const names[] = {"seals", "presses", "returns", "doses", "leak", "fits"};
  return names[kind];
}

static int seal_figure(int seal, const char *name) {
  char path[64];
  snprintf(path, sizeof path, "seals.%s.%s", sb_seal_name(seal), name);
  return sb_figure_find(path);
}

static bool any_open(const SbSummary *summary) {
  return summary->seal[SB_OUTER].leak_state == SB_LEAK_OPEN ||
         summary->seal[SB_INNER].leak_state == SB_LEAK_OPEN;
}

// Returns the relative distance of a figure from its limit; the largest possible one without a
// value.
static double margin(const SbVerdict *of) {
  double distance = fabs(of->value - of->limit) / fmax(fabs(of->limit), 1e-300);
  return isnan(distance) ? INFINITY : distance;
}

// Returns whether the same figure without a limit is worse in *next.
static bool lesser(const SbVerdict *worst, const SbVerdict *next) {
  const bool alone = isnan(worst->limit) && isnan(next->limit) && worst->figure == next->figure;
  return alone && sb_figure(next->figure)->better == SB_BETTER_MORE && next->value < worst->value;
}

bool sb_verdict_take_worse(SbVerdict *worst, const SbVerdict *next) {
  static const int badness[] = {[SB_ANSWER_YES] = 0, [SB_ANSWER_UNKNOWN] = 1, [SB_ANSWER_NO] = 2};
  int more = badness[next->ok] - badness[worst->ok];
  bool worse = worst->figure < 0 || more > 0;
  if (!worse && more == 0) {
    worse = (next->ok == SB_ANSWER_YES && margin(next) < margin(worst)) ||
            (next->ok == SB_ANSWER_NO && margin(next) > margin(worst)) || lesser(worst, next);
  }
  if (worse) {
    *worst = *next;
  }
  return worse;
}

// Returns the largest difference of the film models that were computed for the figure's seal, in
// the figure's unit; 0 for a figure that no other model has computed.
static double film_spread(const SbSummary *summary, int index) {
  const SbFigure *figure = sb_figure(index);
  const bool film = figure->error == SB_BY_FILM || figure->error == SB_BY_FILM_LEAST;
  if (!film || figure->seal == SB_SEAL_COUNT) {
    return 0;
  }
  const SbSealState *of = &summary->seal[figure->seal];
  const double by[] = {of->film_karaszkiewicz, of->film_thesis, of->film_asymptotic,
                       of->film_reynolds};
  double low = of->film_central, high = of->film_central;
  for (size_t i = 0; i < sizeof by / sizeof *by; i++) { // without NaN
    low = fmin(low, by[i]);
    high = fmax(high, by[i]);
  }
  const double spread = (high - low) / of->film_central * fabs(sb_figure_value(summary, index));
  return spread > 0 ? spread : 0;
}

// What is judged.
typedef struct {
  const SbSummary *summary;
  const SbModel *model;
  const double *spread; // [SB_FIGURE_COUNT] between models computed elsewhere; NULL: none
} Judged;

// Makes an answer unknown whose figure is nearer to `bound` than it is known.
static void doubt(SbVerdict *of, const Judged *judged, double bound) {
  const double margin = fabs(of->value - bound);
  const bool error = margin < sb_figure_error_absolute(judged->summary, of->figure);
  const bool models = margin < film_spread(judged->summary, of->figure) ||
                      (judged->spread != NULL && margin < judged->spread[of->figure]);
  if (of->ok != SB_ANSWER_UNKNOWN && (error || models)) {
    of->ok = SB_ANSWER_UNKNOWN;
    sb_message(of->reason, SB_TEXT, "uncertain: the margin of %s is less than %s",
               sb_figure(of->figure)->path,
               error ? "its estimated error" : "the difference between the computed models");
  }
}

// Makes a yes unknown if a ring overfills a groove whose walls the fitment model does not include:
// load and friction are then larger than computed.
static void doubt_walls(SbVerdict *of, const SbModel *model, int seal) {
  const double fill = model->seal[seal].gland_fill;
  if (of->ok == SB_ANSWER_YES && sb_fit_ignores_walls(model->fit, fill)) {
    of->ok = SB_ANSWER_UNKNOWN;
    sb_message(of->reason, SB_TEXT,
               "uncertain: the %s ring overfills its groove (gland fill %.3g %%), whose walls "
               "models.fit = %s does not include (ring does)",
               sb_seal_name(seal), 100 * fill, sb_fit_kind(model->fit)->name);
  }
}

static SbVerdict judge_seal(const Judged *judged, int seal) {
  const SbSummary *summary = judged->summary;
  const SbModel *model = judged->model;
  const SbSealState *of = &summary->seal[seal];
  SbSealPressure side = sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST);
  int figure = seal_figure(seal, "pressure_peak_Pa");
  SbVerdict out = {SB_ANSWER_YES, figure, of->pressure_peak, fabs(side.left - side.right), ""};
  if (of->leak_state == SB_LEAK_OPEN) {
    out.ok = SB_ANSWER_NO;
    sb_message(out.reason, SB_TEXT, "the %s seal is open: %s", sb_seal_name(seal),
               sb_figure_reason(summary, seal_figure(seal, "leakage_static_m3_per_s")));
  } else if (isnan(of->pressure_peak)) {
    out.ok = SB_ANSWER_UNKNOWN;
    sb_message(out.reason, SB_TEXT, "%s", sb_figure_reason(summary, figure));
  } else if (!(of->pressure_peak > out.limit)) {
    out.ok = SB_ANSWER_NO;
    sb_message(out.reason, SB_TEXT, "the %s seal's peak pressure is not above the fluid's",
               sb_seal_name(seal));
  }
  if (of->leak_state != SB_LEAK_OPEN) {
    doubt(&out, judged, out.limit);
  }
  // A model that does not solve the stretch cannot decide that a ring seals if its estimate does
  // not reach the bore.
  SbFitProblem problem;
  sb_model_fit_problem(&problem, model, seal, 0);
  const double left = sb_interference_on_floor(&problem);
  if (out.ok == SB_ANSWER_YES && !sb_fit_kind(model->fit)->section && !(left > 0)) {
    out.ok = SB_ANSWER_UNKNOWN;
    sb_message(out.reason, SB_TEXT,
               "uncertain: stretched onto its groove floor the %s ring stays an estimated %.2g mm "
               "short of the bore, which models.fit = %s cannot judge (ring can)",
               sb_seal_name(seal), -1e3 * left, sb_fit_kind(model->fit)->name);
  }
  doubt_walls(&out, model, seal);
  // A section that jams blocks the stem; one that rolls seals, and is reported.
  const SbContacts *contact = &summary->contact[seal];
  for (int way = 0; way < 2; way++) {
    const SbContact *of_way = way == 0 ? &contact->in_stroke : &contact->back;
    bool jams = of_way->known && of_way->section == SB_RING_JAMS;
    bool rolls = of_way->known && of_way->section == SB_RING_ROLLS;
    if (out.ok == SB_ANSWER_YES && (jams || (rolls && out.reason[0] == '\0'))) {
      out.ok = jams ? SB_ANSWER_NO : out.ok;
      sb_message(out.reason, SB_TEXT,
                 "the %s ring %s on the %s: friction turns its section by %.0f degrees",
                 sb_seal_name(seal), jams ? "jams" : "rolls", way == 0 ? "in-stroke" : "return",
                 of_way->rotation);
    }
  }
  return out;
}

static SbVerdict judge_limit(const Judged *judged, const SbLimit *limit) {
  const SbSummary *summary = judged->summary;
  const SbFigure *figure = sb_figure(limit->figure);
  double value = sb_figure_value(summary, limit->figure);
  bool near_high = !isfinite(limit->low) || value - limit->low > limit->high - value;
  SbVerdict out = {SB_ANSWER_YES, limit->figure, value, near_high ? limit->high : limit->low, ""};
  if (isnan(value)) {
    bool open = figure->verdict == SB_VERDICT_LEAK && any_open(summary);
    out.ok = open ? SB_ANSWER_NO : SB_ANSWER_UNKNOWN;
    out.limit = isfinite(limit->high) ? limit->high : limit->low;
    sb_message(out.reason, SB_TEXT, "%s", sb_figure_reason(summary, limit->figure));
  } else if (value < limit->low || value > limit->high) {
    out.ok = SB_ANSWER_NO;
    out.limit = value < limit->low ? limit->low : limit->high;
    // Value and limit are fields of their own: each surface prints them in one format.
    sb_message(out.reason, SB_TEXT, "%s is %s its limit", figure->path,
               value < limit->low ? "below" : "above");
  }
  doubt(&out, judged, out.limit);
  return out;
}

// Whether the stem returns: by its outcome and by the return margin, the figure that decides.
static SbVerdict judge_return(const Judged *judged) {
  const SbSummary *summary = judged->summary;
  const int figure = sb_figure_find("cycle.force_return_margin_N");
  const double value = summary->force_return_margin;
  SbVerdict out = {SB_ANSWER_UNKNOWN, figure, value, NAN, ""};
  switch (summary->outcome) {
  case SB_OUTCOME_UNKNOWN:
  case SB_OUTCOME_NEVER_MOVED:
    sb_message(out.reason, SB_TEXT, "%s",
               sb_figure_reason(summary, sb_figure_find("cycle.returns")));
    break;
  case SB_OUTCOME_HELD:
    sb_message(out.reason, SB_TEXT,
               "the drive restrains the stem until its motion ends: there is no return to judge");
    break;
  case SB_OUTCOME_STUCK:
    out.ok = SB_ANSWER_NO;
    sb_message(out.reason, SB_TEXT, "the stem is stuck at %.4g mm", 1e3 * summary->stuck_at);
    doubt(&out, judged, 0);
    break;
  case SB_OUTCOME_RETURNED:
    out.ok = value >= 0 ? SB_ANSWER_YES : SB_ANSWER_NO;
    sb_message(out.reason, SB_TEXT, "%s",
               value >= 0 ? ""
                          : "where the stem stops on its return, static friction exceeds the force "
                            "that pushes it back");
    doubt(&out, judged, 0);
    doubt_walls(&out, judged->model, SB_OUTER);
    doubt_walls(&out, judged->model, SB_INNER);
    break;
  }
  return out;
}

// Sizes that do not belong together change the forces, those of the chamber the dose: the verdict
// on the return states them if it is yes, that on the dose states its own if it is yes.
static void state_sizes(SbVerdict *verdict, const SbModel *model) {
  for (int i = 0; i < SB_SIZE_CHECKS; i++) {
    char text[SB_TEXT];
    SbParamId id;
    const bool wrong = sb_params_size_check(text, &id, &model->params, i) != NULL;
    const bool dose =
        id == SB_P_STEM_CHAMBER_LENGTH && verdict[SB_VERDICT_DOSES].ok == SB_ANSWER_YES;
    SbVerdict *of = &verdict[dose ? SB_VERDICT_DOSES : SB_VERDICT_RETURNS];
    if (wrong && of->ok == SB_ANSWER_YES && of->reason[0] == '\0') {
      sb_message(of->reason, SB_TEXT, "%s", text);
    }
  }
}

void sb_verdict_judge(SbVerdict verdict[SB_VERDICT_COUNT], const SbSummary *summary,
                      const SbModel *model, const double *spread) {
  const Judged judged = {summary, model, spread};
  const int margin_figure = sb_figure_find("cycle.force_return_margin_N");
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    verdict[kind] = (SbVerdict){SB_ANSWER_UNKNOWN, -1, NAN, NAN, "no limit is set"};
  }
  if (!sb_motion_kind(model)->valve) {
    sb_message(verdict[SB_VERDICT_SEALS].reason, SB_TEXT, "the sliding plate seals nothing");
  } else {
    SbVerdict *seals = &verdict[SB_VERDICT_SEALS];
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      SbVerdict of = judge_seal(&judged, seal), other = *seals;
      other = sb_verdict_take_worse(seals, &of) ? other : of;
      if (seals->ok == SB_ANSWER_YES && other.ok == SB_ANSWER_YES && seals->reason[0] == '\0') {
        memcpy(seals->reason, other.reason, sizeof seals->reason); // the other one rolls
      }
    }
  }
  verdict[SB_VERDICT_RETURNS] = judge_return(&judged);
  if (summary->outcome == SB_OUTCOME_NEVER_MOVED) {
    const int press = sb_figure_find("cycle.force_press_N");
    verdict[SB_VERDICT_PRESSES] = (SbVerdict){SB_ANSWER_NO, press, NAN, NAN, ""};
    sb_message(verdict[SB_VERDICT_PRESSES].reason, SB_TEXT, "%s", sb_figure_reason(summary, press));
  }
  if (summary->dose_mass == 0 && model->canister_pressure > 0) {
    verdict[SB_VERDICT_DOSES] = (SbVerdict){
        SB_ANSWER_NO, sb_figure_find("cycle.dose_mass_kg"), 0, NAN,
        "the chamber retains its dose: no port opens it to the outside for long enough"};
  } else if (summary->dose_mass == 0 ||
             (!(model->canister_pressure > 0) && summary->outcome == SB_OUTCOME_STUCK)) {
    verdict[SB_VERDICT_DOSES] =
        (SbVerdict){SB_ANSWER_NO, sb_figure_find("cycle.dose_mass_kg"), summary->dose_mass, NAN,
                    "the canister's pressure is not above ambient: nothing is delivered"};
  }
  for (size_t i = 0; i < model->limits.count; i++) {
    const SbLimit *limit = &model->limits.item[i];
    SbVerdictKind kind = sb_figure(limit->figure)->verdict;
    SbVerdict of = judge_limit(&judged, limit);
    if (kind == SB_VERDICT_RETURNS && verdict[kind].ok == SB_ANSWER_YES) {
      // The return margin decides. A limit on the margin replaces the margin itself; a limit on
      // another figure judges that figure and appears only if it is violated.
      if (limit->figure != margin_figure && of.ok == SB_ANSWER_YES) {
        continue;
      }
      if (isnan(verdict[kind].limit)) {
        verdict[kind].figure = -1;
      }
    }
    sb_verdict_take_worse(&verdict[kind], &of);
  }
  state_sizes(verdict, model);
}

void sb_verdict_fill(SbSummary *summary, const SbModel *model) {
  sb_verdict_judge(summary->verdict, summary, model, NULL);
}

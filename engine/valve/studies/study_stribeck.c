// Stribeck curve: coefficient of friction, real contact and film of both seals against the sliding
// speed, in the middle of the in-stroke (chamber as at rest) and of the return.
//
// The states are those from which the cycle's friction is interpolated (speed_states.h), in a run
// of the scene: curve and cycle are one solution, and a point is at the cycle's own speed. Film,
// asperities and friction are the scene's models; with models.asperities = coupled film and
// asperities share the load (film/ehl.h). The contact of a ring has the drag at the cycle's speed,
// so this is one valve and no grid. Between solved speeds the curve is interpolated, with its error
// reported.
#include "engine/valve/model/motion_kind.h"
#include "engine/valve/run/cycle.h"
#include "engine/valve/states/contact_law.h"
#include "engine/valve/states/speed_states.h"
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <string.h>

enum { POINTS = SB_STRIBECK_POINTS, LINES = SB_STRIBECK_LINES };
enum { COEFFICIENT, AREA, RATIO, CENTRAL, LEAST, BOUNDARY, VISCOUS, SHARE };

static const struct {
  const char *name, *friction;
  int seal, way;
} lines[LINES] = {
    {SB_LABEL("outer seal, in"), "seals.outer.contact.in_stroke.friction_N", SB_OUTER, SB_CYCLE_IN},
    {SB_LABEL("outer seal, back"), "seals.outer.contact.return.friction_N", SB_OUTER, SB_CYCLE_OUT},
    {SB_LABEL("inner seal, in"), "seals.inner.contact.in_stroke.friction_N", SB_INNER, SB_CYCLE_IN},
    {SB_LABEL("inner seal, back"), "seals.inner.contact.return.friction_N", SB_INNER,
     SB_CYCLE_OUT}};

static void solve(double *value, SbStudyWork *work, int line, double speed) {
  SbSealState state;
  SbReport report;
  if (work->status != SB_OK) {
    return;
  }
  SbStatus status = sb_evaluator_sliding(&state, work->evaluator, lines[line].seal, lines[line].way,
                                         speed, &report);
  if (!sb_study_goes_on(work, status, &report) || !(state.film_central > 0)) {
    return;
  }
  const double friction = sb_sliding_friction(&state);
  if (friction > 0) {
    work->out->error = fmax(work->out->error, state.friction_error / friction);
  }
  value[RATIO] = state.lambda;
  value[CENTRAL] = state.film_central;
  value[LEAST] = state.film_min;
  value[BOUNDARY] = state.boundary_area + state.boundary_load;
  value[VISCOUS] = state.friction_viscous;
  value[COEFFICIENT] = friction / state.load;
  value[SHARE] = state.asperity_share;
  value[AREA] = state.real_area_share;
}

// Speeds at which a line is drawn: evenly, and that of the cycle.
static int places(double at[POINTS + 1], const SbStudyWork *work, double own) {
  int count = 0;
  bool open = own >= work->lo && own <= work->hi;
  for (int i = 0; i < POINTS; i++) {
    const double even = sb_study_place(work, i, POINTS);
    if (open && own <= even) {
      at[count++] = own;
      open = false;
    }
    if (even != own) {
      at[count++] = even;
    }
  }
  return count;
}

// Adds the errors of the films, and reports speeds without a film. solve() adds those of the
// friction. `before`: steps of work that the study has counted.
static void account(SbStudyWork *work, size_t before) {
  SbStudy *out = work->out;
  const SbSummary *summary = sb_evaluator_summary(work->evaluator);
  out->error = fmax(out->error, summary->error_film);
  out->solves += summary->counters.speed_nodes;
  work->budget.done += summary->work - before;
  for (size_t i = 0; i < summary->warnings.count; i++) {
    const SbWarning *warning = &summary->warnings.item[i];
    if (strcmp(warning->code, "film-speed") == 0) {
      sb_study_gap(out, NAN, warning->text);
      sb_warn(&out->warnings, warning->code, warning->input, "%s", warning->text);
    }
  }
}

static void make(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  const SbOverride once = {SB_P_LIFE_ACTUATIONS, 1};
  const char *path[LINES];
  double friction[LINES], at[POINTS + 1];
  if (sb_motion_kind(model)->valve) {
    work->base = *model; // as it moves
  }
  if (work->hi > SB_SPEED_MOST) {
    work->hi = SB_SPEED_MOST;
    sb_study_note(out, "The cycle has films up to %g m/s: the curves end there.", SB_SPEED_MOST);
  }
  for (int i = 0; i < LINES; i++) {
    path[i] = lines[i].friction;
  }
  sb_study_ask(work, friction, path, LINES, &once, 1);
  const SbSummary *summary = sb_evaluator_summary(work->evaluator);
  if (!out->complete) {
    return; // the scene's own run did not converge
  }
  if (work->status == SB_OK && (summary == NULL || !(summary->seal[SB_OUTER].film_central > 0))) {
    work->status =
        sb_fail_input(work->report, SB_ERROR_INFEASIBLE, sb_input(SB_P_SEAL_SECTION_DIAMETER),
                      "the outer seal carries no load: there is no film");
  }
  if (work->status != SB_OK) {
    return;
  }
  const size_t counted = summary->work;
  double own[2];
  for (int i = 0; i < LINES; i++) {
    const SbContacts *contact = &summary->contact[lines[i].seal];
    const bool in = lines[i].way == SB_CYCLE_IN;
    own[!in] = fabs(in ? contact->in_stroke.speed : contact->back.speed);
    const int count = places(at, work, own[!in]);
    sb_study_curves(work, SB_STUDY_CURVE, lines[i].name, i, at, count);
  }
  for (int i = 0; i < POINTS; i += 5) {
    const double speed = sb_study_place(work, i, POINTS);
    SbStudyRow *row = speed < 1 ? sb_study_row(out, "%.3g mm/s", speed * 1e3)
                                : sb_study_row(out, "%.3g m/s", speed);
    sb_study_cells(row->value, work, speed, 0);
  }
  sb_study_level(work, &out->panel[2], SB_LABEL("film = roughness"), 1);
  sb_study_mark(work, own[0], own[0] == own[1] ? SB_LABEL("cycle") : SB_LABEL("cycle, in"));
  if (own[0] != own[1]) {
    sb_study_mark(work, own[1], SB_LABEL("cycle, back"));
  }
  account(work, counted);
  sb_study_note(out, "Roughness %.3g \xc2\xb5m, shear strength %.3g MPa, m %.3g on %s.",
                model->sigma * 1e6, model->shear_strength * 1e-6, model->load_coefficient,
                sb_contact_law(model)->shares ? "the asperities' load" : "the total load");
}

const SbStudyDesign sb_study_stribeck = {
    .x = SB_QUANTITY("sliding speed", "mm/s"),
    .x_logarithmic = true,
    .panel = {SB_LABEL("coefficient of friction"), SB_QUANTITY("real contact", "%"),
              SB_LABEL("central film over roughness")},
    .logarithmic = {true, false, true},
    .range = offsetof(SbStudyRange, speed_min),
    .row_heading = SB_LABEL("outer seal, in, at"),
    .column = {SB_QUANTITY("central film", "nm"), SB_QUANTITY("minimum film", "nm"),
               SB_LABEL("film over roughness"), SB_QUANTITY("boundary friction", "N"),
               SB_QUANTITY("viscous friction", "N"), SB_LABEL("coefficient"),
               SB_QUANTITY("load on asperities", "%"), SB_QUANTITY("real contact", "%")},
    .value = {CENTRAL, LEAST, RATIO, BOUNDARY, VISCOUS, COEFFICIENT, SHARE, AREA},
    .models = "the scene's own, at the pressures of the cycle",
    .validity =
        "steady sliding; 1 \xc2\xb5m/s to 10 m/s; a ring's contact is that of the cycle's speed",
    .solve = solve,
    .make = make,
};

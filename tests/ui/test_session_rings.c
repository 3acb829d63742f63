// A session whose rings are solved: in which order states are shown, what of them may be kept, what
// an edit cancels, what is predicted of a loop, and what comes back at once. Needs no display.
#include "app/session/session.h"

#include "app/session/session_private.h"
#include "app/session/stored_run.h"
#include "engine/valve/figures/figures.h"
#include "tests/sanitized.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>
#include <time.h>

static void turn(SbSession *session) {
  while (g_main_context_iteration(NULL, FALSE)) {
  }
  sb_session_tick(session, g_get_monotonic_time());
  g_usleep(1000);
}

static void count_up(int *count) {
  ++*count;
}

// Dry rings without pressure, films by a law: two seconds of a processor each.
static void set_rings(SbSession *session) {
  sb_session_set_auto_run(session, FALSE);
  sb_session_edit(session, SB_P_MODELS_FILM, "thesis");
  sb_session_edit(session, SB_P_CANISTER_PRESSURE, "0 MPa");
  sb_session_edit(session, SB_P_FRICTION_SHEAR_STRENGTH, "0.3 MPa");
  sb_session_edit(session, SB_P_OUTPUT_FRAMES, "60");
  sb_session_edit(session, SB_P_MODELS_FIT, "ring");
  g_assert_cmpint(sb_session_error_count(session), ==, 0);
}

static SbSession *session_with_rings(void) {
  SbSession *session = sb_session_new();
  set_rings(session);
  return session;
}

// The runs that are shown one after the other until the last is whole: their grades.
static GArray *settle(SbSession *session) {
  GArray *grades = g_array_new(FALSE, FALSE, sizeof(SbRunGrade));
  const SbRun *shown = sb_session_run(session);
  const gint64 end = g_get_monotonic_time() + 200 * G_USEC_PER_SEC;
  for (;;) {
    turn(session);
    g_assert_cmpint(g_get_monotonic_time(), <, end);
    if (sb_session_run(session) != shown) {
      shown = sb_session_run(session);
      const SbRunGrade grade = sb_session_grade(session);
      g_array_append_val(grades, grade);
    }
    if (sb_session_state(session) != SB_SESSION_RUNNING && !sb_session_wants_ticks(session) &&
        !sb_session_is_stale(session, NULL, NULL)) {
      g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_DONE);
      return grades;
    }
  }
}

// Frames of the shown run are those of a program that runs the session's values, to the bit.
static void assert_cold(SbSession *session) {
  SbPlan plan;
  SbRun *run = NULL;
  sb_plan_wished(&plan, sb_session_model(session),
                 &(SbPlanWishes){.views = SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES | SB_VIEW_SECTION});
  g_assert_cmpint(sb_run_create(&run, sb_session_model(session), &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, NULL, NULL), ==, SB_OK);
  size_t count, mine;
  const SbFrame *frames = sb_run_frames(run, &count), *shown = sb_session_frames(session, &mine);
  g_assert_cmpuint(count, ==, mine);
  for (size_t i = 0; i < count; i++) {
    g_assert_true(memcmp(&frames[i].force, &shown[i].force, sizeof(double)) == 0 &&
                  memcmp(&frames[i].seal[0].load, &shown[i].seal[0].load, sizeof(double)) == 0);
  }
  sb_run_destroy(run);
}

static SbRunGrade nth(const GArray *grades, guint i) {
  return g_array_index(grades, SbRunGrade, i);
}

static void at_stage_c(SbSession *session) {
  g_autofree char *where = sb_session_where(session);
  g_assert_true(g_str_has_prefix(where, "stage C,"));
}

// Waits for what sb_session_prepare() has begun.
static void prepare(SbSession *session, SbParamId id) {
  sb_session_prepare(session, id);
  while (!session->base->sought[id]) {
    turn(session);
  }
}

// Processor time of this thread [s].
static double own_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// What a prediction or an edit with one may take [s].
static const double OWN_MOST = SB_SANITIZED ? 0.1 : 5e-3;

// Opens the values of session_with_rings() with a folder of kept runs; whether one was shown.
static gboolean opens_stored(const char *folder, SbSession *whole) {
  g_autoptr(SbSession) session = sb_session_new();
  session->runs = g_strdup(folder);
  set_rings(session);
  const SbRun *run = sb_session_run(session);
  if (run == NULL) {
    return FALSE;
  }
  // At once, half way from C to D, not to be exported; its pictures are the whole run's to the bit.
  g_assert_cmpint(sb_session_grade(session), ==, SB_GRADE_STORED);
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_DONE);
  g_assert_false(sb_session_may_keep(session));
  g_assert_null(session->base);
  g_autofree char *text = sb_session_grade_text(session), *where = sb_session_where(session);
  g_assert_nonnull(strstr(text, "2001-09-09"));
  g_assert_true(g_str_has_prefix(where, "stage C"));
  size_t count, same;
  const SbFrame *frames = sb_session_frames(session, &count);
  const SbFrame *theirs = sb_session_frames(whole, &same);
  g_assert_cmpmem(frames, count * sizeof *frames, theirs, same * sizeof *theirs);
  guint shapes = 0;
  for (uint32_t i = 0; i < SB_RUN_SHAPES_MAX; i++) {
    const SbSealShape *a = sb_run_shape(run, i), *b = sb_run_shape(sb_session_run(whole), i);
    g_assert_true((a == NULL) == (b == NULL));
    if (a != NULL) {
      shapes++;
      g_assert_cmpmem(a->place, 2 * a->nodes * sizeof(double), b->place,
                      2 * b->nodes * sizeof(double));
      g_assert_cmpmem(a->field[SB_FIELD_SHEAR], a->nodes * sizeof(float), b->field[SB_FIELD_SHEAR],
                      b->nodes * sizeof(float));
      g_assert_cmpmem(a->triangle, 3 * a->triangles * sizeof(int), b->triangle,
                      3 * b->triangles * sizeof(int));
    }
  }
  g_assert_cmpuint(shapes, >, 2);
  return TRUE;
}

// A whole run kept in a file is shown where its values are opened; never one of other values, of
// another engine, or with a byte that is not its own.
static void check_stored(SbSession *session) {
  g_autofree char *folder = g_dir_make_tmp("sealbench-XXXXXX", NULL);
  g_autofree char *path = g_build_filename(folder, "one.run", NULL);
  g_autoptr(GError) error = NULL;
  g_setenv("SOURCE_DATE_EPOCH", "1000000000", TRUE);
  g_assert_true(
      sb_stored_run_write(path, sb_session_document(session), sb_session_run(session), &error));
  g_unsetenv("SOURCE_DATE_EPOCH");
  g_assert_true(opens_stored(folder, session));
  g_autofree char *text = NULL;
  gsize length;
  g_assert_true(g_file_get_contents(path, &text, &length, NULL));
  // In the title, the engine's hash, the values' one, the sum, the figures, and the last byte.
  const gsize at[] = {3, 30, 110, 180, length / 2, length - 1};
  for (guint i = 0; i < G_N_ELEMENTS(at); i++) {
    text[at[i]] ^= 1;
    g_assert_true(g_file_set_contents(path, text, (gssize)length, NULL));
    g_assert_false(opens_stored(folder, session));
    text[at[i]] ^= 1;
  }
  g_assert_true(g_file_set_contents(path, text, (gssize)length, NULL));
  g_autoptr(SbSession) other = sb_session_new();
  other->runs = g_strdup(folder);
  set_rings(other);
  g_assert_cmpint(sb_session_grade(other), ==, SB_GRADE_STORED);
  sb_session_edit(other, SB_P_SEAL_MODULUS, "2.51 MPa");
  g_assert_true(sb_session_is_stale(other, NULL, NULL));
  g_unlink(path);
  g_rmdir(folder);
}

// An edit: the last run stays, dimmed, and with it the dashed loop; then the run from its rings,
// which may not be kept; then the whole one, a file's to the bit. Undo and redo bring runs back.
static void test_order(void) {
  g_autoptr(SbSession) session = session_with_rings();
  sb_session_start(session);
  g_autoptr(GArray) first = settle(session);
  g_assert_cmpuint(first->len, ==, 2); // nothing was shown: closed forms are, until rings are there
  g_assert_cmpint(nth(first, 0), ==, SB_GRADE_CLOSED);
  g_assert_cmpint(nth(first, 1), ==, SB_GRADE_WHOLE);
  check_stored(session);
  g_assert_true(sb_session_may_keep(session));
  sb_session_set_auto_run(session, TRUE);
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_DONE); // nothing to run
  sb_session_set_playhead(session, 0);
  sb_session_step_event(session, 1);
  sb_session_step_event(session, 1);
  at_stage_c(session);
  const SbRun *before = sb_session_run(session);
  const double force_before = sb_session_summary(session)->stage[SB_STAGE_C].force;
  prepare(session, SB_P_GLAND_RADIAL_SPACE);

  const double from = own_seconds();
  sb_session_edit(session, SB_P_GLAND_RADIAL_SPACE, "1.3668 mm"); // +0.5 %
  const double own = own_seconds() - from;
  g_test_message("own work of an edit with its prediction %.2f ms", 1e3 * own);
  g_assert_cmpfloat(own, <, OWN_MOST);
  g_assert_true(sb_session_run(session) == before);
  g_assert_true(sb_session_shows_former(session));
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_RUNNING);
  g_assert_true(sb_session_awaits(session));
  g_assert_cmpuint(session->ticket, !=, 0); // a single edit's run has begun
  g_assert_nonnull(sb_session_chart(session)->predicted);
  const SbChartCurve *curve = &sb_session_chart(session)->predicted->loop;
  const SbTrace *trace = sb_session_chart(session)->run.trace;
  const double predicted =
      curve->force[sb_trace_find(trace, sb_trace_marks(trace)[SB_STAGE_C].frame)];

  // While the run before stays shown, only the progress is told: nothing is drawn anew.
  int drawn = 0, told = 0;
  const gulong frames =
      g_signal_connect_swapped(session, "frames-changed", G_CALLBACK(count_up), &drawn);
  const gulong progress =
      g_signal_connect_swapped(session, "progress-changed", G_CALLBACK(count_up), &told);
  const gint64 end = g_get_monotonic_time() + 100 * G_USEC_PER_SEC;
  while (sb_session_run(session) == before) {
    g_assert_nonnull(sb_session_chart(session)->predicted);
    g_assert_cmpint(drawn, ==, 0);
    turn(session);
    g_assert_cmpint(g_get_monotonic_time(), <, end);
  }
  g_assert_cmpint(told, >, 3);
  g_signal_handler_disconnect(session, frames);
  g_signal_handler_disconnect(session, progress);
  g_assert_cmpint(sb_session_grade(session), ==, SB_GRADE_NEAR);
  g_autofree char *grade_text = sb_session_grade_text(session);
  g_assert_nonnull(grade_text);
  g_assert_null(sb_session_chart(session)->predicted);
  const SbEditLatency latency = sb_session_latency(session);
  g_test_message("edit predicted after %.2f ms, shown after %.0f ms", 1e3 * latency.predicted,
                 1e3 * latency.shown);
  g_assert_cmpfloat(latency.predicted, >, 0);
  g_assert_cmpfloat(latency.shown, >, latency.predicted);
  g_assert_false(sb_session_shows_former(session));
  g_assert_false(sb_session_awaits(session));
  g_assert_false(sb_session_may_keep(session));
  g_assert_null(sb_session_handle(session));
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_RUNNING);
  at_stage_c(session);
  const double near_load = sb_session_summary(session)->seal[SB_OUTER].load;
  const double near_error = sb_session_summary(session)->error_load;
  const SbRun *near = sb_session_run(session);

  g_autoptr(GArray) then = settle(session);
  g_assert_cmpuint(then->len, ==, 1);
  g_assert_cmpint(nth(then, 0), ==, SB_GRADE_WHOLE);
  g_assert_true(sb_session_run(session) != near);
  at_stage_c(session);
  assert_cold(session);
  const SbSummary *whole = sb_session_summary(session);
  g_assert_cmpfloat(fabs(near_load / whole->seal[SB_OUTER].load - 1), <, near_error);
  g_assert_cmpfloat(near_error, <=, 0.01);
  const double force = whole->stage[SB_STAGE_C].force, change = force - force_before;
  g_test_message("force at C %.4f N, predicted %.4f N, change %.4f N", force, predicted, change);
  g_assert_cmpfloat(fabs(predicted - force), <, 0.1 * fabs(change));

  // Slopes of the base before are none of this one.
  g_assert_true(session->base->run == sb_session_run(session));
  g_assert_null(session->base->tangent[SB_P_GLAND_RADIAL_SPACE]);
  sb_session_edit(session, SB_P_GLAND_RADIAL_SPACE, "1.367 mm");
  g_assert_null(sb_session_chart(session)->predicted);
  g_assert_null(sb_session_predicted(session));
  sb_session_undo(session);

  const SbRun *after = sb_session_run(session);
  sb_session_undo(session);
  g_assert_true(sb_session_run(session) == before);
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_DONE);
  g_assert_false(sb_session_wants_ticks(session));
  g_assert_false(sb_session_shows_former(session));
  g_assert_null(sb_session_chart(session)->predicted);
  at_stage_c(session);
  sb_session_redo(session);
  g_assert_true(sb_session_run(session) == after);
  g_assert_true(sb_session_may_keep(session));
  g_assert_false(sb_session_wants_ticks(session));

  // What is under way for one base is dropped with it; that one still has its own slopes.
  sb_session_prepare(session, SB_P_GLAND_AXIAL_WIDTH);
  const unsigned ticket = session->slope_ticket;
  g_assert_cmpuint(ticket, !=, 0);
  sb_session_undo(session);
  g_assert_true(session->base->run == before);
  g_assert_cmpuint(session->slope_ticket, !=, ticket);
  g_assert_nonnull(session->base->tangent[SB_P_GLAND_RADIAL_SPACE]);

  // What has no slopes is not predicted, nor is what lies far off.
  sb_session_edit(session, SB_P_MODELS_SURFACE, "persson");
  g_assert_null(sb_session_chart(session)->predicted);
  g_assert_true(sb_session_shows_former(session));
  sb_session_undo(session);
  sb_session_edit(session, SB_P_GLAND_RADIAL_SPACE, "1.3 mm");
  g_assert_nonnull(sb_session_chart(session)->predicted);
  sb_session_edit(session, SB_P_GLAND_RADIAL_SPACE, "1.2 mm");
  g_assert_null(sb_session_chart(session)->predicted);
}

static const SbParamId predicted_ids[] = {SB_P_SEAL_SECTION_DIAMETER, SB_P_SEAL_MODULUS};

// A base with the slopes of all main parameters, and those of its figures by two.
static SbSession *session_with_slopes(void) {
  SbSession *session = session_with_rings();
  sb_session_start(session);
  g_array_unref(settle(session));
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    while (sb_param_is_main((SbParamId)id, SB_VALVE_PISTON) &&
           sb_param((SbParamId)id)->kind == SB_PARAM_REAL && !session->base->sought[id]) {
      turn(session);
    }
  }
  for (size_t p = 0; p < G_N_ELEMENTS(predicted_ids); p++) {
    sb_session_prepare(session, predicted_ids[p]);
    while (!session->base->differentiated[predicted_ids[p]]) {
      turn(session);
    }
    g_assert_nonnull(session->base->gradient[predicted_ids[p]]);
  }
  return session;
}

// Predicts a change of one parameter of the session's base by a share of it, and solves it, rings
// next to the base's.
static const SbChartPredicted *predict(SbSession *session, SbParamId id, double share,
                                       SbRun **solved) {
  SbParams params = session->base->params;
  SbModel *model = NULL;
  const SbOverride moved = {id, sb_params_get(&params, id) * (1 + share)};
  g_assert_cmpint(sb_params_set(&params, id, moved.value, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_derive(&model, sb_run_model(session->base->run), &moved, 1, NULL), ==,
                  SB_OK);
  const double from = own_seconds();
  g_assert_true(sb_prediction_make(session->prediction, session->base, &params, model));
  const double own = own_seconds() - from;
  g_test_message("%s %+g %%: predicted in %.3f ms", sb_param(id)->key, 100 * share, 1e3 * own);
  g_assert_cmpfloat(own, <, OWN_MOST);
  SbPlan plan;
  sb_plan_wished(&plan, model, &(SbPlanWishes){.views = SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES});
  g_assert_cmpint(sb_run_create(solved, model, &plan, NULL), ==, SB_OK);
  sb_run_start_from(*solved, session->base->run);
  g_assert_cmpint(sb_run_execute(*solved, NULL, NULL), ==, SB_OK);
  sb_run_start_from(*solved, NULL);
  sb_model_destroy(model);
  return sb_prediction_chart(session->prediction);
}

// Predicted figures are the base's and the engine's derivatives (`sealbench sensitivity`); a figure
// without an accepted one has no value, and the reason is that of the derivative.
static void hold_figures(const SbSession *session, const SbSummary *predicted, SbParamId id,
                         double share) {
  const SbGradient *gradient = session->base->gradient[id];
  size_t known = 0, withheld = 0;
  for (int f = 0; f < SB_FIGURE_COUNT; f++) {
    const double is = sb_figure_value(predicted, f);
    const double base = sb_figure_value(sb_run_summary(session->base->run), f);
    const double slope = sb_gradient_slope(gradient, (size_t)f, 0);
    if (isnan(base) || sb_figure(f)->needs == SB_DEPTH_SIZES || sb_figure(f)->digits == 0) {
      continue; // sizes are those of the present values
    }
    g_assert_cmpfloat(base, ==, sb_gradient_value(gradient, (size_t)f));
    g_assert_true(isnan(is) == isnan(slope));
    if (isnan(is)) {
      g_assert_nonnull(strstr(sb_figure_reason(predicted, f), "not predicted: its slope by "));
      g_assert_nonnull(
          strstr(sb_figure_reason(predicted, f), sb_gradient_reason(gradient, (size_t)f, 0)));
      withheld++;
    } else {
      const double by = share * sb_gradient_at(gradient, 0) * slope;
      g_assert_cmpfloat(fabs(is - base - by), <=, 1e-9 * (fabs(base) + fabs(by)));
      known++;
    }
  }
  g_test_message("%s: %zu figures predicted, %zu withheld", sb_param(id)->key, known, withheld);
  g_assert_cmpuint(known, >, 10);
  g_assert_cmpuint(withheld, >, 0);
}

static double peak_of(const SbContactProfile *profile) {
  double peak = 0;
  for (size_t i = 0; i < profile->count; i++) {
    peak = fmax(peak, profile->pressure[i]);
  }
  return peak;
}

static double film_in_the_middle(const SbContactProfile *profile, const SbSealFrame *seal) {
  const double x = 0.5 * (seal->contact_left + seal->contact_right);
  size_t i = 1;
  while (i + 1 < profile->count && profile->x[i] < x) {
    i++;
  }
  const double part = (x - profile->x[i - 1]) / (profile->x[i] - profile->x[i - 1]);
  return profile->film[i - 1] + part * (profile->film[i] - profile->film[i - 1]);
}

// The verdict is that of the predicted figures, sizes are those of the present values.
static void check_verdict(SbSession *session) {
  sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "1.65 mm");
  const SbSummary *predicted = sb_session_predicted(session), *was = sb_session_summary(session);
  g_assert_nonnull(predicted);
  g_assert_cmpfloat(predicted->seal[SB_OUTER].squeeze, ==,
                    sb_model_seal(sb_session_model(session), SB_OUTER)->squeeze);
  g_assert_cmpfloat(predicted->seal[SB_OUTER].load, >, was->seal[SB_OUTER].load);
  g_assert_cmpint(predicted->verdict[SB_VERDICT_SEALS].ok, ==, SB_ANSWER_YES);
  const SbVerdict *seals = &predicted->verdict[SB_VERDICT_SEALS];
  g_assert_cmpfloat(seals->value, ==, sb_figure_value(predicted, seals->figure));
  sb_session_undo(session);
  g_assert_null(sb_session_predicted(session));
}

// Without derivatives of the figures the loop is predicted, but no figure is, and the answers that
// depend on figures are not known.
static void check_withheld(SbSession *session) {
  SbDisplayedRun *base = session->base;
  SbGradient *gradient = g_steal_pointer(&base->gradient[SB_P_SEAL_MODULUS]);
  sb_session_edit(session, SB_P_SEAL_MODULUS, "2.52 MPa");
  const SbSummary *predicted = sb_session_predicted(session);
  const int load = sb_figure_find("seals.outer.load_N");
  g_assert_nonnull(predicted);
  g_assert_true(isnan(sb_figure_value(predicted, load)));
  g_assert_nonnull(strstr(sb_figure_reason(predicted, load), "not computed yet"));
  g_assert_cmpint(predicted->verdict[SB_VERDICT_SEALS].ok, ==, SB_ANSWER_UNKNOWN);
  base->gradient[SB_P_SEAL_MODULUS] = gradient;
  sb_session_undo(session);
}

// Predicted figures have the engine's derivatives; predicted contacts against solved ones.
static void test_predicted(void) {
  g_autoptr(SbSession) session = session_with_slopes();
  static const double shares[] = {0.005, 0.01, 0.05};
  for (size_t p = 0; p < G_N_ELEMENTS(predicted_ids); p++) {
    for (size_t k = 0; k < G_N_ELEMENTS(shares); k++) {
      SbRun *solved = NULL;
      const SbChartPredicted *predicted = predict(session, predicted_ids[p], shares[k], &solved);
      hold_figures(session, predicted->run.summary, predicted_ids[p], shares[k]);
      // The contact of the frame that the base shows at the middle of B to C.
      const SbDisplayedRun *base = session->base;
      const SbStageMark *b = sb_trace_mark(base->trace, SB_STAGE_B, 0);
      const size_t frame = (b->frame + sb_trace_mark(base->trace, SB_STAGE_C, 0)->frame) / 2;
      sb_prediction_show(session->prediction, frame);
      const uint32_t index = base->chart.frames[frame].seal[SB_OUTER].profile;
      const SbSealFrame *seal = &predicted->run.frames[0].seal[SB_OUTER];
      const SbContactProfile *was = sb_run_profile(base->run, index);
      const SbContactProfile *is = sb_run_profile(solved, index);
      const SbContactProfile *mine = predicted->run.profile(predicted->run.source, seal->profile);
      g_assert_nonnull(mine);
      const double peak = peak_of(is), change = peak - peak_of(was);
      g_assert_cmpfloat(fabs(peak_of(mine) - peak), <, 0.1 * fabs(change));
      g_assert_cmpfloat(fabs(peak_of(mine) - seal->pressure_peak), <, 1e-2 * peak);
      const double film = film_in_the_middle(mine, seal);
      g_assert_cmpfloat(fabs(film / seal->film_central - 1), <, 0.03);
      sb_run_destroy(solved);
    }
  }
  check_verdict(session);
  check_withheld(session);
}

// Edits in a row: only the last one's runs are shown, though the first one's has ended. Stopped
// before the whole run, the near one stays, and Run asks for the whole one.
static void test_cancel(void) {
  g_autoptr(SbSession) session = session_with_rings();
  sb_session_start(session);
  g_array_unref(settle(session));
  sb_session_set_auto_run(session, TRUE);
  const SbRun *before = sb_session_run(session);
  static const char *const texts[] = {"2.51 MPa", "2.52 MPa", "2.53 MPa"};
  for (guint i = 0; i < G_N_ELEMENTS(texts); i++) {
    sb_session_edit(session, SB_P_SEAL_MODULUS, texts[i]);
    for (int k = 0; k < 10; k++) {
      turn(session);
      g_assert_true(sb_session_run(session) == before);
    }
    g_usleep(i == 0 ? 300000 : 0); // the run ends, and nobody has looked
  }
  while (sb_session_run(session) == before) {
    turn(session);
  }
  g_assert_cmpint(sb_session_grade(session), ==, SB_GRADE_NEAR);
  g_assert_cmpfloat(sb_model_value(sb_run_model(sb_session_run(session)), SB_P_SEAL_MODULUS), ==,
                    2.53e6);
  sb_session_stop(session);
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_DONE);
  g_assert_false(sb_session_wants_ticks(session));
  g_assert_false(sb_session_may_keep(session));
  g_assert_false(sb_session_pin(session));
  sb_session_start(session);
  g_autoptr(GArray) then = settle(session);
  g_assert_cmpuint(then->len, ==, 1);
  g_assert_cmpint(nth(then, 0), ==, SB_GRADE_WHOLE);
}

// Without a run to start from and to a fine tolerance: a coarse run first. An edit cancels what
// follows it.
static void test_coarse(void) {
  g_autoptr(SbSession) session = session_with_rings();
  sb_session_edit(session, SB_P_OUTPUT_TOLERANCE, "1e-4");
  sb_session_edit(session, SB_P_OUTPUT_FRAMES, "1000");
  sb_session_start(session);
  const gint64 end = g_get_monotonic_time() + 100 * G_USEC_PER_SEC;
  while (sb_session_summary(session) == NULL || sb_session_grade(session) == SB_GRADE_CLOSED) {
    turn(session);
    g_assert_cmpint(g_get_monotonic_time(), <, end);
  }
  const SbRun *coarse = sb_session_run(session);
  size_t count;
  sb_session_frames(session, &count);
  g_assert_cmpint(sb_session_grade(session), ==, SB_GRADE_COARSE);
  g_assert_cmpuint(count, <, 300);
  g_assert_cmpfloat(sb_model_value(sb_run_model(coarse), SB_P_OUTPUT_TOLERANCE), ==, 0.01);
  g_assert_false(sb_session_shows_former(session)); // it is of the present values
  g_assert_false(sb_session_is_stale(session, NULL, NULL));
  g_assert_false(sb_session_may_keep(session));
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_RUNNING);
  sb_session_edit(session, SB_P_SEAL_MODULUS, "2.6 MPa");
  g_assert_true(sb_session_shows_former(session));
  for (int i = 0; i < 100; i++) {
    turn(session);
  }
  sb_session_stop(session);
  while (sb_session_state(session) == SB_SESSION_RUNNING) {
    turn(session);
  }
  g_assert_true(sb_session_run(session) == coarse);
}

// Solves the session's values; the first state that is shown, its rings led there from those of the
// run before, and the whole run after it.
static void check_led(SbSession *session, const char *space) {
  sb_session_edit(session, SB_P_GLAND_RADIAL_SPACE, space);
  while (sb_session_shows_former(session)) {
    turn(session);
  }
  g_assert_cmpint(sb_session_grade(session), ==, SB_GRADE_NEAR);
  const SbSummary led = *sb_session_summary(session);
  g_array_unref(settle(session));
  const SbSummary *whole = sb_session_summary(session);
  g_test_message("%s: %ld iterations, whole %ld", space, led.counters.newton_iterations,
                 whole->counters.newton_iterations);
  g_assert_cmpfloat(led.error_load, >=, 0.015); // a third of the largest difference found
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbContacts *a = &led.contact[seal], *b = &whole->contact[seal];
    const double told = 3 * (led.error_load + whole->error_load); // what honest means
    g_assert_cmpfloat_with_epsilon(a->in_stroke.load / b->in_stroke.load, 1, told);
    g_assert_cmpfloat_with_epsilon(a->back.load / b->back.load, 1, told);
  }
}

// Dragged rings under fluid: the second edit's outer ring finds no way on the first coarse copy.
static void test_led(void) {
  g_autoptr(SbSession) session = sb_session_new();
  g_autoptr(GPtrArray) warnings = g_ptr_array_new_with_free_func(g_free);
  g_autofree char *file =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes/piston.scene", NULL);
  sb_session_set_auto_run(session, FALSE);
  g_assert_true(sb_session_open(session, file, warnings));
  sb_session_start(session);
  g_array_unref(settle(session));
  sb_session_set_auto_run(session, TRUE);
  check_led(session, "1.3668 mm");
  check_led(session, "1.355 mm");
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/session-rings/order", test_order);
  g_test_add_func("/session-rings/predicted", test_predicted);
  g_test_add_func("/session-rings/cancel", test_cancel);
  g_test_add_func("/session-rings/coarse", test_coarse);
  g_test_add_func("/session-rings/led", test_led);
  return g_test_run();
}

// Reports and warnings: formatting, de-duplication, bounds, keys of inputs.
#include "engine/base/status.h"
#include "engine/contact/inputs.h"
#include "engine/film/film.h"
#include "engine/fluid/fluid.h"
#include "engine/mechanism/inputs.h"
#include "engine/rubber/rubber_time.h"
#include "engine/valve/model/params.h"

#include <glib.h>
#include <math.h>

static void test_report(void) {
  SbReport report = {0};
  SbStatus status =
      sb_fail_input(&report, SB_ERROR_RANGE, sb_input(SB_P_DRIVE_SPEED), "speed %g m/s", -1.0);
  g_assert_cmpint(status, ==, SB_ERROR_RANGE);
  g_assert_cmpint(report.status, ==, SB_ERROR_RANGE);
  g_assert_cmpstr(report.text, ==, "speed -1 m/s");
  g_assert_cmpstr(sb_input_key(report.input), ==, "drive.speed");
  // The residual is that of the error alone.
  report.residual = 1e-3;
  g_assert_cmpint(sb_fail(&report, SB_ERROR_NOT_CONVERGED, "other"), ==, SB_ERROR_NOT_CONVERGED);
  g_assert_true(isnan(report.residual));
  g_assert_cmpint(sb_succeed(&report), ==, SB_OK);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(sb_fail(NULL, SB_ERROR_INPUT, "no report"), ==, SB_ERROR_INPUT);
}

// A cause is that of the last report alone.
static void test_cause(void) {
  SbReport report = {0};
  SbStatus status = sb_fail(&report, SB_ERROR_INFEASIBLE, "open");
  g_assert_cmpint(sb_fail_because(&report, status, SB_CAUSE_FLUID_OPENS), ==, SB_ERROR_INFEASIBLE);
  g_assert_cmpint(report.cause, ==, SB_CAUSE_FLUID_OPENS);
  g_assert_cmpstr(report.text, ==, "open");
  status = sb_fail_input(&report, SB_ERROR_INFEASIBLE, sb_input(SB_P_CANISTER_PRESSURE), "other");
  g_assert_cmpint(status, ==, SB_ERROR_INFEASIBLE);
  g_assert_cmpint(report.cause, ==, SB_CAUSE_OTHER);
  g_assert_cmpint(sb_fail_because(NULL, status, SB_CAUSE_FLUID_PASSES), ==, status);
}

static void test_warnings(void) {
  SbWarnings list = {0};
  sb_warn(&list, "a", 1, "first");
  sb_warn(&list, "a", 1, "again");
  sb_warn(&list, "a", 2, "second");
  g_assert_cmpuint(list.count, ==, 2);
  for (int i = 0; i < 2 * SB_WARNINGS_MAX; i++) {
    char code[16];
    g_snprintf(code, sizeof code, "c%d", i);
    sb_warn(&list, code, 0, "text");
  }
  g_assert_cmpuint(list.count, ==, SB_WARNINGS_MAX);
  g_assert_cmpuint(list.dropped, ==, SB_WARNINGS_MAX + 2);
}

// What is true of both seals is said of both, and each sentence names its own.
static void test_subjects(void) {
  SbWarnings list = {0}, of_fit = {0};
  sb_warn(&of_fit, "squeeze-large", sb_input(SB_P_SEAL_SECTION_DIAMETER), "squeeze 41 %%");
  static const char *const seals[] = {"outer seal", "inner seal"};
  for (int i = 0; i < 2; i++) {
    for (int again = 0; again < 2; again++) {
      sb_warn_about(&list, seals[i]);
      sb_warnings_merge(&list, &of_fit);
      sb_warn(&list, "boundary-regime", sb_input(SB_P_SURFACE_SIGMA), "λ = 0.3 at the %s",
              seals[i]);
      sb_warn_about(&list, NULL);
    }
  }
  sb_warn(&list, "squeeze-large", sb_input(SB_P_SEAL_SECTION_DIAMETER), "of no seal");
  g_assert_cmpuint(list.count, ==, 5);
  g_assert_cmpstr(list.item[0].text, ==, "outer seal: squeeze 41 %");
  g_assert_cmpstr(list.item[1].text, ==, "λ = 0.3 at the outer seal");
  g_assert_cmpstr(list.item[2].text, ==, "inner seal: squeeze 41 %");
  g_assert_cmpstr(list.item[3].text, ==, "λ = 0.3 at the inner seal");
  // A merge keeps what each is about, and counts what was lost before.
  SbWarnings all = {0};
  list.dropped = 3;
  sb_warnings_merge(&all, &list);
  g_assert_cmpuint(all.count, ==, 5);
  g_assert_cmpuint(all.dropped, ==, 3);
  sb_warnings_merge(NULL, &list);
}

// A text that does not fit shows it, and ends between two characters.
static void test_cut(void) {
  char text[16];
  sb_text(text, sizeof text, "%s", "fifteen letters");
  g_assert_cmpstr(text, ==, "fifteen letters");
  sb_text(text, sizeof text, "%s", "sixteen letters!");
  g_assert_cmpstr(text, ==, "sixteen lett…");
  sb_text(text, sizeof text, "%s", "ten letterμμμμμμ");
  g_assert_cmpstr(text, ==, "ten letterμ…");
  g_assert_true(g_utf8_validate(text, -1, NULL));
  // A message has room for SB_TEXT bytes with its end, in a report and in a warning.
  SbReport report;
  char *words = g_strnfill(SB_TEXT - 1, 'w');
  g_assert_cmpint(sb_fail(&report, SB_ERROR_INPUT, "%s", words), ==, SB_ERROR_INPUT);
  g_assert_cmpstr(report.text, ==, words);
  SbWarnings *warnings = g_new0(SbWarnings, 1);
  sb_warn(warnings, "code", 0, "%s", words);
  g_assert_cmpstr(warnings->item[0].text, ==, words);
  g_free(warnings);
  g_free(words);
}

// Each input of a room below the valve has a key of the catalogue or of a file; each key has one
// number.
static void test_inputs(void) {
  static const int rooms[][2] = {{SB_CONTACT_INPUTS, SB_CONTACT_IN_END},
                                 {SB_FILM_INPUTS, SB_FILM_IN_END},
                                 {SB_RUBBER_INPUTS, SB_RUBBER_IN_END},
                                 {SB_FLUID_INPUTS, SB_FLUID_IN_END},
                                 {SB_MECHANISM_INPUTS, SB_MECHANISM_IN_END}};
  for (size_t i = 0; i < G_N_ELEMENTS(rooms); i++) {
    for (int input = rooms[i][0]; input < rooms[i][1]; input++) {
      g_assert_cmpstr(sb_input_key(input), !=, "");
      g_assert_cmpint(sb_input_find(sb_input_key(input)), ==, sb_input_resolve(input));
    }
    g_assert_cmpstr(sb_input_key(rooms[i][0] - 1), ==, "");
    g_assert_cmpstr(sb_input_key(rooms[i][1]), ==, "");
  }
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    g_assert_cmpint(sb_input_parameter(sb_input((SbParamId)id)), ==, id);
    g_assert_cmpint(sb_input_find(sb_param((SbParamId)id)->key), ==, sb_input((SbParamId)id));
  }
  g_assert_cmpstr(sb_input_key(SB_CONTACT_IN_DRAWING), ==, "seal.profile_file");
  g_assert_cmpint(sb_input_parameter(SB_CONTACT_IN_DRAWING), ==, -1);
  g_assert_cmpstr(sb_input_key(SB_INPUT_END), ==, "");
  g_assert_cmpint(sb_input_find("no.such_key"), ==, 0);
}

// A warning is as serious as where it was given, also after it was merged into another list.
static void test_serious(void) {
  SbWarnings list = {0}, all = {0};
  sb_warn(&list, "boundary-regime", 0, "λ = %g", 0.3);
  sb_warn_serious(&list, "seal-open", sb_input(SB_P_SEAL_SECTION_DIAMETER), "open at %g bar", 5.5);
  sb_warn_about(&all, "outer seal");
  sb_warnings_merge(&all, &list);
  g_assert_cmpuint(all.count, ==, 2);
  g_assert_false(all.item[0].serious);
  g_assert_true(all.item[1].serious);
  g_assert_cmpstr(all.item[1].text, ==, "outer seal: open at 5.5 bar");
  sb_warn_serious(NULL, "seal-open", 0, "no list");
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/status/report", test_report);
  g_test_add_func("/status/cause", test_cause);
  g_test_add_func("/status/warnings", test_warnings);
  g_test_add_func("/status/subjects", test_subjects);
  g_test_add_func("/status/cut", test_cut);
  g_test_add_func("/status/inputs", test_inputs);
  g_test_add_func("/status/serious", test_serious);
  return g_test_run();
}

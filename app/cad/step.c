// STEP files through sealbench-cad (helper.c), which limits its own processor time and memory. Time
// on the clock has no influence: a loaded machine reads what an idle one reads.
#include "app/base/beside.h"
#include "app/cad/cad_private.h"

#include <gio/gio.h>

#include <signal.h>

enum { TEXT_MAX = 64 << 20 };

// What the helper prints; NULL with an error.
static char *run_helper(const char *path, const SbCadChoices *choices, GError **error) {
  // Beside this program where it is not installed, else in libexecdir.
  static const char *const places[] = {SB_LIBEXEC_FROM_PROGRAM, ".", "..", NULL};
  g_autofree char *program = g_strdup(g_getenv("SEALBENCH_CAD"));
  program = program != NULL ? program : sb_beside_program(places, "sealbench-cad");
  if (program == NULL) {
    sb_app_error_input(
        error, "STEP files need sealbench-cad, which this build lacks: run tools/setup step and "
               "then ./run where the sources are, or save a DXF of the section instead");
    return NULL;
  }
  const double angle = choices->angle != NULL ? *choices->angle : NAN;
  const double unknown[3] = {NAN, NAN, NAN};
  const double *axis = choices->axis != NULL ? choices->axis : unknown;
  const double *at = choices->through != NULL ? choices->through : unknown;
  char number[7][SB_NUMBER_SIZE];
  const double value[7] = {angle, axis[0], axis[1], axis[2], at[0], at[1], at[2]};
  for (int i = 0; i < 7; i++) {
    sb_number_format(number[i], value[i]);
  }
  g_autofree char *whole = g_canonicalize_filename(path, NULL);
  g_autoptr(GBytes) bytes = NULL;
  g_autoptr(GSubprocess) process = g_subprocess_new(
      G_SUBPROCESS_FLAGS_STDOUT_PIPE | G_SUBPROCESS_FLAGS_STDERR_SILENCE, error, program, whole,
      number[0], number[1], number[2], number[3], number[4], number[5], number[6], NULL);
  if (process == NULL || !g_subprocess_communicate(process, NULL, NULL, &bytes, NULL, error)) {
    return NULL;
  }
  const int signal = g_subprocess_get_if_signaled(process) ? g_subprocess_get_term_sig(process) : 0;
  if (signal == SIGXCPU || signal == SIGALRM) {
    sb_app_error_input(
        error,
        signal == SIGXCPU
            ? "the CAD kernel needs more processor time than sealbench-cad allows (%d s): "
              "save the section alone as STEP or DXF"
            : "the CAD kernel has done nothing for %d s and was ended",
        signal == SIGXCPU ? SB_CAD_SECONDS_MAX : SB_CAD_STALLED_MAX);
    return NULL;
  }
  gsize length = 0;
  const char *text = g_bytes_get_data(bytes, &length);
  return g_strndup(text != NULL ? text : "", MIN(length, TEXT_MAX));
}

static bool read_numbers(double *out, int count, const char *text) {
  size_t length = 1;
  for (int i = 0; i < count && length > 0; i++) {
    text += strspn(text, " ");
    length = sb_number_read(&out[i], text);
    text += length;
  }
  return length > 0 && *text == '\0';
}

// Fills `cad` from the helper's lines; false where they are not complete.
static bool take_text(SbCad *cad, char *text, GError **error) {
  g_auto(GStrv) lines = g_strsplit(text, "\n", -1);
  g_autoptr(GArray) pieces = g_array_new(FALSE, FALSE, sizeof(SbPiece)); // of `body`
  SbCadBody *body = NULL;
  for (char **each = lines; *each != NULL; each++) {
    const char *line = *each;
    double n[sizeof(SbSolid) / sizeof(double)];
    if (g_str_has_prefix(line, "error axis ")) {
      return sb_app_error_choose(error, "axis", "x\ny\nz", "%s", line + 11);
    }
    if (g_str_has_prefix(line, "error ")) {
      return sb_app_error_input(error, "%s", line + 6);
    }
    const bool end = strcmp(line, "end") == 0;
    if ((end || g_str_has_prefix(line, "body ")) && body != NULL) {
      sb_cad_section(cad, body, pieces);
      g_array_set_size(pieces, 0);
    }
    if (end) {
      return true;
    }
    if (g_str_has_prefix(line, "axis ") && read_numbers(n, 6, line + 5)) {
      cad->axis = sb_cad_axis_text(n, n + 3);
    } else if (g_str_has_prefix(line, "body ")) {
      g_autofree char *name = sb_printable(line + 5, strlen(line + 5));
      body = sb_cad_body_new(name);
      g_ptr_array_add(cad->bodies, body);
    } else if (body != NULL && g_str_has_prefix(line, "solid ") &&
               read_numbers(n, G_N_ELEMENTS(n), line + 6)) {
      body->measured = true;
      memcpy(&body->solid, n, sizeof n);
    } else if (body != NULL && g_str_has_prefix(line, "note ")) {
      sb_note_add(cad->warnings, "%s: %s", body->name, line + 5);
    } else if (body != NULL && g_str_has_prefix(line, "why ") && body->why == NULL) {
      body->why = sb_printable(line + 4, strlen(line + 4));
    } else if (g_str_has_prefix(line, "piece ") && read_numbers(n, 5, line + 6)) {
      g_array_append_vals(pieces, &(SbPiece){n[0], n[1], n[2], n[3], n[4]}, 1);
    }
  }
  return sb_app_error_input(error,
                            "ends the CAD kernel before it is read (a crash, or more than 4 GB)");
}

SbCad *sb_cad_read_step(const char *path, const SbCadChoices *choices, GError **error) {
  g_autofree char *report = run_helper(path, choices, error);
  g_autoptr(SbCad) cad = sb_cad_new("STEP");
  if (report == NULL || !take_text(cad, report, error)) {
    sb_app_error_prefix(error, path);
    return NULL;
  }
  sb_cad_settle(cad, choices);
  return g_steal_pointer(&cad);
}

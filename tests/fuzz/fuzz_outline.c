// What any bytes must survive as the file of a section or of a groove (but a STEP, which a helper
// of its own reads): a section and a groove that an engine can take, or one printable complaint.
#include "app/base/error.h"
#include "app/document/seal_file.h"

#include <glib/gstdio.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static char *path; // of the one file that every input is written to

static void remove_file(void) {
  g_remove(path);
  g_free(path);
}

static void write_file(const uint8_t *data, size_t size) {
  FILE *file = fopen(path, "wb");
  g_assert_nonnull(file);
  g_assert_cmpuint(fwrite(data, 1, size, file), ==, size);
  fclose(file);
}

static void check_complaint(GError *error) {
  g_assert_true(error != NULL && error->domain == SB_APP_ERROR);
  g_assert_true(g_utf8_validate(error->message, -1, NULL) && strchr(error->message, '\n') == NULL);
  g_assert_true(g_str_has_prefix(error->message, path));
  g_error_free(error);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (path == NULL) {
    path = g_strdup_printf("%s/sealbench-outline-%ld", g_get_tmp_dir(), (long)getpid());
    atexit(remove_file);
  }
  if (size == 0 || g_strstr_len((const char *)data, (gssize)size, "ISO-10303") != NULL) {
    return 0;
  }
  write_file(data, size);
  static SbSealProfile profile;
  static SbRingOutline outline;
  GError *error = NULL;
  double height = NAN;
  profile = (SbSealProfile){.kind = SB_SEAL_PROFILE_FILE};
  if (sb_seal_file_read(&profile.drawn, &height, path, &error)) {
    g_assert_true(error == NULL && height > 0 && isfinite(height) && profile.drawn.count >= 2);
    (void)sb_ring_outline_of_profile(&outline, &profile, height, NULL); // may refuse, and say so
  } else {
    g_assert_cmpint(profile.drawn.count, ==, 0);
    check_complaint(error);
    error = NULL;
  }
  SbGrooveDrawing groove;
  if (sb_groove_file_read(&groove, path, &error)) {
    g_assert_true(error == NULL && groove.count >= 3 && groove.width > 0 && groove.depth > 0 &&
                  isfinite(groove.width) && isfinite(groove.depth));
    for (int k = 0; k < 2; k++) {
      double slope, curvature;
      g_assert_true(isfinite(sb_groove_line(&groove.floor[k], 0.1e-3, &slope, &curvature)));
      g_assert_true(isfinite(sb_groove_line(&groove.wall[k], 0.1e-3, &slope, &curvature)));
      g_assert_true(isfinite(slope) && isfinite(curvature));
    }
  } else {
    g_assert_cmpint(groove.count, ==, 0);
    check_complaint(error);
  }
  return 0;
}

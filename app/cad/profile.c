// Profiles; see the header.
#include "app/cad/profile.h"

#include "app/base/error.h"
#include "app/base/unit.h"

#include <math.h>

static bool read_point(SbProfilePoint *out, const char *word, double scale) {
  g_auto(GStrv) numbers = g_strsplit(word, ",", -1);
  const guint parts = g_strv_length(numbers);
  double value[3] = {0};
  bool good = parts == 2 || parts == 3;
  for (guint k = 0; good && k < parts; k++) {
    good = sb_number_parse(&value[k], numbers[k]);
  }
  *out = (SbProfilePoint){scale * value[0], scale * value[1], value[2]};
  return good;
}

GArray *sb_profile_parse(const char *text, bool *closed, GError **error) {
  g_auto(GStrv) words = g_strsplit_set(text, " \t\r\n", -1);
  g_autoptr(GArray) points = g_array_new(FALSE, FALSE, sizeof(SbProfilePoint));
  double scale = 0;
  bool good = true;
  for (char **word = words; good && *word != NULL; word++) {
    SbProfilePoint point;
    if (**word == '\0') {
      continue;
    }
    if (scale == 0) {
      good = sb_unit_scale(&scale, *word, "m", "mm", NULL) ||
             sb_app_error_input(error, "starts with the unit of its points, not '%s'", *word);
    } else if (points->len == SB_PROFILE_MAX) {
      good = sb_app_error_input(error, "has more than %d points", SB_PROFILE_MAX);
    } else if (!read_point(&point, *word, scale)) {
      good = sb_app_error_input(error, "point %u is not x,r or x,r,bulge", points->len + 1);
    } else {
      g_array_append_val(points, point);
    }
  }
  const SbProfilePoint *point = (const SbProfilePoint *)(void *)points->data;
  const guint count = points->len;
  *closed = count > 1 && point[0].x == point[count - 1].x && point[0].r == point[count - 1].r;
  g_array_set_size(points, count - (*closed ? 1 : 0));
  good = good && (points->len >= 2 ||
                  sb_app_error_input(error, "has %u points, not two or more", points->len));
  return good ? g_steal_pointer(&points) : NULL;
}

void sb_profile_turn(GArray *points, bool closed) {
  const SbProfile profile = {(void *)points->data, points->len, closed};
  const guint n = points->len > 1 && sb_profile_area(&profile) < 0 ? points->len : 0;
  g_autofree SbProfilePoint *old = g_memdup2(points->data, n * sizeof *old);
  for (guint i = 0; i < n; i++) {
    SbProfilePoint *p = &g_array_index(points, SbProfilePoint, i);
    *p = old[n - 1 - i];
    p->bulge = i + 1 < n ? -old[n - 2 - i].bulge : closed ? -old[n - 1].bulge : 0;
  }
}

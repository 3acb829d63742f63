// See nearest.h. Likeness is the number of characters inserted, left out, replaced or swapped with
// their neighbour (optimal string alignment), in capitals or not.
#include "app/base/nearest.h"

#include <glib.h>
#include <string.h>

enum { LENGTH_MAX = 48 };

static int distance(const char *a, int m, const char *b, int n) {
  int d[LENGTH_MAX + 1][LENGTH_MAX + 1];
  for (int i = 0; i <= m; i++) {
    for (int j = 0; j <= n; j++) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      char x = g_ascii_tolower(a[i - 1]), y = g_ascii_tolower(b[j - 1]);
      d[i][j] = MIN(MIN(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (x != y));
      if (i > 1 && j > 1 && x == g_ascii_tolower(b[j - 2]) && y == g_ascii_tolower(a[i - 2])) {
        d[i][j] = MIN(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[m][n];
}

SbNearest sb_nearest(const char *word) {
  return (SbNearest){word, NULL, LENGTH_MAX};
}

void sb_nearest_try(SbNearest *nearest, const char *name) {
  int m = (int)strnlen(nearest->word, LENGTH_MAX + 1);
  int n = (int)strnlen(name, LENGTH_MAX + 1);
  if (m == 0 || m > LENGTH_MAX || n > LENGTH_MAX) {
    return;
  }
  // Short words differ in few letters only; a beginning is as good as one.
  int most = MIN(m / 3, 3);
  int apart = distance(nearest->word, m, name, n);
  if (m >= 3 && g_ascii_strncasecmp(nearest->word, name, (gsize)m) == 0) {
    apart = 1;
  }
  if (apart <= most && apart < MIN(nearest->least, n)) {
    nearest->least = apart;
    nearest->best = name;
  }
}

void sb_nearest_try_list(SbNearest *nearest, const char *names) {
  g_auto(GStrv) each = g_strsplit(names, "|", 0);
  for (char **name = each; *name != NULL; name++) {
    sb_nearest_try(nearest, g_intern_string(*name));
  }
}

char *sb_nearest_hint(const SbNearest *nearest) {
  return nearest->best != NULL ? g_strdup_printf(", do you mean %s?", nearest->best) : g_strdup("");
}

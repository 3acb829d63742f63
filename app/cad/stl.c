// See stl.h.
#include "app/cad/stl.h"

#include "app/base/reader.h"
#include "app/base/unit.h"
#include "app/cad/cad_private.h"

#include <math.h>
#include <string.h>

enum { HEADER = 84, RECORD = 50 };

// A text facet takes up to about 300 bytes; 512 leaves room for long numbers.
static const size_t length_max = (size_t)SB_STL_TRIANGLES_MAX * 512;

// Corners as they are read, nine numbers a triangle [m].
typedef struct {
  GArray *corners;
  double scale;
} Builder;

static void add_triangle(Builder *b, const double corner[9]) {
  double scaled[9];
  for (int k = 0; k < 9; k++) {
    scaled[k] = b->scale * corner[k];
  }
  g_array_append_vals(b->corners, scaled, 9);
}

// ---- welding ----

// Part of the box's diagonal within which corners are one: what six digits of text leave open.
static const double WELD = 1e-5;

// Part of the largest coordinate, for a part far from its origin: two units of single precision.
static const double WELD_SINGLE = 0x1p-22;

// Cells of a grid, hashed: a bucket heads a chain of the vertices in its cells.
typedef struct {
  unsigned *head, *next; // vertex + 1, 0 ends
  guint64 mask;
  double cell;
} Grid;

static unsigned *bucket(const Grid *grid, const gint64 at[3]) {
  guint64 hash = 0;
  for (int k = 0; k < 3; k++) {
    hash = (hash ^ (guint64)at[k]) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return &grid->head[hash & grid->mask];
}

// The first vertex within `tolerance` of `x` along every axis, or `count`. The first, so that equal
// corners are always the same vertex.
static unsigned nearest(const Grid *grid, const double *vertices, unsigned count, const double *x,
                        double tolerance) {
  gint64 low[3], high[3], at[3];
  for (int k = 0; k < 3; k++) {
    low[k] = (gint64)floor((x[k] - tolerance) / grid->cell);
    high[k] = (gint64)floor((x[k] + tolerance) / grid->cell);
  }
  unsigned best = count;
  for (at[0] = low[0]; at[0] <= high[0]; at[0]++) {
    for (at[1] = low[1]; at[1] <= high[1]; at[1]++) {
      for (at[2] = low[2]; at[2] <= high[2]; at[2]++) {
        for (unsigned v = *bucket(grid, at); v != 0; v = grid->next[v - 1]) {
          const double *y = vertices + 3 * (size_t)(v - 1);
          if (v - 1 < best && fabs(y[0] - x[0]) <= tolerance && fabs(y[1] - x[1]) <= tolerance &&
              fabs(y[2] - x[2]) <= tolerance) {
            best = v - 1;
          }
        }
      }
    }
  }
  return best;
}

static void extent(const double *points, gsize count, double low[3], double high[3]) {
  for (int k = 0; k < 3; k++) {
    low[k] = INFINITY;
    high[k] = -INFINITY;
  }
  for (gsize i = 0; i < 3 * count; i++) {
    low[i % 3] = fmin(low[i % 3], points[i]);
    high[i % 3] = fmax(high[i % 3], points[i]);
  }
}

static double weld_tolerance(const double *corners, gsize count) {
  double diagonal = 0.0, largest = 0.0, low[3], high[3];
  extent(corners, count, low, high);
  for (int k = 0; k < 3; k++) {
    diagonal = hypot(diagonal, high[k] - low[k]);
    largest = fmax(largest, fmax(fabs(low[k]), fabs(high[k])));
  }
  return fmax(WELD * diagonal, WELD_SINGLE * largest);
}

// Corners closer than the tolerance become one vertex, triangles that lose a corner by that are
// dropped. Vertices are further apart than the tolerance, so that a cell of four holds few, and the
// time grows with the count alone.
static void weld(SbStl *out, const double *corners, gsize triangles, double tolerance) {
  gsize count = 3 * triangles;
  gsize buckets = 2;
  while (buckets < 2 * count) {
    buckets *= 2;
  }
  Grid grid = {g_new0(unsigned, buckets), g_new(unsigned, count), buckets - 1,
               tolerance > 0.0 ? 4.0 * tolerance : 1.0};
  out->vertices = g_new(double, 3 * count);
  out->triangles = g_new(unsigned, count);
  for (gsize t = 0; t < triangles; t++) {
    unsigned v[3];
    for (gsize k = 0; k < 3; k++) {
      const double *x = corners + 9 * t + 3 * k;
      v[k] = nearest(&grid, out->vertices, (unsigned)out->vertex_count, x, tolerance);
      if (v[k] == out->vertex_count) {
        gint64 at[3];
        for (int j = 0; j < 3; j++) {
          at[j] = (gint64)floor(x[j] / grid.cell);
        }
        unsigned *head = bucket(&grid, at);
        grid.next[v[k]] = *head;
        *head = v[k] + 1;
        memcpy(out->vertices + 3 * out->vertex_count++, x, 3 * sizeof *x);
      }
    }
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      out->dropped++;
    } else {
      memcpy(out->triangles + 3 * out->triangle_count++, v, sizeof v);
    }
  }
  g_free(grid.head);
  g_free(grid.next);
}

// ---- binary ----

static guint32 little_endian(const char *p) {
  const guchar *u = (const guchar *)p;
  return (guint32)u[0] | (guint32)u[1] << 8 | (guint32)u[2] << 16 | (guint32)u[3] << 24;
}

static gboolean read_binary(Builder *b, const char *data, gsize count, const char *name,
                            GError **error) {
  for (gsize i = 0; i < count; i++) {
    double corner[9];
    for (gsize k = 0; k < 9; k++) {
      // 12 bytes of normal come first; the corners' order gives it again.
      guint32 bits = little_endian(data + HEADER + RECORD * i + 12 + 4 * k);
      float value;
      memcpy(&value, &bits, sizeof value);
      corner[k] = (double)value;
      if (!isfinite(corner[k])) {
        g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                    "%s: triangle %" G_GSIZE_FORMAT " has a corner that is not a number", name, i);
        return FALSE;
      }
    }
    add_triangle(b, corner);
  }
  return TRUE;
}

// ---- text ----

typedef struct {
  const char *at, *end;
  int line;
} Text;

// Next word into `word`, cut at its size; its whole length, 0 at the end.
static gsize next_word(Text *t, char *word, gsize size) {
  while (t->at < t->end && g_ascii_isspace(*t->at)) {
    t->line += *t->at == '\n';
    t->at++;
  }
  const char *start = t->at;
  while (t->at < t->end && !g_ascii_isspace(*t->at)) {
    t->at++;
  }
  gsize length = (gsize)(t->at - start), kept = MIN(length, size - 1);
  memcpy(word, start, kept);
  word[kept] = '\0';
  return length;
}

static void skip_line(Text *t) {
  while (t->at < t->end && *t->at != '\n') {
    t->at++;
  }
}

static gboolean expect(Text *t, const char *wanted, const char *name, GError **error) {
  char word[64];
  if (next_word(t, word, sizeof word) == 0 || g_ascii_strcasecmp(word, wanted) != 0) {
    sb_app_error_input(error, "%s:%d: '%s' expected, not '%s'", name, t->line, wanted, word);
    return FALSE;
  }
  return TRUE;
}

static gboolean numbers(Text *t, double *out, const char *name, GError **error) {
  for (int k = 0; k < 3; k++) {
    char word[SB_NUMBER_LENGTH_MAX + 1];
    gsize length = next_word(t, word, sizeof word);
    if (length >= sizeof word || !sb_number_parse(&out[k], word)) {
      sb_app_error_input(error, "%s:%d: a number expected, not '%s'%s", name, t->line, word,
                         length >= sizeof word ? "... (too long)" : "");
      return FALSE;
    }
  }
  return TRUE;
}

static gboolean read_facet(Builder *b, Text *t, const char *name, GError **error) {
  double normal[3], corner[9];
  if (!expect(t, "normal", name, error) || !numbers(t, normal, name, error) ||
      !expect(t, "outer", name, error) || !expect(t, "loop", name, error)) {
    return FALSE;
  }
  for (int k = 0; k < 3; k++) {
    if (!expect(t, "vertex", name, error) || !numbers(t, corner + 3 * k, name, error)) {
      return FALSE;
    }
  }
  if (!expect(t, "endloop", name, error) || !expect(t, "endfacet", name, error)) {
    return FALSE;
  }
  add_triangle(b, corner);
  return TRUE;
}

static gboolean read_text(Builder *b, const char *data, gsize length, const char *name,
                          GError **error) {
  Text t = {data, data + length, 1};
  char word[64];
  gboolean inside = FALSE;
  gsize count = 0;
  while (next_word(&t, word, sizeof word) > 0) {
    if (!inside && g_ascii_strcasecmp(word, "solid") == 0) {
      skip_line(&t); // its name
      inside = TRUE;
    } else if (inside && g_ascii_strcasecmp(word, "endsolid") == 0) {
      skip_line(&t);
      inside = FALSE;
    } else if (inside && g_ascii_strcasecmp(word, "facet") == 0) {
      if (++count > SB_STL_TRIANGLES_MAX) {
        g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: more than %d triangles", name,
                    SB_STL_TRIANGLES_MAX);
        return FALSE;
      }
      if (!read_facet(b, &t, name, error)) {
        return FALSE;
      }
    } else {
      sb_app_error_input(error, "%s:%d: '%s' is not part of STL", name, t.line, word);
      return FALSE;
    }
  }
  if (inside) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: ends before 'endsolid'", name);
    return FALSE;
  }
  return TRUE;
}

// ---- public ----

gboolean sb_stl_parse(SbStl *out, const char *data, gsize length, const char *unit,
                      const char *name, GError **error) {
  *out = (SbStl){0};
  double scale;
  if (!sb_cad_unit(&scale, unit, error)) {
    return FALSE;
  }
  // Binary files may start with "solid" too: their length tells.
  gsize count = length >= HEADER ? little_endian(data + 80) : 0;
  gboolean binary = length >= HEADER && length == HEADER + RECORD * count;
  gboolean text = !binary && length >= 5 && g_ascii_strncasecmp(data, "solid", 5) == 0;
  if (!binary && !text) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s: not an STL file, or cut short (%" G_GSIZE_FORMAT " bytes)", name, length);
    return FALSE;
  }
  if (binary && count > SB_STL_TRIANGLES_MAX) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: more than %d triangles", name,
                SB_STL_TRIANGLES_MAX);
    return FALSE;
  }
  Builder b = {g_array_new(FALSE, FALSE, sizeof(double)), scale};
  out->text = text;
  gboolean ok =
      binary ? read_binary(&b, data, count, name, error) : read_text(&b, data, length, name, error);
  const double *corners = (const double *)(const void *)b.corners->data;
  double tolerance = weld_tolerance(corners, b.corners->len / 3);
  if (ok && b.corners->len > 0 && !isfinite(tolerance)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: has corners too far from the origin",
                name);
    ok = FALSE;
  }
  if (ok) {
    weld(out, corners, b.corners->len / 9, tolerance);
  }
  if (ok && out->triangle_count == 0) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: no triangles", name);
    ok = FALSE;
  }
  g_array_unref(b.corners);
  if (!ok) {
    sb_stl_clear(out);
  }
  return ok;
}

gboolean sb_stl_read(SbStl *out, const char *path, const char *unit, GError **error) {
  *out = (SbStl){0};
  g_autoptr(GPtrArray) issues = sb_issues_new();
  gsize length = 0;
  g_autofree char *data = sb_reader_load(&length, path, path, length_max, issues);
  gboolean ok = FALSE;
  if (data != NULL) {
    ok = sb_stl_parse(out, data, length, unit, path, error);
  } else {
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_IO, line);
  }
  return ok;
}

void sb_stl_extent(const SbStl *stl, double low[3], double high[3]) {
  extent(stl->vertices, stl->vertex_count, low, high);
}

void sb_stl_clear(SbStl *stl) {
  if (stl != NULL) {
    g_free(stl->vertices);
    g_free(stl->triangles);
    *stl = (SbStl){0};
  }
}

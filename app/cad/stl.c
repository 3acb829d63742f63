// STL files; see cad.h.
#include "app/base/bytes.h"
#include "app/cad/cad_private.h"

enum { HEADER = 84, RECORD = 50 };

// A text facet takes up to about 300 bytes; 512 leaves room for long numbers.
static const size_t LONGEST = (size_t)SB_STL_TRIANGLES_MAX * 512;

// Parts of the box's diagonal, as six digits of text leave open, and of the largest coordinate.
static const double WELD = 1e-5, WELD_SINGLE = 0x1p-22;

// Returns the key of a cell of a grid; several cells may have one.
static gpointer key_of(const gint64 at[3]) {
  guint64 hash = 0;
  for (int k = 0; k < 3; k++) {
    hash = (hash ^ (guint64)at[k]) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return GSIZE_TO_POINTER(hash);
}

// The first vertex within `tolerance` of `x` along every axis, or `count`. The first, so that equal
// corners are always the same vertex. `grid`: key of a cell -> number of its last vertex, from 1;
// next[vertex]: the one before in the cell, 0: none.
static unsigned nearest(GHashTable *grid, const unsigned *next, double cell, const double *vertices,
                        unsigned count, const double *x, double tolerance) {
  unsigned best = count;
  for (int corner = 0; corner < 8; corner++) {
    gint64 at[3];
    bool twice = false; // the same cell as of another corner
    for (int k = 0; k < 3; k++) {
      const double low = floor((x[k] - tolerance) / cell), high = floor((x[k] + tolerance) / cell);
      at[k] = (gint64)(corner >> k & 1 ? high : low);
      twice |= (corner >> k & 1) != 0 && high == low;
    }
    unsigned v = twice ? 0 : GPOINTER_TO_UINT(g_hash_table_lookup(grid, key_of(at)));
    for (; v != 0; v = next[v - 1]) {
      const double *y = vertices + 3 * (size_t)(v - 1);
      if (v - 1 < best && fabs(y[0] - x[0]) <= tolerance && fabs(y[1] - x[1]) <= tolerance &&
          fabs(y[2] - x[2]) <= tolerance) {
        best = v - 1;
      }
    }
  }
  return best;
}

void sb_stl_extent(const double *points, gsize count, double low[3], double high[3]) {
  for (int k = 0; k < 3; k++) {
    low[k] = INFINITY;
    high[k] = -INFINITY;
  }
  for (gsize i = 0; i < 3 * count; i++) {
    low[i % 3] = fmin(low[i % 3], points[i]);
    high[i % 3] = fmax(high[i % 3], points[i]);
  }
}

// Corners closer than the tolerance become one vertex, triangles that lose a corner by that are
// dropped. Vertices are further apart, so that a cell of four tolerances holds few: linear time.
static void weld(SbStl *out, const double *corners, gsize triangles, double tolerance) {
  const gsize count = 3 * triangles;
  const double cell = tolerance > 0.0 ? 4.0 * tolerance : 1.0;
  g_autoptr(GHashTable) grid = g_hash_table_new(g_direct_hash, g_direct_equal);
  g_autofree unsigned *next = g_new(unsigned, count);
  out->vertices = g_new(double, 3 * count);
  out->triangles = g_new(unsigned, count);
  for (gsize t = 0; t < triangles; t++) {
    unsigned v[3];
    for (gsize k = 0; k < 3; k++) {
      const double *x = corners + 9 * t + 3 * k;
      const unsigned vertices = (unsigned)out->vertex_count;
      v[k] = nearest(grid, next, cell, out->vertices, vertices, x, tolerance);
      if (v[k] == vertices) {
        const gint64 at[3] = {(gint64)floor(x[0] / cell), (gint64)floor(x[1] / cell),
                              (gint64)floor(x[2] / cell)};
        next[vertices] = GPOINTER_TO_UINT(g_hash_table_lookup(grid, key_of(at)));
        g_hash_table_insert(grid, key_of(at), GUINT_TO_POINTER(vertices + 1));
        memcpy(out->vertices + 3 * out->vertex_count++, x, 3 * sizeof *x);
      }
    }
    if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) {
      memcpy(out->triangles + 3 * out->triangle_count++, v, sizeof v);
    }
  }
}

// Whether the length of a file fits the number of triangles in a binary header; a few bytes behind
// them are ignored. Binary files may start with "solid" too.
static bool is_binary(const char *data, gsize length) {
  return length >= HEADER && (length - HEADER) / RECORD == sb_bytes_u32(data + 80);
}

static bool read_binary(GArray *corners, const char *data, gsize length, GError **error) {
  const gsize count = (length - HEADER) / RECORD;
  if (count > SB_STL_TRIANGLES_MAX) {
    return sb_app_error_input(error, "more than %d triangles", SB_STL_TRIANGLES_MAX);
  }
  for (gsize i = 0; i < 9 * count; i++) {
    // 12 bytes of normal come first; the corners' order gives it again.
    const double number = sb_bytes_float(data + HEADER + RECORD * (i / 9) + 12 + 4 * (i % 9));
    if (!isfinite(number)) {
      return sb_app_error_input(error, "triangle %zu has a corner that is not a number", i / 9);
    }
    g_array_append_val(corners, number);
  }
  return true;
}

typedef struct {
  const char *at, *end;
  int line;
  char word[SB_NUMBER_LENGTH_MAX + 2]; // the last one, cut: too long for a number then
} Text;

// Reads the next word, behind blanks and a mark of UTF-8; false at the end.
static bool next_word(Text *t) {
  while (t->at < t->end && (g_ascii_isspace(*t->at) || (*t->at & 0x80) != 0)) {
    t->line += *t->at++ == '\n';
  }
  gsize length = 0;
  for (; t->at < t->end && !g_ascii_isspace(*t->at); t->at++) {
    t->word[length] = *t->at;
    length += length + 1 < sizeof t->word;
  }
  t->word[length] = '\0';
  return length > 0;
}

static bool is_word(const Text *t, const char *word) {
  return g_ascii_strcasecmp(t->word, word) == 0;
}

static bool read_facet(GArray *corners, Text *t, GError **error) {
  // #: a number; *: anything, as exporters write for the normal of a facet without area.
  static const char *const words[] = {"normal", "*", "*", "*",      "outer",   "loop",    "vertex",
                                      "#",      "#", "#", "vertex", "#",       "#",       "#",
                                      "vertex", "#", "#", "#",      "endloop", "endfacet"};
  for (gsize i = 0; i < G_N_ELEMENTS(words); i++) {
    const bool number = *words[i] == '#';
    double value;
    if (!next_word(t) ||
        !(number ? sb_number_parse(&value, t->word) : *words[i] == '*' || is_word(t, words[i]))) {
      return sb_app_error_input(error, "line %d: %s expected, not '%s'%s", t->line,
                                number ? "a number" : words[i], t->word,
                                strlen(t->word) > SB_NUMBER_LENGTH_MAX ? "... (too long)" : "");
    }
    g_array_append_vals(corners, &value, number);
  }
  return true;
}

static bool read_text(GArray *corners, const char *data, gsize length, GError **error) {
  Text t = {.at = data, .end = data + length, .line = 1};
  bool inside = false;
  while (next_word(&t)) {
    if (is_word(&t, inside ? "endsolid" : "solid")) {
      while (t.at < t.end && *t.at != '\n' && *t.at != '\r') { // its name
        t.at++;
      }
      inside = !inside;
    } else if (!inside || !is_word(&t, "facet")) {
      return sb_app_error_input(error, "line %d: '%s' is not part of STL", t.line, t.word);
    } else if (corners->len == 9 * SB_STL_TRIANGLES_MAX) {
      return sb_app_error_input(error, "more than %d triangles", SB_STL_TRIANGLES_MAX);
    } else if (!read_facet(corners, &t, error)) {
      return false;
    }
  }
  return !inside || sb_app_error_input(error, "ends before 'endsolid'");
}

bool sb_cad_is_stl(const char *data, gsize length) {
  Text t = {.at = data, .end = data + length};
  return is_binary(data, length) || (next_word(&t) && is_word(&t, "solid"));
}

static bool read_mesh(SbStl *out, GArray *corners, const char *data, gsize length, GError **error) {
  if (!sb_cad_is_stl(data, length)) {
    return sb_app_error_input(error, "not an STL file, or cut short (%zu bytes)", length);
  }
  if (!(is_binary(data, length) ? read_binary : read_text)(corners, data, length, error)) {
    return false;
  }
  const double *corner = (const double *)(const void *)corners->data;
  double diagonal = 0, largest = 0, low[3], high[3];
  sb_stl_extent(corner, corners->len / 3, low, high);
  for (int k = 0; k < 3; k++) {
    diagonal = hypot(diagonal, high[k] - low[k]);
    largest = fmax(largest, fmax(fabs(low[k]), fabs(high[k])));
  }
  const double tolerance = fmax(WELD * diagonal, WELD_SINGLE * largest);
  if (corners->len > 0 && !isfinite(tolerance)) {
    return sb_app_error_input(error, "has corners too far from the origin");
  }
  weld(out, corner, corners->len / 9, tolerance);
  SbReport report = {0};
  out->body = g_new(gsize, out->triangle_count + 1);
  return sb_mesh_orient(&out->turned, out->body, out->triangles, out->triangle_count, out->vertices,
                        &report) == SB_OK ||
         sb_app_error_input(error, "%s", report.text);
}

gboolean sb_stl_read(SbStl *out, const char *data, gsize length, const char *unit, const char *path,
                     GError **error) {
  *out = (SbStl){0};
  g_autofree char *own = NULL;
  if (data == NULL) {
    data = own = sb_reader_load_file(&length, path, path, LONGEST, SB_APP_ERROR_IO, error);
  }
  double scale;
  g_autoptr(GArray) corners = g_array_new(FALSE, FALSE, sizeof(double));
  const bool good = data != NULL && sb_unit_scale(&scale, unit, "m", "mm", error) &&
                    read_mesh(out, corners, data, length, error);
  for (gsize i = 0; good && i < 3 * out->vertex_count; i++) {
    out->vertices[i] *= scale;
  }
  if (!good && data != NULL) {
    sb_app_error_prefix(error, path);
    sb_stl_clear(out);
  }
  return good;
}

void sb_stl_clear(SbStl *stl) {
  if (stl != NULL) {
    g_free(stl->vertices);
    g_free(stl->triangles);
    g_free(stl->body);
    *stl = (SbStl){0};
  }
}

// See stl.h.
#include "app/document/stl.h"

#include "app/document/reader.h"
#include "app/document/unit.h"

#include <math.h>
#include <string.h>

enum { HEADER = 84, RECORD = 50 };

// A text facet takes up to about 300 bytes; 512 leaves room for long numbers.
static const size_t length_max = (size_t)SB_STL_TRIANGLES_MAX * 512;

typedef struct {
  SbStl *out;
  GArray *vertices, *triangles;
  GHashTable *index; // corner -> its number + 1
  double scale;
} Builder;

typedef struct {
  double x[3];
} Corner;

static guint corner_hash(gconstpointer key) {
  guint64 bits[3], hash = 1469598103934665603u;
  memcpy(bits, key, sizeof bits);
  for (int i = 0; i < 3; i++) {
    hash = (hash ^ bits[i] ^ bits[i] >> 29) * 1099511628211u;
  }
  return (guint)(hash ^ hash >> 32);
}

static gboolean corner_equal(gconstpointer a, gconstpointer b) {
  return memcmp(a, b, sizeof(Corner)) == 0;
}

static unsigned vertex_of(Builder *b, const double *x) {
  Corner corner;
  for (int k = 0; k < 3; k++) {
    corner.x[k] = x[k] * b->scale + 0.0; // no negative zero
  }
  gpointer found = g_hash_table_lookup(b->index, &corner);
  if (found != NULL) {
    return GPOINTER_TO_UINT(found) - 1;
  }
  unsigned number = b->vertices->len / 3;
  g_array_append_vals(b->vertices, corner.x, 3);
  g_hash_table_insert(b->index, g_memdup2(&corner, sizeof corner), GUINT_TO_POINTER(number + 1));
  return number;
}

static void add_triangle(Builder *b, const double corner[9]) {
  unsigned v[3] = {vertex_of(b, corner), vertex_of(b, corner + 3), vertex_of(b, corner + 6)};
  if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
    b->out->dropped++;
    return;
  }
  g_array_append_vals(b->triangles, v, 3);
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

// Next word into `word`, cut at its size; FALSE at the end.
static gboolean next_word(Text *t, char *word, gsize size) {
  while (t->at < t->end && g_ascii_isspace(*t->at)) {
    t->line += *t->at == '\n';
    t->at++;
  }
  gsize n = 0;
  while (t->at < t->end && !g_ascii_isspace(*t->at)) {
    if (n + 1 < size) {
      word[n++] = *t->at;
    }
    t->at++;
  }
  word[n] = '\0';
  return n > 0;
}

static void skip_line(Text *t) {
  while (t->at < t->end && *t->at != '\n') {
    t->at++;
  }
}

static gboolean expect(Text *t, const char *wanted, const char *name, GError **error) {
  char word[64];
  if (!next_word(t, word, sizeof word) || g_ascii_strcasecmp(word, wanted) != 0) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s:%d: '%s' expected, not '%s'", name,
                t->line, wanted, word);
    return FALSE;
  }
  return TRUE;
}

static gboolean numbers(Text *t, double *out, const char *name, GError **error) {
  for (int k = 0; k < 3; k++) {
    char word[64], *rest;
    gboolean some = next_word(t, word, sizeof word);
    out[k] = some ? g_ascii_strtod(word, &rest) : NAN;
    if (!some || *rest != '\0' || !isfinite(out[k])) {
      g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s:%d: a number expected, not '%s'",
                  name, t->line, word);
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
  while (next_word(&t, word, sizeof word)) {
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
      g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s:%d: '%s' is not part of STL", name,
                  t.line, word);
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
  char *one = g_strdup_printf("1 %s", unit);
  gboolean known = sb_quantity_parse(&scale, one, "m", "mm", error);
  g_free(one);
  if (!known) {
    return FALSE;
  }
  if (!(scale > 0.0)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: '%s' is no unit of length", name,
                unit);
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
  Builder b = {.out = out,
               .vertices = g_array_new(FALSE, FALSE, sizeof(double)),
               .triangles = g_array_new(FALSE, FALSE, sizeof(unsigned)),
               .index = g_hash_table_new_full(corner_hash, corner_equal, g_free, NULL),
               .scale = scale};
  out->text = text;
  gboolean ok =
      binary ? read_binary(&b, data, count, name, error) : read_text(&b, data, length, name, error);
  if (ok && b.triangles->len == 0) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: no triangles", name);
    ok = FALSE;
  }
  g_hash_table_unref(b.index);
  out->vertex_count = b.vertices->len / 3;
  out->triangle_count = b.triangles->len / 3;
  out->vertices = (double *)(void *)g_array_free(b.vertices, FALSE);
  out->triangles = (unsigned *)(void *)g_array_free(b.triangles, FALSE);
  if (!ok) {
    sb_stl_clear(out);
  }
  return ok;
}

gboolean sb_stl_read(SbStl *out, const char *path, const char *unit, GError **error) {
  *out = (SbStl){0};
  GPtrArray *issues = sb_issues_new();
  gsize length = 0;
  char *data = sb_reader_load(&length, path, path, length_max, issues);
  gboolean ok = FALSE;
  if (data != NULL) {
    ok = sb_stl_parse(out, data, length, unit, path, error);
  } else {
    char *line = sb_issue_line(issues->pdata[0]);
    g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_IO, line);
    g_free(line);
  }
  g_ptr_array_unref(issues);
  g_free(data);
  return ok;
}

void sb_stl_clear(SbStl *stl) {
  if (stl != NULL) {
    g_free(stl->vertices);
    g_free(stl->triangles);
    *stl = (SbStl){0};
  }
}

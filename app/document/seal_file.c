// Sections of seals and outlines of grooves from files; see the header.
#include "app/document/seal_file.h"

#include "app/base/error.h"
#include "app/base/output.h"
#include "app/base/reader.h"
#include "app/base/unit.h"
#include "app/cad/cad.h"
#include "engine/numeric/arc.h"

#include <math.h>
#include <string.h>

// As the named profiles' (ring_profile.c).
static const double WIDE = 5.0;

// Of more pieces than there may be, rows become arcs that lie so near, in heights, and bend by less
// than a corner at each joint [rad].
static const double NEAR = 2e-4, CORNER = 0.35;

static void fault(GError **error, const char *path, const char *format, ...) G_GNUC_PRINTF(3, 4);
static void fault(GError **error, const char *path, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *shown = sb_printable(path, strlen(path));
  g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: %s", shown, text);
}

// Comments become blanks.
static void drop_comments(char *text) {
  for (char *c = text; (c = strchr(c, '#')) != NULL;) {
    for (; *c != '\0' && *c != '\n'; c++) {
      *c = ' ';
    }
  }
}

// What is looked for: the layers that may be called so, the first of them in messages.
typedef struct {
  const char *what, *layer[3];
} Wanted;

static const Wanted SECTION = {"a section", {"seal", "section", "free"}};
static const Wanted GROOVE = {"a groove", {"groove", "gland"}};

static bool is_wanted(const char *name, const Wanted *wanted) {
  for (size_t i = 0; i < G_N_ELEMENTS(wanted->layer) && wanted->layer[i] != NULL; i++) {
    if (g_ascii_strcasecmp(name, wanted->layer[i]) == 0) {
      return true;
    }
  }
  return false;
}

// A file's text, which is read once, and where the file is.
typedef struct {
  const char *path;
  char *text;
  size_t length;
} Source;

// First word of a text behind its comments, "" if there is none. Borrowed.
static const char *first_word(const char *text) {
  const char *at = text;
  for (;;) {
    at += strspn(at, " \t\r\n");
    if (*at != '#') {
      return at;
    }
    at += strcspn(at, "\n");
  }
}

// A drawing and not a text of points, which begins with their unit.
static bool is_drawing(const Source *source) {
  const char *word = first_word(source->text);
  return !g_ascii_isalpha(*word) || g_str_has_prefix(word, "ISO-10303") ||
         g_str_has_prefix(word, "solid") || g_str_has_prefix(word, "AutoCAD");
}

static SbCad *read_drawing(const Source *source, GError **error) {
  const SbCadChoices choices = {.section = true};
  // Only a DXF can be read from memory; other drawings are read by a program of their own.
  return g_ascii_isdigit(*first_word(source->text))
             ? sb_cad_parse_dxf(source->text, source->length, source->path, &choices, error)
             : sb_cad_read(source->path, &choices, error);
}

// Number of closed outlines of a drawing on a layer with one of the wanted names; *found: the one
// to take, where there is only one.
static guint count_wanted(const SbCad *cad, const Wanted *wanted, const SbCadBody **found) {
  guint called = 0;
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    if (body->profile->len > 0 && body->closed && is_wanted(body->name, wanted)) {
      *found = called == 0 ? body : *found;
      called++;
    }
  }
  return called;
}

// The closed outline of a drawing that has one, or one that is called so; NULL with an error.
static GArray *from_drawing(const Source *source, const Wanted *wanted, GError **error) {
  g_autoptr(SbCad) cad = read_drawing(source, error);
  const SbCadBody *found = NULL;
  guint count = 0;
  if (cad == NULL) {
    return NULL;
  }
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    if (body->profile->len > 0 && body->closed) {
      found = body;
      count++;
    }
  }
  const guint called = count_wanted(cad, wanted, &found);
  if (count != 1 && called != 1) {
    if (count == 0) {
      fault(error, source->path, "contains no closed outline of %s", wanted->what);
    } else {
      fault(error, source->path,
            "contains %u closed outlines, none of them the only one on a layer \"%s\"", count,
            wanted->layer[0]);
    }
    return NULL;
  }
  GArray *points = g_array_new(FALSE, FALSE, sizeof(SbProfilePoint));
  g_array_append_vals(points, found->profile->data, found->profile->len);
  return points;
}

static bool load(Source *out, const char *path, GError **error) {
  const size_t bytes_max = (size_t)256 << 20; // as sb_cad_read()
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *shown = sb_printable(path, strlen(path));
  *out = (Source){.path = path};
  out->text = sb_reader_load(&out->length, path, shown, bytes_max, issues);
  if (out->text == NULL) {
    const SbIssue *issue = issues->pdata[0];
    fault(error, path, "%s", issue->text);
  }
  return out->text != NULL;
}

// Its points [m]; NULL with an error.
static GArray *read_points(const Source *source, const Wanted *wanted, bool *closed,
                           GError **error) {
  if (is_drawing(source)) {
    *closed = true;
    return from_drawing(source, wanted, error);
  }
  GError *own = NULL;
  g_autofree char *text = g_strdup(source->text);
  drop_comments(text);
  GArray *points = sb_profile_parse(text, closed, &own);
  if (points == NULL) {
    fault(error, source->path, "%s (as in \"" SB_PROFILE_FORM "\")", own->message);
    g_error_free(own);
  }
  return points;
}

// Extent of the piece from p to q along x and r.
static void extend(double low[2], double high[2], const SbProfilePoint *p,
                   const SbProfilePoint *q) {
  const double from[2] = {p->x, p->r};
  for (int k = 0; k < 2; k++) {
    low[k] = fmin(low[k], from[k]);
    high[k] = fmax(high[k], from[k]);
  }
  if (p->bulge == 0) {
    return;
  }
  const double to[2] = {q->x, q->r};
  const SbArc arc = sb_arc_of(from, to, p->bulge);
  for (int quarter = 0; quarter < 4; quarter++) {
    double way = fmod((quarter * M_PI / 2 - arc.start) * copysign(1, arc.sweep), 2 * M_PI);
    way += way < 0 ? 2 * M_PI : 0;
    if (way < fabs(arc.sweep)) {
      const int k = quarter % 2;
      const double at = arc.centre[k] + (quarter < 2 ? arc.radius : -arc.radius);
      low[k] = fmin(low[k], at);
      high[k] = fmax(high[k], at);
    }
  }
}

// Heading of a piece at its end or beginning [rad].
static double heading(const SbProfilePoint *p, const SbProfilePoint *q, bool at_end) {
  return atan2(q->r - p->r, q->x - p->x) + (at_end ? 2 : -2) * atan(p->bulge);
}

// How far a place lies from the arc from `from` through `by` to `to`, which is a line where these
// are on one.
static double off_arc(const SbProfilePoint *from, const SbProfilePoint *by,
                      const SbProfilePoint *to, double x, double r) {
  const double ax = by->x - from->x, ar = by->r - from->r;
  const double bx = to->x - from->x, br = to->r - from->r, cross = ax * br - ar * bx;
  const double aa = ax * ax + ar * ar, bb = bx * bx + br * br;
  if (fabs(cross) < 1e-6 * bb) {
    return fabs((x - from->x) * br - (r - from->r) * bx) / sqrt(bb);
  }
  const double cx = (br * aa - ar * bb) / (2 * cross), cr = (ax * bb - bx * aa) / (2 * cross);
  return fabs(hypot(x - from->x - cx, r - from->r - cr) - hypot(cx, cr));
}

// Whether the row of pieces from `first` to `last` is nearly one arc or line; its bulge.
static bool one_arc(double *bulge, const GArray *row, guint first, guint last, double near) {
  const SbProfilePoint *p = (const SbProfilePoint *)(void *)row->data;
  const SbProfilePoint *from = &p[first], *to = &p[last], *by = &p[(first + last) / 2];
  const double chord = hypot(to->x - from->x, to->r - from->r);
  double turn = 0;
  for (guint i = first; i < last; i++) {
    const double bow = p[i].bulge / 2; // of the chord, to the right
    const double x = (p[i].x + p[i + 1].x) / 2 + bow * (p[i + 1].r - p[i].r);
    const double r = (p[i].r + p[i + 1].r) / 2 - bow * (p[i + 1].x - p[i].x);
    const double bend =
        i > first ? remainder(heading(&p[i], &p[i + 1], false) - heading(&p[i - 1], &p[i], true),
                              2 * M_PI)
                  : 0;
    turn += bend + 4 * atan(p[i].bulge);
    if (!(chord > 0) || off_arc(from, by, to, x, r) > near ||
        off_arc(from, by, to, p[i].x, p[i].r) > near || fabs(bend) > CORNER ||
        fabs(turn) > 0.9 * M_PI) {
      return false;
    }
  }
  // By the middle vertex: sagitta over half the chord, to the right.
  const double side =
      ((by->x - from->x) * (to->r - from->r) - (by->r - from->r) * (to->x - from->x)) / chord;
  const double along =
      ((by->x - from->x) * (to->x - from->x) + (by->r - from->r) * (to->r - from->r)) / chord;
  const double angle = atan2(side, along) + atan2(side, chord - along); // half of the arc's
  *bulge = fabs(angle) < 1e-6 ? 0 : tan(angle / 2);
  return true;
}

// Joins rows of pieces; from a corner on, if there is one.
static GArray *join_seal_file(const GArray *points, double near) {
  const guint n = points->len;
  const SbProfilePoint *p = (const SbProfilePoint *)(void *)points->data;
  guint begin = 0;
  for (guint i = 0; i < n && begin == 0; i++) {
    const double bend =
        heading(&p[i], &p[(i + 1) % n], false) - heading(&p[(i + n - 1) % n], &p[i], true);
    begin = fabs(remainder(bend, 2 * M_PI)) > CORNER ? i : 0;
  }
  g_autoptr(GArray) row = g_array_new(FALSE, FALSE, sizeof *p);
  g_array_append_vals(row, &p[begin], n - begin);
  g_array_append_vals(row, p, begin);
  g_array_append_val(row, p[begin]);
  GArray *out = g_array_new(FALSE, FALSE, sizeof *p);
  for (guint i = 0; i < n;) {
    SbProfilePoint point = g_array_index(row, SbProfilePoint, i);
    guint end = i + 1;
    double bulge;
    while (end < n && one_arc(&bulge, row, i, end + 1, near)) {
      point.bulge = bulge;
      end++;
    }
    g_array_append_val(out, point);
    i = end;
  }
  return out;
}

static bool read_section(SbSealDrawing *out, double *height, const Source *source, GError **error) {
  const char *path = source->path;
  out->count = 0;
  bool closed;
  g_autoptr(GArray) points = read_points(source, &SECTION, &closed, error);
  if (points == NULL) {
    return false;
  }
  if (!closed) {
    fault(error, path, "does not close: a section repeats its first point");
    return false;
  }
  sb_profile_turn(points, true);
  SbProfilePoint *point = (SbProfilePoint *)(void *)points->data;
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  for (guint i = 0; i < points->len; i++) {
    extend(low, high, &point[i], &point[(i + 1) % points->len]);
  }
  const double h = high[1] - low[1], w = high[0] - low[0];
  if (!(h > 0) || !(w > 0) || w > WIDE * h || h > WIDE * w) {
    fault(error, path,
          "is %.4g mm wide (x) and %.4g mm high (r): no more than %g times as the other", 1e3 * w,
          1e3 * h, WIDE);
    return false;
  }
  const guint pieces = points->len;
  if (pieces > SB_SEAL_POINTS_MAX) {
    GArray *fewer = join_seal_file(points, NEAR * h);
    g_array_unref(points);
    points = fewer;
    point = (SbProfilePoint *)(void *)points->data;
  }
  if (points->len > SB_SEAL_POINTS_MAX) {
    fault(error, path,
          "has %u pieces; arcs within %g of its height reduce them to %u, more than the allowed %d",
          pieces, NEAR, points->len, SB_SEAL_POINTS_MAX);
    return false;
  }
  const int n = (int)points->len;
  // Off the axis, wherever it was drawn.
  for (int i = 0; i < n; i++) {
    point[i].r += h - low[1];
  }
  const SbProfile profile = {point, points->len, true};
  SbReport report = {0};
  if (sb_profile_check(&profile, &report) != SB_OK) {
    fault(error, path, "%s", report.text);
    return false;
  }
  // Counter-clockwise in (x, r) is clockwise in (r, x): the other way round.
  for (int i = 0; i < n; i++) {
    const SbProfilePoint *p = &point[n - 1 - i], *before = &point[(2 * n - 2 - i) % n];
    out->point[i] =
        (SbSealPoint){(p->r - h) / h - 0.5, (p->x - (low[0] + high[0]) / 2) / h, before->bulge};
  }
  out->count = n;
  *height = h;
  return true;
}

bool sb_seal_file_read(SbSealDrawing *out, double *height, const char *path, GError **error) {
  out->count = 0;
  Source source;
  const bool good = load(&source, path, error) && read_section(out, height, &source, error);
  g_free(source.text);
  return good;
}

// Takes the opening of a closed outline away: the straight piece along the axis that lies
// outermost.
static bool take_opening(GArray *points) {
  const SbProfilePoint *p = (const SbProfilePoint *)(void *)points->data;
  const guint n = points->len;
  guint opening = n;
  for (guint i = 0; i < n; i++) {
    const SbProfilePoint *q = &p[(i + 1) % n];
    if (p[i].bulge == 0 && fabs(q->r - p[i].r) < 1e-3 * fabs(q->x - p[i].x) &&
        (opening == n || p[i].r > p[opening].r)) {
      opening = i;
    }
  }
  for (guint i = 0; opening < n && i < n; i++) {
    if (p[i].r > fmax(p[opening].r, p[(opening + 1) % n].r) + 1e-9) {
      return false;
    }
  }
  if (opening == n) {
    return false;
  }
  g_autoptr(GArray) row = g_array_new(FALSE, FALSE, sizeof *p);
  for (guint i = 1; i <= n; i++) {
    g_array_append_val(row, p[(opening + i) % n]);
  }
  memcpy(points->data, row->data, n * sizeof *p);
  return true;
}

static bool read_groove(SbGrooveDrawing *out, const Source *source, GError **error) {
  const char *path = source->path;
  *out = (SbGrooveDrawing){0};
  bool closed;
  g_autoptr(GArray) points = read_points(source, &GROOVE, &closed, error);
  if (points == NULL) {
    return false;
  }
  if (closed && !take_opening(points)) {
    fault(error, path, "is closed without a straight opening along the axis on the outside");
    return false;
  }
  if (points->len > SB_SEAL_POINTS_MAX) {
    fault(error, path, "has %u points, more than %d", points->len, SB_SEAL_POINTS_MAX);
    return false;
  }
  SbSealPoint point[SB_SEAL_POINTS_MAX];
  for (guint i = 0; i < points->len; i++) {
    const SbProfilePoint *p = &g_array_index(points, SbProfilePoint, i);
    point[i] = (SbSealPoint){p->r, p->x, p->bulge};
  }
  SbReport report = {0};
  if (sb_groove_draw(out, point, (int)points->len, &report) != SB_OK) {
    *out = (SbGrooveDrawing){0};
    fault(error, path, "%s", report.text);
    return false;
  }
  return true;
}

bool sb_groove_file_read(SbGrooveDrawing *out, const char *path, GError **error) {
  *out = (SbGrooveDrawing){0};
  Source source;
  const bool good = load(&source, path, error) && read_groove(out, &source, error);
  g_free(source.text);
  return good;
}

// ---- Checking ----

// Whether a text begins with the unit of its points.
static bool begins_with_length(const char *text) {
  const char *word = first_word(text);
  g_autofree char *one = g_strdup_printf("1 %.*s", (int)strcspn(word, " \t\r\n"), word);
  double scale = 0;
  return g_ascii_isalpha(*word) && sb_quantity_parse(&scale, one, "m", "mm", NULL);
}

bool sb_seal_file_is_drawing(const char *text, const char *path) {
  static const char *const endings[] = {".dxf", ".step", ".stp", ".stl"};
  for (size_t i = 0; i < G_N_ELEMENTS(endings); i++) {
    if (sb_output_ends_in(path, endings[i])) {
      return true;
    }
  }
  const char *word = first_word(text);
  // The first group of a DXF: code 0 or, of a comment, 999.
  const size_t digits = strspn(word, "0123456789");
  const bool dxf = (digits == 1 && *word == '0') || g_str_has_prefix(word, "999");
  const char *after = word + digits + strspn(word + digits, " \t\r");
  return (dxf && *after == '\n') || g_str_has_prefix(word, "ISO-10303") ||
         g_str_has_prefix(word, "AutoCAD") || begins_with_length(text);
}

bool sb_seal_file_check(bool *groove, const char *text, size_t length, const char *path,
                        GError **error) {
  const Source source = {path, (char *)text, length};
  SbSealDrawing section;
  SbGrooveDrawing drawn;
  double height;
  GError *own = NULL, *other = NULL;
  if (is_drawing(&source)) {
    g_autoptr(SbCad) cad = read_drawing(&source, error);
    const SbCadBody *found = NULL;
    if (cad == NULL) {
      return false;
    }
    *groove = count_wanted(cad, &GROOVE, &found) > 0 && count_wanted(cad, &SECTION, &found) == 0;
    return *groove ? read_groove(&drawn, &source, error)
                   : read_section(&section, &height, &source, error);
  }
  bool closed = true;
  g_autoptr(GArray) points = read_points(&source, &SECTION, &closed, error);
  if (points == NULL) {
    return false;
  }
  *groove = !closed;
  if (!closed) {
    return read_groove(&drawn, &source, error);
  }
  // A closed text of points may be a groove with its opening.
  if (!read_section(&section, &height, &source, &own) && read_groove(&drawn, &source, &other)) {
    *groove = true;
    g_clear_error(&own);
  }
  g_clear_error(&other);
  if (own != NULL) {
    g_propagate_error(error, own);
  }
  return own == NULL;
}

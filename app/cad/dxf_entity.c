// Entities of a DXF: their pairs of a group code and a value, and their curves as pieces.
#include "app/cad/dxf_private.h"

// Control points of a spline and its degree; values of a list.
enum { CONTROL_MAX = 2000, DEGREE_MAX = 15, MOST = 100000 };

// Beyond this an entity is left out [m].
static const double FARTHEST = 1e6;

// Group codes of the lists.
static const int list_code[SB_DXF_LISTS] = {10, 20, 42, 40, 41};

// Reads a line to reader->value; false at the end.
static bool read_line(SbDxfReader *reader) {
  const char *at = reader->next.at;
  if (at >= reader->end) {
    return false;
  }
  const char *stop = memchr(at, reader->separator, (size_t)(reader->end - at));
  reader->next.at = stop != NULL ? stop + 1 : reader->end;
  reader->next.line++;
  stop = stop != NULL ? stop : reader->end;
  const size_t length = MIN((size_t)(stop - at), sizeof reader->value - 1);
  memcpy(reader->value, at, length);
  reader->value[length] = '\0';
  g_strstrip(reader->value);
  return true;
}

bool sb_dxf_read_pair(SbDxfReader *reader, GError **error) {
  double code;
  if (!read_line(reader)) {
    return false;
  }
  if (!sb_number_parse(&code, reader->value) || code != floor(code) || fabs(code) > 9999) {
    return sb_app_error_input(error, "line %d is not a group code of a DXF", reader->next.line);
  }
  reader->code = (int)code;
  return read_line(reader) ||
         sb_app_error_input(error, "the file ends after line %d", reader->next.line);
}

bool sb_dxf_number(const SbDxfReader *reader, double *out, GError **error) {
  const double most = reader->code >= 60 && reader->code < 80 ? 32768 : 1e12;
  return (sb_number_parse(out, reader->value) && fabs(*out) < most) ||
         sb_app_error_input(error, "line %d: '%s' is not a number here", reader->next.line,
                            reader->value);
}

void sb_dxf_entity_clear(SbDxfEntity *entity) {
  for (int i = 0; i < SB_DXF_LISTS; i++) {
    g_clear_pointer(&entity->list[i], g_array_unref);
  }
}

// Takes a pair of an entity.
static bool entity_take(SbDxfEntity *entity, const SbDxfReader *reader, GError **error) {
  const int code = reader->code;
  char *text = code == 8   ? entity->layer
               : code == 2 ? entity->name
               : code == 6 ? entity->line_type
                           : NULL;
  double value;
  if (text != NULL) {
    g_strlcpy(text, reader->value, sizeof entity->layer);
  }
  const bool number = (code >= 10 && code < 80) || code == 210 || code == 220 || code == 230;
  if (!number || !sb_dxf_number(reader, &value, error)) {
    return !number;
  }
  entity->number[code] = value;
  if (code == 30 || (code == 31 && sb_dxf_is(entity, "LINE"))) {
    entity->low = fmin(entity->low, value);
    entity->high = fmax(entity->high, value);
  }
  for (int i = 0; i < SB_DXF_LISTS; i++) {
    GArray *to = entity->list[i];
    // A bulge belongs to the point before it.
    while (code == list_code[i] && i == SB_DXF_BULGE && to->len + 1 < entity->list[SB_DXF_X]->len) {
      const double straight = 0;
      g_array_append_val(to, straight);
    }
    if (code == list_code[i] && to->len < MOST) {
      g_array_append_val(to, value);
    } else if (code == list_code[i]) {
      return sb_app_error_input(error, "line %d: more than %d points", reader->next.line, MOST);
    }
  }
  return true;
}

bool sb_dxf_read_entity(SbDxfEntity *entity, SbDxfReader *reader, GError **error) {
  if (!sb_dxf_read_pair(reader, error)) {
    return false;
  }
  sb_dxf_entity_clear(entity);
  *entity = (SbDxfEntity){.layer = "0", .number[230] = 1, .low = INFINITY, .high = -INFINITY};
  g_strlcpy(entity->type, reader->value, sizeof entity->type);
  for (int i = 0; i < SB_DXF_LISTS; i++) {
    entity->list[i] = g_array_new(FALSE, FALSE, sizeof(double));
  }
  enum { FRAME = 16 }; // a VERTEX that is a control point of a spline, not of the line
  double flags = 0;
  guint before = 0;
  bool in_vertex = false, vertex = true;
  while (vertex) {
    const bool more = sb_dxf_read_pair(reader, error);
    if (*error != NULL || (more && reader->code != 0 && !entity_take(entity, reader, error))) {
      return false;
    }
    if (more && reader->code != 0) {
      continue;
    }
    const bool frame = in_vertex && ((int)entity->number[70] & FRAME) != 0;
    vertex = more && sb_dxf_is(entity, "POLYLINE") && strcmp(reader->value, "VERTEX") == 0;
    flags = in_vertex ? flags : entity->number[70];
    for (int i = 0; (frame || (vertex && !in_vertex)) && i <= SB_DXF_BULGE; i++) {
      g_array_set_size(entity->list[i], MIN(entity->list[i]->len, before));
    }
    entity->number[70] = vertex ? 0 : flags;
    before = entity->list[SB_DXF_X]->len;
    in_vertex = vertex;
  }
  return true;
}

static double at(const GArray *list, guint i) {
  return i < list->len ? g_array_index(list, double, i) : 0;
}

static void map(const SbDxfMap *way, double x, double y, double xy[2]) {
  xy[0] = way->a * x + way->b * y + way->c;
  xy[1] = way->d * x + way->e * y + way->f;
}

SbDxfMap sb_dxf_after(const SbDxfMap *out, const SbDxfMap *in) {
  return (SbDxfMap){
      out->a * in->a + out->b * in->d,          out->a * in->b + out->b * in->e,
      out->a * in->c + out->b * in->f + out->c, out->d * in->a + out->e * in->d,
      out->d * in->b + out->e * in->e,          out->d * in->c + out->e * in->f + out->f};
}

SbPiece sb_dxf_place(const SbDxfMap *way, const SbPiece *piece) {
  double from[2], to[2];
  map(way, piece->x0, piece->y0, from);
  map(way, piece->x1, piece->y1, to);
  const bool turned = way->a * way->e - way->b * way->d < 0;
  return (SbPiece){from[0], from[1], to[0], to[1], turned ? -piece->bulge : piece->bulge};
}

// A part of an ellipse, from the angle `start` over `sweep`.
typedef struct {
  const SbDxfMap *way;
  double centre[2], major[2], minor[2], start, sweep;
} Ellipse;

static void ellipse_at(const void *curve, double t, double xy[2]) {
  const Ellipse *e = curve;
  const double angle = e->start + t * e->sweep, c = cos(angle), s = sin(angle);
  map(e->way, e->centre[0] + c * e->major[0] + s * e->minor[0],
      e->centre[1] + c * e->major[1] + s * e->minor[1], xy);
}

// Adds a straight line or an arc; an arc is one if the map preserves circles, else is followed.
static bool add_bulge(GArray *out, const SbDxfMap *way, const SbPiece *piece) {
  const double u = hypot(way->a, way->d), v = hypot(way->b, way->e);
  const bool even =
      fabs(u - v) <= 1e-9 * (u + v) && fabs(way->a * way->b + way->d * way->e) <= 1e-9 * u * v;
  if (piece->bulge != 0 && !even) {
    const SbArc arc = sb_piece_arc(piece);
    const Ellipse circle = {
        way,      {arc.centre[0], arc.centre[1]}, {arc.radius, 0}, {0, arc.radius}, arc.start,
        arc.sweep};
    return sb_cad_curve(out, ellipse_at, &circle, 2);
  }
  const SbPiece there = sb_dxf_place(way, piece);
  g_array_append_val(out, there);
  return true;
}

// The minor axis is the extrusion direction times the major axis.
static bool add_ellipse(GArray *out, const SbDxfMap *way, const SbDxfEntity *entity) {
  const double *n = entity->number, up = n[230] < 0 ? -n[40] : n[40];
  const double end = n[42] > n[41] ? n[42] : n[42] + 2 * M_PI;
  const Ellipse curve = {way,   {n[10], n[20]}, {n[11], n[21]}, {-up * n[21], up * n[11]},
                         n[41], end - n[41]};
  return n[40] > 0 && curve.sweep <= 2 * M_PI + 1e-6 && sb_cad_curve(out, ellipse_at, &curve, 4);
}

// An arc in two halves. A circle has no angles; those that a file states for it are ignored.
static bool add_arc(GArray *out, const SbDxfMap *way, const SbDxfEntity *entity) {
  const bool circle = sb_dxf_is(entity, "CIRCLE");
  const double *n = entity->number, start = circle ? 0 : n[50] * M_PI / 180;
  const double degrees = circle ? 0 : fmod(n[51] - n[50], 360);
  const double turn = (degrees > 0 ? degrees : degrees + 360) * M_PI / 180;
  bool good = n[40] > 0;
  for (int i = 0; good && i < 2; i++) {
    const double a = start + i * turn / 2, b = a + turn / 2;
    const SbPiece half = {n[10] + n[40] * cos(a), n[20] + n[40] * sin(a), n[10] + n[40] * cos(b),
                          n[20] + n[40] * sin(b), tan(turn / 8)};
    good = add_bulge(out, way, &half);
  }
  return good;
}

typedef struct {
  const SbDxfMap *way;
  const SbDxfEntity *entity;
  int degree, span; // from knot `span` to the next
} Spline;

// De Boor's algorithm in homogeneous coordinates.
static void spline_at(const void *curve, double t, double xy[2]) {
  const Spline *s = curve;
  GArray *const *list = s->entity->list;
  const bool weighted = list[SB_DXF_WEIGHT]->len == list[SB_DXF_X]->len;
  const double *knot = (const double *)(void *)list[SB_DXF_KNOT]->data;
  const int p = s->degree, k = s->span;
  const double u = (1 - t) * knot[k] + t * knot[k + 1];
  double d[DEGREE_MAX + 1][3];
  for (int j = 0; j <= p; j++) {
    const guint i = (guint)(k - p + j);
    d[j][2] = weighted ? at(list[SB_DXF_WEIGHT], i) : 1;
    d[j][0] = d[j][2] * at(list[SB_DXF_X], i);
    d[j][1] = d[j][2] * at(list[SB_DXF_Y], i);
  }
  for (int r = 1; r <= p; r++) {
    for (int j = p; j >= r; j--) {
      const double low = knot[j + k - p], high = knot[j + 1 + k - r];
      const double a = high > low ? (u - low) / (high - low) : 0;
      for (int c = 0; c < 3; c++) {
        d[j][c] = (1 - a) * d[j - 1][c] + a * d[j][c];
      }
    }
  }
  map(s->way, d[p][0] / d[p][2], d[p][1] / d[p][2], xy);
}

// Each span between knots by itself: the curve may have kinks there.
static bool add_spline(GArray *out, const SbDxfMap *way, const SbDxfEntity *entity) {
  GArray *const *list = entity->list;
  const int degree = (int)entity->number[71], count = (int)list[SB_DXF_X]->len;
  bool good = degree >= 1 && degree <= DEGREE_MAX && count > degree && count <= CONTROL_MAX &&
              (int)list[SB_DXF_Y]->len == count &&
              (int)list[SB_DXF_KNOT]->len == count + degree + 1;
  for (guint i = 1; good && i < list[SB_DXF_KNOT]->len; i++) {
    good = at(list[SB_DXF_KNOT], i) >= at(list[SB_DXF_KNOT], i - 1);
  }
  for (int k = degree; good && k < count; k++) {
    const Spline spline = {way, entity, degree, k};
    good = at(list[SB_DXF_KNOT], (guint)k + 1) == at(list[SB_DXF_KNOT], (guint)k) ||
           sb_cad_curve(out, spline_at, &spline, 1);
  }
  return good;
}

static bool add_points(GArray *out, const SbDxfMap *way, const SbDxfEntity *entity) {
  enum { CLOSED = 1, MESHES = 16 | 64 };
  const int flags = (int)entity->number[70];
  const guint count = entity->list[SB_DXF_X]->len;
  bool good = entity->list[SB_DXF_Y]->len == count && count > 1 &&
              (sb_dxf_is(entity, "LWPOLYLINE") || (flags & MESHES) == 0);
  for (guint i = 0; good && i + !(flags & CLOSED) < count; i++) {
    const guint next = (i + 1) % count;
    const SbPiece piece = {at(entity->list[SB_DXF_X], i), at(entity->list[SB_DXF_Y], i),
                           at(entity->list[SB_DXF_X], next), at(entity->list[SB_DXF_Y], next),
                           at(entity->list[SB_DXF_BULGE], i)};
    good = (piece.x0 == piece.x1 && piece.y0 == piece.y1) || add_bulge(out, way, &piece);
  }
  return good;
}

bool sb_dxf_pieces(GArray *out, const SbDxfMap *way, const SbDxfEntity *entity) {
  const double *n = entity->number;
  const SbPiece line = {n[10], n[20], n[11], n[21], 0};
  const bool arc = sb_dxf_is(entity, "CIRCLE") || sb_dxf_is(entity, "ARC");
  const bool points = sb_dxf_is(entity, "LWPOLYLINE") || sb_dxf_is(entity, "POLYLINE");
  bool good = sb_dxf_is(entity, "LINE")      ? add_bulge(out, way, &line)
              : arc                          ? add_arc(out, way, entity)
              : sb_dxf_is(entity, "ELLIPSE") ? add_ellipse(out, way, entity)
              : sb_dxf_is(entity, "SPLINE")  ? add_spline(out, way, entity)
                                             : points && add_points(out, way, entity);
  for (guint i = 0; good && i < out->len; i++) {
    const SbPiece *p = &g_array_index(out, SbPiece, i);
    good = fmax(fmax(fabs(p->x0), fabs(p->y0)), fmax(fabs(p->x1), fabs(p->y1))) < FARTHEST;
  }
  return good;
}

// Outlines from DXF text: LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE, POLYLINE and SPLINE of model
// space and of the blocks that it inserts, by layers. A pair of lines is a group code and its
// value. The file is read twice: first for the unit, the layers and the places of blocks and
// entities in the text, then each entity where it is placed. Source: AutoCAD DXF Reference
// (Autodesk).
//
// LINE, ELLIPSE, SPLINE and 3D polylines are in world coordinates. The others are in object
// coordinates, whose x is reversed if the extrusion direction is (0, 0, -1).
#include "app/base/error.h"
#include "app/base/number.h"
#include "app/base/unit.h"
#include "app/cad/cad_private.h"

#include <math.h>
#include <string.h>

// Control points of a spline, its degree; pieces, entities read, entities placed and layers with
// pieces of a file; nested blocks, of which one may contain itself; different entities left out.
enum {
  CONTROL_MAX = 2000,
  DEGREE_MAX = 15,
  PIECES_MAX = 100000,
  ENTITIES_MAX = 1000000,
  PLACED_MAX = 100000,
  LAYERS_MAX = 200,
  DEPTH_MAX = 8,
  LEFT_OUT_MAX = 20
};

// Ends are one point within this, unless `join` is given; drawings round to a thousandth of their
// unit at worst. Beyond FARTHEST an entity is left out [m].
static const double GAP = 1e-6, FARTHEST = 1e6;

// Where a pair begins in the text.
typedef struct {
  const char *at;
  int line;
} Item;

typedef struct {
  Item next;       // remainder of the text
  const char *end; // of the text
  char separator;  // of lines
  int code;
  char value[512]; // trimmed, cut
} Reader;

// Values that an entity may repeat, and their group codes.
enum { X, Y, BULGE, KNOT, WEIGHT, LISTS };
static const int list_code[LISTS] = {10, 20, 42, 40, 41};

// An entity: its values by group code. A POLYLINE has the points of its VERTEX entities.
typedef struct {
  char type[32], layer[256], line_type[256], name[256];
  double number[256];
  double low, high;    // of z
  GArray *list[LISTS]; // of double
} Entity;

// A block, or model space.
typedef struct {
  double base[2];
  GArray *items; // of Item
} Block;

// x' = a x + b y + c, y' = d x + e y + f
typedef struct {
  double a, b, c, d, e, f;
} Affine;

typedef struct {
  Reader text;          // at its start
  Block *model;         // the section ENTITIES
  GHashTable *blocks;   // name in lower case -> Block
  GHashTable *hidden;   // name of a layer in lower case -> why it is not seen
  GPtrArray *names;     // of the layers with pieces, in order of appearance
  GPtrArray *layers;    // of GArray of SbCadPiece [m], in the order of `names`
  GHashTable *left_out; // type and reason -> count
  GArray *centre;       // of SbCadPiece [m]: centre lines
  guint pieces, items, placed;
  char *unit;   // owned; NULL: not known
  double scale; // its length [m]
} Drawing;

// ---- Pairs ----

// Reads a line to reader->value; false at the end.
static bool read_line(Reader *reader) {
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

// The next pair. False at the end; a code that is no number sets an error.
static bool read_pair(Reader *reader, GError **error) {
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

// Codes 60 to 79 are 16-bit integers.
static bool value_number(const Reader *reader, double *out, GError **error) {
  const double most = reader->code >= 60 && reader->code < 80 ? 32768 : 1e12;
  return (sb_number_parse(out, reader->value) && fabs(*out) < most) ||
         sb_app_error_input(error, "line %d: '%s' is not a number here", reader->next.line,
                            reader->value);
}

// ---- Entities ----

static void entity_clear(Entity *entity) {
  for (int i = 0; i < LISTS; i++) {
    g_clear_pointer(&entity->list[i], g_array_unref);
  }
}

static void entity_begin(Entity *entity, const char *type) {
  entity_clear(entity);
  *entity = (Entity){.layer = "0", .number[230] = 1, .low = INFINITY, .high = -INFINITY};
  g_strlcpy(entity->type, type, sizeof entity->type);
  for (int i = 0; i < LISTS; i++) {
    entity->list[i] = g_array_new(FALSE, FALSE, sizeof(double));
  }
}

static bool is_type(const Entity *entity, const char *type) {
  return strcmp(entity->type, type) == 0;
}

// Takes a pair of an entity.
static bool entity_take(Entity *entity, const Reader *reader, GError **error) {
  const int code = reader->code;
  char *text = code == 8   ? entity->layer
               : code == 2 ? entity->name
               : code == 6 ? entity->line_type
                           : NULL;
  double value;
  if (text != NULL) {
    g_strlcpy(text, reader->value, sizeof entity->layer);
  }
  if (!((code >= 10 && code < 80) || code == 210 || code == 220 || code == 230)) {
    return true;
  }
  if (!value_number(reader, &value, error)) {
    return false;
  }
  entity->number[code] = value;
  if (code == 30 || (code == 31 && is_type(entity, "LINE"))) {
    entity->low = fmin(entity->low, value);
    entity->high = fmax(entity->high, value);
  }
  for (int i = 0; i < LISTS; i++) {
    GArray *list = entity->list[i];
    // A bulge belongs to the point before it.
    while (code == list_code[i] && i == BULGE && list->len + 1 < entity->list[X]->len) {
      const double straight = 0;
      g_array_append_val(list, straight);
    }
    if (code == list_code[i] && list->len < PIECES_MAX) {
      g_array_append_val(list, value);
    } else if (code == list_code[i]) {
      return sb_app_error_input(error, "line %d: more than %d points", reader->next.line,
                                PIECES_MAX);
    }
  }
  return true;
}

// Reads an entity from its type on, a POLYLINE up to its last VERTEX. False at the end of the text,
// or with an error.
static bool read_entity(Entity *entity, Reader *reader, GError **error) {
  if (!read_pair(reader, error)) {
    return false;
  }
  entity_begin(entity, reader->value);
  enum { FRAME = 16 }; // a VERTEX that is a control point of a spline, not of the line
  double flags = 0;
  guint before = 0;
  bool in_vertex = false, vertex = true;
  while (vertex) {
    const Item here = reader->next;
    const bool more = read_pair(reader, error);
    if (*error != NULL || (more && reader->code != 0 && !entity_take(entity, reader, error))) {
      return false;
    }
    if (more && reader->code != 0) {
      continue;
    }
    const bool frame = in_vertex && ((int)entity->number[70] & FRAME) != 0;
    vertex = more && is_type(entity, "POLYLINE") && strcmp(reader->value, "VERTEX") == 0;
    flags = in_vertex ? flags : entity->number[70];
    for (int i = 0; (frame || (vertex && !in_vertex)) && i <= BULGE; i++) {
      g_array_set_size(entity->list[i], MIN(entity->list[i]->len, before));
    }
    entity->number[70] = vertex ? 0 : flags;
    before = entity->list[X]->len;
    in_vertex = vertex;
    if (!vertex) {
      reader->next = here;
    }
  }
  return true;
}

static double at(const GArray *list, guint i) {
  return i < list->len ? g_array_index(list, double, i) : 0;
}

// ---- Curves, placed [m] ----

static void map(const Affine *way, double x, double y, double xy[2]) {
  xy[0] = way->a * x + way->b * y + way->c;
  xy[1] = way->d * x + way->e * y + way->f;
}

// First `in`, then `out`.
static Affine after(const Affine *out, const Affine *in) {
  return (Affine){
      out->a * in->a + out->b * in->d,          out->a * in->b + out->b * in->e,
      out->a * in->c + out->b * in->f + out->c, out->d * in->a + out->e * in->d,
      out->d * in->b + out->e * in->e,          out->d * in->c + out->e * in->f + out->f};
}

// Returns a piece where the map puts it, as a piece with the same part of a circle.
static SbCadPiece placed(const Affine *way, const SbCadPiece *piece) {
  double from[2], to[2];
  map(way, piece->x0, piece->y0, from);
  map(way, piece->x1, piece->y1, to);
  const bool turned = way->a * way->e - way->b * way->d < 0;
  return (SbCadPiece){from[0], from[1], to[0], to[1], turned ? -piece->bulge : piece->bulge};
}

// A part of an ellipse, from the angle `start` over `sweep`.
typedef struct {
  const Affine *way;
  double centre[2], major[2], minor[2], start, sweep;
} Ellipse;

static void ellipse_at(const void *curve, double t, double xy[2]) {
  const Ellipse *e = curve;
  const double angle = e->start + t * e->sweep, c = cos(angle), s = sin(angle);
  map(e->way, e->centre[0] + c * e->major[0] + s * e->minor[0],
      e->centre[1] + c * e->major[1] + s * e->minor[1], xy);
}

// Adds a straight line or an arc; an arc is one if the map preserves circles, else is followed.
static bool add_bulge(GArray *out, const Affine *way, const SbCadPiece *piece) {
  const double u = hypot(way->a, way->d), v = hypot(way->b, way->e);
  const bool even =
      fabs(u - v) <= 1e-9 * (u + v) && fabs(way->a * way->b + way->d * way->e) <= 1e-9 * u * v;
  if (piece->bulge != 0 && !even) {
    const SbArc arc = sb_cad_circle(piece);
    const Ellipse circle = {
        way,      {arc.centre[0], arc.centre[1]}, {arc.radius, 0}, {0, arc.radius}, arc.start,
        arc.sweep};
    return sb_cad_curve(out, ellipse_at, &circle, 2);
  }
  const SbCadPiece there = placed(way, piece);
  g_array_append_val(out, there);
  return true;
}

// The minor axis is the extrusion direction times the major axis.
static bool add_ellipse(GArray *out, const Affine *way, const Entity *entity) {
  const double *n = entity->number, up = n[230] < 0 ? -n[40] : n[40];
  const double end = n[42] > n[41] ? n[42] : n[42] + 2 * M_PI;
  const Ellipse ellipse = {way,   {n[10], n[20]}, {n[11], n[21]}, {-up * n[21], up * n[11]},
                           n[41], end - n[41]};
  return n[40] > 0 && ellipse.sweep <= 2 * M_PI + 1e-6 &&
         sb_cad_curve(out, ellipse_at, &ellipse, 4);
}

// An arc in two halves. A circle has no angles; those that a file states for it are ignored.
static bool add_arc(GArray *out, const Affine *way, const Entity *entity) {
  const bool circle = is_type(entity, "CIRCLE");
  const double *n = entity->number, start = circle ? 0 : n[50] * M_PI / 180;
  const double degrees = circle ? 0 : fmod(n[51] - n[50], 360);
  const double turn = (degrees > 0 ? degrees : degrees + 360) * M_PI / 180;
  bool good = n[40] > 0;
  for (int i = 0; good && i < 2; i++) {
    const double a = start + i * turn / 2, b = a + turn / 2;
    const SbCadPiece half = {n[10] + n[40] * cos(a), n[20] + n[40] * sin(a), n[10] + n[40] * cos(b),
                             n[20] + n[40] * sin(b), tan(turn / 8)};
    good = add_bulge(out, way, &half);
  }
  return good;
}

typedef struct {
  const Affine *way;
  const Entity *entity;
  int degree, span; // from knot `span` to the next
} Spline;

// De Boor's algorithm in homogeneous coordinates.
static void spline_at(const void *curve, double t, double xy[2]) {
  const Spline *s = curve;
  GArray *const *list = s->entity->list;
  const bool weighted = list[WEIGHT]->len == list[X]->len;
  const double *knot = (const double *)(void *)list[KNOT]->data;
  const int p = s->degree, k = s->span;
  const double u = (1 - t) * knot[k] + t * knot[k + 1];
  double d[DEGREE_MAX + 1][3];
  for (int j = 0; j <= p; j++) {
    const guint i = (guint)(k - p + j);
    d[j][2] = weighted ? at(list[WEIGHT], i) : 1;
    d[j][0] = d[j][2] * at(list[X], i);
    d[j][1] = d[j][2] * at(list[Y], i);
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
static bool add_spline(GArray *out, const Affine *way, const Entity *entity) {
  GArray *const *list = entity->list;
  const int degree = (int)entity->number[71], count = (int)list[X]->len;
  bool good = degree >= 1 && degree <= DEGREE_MAX && count > degree && count <= CONTROL_MAX &&
              (int)list[Y]->len == count && (int)list[KNOT]->len == count + degree + 1;
  for (guint i = 1; good && i < list[KNOT]->len; i++) {
    good = at(list[KNOT], i) >= at(list[KNOT], i - 1);
  }
  for (int k = degree; good && k < count; k++) {
    const Spline spline = {way, entity, degree, k};
    good = at(list[KNOT], (guint)k + 1) == at(list[KNOT], (guint)k) ||
           sb_cad_curve(out, spline_at, &spline, 1);
  }
  return good;
}

static bool add_points(GArray *out, const Affine *way, const Entity *entity) {
  enum { CLOSED = 1, MESHES = 16 | 64 };
  const int flags = (int)entity->number[70];
  const guint count = entity->list[X]->len;
  bool good = entity->list[Y]->len == count && count > 1 &&
              (is_type(entity, "LWPOLYLINE") || (flags & MESHES) == 0);
  for (guint i = 0; good && i + !(flags & CLOSED) < count; i++) {
    const guint next = (i + 1) % count;
    const SbCadPiece piece = {at(entity->list[X], i), at(entity->list[Y], i),
                              at(entity->list[X], next), at(entity->list[Y], next),
                              at(entity->list[BULGE], i)};
    good = (piece.x0 == piece.x1 && piece.y0 == piece.y1) || add_bulge(out, way, &piece);
  }
  return good;
}

// Adds the pieces of an entity. False where it is none that we read.
static bool add_entity(GArray *out, const Affine *way, const Entity *entity) {
  const double *n = entity->number;
  bool good = false;
  if (is_type(entity, "LINE")) {
    good = add_bulge(out, way, &(SbCadPiece){n[10], n[20], n[11], n[21], 0});
  } else if (is_type(entity, "CIRCLE") || is_type(entity, "ARC")) {
    good = add_arc(out, way, entity);
  } else if (is_type(entity, "ELLIPSE")) {
    good = add_ellipse(out, way, entity);
  } else if (is_type(entity, "SPLINE")) {
    good = add_spline(out, way, entity);
  } else if (is_type(entity, "LWPOLYLINE") || is_type(entity, "POLYLINE")) {
    good = add_points(out, way, entity);
  }
  for (guint i = 0; good && i < out->len; i++) {
    const SbCadPiece *p = &g_array_index(out, SbCadPiece, i);
    good = fmax(fmax(fabs(p->x0), fabs(p->y0)), fmax(fabs(p->x1), fabs(p->y1))) < FARTHEST;
  }
  return good;
}

// ---- Placing ----

static bool is_centre_line(const Entity *entity) {
  return is_type(entity, "LINE") && (g_ascii_strncasecmp(entity->line_type, "center", 6) == 0 ||
                                     g_ascii_strncasecmp(entity->layer, "axis", 4) == 0 ||
                                     g_ascii_strncasecmp(entity->layer, "cent", 4) == 0);
}

// Returns the value of a name in any case.
static gpointer find(GHashTable *table, const char *name) {
  g_autofree char *key = g_ascii_strdown(name, -1);
  return g_hash_table_lookup(table, key);
}

// Counts an entity that was not read, with the reason ("" or " in paper space").
static void count_left_out(Drawing *drawing, const char *type, const char *reason) {
  g_autofree char *key = g_strconcat(type, reason, NULL);
  const bool more = !g_hash_table_contains(drawing->left_out, key) &&
                    g_hash_table_size(drawing->left_out) >= LEFT_OUT_MAX;
  char *counted = g_strdup(more ? "other entities" : key);
  const guint count = GPOINTER_TO_UINT(g_hash_table_lookup(drawing->left_out, counted));
  g_hash_table_insert(drawing->left_out, counted, GUINT_TO_POINTER(count + 1));
}

static bool add_pieces(Drawing *drawing, const char *name, bool centre, const GArray *pieces,
                       GError **error) {
  guint layer = 0;
  while (layer < drawing->names->len &&
         g_ascii_strcasecmp(drawing->names->pdata[layer], name) != 0) {
    layer++;
  }
  if (!centre && layer == drawing->names->len) {
    g_ptr_array_add(drawing->names, g_strdup(name));
    g_ptr_array_add(drawing->layers, g_array_new(FALSE, FALSE, sizeof(SbCadPiece)));
  }
  g_array_append_vals(centre ? drawing->centre : drawing->layers->pdata[layer], pieces->data,
                      pieces->len);
  drawing->pieces += pieces->len;
  return (drawing->pieces <= PIECES_MAX && drawing->names->len <= LAYERS_MAX) ||
         sb_app_error_input(error,
                            "more than %d pieces or %d layers: export the seal's parts alone",
                            PIECES_MAX, LAYERS_MAX);
}

// Returns why an entity on `layer` is not seen or is not in the plane; NULL: it is drawn.
static char *why_not(const Drawing *drawing, const Entity *entity, const char *layer) {
  const double *n = entity->number;
  const char *hidden = find(drawing->hidden, layer);
  const bool insert = is_type(entity, "INSERT");
  if (n[67] == 1 || n[60] == 1) {
    return g_strdup(n[67] == 1 ? " in paper space" : " that is invisible");
  }
  // On a layer that is off, an insert still shows what its block has on other layers.
  if (hidden != NULL && (!insert || strcmp(hidden, "frozen") == 0)) {
    return g_strdup_printf(" on layer '%s', which is %s", layer, hidden);
  }
  const double rise = is_type(entity, "ELLIPSE") ? fabs(n[31]) : entity->high - entity->low;
  const bool tilted = hypot(n[210], n[220]) > 1e-6 * fabs(n[230]);
  const bool turns = !is_type(entity, "LINE") && !is_type(entity, "SPLINE");
  const bool fit = is_type(entity, "SPLINE") && entity->list[X]->len == 0;
  return (tilted && turns) || rise * drawing->scale > GAP ? g_strdup(" out of the drawing's plane")
         : fit                                            ? g_strdup(" with fit points only")
                                                          : NULL;
}

static bool place_block(Drawing *drawing, const Block *block, const Affine *way, const char *layer,
                        int depth, GError **error);

// Places the rows and columns of an INSERT. What is not given is 1 (41, 42, 70, 71).
static bool place_insert(Drawing *drawing, const Entity *entity, const Affine *way,
                         const char *layer, int depth, GError **error) {
  const double *n = entity->number, turn = n[50] * M_PI / 180, c = cos(turn), s = sin(turn);
  const double sx = entity->list[WEIGHT]->len > 0 ? n[41] : 1;
  const double sy = entity->list[BULGE]->len > 0 ? n[42] : 1;
  const Block *block = find(drawing->blocks, entity->name);
  if (block == NULL || sx == 0 || sy == 0) {
    count_left_out(drawing, "INSERT", "");
    return true;
  }
  if (depth >= DEPTH_MAX) {
    return sb_app_error_input(
        error, "its blocks are nested more than %d deep, or contain themselves", DEPTH_MAX);
  }
  bool good = true;
  const int columns = MAX((int)n[70], 1), count = MAX((int)n[71], 1) * columns;
  for (int i = 0; good && i < count; i++) {
    const double x = n[44] * (i % columns) - sx * block->base[0];
    const double y = n[45] * (i / columns) - sy * block->base[1];
    const Affine own = {c * sx, -s * sy, c * x - s * y + n[10],
                        s * sx, c * sy,  s * x + c * y + n[20]};
    const Affine whole = after(way, &own);
    good = place_block(drawing, block, &whole, layer, depth + 1, error);
  }
  return good;
}

static bool place_entity(Drawing *drawing, const Entity *entity, const Affine *outer,
                         const char *layer, int depth, GError **error) {
  enum { SPACE = 8 }; // a 3D polyline
  const bool world = is_type(entity, "LINE") || is_type(entity, "SPLINE") ||
                     is_type(entity, "ELLIPSE") ||
                     (is_type(entity, "POLYLINE") && ((int)entity->number[70] & SPACE) != 0);
  const Affine back = {-1, 0, 0, 0, 1, 0};
  const Affine way = world || entity->number[230] >= 0 ? *outer : after(outer, &back);
  // Layer 0 of a block is the layer of its insert.
  const char *on = depth > 0 && strcmp(entity->layer, "0") == 0 ? layer : entity->layer;
  g_autofree char *reason = why_not(drawing, entity, on);
  if (reason == NULL && is_type(entity, "INSERT")) {
    return place_insert(drawing, entity, &way, on, depth, error);
  }
  g_autoptr(GArray) pieces = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  if (reason != NULL || !add_entity(pieces, &way, entity)) {
    count_left_out(drawing, entity->type, reason != NULL ? reason : "");
    return true;
  }
  return add_pieces(drawing, on, is_centre_line(entity), pieces, error);
}

// Places all entities of a block; `layer` of its INSERT.
static bool place_block(Drawing *drawing, const Block *block, const Affine *way, const char *layer,
                        int depth, GError **error) {
  Entity entity = {.type = ""};
  bool good = true;
  drawing->placed++; // an empty block as well
  for (guint i = 0; good && i < block->items->len; i++) {
    Reader reader = drawing->text;
    reader.next = g_array_index(block->items, Item, i);
    good = read_entity(&entity, &reader, error);
    drawing->placed += depth > 0;
    if (good && drawing->placed > PLACED_MAX) {
      good = sb_app_error_input(
          error, "its blocks place more than %d entities: export the seal's parts alone",
          PLACED_MAX);
    }
    good = good && place_entity(drawing, &entity, way, layer, depth, error);
  }
  entity_clear(&entity);
  return good;
}

// ---- The file ----

static void block_free(gpointer data) {
  Block *block = data;
  g_array_unref(block->items);
  g_free(block);
}

static Block *block_new(void) {
  Block *block = g_new0(Block, 1);
  block->items = g_array_new(FALSE, FALSE, sizeof(Item));
  return block;
}

// Names of $INSUNITS for udunits-2, from 1. The inch of the US survey (22), which udunits-2 does
// not know, is longer than the inch by 2e-6.
#define UNITS                                                                                      \
  "inch|foot|mile|mm|cm|m|km|uin|mil|yard|angstrom|nm|um|dm|dam|hm|Gm|astronomical_unit|"          \
  "light_year|parsec|US_survey_foot|inch|US_survey_yard|US_survey_mile"

// Reads a record of a section at `item`: a layer, the begin or end of a block, an entity.
static bool read_record(Drawing *drawing, const char *section, const char *type, const Item *item,
                        Block **open, GError **error) {
  const bool blocks = strcmp(section, "BLOCKS") == 0;
  const bool layer = strcmp(section, "TABLES") == 0 && strcmp(type, "LAYER") == 0;
  Entity entity = {.type = ""};
  bool good = true;
  if (layer || (blocks && strcmp(type, "BLOCK") == 0)) {
    Reader reader = drawing->text;
    reader.next = *item;
    good = read_entity(&entity, &reader, error);
    char *key = g_ascii_strdown(entity.name, -1);
    if (layer) {
      const bool frozen = ((int)entity.number[70] & 1) != 0;
      const char *state = frozen ? "frozen" : entity.number[62] < 0 ? "off" : NULL;
      g_hash_table_replace(drawing->hidden, key, (char *)state);
    } else {
      *open = block_new();
      (*open)->base[0] = entity.number[10];
      (*open)->base[1] = entity.number[20];
      g_hash_table_replace(drawing->blocks, key, *open);
    }
  } else if (blocks && strcmp(type, "ENDBLK") == 0) {
    *open = NULL;
  } else if (*open != NULL && strcmp(type, "VERTEX") != 0 && strcmp(type, "SEQEND") != 0) {
    g_array_append_vals((*open)->items, item, 1);
  }
  entity_clear(&entity);
  return good && (drawing->items++ <= ENTITIES_MAX ||
                  sb_app_error_input(error, "more than %d entities: export the seal's parts alone",
                                     ENTITIES_MAX));
}

// Finds the blocks, layers and entities, and the unit unless the caller chose one.
static bool read_file(Drawing *drawing, GError **error) {
  Reader reader = drawing->text;
  char section[32] = "", variable[32] = "";
  Block *open = NULL; // that entities are added to
  bool named = false, sections = false, good = true;
  while (good) {
    const Item item = reader.next;
    if (!read_pair(&reader, error)) {
      break;
    }
    const char *value = reader.value;
    if (reader.code == 0) {
      named = strcmp(value, "SECTION") == 0;
      sections = sections || named;
      if (named || strcmp(value, "ENDSEC") == 0) {
        section[0] = '\0';
        open = NULL;
      } else if (section[0] != '\0') {
        good = read_record(drawing, section, value, &item, &open, error);
      }
    } else if (named && reader.code == 2) {
      g_strlcpy(section, value, sizeof section);
      open = strcmp(section, "ENTITIES") == 0 ? drawing->model : NULL;
      named = false;
    } else if (strcmp(section, "HEADER") == 0 && reader.code == 9) {
      g_strlcpy(variable, value, sizeof variable);
    } else if (strcmp(variable, "$INSUNITS") == 0 && reader.code == 70) {
      double number = 0;
      good = value_number(&reader, &number, error);
      g_auto(GStrv) units = g_strsplit(UNITS, "|", -1);
      if (good && drawing->unit == NULL && number >= 1 && number <= g_strv_length(units)) {
        drawing->unit = g_strdup(units[(int)number - 1]);
      }
      variable[0] = '\0';
    }
  }
  return *error == NULL &&
         (sections ||
          sb_app_error_input(error,
                             "is neither a STEP file (ISO 10303-21) nor a DXF: it has no section"));
}

// Returns a y that all pieces are above [m]. No arc goes further from its chord than that is long
// times the bulge.
static double below(const Drawing *drawing) {
  const double away = 1e-3;
  double low = INFINITY;
  for (guint k = 0; k < drawing->layers->len; k++) {
    const GArray *pieces = drawing->layers->pdata[k];
    for (guint i = 0; i < pieces->len; i++) {
      const SbCadPiece *p = &g_array_index(pieces, SbCadPiece, i);
      low = fmin(low, fmin(p->y0, p->y1) - fabs(p->bulge) * hypot(p->x1 - p->x0, p->y1 - p->y0));
    }
  }
  return low - away;
}

// Finds the axis of the bodies and returns the map that makes it the line y = 0.
static Affine find_axis(SbCad *cad, const Drawing *drawing, const SbCadChoices *choices) {
  double longest = 0, direction[3] = {1, 0, 0}, through[3] = {0};
  const bool found = choices->axis == NULL && choices->through == NULL && !choices->section;
  for (guint i = 0; found && i < drawing->centre->len; i++) {
    const SbCadPiece *line = &g_array_index(drawing->centre, SbCadPiece, i);
    const double dx = line->x1 - line->x0, dy = line->y1 - line->y0, length = hypot(dx, dy);
    if (length > longest) {
      longest = length;
      const double c = dx / length, s = dy / length;
      const double sign = c < -1e-9 || (fabs(c) <= 1e-9 && s < 0) ? -1 : 1;
      memcpy(direction, (double[]){sign * c, sign * s, 0}, sizeof direction);
      memcpy(through, (double[]){line->x0, line->y0, 0}, sizeof through);
    }
  }
  through[1] = choices->section ? below(drawing) : through[1];
  const double *at = choices->section || choices->through == NULL ? through : choices->through;
  const double *along = choices->section || choices->axis == NULL ? direction : choices->axis;
  // The point of the line that is nearest to the drawing's origin is x = 0.
  const double length = hypot(along[0], along[1]), c = along[0] / length, s = along[1] / length;
  const double foot = at[0] * c + at[1] * s;
  const double point[3] = {at[0] - foot * c, at[1] - foot * s, 0};
  g_autofree char *text = sb_cad_axis_text(point, along);
  cad->axis = g_strconcat(text, longest > 0 ? " (the longest centre line)" : "", NULL);
  return (Affine){c, s, 0, -s, c, point[0] * s - point[1] * c};
}

static void left_out(SbCad *cad, const Drawing *drawing) {
  GHashTableIter each;
  gpointer type, count;
  g_autoptr(GPtrArray) texts = g_ptr_array_new_with_free_func(g_free);
  g_hash_table_iter_init(&each, drawing->left_out);
  while (g_hash_table_iter_next(&each, &type, &count)) {
    g_autofree char *shown = sb_printable(type, strlen(type));
    g_ptr_array_add(texts, g_strdup_printf("%u %s", GPOINTER_TO_UINT(count), shown));
  }
  if (texts->len > 0) {
    g_ptr_array_sort(texts, sb_note_compare);
    g_ptr_array_add(texts, NULL);
    g_autofree char *all = g_strjoinv(", ", (char **)texts->pdata);
    sb_note_add(cad->warnings, "left out: %s", all);
  }
}

static void make_bodies(SbCad *cad, const Drawing *drawing, const SbCadChoices *choices) {
  const Affine axis = find_axis(cad, drawing, choices);
  for (guint k = 0; k < drawing->names->len; k++) {
    const char *name = drawing->names->pdata[k];
    GArray *pieces = drawing->layers->pdata[k];
    for (guint i = 0; i < pieces->len; i++) {
      SbCadPiece *piece = &g_array_index(pieces, SbCadPiece, i);
      *piece = placed(&axis, piece);
    }
    g_autofree char *shown = sb_printable(name, strlen(name));
    sb_cad_outlines(cad, pieces, shown, choices->join > 0 ? choices->join : GAP);
  }
  sb_cad_settle(cad, choices);
  left_out(cad, drawing);
}

// Places model space and makes its bodies; NULL with an error.
static SbCad *of_drawing(Drawing *drawing, const SbCadChoices *choices, GError **error) {
  if (!read_file(drawing, error) ||
      (drawing->unit == NULL &&
       !sb_app_error_input(error, "states no unit ($INSUNITS)%s",
                           choices->section ? "" : ": specify it with --unit")) ||
      !sb_unit_scale(&drawing->scale, drawing->unit, "m", "mm", error)) {
    return NULL;
  }
  const Affine way = {drawing->scale, 0, 0, 0, drawing->scale, 0};
  if (!place_block(drawing, drawing->model, &way, "0", 0, error)) {
    return NULL;
  }
  SbCad *cad = sb_cad_new("DXF");
  cad->unit = g_strdup(drawing->unit);
  make_bodies(cad, drawing, choices);
  if (cad->bodies->len == 0) {
    g_ptr_array_add(cad->warnings, NULL);
    g_autofree char *why = g_strjoinv("; ", (char **)cad->warnings->pdata);
    sb_app_error_input(error, "contains no closed outline%s%s", *why != '\0' ? "; " : "", why);
    g_clear_pointer(&cad, sb_cad_free);
  }
  return cad;
}

SbCad *sb_cad_parse_dxf(const char *text, gsize length, const char *name,
                        const SbCadChoices *choices, GError **error) {
  static const char mark[] = "\xEF\xBB\xBF"; // of UTF-8
  const gsize skipped = length >= 3 && memcmp(text, mark, 3) == 0 ? 3 : 0;
  Drawing drawing = {
      .text = {.next.at = text + skipped,
               .end = text + length,
               .separator = memchr(text, '\n', length) != NULL ? '\n' : '\r'},
      .model = block_new(),
      .blocks = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, block_free),
      .hidden = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL),
      .left_out = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL),
      .names = g_ptr_array_new_with_free_func(g_free),
      .layers = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref),
      .centre = g_array_new(FALSE, FALSE, sizeof(SbCadPiece)),
      .unit = g_strdup(choices->unit),
  };
  GError *problem = NULL;
  SbCad *cad = NULL;
  if (length >= 22 && memcmp(text, "AutoCAD Binary DXF", 18) == 0) {
    sb_app_error_input(&problem, "is a binary DXF: save it as text (ASCII)");
  } else if (choices->axis != NULL && choices->axis[2] != 0) {
    sb_app_error_input(&problem, "a DXF has the axes x and y, not z");
  } else {
    cad = of_drawing(&drawing, choices, &problem);
  }
  if (problem != NULL) {
    sb_app_error_prefix(&problem, name);
    g_propagate_error(error, problem);
  }
  block_free(drawing.model);
  g_hash_table_unref(drawing.blocks);
  g_hash_table_unref(drawing.hidden);
  g_hash_table_unref(drawing.left_out);
  g_ptr_array_unref(drawing.names);
  g_ptr_array_unref(drawing.layers);
  g_array_unref(drawing.centre);
  g_free(drawing.unit);
  return cad;
}

// Outlines from DXF text: LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE, POLYLINE and SPLINE of the
// section ENTITIES and of blocks that it inserts, by layers. A pair of lines is a group code and
// its value.
#include "app/base/error.h"
#include "app/base/number.h"
#include "app/base/unit.h"
#include "app/cad/dxf_blocks.h"

#include <math.h>
#include <string.h>

// Control points and knots of a spline, its degree, and pieces of a file.
enum { CONTROL_MAX = 2000, DEGREE_MAX = 15, PIECES_MAX = 100000, LAYERS_MAX = 200 };

// Ends are one point within this [m]; drawings round to a thousandth of their unit at worst.
static const double GAP = 1e-6;

typedef struct {
  const char *at, *end; // what is left of the text
  int line;
  int code;
  char value[512]; // trimmed, cut
} Reader;

// The entity that is being read: its values by group code; repeated ones in lists.
typedef struct {
  char type[32], layer[256], line_type[64], name[256];
  double number[256];
  GArray *x, *y, *bulge, *knot, *weight; // of double
  bool mirrored;                         // drawn on the plane's back: extrusion towards -z
} Entity;

typedef struct {
  GHashTable *layers;   // name -> GArray of SbCadPiece
  GPtrArray *names;     // of the layers, in order of appearance
  GHashTable *left_out; // type -> count
  GArray *centre;       // of SbCadPiece: centre lines
  guint pieces;
  SbDxfBlocks *blocks;
  double tolerance; // of curves, in the drawing's unit
  bool in_polyline; // between POLYLINE and SEQEND
  Entity polyline;
} Drawing;

// ---- Pairs ----

static bool read_line(Reader *reader, const char **text, size_t *length) {
  if (reader->at >= reader->end) {
    return false;
  }
  const char *stop = memchr(reader->at, '\n', (size_t)(reader->end - reader->at));
  const char *next = stop != NULL ? stop + 1 : reader->end;
  stop = stop != NULL ? stop : reader->end;
  *text = reader->at;
  while (stop > *text && (stop[-1] == '\r' || stop[-1] == ' ' || stop[-1] == '\t')) {
    stop--;
  }
  while (*text < stop && (**text == ' ' || **text == '\t')) {
    (*text)++;
  }
  *length = (size_t)(stop - *text);
  reader->at = next;
  reader->line++;
  return true;
}

// A part of the file, which no NUL ends, as a string, cut to fit.
static void copy(char *to, size_t size, const char *text, size_t length) {
  length = MIN(length, size - 1);
  memcpy(to, text, length);
  to[length] = '\0';
}

// The next pair. False at the end; a code that is no number sets an error.
static bool read_pair(Reader *reader, GError **error) {
  const char *text;
  size_t length;
  if (!read_line(reader, &text, &length)) {
    return false;
  }
  char digits[16];
  double code;
  copy(digits, sizeof digits, text, length);
  if (length >= sizeof digits || !sb_number_parse(&code, digits) || code != floor(code) ||
      fabs(code) > 9999) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "line %d is not a group code of a DXF",
                reader->line);
    return false;
  }
  reader->code = (int)code;
  if (!read_line(reader, &text, &length)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "the file ends after line %d",
                reader->line);
    return false;
  }
  copy(reader->value, sizeof reader->value, text, length);
  return true;
}

// Codes 70 to 79 are 16-bit integers.
static bool value_number(const Reader *reader, double *out, GError **error) {
  const double most = reader->code >= 70 && reader->code < 80 ? 32768 : 1e12;
  if (sb_number_parse(out, reader->value) && fabs(*out) < most) {
    return true;
  }
  sb_app_error_input(error, "line %d: '%s' is not a number here", reader->line, reader->value);
  return false;
}

// ---- Entities ----

static void entity_init(Entity *entity) {
  memset(entity, 0, sizeof *entity);
  GArray **const lists[] = {&entity->x, &entity->y, &entity->bulge, &entity->knot, &entity->weight};
  for (size_t i = 0; i < G_N_ELEMENTS(lists); i++) {
    *lists[i] = g_array_new(FALSE, FALSE, sizeof(double));
  }
}

static void entity_clear(Entity *entity) {
  GArray *const lists[] = {entity->x, entity->y, entity->bulge, entity->knot, entity->weight};
  for (size_t i = 0; i < G_N_ELEMENTS(lists); i++) {
    g_array_unref(lists[i]);
  }
}

static void entity_begin(Entity *entity, const char *type) {
  GArray *const lists[] = {entity->x, entity->y, entity->bulge, entity->knot, entity->weight};
  for (size_t i = 0; i < G_N_ELEMENTS(lists); i++) {
    g_array_set_size(lists[i], 0);
  }
  memset(entity->number, 0, sizeof entity->number);
  entity->mirrored = false;
  g_strlcpy(entity->type, type, sizeof entity->type);
  g_strlcpy(entity->layer, "0", sizeof entity->layer);
  entity->line_type[0] = entity->name[0] = '\0';
}

// Takes a pair of an entity.
static bool entity_take(Entity *entity, const Reader *reader, GError **error) {
  const int code = reader->code;
  if (code == 8) {
    g_strlcpy(entity->layer, reader->value, sizeof entity->layer);
    return true;
  }
  if (code == 2) {
    g_strlcpy(entity->name, reader->value, sizeof entity->name);
    return true;
  }
  if (code == 6) {
    g_strlcpy(entity->line_type, reader->value, sizeof entity->line_type);
    return true;
  }
  const bool number = (code >= 10 && code < 60) || (code >= 70 && code < 80) || code == 230;
  if (!number) {
    return true;
  }
  double value;
  if (!value_number(reader, &value, error)) {
    return false;
  }
  entity->mirrored = entity->mirrored || (code == 230 && value < 0);
  entity->number[code] = value;
  GArray *list = code == 10   ? entity->x
                 : code == 20 ? entity->y
                 : code == 40 ? entity->knot
                 : code == 41 ? entity->weight
                 : code == 42 ? entity->bulge
                              : NULL;
  if (list != NULL) {
    // A bulge belongs to the point before it.
    while (code == 42 && list->len + 1 < entity->x->len) {
      const double straight = 0;
      g_array_append_val(list, straight);
    }
    if (list->len >= PIECES_MAX) {
      g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "line %d: more than %d points",
                  reader->line, PIECES_MAX);
      return false;
    }
    g_array_append_val(list, value);
  }
  return true;
}

static double at(const GArray *list, guint i) {
  return i < list->len ? g_array_index(list, double, i) : 0;
}

// ---- Curves ----

typedef struct {
  double centre[2], major[2], ratio, start, end;
} Ellipse;

static void ellipse_at(const void *curve, double t, double xy[2]) {
  const Ellipse *e = curve;
  const double angle = e->start + t * (e->end - e->start);
  const double c = cos(angle), s = e->ratio * sin(angle);
  xy[0] = e->centre[0] + c * e->major[0] - s * e->major[1];
  xy[1] = e->centre[1] + c * e->major[1] + s * e->major[0];
}

typedef struct {
  const double *x, *y, *weight, *knot; // weight: NULL, all 1
  int count, degree;
} Spline;

// De Boor's algorithm in homogeneous coordinates.
static void spline_at(const void *curve, double t, double xy[2]) {
  const Spline *s = curve;
  const int p = s->degree;
  const double u = s->knot[p] + t * (s->knot[s->count] - s->knot[p]);
  int k = p;
  while (k + 1 < s->count && s->knot[k + 1] <= u) {
    k++;
  }
  double d[DEGREE_MAX + 1][3];
  for (int j = 0; j <= p; j++) {
    const int i = k - p + j;
    const double w = s->weight != NULL ? s->weight[i] : 1;
    d[j][0] = w * s->x[i];
    d[j][1] = w * s->y[i];
    d[j][2] = w;
  }
  for (int r = 1; r <= p; r++) {
    for (int j = p; j >= r; j--) {
      const double low = s->knot[j + k - p], high = s->knot[j + 1 + k - r];
      const double a = high > low ? (u - low) / (high - low) : 0;
      for (int c = 0; c < 3; c++) {
        d[j][c] = (1 - a) * d[j - 1][c] + a * d[j][c];
      }
    }
  }
  xy[0] = d[p][0] / d[p][2];
  xy[1] = d[p][1] / d[p][2];
}

static bool add_spline(GArray *pieces, const Entity *entity, double tolerance) {
  const int degree = (int)entity->number[71], count = (int)entity->x->len;
  const int knots = (int)entity->knot->len;
  if (degree < 1 || degree > DEGREE_MAX || count <= degree || count > CONTROL_MAX ||
      (int)entity->y->len != count || knots != count + degree + 1) {
    return false;
  }
  for (int i = 1; i < knots; i++) {
    if (at(entity->knot, (guint)i) < at(entity->knot, (guint)i - 1)) {
      return false;
    }
  }
  const Spline spline = {
      (const double *)(void *)entity->x->data,
      (const double *)(void *)entity->y->data,
      (int)entity->weight->len == count ? (const double *)(void *)entity->weight->data : NULL,
      (const double *)(void *)entity->knot->data,
      count,
      degree};
  return sb_cad_curve(pieces, spline_at, &spline, count - degree, tolerance);
}

static bool add_points(GArray *pieces, const Entity *entity, bool closed) {
  const guint count = entity->x->len;
  for (guint i = 0; i + !closed < count; i++) {
    const guint next = (i + 1) % count;
    const SbCadPiece piece = {at(entity->x, i), at(entity->y, i), at(entity->x, next),
                              at(entity->y, next), at(entity->bulge, i)};
    if (piece.x0 != piece.x1 || piece.y0 != piece.y1) {
      g_array_append_val(pieces, piece);
    }
  }
  return entity->y->len == count && count > 1;
}

static bool add_arc(GArray *pieces, const Entity *entity, double start, double turn,
                    double tolerance) {
  const double *n = entity->number;
  const Ellipse circle = {{n[10], n[20]}, {n[40], 0}, 1, start, start + turn};
  return n[40] > 0 && sb_cad_curve(pieces, ellipse_at, &circle, turn > M_PI ? 2 : 1, tolerance);
}

// The pieces of one entity in the drawing's unit. False where it is none that we read.
static bool add_entity(GArray *pieces, const Entity *entity, double tolerance) {
  const double *n = entity->number;
  const char *type = entity->type;
  if (strcmp(type, "LINE") == 0) {
    const SbCadPiece piece = {n[10], n[20], n[11], n[21], 0};
    g_array_append_val(pieces, piece);
    return true;
  }
  if (strcmp(type, "CIRCLE") == 0) {
    return add_arc(pieces, entity, 0, 2 * M_PI, tolerance);
  }
  if (strcmp(type, "ARC") == 0) {
    const double turn = fmod(n[51] - n[50], 360);
    return add_arc(pieces, entity, n[50] * M_PI / 180, (turn > 0 ? turn : turn + 360) * M_PI / 180,
                   tolerance);
  }
  if (strcmp(type, "ELLIPSE") == 0) {
    const double end = n[42] > n[41] ? n[42] : n[42] + 2 * M_PI;
    const Ellipse ellipse = {{n[10], n[20]}, {n[11], n[21]}, n[40], n[41], end};
    return n[40] > 0 && end - n[41] <= 2 * M_PI + 1e-6 &&
           sb_cad_curve(pieces, ellipse_at, &ellipse, 4, tolerance);
  }
  if (strcmp(type, "SPLINE") == 0) {
    return add_spline(pieces, entity, tolerance);
  }
  if (strcmp(type, "LWPOLYLINE") == 0 || strcmp(type, "POLYLINE") == 0) {
    return add_points(pieces, entity, ((int)n[70] & 1) != 0);
  }
  return false;
}

// ---- The drawing ----

static bool is_centre_line(const Entity *entity) {
  g_autofree char *layer = g_ascii_strdown(entity->layer, -1);
  g_autofree char *type = g_ascii_strdown(entity->line_type, -1);
  return strcmp(entity->type, "LINE") == 0 &&
         (g_str_has_prefix(type, "center") || g_str_has_prefix(layer, "axis") ||
          g_str_has_prefix(layer, "cent"));
}

static void count_left_out(void *data, const char *type) {
  const Drawing *drawing = data;
  const guint count = GPOINTER_TO_UINT(g_hash_table_lookup(drawing->left_out, type));
  if (count > 0 || g_hash_table_size(drawing->left_out) < 20) {
    g_hash_table_insert(drawing->left_out, g_strdup(type), GUINT_TO_POINTER(count + 1));
  }
}

static bool add_pieces(void *data, const char *name, bool centre, const GArray *pieces,
                       GError **error) {
  Drawing *drawing = data;
  drawing->pieces += pieces->len;
  if (centre) {
    g_array_append_vals(drawing->centre, pieces->data, pieces->len);
  } else {
    GArray *layer = g_hash_table_lookup(drawing->layers, name);
    if (layer == NULL) {
      layer = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
      g_hash_table_insert(drawing->layers, g_strdup(name), layer);
      g_ptr_array_add(drawing->names, g_strdup(name));
    }
    g_array_append_vals(layer, pieces->data, pieces->len);
  }
  if (drawing->pieces > PIECES_MAX || drawing->names->len > LAYERS_MAX) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "more than %d pieces or %d layers: export the seal's parts alone", PIECES_MAX,
                LAYERS_MAX);
    return false;
  }
  return true;
}

// What is not given is 1 (41, 42, 70, 71): the lists tell whether a scale was.
static bool add_insert(Drawing *drawing, const Entity *entity, GError **error) {
  const double *n = entity->number;
  return sb_dxf_blocks_insert(drawing->blocks,
                              &(SbDxfInsert){.name = entity->name,
                                             .layer = entity->layer,
                                             .at = {n[10], n[20]},
                                             .scale = {entity->weight->len > 0 ? n[41] : 1,
                                                       entity->bulge->len > 0 ? n[42] : 1},
                                             .turn = n[50],
                                             .spacing = {n[44], n[45]},
                                             .columns = MAX((int)n[70], 1),
                                             .rows = MAX((int)n[71], 1),
                                             .mirrored = entity->mirrored},
                              error);
}

static bool drawing_add(Drawing *drawing, const Entity *entity, GError **error) {
  if (entity->type[0] == '\0') {
    return true;
  }
  const bool inside = sb_dxf_blocks_inside(drawing->blocks);
  if (strcmp(entity->type, "INSERT") == 0) {
    return add_insert(drawing, entity, error);
  }
  g_autoptr(GArray) pieces = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  // An insert may enlarge a block.
  if (!add_entity(pieces, entity, (inside ? 0.1 : 1) * drawing->tolerance)) {
    if (inside) {
      sb_dxf_blocks_left_out(drawing->blocks, entity->type);
    } else {
      count_left_out(drawing, entity->type);
    }
    return true;
  }
  for (guint i = 0; entity->mirrored && strcmp(entity->type, "LINE") != 0 && i < pieces->len; i++) {
    SbCadPiece *piece = &g_array_index(pieces, SbCadPiece, i);
    *piece = (SbCadPiece){-piece->x0, piece->y0, -piece->x1, piece->y1, -piece->bulge};
  }
  const bool centre = is_centre_line(entity);
  return inside ? sb_dxf_blocks_pieces(drawing->blocks, entity->layer, centre, pieces, error)
                : add_pieces(drawing, entity->layer, centre, pieces, error);
}

// An entity has ended. A POLYLINE takes the points of the VERTEX entities that follow it.
static bool drawing_end_entity(Drawing *drawing, const Entity *entity, GError **error) {
  Entity *polyline = &drawing->polyline;
  if (strcmp(entity->type, "BLOCK") == 0) {
    sb_dxf_blocks_begin(drawing->blocks, entity->name, entity->number[10], entity->number[20]);
    return true;
  }
  if (strcmp(entity->type, "ENDBLK") == 0) {
    sb_dxf_blocks_end(drawing->blocks);
    return true;
  }
  if (strcmp(entity->type, "POLYLINE") == 0) {
    entity_begin(polyline, "POLYLINE");
    g_strlcpy(polyline->layer, entity->layer, sizeof polyline->layer);
    polyline->number[70] = entity->number[70];
    polyline->mirrored = entity->mirrored;
    drawing->in_polyline = true;
    return true;
  }
  if (drawing->in_polyline && strcmp(entity->type, "VERTEX") == 0) {
    if (polyline->x->len < PIECES_MAX) {
      g_array_append_val(polyline->x, entity->number[10]);
      g_array_append_val(polyline->y, entity->number[20]);
      g_array_append_val(polyline->bulge, entity->number[42]);
    }
    return true;
  }
  if (drawing->in_polyline) {
    drawing->in_polyline = false;
    return drawing_add(drawing, polyline, error) &&
           (strcmp(entity->type, "SEQEND") == 0 || drawing_add(drawing, entity, error));
  }
  // Ends the attributes of an insert.
  return strcmp(entity->type, "SEQEND") == 0 || drawing_add(drawing, entity, error);
}

// Metres to the unit; 0 with an error where it is no length.
static double scale_of(const char *unit, GError **error) {
  g_autofree char *one = g_strdup_printf("1 %s", unit);
  double scale = 0;
  return sb_quantity_parse(&scale, one, "m", "mm", error) ? scale : 0;
}

// Reads all pairs. *unit, NULL where nobody chose it, becomes that of $INSUNITS (NULL: not given or
// none we know); it comes before the entities.
static bool read_drawing(Drawing *drawing, Reader *reader, const char **unit, GError **error) {
  static const struct {
    int code;
    const char *unit;
  } units[] = {{1, "inch"}, {2, "foot"}, {4, "mm"},  {5, "cm"}, {6, "m"},
               {8, "uin"},  {9, "mil"},  {13, "um"}, {0, NULL}};
  GError *problem = NULL;
  Entity entity;
  entity_init(&entity);
  char section[32] = "", variable[32] = "";
  const bool chosen = *unit != NULL;
  bool named = false, sections = false, good = true;
  while (good && read_pair(reader, &problem)) {
    const char *value = reader->value;
    if (reader->code == 0) {
      good = drawing_end_entity(drawing, &entity, &problem);
      entity_begin(&entity, "");
      named = strcmp(value, "SECTION") == 0;
      sections = sections || named;
      if (strcmp(value, "ENDSEC") == 0) {
        section[0] = '\0';
        sb_dxf_blocks_end(drawing->blocks);
      } else if (!named && (strcmp(section, "ENTITIES") == 0 || strcmp(section, "BLOCKS") == 0)) {
        entity_begin(&entity, value);
      }
    } else if (named && reader->code == 2) {
      g_strlcpy(section, value, sizeof section);
      named = false;
      const double scale = scale_of(*unit != NULL ? *unit : "mm", &problem);
      good = scale > 0;
      drawing->tolerance = SB_CAD_TOLERANCE / scale;
    } else if (entity.type[0] != '\0') {
      good = entity_take(&entity, reader, &problem);
    } else if (strcmp(section, "HEADER") == 0 && reader->code == 9) {
      g_strlcpy(variable, value, sizeof variable);
    } else if (strcmp(variable, "$INSUNITS") == 0 && reader->code == 70) {
      double number = 0;
      good = value_number(reader, &number, &problem);
      for (size_t i = 0; good && units[i].unit != NULL; i++) {
        *unit = !chosen && units[i].code == (int)number ? units[i].unit : *unit;
      }
      variable[0] = '\0';
    }
  }
  good = good && problem == NULL && drawing_end_entity(drawing, &entity, &problem);
  sb_dxf_blocks_end(drawing->blocks);
  const SbDxfSink sink = {add_pieces, count_left_out, drawing};
  good = good && sb_dxf_blocks_place(drawing->blocks, drawing->tolerance, &sink, &problem);
  entity_clear(&entity);
  if (problem == NULL && !sections) {
    g_set_error(&problem, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "is neither a STEP file (ISO 10303-21) nor a DXF: it has no section");
  }
  if (problem != NULL) {
    g_propagate_error(error, problem);
  }
  return problem == NULL && good;
}

// The line that bodies are revolved about: a point and a direction.
typedef struct {
  double x, y, c, s;
} Axis;

static Axis find_axis(SbCad *cad, const Drawing *drawing, const char *wish) {
  if (wish != NULL && strcmp(wish, "y") == 0) {
    cad->axis = g_strdup("the line x = 0");
    // Turned clockwise, so that x runs along the drawing's y.
    return (Axis){0, 0, 0, 1};
  }
  double longest = 0;
  const SbCadPiece *line = NULL;
  for (guint i = 0; wish == NULL && i < drawing->centre->len; i++) {
    const SbCadPiece *piece = &g_array_index(drawing->centre, SbCadPiece, i);
    const double length = hypot(piece->x1 - piece->x0, piece->y1 - piece->y0);
    if (length > longest) {
      longest = length;
      line = piece;
    }
  }
  if (line == NULL) {
    cad->axis = g_strdup("the line y = 0");
    return (Axis){0, 0, 1, 0};
  }
  cad->axis = g_strdup("the longest centre line");
  const double c = (line->x1 - line->x0) / longest, s = (line->y1 - line->y0) / longest;
  const double sign = c < -1e-9 || (fabs(c) <= 1e-9 && s < 0) ? -1 : 1;
  // The point of the line that is nearest to the drawing's origin is x = 0.
  const double along = line->x0 * c + line->y0 * s;
  return (Axis){line->x0 - along * c, line->y0 - along * s, sign * c, sign * s};
}

static gint by_text(gconstpointer a, gconstpointer b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
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
  g_ptr_array_sort(texts, by_text);
  g_autoptr(GString) all = g_string_new("left out: ");
  for (guint i = 0; i < texts->len; i++) {
    g_string_append_printf(all, "%s%s", i > 0 ? ", " : "", (const char *)texts->pdata[i]);
  }
  if (texts->len > 0) {
    g_ptr_array_add(cad->warnings, g_strdup(all->str));
  }
}

// Moves a drawing's pieces to one side of the line y = 0, and away from it.
static void lift(const Drawing *drawing) {
  const double away = 1; // in the drawing's unit
  double low = INFINITY;
  for (int pass = 0; pass < 2; pass++) {
    for (guint k = 0; k < drawing->names->len; k++) {
      GArray *pieces = g_hash_table_lookup(drawing->layers, drawing->names->pdata[k]);
      for (guint i = 0; i < pieces->len; i++) {
        SbCadPiece *p = &g_array_index(pieces, SbCadPiece, i);
        if (pass == 0) {
          // No arc goes further from its chord than that is long times the bulge.
          const double bow = fabs(p->bulge) * hypot(p->x1 - p->x0, p->y1 - p->y0);
          low = fmin(low, fmin(p->y0, p->y1) - bow);
        } else {
          p->y0 += away - low;
          p->y1 += away - low;
        }
      }
    }
  }
}

static void make_bodies(SbCad *cad, const Drawing *drawing, double scale,
                        const SbCadChoices *choices) {
  if (choices->section) {
    lift(drawing);
  }
  const Axis axis = find_axis(cad, drawing, choices->section ? "x" : choices->axis);
  for (guint k = 0; k < drawing->names->len; k++) {
    const char *name = drawing->names->pdata[k];
    GArray *pieces = g_hash_table_lookup(drawing->layers, name);
    for (guint i = 0; i < pieces->len; i++) {
      SbCadPiece *p = &g_array_index(pieces, SbCadPiece, i);
      const double x0 = p->x0 - axis.x, y0 = p->y0 - axis.y;
      const double x1 = p->x1 - axis.x, y1 = p->y1 - axis.y;
      *p = (SbCadPiece){scale * (x0 * axis.c + y0 * axis.s), scale * (y0 * axis.c - x0 * axis.s),
                        scale * (x1 * axis.c + y1 * axis.s), scale * (y1 * axis.c - x1 * axis.s),
                        p->bulge};
    }
    g_autofree char *shown = sb_printable(name, strlen(name));
    sb_cad_outlines(cad, pieces, shown, GAP);
  }
  for (guint i = 0; i < cad->bodies->len; i++) {
    sb_cad_body_settle(cad->bodies->pdata[i], choices);
  }
  left_out(cad, drawing);
}

SbCad *sb_cad_parse_dxf(const char *text, gsize length, const char *name,
                        const SbCadChoices *choices, GError **error) {
  Reader reader = {.at = text, .end = text + length};
  Drawing drawing = {
      .layers =
          g_hash_table_new_full(g_str_hash, g_str_equal, g_free, (GDestroyNotify)g_array_unref),
      .names = g_ptr_array_new_with_free_func(g_free),
      .left_out = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL),
      .centre = g_array_new(FALSE, FALSE, sizeof(SbCadPiece)),
      .blocks = sb_dxf_blocks_new(),
  };
  entity_init(&drawing.polyline);
  GError *problem = NULL;
  const char *unit = choices->unit;
  SbCad *cad = NULL;
  if (length >= 22 && memcmp(text, "AutoCAD Binary DXF", 18) == 0) {
    g_set_error(&problem, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "is a binary DXF: save it as text (ASCII)");
  } else if (choices->axis != NULL && strcmp(choices->axis, "z") == 0) {
    g_set_error(&problem, SB_APP_ERROR, SB_APP_ERROR_INPUT, "a DXF has the axes x and y, not z");
  } else if (read_drawing(&drawing, &reader, &unit, &problem)) {
    const double scale = unit != NULL ? scale_of(unit, &problem) : 0;
    if (unit == NULL) {
      g_set_error(&problem, SB_APP_ERROR, SB_APP_ERROR_INPUT, "states no unit ($INSUNITS)%s",
                  choices->section ? "" : ": specify it with --unit");
    } else if (scale > 0) {
      cad = sb_cad_new("DXF");
      cad->unit = g_strdup(unit);
      make_bodies(cad, &drawing, scale, choices);
      if (cad->bodies->len == 0) {
        g_set_error(&problem, SB_APP_ERROR, SB_APP_ERROR_INPUT, "contains no closed outline%s%s",
                    cad->warnings->len > 0 ? "; " : "",
                    cad->warnings->len > 0 ? (const char *)cad->warnings->pdata[0] : "");
        g_clear_pointer(&cad, sb_cad_free);
      }
    }
  }
  if (problem != NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: %s", name, problem->message);
    g_error_free(problem);
  }
  entity_clear(&drawing.polyline);
  g_hash_table_unref(drawing.layers);
  g_ptr_array_unref(drawing.names);
  g_hash_table_unref(drawing.left_out);
  g_array_unref(drawing.centre);
  sb_dxf_blocks_free(drawing.blocks);
  return cad;
}

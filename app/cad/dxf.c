// Outlines from DXF text: LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE, POLYLINE and SPLINE of model
// space and of the blocks that it inserts, by layers. A pair of lines is a group code and its
// value. The file is read twice: first for the unit, the layers and the places of blocks and
// entities in the text, then each entity where it is placed. Source: AutoCAD DXF Reference
// (Autodesk).
//
// LINE, ELLIPSE, SPLINE and 3D polylines are in world coordinates. The others are in object
// coordinates, whose x is reversed if the extrusion direction is (0, 0, -1).
#include "app/base/bytes.h"
#include "app/cad/dxf_private.h"
#include "app/cad/dxf_words.def"

// Largest numbers of pieces, entities read, entities placed, layers; nested blocks, kinds left out.
enum { DXF_PIECES_MAX = 100000, ENTITIES_MAX = 1000000, PLACED_MAX = 100000, LAYERS_MAX = 200 };
enum { DXF_DEPTH_MAX = 8, LEFT_OUT_MAX = 20 };

// Ends are one point within this, unless `join` is given; drawings round to a thousandth of their
// unit at worst. Larger gaps that may be errors of drawing; distance of an axis below all [m].
static const double GAP = 1e-6, CLOSABLE = 0.2e-3, AWAY = 1e-3;

// A block, or model space.
typedef struct {
  double base[2];
  bool elsewhere; // an external reference
  GArray *items;  // of SbDxfItem
} Block;

typedef struct {
  SbDxfReader text;       // at its start, then where an entity is read
  Block *model;           // the section ENTITIES
  GHashTable *blocks;     // name in lower case -> Block
  GHashTable *hidden;     // name of a layer in lower case -> why it is not seen
  GHashTable *line_types; // the same -> its type of lines
  GPtrArray *names;       // of the layers with pieces, in order of appearance
  GPtrArray *layers;      // in the order of `names`: GPtrArray of GArray of SbPiece [m]
  GHashTable *left_out;   // type and reason -> count
  GArray *centre;         // of SbPiece [m]: centre lines
  double low;             // all pieces are above this y [m]
  guint pieces, items, placed;
  char *unit;   // owned; NULL: not known
  double scale; // its length [m]
} Drawing;

// Returns the value of a name in any case.
static gpointer find(GHashTable *table, const char *name) {
  g_autofree char *key = g_ascii_strdown(name, -1);
  return g_hash_table_lookup(table, key);
}

// Returns whether an entity on `layer` is a straight line, in one or more pieces, whose type, or
// the layer's, or the layer's name begins as those of centre lines do.
static bool is_centre_line(const Drawing *drawing, const SbDxfEntity *entity, const char *layer,
                           const GArray *pieces) {
  static const char *const starts[] = {SB_DXF_CENTRE};
  const bool by_layer =
      *entity->line_type == '\0' || g_ascii_strcasecmp(entity->line_type, "bylayer") == 0;
  const char *type = by_layer ? find(drawing->line_types, layer) : entity->line_type;
  bool centre = false, straight = pieces->len > 0;
  for (guint i = 0; i < pieces->len; i++) {
    const SbPiece *piece = &g_array_index(pieces, SbPiece, i);
    double off;
    (void)sb_piece_place(&g_array_index(pieces, SbPiece, 0), piece->x1, piece->y1, &off);
    straight = straight && piece->bulge == 0 && off <= GAP;
  }
  for (size_t i = 0; straight && i < G_N_ELEMENTS(starts); i++) {
    const size_t length = strlen(starts[i]);
    centre = centre || g_ascii_strncasecmp(layer, starts[i], length) == 0 ||
             (type != NULL && g_ascii_strncasecmp(type, starts[i], length) == 0);
  }
  return centre;
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

static bool add_pieces(Drawing *to, const char *name, bool centre, GArray *pieces, GError **error) {
  guint layer = 0;
  while (layer < to->names->len && g_ascii_strcasecmp(to->names->pdata[layer], name) != 0) {
    layer++;
  }
  if (!centre && layer == to->names->len) {
    g_ptr_array_add(to->names, g_strdup(name));
    g_ptr_array_add(to->layers, g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref));
  }
  if (centre) {
    g_array_append_vals(to->centre, pieces->data, pieces->len);
  } else {
    g_ptr_array_add(to->layers->pdata[layer], g_array_ref(pieces));
  }
  // No arc goes further from its chord than that is long times the bulge.
  for (guint i = 0; !centre && i < pieces->len; i++) {
    const SbPiece *p = &g_array_index(pieces, SbPiece, i);
    const double deep = fabs(p->bulge) * hypot(p->x1 - p->x0, p->y1 - p->y0);
    to->low = fmin(to->low, fmin(p->y0, p->y1) - deep);
  }
  to->pieces += pieces->len;
  return (to->pieces <= DXF_PIECES_MAX && to->names->len <= LAYERS_MAX) ||
         sb_app_error_input(error,
                            "more than %d pieces or %d layers: export the seal's parts alone",
                            DXF_PIECES_MAX, LAYERS_MAX);
}

// Returns why an entity on `layer` is not seen or is not in the plane; NULL: it is drawn.
static char *why_not(const Drawing *drawing, const SbDxfEntity *entity, const char *layer) {
  const double *n = entity->number;
  const char *hidden = find(drawing->hidden, layer);
  const bool insert = sb_dxf_is(entity, "INSERT");
  if (n[67] == 1 || n[60] == 1) {
    return g_strdup(n[67] == 1 ? " in paper space" : " that is invisible");
  }
  // On a layer that is off, an insert still shows what its block has on other layers.
  if (hidden != NULL && (!insert || strcmp(hidden, "frozen") == 0)) {
    return g_strdup_printf(" on layer '%s', which is %s", layer, hidden);
  }
  const double rise = sb_dxf_is(entity, "ELLIPSE") ? fabs(n[31]) : entity->high - entity->low;
  const bool tilted = hypot(n[210], n[220]) > 1e-6 * fabs(n[230]);
  const bool turns = !sb_dxf_is(entity, "LINE") && !sb_dxf_is(entity, "SPLINE");
  const bool fit = sb_dxf_is(entity, "SPLINE") && entity->list[SB_DXF_X]->len == 0;
  return (tilted && turns) || rise * drawing->scale > GAP ? g_strdup(" out of the drawing's plane")
         : fit                                            ? g_strdup(" with fit points only")
                                                          : NULL;
}

static bool place_block(Drawing *drawing, const Block *block, const SbDxfMap *way,
                        const char *layer, int depth, GError **error);

// Places the rows and columns of an INSERT. What is not given is 1 (41, 42, 70, 71).
static bool place_insert(Drawing *drawing, const SbDxfEntity *entity, const SbDxfMap *way,
                         const char *layer, int depth, GError **error) {
  const double *n = entity->number, turn = n[50] * M_PI / 180, c = cos(turn), s = sin(turn);
  const double sx = entity->list[SB_DXF_WEIGHT]->len > 0 ? n[41] : 1;
  const double sy = entity->list[SB_DXF_BULGE]->len > 0 ? n[42] : 1;
  const Block *block = find(drawing->blocks, entity->name);
  const bool elsewhere = block != NULL && block->elsewhere && block->items->len == 0;
  if (block == NULL || elsewhere || sx == 0 || sy == 0) {
    count_left_out(drawing, "INSERT", elsewhere ? " of another file" : "");
    return true;
  }
  if (depth >= DXF_DEPTH_MAX) {
    return sb_app_error_input(
        error, "its blocks are nested more than %d deep, or contain themselves", DXF_DEPTH_MAX);
  }
  bool good = true;
  const int columns = MAX((int)n[70], 1), count = MAX((int)n[71], 1) * columns;
  for (int i = 0; good && i < count; i++) {
    const int row = i / columns;
    const double x = n[44] * (i % columns) - sx * block->base[0];
    const double y = n[45] * row - sy * block->base[1];
    const SbDxfMap own = {c * sx, -s * sy, c * x - s * y + n[10],
                          s * sx, c * sy,  s * x + c * y + n[20]};
    const SbDxfMap whole = sb_dxf_after(way, &own);
    good = place_block(drawing, block, &whole, layer, depth + 1, error);
  }
  return good;
}

static bool place_entity(Drawing *drawing, const SbDxfEntity *entity, const SbDxfMap *outer,
                         const char *layer, int depth, GError **error) {
  enum { SPACE = 8 }; // a 3D polyline
  const bool world = sb_dxf_is(entity, "LINE") || sb_dxf_is(entity, "SPLINE") ||
                     sb_dxf_is(entity, "ELLIPSE") ||
                     (sb_dxf_is(entity, "POLYLINE") && ((int)entity->number[70] & SPACE) != 0);
  const SbDxfMap back = {-1, 0, 0, 0, 1, 0};
  const SbDxfMap way = world || entity->number[230] >= 0 ? *outer : sb_dxf_after(outer, &back);
  // Layer 0 of a block is the layer of its insert.
  const char *on = depth > 0 && strcmp(entity->layer, "0") == 0 ? layer : entity->layer;
  g_autofree char *reason = why_not(drawing, entity, on);
  if (reason == NULL && sb_dxf_is(entity, "INSERT")) {
    return place_insert(drawing, entity, &way, on, depth, error);
  }
  g_autoptr(GArray) pieces = g_array_new(FALSE, FALSE, sizeof(SbPiece));
  if (reason != NULL || !sb_dxf_pieces(pieces, &way, entity)) {
    count_left_out(drawing, entity->type, reason != NULL ? reason : "");
    return true;
  }
  return add_pieces(drawing, on, is_centre_line(drawing, entity, on, pieces), pieces, error);
}

// Places all entities of a block; `layer` of its INSERT.
static bool place_block(Drawing *drawing, const Block *block, const SbDxfMap *way,
                        const char *layer, int depth, GError **error) {
  SbDxfEntity entity = {.type = ""};
  bool good = true;
  drawing->placed++; // an empty block as well
  for (guint i = 0; good && i < block->items->len; i++) {
    drawing->text.next = g_array_index(block->items, SbDxfItem, i);
    good = sb_dxf_read_entity(&entity, &drawing->text, error);
    drawing->placed += depth > 0;
    if (good && drawing->placed > PLACED_MAX) {
      good = sb_app_error_input(
          error, "its blocks place more than %d entities: export the seal's parts alone",
          PLACED_MAX);
    }
    good = good && place_entity(drawing, &entity, way, layer, depth, error);
  }
  sb_dxf_entity_clear(&entity);
  return good;
}

static void block_free(gpointer data) {
  Block *block = data;
  g_array_unref(block->items);
  g_free(block);
}

// Reads a record of a section at `item`: a layer, the begin or end of a block, an entity.
static bool read_record(Drawing *drawing, const char *section, const char *type,
                        const SbDxfItem *item, Block **open, GError **error) {
  const bool blocks = strcmp(section, "BLOCKS") == 0;
  const bool layer = strcmp(section, "TABLES") == 0 && strcmp(type, "LAYER") == 0;
  SbDxfEntity entity = {.type = ""};
  bool good = true;
  if (layer || (blocks && strcmp(type, "BLOCK") == 0)) {
    drawing->text.next = *item;
    good = sb_dxf_read_entity(&entity, &drawing->text, error);
    char *key = g_ascii_strdown(entity.name, -1);
    if (layer) {
      const bool frozen = ((int)entity.number[70] & 1) != 0;
      const char *state = frozen ? "frozen" : entity.number[62] < 0 ? "off" : NULL;
      g_hash_table_replace(drawing->hidden, key, (char *)state);
      g_hash_table_replace(drawing->line_types, g_strdup(key), g_strdup(entity.line_type));
    } else {
      const bool elsewhere = ((int)entity.number[70] & (4 | 8)) != 0; // also as an overlay
      GArray *items = g_array_new(FALSE, FALSE, sizeof(SbDxfItem));
      const Block block = {{entity.number[10], entity.number[20]}, elsewhere, items};
      *open = g_memdup2(&block, sizeof block);
      g_hash_table_replace(drawing->blocks, key, *open);
    }
  } else if (blocks && strcmp(type, "ENDBLK") == 0) {
    *open = NULL;
  } else if (*open != NULL && strcmp(type, "VERTEX") != 0 && strcmp(type, "SEQEND") != 0) {
    g_array_append_vals((*open)->items, item, 1);
  }
  sb_dxf_entity_clear(&entity);
  return good && (drawing->items++ <= ENTITIES_MAX ||
                  sb_app_error_input(error, "more than %d entities: export the seal's parts alone",
                                     ENTITIES_MAX));
}

// Finds the blocks, layers and entities, and the unit unless the caller chose one.
static bool read_file(Drawing *drawing, GError **error) {
  SbDxfReader reader = drawing->text;
  char section[32] = "", variable[32] = "";
  Block *open = NULL; // that entities are added to
  bool named = false, sections = false, good = true;
  while (good) {
    const SbDxfItem item = reader.next;
    const char *value = reader.value;
    if (!sb_dxf_read_pair(&reader, error) || (reader.code == 0 && strcmp(value, "EOF") == 0)) {
      break;
    }
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
      good = sb_dxf_number(&reader, &number, error);
      g_auto(GStrv) units = g_strsplit(SB_DXF_UNITS, "|", -1);
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

// Finds the axis of the bodies and returns the map that makes it the line y = 0. Warns of the
// longest centre line that is not on it, as of another view.
static SbDxfMap find_axis(SbCad *cad, const Drawing *drawing, const SbCadChoices *choices) {
  double longest = 0, along[3] = {1, 0, 0}, at[3] = {0};
  const bool found = choices->axis == NULL && choices->through == NULL && !choices->section;
  for (guint i = 0; found && i < drawing->centre->len; i++) {
    const SbPiece *line = &g_array_index(drawing->centre, SbPiece, i);
    const double dx = line->x1 - line->x0, dy = line->y1 - line->y0, length = hypot(dx, dy);
    if (length > longest) {
      const double most = 1e-9 * length, sign = dx < -most || (dx <= most && dy < 0) ? -1 : 1;
      longest = length;
      memcpy(along, (double[]){sign * dx, sign * dy, 0}, sizeof along);
      memcpy(at, (double[]){line->x0, line->y0, 0}, sizeof at);
    }
  }
  const double *axis = choices->axis != NULL && !choices->section ? choices->axis : along;
  const double *through = choices->through != NULL && !choices->section ? choices->through : at;
  const double x = through[0], y = choices->section ? drawing->low - AWAY : through[1];
  // The point of the line that is nearest to the drawing's origin is x = 0.
  const double length = hypot(axis[0], axis[1]), c = axis[0] / length, s = axis[1] / length;
  const double foot = x * c + y * s, point[3] = {x - foot * c, y - foot * s, 0};
  g_autofree char *text = sb_cad_axis_text(point, axis);
  cad->axis = g_strconcat(text, longest > 0 ? " (the longest centre line)" : "", NULL);
  const SbDxfMap way = {c, s, 0, -s, c, point[0] * s - point[1] * c};
  const SbPiece *other = NULL;
  for (guint i = 0; found && i < drawing->centre->len; i++) {
    const SbPiece *line = &g_array_index(drawing->centre, SbPiece, i);
    const SbPiece to = sb_dxf_place(&way, line);
    const bool off = fmax(fabs(to.y0), fabs(to.y1)) > GAP;
    other = off && (other == NULL || sb_piece_length(line) > sb_piece_length(other)) ? line : other;
  }
  if (other != NULL) {
    g_autofree char *where =
        sb_cad_axis_text((double[]){other->x0, other->y0, 0},
                         (double[]){other->x1 - other->x0, other->y1 - other->y0, 0});
    sb_note_add(cad->warnings,
                "another centre line is %s: what is drawn about it is not measured about it "
                "(axis and through select it)",
                where);
  }
  return way;
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

// Places model space and makes its bodies; NULL with an error.
static SbCad *of_drawing(Drawing *drawing, const SbCadChoices *choices, GError **error) {
  if (!read_file(drawing, error) ||
      (drawing->unit == NULL &&
       !sb_app_error_choose(error, choices->section ? NULL : "unit", "mm\ncm\ninch",
                            "states no unit ($INSUNITS)")) ||
      !sb_unit_scale(&drawing->scale, drawing->unit, "m", "mm", error)) {
    return NULL;
  }
  const SbDxfMap way = {drawing->scale, 0, 0, 0, drawing->scale, 0};
  if (!place_block(drawing, drawing->model, &way, "0", 0, error)) {
    return NULL;
  }
  SbCad *cad = sb_cad_new("DXF");
  cad->unit = g_strdup(drawing->unit);
  const SbDxfMap axis = find_axis(cad, drawing, choices);
  for (guint k = 0; k < drawing->names->len; k++) {
    const char *name = drawing->names->pdata[k];
    const GPtrArray *entities = drawing->layers->pdata[k];
    for (guint i = 0; i < entities->len; i++) {
      const GArray *pieces = entities->pdata[i];
      for (guint n = 0; n < pieces->len; n++) {
        SbPiece *piece = &g_array_index(pieces, SbPiece, n);
        *piece = sb_dxf_place(&axis, piece);
      }
    }
    g_autofree char *shown = sb_printable(name, strlen(name));
    sb_cad_outlines(cad, entities, shown, choices->join > 0 ? choices->join : GAP);
  }
  sb_cad_settle(cad, choices);
  left_out(cad, drawing);
  if (cad->bodies->len == 0) {
    g_ptr_array_add(cad->warnings, NULL);
    g_autofree char *why = g_strjoinv("; ", (char **)cad->warnings->pdata);
    g_autofree char *join = g_strdup_printf("%.2gmm", 1.1e3 * cad->apart);
    sb_app_error_choose(error, cad->apart > 0 && cad->apart < CLOSABLE ? "join" : NULL, join,
                        "contains no closed outline%s%s", *why != '\0' ? "; " : "", why);
    g_clear_pointer(&cad, sb_cad_free);
  }
  return cad;
}

SbCad *sb_cad_parse_dxf(const char *text, gsize length, const char *name,
                        const SbCadChoices *choices, GError **error) {
  const gsize skipped = sb_bytes_begin(text, length, "\xEF\xBB\xBF") ? 3 : 0;
  g_autoptr(GHashTable) blocks = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, block_free);
  g_autoptr(GHashTable) hidden = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
  g_autoptr(GHashTable) types = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
  g_autoptr(GHashTable) left_out = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
  g_autoptr(GPtrArray) names = g_ptr_array_new_with_free_func(g_free);
  g_autoptr(GPtrArray) layers = g_ptr_array_new_with_free_func((GDestroyNotify)g_ptr_array_unref);
  g_autoptr(GArray) centre = g_array_new(FALSE, FALSE, sizeof(SbPiece));
  g_autoptr(GArray) items = g_array_new(FALSE, FALSE, sizeof(SbDxfItem));
  Block model = {.items = items};
  const char separator = memchr(text, '\n', length) != NULL ? '\n' : '\r';
  Drawing drawing = {
      .text = {.next.at = text + skipped, .end = text + length, .separator = separator},
      .model = &model,
      .blocks = blocks,
      .hidden = hidden,
      .line_types = types,
      .names = names,
      .layers = layers,
      .left_out = left_out,
      .centre = centre,
      .low = INFINITY,
      .unit = g_strdup(choices->unit)};
  GError *problem = NULL;
  SbCad *cad = NULL;
  if (sb_bytes_begin(text, length, "AutoCAD Binary DXF")) {
    sb_app_error_input(&problem, "is a binary DXF: save it as text (ASCII)");
  } else if (choices->axis != NULL && choices->axis[2] != 0) {
    sb_app_error_choose(&problem, "axis", "x\ny", "a DXF has the axes x and y, not z");
  } else {
    cad = of_drawing(&drawing, choices, &problem);
  }
  if (cad == NULL) {
    sb_app_error_prefix(&problem, name);
    g_propagate_error(error, problem);
  }
  g_free(drawing.unit);
  return cad;
}

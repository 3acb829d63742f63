#include "app/cad/dxf_blocks.h"

#include "app/base/error.h"
#include "engine/numeric/arc.h"

#include <math.h>
#include <string.h>

// Deeper than drawings go; a block that holds itself ends there.
enum { DEPTH_MAX = 8, PLACED_MAX = 100000, HELD_MAX = 100000 };
static const double FARTHEST = 1e12; // as any number of the file

typedef enum { PIECES, LEFT_OUT, INSERT } Kind;

typedef struct {
  Kind kind;
  char *layer, *name; // name: an insert's block, or the type of what is left out
  bool centre;
  GArray *pieces;     // of SbCadPiece
  SbDxfInsert insert; // its texts are those above
} Item;

typedef struct {
  double base[2];
  GPtrArray *items;
} Block;

struct SbDxfBlocks {
  GHashTable *block; // name -> Block
  Block *open;       // NULL: outside
  GPtrArray *items;  // the drawing's own inserts
  guint held;        // pieces and items in all
};

// x' = a x + b y + c, y' = d x + e y + f
typedef struct {
  double a, b, c, d, e, f;
} Affine;

static void item_free(gpointer data) {
  Item *item = data;
  g_free(item->layer);
  g_free(item->name);
  g_clear_pointer(&item->pieces, g_array_unref);
  g_free(item);
}

static void block_free(gpointer data) {
  Block *block = data;
  g_ptr_array_unref(block->items);
  g_free(block);
}

SbDxfBlocks *sb_dxf_blocks_new(void) {
  SbDxfBlocks *blocks = g_new0(SbDxfBlocks, 1);
  blocks->block = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, block_free);
  blocks->items = g_ptr_array_new_with_free_func(item_free);
  return blocks;
}

void sb_dxf_blocks_free(SbDxfBlocks *blocks) {
  g_hash_table_unref(blocks->block);
  g_ptr_array_unref(blocks->items);
  g_free(blocks);
}

void sb_dxf_blocks_begin(SbDxfBlocks *blocks, const char *name, double base_x, double base_y) {
  Block *block = g_new0(Block, 1);
  block->base[0] = base_x;
  block->base[1] = base_y;
  block->items = g_ptr_array_new_with_free_func(item_free);
  g_hash_table_replace(blocks->block, g_strdup(name), block);
  blocks->open = block;
}

void sb_dxf_blocks_end(SbDxfBlocks *blocks) {
  blocks->open = NULL;
}

bool sb_dxf_blocks_inside(const SbDxfBlocks *blocks) {
  return blocks->open != NULL;
}

static bool hold(SbDxfBlocks *blocks, guint count, GError **error) {
  blocks->held += count;
  if (blocks->held > HELD_MAX) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "more than %d pieces in blocks: export the seal's parts alone", HELD_MAX);
    return false;
  }
  return true;
}

bool sb_dxf_blocks_pieces(SbDxfBlocks *blocks, const char *layer, bool centre, const GArray *pieces,
                          GError **error) {
  Item *item = g_new0(Item, 1);
  item->kind = PIECES;
  item->layer = g_strdup(layer);
  item->centre = centre;
  item->pieces = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  g_array_append_vals(item->pieces, pieces->data, pieces->len);
  g_ptr_array_add(blocks->open->items, item);
  return hold(blocks, pieces->len + 1, error);
}

void sb_dxf_blocks_left_out(SbDxfBlocks *blocks, const char *type) {
  GPtrArray *items = blocks->open->items;
  if (items->len < HELD_MAX) {
    Item *item = g_new0(Item, 1);
    item->kind = LEFT_OUT;
    item->name = g_strdup(type);
    g_ptr_array_add(items, item);
  }
}

bool sb_dxf_blocks_insert(SbDxfBlocks *blocks, const SbDxfInsert *insert, GError **error) {
  Item *item = g_new0(Item, 1);
  item->kind = INSERT;
  item->layer = g_strdup(insert->layer);
  item->name = g_strdup(insert->name);
  item->insert = *insert;
  item->insert.layer = item->layer;
  item->insert.name = item->name;
  g_ptr_array_add(blocks->open != NULL ? blocks->open->items : blocks->items, item);
  return hold(blocks, 1, error);
}

// Placing ----------------------------------------------------------------------------------------

typedef struct {
  const SbDxfBlocks *blocks;
  const SbDxfSink *sink;
  double tolerance;
  guint placed;
} Placing;

// First `in`, then `out`.
static Affine after(const Affine *out, const Affine *in) {
  return (Affine){
      out->a * in->a + out->b * in->d,          out->a * in->b + out->b * in->e,
      out->a * in->c + out->b * in->f + out->c, out->d * in->a + out->e * in->d,
      out->d * in->b + out->e * in->e,          out->d * in->c + out->e * in->f + out->f};
}

static Affine of_insert(const SbDxfInsert *insert, const double base[2], int column, int row) {
  const double c = cos(insert->turn * M_PI / 180), s = sin(insert->turn * M_PI / 180);
  const double x = insert->spacing[0] * column - insert->scale[0] * base[0];
  const double y = insert->spacing[1] * row - insert->scale[1] * base[1];
  Affine way = {c * insert->scale[0], -s * insert->scale[1], c * x - s * y + insert->at[0],
                s * insert->scale[0], c * insert->scale[1],  s * x + c * y + insert->at[1]};
  if (insert->mirrored) {
    way.a = -way.a;
    way.b = -way.b;
    way.c = -way.c;
  }
  return way;
}

static void map(const Affine *way, double x, double y, double xy[2]) {
  xy[0] = way->a * x + way->b * y + way->c;
  xy[1] = way->d * x + way->e * y + way->f;
}

// An arc under a map that need not keep circles.
typedef struct {
  Affine way;
  SbArc arc;
} PlacedArc;

static void arc_at(const void *curve, double t, double xy[2]) {
  const PlacedArc *placed = curve;
  double at[2];
  sb_arc_place(&placed->arc, t, at);
  map(&placed->way, at[0], at[1], xy);
}

// A piece placed. False where an arc becomes no curve within the tolerance, or it lies too far.
static bool place_piece(GArray *out, const SbCadPiece *piece, const Affine *way, double tolerance) {
  double from[2], to[2];
  map(way, piece->x0, piece->y0, from);
  map(way, piece->x1, piece->y1, to);
  if (!(fmax(fmax(fabs(from[0]), fabs(from[1])), fmax(fabs(to[0]), fabs(to[1]))) < FARTHEST)) {
    return false;
  }
  const double turned = way->a * way->e - way->b * way->d;
  // Circles stay circles where the columns are as long and at right angles.
  const double u = hypot(way->a, way->d), v = hypot(way->b, way->e);
  const bool even =
      fabs(u - v) <= 1e-9 * (u + v) && fabs(way->a * way->b + way->d * way->e) <= 1e-9 * u * v;
  if (piece->bulge == 0 || even) {
    const SbCadPiece placed = {from[0], from[1], to[0], to[1],
                               turned < 0 ? -piece->bulge : piece->bulge};
    g_array_append_val(out, placed);
    return true;
  }
  const double begin[2] = {piece->x0, piece->y0}, end[2] = {piece->x1, piece->y1};
  const PlacedArc arc = {.way = *way, .arc = sb_arc_of(begin, end, piece->bulge)};
  return sb_cad_curve(out, arc_at, &arc, 2, tolerance);
}

static bool place(Placing *placing, const SbDxfInsert *insert, const Affine *outer,
                  const char *layer, int depth, GError **error);

static bool place_item(Placing *placing, const Item *item, const Affine *way, const char *layer,
                       int depth, GError **error) {
  const SbDxfSink *sink = placing->sink;
  const char *on = item->layer != NULL && strcmp(item->layer, "0") != 0 ? item->layer : layer;
  if (item->kind == LEFT_OUT) {
    sink->left_out(sink->data, item->name);
    return true;
  }
  if (item->kind == INSERT) {
    return place(placing, &item->insert, way, on, depth + 1, error);
  }
  g_autoptr(GArray) pieces = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  bool good = true;
  for (guint i = 0; good && i < item->pieces->len; i++) {
    good =
        place_piece(pieces, &g_array_index(item->pieces, SbCadPiece, i), way, placing->tolerance);
  }
  if (!good) {
    sink->left_out(sink->data, "scaled piece");
    return true;
  }
  return sink->add(sink->data, on, item->centre, pieces, error);
}

static bool place(Placing *placing, const SbDxfInsert *insert, const Affine *outer,
                  const char *layer, int depth, GError **error) {
  const Block *block = g_hash_table_lookup(placing->blocks->block, insert->name);
  if (block == NULL || insert->scale[0] == 0 || insert->scale[1] == 0) {
    placing->sink->left_out(placing->sink->data, "INSERT");
    return true;
  }
  if (depth > DEPTH_MAX) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "its blocks are nested more than %d deep, or contain themselves", DEPTH_MAX);
    return false;
  }
  for (int row = 0; row < insert->rows; row++) {
    for (int column = 0; column < insert->columns; column++) {
      const Affine own = of_insert(insert, block->base, column, row), way = after(outer, &own);
      placing->placed += block->items->len + 1;
      if (placing->placed > PLACED_MAX) {
        g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                    "its blocks place more than %d entities: export the seal's parts alone",
                    PLACED_MAX);
        return false;
      }
      for (guint i = 0; i < block->items->len; i++) {
        if (!place_item(placing, block->items->pdata[i], &way, layer, depth, error)) {
          return false;
        }
      }
    }
  }
  return true;
}

bool sb_dxf_blocks_place(const SbDxfBlocks *blocks, double tolerance, const SbDxfSink *sink,
                         GError **error) {
  Placing placing = {.blocks = blocks, .sink = sink, .tolerance = tolerance};
  const Affine same = {1, 0, 0, 0, 1, 0};
  for (guint i = 0; i < blocks->items->len; i++) {
    const Item *item = blocks->items->pdata[i];
    if (!place(&placing, &item->insert, &same, item->layer, 0, error)) {
      return false;
    }
  }
  return true;
}

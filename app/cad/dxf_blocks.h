// Blocks of a DXF: what the section BLOCKS defines and INSERT places, any number of times, moved,
// turned, scaled, in rows and columns, one within another.
#pragma once

#include "app/cad/cad_private.h"

typedef struct {
  const char *name, *layer;
  double at[2], scale[2], turn; // where the block's base point comes to; turn in degrees
  double spacing[2];            // of columns and rows, in the insert's turned axes
  int columns, rows;            // at least 1
  bool mirrored;                // on the plane's back: x is -x afterwards
} SbDxfInsert;

// Where what is placed goes to.
typedef struct {
  bool (*add)(void *data, const char *layer, bool centre, const GArray *pieces, GError **error);
  void (*left_out)(void *data, const char *type);
  void *data;
} SbDxfSink;

typedef struct SbDxfBlocks SbDxfBlocks;

SbDxfBlocks *sb_dxf_blocks_new(void);
void sb_dxf_blocks_free(SbDxfBlocks *blocks);

// Until the end what is added belongs to this block; outside only inserts may be added.
void sb_dxf_blocks_begin(SbDxfBlocks *blocks, const char *name, double base_x, double base_y);
void sb_dxf_blocks_end(SbDxfBlocks *blocks);
bool sb_dxf_blocks_inside(const SbDxfBlocks *blocks);

// Adds pieces (copied) of a layer, an entity that is not read, or an insert. False with an error
// where the blocks hold too much.
bool sb_dxf_blocks_pieces(SbDxfBlocks *blocks, const char *layer, bool centre, const GArray *pieces,
                          GError **error);
void sb_dxf_blocks_left_out(SbDxfBlocks *blocks, const char *type);
bool sb_dxf_blocks_insert(SbDxfBlocks *blocks, const SbDxfInsert *insert, GError **error);

// Places the drawing's own inserts. What lies on layer 0 of a block comes to the insert's layer.
// Arcs that are scaled unevenly become curves within `tolerance`. False with an error: nested too
// deep, or too many.
bool sb_dxf_blocks_place(const SbDxfBlocks *blocks, double tolerance, const SbDxfSink *sink,
                         GError **error);

// Blocks of a DXF: the section BLOCKS defines named sets of pieces, and each INSERT places a block
// in the drawing or in another block: moved, turned, scaled, mirrored, in rows and columns.
//
// Usage: fill the blocks while the file is read (begin, pieces, left_out, insert, end), then call
// sb_dxf_blocks_place() once at the end of the file.
#pragma once

#include "app/cad/cad_private.h"

// One INSERT. The texts are copied when it is added.
typedef struct {
  const char *name, *layer; // of the block; layer of the INSERT
  double at[2];             // where the base point of the block is placed [drawing units]
  double scale[2];          // factors of x and y
  double turn;              // rotation, counter-clockwise [degrees]
  double spacing[2];        // between columns and rows, along the insert's turned axes
  int columns, rows;        // at least 1
  bool mirrored;            // the insert is on the back of the plane: x is reversed at the end
} SbDxfInsert;

// Receives what is placed, in the order of the drawing. Both functions must be set; `data` is
// passed to them.
typedef struct {
  // Adds the pieces (of SbCadPiece, in drawing units, valid during the call) of a layer; `centre`:
  // they are a centre line. Returns false with an error to stop.
  bool (*add)(void *data, const char *layer, bool centre, const GArray *pieces, GError **error);
  // Counts an entity of this type that was not read or could not be placed.
  void (*left_out)(void *data, const char *type);
  void *data;
} SbDxfSink;

// The blocks of one file.
typedef struct SbDxfBlocks SbDxfBlocks;

// Returns an empty set of blocks.
SbDxfBlocks *sb_dxf_blocks_new(void);

// Frees the blocks; not NULL.
void sb_dxf_blocks_free(SbDxfBlocks *blocks);

// Begins the definition of a block with its base point [drawing units]; what is added up to
// sb_dxf_blocks_end() belongs to it. A definition that is open ends. An earlier block of the same
// name is replaced.
void sb_dxf_blocks_begin(SbDxfBlocks *blocks, const char *name, double base_x, double base_y);

// Ends the definition of a block; does nothing outside of one.
void sb_dxf_blocks_end(SbDxfBlocks *blocks);

// Returns whether a definition has begun and not ended.
bool sb_dxf_blocks_inside(const SbDxfBlocks *blocks);

// Adds a copy of `pieces` (of SbCadPiece, in drawing units) of a layer to the block being defined.
// Only inside of a definition. Returns false with SB_APP_ERROR_INPUT if all blocks together have
// too many pieces.
bool sb_dxf_blocks_pieces(SbDxfBlocks *blocks, const char *layer, bool centre, const GArray *pieces,
                          GError **error);

// Records that the block being defined has an entity of `type` that is not read. Only inside of a
// definition.
void sb_dxf_blocks_left_out(SbDxfBlocks *blocks, const char *type);

// Adds an INSERT to the block being defined, or outside of a definition to the drawing. Returns
// false with SB_APP_ERROR_INPUT if there are too many.
bool sb_dxf_blocks_insert(SbDxfBlocks *blocks, const SbDxfInsert *insert, GError **error);

// Passes everything that the drawing's own inserts place to `sink`. Pieces on layer 0 of a block
// are on the layer of the insert. Arcs that are scaled by different factors become pieces within
// `tolerance` [drawing units]. Returns false with an error: blocks nested too deep or in
// themselves, too many pieces, or the error of `sink`.
bool sb_dxf_blocks_place(const SbDxfBlocks *blocks, double tolerance, const SbDxfSink *sink,
                         GError **error);

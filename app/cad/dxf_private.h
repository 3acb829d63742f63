// Entities of a DXF: dxf.c finds and places them, dxf_entity.c reads them and follows their curves.
#pragma once

#include "app/cad/cad_private.h"

// Where a pair begins in the text; `line` is the number of lines before it.
typedef struct {
  const char *at;
  int line;
} SbDxfItem;

// A place in the text (`next`, `end` and `separator`, set by the caller), and the last pair read.
typedef struct {
  SbDxfItem next;  // remainder of the text
  const char *end; // of the text
  char separator;  // that ends a line, '\n' or '\r'
  int code;
  char value[512]; // trimmed, cut
} SbDxfReader;

// Values that an entity may repeat.
enum { SB_DXF_X, SB_DXF_Y, SB_DXF_BULGE, SB_DXF_KNOT, SB_DXF_WEIGHT, SB_DXF_LISTS };

// An entity: its values by group code, in units of the file; 0 (230: 1) for a code that it has not.
// A POLYLINE has the points of its VERTEX entities. Initialise with zeros.
typedef struct {
  char type[32], layer[256], line_type[256], name[256];
  double number[256];
  double low, high;           // of z; INFINITY and -INFINITY: no z
  GArray *list[SB_DXF_LISTS]; // of double
} SbDxfEntity;

// A map of the plane: x' = a x + b y + c, y' = d x + e y + f.
typedef struct {
  double a, b, c, d, e, f;
} SbDxfMap;

// Reads the next pair. Returns false at the end; with an error if a code is none or has no value.
bool sb_dxf_read_pair(SbDxfReader *reader, GError **error);

// Writes the number of the pair. Codes 60 to 79 are 16-bit integers. Returns false with an error.
bool sb_dxf_number(const SbDxfReader *reader, double *out, GError **error);

// Frees the lists of an entity, which may be empty.
void sb_dxf_entity_clear(SbDxfEntity *entity);

// Returns whether an entity has a type, as in "LINE".
static inline bool sb_dxf_is(const SbDxfEntity *entity, const char *type) {
  return strcmp(entity->type, type) == 0;
}

// Reads an entity: from its type, the next pair of `reader`, to the type after it, the last one
// read (after the VERTEX entities of a POLYLINE). Frees the lists that `entity` had.
// Returns false at the end of the text, or with an error; `error` must not be NULL, *error is NULL.
bool sb_dxf_read_entity(SbDxfEntity *entity, SbDxfReader *reader, GError **error);

// Returns the map that applies `in` first, then `out`.
SbDxfMap sb_dxf_after(const SbDxfMap *out, const SbDxfMap *in);

// Returns a piece where the map puts it, as a piece with the same part of a circle.
SbPiece sb_dxf_place(const SbDxfMap *way, const SbPiece *piece);

// Appends the curves of an entity, mapped by `way` to m, to `out` (of SbPiece). Returns false if
// it is of a type that is not read, is not sound, or is too far away; `out` may then have a part.
bool sb_dxf_pieces(GArray *out, const SbDxfMap *way, const SbDxfEntity *entity);

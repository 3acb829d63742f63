// Entities of a DXF: dxf.c finds and places them, dxf_entity.c reads them and follows their curves.
#pragma once

#include "app/cad/cad_private.h"

#include <string.h>

// Where a pair begins in the text; `line` is the number of lines before it.
typedef struct {
  const char *at;
  int line;
} SbDxfItem;

// A place in the text, and the pair that was read last, which calls set after the first three.
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
  double low, high;           // of z
  GArray *list[SB_DXF_LISTS]; // of double
} SbDxfEntity;

// A map of the plane: x' = a x + b y + c, y' = d x + e y + f.
typedef struct {
  double a, b, c, d, e, f;
} SbDxfMap;

// Reads the next pair. Returns false at the end of the text; with an error if a code is not a
// number or has no value.
bool sb_dxf_read_pair(SbDxfReader *reader, GError **error);

// Writes the number of the pair. Codes 60 to 79 are 16-bit integers. Returns false with an error.
bool sb_dxf_number(const SbDxfReader *reader, double *out, GError **error);

// Frees the lists of an entity, which may be empty.
void sb_dxf_entity_clear(SbDxfEntity *entity);

// Returns whether an entity has a type, as in "LINE".
static inline bool sb_dxf_is(const SbDxfEntity *entity, const char *type) {
  return strcmp(entity->type, type) == 0;
}

// Reads the pair with an entity's type and the pairs up to the next type (of a POLYLINE: up to the
// end of its last VERTEX), which is the next pair then. Frees the lists that `entity` had. Returns
// false at the end of the text, or with an error, which must not be NULL.
bool sb_dxf_read_entity(SbDxfEntity *entity, SbDxfReader *reader, GError **error);

// Returns the map that applies `in` first, then `out`.
SbDxfMap sb_dxf_after(const SbDxfMap *out, const SbDxfMap *in);

// Returns a piece where the map puts it, as a piece with the same part of a circle.
SbCadPiece sb_dxf_place(const SbDxfMap *way, const SbCadPiece *piece);

// Appends the curves of an entity to `out` (of SbCadPiece) [m]. Returns false if it is of a type
// that is not read, is not sound, or is too far away; `out` then contains a part of it.
bool sb_dxf_pieces(GArray *out, const SbDxfMap *way, const SbDxfEntity *entity);

// Shapes of parts in documents: [part.NAME] groups with a profile or a mesh. Used by document.c.
#pragma once

#include "app/base/reader.h"

#include "engine/valve/model/valve.h"

// Whether `name` in `group` belongs to a part's shape and is no key of the catalogue.
bool sb_parts_is_shape_key(const char *group, const char *name);

// "housing", "stem_centre" ... of the parts that may have a shape, by the valve's index.
extern const char *const sb_shape_parts[SB_VALVE_STEM_BOTTOM + 1];

// Keys beside a shape may differ from it by rounding, relative.
#define SB_SHAPE_ROUNDING 1e-3

// A parameter that follows from a shape.
typedef struct {
  SbParamId id;
  double value;  // SI
  bool in_valve; // the shape stands in the scene's valve, not in the document itself
  char *source;  // "the bore of [part.housing]"
} SbShapeSize;

// What the shapes of a document and its valve say.
typedef struct {
  SbValveOutlines outlines;                 // for the drawing
  bool has_bore, has_groove[SB_SEAL_COUNT]; // which of the outlines' sizes are known
  bool mesh[SB_VALVE_STEM_BOTTOM + 1];      // the part is a mesh, whose section nothing draws
  char *text[SB_VALVE_STEM_BOTTOM + 1];     // a part's shape keys as lines of a file, or NULL
  GPtrArray *sizes, *masses;                // of SbShapeSize; masses: moments of inertia too
} SbShapes;

// Owned by the caller.
SbShapes *sb_shapes_new(void);
void sb_shapes_free(SbShapes *shapes);

// The size that follows from a shape for `id`, the document's own before its valve's; NULL: none.
const SbShapeSize *sb_shapes_size(const SbShapes *shapes, SbParamId id);

// The size, mass or moment that the shapes of a document itself (in_valve as in SbShapeSize) give
// `id`: what holds without a key beside them. NULL: none.
const SbShapeSize *sb_shapes_own(const SbShapes *shapes, SbParamId id, bool in_valve);

// Derives masses, moments of inertia and sizes from the shapes among `entries`, adds them to
// `shapes` and sets those that `params` does not give; `base` is what they lie upon (the valve's
// values; NULL for a valve). `directory` is where meshes are looked for (NULL: the current one).
//
// A shape takes precedence over sizes in its own file: where a key beside it says otherwise by more
// than 0.1 % that is an issue. A mass or moment beside it is in force, and a note (char *) tells.
// What cannot be read or bounds no body becomes an issue with file, group and key.
void sb_parts_read(SbShapes *shapes, SbParams *params, const SbParams *base,
                   const GPtrArray *entries, const char *shown, const char *directory,
                   GPtrArray *issues, GPtrArray *notes);

// To be called when all is read: settles which outlines can be drawn, with a note on others.
void sb_shapes_settle(SbShapes *shapes, const char *shown, GPtrArray *notes);

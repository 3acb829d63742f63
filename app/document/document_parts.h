// Shapes of parts in documents: groups [part.NAME] with a profile or a mesh, from which masses,
// moments of inertia and sizes follow. Used by document.c.
#pragma once

#include "app/base/reader.h"

#include "engine/valve/model/valve.h"

// Returns whether the key `name` in `group` belongs to a part's shape and is no key of the
// catalogue.
bool sb_parts_is_shape_key(const char *group, const char *name);

// "housing", "stem_centre", ...: names of the parts that may have a shape, indexed as in the valve.
extern const char *const sb_shape_parts[SB_VALVE_STEM_BOTTOM + 1];

// Returns the parameter of the mass of a part (SB_VALVE_HOUSING, ...), the first one of its group.
SbParamId sb_parts_mass(int part);

// Keys in the same file may differ from a shape by this fraction (rounding).
#define SB_SHAPE_ROUNDING 1e-3

// A parameter that follows from a shape.
typedef struct {
  SbParamId id;
  double value;  // [SI]
  bool in_valve; // the shape is in the scene's valve, not in the document itself
  char *source;  // for the user: "the bore of [part.housing]"
} SbShapeSize;

// Everything that follows from the shapes of a document and of its valve.
typedef struct {
  SbValveOutlines outlines;             // for the drawing of the section
  bool has_bore;                        // the housing's profile has a stretch for the bore
  bool has_groove[SB_SEAL_COUNT];       // the stem's profile has a stretch for this seal's groove
  bool mesh[SB_VALVE_STEM_BOTTOM + 1];  // the part is a mesh, which the section does not draw
  char *text[SB_VALVE_STEM_BOTTOM + 1]; // the part's shape keys as lines of a file; NULL: none
  GPtrArray *sizes, *masses;            // of SbShapeSize; masses include moments of inertia
} SbShapes;

// Returns empty shapes. Freed by sb_shapes_free().
SbShapes *sb_shapes_new(void);

// Frees the shapes; not NULL.
void sb_shapes_free(SbShapes *shapes);

// Returns the size that a shape gives `id`, of the document's own shape before its valve's; NULL:
// none.
const SbShapeSize *sb_shapes_size(const SbShapes *shapes, SbParamId id);

// Returns the size, mass or moment of inertia that a shape of the valve (`in_valve`) or of the
// document itself gives `id`; NULL: none.
const SbShapeSize *sb_shapes_own(const SbShapes *shapes, SbParamId id, bool in_valve);

// Computes masses, moments of inertia and sizes from the shapes among `entries` (of SbEntry) of one
// file, adds them to `shapes` and sets in `params` those that `params` does not give. `base` is the
// layer below (the valve's values; NULL: `entries` are those of a valve). Mesh files are relative
// to `directory` (NULL: the current folder). `shown` names the file in messages.
//
// A shape takes precedence over sizes in its own file: a key that differs from it by more than
// SB_SHAPE_ROUNDING is an issue. A mass or moment of inertia that a key gives applies in place of
// that of the shape; then a sentence is appended to `notes` (of SbIssue). A shape that cannot be
// read or bounds no body is an issue with file, group and key.
void sb_parts_read(SbShapes *shapes, SbParams *params, const SbParams *base,
                   const GPtrArray *entries, const char *shown, const char *directory,
                   GPtrArray *issues, GPtrArray *notes);

// Decides which outlines the section can draw (shapes->outlines), and appends a sentence to `notes`
// (of SbIssue), in which `shown` names the document's file, for each shape that it cannot. Call it
// once, after all files were read by sb_parts_read(): that of the valve first.
void sb_shapes_settle(SbShapes *shapes, const char *shown, GPtrArray *notes);

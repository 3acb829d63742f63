// Shapes of parts in documents: [part.NAME] groups with a profile or a mesh. Used by document.c.
#pragma once

#include "app/document/reader.h"

#include "engine/params.h"

// Whether `name` in `group` belongs to a part's shape and is no key of the catalogue.
bool sb_parts_is_shape_key(const char *group, const char *name);

// Derives masses, moments of inertia and diameters from the shapes among `entries` and sets those
// that `params` does not give. `directory` is where meshes are looked for (NULL: the current one).
// What cannot be read or bounds no body becomes an issue with file, group and key; where a given
// value differs from the shape's by more than 0.1 % a note (char *) tells.
void sb_parts_read(SbParams *params, const GPtrArray *entries, const char *shown,
                   const char *directory, GPtrArray *issues, GPtrArray *notes);

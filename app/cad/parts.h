// Bodies of a drawing as a valve's parts: groups [part.NAME] of a scene, with the stretches that
// give its sizes, and how those differ from what a scene has in force.
#pragma once

#include "app/cad/cad.h"
#include "app/document/document.h"

typedef enum {
  SB_CAD_HOUSING,
  SB_CAD_STEM_CENTRE,
  SB_CAD_STEM_TOP,
  SB_CAD_STEM_BOTTOM,
  SB_CAD_PART_COUNT
} SbCadPart;

// "housing" ...; and the part of that name, or -1.
const char *sb_cad_part_name(SbCadPart part);
int sb_cad_part_of(const char *name);

// Which body (index into cad->bodies, -1: none) stands for each part: those whose names are the
// part's, in any case and with blanks or hyphens for the underscore.
void sb_cad_parts_by_name(int body[SB_CAD_PART_COUNT], const SbCad *cad);

// A scene that is `base` with those parts shaped by the drawing: the text of a file to be written
// to `path`. Sizes that follow from the shapes give way to them. density: of the parts [kg/m3].
// NULL with issues. Owned by the caller.
char *sb_cad_scene(const SbCad *cad, const int body[SB_CAD_PART_COUNT], double density,
                   const SbDocument *base, const char *drawing, const char *path,
                   GPtrArray *issues);

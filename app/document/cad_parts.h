// Bodies of a drawing as a valve's parts: groups [part.NAME] of a scene, with the stretches that
// give its sizes, and how those differ from what a scene has in force.
#pragma once

#include "app/cad/cad.h"
#include "app/document/document.h"
#include "app/document/document_parts.h"

// The parts are the valve's first ones, in its order: SB_VALVE_HOUSING to SB_VALVE_STEM_BOTTOM.
enum { SB_CAD_PART_COUNT = SB_VALVE_STEM_BOTTOM + 1 };

// The part of that name ("housing", "Stem centre", "stem-top"), or -1.
int sb_cad_part_of(const char *name);

// What somebody chose, as texts by the names of the command's options.
typedef struct {
  SbCadChoices read;             // its texts are owned below
  char *unit, *axis;             // NULL: as found
  double density;                // of the parts [kg/m3]
  char *part[SB_CAD_PART_COUNT]; // number from 1 or name of the body; NULL: by names
} SbCadSettings;

void sb_cad_settings_init(SbCadSettings *settings);
void sb_cad_settings_clear(SbCadSettings *settings);

// name: "unit", "axis", "angle", "flip" ("yes", "no"), "shift", "density" or a part's. False with
// an error of SB_APP_ERROR.
bool sb_cad_choose(SbCadSettings *settings, const char *name, const char *text, GError **error);

// Which body (index into cad->bodies, -1: none) stands for each part: as chosen, else those whose
// names are the part's, in any case and with blanks or hyphens for the underscore. False with an
// error where a chosen one is none.
bool sb_cad_parts(int body[SB_CAD_PART_COUNT], const SbCad *cad, const SbCadSettings *settings,
                  GError **error);

// A scene that is `base` with those parts shaped by the drawing: the text of a file to be written
// to `path`. Sizes that follow from the shapes give way to them. density: of the parts [kg/m3].
// *after is that document as it would be read. Both are owned by the caller; NULL for both with
// issues.
char *sb_cad_scene(SbDocument **after, const SbCad *cad, const int body[SB_CAD_PART_COUNT],
                   double density, const SbDocument *base, const char *drawing, const char *path,
                   GPtrArray *issues);

// Lines of the values in force that differ: "stem.chamber_depth: 0.85 mm → 0.847 mm"; empty where
// none does. Owned by the caller.
char *sb_cad_differences(const SbDocument *before, const SbDocument *after);

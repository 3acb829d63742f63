// Bodies of a drawing as parts of a valve: assigns bodies to parts, writes the groups [part.NAME]
// of a scene with their profiles and the stretches that give sizes, and lists how these sizes
// differ from the values in force.
#pragma once

#include "app/cad/cad.h"
#include "app/document/document.h"
#include "app/document/document_parts.h"

// Number of parts that a drawing can shape: SB_VALVE_HOUSING to SB_VALVE_STEM_BOTTOM, in this
// order.
enum { SB_CAD_PART_COUNT = SB_VALVE_STEM_BOTTOM + 1 };

// Returns the index of the part with this name ("housing", "Stem centre", "stem-top"); -1: none.
int sb_cad_part_of(const char *name);

// Choices of the user. Initialised by sb_cad_settings_init(), freed by sb_cad_settings_clear().
typedef struct {
  SbCadChoices read;             // for sb_cad_read(); points to `unit` and the numbers below
  char *unit;                    // NULL: not chosen
  double axis[3], through[3];    // direction and a point [m] of the axis
  double angle;                  // [rad]
  double density;                // of the parts [kg/m3]
  char *part[SB_CAD_PART_COUNT]; // number (from 1) or name of the body; NULL: found by its name
} SbCadSettings;

// Sets the default: a density of 1410 kg/m3 (acetal). Settings may not be copied.
void sb_cad_settings_init(SbCadSettings *settings);

// Frees the strings.
void sb_cad_settings_clear(SbCadSettings *settings);

// Sets one choice from text. `name` is an option of `sealbench cad` without dashes: "unit" ("mm"),
// "axis" ("x", "y", "z" or "X,Y,Z"), "through" ("X,Y,Z" with units, else mm), "angle" ("30 deg"),
// "join" (up to "1 mm"), "flip" ("yes", "no"), "shift" ("2 mm"), "density" ("1410 kg/m3") or a
// part's name (number or name of the body). Returns false with SB_APP_ERROR_INPUT for an unknown
// name or a wrong text; the value of this choice is then unspecified.
bool sb_cad_choose(SbCadSettings *settings, const char *name, const char *text, GError **error);

// Writes the index into cad->bodies for each part (-1: none): the chosen body, else the first body
// with a half-section whose name is the part's, ignoring case and with blanks or hyphens for the
// underscore. Returns false with SB_APP_ERROR_INPUT if a chosen body does not exist or has no
// half-section.
bool sb_cad_parts(int body[SB_CAD_PART_COUNT], const SbCad *cad, const SbCadSettings *settings,
                  GError **error);

// Returns the text of a scene or valve file, to be written to `path`: `base` with the parts shaped
// by the bodies (`body` as sb_cad_parts() writes it). Own sizes of `base` that follow from these
// shapes are removed. `density` of the parts [kg/m3]; `drawing` is the path of the drawing, for
// messages and for a mesh. *after receives the document as it would be read from `path`, freed by
// sb_document_free(). `issues` must be empty; returns NULL, with *after = NULL, if there are
// issues.
char *sb_cad_scene(SbDocument **after, const SbCad *cad, const int body[SB_CAD_PART_COUNT],
                   double density, const SbDocument *base, const char *drawing, const char *path,
                   GPtrArray *issues);

// Returns a line for each value in force that differs: "stem.chamber_depth: 0.85 mm → 0.847 mm";
// empty if none does.
char *sb_cad_differences(const SbDocument *before, const SbDocument *after);

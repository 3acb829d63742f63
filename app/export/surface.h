// The figures of a scan of a surface, as JSON, as texts and as a page; and the choices of how a
// scan is read and evaluated.
#pragma once

#include "app/data/scan/scan.h"
#include "app/table/json.h"

#include <cairo.h>

// A scan with its figures. Borrowed.
typedef struct {
  const char *path; // of the file
  const SbScan *scan;
  const SbHeightsChoices *choices; // that the figures were computed with
  const SbScanFigures *figures;
} SbSurface;

// Returns the JSON document of `sealbench surface`.
char *sb_surface_json(const SbSurface *surface);

// Rows of SbHeightFigures and of SbAsperityFigures (sb_result_value()), each list ends with a key
// of NULL.
extern const SbResultRow sb_surface_heights[], sb_surface_asperities[];

// A figure that is compared between the parts of a scan.
typedef struct {
  const char *key;                              // in JSON
  const char *label;                            // in the table
  const char *si;                               // unit of the value
  const char *shown;                            // display unit
  double (*value)(const SbHeightFigures *part); // of one part [si]
} SbSurfaceScatter;

// Those figures; the list ends with a key of NULL.
extern const SbSurfaceScatter sb_surface_scatter[];

// How a scan is read and evaluated.
typedef struct {
  SbScanChoices scan;
  SbHeightsChoices heights;
  char *channel; // owned; scan.channel points to it
} SbSurfaceChoices;

// Texts of the choice "missing" ("leave", "fill"), ended by NULL.
extern const char *const sb_surface_missing[];

// Sets the defaults: a plane is subtracted, all else as in the file.
void sb_surface_choices_init(SbSurfaceChoices *choices);

// Frees the content and zeroes it.
void sb_surface_choices_clear(SbSurfaceChoices *choices);

// Sets one choice by the `name` of its command line option to the value `text`: "form" ("none",
// "plane", "quadratic", "cylinder"), "missing" (sb_surface_missing), "channel" (its name in the
// file), "outliers" (number of robust deviations), "decimal" ("point" or "comma"), "cutoff-short",
// "cutoff-long" and "spacing" (a length with its unit), "unit" and "lateral-unit" (the name of a
// unit of length). Numbers must be above 0. Returns false with SB_APP_ERROR_INPUT whose message
// does not contain the name ("a value above 0 is needed"); the choices are then not to be used, but
// still to be cleared.
bool sb_surface_choose(SbSurfaceChoices *choices, const char *name, const char *text,
                       GError **error);

// Returns the choices in force as text: "plane removed, no outliers sought, missing points left
// out, no cut-off".
char *sb_surface_choices_text(const SbSurface *surface);

// Returns the settings of a scene for this surface, "surface.gt_product=0.1289" and so on, ends
// with NULL; *reason is NULL then. If a scene cannot have it, returns NULL, and *reason
// (static) states why. Freed by g_strfreev().
char **sb_surface_settings(const char **reason, const SbSurface *surface);

// Draws map, spectrum, heights and asperities as one page of width by height logical pixels.
// `dark`: theme.
void sb_surface_draw(cairo_t *cr, double width, double height, const SbSurface *surface, bool dark);

// Writes the page in the light theme into the file `path`, by its ending .png, .svg or .pdf.
// Returns false with SB_APP_ERROR_INPUT for another ending or a path that may not be written,
// SB_APP_ERROR_IO for a full disk and other failures; an earlier file is intact then.
bool sb_surface_still(const SbSurface *surface, const char *path, GError **error);

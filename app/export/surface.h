// What a scan says, as JSON and for people.
#pragma once

#include "app/data/scan/scan_figures.h"
#include "app/export/json.h"

#include <cairo.h>

// Where the figures come from.
typedef struct {
  const char *path; // of the file
  const SbScan *scan;
  const SbHeightsChoices *choices;
  const SbScanFigures *figures;
} SbSurface;

// The contract's JSON. Owned by the caller.
char *sb_surface_json(const SbSurface *surface);

// Figures with a label, of SbHeightFigures and SbAsperityFigures, up to a key of NULL.
extern const SbResultRow sb_surface_heights[], sb_surface_asperities[];

// A figure of the parts and its scatter, up to a key of NULL.
typedef struct {
  const char *key, *label, *si, *shown;
  double (*value)(const SbHeightFigures *part);
} SbSurfaceScatter;
extern const SbSurfaceScatter sb_surface_scatter[];

// How a scan is read and what is made of it.
typedef struct {
  SbScanChoices scan;
  SbHeightsChoices heights;
  char *channel; // owned, scan.channel
} SbSurfaceChoices;

void sb_surface_choices_init(SbSurfaceChoices *choices); // a plane is taken away
void sb_surface_choices_clear(SbSurfaceChoices *choices);

// A choice by the name that the command line's option has, "cutoff-long": true, or SB_APP_ERROR
// with what is wrong ("a value above 0 is needed").
bool sb_surface_choose(SbSurfaceChoices *choices, const char *name, const char *text,
                       GError **error);

// "plane taken away, all points kept, no cut-off": the choices in force. Owned by the caller.
char *sb_surface_choices_text(const SbSurface *surface);

// "surface.gt_product=0.1289" and the like, NULL-terminated, where a scene can take the surface;
// else NULL and why not (static). Owned by the caller (g_strfreev).
char **sb_surface_settings(const char **reason, const SbSurface *surface);

// Draws map, spectrum, heights and asperities as one page.
void sb_surface_draw(cairo_t *cr, double width, double height, const SbSurface *surface, bool dark);

// The same into a file, by the ending .png, .svg or .pdf. FALSE
// as sb_still_write().
bool sb_surface_still(const SbSurface *surface, const char *path, GError **error);

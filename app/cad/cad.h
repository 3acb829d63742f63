// Bodies of drawings: half-sections, volume and moments of the parts in a DXF, STEP or STL file,
// and the lands, bores and grooves on them.
//
// A STEP file is read by sealbench-cad, a program of its own (gmsh with OpenCASCADE) with limits of
// time and memory, which finds the axis, cuts the bodies by a half-plane and measures them. A DXF
// is read here: its closed outlines are bodies; of an STL the mesh is cut. All give half-profiles
// of straight pieces and arcs as [part.NAME] takes them; other curves become arcs that lie within
// SB_CAD_TOLERANCE of them.
#pragma once

#include "app/base/reader.h"

#include "engine/mechanism/solid.h"

#include <glib.h>
#include <stdbool.h>

enum { SB_CAD_BODIES_MAX = 200 };

// How far arcs may lie from the curve that they stand for [m].
#define SB_CAD_TOLERANCE 0.1e-6

typedef enum { SB_CAD_LAND, SB_CAD_BORE, SB_CAD_GROOVE } SbCadKind;

// A stretch of a half-section [m]. Groove: between its walls, `diameter` that of its floor.
typedef struct {
  SbCadKind kind;
  double x0, x1, diameter;
  double depth; // of a groove, from the lower of its two shoulders; else 0
} SbCadFeature;

typedef struct {
  char *name;      // of the body or layer; "body 2" where the file has none
  GArray *profile; // of SbProfilePoint, as SbProfile; empty: none, and `why` says why
  bool closed;
  char *why;
  SbSolid revolved; // of the half-section at a density of 1 kg/m3
  bool measured;    // whether the file's own kernel measured the body
  SbSolid solid;    // what it measured, the axis along x, at 1 kg/m3; else `revolved`
  GArray *features; // of SbCadFeature, in order of x
} SbCadBody;

typedef struct {
  const char *format;  // "DXF", "STEP", "STL"
  char *unit;          // of the file
  char *axis;          // in words
  GPtrArray *bodies;   // of SbCadBody
  GPtrArray *warnings; // of char *: what was left out
} SbCad;

// unit: of a DXF or STL, in place of the file's; NULL: the file's, or the one in which an STL is as
// large as a valve's part. axis: "x" or "y", the line of a DXF that bodies are revolved about;
// NULL: its centre line, else x; of an STL "x", "y" or "z"; NULL: about which its moments are most
// alike. angle: of the half-plane about the axis of a STEP's bodies [rad]. flip: x the other way,
// for a valve drawn with the canister on its right. shift: added to x afterwards [m]. section: a
// DXF's outlines are whole sections, wherever they lie, and no half-sections about an axis.
typedef struct {
  const char *unit, *axis;
  double angle, shift;
  bool flip, section;
} SbCadChoices;

// Reads `path`; NULL with an error of SB_APP_ERROR. Owned by the caller.
SbCad *sb_cad_read(const char *path, const SbCadChoices *choices, GError **error);
void sb_cad_free(SbCad *cad);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbCad, sb_cad_free)

// A DXF from memory; `name` stands for the file in messages.
SbCad *sb_cad_parse_dxf(const char *text, gsize length, const char *name,
                        const SbCadChoices *choices, GError **error);

// The half-profile as the value of a part's `profile` key, in mm; NULL if there is none. Owned by
// the caller.
char *sb_cad_profile_text(const SbCadBody *body);

// The section of a seal from a file, for seal.profile = file, and the outline of a groove: a text
// of points as a part's profile has them (app/cad/profile.h, # begins a comment), a DXF with one
// closed outline, or a STEP of the ring. x is axial, pointing out of the canister.
#pragma once

#include "engine/contact/ring/ring_drawn_groove.h"

#include <glib.h>

// Reads `path` into *out and the section's radial height [m]. False with an error of SB_APP_ERROR
// that names the file, *out empty: no closed outline or several, one that crosses itself, more than
// SB_SEAL_POINTS_MAX pieces, a section more than 5 times as wide as high or the other way.
bool sb_seal_file_read(SbSealDrawing *out, double *height, const char *path, GError **error);

// Reads a groove (gland.profile_file): its outline from one edge to the other, or closed by its
// opening (in a DXF on a layer "groove" if there are others). False with an error that names the
// file, *out without points: no such outline, more than SB_SEAL_POINTS_MAX points, none that
// sb_groove_draw() takes.
bool sb_groove_file_read(SbGrooveDrawing *out, const char *path, GError **error);

// Whether a file's text is a section or a groove: a DXF, STEP or STL, or points behind their unit.
bool sb_seal_file_is_drawing(const char *text, const char *path);

// Checks a section or groove that was read from `path`; *groove: which of them it is. A drawing is
// a groove if an outline of it is on a layer "groove" or "gland" and none on a section's layer; a
// text of points is one if it is open, or if it can only be read as one. False with an error that
// names the file.
bool sb_seal_file_check(bool *groove, const char *text, size_t length, const char *path,
                        GError **error);

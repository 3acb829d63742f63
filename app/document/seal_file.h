// Drawings of a seal's section (seal.profile_file) and of a groove's outline (gland.profile_file):
// a text of points as in a part's profile (app/cad/cad.h; # begins a comment), a DXF with one
// closed outline, or for a section a STEP of the ring. In the file x is axial and points out of the
// canister, and the second coordinate is radial.
#pragma once

#include "engine/contact/ring/ring_drawn_groove.h"

#include <glib.h>

// Reads the section in the file `path` to *out, and its radial height [m]. Returns false with
// SB_APP_ERROR, whose message names the file: no closed outline or several, one that crosses
// itself, more than SB_SEAL_POINTS_MAX pieces, more than 5 times as wide as high or as high as
// wide. *out is then empty.
bool sb_seal_file_read(SbSealDrawing *out, double *height, const char *path, GError **error);

// Reads the groove in the file `path`: the outline from one edge to the other, or closed across its
// opening (in a DXF with several outlines, that on a layer "groove"). Returns false with
// SB_APP_ERROR, whose message names the file: no such outline, more than SB_SEAL_POINTS_MAX points,
// or one that sb_groove_draw() refuses. *out then has no points.
bool sb_groove_file_read(SbGrooveDrawing *out, const char *path, GError **error);

// Returns whether the file `path` with the content `text`, terminated by 0, is a drawing: its path
// ends in .dxf, .step, .stp or .stl, or its text begins as that of a DXF or STEP, or with a unit of
// length (a text of points).
bool sb_seal_file_is_drawing(const char *text, const char *path);

// Checks the drawing whose `length` bytes were read from `path`. *groove is set to whether it is a
// groove: an outline is on a layer "groove" or "gland" and none on a section's layer; or a text of
// points that is open, or that can only be read as a groove. Returns false with SB_APP_ERROR, whose
// message names the file, if the drawing can be read as neither.
bool sb_seal_file_check(bool *groove, const char *text, size_t length, const char *path,
                        GError **error);

// What the parts of app/cad share.
#pragma once

#include "app/cad/cad.h"

// Processor time that sealbench-cad may use for one file [s].
enum { SB_CAD_SECONDS_MAX = 60 };

// A straight piece or an arc in the drawing's plane [m]; bulge as in SbProfilePoint.
typedef struct {
  double x0, y0, x1, y1, bulge;
} SbCadPiece;

// A point of a curve at t in [0, 1].
typedef void (*SbCadCurve)(const void *curve, double t, double xy[2]);

// Appends pieces that follow `curve` within `tolerance`, in its own unit; `steps` parts of it are
// looked at apart from each other at least. False where it is not finite or needs too many.
bool sb_cad_curve(GArray *pieces, SbCadCurve at, const void *curve, int steps, double tolerance);

// The piece from one end through `middle` to the other.
SbCadPiece sb_cad_arc(const double from[2], const double middle[2], const double to[2]);

// Joins pieces to outlines, ends within `gap` being one point, and makes of each a body about the
// line y = 0 (half-section: what lies at y >= 0, or below where nothing lies above). Appends to
// cad->bodies; what closes to no outline is told in its warnings.
void sb_cad_outlines(SbCad *cad, const GArray *pieces, const char *name, double gap);

// A body without anything but its name (copied).
SbCadBody *sb_cad_body_new(const char *name);
void sb_cad_body_free(SbCadBody *body);

// Settles a body whose profile is filled: moved by the choices, counter-clockwise, checked,
// measured, its features found. A profile that bounds no body is emptied, and `why` tells.
void sb_cad_body_settle(SbCadBody *body, const SbCadChoices *choices);

// Appends lands, bores and grooves of the body's profile.
void sb_cad_features(SbCadBody *body);

SbCad *sb_cad_new(const char *format);

// Through sealbench-cad; `shown` stands for the file in messages.
SbCad *sb_cad_read_step(const char *path, const char *shown, const SbCadChoices *choices,
                        GError **error);

// Whether bytes are an STL file, by its size or its first word; and its body, of the file's name.
bool sb_cad_is_stl(const char *data, gsize length);
SbCad *sb_cad_parse_stl(const char *data, gsize length, const char *path,
                        const SbCadChoices *choices, GError **error);

// Profiles: their points as text, and which way round they go. A text has a unit, then x,r or
// x,r,bulge of each point.
//
//   mm 14,0 14,2.9 8,2.9 8,1.64
//
// bulge is that of SbProfilePoint. It closes by repeating its first point.
#pragma once

#include "engine/mechanism/solid.h"

#include <glib.h>
#include <stdbool.h>

// What such a text may look like, for messages.
#define SB_PROFILE_FORM "mm 0,0 10,0 10,2 0,2"

// Points [m] of a text, SB_PROFILE_MAX at most, the repeated one left out; NULL with an error of
// SB_APP_ERROR. An array of SbProfilePoint, owned by the caller.
GArray *sb_profile_parse(const char *text, bool *closed, GError **error);

// Makes a profile (of SbProfilePoint) counter-clockwise, closed by its last piece or by the axis.
void sb_profile_turn(GArray *points, bool closed);

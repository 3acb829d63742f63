// Half-profiles as text, the value of the key [part.NAME] profile, and their orientation. The text
// is a unit of length (any that udunits-2 knows) and then x,r or x,r,bulge of each point, separated
// by blanks or line ends:
//
//   mm 14,0 14,2.9 8,2.9 8,1.64
//
// x is axial, r the distance from the axis, bulge as in SbProfilePoint. A text that repeats its
// first point is closed; another one is closed by the axis.
#pragma once

#include "engine/mechanism/solid.h"

#include <glib.h>
#include <stdbool.h>

// Example of such a text, for messages.
#define SB_PROFILE_FORM "mm 0,0 10,0 10,2 0,2"

// Returns the points [m] of a text, 2 to SB_PROFILE_MAX, as an array of SbProfilePoint to be freed
// by g_array_unref(). *closed is set to whether the text repeats its first point, which the result
// does not contain twice. NULL with SB_APP_ERROR_INPUT: no unit, not numbers, too few or too many
// points. Orientation and crossings are not checked (sb_profile_check()).
GArray *sb_profile_parse(const char *text, bool *closed, GError **error);

// Orders the points (of SbProfilePoint) counter-clockwise in the (x, r) plane, as SbProfile
// requires: reverses them in place, with their bulges, if they are clockwise. `closed`, as
// sb_profile_parse() sets it: a piece from the last point to the first closes the outline; else the
// axis closes it.
void sb_profile_turn(GArray *points, bool closed);

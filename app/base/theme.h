// The look in numbers: colour roles light and dark, type scale, line widths, dashes, colour maps.
//
// Lengths are logical pixels. Every picture of the program, in whatever renderer, takes its colours
// from here.
#pragma once

#include "app/base/color.h"

#include <stdbool.h>

typedef enum {
  SB_ROLE_BACKGROUND,
  SB_ROLE_PANEL,
  SB_ROLE_HAIRLINE,
  SB_ROLE_GRID,
  SB_ROLE_AXIS,
  SB_ROLE_INK,
  SB_ROLE_SECOND,
  SB_ROLE_THIRD,
  SB_ROLE_INNER,
  SB_ROLE_OUTER,
  SB_ROLE_FLUID,
  SB_ROLE_NOW,
  SB_ROLE_PINNED,
  SB_ROLE_VIOLET,
  SB_ROLE_TEAL,
  SB_ROLE_OCHRE,
  SB_ROLE_HOUSING,
  SB_ROLE_HOUSING_HATCH,
  SB_ROLE_STEM,
  SB_ROLE_STEM_HATCH,
  SB_ROLE_OUTLINE,
  SB_ROLE_PASS,
  SB_ROLE_WARN,
  SB_ROLE_ERROR,
  SB_ROLE_WARN_GROUND,
  SB_ROLE_ERROR_GROUND,
  SB_ROLE_COUNT
} SbRole;

typedef struct {
  bool dark;
  SbColor role[SB_ROLE_COUNT];
  double loop_fill;  // opacity of a loop's interior
  double curve_fill; // opacity of the area under a curve
} SbTheme;

// Type sizes.
#define SB_TYPE_TITLE        28.0
#define SB_TYPE_READOUT      30.0
#define SB_TYPE_PANEL        17.0
#define SB_TYPE_PANEL_WINDOW 15.0
#define SB_TYPE_LABEL        12.0
#define SB_TYPE_NOTE         11.0

// Grid.
#define SB_GRID_MARGIN  32.0
#define SB_GRID_PADDING 20.0
#define SB_GRID_GUTTER  24.0
#define SB_GRID_RADIUS  6.0

// Line widths.
#define SB_LINE_ACTIVE  2.6
#define SB_LINE_SEAL    2.2
#define SB_LINE_OUTLINE 1.8
#define SB_LINE_FRAME   1.4
#define SB_LINE_FUTURE  1.6
#define SB_LINE_PINNED  1.4

// Opacity of the part of a curve that is still to be played, and of an earlier run while a new one
// is being computed.
#define SB_OPACITY_FUTURE  0.70
#define SB_OPACITY_EARLIER 0.45

typedef struct {
  int count;
  double length[4];
} SbDash;

extern const SbDash sb_dash_pinned, sb_dash_predicted, sb_dash_reference, sb_dash_dimension,
    sb_dash_centre, sb_dash_dose, sb_dash_now;

// The light or the dark theme; borrowed, immutable.
const SbTheme *sb_theme(bool dark);

// Colour of one seal's curves (SB_OUTER, SB_INNER).
SbColor sb_theme_seal(const SbTheme *theme, int seal);

// Sequential map of a field inside the rubber, t in 0..1 (clamped). Low values recede into the
// panel.
SbColor sb_theme_field(const SbTheme *theme, double t);

// Tint of fluid at a gauge pressure [Pa]; full at 0.7 MPa.
SbColor sb_theme_fluid(const SbTheme *theme, double pressure);

// Pressure at which the fluid map ends [Pa].
#define SB_FLUID_FULL 0.7e6

// Diverging map, t in -1..1 (clamped).
SbColor sb_theme_diverging(const SbTheme *theme, double t);

// Ink that reads on `ground`: the wanted colour if its contrast reaches 4.5:1, else `ink` or the
// panel colour, whichever reads better.
SbColor sb_theme_readable(const SbTheme *theme, SbColor wanted, SbColor ground);

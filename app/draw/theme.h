// The style of all pictures: colour roles (light and dark), type sizes, line widths, dashes, colour
// maps. Lengths are logical pixels. Every renderer uses these. Constant data; any thread.
#pragma once

#include "app/draw/color.h"

#include <stdbool.h>

// What a colour is for.
typedef enum {
  SB_ROLE_BACKGROUND, // of the page
  SB_ROLE_PANEL,      // background of a panel
  SB_ROLE_HAIRLINE,   // borders of panels
  SB_ROLE_GRID,       // grid lines of a chart
  SB_ROLE_AXIS,       // axes of a chart
  SB_ROLE_INK,        // text
  SB_ROLE_SECOND,     // secondary text
  SB_ROLE_THIRD,      // faint text
  SB_ROLE_INNER,      // inner seal
  SB_ROLE_OUTER,      // outer seal
  SB_ROLE_FLUID,      // fluid
  SB_ROLE_NOW,        // present instant
  SB_ROLE_PINNED,     // pinned runs
  SB_ROLE_VIOLET,     // further curves
  SB_ROLE_TEAL,
  SB_ROLE_OCHRE,
  SB_ROLE_HOUSING, // parts of the section
  SB_ROLE_HOUSING_HATCH,
  SB_ROLE_STEM,
  SB_ROLE_STEM_HATCH,
  SB_ROLE_OUTLINE,
  SB_ROLE_PASS,         // verdict yes
  SB_ROLE_WARN,         // warning
  SB_ROLE_ERROR,        // verdict no, error
  SB_ROLE_WARN_GROUND,  // background of a warning
  SB_ROLE_ERROR_GROUND, // background of an error
  SB_ROLE_COUNT
} SbRole;

// The light or the dark theme.
typedef struct {
  bool dark;
  SbColor role[SB_ROLE_COUNT]; // by SbRole
  double loop_fill;            // opacity of a loop's interior
  double curve_fill;           // opacity of the area under a curve
} SbTheme;

// Type sizes [px].
#define SB_TYPE_TITLE        28.0
#define SB_TYPE_READOUT      30.0
#define SB_TYPE_PANEL        17.0
#define SB_TYPE_PANEL_WINDOW 15.0
#define SB_TYPE_LABEL        12.0
#define SB_TYPE_NOTE         11.0

// Layout of a page [px].
#define SB_GRID_MARGIN  32.0
#define SB_GRID_PADDING 20.0
#define SB_GRID_GUTTER  24.0
#define SB_GRID_RADIUS  6.0

// Line widths [px].
#define SB_LINE_ACTIVE  2.6
#define SB_LINE_SEAL    2.2
#define SB_LINE_OUTLINE 1.8
#define SB_LINE_FRAME   1.4
#define SB_LINE_FUTURE  1.6
#define SB_LINE_PINNED  1.4

// Opacity of the part of a curve after the playhead, and of an earlier run while a new one is
// computed.
#define SB_OPACITY_FUTURE  0.70
#define SB_OPACITY_EARLIER 0.45

// A dash pattern: lengths of dashes and gaps in turn [px].
typedef struct {
  int count; // 2 or 4
  double length[4];
} SbDash;

// Style of a line.
typedef struct {
  SbRole role;        // its colour
  double width;       // [px]
  const SbDash *dash; // NULL: solid
} SbStroke;

// The patterns in use, each named after what it draws.
extern const SbDash sb_dash_pinned, sb_dash_predicted, sb_dash_reference, sb_dash_dimension,
    sb_dash_centre, sb_dash_dose, sb_dash_now;

// Returns the dark or the light theme. Static.
const SbTheme *sb_theme(bool dark);

// Returns the colour of a seal's curves; `seal` is SB_OUTER or SB_INNER.
SbColor sb_theme_seal(const SbTheme *theme, int seal);

// Returns the colour of a field inside the rubber at t, 0 to 1 (clamped). Low values are close to
// the colour of the panel.
SbColor sb_theme_field(const SbTheme *theme, double t);

// Returns the colour of fluid at a gauge pressure [Pa]; constant above SB_FLUID_FULL.
SbColor sb_theme_fluid(const SbTheme *theme, double pressure);

// Pressure at which the fluid map ends [Pa].
#define SB_FLUID_FULL 0.7e6

// Returns the colour of a signed value t, -1 to 1 (clamped).
SbColor sb_theme_diverging(const SbTheme *theme, double t);

// Returns a text colour that is readable on `ground`: `wanted` if its contrast is at least 4.5:1,
// else the theme's ink or panel colour, whichever has the higher contrast.
SbColor sb_theme_readable(const SbTheme *theme, SbColor wanted, SbColor ground);

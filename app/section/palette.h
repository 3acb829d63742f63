// Colours of the section: the theme's roles as colours for display lists, and the colour maps for
// fields in a seal, fluid pressure and shaded surfaces.
#pragma once

#include "app/section/draw_list.h"
#include "engine/valve/model/valve.h"

typedef struct {
  bool dark;
  SbColor panel, axis;                                       // background; axis of symmetry
  SbColor ink, second;                                       // text; secondary text
  SbColor seal[SB_SEAL_COUNT];                               // of each seal
  SbColor fluid_line, now;                                   // film and flow; present instant
  SbColor housing, housing_hatch, stem, stem_hatch, outline; // of the parts
  SbDrawMap field;     // stress in a seal, 0 to 1 of its range
  SbDrawMap diverging; // a signed field, -1 to 1
  SbDrawMap fluid;     // gauge pressure, 0 to SB_PALETTE_FLUID_FULL
  // Surfaces in three dimensions by brightness, 0 to 1.
  SbDrawMap housing_shade, stem_shade, seal_shade[SB_SEAL_COUNT];
} SbPalette;

enum { SB_PALETTE_LIGHT, SB_PALETTE_DARK, SB_PALETTE_COUNT };

// Pressure at the end of the fluid map [Pa].
#define SB_PALETTE_FLUID_FULL 0.7e6

// Returns the light or dark palette, created at the first call. Static. Any thread.
const SbPalette *sb_palette(bool dark);

// Returns the colour of fluid at gauge pressure `p` [Pa]; outside of the map that of its nearer
// end.
SbColor sb_palette_fluid(const SbPalette *palette, double p);

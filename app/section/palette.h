// The section's colours: the theme's roles as the display list wants them, and its maps (a
// field in a seal, the fluid by pressure, surfaces by brightness) as tables.
#pragma once

#include "app/section/draw_list.h"
#include "engine/valve/model/valve.h"

typedef struct {
  bool dark;
  SbColor panel, axis;
  SbColor ink, second;
  SbColor seal[SB_SEAL_COUNT];
  SbColor fluid_line, now;
  SbColor housing, housing_hatch, stem, stem_hatch, outline;
  SbDrawMap field;     // stress in a seal
  SbDrawMap diverging; // a signed field, -1 to 1
  SbDrawMap fluid;     // pressure from 0 to 0.7 MPa
  // Surfaces of parts in three dimensions by brightness, 0 to 1.
  SbDrawMap housing_shade, stem_shade, seal_shade[SB_SEAL_COUNT];
} SbPalette;

enum { SB_PALETTE_LIGHT, SB_PALETTE_DARK, SB_PALETTE_COUNT };

// Full scale of the fluid map [Pa].
#define SB_PALETTE_FLUID_FULL 0.7e6

// The palette, made once; borrowed for the life of the program. Any thread.
const SbPalette *sb_palette(bool dark);

// Colour of fluid at gauge pressure p [Pa]; beyond the map's ends their colours.
SbColor sb_palette_fluid(const SbPalette *palette, double p);

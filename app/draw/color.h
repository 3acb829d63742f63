// Colours: sRGB, OKLab and OKLCh with a gamut clip, mixing and contrast. Pure functions of their
// arguments; any thread.
#pragma once

// Gamma-encoded sRGB and opacity (straight, not premultiplied), each 0 to 1. The functions below
// make opaque colours.
typedef struct {
  double r, g, b, a;
} SbColor;

// OKLab: lightness, green-red, blue-yellow.
typedef struct {
  double l, a, b;
} SbOklab;

// Returns the opaque colour 0xRRGGBB.
SbColor sb_color_hex(unsigned rgb);

// Returns the colour of an OKLab; components can be outside of 0 to 1.
SbColor sb_color_from_oklab(SbOklab lab);

// Returns the colour with this lightness (0 to 1), chroma and hue [degrees]. Outside of sRGB the
// chroma is reduced at constant lightness and hue until the colour fits.
SbColor sb_color_oklch(double lightness, double chroma, double hue_degrees);

// Returns the linear mixture of sRGB components and opacity: `a` at t = 0, `b` at t = 1.
SbColor sb_color_mix(SbColor a, SbColor b, double t);

// Returns the WCAG 2 contrast ratio, 1 to 21.
double sb_color_contrast(SbColor a, SbColor b);

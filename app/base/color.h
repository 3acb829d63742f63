// Colours: OKLCh to sRGB with a gamut clip, and contrast.
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

// 0xRRGGBB.
SbColor sb_color_hex(unsigned rgb);

// Ottosson's OKLab of a colour and back; the way back may leave the gamut.
SbOklab sb_color_to_oklab(SbColor color);
SbColor sb_color_from_oklab(SbOklab lab);

// Lightness 0-1, chroma, hue in degrees. Outside sRGB the chroma is lowered at fixed lightness and
// hue until the colour fits, so that lightness keeps its order.
SbColor sb_color_oklch(double lightness, double chroma, double hue_degrees);

// `a` where t = 0, `b` where t = 1; opacity too.
SbColor sb_color_mix(SbColor a, SbColor b, double t);

// WCAG 2 contrast ratio, 1 to 21.
double sb_color_contrast(SbColor a, SbColor b);

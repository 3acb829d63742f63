// Colour arithmetic. OKLab after Ottosson (2020), contrast after WCAG 2.1. All values are
// dimensionless. Leaves out chromatic adaptation: sRGB with D65 throughout.
#include "app/draw/color.h"

#include <math.h>
#include <stdbool.h>

static double to_linear(double c) {
  return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double to_gamma(double c) {
  return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}

static double clamp01(double c) {
  return c < 0 ? 0 : c > 1 ? 1 : c;
}

SbColor sb_color_hex(unsigned rgb) {
  return (SbColor){((rgb >> 16) & 0xff) / 255.0, ((rgb >> 8) & 0xff) / 255.0, (rgb & 0xff) / 255.0,
                   1};
}

SbColor sb_color_from_oklab(SbOklab lab) {
  double l = lab.l + 0.3963377774 * lab.a + 0.2158037573 * lab.b;
  double m = lab.l - 0.1055613458 * lab.a - 0.0638541728 * lab.b;
  double s = lab.l - 0.0894841775 * lab.a - 1.2914855480 * lab.b;
  l = l * l * l;
  m = m * m * m;
  s = s * s * s;
  return (SbColor){to_gamma(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                   to_gamma(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                   to_gamma(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s), 1};
}

static bool in_gamut(SbColor c) {
  const double slack = 1e-6;
  return c.r >= -slack && c.r <= 1 + slack && c.g >= -slack && c.g <= 1 + slack && c.b >= -slack &&
         c.b <= 1 + slack;
}

SbColor sb_color_oklch(double lightness, double chroma, double hue_degrees) {
  const double hue = hue_degrees * (M_PI / 180);
  double ca = cos(hue), sa = sin(hue);
  SbColor out = sb_color_from_oklab((SbOklab){lightness, chroma * ca, chroma * sa});
  if (!in_gamut(out)) {
    // Grey is always inside for lightness in 0..1, so the largest chroma that fits is bracketed.
    double low = 0, high = chroma;
    for (int i = 0; i < 40; i++) {
      double mid = 0.5 * (low + high);
      SbColor c = sb_color_from_oklab((SbOklab){lightness, mid * ca, mid * sa});
      if (in_gamut(c)) {
        low = mid;
      } else {
        high = mid;
      }
    }
    out = sb_color_from_oklab((SbOklab){lightness, low * ca, low * sa});
  }
  return (SbColor){clamp01(out.r), clamp01(out.g), clamp01(out.b), 1};
}

SbColor sb_color_mix(SbColor a, SbColor b, double t) {
  return (SbColor){a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t,
                   a.a + (b.a - a.a) * t};
}

static double luminance(SbColor c) {
  return 0.2126 * to_linear(c.r) + 0.7152 * to_linear(c.g) + 0.0722 * to_linear(c.b);
}

double sb_color_contrast(SbColor a, SbColor b) {
  double p = luminance(a), q = luminance(b);
  return (fmax(p, q) + 0.05) / (fmin(p, q) + 0.05);
}

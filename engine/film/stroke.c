// Equation 5.20; see stroke.h.
#include "engine/film/stroke.h"

#include <math.h>

double sb_leak_stroke(double diameter, double film, double length) {
  return M_PI * diameter * film * length / 2;
}

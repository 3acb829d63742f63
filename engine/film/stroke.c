// Equations 5.19 and 5.20; see stroke.h.
#include "engine/film/stroke.h"

#include <math.h>

double sb_leak_stroke(double diameter, double film, double length) {
  return M_PI * diameter * film * length / 2;
}

double sb_leak_flow(double diameter, double film, double speed) {
  return M_PI * diameter * film * speed / 2;
}

// Equation 5.17 with cut-off; see van_der_waals.h.
#include "engine/contact/rough/van_der_waals.h"

#include <math.h>

double sb_vdw_attraction(double hamaker, double gap) {
  double h = fmax(gap, SB_VDW_CUTOFF);
  return hamaker / (6 * M_PI * h * h * h);
}

double sb_vdw_slope(double hamaker, double gap) {
  return gap > SB_VDW_CUTOFF ? -3 * sb_vdw_attraction(hamaker, gap) / gap : 0;
}

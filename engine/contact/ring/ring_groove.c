// The groove's rigid surfaces: floor, both walls and the bore with its land and chamfers.
//
// Each gives the gap of a place, its normal, tangent and curvature. Beyond an end of the land the
// bore opens with the chamfer's slope, which sets in smoothly over the edge's rounding. Leaves out
// fillets of the groove's corners and any give of the surfaces.
#include "engine/contact/ring/ring_contact.h"

#include <math.h>

// Height above zero whose slope rises smoothly from 0 to 1 over a length (twice differentiable, so
// that Newton does not stumble where the chamfer sets in).
static double ramp(double x, double length, double *slope, double *curvature) {
  if (x <= 0.0) {
    *slope = *curvature = 0.0;
    return 0.0;
  }
  if (x < length) {
    double t = x / length;
    *slope = t * t * (3.0 - 2.0 * t);
    *curvature = 6.0 * t * (1.0 - t) / length;
    return length * t * t * t * (1.0 - 0.5 * t);
  }
  *slope = 1.0;
  *curvature = 0.0;
  return x - 0.5 * length;
}

double sb_ring_gap(const SbRingSetting *setting, SbRingSurface surface, const double x[2],
                   double gradient[2], double *curvature) {
  *curvature = 0.0;
  switch (surface) {
  case SB_RING_BORE: {
    double s1, c1, s2, c2;
    double opening = ramp(x[1] - setting->land_right, setting->edge_length, &s1, &c1) +
                     ramp(setting->land_left - x[1], setting->edge_length, &s2, &c2);
    gradient[0] = -1.0;
    gradient[1] = setting->chamfer_slope * (s1 - s2);
    *curvature = setting->chamfer_slope * (c1 + c2);
    return setting->bore + setting->chamfer_slope * opening - x[0];
  }
  case SB_RING_FLOOR:
    gradient[0] = 1.0;
    gradient[1] = 0.0;
    return x[0] - setting->floor;
  case SB_RING_WALL_RIGHT:
    gradient[0] = 0.0;
    gradient[1] = -1.0;
    return setting->wall_right - x[1];
  case SB_RING_WALL_LEFT:
    gradient[0] = 0.0;
    gradient[1] = 1.0;
    return x[1] - setting->wall_left;
  case SB_RING_SURFACES:
    break;
  }
  gradient[0] = gradient[1] = 0.0;
  return INFINITY;
}

void sb_ring_frame(const SbRingSetting *setting, SbRingSurface surface, const double x[2],
                   double n[2], double t[2], double *gap, double *curvature) {
  double g[2];
  *gap = sb_ring_gap(setting, surface, x, g, curvature);
  double length = hypot(g[0], g[1]);
  n[0] = g[0] / length;
  n[1] = g[1] / length;
  *gap /= length;
  bool along_z = surface == SB_RING_BORE || surface == SB_RING_FLOOR;
  t[0] = along_z ? (surface == SB_RING_BORE ? -n[1] * n[0] / fabs(n[0]) : 0.0) : 1.0;
  t[1] = along_z ? fabs(n[0]) : 0.0;
  *curvature /= length * length;
}

const char *sb_ring_surface_name(SbRingSurface surface) {
  switch (surface) {
  case SB_RING_BORE:
    return "bore";
  case SB_RING_FLOOR:
    return "groove floor";
  case SB_RING_WALL_RIGHT:
    return "right groove wall";
  case SB_RING_WALL_LEFT:
    return "left groove wall";
  case SB_RING_SURFACES:
    break;
  }
  return "";
}

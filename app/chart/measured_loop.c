// See the header.
#include "app/chart/measured_loop.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

enum { LOOP_DOTS = 360 };

// Index of drawn point `k`: by the golden ratio, because even steps would select the same positions
// in every cycle.
static size_t drawn(const SbComparison *of, size_t k) {
  const double share = of->count > LOOP_DOTS ? fmod((double)(k + 1) * 0.6180339887498949, 1)
                                             : (double)k / (double)of->count;
  return MIN((size_t)(share * (double)of->count), of->count - 1);
}

void sb_measured_loop_dot(SbCanvas *c, SbPoint at, bool open) {
  sb_canvas_dot(c, at.x, at.y, 1.95, sb_canvas_role(c, open ? SB_ROLE_OCHRE : SB_ROLE_INK));
  sb_canvas_dot(c, at.x, at.y, 1.25, sb_canvas_role(c, open ? SB_ROLE_PANEL : SB_ROLE_OCHRE));
}

void sb_measured_loop_band(SbCanvas *c, const SbAxes *at, const SbMeasuredBand *of, SbRole role,
                           double alpha) {
  SbPoint outline[2 * SB_MEASURED_BAND];
  for (int way = 0; way < 2 && of->end > 0; way++) {
    size_t count = 0;
    for (int side = 0; side < 2; side++) {
      for (int i = 0; i < SB_MEASURED_BAND; i++) {
        const int bin = side == 0 ? i : SB_MEASURED_BAND - 1 - i;
        const double force = of->force[way][bin][side];
        if (isfinite(force)) {
          outline[count++] = sb_axes_at(at, (bin + 0.5) / SB_MEASURED_BAND * of->end * 1e3, force);
        }
      }
    }
    if (count > 2) {
      sb_canvas_area(c, outline, count, role, alpha);
    }
  }
}

void sb_measured_loop_points(SbCanvas *c, const SbAxes *at, const SbComparison *of) {
  for (size_t k = 0; k < MIN(of->count, LOOP_DOTS); k++) {
    const SbMeasuredPoint *point = &of->point[drawn(of, k)];
    sb_measured_loop_dot(c, sb_axes_at(at, point->displacement * 1e3, point->force), false);
  }
}

void sb_measured_loop_residuals(SbCanvas *c, SbRect strip, const SbAxes *loop, bool numbers,
                                const SbComparison *of, double most, int wanted) {
  double low = -most, high = most;
  SbAxes at = {.x_name = NULL};
  sb_axis_round_out(&low, &high, wanted);
  sb_axes_linear(&at, strip, loop->x.lo, loop->x.hi, low, high);
  sb_axes_ticks(&at, 0, wanted);
  if (numbers) {
    at.x_ticks = loop->x_ticks;
    at.x_name = _("displacement / mm");
  }
  sb_axes_draw(c, &at, NULL);
  if (of == NULL) {
    return;
  }
  if (isfinite(of->measured->noise)) {
    const double by = fmin(1.96 * of->measured->noise, high);
    const double top = sb_axis_at(&at.y, by);
    sb_canvas_fill(c, (SbRect){strip.x, top, strip.width, sb_axis_at(&at.y, -by) - top},
                   SB_ROLE_OCHRE, 0.14);
  }
  for (size_t k = 0; k < MIN(of->count, LOOP_DOTS); k++) {
    const size_t i = drawn(of, k);
    if (isfinite(of->residual[i])) {
      sb_measured_loop_dot(c, sb_axes_at(&at, of->point[i].displacement * 1e3, of->residual[i]),
                           of->point[i].way == 1);
    }
  }
}

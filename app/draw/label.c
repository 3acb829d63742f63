// Greedy label placement. Cost of a place: rank in the offer, plus the length of curve that its box
// covers; taken boxes and the bounds are hard limits. Greedy, in order of importance, because the
// order is part of the design (a label gives way to *now*), and stable: a playhead that moves does
// not make far labels jump. Leaves out a global optimum.
#include "app/draw/label.h"

#include <math.h>

void sb_labels_init(SbLabels *labels, SbRect bounds) {
  labels->bounds = bounds;
  labels->box_count = 0;
  labels->line_count = 0;
  labels->full = false;
  labels->crossing_max = INFINITY;
}

double sb_rect_overlap(SbRect a, SbRect b) {
  double w = fmin(a.x + a.width, b.x + b.width) - fmax(a.x, b.x);
  double h = fmin(a.y + a.height, b.y + b.height) - fmax(a.y, b.y);
  return w > 0 && h > 0 ? w * h : 0;
}

void sb_labels_block(SbLabels *labels, SbRect box) {
  labels->full = labels->box_count == SB_LABELS_MAX;
  if (!labels->full) {
    labels->box[labels->box_count++] = box;
  }
}

void sb_labels_widen(SbLabels *labels, int first, double by) {
  for (int i = first; i < labels->box_count; i++) {
    labels->box[i].x -= by;
    labels->box[i].width += 2 * by;
  }
}

void sb_labels_avoid(SbLabels *labels, const SbPoint *point, size_t count, double weight) {
  // A point is kept when the line turns or has gone 12 px, so that no corner is cut by a pixel.
  size_t anchor = 0;
  for (size_t i = 1; i < count; i++) {
    SbPoint a = point[anchor], b = point[i];
    bool last = i + 1 == count;
    bool keep = last || hypot(b.x - a.x, b.y - a.y) > 12;
    if (!keep) {
      SbPoint c = point[i + 1];
      double cross = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      double along = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);
      keep = fabs(cross) > 0.4 * hypot(c.x - a.x, c.y - a.y) + 1e-9 || along < 0;
    }
    if (keep) {
      if (labels->line_count < SB_LABEL_LINES_MAX && isfinite(a.x + a.y + b.x + b.y)) {
        labels->line[labels->line_count].a = a;
        labels->line[labels->line_count].b = b;
        labels->line[labels->line_count++].weight = weight;
      }
      anchor = i;
    }
  }
}

// Length of the segment inside the box (Liang-Barsky).
static double length_inside(SbPoint a, SbPoint b, SbRect box) {
  double t0 = 0, t1 = 1, dx = b.x - a.x, dy = b.y - a.y;
  const double p[4] = {-dx, dx, -dy, dy};
  const double q[4] = {a.x - box.x, box.x + box.width - a.x, a.y - box.y, box.y + box.height - a.y};
  for (int i = 0; i < 4; i++) {
    if (p[i] == 0) {
      if (q[i] < 0) {
        return 0;
      }
    } else {
      double r = q[i] / p[i];
      if (p[i] < 0) {
        t0 = fmax(t0, r);
      } else {
        t1 = fmin(t1, r);
      }
    }
  }
  return t1 > t0 ? (t1 - t0) * hypot(dx, dy) : 0;
}

bool sb_labels_hits(const SbLabels *labels, SbRect box) {
  const SbRect *in = &labels->bounds;
  if (box.x < in->x || box.y < in->y || box.x + box.width > in->x + in->width ||
      box.y + box.height > in->y + in->height) {
    return true;
  }
  for (int i = 0; i < labels->box_count; i++) {
    if (sb_rect_overlap(box, labels->box[i]) > 0) {
      return true;
    }
  }
  return false;
}

bool sb_labels_place_box(SbLabels *labels, double width, double size, const SbPlace *place,
                         int count, SbPlace *out) {
  const double margin = 2;
  double best = INFINITY;
  SbRect best_box = {0, 0, 0, 0};
  for (int i = 0; i < count; i++) {
    double shift = place[i].align == SB_LEFT     ? 0
                   : place[i].align == SB_MIDDLE ? -0.5 * width
                                                 : -width;
    SbRect box = {place[i].x + shift - margin, place[i].y - 0.80 * size - margin,
                  width + 2 * margin, 1.03 * size + 2 * margin};
    if (sb_labels_hits(labels, box)) {
      continue;
    }
    double crossing = 0;
    for (int k = 0; k < labels->line_count; k++) {
      crossing += labels->line[k].weight * length_inside(labels->line[k].a, labels->line[k].b, box);
    }
    double cost = 4.0 * i + crossing;
    if (crossing <= labels->crossing_max && cost < best) {
      labels->crossing = crossing;
      best = cost;
      best_box = box;
      *out = place[i];
    }
  }
  if (!isfinite(best) || labels->full || labels->box_count == SB_LABELS_MAX) {
    return false;
  }
  sb_labels_block(labels, best_box);
  return true;
}

bool sb_labels_place(SbLabels *labels, SbCanvas *canvas, const char *text, const SbTextStyle *style,
                     const SbPlace *place, int count, SbPlace *out) {
  double width = sb_canvas_text_width(canvas, text, style);
  return sb_labels_place_box(labels, width, style->size, place, count, out);
}

void sb_labels_draw(const SbLabels *labels, SbCanvas *canvas, const char *text,
                    const SbTextStyle *style, const SbPlace *at) {
  if (labels->crossing > 0) {
    sb_canvas_text_halo(canvas, text, style, at->x, at->y, at->align);
  } else {
    sb_canvas_text(canvas, text, style, at->x, at->y, at->align);
  }
}

bool sb_labels_put(SbLabels *labels, SbCanvas *canvas, const char *text, const SbTextStyle *style,
                   const SbPlace *place, int count) {
  SbPlace at;
  if (!sb_labels_place(labels, canvas, text, style, place, count, &at)) {
    return false;
  }
  sb_labels_draw(labels, canvas, text, style, &at);
  return true;
}

void sb_labels_spread(double *y, int count, double line, double top, double bottom) {
  enum { ROUNDS = 60 };
  for (int round = 0; round < ROUNDS; round++) {
    for (int i = 1; i < count; i++) {
      const double lack = fmax(line - (y[i] - y[i - 1]), 0);
      y[i] += lack / 2;
      y[i - 1] -= lack / 2;
    }
    for (int i = 0; i < count; i++) {
      const double first = top + line * i, last = bottom - line * (count - 1 - i);
      y[i] = y[i] > fmax(first, last) ? fmax(first, last) : fmax(y[i], first);
    }
  }
}

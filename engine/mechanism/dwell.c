// See dwell.h.
#include "engine/mechanism/dwell.h"

#include <math.h>
#include <string.h>

static const double close_enough = 1e-4;

// The last piece goes on as the law does on average up to so many times its start.
static const double beyond = 1e4;

// A node of the table: time [s], value, and how far the middle of the piece behind it is off, over
// the value.
typedef struct {
  double time, value, off;
} Node;

static void measure(Node *node, double (*law)(double, const void *), const void *context) {
  double middle = law(sqrt(node[0].time * node[1].time), context);
  node->off = fabs(middle - 0.5 * (node[0].value + node[1].value)) / middle;
}

void sb_dwell_table(SbDwellLaw *out, double (*law)(double, const void *), const void *context,
                    double first, double last) {
  Node node[SB_DWELL_PIECES] = {{1e-3 * first, law(1e-3 * first, context), 0.0},
                                {1e6 * last, law(1e6 * last, context), 0.0}};
  size_t count = 2, worst = 0;
  measure(node, law, context);
  // The first piece leads from 0 to the first node, the last one beyond the last.
  while (count + 1 < SB_DWELL_PIECES && node[worst].off > close_enough) {
    memmove(node + worst + 2, node + worst + 1, (count - worst - 1) * sizeof *node);
    double time = sqrt(node[worst].time * node[worst + 2].time);
    node[worst + 1] = (Node){time, law(time, context), 0.0};
    count++;
    measure(node + worst, law, context);
    measure(node + worst + 1, law, context);
    for (size_t i = worst = 0; i + 1 < count; i++) {
      worst = node[i].off > node[worst].off ? i : worst;
    }
  }
  double start = law(0.0, context), end = node[count - 1].time;
  out->count = count + 1;
  out->piece[0] = (SbDwellPiece){0.0, node[0].time, start, (node[0].value - start) / M_LN2};
  for (size_t i = 0; i < count; i++) {
    double after = i + 1 < count ? node[i + 1].value : law(beyond * end, context);
    double way = i + 1 < count ? log(node[i + 1].time / node[i].time) : log(beyond);
    out->piece[i + 1] = (SbDwellPiece){node[i].time, node[i].time, node[i].value,
                                       fmax(0.0, after - node[i].value) / way};
  }
}

const SbDwellPiece *sb_dwell_piece(double *until, const SbDwellLaw *law, double dwell) {
  size_t low = 0, high = law->count;
  while (low + 1 < high) {
    size_t middle = (low + high) / 2;
    *(law->piece[middle].from <= dwell ? &low : &high) = middle;
  }
  *until = low + 1 < law->count ? law->piece[low + 1].from : INFINITY;
  return &law->piece[low];
}

double sb_dwell_at(const SbDwellLaw *law, double dwell) {
  double until;
  const SbDwellPiece *piece = sb_dwell_piece(&until, law, dwell);
  return piece->value + piece->gain * log1p((dwell - piece->from) / piece->time);
}

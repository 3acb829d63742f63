// See squeeze.h. With solids the time is integrated over the film, in panels that shrink towards
// its end: dt = -4 eta b^2 dh/(h^3 p_f(h)).
#include "engine/film/squeeze.h"

#include "engine/numeric/legendre.h"
#include "engine/numeric/root.h"

#include <math.h>

enum { POINTS = 4, PANELS_PER_HALVING = 4 };

// -dt/dh at a film h.
static double slowness(const SbSqueeze *s, double h) {
  SbRoughPoint at;
  sb_rough_law_at(&at, s->law, sb_rough_law_of_gap(s->law, h));
  return s->drag / (h * h * h * (s->pressure - at.pressure + at.pull));
}

// Time from a film to a thinner one in one panel.
static double panel(const SbSqueeze *s, double from, double to) {
  double node[POINTS], weight[POINTS], sum = 0;
  sb_legendre_gauss(node, weight, POINTS);
  for (int i = 0; i < POINTS; i++) {
    sum += weight[i] * slowness(s, (from + to) / 2 + (from - to) / 2 * node[i]);
  }
  return sum * (from - to) / 2;
}

void sb_squeeze_init(SbSqueeze *s, double film, double pressure, double half_width,
                     double viscosity, const SbRoughLaw *law) {
  *s = (SbSqueeze){.film = film,
                   .pressure = pressure,
                   .drag = 4 * viscosity * half_width * half_width,
                   .law = law};
  if (law == NULL) {
    return;
  }
  SbRoughPoint end;
  sb_rough_law_at(&end, law, sb_rough_law_of_load(law, pressure));
  s->rest = fmin(end.gap, film);
  s->gap[0] = film;
  for (int i = 1; i < SB_SQUEEZE_NODES; i++) {
    s->gap[i] = s->rest + (film - s->rest) * exp2(-(double)i / PANELS_PER_HALVING);
    s->time[i] = film > s->rest ? s->time[i - 1] + panel(s, s->gap[i - 1], s->gap[i]) : INFINITY;
  }
}

typedef struct {
  const SbSqueeze *squeeze;
  size_t node; // that begins the panel
  double time;
} Search;

// How much earlier than wanted a film is reached; rises with it.
static double early(double *slope, double h, const void *context) {
  const Search *search = context;
  const SbSqueeze *s = search->squeeze;
  *slope = slowness(s, h);
  return search->time - s->time[search->node] - panel(s, s->gap[search->node], h);
}

double sb_squeeze_film(const SbSqueeze *s, double time) {
  if (s->law == NULL) {
    return s->film / sqrt(1 + 2 * s->film * s->film * s->pressure / s->drag * time);
  }
  if (!(time < s->time[SB_SQUEEZE_NODES - 1])) {
    return s->rest;
  }
  if (s->film <= s->rest) {
    return s->film;
  }
  const size_t i = sb_interval(s->time, SB_SQUEEZE_NODES, time);
  const Search search = {s, i, time};
  return sb_newton_bracketed(early, &search, s->gap[i + 1], s->gap[i], s->gap[i]);
}

double sb_squeeze_time(const SbSqueeze *s, double film) {
  if (s->law == NULL) {
    return s->drag / (2 * s->pressure) * (1 / (film * film) - 1 / (s->film * s->film));
  }
  size_t i = 0;
  while (i + 2 < SB_SQUEEZE_NODES && s->gap[i + 1] > film) {
    i++;
  }
  return s->film > s->rest ? s->time[i] + panel(s, s->gap[i], film) : 0;
}

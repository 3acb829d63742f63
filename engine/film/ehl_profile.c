// Profile of a coupled film solution, dense enough to recompute Reynolds' equation, the load and
// the deflection from its points alone.
//
// Points are evenly spaced in the element's own coordinate, with the same number on every element,
// because elements follow the layers. On an infinite element they are geometric in s, with the same
// number per factor of GROWTH. A central difference on a geometric grid of ratio 1 + c has an error
// of about 3 c^2 in the far inlet, where p' decreases like |x|^-4.
//
// Pressure of smooth rows: nodal polynomials satisfy Reynolds' equation at the collocation points
// only, and their slopes jump at the joints of elements. Collocation at Gauss points is
// superconvergent at the joints (de Boor and Swartz 1973), and the gap has a degree to spare. So
// the integral of the slope's deviation from Reynolds' equation, for the gap interpolated through
// collocation points and joints, is added to the polynomial. Deep inside the contact of a thin
// film, where that slope is the small difference of gap and flux film, it is the reverse: the
// polynomial remains, and its slope gives the film.
#include "engine/film/ehl.h"

#include <math.h>

// A point in the scaled problem.
typedef struct {
  double X, pressure, film, asperity;
  double lack; // of the pressure's slope against Reynolds'
} Point;

// Extent of a liquid end at `ambient`. Beyond X the pressure rises by (4/3) lambda/X^3. The omitted
// load must be below 1e-6 of the total and, in a profile to be recomputed from, the friction below
// about 2e-3 (its remainder is proportional to lambda^(1/4)/X), as long as steps of the pressure
// are resolved against the ambient one.
static double reach_of(double lambda, double ambient, bool drawn) {
  const double least = 3.0, digits = 1e-11, step = 0.02;
  double load = sqrt(2.0 / 3.0 * lambda / (0.5 * M_PI * 1e-6));
  double friction = 600.0 * pow(lambda, 0.25);
  double shown = cbrt(4.0 / 3.0 * lambda * step / (digits * fmax(ambient, 1e-12)));
  return fmax(fmax(least, load), drawn ? 0.0 : fmin(friction, shown));
}

static const double GROWTH = 2.0;

// s where an infinite element's points end, and how many parts of equal growth that makes; one of a
// finite element.
static int parts_of(double *s, const SbEhlElement *e, const SbEhlCase *c, bool drawn) {
  *s = 1.0;
  if (e->side == 0) {
    return 1;
  }
  double reach = 1.0 + reach_of(c->layers.lambda, e->far_pressure, drawn);
  *s = sb_ehl_inverse(e, sb_ehl_coordinate(e, e->side * reach));
  return (int)fmax(1.0, ceil(-log(*s) / log(GROWTH)));
}

// Films this flat use their polynomial: see the top of the file.
static bool flat_element(const SbEhlSolution *s, const SbEhlElement *e) {
  static const double FLAT = 0.03;
  bool flat = e->side == 0;
  for (int k = 0; k < e->points; k++) {
    flat = flat && fabs(s->state.gap[e->first_row + k] / s->state.flux - 1.0) < FLAT;
  }
  return flat;
}

// Towards infinity a thin film's gap grows by many decades: there its excess over the dry gap,
// which is in solver->gaps, is interpolated.
static Point smooth_point(const SbEhlSolution *s, const SbEhlElement *e, bool flat, double r) {
  const SbEhlLayers *l = &s->c.layers;
  const double flux = s->state.flux;
  Point p = {.X = sb_ehl_position(e, r)};
  double slope;
  p.pressure = sb_ehl_pressure(&slope, e, s->state.nodal, r);
  if (flat) {
    p.film = sb_ehl_flat_film(&s->c, flux, flux, p.pressure, slope);
    return p;
  }
  bool infinite = e->side != 0;
  p.film = sb_ehl_gap(e, infinite ? s->solver->gaps : s->state.gap, r) +
           (infinite ? sb_ehl_layers_dry_gap(l, p.X) : 0.0);
  double m, by_film, by_pressure;
  sb_film_mobility(&m, &by_film, &by_pressure, &s->c.fluid, p.film, p.pressure);
  p.lack = l->lambda * (p.film - flux) / (p.film * p.film * p.film * m) - slope;
  return p;
}

static Point rough_point(const SbEhlSolution *s, const SbEhlElement *e, double r) {
  SbEhlRoughPoint at;
  sb_ehl_rough_point(&at, &s->c, sb_ehl_interpolate(e->table, &s->state.t[e->first_dof], r));
  return (Point){.X = sb_ehl_position(e, r),
                 .pressure = sb_ehl_interpolate(e->table, &s->state.nodal[e->first_dof], r),
                 .film = at.h,
                 .asperity = at.asperity};
}

// Returns the number of intervals of a part: even, so that the profile can be integrated by
// parabolas, and at least 4.
static size_t intervals_of_part(const SbFilmProblem *wanted, const SbEhlSolution *s, bool drawn) {
  double far;
  int parts = 0;
  for (int i = 0; i < s->mesh.count; i++) {
    parts += parts_of(&far, &s->mesh.element[i], &s->c, drawn);
  }
  size_t room = s->c.rough.rows ? 5200 : SB_FILM_POINTS - 1 - SB_EHL_ELEMENTS_MAX;
  size_t most = drawn && wanted->profile_points < room ? wanted->profile_points : room;
  size_t per = most / (size_t)parts / 2 * 2;
  return per < 4 ? 4 : per;
}

void sb_ehl_profile(SbFilm *out, const SbFilmProblem *wanted, const SbEhlSolution *s,
                    const SbFilmScale *scale) {
  if (wanted->profile == NULL) {
    return;
  }
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  const bool rough = s->c.rough.rows;
  const bool drawn = wanted->profile_points > 0;
  for (int i = 0; i < mesh->targets && !rough; i++) {
    s->solver->gaps[i] = state->gap[i] - sb_ehl_layers_dry_gap(&s->c.layers, mesh->x[i]);
  }
  const size_t per = intervals_of_part(wanted, s, drawn);
  double far;                    // s of an infinite element's last point
  size_t thin = 0, thin_end = 1; // points of the thinnest element
  double least = INFINITY;       // film in its middle
  double correction = 0.0;
  Point last = {0};
  for (int i = 0; i < mesh->count; i++) {
    const SbEhlElement *e = &mesh->element[i];
    size_t intervals = per * (size_t)parts_of(&far, e, &s->c, drawn);
    bool flat = !rough && flat_element(s, e);
    bool fresh = i == 0 || e->apart;
    const size_t begin = out->points;
    least = fresh ? INFINITY : least;
    for (size_t k = 0; k <= intervals; k++) {
      double share = (double)k / (double)intervals;
      double r = e->side != 0 ? e->side * (1.0 - 2.0 * pow(far, e->side < 0 ? 1.0 - share : share))
                              : -1.0 + 2.0 * share;
      Point p = rough ? rough_point(s, e, r) : smooth_point(s, e, flat, r);
      correction += k > 0 ? 0.5 * (p.lack + last.lack) * (p.X - last.X) : 0.0;
      correction = k == 0 && fresh ? 0.0 : correction;
      last = p;
      if (k > 0 || fresh) { // a joint has been written by the element before
        sb_film_put(out, out->points, (p.X + state->shift) * scale->half_width,
                    (p.pressure + correction + s->c.fluid.rupture) * scale->pressure,
                    p.film * scale->film);
        out->asperity_pressure[out->points - 1] = p.asperity * scale->pressure;
      }
    }
    double middle = rough ? INFINITY : state->gap[e->first_row + e->points / 2];
    if (middle < least) {
      least = middle;
      thin = begin;
      thin_end = out->points;
    }
    // The excess of a full film's pressure at its end is distributed over its thinnest element,
    // where a difference in pressure changes the flux least.
    bool ends = i + 1 == mesh->count || mesh->element[i + 1].apart;
    for (size_t n = thin; n < out->points && ends; n++) {
      double share = fmin((double)(n - thin + 1) / (double)(thin_end - thin), 1.0);
      out->pressure[n] -= correction * scale->pressure * share;
    }
  }
}

// Profile of a coupled film solution, dense enough that Reynolds' equation, the load and the
// deflection can be recomputed from its points alone.
//
// The points follow a density with a closed-form integral: geometric in the distance from the inlet
// layer and from the outlet layer, even in the angle inside the contact. A central difference on a
// geometric grid of ratio 1 + c errs by about 3 c^2 in the far inlet, where p' falls like |x|^-4.
//
// Pressure: nodal polynomials satisfy Reynolds' equation at the collocation points only, and their
// slopes jump at the joints of elements. Collocation at Gauss points is superconvergent at the
// joints (de Boor and Swartz 1973), and the gap has a degree to spare; so the pressure is the
// integral of the slope that Reynolds' equation gives for the gap interpolated through collocation
// points and joints. Deep inside a thin film's contact, where that slope is the small difference of
// gap and flux film, it is the other way round: the polynomial is kept, and its slope gives the
// film.
#include "engine/film/ehl.h"

#include "engine/numeric/legendre.h"

#include <assert.h>
#include <math.h>

enum { MODES = 22 }; // of the slope on an element; the fine rule holds 24 points

// How points are spread: flow frame, X of the mesh.
typedef struct {
  double inlet, inlet_unit;   // place and length of the inlet layer
  double outlet, outlet_unit; // and of the outlet layer
  double fineness;            // points per unit of the layers' geometric measure, times the ratio
  double angle;               // points per radian inside the contact
} Spread;

// Ratios of the geometric grids outside and inside of a layer, and its length without growth.
static const double RATIO_OUTSIDE = 0.0058;
static const double RATIO_INSIDE = 0.0125;
static const double CORE_INLET = 1.2;
static const double CORE_OUTLET = 0.4;
// Just outside, where the film is a few times the flux film, the flux is asked relative to the flux
// film: EXTRA more points per core length, fading over NEARBY core lengths.
static const double EXTRA = 20.0;
static const double NEARBY = 6.0;

// Points of a layer's grid up to `distance` from its middle, outwards positive.
static double layer_count(double distance, double core) {
  double u = distance / core;
  return u > 0.0 ? asinh(u) / RATIO_OUTSIDE + EXTRA * NEARBY * atan(u / NEARBY)
                 : asinh(u) / RATIO_INSIDE;
}

static double layer_density(double distance, double core) {
  double u = distance / core;
  double geometric = 1.0 / (core * hypot(u, 1.0));
  return u > 0.0 ? geometric / RATIO_OUTSIDE + EXTRA / core / (1.0 + u * u / (NEARBY * NEARBY))
                 : geometric / RATIO_INSIDE;
}

// Number of points left of X, up to a constant, and its derivative.
static double count_to(const Spread *s, double X) {
  double in = layer_count(s->inlet - X, CORE_INLET * s->inlet_unit);
  double out = layer_count(X - s->outlet, CORE_OUTLET * s->outlet_unit);
  double inside = acos(fmin(fmax(-X, -1.0), 1.0));
  return s->fineness * (out - in) + s->angle * inside;
}

static double density(const Spread *s, double X) {
  double in = layer_density(s->inlet - X, CORE_INLET * s->inlet_unit);
  double out = layer_density(X - s->outlet, CORE_OUTLET * s->outlet_unit);
  double inside = fabs(X) < 1.0 ? 1.0 / sqrt((1.0 - X) * (1.0 + X)) : 0.0;
  return s->fineness * (in + out) + s->angle * inside;
}

// Spread of at most `limit` points from `begin` to `end`.
static Spread spread_points(const SbEhlMesh *mesh, const SbEhlLayers *layers, double begin,
                            double end, double limit) {
  static const double INSIDE_MOST = 2600.0;
  const SbEhlElement *last = &mesh->element[mesh->count - 1];
  double edge = last->map == SB_EHL_OUTLET ? mesh->element[mesh->outlet].x0 : last->x1;
  double width = sb_ehl_layers_width(layers);
  Spread s = {
      .inlet = -1.0,
      .inlet_unit = width,
      .outlet = edge,
      .outlet_unit = sb_ehl_layers_outlet_width(layers),
      .fineness = 1.0,
  };
  double wedge = sb_ehl_layers_wedge(layers);
  if (wedge > 0.0) {
    s.inlet_unit = s.outlet_unit = 0.4 * wedge;
    s.inlet = edge - 3.0 * s.inlet_unit;
  }
  double layer = count_to(&s, end) - count_to(&s, begin);
  s.fineness = fmin(1.0, 0.85 * limit / layer);
  s.angle = fmin(INSIDE_MOST, limit - s.fineness * layer) / M_PI;
  return s;
}

// Gap of an element at r. Towards infinity a thin film's gap grows by many decades: there its
// excess over the dry gap is interpolated, which the caller has put into `excess`.
static double gap_at(SbFilmSolver *solver, int which, const SbEhlCase *problem, int element,
                     const double *excess, double r) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlElement *e = &mesh->element[element];
  if (!sb_ehl_infinite(e)) {
    return sb_ehl_gap(mesh, &solver->tables, element, solver->state[which].gap, r);
  }
  return sb_ehl_gap(mesh, &solver->tables, element, excess, r) +
         sb_ehl_layers_dry_gap(&problem->layers, sb_ehl_position(e, r));
}

// A piece of the profile: an element, or part of an infinite one, over which s grows by a factor
// of four. Its pressure as Legendre modes in its own coordinate t: of dp/dt by Reynolds' equation,
// or of the nodal polynomial itself where the film is flat.
typedef struct {
  int element;
  double middle, half; // r = middle + half t
  bool flat;
  double mode[MODES + 1];
  double begin, end; // pressure at t = -1 and 1, so that the whole is continuous
} Piece;

enum { PIECES_MAX = SB_EHL_ELEMENTS_MAX + 40 };

// Slope dp/dr by Reynolds' equation.
static double reynolds_slope(SbFilmSolver *solver, int which, const SbEhlCase *problem, int element,
                             const double *excess, double r) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  const SbEhlElement *e = &mesh->element[element];
  double film = gap_at(solver, which, problem, element, excess, r);
  double pressure = sb_ehl_pressure(mesh, &solver->tables, e, state->nodal, r);
  double m, by_film, by_pressure;
  sb_film_mobility(&m, &by_film, &by_pressure, &problem->fluid, film, pressure);
  return problem->layers.lambda * (film - state->flux) / (film * film * film * m) *
         sb_ehl_stretch(e, r);
}

static void fill_piece(Piece *out, SbFilmSolver *solver, int which, const SbEhlCase *problem,
                       const double *excess) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlElement *e = &mesh->element[out->element];
  for (int q = 0; q < SB_EHL_QUAD; q++) {
    double r = out->middle + out->half * solver->tables.fine[q];
    double value =
        out->flat ? sb_ehl_pressure(mesh, &solver->tables, e, solver->state[which].nodal, r)
                  : out->half * reynolds_slope(solver, which, problem, out->element, excess, r);
    value *= solver->tables.fine_weight[q];
    for (int k = 0; k <= MODES; k++) {
      out->mode[k] += (k + 0.5) * value * solver->tables.fine_legendre[q][k];
    }
  }
}

// Cuts the mesh between X = begin and end into pieces, left to right; their number.
static int cut_pieces(Piece *out, SbFilmSolver *solver, int which, const SbEhlCase *problem,
                      const double *excess, double begin, double end) {
  // Films this flat keep their polynomial: see the head of the file.
  static const double FLAT = 0.03;
  static const double GROWTH = 4.0;
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  int count = 0;
  for (int i = 0; i < mesh->count; i++) {
    const SbEhlElement *e = &mesh->element[i];
    if (sb_ehl_infinite(e)) {
      // s is 1 at the joint, r = 2 s - 1 in the inlet and 1 - 2 s in the outlet.
      bool inlet = e->map == SB_EHL_INLET;
      double far = sb_ehl_coordinate(e, inlet ? begin : end);
      double s = sb_ehl_inverse(e, far);
      int pieces = (int)fmax(1.0, ceil(-log(s) / log(GROWTH)));
      for (int k = 0; k < pieces && count < PIECES_MAX; k++) {
        int from = inlet ? k : pieces - k; // 0 is the far end
        double s0 = pow(s, (double)(pieces - from) / pieces);
        double s1 = pow(s, (double)(pieces - from + (inlet ? -1 : 1)) / pieces);
        double r0 = inlet ? 2.0 * s0 - 1.0 : 1.0 - 2.0 * s0;
        double r1 = inlet ? 2.0 * s1 - 1.0 : 1.0 - 2.0 * s1;
        out[count++] = (Piece){i, 0.5 * (r0 + r1), 0.5 * (r1 - r0), false, {0.0}, 0.0, 0.0};
      }
      continue;
    }
    bool flat = true;
    for (int k = 0; k < e->points; k++) {
      flat = flat && fabs(state->gap[e->first_row + k] / state->flux - 1.0) < FLAT;
    }
    out[count++] = (Piece){i, 0.0, 1.0, flat, {0.0}, 0.0, 0.0};
  }
  for (int i = 0; i < count; i++) {
    fill_piece(&out[i], solver, which, problem, excess);
  }
  return count;
}

// Rise of the pressure over a piece by its own modes.
static double rise_of(const Piece *piece) {
  double sum = piece->flat ? 0.0 : 2.0 * piece->mode[0];
  for (int k = 1; piece->flat && k <= MODES; k += 2) {
    sum += 2.0 * piece->mode[k];
  }
  return sum;
}

// Pressure at t and, of a flat film, its slope dp/dt; the integral of P_k from -1 is
// (P_{k+1} - P_{k-1})(t) / (2k + 1). What the ends hold beyond the modes is spread evenly.
static double pressure_at(double *slope, const Piece *piece, double t) {
  double before = 1.0, now = t;               // P_{k-1}, P_k
  double slope_before = 0.0, slope_now = 1.0; // and their derivatives
  double tilt = 0.5 * (piece->end - piece->begin - rise_of(piece));
  double sum = piece->begin + tilt * (t + 1.0);
  sum += piece->flat ? 0.0 : piece->mode[0] * (t + 1.0);
  *slope = tilt;
  for (int k = 1; k <= MODES; k++) {
    double next = ((2 * k + 1) * t * now - k * before) / (k + 1);
    if (piece->flat) {
      sum += piece->mode[k] * (now - (k % 2 == 0 ? 1.0 : -1.0));
      *slope += piece->mode[k] * slope_now;
    } else {
      sum += piece->mode[k] * (next - before) / (2 * k + 1);
    }
    double slope_next = slope_before + (2 * k + 1) * now;
    slope_before = slope_now;
    slope_now = slope_next;
    before = now;
    now = next;
  }
  return sum;
}

// Pressure gained between infinity and an end of the profile, where p' falls like |x|^-4.
static double gain_beyond(SbFilmSolver *solver, int which, const SbEhlCase *problem,
                          const Piece *piece, const double *excess, double t) {
  const SbEhlElement *e = &solver->mesh[which].element[piece->element];
  double r = piece->middle + piece->half * t;
  return reynolds_slope(solver, which, problem, piece->element, excess, r) / sb_ehl_stretch(e, r) *
         fabs(sb_ehl_position(e, r)) / 3.0;
}

// Strings the pieces' pressures together, from both ends of every full film to its thinnest piece:
// there a difference in pressure changes the flux least.
static void join(Piece *piece, int count, SbFilmSolver *solver, int which, const SbEhlCase *problem,
                 const double *excess) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  for (int first = 0, last; first < count; first = last + 1) {
    last = first;
    while (last + 1 < count && (piece[last + 1].element == piece[last].element ||
                                !mesh->element[piece[last + 1].element].apart)) {
      last++;
    }
    int thinnest = first;
    double least = INFINITY;
    for (int i = first; i <= last; i++) {
      const SbEhlElement *e = &mesh->element[piece[i].element];
      double thickest = 0.0;
      for (int k = 0; k < e->points; k++) {
        thickest = fmax(thickest, state->gap[e->first_row + k]);
      }
      if (thickest < least) {
        least = thickest;
        thinnest = i;
      }
    }
    const SbEhlElement *left = &mesh->element[piece[first].element];
    const SbEhlElement *right = &mesh->element[piece[last].element];
    double from = sb_ehl_pressure(mesh, &solver->tables, left, state->nodal, -1.0);
    if (left->map == SB_EHL_INLET) {
      from += gain_beyond(solver, which, problem, &piece[first], excess, -1.0);
    }
    for (int i = first; i <= thinnest; i++) {
      piece[i].begin = from;
      piece[i].end = from += rise_of(&piece[i]);
    }
    from = sb_ehl_pressure(mesh, &solver->tables, right, state->nodal, 1.0);
    if (right->map == SB_EHL_OUTLET) {
      from -= gain_beyond(solver, which, problem, &piece[last], excess, 1.0);
    }
    for (int i = last; i >= thinnest; i--) {
      piece[i].end = from;
      if (i > thinnest) {
        piece[i].begin = from -= rise_of(&piece[i]);
      }
    }
  }
}

// How far a liquid end at `ambient` is followed. Beyond X the pressure gains (4/3) lambda / X^3:
// the load left out shall be below 1e-6 of the whole and, in a profile to be recomputed from, the
// friction below some 2e-3 (its remainder goes with lambda^(1/4) / X), as long as steps of the
// pressure show beside the ambient one.
static double reach_of(double lambda, double ambient, bool drawn) {
  const double least = 3.0, digits = 1e-11, step = 0.02;
  double load = sqrt(2.0 / 3.0 * lambda / (0.5 * M_PI * 1e-6));
  double friction = 600.0 * pow(lambda, 0.25);
  double shown = cbrt(4.0 / 3.0 * lambda * step / (digits * fmax(ambient, 1e-12)));
  return fmax(fmax(least, load), drawn ? 0.0 : fmin(friction, shown));
}

// Rough rows: every element evenly, by its own polynomials.
static void fill_rough(SbFilm *out, SbFilmSolver *solver, int which, const SbEhlCase *c,
                       const SbFilmScale *scale) {
  enum { POINTS = 5200 }; // about
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  int per = POINTS / mesh->count;
  const SbEhlTable *table = sb_ehl_table(&solver->tables, mesh->element[0].degree);
  for (int k = 0; k <= per; k++) {
    double basis[SB_EHL_DEGREE_MAX + 1];
    double r = -1 + 2.0 * k / per;
    sb_barycentric_basis(basis, r, table->node, table->bary, table->degree + 1);
    for (int i = 0; i < (k > 0 ? mesh->count : 1); i++) {
      const SbEhlElement *e = &mesh->element[i];
      size_t n = (size_t)(i * per + k);
      double t = 0, q = 0;
      for (int j = 0; j <= table->degree; j++) {
        t += basis[j] * state->t[e->first_dof + j];
        q += basis[j] * state->nodal[e->first_dof + j];
      }
      SbEhlRoughPoint at;
      sb_ehl_rough_point(&at, c, t);
      sb_film_put(out, n, (sb_ehl_position(e, r) + state->shift) * scale->half_width,
                  (q + c->fluid.rupture) * scale->pressure, at.h * scale->film);
      out->asperity_pressure[n] = at.asperity * scale->pressure;
    }
  }
}

static void fill_smooth(SbFilm *out, SbFilmSolver *solver, int which, const SbEhlCase *problem,
                        const SbFilmScale *scale, const SbFilmProblem *wanted) {
  enum { LEAST = 4 }; // intervals of an element
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  const SbEhlElement *last = &mesh->element[mesh->count - 1];
  bool drawn = wanted->profile_points > 0;
  double lambda = problem->layers.lambda;
  double begin = mesh->element[0].map == SB_EHL_INLET
                     ? -1.0 - reach_of(lambda, problem->layers.inlet, drawn)
                     : mesh->element[0].x0;
  double end =
      last->map == SB_EHL_OUTLET ? 1.0 + reach_of(lambda, problem->layers.outlet, drawn) : last->x1;
  double room = SB_FILM_POINTS - (LEAST + 2) * 80;
  double limit = wanted->profile_points > 0 ? (double)wanted->profile_points : room;
  Spread spread = spread_points(mesh, &problem->layers, begin, end, fmin(limit, room));

  Piece *pieces = (void *)solver->matrix; // free between solves
  static_assert(PIECES_MAX * sizeof *pieces < SB_EHL_DOFS_MAX * SB_EHL_DOFS_MAX * sizeof(double),
                "the matrix holds the pieces");
  double *excess = solver->gaps;
  for (int i = 0; i < mesh->targets; i++) {
    excess[i] = state->gap[i] - sb_ehl_layers_dry_gap(&problem->layers, mesh->x[i]);
  }
  int count = cut_pieces(pieces, solver, which, problem, excess, begin, end);
  join(pieces, count, solver, which, problem, excess);

  size_t n = 0;
  for (int i = 0; i < count; i++) {
    const Piece *piece = &pieces[i];
    const SbEhlElement *e = &mesh->element[piece->element];
    double x0 = sb_ehl_position(e, piece->middle - piece->half);
    double x1 = sb_ehl_position(e, piece->middle + piece->half);
    double c0 = count_to(&spread, x0);
    double c1 = count_to(&spread, x1);
    size_t intervals = (size_t)fmax(ceil(c1 - c0), LEAST);
    double X = x0;
    for (size_t k = 0; k <= intervals; k++) {
      // Next place by two steps of Newton's method from the last one.
      double target = c0 + (c1 - c0) * (double)k / (double)intervals;
      double next = X;
      for (int pass = 0; pass < 2 && k > 0; pass++) {
        next += (target - count_to(&spread, next)) / density(&spread, next);
        next = fmin(fmax(next, X + 0.1 / density(&spread, X)), x1);
      }
      X = k == 0 ? x0 : k == intervals ? x1 : next;
      if (k == 0 && i > 0 && (piece[-1].element == piece->element || !e->apart)) {
        continue; // the joint has been written by the piece before
      }
      double t = (sb_ehl_coordinate(e, X) - piece->middle) / piece->half;
      t = k == 0 ? -1.0 : k == intervals ? 1.0 : fmin(fmax(t, -1.0), 1.0);
      double r = piece->middle + piece->half * t;
      double slope;
      double P = pressure_at(&slope, piece, t);
      double film = piece->flat ? sb_ehl_flat_film(problem, state->flux, state->flux, P,
                                                   slope / fmax(sb_ehl_stretch(e, r), 1e-300))
                                : gap_at(solver, which, problem, piece->element, excess, r);
      sb_film_put(out, n++, (X + state->shift) * scale->half_width,
                  (P + problem->fluid.rupture) * scale->pressure, film * scale->film);
    }
  }
}

void sb_ehl_profile(SbFilm *out, SbFilmSolver *solver, int which, const SbEhlCase *problem,
                    const SbFilmScale *scale, const SbFilmProblem *wanted) {
  if (wanted->profile == NULL) {
    return;
  }
  if (problem->rough.rows) {
    fill_rough(out, solver, which, problem, scale);
  } else {
    fill_smooth(out, solver, which, problem, scale, wanted);
  }
  if (wanted->speed < 0.0) {
    sb_film_mirror(out);
  }
}

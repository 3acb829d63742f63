// Meshes and starting guesses of the film solver.
//
// Thin films: Hertz's contact with two layers of width lambda^0.4 at its edges, where pressure
// scales with lambda^0.2 and film with lambda^0.6. Elements follow them; between them the cosine
// map takes steps that grow by a constant factor in theta. Thick films (M below about 4) live on
// the length of the rigid wedge, sqrt(2 H_min). The guess joins the layers' shapes, read off our
// own solution at M = 1e4, or takes the rigid wedge (thesis eq. 6.17-6.19). It only starts Newton's
// method: its digits do not reach the result.
#include "engine/film/ehl.h"

#include "engine/film/wedge.h"
#include "engine/numeric/root.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Shapes of the layers: distance from the edge over the layer's width, pressure over lambda^0.2,
// film over the flux film (in the inlet: its excess over the dry gap).
static const double inlet_z[] = {-100, -30, -10, -6,  -4, -3, -2, -1.5, -1, -0.5,
                                 0,    0.5, 1,   1.5, 2,  3,  4,  6,    10};
static const double inlet_p[] = {0.000053, 0.00061, 0.00539, 0.01436, 0.0301, 0.0492, 0.0919,
                                 0.1345,   0.2077,  0.3373,  0.5584,  0.8813, 1.2504, 1.5965,
                                 1.8965,   2.3857,  2.7837,  3.4347,  4.4484};
static const double inlet_h[] = {1.3,    1.4,    1.6957, 1.8636, 2.008,  2.111,  2.2458,
                                 2.325,  2.4026, 2.4414, 2.2531, 1.6869, 1.3937, 1.2529,
                                 1.1832, 1.1222, 1.096,  1.0717, 1.0517};
static const double outlet_z[] = {-10,  -6,   -4,   -3,   -2, -1.5, -1,  -0.7, -0.5,
                                  -0.4, -0.3, -0.2, -0.1, 0,  0.05, 0.1, 0.15, 0.16406};
static const double outlet_p[] = {4.4608, 3.4596, 2.827,  2.4497, 2.0018, 1.7367,
                                  1.4283, 1.192,  0.976,  0.8364, 0.6692, 0.4764,
                                  0.2759, 0.1082, 0.0508, 0.0151, 0.0006, 0.0};
static const double outlet_h[] = {0.9609, 0.9509, 0.9416, 0.9341, 0.9223, 0.9141,
                                  0.8999, 0.8764, 0.8465, 0.8276, 0.8091, 0.797,
                                  0.8024, 0.8402, 0.8755, 0.9228, 0.9819, 1.0};
enum {
  INLET_COUNT = sizeof inlet_z / sizeof inlet_z[0],
  OUTLET_COUNT = sizeof outlet_z / sizeof outlet_z[0]
};

// Films thicker than this layer width start from the rigid wedge and have its mesh.
static const double THICK = 0.86;

static const double MIDDLE = 0.6; // of the contact, theta from either edge

static double interpolate(double z, const double *node, const double *value, int count) {
  size_t i = sb_interval(node, (size_t)count, z);
  double t = (z - node[i]) / (node[i + 1] - node[i]);
  return value[i] + fmin(fmax(t, 0.0), 1.0) * (value[i + 1] - value[i]);
}

// A fitted body's dry pressure over Hertz's.
static double bowed(const SbEhlLayers *l, double X) {
  double sum = 1.0;
  double u = 1.0; // U_k
  double before = 0.0;
  for (int k = 0; k < SB_COMPLIANCE_PRESSURES; k++) {
    sum += l->bow[k] * u;
    double next = 2.0 * X * u - before;
    before = u;
    u = next;
  }
  return sum;
}

double sb_ehl_layers_inlet_slope(const SbEhlLayers *l) {
  return bowed(l, -1.0) - (l->inlet - l->outlet) / M_PI;
}

// The same at the outlet edge.
static double outlet_slope(const SbEhlLayers *l) {
  return bowed(l, 1.0) + (l->inlet - l->outlet) / M_PI;
}

// Starving thins the layers: film^2 slope / width^0.5 ~ lambda.
static double starved(const SbEhlLayers *l) {
  return pow(l->starvation, 1.5);
}

// Flux film over that which the outlet's own slope would carry, where end pressures that nearly
// open the inlet make it several times that and the film breaks behind it; else 1.
static double excess(const SbEhlLayers *l) {
  static const double SEVERAL = 4.0;
  const double flux = pow(outlet_slope(l) / sb_ehl_layers_inlet_slope(l), 0.8);
  return l->end == SB_EHL_RUPTURE && !(l->starvation < 1.0) && flux > SEVERAL ? flux : 1.0;
}

double sb_ehl_layers_width(const SbEhlLayers *l) {
  const double slope = pow(l->lambda, 0.4) * pow(sb_ehl_layers_inlet_slope(l), -1.2) * starved(l);
  // Where end pressures leave hardly any slope the gap opens by its next term, 0.2 of it per width.
  return excess(l) > 1.0 ? slope / hypot(1.0, slope / pow(pow(l->lambda, 0.4) * 6.9, 1.0 / 2.2))
                         : slope;
}

// A flux below what the outlet's own slope would carry narrows its layer as starving does, to the
// inlet's width. One above widens it: film^4/3 ~ slope^-4/3 lambda flux.
double sb_ehl_layers_outlet_width(const SbEhlLayers *l) {
  return pow(l->lambda, 0.4) * pow(fmax(sb_ehl_layers_inlet_slope(l), outlet_slope(l)), -1.2) *
         starved(l) * pow(excess(l), 0.25);
}

// Minimum film of the rigid wedge: h_min = 4.894968 R U / W.
static double rigid_film(const SbEhlLayers *l) {
  return 4.894968 * l->lambda / (6.0 * M_PI);
}

static SbWedgePools wedge_of(const SbEhlLayers *l) {
  return sb_wedge_pools(l->lambda, l->inlet, l->end == SB_EHL_RUPTURE ? 0.0 : l->outlet);
}

// Returns the length scale of a thick film: that of the rigid wedge between the end pressures, at
// least 1. Returns 0 if the film is thin.
static double wedge_length(const SbEhlLayers *l) {
  if (!(sb_ehl_layers_width(l) > THICK)) {
    return 0.0;
  }
  return hypot(1.2, wedge_of(l).length);
}

double sb_ehl_layers_flux(const SbEhlLayers *l) {
  double elastic = 0.44582 * pow(l->lambda, 0.6) * pow(sb_ehl_layers_inlet_slope(l), -0.8);
  double rigid = 1.225748 * rigid_film(l);
  return pow(pow(elastic, 1.4) + pow(rigid, 1.4), 1.0 / 1.4);
}

// Distance from the axis to the rupture, well enough to place the mesh.
static double rupture_guess(const SbEhlLayers *l) {
  double width = sb_ehl_layers_outlet_width(l), above = excess(l);
  double elastic = 1.0 + 0.16406 * width - 0.25 * fmin(width, 0.3) * width;
  if (above > 1.0) {
    // Part of the distance to where the dry gap equals the flux film, from our own solutions.
    double open = pow(sb_ehl_layers_flux(l) / (0.943 * outlet_slope(l)), 2.0 / 3.0);
    elastic = 1.0 + (1.0 - 0.73 * pow(above, -0.36)) * open;
  }
  if (sb_ehl_layers_width(l) <= THICK) {
    return elastic;
  }
  SbWedgePools wedge = wedge_of(l);
  double rigid = tan(wedge.end) * wedge.length + 0.8;
  elastic = 1.0 + 0.164 * width;
  return 1.0 / sqrt(1.0 / (elastic * elastic) + 1.0 / (rigid * rigid));
}

// Distance of the minimum film from the edge for a given slope at the edge, and position where the
// gap's next term matters because end pressures have nearly removed the slope.
static double place_by(double lambda, double slope) {
  double s = -log(slope);
  double thin = exp(-0.916 + 1.25 * s + 0.972 * (1.0 - exp(-1.8 * s)));
  thin *= 1.0 + 0.052 * exp(-pow(slope / 0.2466, 2.0));
  double slowing = cbrt(1.0 + pow(0.8 * thin, 3.0));
  return thin * pow(lambda, 0.4) / (1.0 + slowing * pow(lambda, 0.32));
}

static double place_of(double lambda, double slope) {
  enum { ROUNDS = 20 };
  static const double BENT = 0.041; // of thick films, in the opposite direction
  const double thick = (1.0 + BENT) / (1.0 + pow(lambda / 1.5e-4, 0.3268)) - BENT;
  const double next = 0.2439 * exp(-pow(slope / 0.2316, 1.136)) * thick;
  double place = place_by(lambda, slope);
  for (int i = 0; i < ROUNDS; i++) {
    place = 0.5 * (place + place_by(lambda, fmax(slope + next * place, 0.2 * slope)));
  }
  return place;
}

// Position of the minimum film before a flooded outlet, from our own solutions (M from 1.3 to 1e6,
// pressure differences up to 3.05 p_H): without pressure the layer is at the edge, higher outlet
// pressure moves it outwards, for thick films less. On a half-plane the slopes of the edges have
// the mean 1. Another mean K, of a fitted body, scales the pressure: the layers are those of
// lambda/K^3 (their widths) with the slopes divided by K.
double sb_ehl_layers_outlet(const SbEhlLayers *l) {
  if (l->end != SB_EHL_FULL) {
    return 1.0;
  }
  double K = 0.5 * (sb_ehl_layers_inlet_slope(l) + outlet_slope(l));
  double lambda = l->lambda / (K * K * K);
  return 1.0 + place_of(lambda, outlet_slope(l) / K) + l->moved * sb_ehl_layers_outlet_width(l);
}

// Length over which the gap opens behind a flooded outlet: the flux film against the dry gap.
static double opening(const SbEhlLayers *l) {
  double film = pow(sb_ehl_layers_inlet_slope(l), -0.8);
  return fmax(sb_ehl_layers_outlet_width(l),
              pow(l->lambda, 0.4) * pow(film / outlet_slope(l), 2.0 / 3.0));
}

// Edge of the contact that the outlet layer's shape belongs to.
static double outlet_edge(const SbEhlLayers *l) {
  return l->end == SB_EHL_FULL ? sb_ehl_layers_outlet(l) + 0.17 * sb_ehl_layers_outlet_width(l)
                               : 1.0;
}

// A flooded outlet: elements of growing size up to `reach`, then the infinite one.
static void add_outlet(SbEhlMesh *mesh, double unit, double reach, int degree) {
  static const double step[] = {0.4, 1.5, 4.0};
  const double from = mesh->end;
  for (int i = 0; i < 3 || mesh->end - from < reach; i++) {
    double end = i < 3 ? from + unit * step[i] : from + 2.5 * (mesh->end - from);
    sb_ehl_mesh_add(mesh, SB_EHL_AFFINE, end, degree + 4);
  }
  sb_ehl_mesh_add_far(mesh, 1, mesh->end, 1.125 * (mesh->end - from), degree + 4);
}

// Elements on the scale of the rigid wedge, up to the rupture. For a film without a cavity they are
// mirrored about the axis: its pressure is nearly odd, and its load is the small remainder, which
// the discretisation error must not change.
static void thick_mesh(SbEhlMesh *mesh, const SbEhlLayers *l) {
  static const double broken[] = {-5.0, -2.6, -1.9, -1.3, -0.75, -0.35, -0.1, 0.0};
  static const double mirrored[] = {-4.0, -2.0, -1.2, -0.7, -0.3, 0.3, 0.7, 1.2, 2.0, 4.0};
  const bool full = l->end == SB_EHL_FULL;
  const double *step = full ? mirrored : broken;
  const size_t count = full ? sizeof mirrored / sizeof *step : sizeof broken / sizeof *step;
  const double origin = full ? 0.0 : rupture_guess(l);
  const double unit = wedge_length(l);
  sb_ehl_mesh_add_far(mesh, -1, origin + unit * step[0], unit, l->degree);
  for (size_t i = 1; i < count; i++) {
    sb_ehl_mesh_add(mesh, SB_EHL_AFFINE, origin + unit * step[i], l->degree);
  }
  if (full) {
    sb_ehl_mesh_add_far(mesh, 1, mesh->end, unit, l->degree);
  }
}

// Inlet and its layer: higher degree, as the flux there is a small difference. From a meniscus on
// five elements, evenly in asinh z.
static void add_inlet(SbEhlMesh *mesh, const SbEhlLayers *l) {
  enum { COUNT = 5 };
  static const double step[] = {-1.0, 1.5, 4.0};
  double in = sb_ehl_layers_width(l);
  if (isfinite(l->meniscus)) {
    double last = fmin(-1.0 + 4.0 * in, 0.0);
    double begin = asinh((l->meniscus + 1.0) / in);
    double end = asinh((last + 1.0) / in);
    for (int i = 1; i <= COUNT; i++) {
      double x = -1.0 + in * sinh(begin + (end - begin) * i / COUNT);
      sb_ehl_mesh_add(mesh, SB_EHL_AFFINE, i == COUNT ? last : x, l->degree);
    }
    return;
  }
  sb_ehl_mesh_add_far(mesh, -1, -1.0 - 4.0 * in, 4.5 * in, l->degree + 4);
  for (int i = 0; i < 3 && (i == 0 || -1.0 + in * step[i] < 0.3); i++) {
    sb_ehl_mesh_add(mesh, SB_EHL_AFFINE, -1.0 + in * step[i], l->degree + 4);
  }
}

// Element ends of the outlet's layer from the left; their number.
static int outlet_ends(double *right, int most, const SbEhlLayers *l, double from) {
  static const double step[] = {-8.0, -2.5, -0.8, -0.1};
  double in = sb_ehl_layers_width(l);
  double out = sb_ehl_layers_outlet_width(l);
  bool full = l->end == SB_EHL_FULL;
  double edge = sb_ehl_layers_outlet(l);
  double last = full ? edge : rupture_guess(l);
  int count = 0;
  for (int i = 0; i < (full ? 3 : 4); i++) {
    double x = edge + out * step[i];
    // A starved film near M = 1 breaks before the last of them.
    if (x > from + 0.6 * fmax(in, out) && x > (i == 0 ? 0.05 : -0.3) && x < last - 0.1 * out) {
      right[count++] = x;
    }
  }
  right[count++] = last;
  // A layer pushed out of the dry contact: elements back into it, each twice as far from the edge.
  while (full && right[0] > 1.0 - out && count < most) {
    memmove(&right[1], &right[0], (size_t)count++ * sizeof right[0]);
    double back = fmax(2.2 * (edge - right[0]), -step[2] * out);
    right[0] = fmax(edge - back, 0.5 * (from + right[0]));
  }
  return count;
}

// The i-th of `steps` places in theta that grow from a layer at `begin` to the middle.
static double inner_step(double begin, int i, int steps) {
  return begin * pow(MIDDLE / begin, steps > 0 ? (double)i / steps : 0.0);
}

// How many there are, fourfold each.
static int inner_steps(double begin) {
  return begin < MIDDLE ? (int)ceil(log(MIDDLE / begin) / log(4.0)) : 0;
}

// Elements that follow the two layers.
static void thin_mesh(SbEhlMesh *mesh, const SbEhlLayers *l) {
  enum { RIGHTS_MAX = 8 };
  double right[RIGHTS_MAX];
  add_inlet(mesh, l);
  int rights = outlet_ends(right, RIGHTS_MAX, l, mesh->end);
  // Inside the contact, steps growing from both layers to the middle.
  const double begin = acos(-mesh->end), end = acos(right[0]);
  const int before = inner_steps(begin), inner = before + 1 + inner_steps(end);
  SbEhlMap map = sb_ehl_layers_width(l) > 0.25 ? SB_EHL_AFFINE : SB_EHL_COSINE;
  double theta = begin;
  // A film that end pressures drive thins all along the contact.
  const double most = excess(l) > 1.0 ? 0.4 : M_PI;
  for (int i = 1; i <= inner; i++) {
    double last = theta;
    theta = i <= before ? inner_step(begin, i, before)
                        : M_PI - inner_step(end, inner - i, inner - before - 1);
    // The widest element is over the middle; a higher degree resolves the film between its points.
    int degree = l->degree + (theta - last > 0.8 ? 6 : 4);
    const int parts = (int)ceil((theta - last) / most);
    for (int k = 1; k <= parts; k++) {
      double to = last + (theta - last) * k / parts;
      sb_ehl_mesh_add(mesh, map, i == inner && k == parts ? right[0] : -cos(to),
                      degree < SB_EHL_DEGREE_MAX ? degree : SB_EHL_DEGREE_MAX);
    }
  }
  for (int i = 1; i < rights; i++) {
    sb_ehl_mesh_add(mesh, SB_EHL_AFFINE, right[i], l->degree);
  }
}

bool sb_ehl_layers_mesh(SbEhlSolution *s) {
  SbEhlMesh *mesh = &s->mesh;
  const SbEhlLayers *l = &s->c.layers;
  const double wedge = isfinite(l->meniscus) ? 0.0 : wedge_length(l);
  sb_ehl_mesh_begin(mesh, l->meniscus, l->inlet, l->outlet);
  (wedge > 0.0 ? thick_mesh : thin_mesh)(mesh, l);
  if (l->end == SB_EHL_FULL && !(wedge > 0.0)) {
    add_outlet(mesh, sb_ehl_layers_outlet_width(l), 2.0 * opening(l), l->degree);
  } else if (l->end == SB_EHL_REFORM) {
    double unit = wedge > 0.0 ? 0.3 * wedge : sb_ehl_layers_outlet_width(l);
    mesh->end = l->reform;
    mesh->apart = true;
    add_outlet(mesh, 0.5 * unit + 0.5 * fmax(l->reform - rupture_guess(l), 0.0), 0.0, l->degree);
  }
  return sb_ehl_mesh_build(mesh, false);
}

double sb_ehl_layers_dry_pressure(const SbEhlLayers *l, double X) {
  double inside = fmin(fmax(X, -1.0), 1.0);
  return sqrt((1.0 - inside) * (1.0 + inside)) * bowed(l, inside) +
         sb_film_ends(X, l->inlet, l->outlet);
}

double sb_ehl_layers_dry_gap(const SbEhlLayers *l, double X) {
  double a = fabs(X);
  if (a <= 1.0) {
    return 0.0;
  }
  double bend = (l->inlet - l->outlet) / M_PI * (a * acosh(a) - sqrt((a - 1.0) * (a + 1.0)));
  double edge = bowed(l, X < 0.0 ? -1.0 : 1.0);
  return fmax(edge * sb_film_dry_gap(X) + (X < 0.0 ? -bend : bend), 0.0);
}

void sb_ehl_layers_shape(double *pressure, double *film, const SbEhlLayers *l, double flux,
                         double X) {
  double in = sb_ehl_layers_width(l);
  double out = sb_ehl_layers_outlet_width(l);
  double inside = fmin(fmax(X, -1.0), 1.0);
  double ends = sb_film_ends(X, l->inlet, l->outlet);
  if (X < 0.0) {
    double z = (X + 1.0) / in;
    double p = z > 10.0     ? sqrt(2.0 * z)
               : z < -100.0 ? 0.53 / (z * z)
                            : interpolate(z, inlet_z, inlet_p, INLET_COUNT);
    *pressure = ends + sqrt(in) * p * sqrt(0.5 * (1.0 - X)) * bowed(l, inside);
    *film = sb_ehl_layers_dry_gap(l, X) + flux * interpolate(z, inlet_z, inlet_h, INLET_COUNT);
  } else {
    double z = (X - outlet_edge(l)) / out;
    double p = z < -10.0 ? sqrt(-2.0 * z) : interpolate(z, outlet_z, outlet_p, OUTLET_COUNT);
    *pressure = ends + sqrt(out) * p * sqrt(0.5 * (1.0 + fmin(X, 1.0))) * bowed(l, inside);
    if (l->end == SB_EHL_FULL) { // the layer is outside the edge: on the dry pressure there
      double edge = sqrt(2.0 * (1.0 - inside));
      *pressure = sb_ehl_layers_dry_pressure(l, X) + outlet_slope(l) * (sqrt(out) * p - edge);
    }
    *film = flux * interpolate(z, outlet_z, outlet_h, OUTLET_COUNT);
    if (z > 0.16406) {
      *film += sb_ehl_layers_dry_gap(l, X);
    }
  }
}

// Pressure that a film formed again gains from X to infinity, by Reynolds' equation on the dry gap
// well enough to start from: lambda / h^2 over the length on which the gap opens, 1/2 of the
// product behind the contact's edge, 1/3 far away.
static double gain(const SbEhlLayers *l, double flux, double X) {
  double film = flux + sb_ehl_layers_dry_gap(l, X);
  return 0.4 * l->lambda * (sqrt(2.0 * flux) + X - rupture_guess(l)) / (film * film);
}

typedef struct {
  const SbEhlLayers *layers;
  double flux;
} Reform;

static double excess_gain(double X, const void *context) {
  const Reform *r = context;
  return gain(r->layers, r->flux, X) - r->layers->outlet;
}

double sb_ehl_layers_reform(const SbEhlLayers *l) {
  double begin = rupture_guess(l);
  if (sb_ehl_layers_width(l) > THICK) {
    SbWedgePools wedge = wedge_of(l);
    return begin + (tan(wedge.reform) - tan(wedge.end)) * wedge.length;
  }
  double reach = 10.0 * (sqrt(1.44 + 0.52 * l->lambda) + cbrt(l->lambda / l->outlet));
  return sb_bisect(excess_gain, &(Reform){l, sb_ehl_layers_flux(l)}, begin, begin + reach);
}

// Start of pressure and gap at X in an element: by the rigid wedge where the film is thick, else by
// the joined layers, behind a cavity by what the film gains there.
static void start_at(double *pressure, double *film, const SbEhlSolution *s,
                     const SbWedgePools *wedge, int element, double X) {
  const SbEhlLayers *l = &s->c.layers;
  if (wedge != NULL) {
    double x = X + s->state.shift - l->middle;
    *pressure = sb_wedge_pools_pressure(wedge, x);
    *film = wedge->film + 0.5 * x * x;
  } else if (element > s->mesh.film_end) {
    *pressure = l->outlet - gain(l, s->state.flux, X);
    *film = s->state.flux + sb_ehl_layers_dry_gap(l, X);
  } else {
    sb_ehl_layers_shape(pressure, film, l, s->state.flux, X);
  }
}

void sb_ehl_layers_guess(SbEhlSolution *s) {
  const SbEhlLayers *l = &s->c.layers;
  const bool thick = sb_ehl_layers_width(l) > THICK;
  const SbWedgePools wedge = wedge_of(l);
  const bool broken = thick && l->end != SB_EHL_FULL;
  s->state.H0 = 0.0;
  s->state.flux = thick ? wedge.stretch * wedge.film : sb_ehl_layers_flux(l);
  s->state.shift = l->middle + (broken ? tan(wedge.end) * wedge.length - rupture_guess(l) : 0.0);
  const SbEhlMesh *mesh = &s->mesh;
  double pressure, film;
  for (int i = 0; i < mesh->count; i++) {
    const SbEhlElement *e = &mesh->element[i];
    for (int k = 0; k <= e->degree; k++) {
      start_at(&pressure, &film, s, thick ? &wedge : NULL, i, sb_ehl_node(e, k));
      s->state.nodal[e->first_dof + k] = sb_ehl_nodal(e, k, pressure);
    }
  }
  for (int i = 0; i < mesh->targets; i++) {
    start_at(&pressure, &s->state.gap[i], s, thick ? &wedge : NULL, mesh->owner[i], mesh->x[i]);
  }
}

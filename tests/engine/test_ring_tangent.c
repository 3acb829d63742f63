// Rings beside a solved one, to first order: against bodies that scale, against solved ones where
// both ends have the base's active set, and where they have another.
#include "engine/contact/fit.h"
#include "engine/contact/ring/ring_private.h"

#include <glib.h>
#include <math.h>

typedef struct {
  double coefficient, strength;
} Law;

// As a seal's friction, that bends where the pressure cannot bear the strength.
static double shear(double pressure, double *slope, const void *data) {
  const Law *law = data;
  const bool limited = pressure < law->strength;
  *slope = law->coefficient + (limited ? 1 : 0);
  return law->coefficient * pressure + (limited ? pressure : law->strength);
}

typedef struct {
  double pressure, floor, wall;
  Law law;
} Case;

typedef struct {
  SbRing *ring;
  SbRingTangent *tangent;
  SbRingBody body;
  SbRingLoad load;
  SbRingOptions options;
} Base;

static void set_up(Base *base, const Case *of) {
  const SbFitProblem problem = {.model = SB_FIT_RING,
                                .section_diameter = 1.61e-3,
                                .inner_diameter = 2.84e-3,
                                .modulus = 2.5e6,
                                .poisson_ratio = 0.49,
                                .radial_space = 1.36e-3,
                                .bore_diameter = 6e-3,
                                .gland_width = 2.1e-3,
                                .pressure = of->pressure,
                                .tolerance = 3e-3,
                                .dragged = true,
                                .drag = 1,
                                .floor_friction = of->floor,
                                .wall_friction = of->wall,
                                .shear = shear,
                                .law = &of->law,
                                .kept = &base->ring};
  SbFit *fit = g_new0(SbFit, 1);
  *base = (Base){0};
  g_assert_cmpint(sb_fit_solve(fit, &problem, NULL), ==, SB_OK);
  g_assert_cmpint(fit->ring.state, ==, SB_RING_SLIDES);
  g_free(fit);
  sb_fit_ring_problem(&base->body, &base->load, &problem);
  g_assert_cmpint(sb_ring_tangent_create(&base->tangent, base->ring, &of->law, NULL), ==, SB_OK);
}

static void clear(Base *base) {
  sb_ring_tangent_destroy(base->tangent);
  sb_ring_destroy(base->ring);
}

static SbRing *beside(const Base *base, const SbRingBody *body, const SbRingLoad *load) {
  SbRing *ring;
  g_assert_cmpint(sb_ring_tangent_at(&ring, base->tangent, body, load, &base->options, NULL), ==,
                  SB_OK);
  return ring;
}

static double load_of(const SbRing *ring) {
  SbRingResult result;
  sb_ring_result(ring, &result);
  return result.bore_force;
}

// At the base the base; a stiffer body bears as much more, a larger one with the square.
static void test_scales(void) {
  const Case smooth = {0, 0, 0, {0.1, 0}};
  const double more = 1e-3;
  Base base;
  set_up(&base, &smooth);
  SbRing *same = beside(&base, &base.body, &base.load);
  const double load = load_of(same);
  g_assert_cmpfloat(fabs(load / load_of(base.ring) - 1), <, 1e-7); // ends found by comparing
  SbRingBody body = base.body;
  SbRingLoad larger = base.load;
  body.modulus *= 1 + more;
  SbRing *other = beside(&base, &body, &base.load);
  g_assert_cmpfloat(fabs(load_of(other) / load - 1 - more), <, 1e-9);
  sb_ring_destroy(other);
  body = base.body;
  body.section_diameter *= 1 + more;
  body.inner_diameter *= 1 + more;
  larger.bore_radius *= 1 + more;
  larger.floor_radius *= 1 + more;
  larger.wall_left *= 1 + more;
  larger.wall_right *= 1 + more;
  other = beside(&base, &body, &larger);
  g_assert_cmpfloat(fabs(load_of(other) / load - (1 + more) * (1 + more)), <, 1e-9);
  sb_ring_destroy(other);
  sb_ring_destroy(same);
  clear(&base);
}

// What is changed: of the body or of the load.
enum { FLOOR, PRESSURE, MODULUS, SECTION, BORE, POISSON, CHANGES };

static void change(SbRingBody *body, SbRingLoad *load, const Base *base, int what, double by) {
  *body = base->body;
  *load = base->load;
  const double space = load->bore_radius - load->floor_radius;
  load->floor_radius += what == FLOOR ? by * space : 0;
  load->bore_radius += what == BORE ? by * space : 0;
  load->pressure_left *= what == PRESSURE ? 1 + by : 1;
  body->modulus *= what == MODULUS ? 1 + by : 1;
  body->section_diameter *= what == SECTION ? 1 + by : 1;
  body->poisson_ratio *= what == POISSON ? 1 + by : 1;
}

// Nodal forces of the bore's contact, their sum, in the ring's own units.
static double nodal_load(const SbRing *ring) {
  double sum = 0;
  for (int i = 0; i < ring->contact->count; i++) {
    sum += sb_ring_touch(ring->contact, i, SB_RING_BORE)->force;
  }
  return sum;
}

static bool same_set(const SbRing *a, const SbRing *b) {
  bool same = a->contact->count == b->contact->count;
  for (int i = 0; same && i < SB_RING_SURFACES * a->contact->count; i++) {
    const SbRingTouch *p = &a->contact->is.touch[i], *q = &b->contact->is.touch[i];
    same = p->held == q->held && p->slip == q->slip;
  }
  return same;
}

typedef struct {
  double solved, tangent, fault; // slopes of the nodal load; fault of the set over the step
  double load;
  bool same; // both ends have the base's set
} Slopes;

static void slopes(Slopes *out, const Base *base, int what, double h) {
  double solved[2], tangent[2];
  *out = (Slopes){.same = true};
  for (int side = 0; side < 2; side++) {
    SbRingBody body;
    SbRingLoad load;
    SbRing *near;
    SbRingResult result;
    change(&body, &load, base, what, side == 0 ? h : -h);
    g_assert_cmpint(sb_ring_near(&near, base->ring, &body, &load, &base->options, NULL), ==, SB_OK);
    SbRing *linear = beside(base, &body, &load);
    sb_ring_result(linear, &result);
    out->same = out->same && same_set(near, base->ring);
    out->fault += result.fault / h / 2;
    solved[side] = nodal_load(near);
    tangent[side] = nodal_load(linear);
    out->load = tangent[side];
    sb_ring_destroy(linear);
    sb_ring_destroy(near);
  }
  out->solved = (solved[0] - solved[1]) / (2 * h);
  out->tangent = (tangent[0] - tangent[1]) / (2 * h);
}

// In a smooth groove small changes leave the active set: the slopes of solved rings are the
// tangent's, by Coulomb's law under fluid and by one that bends in the dry.
static void test_held(void) {
  static const Case cases[] = {{5.5e5, 0, 0, {0.1, 0}}, {0, 0, 0, {0.1, 1.5e5}}};
  for (size_t c = 0; c < G_N_ELEMENTS(cases); c++) {
    Base base;
    set_up(&base, &cases[c]);
    for (int what = 0; what < CHANGES; what++) {
      Slopes is;
      slopes(&is, &base, what, 1e-6);
      g_test_message("case %zu, change %d: %.9g, solved %.9g", c, what, is.tangent, is.solved);
      g_assert_true(is.same);
      g_assert_cmpfloat(is.fault, ==, 0);
      // Of the solved rings' own rounding, 1e-11 of the load over the step.
      g_assert_cmpfloat(fabs(is.solved - is.tangent), <=, 1e-5 * fabs(is.tangent) + 1e-6);
      g_assert_true(what == PRESSURE || what == MODULUS || fabs(is.tangent) > 1);
    }
    clear(&base);
  }
}

// On a rough floor nodes that slide in the base stick as soon as the change leads them back, on one
// side or the other: slopes of solved rings then are others, by some of what violates the set.
static void test_slips(void) {
  static const Case cases[] = {{5.5e5, 0.3, 0.1, {0.2, 1.5e5}}, {0, 0.3, 0, {0.2, 0}}};
  static const double TIMES = 3, LEAST = 2e-3;
  int others = 0;
  for (size_t c = 0; c < G_N_ELEMENTS(cases); c++) {
    Base base;
    set_up(&base, &cases[c]);
    for (int what = 0; what < CHANGES; what++) {
      Slopes is;
      slopes(&is, &base, what, 1e-6);
      g_test_message("case %zu, change %d: %.6g, solved %.6g, fault %.2g", c, what, is.tangent,
                     is.solved, is.fault);
      others += !is.same;
      g_assert_true(is.same || is.fault > 0);
      g_assert_cmpfloat(fabs(is.solved - is.tangent), <=,
                        TIMES * is.fault * is.load + (is.same ? 1e-5 : LEAST) * fabs(is.tangent) +
                            1e-6);
    }
    clear(&base);
  }
  g_assert_cmpint(others, >, 0);
}

// What rolls, or slides the other way, is none of its states.
static void test_refused(void) {
  const Case smooth = {0, 0, 0, {0.1, 0}};
  Base base;
  SbRing *ring;
  SbReport report;
  set_up(&base, &smooth);
  SbRingLoad back = base.load;
  back.bore_slides = -back.bore_slides;
  g_assert_cmpint(
      sb_ring_tangent_at(&ring, base.tangent, &base.body, &back, &base.options, &report), ==,
      SB_ERROR_NOT_CONVERGED);
  g_assert_null(ring);
  back = base.load;
  back.bore_radius = back.floor_radius;
  g_assert_cmpint(
      sb_ring_tangent_at(&ring, base.tangent, &base.body, &back, &base.options, &report), ==,
      SB_ERROR_INFEASIBLE);
  clear(&base);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/ring-tangent/scales", test_scales);
  g_test_add_func("/ring-tangent/held", test_held);
  g_test_add_func("/ring-tangent/slips", test_slips);
  g_test_add_func("/ring-tangent/refused", test_refused);
  return g_test_run();
}

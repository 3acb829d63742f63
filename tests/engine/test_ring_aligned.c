// Contact ends as unknowns (ring_aligned.h) against the limits that finer meshes and an independent
// solver of another order agree on.
#include "near.h"
#include "ring_aligned.h"
#include "seals.h"

#include <math.h>
#include <stdlib.h>

// The outer seal of the thesis' valve under `pressure`, dragged by `drag` times its load, on a mesh
// of elements of `size` in its contacts and a twentieth of it at their ends.
static SbRing *solved(double pressure, double drag, double rough, double size) {
  SbRingLoad load = open_groove();
  SbReport report = {0};
  load.pressure_left = pressure;
  load.wall_right = pressure > 0.0 ? 1e-3 : INFINITY;
  if (drag != 0.0) {
    load.wall_left = -1e-3;
    load.bore_slides = drag > 0.0 ? 1 : -1;
    load.friction_bore = fabs(drag);
    load.friction_floor = 3.0 * rough;
    load.friction_wall = rough;
  }
  const SbRingOptions options = {.element_size = 0.05, .fit_mesh = true};
  SbRing *ring;
  g_assert_cmpint(sb_ring_create(&ring, &BODY, &load, &options, &report), ==, SB_OK);
  for (int i = 0; i < 2; i++) {
    SbRing *fitted;
    g_assert_cmpint(sb_ring_create_like(&fitted, ring, &report), ==, SB_OK);
    g_assert_cmpint(sb_ring_remesh(fitted, ring, size, 0.05, &report), ==, SB_OK);
    sb_ring_destroy(ring);
    ring = fitted;
  }
  return ring;
}

// A solved state with its results.
typedef struct {
  SbRing *ring;
  AlignedRing *aligned;
  double out[ALIGNED_RESULTS];
} Case;

static Case align(double pressure, double drag, double rough, double size) {
  Case c = {.ring = solved(pressure, drag, rough, size)};
  c.aligned = aligned_create(c.ring, drag);
  g_assert_nonnull(c.aligned);
  const int iterations = aligned_solve(c.aligned);
  g_assert_cmpint(iterations, >=, 0);
  g_assert_cmpint(iterations, <=, 8);
  aligned_results(c.aligned, c.out);
  g_test_message("%.2f MPa, drag %.2f, %d unknowns: %d iterations, load %.6f N, width %.6f mm",
                 1e-6 * pressure, drag, 2 * c.ring->mesh->nodes, iterations, c.out[ALIGNED_LOAD],
                 1e3 * c.out[ALIGNED_WIDTH]);
  double tension, penetration;
  aligned_faults(c.aligned, &tension, &penetration);
  g_assert_cmpfloat(tension, <, 1e-2);
  g_assert_cmpfloat(penetration, <, 1e-5);
  return c;
}

static void end(Case *c) {
  aligned_destroy(c->aligned);
  sb_ring_destroy(c->ring);
}

// Limits by elements of order 8: 4.771196 N, width 0.55445 mm (known to 1e-4), root 1.535 +- 0.003.
static void dry(void) {
  Case c = align(0.0, 0.0, 0.0, 0.05);
  double root[2];
  assert_close(c.out[ALIGNED_LOAD], 4.771196, 3e-4);
  assert_close(c.out[ALIGNED_WIDTH], 0.55445e-3, 5e-4);
  assert_close(c.out[ALIGNED_FLOOR], 4.446030, 3e-4);
  g_assert_true(aligned_roots(c.aligned, root));
  assert_close(root[0], 1.535, 0.015);
  assert_close(root[1], root[0], 1e-6);
  end(&c);
}

// 13.491 N (known to 0.002 N); the wall carries p pi (r_bore^2 - r_floor^2).
static void pressed(void) {
  Case c = align(0.55e6, 0.0, 0.0, 0.05), fine = align(0.55e6, 0.0, 0.0, 0.025);
  double root[2], other[2];
  assert_close(c.out[ALIGNED_LOAD], 13.491, 2e-4);
  assert_close(fine.out[ALIGNED_LOAD], c.out[ALIGNED_LOAD], 2e-4);
  assert_close(aligned_force(c.aligned, SB_RING_WALL_RIGHT), 0.55 * M_PI * (9.0 - 1.64 * 1.64),
               1e-9);
  g_assert_true(aligned_roots(c.aligned, root) && aligned_roots(fine.aligned, other));
  assert_close(root[0], other[0], 0.01);
  assert_close(root[1], other[1], 0.01);
  end(&c);
  end(&fine);
}

// Drag is the coefficient times the load to rounding, and loads are those of elements of order 5.
static void dragged(void) {
  static const double table[][2] = {
      {0.1, 14.9761}, {0.2, 16.9513}, {0.3, 19.8921}, {-0.1, 12.3149}};
  for (size_t i = 0; i < G_N_ELEMENTS(table); i++) {
    Case c = align(0.55e6, table[i][0], 0.1, 0.05);
    assert_close(c.out[ALIGNED_LOAD], table[i][1], 2e-3);
    assert_close(c.out[ALIGNED_DRAG], fabs(table[i][0]) * c.out[ALIGNED_LOAD], 1e-12);
    end(&c);
  }
}

// One back-substitution gives the slopes of full solves, also with the friction's history.
static void slopes(void) {
  Case c = align(0.55e6, 0.1, 0.1, 0.05);
  for (int input = 0; input < ALIGNED_INPUTS; input++) {
    double slope[ALIGNED_RESULTS], at[2][ALIGNED_RESULTS];
    g_assert_true(aligned_slopes(c.aligned, (AlignedInput)input, slope));
    for (int s = 0; s < 2; s++) {
      const double change = s == 0 ? -0.01 : 0.01;
      g_assert_cmpint(aligned_solve_at(c.aligned, (AlignedInput)input, change, at[s]), >, 0);
    }
    for (int q = 0; q < ALIGNED_RESULTS; q++) {
      const double central = (at[1][q] - at[0][q]) / (0.02 * c.out[q]);
      g_test_message("input %d, result %d: %.5f, %.5f by full solves", input, q, slope[q], central);
      g_assert_cmpfloat(fabs(slope[q] - central), <, 1e-4);
    }
  }
  end(&c);
}

// What became of random rings that the usual solver solves.
typedef struct {
  int solved, failed, faulty, iterations, most;
  double moved;
} Tally;

// Places the ends of a ring that the usual solver has solved on a fitted mesh.
static void count_ring(Tally *tally, SbRing *ring, double drag, int number) {
  double out[ALIGNED_RESULTS], tension, penetration;
  SbRingResult usual;
  sb_ring_result(ring, &usual);
  AlignedRing *aligned = aligned_create(ring, drag);
  const int iterations = aligned != NULL ? aligned_solve(aligned) : -1;
  tally->solved++;
  if (iterations < 0) {
    tally->failed++;
    g_test_message("%d: not solved, usual load %.4f N", number, usual.bore_force);
  } else {
    aligned_results(aligned, out);
    aligned_faults(aligned, &tension, &penetration);
    const double change = fabs(out[ALIGNED_LOAD] / usual.bore_force - 1.0);
    tally->moved = fmax(tally->moved, change);
    tally->most = MAX(tally->most, iterations);
    tally->iterations += iterations;
    // Nodal forces next to an end waver by up to 0.08 shear moduli; a contact that is missing
    // penetrates by more than 1e-4 diameters.
    if (tension > 0.1 || penetration > 1e-4 || change > 0.01) {
      tally->faulty++;
      g_test_message("%d: load moved by %.2g, tension %.2g, penetration %.2g", number, change,
                     tension, penetration);
    }
  }
  if (aligned != NULL) {
    aligned_destroy(aligned);
  }
}

// Solves as usual, on a mesh fitted to the contacts too, and places the ends.
static void count_solved(Tally *tally, const SbRingBody *body, const SbRingLoad *load, double drag,
                         int number) {
  const SbRingOptions options = {.element_size = 0.05, .fit_mesh = true};
  SbRing *ring, *fitted;
  SbRingResult usual;
  if (sb_ring_create(&ring, body, load, &options, NULL) != SB_OK) {
    return;
  }
  sb_ring_result(ring, &usual);
  g_assert_cmpint(sb_ring_create_like(&fitted, ring, NULL), ==, SB_OK);
  if (usual.touching && usual.state == SB_RING_SLIDES &&
      sb_ring_remesh(fitted, ring, 0.05, 0.05, NULL) == SB_OK) {
    count_ring(tally, fitted, drag, number);
  }
  sb_ring_destroy(fitted);
  sb_ring_destroy(ring);
}

static void check_tally(const Tally *tally, int count) {
  g_test_message("%d of %d rings solved as usual, of which %d not with ends as unknowns, %d with "
                 "faults; %.2f iterations, at most %d; loads moved by at most %.2g",
                 tally->solved, count, tally->failed, tally->faulty,
                 (double)tally->iterations / MAX(1, tally->solved - tally->failed), tally->most,
                 tally->moved);
  g_assert_cmpint(tally->failed + tally->faulty, <=, count / 50);
}

static double draw(GRand *random, double from, double to) {
  return from + (to - from) * g_rand_double(random);
}

// Random glands, half of them under fluid and half dragged.
static void random_glands(int first, int count) {
  Tally tally = {0};
  for (int number = first; number < first + count; number++) {
    GRand *random = g_rand_new_with_seed((guint32)number);
    const double d = BODY.section_diameter, squeeze = draw(random, 0.03, 0.32);
    SbRingBody body = BODY;
    SbRingLoad load = SB_RING_LOAD_INIT;
    body.inner_diameter = d * draw(random, 1.2, 6.0);
    body.poisson_ratio = draw(random, 0.45, 0.495);
    load.floor_radius = 0.5 * body.inner_diameter * draw(random, 1.02, 1.12);
    load.bore_radius = load.floor_radius + d * (1.0 - squeeze);
    load.pressure_left = fmax(0.0, draw(random, -0.5, 0.5) * body.modulus);
    load.wall_right = 0.75 * d;
    const double drag = number % 2 != 0 ? draw(random, -0.3, 0.3) : 0.0;
    if (drag != 0.0) {
      load.wall_left = -load.wall_right;
      load.bore_slides = drag > 0.0 ? 1 : -1;
      load.friction_bore = fabs(drag);
      load.friction_floor = load.friction_wall = draw(random, 0.0, 1.0) < 0.5 ? 0.0 : 0.4;
    }
    g_rand_free(random);
    count_solved(&tally, &body, &load, drag, number);
  }
  check_tally(&tally, count);
}

// Random sections that are no circles, half of them under fluid.
static void random_profiles(int first, int count) {
  Tally tally = {0};
  for (int number = first; number < first + count; number++) {
    GRand *random = g_rand_new_with_seed((guint32)number);
    const double h = 1.6e-3;
    SbRingBody body = BODY;
    SbRingLoad load = open_groove();
    SbSealProfile *p = &body.profile;
    p->kind = (SbSealProfileKind)g_rand_int_range(random, 1, 6);
    p->axial_height = h * draw(random, 0.5, 1.6);
    p->corner_radius =
        p->kind == SB_SEAL_PROFILE_X ? h * draw(random, 0.12, 0.26) : h * draw(random, 0.04, 0.12);
    p->valley_depth = h * draw(random, 0.04, 0.14);
    p->web_width = p->axial_height * draw(random, 0.4, 0.8);
    p->flange_height = h * draw(random, 0.3, 0.5);
    p->lip_thickness = h * draw(random, 0.2, 0.3);
    p->lip_depth = p->axial_height * draw(random, 0.3, 0.6);
    p->lip_flare = h * draw(random, 0.0, 0.15);
    body.section_diameter = h;
    body.poisson_ratio = draw(random, 0.45, 0.499);
    load.bore_radius = load.floor_radius + h * (1.0 - draw(random, 0.05, 0.35));
    body.inner_diameter = 2.0 * load.floor_radius / (1.0 + draw(random, 0.0, 0.15));
    const double width = p->kind == SB_SEAL_PROFILE_X ? h : p->axial_height;
    load.wall_right = 0.5 * width * draw(random, 1.3, 2.0);
    load.pressure_left = fmax(0.0, draw(random, -1e6, 1e6));
    g_rand_free(random);
    count_solved(&tally, &body, &load, 0.0, number);
  }
  check_tally(&tally, count);
}

static void glands(void) {
  random_glands(1, 6);
}

static int campaign_first, campaign_count;

static void campaign(void) {
  random_glands(campaign_first, campaign_count);
}

static void campaign_profiles(void) {
  random_profiles(campaign_first, campaign_count);
}

// COUNT FIRST [profiles]: so many random glands or profiles from a number on, else all tests.
int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  if (argc > 2) {
    campaign_count = atoi(argv[1]);
    campaign_first = atoi(argv[2]);
    g_test_add_func("/ring-aligned/campaign", argc > 3 ? campaign_profiles : campaign);
    return g_test_run();
  }
  g_test_add_func("/ring-aligned/dry", dry);
  g_test_add_func("/ring-aligned/pressed", pressed);
  g_test_add_func("/ring-aligned/dragged", dragged);
  g_test_add_func("/ring-aligned/slopes", slopes);
  g_test_add_func("/ring-aligned/glands", glands);
  return g_test_run();
}

// Random rings through the ring's whole range, and what must hold for every state they reach.
//
// Rings, grooves, pressures, land edges and frictions are drawn from a fixed seed: squeeze 2-40 %,
// stretch 0-20 %, nu 0.45-0.4999, pressure to 2 MPa, friction to 1 on all surfaces, the land's edge
// anywhere under the seal, sliding to 0.6 section diameters and back, steady sliding either way.
// Against flat surfaces without friction every fit must be found; over a land's edge and with
// friction a ring may be given up, saying where, and a slid one keeps a state that still satisfies
// everything.
//
// test-engine-ring-campaign [COUNT [FIRST]]: COUNT rings of each kind from number FIRST on; without
// them a few, and many with -m slow.
#include "engine/contact/ring/ring.h"
#include "tests/engine/seals.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>

static guint64 seed;
static int count, first; // by the arguments; without them 0

static double draw(double from, double to) {
  seed = seed * 6364136223846793005u + 1442695040888963407u;
  return from + (to - from) * ((double)(seed >> 11) * 0x1p-53);
}

typedef struct {
  SbRingBody body;
  SbRingLoad load;
  double travel; // of the bore, m
} Case;

typedef enum { PRESSED, EDGE, EDGE_PRESSED, SLIDING, DRAGGED, KINDS } Kind;

// Case `index` of a kind; the same numbers whatever ran before.
static Case make(Kind kind, int index) {
  seed = (guint64)(gint32)(1234567U + 7919U * (guint32)index); // large numbers wrap
  for (int i = 0; i < 5; i++) {
    draw(0.0, 1.0);
  }
  Case c = {.load = SB_RING_LOAD_INIT};
  double d = draw(1e-3, 3e-3);
  c.body.section_diameter = d;
  c.body.inner_diameter = d * draw(1.2, 8.0);
  c.body.modulus = draw(1.5e6, 10e6);
  c.body.poisson_ratio = 0.5 - pow(10.0, draw(-4.0, -1.3));
  c.body.mooney_share = draw(0.0, 1.0) < 0.3 ? draw(0.0, 0.4) : 0.0;
  double squeeze = draw(0.02, 0.4), mean = c.body.inner_diameter + d;
  SbRingLoad *load = &c.load;
  load->floor_radius = 0.5 * c.body.inner_diameter * (1.0 + draw(0.0, 0.2));
  double thickness = d * sqrt(mean / (2.0 * load->floor_radius + d));
  load->bore_radius = load->floor_radius + thickness * (1.0 - squeeze);
  double space = load->bore_radius - load->floor_radius;
  double area = 0.25 * G_PI * d * d * mean / (load->floor_radius + load->bore_radius);
  load->wall_right = 0.5 * area / space / draw(0.6, 0.92);
  load->wall_left = -load->wall_right;
  double pressure = fmin(draw(0.0, 2e6), 3.0 * c.body.modulus);
  bool left = draw(0.0, 1.0) < 0.5, right_edge = draw(0.0, 1.0) < 0.5;
  double edge = d * draw(-0.45, 0.45), rounding = d * draw(0.02, 0.2), angle = draw(0.1, 1.0);
  double friction[3] = {draw(0.0, 1.0), draw(0.0, 1.0), draw(0.0, 1.0)};
  c.travel = d * draw(0.1, 0.6);
  if (kind != EDGE && !(kind >= SLIDING && index % 2 == 1)) {
    *(left ? &load->pressure_left : &load->pressure_right) = pressure;
  }
  if (kind == EDGE || kind == EDGE_PRESSED) {
    load->chamfer_angle = angle;
    load->edge_length = rounding;
    *(right_edge ? &load->land_right : &load->land_left) = edge;
  }
  if (kind == SLIDING || kind == DRAGGED) {
    double most = kind == DRAGGED ? 0.8 : 1.0;
    load->friction_bore = most * friction[0];
    load->friction_floor = most * friction[1];
    load->friction_wall = most * friction[2];
  }
  if (kind == DRAGGED) {
    load->bore_slides = draw(0.0, 1.0) < 0.5 ? 1 : -1;
    load->rests_on_wall = draw(0.0, 1.0) < 0.5;
  }
  return c;
}

// Mean of the mean stress over the section's volume, from the drawing's nodal values.
static double mean_stress(const SbRing *ring, double *most) {
  int nodes, triangles, outline;
  SbRingFields fields = fields_of(ring, &nodes, &triangles, &outline);
  double sum = 0.0, volume = 0.0;
  *most = 0.0;
  for (int i = 0; i < triangles; i++) {
    const int *t = &fields.triangle[3 * i];
    const double *a = &fields.place[2 * t[0]], *b = &fields.place[2 * t[1]],
                 *c = &fields.place[2 * t[2]];
    double area = 0.5 * fabs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    double weight = area * (a[1] + b[1] + c[1]) / 3.0;
    double stress =
        (fields.hydrostatic[t[0]] + fields.hydrostatic[t[1]] + fields.hydrostatic[t[2]]) / 3.0;
    sum += weight * stress;
    volume += weight;
    *most = fmax(*most, fabs(stress));
  }
  fields_free(&fields);
  return sum / volume;
}

// Everything that an accepted or kept state must satisfy.
static void check(const SbRing *ring, const Case *c) {
  SbRingResult r;
  sb_ring_result(ring, &r);
  const SbRingLoad *load = sb_ring_load(ring);
  const SbRingBody *body = &c->body;
  g_assert_true(isfinite(r.bore_force) && isfinite(r.floor_force));
  g_assert_cmpfloat(r.penetration, <=, 1e-9);
  // Each node is in balance to 1e-10 of the scale of forces; over a thousand nodes that adds up to
  // 1e-7 at most, which rings of any number come near (2.4e-8: 800935). The first stay below 1e-8.
  double balance = count > 0 ? 1e-7 : 1e-8;
  g_assert_cmpfloat(r.axial_imbalance, <=, balance);
  g_assert_cmpfloat(r.pressure_least, >=, -1e-6 * body->modulus);
  double none = -1e-9 * (r.bore_force + r.floor_force) -
                1e-12 * body->modulus * body->section_diameter * load->bore_radius;
  g_assert_cmpfloat(fmin(r.bore_force, r.floor_force), >=, none);
  g_assert_cmpfloat(fmin(r.wall_left_force, r.wall_right_force), >=, none);

  // Walls against pressure on the annulus and the drags: on a bore without an edge, where the fluid
  // is not shut out of part of the annulus by a wall on its own side.
  bool shut =
      r.wall_left_force * load->pressure_left + r.wall_right_force * load->pressure_right > 0.0;
  if (!shut && r.touching && !isfinite(load->land_left) && !isfinite(load->land_right)) {
    double area =
        G_PI * (load->bore_radius * load->bore_radius - load->floor_radius * load->floor_radius);
    double pressed = (load->pressure_left - load->pressure_right) * area;
    double walls = r.wall_right_force - r.wall_left_force;
    double most = fmax(fabs(pressed), fmax(r.bore_force, r.floor_force));
    g_assert_cmpfloat(fabs(walls - pressed - r.bore_drag - r.floor_drag), <=, balance * most);
  }
  // Coulomb's law.
  double rubbed = load->friction_bore * r.bore_force + load->friction_floor * r.floor_force +
                  load->friction_wall * (r.wall_left_force + r.wall_right_force);
  g_assert_cmpfloat(r.friction_excess, <=, 0.05 * rubbed);

  // The profile starts and ends with the fluid's pressure and is nowhere negative.
  if (r.touching) {
    double x[1024], p[1024];
    int n = sb_ring_profile(ring, x, p, 1024);
    g_assert_cmpint(n, >=, 2);
    g_assert_cmpfloat(fabs(p[0] - load->pressure_left), <=, 1e-12 * body->modulus);
    g_assert_cmpfloat(fabs(p[n - 1] - load->pressure_right), <=, 1e-12 * body->modulus);
    for (int i = 0; i < n; i++) {
      g_assert_cmpfloat(p[i], >=, 0.0);
      g_assert_true(i == 0 || x[i] > x[i - 1]);
    }
  }
  // Volume: J - 1 is the mean stress over the bulk modulus.
  double bulk = body->modulus / (3.0 * (1.0 - 2.0 * body->poisson_ratio)), most;
  double mean = mean_stress(ring, &most);
  g_assert_cmpfloat(fabs(r.volume_change * bulk - mean), <=, 0.03 * fabs(mean) + 0.02 * most);
}

typedef struct {
  int states, refused, lost;
  double worst; // processor seconds of one fit
} Tally;

// Fits one case and, with friction, slides it forth and back.
static void follow(Kind kind, int index, Tally *tally) {
  Case c = make(kind, index);
  SbRing *ring = NULL;
  SbReport report = {0};
  SbRingOptions options = {.element_size = 0.06, .fit_mesh = true};
  clock_t start = clock();
  SbStatus status = sb_ring_create(&ring, &c.body, &c.load, &options, &report);
  double took = (double)(clock() - start) / CLOCKS_PER_SEC;
  tally->worst = fmax(tally->worst, took);
  if (took > 1.0) {
    g_test_message("kind %d case %d took %.2f s", kind, index, took);
  }
  if (status != SB_OK) {
    // Refused beforehand with a parameter, or lost on the way with a reason.
    g_test_message("kind %d case %d: %s", kind, index, report.text);
    g_assert_cmpuint(strlen(report.text), >, 20);
    g_assert_true(status == SB_ERROR_NOT_CONVERGED || report.input != 0);
    *(status == SB_ERROR_NOT_CONVERGED ? &tally->lost : &tally->refused) += 1;
    return;
  }
  tally->states++;
  check(ring, &c);
  SbRingLoad load = c.load;
  for (int i = 0; kind == SLIDING && i < 8 && status == SB_OK; i++) {
    load.bore_position += (i < 4 ? 0.25 : -0.25) * c.travel;
    status = sb_ring_step(ring, &load, &report);
    tally->states++;
    check(ring, &c);
    if (status != SB_OK) {
      g_test_message("sliding case %d, friction %.2f %.2f %.2f: %s", index, load.friction_bore,
                     load.friction_floor, load.friction_wall, report.text);
      g_assert_cmpint(status, ==, SB_ERROR_NOT_CONVERGED);
      g_assert_nonnull(strstr(report.text, "equilibrium lost at"));
      // What is kept lies on the way.
      double kept = sb_ring_load(ring)->bore_position;
      g_assert_cmpfloat(fabs(kept - load.bore_position), <=, 0.2501 * c.travel);
      tally->lost++;
    }
  }
  sb_ring_destroy(ring);
}

static void campaign(Kind kind, int quick, int slow, Tally *tally) {
  int cases = count > 0 ? count : g_test_slow() ? slow : quick;
  for (int i = first; i < first + cases; i++) {
    follow(kind, i, tally);
  }
  g_test_message("%d states, %d refused beforehand, %d lost, slowest fit %.2f s", tally->states,
                 tally->refused, tally->lost, tally->worst);
}

// At most one state in `share` lost; one ring where the arguments ask for fewer than that.
static void few_lost(const Tally *tally, int share) {
  // The fluid passes a few rings of any number; of the first it passes none.
  g_assert_true(count > 0 || tally->refused == 0);
  int most = tally->states / share;
  g_assert_cmpint(tally->lost, <=, count > 0 && most < 1 ? 1 : most);
}

// Against flat surfaces without friction nothing may be lost.
static void test_pressed(void) {
  Tally tally = {0};
  campaign(PRESSED, 4, 60, &tally);
  g_assert_cmpint(tally.lost + tally.refused, ==, 0);
}

// Over the land's edge the section snaps; few may be given up (2 of 60 at writing), more under
// pressure to 2 MPa (about one in ten).
static void test_edge(void) {
  Tally tally = {0};
  campaign(EDGE, 2, 60, &tally);
  few_lost(&tally, 20);
}

static void test_edge_pressed(void) {
  Tally tally = {0};
  campaign(EDGE_PRESSED, 2, 40, &tally);
  few_lost(&tally, 7);
}

// With friction to 1 equilibrium may end; seldom. Ring 841298 has its highest nodal pressure at the
// middle node of the last side of its bore contact, which is held in part: the fluid reaches all
// the same as far as the last held node.
static void test_sliding(void) {
  Tally tally = {0};
  follow(SLIDING, 841298, &tally);
  campaign(SLIDING, 2, 30, &tally);
  few_lost(&tally, 20);
}

// Steady sliding with friction to 0.8, dry and under fluid. Every ring slides, rolls at a drag that
// is told, or is given up where its path stops: about a third at writing, those that fill the
// corner of wall and bore or strain beyond what the mesh follows. Of ring 841322 every step takes
// many iterations however short it is.
static void test_dragged(void) {
  Tally tally = {0};
  for (int i = 3; i < 8; i++) {
    follow(DRAGGED, i, &tally);
  }
  g_assert_cmpint(tally.lost, ==, 0);
  if (g_test_slow()) {
    follow(DRAGGED, 841322, &tally);
    g_assert_cmpfloat(tally.worst, <, 60); // 4 at writing; it did not end before
  }
  campaign(DRAGGED, 0, 24, &tally);
  few_lost(&tally, 2);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  if (argc > 1) {
    count = atoi(argv[1]);
  }
  if (argc > 2) {
    first = atoi(argv[2]);
  }
  g_test_add_func("/ring-campaign/pressed", test_pressed);
  g_test_add_func("/ring-campaign/edge", test_edge);
  g_test_add_func("/ring-campaign/edge-pressed", test_edge_pressed);
  g_test_add_func("/ring-campaign/sliding", test_sliding);
  g_test_add_func("/ring-campaign/dragged", test_dragged);
  return g_test_run();
}

// Grooves as they are made: walls with draft, rounded corners, chamfered edges.
#include "engine/contact/gland.h"
#include "engine/contact/ring/ring_contact.h"
#include "engine/contact/ring/ring_private.h"
#include "engine/valve/model/params.h"

#include <glib.h>

#include <math.h>

static const SbRingSurface WALLS[] = {SB_RING_WALL_RIGHT, SB_RING_WALL_LEFT};

static SbRingLoad made(double draft, double corner, double chamfer) {
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.floor_radius = 1.64e-3;
  load.bore_radius = 3e-3;
  load.wall_left = -1e-3;
  load.wall_right = 1e-3;
  load.wall_draft = draft;
  load.floor_corner = corner;
  load.wall_chamfer = chamfer;
  load.wall_top = 2.9e-3;
  return load;
}

// Puts a place on a surface, along its normal.
static SbRingFrame settle(const SbRingLoad *load, SbRingSurface surface, double x[2]) {
  SbRingFrame frame = sb_ring_frame(load, surface, x);
  for (int i = 0; i < 60 && fabs(frame.gap) > 1e-16; i++) {
    x[0] -= frame.gap * frame.n[0];
    x[1] -= frame.gap * frame.n[1];
    frame = sb_ring_frame(load, surface, x);
  }
  g_assert_cmpfloat(fabs(frame.gap), <, 1e-15);
  return frame;
}

// On the surfaces normals are the gaps' gradients, tangents are normal to them, and what bends the
// gap along them is told; the left wall is the right one's image.
static void check_frames(const SbRingLoad load, bool alike) {
  const double step = 1e-8;
  for (int k = 0; k <= 61; k++) {
    const double r = 1.64e-3 + 1.36e-3 * k / 61, z = -1e-3 + 2e-3 * k / 61;
    double x[3][2] = {{1.64e-3, z}, {r, 1e-3}, {r, -1e-3}};
    const SbRingSurface surface[] = {SB_RING_FLOOR, WALLS[0], WALLS[1]};
    for (int s = 0; s < 3; s++) {
      const SbRingFrame frame = settle(&load, surface[s], x[s]);
      g_assert_cmpfloat(fabs(frame.n[0] * frame.t[0] + frame.n[1] * frame.t[1]), <, 1e-15);
      for (int i = 0; i < 2; i++) {
        double to[2] = {x[s][0], x[s][1]}, from[2] = {x[s][0], x[s][1]};
        to[i] += step;
        from[i] -= step;
        const double slope = (sb_ring_frame(&load, surface[s], to).gap -
                              sb_ring_frame(&load, surface[s], from).gap) /
                             (2 * step);
        g_assert_cmpfloat_with_epsilon(slope, frame.n[i], 1e-6);
      }
      // The normal's turn along the tangent.
      const int axis = s == 0 ? 1 : 0;
      g_assert_cmpint(frame.axis, ==, axis);
      const double ahead[2] = {x[s][0] + step * frame.t[0], x[s][1] + step * frame.t[1]};
      const SbRingFrame next = sb_ring_frame(&load, surface[s], ahead);
      double turn = 0;
      for (int i = 0; i < 2; i++) {
        turn += (next.n[i] - frame.n[i]) / (step * frame.t[axis]) * frame.t[i];
      }
      g_assert_cmpfloat_with_epsilon(turn, frame.curvature, 1e-2 * fabs(frame.curvature) + 5);
    }
    if (alike) {
      g_assert_cmpfloat_with_epsilon(x[1][0], x[2][0], 1e-15);
      g_assert_cmpfloat_with_epsilon(x[1][1], -x[2][1], 1e-15);
    }
  }
}

// The same groove as its drawing: draft, corners' arcs, edges, from the floor's left end on.
static SbGrooveDrawing drawn(double draft, double corner, double chamfer) {
  const double top = 1.26e-3, middle = 5e-3, radius = 8e-3;
  const double foot = corner * (1 - sin(draft)); // where the arc meets the wall
  const double arc = 1e-3 + tan(draft) * corner - corner / cos(draft);
  const double right[][3] = {{arc, 0, tan((M_PI / 2 - draft) / 4)},
                             {arc + corner * cos(draft), foot, 0},
                             {1e-3 + tan(draft) * (top - chamfer), top - chamfer, 0},
                             {1e-3 + tan(draft) * top + chamfer, top, 0}};
  SbSealPoint point[8];
  for (int i = 0; i < 4; i++) {
    const double bulge = i < 3 ? right[2 - i][2] : 0;
    point[i] = (SbSealPoint){radius + right[3 - i][1], middle - right[3 - i][0], bulge};
    point[4 + i] = (SbSealPoint){radius + right[i][1], middle + right[i][0], right[i][2]};
  }
  SbGrooveDrawing out;
  SbReport report = {0};
  if (sb_groove_draw(&out, point, 8, &report) != SB_OK) {
    g_error("%s", report.text);
  }
  return out;
}

static SbRingLoad load_of(const SbGrooveDrawing *groove) {
  SbRingLoad load = made(0, 0, 0);
  load.groove = groove;
  load.wall_right = 0.5 * groove->width;
  load.wall_left = -load.wall_right;
  return load;
}

static void frames(void) {
  check_frames(made(0.08, 0.3e-3, 0.2e-3), true);
  const SbGrooveDrawing groove = drawn(0.08, 0.3e-3, 0.2e-3);
  check_frames(load_of(&groove), true);
  // A floor that rises to the left alone, a wall that leans inwards.
  const SbSealPoint askew[] = {{1.3e-3, -1.2e-3, 0}, {0.2e-3, -1e-3, 0}, {0, 0.2e-3, 0.1},
                               {0, 0.8e-3, 0.3},     {0.4e-3, 1e-3, 0},  {1.3e-3, 0.9e-3, 0}};
  SbGrooveDrawing other;
  SbReport report = {0};
  g_assert_cmpint(sb_groove_draw(&other, askew, 6, &report), ==, SB_OK);
  check_frames(load_of(&other), false);
}

// A corner is an arc up to 60 degrees and lies outside it by no more than 3.6 % of its radius
// beyond, a leaning wall on its line, a chamfer on its.
static void shapes(void) {
  const SbRingLoad load = made(0, 0.3e-3, 0);
  for (int k = 0; k <= 90; k++) {
    const double angle = k * M_PI / 180;
    const double on[2] = {1.94e-3 - 0.3e-3 * cos(angle), 0.7e-3 + 0.3e-3 * sin(angle)};
    const double gap = fmin(sb_ring_frame(&load, SB_RING_FLOOR, on).gap,
                            sb_ring_frame(&load, SB_RING_WALL_RIGHT, on).gap);
    g_assert_cmpfloat(gap, >, -1e-15);
    g_assert_cmpfloat(gap, <, k <= 60 ? 1e-15 : 0.036 * 0.3e-3);
  }
  const SbRingLoad leans = made(0.1, 0, 0.2e-3);
  const double wall[2] = {2.4e-3, 1e-3 + tan(0.1) * 0.76e-3};
  const double edge[2] = {2.9e-3, 1e-3 + tan(0.1) * 1.26e-3 + 0.2e-3};
  g_assert_cmpfloat(fabs(sb_ring_frame(&leans, SB_RING_WALL_RIGHT, wall).gap), <, 1e-15);
  g_assert_cmpfloat(fabs(sb_ring_frame(&leans, SB_RING_WALL_RIGHT, edge).gap), <, 1e-15);
}

// A drawn groove has the places of the one that it draws, arcs to 0.3 % of their radius up to 60
// degrees and 3 % beyond; its outline lies on its surfaces, and its area follows.
static void drawings(void) {
  const double draft = 0.08, corner = 0.3e-3;
  const SbGrooveDrawing upright = drawn(0, corner, 0), leans = drawn(draft, corner, 0);
  const SbRingLoad is = load_of(&upright), other = load_of(&leans);
  g_assert_cmpfloat_with_epsilon(upright.width, 2e-3, 1e-12);
  g_assert_cmpfloat_with_epsilon(upright.depth, 1.26e-3, 1e-12);
  g_assert_cmpfloat_with_epsilon(leans.width, 2e-3 + 2 * tan(draft) * corner * (1 - sin(draft)),
                                 1e-12);
  const SbRingSurface surface[] = {SB_RING_FLOOR, WALLS[0], WALLS[1]};
  for (int k = 0; k <= 90; k++) {
    const double angle = k * M_PI / 180;
    const double on[2] = {1.94e-3 - corner * cos(angle), 0.7e-3 + corner * sin(angle)};
    const double gap = fmin(sb_ring_frame(&is, SB_RING_FLOOR, on).gap,
                            sb_ring_frame(&is, SB_RING_WALL_RIGHT, on).gap);
    g_assert_cmpfloat(fabs(gap), <, (k <= 60 ? 0.003 : 0.03) * corner);
  }
  for (int k = 0; k <= 10; k++) {
    const double r = 0.4e-3 + 0.8e-3 * k / 10;
    const double on[2] = {1.64e-3 + r, 1e-3 + tan(draft) * r};
    g_assert_cmpfloat(fabs(sb_ring_frame(&other, SB_RING_WALL_RIGHT, on).gap), <, 1e-12);
  }
  double out[SB_GROOVE_POINTS][2];
  const int count = sb_groove_outline(out, &leans, leans.width, 1.26e-3);
  for (int i = 0; i < count; i++) {
    const double x[2] = {other.floor_radius + out[i][1], out[i][0]};
    double gap = INFINITY;
    for (int s = 0; s < 3; s++) {
      gap = fmin(gap, sb_ring_frame(&other, surface[s], x).gap);
    }
    g_assert_cmpfloat(fabs(gap), <, 1e-9);
  }
  const double area = sb_groove_area(1.26e-3, 2e-3, draft, 0, NULL) -
                      2 * corner * corner * (tan(M_PI / 4 - draft / 2) - (M_PI / 4 - draft / 2));
  g_assert_cmpfloat_with_epsilon(sb_groove_drawn_area(&leans, leans.width, 1.26e-3), area,
                                 1e-3 * area);
  // Further apart by what they are moved, and above the drawing as wide as its opening.
  const double wide = sb_groove_drawn_area(&leans, leans.width + 1e-4, 1.26e-3);
  g_assert_cmpfloat_with_epsilon(wide, area + 1.26e-7, 1e-3 * area);
  const double opening = out[0][0] - out[count - 1][0];
  g_assert_cmpfloat_with_epsilon(sb_groove_drawn_area(&leans, leans.width, 1.36e-3),
                                 area + 1e-4 * opening, 1e-3 * area);

  // A point twice is one; a floor ends at the wall, however that leans.
  const SbSealPoint twice[] = {{1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {0, 1, 0}, {1, 1, 0}};
  const SbSealPoint steep[] = {{1, -2.75, 0}, {0.25, -2, 0}, {0.2, -2, 0}, {0, -1.907, 0},
                               {0, 1.907, 0}, {0.2, 2, 0},   {0.25, 2, 0}, {1, 2.75, 0}};
  SbGrooveDrawing drawing;
  g_assert_cmpint(sb_groove_draw(&drawing, twice, 5, NULL), ==, SB_OK);
  g_assert_cmpfloat_with_epsilon(sb_groove_drawn_area(&drawing, 2, 1), 2, 1e-6);
  g_assert_cmpint(sb_groove_draw(&drawing, steep, 8, NULL), ==, SB_OK);
  const double trapezoid = 0.2 * (1.907 + 2) + 0.05 * 4 + 0.75 * (2 + 2.75);
  g_assert_cmpfloat_with_epsilon(sb_groove_drawn_area(&drawing, 4, 1), trapezoid, 0.02 * trapezoid);

  static const struct {
    SbSealPoint point[8];
    int count;
    const char *said;
  } bad[] = {
      {{{1, 0, 0}, {0, 0, 0}}, 2, "at least 3"},
      {{{1, -1, 0}, {0, -1, 0}, {0, 1, 0}}, 3, "no wall"},
      {{{1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {0.5, 1, 0}, {0.5, 2, 0}, {1, 2, 0}}, 6, "leans"},
      {{{1, -1, 0},
        {0, -1, 0},
        {0, 0, 0},
        {0.5, 0, 0},
        {0.5, 0.3, 0},
        {0, 0.3, 0},
        {0, 1, 0},
        {1, 1, 0}},
       8,
       "leans"},
      {{{1, -1, 0}, {0, -1, 0}, {0.6, 0.5, 0}, {0, 0.6, 0}, {0.1, 0.7, 0}, {1, 0.2, 0}}, 6, ""},
      {{{1, -1, 0}, {0, -1, 0}, {0, NAN, 0}, {1, 1, 0}}, 4, ""},
      {{{1, 0, 1e9}, {0, 0, 1e9}, {1, 0, 0}}, 3, ""},
      {{{1, -1, 0}, {0, -1, 0}, {0, 1, 1e200}, {1, 1, 0}}, 4, "none"},
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    SbGrooveDrawing none;
    SbReport report = {0};
    g_assert_cmpint(sb_groove_draw(&none, bad[i].point, bad[i].count, &report), ==, SB_ERROR_INPUT);
    g_assert_nonnull(strstr(report.text, bad[i].said));
  }
}

static SbRingResult pressed(const SbRingLoad *groove, double pressure) {
  const SbRingBody body = {.section_diameter = 1.61e-3,
                           .inner_diameter = 2.84e-3,
                           .modulus = 2.5e6,
                           .poisson_ratio = 0.49};
  SbRingLoad load = *groove;
  load.pressure_left = fmax(pressure, 0);
  load.pressure_right = fmax(-pressure, 0);
  SbRing *ring;
  SbRingResult is;
  SbReport report = {0};
  const SbStatus status = sb_ring_create(&ring, &body, &load, NULL, &report);
  if (status != SB_OK) {
    g_error("%s", report.text);
  }
  sb_ring_result(ring, &is);
  sb_ring_destroy(ring);
  return is;
}

// Statics of a section that friction drags along the bore onto a leaning wall, without hoop stress
// and fluid: wall and corner bear the drag, and the wall's share outwards unloads the floor. And
// the wall on the other side does the same to the fluid's ring.
static void wedge(void) {
  const double draft = 5 * M_PI / 180;
  const SbRingBody flat = {.profile = {.kind = SB_SEAL_PROFILE_RECTANGLE,
                                       .axial_height = 1.5e-3,
                                       .corner_radius = 0.2e-3},
                           .section_diameter = 1.61e-3,
                           .modulus = 2.5e6,
                           .poisson_ratio = 0.49,
                           .plane_strain = true};
  SbRingLoad load = made(draft, 0.2e-3, 0);
  load.friction_bore = 0.2;
  load.bore_slides = 1;
  SbRing *ring;
  SbRingResult is;
  SbReport report = {0};
  if (sb_ring_create(&ring, &flat, &load, NULL, &report) != SB_OK) {
    g_error("%s", report.text);
  }
  sb_ring_result(ring, &is);
  sb_ring_destroy(ring);
  g_test_message("bore %.6g, floor %.6g, drag %.6g, wall %.6g N/m", is.bore_force, is.floor_force,
                 is.bore_drag, is.wall_right_force);
  g_assert_cmpint(is.state, ==, SB_RING_SLIDES);
  g_assert_cmpfloat_with_epsilon(is.bore_drag, 0.2 * is.bore_force, 1e-8 * is.bore_force);
  g_assert_cmpfloat(is.floor_drag, <, -0.1 * is.bore_drag); // by its rounded corner
  g_assert_cmpfloat_with_epsilon(is.bore_drag + is.floor_drag, is.wall_right_force,
                                 1e-8 * is.bore_force);
  g_assert_cmpfloat_with_epsilon(is.bore_force, is.floor_force + is.wall_right_force * tan(draft),
                                 1e-8 * is.bore_force);
  const SbRingLoad leans = made(draft, 0, 0);
  const SbRingResult one = pressed(&leans, 0.55e6), other = pressed(&leans, -0.55e6);
  g_assert_cmpfloat_with_epsilon(other.bore_force, one.bore_force, 1e-9 * one.bore_force);
  g_assert_cmpfloat_with_epsilon(other.wall_left_force, one.wall_right_force,
                                 1e-9 * one.wall_right_force);
}

// What is nearly nothing does nearly nothing; what is more than the groove holds is refused.
static void limits(void) {
  const SbRingLoad straight = made(0, 0, 0), nearly = made(1e-6, 1e-8, 1e-8);
  const double load = pressed(&straight, 0.55e6).bore_force;
  g_assert_cmpfloat_with_epsilon(pressed(&nearly, 0.55e6).bore_force, load, 1e-5 * load);
  // What draws nothing but upright walls does nothing at all; what draws the same, the same.
  const SbGrooveDrawing upright = drawn(0, 1e-9, 0), rounded = drawn(0, 0.6e-3, 0);
  const SbRingLoad by[] = {load_of(&upright), load_of(&rounded), made(0, 0.6e-3, 0)};
  g_assert_cmpfloat_with_epsilon(pressed(&by[0], 0.55e6).bore_force, load, 1e-8 * load);
  const double corners = pressed(&by[2], 0.55e6).bore_force;
  const double as_drawn = pressed(&by[1], 0.55e6).bore_force;
  g_test_message("upright %.6g, rounded %.6g, as drawn %.6g N", load, corners, as_drawn);
  g_assert_cmpfloat(fabs(corners - load), >, 5e-3 * load);
  g_assert_cmpfloat_with_epsilon(as_drawn, corners, 0.1 * fabs(corners - load));
  const SbRingBody body = {.section_diameter = 1.61e-3,
                           .inner_diameter = 2.84e-3,
                           .modulus = 2.5e6,
                           .poisson_ratio = 0.49};
  const SbRingLoad bad[] = {made(0.5, 0, 0), made(0, 1.5e-3, 0), made(0, 0, 2e-3)};
  static const char *const key[] = {"gland.draft", "gland.corner_radius", "gland.edge_chamfer"};
  for (int i = 0; i < 3; i++) {
    SbReport report = {0};
    g_assert_cmpint(sb_ring_check(&body, &bad[i], &report), ==, SB_ERROR_RANGE);
    g_assert_cmpstr(sb_input_key(report.input), ==, key[i]);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/ring-groove/frames", frames);
  g_test_add_func("/ring-groove/shapes", shapes);
  g_test_add_func("/ring-groove/drawings", drawings);
  g_test_add_func("/ring-groove/wedge", wedge);
  g_test_add_func("/ring-groove/limits", limits);
  return g_test_run();
}

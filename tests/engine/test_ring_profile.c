// Rings whose free section is no circle: outlines, meshes, loads against independent figures.
#include "engine/contact/ring/ring_mesh.h"
#include "engine/contact/ring/ring_private.h"

#include "seals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The reference's ring (shared figures): 15 % squeeze.
static SbRingBody body_of(SbSealProfileKind kind, double axial, double corner) {
  return (SbRingBody){
      .profile = {.kind = kind,
                  .axial_height = axial,
                  .corner_radius = corner,
                  .valley_depth = 0.15e-3,
                  .web_width = 0.7e-3,
                  .flange_height = 0.6e-3,
                  .lip_thickness = 0.4e-3,
                  .lip_depth = 0.7e-3,
                  .lip_flare = 0.15e-3},
      .section_diameter = 1.6e-3,
      .inner_diameter = 3.2e-3,
      .modulus = 2.5e6,
      .poisson_ratio = 0.49,
  };
}

static double load_of(const SbRingBody *body, double pressure, double tolerance, double *error) {
  SbRingLoad load = open_groove();
  SbRingResult result;
  SbWarnings warnings = {0};
  SbReport report = {0};
  const SbRingOptions options = {.tolerance = tolerance};
  load.pressure_left = pressure;
  load.wall_right = pressure > 0 ? 1e-3 : INFINITY;
  SbStatus status = sb_ring_fit(NULL, &result, body, &load, &options, &warnings, &report);
  g_test_message("%s: load %.5f N, error %.2g%s", sb_seal_profile_name(body->profile.kind),
                 result.bore_force, result.error.load, report.text);
  g_assert_cmpint(status, ==, SB_OK);
  *error = result.error.load;
  return result.bore_force;
}

static const struct {
  SbSealProfileKind kind;
  double axial, corner;
} SHAPE[] = {{SB_SEAL_PROFILE_RECTANGLE, 1.2e-3, 0.2e-3},
             {SB_SEAL_PROFILE_D, 1.6e-3, 0.15e-3},
             {SB_SEAL_PROFILE_X, 0, 0.32e-3},
             {SB_SEAL_PROFILE_T, 1.2e-3, 0.1e-3},
             {SB_SEAL_PROFILE_LIP, 1.2e-3, 0.1e-3},
             {SB_SEAL_PROFILE_CIRCLE, 0, 0}};

// Closed, smooth outlines whose area is that of the shape, by the angles and back.
static void outlines(void) {
  const double h = 1.6e-3, corner = 4.0 - M_PI;
  const double area[] = {1.2 * 1.6 - corner * 0.04, // four corners
                         0.8 * 1.6 + 0.5 * M_PI * 0.64 -
                             0.5 * corner * 0.0225, // half circle on a block
                         0,
                         0.6 * 1.2 + 1.0 * 0.7 - corner * 0.01, // six corners out, two in
                         0,
                         M_PI / 4 * 2.56};
  for (size_t i = 0; i < G_N_ELEMENTS(SHAPE); i++) {
    SbRingBody body = body_of(SHAPE[i].kind, SHAPE[i].axial, SHAPE[i].corner);
    SbRingOutline outline;
    g_assert_cmpint(sb_ring_outline_of_profile(&outline, &body.profile, h, NULL), ==, SB_OK);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < outline.count; k++) {
      const SbRingOutlinePart *part = &outline.part[k],
                              *next = &outline.part[(k + 1) % outline.count];
      g_assert_cmpfloat(hypot(part->to[0] - next->from[0], part->to[1] - next->from[1]), <, 1e-9);
    }
    for (int k = 0; k < 1000; k++) {
      double x[2], angle = -M_PI + 2 * M_PI * (k + 0.5) / 1000;
      double arc = sb_ring_outline_arc(&outline, angle);
      g_assert_cmpfloat(fabs(sb_ring_outline_angle(&outline, arc) - angle), <, 1e-12);
      sb_ring_outline_place(&outline, arc, x);
      low = fmin(low, x[0]);
      high = fmax(high, x[0]);
    }
    g_assert_cmpfloat(fabs(low + 0.5) + fabs(high - 0.5), <, 1e-4);
    if (area[i] > 0) {
      g_assert_cmpfloat(fabs(outline.area * 2.56 / area[i] - 1), <, 2e-4);
    }
  }
}

// Meshes cover their outline, without a triangle that is turned over or flat.
static void meshes(void) {
  for (size_t i = 0; i < G_N_ELEMENTS(SHAPE); i++) {
    SbRingBody body = body_of(SHAPE[i].kind, SHAPE[i].axial, SHAPE[i].corner);
    SbRingOutline outline;
    g_assert_cmpint(sb_ring_outline_of_profile(&outline, &body.profile, 1.6e-3, NULL), ==, SB_OK);
    for (int fine = 0; fine < 3; fine++) {
      const double size = 0.08 / (1 << fine);
      SbRingMeshPlan plan = {.centre = 1.5,
                             .outline = &outline,
                             .size_max = 0.16,
                             .growth = 0.5,
                             .zone_count = 1,
                             .zone = {{-0.4, 0.4, size}},
                             .vertex_count = 1,
                             .vertex = {0.31}};
      SbRingMesh *mesh;
      SbReport report = {0};
      SbStatus status = sb_ring_mesh_create(&mesh, &plan, &report);
      g_assert_cmpstr(report.text, ==, "");
      g_assert_cmpint(status, ==, SB_OK);
      double area = 0, worst = HUGE_VAL, polygon = 0, nearest = HUGE_VAL;
      for (int e = 0; e < mesh->elements; e++) {
        const int *tri = &mesh->tri[6 * e];
        double u[2], v[2], w[2];
        for (int k = 0; k < 2; k++) {
          u[k] = mesh->x[2 * tri[1] + k] - mesh->x[2 * tri[0] + k];
          v[k] = mesh->x[2 * tri[2] + k] - mesh->x[2 * tri[0] + k];
          w[k] = v[k] - u[k];
        }
        double twice = u[0] * v[1] - u[1] * v[0];
        double most = fmax(hypot(u[0], u[1]), fmax(hypot(v[0], v[1]), hypot(w[0], w[1])));
        worst = fmin(worst, twice / (most * most));
        area += twice / 2;
      }
      for (int k = 0; k < mesh->loop_count; k += 2) {
        const double *a = &mesh->x[2 * mesh->loop[k]];
        const double *b = &mesh->x[2 * mesh->loop[(k + 2) % mesh->loop_count]];
        polygon += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        nearest = fmin(nearest, fabs(mesh->angle[k] - 0.31));
        g_assert_true(k == 0 || mesh->angle[k] > mesh->angle[k - 1]);
      }
      g_assert_cmpfloat(fabs(area / polygon - 1), <, 1e-12);
      g_assert_cmpfloat(fabs(area / outline.area - 1), <, 0.02);
      g_assert_cmpfloat(worst, >, 0.2); // twice the area over the longest side's square
      g_assert_cmpfloat(nearest, <, 1e-9);
      sb_ring_mesh_destroy(mesh);
    }
  }
}

// A rectangle of corners as wide as itself is the circle: the general meshes beside the rows.
static void circle(void) {
  const SbRingBody round = body_of(SB_SEAL_PROFILE_CIRCLE, 0, 0);
  const SbRingBody general = body_of(SB_SEAL_PROFILE_RECTANGLE, 1.6e-3, 0.8e-3);
  double error[2];
  const double by_rows = load_of(&round, 0, 2e-4, &error[0]);
  const double by_general = load_of(&general, 0, 2e-4, &error[1]);
  g_assert_cmpfloat(fabs(by_general / by_rows - 1), <, 1e-4);
}

// Independent finite elements (+-0.5 % dry, +-1.5 % under 0.55 MPa).
static void reference(void) {
  static const struct {
    int shape;
    double dry, pressed;
  } ROW[] = {{0, 14.362, 27.2}, {1, 11.24, 22.60}, {5, 8.316, 18.25}};
  for (size_t i = 0; i < G_N_ELEMENTS(ROW); i++) {
    const int k = ROW[i].shape;
    const SbRingBody body = body_of(SHAPE[k].kind, SHAPE[k].axial, SHAPE[k].corner);
    double error;
    g_assert_cmpfloat(fabs(load_of(&body, 0, 1e-3, &error) / ROW[i].dry - 1), <, 5e-3);
    g_assert_cmpfloat(fabs(load_of(&body, 0.55e6, 1e-3, &error) / ROW[i].pressed - 1), <, 1.5e-2);
  }
}

// Under fluid that the first lobe of an x holds, the hollow behind it is no part of the load: by
// CalculiX on the same wetted faces 12.287 N and 14.562 N (compare_ccx.py).
static void hollow(void) {
  static const double row[][2] = {{0.1e6, 12.287}, {0.2e6, 14.562}};
  const SbRingBody x = body_of(SB_SEAL_PROFILE_X, 0, 0.32e-3);
  for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
    double error;
    g_assert_cmpfloat(fabs(load_of(&x, row[i][0], 1e-3, &error) / row[i][1] - 1), <, 5e-3);
  }
}

// A lip whose contact exceeds the fluid by little, dragged to both sides: the drag is the law's
// over the load, but for the fluid at the contact's ends, which counts into the load and does not
// rub.
static void lip(void) {
  const SbRingBody body = body_of(SB_SEAL_PROFILE_LIP, 1.2e-3, 0.1e-3);
  for (int side = -1; side <= 1; side += 2) {
    SbRingLoad load = groove(0.55e6);
    load.friction_bore = 0.1;
    load.friction_floor = 0.3;
    load.friction_wall = 0.1;
    load.bore_slides = side;
    load.rests_on_wall = true;
    SbRingResult result;
    SbWarnings warnings = {0};
    SbReport report = {0};
    SbStatus status = sb_ring_fit(NULL, &result, &body, &load, NULL, &warnings, &report);
    g_test_message("lip: load %.5f N, drag %.5f N, error %.2g%s", result.bore_force,
                   result.bore_drag, result.error.load, report.text);
    g_assert_cmpint(status, ==, SB_OK);
    g_assert_cmpint(result.state, ==, SB_RING_SLIDES);
    g_assert_cmpfloat(fabs(side * result.bore_drag / (0.1 * result.bore_force) - 1), <, 0.01);
    g_assert_cmpfloat(result.error.load, <, 0.01); // no lack is told
  }
}

// Errors that are told hold against a mesh of six times the accuracy.
static void errors(void) {
  for (int i = 0; i < 5; i++) {
    const SbRingBody body = body_of(SHAPE[i].kind, SHAPE[i].axial, SHAPE[i].corner);
    double told, fine;
    const double coarse = load_of(&body, 0, 3e-3, &told);
    const bool lips = SHAPE[i].kind == SB_SEAL_PROFILE_LIP; // their error falls slowly
    const double better = load_of(&body, 0, lips ? 1e-3 : 5e-4, &fine);
    g_assert_cmpfloat(fabs(coarse / better - 1), <, 3 * told + fine);
  }
  // Sections that bend, by their usual sizes: strictly.
  for (int i = 0; i < 2; i++) {
    SbRingBody body = body_of(i ? SB_SEAL_PROFILE_LIP : SB_SEAL_PROFILE_T, 1.6e-3, 0.1e-3);
    body.profile.axial_height = i ? 1.2e-3 : 1.6e-3;
    body.profile.lip_thickness = 0.45e-3;
    body.profile.lip_depth = 0.5e-3;
    body.profile.lip_flare = 0.2e-3;
    double told, fine;
    body.section_diameter = i ? 1.6e-3 : 1.511e-3;
    const double better = load_of(&body, 0, i ? 1e-3 : 5e-4, &fine);
    for (int k = 0; k < 2; k++) {
      const double coarse = load_of(&body, 0, k ? 2e-3 : 1e-2, &told);
      g_assert_cmpfloat(fabs(coarse / better - 1), <, told + fine);
    }
  }
}

// A T of the usual sizes that is squeezed by a fifth has 14.4 N, or 3.2 N where it has rolled, as
// here: which it is hangs on rounding, and is told. By a tenth it stands.
static void rolled(void) {
  static const double height[] = {1.7e-3, 1.511e-3};
  for (int i = 0; i < 2; i++) {
    SbRingBody body = body_of(SB_SEAL_PROFILE_T, 1.6e-3, 0.18e-3);
    body.profile.web_width = 0.7e-3;
    body.profile.flange_height = 0.5e-3;
    body.section_diameter = height[i];
    const SbRingLoad load = open_groove();
    const SbRingOptions options = {.tolerance = 1e-2};
    SbRingResult result;
    SbWarnings warnings = {0};
    SbReport report = {0};
    SbStatus status = sb_ring_fit(NULL, &result, &body, &load, &options, &warnings, &report);
    g_assert_cmpint(status, ==, SB_OK);
    bool told = false;
    for (size_t k = 0; k < (size_t)warnings.count; k++) {
      told = told || strcmp(warnings.item[k].code, "section-rolled") == 0;
    }
    g_test_message("%.3f mm: %.4f N%s", 1e3 * height[i], result.bore_force, told ? ", rolled" : "");
    g_assert_true(told == (i == 0 && result.bore_force < 8));
  }
}

// A long block between smooth plates: plane strain, of a neo-Hookean rubber that keeps its volume
// mu (1/l^3 - l) of its free width; stuck to them: Gent and Lindley's strip, 4/3 E (1 + S^2) with S
// its half width over its height, valid for S above one and small strain. Corners are rounded by
// 2 % of the height.
static void blocks(void) {
  SbRingBody body = {
      .profile = {SB_SEAL_PROFILE_RECTANGLE, .axial_height = 4e-3, .corner_radius = 0.04e-3},
      .section_diameter = 2e-3,
      .modulus = 3e6,
      .poisson_ratio = 0.4999,
      .plane_strain = true};
  const double width = 4e-3, shear = 1e6;
  SbRingLoad load = SB_RING_LOAD_INIT;
  SbReport report = {0};
  SbRingResult result;
  SbRing *ring;
  load.floor_radius = 10e-3;
  load.bore_radius = load.floor_radius + 0.9 * 2e-3;
  const SbRingOptions options = {.element_size = 0.06};
  g_assert_cmpint(sb_ring_create(&ring, &body, &load, &options, &report), ==, SB_OK);
  sb_ring_result(ring, &result);
  const double l = 0.9, smooth = shear * (1 / (l * l * l) - l) * width;
  g_test_message("smooth %.5g N/m, %.5g", result.bore_force, smooth);
  g_assert_cmpfloat(fabs(result.bore_force / smooth - 1), <, 0.005);
  // Its sides are pressed along to l, but by their ends.
  g_assert_cmpfloat(sb_ring_crease(ring->contact), >, 0.99 / (l * l));
  g_assert_cmpfloat(sb_ring_crease(ring->contact), <, 1.2 / (l * l));
  sb_ring_destroy(ring);
  // Stuck from a touch on.
  load.bore_radius = load.floor_radius + 0.9995 * 2e-3;
  g_assert_cmpint(sb_ring_create(&ring, &body, &load, &options, &report), ==, SB_OK);
  sb_ring_result(ring, &result);
  const double before = result.bore_force;
  load.bore_radius = load.floor_radius + 0.9895 * 2e-3;
  load.friction_bore = load.friction_floor = 2.0;
  g_assert_cmpint(sb_ring_step(ring, &load, &report), ==, SB_OK);
  sb_ring_result(ring, &result);
  const double stuck = 4.0 / 3.0 * 3e6 * (1 + 1.0) * 0.01 * width;
  g_test_message("stuck %.5g N/m, %.5g", result.bore_force - before, stuck);
  g_assert_cmpfloat(fabs((result.bore_force - before) / stuck - 1), <, 0.02);
  sb_ring_destroy(ring);
}

// An x whose lobes close on each other, and a t whose web the fluid lays onto its flange: what
// presses them apart is no force from outside, and lets them into each other by little.
static void folds(void) {
  static const struct {
    SbSealProfileKind kind;
    double axial, corner, squeeze;
  } cases[] = {{SB_SEAL_PROFILE_X, 0, 0.32e-3, 0.42}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbRingBody body = body_of(cases[i].kind, cases[i].axial, cases[i].corner);
    body.plane_strain = true;
    SbRingLoad load = SB_RING_LOAD_INIT;
    load.bore_radius = load.floor_radius + (1 - cases[i].squeeze) * body.section_diameter;
    SbRing *ring;
    SbRingResult is;
    SbReport report = {0};
    if (sb_ring_create(&ring, &body, &load, NULL, &report) != SB_OK) {
      g_error("%s", report.text);
    }
    sb_ring_result(ring, &is);
    g_test_message("%s: bore %.8g, floor %.8g N/m, folded by %.2g of its height",
                   sb_seal_profile_name(cases[i].kind), is.bore_force, is.floor_force,
                   ring->contact->folded);
    g_assert_cmpfloat(ring->contact->folded, >, 0);
    g_assert_cmpfloat(ring->contact->folded, <, 5e-3);
    g_assert_cmpfloat_with_epsilon(is.bore_force, is.floor_force, 1e-8 * is.bore_force);
    sb_ring_destroy(ring);
  }
  const SbRingBody t = body_of(SB_SEAL_PROFILE_T, 1.2e-3, 0.1e-3);
  const SbRingLoad pressed = groove(0.55e6);
  SbRing *ring;
  g_assert_cmpint(sb_ring_create(&ring, &t, &pressed, NULL, NULL), ==, SB_OK);
  g_test_message("t: folded by %.2g of its height", ring->contact->folded);
  g_assert_cmpfloat(ring->contact->folded, >, 0);
  g_assert_cmpfloat(ring->contact->folded, <, 1e-2);
  sb_ring_destroy(ring);
}

// A t whose flange the squeeze and the fluid make thin: the surfaces of its flange lie behind each
// other through its own rubber, which is no contact (campaign random-valves, seed 1, number 142).
static void flange(void) {
  const SbRingBody body = {.profile = {.kind = SB_SEAL_PROFILE_T,
                                       .axial_height = 2.1806201e-3,
                                       .corner_radius = 0.1473819e-3,
                                       .web_width = 1.2664249e-3,
                                       .flange_height = 0.9642034e-3},
                           .section_diameter = 3.1330087e-3,
                           .inner_diameter = 5.4307449e-3,
                           .modulus = 4.7855443e6,
                           .poisson_ratio = 0.4924391};
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.bore_radius = 5.8043922e-3;
  load.floor_radius = 3.3129042e-3;
  load.wall_right = 2.6606604e-3;
  load.wall_left = -load.wall_right;
  load.pressure_left = 0.975563e6;
  double bore[2];
  for (int i = 0; i < 2; i++) {
    const SbRingOptions options = {.element_size = i == 0 ? 0.08 : 0.05};
    SbRing *ring;
    SbRingResult is;
    SbReport report = {0};
    const SbStatus status = sb_ring_create(&ring, &body, &load, &options, &report);
    g_test_message("%s", report.text);
    g_assert_cmpint(status, ==, SB_OK);
    sb_ring_result(ring, &is);
    g_test_message("bore %.6g, wall %.6g N, folded by %.2g of its height", is.bore_force,
                   is.wall_right_force, ring->contact->folded);
    g_assert_cmpfloat(ring->contact->folded, <, 5e-3);
    g_assert_cmpfloat(is.axial_imbalance, <, 1e-8);
    bore[i] = is.bore_force;
    sb_ring_destroy(ring);
  }
  // The error of elements of 0.08 is three times that of 0.05 (second order), which is 0.2 %.
  g_assert_cmpfloat(fabs(bore[0] / bore[1] - 1), <, 0.01);
}

// What is not modelled is refused with its reason.
static void refusals(void) {
  SbRingLoad load = groove(0.55e6);
  SbRing *ring;
  SbReport report;
  SbRingBody body = body_of(SB_SEAL_PROFILE_T, 1.2e-3, 0.2e-3);
  g_assert_cmpint(sb_ring_create(&ring, &body, &load, NULL, &report), ==, SB_ERROR_INFEASIBLE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "seal.corner_radius");
  // The reported radius fits, to the digits that are printed.
  const char *most = strstr(report.text, "at most ");
  g_assert_nonnull(most);
  SbRingOutline outline;
  body.profile.corner_radius = 0.99e-3 * strtod(most + strlen("at most "), NULL);
  g_assert_cmpint(sb_ring_outline_of_profile(&outline, &body.profile, body.section_diameter, NULL),
                  ==, SB_OK);
  body = body_of(SB_SEAL_PROFILE_RECTANGLE, 12e-3, 0.2e-3);
  g_assert_cmpint(sb_ring_create(&ring, &body, &load, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "seal.axial_height");
  SbFit fit;
  SbFitProblem problem = thesis(SB_FIT_HERTZ);
  problem.profile = body_of(SB_SEAL_PROFILE_D, 1.2e-3, 0.2e-3).profile;
  g_assert_cmpint(sb_fit_solve(&fit, &problem, &report), ==, SB_ERROR_INPUT);
  g_assert_cmpstr(sb_input_key(report.input), ==, "models.fit");
}

// A number between two, from a sequence that is the same everywhere.
static double draw(GRand *random, double from, double to) {
  return from + (to - from) * g_rand_double(random);
}

// A groove as somebody may draw it: a floor that rises by up to 5 degrees or bends up in the
// middle, round or broken corners, walls that lean out by 15 degrees or in by 8, broken edges.
static SbGrooveDrawing any_groove(GRand *random, double width, double depth) {
  SbSealPoint point[9];
  const double ridge = draw(random, 0, 1) < 0.3 ? 0.08 * depth : 0;
  const double slope = ridge > 0 ? 0 : tan(draw(random, 0, 5) * M_PI / 180);
  for (int side = 0; side < 2; side++) {
    const double way = side == 0 ? -1 : 1;
    const double corner = depth * draw(random, 0.02, 0.3), edge = depth * draw(random, 0, 0.15);
    const double lean = tan(draw(random, -8, 15) * M_PI / 180);
    const double rise = width * slope * (1 + way);
    const double foot = rise + corner, round = draw(random, 0, 1) < 0.5 ? 0.414 : 0;
    const double top[3][2] = {{width - corner, rise},
                              {width, foot},
                              {width + lean * (depth - edge - foot), depth - edge}};
    for (int i = 0; i < 3; i++) {
      point[side == 0 ? 3 - i : 5 + i] = (SbSealPoint){top[i][1], way * top[i][0], 0};
    }
    point[side == 0 ? 2 : 5].bulge = round;
    point[side == 0 ? 0 : 8] = (SbSealPoint){depth, way * (top[2][0] + edge + 1e-9), 0};
  }
  point[4] = (SbSealPoint){ridge + slope * width, 0, 0};
  SbGrooveDrawing out;
  SbReport report = {0};
  if (sb_groove_draw(&out, point, 9, &report) != SB_OK) {
    g_error("%s", report.text);
  }
  return out;
}

// Any profile in any gland, `drawn` or flat with one wall: solved, without an element that is
// turned over, or refused as a state that there is not: corners that do not fit, a surface that
// creases.
static void random_rings(int first, int count, bool drawn) {
  int outcome[3] = {0}; // solved, refused, given up
  int creases[2] = {0}; // solved with a surface that would crease, refused for it
  for (int number = first; number < first + count; number++) {
    GRand *random = g_rand_new_with_seed((guint32)number);
    const double h = 1.6e-3;
    SbRingBody body = body_of((SbSealProfileKind)g_rand_int_range(random, 1, 6), 0, 0);
    SbSealProfile *p = &body.profile;
    p->axial_height = h * draw(random, 0.5, 1.6);
    p->corner_radius =
        h * (p->kind == SB_SEAL_PROFILE_X ? draw(random, 0.12, 0.26) : draw(random, 0.04, 0.12));
    p->valley_depth = h * draw(random, 0.04, 0.14);
    p->web_width = p->axial_height * draw(random, 0.4, 0.8);
    p->flange_height = h * draw(random, 0.3, 0.5);
    p->lip_thickness = h * draw(random, 0.2, 0.3);
    p->lip_depth = p->axial_height * draw(random, 0.3, 0.6);
    p->lip_flare = h * draw(random, 0.0, 0.15);
    body.poisson_ratio = draw(random, 0.45, 0.499);
    SbRingLoad load = open_groove();
    load.bore_radius = load.floor_radius + h * (1 - draw(random, 0.05, 0.35));
    body.inner_diameter = 2 * load.floor_radius / (1 + draw(random, 0.0, 0.15));
    const double width = p->kind == SB_SEAL_PROFILE_X ? h : p->axial_height;
    load.wall_right = 0.5 * width * draw(random, 1.3, 2.0);
    if (draw(random, 0, 1) < 0.5) {
      load.pressure_left = draw(random, 0.0, 1.0e6);
    }
    SbGrooveDrawing groove;
    if (drawn) {
      groove = any_groove(random, load.wall_right, 0.75 * h);
      load.groove = &groove;
      load.wall_left = -load.wall_right;
    }
    const SbRingOptions options = {.tolerance = 5e-3};
    SbRingResult result;
    SbWarnings warnings = {0};
    SbReport report = {0};
    SbRing *ring = NULL;
    SbStatus status = sb_ring_fit(&ring, &result, &body, &load, &options, &warnings, &report);
    if (status == SB_OK) {
      int nodes, triangles, outline;
      SbRingFields fields = fields_of(ring, &nodes, &triangles, &outline);
      for (int i = 0; i < triangles; i++) {
        const int *t = &fields.triangle[3 * i];
        const double *a = &fields.place[2 * t[0]], *b = &fields.place[2 * t[1]],
                     *c = &fields.place[2 * t[2]];
        g_assert_cmpfloat((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), >, 0);
      }
      g_assert_cmpfloat(result.penetration, <, 1e-9);
      fields_free(&fields);
      creases[0] += warnings.count > 0 && strcmp(warnings.item[0].code, "surface-creases") == 0;
    }
    creases[1] += strstr(report.text, "creases") != NULL;
    outcome[status == SB_OK ? 0 : status == SB_ERROR_NOT_CONVERGED ? 2 : 1]++;
    if (status != SB_OK) {
      g_test_message("%d: %s, squeeze %.0f %%, %.2f MPa: %s", number, sb_seal_profile_name(p->kind),
                     100 * (1 - (load.bore_radius - load.floor_radius) / h),
                     1e-6 * load.pressure_left, report.text);
      g_assert_true(status == SB_ERROR_INFEASIBLE || status == SB_ERROR_NOT_CONVERGED);
    }
    sb_ring_destroy(ring);
    g_rand_free(random);
  }
  g_test_message("%d solved (%d with a surface that would crease), %d refused (%d that crease), %d "
                 "given up",
                 outcome[0], creases[0], outcome[1], creases[1], outcome[2]);
  // None of 600 tried; 3 of 200 in drawn grooves.
  g_assert_cmpint((drawn ? 50 : 200) * outcome[2], <=, count);
}

static int campaign_first, campaign_count;

static void campaign(void) {
  random_rings(campaign_first, campaign_count, false);
}

static void campaign_drawn(void) {
  random_rings(campaign_first, campaign_count, true);
}

static void random_slice(void) {
  random_rings(1, 4, false);
  random_rings(183, 1, false); // fluid above the contact's pressure behind a lip that holds it
  random_rings(235, 1, false);
  random_rings(378, 1, false); // no guess has a balance: from the free ring
  random_rings(1, 4, true);
}

// A T squeezed by 35 % that slides: its web's roundings crease on every mesh, and no path of
// sliding leads on. The reason is reported, as for a ring at rest (campaign random-valves, seed 18,
// numbers 315 and 342).
static void sliding_crease(void) {
  const SbRingBody body = {.profile = {.kind = SB_SEAL_PROFILE_T,
                                       .axial_height = 3.33383e-3,
                                       .corner_radius = 0.214377e-3,
                                       .web_width = 1.73801e-3,
                                       .flange_height = 1.18134e-3},
                           .section_diameter = 3.78693e-3,
                           .inner_diameter = 4.80478e-3,
                           .modulus = 3.23409e6,
                           .poisson_ratio = 0.484055};
  const SbRingOptions options = {.element_size = 0.1, .alone = true};
  SbRingLoad load = SB_RING_LOAD_INIT;
  SbReport report = {0};
  SbRing *ring;
  load.floor_radius = 2.89052e-3;
  load.bore_radius = load.floor_radius + 0.65 * body.section_diameter;
  load.wall_right = 3.29014e-3;
  load.wall_left = -load.wall_right;
  load.friction_bore = 1;
  load.friction_floor = 0.484705;
  load.friction_wall = 0.209139;
  load.rests_on_wall = true;
  load.bore_slides = 1;
  g_assert_cmpint(sb_ring_create(&ring, &body, &load, &options, &report), ==, SB_ERROR_INFEASIBLE);
  g_test_message("%s", report.text);
  g_assert_cmpint(report.cause, ==, SB_CAUSE_CREASES);
  g_assert_cmpstr(sb_input_key(report.input), ==, "seal.profile");
  g_assert_nonnull(strstr(report.text, "surface creases"));
}

// COUNT FIRST [drawn]: so many random rings from a number on, in drawn grooves, else all tests.
int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  if (argc > 2) {
    campaign_count = atoi(argv[1]);
    campaign_first = atoi(argv[2]);
    g_test_add_func("/ring-profile/campaign", argc > 3 ? campaign_drawn : campaign);
    return g_test_run();
  }
  g_test_add_func("/ring-profile/random", random_slice);
  g_test_add_func("/ring-profile/outlines", outlines);
  g_test_add_func("/ring-profile/meshes", meshes);
  g_test_add_func("/ring-profile/circle", circle);
  g_test_add_func("/ring-profile/reference", reference);
  g_test_add_func("/ring-profile/hollow", hollow);
  g_test_add_func("/ring-profile/lip", lip);
  g_test_add_func("/ring-profile/errors", errors);
  g_test_add_func("/ring-profile/rolled", rolled);
  g_test_add_func("/ring-profile/blocks", blocks);
  g_test_add_func("/ring-profile/folds", folds);
  g_test_add_func("/ring-profile/flange", flange);
  g_test_add_func("/ring-profile/sliding-crease", sliding_crease);
  g_test_add_func("/ring-profile/refusals", refusals);
  return g_test_run();
}

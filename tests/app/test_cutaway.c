// Bodies turned for the cutaway: their volumes against Pappus, the order of painting against the
// nearest surface found pixel by pixel, and that drawing on and on neither grows nor takes long.
#include "app/section/cutaway.h"
#include "tests/sanitized.h"

#include <glib.h>
#include <malloc.h>
#include <math.h>
#include <string.h>

enum { AROUND = 60, BODIES = 5 };

typedef struct {
  SbRevolveBody body;
  bool smooth;
  size_t count;
  SbValvePoint point[AROUND];
} Outline;

static void circle(Outline *out, SbRevolveBody body, double z, double r, double radius) {
  *out = (Outline){.body = body, .smooth = true, .count = AROUND};
  for (int i = 0; i < AROUND; i++) {
    double angle = 2 * G_PI * i / AROUND;
    out->point[i] = (SbValvePoint){z + radius * cos(angle), r + radius * sin(angle)};
  }
}

// A tube with a flange inside that is narrower than the stem, a stem with two grooves, and a ring
// in each: sight lines meet them in no order of the bodies.
static void make(Outline out[BODIES]) {
  static const Outline tube = {
      SB_REVOLVE_HOUSING,
      false,
      8,
      {{-6, 5}, {-6, 4}, {-4, 3.4}, {5, 3.4}, {5, 1.6}, {6, 1.6}, {6, 5}, {0, 5.4}}};
  static const Outline stem = {SB_REVOLVE_STEM,
                               false,
                               12,
                               {{9, 0},
                                {9, 1.4},
                                {4, 1.4},
                                {4, 3.2},
                                {2, 3.2},
                                {2, 1.8},
                                {-1, 1.8},
                                {-1, 3.2},
                                {-3, 3.2},
                                {-3, 1.2},
                                {-8, 1.2},
                                {-8, 0}}};
  out[0] = tube;
  out[1] = stem;
  circle(&out[2], SB_REVOLVE_OUTER, 0.5, 2.6, 0.78);
  circle(&out[3], SB_REVOLVE_INNER, -5, 1.9, 0.6);
  circle(&out[4], SB_REVOLVE_INNER, 7, 2.2, 0.7);
}

static double area_of(const Outline *o, double *radius) {
  double twice = 0, moment = 0;
  for (size_t i = 0; i < o->count; i++) {
    SbValvePoint a = o->point[i], b = o->point[(i + 1) % o->count];
    double c = a.x * b.y - b.x * a.y;
    twice += c;
    moment += c * (a.y + b.y) / 3;
  }
  *radius = moment / twice;
  return twice / 2;
}

// A flat-sided body of n sectors has sin(d)/d of the volume, d = 5 degrees: second order in d.
static void test_volume(void) {
  Outline outline[BODIES];
  make(outline);
  SbOrbit orbit = sb_orbit(0.3, 0.2);
  double d = 1.5 * G_PI / SB_REVOLVE_SECTORS;
  for (int i = 0; i < BODIES; i++) {
    SbRevolve revolve;
    sb_revolve_init(&revolve);
    sb_revolve_begin(&revolve, &orbit, 30, 0, 0);
    sb_revolve_add(&revolve, outline[i].body, outline[i].point, outline[i].count, false);
    double radius, area = area_of(&outline[i], &radius);
    double pappus = 1.5 * G_PI * radius * area;
    double volume = sb_revolve_volume(&revolve, outline[i].body);
    g_assert_cmpfloat(area, >, 0);
    g_assert_cmpfloat(fabs(volume - pappus * sin(d) / d), <, 1e-9 * pappus);
    g_assert_cmpfloat(fabs(volume - pappus), <, 1.01 * d * d / 6 * pappus);
    sb_revolve_finish(&revolve);
  }
}

// Nearness of a cell where it covers the pixel; -HUGE_VAL elsewhere.
static double cell_at(const SbRevolveCell *c, double x, double y) {
  static const int corner[2][3] = {{0, 1, 2}, {0, 2, 3}};
  for (int t = 0; t < 2; t++) {
    double px[3], py[3];
    for (int k = 0; k < 3; k++) {
      px[k] = (double)c->x[corner[t][k]];
      py[k] = (double)c->y[corner[t][k]];
    }
    double det = (px[1] - px[0]) * (py[2] - py[0]) - (px[2] - px[0]) * (py[1] - py[0]);
    double u = ((x - px[0]) * (py[2] - py[0]) - (px[2] - px[0]) * (y - py[0])) / det;
    double v = ((px[1] - px[0]) * (y - py[0]) - (x - px[0]) * (py[1] - py[0])) / det;
    if (u >= 0 && v >= 0 && u + v <= 1) {
      const float *depth = c->depth;
      return (double)depth[corner[t][0]] * (1 - u - v) + (double)depth[corner[t][1]] * u +
             (double)depth[corner[t][2]] * v;
    }
  }
  return -HUGE_VAL;
}

static bool inside(const Outline *o, double z, double r) {
  bool in = false;
  for (size_t i = 0, j = o->count - 1; i < o->count; j = i++) {
    SbValvePoint a = o->point[i], b = o->point[j];
    if ((a.y > r) != (b.y > r) && z < (b.x - a.x) * (r - a.y) / (b.y - a.y) + a.x) {
      in = !in;
    }
  }
  return in;
}

// Component of (z, r at the angle) along a vector.
static double along(const double v[3], double z, double r, double angle) {
  return v[0] * z + r * (v[1] * cos(angle) + v[2] * sin(angle));
}

// The point (z, r) [m] at `angle`: its pixel, and its nearness to the camera [m].
static void place_at(const SbRevolve *revolve, double z, double r, double angle, double out[3]) {
  const SbOrbit *orbit = &revolve->orbit;
  out[0] = revolve->x0 + revolve->scale * along(orbit->right, z, r, angle);
  out[1] = revolve->y0 - revolve->scale * along(orbit->up, z, r, angle);
  out[2] = along(orbit->toward, z, r, angle);
}

// Nearness of a cut face where a body is cut at the pixel.
static double face_at(const SbRevolve *revolve, const Outline *outline, int face, double x,
                      double y) {
  double o[3], ez[3], er[3];
  double angle = sb_revolve_face_angle(face);
  place_at(revolve, 0, 0, angle, o);
  place_at(revolve, 1, 0, angle, ez);
  place_at(revolve, 0, 1, angle, er);
  for (int i = 0; i < 3; i++) {
    ez[i] -= o[i];
    er[i] -= o[i];
  }
  double det = ez[0] * er[1] - er[0] * ez[1];
  double z = ((x - o[0]) * er[1] - er[0] * (y - o[1])) / det;
  double r = (ez[0] * (y - o[1]) - (x - o[0]) * ez[1]) / det;
  for (int i = 0; i < BODIES; i++) {
    if (r >= 0 && inside(&outline[i], z, r)) {
      return o[2] + z * ez[2] + r * er[2];
    }
  }
  return -HUGE_VAL;
}

// Share of the covered pixels whose last painted surface is not the nearest one. `reversed`: what
// the opposite order would make of it.
static double wrong_share(const SbRevolve *revolve, const Outline *outline, double size,
                          bool reversed) {
  const double step = 9.13, tolerance = 0.03;
  size_t covered = 0, wrong = 0;
  for (double y = step / 2; y < size; y += step) {
    for (double x = step / 2; x < size; x += step) {
      double nearest = -HUGE_VAL, shown = -HUGE_VAL;
      for (size_t s = 0; s < revolve->step->len; s++) {
        const SbRevolveStep *at = &g_array_index(revolve->step, SbRevolveStep, s);
        for (size_t i = 0; i < at->count && at->kind != SB_REVOLVE_EDGES; i++) {
          double depth;
          if (at->kind == SB_REVOLVE_FACE) {
            depth = face_at(revolve, outline, (int)at->first, x, y);
          } else {
            depth = cell_at(&g_array_index(revolve->cell, SbRevolveCell, at->first + i), x, y);
          }
          if (isfinite(depth)) {
            nearest = fmax(nearest, depth);
            shown = reversed && isfinite(shown) ? shown : depth;
          }
        }
      }
      covered += isfinite(nearest);
      wrong += isfinite(nearest) && shown < nearest - tolerance;
    }
  }
  g_assert_cmpuint(covered, >, 300);
  return (double)wrong / (double)covered;
}

static void test_order(void) {
  Outline outline[BODIES];
  make(outline);
  SbRevolve revolve;
  sb_revolve_init(&revolve);
  static const double camera[][2] = {{0, 0},      {-30, 20}, {35, 25},    {-70, 10},
                                     {150, 30},   {20, -40}, {-90, 0},    {89, 1},
                                     {-120, -60}, {5, 90},   {-179, -15}, {61, -89.5}};
  double worst = 0, all = 0;
  // The sanitizer looks for other faults, and slowly.
  for (size_t i = 0; i < G_N_ELEMENTS(camera); i += SB_SANITIZED ? 4 : 1) {
    SbOrbit orbit = sb_orbit(camera[i][0] * G_PI / 180, camera[i][1] * G_PI / 180);
    sb_revolve_begin(&revolve, &orbit, 20, 200, 200);
    for (int b = 0; b < BODIES; b++) {
      sb_revolve_add(&revolve, outline[b].body, outline[b].point, outline[b].count,
                     outline[b].smooth);
    }
    sb_revolve_build(&revolve);
    double wrong = wrong_share(&revolve, outline, 400, false);
    g_test_message("azimuth %g, elevation %g: %.2f %% painted wrongly", camera[i][0], camera[i][1],
                   100 * wrong);
    worst = fmax(worst, wrong);
    all += wrong / G_N_ELEMENTS(camera);
    if (i < 3) {
      g_assert_cmpfloat(wrong_share(&revolve, outline, 400, true), >, 0.2);
    }
  }
  g_assert_cmpfloat(worst, <=, 0.004);
  g_assert_cmpfloat(all, <=, 0.001);
  sb_revolve_finish(&revolve);
}

// A turning camera over a moving stem: after one turn nothing is allocated any more.
static void test_steady(void) {
  SbParams params;
  sb_params_init(&params);
  SbModel *model = NULL;
  g_assert_cmpint(sb_model_create(&model, &params, NULL, NULL, NULL), ==, SB_OK);
  SbSectionLimits limits = {.inner_contact_left = -0.3e-3, .pressure_max = 1.2e6};
  SbSection *section = sb_section_create(model, &limits);
  SbDrawList list;
  sb_draw_list_init(&list);
  SbFrame frame = {.stage = SB_STAGE_B};
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    frame.seal[i] =
        (SbSealFrame){.land_fraction = 1, .contact_left = -0.35e-3, .contact_right = 0.35e-3};
  }
  SbSectionInstant instant = {.frame = &frame};
  size_t allocated = 0;
  enum { TURN = 60, PICTURES = (SB_SANITIZED ? 1 : 4) * TURN };
  for (int i = 0; i < PICTURES; i++) {
    double phase = 2 * G_PI * i / TURN;
    frame.displacement = 0.5 * sb_model_value(model, SB_P_DRIVE_STROKE) * (1 - cos(phase));
    SbSectionView view = {.width = 1216,
                          .height = 568,
                          .margin = 20,
                          .cutaway = true,
                          .hide_labels = true,
                          .azimuth = phase,
                          .elevation = sin(phase)};
    sb_section_draw(section, &list, &view, &instant);
    if (i == TURN) {
      allocated = mallinfo2().uordblks;
    }
  }
  g_test_message("%zu items, %zu points", list.item_count, list.point_count);
  g_assert_cmpuint(list.item_count, >, SB_REVOLVE_SECTORS); // the cells of the bodies
  if (!SB_SANITIZED) {
    // Captions with new angles are remembered by the text measurer.
    g_assert_cmpuint(mallinfo2().uordblks, <, allocated + 64 * 1024);
  }
  sb_draw_list_finish(&list);
  sb_section_destroy(section);
  sb_model_destroy(model);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/cutaway/volume", test_volume);
  g_test_add_func("/cutaway/order", test_order);
  g_test_add_func("/cutaway/steady", test_steady);
  return g_test_run();
}

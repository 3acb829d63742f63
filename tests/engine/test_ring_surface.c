// The ring's surface for films against full solutions of the ring: the split into half-plane and
// smooth part must give the ring's own dry contact, how it changes with the approach, and not
// depend on the mesh.
#include "engine/contact/ring/ring.h"
#include "tests/engine/seals.h"

#include <glib.h>
#include <math.h>

static SbSurfaceCompliance surface(SbRing *ring) {
  SbSurfaceCompliance c;
  SbReport report = {0};
  SbStatus status = sb_ring_surface(ring, &c, &report);
  if (status != SB_OK) {
    g_test_message("%s", report.text);
  }
  g_assert_cmpint(status, ==, SB_OK);
  return c;
}

// Net load per length as the dry contact takes it: above the left pressure for x < 0, above the
// right one for x > 0, from the profile.
static double net_load(const SbRing *ring) {
  double x[1024], p[1024], sum = 0.0;
  int n = sb_ring_profile(ring, x, p, 1024);
  for (int i = 1; i < n; i++) {
    sum += 0.5 * (p[i] + p[i - 1]) * (x[i] - x[i - 1]);
  }
  const SbRingLoad *load = sb_ring_load(ring);
  return sum + load->pressure_left * x[0] - load->pressure_right * x[n - 1];
}

static void near(const char *what, double value, double reference, double tolerance) {
  g_test_message("%s %.6g, ring %.6g (%+.3f %%)", what, value, reference,
                 100.0 * (value / reference - 1.0));
  g_assert_cmpfloat(fabs(value / reference - 1.0), <=, tolerance);
}

// -int p ln|x - s| ds from a to b.
static double logarithm(const SbDryContact *dry, double a, double b, double x) {
  enum { POINTS = 4000 };
  double half = 0.5 * (b - a), middle = 0.5 * (a + b), sum = 0.0;
  for (int i = 0; i < POINTS; i++) {
    double theta = G_PI * (i + 0.5) / POINTS, s = middle - half * cos(theta);
    sum -= sb_dry_contact_pressure(dry, s) * log(fabs(x - s)) * half * sin(theta) * G_PI / POINTS;
  }
  return sum;
}

// Elastic displacement at x by what acts within the window, up to a constant.
static double displacement(const SbSurfaceCompliance *c, const SbDryContact *dry, double x) {
  return 4.0 / (G_PI * c->modulus) *
             (logarithm(dry, c->left, dry->left, x) + logarithm(dry, dry->left, dry->right, x) +
              logarithm(dry, dry->right, c->right, x)) +
         sb_compliance_smooth(c, x, dry->moment, NULL);
}

// The dry contact of the surface is the ring's, and follows it when the bore comes nearer: 4-5 % in
// the approach at a given load, less than a tenth in width and peak at 13 % more load.
static void test_dry(void) {
  static const double PRESSURE[] = {0.0, 0.29e6};
  for (int k = 0; k < 2; k++) {
    SbRingLoad load = groove(PRESSURE[k]);
    SbRing *ring = fitted(&BODY, &load, 0.03);
    SbSurfaceCompliance c = surface(ring);
    g_test_message("modulus %.4g Pa, of the unstrained rubber %.4g Pa", c.modulus,
                   2.0 * BODY.modulus / (1.0 - 0.49 * 0.49));
    SbRingResult r, after;
    sb_ring_result(ring, &r);
    SbReport report = {0};
    SbDryContact dry, more;
    double w0 = net_load(ring);
    g_assert_cmpint(sb_dry_contact(&dry, &c, w0, load.pressure_left, load.pressure_right, &report),
                    ==, SB_OK);
    near("width", dry.right - dry.left, r.contact_right - r.contact_left, 0.01);
    near("peak", dry.peak, r.pressure_peak, 0.01);
    // A little nearer: the approach by a step of the same ring (of several nodes, since on one mesh
    // the fluid's edge moves by nodes), the edges by rings fitted anew.
    static const double APPROACH[] = {6e-6, 20e-6};
    for (int i = 0; i < 2; i++) {
      SbRingLoad next = load;
      next.bore_radius -= APPROACH[i];
      SbRing *other = i == 0 ? ring : fitted(&BODY, &next, 0.03);
      g_assert_cmpint(sb_ring_step(other, &next, &report), ==, SB_OK);
      sb_ring_result(other, &after);
      g_assert_cmpint(sb_dry_contact(&more, &c, net_load(other), load.pressure_left,
                                     load.pressure_right, &report),
                      ==, SB_OK);
      if (i == 0) {
        double x = 0.5 * (dry.left + dry.right);
        near("approach", displacement(&c, &more, x) - displacement(&c, &dry, x), APPROACH[i], 0.08);
      } else {
        near("change of width", (more.right - more.left) - (dry.right - dry.left),
             (after.contact_right - after.contact_left) - (r.contact_right - r.contact_left), 0.15);
        near("change of peak", more.peak - dry.peak, after.pressure_peak - r.pressure_peak, 0.15);
        sb_ring_destroy(other);
      }
    }
    sb_ring_destroy(ring);
  }
}

// The recovered pressure: its integral is the load, its ends and its root's strength at them hardly
// depend on the mesh, and it has no kinks at nodes (its second differences in the angle change sign
// a few times at most, nodal pressures at every node).
static void test_pressure(void) {
  static const double PRESSURE[] = {0.0, 0.29e6, 0.7e6}, SIZE[] = {0.012, 0.02, 0.03, 0.05};
  for (int k = 0; k < 3; k++) {
    double width[4];
    for (int i = 0; i < 4; i++) {
      SbRingLoad load = groove(PRESSURE[k]);
      SbRing *ring = fitted(&BODY, &load, SIZE[i]);
      SbRingResult r;
      sb_ring_result(ring, &r);
      double x[1024], p[1024], sum = 0.0;
      int n = sb_ring_profile(ring, x, p, 1024), turns = 0;
      double before = 0.0;
      for (int j = 1; j < n; j++) {
        sum += 0.5 * (p[j] + p[j - 1]) * (x[j] - x[j - 1]);
        double second = j + 1 < n ? p[j + 1] - 2.0 * p[j] + p[j - 1] : before;
        turns += second * before < 0.0 ? 1 : 0;
        before = second;
      }
      width[i] = r.contact_right - r.contact_left;
      g_test_message("size %.3f: load %.6g, of the profile %.6g N, width %.5g mm, %d turns",
                     SIZE[i], r.bore_force, sum * 2.0 * G_PI * load.bore_radius, 1e3 * width[i],
                     turns);
      g_assert_cmpfloat(fabs(sum * 2.0 * G_PI * load.bore_radius / r.bore_force - 1.0), <, 3e-5);
      g_assert_cmpfloat(x[0], ==, r.contact_left);
      g_assert_cmpfloat(fabs(x[n - 1] - r.contact_right), <, 1e-15);
      g_assert_cmpint(turns, <=, 6);
      g_assert_cmpfloat(fabs(width[i] / width[0] - 1.0), <, k == 0 ? 1.5e-3 : 3e-3);
      sb_ring_destroy(ring);
    }
  }
}

// Largest difference of two smooth parts within the common window, less its mean.
static double distance(const SbSurfaceCompliance *a, const SbSurfaceCompliance *b) {
  enum { N = 21 };
  double left = fmax(a->left, b->left), right = fmin(a->right, b->right), worst = 0.0, mean = 0.0;
  double off[N][N];
  for (int i = 0; i < N; i++) {
    for (int j = 0; j < N; j++) {
      double x = left + (right - left) * (i + 0.5) / N, s = left + (right - left) * (j + 0.5) / N;
      double ta[SB_COMPLIANCE_MODES], tb[SB_COMPLIANCE_MODES];
      sb_compliance_modes(a, s, ta, NULL);
      sb_compliance_modes(b, s, tb, NULL);
      off[i][j] = sb_compliance_smooth(a, x, ta, NULL) - sb_compliance_smooth(b, x, tb, NULL);
      mean += off[i][j] / (N * N);
    }
  }
  for (int i = 0; i < N * N; i++) {
    worst = fmax(worst, fabs(off[i / N][i % N] - mean));
  }
  return worst;
}

// A finer mesh changes modulus and smooth part little; along and across the diagonal the
// smooth part has bounded second differences (the logarithm's would be 4 C at the last).
static void test_smooth(void) {
  SbRingLoad load = groove(0.0);
  SbRing *coarse = fitted(&BODY, &load, 0.03), *fine = fitted(&BODY, &load, 0.02);
  SbSurfaceCompliance a = surface(coarse), b = surface(fine);
  near("modulus, coarse", a.modulus, b.modulus, 0.02);
  double worst = distance(&a, &b), unit = 4.0 / (G_PI * b.modulus);
  g_test_message("meshes differ by %.3g C", worst / unit);
  g_assert_cmpfloat(worst, <=, 0.25 * unit);
  double half = 0.5 * (b.right - b.left), middle = 0.5 * (b.left + b.right);
  for (int i = -3; i <= 3; i++) {
    double x = middle + 0.2 * i * half;
    for (double h = 0.1 * half; h > 1e-4 * half; h *= 0.5) {
      double v[3];
      for (int k = 0; k < 3; k++) {
        double t[SB_COMPLIANCE_MODES];
        sb_compliance_modes(&b, x + (k - 1) * h, t, NULL);
        v[k] = sb_compliance_smooth(&b, x, t, NULL);
      }
      double second = (v[0] - 2.0 * v[1] + v[2]) / (h * h) * half * half;
      g_assert_cmpfloat(fabs(second), <=, 40.0 * unit);
    }
  }
  sb_ring_destroy(coarse);
  sb_ring_destroy(fine);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/ring-surface/dry", test_dry);
  g_test_add_func("/ring-surface/pressure", test_pressure);
  g_test_add_func("/ring-surface/smooth", test_smooth);
  return g_test_run();
}

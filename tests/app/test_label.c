// The collision rule: what is placed never overlaps, stays inside, prefers its first place, keeps
// off curves, and gives way.
#include "app/draw/label.h"

#include <glib.h>
#include <math.h>

static SbLabels labels;

static void test_never_overlaps(void) {
  GRand *rand = g_rand_new_with_seed(3);
  sb_labels_init(&labels, (SbRect){0, 0, 600, 400});
  int placed = 0;
  for (int i = 0; i < 400; i++) {
    SbPlace offer[3], at;
    for (int k = 0; k < 3; k++) {
      offer[k] = (SbPlace){g_rand_double_range(rand, -50, 650), g_rand_double_range(rand, -20, 420),
                           (SbAlign)g_rand_int_range(rand, 0, 3)};
    }
    placed += sb_labels_place_box(&labels, g_rand_double_range(rand, 10, 90), 12, offer, 3, &at);
  }
  g_rand_free(rand);
  g_test_message("%d of 400 placed", placed);
  g_assert_cmpint(placed, >, 40);
  g_assert_cmpint(placed, ==, labels.box_count);
  for (int i = 0; i < labels.box_count; i++) {
    SbRect a = labels.box[i];
    g_assert_true(a.x >= 0 && a.y >= 0 && a.x + a.width <= 600 && a.y + a.height <= 400);
    for (int k = i + 1; k < labels.box_count; k++) {
      g_assert_cmpfloat(sb_rect_overlap(a, labels.box[k]), ==, 0);
    }
  }
}

static void test_prefers_and_avoids(void) {
  const SbPlace offer[2] = {{100, 100, SB_LEFT}, {100, 200, SB_LEFT}};
  SbPlace at;
  // Both free: the first.
  sb_labels_init(&labels, (SbRect){0, 0, 600, 400});
  g_assert_true(sb_labels_place_box(&labels, 60, 12, offer, 2, &at));
  g_assert_cmpfloat(at.y, ==, 100);
  // Taken: the second; both taken: none.
  g_assert_true(sb_labels_place_box(&labels, 60, 12, offer, 2, &at));
  g_assert_cmpfloat(at.y, ==, 200);
  g_assert_false(sb_labels_place_box(&labels, 60, 12, offer, 2, &at));
  // A curve through the first: the second.
  sb_labels_init(&labels, (SbRect){0, 0, 600, 400});
  SbPoint curve[200];
  for (int i = 0; i < 200; i++) {
    curve[i] = (SbPoint){3.0 * i, 96 + 2 * sin(0.1 * i)};
  }
  sb_labels_avoid(&labels, curve, 200, 1);
  g_assert_true(sb_labels_place_box(&labels, 60, 12, offer, 2, &at));
  g_assert_cmpfloat(at.y, ==, 200);
  // With a limit, a place on the curve is refused altogether.
  labels.crossing_max = 1;
  g_assert_false(sb_labels_place_box(&labels, 60, 12, offer, 1, &at));
}

// A corner of densely sampled points is not cut.
static void test_corner(void) {
  sb_labels_init(&labels, (SbRect){0, 0, 600, 400});
  SbPoint curve[401];
  for (int i = 0; i <= 400; i++) {
    curve[i] = i < 200 ? (SbPoint){100, 100 + 0.5 * i} : (SbPoint){100 + 0.5 * (i - 200), 200};
  }
  sb_labels_avoid(&labels, curve, 401, 1);
  double length = 0;
  for (int i = 0; i < labels.line_count; i++) {
    length +=
        hypot(labels.line[i].b.x - labels.line[i].a.x, labels.line[i].b.y - labels.line[i].a.y);
  }
  g_assert_cmpfloat(fabs(length - 200), <, 1);
  // Just inside the corner there is room.
  SbPlace at;
  const SbPlace offer = {104, 194, SB_LEFT};
  labels.crossing_max = 0;
  g_assert_true(sb_labels_place_box(&labels, 40, 12, &offer, 1, &at));
}

// Boxes that are widened keep later labels at a distance; those before them do not.
static void test_widen(void) {
  SbPlace at;
  const SbPlace a = {100, 100, SB_LEFT}, beside = {170, 100, SB_LEFT};
  for (int first = 0; first < 2; first++) {
    sb_labels_init(&labels, (SbRect){0, 0, 600, 400});
    g_assert_true(sb_labels_place_box(&labels, 60, 12, &a, 1, &at));
    sb_labels_widen(&labels, first, 12);
    g_assert_true(sb_labels_place_box(&labels, 40, 12, &beside, 1, &at) == (first == 1));
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/label/never-overlaps", test_never_overlaps);
  g_test_add_func("/label/prefers-and-avoids", test_prefers_and_avoids);
  g_test_add_func("/label/corner", test_corner);
  g_test_add_func("/label/widen", test_widen);
  return g_test_run();
}

// Steps of a ring allocate nothing apart from the sparse factorisation, which is SuiteSparse's own:
// the linker sends the engine's calls of malloc here (-Wl,--wrap) to be counted.
#include "tests/engine/seals.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);

static int calls;

void *__wrap_malloc(size_t size) {
  calls++;
  return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size) {
  calls++;
  return __real_calloc(count, size);
}

void *__wrap_realloc(void *old, size_t size) {
  calls++;
  return __real_realloc(old, size);
}

static void test_steps(void) {
  SbRingLoad load = groove(0.2e6);
  load.friction_bore = load.friction_floor = load.friction_wall = 0.2;
  SbReport report = {0};
  calls = 0;
  SbRing *ring = fitted(&BODY, &load, 0.06);
  g_test_message("%d calls to fit the ring", calls);
  g_assert_cmpint(calls, >, 10); // the counter counts
  calls = 0;
  SbRingResult r;
  double x[256], p[256];
  for (int i = 0; i < 6; i++) {
    load.bore_position += i < 3 ? 2e-5 : -2e-5;
    load.pressure_left *= 1.02;
    g_assert_cmpint(sb_ring_step(ring, &load, &report), ==, SB_OK);
    sb_ring_result(ring, &r);
    sb_ring_profile(ring, x, p, 256);
  }
  // The land's edge passes under the seal, with snaps that are followed in viscous steps.
  load.land_right = 0.6e-3;
  for (int i = 0; i < 4; i++) {
    load.land_right -= 0.2e-3;
    g_assert_cmpint(sb_ring_step(ring, &load, &report), ==, SB_OK);
  }
  g_assert_cmpint(calls, ==, 0);
  sb_ring_destroy(ring);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/ring-allocations/steps", test_steps);
  return g_test_run();
}

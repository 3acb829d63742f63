// A run as bytes and back: what is shown of it is the same to the bit, and bytes that were cut or
// are another model's make no run.
#include "engine/valve/figures/figures.h"
#include "engine/valve/sealbench.h"

#include <glib.h>
#include <stdlib.h>
#include <string.h>

// Closed forms with profiles, and a life of three actuations.
static SbModel *model_new(int frames) {
  SbParams params;
  SbModel *model;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_FRAMES, frames, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_LIFE_ACTUATIONS, 3, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_create(&model, &params, NULL, NULL, NULL), ==, SB_OK);
  return model;
}

static void assert_same(const SbRun *a, const SbRun *b) {
  size_t m, n;
  const SbFrame *of_a = sb_run_frames(a, &m), *of_b = sb_run_frames(b, &n);
  g_assert_cmpuint(m, ==, n);
  g_assert_cmpmem(of_a, m * sizeof *of_a, of_b, n * sizeof *of_b);
  for (size_t i = 0; i < m; i++) {
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      const SbContactProfile *p = sb_run_profile(a, of_a[i].seal[seal].profile);
      const SbContactProfile *q = sb_run_profile(b, of_b[i].seal[seal].profile);
      g_assert_true((p == NULL) == (q == NULL));
      if (p != NULL) {
        g_assert_cmpstr(p->model, ==, q->model);
        g_assert_cmpmem(p->x, p->count * sizeof(double), q->x, q->count * sizeof(double));
        g_assert_cmpmem(p->film, p->count * sizeof(double), q->film, q->count * sizeof(double));
      }
    }
  }
  const SbLifeActuation *lives = sb_run_life(a, &m), *again = sb_run_life(b, &n);
  g_assert_cmpmem(lives, m * sizeof *lives, again, n * sizeof *again);
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const double x = sb_figure_value(sb_run_summary(a), i);
    const double y = sb_figure_value(sb_run_summary(b), i);
    g_assert_cmpmem(&x, sizeof x, &y, sizeof y);
    g_assert_cmpstr(sb_figure_reason(sb_run_summary(a), i), ==,
                    sb_figure_reason(sb_run_summary(b), i));
  }
}

static void test_kept(void) {
  SbModel *model = model_new(300);
  SbPlan plan;
  sb_plan_wished(&plan, model, &(SbPlanWishes){.views = SB_VIEW_PROFILES, .life = true});
  SbRun *run, *back;
  SbReport report;
  g_assert_cmpint(sb_run_create(&run, model, &plan, NULL), ==, SB_OK);
  void *bytes;
  size_t size;
  g_assert_cmpint(sb_run_pack(&bytes, &size, run, &report), ==, SB_ERROR_INPUT); // not executed
  g_assert_null(bytes);
  g_assert_cmpint(sb_run_execute(run, NULL, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_pack(&bytes, &size, run, &report), ==, SB_OK);
  g_assert_cmpint(sb_run_unpack(&back, model, &plan, bytes, size, &report), ==, SB_OK);
  assert_same(run, back);
  sb_run_destroy(back);

  // Cut anywhere, or with something behind it.
  for (size_t cut = 0; cut < size; cut += size / 400 + 1) {
    void *part = g_memdup2(bytes, cut); // of its own, so that a read behind it is found
    g_assert_cmpint(sb_run_unpack(&back, model, &plan, part, cut, &report), ==, SB_ERROR_INPUT);
    g_assert_null(back);
    g_free(part);
  }
  void *longer = g_malloc0(size + 8);
  memcpy(longer, bytes, size);
  g_assert_cmpint(sb_run_unpack(&back, model, &plan, longer, size + 8, &report), ==,
                  SB_ERROR_INPUT);
  // Of another build: the head differs in any byte.
  for (size_t i = 0; i < 40; i += 4) {
    memcpy(longer, bytes, size);
    ((unsigned char *)longer)[i] ^= 0x10;
    g_assert_cmpint(sb_run_unpack(&back, model, &plan, longer, size, &report), ==, SB_ERROR_INPUT);
  }
  g_free(longer);
  // More frames than the model has room for.
  SbModel *less = model_new(20);
  sb_plan_wished(&plan, less, &(SbPlanWishes){.views = SB_VIEW_PROFILES});
  SbRun *room;
  g_assert_cmpint(sb_run_create(&room, less, &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_unpack(&back, less, &plan, bytes, size, &report), ==,
                  sb_run_capacity(room) < sb_run_summary(run)->frames ? SB_ERROR_INPUT : SB_OK);
  sb_run_destroy(back);
  sb_run_destroy(room);
  free(bytes);
  sb_run_destroy(run);
  sb_model_destroy(less);
  sb_model_destroy(model);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-store/kept", test_kept);
  return g_test_run();
}

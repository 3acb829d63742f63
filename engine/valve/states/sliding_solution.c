// The results of a state's solvers as terms of sums (sliding_beside.c).
#include "engine/valve/states/sliding_private.h"

#include <stddef.h>

SbSlidingSolved *sb_sliding_slot(SbSlidingMemory *memory, int i) {
  SbSlidingSolved *const slots[SB_SLIDING_FILMS] = {&memory->plane, &memory->fitted, &memory->rest};
  return slots[i];
}

// Runs of doubles in a solution.
#define RUN(from, to) offsetof(SbSlidingSolution, from), offsetof(SbSlidingSolution, to)
#define FILM_RUNS(i)                                                                               \
  {RUN(on[i].film.film_min, on[i].film.ruptured)}, {                                               \
    RUN(on[i].film.hertz_half_width, on[i].film.regime)                                            \
  }
static const struct {
  size_t from, to;
} runs[] = {{RUN(fit.squeeze, fit.touches)},
            {RUN(fit.ring.floor_load, fit.ring.drag_limit)},
            {RUN(fit.ring.turn, fit.ring.state)},
            {RUN(fit.profile_x, fit.surface)},
            {RUN(fit.surface.left, body)}, // from here on what the fitment alone has not
            {RUN(body.load, body.compliance.modes)},
            {RUN(body.compliance.left, on)},
            FILM_RUNS(0),
            FILM_RUNS(1),
            FILM_RUNS(2)};
#undef FILM_RUNS
#undef RUN
enum { RUNS = sizeof runs / sizeof *runs, FITMENT_RUNS = 4 };

void sb_solution_add(SbSlidingSolution *out, double by, const SbSlidingSolution *from,
                     SbSolutionPart part) {
  const size_t first = part == SB_SOLUTION_FILMS ? FITMENT_RUNS : 0;
  const size_t end = part == SB_SOLUTION_FITMENT ? FITMENT_RUNS : RUNS;
  for (size_t k = first; k < end; k++) {
    double *a = (double *)(void *)((char *)out + runs[k].from);
    const double *b = (const double *)(const void *)((const char *)from + runs[k].from);
    for (size_t i = 0; i < (runs[k].to - runs[k].from) / sizeof(double); i++) {
      a[i] += by * b[i];
    }
  }
}

void sb_solution_take(SbSlidingSolution *out, SbSlidingMemory *memory) {
  out->fit = memory->now->fit;
  out->body = memory->body;
  for (int i = 0; i < SB_SLIDING_FILMS; i++) {
    const SbSlidingSolved *from = sb_sliding_slot(memory, i);
    out->on[i].solved = from->fresh;
    out->on[i].fitted = from->fitted;
    out->on[i].share = from->share;
    out->on[i].film = from->film;
  }
}

bool sb_solution_alike(const SbSlidingSolution *a, const SbSlidingSolution *b, bool fitment) {
  bool same = a->fit.profile_count == b->fit.profile_count && a->fit.touches == b->fit.touches &&
              a->fit.ring.state == b->fit.ring.state;
  same = same && (fitment || (a->fit.surface.modes == b->fit.surface.modes &&
                              a->body.compliance.modes == b->body.compliance.modes));
  for (int i = 0; i < SB_SLIDING_FILMS && !fitment; i++) {
    same = same && a->on[i].solved == b->on[i].solved && a->on[i].fitted == b->on[i].fitted &&
           a->on[i].film.ruptured == b->on[i].film.ruptured &&
           a->on[i].film.starved == b->on[i].film.starved;
  }
  return same;
}

void sb_sliding_copy_film(SbSlidingSolved *out, SbSlidingMemory *memory) {
  for (int i = 0; i < SB_SLIDING_FILMS; i++) {
    if (sb_sliding_slot(memory, i) == out) {
      out->film = memory->sum.on[i].film;
      out->fitted = memory->sum.on[i].fitted;
      out->share = memory->sum.on[i].share;
    }
  }
}

bool sb_sliding_film_summed(const SbSlidingMemory *memory, const SbSlidingSolved *which,
                            bool fitted) {
  const SbSlidingSolved *const slots[SB_SLIDING_FILMS] = {&memory->plane, &memory->fitted,
                                                          &memory->rest};
  bool is = false;
  for (int i = 0; i < SB_SLIDING_FILMS; i++) {
    is =
        is || (slots[i] == which && memory->sum.on[i].solved && memory->sum.on[i].fitted == fitted);
  }
  return is && memory->sums == SB_SUM_ALL;
}

// Four doubles side by side, which is what the ring's sums over elements and blocks are made of.
//
// The same source is compiled twice, for any processor and for one whose registers hold all four;
// which of them runs is asked at run time. Neither fuses products and sums, and each of the four
// has its own sum in the same order, so that both give the same bits. What holds two only (before
// 2013, or not of that family) takes about twice as long.
#pragma once

#include <stdbool.h>

typedef double SbQuad __attribute__((vector_size(32)));
// The same anywhere in an array of doubles.
typedef double SbQuadAt __attribute__((vector_size(32), aligned(8), may_alias));

#define SB_QUAD_INLINE static inline __attribute__((always_inline))

#if defined(__x86_64__)
#define SB_QUAD_WIDE __attribute__((target("avx2")))
static inline bool sb_quad_wide(void) {
  return __builtin_cpu_supports("avx2");
}
#else
#define SB_QUAD_WIDE
static inline bool sb_quad_wide(void) {
  return false;
}
#endif

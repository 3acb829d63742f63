// Vectors of four doubles for the sums over elements and blocks. Private to engine/contact/ring.
//
// Functions that use them are compiled twice, for any processor and, with the attribute
// SB_QUAD_WIDE, for AVX2. The caller selects the version at run time: the wide one only if
// sb_quad_wide() returns true. Functions that both versions call are defined with SB_QUAD_INLINE,
// so that each is compiled with its caller. Neither version fuses products and sums, and each of
// the four has its own sum in the same order, so both give bit-identical results.
#pragma once

#include <stdbool.h>

// Four doubles, aligned.
typedef double SbQuad __attribute__((vector_size(32)));

// Four doubles at any position of an array of doubles.
typedef double SbQuadAt __attribute__((vector_size(32), aligned(8), may_alias));

// Begins the definition of a static function that is always inlined. Builds that assert leave the
// inlining to the compiler: with the checks of a sanitizer the assembly of the elements in one
// function takes four times as long to compile.
#ifdef SB_ASSERT_RUNS
#define SB_QUAD_INLINE static inline
#else
#define SB_QUAD_INLINE static inline __attribute__((always_inline))
#endif

#if defined(__x86_64__)
#define SB_QUAD_WIDE __attribute__((target("avx2")))
// Returns whether this processor supports AVX2.
static inline bool sb_quad_wide(void) {
  return __builtin_cpu_supports("avx2");
}
#else
#define SB_QUAD_WIDE
// Returns false: there is only one version.
static inline bool sb_quad_wide(void) {
  return false;
}
#endif

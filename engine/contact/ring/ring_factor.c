// By columns, each gathered from those before it that have a block in its row; U's rows have the
// pattern of L's columns.
#include "engine/contact/ring/ring_factor.h"
#include "engine/contact/ring/ring_quad.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/amd.h>

enum { BLOCK = SB_RING_BLOCK };

struct SbRingFactor {
  atomic_uint *holders; // of the lists up to mirror_of, which equal factors share
  int nodes;
  int *order;             // [nodes] node of each place
  int *start;             // [nodes + 1] of each column's blocks below the diagonal
  int *row;               // [start[nodes]] their places, rising
  int *pattern;           // [nodes + 1] where each place's blocks of A begin in the two lists
  int *column_of;         // [blocks of A] their place
  int *block_of;          // [blocks of A] their number in A
  int *mirror_of;         // [blocks of A] the number of the block across the diagonal
  int *first;             // [nodes] columns that have a block in a row, as lists
  int *next, *at;         // [nodes] the next of the list; where each column has got to
  double *lower, *upper;  // [BLOCK start[nodes]]
  double *inverse;        // [BLOCK nodes] of the pivots
  double *below, *beside; // [BLOCK nodes] the column and the row in work
  double *work;           // [2 nodes]
};

void sb_ring_factor_destroy(SbRingFactor *factor) {
  if (factor == NULL) {
    return;
  }
  if (factor->holders == NULL || atomic_fetch_sub(factor->holders, 1) == 1) {
    free(factor->holders);
    free(factor->order);
    free(factor->row);
    free(factor->pattern);
  }
  free(factor->first);
  free(factor->lower);
  free(factor);
}

static int compare(const void *a, const void *b) {
  return *(const int *)a - *(const int *)b;
}

// Pattern of the factor: a column has the rows of A's and those of the columns whose first row it
// is. `mark` is scratch, [nodes].
static bool find_pattern(SbRingFactor *f, int *mark) {
  const int n = f->nodes;
  size_t room = 0;
  int *child = f->first, *sibling = f->next;
  memset(child, -1, sizeof(int) * (size_t)n);
  memset(mark, -1, sizeof(int) * (size_t)n);
  f->start[0] = 0;
  for (int j = 0; j < n; j++) {
    size_t at = (size_t)f->start[j];
    if (at + (size_t)n > room) {
      room = 2 * room + 8 * (size_t)n;
      int *row = realloc(f->row, room * sizeof *row);
      if (row == NULL) {
        return false;
      }
      f->row = row;
    }
    mark[j] = j;
    for (int k = f->pattern[j]; k < f->pattern[j + 1]; k++) {
      if (f->column_of[k] > j) {
        mark[f->column_of[k]] = j;
        f->row[at++] = f->column_of[k];
      }
    }
    for (int c = child[j]; c >= 0; c = sibling[c]) {
      for (int k = f->start[c]; k < f->start[c + 1]; k++) {
        if (mark[f->row[k]] != j) {
          mark[f->row[k]] = j;
          f->row[at++] = f->row[k];
        }
      }
    }
    qsort(&f->row[f->start[j]], at - (size_t)f->start[j], sizeof(int), compare);
    f->start[j + 1] = (int)at;
    if (f->start[j + 1] > f->start[j]) {
      const int parent = f->row[f->start[j]];
      sibling[j] = child[parent];
      child[parent] = j;
    }
  }
  return true;
}

SbRingFactor *sb_ring_factor_create(int nodes, const int *start, const int *column) {
  const size_t n = (size_t)nodes, blocks = (size_t)start[nodes];
  SbRingFactor *f = calloc(1, sizeof *f);
  int *place = malloc(sizeof(int) * 2 * n), *mark = place + n;
  if (f != NULL) {
    f->nodes = nodes;
    f->holders = malloc(sizeof *f->holders);
    if (f->holders != NULL) {
      atomic_init(f->holders, 1);
    }
    f->order = malloc(sizeof(int) * (2 * n + 1));
    f->first = malloc(sizeof(int) * 3 * n);
    f->pattern = malloc(sizeof(int) * (n + 1 + 3 * blocks));
  }
  bool good = f != NULL && place != NULL && f->holders != NULL && f->order != NULL &&
              f->first != NULL && f->pattern != NULL &&
              amd_order(nodes, start, column, f->order, NULL, NULL) >= AMD_OK;
  if (good) {
    f->start = f->order + n;
    f->next = f->first + n;
    f->at = f->next + n;
    f->column_of = f->pattern + n + 1;
    f->block_of = f->column_of + blocks;
    f->mirror_of = f->block_of + blocks;
    for (int i = 0; i < nodes; i++) {
      place[f->order[i]] = i;
    }
    int at = 0;
    for (int i = 0; i < nodes; i++) {
      const int node = f->order[i];
      f->pattern[i] = at;
      for (int k = start[node]; k < start[node + 1]; k++) {
        int other = start[column[k]];
        while (column[other] != node) {
          other++;
        }
        f->column_of[at] = place[column[k]];
        f->block_of[at] = k;
        f->mirror_of[at++] = other;
      }
    }
    f->pattern[nodes] = at;
    good = find_pattern(f, mark);
  }
  free(place);
  if (!good) {
    sb_ring_factor_destroy(f);
    f = NULL;
  }
  return f;
}

SbRingFactor *sb_ring_factor_like(const SbRingFactor *factor) {
  const size_t n = (size_t)factor->nodes;
  SbRingFactor *f = malloc(sizeof *f);
  int *first = malloc(sizeof(int) * 3 * n);
  if (f == NULL || first == NULL) {
    free(f);
    free(first);
    return NULL;
  }
  *f = *factor;
  f->lower = NULL;
  f->first = first;
  f->next = first + n;
  f->at = f->next + n;
  atomic_fetch_add(f->holders, 1);
  return f;
}

// Room for the numbers.
static bool make_room(SbRingFactor *f) {
  const size_t n = (size_t)f->nodes, filled = (size_t)f->start[n];
  f->lower = malloc(sizeof(double) * (BLOCK * (2 * filled + 3 * n) + 2 * n));
  if (f->lower == NULL) {
    return false;
  }
  f->upper = f->lower + BLOCK * filled;
  f->inverse = f->upper + BLOCK * filled;
  f->below = f->inverse + BLOCK * n;
  f->beside = f->below + BLOCK * n;
  f->work = f->beside + BLOCK * n;
  memset(f->below, 0, sizeof(double) * 2 * BLOCK * n); // all else is written before it is read
  return true;
}

SB_QUAD_INLINE bool invert(double *out, const double *a) {
  const double det = a[0] * a[3] - a[1] * a[2];
  const double scale = 1.0 / det;
  out[0] = a[3] * scale;
  out[1] = -a[1] * scale;
  out[2] = -a[2] * scale;
  out[3] = a[0] * scale;
  return isfinite(scale);
}

// Takes a column that has got to block k to the list of that block's row.
SB_QUAD_INLINE void list(SbRingFactor *f, int column, int k) {
  if (k < f->start[column + 1]) {
    f->at[column] = k;
    f->next[column] = f->first[f->row[k]];
    f->first[f->row[k]] = column;
  }
}

// Columns of a block are next to each other; its rows are one below the other.
#define FIRST_COLUMN(a) __builtin_shufflevector(a, a, 0, 0, 2, 2)
#define OTHER_COLUMN(a) __builtin_shufflevector(a, a, 1, 1, 3, 3)
#define FIRST_ROW(a)    __builtin_shufflevector(a, a, 0, 1, 0, 1)
#define OTHER_ROW(a)    __builtin_shufflevector(a, a, 2, 3, 2, 3)

SB_QUAD_INLINE bool compute(SbRingFactor *f, const double *value) {
  const int n = f->nodes;
  double *restrict below = f->below, *restrict beside = f->beside;
  memset(f->first, -1, sizeof(int) * (size_t)n);
  for (int j = 0; j < n; j++) {
    for (int k = f->pattern[j]; k < f->pattern[j + 1]; k++) {
      const int i = f->column_of[k];
      if (i >= j) {
        memcpy(&below[BLOCK * i], &value[BLOCK * f->mirror_of[k]], BLOCK * sizeof(double));
        memcpy(&beside[BLOCK * i], &value[BLOCK * f->block_of[k]], BLOCK * sizeof(double));
      }
    }
    for (int c = f->first[j], after; c >= 0; c = after) {
      after = f->next[c];
      const int begin = f->at[c], end = f->start[c + 1];
      const SbQuad l = *(const SbQuadAt *)&f->lower[BLOCK * begin];
      const SbQuad u = *(const SbQuadAt *)&f->upper[BLOCK * begin];
      const SbQuad l0 = FIRST_COLUMN(l), l1 = OTHER_COLUMN(l), u0 = FIRST_ROW(u), u1 = OTHER_ROW(u);
      *(SbQuadAt *)&below[BLOCK * j] -= l0 * u0 + l1 * u1;
      for (int k = begin + 1; k < end; k++) {
        const int i = BLOCK * f->row[k];
        const SbQuad left = *(const SbQuadAt *)&f->lower[BLOCK * k];
        const SbQuad right = *(const SbQuadAt *)&f->upper[BLOCK * k];
        *(SbQuadAt *)&below[i] -= FIRST_COLUMN(left) * u0 + OTHER_COLUMN(left) * u1;
        *(SbQuadAt *)&beside[i] -= l0 * FIRST_ROW(right) + l1 * OTHER_ROW(right);
      }
      list(f, c, begin + 1);
    }
    double *inverse = &f->inverse[BLOCK * j];
    const bool good = invert(inverse, &below[BLOCK * j]);
    const SbQuad v = *(const SbQuadAt *)inverse, v0 = FIRST_ROW(v), v1 = OTHER_ROW(v);
    const SbQuad none = {0.0, 0.0, 0.0, 0.0};
    for (int k = f->start[j]; k < f->start[j + 1]; k++) {
      SbQuadAt *b = (SbQuadAt *)&below[BLOCK * f->row[k]];
      SbQuadAt *u = (SbQuadAt *)&beside[BLOCK * f->row[k]];
      const SbQuad left = *b;
      *(SbQuadAt *)&f->lower[BLOCK * k] = FIRST_COLUMN(left) * v0 + OTHER_COLUMN(left) * v1;
      *(SbQuadAt *)&f->upper[BLOCK * k] = *u;
      *b = none;
      *u = none;
    }
    memset(&below[BLOCK * j], 0, BLOCK * sizeof(double));
    memset(&beside[BLOCK * j], 0, BLOCK * sizeof(double));
    if (!good) {
      return false;
    }
    list(f, j, f->start[j]);
  }
  return true;
}

SB_QUAD_WIDE static bool compute_wide(SbRingFactor *f, const double *value) {
  return compute(f, value);
}

static bool compute_any(SbRingFactor *f, const double *value) {
  return compute(f, value);
}

bool sb_ring_factor_compute(SbRingFactor *f, const double *value) {
  if (f->lower == NULL && !make_room(f)) {
    return false;
  }
  return sb_quad_wide() ? compute_wide(f, value) : compute_any(f, value);
}

void sb_ring_factor_solve(SbRingFactor *f, double *x, const double *b) {
  const int n = f->nodes;
  double *y = f->work;
  for (int i = 0; i < n; i++) {
    y[2 * i] = b[2 * f->order[i]];
    y[2 * i + 1] = b[2 * f->order[i] + 1];
  }
  for (int j = 0; j < n; j++) {
    const double y0 = y[2 * j], y1 = y[2 * j + 1];
    for (int k = f->start[j]; k < f->start[j + 1]; k++) {
      const double *l = &f->lower[BLOCK * k];
      y[2 * f->row[k]] -= l[0] * y0 + l[1] * y1;
      y[2 * f->row[k] + 1] -= l[2] * y0 + l[3] * y1;
    }
  }
  for (int j = n - 1; j >= 0; j--) {
    double y0 = y[2 * j], y1 = y[2 * j + 1];
    for (int k = f->start[j]; k < f->start[j + 1]; k++) {
      const double *u = &f->upper[BLOCK * k], *z = &y[2 * f->row[k]];
      y0 -= u[0] * z[0] + u[1] * z[1];
      y1 -= u[2] * z[0] + u[3] * z[1];
    }
    const double *inverse = &f->inverse[BLOCK * j];
    y[2 * j] = inverse[0] * y0 + inverse[1] * y1;
    y[2 * j + 1] = inverse[2] * y0 + inverse[3] * y1;
  }
  for (int i = 0; i < n; i++) {
    x[2 * f->order[i]] = y[2 * i];
    x[2 * f->order[i] + 1] = y[2 * i + 1];
  }
}

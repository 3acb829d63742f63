// See cholesky.h. Places are those in the order of elimination; row `k` of L is gathered while the
// columns before it are walked up the tree.
#include "engine/numeric/cholesky.h"

#include <stdlib.h>
#include <string.h>
#include <suitesparse/amd.h>

struct SbCholesky {
  int n;
  const int *start, *column; // borrowed
  int *order, *place;        // [n] unknown of each place, and back
  int *parent;               // [n] in the elimination tree, -1: a root
  size_t *first;             // [n + 1] where each column of L begins
  int *count;                // [n] entries so far
  int *flag, *path;          // [n]
  int *row;                  // [first[n]]
  double *lower;             // [first[n]]
  double *pivot, *work;      // [n]
};

void sb_cholesky_destroy(SbCholesky *f) {
  if (f != NULL) {
    free(f->order);
    free(f->first);
    free(f->row);
    free(f->lower);
    free(f->pivot);
    free(f);
  }
}

// Tree and number of entries of each column, by all paths from the entries of a row upwards.
static void find_tree(SbCholesky *f) {
  for (int k = 0; k < f->n; k++) {
    f->parent[k] = -1;
    f->flag[k] = k;
    f->count[k] = 0;
    const int unknown = f->order[k];
    for (int at = f->start[unknown]; at < f->start[unknown + 1]; at++) {
      for (int i = f->place[f->column[at]]; i < k && f->flag[i] != k; i = f->parent[i]) {
        f->parent[i] = f->parent[i] < 0 ? k : f->parent[i];
        f->count[i]++;
        f->flag[i] = k;
      }
    }
  }
  f->first[0] = 0;
  for (int k = 0; k < f->n; k++) {
    f->first[k + 1] = f->first[k] + (size_t)f->count[k];
  }
}

SbCholesky *sb_cholesky_create(int n, const int *start, const int *column) {
  SbCholesky *f = calloc(1, sizeof *f);
  const size_t room = (size_t)(n > 0 ? n : 1);
  if (f == NULL) {
    return NULL;
  }
  *f = (SbCholesky){.n = n, .start = start, .column = column};
  f->order = calloc(6 * room, sizeof *f->order);
  f->first = calloc(room + 1, sizeof *f->first);
  f->pivot = calloc(2 * room, sizeof *f->pivot);
  if (f->order == NULL || f->first == NULL || f->pivot == NULL ||
      amd_order(n, start, column, f->order, NULL, NULL) < 0) {
    sb_cholesky_destroy(f);
    return NULL;
  }
  f->place = f->order + n;
  f->parent = f->place + n;
  f->count = f->parent + n;
  f->flag = f->count + n;
  f->path = f->flag + n;
  f->work = f->pivot + n;
  for (int k = 0; k < n; k++) {
    f->place[f->order[k]] = k;
  }
  find_tree(f);
  f->row = calloc(f->first[n] + 1, sizeof *f->row);
  f->lower = calloc(f->first[n] + 1, sizeof *f->lower);
  if (f->row == NULL || f->lower == NULL) {
    sb_cholesky_destroy(f);
    return NULL;
  }
  return f;
}

// Scatters row k of A, and puts the columns that row k of L has into path[top .. n), each before
// those above it. Returns top.
static int gather(SbCholesky *f, int k, const double *value) {
  const int unknown = f->order[k];
  int top = f->n;
  f->flag[k] = k;
  for (int at = f->start[unknown]; at < f->start[unknown + 1]; at++) {
    int i = f->place[f->column[at]], length = 0;
    if (i > k) {
      continue;
    }
    f->work[i] += value[at];
    for (; f->flag[i] != k; i = f->parent[i]) {
      f->path[length++] = i;
      f->flag[i] = k;
    }
    while (length > 0) {
      f->path[--top] = f->path[--length];
    }
  }
  return top;
}

bool sb_cholesky_compute(SbCholesky *f, const double *value) {
  double *y = f->work;
  memset(y, 0, sizeof *y * (size_t)f->n);
  memset(f->count, 0, sizeof *f->count * (size_t)f->n);
  memset(f->flag, -1, sizeof *f->flag * (size_t)f->n);
  for (int k = 0; k < f->n; k++) {
    int top = gather(f, k, value);
    double pivot = y[k];
    y[k] = 0.0;
    for (; top < f->n; top++) {
      const int i = f->path[top];
      const double yi = y[i], entry = yi / f->pivot[i];
      const size_t begin = f->first[i], end = begin + (size_t)f->count[i];
      y[i] = 0.0;
      for (size_t p = begin; p < end; p++) {
        y[f->row[p]] -= f->lower[p] * yi;
      }
      pivot -= entry * yi;
      f->row[end] = k;
      f->lower[end] = entry;
      f->count[i]++;
    }
    if (!(pivot > 0.0)) {
      return false;
    }
    f->pivot[k] = pivot;
  }
  return true;
}

void sb_cholesky_solve(const SbCholesky *f, double *b) {
  double *x = f->work;
  for (int k = 0; k < f->n; k++) {
    x[k] = b[f->order[k]];
  }
  for (int k = 0; k < f->n; k++) {
    for (size_t p = f->first[k]; p < f->first[k] + (size_t)f->count[k]; p++) {
      x[f->row[p]] -= f->lower[p] * x[k];
    }
  }
  for (int k = f->n - 1; k >= 0; k--) {
    x[k] /= f->pivot[k];
    for (size_t p = f->first[k]; p < f->first[k] + (size_t)f->count[k]; p++) {
      x[k] -= f->lower[p] * x[f->row[p]];
    }
    b[f->order[k]] = x[k];
  }
}

// Multifrontal LU (Duff and Reid 1983) of the ring's tangent: a dense front for each group of nodes
// that are eliminated together.
//
// The columns of a group have nearly the same pattern below it (supernodes, Liu 1992, relaxed: some
// zeros are kept for fewer and larger fronts). A front takes the matrix's entries of its nodes and
// what its children left, eliminates its nodes, four pivots at a time, and leaves the rest to its
// parent on a stack. Without pivoting beyond the diagonal: the tangent is that of a stable or
// nearly stable body, and a condition keeps its row's diagonal large (ring_sparse.c).
#include "engine/contact/ring/ring_fronts.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Nodes of a group at most, and the share of kept zeros that it may have.
enum { GROUP_MAX = 24, SMALL = 64 };
static const double ZEROS_MOST = 0.25;

// One front: nodes `first` .. `first + own - 1` in the order of elimination, and `rest` later ones.
typedef struct {
  int first, own, rest, parent;
  int later;     // place of these in `index`
  int children;  // fronts whose rest it takes, the last ones on the stack
  int blocks;    // place of its first block of the matrix
  size_t factor; // place of its factors: own rows whole, then the rest's rows in the own columns
} Front;

// A 2 x 2 block of the matrix: where its rows begin among the values and in the front.
typedef struct {
  int from, width, to;
} Block;

struct SbRingFronts {
  int nodes, fronts;
  int *order;    // [nodes] node at each place of the elimination
  int *index;    // places of the fronts' later nodes
  int *relative; // [as index] their places in the parent's front
  Front *front;  // [fronts + 1]
  Block *block;
  double *factor, *work, *stack; // one front; what the children left
  double *x;                     // [2 nodes]
};

// ---- symbolic

// Sizes grow with the fill, which is known last.
typedef struct {
  int *item;
  size_t count, room;
} List;

static bool push(List *list, int item) {
  if (list->count == list->room) {
    size_t room = list->room > 0 ? 2 * list->room : 4096;
    int *grown = realloc(list->item, room * sizeof *grown);
    if (grown == NULL) {
      return false;
    }
    list->item = grown;
    list->room = room;
  }
  list->item[list->count++] = item;
  return true;
}

typedef struct {
  const int *row_start, *column;
  int nodes;
  int *order, *place, *parent, *mark, *head, *next, *start; // [nodes], start [nodes + 1]
  List pattern;                                             // of the columns below the diagonal
} Symbolic;

static int degree(const Symbolic *s, int node) {
  return (s->row_start[2 * node + 1] - s->row_start[2 * node]) / 2;
}

static int neighbour(const Symbolic *s, int node, int k) {
  return s->column[s->row_start[2 * node] + 2 * k] / 2;
}

static void set_places(Symbolic *s) {
  for (int i = 0; i < s->nodes; i++) {
    s->place[s->order[i]] = i;
  }
}

// The elimination tree (Liu 1986), `mark` as the shortened paths.
static void make_tree(Symbolic *s) {
  for (int i = 0; i < s->nodes; i++) {
    s->parent[i] = s->mark[i] = -1;
    for (int k = 0; k < degree(s, s->order[i]); k++) {
      int j = s->place[neighbour(s, s->order[i], k)];
      while (j >= 0 && j < i) {
        int up = s->mark[j];
        s->mark[j] = i;
        s->parent[j] = up < 0 ? i : s->parent[j];
        j = up;
      }
    }
  }
}

// Takes the nodes into a postorder of the tree, so that children come right before their parents.
static void postorder(Symbolic *s) {
  int root = -1, at = 0, *stack = s->mark, *order = s->start;
  memset(s->head, -1, sizeof(int) * (size_t)s->nodes);
  for (int i = s->nodes - 1; i >= 0; i--) {
    int *list = s->parent[i] >= 0 ? &s->head[s->parent[i]] : &root;
    s->next[i] = *list;
    *list = i;
  }
  for (int top = 0; root >= 0;) {
    stack[0] = root;
    root = s->next[root];
    for (top = 1; top > 0;) {
      int i = stack[top - 1], child = s->head[i];
      if (child >= 0) {
        s->head[i] = s->next[child];
        stack[top++] = child;
      } else {
        order[at++] = s->order[i];
        top--;
      }
    }
  }
  memcpy(s->order, order, sizeof(int) * (size_t)s->nodes);
}

static int compare(const void *a, const void *b) {
  return *(const int *)a - *(const int *)b;
}

// Patterns of the factors' columns, each from the matrix's and those of its children.
static bool make_patterns(Symbolic *s) {
  memset(s->head, -1, sizeof(int) * (size_t)s->nodes);
  memset(s->mark, -1, sizeof(int) * (size_t)s->nodes);
  for (int i = 0; i < s->nodes; i++) {
    s->start[i] = (int)s->pattern.count;
    s->mark[i] = i;
    for (int k = 0; k < degree(s, s->order[i]); k++) {
      int j = s->place[neighbour(s, s->order[i], k)];
      if (j > i && s->mark[j] != i) {
        s->mark[j] = i;
        if (!push(&s->pattern, j)) {
          return false;
        }
      }
    }
    for (int child = s->head[i]; child >= 0; child = s->next[child]) {
      for (int k = s->start[child]; k < s->start[child + 1]; k++) {
        int j = s->pattern.item[k];
        if (j > i && s->mark[j] != i) {
          s->mark[j] = i;
          if (!push(&s->pattern, j)) {
            return false;
          }
        }
      }
    }
    s->start[i + 1] = (int)s->pattern.count;
    int count = s->start[i + 1] - s->start[i];
    if (count > 0) {
      qsort(&s->pattern.item[s->start[i]], (size_t)count, sizeof(int), compare);
      s->next[i] = s->head[s->pattern.item[s->start[i]]];
      s->head[s->pattern.item[s->start[i]]] = i;
    }
  }
  return true;
}

static int below(const Symbolic *s, int i) {
  return s->start[i + 1] - s->start[i];
}

// Groups columns; `next` becomes the front of each.
static void make_groups(SbRingFronts *f, Symbolic *s) {
  for (int i = 0; i < s->nodes;) {
    Front *front = &f->front[f->fronts];
    double sum = below(s, i) + 1.0; // nodes of the columns as they are
    int last = i;
    for (int j = i + 1; j < s->nodes && j - i < GROUP_MAX; j++) {
      if (below(s, j - 1) == 0 || s->pattern.item[s->start[j - 1]] != j) {
        break;
      }
      sum += below(s, j) + 1.0;
      double own = j - i + 1.0, whole = own * (own + 1.0) / 2.0 + own * below(s, j);
      if (whole - sum > ZEROS_MOST * whole && whole > SMALL) {
        break;
      }
      last = j;
    }
    *front = (Front){.first = i, .own = last - i + 1, .rest = below(s, last)};
    for (; i <= last; i++) {
      s->next[i] = f->fronts;
    }
    f->fronts++;
  }
}

// Place of a node in a front.
static int place_in(const SbRingFronts *f, const Front *front, int node) {
  if (node < front->first + front->own) {
    return node - front->first;
  }
  const int *later = &f->index[front->later];
  int low = 0, high = front->rest - 1;
  while (low < high) {
    int middle = (low + high) / 2;
    if (later[middle] < node) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return front->own + low;
}

static int size_of(const Front *front) {
  return 2 * (front->own + front->rest);
}

static bool allocate(SbRingFronts *f, const Symbolic *s) {
  size_t later = 0, factor = 0, most = 0, stack = 0, highest = 0;
  int blocks = s->row_start[2 * s->nodes] / 4;
  for (int k = 0; k < f->fronts; k++) {
    Front *front = &f->front[k];
    size_t n = (size_t)size_of(front), own = 2 * (size_t)front->own;
    front->later = (int)later;
    front->factor = factor;
    later += (size_t)front->rest;
    factor += own * n + (n - own) * own;
    most = n * n > most ? n * n : most;
  }
  f->index = malloc(sizeof(int) * (later + 1));
  f->relative = malloc(sizeof(int) * (later + 1));
  if (f->index == NULL || f->relative == NULL) {
    return false;
  }
  for (int k = 0; k < f->fronts; k++) {
    Front *front = &f->front[k];
    memcpy(&f->index[front->later], &s->pattern.item[s->start[front->first + front->own - 1]],
           sizeof(int) * (size_t)front->rest);
    front->parent = front->rest > 0 ? s->next[f->index[front->later]] : -1;
    if (front->parent >= 0) {
      f->front[front->parent].children++;
    }
  }
  // Heights of the stack, children popped before their parent's rest is pushed.
  size_t *left = malloc(sizeof(size_t) * (size_t)f->fronts);
  int top = 0;
  for (int k = 0; left != NULL && k < f->fronts; k++) {
    const Front *front = &f->front[k];
    for (int c = 0; c < front->children; c++) {
      stack -= left[--top];
    }
    left[top] = 4 * (size_t)front->rest * (size_t)front->rest;
    stack += left[top];
    top += front->rest > 0;
    highest = stack > highest ? stack : highest;
  }
  bool good = left != NULL;
  free(left);
  f->block = malloc(sizeof(Block) * (size_t)blocks);
  f->factor = malloc(sizeof(double) * (factor + 1));
  f->work = malloc(sizeof(double) * (most + 1));
  f->stack = malloc(sizeof(double) * (highest + 1));
  f->x = malloc(sizeof(double) * 2 * (size_t)s->nodes);
  return good && f->block != NULL && f->factor != NULL && f->work != NULL && f->stack != NULL &&
         f->x != NULL;
}

// Where the matrix's blocks go, and the fronts' rest in their parents.
static void make_maps(SbRingFronts *f, const Symbolic *s) {
  int at = 0;
  for (int k = 0; k < f->fronts; k++) {
    Front *front = &f->front[k];
    const int n = size_of(front), end = front->first + front->own;
    front->blocks = at;
    for (int i = front->first; i < end; i++) {
      const int node = s->order[i], row = i - front->first;
      for (int b = 0; b < degree(s, node); b++) {
        const int other = neighbour(s, node, b), j = s->place[other];
        if (j < front->first) {
          continue;
        }
        const int column = place_in(f, front, j);
        f->block[at++] =
            (Block){s->row_start[2 * node] + 2 * b, 2 * degree(s, node), 2 * row * n + 2 * column};
        for (int c = 0; j >= end && c < degree(s, other); c++) {
          if (neighbour(s, other, c) == node) {
            f->block[at++] = (Block){s->row_start[2 * other] + 2 * c, 2 * degree(s, other),
                                     2 * column * n + 2 * row};
          }
        }
      }
    }
    for (int r = 0; r < front->rest; r++) {
      f->relative[front->later + r] =
          place_in(f, &f->front[front->parent], f->index[front->later + r]);
    }
  }
  f->front[f->fronts].blocks = at;
}

static bool analyse(SbRingFronts *f, Symbolic *s, const int *order) {
  int count = 0;
  memset(s->mark, 0, sizeof(int) * (size_t)s->nodes);
  for (int i = 0; i < 2 * s->nodes; i++) {
    if (s->mark[order[i] / 2]++ == 0) {
      s->order[count++] = order[i] / 2;
    }
  }
  set_places(s);
  make_tree(s);
  postorder(s);
  set_places(s);
  if (!make_patterns(s)) {
    return false;
  }
  make_groups(f, s);
  if (!allocate(f, s)) {
    return false;
  }
  make_maps(f, s);
  memcpy(f->order, s->order, sizeof(int) * (size_t)s->nodes);
  return true;
}

SbRingFronts *sb_ring_fronts_create(int nodes, const int *row_start, const int *column,
                                    const int *order) {
  SbRingFronts *f = calloc(1, sizeof *f);
  size_t n = (size_t)nodes;
  Symbolic s = {.row_start = row_start, .column = column, .nodes = nodes};
  s.order = malloc(sizeof(int) * (7 * n + 1));
  bool good = f != NULL && s.order != NULL;
  if (good) {
    s.place = s.order + n;
    s.parent = s.order + 2 * n;
    s.mark = s.order + 3 * n;
    s.head = s.order + 4 * n;
    s.next = s.order + 5 * n;
    s.start = s.order + 6 * n;
    f->nodes = nodes;
    f->order = malloc(sizeof(int) * n);
    f->front = calloc(n + 1, sizeof(Front));
    good = f->order != NULL && f->front != NULL && analyse(f, &s, order);
  }
  free(s.order);
  free(s.pattern.item);
  if (!good) {
    sb_ring_fronts_destroy(f);
    return NULL;
  }
  return f;
}

void sb_ring_fronts_destroy(SbRingFronts *f) {
  if (f != NULL) {
    void *owned[] = {f->order,  f->index, f->relative, f->front, f->block,
                     f->factor, f->work,  f->stack,    f->x};
    for (size_t i = 0; i < sizeof owned / sizeof owned[0]; i++) {
      free(owned[i]);
    }
    free(f);
  }
}

// ---- numeric

// a -= l u of four pivots, two rows of a at once.
static void update(double *restrict a, double *restrict b, const double l[4], const double m[4],
                   const double *restrict u, int n, int count) {
  const double *u1 = u + n, *u2 = u + 2 * n, *u3 = u + 3 * n;
  for (int j = 0; j < count; j++) {
    a[j] -= l[0] * u[j] + l[1] * u1[j] + l[2] * u2[j] + l[3] * u3[j];
    b[j] -= m[0] * u[j] + m[1] * u1[j] + m[2] * u2[j] + m[3] * u3[j];
  }
}

// Eliminates the first `own` rows and columns of a row-major matrix; own and n are even.
static bool eliminate(double *restrict a, int own, int n) {
  for (int k = 0; k < own;) {
    const int width = own - k >= 4 ? 4 : 2, end = k + width;
    for (int p = k; p < end; p++) {
      const double *top = &a[p * n];
      if (!(fabs(top[p]) > DBL_MIN)) {
        return false;
      }
      const double inverse = 1.0 / top[p];
      for (int i = p + 1; i < n; i++) {
        double *row = &a[i * n];
        const double factor = row[p] *= inverse;
        for (int j = p + 1; j < (i < end ? n : end); j++) {
          row[j] -= factor * top[j];
        }
      }
    }
    for (int i = end; i < n; i += 2) {
      double *row = &a[i * n], *next = row + n;
      if (width == 4) {
        update(row + end, next + end, row + k, next + k, &a[k * n + end], n, n - end);
        continue;
      }
      const double *restrict u = &a[k * n], *restrict v = u + n;
      for (int j = end; j < n; j++) {
        row[j] -= row[k] * u[j] + row[k + 1] * v[j];
        next[j] -= next[k] * u[j] + next[k + 1] * v[j];
      }
    }
    k = end;
  }
  return true;
}

bool sb_ring_fronts_factor(SbRingFronts *f, const double *value) {
  double *top = f->stack;
  for (int k = 0; k < f->fronts; k++) {
    const Front *front = &f->front[k];
    const int n = size_of(front), own = 2 * front->own, rest = n - own;
    double *a = f->work;
    memset(a, 0, sizeof(double) * (size_t)n * (size_t)n);
    for (int b = front->blocks; b < front[1].blocks; b++) {
      const Block *block = &f->block[b];
      const double *from = &value[block->from];
      double *to = &a[block->to];
      to[0] = from[0];
      to[1] = from[1];
      to[n] = from[block->width];
      to[n + 1] = from[block->width + 1];
    }
    // The children's rest, the last child's on top: fronts are in postorder.
    int child = k;
    for (int c = 0; c < front->children; c++) {
      do {
        child--;
      } while (f->front[child].parent != k);
      const Front *from = &f->front[child];
      const int *relative = &f->relative[from->later], count = from->rest;
      top -= 4 * count * count;
      for (int i = 0; i < count; i++) {
        const double *row = &top[4 * i * count];
        double *to = &a[2 * relative[i] * n];
        for (int j = 0; j < count; j++) {
          double *entry = &to[2 * relative[j]];
          entry[0] += row[2 * j];
          entry[1] += row[2 * j + 1];
          entry[n] += row[2 * count + 2 * j];
          entry[n + 1] += row[2 * count + 2 * j + 1];
        }
      }
    }
    if (!eliminate(a, own, n)) {
      return false;
    }
    double *factor = &f->factor[front->factor];
    memcpy(factor, a, sizeof(double) * (size_t)own * (size_t)n);
    factor += own * n;
    for (int i = own; i < n; i++) {
      memcpy(factor, &a[i * n], sizeof(double) * (size_t)own);
      factor += own;
      memcpy(top, &a[i * n + own], sizeof(double) * (size_t)rest);
      top += rest;
    }
  }
  return true;
}

void sb_ring_fronts_solve(const SbRingFronts *f, double *x) {
  double *y = f->x;
  for (int i = 0; i < f->nodes; i++) {
    y[2 * i] = x[2 * f->order[i]];
    y[2 * i + 1] = x[2 * f->order[i] + 1];
  }
  for (int k = 0; k < f->fronts; k++) {
    const Front *front = &f->front[k];
    const int n = size_of(front), own = 2 * front->own, *later = &f->index[front->later];
    const double *a = &f->factor[front->factor];
    double *top = &y[2 * front->first];
    for (int i = 1; i < own; i++) {
      for (int j = 0; j < i; j++) {
        top[i] -= a[i * n + j] * top[j];
      }
    }
    a += own * n;
    for (int i = 0; i < n - own; i++, a += own) {
      double sum = 0.0, other = 0.0;
      for (int j = 0; j < own; j += 2) {
        sum += a[j] * top[j];
        other += a[j + 1] * top[j + 1];
      }
      y[2 * later[i / 2] + i % 2] -= sum + other;
    }
  }
  for (int k = f->fronts - 1; k >= 0; k--) {
    const Front *front = &f->front[k];
    const int n = size_of(front), own = 2 * front->own, *later = &f->index[front->later];
    double *top = &y[2 * front->first], *rest = f->work;
    for (int i = 0; i < front->rest; i++) {
      rest[2 * i] = y[2 * later[i]];
      rest[2 * i + 1] = y[2 * later[i] + 1];
    }
    for (int i = own - 1; i >= 0; i--) {
      const double *a = &f->factor[front->factor + (size_t)i * (size_t)n];
      double sum = top[i], other = 0.0;
      for (int j = i + 1; j < own; j++) {
        sum -= a[j] * top[j];
      }
      for (int j = own; j < n; j += 2) {
        sum -= a[j] * rest[j - own];
        other -= a[j + 1] * rest[j - own + 1];
      }
      top[i] = (sum + other) / a[i];
    }
  }
  for (int i = 0; i < f->nodes; i++) {
    x[2 * f->order[i]] = y[2 * i];
    x[2 * f->order[i] + 1] = y[2 * i + 1];
  }
}

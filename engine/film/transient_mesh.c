// Mesh and elastic kernel of the transient film.
//
// Nodes crowd at both edges of the contact. The pressure is a straight line between nodes with the
// bend of its second differences; both are integrated against the logarithm exactly. A fitted body
// adds its smooth part through the moments of the nodes' hats (elastic/compliance.h).
#include <cblas.h>
#include <math.h>
#include <string.h>

#include "engine/film/layers.h"
#include "engine/film/transient_internal.h"
#include "engine/numeric/legendre.h"

// f'' = ln|y|.
static double second_integral(double y) {
  return y == 0.0 ? 0.0 : 0.5 * y * y * (log(fabs(y)) - 1.5);
}

static double first_integral(double y) {
  return y == 0.0 ? 0.0 : y * (log(fabs(y)) - 1.0);
}

static double third_integral(double y) {
  return y == 0.0 ? 0.0 : y * y * y / 6.0 * (log(fabs(y)) - 11.0 / 6.0);
}

// Integrals over [a, b] times ln|X - s|: of the straight lines that are 1 at a, and at b, and of
// the parabola (s - a)(b - s)/2. Far away by Gauss' rule, where the closed forms would cancel.
typedef struct {
  double left, right, bubble;
} Moments;

static Moments moments(double X, double a, double b) {
  static const double node[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  static const double weight[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const double h = b - a;
  const double y = X - 0.5 * (a + b);
  Moments out = {0};
  if (fabs(y) > 4.0 * h) {
    double even = 0.0, odd = 0.0, bubble = 0.0;
    for (int q = 0; q < 3; q++) {
      const double near = log(fabs(y - 0.5 * h * node[q])), far = log(fabs(y + 0.5 * h * node[q]));
      even += weight[q] * (near + far);
      odd += weight[q] * node[q] * (near - far);
      bubble += weight[q] * (1.0 - node[q] * node[q]) * (near + far);
    }
    out = (Moments){0.25 * h * (even - odd), 0.25 * h * (even + odd), h * h * h / 16.0 * bubble};
    return out;
  }
  const double by_a = X - a, by_b = X - b;
  const double rise = (second_integral(by_b) - second_integral(by_a)) / h;
  out.left = first_integral(by_a) + rise;
  out.right = -first_integral(by_b) - rise;
  out.bubble = 0.5 * h * (second_integral(by_a) + second_integral(by_b)) - third_integral(by_a) +
               third_integral(by_b);
  return out;
}

// Second difference of the pressure at node j: factors of j - 1, j, j + 1.
static void second_difference(double out[3], const SbFilmTransient *t, int j) {
  const double left = t->X[j] - t->X[j - 1];
  const double right = t->X[j + 1] - t->X[j];
  out[0] = 2.0 / (left * (left + right));
  out[2] = 2.0 / (right * (left + right));
  out[1] = -out[0] - out[2];
}

static void build_kernel(SbFilmTransient *t) {
  const int n = t->nodes;
  for (int i = 0; i < n; i++) {
    double *row = t->kernel + (size_t)i * (size_t)n;
    memset(row, 0, (size_t)n * sizeof *row);
    for (int j = 0; j + 1 < n; j++) {
      const Moments moment = moments(t->X[i], t->X[j], t->X[j + 1]);
      row[j] -= moment.left / M_PI;
      row[j + 1] -= moment.right / M_PI;
      // The bend between the nodes: p = line - p'' (s - a)(b - s)/2, p'' the ends' mean.
      const double bend = moment.bubble / M_PI;
      for (int k = j; k <= j + 1; k++) {
        if (k > 0 && k + 1 < n) {
          double d[3];
          second_difference(d, t, k);
          for (int m = 0; m < 3; m++) {
            row[k - 1 + m] += 0.5 * bend * d[m];
          }
        }
      }
    }
    t->known[i] = t->inlet / M_PI * first_integral(t->X[i] - t->X[0]) -
                  t->outlet / M_PI * first_integral(t->X[i] - t->X[n - 1]) +
                  (t->inlet - t->outlet) / M_PI * log(2.0) * t->X[i];
  }
}

// What follows from the nodes.
static void complete(SbFilmTransient *t) {
  const int n = t->nodes;
  for (int i = 0; i < n; i++) {
    const double left = i > 0 ? 0.5 * (t->X[i - 1] - t->X[i]) : 0.0;
    const double right = i + 1 < n ? 0.5 * (t->X[i + 1] - t->X[i]) : 0.0;
    t->volume[i] = t->weight[i] = right - left;
    t->mean[i][0] = t->mean[i][2] = 0.0;
    if (i > 0 && i + 1 < n) { // the parabola through three heights, over the cell
      const double cube = (right * right * right - left * left * left) / 3.0;
      const double square = 0.5 * (right * right - left * left);
      t->mean[i][0] = (cube - 2.0 * right * square) / (4.0 * left * (left - right));
      t->mean[i][2] = (cube - 2.0 * left * square) / (4.0 * right * (right - left));
    }
    t->mean[i][1] = t->volume[i] - t->mean[i][0] - t->mean[i][2];
  }
  for (int j = 0; j + 1 < n; j++) {
    const double h = t->X[j + 1] - t->X[j];
    for (int k = j; k <= j + 1; k++) {
      if (k > 0 && k + 1 < n) {
        double d[3];
        second_difference(d, t, k);
        for (int m = 0; m < 3; m++) {
          t->weight[k - 1 + m] -= 0.5 * h * h * h / 12.0 * d[m];
        }
      }
    }
  }
  build_kernel(t);
  t->present_half = NAN;
  t->factored = false;
}

// Spacing wanted at X: a share of the distance to the edge, and what the film's bends ask for with
// the way that the wall carries them.
static double spacing(const SbFilmTransient *t, double X) {
  const double share = 0.15 * t->fineness;
  double out = share * hypot(0.5 * t->layer, fabs(X) - 1.0);
  if (fabs(X) < 1.0) {
    out /= hypot(1.0, out / (0.03 * t->fineness));
  }
  for (int i = 0; i < t->nodes; i++) {
    if (t->wanted[i] < out) {
      const double away = fmax(X - t->X[i] - t->span[1], t->X[i] + t->span[0] - X);
      out = fmin(out, t->wanted[i] + share * fmax(away, 0.0));
    }
  }
  return out;
}

// Nodes of one half from its end to the middle; their number, or -1 if they are too many.
static int march(double *X, const SbFilmTransient *t, double side) {
  enum { HALF = SB_TRANSIENT_NODES_MAX / 2 };
  int n = 0;
  double at = t->reach;
  while (n < HALF) {
    X[n++] = side * at;
    double step = 0.0;
    for (int pass = 0; pass < 3; pass++) {
      step = spacing(t, side * (at - 0.5 * step));
    }
    if (at < 0.5 * step) {
      break;
    }
    at -= step;
  }
  if (n == HALF) {
    return -1;
  }
  // The last node comes to the middle, those of the inner half contact with it.
  const double stretch = 0.5 / (0.5 - at);
  for (int i = 0; i < n; i++) {
    const double d = fabs(X[i]);
    X[i] = side * X[i] < 0.5 ? side * (0.5 - (0.5 - side * X[i]) * stretch) : side * d;
  }
  X[n - 1] = 0.0;
  return n;
}

// Lays nodes into `X`; their number.
static int lay(double *X, SbFilmTransient *t) {
  double *other = t->scratch[1];
  for (;;) {
    const int left = march(X, t, -1.0);
    const int right = left > 0 ? march(other, t, 1.0) : -1;
    if (right > 0) {
      for (int i = right - 2; i >= 0; i--) {
        X[left + right - 2 - i] = other[i];
      }
      return left + right - 1;
    }
    for (int i = 0; i < t->nodes; i++) {
      t->wanted[i] *= 1.25;
    }
    if (t->nodes == 0) {
      t->fineness *= 1.25;
    }
  }
}

void sb_transient_mesh(SbFilmTransient *t, double rest) {
  SbLayers layers = {.lambda = t->scale.lambda, .starvation = 1.0};
  memcpy(layers.bow, t->scale.bow, sizeof layers.bow);
  t->layer = fmin(sb_layers_width(&layers), 2.0);
  t->reach = 1.0 + fmax(fmax(4.0, 60.0 * t->layer), 6.0 * sqrt(2.0 * rest));
  t->nodes = 0;
  t->nodes = lay(t->X, t);
  complete(t);
}

// Spacings by the film's bends: a share of the length over which its height curves by its own.
static void want(SbFilmTransient *t) {
  const double share = 0.25 * t->fineness;
  const double least = 0.01 * t->layer * t->fineness;
  for (int i = 0; i < t->nodes; i++) {
    t->wanted[i] = INFINITY;
    const bool rough = i < 2 || i + 2 >= t->nodes || t->beside_cavity[i] ||
                       t->beside_cavity[i - 1] || t->steep[i] || t->steep[i - 1];
    if (!rough && fabs(t->X[i]) < 1.0 + 2.0 * t->layer) {
      double d[3];
      second_difference(d, t, i);
      const double bend = d[0] * t->now.H[i - 1] + d[1] * t->now.H[i] + d[2] * t->now.H[i + 1];
      t->wanted[i] = fmax(share * sqrt(t->now.H[i] / fmax(fabs(bend), 1e-300)), least);
    }
  }
}

// Value at x of the polynomial through `count` points about the interval `from`, from + 1.
static double interpolate(const double *at, const double *value, int from, int count, double x) {
  double sum = 0.0;
  const int first = from + 1 - count / 2;
  for (int j = first; j < first + count; j++) {
    double basis = value[j] - value[from];
    for (int k = first; k < first + count; k++) {
      basis *= k == j ? 1.0 : (x - at[k]) / (at[j] - at[k]);
    }
    sum += basis;
  }
  return value[from] + sum;
}

// Brings node values from the mesh `X` to the new one.
static void carry_state(SbFilmTransient *t, SbTransientState *s, const double *X, int n,
                        SbTransientState *old) {
  *old = *s;
  for (int i = 0, j = 0; i < t->nodes; i++) {
    while (j + 2 < n && X[j + 1] <= t->X[i]) {
      j++;
    }
    const int count = j < 1 || j + 2 >= n || t->beside_cavity[j] || t->steep[j] ? 2 : 4;
    s->P[i] = interpolate(X, old->P, j, count, t->X[i]);
    s->H[i] = interpolate(X, old->H, j, count, t->X[i]);
    s->void_[i] = interpolate(X, old->void_, j, 2, t->X[i]);
    s->cavity[i] = old->cavity[2.0 * t->X[i] < X[j] + X[j + 1] ? j : j + 1];
    s->P[i] = s->cavity[i] ? 0.0 : fmax(s->P[i], 0.0);
    s->void_[i] = s->cavity[i] ? s->void_[i] : 0.0;
  }
}

// Faces of a mesh: its ends and the midpoints between its nodes.
static void faces(double *out, const double *X, int n) {
  out[0] = X[0];
  for (int i = 1; i < n; i++) {
    out[i] = 0.5 * (X[i - 1] + X[i]);
  }
  out[n] = X[n - 1];
}

// Content between the face j and x beyond it, by the polynomial through `count` sums of contents.
static double partial_content(const double *face, const double *content, int j, int count,
                              double x) {
  enum { COUNT_MAX = 6 };
  double sum[COUNT_MAX];
  const int own = count / 2 - 1;
  const double *at = face + j - own;
  sum[own] = 0.0;
  for (int k = own + 1; k < count; k++) {
    sum[k] = sum[k - 1] + content[j - own + k - 1];
  }
  for (int k = own; k > 0; k--) {
    sum[k - 1] = sum[k] - content[j - own + k - 1];
  }
  double out = 0.0;
  for (int m = 0; m < count; m++) {
    double basis = sum[m];
    for (int k = 0; k < count; k++) {
      basis *= k == m ? 1.0 : (x - at[k]) / (at[m] - at[k]);
    }
    out += basis;
  }
  return out;
}

// Contents of cells with the faces `to` from those of the n cells with the faces `from`, by their
// integral; cells that stand keep theirs to the last digit.
static void carry_content(double *out, const SbFilmTransient *t, const double *to, int cells,
                          const double *from, const double *content, int n) {
  double before = 0.0;
  for (int i = 0, j = 0; i < cells; i++) {
    double whole = 0.0;
    while (j < n && from[j + 1] <= to[i + 1]) {
      whole += content[j++];
    }
    int count = j == n ? 0 : j < 2 || j + 3 > n ? 2 : 6;
    for (int k = j - 2; k <= j + 1 && count > 2; k++) {
      count = t->beside_cavity[k] || t->steep[k] ? 2 : count;
    }
    const double part = count > 0 ? partial_content(from, content, j, count, to[i + 1]) : 0.0;
    out[i] = whole + part - before;
    before = part;
  }
}

void sb_transient_adapt(SbFilmTransient *t, double travel) {
  t->mesh_steps = 0;
  const double margin = 0.2 * fabs(travel);
  t->span[0] = fmin(travel, 0.0) - margin;
  t->span[1] = fmax(travel, 0.0) + margin;
  want(t);
  double *X = t->scratch[0];
  const int n = t->nodes;
  const int laid = lay(X, t);
  bool serves = laid > 0.8 * n;
  for (int i = 0; i + 1 < n && serves; i++) {
    serves = t->X[i + 1] - t->X[i] < 1.2 * spacing(t, 0.5 * (t->X[i] + t->X[i + 1]));
  }
  t->span[0] += t->travel;
  t->span[1] += t->travel;
  if (serves) {
    return;
  }
  double *old = t->scratch[1], *from = t->scratch[2], *to = t->scratch[4];
  memcpy(old, t->X, (size_t)n * sizeof *old);
  memcpy(t->X, X, (size_t)laid * sizeof *X);
  t->nodes = laid;
  carry_state(t, &t->now, old, n, &t->next);
  carry_state(t, &t->before, old, n, &t->next);
  faces(from, old, n);
  faces(to, t->X, laid);
  for (int k = 0; k < t->known_times; k++) {
    memcpy(old, t->content[k], (size_t)n * sizeof *old);
    carry_content(t->content[k], t, to, laid, from, old, n);
  }
  complete(t);
}

// Goes on as the wall does where the faces move: dX over their share of its speed, integrated.
static double stretched(double X, double lag) {
  return X + 0.5 * lag * lag * (X / (1.0 - X * X) + atanh(X));
}

void sb_transient_depart(double *out, SbFilmTransient *t, const double *content, double travel,
                         double lag) {
  double *from = t->scratch[2], *to = t->scratch[4];
  const int n = t->nodes;
  faces(from, t->X, n);
  for (int i = 0; i <= n; i++) {
    to[i] = from[i];
    if (fabs(from[i]) < 1.0 - 1e-12 && travel != 0.0) {
      const double aim = stretched(from[i], lag) - travel;
      double low = travel > 0.0 ? -1.0 : from[i], high = travel > 0.0 ? from[i] : 1.0;
      double X = from[i];
      for (int k = 0; k < 60 && high - low > 1e-15; k++) {
        const double wrong = stretched(X, lag) - aim;
        const double inside = lag / (1.0 - X * X);
        *(wrong > 0.0 ? &high : &low) = X;
        const double next = X - wrong / (1.0 + inside * inside);
        if (fabs(next - X) < 1e-15) {
          break;
        }
        X = next > low && next < high ? next : 0.5 * (low + high);
      }
      to[i] = X;
    }
  }
  carry_content(out, t, to, n, from, content, n);
}

// Smooth part of a fitted body on the nodes, added to `present` and its known gap: moments of the
// nodes' hats, S, and the polynomials at the nodes. Beyond the window the pressure counts as far as
// it differs from the ambient one. The constant is H0's.
static void add_smooth(SbFilmTransient *t, double half, double middle) {
  enum { POINTS = 3, MODES = SB_COMPLIANCE_MODES };
  const SbSurfaceCompliance *c = &t->compliance;
  const int n = t->nodes;
  const double b = t->scale.half_width;
  double node[POINTS];
  double weight[POINTS];
  sb_legendre_gauss(node, weight, POINTS);
  double(*moment)[SB_TRANSIENT_NODES_MAX] = (double(*)[SB_TRANSIENT_NODES_MAX])t->moment;
  memset(moment, 0, MODES * sizeof *moment);
  double value[MODES];
  for (int j = 0; j + 1 < n; j++) {
    const double h = t->X[j + 1] - t->X[j];
    for (int q = 0; q < POINTS; q++) {
      const double s = 0.5 * (1.0 + node[q]);
      sb_compliance_modes(c, b * (middle + half * (t->X[j] + s * h)), value, NULL);
      for (int k = 0; k < c->modes; k++) {
        moment[k][j] += half * 0.5 * h * weight[q] * (1.0 - s) * value[k];
        moment[k][j + 1] += half * 0.5 * h * weight[q] * s * value[k];
      }
    }
  }
  const double left = b * (middle + half * t->X[0]);
  const double right = b * (middle + half * t->X[n - 1]);
  double before[MODES], after[MODES], whole[MODES], at_left[MODES], at_right[MODES];
  sb_compliance_integrals(c, fmin(c->left, left), left, before);
  sb_compliance_integrals(c, right, fmax(c->right, right), after);
  sb_compliance_integrals(c, c->left, c->right, whole);
  sb_compliance_modes(c, c->left, at_left, NULL);
  sb_compliance_modes(c, c->right, at_right, NULL);
  double known[MODES];
  for (int k = 0; k < c->modes; k++) {
    known[k] = (t->inlet * (before[k] - fmax(c->left - left, 0.0) * at_left[k]) +
                t->outlet * (after[k] - fmax(right - c->right, 0.0) * at_right[k]) -
                fmin(t->inlet, t->outlet) * whole[k]) /
               b;
  }
  const double factor = 0.25 * c->modulus; // p_H b over the film's scale
  const double window = 0.5 * (c->right - c->left) / (half * b);
  const double tilt = -(t->inlet - t->outlet) / M_PI * log(window) * half;
  for (int i = 0; i < n; i++) {
    sb_compliance_modes(c, b * (middle + half * t->X[i]), value, NULL);
    double *row = t->present + (size_t)i * (size_t)n;
    t->present_known[i] += tilt * t->X[i];
    for (int l = 0; l < c->modes; l++) {
      double sum = 0.0;
      for (int k = 1; k < c->modes; k++) {
        sum += factor * value[k] * c->smooth[k][l];
      }
      t->present_known[i] += sum * known[l];
      cblas_daxpy(n, sum, moment[l], 1, row, 1);
    }
  }
}

void sb_transient_present(SbFilmTransient *t, double half, double middle) {
  if (half == t->present_half && middle == t->present_middle) {
    return;
  }
  const size_t n = (size_t)t->nodes;
  t->present_half = half;
  t->present_middle = middle;
  for (size_t i = 0; i < n * n; i++) {
    t->present[i] = half * t->kernel[i];
  }
  for (size_t i = 0; i < n; i++) {
    const double x = middle + half * t->X[i];
    t->present_known[i] = half * t->known[i];
    t->present_known[i] +=
        t->compliance.modes > 0
            ? sb_compliance_gap(&t->compliance, t->scale.half_width * x, NULL) / t->scale.film
            : 0.5 * x * x;
  }
  if (t->compliance.modes > 0) {
    add_smooth(t, half, middle);
  }
}

void sb_transient_gap(double *out, const SbFilmTransient *t, const SbTransientState *s) {
  for (int i = 0; i < t->nodes; i++) {
    out[i] = s->H0 + t->present_known[i];
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, t->nodes, t->nodes, 1.0, t->present, t->nodes, s->P, 1,
              1.0, out, 1);
}

SbStatus sb_transient_place(double *half, double *middle, const SbFilmTransient *t, double load,
                            SbReport *report) {
  *half = sqrt(load / (0.5 * M_PI));
  *middle = 0.0;
  if (t->compliance.modes == 0) {
    return sb_succeed(report);
  }
  SbDryContact dry;
  const SbFilmProblem *p = &t->problem.film;
  const SbStatus status = sb_dry_contact(&dry, &t->compliance, load / (0.5 * M_PI) * p->load,
                                         p->pressure_left, p->pressure_right, report);
  *half = 0.5 * (dry.right - dry.left) / t->scale.half_width;
  *middle = 0.5 * (dry.right + dry.left) / t->scale.half_width;
  return status;
}

// See oscillator.h. With z = u - trend and s, c the (hyperbolic) sine over split and cosine:
//   z = exp(-beta tau) [z0 (c + beta s) + w0 s],  z' = exp(-beta tau) [w0 (c - beta s) - z0
//   omega0^2 s]
// Without a spring the phi functions phi_k(u) = (phi_{k-1}(u) - 1/(k-1)!)/u, phi_0 = exp, give
//   v = v0 phi_0 + f0/m tau phi_1 + f1/m tau^2 phi_2 at -C tau/m, and u one order up.
#include "engine/mechanism/oscillator.h"

#include "engine/numeric/legendre.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

enum { PHI_MAX = 5 };

// phi_0 .. phi_PHI_MAX at u <= 0. The upward recurrence loses digits for small |u|: series there.
static void phi(double u, double p[PHI_MAX + 1]) {
  static const double inverse_factorial[PHI_MAX + 1] = {1.0,       1.0,        0.5,
                                                        1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0};
  if (fabs(u) < 2.0) {
    // Highest order by its series, then downwards, which is stable.
    double term = inverse_factorial[PHI_MAX];
    double sum = term;
    for (int k = PHI_MAX + 1; k < 40; k++) {
      term *= u / k;
      sum += term;
    }
    p[PHI_MAX] = sum;
    for (int k = PHI_MAX; k > 0; k--) {
      p[k - 1] = u * p[k] + inverse_factorial[k - 1];
    }
  } else {
    p[0] = exp(u);
    for (int k = 1; k <= PHI_MAX; k++) {
      p[k] = (p[k - 1] - inverse_factorial[k - 1]) / u;
    }
  }
}

void sb_oscillator_hold(SbOscillator *o) {
  *o = (SbOscillator){.kind = SB_OSCILLATOR_HELD, .mass = 1.0};
}

void sb_oscillator_init(SbOscillator *o, double mass, double damping, double stiffness, double f0,
                        double f1, double v0) {
  *o = (SbOscillator){
      .mass = mass, .damping = damping, .stiffness = stiffness, .f0 = f0, .f1 = f1, .v0 = v0};
  if (stiffness <= 0.0) {
    o->kind = SB_OSCILLATOR_DRIFT;
    return;
  }
  o->trend1 = f1 / stiffness;
  o->trend0 = (f0 - damping * o->trend1) / stiffness;
  o->z0 = -o->trend0;
  o->w0 = v0 - o->trend1;
  o->beta = 0.5 * damping / mass;
  o->omega0 = sqrt(stiffness / mass);
  double difference = (o->beta - o->omega0) * (o->beta + o->omega0);
  o->split = sqrt(fabs(difference));
  if (difference < 0.0) {
    o->kind = SB_OSCILLATOR_UNDER;
    return;
  }
  o->kind = SB_OSCILLATOR_OVER;
  o->fast = o->beta + o->split;
  o->slow = o->omega0 / o->fast * o->omega0;
  o->apart = o->split > 0.05 * o->beta;
  if (o->apart) {
    double gap = 2.0 * o->split;
    o->c_slow = (o->w0 + o->fast * o->z0) / gap;
    o->c_fast = -(o->w0 + o->slow * o->z0) / gap;
  }
}

// exp(-beta tau) times the sine over split and the cosine, circular or hyperbolic.
static void decayed(const SbOscillator *o, double tau, double *s, double *c) {
  if (o->kind == SB_OSCILLATOR_UNDER) {
    double e = exp(-o->beta * tau);
    double angle = o->split * tau;
    // Close to critical damping sin(angle)/split loses nothing as long as split > 0.
    *s = e * sin(angle) / o->split;
    *c = e * cos(angle);
    return;
  }
  double gap = 2.0 * o->split * tau;
  double slow = exp(-o->slow * tau);
  // slow (1 - exp(-gap))/(2 split), with its limit slow tau for a gap of zero
  *s = gap > 1e-8 ? slow * -expm1(-gap) / (2.0 * o->split) : slow * tau * (1.0 - 0.5 * gap);
  *c = 0.5 * slow * (1.0 + exp(-gap));
}

// The transient, its rate, and how far it has come from z0 without cancellation.
static void transient_at(const SbOscillator *o, double tau, double *z, double *w, double *travel) {
  if (o->apart) {
    // The two exponentials apart: no cancellation in c - beta s for a strongly damped mass.
    double slow = o->c_slow * exp(-o->slow * tau), fast = o->c_fast * exp(-o->fast * tau);
    *z = slow + fast;
    *w = -o->slow * slow - o->fast * fast;
    *travel = o->c_slow * expm1(-o->slow * tau) + o->c_fast * expm1(-o->fast * tau);
    return;
  }
  double s, c;
  decayed(o, tau, &s, &c);
  *z = o->z0 * (c + o->beta * s) + o->w0 * s;
  *w = o->w0 * (c - o->beta * s) - o->z0 * o->omega0 * o->omega0 * s;
  double near = o->omega0 * tau;
  if (near < 1e-3) {
    // c + beta s - 1 = -(omega0 tau)^2/2 (1 - 2 beta tau/3 + (4 beta^2 - omega0^2) tau^2/12 - ...)
    double b = o->beta * tau, n2 = near * near;
    double series = 1.0 - 2.0 * b / 3.0 + (4.0 * b * b - n2) / 12.0 - (2.0 * b * b - n2) * b / 15.0;
    *travel = o->w0 * s - 0.5 * n2 * series * o->z0;
  } else {
    *travel = *z - o->z0;
  }
}

// The state at one time: what a function, its rounding and its bounds all ask for.
typedef struct {
  double tau, travel, v, a;
  double z, w; // transient and its rate; 0 without a spring
} State;

static State state_at(const SbOscillator *o, double tau) {
  State s = {.tau = tau};
  if (o->kind == SB_OSCILLATOR_DRIFT) {
    double p[PHI_MAX + 1];
    phi(-o->damping * tau / o->mass, p);
    double g0 = o->f0 / o->mass, g1 = o->f1 / o->mass;
    s.v = o->v0 * p[0] + tau * (g0 * p[1] + tau * g1 * p[2]);
    s.travel = tau * (o->v0 * p[1] + tau * (g0 * p[2] + tau * g1 * p[3]));
    s.a = g0 + g1 * tau - o->damping * s.v / o->mass;
  } else if (o->kind != SB_OSCILLATOR_HELD) {
    double moved;
    transient_at(o, tau, &s.z, &s.w, &moved);
    s.travel = tau > 0.0 ? moved + o->trend1 * tau : 0.0;
    s.v = tau > 0.0 ? o->trend1 + s.w : o->v0;
    s.a = -2.0 * o->beta * s.w - o->omega0 * o->omega0 * s.z;
  }
  return s;
}

void sb_oscillator_at(const SbOscillator *o, double tau, double *travel, double *v, double *a) {
  State s = state_at(o, tau);
  if (travel != NULL) {
    *travel = s.travel;
  }
  if (v != NULL) {
    *v = s.v;
  }
  if (a != NULL) {
    *a = s.a;
  }
}

double sb_oscillator_integral_u(const SbOscillator *o, double tau) {
  if (o->kind == SB_OSCILLATOR_HELD) {
    return 0.0;
  }
  if (o->kind == SB_OSCILLATOR_DRIFT) {
    double p[PHI_MAX + 1];
    phi(-o->damping * tau / o->mass, p);
    double g0 = o->f0 / o->mass, g1 = o->f1 / o->mass;
    return tau * tau * (o->v0 * p[2] + tau * (g0 * p[3] + tau * g1 * p[4]));
  }
  // The transient obeys z'' + 2 beta z' + omega0^2 z = 0: integrate it once.
  double z, w, moved;
  transient_at(o, tau, &z, &w, &moved);
  double area = -((w - o->w0) + 2.0 * o->beta * moved) / (o->omega0 * o->omega0);
  return tau * (o->trend0 + 0.5 * o->trend1 * tau) + area;
}

// Integral of v^2 over (0, tau) or, for `transient`, of z'^2: Gauss points in panels that grow from
// the fastest decay to tau.
static double graded_v2(const SbOscillator *o, double tau, double rate, bool transient) {
  enum { POINTS = 10 };
  double node[POINTS], weight[POINTS], a = 0.0, sum = 0.0;
  double step = rate > 0.0 ? 0.5 / rate : tau;
  sb_legendre_gauss(node, weight, POINTS);
  while (a < tau) {
    double b = fmin(tau, a + step);
    for (int i = 0; i < POINTS; i++) {
      State s = state_at(o, 0.5 * (a + b) + 0.5 * (b - a) * node[i]);
      double v = transient ? s.w : s.v;
      sum += 0.5 * (b - a) * weight[i] * v * v;
    }
    a = b;
    step *= 1.5;
  }
  return sum;
}

// (1 - exp(-u))/u
static double fading(double u) {
  return u > 1e-12 ? -expm1(-u) / u : 1.0 - 0.5 * u;
}

double sb_oscillator_integral_v2(const SbOscillator *o, double tau) {
  if (o->kind == SB_OSCILLATOR_HELD || tau <= 0.0) {
    return 0.0;
  }
  if (o->kind == SB_OSCILLATOR_DRIFT) {
    return graded_v2(o, tau, o->damping / o->mass, false);
  }
  double z, w, moved, square;
  transient_at(o, tau, &z, &w, &moved);
  if (o->kind == SB_OSCILLATOR_UNDER) {
    // z' = exp(-beta tau) (p cos + q sin): its square by the double angle.
    double p = o->w0;
    double q = -(o->beta * o->w0 + o->omega0 * o->omega0 * o->z0) / o->split;
    double b = 2.0 * o->beta, k = 2.0 * o->split;
    double e = exp(-b * tau), norm = b * b + k * k;
    double cosine = (e * (-b * cos(k * tau) + k * sin(k * tau)) + b) / norm;
    double sine = (e * (-b * sin(k * tau) - k * cos(k * tau)) + k) / norm;
    square = 0.5 * (p * p + q * q) * tau * fading(b * tau) + 0.5 * (p * p - q * q) * cosine +
             p * q * sine;
  } else if (o->apart) {
    double s = -o->slow * o->c_slow, f = -o->fast * o->c_fast, both = o->slow + o->fast;
    square = s * s * tau * fading(2.0 * o->slow * tau) + f * f * tau * fading(2.0 * o->fast * tau) +
             2.0 * s * f * tau * fading(both * tau);
  } else {
    square = graded_v2(o, tau, o->beta, true);
  }
  return o->trend1 * (o->trend1 * tau + 2.0 * moved) + square;
}

static double value_at(const SbEventFunction *g, const State *s, double *rate) {
  double value = g->constant + g->rate * s->tau + g->of_x * s->travel + g->of_v * s->v;
  *rate = g->rate + g->of_x * s->v + g->of_v * s->a;
  if (g->relax != 0.0) {
    double e = g->relax * exp(-g->relax_rate * s->tau);
    value += e;
    *rate -= g->relax_rate * e;
  }
  if (g->log_gain != 0.0) {
    value += g->log_gain * log1p((g->log_start + s->tau) / g->log_time);
    *rate += g->log_gain / (g->log_time + g->log_start + s->tau);
  }
  return value;
}

double sb_event_at(const SbEventFunction *g, const SbOscillator *o, double tau, double *rate) {
  State s = state_at(o, tau);
  double slope;
  double value = value_at(g, &s, &slope);
  if (rate != NULL) {
    *rate = slope;
  }
  return value;
}

// Size below which a value of g is rounding.
static double noise(const SbEventFunction *g, const SbOscillator *o, const State *s) {
  double size = g->noise + fabs(g->constant) + fabs(g->rate * s->tau) + fabs(g->relax) +
                fabs(g->of_x * s->travel) +
                fabs(g->of_v) * (fabs(s->v) + fabs(o->v0) + fabs(o->w0));
  if (o->omega0 * s->tau >= 1e-3) {
    size += fabs(g->of_x * o->z0);
  }
  return 4.0 * DBL_EPSILON * size;
}

// Bounds over `window` from the state on: |g''|, and how far the fading parts can pull g below its
// trend.
static void bounds(const SbEventFunction *g, const SbOscillator *o, const State *at, double window,
                   double *curvature, double *swing) {
  double tau = at->tau;
  double px = fabs(g->of_x), pv = fabs(g->of_v);
  *curvature = 0.0;
  *swing = 0.0;
  if (o->kind == SB_OSCILLATOR_DRIFT) {
    double a = at->a, gamma = o->damping / o->mass, jerk0 = o->f1 / o->mass;
    // a' = f1/m - gamma a fades; a grows at most by its integral, and not at all without a ramp.
    double jerk = fabs(jerk0 - gamma * a);
    double reach = gamma * window > 1.0 ? 1.0 / gamma : window;
    *curvature = px * (fabs(a) + (jerk0 != 0.0 ? jerk * reach : 0.0)) + pv * jerk;
  } else if (o->kind != SB_OSCILLATOR_HELD) {
    if (o->apart) {
      double s = fabs(o->c_slow) * exp(-o->slow * tau), f = fabs(o->c_fast) * exp(-o->fast * tau);
      *curvature =
          s * o->slow * o->slow * (px + pv * o->slow) + f * o->fast * o->fast * (px + pv * o->fast);
      *swing = s * (px + pv * o->slow) + f * (px + pv * o->fast);
    } else {
      // The transient's energy never grows: |z'| <= size, |z| <= size/omega0 from here on.
      double size = hypot(o->omega0 * at->z, at->w), b = 2.0 * o->beta;
      double second = (b + o->omega0) * size;
      *curvature = px * second + pv * (b * second + o->omega0 * o->omega0 * size);
      *swing = (px / o->omega0 + pv) * size;
    }
  }
  if (g->relax != 0.0) {
    double e = fabs(g->relax) * exp(-g->relax_rate * tau);
    *curvature += g->relax_rate * g->relax_rate * e;
    *swing += g->relax < 0.0 ? e : 0.0;
  }
  if (g->log_gain != 0.0) {
    double since = g->log_time + g->log_start + tau;
    *curvature += g->log_gain / (since * since);
  }
}

// Until when the straight trend of g, lowered by all that still swings, stays positive.
static double trend_clear(const SbEventFunction *g, const SbOscillator *o, double tau,
                          double swing) {
  if (o->kind == SB_OSCILLATOR_DRIFT) {
    return tau;
  }
  double level = g->constant - swing, rate = g->rate;
  if (o->kind != SB_OSCILLATOR_HELD) {
    level += g->of_x * o->trend0 + g->of_v * o->trend1;
    rate += g->of_x * o->trend1;
  }
  if (g->log_gain != 0.0) {
    level += g->log_gain * log1p((g->log_start + tau) / g->log_time);
  }
  if (!(level + rate * tau > 0.0)) {
    return tau;
  }
  // Short of it by rounding, so that rounding cannot step over.
  return rate >= 0.0 ? INFINITY : fmax(tau, (1.0 - 8.0 * DBL_EPSILON) * (level / -rate));
}

// From tau, where g is small and falls: Newton's method kept in the bracket of the sign change.
static double polish(const SbEventFunction *g, const SbOscillator *o, double tau, double horizon) {
  double rate;
  double value = sb_event_at(g, o, tau, &rate);
  for (int i = 0; i < 8 && rate < 0.0; i++) {
    double next = fmin(horizon, fmax(0.0, tau - value / rate));
    if (fabs(next - tau) <= DBL_EPSILON * tau) {
      return next;
    }
    double r;
    double v = sb_event_at(g, o, next, &r);
    if (fabs(v) > fabs(value)) {
      break;
    }
    tau = next;
    value = v;
    rate = r;
  }
  return tau;
}

double sb_event_first(const SbEventFunction *g, const SbOscillator *o, double horizon,
                      bool *found) {
  double tau = 0.0, rate;
  State at = state_at(o, 0.0);
  double value = value_at(g, &at, &rate);
  double tiny = noise(g, o, &at);
  *found = false;
  // Already past it: something jumped.
  if (value < -64.0 * tiny) {
    *found = true;
    return 0.0;
  }
  // At the limit from the start: look which way it goes.
  if (value <= tiny) {
    double curvature, swing;
    bounds(g, o, &at, horizon, &curvature, &swing);
    double lift = fabs(curvature) > 0.0 ? 2.0 * fabs(rate) / curvature : horizon;
    if (rate > 0.0 && rate * lift > 16.0 * tiny) {
      // Rising: nothing can happen before curvature has bent it back.
      tau = fmin(0.999 * lift, horizon);
    } else if (rate < 0.0 && -rate * lift > 16.0 * tiny) {
      *found = true;
      return 0.0;
    } else {
      // Flat to rounding: probe ahead, wider and wider, until the sign shows.
      double step = horizon * 1e-15;
      if (o->omega0 > 0.0) {
        step = fmin(step, 1e-9 / o->omega0);
      }
      for (step = fmax(step, 1e-300);; step *= 4.0) {
        tau = fmin(step, horizon);
        at = state_at(o, tau);
        value = value_at(g, &at, &rate);
        tiny = noise(g, o, &at);
        if (value > 16.0 * tiny || tau >= horizon) {
          break;
        }
        if (value < -16.0 * tiny) {
          *found = true;
          return 0.0;
        }
      }
    }
  }
  double window = horizon;
  for (int i = 0; i < 200000 && tau < horizon; i++) {
    at = state_at(o, tau);
    value = value_at(g, &at, &rate);
    tiny = noise(g, o, &at);
    if (value <= tiny) {
      if (rate < 0.0) {
        *found = true;
        return polish(g, o, tau, horizon);
      }
      if (value < -16.0 * tiny) {
        *found = true;
        return tau;
      }
      value = tiny;
    }
    double curvature, swing;
    bounds(g, o, &at, window, &curvature, &swing);
    double clear = trend_clear(g, o, tau, swing);
    if (clear > tau * (1.0 + 4.0 * DBL_EPSILON)) {
      tau = fmin(clear, horizon);
      continue;
    }
    // Largest s with value + rate s - curvature s^2/2 >= 0 (written without cancellation).
    double root = sqrt(rate * rate + 2.0 * curvature * value);
    double step = rate < 0.0        ? 2.0 * value / (root - rate)
                  : curvature > 0.0 ? (rate + root) / curvature
                                    : horizon;
    if (step > window) {
      step = window;
      window *= 4.0;
    } else {
      window = fmin(window, 16.0 * step);
    }
    step = fmax(step, 4.0 * DBL_EPSILON * tau);
    tau += step;
  }
  return horizon;
}

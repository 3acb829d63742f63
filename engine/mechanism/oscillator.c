// See oscillator.h. The motion is made of an impulse's answer H_1 and its integrals
// H_k = integral of H_(k-1) over (0, tau), H_0 = H_1':
//
//   u = v0 H_1 + g0 H_2 + g1 H_3,   H_1'' + C/m H_1' + K/m H_1 = 0,   H_1(0) = 0, H_1'(0) = 1
//
// whose equation, integrated, joins three of them in a row:
//
//   H_(k-2) + C/m H_(k-1) + K/m H_k = tau^(k-2)/(k-2)!
#include "engine/mechanism/oscillator.h"

#include "engine/numeric/legendre.h"

#include <complex.h>
#include <float.h>
#include <math.h>
#include <string.h>

enum { ORDERS = 5 };

void sb_oscillator_init(SbOscillator *o, double mass, double damping, double stiffness, double f0,
                        double f1, double v0) {
  *o = (SbOscillator){.damping = damping / mass,
                      .stiffness = stiffness / mass,
                      .v0 = v0,
                      .g0 = f0 / mass,
                      .g1 = f1 / mass,
                      .omega = sqrt(stiffness / mass),
                      .trend1 = v0};
  if (stiffness > 0.0) {
    o->trend1 = f1 / stiffness;
    o->trend0 = (f0 - damping * o->trend1) / stiffness;
  }
  double beta = 0.5 * o->damping, difference = (beta - o->omega) * (beta + o->omega);
  o->split = sqrt(fabs(difference));
  o->swings = difference < 0.0;
  o->apart = o->split > 0.05 * fabs(beta);
  o->slow = o->fast = beta;
  if (difference > 0.0 && beta > 0.0) {
    o->fast = beta + o->split;
    o->slow = o->omega / o->fast * o->omega;
  } else if (difference > 0.0) {
    o->slow = beta - o->split; // grows the faster
    o->fast = o->omega / o->slow * o->omega;
  }
}

// exp(-rate tau), its slope (first) and its integrals from 0; power[k] is tau^k/k!. Upwards digits
// are lost for a small rate tau: there the highest integral by its series, then downwards.
static void decay(double e[ORDERS], double rate, double tau, const double power[ORDERS]) {
  enum { TOP = ORDERS - 1 };
  if (rate * tau < 2.0) {
    double term = power[TOP - 1];
    e[TOP] = 0.0;
    for (int k = TOP; fabs(term) > 0.1 * DBL_EPSILON * e[TOP]; k++) {
      e[TOP] += term;
      term *= -rate * tau / k;
    }
    for (int k = TOP; k > 1; k--) {
      e[k - 1] = power[k - 2] - rate * e[k];
    }
  } else {
    e[1] = exp(-rate * tau);
    for (int k = 2; k <= TOP; k++) {
      e[k] = (power[k - 2] - e[k - 1]) / rate;
    }
  }
  e[0] = -rate * e[1];
}

// H_0 .. H_4 at tau.
static void answers(double h[ORDERS], const SbOscillator *o, double tau) {
  if (tau == 0.0) { // where every search for an event begins
    memset(h, 0, ORDERS * sizeof *h);
    h[0] = 1.0;
    return;
  }
  double power[ORDERS] = {1.0}, c = o->damping, k = o->stiffness;
  for (int i = 1; i < ORDERS; i++) {
    power[i] = power[i - 1] * tau / i;
  }
  if (tau * (fabs(c) + k * tau) < 2.0) {
    // Neither damper nor spring has done much: the two highest by their series, then downwards.
    double before = 0.0, now = 1.0, weight[2] = {power[3], power[4]};
    h[3] = h[4] = 0.0;
    for (int n = 4; (fabs(before) + fabs(now)) * weight[0] > 0.1 * DBL_EPSILON * h[3]; n++) {
      h[3] += now * weight[0];
      h[4] += now * weight[1];
      double next = -tau * (c * now + k * tau * before);
      before = now;
      now = next;
      weight[0] /= n;
      weight[1] /= n + 1;
    }
    for (int i = 4; i > 1; i--) {
      h[i - 2] = power[i - 2] - c * h[i - 1] - k * h[i];
    }
  } else if (o->apart && !o->swings) {
    double slow[ORDERS], fast[ORDERS];
    decay(slow, o->slow, tau, power);
    decay(fast, o->fast, tau, power);
    for (int i = 0; i < ORDERS; i++) {
      h[i] = (slow[i] - fast[i]) / (o->fast - o->slow);
    }
  } else {
    // Sine over split, circular or hyperbolic, and cosine; at critical damping the sine's limit.
    double e = exp(-o->slow * tau), gap = 2.0 * o->split * tau, sine, cosine;
    if (o->swings) {
      sine = e * sin(o->split * tau) / o->split;
      cosine = e * cos(o->split * tau);
    } else {
      sine = gap > 1e-8 ? e * -expm1(-gap) / (2.0 * o->split) : e * tau * (1.0 - 0.5 * gap);
      cosine = 0.5 * e * (1.0 + exp(-gap));
    }
    h[0] = cosine - 0.5 * c * sine;
    h[1] = sine;
    for (int i = 2; i < ORDERS; i++) {
      h[i] = (power[i - 2] - h[i - 2] - c * h[i - 1]) / k;
    }
  }
}

SbOscillatorState sb_oscillator_at(const SbOscillator *o, double tau) {
  double h[ORDERS], v0 = o->v0, g0 = o->g0, g1 = o->g1;
  answers(h, o, tau);
  // The acceleration has the answers' equation, without a force.
  double a0 = g0 - o->damping * v0, pull = g1 - o->stiffness * v0;
  return (SbOscillatorState){
      .tau = tau,
      .travel = v0 * h[1] + g0 * h[2] + g1 * h[3],
      .v = v0 * h[0] + g0 * h[1] + g1 * h[2],
      .a = a0 * h[0] + pull * h[1],
      .jerk = (pull - o->damping * a0) * h[0] - o->stiffness * a0 * h[1],
      .area = v0 * h[2] + g0 * h[3] + g1 * h[4],
      .size_u = fabs(v0 * h[1]) + fabs(g0 * h[2]) + fabs(g1 * h[3]),
      .size_v = fabs(v0) + fabs(g0 * h[1]) + fabs(g1 * h[2]),
  };
}

// u - rate tau has the equation of u, with other coefficients.
double sb_oscillator_lag(const SbOscillator *o, double tau, double rate, double pull) {
  double h[ORDERS];
  answers(h, o, tau);
  return (o->v0 - rate) * h[2] + (o->g0 - o->damping * rate) * h[3] + pull * h[4];
}

// Integral of exp(-rate t) over (0, tau).
static double complex faded(double complex rate, double tau) {
  double complex u = rate * tau, term = tau, sum = 0.0;
  if (cabs(u) > 0.5) {
    return (1.0 - cexp(-u)) / rate;
  }
  for (int k = 2; k < 16; k++) {
    sum += term;
    term *= -u / k;
  }
  return sum;
}

double sb_oscillator_square(const SbOscillator *o, double tau) {
  enum { POINTS = 10 };
  if (o->v0 == 0.0 && o->g0 == 0.0 && o->g1 == 0.0) {
    return 0.0; // fixed
  }
  if (o->stiffness > 0.0 && o->apart) {
    // v is the trend's and two exponentials, conjugate if it swings.
    double complex p = o->slow, q = o->fast, gap;
    if (o->swings) {
      p += I * o->split;
      q -= I * o->split;
    }
    gap = q - p;
    double w = o->v0 - o->trend1, a = o->g0 - o->damping * o->v0;
    double complex b = (a + q * w) / gap, c = -(a + p * w) / gap;
    double complex square =
        b * b * faded(2.0 * p, tau) + c * c * faded(2.0 * q, tau) + 2.0 * b * c * faded(p + q, tau);
    return creal(square) + o->trend1 * (2.0 * sb_oscillator_at(o, tau).travel - o->trend1 * tau);
  }
  // Gauss points in panels that grow from the fastest decay to tau.
  double node[POINTS], weight[POINTS], from = 0.0, sum = 0.0,
                                       rate = fmax(fabs(o->slow), fmax(o->fast, o->omega));
  double step = rate > 0.0 ? 0.5 / rate : tau;
  sb_legendre_gauss(node, weight, POINTS);
  while (from < tau) {
    double to = fmin(tau, from + step);
    for (int i = 0; i < POINTS; i++) {
      double v = sb_oscillator_at(o, 0.5 * (from + to) + 0.5 * (to - from) * node[i]).v;
      sum += 0.5 * (to - from) * weight[i] * v * v;
    }
    from = to;
    step *= 1.5;
  }
  return sum;
}

// ---- events ----

// A function at tau: its value, rate, the size below which the value is rounding, and the motion.
typedef struct {
  double value, rate, tiny;
  SbOscillatorState at;
} Look;

static Look look(const SbEventFunction *g, const SbOscillator *o, double tau) {
  SbOscillatorState s = sb_oscillator_at(o, tau);
  Look out = {.value = g->constant + g->rate * tau + g->of_x * s.travel + g->of_v * s.v,
              .rate = g->rate + g->of_x * s.v + g->of_v * s.a,
              .tiny = 4.0 * DBL_EPSILON *
                      (g->noise + fabs(g->constant) + fabs(g->rate * tau) + fabs(g->relax) +
                       fabs(g->of_x) * s.size_u + fabs(g->of_v) * s.size_v),
              .at = s};
  if (g->relax != 0.0) {
    double e = g->relax * exp(-g->relax_rate * tau);
    out.value += e;
    out.rate -= g->relax_rate * e;
  }
  for (int i = 0; i < g->logs; i++) {
    out.value += g->log[i].gain * log1p((g->log[i].start + tau) / g->log[i].time);
    out.rate += g->log[i].gain / (g->log[i].time + g->log[i].start + tau);
  }
  return out;
}

// Bounds over `window` from a look on: |g''|, and how far the fading parts can pull g below its
// trend.
static void bounds(const SbEventFunction *g, const SbOscillator *o, const Look *now, double window,
                   double *curvature, double *swing) {
  double tau = now->at.tau, a = now->at.a, jerk = now->at.jerk;
  double px = fabs(g->of_x), pv = fabs(g->of_v);
  *curvature = *swing = 0.0;
  if (o->apart && !o->swings) {
    // Shares of the acceleration that fade slowly and fast.
    double gap = o->fast - o->slow;
    double s = fabs(jerk + o->fast * a) / gap, f = fabs(jerk + o->slow * a) / gap;
    *curvature = s * (px + pv * fabs(o->slow)) + f * (px + pv * fabs(o->fast));
    *swing = s * (px / o->slow + pv) / o->slow + f * (px / o->fast + pv) / o->fast;
  } else if (a != 0.0 || jerk != 0.0) {
    // The energy jerk^2 + (omega a)^2 never grows, nor does that of the transient.
    double most = hypot(jerk, o->omega * a);
    double w = (jerk + o->damping * a) / o->stiffness, z = (a - o->damping * w) / o->stiffness;
    *curvature = px * fmin(most / o->omega, fabs(a) + most * window) + pv * most;
    *swing = hypot(o->omega * z, w) * (px / o->omega + pv);
  }
  if (o->damping < 0.0) {
    // What does not fade grows by no more than e up to the end.
    *curvature *= M_E;
    *swing = INFINITY;
  }
  if (g->relax != 0.0) {
    double e = fabs(g->relax) * exp(-g->relax_rate * tau);
    *curvature += g->relax_rate * g->relax_rate * e;
    *swing += g->relax < 0.0 ? e : 0.0;
  }
  for (int i = 0; i < g->logs; i++) {
    double since = g->log[i].time + g->log[i].start + tau;
    *curvature += g->log[i].gain / (since * since);
  }
}

// Until when the straight trend of g, lowered by all that still swings, stays positive.
static double trend_clear(const SbEventFunction *g, const SbOscillator *o, double tau,
                          double swing) {
  double level = g->constant - swing + g->of_x * o->trend0 + g->of_v * o->trend1;
  double rate = g->rate + g->of_x * o->trend1;
  for (int i = 0; i < g->logs; i++) {
    level += g->log[i].gain * log1p((g->log[i].start + tau) / g->log[i].time);
  }
  if (!(level + rate * tau > 0.0)) {
    return tau;
  }
  // Short of it by rounding, so that rounding cannot step over.
  return rate >= 0.0 ? INFINITY : fmax(tau, (1.0 - 8.0 * DBL_EPSILON) * (level / -rate));
}

// Decides about an event that is met at the start, *now. Returns whether it happens there. Else
// writes the time up to which nothing can happen, and its *now.
static bool happens_first(double *tau, Look *now, const SbEventFunction *g, const SbOscillator *o,
                          double horizon) {
  double curvature, swing;
  *tau = 0.0;
  // Already past it: something jumped.
  if (now->value < -64.0 * now->tiny) {
    return true;
  }
  if (now->value > now->tiny) {
    return false;
  }
  // At the limit from the start: its direction decides.
  bounds(g, o, now, horizon, &curvature, &swing);
  double lift = curvature > 0.0 ? 2.0 * fabs(now->rate) / curvature : horizon;
  if (now->rate < 0.0 && -now->rate * lift > 16.0 * now->tiny) {
    return true;
  }
  if (now->rate * lift > 16.0 * now->tiny) {
    // Rising: nothing can happen before curvature has bent it back.
    *tau = fmin(0.999 * lift, horizon);
    return false;
  }
  // Flat to rounding: probe ahead, wider and wider, until the sign shows.
  double step = fmax(fmin(horizon * 1e-15, 1e-9 / o->omega), 1e-300);
  for (; *tau < horizon && now->value <= 16.0 * now->tiny; step *= 4.0) {
    *tau = fmin(step, horizon);
    *now = look(g, o, *tau);
    if (*tau < horizon && now->value < -16.0 * now->tiny) {
      return true;
    }
  }
  return false;
}

double sb_event_first(const SbEventFunction *g, const SbOscillator *o, double horizon,
                      bool *found) {
  double tau, window = horizon, curvature, swing;
  Look now = look(g, o, 0.0);
  *found = true;
  if (happens_first(&tau, &now, g, o, horizon)) {
    return 0.0;
  }
  for (int i = 0; i < 200000 && tau < horizon; i++) {
    now = now.at.tau == tau ? now : look(g, o, tau);
    if (now.value <= now.tiny && now.rate < 0.0) {
      return fmin(horizon, fmax(0.0, tau - now.value / now.rate));
    }
    if (now.value < -16.0 * now.tiny) {
      return tau;
    }
    now.value = fmax(now.value, now.tiny);
    bounds(g, o, &now, window, &curvature, &swing);
    double clear = trend_clear(g, o, tau, swing);
    if (clear > tau * (1.0 + 4.0 * DBL_EPSILON)) {
      tau = fmin(clear, horizon);
      continue;
    }
    // Largest s with value + rate s - curvature s^2/2 >= 0 (written without cancellation).
    double root = sqrt(now.rate * now.rate + 2.0 * curvature * now.value);
    double step = now.rate < 0.0    ? 2.0 * now.value / (root - now.rate)
                  : curvature > 0.0 ? (now.rate + root) / curvature
                                    : horizon;
    if (step > window) {
      step = window;
      window *= 4.0;
    } else {
      window = fmin(window, 16.0 * step);
    }
    tau += fmax(step, 4.0 * DBL_EPSILON * tau);
  }
  *found = false;
  return horizon;
}

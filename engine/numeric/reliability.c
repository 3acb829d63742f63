// Failure points and importance sampling; see the header.
#include "engine/numeric/reliability.h"

#include "engine/numeric/sampling.h"
#include "engine/numeric/statistics.h"

#include <float.h>
#include <math.h>
#include <string.h>

// Returns the meaning of `end` as a clause, without a full stop.
static const char *end_text(SbSearchEnd end) {
  switch (end) {
  case SB_SEARCH_FOUND:
    return "the most probable failure was found";
  case SB_SEARCH_FLAT:
    return "nothing that varies changes the figure";
  case SB_SEARCH_FAR:
    return "the limit is not reached within 8 standard deviations";
  case SB_SEARCH_KINK:
    return "the figure has a kink between the median and the limit";
  case SB_SEARCH_NO_VALUE:
    return "the figure has no value at the median";
  case SB_SEARCH_STALLED:
    return "the search for the most probable failure did not converge";
  }
  return "";
}

const char *sb_failure_text(const SbFailurePoint *found) {
  if (!(found->value < 0)) {
    return end_text(found->end);
  }
  switch (found->end) {
  case SB_SEARCH_FLAT:
    return "the median fails, and nothing that varies changes the figure";
  case SB_SEARCH_FAR:
    return "the median fails, and no valve that meets the limit was found within 8 standard "
           "deviations";
  default:
    return end_text(found->end);
  }
}

// ---- The search ----

typedef struct {
  double value, slope; // slope: length of the gradient
  double gradient[SB_RELIABILITY_DIMENSIONS];
} Place;

typedef struct {
  size_t n;
  SbLimitState state;
  void *data;
  SbFailurePoint *out;
} Search;

static double dot(const double *a, const double *b, size_t n) {
  double sum = 0;
  for (size_t k = 0; k < n; k++) {
    sum += a[k] * b[k];
  }
  return sum;
}

static SbStatus look(Place *place, const Search *search, const double *u) {
  search->out->evaluations++;
  const SbStatus status = search->state(&place->value, place->gradient, u, search->data);
  place->slope = sqrt(dot(place->gradient, place->gradient, search->n));
  return status;
}

// Penalty of the merit |u|^2/2 + c |g|: above |u|/|grad g|, so that the step descends, and such
// that what a whole step adds to the first term it takes from the second.
static double penalty(const double *u, const double *step, const Place *at, size_t n,
                      double negligible) {
  const double first = sqrt(dot(u, u, n)) / at->slope;
  double end = 0;
  for (size_t k = 0; k < n; k++) {
    end += (u[k] + step[k]) * (u[k] + step[k]);
  }
  const double second = fabs(at->value) > negligible ? end / 2 / fabs(at->value) : 0;
  return 2 * fmax(first, second) + DBL_MIN;
}

// Halves the step until the merit is less by Armijo's rule. False: no such step. *u and *at become
// the new place.
static SbStatus advance(bool *moved, double *u, Place *at, const double *step, double negligible,
                        const Search *search) {
  enum { HALVINGS = 12 };
  const size_t n = search->n;
  const double c = penalty(u, step, at, n, negligible);
  const double before = dot(u, u, n) / 2 + c * fabs(at->value);
  const double descent = dot(u, step, n) + copysign(c, at->value) * dot(at->gradient, step, n);
  double share = 1;
  *moved = false;
  for (int i = 0; i < HALVINGS; i++, share /= 2) {
    double next[SB_RELIABILITY_DIMENSIONS];
    Place there;
    for (size_t k = 0; k < n; k++) {
      next[k] = u[k] + share * step[k];
    }
    const SbStatus status = look(&there, search, next);
    if (status != SB_OK) {
      return status;
    }
    const double after = dot(next, next, n) / 2 + c * fabs(there.value);
    // By rounding alone the merit may stay.
    if (after <= before + 1e-4 * share * descent + 4 * DBL_EPSILON * before) {
      memcpy(u, next, n * sizeof *u);
      *at = there;
      *moved = true;
      return SB_OK;
    }
  }
  return SB_OK;
}

// Of both the distance to the limit and that to the nearest of its points.
static bool is_settled(const double *u, const Place *at, size_t n, double tolerance) {
  const double along = dot(u, at->gradient, n) / at->slope;
  double off = 0;
  for (size_t k = 0; k < n; k++) {
    const double rest = u[k] - along * at->gradient[k] / at->slope;
    off += rest * rest;
  }
  return fmax(fabs(at->value) / at->slope, sqrt(off)) <= tolerance * fmax(1, fabs(along));
}

static SbStatus search_from(double *u, Place *at, const Search *search, double tolerance) {
  enum { STEPS = 60 };
  const size_t n = search->n;
  SbFailurePoint *out = search->out;
  SbStatus status = look(at, search, u);
  out->value = at->value;
  out->slope = at->slope;
  out->end = SB_SEARCH_STALLED;
  int far = 0;
  for (int i = 0; status == SB_OK && i < STEPS; i++) {
    if (isnan(at->value) || isnan(at->slope) || !(at->slope > 0)) {
      out->end = isnan(at->value)   ? SB_SEARCH_NO_VALUE
                 : isnan(at->slope) ? SB_SEARCH_KINK
                                    : SB_SEARCH_FLAT;
      break;
    }
    if (is_settled(u, at, n, tolerance)) {
      out->end = SB_SEARCH_FOUND;
      out->beta = copysign(sqrt(dot(u, u, n)), out->value);
      break;
    }
    double step[SB_RELIABILITY_DIMENSIONS];
    const double to = (dot(at->gradient, u, n) - at->value) / (at->slope * at->slope);
    // Not beyond the largest searched distance.
    const double most = SB_SEARCH_FARTHEST / fmax(fabs(to) * at->slope, DBL_MIN);
    for (size_t k = 0; k < n; k++) {
      step[k] = fmin(most, 1) * to * at->gradient[k] - u[k];
    }
    bool moved = false;
    if (most < 1) {
      // The full step to the farthest distance: is its end still on the median's side?
      Place there;
      double end[SB_RELIABILITY_DIMENSIONS];
      for (size_t k = 0; k < n; k++) {
        end[k] = u[k] + step[k];
      }
      status = look(&there, search, end);
      if (status == SB_OK && there.value * out->value > 0) {
        memcpy(u, end, n * sizeof *u);
        *at = there;
        moved = true;
        far++;
      }
    }
    if (status == SB_OK && !moved) {
      status = advance(&moved, u, at, step, tolerance * at->slope, search);
    }
    if (status == SB_OK && (far == 3 || !moved)) {
      out->end = far == 3 ? SB_SEARCH_FAR : SB_SEARCH_STALLED;
      break;
    }
  }
  return status;
}

SbStatus sb_failure_point(SbFailurePoint *out, double *u, size_t dimensions, SbLimitState state,
                          void *data, double tolerance, SbReport *report) {
  *out = (SbFailurePoint){.end = SB_SEARCH_STALLED, .beta = NAN, .value = NAN, .slope = NAN};
  if (dimensions == 0 || dimensions > SB_RELIABILITY_DIMENSIONS) {
    return sb_fail(report, SB_ERROR_RANGE, "a search has 1 to %d dimensions, not %zu",
                   SB_RELIABILITY_DIMENSIONS, dimensions);
  }
  Place at;
  memset(u, 0, dimensions * sizeof *u);
  const Search search = {dimensions, state, data, out};
  const SbStatus status = search_from(u, &at, &search, tolerance);
  return status == SB_OK ? sb_succeed(report) : status;
}

// ---- Samples ----

// One sample of so many is drawn about 0, so that no weight exceeds it.
enum { PLAIN = 5 };

void sb_sample_importance(double *u, size_t samples, size_t dimensions, const double *centre,
                          size_t centres, uint64_t seed) {
  for (size_t i = 0; i < samples; i++) {
    const bool plain = centres == 0 || i % PLAIN == 0;
    const double *about = plain ? NULL : centre + (i - i / PLAIN - 1) % centres * dimensions;
    for (size_t k = 0; k < dimensions; k++) {
      u[i * dimensions + k] =
          sb_normal_quantile(sb_random(seed, i, (uint32_t)k)) + (about != NULL ? about[k] : 0);
    }
  }
}

double sb_importance_weight(const double *u, size_t dimensions, const double *centre,
                            size_t centres) {
  if (centres == 0) {
    return 1;
  }
  double density = 1.0 / PLAIN;
  for (size_t m = 0; m < centres; m++) {
    const double *c = centre + m * dimensions;
    density += (1 - 1.0 / PLAIN) / (double)centres *
               exp(dot(u, c, dimensions) - dot(c, c, dimensions) / 2);
  }
  return 1 / density;
}

void sb_weighted_share(SbWeightedShare *out, const double *weight, const uint8_t *trial,
                       size_t samples) {
  *out = (SbWeightedShare){.probability = NAN, .interval = {NAN, NAN}};
  size_t count[SB_TRIAL_LEFT_OUT + 1] = {0};
  double share[SB_TRIAL_LEFT_OUT + 1] = {0}, square = 0;
  const double n = (double)samples;
  for (size_t i = 0; i < samples; i++) {
    count[trial[i]]++;
    share[trial[i]] += (weight != NULL ? weight[i] : 1) / n;
  }
  out->failed = count[SB_TRIAL_FAILS];
  out->known = out->failed + count[SB_TRIAL_HOLDS];
  const double drawn = share[SB_TRIAL_FAILS] + share[SB_TRIAL_HOLDS] + share[SB_TRIAL_UNKNOWN];
  out->unknown = drawn > 0 ? share[SB_TRIAL_UNKNOWN] / drawn : 0;
  if (out->known == 0) {
    return;
  }
  // Weights are 1 on average: all of them are a probability of 1, but for what they scatter.
  const double lost = share[SB_TRIAL_UNKNOWN] + share[SB_TRIAL_LEFT_OUT];
  const double of = out->known < samples ? fmax(1 - lost, share[SB_TRIAL_FAILS]) : 1;
  const double failed = share[SB_TRIAL_FAILS];
  if (weight == NULL) {
    out->probability = (double)out->failed / (double)out->known;
    sb_probability_interval(out->interval, out->failed, out->known);
  } else if (out->failed == 0 || out->failed == out->known) {
    // As if every trial were a plain one with the greatest weight.
    double none[2];
    sb_probability_interval(none, 0, out->known);
    const double most = fmin(PLAIN * none[1], 1);
    out->probability = out->failed > 0 ? 1 : 0;
    out->interval[0] = out->failed > 0 ? 1 - most : 0;
    out->interval[1] = out->failed > 0 ? 1 : most;
  } else {
    for (size_t i = 0; i < samples; i++) {
      const double off = (trial[i] == SB_TRIAL_FAILS ? weight[i] : 0) - failed;
      square += off * off / (n * fmax(n - 1, 1));
    }
    const double spread = exp(1.959963984540054 * sqrt(square) / failed);
    out->probability = fmin(failed / of, 1);
    out->interval[0] = out->probability / spread;
    out->interval[1] = fmin(out->probability * spread, 1);
  }
  out->interval[1] = fmin(out->interval[1] + out->unknown, 1);
  if (out->failed == out->known) {
    out->interval[0] = fmax(out->interval[0] - out->unknown, 0);
  }
}

// Differences of runs, frame by frame. See the header.
#include "app/session/tangent.h"

#include <math.h>
#include <string.h>

// Frames of a run that are worth their slopes: 3 MB a parameter.
enum { FRAMES_MOST = 20000 };

// The numbers of a frame, of all but its indices and signs: runs of doubles, then floats.
enum { OWN = 9, SEAL_DOUBLES = 11, SEAL_FLOATS = 3, EACH = SEAL_DOUBLES + SEAL_FLOATS };
enum { FIELDS = OWN + SB_SEAL_COUNT * EACH, DISPLACEMENT = 1, FORCE = 4 };
_Static_assert(offsetof(SbFrame, spring_force) == (OWN - 1) * sizeof(double), "not in a row");
_Static_assert(offsetof(SbFrame, displacement) == DISPLACEMENT * sizeof(double), "another place");
_Static_assert(offsetof(SbFrame, force) == FORCE * sizeof(double), "another place");
_Static_assert(offsetof(SbSealFrame, friction) - offsetof(SbSealFrame, contact_left) ==
                   (SEAL_DOUBLES - 1) * sizeof(double),
               "not in a row");
_Static_assert(offsetof(SbSealFrame, pressure_right) == (SEAL_FLOATS - 1) * sizeof(float),
               "not in a row");

enum { ARRAYS = 4, FILM = 2 }; // of a profile: x, pressure, film, asperities

typedef struct {
  size_t count;
  float *slope; // [ARRAYS][count], owned; NULL: none
} Profile;

struct SbTangent {
  size_t frames, profiles;
  float *frame;     // [frames][FIELDS]
  Profile *profile; // [profiles]
};

static void get_fields(double *out, const SbFrame *frame) {
  memcpy(out, frame, OWN * sizeof *out);
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealFrame *seal = &frame->seal[i];
    double *to = out + OWN + i * EACH;
    memcpy(to, &seal->contact_left, SEAL_DOUBLES * sizeof *to);
    to[SEAL_DOUBLES] = (double)seal->land_fraction;
    to[SEAL_DOUBLES + 1] = (double)seal->pressure_left;
    to[SEAL_DOUBLES + 2] = (double)seal->pressure_right;
  }
}

static void put_fields(SbFrame *frame, const double *from) {
  memcpy(frame, from, OWN * sizeof *from);
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    SbSealFrame *seal = &frame->seal[i];
    const double *of = from + OWN + i * EACH;
    memcpy(&seal->contact_left, of, SEAL_DOUBLES * sizeof *of);
    seal->land_fraction = (float)fmin(fmax(of[SEAL_DOUBLES], 0), 1);
    seal->pressure_left = (float)of[SEAL_DOUBLES + 1];
    seal->pressure_right = (float)of[SEAL_DOUBLES + 2];
  }
}

// Whether two runs have the same events in the same order.
static bool same_events(const SbTrace *a, const SbTrace *b) {
  size_t count, others;
  const SbTraceEvent *one = sb_trace_events(a, &count), *other = sb_trace_events(b, &others);
  bool same = count == others && count > 0;
  for (size_t i = 0; same && i < count; i++) {
    same = one[i].stage == other[i].stage && one[i].cycle == other[i].cycle;
  }
  return same;
}

// A run and where its present stage lies in it, by frames.
typedef struct {
  const SbDisplayedRun *run;
  size_t begin, end;
} Span;

static void to_stage(Span *span, size_t stage) {
  size_t count;
  const SbTraceEvent *event = sb_trace_events(span->run->trace, &count);
  span->begin = event[stage].mark.frame;
  span->end = stage + 1 < count ? event[stage + 1].mark.frame : span->run->chart.count - 1;
}

// The frame at a share of a stage's time, and its numbers; of frames at the same time, before and
// after an event, the last.
static const SbFrame *at_share(double *out, const Span *span, double share) {
  const SbFrame *frames = span->run->chart.frames;
  const double from = frames[span->begin].time, to = frames[span->end].time;
  const double time = from + share * (to - from);
  size_t low = span->begin, high = span->end;
  while (high > low + 1) {
    const size_t middle = low + (high - low) / 2;
    *(frames[middle].time <= time ? &low : &high) = middle;
  }
  const SbFrame *a = &frames[low], *b = &frames[high];
  const double part = b->time > a->time ? fmin((time - a->time) / (b->time - a->time), 1) : 0;
  const bool nearer = part > 0.5;
  get_fields(out, nearer ? b : a);
  // Rounding of a time is no way to the next frame, which may be of another state.
  if (part > 1e-9 && part < 1 - 1e-9) {
    double other[FIELDS];
    get_fields(other, nearer ? a : b);
    for (int i = 0; i < FIELDS; i++) {
      out[i] += (nearer ? 1 - part : part) * (other[i] - out[i]);
    }
  }
  return nearer ? b : a;
}

// Moves a span to the stage of the base's frame, and there to its instant.
static const SbFrame *at_frame(double *out, Span *its, const Span *mine, size_t frame) {
  const SbFrame *frames = mine->run->chart.frames;
  if (frame <= mine->begin || frame >= mine->end) {
    const SbFrame *same = &its->run->chart.frames[frame <= mine->begin ? its->begin : its->end];
    get_fields(out, same);
    return same;
  }
  const double from = frames[mine->begin].time, to = frames[mine->end].time;
  return at_share(out, its, to > from ? (frames[frame].time - from) / (to - from) : 0);
}

static const double *array_of(const SbContactProfile *profile, int array) {
  const double *const arrays[ARRAYS] = {profile->x, profile->pressure, profile->film,
                                        profile->asperity_pressure};
  return arrays[array];
}

// The base's profile `index`, whose like the sides have in these frames.
static void take_profile(Profile *out, const SbDisplayedRun *base, uint32_t index,
                         const SbDisplayedRun *const side[2], const uint32_t its[2], double width) {
  const SbContactProfile *own = sb_run_profile(base->run, index);
  const SbContactProfile *of[2];
  for (int k = 0; k < 2; k++) {
    of[k] = its[k] != UINT32_MAX ? sb_run_profile(side[k]->run, its[k]) : NULL;
    if (own == NULL || of[k] == NULL || of[k]->count != own->count ||
        (of[k]->asperity_pressure == NULL) != (own->asperity_pressure == NULL)) {
      return;
    }
  }
  out->count = own->count;
  out->slope = g_new0(float, ARRAYS * own->count);
  for (int a = 0; a < ARRAYS; a++) {
    const double *up = array_of(of[0], a), *down = array_of(of[1], a);
    float *slope = out->slope + (size_t)a * own->count;
    for (size_t i = 0; up != NULL && i < own->count; i++) {
      // At rest there is no film; one that both sides do not have has no slope.
      const bool rests = !(up[i] > 0) && !(down[i] > 0), slides = up[i] > 0 && down[i] > 0;
      const double change = a != FILM ? up[i] - down[i]
                            : slides  ? log(up[i] / down[i])
                            : rests   ? 0
                                      : NAN;
      slope[i] = (float)(change / width);
    }
  }
}

SbTangent *sb_tangent_new(const SbDisplayedRun *base, const SbTangentRuns *runs, SbParamId id) {
  const SbDisplayedRun *const side[2] = {runs->up != NULL ? runs->up : runs->level,
                                         runs->down != NULL ? runs->down : runs->level};
  const double width = sb_params_get(&side[0]->params, id) - sb_params_get(&side[1]->params, id);
  size_t events;
  const SbTraceEvent *event = sb_trace_events(base->trace, &events);
  if (!(width > 0) || base->chart.count > FRAMES_MOST ||
      !same_events(base->trace, side[0]->trace) || !same_events(base->trace, side[1]->trace)) {
    return NULL;
  }
  SbTangent *out = g_new0(SbTangent, 1);
  out->frames = base->chart.count;
  out->frame = g_new(float, FIELDS * out->frames);
  for (size_t i = 0; i < out->frames; i++) {
    for (int s = 0; s < SB_SEAL_COUNT; s++) {
      const uint32_t index = base->chart.frames[i].seal[s].profile;
      out->profiles = index != UINT32_MAX ? MAX(out->profiles, index + 1) : out->profiles;
    }
  }
  out->profile = g_new0(Profile, out->profiles + 1);

  // Frames, stage by stage; each profile where a frame first has it.
  Span mine = {.run = base}, its[2] = {{.run = side[0]}, {.run = side[1]}};
  size_t stage = 0;
  for (size_t i = 0; i < out->frames; i++) {
    // An event's own frame ends the stage before it.
    while (i > 0 && stage + 1 < events && i > event[stage + 1].mark.frame) {
      stage++;
    }
    to_stage(&mine, stage);
    double value[2][FIELDS];
    const SbFrame *frame[2];
    for (int k = 0; k < 2; k++) {
      to_stage(&its[k], stage);
      frame[k] = at_frame(value[k], &its[k], &mine, i);
    }
    for (int f = 0; f < FIELDS; f++) {
      out->frame[i * FIELDS + (size_t)f] = (float)((value[0][f] - value[1][f]) / width);
    }
    for (int s = 0; s < SB_SEAL_COUNT; s++) {
      const uint32_t index = base->chart.frames[i].seal[s].profile;
      if (index != UINT32_MAX && out->profile[index].slope == NULL) {
        const uint32_t theirs[2] = {frame[0]->seal[s].profile, frame[1]->seal[s].profile};
        take_profile(&out->profile[index], base, index, side, theirs, width);
      }
    }
  }
  return out;
}

void sb_tangent_free(SbTangent *tangent) {
  if (tangent != NULL) {
    for (size_t i = 0; i < tangent->profiles; i++) {
      g_free(tangent->profile[i].slope);
    }
    g_free(tangent->profile);
    g_free(tangent->frame);
    g_free(tangent);
  }
}

void sb_tangent_add_frame(SbFrame *out, const SbTangent *tangent, size_t frame, double by) {
  double value[FIELDS];
  get_fields(value, out);
  for (size_t i = 0; i < FIELDS; i++) {
    value[i] += by * (double)tangent->frame[frame * FIELDS + i];
  }
  put_fields(out, value);
}

void sb_tangent_add_loop(double *displacement, double *force, const SbTangent *tangent,
                         size_t frame, double by) {
  *displacement += by * (double)tangent->frame[frame * FIELDS + DISPLACEMENT];
  *force += by * (double)tangent->frame[frame * FIELDS + FORCE];
}

bool sb_tangent_add_profile(SbTangentProfile *out, const SbTangent *tangent, uint32_t profile,
                            double by) {
  if (profile >= tangent->profiles || tangent->profile[profile].slope == NULL) {
    return false;
  }
  const Profile *of = &tangent->profile[profile];
  const size_t n = of->count;
  for (size_t i = 0; i < n; i++) {
    out->x[i] += by * (double)of->slope[i];
    out->pressure[i] += by * (double)of->slope[n + i];
    out->film[i] *= exp(by * (double)of->slope[FILM * n + i]);
    out->asperity[i] += by * (double)of->slope[(ARRAYS - 1) * n + i];
  }
  return true;
}

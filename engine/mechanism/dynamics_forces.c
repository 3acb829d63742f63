// Forces of dynamics.h at a point of the motion, each written once as coefficients about it, what
// they do, and the quantities whose sign announces an event.
#include "engine/mechanism/dynamics_internal.h"

#include <math.h>
#include <string.h>

Moving sb_motion_drive_at(const SbDynamics *s, double t) {
  Moving at = {s->piece.value + s->piece.rate * (t - s->piece.at), s->piece.rate};
  if (s->piece.curved) {
    sb_drive_sine(&s->model->drive, t, &at.value, &at.rate);
  }
  return at;
}

Moving sb_motion_wall_at(const SbDynamics *s, size_t w, double t) {
  return w == SB_DYNAMICS_PLATEN ? sb_motion_drive_at(s, t)
                                 : (Moving){s->model->stop[w].position, 0.0};
}

double sb_motion_deflection(const SbDynamics *s, size_t w, double t, double x) {
  const SbDynamicsWall *wall = &s->wall[w];
  if (wall->on && wall->stiffness > 0.0 && !rigid(wall->stiffness)) {
    return sb_motion_wall_at(s, w, t).value - x;
  }
  if (wall->on || wall->residual == 0.0) {
    return 0.0;
  }
  // exp(-746) is 0, but slow to find.
  double faded = wall->stiffness / wall->damping * (t - wall->since);
  return faded < 746.0 ? wall->residual * exp(-faded) : 0.0;
}

bool sb_motion_speed_dependent(const SbDynamicsModel *m, size_t i) {
  return m->contact[i].stribeck_speed > 0.0 && m->contact[i].static_ratio != 1.0;
}

double sb_motion_sliding_level(const SbDynamics *s, size_t i, double level, double speed) {
  const SbDynamicsContact *c = &s->model->contact[i];
  if (c->stribeck_speed > 0.0) {
    double fall = exp(-pow(fmax(speed, 0.0) / c->stribeck_speed, c->stribeck_exponent));
    return level * (1.0 + (c->static_ratio - 1.0) * fall);
  }
  return level;
}

// ---- forces ----

void sb_motion_wall_force(Force *force, const SbDynamics *s, size_t w, double t, double x) {
  const Moving at = sb_motion_wall_at(s, w, t);
  double k = s->wall[w].stiffness;
  force->c = s->wall[w].damping;
  if (w == SB_DYNAMICS_PLATEN && sb_motion_by_force(s->model)) {
    force->f0 = at.value;
    force->f1 = at.rate;
    force->k = 0.0;
    return;
  }
  force->f0 = k * (at.value - x) + force->c * at.rate;
  force->f1 = k * at.rate;
  force->k = k;
}

static void contact_force(Force *force, const SbDynamics *s, size_t i, const Point *p) {
  const SbDynamicsContact *c = &s->model->contact[i];
  if (s->state[i] == SB_CONTACT_SLIP) {
    double level = sb_motion_level(&p->loads, i, s->sign[i]);
    force->f0 = -s->sign[i] * sb_motion_sliding_level(s, i, level, s->sign[i] * p->v);
  } else if (s->state[i] == SB_CONTACT_STUCK && !is_rigid(s->model, i)) {
    force->f0 = -c->stiffness * p->z->d[i];
    force->k = c->stiffness;
    force->c = c->damping;
  }
}

static void add(Force *sum, const Force *f) {
  sum->f0 += f->f0;
  sum->f1 += f->f1;
  sum->k += f->k;
  sum->c += f->c;
}

void sb_motion_point(Point *p, const SbDynamics *s, double t, const SbDynamicsState *z) {
  const SbDynamicsModel *m = s->model;
  p->t = t;
  p->z = z;
  p->v = s->held ? 0.0 : z->v;
  if (s->loads.constant || m->loads == NULL) {
    p->loads = s->loads;
  } else {
    p->loads = (SbDynamicsLoads){0};
    m->loads(&p->loads, z->x, s->region, &z->extra, m->user);
  }
  SbDynamicsBand other = {0};
  const SbDynamicsBand *band = &s->band;
  if (s->banded && !s->loads.constant) {
    double inside = isfinite(band->high) ? 0.5 * (band->low + band->high) : band->low;
    m->band(&other, z->x, s->region, s->direction, inside, &z->extra, m->user);
    band = &other;
  }
  p->rigid = p->sum.f1 = 0.0;
  p->sum.f0 = p->loads.force - m->spring_preload - m->spring_stiffness * z->x;
  p->sum.k = m->spring_stiffness;
  p->sum.c = m->damping;
  // Piece by piece: this is called most of all.
  for (size_t w = 0; w < SB_DYNAMICS_WALLS; w++) {
    p->wall[w] = (Force){0};
    if (s->wall[w].on && !rigid(s->wall[w].stiffness)) {
      sb_motion_wall_force(&p->wall[w], s, w, t, z->x);
      add(&p->sum, &p->wall[w]);
    }
  }
  for (size_t i = 0; i < m->contacts; i++) {
    p->contact[i] = p->beside[i] = (Force){0};
    if (s->state[i] != SB_CONTACT_OFF) {
      contact_force(&p->contact[i], s, i, p);
      add(&p->sum, &p->contact[i]);
    }
    if (s->banded && s->state[i] == SB_CONTACT_SLIP && s->sign[i] == s->direction) {
      p->beside[i] = (Force){.f0 = -s->direction * band->rise[i], .c = band->slope[i]};
      add(&p->sum, &p->beside[i]);
    }
    p->rigid += is_rigid(m, i) ? p->contact[i].f0 + p->beside[i].f0 : 0.0;
  }
}

double sb_motion_deflection_rate(const SbDynamics *s, const Point *p, size_t i) {
  const SbDynamicsContact *c = &s->model->contact[i];
  if (is_rigid(s->model, i) || s->state[i] == SB_CONTACT_OFF) {
    return 0.0;
  }
  if (s->state[i] == SB_CONTACT_STUCK) {
    return p->v;
  }
  return c->damping > 0.0 ? (-p->contact[i].f0 - c->stiffness * p->z->d[i]) / c->damping : 0.0;
}

double sb_motion_deflection_at(const SbDynamics *s, size_t i, double tau, double travel,
                               double *rate) {
  const SbDynamicsContact *c = &s->model->contact[i];
  *rate = 0.0;
  if (is_rigid(s->model, i) || s->state[i] == SB_CONTACT_OFF) {
    return 0.0;
  }
  if (s->state[i] == SB_CONTACT_STUCK) {
    return s->at.d[i] + travel; // its rate is the stem's
  }
  if (c->damping <= 0.0) {
    return s->at.d[i];
  }
  double fading = c->stiffness / c->damping;
  double end = s->sign[i] * sb_motion_level(&s->loads, i, s->sign[i]) / c->stiffness;
  double left = (s->at.d[i] - end) * exp(-fading * tau);
  *rate = -fading * left;
  return end + left;
}

// ---- energy ----

double sb_motion_stored_energy(const SbDynamics *s, double t, const SbDynamicsState *z) {
  const SbDynamicsModel *m = s->model;
  double sum = m->spring_preload * z->x + 0.5 * m->spring_stiffness * z->x * z->x;
  for (size_t i = 0; i < m->contacts; i++) {
    sum += is_rigid(m, i) ? 0.0 : 0.5 * m->contact[i].stiffness * z->d[i] * z->d[i];
  }
  for (size_t w = 0; w < SB_DYNAMICS_WALLS; w++) {
    double e = sb_motion_deflection(s, w, t, z->x);
    sum += e != 0.0 ? 0.5 * s->wall[w].stiffness * e * e : 0.0;
  }
  return sum;
}

double sb_motion_relaxed(const SbDynamics *s, size_t w, double t0, double t1) {
  if (s->wall[w].on || s->wall[w].residual == 0.0) {
    return 0.0;
  }
  double a = sb_motion_deflection(s, w, t0, 0.0), b = sb_motion_deflection(s, w, t1, 0.0);
  return 0.5 * s->wall[w].stiffness * (a - b) * (a + b);
}

// In the order of SbDynamicsEnergy.
enum { DRIVE, PRESSURE, FRICTION, VISCOUS, SEAL, STOP, MACHINE };

void sb_motion_add_energy(double *term, const SbDynamics *s, const Point *p, const Stretch *over) {
  const SbDynamicsModel *m = s->model;
  term[PRESSURE] += p->loads.force * over->travel;
  term[VISCOUS] += m->damping * over->square;
  for (size_t w = 0; w < SB_DYNAMICS_PLATEN; w++) {
    term[STOP] += p->wall[w].c * over->square;
  }
  const Force *f = &p->wall[SB_DYNAMICS_PLATEN];
  if (s->wall[SB_DYNAMICS_PLATEN].on && sb_motion_by_force(m)) {
    term[DRIVE] += f->f0 * over->travel + f->f1 * over->ramp - f->c * over->square;
  } else if (s->wall[SB_DYNAMICS_PLATEN].on) {
    // The platen moves at its own speed against the integral of the force.
    double rate = f->f1 / f->k;
    term[DRIVE] += rate * (f->f0 * over->time - f->k * over->lag - f->c * over->travel);
    term[MACHINE] += f->c * (rate * (rate * over->time - 2.0 * over->travel) + over->square);
  }
  for (size_t i = 0; i < m->contacts; i++) {
    if (s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    term[SEAL] += m->contact[i].damping * over->fade[i];
    if (s->state[i] == SB_CONTACT_SLIP) {
      term[FRICTION] -= p->contact[i].f0 * (over->travel - over->shift[i]) +
                        p->beside[i].f0 * over->travel - p->beside[i].c * over->square;
    }
  }
}

// ---- event functions ----

// Returns `side` times a force, f0 of which is the remainder of terms of `size` [N].
static SbEventFunction function_of(const Force *f, double side, double size) {
  return (SbEventFunction){.constant = side * f->f0,
                           .rate = side * f->f1,
                           .of_x = -side * f->k,
                           .of_v = -side * f->c,
                           .noise = size};
}

// Terms in the gap to wall w [m], or in its force [N]: the drive's value carries the rounding of
// the time since its piece began.
static double gap_size(const SbDynamics *s, const Point *p, size_t w) {
  const Moving at = sb_motion_wall_at(s, w, p->t);
  return fabs(at.value) + fabs(at.rate * p->t) +
         (w == SB_DYNAMICS_PLATEN ? fabs(s->piece.value) : 0.0) + fabs(p->z->x) + length_noise;
}

static double wall_size(const SbDynamics *s, const Point *p, size_t w) {
  double k = s->wall[w].stiffness; // a finger has none
  return (k > 0.0 ? k : 1.0) * gap_size(s, p, w);
}

// Terms in all forces together [N].
static double sum_size(const SbDynamics *s, const Point *p) {
  double size = fabs(p->loads.force) + fabs(s->model->spring_preload);
  for (size_t w = 0; w < SB_DYNAMICS_WALLS; w++) {
    size += s->wall[w].on && !rigid(s->wall[w].stiffness) ? wall_size(s, p, w) : 0.0;
  }
  for (size_t i = 0; i < s->model->contacts; i++) {
    size += fabs(p->contact[i].f0) + fabs(p->beside[i].f0);
  }
  return size;
}

static bool wall_function(const SbDynamics *s, const Point *p, size_t w, SbEventFunction *g) {
  const SbDynamicsModel *m = s->model;
  const SbDynamicsWall *wall = &s->wall[w];
  bool platen = w == SB_DYNAMICS_PLATEN;
  if (platen ? m->drive.kind == SB_DRIVE_NONE || m->drive_bonded || sb_motion_finger_gone(s)
             : w >= m->stops) {
    return false;
  }
  if (wall->on) {
    // A rigid stop carries all of the force that presses the stem on it.
    *g = rigid(wall->stiffness) ? function_of(&p->sum, -wall->push, sum_size(s, p))
                                : function_of(&p->wall[w], wall->push, wall_size(s, p, w));
  } else if (platen && sb_motion_by_force(m)) {
    Force force;
    sb_motion_wall_force(&force, s, w, p->t, p->z->x);
    *g = function_of(&force, -wall->push, wall_size(s, p, w));
  } else {
    // Contact lost: met again when the gap closes on the remaining deflection; a stop is also met
    // by a stem that friction holds in the meantime.
    if (!platen && s->held && wall->residual == 0.0) {
      return false;
    }
    const Moving at = sb_motion_wall_at(s, w, p->t);
    *g = (SbEventFunction){.constant = wall->push * (p->z->x - at.value),
                           .rate = -wall->push * at.rate,
                           .of_x = wall->push,
                           .relax = sb_motion_deflection(s, w, p->t, p->z->x),
                           .relax_rate = wall->damping > 0.0 ? wall->stiffness / wall->damping : 0,
                           .noise = gap_size(s, p, w)};
  }
  return true;
}

// Adds the largest force that contact i can carry from now on.
static void add_holding(const SbDynamics *s, const Point *p, size_t i, int direction,
                        SbEventFunction *g) {
  const SbDynamicsContact *c = &s->model->contact[i];
  double level = sb_motion_level(&p->loads, i, direction), dwell = fmax(0.0, p->t - s->since[i]),
         until;
  const SbDwellPiece own = {0.0, c->dwell_time, c->static_ratio, c->dwell_gain}, *piece = &own;
  g->constant += s->margin[i];
  if (p->loads.rest[i] != NULL) {
    piece = sb_dwell_piece(&until, p->loads.rest[i], dwell + sb_motion_time_noise(p->t));
  } else if (s->fresh[i]) {
    g->constant += sb_motion_sliding_level(s, i, level, 0.0);
    return;
  }
  g->constant += level * piece->value;
  if (piece->gain > 0.0 && level > 0.0) {
    g->log[g->logs].gain = level * piece->gain;
    g->log[g->logs].start = fmax(0.0, dwell - piece->from);
    g->log[g->logs++].time = piece->time;
  }
}

double sb_motion_rest_ends(const SbDynamics *s, const Point *p) {
  double ends = INFINITY;
  for (size_t i = 0; i < s->model->contacts; i++) {
    if (s->state[i] == SB_CONTACT_STUCK && p->loads.rest[i] != NULL) {
      double until, dwell = fmax(0.0, p->t - s->since[i]);
      (void)sb_dwell_piece(&until, p->loads.rest[i], dwell + sb_motion_time_noise(p->t));
      ends = fmin(ends, until - dwell);
    }
  }
  return ends;
}

// A function's value at the point itself.
static double value_of(const SbEventFunction *g, double v) {
  double value = g->constant + g->of_v * v + g->relax;
  for (int i = 0; i < g->logs; i++) {
    value += g->log[i].gain * log1p(g->log[i].start / g->log[i].time);
  }
  return value;
}

double sb_motion_holding(const SbDynamics *s, const Point *p, size_t i, int direction) {
  SbEventFunction g = {0};
  add_holding(s, p, i, direction, &g);
  return value_of(&g, 0.0);
}

// Returns the speed of a sliding patch in its direction; a patch that decelerates for ever comes to
// rest.
static SbEventFunction patch_function(const SbDynamics *s, const Point *p, size_t i) {
  const SbDynamicsContact *c = &s->model->contact[i];
  SbEventFunction g = {.constant = s->brisk[i] ? -sb_motion_rest_speed(s->model) : 0.0,
                       .of_v = s->sign[i]};
  if (!is_rigid(s->model, i) && c->damping > 0.0) {
    double end = -p->contact[i].f0 / c->stiffness;
    g.relax_rate = c->stiffness / c->damping;
    g.relax = s->sign[i] * g.relax_rate * (p->z->d[i] - end);
    g.noise = g.relax_rate * (fabs(p->z->d[i]) + fabs(end));
  }
  return g;
}

static bool rigid_function(const SbDynamics *s, const Point *p, int side, SbEventFunction *g) {
  const SbDynamicsModel *m = s->model;
  bool any = false;
  *g = function_of(&p->sum, -side, sum_size(s, p));
  for (size_t i = 0; i < m->contacts; i++) {
    if (!is_rigid(m, i) || s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    if (s->state[i] == SB_CONTACT_SLIP) {
      *g = patch_function(s, p, i);
      return side > 0;
    }
    any = true;
    add_holding(s, p, i, side, g);
  }
  // On a rigid stop the stop carries first.
  for (size_t w = 0; w < m->stops; w++) {
    any = any && !(s->wall[w].on && rigid(s->wall[w].stiffness));
  }
  return any;
}

static bool contact_function(const SbDynamics *s, const Point *p, size_t i, int side,
                             SbEventFunction *g) {
  if (i >= s->model->contacts || is_rigid(s->model, i) || s->state[i] == SB_CONTACT_OFF) {
    return false;
  }
  if (s->state[i] == SB_CONTACT_SLIP) {
    *g = patch_function(s, p, i);
    return side > 0 && !(s->held && s->model->contact[i].damping == 0.0);
  }
  *g = function_of(&p->contact[i], side, fabs(p->contact[i].f0));
  add_holding(s, p, i, side, g);
  return true;
}

// Returns the remaining speed in the band. It ends at rest only for elastic contacts: a rigid one
// comes to rest there.
static bool speed_function(const SbDynamics *s, int side, SbEventFunction *g) {
  const SbDynamicsBand *band = &s->band;
  bool rests = false;
  for (size_t i = 0; i < s->model->contacts; i++) {
    rests = rests || (is_rigid(s->model, i) && s->state[i] == SB_CONTACT_SLIP);
  }
  if (!s->banded || (side > 0 ? isinf(band->high) : band->low == 0.0 && rests)) {
    return false;
  }
  *g = (SbEventFunction){.constant = side > 0 ? band->high : -band->low,
                         .of_v = -side * s->direction};
  return true;
}

static bool edge_function(const SbDynamics *s, const Point *p, int side, SbEventFunction *g) {
  const SbDynamicsModel *m = s->model;
  if (s->held || (side > 0 ? s->region >= m->edges : s->region == 0)) {
    return false;
  }
  double edge = m->edge[side > 0 ? s->region : s->region - 1];
  *g = (SbEventFunction){.constant = side * (edge - p->z->x), .of_x = -side};
  return true;
}

bool sb_motion_event_function(const SbDynamics *s, const Point *p, int event, SbEventFunction *g) {
  bool live = false;
  if (event >= EVENT_CONTACT_DOWN) {
    live = contact_function(s, p, (size_t)(event - EVENT_CONTACT_DOWN), -1, g);
  } else if (event >= EVENT_CONTACT_UP) {
    live = contact_function(s, p, (size_t)(event - EVENT_CONTACT_UP), 1, g);
  } else if (event >= EVENT_STOP) {
    live = wall_function(s, p, (size_t)(event - EVENT_STOP), g);
  } else if (event >= EVENT_SPEED_UP) {
    live = speed_function(s, event == EVENT_SPEED_UP ? 1 : -1, g);
  } else if (event >= EVENT_RIGID_UP) {
    live = rigid_function(s, p, event == EVENT_RIGID_UP ? 1 : -1, g);
  } else if (event == EVENT_PLATEN) {
    live = wall_function(s, p, SB_DYNAMICS_PLATEN, g);
  } else if (event >= EVENT_EDGE_UP) {
    live = edge_function(s, p, event == EVENT_EDGE_UP ? 1 : -1, g);
  }
  if (live && s->held) {
    g->of_x = g->of_v = 0.0;
  }
  return live;
}

double sb_motion_event_value(const SbDynamics *s, int event, const SbEventFunction *g, double v,
                             double *noise) {
  *noise = 1e-12 * (fabs(g->constant) + g->noise + fabs(g->relax)) +
           fabs(g->of_v) * 10.0 * s->system.tolerance * s->speed_size;
  // A contact that decelerates to the speed of rest is at rest, whatever speed remains within the
  // tolerance.
  for (size_t i = 0; i < s->model->contacts; i++) {
    int own = is_rigid(s->model, i) ? EVENT_RIGID_UP : EVENT_CONTACT_UP + (int)i;
    if (event == own && s->brisk[i] && s->state[i] == SB_CONTACT_SLIP) {
      *noise = fmin(*noise, 0.1 * sb_motion_rest_speed(s->model));
    }
  }
  return value_of(g, v);
}

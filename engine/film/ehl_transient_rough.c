// Pressure of the surfaces in the transient film, and the friction of its state.
#include "engine/film/ehl_transient.h"

#include <math.h>

// A smaller fraction of Hertz's pressure counts as none: a cavity next to the contact then has no
// unknown for it.
static const double NOTHING = 1e-13;

static void touch(SbEhlRoughPoint *out, const SbFilmTransient *t, double H) {
  *out = (SbEhlRoughPoint){0};
  if (t->rough && H > 0.0) {
    sb_ehl_rough_point(out, &t->surface, sb_ehl_rough_of_gap(&t->surface, H));
  }
}

void sb_transient_solids(SbFilmTransient *t, SbTransientState *s, bool split) {
  for (int i = 0; i < t->nodes; i++) {
    SbEhlRoughPoint at;
    touch(&at, t, s->H[i]);
    const bool nothing = !(fabs(at.solid) > NOTHING);
    t->solid[i] = nothing ? 0.0 : at.solid;
    t->solid_H[i] = nothing ? 0.0 : at.solid_t / at.h_t;
    if (!split) {
      s->Q[i] = s->P[i] + t->solid[i];
    } else if (!s->cavity[i]) {
      s->P[i] = s->Q[i] - t->solid[i];
    }
  }
}

// Integrals as of a steady film (ehl.h): of the shear of u over the open gap, where a cavity's
// fluid fills the share m/h in streamers; of h/2 dp/dx; of the asperities' pressure and real area.
void sb_transient_friction(SbFilmTransientResult *out, const SbFilmTransient *t) {
  const SbTransientState *s = &t->now;
  const SbFilmScale *scale = &t->scale;
  const SbFilmProblem *film = &t->problem.film;
  double couette = 0.0, cavity = 0.0, poiseuille = 0.0, load = 0.0, solid = 0.0, area = 0.0;
  double open = 1.0;
  for (int i = 0; i < t->nodes; i++) {
    SbEhlRoughPoint at;
    const double before = open;
    touch(&at, t, s->H[i]);
    open = 1.0 - at.share;
    *(s->cavity[i] ? &cavity : &couette) += t->volume[i] * open * s->m[i] / (s->H[i] * s->H[i]);
    load += t->volume[i] * at.asperity;
    solid += t->volume[i] * at.solid;
    area += t->volume[i] * at.share;
    if (i > 0) {
      const double half = 0.25 * (open * s->H[i] + before * s->H[i - 1]);
      poiseuille += half * (s->P[i] - s->P[i - 1]);
    }
  }
  const double shear =
      film->viscosity * 2.0 * s->speed * scale->half_width * scale->half_width / scale->film;
  out->friction_couette = shear * couette;
  out->friction_cavity = shear * cavity;
  out->friction_poiseuille = poiseuille * scale->film * scale->pressure;
  out->asperity_load = load * scale->half_width * scale->pressure;
  out->asperity_share = sb_ehl_asperity_share(
      out->asperity_load, solid * scale->half_width * scale->pressure, film->load);
  out->real_area = area * scale->half_width;
  const double sign = s->speed < 0.0 ? -1.0 : 1.0;
  out->friction_boundary =
      sign * (film->shear_strength * out->real_area + film->load_coefficient * out->asperity_load);
}

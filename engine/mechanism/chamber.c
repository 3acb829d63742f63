// See chamber.h.
#include "engine/mechanism/chamber.h"

#include "engine/base/check.h"
#include "engine/mechanism/inputs.h"
#include "engine/numeric/root.h"

#include <math.h>

SbStatus sb_chamber_check(const SbChamberModel *m, SbReport *report) {
  SbStatus status =
      SB_CHECK(report, {SB_MECHANISM_IN_PRESSURE, "the pressure [Pa]", m->canister, SB_FINITE},
               {0, "the chamber's volume [m3]", m->volume, SB_ABOVE_ZERO},
               {0, "the chamber's stiffness [Pa]", m->stiffness, SB_ABOVE_ZERO},
               {0, "the liquid's density [kg/m3]", m->density, SB_ABOVE_ZERO});
  if (status != SB_OK) {
    return status;
  }
  if (m->ports > SB_CHAMBER_PORTS) {
    return sb_fail(report, SB_ERROR_RANGE, "a chamber has at most %d ports", SB_CHAMBER_PORTS);
  }
  for (size_t i = 0; i < m->ports; i++) {
    const SbChamberPort *p = &m->port[i];
    if (!(p->high > p->low) || !(p->area > 0.0) || !isfinite(p->pressure)) {
      return sb_fail(report, SB_ERROR_RANGE, "port %zu needs a stretch, an area and a pressure", i);
    }
  }
  return sb_succeed(report);
}

static void equalise(const SbDoseChamber *c, double *pressure) {
  for (size_t i = 0; i < c->model->ports; i++) {
    if (c->open[i] && isinf(c->model->port[i].area)) {
      *pressure = c->model->port[i].pressure;
    }
  }
}

void sb_chamber_start(SbDoseChamber *c, const SbChamberModel *m, double x, double *pressure) {
  *c = (SbDoseChamber){.model = m};
  for (size_t i = 0; i < m->ports; i++) {
    const SbChamberPort *p = &m->port[i];
    c->open[i] = p->way == SB_PORT_BOTH_WAYS && x >= p->low && x < p->high;
  }
  equalise(c, pressure);
}

void sb_chamber_cross(SbDoseChamber *c, double x, int direction, double *pressure) {
  for (size_t i = 0; i < c->model->ports; i++) {
    const SbChamberPort *p = &c->model->port[i];
    if (x == p->low) {
      c->open[i] = direction > 0 && p->way == SB_PORT_BOTH_WAYS;
    } else if (x == p->high) {
      c->open[i] = direction < 0;
    }
  }
  equalise(c, pressure);
}

// sign(d) sqrt|d|, with a smooth bend within `bend` of zero.
static double bent_root(double d, double bend) {
  double u = d / bend;
  if (fabs(u) < 1.0) {
    return sqrt(bend) * u * (1.25 - 0.25 * u * u);
  }
  return d > 0.0 ? sqrt(d) : -sqrt(-d);
}

double sb_chamber_rate(const SbDoseChamber *c, double pressure) {
  const SbChamberModel *m = c->model;
  double flow = 0.0, bend = 1e-4 * fmax(fabs(m->canister), 1e3);
  for (size_t i = 0; i < m->ports; i++) {
    if (c->open[i] && isfinite(m->port[i].area)) {
      flow += m->port[i].area * sqrt(2.0 / m->density) *
              bent_root(m->port[i].pressure - pressure, bend);
    }
  }
  return m->stiffness / m->volume * flow;
}

static double rate_at(double pressure, const void *chamber) {
  return sb_chamber_rate(chamber, pressure);
}

double sb_chamber_rest_pressure(const SbDoseChamber *c, double pressure) {
  double low = INFINITY, high = -INFINITY;
  for (size_t i = 0; i < c->model->ports; i++) {
    const SbChamberPort *p = &c->model->port[i];
    if (c->open[i] && isinf(p->area)) {
      return pressure;
    }
    if (c->open[i]) {
      low = fmin(low, p->pressure);
      high = fmax(high, p->pressure);
    }
  }
  if (!(high >= low)) {
    return pressure;
  }
  return sb_bisect(rate_at, c, low, high); // it falls as the pressure rises
}

bool sb_chamber_settled(const SbDoseChamber *c, double pressure) {
  double most = 0.0, in = 0.0, out = 0.0;
  for (size_t i = 0; i < c->model->ports; i++) {
    if (c->open[i] && isfinite(c->model->port[i].area)) {
      double drop = c->model->port[i].pressure - pressure;
      most = fmax(most, fabs(drop));
      *(drop > 0.0 ? &in : &out) += c->model->port[i].area * sqrt(fabs(drop));
    }
  }
  // Nothing flows, or as much comes in as goes out.
  return most <= 1e-9 * fmax(fabs(c->model->canister), 1e3) || fabs(in - out) <= 1e-9 * (in + out);
}

static double annulus(double outer, double inner) {
  return M_PI / 4.0 * (outer - inner) * (outer + inner);
}

double sb_chamber_metered_volume(const SbDoseGeometry *g) {
  double volume = annulus(g->bore, g->land) * g->spacing + annulus(g->land, g->floor) * g->groove +
                  annulus(g->land, g->land - 2.0 * g->recess_depth) * g->recess_length;
  // Half of each ring, by Pappus.
  for (int i = 0; i < 2; i++) {
    double d = g->rings[i].section;
    volume -= 0.5 * M_PI * (g->rings[i].inner + d) * M_PI / 4.0 * d * d;
  }
  return volume;
}

// Doses that the liquid is good for, with fractions.
static double supply_of(const SbDoseSupply *s) {
  if (!(s->volume > 0.0) || !(s->liquid > s->residue)) {
    return 0.0;
  }
  return (s->liquid - s->residue) / s->volume * (1.0 - s->vapour / s->density) * (1.0 + 1e-12);
}

long sb_chamber_doses(const SbDoseSupply *supply) {
  return (long)floor(supply_of(supply));
}

double sb_chamber_dose(const SbDoseSupply *supply, long n) {
  const double before = (double)(n - 1 - (supply->empty ? 1 : 0));
  const double left = supply_of(supply) - before;
  return before < 0.0 ? 0.0 : supply->volume * supply->density * fmin(fmax(left, 0.0), 1.0);
}

double sb_chamber_filling(double volume, double area, double drop, double density) {
  return drop > 0.0 && area > 0.0 ? volume / (area * sqrt(2.0 * drop / density)) : NAN;
}

double sb_chamber_remaining(const SbDoseSupply *s, double area, double drop, double time) {
  if (isinf(time)) {
    return s->volume * s->gas;
  }
  const double draining = sb_chamber_filling(s->volume, area, drop, s->density);
  if (!(time > draining)) { // or nothing drives it out
    const double left = draining > 0.0 ? 1.0 - time / draining : 1.0;
    return s->volume * (left * s->density + (1.0 - left) * s->vapour);
  }
  const double rate =
      s->vapour > 0.0 ? 0.63 * area * sqrt(s->pressure / s->vapour) / s->volume : 0.0;
  return s->volume * fmax(s->gas, s->vapour * exp(-rate * (time - draining)));
}

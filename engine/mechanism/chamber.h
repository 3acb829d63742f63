// Pressure in the dose chamber as a state: open to the canister, closed, venting.
//
// The chamber lies between the inner and the outer seal. Ports join it to the canister or to the
// outside while the stem is in a stretch of its stroke; through an open port of effective area CdA
// liquid flows as through an orifice, Q = CdA sqrt(2 dp / rho), and the pressure follows
// p' = (B/V) sum Q, B the stiffness of liquid, rings and walls together. An infinite area equalises
// in one step. Then the seals see canister - chamber (inner) and chamber - outside (outer), and the
// thesis' two readings (docs/thesis.md) are two sets of ports, not two tables. SI units, gauge
// pressures, stem position > 0 into the canister. Leaves out: boiling in the chamber and the
// aerosol (B stands for both), heat, the seals' own leakage (see leak/).
#pragma once

#include "engine/base/status.h"

enum { SB_CHAMBER_PORTS = 4 };

typedef enum {
  SB_PORT_BOTH_WAYS, // open whenever the stem is in the stretch
  SB_PORT_ON_RETURN, // opens only if the stem enters the stretch from above; open until it leaves
} SbPortWay;

typedef struct {
  double low, high; // stretch of stem position, m; -INFINITY and INFINITY allowed
  SbPortWay way;
  double pressure; // beyond it, Pa gauge
  double area;     // effective (discharge coefficient included), m2; INFINITY: at once
} SbChamberPort;

typedef struct {
  double canister;  // Pa gauge
  double volume;    // m3
  double stiffness; // B, Pa
  double density;   // kg/m3
  size_t ports;
  SbChamberPort port[SB_CHAMBER_PORTS];
} SbChamberModel;

typedef struct {
  const SbChamberModel *model; // borrowed
  bool open[SB_CHAMBER_PORTS];
} SbDoseChamber;

// Refuses what makes no sense.
SbStatus sb_chamber_check(const SbChamberModel *model, SbReport *report);

// Ports for a stem at rest at x; `pressure` is equalised through ports of infinite area.
void sb_chamber_start(SbDoseChamber *chamber, const SbChamberModel *model, double x,
                      double *pressure);

// The stem crosses the edge at position x in direction +1 or -1.
void sb_chamber_cross(SbDoseChamber *chamber, double x, int direction, double *pressure);

// Pressure at which the flows through the open ports of a stem at rest balance; with none open, or
// ports of infinite area, the pressure given.
double sb_chamber_rest_pressure(const SbDoseChamber *chamber, double pressure);

// dp/dt [Pa/s], and whether nothing flows any more (to 1e-9 of the canister's pressure).
double sb_chamber_rate(const SbDoseChamber *chamber, double pressure);
bool sb_chamber_settled(const SbDoseChamber *chamber, double pressure);

// What bounds the dose chamber, all in m.
typedef struct {
  double bore, land, floor;           // diameters: bore, stem's land, groove floors
  double spacing, groove;             // between the grooves' middles; width of a groove
  double recess_depth, recess_length; // cut into the stem's land between them
  struct {
    double section, inner; // free diameters; rubber keeps its volume
  } rings[2];
} SbDoseGeometry;

// Volume [m3] between the middles of the two grooves that neither stem nor rubber fills: annulus,
// recess and the inner halves of both grooves, less the inner half of each ring. Exact for rings
// that lie symmetrically in their grooves. May be negative if the rings overfill it.
double sb_chamber_metered_volume(const SbDoseGeometry *geometry);

// What the canister gives the dose chamber over its life, its pressure held by what boils: each
// dose leaves a room that vapour fills, which boils off liquid besides, so that the liquid falls by
// V rho/(rho - rho_v) with each. Leaves out leaks, and what boiling cools.
typedef struct {
  double volume;          // metered, V [m3]
  double density, vapour; // rho, rho_v at saturation; rho_v 0: unknown [kg/m3]
  double liquid, residue; // in a new canister, and what can no longer be drawn [m3]
  bool empty;             // the chamber is before the first actuation, which fills it for the next
  double gas;             // density of the vapour at ambient pressure; 0: unknown [kg/m3]
  double pressure;        // absolute, at saturation [Pa]
} SbDoseSupply;

// Whole doses in the canister.
long sb_chamber_doses(const SbDoseSupply *supply);

// Mass [kg] that actuation n, from 1, delivers: the liquid's share of the last one falls short.
double sb_chamber_dose(const SbDoseSupply *supply, long n);

// Time [s] in which liquid fills a volume through an effective area [m2] under a pressure drop
// [Pa], as through an orifice; NAN without a drop or an area.
double sb_chamber_filling(double volume, double area, double drop, double density);

// Mass [kg] that a full chamber keeps after it was open to the outside for a time [s] through an
// effective area [m2], under a pressure drop [Pa] that boiling holds: liquid leaves as through an
// orifice, V/(CdA sqrt(2 dp/rho)), then the vapour, choked and at one temperature, rho falling by
// exp(-0.63 CdA sqrt(p/rho_v) t/V), to that at ambient pressure; an infinite time leaves that
// alone. 0.63: sqrt(g) (2/(g + 1))^((g + 1)/(2(g - 1))) at g = 1.1. Leaves out: what boils in the
// hole itself, which takes longer (a short one lets little boil: Fauske 1985), and cooling.
double sb_chamber_kept(const SbDoseSupply *supply, double area, double drop, double time);

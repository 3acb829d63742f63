// Pressure in the dose chamber, and mass of the doses.
//
// The chamber is between the inner and the outer seal. Ports connect it to the canister or to the
// outside while the stem is in a range of positions. Liquid flows through an open port of effective
// area CdA like through an orifice, Q = CdA sqrt(2 dp/rho), and p' = (B/V) sum Q. B is the
// stiffness of liquid, rings and walls together. A port of infinite area equalises the pressure
// immediately. x is the displacement of the stem, positive into the canister. The inner seal
// carries the pressure of the canister minus that of the chamber, the outer seal that of the
// chamber. The two pressure histories of the thesis (docs/thesis.md) are two sets of ports. Not
// modelled: boiling in the chamber, aerosol, heat, leakage of the seals. The functions have no
// state of their own and may be called concurrently on different chambers.
#pragma once

#include "engine/base/status.h"

// Largest number of ports.
enum { SB_CHAMBER_PORTS = 4 };

// When a port opens.
typedef enum {
  SB_PORT_BOTH_WAYS, // open whenever the stem is in the range
  SB_PORT_ON_RETURN, // opens when the stem enters the range at `high` (moving out of the
                     // canister); closes when the stem leaves the range
} SbPortWay;

// A port.
typedef struct {
  double low, high; // range of the stem position, low <= x < high [m]; -INFINITY, INFINITY allowed
  SbPortWay way;
  double pressure; // on the other side of the port [Pa]
  double area;     // effective area CdA [m2]; INFINITY: equalises immediately
} SbChamberPort;

// Constants of a chamber.
typedef struct {
  double canister;  // pressure of the canister [Pa]
  double volume;    // V [m3]
  double stiffness; // B [Pa]
  double density;   // rho of the liquid [kg/m3]
  size_t ports;     // number of ports
  SbChamberPort port[SB_CHAMBER_PORTS];
} SbChamberModel;

// State of the ports, set by sb_chamber_start().
typedef struct {
  const SbChamberModel *model; // borrowed
  bool open[SB_CHAMBER_PORTS]; // by port
} SbDoseChamber;

// Checks a model. SB_ERROR_RANGE: a constant or a port is out of range.
SbStatus sb_chamber_check(const SbChamberModel *model, SbReport *report);

// Initialises the ports for a stem at rest at x [m]; SB_PORT_ON_RETURN ports are closed. *pressure
// is the chamber's pressure [Pa], which the caller stores: if a port of infinite area is open, it
// is set to the pressure of that port, else it is unchanged. `model` is borrowed.
void sb_chamber_start(SbDoseChamber *chamber, const SbChamberModel *model, double x,
                      double *pressure);

// Updates the ports when the stem crosses the position x [m], which must equal `low` or `high` of a
// port exactly; `direction` is +1 (into the canister) or -1. *pressure [Pa] changes as in
// sb_chamber_start().
void sb_chamber_cross(SbDoseChamber *chamber, double x, int direction, double *pressure);

// Returns the pressure [Pa] at which the flows through the open ports cancel. If no port or one of
// infinite area is open, it returns `pressure`.
double sb_chamber_rest_pressure(const SbDoseChamber *chamber, double pressure);

// Returns dp/dt [Pa/s] at the chamber pressure `pressure` [Pa], for the open ports of finite area.
// Below a pressure difference of 1e-4 of the canister pressure (at least of 1 kPa) the square root
// is replaced by a smooth polynomial.
double sb_chamber_rate(const SbDoseChamber *chamber, double pressure);

// Returns whether the flow through the open ports of finite area has ceased, or inflow equals
// outflow, to a relative 1e-9; true if there is no such port.
bool sb_chamber_settled(const SbDoseChamber *chamber, double pressure);

// Dimensions of the dose chamber [m].
typedef struct {
  double bore, land, floor; // diameters of the bore, of the stem's land, of the groove floors
  double spacing, groove;   // distance of the groove centres; width of a groove
  double recess_depth, recess_length; // recess in the land between the grooves
  struct {
    double section, inner; // free section diameter and free inner diameter of the ring
  } rings[2];              // inner and outer seal, in any order
} SbDoseGeometry;

// Returns the volume [m3] between the centres of the two grooves that is not filled by stem or
// rubber: annulus, recess and the inner half of both grooves, minus half of each ring. The rubber
// is incompressible. Exact for rings that are symmetric in their grooves. The result is negative if
// the rings overfill the chamber.
double sb_chamber_metered_volume(const SbDoseGeometry *geometry);

// A canister and its chamber for the doses over the canister's life. Evaporation keeps the pressure
// constant: each dose leaves a volume of vapour, so the liquid decreases by V rho/(rho - rho_v) per
// dose. Not modelled: leakage, cooling by evaporation.
typedef struct {
  double volume;          // V, metered volume [m3]
  double density, vapour; // rho, rho_v at saturation [kg/m3]; rho_v 0: not known, taken as 0
  double liquid, residue; // volume of liquid in a new canister; volume that cannot be drawn [m3]
  bool empty;             // the chamber is empty before the first actuation; false: it is full
  double gas;             // density of the vapour at ambient pressure [kg/m3]; 0: not known
  double pressure;        // absolute saturation pressure [Pa]
} SbDoseSupply;

// Returns the number of complete doses in the canister.
long sb_chamber_doses(const SbDoseSupply *supply);

// Returns the mass [kg] that actuation n (from 1) delivers. It is 0 for the first actuation if the
// chamber was empty. The actuation after the last complete dose delivers the remaining fraction of
// a dose, later ones 0.
double sb_chamber_dose(const SbDoseSupply *supply, long n);

// Returns the time [s] in which liquid of `density` [kg/m3] fills `volume` [m3] through the
// effective `area` CdA [m2] under the pressure difference `drop` [Pa], by the orifice equation. NAN
// if `drop` or `area` is not positive.
double sb_chamber_filling(double volume, double area, double drop, double density);

// Returns the mass [kg] that remains in a full chamber after it was open to the outside for `time`
// [s] (INFINITY: vapour at ambient pressure) through the effective `area` CdA [m2], with the
// constant pressure difference `drop` [Pa]. First the liquid flows out as through an orifice in
// V/(CdA sqrt(2 dp/rho)). Then the vapour flows out, choked and isothermal: rho decays as exp(-0.63
// CdA sqrt(p/rho_v) t/V). 0.63 = sqrt(g) (2/(g + 1))^((g + 1)/(2(g - 1))) at g = 1.1. Not modelled:
// boiling in the orifice (Fauske 1985), cooling. If `area` or `drop` is not positive nothing flows
// out in a finite time; of a fluid with vapour 0 only `gas` remains after the liquid.
double sb_chamber_remaining(const SbDoseSupply *supply, double area, double drop, double time);

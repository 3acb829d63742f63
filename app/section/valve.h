// The valve's outlines to scale: housing with bore land, mouth and vent, stem with grooves and dose
// chamber. Lengths in m.
//
// Axes: x axial, canister on the left; y radial from the axis. The housing's frame has the land
// edge at x = 0, the land on its right. The stem's frame lies on the housing's at displacement 0: a
// point of the stem sits at x - s. The origin of a seal's frame (the contract's x = 0) moves with
// the stem. Sizes that no result depends on come from the drawing's own parameters; where those
// contradict each other or the gland (a spacing shorter than a groove...) they are stretched to the
// next size that can be drawn, and `adjusted` says so.
#pragma once

#include "engine/model.h"

typedef struct {
  double x, y;
} SbValvePoint;

enum { SB_VALVE_POINTS_MAX = 24 };

typedef struct {
  size_t count;
  SbValvePoint point[SB_VALVE_POINTS_MAX];
} SbValveOutline;

typedef struct {
  double bore, floor, land;     // radii: bore, groove floor, stem's land [m]
  double face, end;             // housing's ends [m], face < 0 < end
  double vent_left, vent_right; // equal: no vent
  SbValveOutline housing;       // its lower edge, from the face's top to the end's top
  SbValveOutline stem;          // its upper edge, from the nose on the axis to the rod's end
  double nose;                  // x of the nose's face, stem's frame
  double chamber;               // x of the chamber's middle, stem's frame
  double chamber_floor;         // radius
  double shoulder;              // x where the land behind the outer groove ends, stem's frame
  double rod;                   // radius of the rod
  double groove_left[SB_SEAL_COUNT], groove_right[SB_SEAL_COUNT]; // stem's frame
  double origin[SB_SEAL_COUNT];       // origin of the seal's frame, stem's frame
  double section_area[SB_SEAL_COUNT]; // of the fitted ring, volume kept: A/(1 + stretch) [m2]
  bool adjusted;                      // some drawing size had to give way
} SbValve;

// Builds the outlines. inner_contact_left: left end of the inner seal's contact in its own frame
// when it reaches the land edge [m]; with `land_edge` it fixes where the seals are. `top` is the
// radius up to which the housing is drawn [m].
void sb_valve_make(SbValve *valve, const SbModel *model, double inner_contact_left, double top);

// Radius of the housing's inner surface at x in the housing's frame [m]; HUGE_VAL beside the
// housing.
double sb_valve_bore_at(const SbValve *valve, double x);

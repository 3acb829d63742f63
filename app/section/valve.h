// The valve's outlines to scale: housing with bore land, mouth and vent, stem with grooves and dose
// chamber. Lengths in m.
//
// Parts whose shape the model's outlines give are drawn by it: the housing with the beginning of
// its bore land at the land edge, the stem with its grooves where the seals sit. Where the sizes in
// force differ from the profile's (a scene overrides them) it is stretched onto them piecewise:
// radially at bore or groove floor and land, axially at the grooves' walls.
//
// Axes: x axial, canister on the left; y radial from the axis. The housing's frame has the land
// edge at x = 0, the land on its right; that of a gasket valve the chamber gasket's middle, and its
// seals' frames stand with it. The stem's frame lies on the housing's at displacement 0: a
// point of the stem sits at x - s. The origin of a seal's frame (x = 0) moves with
// the stem. Sizes that no result depends on come from the drawing's own parameters; where those
// contradict each other or the gland (a spacing shorter than a groove...) they are stretched to the
// next size that can be drawn, and `adjusted` says so.
#pragma once

#include "engine/valve/model/valve.h"

typedef struct {
  double x, y;
} SbValvePoint;

enum { SB_VALVE_POINTS_MAX = SB_OUTLINE_MAX + 8, SB_VALVE_SOLIDS_MAX = 5 };

// A part as it is filled: counter-clockwise (x to the right, y up), closed by its first point,
// y >= 0.
typedef struct {
  bool moves; // with the stem, whose frame it is in; otherwise in the housing's
  size_t count;
  SbValvePoint point[SB_VALVE_POINTS_MAX];
} SbValveSolid;

// What stands around a gasket valve's body: rooms by their fluid, sheet metal, rubber, plastic.
typedef enum {
  SB_VALVE_CANISTER,
  SB_VALVE_AMBIENT,
  SB_VALVE_SHEET,
  SB_VALVE_RUBBER,
  SB_VALVE_PLASTIC
} SbValveMaterial;

enum { SB_VALVE_AROUND_POINTS = 12, SB_VALVE_AROUND_MAX = 6, SB_VALVE_COILS = 5 };

// One of those in the housing's frame, back to front; no result depends on them.
typedef struct {
  SbValveMaterial material;
  size_t count;
  SbValvePoint point[SB_VALVE_AROUND_POINTS];
} SbValveAround;

typedef struct {
  double bore, floor, land;     // radii: bore, groove floor, stem's land [m]
  double mouth;                 // radius of the housing's mouth at its face
  double face, end;             // housing's ends [m], face < 0 < end
  double vent_left, vent_right; // equal: no vent
  size_t solid_count;           // of the housing (two where the vent cuts it), then of the stem
  SbValveSolid solid[SB_VALVE_SOLIDS_MAX];
  SbOutlineSurface housing; // its surfaces by x, as if there were no vent
  bool shaped_housing;      // by a profile: what lies outside of it is not known
  double nose;              // x of the nose's face, stem's frame
  double chamber;           // x of the chamber's middle, stem's frame
  double chamber_left;      // x where its recess begins
  double chamber_floor;     // radius
  double rod;               // radius of the rod
  double groove_left[SB_SEAL_COUNT], groove_right[SB_SEAL_COUNT]; // stem's frame
  double origin[SB_SEAL_COUNT];       // origin of the seal's frame, stem's frame
  double section_area[SB_SEAL_COUNT]; // of the fitted ring, volume kept: A/(1 + stretch) [m2]
  double size;                        // diameter that pictures are laid out by: the bore's
  // Of a gasket valve: bore, floor and land are the stem, which slides on the gaskets.
  bool gasket;
  double rim;                   // radius of the pockets that hold the gaskets
  double outside;               // radius of the body
  double chamber_roof;          // radius of the chamber
  double shoulder;              // x of the stem's shoulder behind the neck, stem's frame
  double port_left, port_right; // of the stem's side port, stem's frame
  double channel;               // radius of the channel behind it
  size_t around_count;
  SbValveAround around[SB_VALVE_AROUND_MAX];
  double spring_seat;                  // x on which the spring stands; its other end is the nose
  double spring_radius, coil;          // of its wire's middle; diameter of the wire
  double slot;                         // x of the slots' edge, behind which the liquid comes in
  double left;                         // of all that is to be seen
  double ferrule, neck_gasket, flange; // x of the ferrule's outer faces; radius of the can's flange
  bool adjusted; // some drawing size had to give way, or a profile was stretched
} SbValveOutline;

// Builds the outlines, the housing with its vent or without. inner_contact_left: left end of the
// inner seal's contact in its own frame when it reaches the land edge [m]; with `land_edge` it
// fixes where the seals are. `top` is the radius up to which the housing is drawn [m].
void sb_valve_outline_make(SbValveOutline *valve, const SbModel *model, double inner_contact_left,
                           double top, bool vent);

// Radius of the housing's inner surface at x in the housing's frame [m]; HUGE_VAL beside the
// housing.
double sb_valve_outline_bore(const SbValveOutline *valve, double x);

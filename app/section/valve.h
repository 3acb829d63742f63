// The valve's outlines to scale: housing with bore land, mouth and vent, stem with grooves and dose
// chamber. Lengths in m.
//
// Parts whose shape the model's outlines give have that shape: the housing with the beginning of
// its bore land at the land edge, the stem with its grooves at the seals. If the sizes in force
// differ from the profile's (a scene overrides them), the profile is scaled to them piecewise:
// radially at bore or groove floor and land, axially at the grooves' walls.
//
// Axes: x axial, canister on the left; y radial from the axis. The housing's frame has the land
// edge at x = 0 and the land on its right; that of a gasket valve has x = 0 at the middle of the
// chamber gasket, and its seals' frames do not move. The stem's frame coincides with the housing's
// at displacement 0: a point x of the stem is at x - s in the housing's frame. The origin of a
// seal's frame (x = 0) moves with the stem. Sizes on which no result depends are the drawing's own
// parameters. If these contradict each other or the gland, they are changed to the nearest size
// that can be drawn, and `adjusted` states it.
#pragma once

#include "engine/valve/model/valve.h"

// A point [m].
typedef struct {
  double x, y;
} SbValvePoint;

// Largest numbers of points of a part, and of parts.
enum { SB_VALVE_POINTS_MAX = SB_OUTLINE_MAX + 8, SB_VALVE_SOLIDS_MAX = 5 };

// A part that is filled: counter-clockwise (x to the right, y up), closed by its first point, y >=
// 0.
typedef struct {
  bool moves;   // the points are in the stem's frame; else in the housing's
  size_t count; // of points
  SbValvePoint point[SB_VALVE_POINTS_MAX];
} SbValveSolid;

// What is around the body of a gasket valve.
typedef enum {
  SB_VALVE_CANISTER, // liquid of the canister
  SB_VALVE_AMBIENT,  // air
  SB_VALVE_SHEET,    // sheet metal
  SB_VALVE_RUBBER,
  SB_VALVE_PLASTIC
} SbValveMaterial;

// Largest numbers of points of a surrounding part, of such parts, and number of drawn spring coils.
enum { SB_VALVE_AROUND_POINTS = 12, SB_VALVE_AROUND_MAX = 6, SB_VALVE_COILS = 5 };

// A surrounding part in the housing's frame, a polygon; no result depends on it.
typedef struct {
  SbValveMaterial material;
  size_t count;
  SbValvePoint point[SB_VALVE_AROUND_POINTS];
} SbValveAround;

// All outlines. Lengths are [m]; x is in the housing's frame unless stated otherwise.
typedef struct {
  double bore, floor, land;     // radii of bore, groove floor and stem's land
  double mouth;                 // radius of the housing's opening at its face
  double face, end;             // ends of the housing, face < 0 < end
  double vent_left, vent_right; // equal: no vent
  size_t solid_count;           // of the housing (two where the vent cuts it), then of the stem
  SbValveSolid solid[SB_VALVE_SOLIDS_MAX];
  SbOutlineSurface housing; // surfaces of the housing without the vent
  bool shaped_housing;      // the housing has a profile; its outside is then not known
  double nose;              // x of the nose's face, stem's frame
  double chamber;           // x of the chamber's middle, stem's frame
  double chamber_left;      // x where its recess begins
  double chamber_floor;     // radius
  double rod;               // radius of the rod
  double groove_left[SB_SEAL_COUNT], groove_right[SB_SEAL_COUNT]; // stem's frame
  double origin[SB_SEAL_COUNT];       // origin of the seal's frame, stem's frame
  double section_area[SB_SEAL_COUNT]; // of the fitted ring at constant volume, A/(1 + stretch) [m2]
  double size;                        // bore diameter, the reference length of pictures
  // Of a gasket valve: bore, floor and land are the stem, which slides on the gaskets.
  bool gasket;
  double rim;                   // radius of the pockets that hold the gaskets
  double outside;               // radius of the body
  double chamber_roof;          // radius of the chamber
  double shoulder;              // x of the stem's shoulder after the neck, stem's frame
  double port_left, port_right; // of the stem's side port, stem's frame
  double channel;               // radius of the channel to which the port leads
  size_t around_count;
  SbValveAround around[SB_VALVE_AROUND_MAX]; // back to front
  double spring_seat;          // x of the spring's fixed end; its other end is at the nose
  double spring_radius;        // of the middle of its wire
  double coil;                 // diameter of the wire
  double slot;                 // x of the edge of the slots through which the liquid enters
  double left;                 // smallest x that is drawn
  double ferrule, neck_gasket; // x of the ferrule's outer face: at its end, beside the neck gasket
  double flange;               // radius of the can's flange
  bool adjusted;               // a size of the drawing was changed, or a profile was scaled
} SbValveOutline;

// Writes the outlines of `model`. `inner_contact_left` is the left end of the inner seal's contact
// in its own frame when it reaches the land edge [m]; with bore.land_edge it determines the
// positions of the seals, except those of a gasket valve. `top` is the radius up to which a housing
// without a profile is drawn [m]. `vent`: draw the housing's vent, or a gasket valve's side port.
void sb_valve_outline_make(SbValveOutline *valve, const SbModel *model, double inner_contact_left,
                           double top, bool vent);

// Returns the radius of the housing's inner surface at x in the housing's frame [m]; HUGE_VAL
// outside of the housing.
double sb_valve_outline_bore(const SbValveOutline *valve, double x);

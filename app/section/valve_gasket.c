// Outlines of a gasket valve (engine/valve/model/gasket.h): the body that clamps both gaskets
// between plates and holds the chamber, and the stem with its neck, its side port and the channel
// behind.
//
// The housing's frame has the chamber gasket's middle at x = 0. Can, ferrule, neck gasket, cage and
// spring are a scheme around it: no result depends on their sizes.
#include "app/section/valve_private.h"

#include "engine/valve/sealbench.h"

#include <math.h>
#include <string.h>

// Proportions that are not worth a parameter, of the gaskets' thickness: the body beyond the outer
// plates, the plates' way past the stem, the room around the gaskets, the body's wall around that,
// sheet metal, the spring's cage, the can's flange; of the stem's radius: the channel; of the
// neck's depth: its ends. The rise of the can's shoulder.
static const double END = 0.7, CLEARANCE = 0.03, POCKET = 0.1, WALL = 0.7, SHEET = 0.22,
                    CAGE = 0.45, CAGE_IN = 0.35, CAGE_OUT = 0.95, FLANGE = 0.5, CHANNEL = 0.4,
                    BEVEL = 0.6, CONE = 0.7;

static void add_around(SbValveOutline *valve, SbValveMaterial material, const SbValvePoint *point,
                       size_t count) {
  SbValveAround *around = &valve->around[valve->around_count++];
  around->material = material;
  around->count = count;
  memcpy(around->point, point, count * sizeof *point);
}

// The ferrule, which clamps the body and is crimped behind the flange of the can's neck, a gasket
// between them.
static void stand_around(SbValveOutline *valve, double thick) {
  const double sheet = SHEET * thick, out = valve->outside, end = valve->end;
  const double neck = out + 0.12 * thick, flange = neck + FLANGE * thick;
  const double at = 0.4 * (valve->face + end) + 0.6 * valve->chamber, step = at + 0.35 * thick;
  const double lip = at - sheet, back = 0.3 * thick, shoulder = valve->face - 0.3 * thick;
  valve->ferrule = end + sheet;
  valve->neck_gasket = step + sheet;
  valve->flange = flange;
  const double far = 40 * thick, high = neck + CONE * far, fold = valve->mouth + 0.25 * thick;
  const SbValvePoint room[] = {
      {valve->face, out}, {step, out}, {step, neck + sheet}, {valve->face, neck + sheet}};
  const SbValvePoint air[] = {{shoulder - far, high + sheet},
                              {shoulder, neck + sheet},
                              {lip, neck + sheet},
                              {lip, flange},
                              {step, flange},
                              {step, out},
                              {end, out},
                              {end, 0},
                              {end + far, 0},
                              {end + far, high + far}};
  const SbValvePoint can[] = {{at, neck},
                              {at, flange},
                              {lip, flange},
                              {lip, neck + sheet},
                              {shoulder, neck + sheet},
                              {shoulder - far, high + 1.22 * sheet},
                              {shoulder - far, high},
                              {shoulder, neck}};
  const SbValvePoint gasket[] = {{at, neck}, {step, neck}, {step, flange}, {at, flange}};
  const SbValvePoint ferrule[] = {{step, flange},
                                  {step, out},
                                  {end, out},
                                  {end, fold},
                                  {end + sheet, fold},
                                  {end + sheet, out + sheet},
                                  {step + sheet, out + sheet},
                                  {step + sheet, flange + sheet},
                                  {lip - 0.3 * sheet, flange + sheet},
                                  {lip - back - 0.7 * sheet, flange - back + 0.7 * sheet},
                                  {lip - back, flange - back},
                                  {lip, flange}};
  add_around(valve, SB_VALVE_CANISTER, room, sizeof room / sizeof *room);
  add_around(valve, SB_VALVE_AMBIENT, air, sizeof air / sizeof *air);
  add_around(valve, SB_VALVE_SHEET, can, sizeof can / sizeof *can);
  add_around(valve, SB_VALVE_RUBBER, gasket, sizeof gasket / sizeof *gasket);
  add_around(valve, SB_VALVE_SHEET, ferrule, sizeof ferrule / sizeof *ferrule);
}

// The cage that the spring stands in, with room for its coils at full stroke and slots to fill by.
static void cage_spring(SbValveOutline *valve, double thick, double stroke) {
  const double wire = fmin(0.36 * thick, 0.5 * valve->bore), wall = CAGE * thick;
  const double in = valve->bore + CAGE_IN * thick, out = valve->bore + CAGE_OUT * thick;
  const double seat = valve->nose - stroke - (SB_VALVE_COILS + 0.3) * wire;
  valve->coil = wire;
  valve->spring_radius = 0.96 * valve->bore - 0.5 * wire;
  valve->spring_seat = seat;
  valve->left = seat - wall - 0.3 * thick;
  const SbValvePoint cage[] = {
      {seat - wall, 0.45 * valve->bore}, {seat, 0.45 * valve->bore}, {seat, in},
      {seat + 0.8 * thick, in},          {seat + 0.8 * thick, out},  {seat - wall, out}};
  add_around(valve, SB_VALVE_PLASTIC, cage, sizeof cage / sizeof *cage);
}

void sb_valve_gasket_make(SbValveOutline *valve, const SbModel *model, bool port) {
  const SbValveShape *shape = sb_model_shape(model);
  const double thick = sb_model_value(model, SB_P_GASKET_THICKNESS);
  const double half = 0.5 * thick * (1 - sb_model_value(model, SB_P_GASKET_CRIMP));
  const double outer = 0.5 * sb_model_value(model, SB_P_GASKET_OUTER_DIAMETER);
  const double stem = 0.5 * sb_model_value(model, SB_P_STEM_PRESSURE_DIAMETER);
  const double chamber = 0.5 * sb_model_value(model, SB_P_BORE_DIAMETER);
  const double plate = SB_GASKET_PLATE * thick, end = END * thick;
  const double hole = stem + CLEARANCE * thick;
  // Volume that crimping moves outwards.
  const double crimped = outer * (1 + 0.5 * sb_model_value(model, SB_P_GASKET_CRIMP));
  const double pocket = crimped + POCKET * thick, apart = shape->seal_spacing;
  const double top = pocket + WALL * thick;
  valve->gasket = true;
  valve->bore = valve->floor = valve->land = valve->rod = stem;
  valve->size = 2 * 0.93 * pocket;
  valve->rim = pocket;
  valve->outside = top;
  valve->origin[SB_INNER] = 0;
  valve->origin[SB_OUTER] = apart;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    valve->section_area[i] = thick * (outer - sb_model_seal(model, i)->inner_diameter / 2);
    valve->groove_left[i] = valve->origin[i] - half;
    valve->groove_right[i] = valve->origin[i] + half;
  }
  valve->face = -half - end;
  valve->end = apart + half + end;
  valve->mouth = hole;
  valve->chamber = 0.5 * apart;
  valve->chamber_left = half;
  valve->chamber_floor = stem;
  valve->chamber_roof = chamber;

  SbValveSolid *body = sb_valve_new_solid(valve, false);
  const double cage_in = stem + CAGE_IN * thick, cage_out = stem + CAGE_OUT * thick;
  const double slot = valve->slot = valve->face - CAGE * thick;
  const SbValvePoint inside[] = {{valve->face, top},
                                 {valve->face, cage_out},
                                 {slot, cage_out},
                                 {slot, cage_in},
                                 {valve->face, cage_in},
                                 {valve->face, hole},
                                 {-half, hole},
                                 {-half, pocket},
                                 {half, pocket},
                                 {half, hole},
                                 {half + plate, hole},
                                 {half + plate, chamber},
                                 {apart - half - plate, chamber},
                                 {apart - half - plate, hole},
                                 {apart - half, hole},
                                 {apart - half, pocket},
                                 {apart + half, pocket},
                                 {apart + half, hole},
                                 {valve->end, hole},
                                 {valve->end, top}};
  for (size_t i = 0; i < sizeof inside / sizeof inside[0]; i++) {
    sb_valve_add(body, inside[i].x, inside[i].y);
  }

  // The stem: its shoulder meets the chamber gasket's contact at the land edge, its port leaves
  // the stem gasket's at the port's travel.
  const double shoulder = half + sb_model_value(model, SB_P_BORE_LAND_EDGE);
  const double neck = fmin(shape->chamber_depth, 0.7 * stem);
  const double length = fmax(shape->chamber_length, shoulder + half + 0.4 * thick);
  const double bevel = BEVEL * neck, flange = 0.6 * thick;
  const double hole_left = apart - half + sb_model_value(model, SB_P_STEM_PORT_TRAVEL) -
                           0.5 * sb_model_value(model, SB_P_STEM_PORT_DIAMETER);
  const double hole_right = hole_left + sb_model_value(model, SB_P_STEM_PORT_DIAMETER);
  const double channel = CHANNEL * stem, far = valve->end + 40 * valve->size;
  valve->adjusted = neck < shape->chamber_depth || length > shape->chamber_length;
  valve->nose = shoulder - length - flange;
  valve->shoulder = shoulder;
  valve->port_left = hole_left;
  valve->port_right = hole_right;
  valve->channel = channel;
  stand_around(valve, thick);
  cage_spring(valve, thick, sb_model_value(model, SB_P_DRIVE_STROKE));
  SbValveSolid *solid = sb_valve_new_solid(valve, true);
  if (!port) {
    sb_valve_add(solid, far, channel);
    sb_valve_add(solid, far, stem);
  } else {
    sb_valve_add(solid, hole_left, stem);
  }
  sb_valve_add(solid, shoulder, stem);
  sb_valve_add(solid, shoulder - bevel, stem - neck);
  sb_valve_add(solid, shoulder - length + bevel, stem - neck);
  sb_valve_add(solid, shoulder - length, stem);
  sb_valve_add(solid, valve->nose, stem);
  sb_valve_add(solid, valve->nose, 0);
  sb_valve_add(solid, hole_left, 0);
  if (!port) {
    sb_valve_add(solid, hole_left, channel);
    return;
  }
  solid = sb_valve_new_solid(valve, true);
  sb_valve_add(solid, far, channel);
  sb_valve_add(solid, far, stem);
  sb_valve_add(solid, hole_right, stem);
  sb_valve_add(solid, hole_right, channel);
}

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

static void add_solid(SbValveOutline *valve, bool moves, const SbValvePoint *point, size_t count) {
  SbValveSolid *solid = sb_valve_new_solid(valve, moves);
  for (size_t i = 0; i < count; i++) {
    sb_valve_add(solid, point[i].x, point[i].y);
  }
}

// The body, which clamps both gaskets in pockets up to the radius `pocket`; `hole` is the radius of
// its plates, `half` half of a gasket's height.
static void add_body(SbValveOutline *valve, double thick, double half, double hole, double pocket) {
  const double in = valve->bore + CAGE_IN * thick, out = valve->bore + CAGE_OUT * thick;
  const double apart = valve->origin[SB_OUTER], plate = half + SB_GASKET_PLATE * thick;
  const double face = valve->face, slot = valve->slot, roof = valve->chamber_roof;
  const SbValvePoint inside[] = {{face, valve->outside},
                                 {face, out},
                                 {slot, out},
                                 {slot, in},
                                 {face, in},
                                 {face, hole},
                                 {-half, hole},
                                 {-half, pocket},
                                 {half, pocket},
                                 {half, hole},
                                 {plate, hole},
                                 {plate, roof},
                                 {apart - plate, roof},
                                 {apart - plate, hole},
                                 {apart - half, hole},
                                 {apart - half, pocket},
                                 {apart + half, pocket},
                                 {apart + half, hole},
                                 {valve->end, hole},
                                 {valve->end, valve->outside}};
  add_solid(valve, false, inside, sizeof inside / sizeof *inside);
}

// The stem, whose neck is `length` long and `neck` deep; with a `port` it is two parts.
static void add_stem(SbValveOutline *valve, double length, double neck, bool port) {
  const double stem = valve->bore, bevel = BEVEL * neck, far = valve->end + 40 * valve->size;
  const double right = valve->shoulder, left = right - length, hole = valve->port_left;
  const SbValvePoint closed[] = {{far, valve->channel},
                                 {port ? hole : far, stem},
                                 {right, stem},
                                 {right - bevel, stem - neck},
                                 {left + bevel, stem - neck},
                                 {left, stem},
                                 {valve->nose, stem},
                                 {valve->nose, 0},
                                 {hole, 0},
                                 {hole, valve->channel}};
  const SbValvePoint beyond[] = {{far, valve->channel},
                                 {far, stem},
                                 {valve->port_right, stem},
                                 {valve->port_right, valve->channel}};
  if (port) {
    add_solid(valve, true, closed + 1, sizeof closed / sizeof *closed - 2);
    add_solid(valve, true, beyond, sizeof beyond / sizeof *beyond);
  } else {
    add_solid(valve, true, closed, sizeof closed / sizeof *closed);
  }
}

void sb_valve_gasket_make(SbValveOutline *valve, const SbModel *model, bool port) {
  const SbValveShape *shape = sb_model_shape(model);
  const double thick = sb_model_value(model, SB_P_GASKET_THICKNESS);
  const double half = 0.5 * thick * (1 - sb_model_value(model, SB_P_GASKET_CRIMP));
  const double outer = 0.5 * sb_model_value(model, SB_P_GASKET_OUTER_DIAMETER);
  const double stem = 0.5 * sb_model_value(model, SB_P_STEM_PRESSURE_DIAMETER);
  const double end = END * thick, apart = shape->seal_spacing;
  // Volume that crimping moves outwards.
  const double crimped = outer * (1 + 0.5 * sb_model_value(model, SB_P_GASKET_CRIMP));
  const double pocket = crimped + POCKET * thick;
  valve->gasket = true;
  valve->bore = valve->floor = valve->land = valve->rod = stem;
  valve->size = 2 * 0.93 * pocket;
  valve->rim = pocket;
  valve->outside = pocket + WALL * thick;
  valve->origin[SB_INNER] = 0;
  valve->origin[SB_OUTER] = apart;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    valve->section_area[i] = thick * (outer - sb_model_seal(model, i)->inner_diameter / 2);
    valve->groove_left[i] = valve->origin[i] - half;
    valve->groove_right[i] = valve->origin[i] + half;
  }
  valve->face = -half - end;
  valve->end = apart + half + end;
  valve->slot = valve->face - CAGE * thick;
  valve->mouth = stem + CLEARANCE * thick;
  valve->chamber = 0.5 * apart;
  valve->chamber_left = half;
  valve->chamber_floor = stem;
  valve->chamber_roof = 0.5 * sb_model_value(model, SB_P_BORE_DIAMETER);

  // The stem's shoulder meets the chamber gasket's contact at the land edge, its port leaves the
  // stem gasket's at the port's travel.
  const double shoulder = half + sb_model_value(model, SB_P_BORE_LAND_EDGE);
  const double neck = fmin(shape->chamber_depth, 0.7 * stem);
  const double length = fmax(shape->chamber_length, shoulder + half + 0.4 * thick);
  const double hole = sb_model_value(model, SB_P_STEM_PORT_DIAMETER);
  valve->adjusted = neck < shape->chamber_depth || length > shape->chamber_length;
  valve->nose = shoulder - length - 0.6 * thick;
  valve->shoulder = shoulder;
  valve->port_left = apart - half + sb_model_value(model, SB_P_STEM_PORT_TRAVEL) - 0.5 * hole;
  valve->port_right = valve->port_left + hole;
  valve->channel = CHANNEL * stem;
  add_body(valve, thick, half, valve->mouth, pocket);
  stand_around(valve, thick);
  cage_spring(valve, thick, sb_model_value(model, SB_P_DRIVE_STROKE));
  add_stem(valve, length, neck, port);
}

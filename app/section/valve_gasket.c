// Outlines of a gasket valve (engine/valve/gasket.h): the body that clamps both gaskets between
// plates and holds the chamber, and the stem with its neck, its side port and the channel behind.
//
// The housing's frame has the chamber gasket's middle at x = 0. Left out: the can's neck and the
// ferrule's crimp, which the body stands for, and the spring.
#include "app/section/valve_private.h"

#include "engine/valve/sealbench.h"

#include <math.h>

// Proportions that are not worth a parameter, of the gaskets' thickness: the body beyond the outer
// plates, the plates' way past the stem, the room around the gaskets; of the stem's radius: the
// channel; of the neck's depth: its ends.
static const double END = 0.7, CLEARANCE = 0.03, POCKET = 0.1, CHANNEL = 0.4, BEVEL = 0.6;

void sb_valve_gasket_make(SbValveOutline *valve, const SbModel *model, double top, bool port) {
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
  top = fmax(top, pocket + 0.3 * thick);
  valve->gasket = true;
  valve->bore = valve->floor = valve->land = valve->rod = stem;
  valve->size = 2 * 0.85 * pocket;
  valve->rim = pocket;
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
  const SbValvePoint inside[] = {{valve->face, top},
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

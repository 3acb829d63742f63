// Outlines of housing and stem from the model. Without profiles: bore land with a broken edge and a
// lead-in to the mouth, chamfered housing ends, stem nose with a chamfer, two rectangular grooves,
// the dose chamber with sloped flanks, the shoulder, the rod. Left out there: fillets, the split of
// the stem into its three parts, the crimp.
#include "app/section/valve_private.h"

#include "app/base/device.h"

#include "engine/valve/sealbench.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// Proportions that are not worth a parameter, relative to the radial space (1.36 mm in the thesis
// valve): flank of the dose chamber, chamfers.
static const double VALVE_CHAMFER = 0.08;
static const double FLANK_SLOPE = 0.33;

// The lead-in beside the land is the one that solved rings are pressed against (chamfer and edge of
// SB_RING_LOAD_INIT): its slope sets in smoothly over the edge's length, as t^2 (3 - 2 t).
static const double LEAD_ANGLE = 0.5, EDGE_LENGTH = 5e-5; // [rad], [m]
enum { EDGE_POINTS = 6 };

void sb_valve_add(SbValveSolid *solid, double x, double y) {
  if (solid->count < SB_VALVE_POINTS_MAX) {
    solid->point[solid->count++] = (SbValvePoint){x, y};
  }
}

SbValveSolid *sb_valve_new_solid(SbValveOutline *valve, bool moves) {
  SbValveSolid *solid = &valve->solid[valve->solid_count++];
  solid->moves = moves;
  solid->count = 0;
  return solid;
}

// The part of `from` left (side -1) or right (side 1) of x; what is cut off leaves a straight edge.
static void cut(SbValveSolid *to, const SbValveSolid *from, double x, int side) {
  to->count = 0;
  for (size_t i = 0; i < from->count; i++) {
    SbValvePoint a = from->point[i], b = from->point[(i + 1) % from->count];
    bool a_in = side * (a.x - x) >= 0, b_in = side * (b.x - x) >= 0;
    if (a_in) {
      sb_valve_add(to, a.x, a.y);
    }
    if (a_in != b_in) {
      sb_valve_add(to, x, a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x));
    }
  }
}

static double at_least(SbValveOutline *valve, double value, double least) {
  if (value >= least) {
    return value;
  }
  valve->adjusted = true;
  return least;
}

static double at_most(SbValveOutline *valve, double value, double most) {
  if (value <= most) {
    return value;
  }
  valve->adjusted = true;
  return most;
}

static void make_vent(SbValveOutline *valve, const SbValveShape *shape) {
  if (shape->vent_diameter > 0 && shape->vent_position + shape->vent_diameter < valve->end) {
    valve->vent_left = shape->vent_position - shape->vent_diameter / 2;
    valve->vent_right = shape->vent_position + shape->vent_diameter / 2;
  }
}

// The housing's surfaces, and its solid cut in two by the vent.
static void finish_valve_housing(SbValveOutline *valve) {
  SbValveSolid *whole = &valve->solid[0];
  g_autofree SbOutline *outline = g_new(SbOutline, 1);
  outline->count = whole->count;
  for (size_t i = 0; i < whole->count; i++) {
    outline->point[i] = (SbOutlinePoint){whole->point[i].x, whole->point[i].y};
  }
  sb_outline_surface(&valve->housing, outline);
  if (valve->vent_right > valve->vent_left) {
    g_autofree SbValveSolid *uncut = g_memdup2(whole, sizeof *whole);
    cut(sb_valve_new_solid(valve, false), uncut, valve->vent_right, 1);
    cut(whole, uncut, valve->vent_left, -1);
    whole->moves = false;
  }
}

static void make_housing(SbValveOutline *valve, const SbModel *model, double top) {
  const SbValveShape *shape = sb_model_shape(model);
  double g = sb_model_value(model, SB_P_GLAND_RADIAL_SPACE);
  double mouth = at_least(valve, shape->entry_diameter / 2, valve->bore + 0.1 * g);
  mouth = at_most(valve, mouth, 0.8 * top + 0.2 * valve->bore);
  double chamfer = VALVE_CHAMFER * g;
  double rise = mouth - valve->bore;
  double slope = tan(LEAD_ANGLE);
  double lead = rise / slope + EDGE_LENGTH / 2;
  double entry = at_least(valve, shape->entry_length, lead + 2 * chamfer);
  valve->face = -entry;
  valve->mouth = mouth;

  SbValveSolid *solid = sb_valve_new_solid(valve, false);
  sb_valve_add(solid, -entry, top);
  sb_valve_add(solid, -entry, mouth + chamfer);
  sb_valve_add(solid, -entry + chamfer, mouth);
  sb_valve_add(solid, -lead, mouth);
  for (int i = EDGE_POINTS; i >= 0; i--) {
    double t = (double)i / EDGE_POINTS;
    double opening = EDGE_LENGTH * t * t * t * (1 - t / 2);
    sb_valve_add(solid, -EDGE_LENGTH * t, valve->bore + slope * opening);
  }
  sb_valve_add(solid, valve->end - chamfer, valve->bore);
  sb_valve_add(solid, valve->end, valve->bore + chamfer);
  sb_valve_add(solid, valve->end, top);
}

// Points of a groove from its right edge to its left one: chamfers, walls, corners, floor.
static void add_groove(SbValveSolid *solid, const SbValveOutline *valve, int seal,
                       const SbModel *model) {
  enum { ARC = 8 };
  const SbGrooveDrawing *drawn = sb_model_groove(model);
  if (drawn != NULL) {
    const double width = valve->groove_right[seal] - valve->groove_left[seal];
    const double middle = (valve->groove_right[seal] + valve->groove_left[seal]) / 2;
    double at[SB_GROOVE_POINTS][2];
    const int points = sb_groove_outline(at, drawn, width, valve->land - valve->floor);
    for (int i = 0; i < points; i++) {
      sb_valve_add(solid, middle + at[i][0], valve->floor + at[i][1]);
    }
    return;
  }
  const double draft = tan(sb_model_value(model, SB_P_GLAND_DRAFT));
  const double corner = sb_model_value(model, SB_P_GLAND_CORNER_RADIUS);
  const double chamfer = sb_model_value(model, SB_P_GLAND_EDGE_CHAMFER);
  const double lean = atan(draft);
  SbOutlinePoint side[2 * ARC + 3]; // from the land down, x into the wall from its foot
  size_t count = 0;
  // The chamfer sets in as solved rings meet it (engine/contact/ring/ring_groove.c).
  for (int i = chamfer > 0 ? ARC : 0; i >= 0; i--) {
    const double t = (double)i / ARC, r = valve->land - 1.5 * chamfer * (1 - t);
    const double way = 1.5 * t;
    const double recess = way < 1 ? way * way * way * (1 - way / 2) : way - 0.5;
    side[count++] =
        (SbOutlinePoint){draft * (r - valve->floor) + (chamfer > 0 ? chamfer * recess : 0), r};
  }
  if (corner > 0) {
    // The arc's centre is a radius above the floor and off the wall.
    const double x = draft * corner - corner / cos(lean);
    for (int i = 0; i <= ARC; i++) {
      const double angle = -lean - (M_PI / 2 - lean) * i / ARC;
      side[count++] =
          (SbOutlinePoint){x + corner * cos(angle), valve->floor + corner * (1 + sin(angle))};
    }
  } else {
    side[count++] = (SbOutlinePoint){0, valve->floor};
  }
  for (size_t i = 0; i < count; i++) {
    sb_valve_add(solid, valve->groove_right[seal] + side[i].x, side[i].r);
  }
  for (size_t i = count; i-- > 0;) {
    sb_valve_add(solid, valve->groove_left[seal] - side[i].x, side[i].r);
  }
}

static void make_stem(SbValveOutline *valve, const SbModel *model) {
  const SbValveShape *shape = sb_model_shape(model);
  double g = sb_model_value(model, SB_P_GLAND_RADIAL_SPACE);
  double chamfer = fmin(0.33 * g, 0.3 * shape->nose_length);
  double land = valve->land;
  double rod = at_most(valve, shape->rod_diameter / 2, valve->floor);
  double length = valve->groove_left[SB_OUTER] - valve->groove_right[SB_INNER];
  double chamber = at_most(valve, shape->chamber_length, 0.9 * length);
  double depth = at_most(valve, shape->chamber_depth, land - 0.3 * valve->floor);
  double flank = fmin(FLANK_SLOPE * depth, 0.3 * chamber);
  double shoulder = valve->groove_right[SB_OUTER] + shape->shoulder_length;
  double shoulder_chamfer = fmin(0.22 * g, 0.5 * shape->shoulder_length);
  valve->nose = valve->groove_left[SB_INNER] - shape->nose_length;
  valve->chamber = (valve->groove_left[SB_OUTER] + valve->groove_right[SB_INNER]) / 2;
  valve->chamber_left = valve->chamber - chamber / 2;
  valve->chamber_floor = land - depth;
  valve->rod = rod;

  double far = valve->end + 40 * sb_model_value(model, SB_P_BORE_DIAMETER);
  SbValveSolid *solid = sb_valve_new_solid(valve, true);
  sb_valve_add(solid, far, 0);
  sb_valve_add(solid, far, rod);
  sb_valve_add(solid, shoulder, rod);
  sb_valve_add(solid, shoulder, land - shoulder_chamfer);
  sb_valve_add(solid, shoulder - shoulder_chamfer, land);
  add_groove(solid, valve, SB_OUTER, model);
  sb_valve_add(solid, valve->chamber + chamber / 2, land);
  sb_valve_add(solid, valve->chamber + chamber / 2 - flank, land - depth);
  sb_valve_add(solid, valve->chamber_left + flank, land - depth);
  sb_valve_add(solid, valve->chamber_left, land);
  add_groove(solid, valve, SB_INNER, model);
  sb_valve_add(solid, valve->nose + chamfer, land);
  sb_valve_add(solid, valve->nose, land - 1.22 * chamfer);
  sb_valve_add(solid, valve->nose, 0);
}

// ---- Parts with a shape of their own ----

// A piecewise straight map of a coordinate; slope 1 beyond its knots.
typedef struct {
  size_t count;
  double from[4], to[4];
} Map;

static double map_to(const Map *map, double value) {
  if (value <= map->from[0]) {
    return map->to[0] + value - map->from[0];
  }
  size_t i = 1;
  while (i < map->count && value > map->from[i]) {
    i++;
  }
  if (i == map->count) {
    return map->to[i - 1] + value - map->from[i - 1];
  }
  double share = (value - map->from[i - 1]) / (map->from[i] - map->from[i - 1]);
  return map->to[i - 1] + share * (map->to[i] - map->to[i - 1]);
}

// Whether the map does more than to shift.
static bool map_stretches(const Map *map) {
  double shift = map->to[0] - map->from[0];
  double size = fabs(map->from[map->count - 1] - map->from[0]);
  for (size_t i = 1; i < map->count; i++) {
    if (fabs(map->to[i] - map->from[i] - shift) > 1e-6 * size) {
      return true;
    }
  }
  return false;
}

static void add_outline(SbValveSolid *solid, const SbOutline *outline, const Map *x, const Map *r) {
  for (size_t i = 0; i < outline->count; i++) {
    sb_valve_add(solid, map_to(x, outline->point[i].x), map_to(r, outline->point[i].r));
  }
}

static void shape_housing(SbValveOutline *valve, const SbValveOutlines *given) {
  Map x = {1, {given->land_edge}, {0}};
  Map r = {2, {0, given->bore}, {0, valve->bore}};
  valve->adjusted = valve->adjusted || map_stretches(&r);
  add_outline(sb_valve_new_solid(valve, false), &given->part[SB_VALVE_HOUSING], &x, &r);
  valve->shaped_housing = true;
  const SbValveSolid *solid = &valve->solid[0];
  valve->face = HUGE_VAL;
  valve->end = -HUGE_VAL;
  for (size_t i = 0; i < solid->count; i++) {
    valve->face = fmin(valve->face, solid->point[i].x);
    valve->end = fmax(valve->end, solid->point[i].x);
  }
  // The mouth is as wide as the hole is a quarter of the way from the face to the land.
  g_autofree SbOutlineSurface *surface = g_new(SbOutlineSurface, 1);
  double low, high;
  sb_outline_surface(surface, &given->part[SB_VALVE_HOUSING]);
  bool found = sb_outline_radii(&low, &high, surface, given->land_edge + 0.75 * valve->face);
  valve->mouth = found ? map_to(&r, low) : valve->bore;
}

static void shape_stem(SbValveOutline *valve, const SbValveOutlines *given) {
  Map x = {4,
           {given->groove_left[SB_INNER], given->groove_right[SB_INNER],
            given->groove_left[SB_OUTER], given->groove_right[SB_OUTER]},
           {valve->groove_left[SB_INNER], valve->groove_right[SB_INNER],
            valve->groove_left[SB_OUTER], valve->groove_right[SB_OUTER]}};
  Map r = {3, {0, given->floor, given->land}, {0, valve->floor, valve->land}};
  valve->adjusted = valve->adjusted || map_stretches(&x) || map_stretches(&r);
  double far = -HUGE_VAL;
  valve->nose = HUGE_VAL;
  for (int part = SB_VALVE_STEM_CENTRE; part <= SB_VALVE_STEM_BOTTOM; part++) {
    const SbOutline *outline = &given->part[part];
    if (outline->count > 0) {
      add_outline(sb_valve_new_solid(valve, true), outline, &x, &r);
    }
    for (size_t i = 0; i < outline->count; i++) {
      valve->nose = fmin(valve->nose, map_to(&x, outline->point[i].x));
      far = fmax(far, outline->point[i].x);
    }
  }
  // The recess between the grooves, for labels and the dose path; the rod behind the outer one.
  g_autofree SbOutlineSurface *surface = g_new(SbOutlineSurface, 1);
  enum { SAMPLES = 200 };
  double low, high;
  double left = given->groove_right[SB_INNER], right = given->groove_left[SB_OUTER];
  double deepest = given->land;
  sb_outline_surface(surface, &given->part[SB_VALVE_STEM_CENTRE]);
  for (int pass = 0; pass < 2; pass++) {
    for (int i = 0; i <= SAMPLES; i++) {
      double at = left + (right - left) * i / SAMPLES;
      if (!sb_outline_radii(&low, &high, surface, at)) {
        continue;
      }
      deepest = fmin(deepest, high);
      if (pass == 1 && high < given->land - 0.05 * (given->land - deepest)) {
        valve->chamber_left = map_to(&x, at);
        break;
      }
    }
  }
  valve->chamber = (valve->groove_left[SB_OUTER] + valve->groove_right[SB_INNER]) / 2;
  valve->chamber_floor = map_to(&r, deepest);
  double behind = (given->groove_right[SB_OUTER] + far) / 2;
  for (int part = SB_VALVE_STEM_CENTRE; part <= SB_VALVE_STEM_BOTTOM; part++) {
    sb_outline_surface(surface, &given->part[part]);
    if (sb_outline_radii(&low, &high, surface, behind)) {
      valve->rod = map_to(&r, high);
    }
  }
}

void sb_valve_outline_make(SbValveOutline *valve, const SbModel *model, double inner_contact_left,
                           double top, bool vent) {
  memset(valve, 0, sizeof *valve);
  if (!sb_device(model)->gland && sb_device(model)->stem) {
    sb_valve_gasket_make(valve, model, vent);
    finish_valve_housing(valve);
    return;
  }
  const SbValveShape *shape = sb_model_shape(model);
  double b = sb_model_value(model, SB_P_GLAND_AXIAL_WIDTH);
  double g = sb_model_value(model, SB_P_GLAND_RADIAL_SPACE);
  double stem = sb_model_value(model, SB_P_STEM_PRESSURE_DIAMETER) / 2;
  valve->size = sb_model_value(model, SB_P_BORE_DIAMETER);
  valve->bore = valve->size / 2;
  valve->floor = valve->bore - g;
  valve->land = fmax(stem, valve->floor + 0.2 * g);
  valve->adjusted = valve->land > stem;

  // A seal's frame has its origin in its groove's middle.
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealModel *seal = sb_model_seal(model, i);
    double d = seal->section_diameter;
    valve->section_area[i] = M_PI / 4 * d * d / (1 + seal->stretch_mean);
  }
  valve->origin[SB_INNER] = sb_model_value(model, SB_P_BORE_LAND_EDGE) - inner_contact_left;
  double spacing = at_least(valve, shape->seal_spacing, 1.2 * b);
  valve->groove_right[SB_INNER] = valve->origin[SB_INNER] + b / 2;
  valve->groove_right[SB_OUTER] = valve->groove_right[SB_INNER] + spacing;
  valve->origin[SB_OUTER] = valve->groove_right[SB_OUTER] - b / 2;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    valve->groove_left[i] = valve->groove_right[i] - b;
  }

  // The land holds the outer seal at rest.
  valve->end = at_least(valve, shape->land_length, valve->groove_right[SB_OUTER] + 0.2 * b);
  const SbValveOutlines *given = sb_model_outlines(model);
  if (given != NULL && given->housing) {
    shape_housing(valve, given);
  } else {
    make_housing(valve, model, top);
  }
  if (vent) {
    make_vent(valve, shape);
  }
  finish_valve_housing(valve);
  // Where a profile gives the stem it replaces the one made of parameters, of which it keeps what
  // it does not say.
  size_t first = valve->solid_count;
  make_stem(valve, model);
  if (given != NULL && given->stem) {
    valve->solid_count = first;
    shape_stem(valve, given);
  }
}

double sb_valve_outline_bore(const SbValveOutline *valve, double x) {
  double low, high;
  return sb_outline_radii(&low, &high, &valve->housing, x) ? low : HUGE_VAL;
}

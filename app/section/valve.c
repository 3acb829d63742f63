// Outlines of housing and stem from the model. What is drawn: bore land with a broken edge and a
// lead-in to the mouth, chamfered housing ends, stem nose with a chamfer, two rectangular grooves,
// the dose chamber with sloped flanks, the shoulder, the rod. Left out: fillets, the split of the
// stem into its three parts, the crimp.
#include "app/section/valve.h"

#include <math.h>

// Proportions that are not worth a parameter, relative to the radial space (1.36 mm in the thesis
// valve): flank of the dose chamber, chamfers.
static const double CHAMFER = 0.08;
static const double FLANK_SLOPE = 0.33;

// The lead-in beside the land is the one that solved rings are pressed against (chamfer and edge of
// SB_RING_LOAD_INIT): its slope sets in smoothly over the edge's length, as t^2 (3 - 2 t).
static const double LEAD_ANGLE = 0.5, EDGE_LENGTH = 5e-5; // [rad], [m]
enum { EDGE_POINTS = 6 };

static void add(SbValveOutline *outline, double x, double y) {
  if (outline->count < SB_VALVE_POINTS_MAX) {
    outline->point[outline->count++] = (SbValvePoint){x, y};
  }
}

static double at_least(SbValve *valve, double value, double least) {
  if (value >= least) {
    return value;
  }
  valve->adjusted = true;
  return least;
}

static double at_most(SbValve *valve, double value, double most) {
  if (value <= most) {
    return value;
  }
  valve->adjusted = true;
  return most;
}

static void make_housing(SbValve *valve, const SbModel *model, double top) {
  const SbValveShape *shape = &model->shape;
  double g = model->radial_space;
  double mouth = at_least(valve, shape->entry_diameter / 2, valve->bore + 0.1 * g);
  mouth = at_most(valve, mouth, 0.8 * top + 0.2 * valve->bore);
  double chamfer = CHAMFER * g;
  double rise = mouth - valve->bore;
  double slope = tan(LEAD_ANGLE);
  double lead = rise / slope + EDGE_LENGTH / 2;
  double entry = at_least(valve, shape->entry_length, lead + 2 * chamfer);
  valve->face = -entry;

  SbValveOutline *outline = &valve->housing;
  outline->count = 0;
  add(outline, -entry, top);
  add(outline, -entry, mouth + chamfer);
  add(outline, -entry + chamfer, mouth);
  add(outline, -lead, mouth);
  for (int i = EDGE_POINTS; i >= 0; i--) {
    double t = (double)i / EDGE_POINTS;
    double opening = EDGE_LENGTH * t * t * t * (1 - t / 2);
    add(outline, -EDGE_LENGTH * t, valve->bore + slope * opening);
  }
  add(outline, valve->end - chamfer, valve->bore);
  add(outline, valve->end, valve->bore + chamfer);
  add(outline, valve->end, top);
}

static void make_stem(SbValve *valve, const SbModel *model) {
  const SbValveShape *shape = &model->shape;
  double g = model->radial_space;
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
  valve->chamber_floor = land - depth;
  valve->shoulder = shoulder;
  valve->rod = rod;

  SbValveOutline *outline = &valve->stem;
  outline->count = 0;
  add(outline, valve->nose, 0);
  add(outline, valve->nose, land - 1.22 * chamfer);
  add(outline, valve->nose + chamfer, land);
  add(outline, valve->groove_left[SB_INNER], land);
  add(outline, valve->groove_left[SB_INNER], valve->floor);
  add(outline, valve->groove_right[SB_INNER], valve->floor);
  add(outline, valve->groove_right[SB_INNER], land);
  add(outline, valve->chamber - chamber / 2, land);
  add(outline, valve->chamber - chamber / 2 + flank, land - depth);
  add(outline, valve->chamber + chamber / 2 - flank, land - depth);
  add(outline, valve->chamber + chamber / 2, land);
  add(outline, valve->groove_left[SB_OUTER], land);
  add(outline, valve->groove_left[SB_OUTER], valve->floor);
  add(outline, valve->groove_right[SB_OUTER], valve->floor);
  add(outline, valve->groove_right[SB_OUTER], land);
  add(outline, shoulder - shoulder_chamfer, land);
  add(outline, shoulder, land - shoulder_chamfer);
  add(outline, shoulder, rod);
  add(outline, valve->end + 40 * model->bore_diameter, rod);
  add(outline, valve->end + 40 * model->bore_diameter, 0);
}

void sb_valve_make(SbValve *valve, const SbModel *model, double inner_contact_left, double top) {
  *valve = (SbValve){0};
  const SbValveShape *shape = &model->shape;
  double b = model->axial_width;
  valve->bore = model->bore_diameter / 2;
  valve->floor = valve->bore - model->radial_space;
  valve->land = fmax(model->stem_diameter / 2, valve->floor + 0.2 * model->radial_space);
  valve->adjusted = valve->land > model->stem_diameter / 2;

  // A seal's frame has its origin in its groove's middle.
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealModel *seal = &model->seal[i];
    double d = seal->section_diameter;
    valve->section_area[i] = M_PI / 4 * d * d / (1 + seal->stretch_mean);
  }
  valve->origin[SB_INNER] = model->land_edge - inner_contact_left;
  double spacing = at_least(valve, shape->seal_spacing, 1.2 * b);
  valve->groove_right[SB_INNER] = valve->origin[SB_INNER] + b / 2;
  valve->groove_right[SB_OUTER] = valve->groove_right[SB_INNER] + spacing;
  valve->origin[SB_OUTER] = valve->groove_right[SB_OUTER] - b / 2;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    valve->groove_left[i] = valve->groove_right[i] - b;
  }

  // The land holds the outer seal at rest.
  valve->end = at_least(valve, shape->land_length, valve->groove_right[SB_OUTER] + 0.2 * b);
  if (shape->vent_diameter > 0 && shape->vent_position + shape->vent_diameter < valve->end) {
    valve->vent_left = shape->vent_position - shape->vent_diameter / 2;
    valve->vent_right = shape->vent_position + shape->vent_diameter / 2;
  }
  make_housing(valve, model, top);
  make_stem(valve, model);
}

double sb_valve_bore_at(const SbValve *valve, double x) {
  const SbValveOutline *outline = &valve->housing;
  if (x < valve->face || x > valve->end) {
    return HUGE_VAL;
  }
  for (size_t i = 1; i + 2 < outline->count; i++) {
    SbValvePoint a = outline->point[i];
    SbValvePoint b = outline->point[i + 1];
    if (x >= a.x && x <= b.x && b.x > a.x) {
      return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
    }
  }
  return valve->bore;
}

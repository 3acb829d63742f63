// The cutaway: outlines of the section's own parts turned about the axis (revolve.h), painted back
// to front as shaded cells and edges, and the cut faces as the section paints them. The projection
// is parallel, so that lengths along one direction keep their scale.
//
// The fluid is a tint on the cut faces only. A housing without a shape of its own ends where the
// section is cut off above, and its rod ends somewhere; the vent is drawn on the upper face, though
// the section shows it as a gap. Labels stand above and below the valve, each with a line to its
// part.
#include "app/section/cutaway.h"

#include "app/section/cutaway_private.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { CONTOUR_MAX = 2 * SB_OUTLINE_MAX + 4 }; // of a part on a cut face

// [m per m of bore diameter]: rod beyond the housing at full stroke, chamfer outside.
static const double ROD = 0.3, CHAMFER = 0.05;

static const double EDGE_WIDTH = 1.3, FACE_WIDTH = 1.8;
// Of the tint from this gauge pressure [Pa] on; what has none is clear.
static const double FLUID_OPACITY = 0.72, FLUID_FULL = 0.2e6;

// A housing without a shape of its own ends at a cylinder with broken edges.
static void finish_housing(SbValveSolid *housing, double radius, double chamfer) {
  SbValveSolid plain = *housing;
  housing->count = 0;
  for (size_t i = 0; i < plain.count; i++) {
    SbValvePoint p = plain.point[i];
    if (p.y < radius) {
      housing->point[housing->count++] = p;
    }
  }
  SbValvePoint first = plain.point[0], last = plain.point[plain.count - 1];
  const SbValvePoint end[4] = {{last.x, radius - chamfer},
                               {last.x - chamfer, radius},
                               {first.x + chamfer, radius},
                               {first.x, radius - chamfer}};
  memcpy(housing->point + housing->count, end, sizeof end);
  housing->count += 4;
}

SbCutaway *sb_cutaway_create(const SbModel *model, double inner_contact_left) {
  SbCutaway *cutaway = g_new0(SbCutaway, 1);
  sb_revolve_init(&cutaway->revolve);
  cutaway->point = g_array_new(FALSE, FALSE, sizeof(SbPoint));
  cutaway->scalar = g_array_new(FALSE, FALSE, sizeof(float));
  SbValveOutline *valve = &cutaway->valve;
  const double diameter = sb_model_value(model, SB_P_BORE_DIAMETER);
  const double entry = sb_model_shape(model)->entry_diameter / 2;
  double radius = fmax(SB_SECTION_TOP * diameter, entry + 0.12 * diameter);
  sb_valve_outline_make(valve, model, inner_contact_left, radius, false);
  const double bore = valve->size;
  radius = valve->gasket ? valve->outside : radius; // which has its own
  if (!valve->shaped_housing) {
    finish_housing(&valve->solid[0], radius, CHAMFER * bore);
  }
  // The rod that goes on and on ends here.
  double end = valve->end + sb_model_value(model, SB_P_DRIVE_STROKE) + ROD * bore;
  const SbValveOutlines *given = sb_model_outlines(model);
  bool shaped_stem = given != NULL && given->stem;
  for (size_t i = 0; i < valve->solid_count && !shaped_stem; i++) {
    SbValveSolid *solid = &valve->solid[i];
    for (size_t k = 0; solid->moves && k < solid->count; k++) {
      solid->point[k].x = fmin(solid->point[k].x, end);
    }
  }
  return cutaway;
}

void sb_cutaway_destroy(SbCutaway *cutaway) {
  if (cutaway == NULL) {
    return;
  }
  sb_revolve_finish(&cutaway->revolve);
  g_array_free(cutaway->point, TRUE);
  g_array_free(cutaway->scalar, TRUE);
  g_free(cutaway);
}

// Outlines ---------------------------------------------------------------------------------------

// A solid's points where they are now. Returns the count.
static size_t outline_solid(const SbValveSolid *solid, double displacement, SbValvePoint *out) {
  double shift = solid->moves ? displacement : 0;
  for (size_t i = 0; i < solid->count; i++) {
    out[i] = (SbValvePoint){solid->point[i].x - shift, solid->point[i].y};
  }
  return solid->count;
}

static void outline_ring(SbCutaway *cutaway, const SbSection *section, int seal) {
  double x0 = sb_section_origin(section, seal), y0 = section->valve.floor;
  const SbSealShape *solved = section->instant->ring[seal];
  const SbRingShape *shape = &section->ring[seal];
  size_t all = solved != NULL ? solved->outline : shape->count;
  size_t count = MIN(all, (size_t)SB_CUTAWAY_RING_POINTS);
  SbValvePoint *out = cutaway->ring[seal];
  double twice = 0;
  for (size_t i = 0; i < count; i++) {
    size_t from = i * all / count;
    if (solved != NULL) {
      size_t node = (size_t)solved->outline_node[from];
      out[i] = (SbValvePoint){x0 + solved->place[2 * node], y0 + solved->place[2 * node + 1]};
    } else {
      out[i] = (SbValvePoint){x0 + shape->x[from], y0 + shape->y[from]};
    }
    if (i > 0) {
      twice += (out[i - 1].x - x0) * (out[i].y - y0) - (out[i].x - x0) * (out[i - 1].y - y0);
    }
  }
  for (size_t i = 0; twice < 0 && i < count / 2; i++) {
    SbValvePoint swap = out[i];
    out[i] = out[count - 1 - i];
    out[count - 1 - i] = swap;
  }
  cutaway->ring_count[seal] = count;
}

// The largest picture of housing and stem at every stroke that the strip holds, in its middle.
static void place_camera(SbCutaway *cutaway, const SbSection *section, const SbOrbit *orbit,
                         double *scale, double *x0, double *y0) {
  const SbValveOutline *valve = &cutaway->valve;
  const SbRect *strip = &section->strip;
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  const double *axis[2] = {orbit->right, orbit->up};
  for (size_t k = 0; k < valve->solid_count; k++) {
    const SbValveSolid *solid = &valve->solid[k];
    double stroke = solid->moves ? sb_model_value(section->model, SB_P_DRIVE_STROKE) : 0;
    for (size_t j = 0; j < solid->count; j++) {
      SbValvePoint p = solid->point[j];
      for (int i = 0; i < 2; i++) {
        double reach = p.y * hypot(axis[i][1], axis[i][2]);
        double at_rest = axis[i][0] * p.x, pressed = axis[i][0] * (p.x - stroke);
        low[i] = fmin(low[i], fmin(at_rest, pressed) - reach);
        high[i] = fmax(high[i], fmax(at_rest, pressed) + reach);
      }
    }
  }
  double labels = section->view->hide_labels ? 0 : 26;
  double width = (double)strip->width - 12, height = (double)strip->height - 12 - 2 * labels;
  *scale = fmax(fmin(width / (high[0] - low[0]), height / (high[1] - low[1])), 1);
  *scale *= section->view->magnify > 0 ? section->view->magnify : 1;
  *x0 = (double)(strip->x + strip->width / 2) - *scale * (low[0] + high[0]) / 2;
  *y0 = (double)(strip->y + strip->height / 2) + *scale * (low[1] + high[1]) / 2;
  cutaway->top = *y0 - *scale * high[1];
  cutaway->bottom = *y0 - *scale * low[1];
}

// Surfaces and edges -----------------------------------------------------------------------------

static void flush_cells(SbCutaway *cutaway, SbSection *section, SbRevolveBody solid) {
  const SbPalette *palette = section->palette;
  const SbDrawMap *const map[SB_REVOLVE_COUNT] = {
      [SB_REVOLVE_HOUSING] = &palette->housing_shade,
      [SB_REVOLVE_STEM] = &palette->stem_shade,
      [SB_REVOLVE_OUTER] = &palette->seal_shade[SB_OUTER],
      [SB_REVOLVE_INNER] = &palette->seal_shade[SB_INNER],
  };
  if (cutaway->point->len > 0) {
    sb_draw_mesh(section->list, (const SbPoint *)(const void *)cutaway->point->data,
                 (const float *)(const void *)cutaway->scalar->data, cutaway->point->len,
                 map[solid], 0, 1)
        ->shaded = true;
  }
  g_array_set_size(cutaway->point, 0);
  g_array_set_size(cutaway->scalar, 0);
}

static void paint_cells(SbCutaway *cutaway, SbSection *section, const SbRevolveStep *step) {
  static const int corner[6] = {0, 1, 2, 0, 2, 3};
  SbRevolveBody solid = SB_REVOLVE_HOUSING;
  for (size_t i = 0; i < step->count; i++) {
    const SbRevolveCell *cell =
        &g_array_index(cutaway->revolve.cell, SbRevolveCell, step->first + i);
    if (cell->solid != solid) {
      flush_cells(cutaway, section, solid);
      solid = cell->solid;
    }
    for (int k = 0; k < 6; k++) {
      SbPoint point = {cell->x[corner[k]], cell->y[corner[k]]};
      g_array_append_val(cutaway->point, point);
      g_array_append_val(cutaway->scalar, cell->shade[corner[k]]);
    }
  }
  flush_cells(cutaway, section, solid);
}

static void paint_edges(SbCutaway *cutaway, SbSection *section, const SbRevolveStep *step) {
  for (size_t i = 0; i < step->count; i++) {
    const SbRevolveEdge *edge =
        &g_array_index(cutaway->revolve.edge, SbRevolveEdge, step->first + i);
    float x = (EDGE_WIDTH / 2) * edge->out_x, y = (EDGE_WIDTH / 2) * edge->out_y;
    sb_draw_line(section->list, edge->x[0] + x, edge->y[0] + y, edge->x[1] + x, edge->y[1] + y,
                 EDGE_WIDTH, section->palette->outline);
  }
}

// Cut faces --------------------------------------------------------------------------------------

SbSectionPlane sb_cutaway_plane(const SbRevolve *revolve, int face) {
  double angle = sb_revolve_face_angle(face);
  const double *right = revolve->orbit.right, *up = revolve->orbit.up;
  double c = cos(angle), s = sin(angle);
  return (SbSectionPlane){
      revolve->x0, revolve->scale * right[0], revolve->scale * (right[1] * c + right[2] * s),
      revolve->y0, -revolve->scale * up[0],   -revolve->scale * (up[1] * c + up[2] * s)};
}

// The section's hatch, lying in the face: lines z - lean r = start + n pitch sqrt(2).
static void hatch_on(SbDrawItem *item, const SbSectionPlane *plane, double scale, SbColor color,
                     double lean, double start) {
  item->feather = false;
  double det = plane->xx * plane->yy - plane->xy * plane->yx;
  if (fabs(det) < 0.02 * scale * scale) {
    return; // seen along the face
  }
  // Gradient over the picture of the distance across the lines, in pixels of the face's own scale.
  double gx = scale * M_SQRT1_2 * (plane->yy + lean * plane->yx) / det;
  double gy = scale * M_SQRT1_2 * (-plane->xy - lean * plane->xx) / det;
  double steep = hypot(gx, gy);
  double nx = gx / steep, ny = gy / steep;
  double offset = scale * M_SQRT1_2 * start / steep + nx * plane->x0 + ny * plane->y0;
  item->hatch = (SbDrawHatch){color, (SB_HATCH_PITCH / steep), SB_HATCH_WIDTH, nx, ny, offset};
}

// Contour of the housing's inside with both ends on the axis, from `left` to `right`.
static size_t inside(const SbValveOutline *valve, double left, double right, SbValvePoint *out) {
  const SbOutlineSurface *surface = &valve->housing;
  const double beside = 1e-9 * (right - left);
  size_t n = 0;
  out[n++] = (SbValvePoint){left, 0};
  out[n++] = (SbValvePoint){left, sb_valve_outline_bore(valve, left + beside)};
  for (size_t i = 0; i < surface->count; i++) {
    if (surface->x[i] > left + beside && surface->x[i] < right - beside) {
      out[n++] = (SbValvePoint){surface->x[i], surface->low_left[i]};
      out[n++] = (SbValvePoint){surface->x[i], surface->low_right[i]};
    }
  }
  out[n++] = (SbValvePoint){right, sb_valve_outline_bore(valve, right - beside)};
  out[n++] = (SbValvePoint){right, 0};
  for (size_t i = 0; i < n; i++) {
    out[i].y = isfinite(out[i].y) ? fmax(out[i].y, 0) : 0;
  }
  return n;
}

static size_t map_points(const SbSectionPlane *plane, const SbValvePoint *points, size_t count,
                         SbPoint *out) {
  for (size_t i = 0; i < count; i++) {
    out[i] = sb_section_plane_at(plane, points[i].x, points[i].y);
  }
  return count;
}

// Fluid in the housing by pressure, changing at the sealing contacts as in the section.
static void paint_fluid(const SbCutaway *cutaway, SbSection *section, const SbSectionPlane *plane) {
  const SbValveOutline *valve = &cutaway->valve;
  const SbFrame *frame = section->instant->frame;
  double edge[4] = {valve->face, 0, 0, valve->end};
  const int seals[2] = {SB_INNER, SB_OUTER};
  for (int i = 0; i < 2; i++) {
    const SbSealFrame *seal = &frame->seal[seals[i]];
    double split =
        sb_section_origin(section, seals[i]) + (seal->contact_left + seal->contact_right) / 2;
    edge[i + 1] = CLAMP(split, edge[i], valve->end);
  }
  const double pressure[3] = {frame->seal[SB_INNER].pressure_left,
                              frame->seal[SB_OUTER].pressure_left,
                              frame->seal[SB_OUTER].pressure_right};
  g_autofree SbValvePoint *contour = g_new(SbValvePoint, CONTOUR_MAX);
  g_autofree SbPoint *pixel = g_new(SbPoint, CONTOUR_MAX);
  for (int i = 0; i < 3; i++) {
    if (edge[i + 1] <= edge[i]) {
      continue;
    }
    size_t count = inside(valve, edge[i], edge[i + 1], contour);
    SbColor color = sb_palette_fluid(section->palette, pressure[i]);
    color.a = (FLUID_OPACITY * sqrt(CLAMP(pressure[i] / FLUID_FULL, 0, 1)));
    sb_draw_fill(section->list, pixel, map_points(plane, contour, count, pixel), color);
  }
}

// The port on the upper face, as the section shows it.
static void paint_vent(SbSection *section, const SbCutaway *cutaway, const SbSectionPlane *plane) {
  const SbValveOutline *valve = &section->valve;
  double low, high;
  if (valve->vent_right <= valve->vent_left ||
      !sb_outline_radii(&low, &high, &cutaway->valve.housing,
                        (valve->vent_left + valve->vent_right) / 2)) {
    return;
  }
  const SbValvePoint corner[4] = {{valve->vent_left, low},
                                  {valve->vent_right, low},
                                  {valve->vent_right, high},
                                  {valve->vent_left, high}};
  SbPoint pixel[4];
  map_points(plane, corner, 4, pixel);
  double ambient = (double)section->instant->frame->seal[SB_OUTER].pressure_right;
  sb_draw_fill(section->list, pixel, 4, sb_palette_fluid(section->palette, ambient))->feather =
      false;
  const SbPoint side[2][2] = {{pixel[0], pixel[3]}, {pixel[1], pixel[2]}};
  for (int i = 0; i < 2; i++) {
    sb_draw_stroke(section->list, side[i], 2, FACE_WIDTH, section->palette->outline);
  }
}

static void paint_face(SbCutaway *cutaway, SbSection *section, int face) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  SbSectionPlane plane = sb_cutaway_plane(&cutaway->revolve, face);
  double scale = cutaway->revolve.scale;
  paint_fluid(cutaway, section, &plane);

  double s = sb_section_displacement(section);
  g_autofree SbValvePoint *point = g_new(SbValvePoint, SB_VALVE_POINTS_MAX);
  g_autofree SbPoint *pixel = g_new(SbPoint, SB_VALVE_POINTS_MAX);
  for (size_t i = 0; i < cutaway->valve.solid_count; i++) {
    const SbValveSolid *solid = &cutaway->valve.solid[i];
    size_t count = map_points(&plane, point, outline_solid(solid, s, point), pixel);
    SbDrawItem *item =
        sb_draw_fill(list, pixel, count, solid->moves ? palette->stem : palette->housing);
    hatch_on(item, &plane, scale, solid->moves ? palette->stem_hatch : palette->housing_hatch,
             solid->moves ? -1 : 1, solid->moves ? -s : 0);
    sb_draw_stroke(list, pixel, count, FACE_WIDTH, palette->outline)->closed = true;
    if (face == 0 && !solid->moves) {
      paint_vent(section, cutaway, &plane);
    }
  }

  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    // The ring's own frame in this plane.
    SbPoint origin =
        sb_section_plane_at(&plane, sb_section_origin(section, i), section->valve.floor);
    SbSectionPlane own = plane;
    own.x0 = (double)origin.x;
    own.y0 = (double)origin.y;
    sb_section_draw_ring(section, i, &own);
    const SbRingShape *ring = &section->ring[i];
    if (section->instant->frame->seal[i].land_fraction > 0 &&
        ring->contact_right > ring->contact_left) {
      double height = section->valve.bore - section->valve.floor;
      SbPoint a = sb_section_plane_at(&own, ring->contact_left, height);
      SbPoint b = sb_section_plane_at(&own, ring->contact_right, height);
      sb_draw_line(list, a.x, a.y, b.x, b.y, 4, palette->seal[i]);
    }
  }
}

void sb_cutaway_draw(SbCutaway *cutaway, SbSection *section) {
  SbRevolve *revolve = &cutaway->revolve;
  SbOrbit orbit = sb_orbit(section->view->azimuth, section->view->elevation);
  double scale, x0, y0;
  place_camera(cutaway, section, &orbit, &scale, &x0, &y0);
  sb_revolve_begin(revolve, &orbit, scale, x0, y0);
  for (size_t i = 0; i < cutaway->valve.solid_count; i++) {
    const SbValveSolid *solid = &cutaway->valve.solid[i];
    SbValvePoint point[SB_VALVE_POINTS_MAX];
    size_t count = outline_solid(solid, sb_section_displacement(section), point);
    sb_revolve_add(revolve, solid->moves ? SB_REVOLVE_STEM : SB_REVOLVE_HOUSING, point, count,
                   false);
  }
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    outline_ring(cutaway, section, i);
    sb_revolve_add(revolve, i == SB_OUTER ? SB_REVOLVE_OUTER : SB_REVOLVE_INNER, cutaway->ring[i],
                   cutaway->ring_count[i], true);
  }
  sb_revolve_build(revolve);

  sb_draw_clip(section->list, &section->strip);
  for (size_t i = 0; i < revolve->step->len; i++) {
    const SbRevolveStep *step = &g_array_index(revolve->step, SbRevolveStep, i);
    switch (step->kind) {
    case SB_REVOLVE_CELLS:
      paint_cells(cutaway, section, step);
      break;
    case SB_REVOLVE_EDGES:
      paint_edges(cutaway, section, step);
      break;
    case SB_REVOLVE_FACE:
      paint_face(cutaway, section, (int)step->first);
      break;
    }
  }
  sb_draw_clip(section->list, NULL);
  if (!section->view->hide_labels) {
    sb_cutaway_labels(cutaway, section);
  }
  sb_cutaway_caption(section);
}

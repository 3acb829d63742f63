// Rings as the section shows them: the field of a solved shape in its own triangles, the schematic
// outline of closed forms, and the outline before fitting; in any plane of a picture.
#include "app/section/section_private.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ISOLINES = 12 }; // over the range of a field

SbPoint sb_section_plane_at(const SbSectionPlane *plane, double x, double y) {
  return (SbPoint){(plane->x0 + plane->xx * x + plane->xy * y),
                   (plane->y0 + plane->yx * x + plane->yy * y)};
}

void sb_section_field_limits(const SbSection *section, SbField field, double *least,
                             double *greatest) {
  *least = section->limits.field_min[field];
  *greatest = section->limits.field_max[field];
  double given = section->view->field_max;
  if (given > 0 && field != SB_FIELD_DISPLACEMENT && field != SB_FIELD_PERMEATION) {
    *least = fmin(*least, 0);
    *greatest = given;
  }
  if (field == SB_FIELD_SHEAR) {
    // Signed: the map's middle is zero.
    *greatest = given > 0 ? given : fmax(*greatest, -*least);
    *least = -*greatest;
  }
}

// Pressure lives on the surface: a band along the outline on a plain body. Quads from the outline
// towards the middle, BAND px wide.
static void draw_surface_field(SbSection *section, int seal, const SbSealShape *shape,
                               const SbSectionPlane *plane, double least, double greatest) {
  const double BAND = 7;
  const SbPalette *palette = section->palette;
  size_t n = shape->outline;
  SbPoint *edge = section->scratch;
  SbPoint *quad = section->scratch + n;
  float *scalar = section->scratch_scalar;
  SbPoint middle = {0};
  for (size_t i = 0; i < n; i++) {
    int node = shape->outline_node[i];
    double x = shape->place[2 * node];
    double y = shape->place[2 * node + 1];
    edge[i] = sb_section_plane_at(plane, x, y);
    middle.x += edge[i].x / n;
    middle.y += edge[i].y / n;
  }
  sb_draw_fill(section->list, edge, n, sb_color_mix(palette->panel, palette->seal[seal], 0.12))
      ->feather = false;
  for (size_t i = 0; i < n; i++) {
    size_t next = (i + 1) % n;
    SbPoint in[2];
    for (int k = 0; k < 2; k++) {
      SbPoint p = edge[k == 0 ? i : next];
      double length = hypot((double)(middle.x - p.x), (double)(middle.y - p.y));
      float share = fmin(BAND / fmax(length, 1), 0.5);
      in[k] = (SbPoint){p.x + share * (middle.x - p.x), p.y + share * (middle.y - p.y)};
    }
    const SbPoint corner[6] = {edge[i], edge[next], in[1], edge[i], in[1], in[0]};
    float a = shape->field[SB_FIELD_CONTACT][shape->outline_node[i]];
    float b = shape->field[SB_FIELD_CONTACT][shape->outline_node[next]];
    const float value[6] = {a, b, b, a, b, a};
    memcpy(quad + 6 * i, corner, sizeof corner);
    memcpy(scalar + 6 * i, value, sizeof value);
  }
  sb_draw_mesh(section->list, quad, scalar, 6 * n, &palette->field, least, greatest);
}

// Field of a solved ring in its deformed triangles with lines of equal value, then its outline.
static void draw_solved_ring(SbSection *section, int seal, const SbSealShape *shape,
                             const SbSectionPlane *plane) {
  const SbPalette *palette = section->palette;
  SbField field = section->view->field;
  size_t corners = 3 * shape->triangles;
  size_t most = MAX(corners, 7 * shape->outline);
  if (most > section->scratch_size) {
    section->scratch_size = most;
    section->scratch = g_renew(SbPoint, section->scratch, most);
    section->scratch_scalar = g_renew(float, section->scratch_scalar, most);
  }
  SbPoint *point = section->scratch;
  float *scalar = section->scratch_scalar;
  double least, greatest;
  sb_section_field_limits(section, field, &least, &greatest);
  bool sign = field == SB_FIELD_SHEAR;
  if (field == SB_FIELD_CONTACT) {
    draw_surface_field(section, seal, shape, plane, least, greatest);
  }
  for (size_t i = 0; i < corners; i++) {
    int node = shape->triangle[i];
    double x = shape->place[2 * node];
    double y = shape->place[2 * node + 1];
    point[i] = sb_section_plane_at(plane, x, y);
    scalar[i] = shape->field[field][node];
  }
  if (field != SB_FIELD_CONTACT) {
    SbDrawItem *item = sb_draw_mesh(section->list, point, scalar, corners,
                                    sign ? &palette->diverging : &palette->field, least, greatest);
    item->isolines = ISOLINES;
    item->width = 0.6;
    item->line_color = palette->ink;
    item->line_color.a = 0.16;
  }
  if (section->view->mesh) {
    SbColor line = palette->outline;
    line.a = 0.35;
    for (size_t i = 0; i < corners; i += 3) {
      sb_draw_stroke(section->list, point + i, 3, 0.6, line)->closed = true;
    }
  }
  for (size_t i = 0; i < shape->outline; i++) {
    int node = shape->outline_node[i];
    double x = shape->place[2 * node];
    double y = shape->place[2 * node + 1];
    point[i] = sb_section_plane_at(plane, x, y);
  }
  sb_draw_stroke(section->list, point, shape->outline, 1.8, palette->outline)->closed = true;
}

// The section of the free ring, where it lies when nothing holds it: its axis is the valve's, so
// that it cuts into groove floor and bore by stretch and squeeze.
static void draw_undeformed(SbSection *section, int seal, const SbSectionPlane *plane) {
  const SbSealModel *model = sb_model_seal(section->model, seal);
  enum { POINTS = 144 };
  SbPoint point[POINTS];
  const double height = model->section_diameter;
  const double middle = (model->inner_diameter + height) / 2 - section->valve.floor;
  const SbSealProfile profile = sb_model_profile(section->model, seal);
  SbRingOutline outline;
  if (sb_ring_outline_of_profile(&outline, &profile, height, NULL) != SB_OK) {
    return; // no model has such a profile
  }
  for (int i = 0; i < POINTS; i++) {
    double at[2]; // radial, axial
    sb_ring_outline_place(&outline, outline.length * i / POINTS, at);
    point[i] = sb_section_plane_at(plane, at[1] * height, middle + at[0] * height);
  }
  SbDrawItem *item = sb_draw_stroke(section->list, point, POINTS, 1.2, section->palette->ink);
  item->closed = true;
  item->dash = &sb_dash_reference;
}

static void draw_deformed(SbSection *section, int seal, const SbSectionPlane *plane) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  const SbSealShape *solved = section->instant->ring[seal];
  if (solved != NULL) {
    draw_solved_ring(section, seal, solved, plane);
    return;
  }
  const SbRingShape *shape = &section->ring[seal];
  SbPoint points[SB_RING_POINTS];
  for (size_t i = 0; i < shape->count; i++) {
    points[i] = sb_section_plane_at(plane, shape->x[i], shape->y[i]);
  }
  SbColor fill = sb_color_mix(palette->panel, palette->seal[seal], palette->dark ? 0.42 : 0.34);
  sb_draw_fill(list, points, shape->count, fill)->feather = false;
  sb_draw_stroke(list, points, shape->count, 1.8, palette->outline)->closed = true;
}

void sb_section_draw_ring(SbSection *section, int seal, const SbSectionPlane *plane) {
  draw_deformed(section, seal, plane);
  if (section->view->undeformed) {
    draw_undeformed(section, seal, plane);
  }
}

// Triangles from fills, lines, fields and glyphs.
#include "app/section/mesh.h"

#include <glib.h>
#include <math.h>

// Half width of a fill: no line is as wide.
static const double WIDE = 1e6;

void sb_mesh_init(SbMesh *mesh) {
  *mesh = (SbMesh){0};
}

void sb_mesh_finish(SbMesh *mesh) {
  g_free(mesh->vertex);
  g_free(mesh->work);
  g_free(mesh->link);
  *mesh = (SbMesh){0};
}

static SbMeshVertex *add(SbMesh *mesh, size_t count) {
  if (mesh->count + count > mesh->capacity) {
    mesh->capacity = MAX(2 * mesh->capacity, MAX(mesh->count + count, (size_t)4096));
    mesh->vertex = g_realloc_n(mesh->vertex, mesh->capacity, sizeof *mesh->vertex);
  }
  SbMeshVertex *vertex = mesh->vertex + mesh->count;
  mesh->count += count;
  return vertex;
}

static SbPoint *work_space(SbMesh *mesh, size_t count) {
  if (count > mesh->work_capacity) {
    mesh->work_capacity = MAX(2 * mesh->work_capacity, MAX(count, (size_t)256));
    mesh->work = g_realloc_n(mesh->work, mesh->work_capacity, sizeof *mesh->work);
    mesh->link = g_realloc_n(mesh->link, mesh->work_capacity, 2 * sizeof *mesh->link);
  }
  return mesh->work;
}

static void premultiply(uint8_t out[4], SbColor c) {
  out[0] = (uint8_t)(255.0 * c.r * c.a + 0.5);
  out[1] = (uint8_t)(255.0 * c.g * c.a + 0.5);
  out[2] = (uint8_t)(255.0 * c.b * c.a + 0.5);
  out[3] = (uint8_t)(255.0 * c.a + 0.5);
}

static SbMeshVertex solid(SbPoint point, const uint8_t color[4]) {
  return (SbMeshVertex){
      point.x, point.y, {color[0], color[1], color[2], color[3]}, {0.0, WIDE, WIDE, 2.0 * WIDE}};
}

// Scaled points without repeated ones. Returns how many are left.
static size_t copy_scaled(SbPoint *out, const SbPoint *points, size_t count, double scale,
                          bool closed) {
  size_t kept = 0;
  for (size_t i = 0; i < count; i++) {
    SbPoint p = {(points[i].x * scale), (points[i].y * scale)};
    if (kept > 0 && fabs(p.x - out[kept - 1].x) + fabs(p.y - out[kept - 1].y) < 1e-3) {
      continue;
    }
    out[kept++] = p;
  }
  while (closed && kept > 1 &&
         fabs(out[0].x - out[kept - 1].x) + fabs(out[0].y - out[kept - 1].y) < 1e-3) {
    kept--;
  }
  return kept;
}

static double cross(SbPoint a, SbPoint b, SbPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static double signed_area(const SbPoint *p, size_t n) {
  double twice = 0.0;
  for (size_t i = 0, j = n - 1; i < n; j = i++) {
    twice += p[j].x * p[i].y - p[i].x * p[j].y;
  }
  return twice / 2.0;
}

static bool inside_mesh(SbPoint p, SbPoint a, SbPoint b, SbPoint c) {
  return cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0;
}

// Is b, between a and c, an ear of the ring of links? Only reflex corners can lie in it.
static bool is_ear(const SbPoint *p, const int *next, const int *previous, int b) {
  int a = previous[b], c = next[b];
  if (cross(p[a], p[b], p[c]) <= 0.0) {
    return false;
  }
  for (int i = next[c]; i != a; i = next[i]) {
    if (cross(p[previous[i]], p[i], p[next[i]]) <= 0.0 && inside_mesh(p[i], p[a], p[b], p[c])) {
      return false;
    }
  }
  return true;
}

static void triangle(SbMesh *mesh, SbPoint a, SbPoint b, SbPoint c, const uint8_t color[4]) {
  SbMeshVertex *v = add(mesh, 3);
  v[0] = solid(a, color);
  v[1] = solid(b, color);
  v[2] = solid(c, color);
}

// Triangulates a simple polygon with positive area in mesh->work.
static void clip_ears(SbMesh *mesh, const SbPoint *p, int n, const uint8_t color[4]) {
  bool convex = true;
  for (int i = 0; i < n && convex; i++) {
    convex = cross(p[i], p[(i + 1) % n], p[(i + 2) % n]) >= 0.0;
  }
  if (convex) {
    for (int i = 1; i + 1 < n; i++) {
      triangle(mesh, p[0], p[i], p[i + 1], color);
    }
    return;
  }
  int *next = mesh->link, *previous = mesh->link + n;
  for (int i = 0; i < n; i++) {
    next[i] = (i + 1) % n;
    previous[i] = (i + n - 1) % n;
  }
  int left = n, at = 0, tried = 0;
  while (left > 3 && tried < left) {
    if (is_ear(p, next, previous, at)) {
      triangle(mesh, p[previous[at]], p[at], p[next[at]], color);
      next[previous[at]] = next[at];
      previous[next[at]] = previous[at];
      at = previous[at];
      left--;
      tried = 0;
    } else {
      at = next[at];
      tried++;
    }
  }
  // What is left is a triangle, or (rounding, self-contact) nothing worth a hole: a fan.
  int first = at;
  for (int i = next[first]; next[i] != first; i = next[i]) {
    triangle(mesh, p[first], p[i], p[next[i]], color);
  }
}

// Mitre at a corner with edge directions d0, d1 (unit): offset by 1 to the left of the path.
static SbPoint mitre(SbPoint d0, SbPoint d1, double limit) {
  SbPoint n = {-(d0.y + d1.y), d0.x + d1.x};
  double dot = 1.0 + d0.x * d1.x + d0.y * d1.y; // |n|^2 = 2 dot
  double length = 1.0 / fmax(dot, 2.0 / (limit * limit));
  return (SbPoint){n.x * length, n.y * length};
}

static SbPoint direction(SbPoint a, SbPoint b) {
  double dx = b.x - a.x, dy = b.y - a.y;
  double length = fmax(sqrt(dx * dx + dy * dy), 1e-9);
  return (SbPoint){dx / length, dy / length};
}

void sb_mesh_fill(SbMesh *mesh, const SbDrawItem *item, const SbPoint *points, double scale) {
  SbPoint *p = work_space(mesh, 2 * item->count);
  size_t n = copy_scaled(p, points, item->count, scale, true);
  if (n < 3) {
    return;
  }
  double area = signed_area(p, n);
  if (area < 0.0) {
    for (size_t i = 0; i < n / 2; i++) {
      SbPoint swap = p[i];
      p[i] = p[n - 1 - i];
      p[n - 1 - i] = swap;
    }
  }
  size_t first = mesh->count;
  uint8_t color[4];
  premultiply(color, item->color);
  if (item->feather) {
    // With positive area (y down) the inside is on the left of the path in the mitre's sense.
    static const uint8_t none[4] = {0, 0, 0, 0};
    SbPoint *inner = p + n;
    for (size_t i = 0; i < n; i++) {
      SbPoint before = p[(i + n - 1) % n], after = p[(i + 1) % n];
      SbPoint m = mitre(direction(before, p[i]), direction(p[i], after), 3.0);
      inner[i] = (SbPoint){p[i].x + 0.5 * m.x, p[i].y + 0.5 * m.y};
    }
    clip_ears(mesh, inner, (int)n, color);
    for (size_t i = 0; i < n; i++) {
      size_t j = (i + 1) % n;
      SbPoint outer_i = {2.0 * p[i].x - inner[i].x, 2.0 * p[i].y - inner[i].y};
      SbPoint outer_j = {2.0 * p[j].x - inner[j].x, 2.0 * p[j].y - inner[j].y};
      SbMeshVertex *v = add(mesh, 6);
      v[0] = solid(inner[i], color);
      v[1] = solid(outer_i, none);
      v[2] = solid(inner[j], color);
      v[3] = solid(outer_i, none);
      v[4] = solid(outer_j, none);
      v[5] = solid(inner[j], color);
    }
  } else {
    clip_ears(mesh, p, (int)n, color);
  }
  if (item->hatch.width > 0.0) {
    const SbDrawHatch *hatch = &item->hatch;
    double offset = hatch->offset * (double)scale;
    for (size_t i = first; i < mesh->count; i++) {
      SbMeshVertex *v = &mesh->vertex[i];
      v->extra[0] = hatch->across_x * v->x + hatch->across_y * v->y - offset;
    }
  }
}

// The strip of a whole line, a quad per segment; ends reach a pixel further for their soft edge.
static void strip(SbMesh *mesh, const SbPoint *p, size_t n, bool closed, double half,
                  const uint8_t color[4]) {
  double reach = half + 1.0;
  double total = 0.0;
  size_t segments = closed ? n : n - 1;
  for (size_t i = 0; i < segments; i++) {
    SbPoint a = p[i], b = p[(i + 1) % n];
    total += sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  }
  double along = 0.0;
  for (size_t i = 0; i < segments; i++) {
    SbPoint a = p[i], b = p[(i + 1) % n];
    SbPoint d = direction(a, b);
    double length = sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
    bool starts = !closed && i == 0, ends = !closed && i + 1 == segments;
    SbPoint square = {-d.y, d.x};
    SbPoint ma = starts ? square : mitre(direction(p[(i + n - 1) % n], a), d, 2.5);
    SbPoint mb = ends ? square : mitre(d, direction(b, p[(i + 2) % n]), 2.5);
    double from = along, to = along + length;
    if (starts) {
      a = (SbPoint){a.x - d.x, a.y - d.y};
      from -= 1.0;
    }
    if (ends) {
      b = (SbPoint){b.x + d.x, b.y + d.y};
      to += 1.0;
    }
    double lead = closed ? WIDE : 0.0, size = closed ? 2.0 * WIDE + total : total;
    const SbMeshVertex corner[4] = {
        {a.x + reach * ma.x,
         a.y + reach * ma.y,
         {color[0], color[1], color[2], color[3]},
         {reach, half, lead + from, size}},
        {a.x - reach * ma.x,
         a.y - reach * ma.y,
         {color[0], color[1], color[2], color[3]},
         {-reach, half, lead + from, size}},
        {b.x + reach * mb.x,
         b.y + reach * mb.y,
         {color[0], color[1], color[2], color[3]},
         {reach, half, lead + to, size}},
        {b.x - reach * mb.x,
         b.y - reach * mb.y,
         {color[0], color[1], color[2], color[3]},
         {-reach, half, lead + to, size}},
    };
    SbMeshVertex *v = add(mesh, 6);
    v[0] = corner[0];
    v[1] = corner[1];
    v[2] = corner[2];
    v[3] = corner[1];
    v[4] = corner[3];
    v[5] = corner[2];
    along += length;
  }
}

void sb_mesh_stroke(SbMesh *mesh, const SbDrawItem *item, const SbPoint *points, double scale) {
  SbPoint *p = work_space(mesh, item->count);
  size_t n = copy_scaled(p, points, item->count, scale, item->closed);
  if (n < 2) {
    return;
  }
  SbColor color = item->color;
  double half = item->width * (double)scale / 2.0;
  if (half < 0.5) {
    // Thinner than a pixel: a pixel wide, fainter.
    color.a *= 2.0 * half;
    half = 0.5;
  }
  uint8_t ink[4];
  premultiply(ink, color);
  strip(mesh, p, n, item->closed && n > 2, half, ink);
}

void sb_mesh_field(SbMesh *mesh, const SbDrawItem *item, const SbPoint *points,
                   const float *scalars, double scale) {
  static const uint8_t white[4] = {255, 255, 255, 255};
  double range = fmax(item->map_max - item->map_min, 1e-30);
  SbMeshVertex *v = add(mesh, item->count);
  for (size_t i = 0; i < item->count; i++) {
    SbPoint p = {(points[i].x * scale), (points[i].y * scale)};
    double t = (scalars[i] - item->map_min) / range;
    if (item->shaded) {
      uint8_t color[4];
      premultiply(color, item->map->entry[(int)(255.0 * fmin(fmax(t, 0.0), 1.0) + 0.5)]);
      v[i] = solid(p, color);
    } else {
      v[i] = solid(p, white);
      v[i].extra[0] = t;
    }
  }
}

void sb_mesh_glyphs(SbMesh *mesh, double x, double y, double width, double height, double u,
                    double v, SbColor color) {
  uint8_t ink[4];
  premultiply(ink, color);
  const double at[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  SbMeshVertex *vertex = add(mesh, 6);
  for (int i = 0; i < 6; i++) {
    vertex[i] = (SbMeshVertex){(x + at[i][0] * width),
                               (y + at[i][1] * height),
                               {ink[0], ink[1], ink[2], ink[3]},
                               {(u + at[i][0] * width), (v + at[i][1] * height), 0.0, 0.0}};
  }
}

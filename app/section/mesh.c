// Triangles from fills, lines, fields and glyphs.
#include "app/section/mesh.h"

#include <glib.h>
#include <math.h>

// Half width of a fill: no line is as wide.
static const float WIDE = 1e6f;

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

static SbDrawPoint *work_space(SbMesh *mesh, size_t count) {
  if (count > mesh->work_capacity) {
    mesh->work_capacity = MAX(2 * mesh->work_capacity, MAX(count, (size_t)256));
    mesh->work = g_realloc_n(mesh->work, mesh->work_capacity, sizeof *mesh->work);
    mesh->link = g_realloc_n(mesh->link, mesh->work_capacity, 2 * sizeof *mesh->link);
  }
  return mesh->work;
}

static void premultiply(uint8_t out[4], SbDrawColour c) {
  out[0] = (uint8_t)(255.0f * c.r * c.a + 0.5f);
  out[1] = (uint8_t)(255.0f * c.g * c.a + 0.5f);
  out[2] = (uint8_t)(255.0f * c.b * c.a + 0.5f);
  out[3] = (uint8_t)(255.0f * c.a + 0.5f);
}

static SbMeshVertex solid(SbDrawPoint point, const uint8_t colour[4]) {
  return (SbMeshVertex){point.x,
                        point.y,
                        {colour[0], colour[1], colour[2], colour[3]},
                        {0.0f, WIDE, WIDE, 2.0f * WIDE}};
}

// Scaled points without repeated ones. Returns how many are left.
static size_t copy_scaled(SbDrawPoint *out, const SbDrawPoint *points, size_t count, double scale,
                          bool closed) {
  size_t kept = 0;
  for (size_t i = 0; i < count; i++) {
    SbDrawPoint p = {(float)((double)points[i].x * scale), (float)((double)points[i].y * scale)};
    if (kept > 0 && fabsf(p.x - out[kept - 1].x) + fabsf(p.y - out[kept - 1].y) < 1e-3f) {
      continue;
    }
    out[kept++] = p;
  }
  while (closed && kept > 1 &&
         fabsf(out[0].x - out[kept - 1].x) + fabsf(out[0].y - out[kept - 1].y) < 1e-3f) {
    kept--;
  }
  return kept;
}

static float cross(SbDrawPoint a, SbDrawPoint b, SbDrawPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static float signed_area(const SbDrawPoint *p, size_t n) {
  float twice = 0.0f;
  for (size_t i = 0, j = n - 1; i < n; j = i++) {
    twice += p[j].x * p[i].y - p[i].x * p[j].y;
  }
  return twice / 2.0f;
}

static bool inside(SbDrawPoint p, SbDrawPoint a, SbDrawPoint b, SbDrawPoint c) {
  return cross(a, b, p) >= 0.0f && cross(b, c, p) >= 0.0f && cross(c, a, p) >= 0.0f;
}

// Is b, between a and c, an ear of the ring of links? Only reflex corners can lie in it.
static bool is_ear(const SbDrawPoint *p, const int *next, const int *previous, int b) {
  int a = previous[b], c = next[b];
  if (cross(p[a], p[b], p[c]) <= 0.0f) {
    return false;
  }
  for (int i = next[c]; i != a; i = next[i]) {
    if (cross(p[previous[i]], p[i], p[next[i]]) <= 0.0f && inside(p[i], p[a], p[b], p[c])) {
      return false;
    }
  }
  return true;
}

static void triangle(SbMesh *mesh, SbDrawPoint a, SbDrawPoint b, SbDrawPoint c,
                     const uint8_t colour[4]) {
  SbMeshVertex *v = add(mesh, 3);
  v[0] = solid(a, colour);
  v[1] = solid(b, colour);
  v[2] = solid(c, colour);
}

// Triangulates a simple polygon with positive area in mesh->work.
static void clip_ears(SbMesh *mesh, const SbDrawPoint *p, int n, const uint8_t colour[4]) {
  bool convex = true;
  for (int i = 0; i < n && convex; i++) {
    convex = cross(p[i], p[(i + 1) % n], p[(i + 2) % n]) >= 0.0f;
  }
  if (convex) {
    for (int i = 1; i + 1 < n; i++) {
      triangle(mesh, p[0], p[i], p[i + 1], colour);
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
      triangle(mesh, p[previous[at]], p[at], p[next[at]], colour);
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
    triangle(mesh, p[first], p[i], p[next[i]], colour);
  }
}

// Mitre at a corner with edge directions d0, d1 (unit): offset by 1 to the left of the path.
static SbDrawPoint mitre(SbDrawPoint d0, SbDrawPoint d1, float limit) {
  SbDrawPoint n = {-(d0.y + d1.y), d0.x + d1.x};
  float dot = 1.0f + d0.x * d1.x + d0.y * d1.y; // |n|^2 = 2 dot
  float length = 1.0f / fmaxf(dot, 2.0f / (limit * limit));
  return (SbDrawPoint){n.x * length, n.y * length};
}

static SbDrawPoint direction(SbDrawPoint a, SbDrawPoint b) {
  float dx = b.x - a.x, dy = b.y - a.y;
  float length = fmaxf(sqrtf(dx * dx + dy * dy), 1e-9f);
  return (SbDrawPoint){dx / length, dy / length};
}

void sb_mesh_fill(SbMesh *mesh, const SbDrawItem *item, const SbDrawPoint *points, double scale) {
  SbDrawPoint *p = work_space(mesh, 2 * item->count);
  size_t n = copy_scaled(p, points, item->count, scale, true);
  if (n < 3) {
    return;
  }
  float area = signed_area(p, n);
  if (area < 0.0f) {
    for (size_t i = 0; i < n / 2; i++) {
      SbDrawPoint swap = p[i];
      p[i] = p[n - 1 - i];
      p[n - 1 - i] = swap;
    }
  }
  size_t first = mesh->count;
  uint8_t colour[4];
  premultiply(colour, item->colour);
  if (item->feather) {
    // With positive area (y down) the inside is on the left of the path in the mitre's sense.
    static const uint8_t none[4] = {0, 0, 0, 0};
    SbDrawPoint *inner = p + n;
    for (size_t i = 0; i < n; i++) {
      SbDrawPoint before = p[(i + n - 1) % n], after = p[(i + 1) % n];
      SbDrawPoint m = mitre(direction(before, p[i]), direction(p[i], after), 3.0f);
      inner[i] = (SbDrawPoint){p[i].x + 0.5f * m.x, p[i].y + 0.5f * m.y};
    }
    clip_ears(mesh, inner, (int)n, colour);
    for (size_t i = 0; i < n; i++) {
      size_t j = (i + 1) % n;
      SbDrawPoint outer_i = {2.0f * p[i].x - inner[i].x, 2.0f * p[i].y - inner[i].y};
      SbDrawPoint outer_j = {2.0f * p[j].x - inner[j].x, 2.0f * p[j].y - inner[j].y};
      SbMeshVertex *v = add(mesh, 6);
      v[0] = solid(inner[i], colour);
      v[1] = solid(outer_i, none);
      v[2] = solid(inner[j], colour);
      v[3] = solid(outer_i, none);
      v[4] = solid(outer_j, none);
      v[5] = solid(inner[j], colour);
    }
  } else {
    clip_ears(mesh, p, (int)n, colour);
  }
  if (item->hatch.width > 0.0f) {
    const SbDrawHatch *hatch = &item->hatch;
    float offset = hatch->offset * (float)scale;
    for (size_t i = first; i < mesh->count; i++) {
      SbMeshVertex *v = &mesh->vertex[i];
      v->extra[0] = hatch->across_x * v->x + hatch->across_y * v->y - offset;
    }
  }
}

// The strip of a whole line, a quad per segment; ends reach a pixel further for their soft edge.
static void strip(SbMesh *mesh, const SbDrawPoint *p, size_t n, bool closed, float half,
                  const uint8_t colour[4]) {
  float reach = half + 1.0f;
  float total = 0.0f;
  size_t segments = closed ? n : n - 1;
  for (size_t i = 0; i < segments; i++) {
    SbDrawPoint a = p[i], b = p[(i + 1) % n];
    total += sqrtf((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  }
  float along = 0.0f;
  for (size_t i = 0; i < segments; i++) {
    SbDrawPoint a = p[i], b = p[(i + 1) % n];
    SbDrawPoint d = direction(a, b);
    float length = sqrtf((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
    bool starts = !closed && i == 0, ends = !closed && i + 1 == segments;
    SbDrawPoint square = {-d.y, d.x};
    SbDrawPoint ma = starts ? square : mitre(direction(p[(i + n - 1) % n], a), d, 2.5f);
    SbDrawPoint mb = ends ? square : mitre(d, direction(b, p[(i + 2) % n]), 2.5f);
    float from = along, to = along + length;
    if (starts) {
      a = (SbDrawPoint){a.x - d.x, a.y - d.y};
      from -= 1.0f;
    }
    if (ends) {
      b = (SbDrawPoint){b.x + d.x, b.y + d.y};
      to += 1.0f;
    }
    float lead = closed ? WIDE : 0.0f, size = closed ? 2.0f * WIDE + total : total;
    const SbMeshVertex corner[4] = {
        {a.x + reach * ma.x,
         a.y + reach * ma.y,
         {colour[0], colour[1], colour[2], colour[3]},
         {reach, half, lead + from, size}},
        {a.x - reach * ma.x,
         a.y - reach * ma.y,
         {colour[0], colour[1], colour[2], colour[3]},
         {-reach, half, lead + from, size}},
        {b.x + reach * mb.x,
         b.y + reach * mb.y,
         {colour[0], colour[1], colour[2], colour[3]},
         {reach, half, lead + to, size}},
        {b.x - reach * mb.x,
         b.y - reach * mb.y,
         {colour[0], colour[1], colour[2], colour[3]},
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

void sb_mesh_stroke(SbMesh *mesh, const SbDrawItem *item, const SbDrawPoint *points, double scale) {
  SbDrawPoint *p = work_space(mesh, item->count);
  size_t n = copy_scaled(p, points, item->count, scale, item->closed);
  if (n < 2) {
    return;
  }
  SbDrawColour colour = item->colour;
  float half = item->width * (float)scale / 2.0f;
  if (half < 0.5f) {
    // Thinner than a pixel: a pixel wide, fainter.
    colour.a *= 2.0f * half;
    half = 0.5f;
  }
  uint8_t ink[4];
  premultiply(ink, colour);
  strip(mesh, p, n, item->closed && n > 2, half, ink);
}

void sb_mesh_field(SbMesh *mesh, const SbDrawItem *item, const SbDrawPoint *points,
                   const float *scalars, double scale) {
  static const uint8_t white[4] = {255, 255, 255, 255};
  float range = fmaxf(item->map_max - item->map_min, 1e-30f);
  SbMeshVertex *v = add(mesh, item->count);
  for (size_t i = 0; i < item->count; i++) {
    SbDrawPoint p = {(float)((double)points[i].x * scale), (float)((double)points[i].y * scale)};
    float t = (scalars[i] - item->map_min) / range;
    if (item->shaded) {
      uint8_t colour[4];
      premultiply(colour, item->map->entry[(int)(255.0f * fminf(fmaxf(t, 0.0f), 1.0f) + 0.5f)]);
      v[i] = solid(p, colour);
    } else {
      v[i] = solid(p, white);
      v[i].extra[0] = t;
    }
  }
}

void sb_mesh_glyphs(SbMesh *mesh, double x, double y, double width, double height, double u,
                    double v, SbDrawColour colour) {
  uint8_t ink[4];
  premultiply(ink, colour);
  const double at[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  SbMeshVertex *vertex = add(mesh, 6);
  for (int i = 0; i < 6; i++) {
    vertex[i] =
        (SbMeshVertex){(float)(x + at[i][0] * width),
                       (float)(y + at[i][1] * height),
                       {ink[0], ink[1], ink[2], ink[3]},
                       {(float)(u + at[i][0] * width), (float)(v + at[i][1] * height), 0.0f, 0.0f}};
  }
}

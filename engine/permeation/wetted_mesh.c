// See wetted_mesh.h.
#include "engine/permeation/wetted_mesh.h"

#include <stdlib.h>
#include <string.h>

SbStatus sb_wetted_mesh_create(SbWettedMesh **out, int nodes, int elements, bool axisymmetric,
                               SbReport *report) {
  SbWettedMesh *section = *out = calloc(1, sizeof *section);
  if (section != NULL) {
    section->nodes = nodes;
    section->elements = elements;
    section->axisymmetric = axisymmetric;
    section->place = calloc(2 * (size_t)nodes + 1, sizeof *section->place);
    section->triangle = calloc(6 * (size_t)elements + 1, sizeof *section->triangle);
    section->face = calloc(2 * (size_t)nodes + 1, sizeof *section->face);
    section->end = section->face + nodes;
  }
  if (section == NULL || section->place == NULL || section->triangle == NULL ||
      section->face == NULL) {
    sb_wetted_mesh_destroy(section);
    *out = NULL;
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a section of %d nodes", nodes);
  }
  return sb_succeed(report);
}

void sb_wetted_mesh_destroy(SbWettedMesh *section) {
  if (section != NULL) {
    free(section->place);
    free(section->triangle);
    free(section->face);
    free(section);
  }
}

SbStatus sb_wetted_mesh_copy(SbWettedMesh **out, const SbWettedMesh *from, SbReport *report) {
  SbStatus status =
      sb_wetted_mesh_create(out, from->nodes, from->elements, from->axisymmetric, report);
  if (status == SB_OK) {
    memcpy((*out)->place, from->place, 2 * sizeof *from->place * (size_t)from->nodes);
    memcpy((*out)->triangle, from->triangle, 6 * sizeof *from->triangle * (size_t)from->elements);
    memcpy((*out)->face, from->face, (size_t)from->nodes);
    memcpy((*out)->end, from->end, (size_t)from->nodes);
  }
  return status;
}

// A point of a side from `a` over its middle `m` to `b`, at a share xi of -1 .. 1.
static void along(double x[2], const double *place, int a, int m, int b, double xi) {
  for (int k = 0; k < 2; k++) {
    x[k] = 0.5 * xi * (xi - 1.0) * place[2 * a + k] + (1.0 - xi * xi) * place[2 * m + k] +
           0.5 * xi * (xi + 1.0) * place[2 * b + k];
  }
}

// Returns the node in the middle between the mid-side node `m` and the vertex `v` of a side whose
// other vertex is `w`: a side's two such nodes are known[2 m] (at the smaller vertex) and the next
// one.
static int half_side(SbWettedMesh *to, const SbWettedMesh *from, int *known, int v, int m, int w) {
  int *node = &known[2 * m + (v > w ? 1 : 0)];
  if (*node < 0) {
    *node = to->nodes++;
    along(&to->place[(size_t)2 * *node], from->place, v, m, w, -0.5);
    to->face[*node] = from->face[m];
  }
  return *node;
}

// The node of an element between two of its mid-side nodes: at area coordinates 1/2 of vertex v and
// 1/4 of the others, whose shape functions are those below.
static int between(SbWettedMesh *to, const SbWettedMesh *from, const int *tri, int v) {
  const int b = (v + 1) % 3, c = (v + 2) % 3;
  const int node = to->nodes++;
  for (int k = 0; k < 2; k++) {
    to->place[2 * node + k] = -0.125 * (from->place[2 * tri[b] + k] + from->place[2 * tri[c] + k]) +
                              0.5 * from->place[2 * tri[3 + v] + k] +
                              0.25 * from->place[2 * tri[3 + b] + k] +
                              0.5 * from->place[2 * tri[3 + c] + k];
  }
  return node;
}

static void split_element(SbWettedMesh *to, const SbWettedMesh *from, int *known, const int *tri) {
  int half[3][2], inner[3];
  for (int v = 0; v < 3; v++) {
    const int next = (v + 1) % 3;
    half[v][0] = half_side(to, from, known, tri[v], tri[3 + v], tri[next]);
    half[v][1] = half_side(to, from, known, tri[next], tri[3 + v], tri[v]);
    inner[v] = between(to, from, tri, v);
  }
  for (int v = 0; v < 3; v++) {
    const int before = (v + 2) % 3;
    const int corner[6] = {tri[v],     tri[3 + v], tri[3 + before],
                           half[v][0], inner[v],   half[before][1]};
    memcpy(&to->triangle[6 * to->elements++], corner, sizeof corner);
  }
  const int middle[6] = {tri[3], tri[4], tri[5], inner[1], inner[2], inner[0]};
  memcpy(&to->triangle[6 * to->elements++], middle, sizeof middle);
}

SbStatus sb_wetted_mesh_split(SbWettedMesh **out, const SbWettedMesh *from, SbReport *report) {
  *out = NULL;
  for (int i = 0; i < 6 * from->elements; i++) {
    if (from->triangle[i] < 0 || from->triangle[i] >= from->nodes) {
      return sb_fail(report, SB_ERROR_INPUT, "a triangle of the section names no node");
    }
  }
  // At most three halves of sides twice and three inner ones an element.
  int *known = malloc(2 * sizeof *known * (size_t)(from->nodes + 1));
  SbStatus status = sb_wetted_mesh_create(out, from->nodes + 9 * from->elements, 4 * from->elements,
                                          from->axisymmetric, report);
  if (status == SB_OK && known == NULL) {
    status = sb_fail(report, SB_ERROR_MEMORY, "no memory to split a section");
  }
  if (status != SB_OK) {
    free(known);
    sb_wetted_mesh_destroy(*out);
    *out = NULL;
    return status;
  }
  SbWettedMesh *to = *out;
  memset(known, -1, 2 * sizeof *known * (size_t)from->nodes);
  memcpy(to->place, from->place, 2 * sizeof *to->place * (size_t)from->nodes);
  memcpy(to->face, from->face, (size_t)from->nodes);
  memcpy(to->end, from->end, (size_t)from->nodes);
  to->nodes = from->nodes;
  to->elements = 0;
  for (int e = 0; e < from->elements; e++) {
    split_element(to, from, known, &from->triangle[(size_t)6 * e]);
  }
  free(known);
  return sb_succeed(report);
}

void sb_wetted_mesh_quarter(SbWettedMesh *section) {
  for (int e = 0; e < section->elements; e++) {
    const int *tri = &section->triangle[(size_t)6 * e];
    for (int side = 0; side < 3; side++) {
      const int a = tri[side], b = tri[(side + 1) % 3], m = tri[3 + side];
      // A side of two elements is moved by one of them; one between two ends stays.
      if (section->end[a] == section->end[b] || section->end[m] != 0) {
        continue;
      }
      double x[2];
      along(x, section->place, section->end[a] ? a : b, m, section->end[a] ? b : a, -0.5);
      memcpy(&section->place[(size_t)2 * m], x, sizeof x);
      section->end[m] = 2;
    }
  }
  for (int i = 0; i < section->nodes; i++) {
    section->end[i] = section->end[i] == 1;
  }
}

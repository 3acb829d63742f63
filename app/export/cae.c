// Files of a solved ring for other programs; what they hold: cae.h.
#include "app/export/cae.h"
#include "app/base/output.h"
#include "app/export/cae_private.h"

#include <math.h>
#include <string.h>

static void take(SbCaeMesh *mesh, const SbRing *ring, const SbFitProblem *problem) {
  int triangles, outline;
  sb_ring_section_sizes(ring, &mesh->nodes, &mesh->elements, &mesh->sides);
  sb_ring_sizes(ring, &mesh->nodes, &triangles, &outline);
  const size_t n = (size_t)mesh->nodes;
  mesh->section = (SbRingSection){g_new(double, 2 * n), g_new(int, 6 * mesh->elements),
                                  g_new(int, 2 * mesh->sides), g_new(unsigned char, mesh->sides)};
  double *at = mesh->values = g_new(double, 8 * n);
  mesh->fields = (SbRingFields){.place = at,
                                .displacement = at + 2 * n,
                                .mises = at + 4 * n,
                                .hydrostatic = at + 5 * n,
                                .shear = at + 6 * n,
                                .contact = at + 7 * n,
                                .triangle = g_new(int, 3 * triangles),
                                .outline = g_new(int, outline)};
  sb_ring_section(ring, &mesh->section);
  sb_ring_fields(ring, &mesh->fields);
  sb_fit_ring_problem(&mesh->body, &mesh->load, problem);
  sb_ring_result(ring, &mesh->result);
}

static void drop(SbCaeMesh *mesh) {
  g_free(mesh->section.place);
  g_free(mesh->section.triangle);
  g_free(mesh->section.loop);
  g_free(mesh->section.side);
  g_free(mesh->values);
  g_free(mesh->fields.triangle);
  g_free(mesh->fields.outline);
}

void sb_cae_put(GString *out, const char *mark, double value) {
  char text[G_ASCII_DTOSTR_BUF_SIZE];
  g_string_append(out, mark);
  g_string_append(out, g_ascii_formatd(text, sizeof text, "%.10g", value));
}

double sb_cae_free_place(const SbCaeMesh *mesh, int node, int axis) {
  const int at = 2 * node + axis;
  return mesh->fields.place[at] - mesh->fields.displacement[at];
}

// ---- VTU

static void put_field(GString *out, const SbCaeMesh *mesh, const char *name, const double *value,
                      int components) {
  g_string_append_printf(out,
                         "<DataArray type=\"Float64\" Name=\"%s\" NumberOfComponents=\"%d\" "
                         "format=\"ascii\">\n",
                         name, components == 1 ? 1 : 3);
  for (int i = 0; i < mesh->nodes; i++) {
    for (int k = 0; k < components; k++) {
      sb_cae_put(out, k > 0 ? " " : "", value[components * i + k]);
    }
    g_string_append(out, components == 1 ? "\n" : " 0\n");
  }
  g_string_append(out, "</DataArray>\n");
}

static void write_vtu(GString *out, const SbCaeMesh *mesh) {
  enum { QUADRATIC_TRIANGLE = 22 };
  g_string_append_printf(out,
                         "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
                         "version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
                         "<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%d\">\n<Points>\n",
                         mesh->nodes, mesh->elements);
  put_field(out, mesh, "place_m", mesh->fields.place, 2);
  g_string_append(out, "</Points>\n<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" "
                       "format=\"ascii\">\n");
  for (int i = 0; i < 6 * mesh->elements; i++) {
    g_string_append_printf(out, "%d%s", mesh->section.triangle[i], i % 6 == 5 ? "\n" : " ");
  }
  g_string_append(out, "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" "
                       "format=\"ascii\">\n");
  for (int i = 1; i <= mesh->elements; i++) {
    g_string_append_printf(out, "%d\n", 6 * i);
  }
  g_string_append(out, "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" "
                       "format=\"ascii\">\n");
  for (int i = 0; i < mesh->elements; i++) {
    g_string_append_printf(out, "%d\n", QUADRATIC_TRIANGLE);
  }
  g_string_append(out, "</DataArray>\n</Cells>\n<PointData>\n");
  put_field(out, mesh, "displacement_m", mesh->fields.displacement, 2);
  put_field(out, mesh, "von_mises_Pa", mesh->fields.mises, 1);
  put_field(out, mesh, "mean_stress_Pa", mesh->fields.hydrostatic, 1);
  put_field(out, mesh, "shear_stress_Pa", mesh->fields.shear, 1);
  put_field(out, mesh, "boundary_pressure_Pa", mesh->fields.contact, 1);
  g_string_append(out, "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

// ---- DXF

// A vertex [m] and the bulge of the arc to the next one.
static void put_vertex(GString *out, const char *layer, double x, double y, double bulge) {
  g_string_append_printf(out, "0\nVERTEX\n8\n%s\n", layer);
  sb_cae_put(out, "10\n", 1e3 * x);
  sb_cae_put(out, "\n20\n", 1e3 * y);
  g_string_append(out, "\n30\n0\n");
  if (bulge != 0.0) {
    sb_cae_put(out, "42\n", bulge);
    g_string_append_c(out, '\n');
  }
}

static void begin_polyline(GString *out, const char *layer, bool closed) {
  g_string_append_printf(out, "0\nPOLYLINE\n8\n%s\n66\n1\n70\n%d\n10\n0\n20\n0\n30\n0\n", layer,
                         closed ? 1 : 0);
}

static void end_polyline(GString *out, const char *layer) {
  g_string_append_printf(out, "0\nSEQEND\n8\n%s\n", layer);
}

// The free section by the lines and arcs that it has. Its (r, z) are y and x here, so that arcs
// turn the other way, and a gasket's bore lies inwards, so that they turn once more.
static void put_free(GString *out, const SbCaeMesh *mesh, const char *layer) {
  const SbRingBody *body = &mesh->body;
  const double d = body->section_diameter, middle = 0.5 * (body->inner_diameter + d);
  const double way = body->inward ? -1.0 : 1.0;
  SbRingOutline outline;
  (void)sb_ring_outline_of_profile(&outline, &body->profile, d, NULL); // it was solved
  begin_polyline(out, layer, true);
  for (int i = 0; i < outline.count; i++) {
    const SbRingOutlinePart *part = &outline.part[i];
    put_vertex(out, layer, d * part->from[1], middle + way * d * part->from[0],
               part->radius > 0.0 ? -way * tan(0.25 * part->sweep) : 0.0);
  }
  end_polyline(out, layer);
}

static void write_dxf(GString *out, const SbCaeMesh *mesh) {
  static const char *const line[] = {"FLOOR", "BORE"}, deformed[] = "DEFORMED";
  const double radius[] = {mesh->load.floor_radius, fabs(mesh->load.bore_radius)};
  g_string_append(out, "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n4\n"
                       "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
  put_free(out, mesh, "FREE");
  begin_polyline(out, deformed, true);
  for (int i = 0; i < 2 * mesh->sides; i++) {
    const double *place = &mesh->fields.place[2 * mesh->section.loop[i]];
    put_vertex(out, deformed, place[0], place[1], 0.0);
  }
  end_polyline(out, deformed);
  for (int k = mesh->body.inward ? 1 : 0; k < 2; k++) {
    begin_polyline(out, line[k], false);
    put_vertex(out, line[k], 1.5 * mesh->result.axial_left, radius[k], 0.0);
    put_vertex(out, line[k], 1.5 * mesh->result.axial_right, radius[k], 0.0);
    end_polyline(out, line[k]);
  }
  g_string_append(out, "0\nENDSEC\n0\nEOF\n");
}

// ---- STL

// The corner of a triangle at a place of the section, turned about the axis [mm].
static void put_corner(GString *out, double x, double r, double angle) {
  sb_cae_put(out, "vertex ", 1e3 * x);
  sb_cae_put(out, " ", 1e3 * r * cos(angle));
  sb_cae_put(out, " ", 1e3 * r * sin(angle));
  g_string_append_c(out, '\n');
}

// The triangle of three corners (side's end 0 or 1, step of the turn 0 or 1), outwards.
static void put_facet(GString *out, const double x[2], const double r[2], const double angle[2],
                      const int corner[3][2]) {
  double p[3][3], n[3];
  for (int i = 0; i < 3; i++) {
    const double at = angle[corner[i][1]];
    p[i][0] = x[corner[i][0]];
    p[i][1] = r[corner[i][0]] * cos(at);
    p[i][2] = r[corner[i][0]] * sin(at);
  }
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
  }
  const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int i = 0; i < 3; i++) {
    sb_cae_put(out, i == 0 ? "facet normal " : " ", n[i] / length);
  }
  g_string_append(out, "\nouter loop\n");
  for (int i = 0; i < 3; i++) {
    put_corner(out, x[corner[i][0]], r[corner[i][0]], angle[corner[i][1]]);
  }
  g_string_append(out, "endloop\nendfacet\n");
}

static void write_body(GString *out, const SbCaeMesh *mesh, bool deformed) {
  enum { TURN = 72 };
  static const int corner[2][3][2] = {{{0, 0}, {0, 1}, {1, 0}}, {{1, 0}, {0, 1}, {1, 1}}};
  g_string_append_printf(out, "solid %s\n", deformed ? "DEFORMED" : "FREE");
  for (int i = 0; i < mesh->sides; i++) {
    double x[2], r[2];
    for (int k = 0; k < 2; k++) {
      const int node = mesh->section.loop[2 * ((i + k) % mesh->sides)];
      x[k] = deformed ? mesh->fields.place[2 * node] : sb_cae_free_place(mesh, node, 0);
      r[k] = deformed ? mesh->fields.place[2 * node + 1] : sb_cae_free_place(mesh, node, 1);
    }
    for (int step = 0; step < TURN; step++) {
      const double angle[2] = {2 * M_PI * step / TURN, 2 * M_PI * ((step + 1) % TURN) / TURN};
      put_facet(out, x, r, angle, corner[0]);
      put_facet(out, x, r, angle, corner[1]);
    }
  }
  g_string_append_printf(out, "endsolid %s\n", deformed ? "DEFORMED" : "FREE");
}

static void write_stl(GString *out, const SbCaeMesh *mesh) {
  write_body(out, mesh, true);
}

static void write_free_stl(GString *out, const SbCaeMesh *mesh) {
  write_body(out, mesh, false);
}

static const struct {
  const char *ending;
  void (*write)(GString *, const SbCaeMesh *);
} KIND[] = {{".vtu", write_vtu},
            {".inp", sb_cae_write_calculix},
            {".dxf", write_dxf},
            {".free.stl", write_free_stl},
            {".stl", write_stl}};

static size_t kind_of(const char *path) {
  size_t kind = 0;
  while (kind < G_N_ELEMENTS(KIND) && !sb_output_ends_in(path, KIND[kind].ending)) {
    kind++;
  }
  return kind;
}

bool sb_cae_check(const char *path, const SbFitProblem *problem, GError **error) {
  const size_t kind = kind_of(path);
  if (kind == G_N_ELEMENTS(KIND)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "--export: %s has no known ending (allowed .vtu, .inp, .dxf, .stl, .free.stl)",
                path);
  } else if (!sb_fit_kind(problem->model)->section) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "--export: only the ring model has a mesh, not %s (--model ring)",
                sb_fit_kind(problem->model)->name);
  } else if (KIND[kind].write == sb_cae_write_calculix && problem->dragged) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s: a ring with friction is not written for CalculiX: it depends on its path",
                path);
  } else if (KIND[kind].write == sb_cae_write_calculix &&
             (problem->wall_draft > 0 || problem->groove_corner > 0 ||
              problem->groove_chamfer > 0 || problem->groove != NULL)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s: only grooves with upright walls and sharp edges are written for CalculiX",
                path);
  } else if (KIND[kind].write == sb_cae_write_calculix && problem->gasket) {
    g_set_error(
        error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
        "%s: a gasket is not written for CalculiX: the plates' friction depends on its path", path);
  } else {
    return true;
  }
  return false;
}

char *sb_cae_text(const char *path, const SbRing *ring, const SbFitProblem *problem) {
  SbCaeMesh mesh;
  take(&mesh, ring, problem);
  GString *out = g_string_new(NULL);
  KIND[kind_of(path)].write(out, &mesh);
  drop(&mesh);
  return g_string_free(out, FALSE);
}

// A solved ring's problem for CalculiX; what it is: cae.h.
#include "app/export/cae_private.h"

#include <math.h>
#include <string.h>

// A side of an element, numbered as there, for each boundary side.
typedef struct {
  int element, face;
  double out[2]; // direction outwards in the free section, axial and radial
} Face;

static Face *faces_of(const SbCaeMesh *mesh) {
  const SbRingSection *section = &mesh->section;
  int *side_of = g_new(int, mesh->nodes); // boundary side of a mid-side node
  Face *face = g_new0(Face, mesh->sides);
  for (int i = 0; i < mesh->nodes; i++) {
    side_of[i] = -1;
  }
  for (int k = 0; k < mesh->sides; k++) {
    side_of[section->loop[2 * k + 1]] = k;
    const int from = section->loop[2 * k], to = section->loop[2 * ((k + 1) % mesh->sides)];
    const double axial = sb_cae_free_place(mesh, to, 0) - sb_cae_free_place(mesh, from, 0);
    const double radial = sb_cae_free_place(mesh, to, 1) - sb_cae_free_place(mesh, from, 1);
    const double length = hypot(axial, radial);
    // Counter-clockwise in (r, z) the inside is to the left.
    face[k].out[0] = -radial / length;
    face[k].out[1] = axial / length;
  }
  for (int i = 0; i < 3 * mesh->elements; i++) {
    const int side = side_of[section->triangle[i / 3 * 6 + 3 + i % 3]];
    if (side >= 0) {
      face[side].element = i / 3 + 1;
      face[side].face = i % 3 + 1;
    }
  }
  g_free(side_of);
  return face;
}

// A rigid ring: four-node elements along an axis, from a place to another, its far side beyond.
typedef struct {
  const char *name;
  int axis;            // along which it is divided: 0 axial, 1 radial
  double from, to;     // along it [mm]
  double face, back;   // across: of the side that is touched, and behind it [mm]
  double out[2], move; // the ring's faces that may touch it look here; its motion across [mm]
  int first, first_element;
} Rigid;

enum { PIECES = 64 }; // short beside the contact: the forces on their nodes are its pressures

static void put_rigid_nodes(GString *out, const Rigid *rigid) {
  for (int i = 0; i <= PIECES; i++) {
    const double along = rigid->from + (rigid->to - rigid->from) * i / PIECES;
    const double across[2] = {rigid->face, rigid->back};
    for (int k = 0; k < 2; k++) {
      g_string_append_printf(out, "%d", rigid->first + 2 * i + k);
      sb_cae_put(out, ", ", rigid->axis == 0 ? across[k] : along);
      sb_cae_put(out, ", ", rigid->axis == 0 ? along : across[k]);
      g_string_append(out, ", 0\n");
    }
  }
}

// Counter-clockwise in (r, z), with the touched side's number.
static int put_rigid_elements(GString *out, const Rigid *rigid) {
  const bool behind = rigid->back > rigid->face; // further out, or further right
  const bool turned = rigid->axis == 0 ? !behind : behind;
  g_string_append_printf(out, "*ELEMENT, TYPE=CAX4, ELSET=%s\n", rigid->name);
  for (int i = 0; i < PIECES; i++) {
    const int a = rigid->first + 2 * i, b = a + 1, c = a + 3, d = a + 2;
    g_string_append_printf(out, "%d, %d, %d, %d, %d\n", rigid->first_element + i, a, turned ? d : b,
                           c, turned ? b : d);
  }
  return turned ? 1 : 4;
}

static void put_move(GString *out, const Rigid *rigid, bool moved) {
  const int across = rigid->axis == 0 ? 1 : 2;
  g_string_append_printf(out, "N%s, %d, %d, 0\nN%s, %d, %d", rigid->name, 3 - across, 3 - across,
                         rigid->name, across, across);
  sb_cae_put(out, ", ", moved ? rigid->move : 0.0);
  g_string_append_c(out, '\n');
}

// Its contact's stiffness [MPa/mm] and, in N/mm for each MPa of modulus and mm of radius, that of
// the springs below, of the wedge.
static const double STIFFNESS = 1e4, SPRING = 0.0009;

// Beyond this squeeze, and under fluid, CalculiX finds no way from the free ring: its contact
// chatters, and its iteration takes the fluid's force as if it did not turn with the faces.
static const double FOLLOWED = 0.205;

// The found balance, as a start: where nodes stand [mm] in the free ring's frame, those of a
// contact as deep in it as its pressure makes them.
typedef struct {
  double (*move)[2]; // [nodes] radial, axial
  int first, first_element;
} Start;

static Start start_of(const SbCaeMesh *mesh, double drift, double wall, int first,
                      int first_element) {
  const double mm = 1e3, near = 1e-6; // of a surface [mm]
  const double at[2] = {mm * mesh->load.bore_radius, mm * mesh->load.floor_radius};
  Start start = {g_malloc_n((size_t)mesh->nodes, sizeof *start.move), first, first_element};
  for (int i = 0; i < mesh->nodes; i++) {
    const double deep = 1e-6 * mesh->fields.contact[i] / STIFFNESS;
    const double r = mm * mesh->fields.place[2 * i + 1], z = mm * mesh->fields.place[2 * i];
    start.move[i][0] = mm * mesh->fields.displacement[2 * i + 1];
    start.move[i][1] = mm * mesh->fields.displacement[2 * i] - drift;
    if (fabs(r - at[0]) < near) {
      start.move[i][0] += deep;
    } else if (fabs(r - at[1]) < near) {
      start.move[i][0] -= deep;
    } else if (fabs(z - wall) < near) {
      start.move[i][1] += wall > 0.0 ? deep : -deep;
    }
  }
  return start;
}

// Connects the nodes of the boundary by weak springs to their equilibrium positions.
static void put_springs(GString *out, const SbCaeMesh *mesh, const Start *start, double drift) {
  const int count = 2 * mesh->sides;
  double radius = 0.0;
  g_string_append(out, "*NODE, NSET=NHANG\n");
  for (int i = 0; i < count; i++) {
    const int node = mesh->section.loop[i];
    radius += 1e3 * mesh->fields.place[2 * node + 1] / count;
    g_string_append_printf(out, "%d", start->first + i);
    sb_cae_put(out, ", ", 1e3 * sb_cae_free_place(mesh, node, 1));
    sb_cae_put(out, ", ", 1e3 * sb_cae_free_place(mesh, node, 0) + drift);
    g_string_append(out, ", 0\n");
  }
  for (int k = 0; k < 2; k++) {
    g_string_append_printf(out, "*ELEMENT, TYPE=SPRING2, ELSET=HANG%d\n", k + 1);
    for (int i = 0; i < count; i++) {
      g_string_append_printf(out, "%d, %d, %d\n", start->first_element + k * count + i,
                             mesh->section.loop[i] + 1, start->first + i);
    }
    g_string_append_printf(out, "*SPRING, ELSET=HANG%d\n%d, %d\n", k + 1, k + 1, k + 1);
    sb_cae_put(out, "", SPRING * 1e-6 * mesh->body.modulus * radius);
    g_string_append_c(out, '\n');
  }
}

static void put_place(GString *out, int node, const double move[2]) {
  for (int k = 0; k < 2; k++) {
    g_string_append_printf(out, "%d, %d, %d", node, k + 1, k + 1);
    sb_cae_put(out, ", ", move[k]);
    g_string_append_c(out, '\n');
  }
}

// The springs' far ends where the nodes were found, or free.
static void put_hung(GString *out, const SbCaeMesh *mesh, const Start *start, bool hung) {
  g_string_append(out, "NHANG, 3, 3, 0\n");
  for (int i = 0; i < 2 * mesh->sides && hung; i++) {
    put_place(out, start->first + i, start->move[mesh->section.loop[i]]);
  }
}

static void put_fluid(GString *out, const SbCaeMesh *mesh, const Face *face) {
  g_string_append(out, "*DLOAD\n");
  for (int i = 0; i < mesh->sides; i++) {
    const unsigned char at = mesh->section.side[i];
    const double p = at == SB_RING_SIDE_LEFT    ? mesh->load.pressure_left
                     : at == SB_RING_SIDE_RIGHT ? mesh->load.pressure_right
                                                : 0.0;
    if (p != 0.0) {
      g_string_append_printf(out, "%d, P%d", face[i].element, face[i].face);
      sb_cae_put(out, ", ", 1e-6 * p);
      g_string_append_c(out, '\n');
    }
  }
}

// The reactions at the end of a step; of the bore each node's.
static void put_prints(GString *out, const Rigid rigid[], int count, bool hung) {
  for (int k = 0; k < count; k++) {
    g_string_append_printf(out, "*NODE PRINT, NSET=N%s, TOTALS=%s, FREQUENCY=1000\nRF\n",
                           rigid[k].name, k == 1 ? "YES" : "ONLY");
  }
  if (hung) {
    g_string_append(out, "*NODE PRINT, NSET=NHANG, TOTALS=ONLY, FREQUENCY=1000\nRF\n");
  }
  g_string_append(out, "*END STEP\n");
}

// Onto the floor; the bore to its place; and once more there, since faces in contact are those that
// faced each other as the increment began.
static void put_path(GString *out, const Rigid rigid[], int count, int middle) {
  for (int step = 0; step <= count; step++) {
    g_string_append_printf(out, "*STEP, NLGEOM, INC=500\n*STATIC\n%s\n*BOUNDARY, OP=NEW\n",
                           step < count ? "0.1, 1, 1e-6, 0.25" : "1, 1, 1e-6, 1");
    for (int k = 0; k < count; k++) {
      put_move(out, &rigid[k], step >= k);
    }
    g_string_append_printf(out, "%d, 2, 2, 0\n", middle);
    put_prints(out, rigid, count, false);
  }
}

// All where it was found, at once; let go but for the springs; without fluid from these as well.
static void put_balance(GString *out, const SbCaeMesh *mesh, const Rigid rigid[], int count,
                        int middle, const Start *start, const Face *face, bool pressed) {
  for (int step = 0; step < (pressed ? 2 : 3); step++) {
    g_string_append_printf(out, "*STEP, NLGEOM, INC=500\n*STATIC%s\n*BOUNDARY, OP=NEW\n",
                           step == 0 ? ", DIRECT\n1, 1" : "\n1, 1, 1e-6, 1");
    for (int k = 0; k < count; k++) {
      put_move(out, &rigid[k], true);
    }
    for (int i = 0; i < mesh->nodes && step == 0; i++) {
      if (i + 1 != middle) { // something must be free
        put_place(out, i + 1, start->move[i]);
      }
    }
    if (step > 0 && !pressed) {
      g_string_append_printf(out, "%d, 2, 2", middle);
      sb_cae_put(out, ", ", start->move[middle - 1][1]);
      g_string_append_c(out, '\n');
    }
    put_hung(out, mesh, start, step < 2);
    if (pressed) {
      put_fluid(out, mesh, face);
    }
    put_prints(out, rigid, count, true);
  }
}

// What the parts of a file share.
typedef struct {
  const SbCaeMesh *mesh;
  double low[2], high[2]; // ends of the free section, axial (moved by `drift`) and radial [mm]
  double drift;           // mean axial displacement [mm]
  double wall;            // place of the wall that fluid presses the ring against [mm]
  bool pressed;
  Rigid rigid[3]; // [count] floor, bore, and with fluid a wall
  int count;
} Problem;

// Finds the ends of the free section. It is placed where the pressed ring will be: only its place
// relative to the wall matters.
static void find_ends(Problem *of) {
  const double mm = 1e3;
  const SbCaeMesh *mesh = of->mesh;
  for (int k = 0; k < 2; k++) {
    of->low[k] = HUGE_VAL;
    of->high[k] = -HUGE_VAL;
  }
  for (int i = 0; i < mesh->nodes; i++) {
    of->drift += mm * mesh->fields.displacement[2 * i] / mesh->nodes;
    for (int k = 0; k < 2; k++) {
      of->low[k] = fmin(of->low[k], mm * sb_cae_free_place(mesh, i, k));
      of->high[k] = fmax(of->high[k], mm * sb_cae_free_place(mesh, i, k));
    }
  }
  of->low[0] += of->drift;
  of->high[0] += of->drift;
}

static void place_rigid(Problem *of) {
  // A straight element of a rigid ring is a chord of the wedge: its middle stands at the radius.
  const double chord = 1.0 / cos(M_PI / 180.0), mm = 1e3;
  const SbCaeMesh *mesh = of->mesh;
  const SbRingLoad *load = &mesh->load;
  const double d = mm * mesh->body.section_diameter;
  const bool right = load->pressure_left > load->pressure_right;
  const double *low = of->low, *high = of->high;
  const double floor = low[1] - 1e-3, bore = high[1] + 0.02 * d;
  const double side = right ? high[0] + 0.3 * d : low[0] - 0.3 * d;
  of->pressed = load->pressure_left != 0.0 || load->pressure_right != 0.0;
  of->wall = mm * (right ? load->wall_right : load->wall_left);
  of->count = of->pressed && isfinite(of->wall) ? 3 : 2;
  const double outer = low[0] - d, inner = high[0] + d;
  const Rigid rigid[3] = {{"FLOOR",
                           0,
                           outer,
                           inner,
                           floor,
                           low[1] - 0.3,
                           {0, -1},
                           chord * mm * load->floor_radius - floor,
                           0,
                           0},
                          {"BORE",
                           0,
                           outer,
                           inner,
                           bore,
                           bore + 0.3,
                           {0, 1},
                           chord * mm * load->bore_radius - bore,
                           0,
                           0},
                          {"WALL",
                           1,
                           0.2 * low[1],
                           high[1] + d,
                           side,
                           side + (right ? 0.3 : -0.3),
                           {right ? 1 : -1, 0},
                           of->wall - side,
                           0,
                           0}};
  for (int k = 0; k < of->count; k++) {
    of->rigid[k] = rigid[k];
    of->rigid[k].first = mesh->nodes + 1 + k * 2 * (PIECES + 1);
    of->rigid[k].first_element = mesh->elements + 1 + k * PIECES;
  }
}

// Returns the node in the middle of the section.
static int put_nodes(GString *out, const Problem *of) {
  const SbCaeMesh *mesh = of->mesh;
  const double mm = 1e3, *low = of->low, *high = of->high;
  double nearest = HUGE_VAL;
  int middle = 0;
  g_string_append(out, "\n*NODE, NSET=ALL\n");
  for (int i = 0; i < mesh->nodes; i++) {
    const double r = mm * sb_cae_free_place(mesh, i, 1),
                 z = mm * sb_cae_free_place(mesh, i, 0) + of->drift;
    g_string_append_printf(out, "%d", i + 1);
    sb_cae_put(out, ", ", r);
    sb_cae_put(out, ", ", z);
    g_string_append(out, ", 0\n");
    const double away = hypot(r - 0.5 * (low[1] + high[1]), z - 0.5 * (low[0] + high[0]));
    middle = away < nearest ? i + 1 : middle;
    nearest = fmin(nearest, away);
  }
  for (int k = 0; k < of->count; k++) {
    put_rigid_nodes(out, &of->rigid[k]);
  }
  return middle;
}

static void put_elements(GString *out, const Problem *of, int face_number[3]) {
  const SbCaeMesh *mesh = of->mesh;
  g_string_append(out, "*ELEMENT, TYPE=CAX6, ELSET=RUBBER\n");
  for (int i = 0; i < 6 * mesh->elements; i++) {
    if (i % 6 == 0) {
      g_string_append_printf(out, "%d", i / 6 + 1);
    }
    g_string_append_printf(out, ", %d%s", mesh->section.triangle[i] + 1, i % 6 == 5 ? "\n" : "");
  }
  for (int k = 0; k < of->count; k++) {
    const Rigid *rigid = &of->rigid[k];
    face_number[k] = put_rigid_elements(out, rigid);
    g_string_append_printf(out, "*NSET, NSET=N%s, GENERATE\n%d, %d\n", rigid->name, rigid->first,
                           rigid->first + 2 * PIECES + 1);
  }
}

// The faces of each contact pair: those of the ring look towards the rigid one, or lie in it.
static void put_surfaces(GString *out, const Problem *of, const Face *face,
                         const int face_number[3]) {
  for (int k = 0; k < of->count; k++) {
    const Rigid *rigid = &of->rigid[k];
    g_string_append_printf(out, "*SURFACE, NAME=S%s, TYPE=ELEMENT\n", rigid->name);
    for (int i = 0; i < of->mesh->sides; i++) {
      if (rigid->out[0] * face[i].out[0] + rigid->out[1] * face[i].out[1] > 0.25) {
        g_string_append_printf(out, "%d, S%d\n", face[i].element, face[i].face);
      }
    }
    g_string_append_printf(out, "*SURFACE, NAME=M%s, TYPE=ELEMENT\n", rigid->name);
    for (int i = 0; i < PIECES; i++) {
      g_string_append_printf(out, "%d, S%d\n", rigid->first_element + i, face_number[k]);
    }
  }
}

static void put_materials(GString *out, const Problem *of) {
  const SbRingBody *body = &of->mesh->body;
  const double shear = 1e-6 * body->modulus / (2.0 * (1.0 + body->poisson_ratio));
  const double bulk = 1e-6 * body->modulus / (3.0 * (1.0 - 2.0 * body->poisson_ratio));
  g_string_append_printf(out, "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, %s\n",
                         body->mooney_share > 0.0 ? "MOONEY-RIVLIN" : "NEO HOOKE");
  sb_cae_put(out, "", 0.5 * shear * (1.0 - body->mooney_share));
  if (body->mooney_share > 0.0) {
    sb_cae_put(out, ", ", 0.5 * shear * body->mooney_share);
  }
  sb_cae_put(out, ", ", 2.0 / bulk);
  g_string_append(out, "\n*SOLID SECTION, ELSET=RUBBER, MATERIAL=RUBBER\n"
                       "** So soft that its own stress does not count; all its nodes are moved.\n"
                       "*MATERIAL, NAME=RIGID\n*ELASTIC\n1e-6, 0\n");
  for (int k = 0; k < of->count; k++) {
    g_string_append_printf(out, "*SOLID SECTION, ELSET=%s, MATERIAL=RIGID\n", of->rigid[k].name);
  }
}

static void put_contacts(GString *out, const Problem *of) {
  g_string_append(out, "*SURFACE INTERACTION, NAME=SMOOTH\n"
                       "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n");
  sb_cae_put(out, "", STIFFNESS);
  g_string_append(out, ", 0.0025, 0.01\n");
  for (int k = 0; k < of->count; k++) {
    g_string_append_printf(out,
                           "*CONTACT PAIR, INTERACTION=SMOOTH, TYPE=SURFACE TO SURFACE\nS%s, "
                           "M%s\n",
                           of->rigid[k].name, of->rigid[k].name);
  }
}

void sb_cae_write_calculix(GString *out, const SbCaeMesh *mesh) {
  Problem of = {.mesh = mesh};
  find_ends(&of);
  place_rigid(&of);
  g_string_append_printf(out, "** A seal ring by sealbench: mm, N, MPa; r = x, axial = y.\n"
                              "** Forces are those of 2 degrees of the ring, its 180th part.\n");
  sb_cae_put(out, "** Bore load by sealbench [N], whole ring: ", mesh->result.bore_force);
  const int middle = put_nodes(out, &of); // holds the ring axially while nothing else does
  const double squeeze = 1.0 - mesh->result.thickness / (1e-3 * (of.high[1] - of.low[1]));
  const bool started = of.pressed || squeeze > FOLLOWED;
  const Rigid *last = &of.rigid[of.count - 1];
  Start start = {0};
  if (started) {
    start = start_of(mesh, of.drift, of.wall, last->first + 2 * (PIECES + 1),
                     last->first_element + PIECES);
  }
  int face_number[3];
  g_autofree Face *face = faces_of(mesh);
  put_elements(out, &of, face_number);
  put_surfaces(out, &of, face, face_number);
  put_materials(out, &of);
  if (started) {
    put_springs(out, mesh, &start, of.drift);
  }
  put_contacts(out, &of);
  if (started) {
    put_balance(out, mesh, of.rigid, of.count, middle, &start, face, of.pressed);
    g_free(start.move);
  } else {
    put_path(out, of.rigid, of.count, middle);
  }
}

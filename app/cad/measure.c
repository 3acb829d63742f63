// Volume, moments and section of a body in the kernel. Compiled into sealbench-cad.
//
// The kernel's quadrature is wrong by 1 % on spline faces, and by more on a spline that was
// revolved. Their bodies are measured by meshes: the vertices are on the faces, so that the numbers
// of a mesh deviate by even powers of the facets' size, and are extrapolated from meshes with
// facets of half the size (Romberg's method) to some 1e-5 (campaign `foreign`). Kernel's numbers
// that agree stay. As the mesher can hang or crash, it runs as a process, at most three times.
#include "app/cad/cad_private.h"

#include <gmshc.h>

#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

// Meshes; facets of the first one on a turn; processor time of a mesher and of all meshers [s].
enum { MESHES = 3, FACETS = 8, SECONDS = 40, SECONDS_ALL = 80 };

// Smallest facets that are tried, and largest, relative to the body's largest side; relative size
// of the last extrapolation, 16 times the error or more, of a volume that is accepted.
static const double SMALLEST[] = {0.01, 0.03, 0.02}, LARGEST = 0.1, SETTLED = 5e-4;

// Writes the kernel's numbers [mm].
static bool by_kernel(SbSolid *solid, int body) {
  int failed[3];
  double *moment = NULL, *at = solid->centre;
  size_t count = 0;
  gmshModelOccGetMass(3, body, &solid->volume, &failed[0]);
  gmshModelOccGetCenterOfMass(3, body, &at[0], &at[1], &at[2], &failed[1]);
  gmshModelOccGetMatrixOfInertia(3, body, &moment, &count, &failed[2]);
  const bool good = failed[0] == 0 && failed[1] == 0 && failed[2] == 0 && count == 9;
  for (int k = 0; good && k < 9; k++) {
    solid->inertia[k / 3][k % 3] = moment[k];
  }
  gmshFree(moment);
  return good;
}

// Writes the numbers of the mesh [mm], which is that of one body.
static bool by_mesh(SbSolid *solid) {
  size_t *tags = NULL, *nodes = NULL, *elements = NULL, count = 0, n_at = 0, n_uv = 0, corners = 0;
  double *at = NULL, *uv = NULL;
  int ierr;
  gmshModelMeshRenumberNodes(&ierr); // 1, 2, ...
  gmshModelMeshGetNodes(&tags, &count, &at, &n_at, &uv, &n_uv, -1, -1, 0, 0, &ierr);
  g_autofree double *vertices = g_new0(double, n_at + 1);
  for (size_t i = 0; i < n_at; i++) {
    vertices[3 * (tags[i / 3] - 1) + i % 3] = at[i];
  }
  gmshFree(tags);
  gmshFree(at);
  gmshFree(uv);
  gmshModelMeshGetElementsByType(2, &elements, &n_at, &nodes, &corners, -1, 0, 1, &ierr);
  g_autofree unsigned *triangles = g_new(unsigned, corners + 1);
  for (size_t i = 0; i < corners; i++) {
    triangles[i] = (unsigned)nodes[i] - 1;
  }
  gmshFree(elements);
  gmshFree(nodes);
  return sb_mesh_orient(&n_uv, NULL, triangles, corners / 3, vertices, NULL) == SB_OK &&
         sb_solid_integrate(solid, vertices, count, triangles, corners / 3, 1, NULL) == SB_OK;
}

// Extrapolates the numbers of a body from its meshes; false if they do not settle.
static bool by_meshes(SbSolid *solid, int body, double smallest) {
  enum { NUMBERS = sizeof *solid / sizeof(double) };
  SbSolid row[MESHES] = {0};
  double box[6];
  int ierr, *all = NULL, own[2] = {3, body};
  size_t count = 0;
  gmshModelGetEntities(&all, &count, -1, &ierr);
  gmshModelSetVisibility(all, count, 0, 0, &ierr);
  gmshModelSetVisibility(own, 2, 1, 1, &ierr);
  gmshFree(all);
  gmshModelGetBoundingBox(3, body, &box[0], &box[1], &box[2], &box[3], &box[4], &box[5], &ierr);
  const double side = fmax(fmax(box[3] - box[0], box[4] - box[1]), box[5] - box[2]);
  gmshOptionSetNumber("Mesh.MeshOnlyVisible", 1, &ierr);
  gmshOptionSetNumber("Mesh.MeshSizeFromCurvature", FACETS, &ierr);
  gmshOptionSetNumber("Mesh.MeshSizeMin", smallest * side, &ierr);
  gmshOptionSetNumber("Mesh.MeshSizeMax", LARGEST * side, &ierr);
  bool settled = false;
  for (int mesh = 0; !settled && mesh < MESHES; mesh++) {
    if (mesh == 0) {
      gmshModelMeshGenerate(2, &ierr);
    } else {
      gmshModelMeshRefine(&ierr);
    }
    if (ierr != 0 || !by_mesh(solid)) {
      return false;
    }
    for (int k = 0, divisor = 4; k <= mesh; k++, divisor *= 4) {
      for (int n = 0; n < NUMBERS; n++) {
        double *next = (double *)solid + n, *old = (double *)&row[k] + n;
        const double finer = *next;
        *next += (finer - *old) / (divisor - 1);
        *old = finer;
      }
    }
    *solid = row[mesh];
    settled = mesh > 0 && fabs(solid->volume / row[mesh - 1].volume - 1) < SETTLED;
  }
  return settled;
}

static void set_timer(time_t seconds) {
  setitimer(ITIMER_REAL, &(struct itimerval){{seconds, 0}, {seconds, 0}}, NULL);
}

// As by_meshes(), in a process of its own.
static bool in_process(SbSolid *solid, int body, double smallest) {
  int ends[2];
  struct rusage used;
  getrusage(RUSAGE_CHILDREN, &used);
  if (used.ru_utime.tv_sec + SECONDS > SECONDS_ALL || pipe(ends) != 0) {
    return false;
  }
  set_timer(0); // which ends this program if it does nothing
  const pid_t child = fork();
  if (child == 0) {
    set_timer(1);
    setrlimit(RLIMIT_CPU, &(struct rlimit){SECONDS, SECONDS + 5});
    const bool good = by_meshes(solid, body, smallest);
    _exit(good && write(ends[1], solid, sizeof *solid) == sizeof *solid ? 0 : 1);
  }
  close(ends[1]);
  const bool good = child > 0 && read(ends[0], solid, sizeof *solid) == sizeof *solid;
  close(ends[0]);
  (void)waitpid(child, NULL, 0);
  set_timer(1);
  return good;
}

// Returns whether volumes and moments are equal to a few times the error of the meshes.
static bool equal(const SbSolid *a, const SbSolid *b) {
  bool good = fabs(a->volume / b->volume - 1) < 3e-5;
  for (int k = 0; k < 3; k++) {
    good = good && fabs(a->inertia[k][k] / b->inertia[k][k] - 1) < 3e-5;
  }
  return good;
}

bool sb_cad_measure(SbSolid *solid, int body, bool *coarse) {
  static const char *const exact[] = {"Plane", "Cylinder", "Cone", "Sphere", "Torus", NULL};
  int ierr, of[2] = {3, body}, *faces = NULL;
  size_t count = 0;
  *coarse = false;
  if (!by_kernel(solid, body)) {
    return false;
  }
  gmshModelGetBoundary(of, 2, &faces, &count, 0, 0, 0, &ierr);
  for (size_t i = 0; i + 1 < count; i += 2) {
    char *type = NULL;
    gmshModelGetType(2, faces[i + 1], &type, &ierr);
    *coarse = *coarse || ierr != 0 || !g_strv_contains(exact, type);
    gmshFree(type);
  }
  gmshFree(faces);
  for (size_t i = 0; *coarse && i < G_N_ELEMENTS(SMALLEST); i++) {
    SbSolid mesh;
    *coarse = !in_process(&mesh, body, SMALLEST[i]);
    *solid = *coarse || equal(solid, &mesh) ? *solid : mesh;
  }
  return true;
}

int *sb_cad_cut(size_t *count, double *volume, bool *failed, int body, const double box[6]) {
  const double size = 2 * hypot(fmax(fabs(box[1]), fabs(box[4])), fmax(fabs(box[2]), fabs(box[5])));
  const double margin = 0.1 * (box[3] - box[0]) + 0.1;
  int ierr, object[2] = {3, body}, tool[2] = {2, -1}, *all = NULL, **map = NULL;
  size_t n = 0, *map_n = NULL, maps = 0;
  *count = 0;
  *volume = 0;
  tool[1] = gmshModelOccAddRectangle(box[0] - margin, 0, 0, box[3] - box[0] + 2 * margin, size + 1,
                                     -1, 0, &ierr);
  if (ierr == 0) {
    gmshModelOccIntersect(object, 2, tool, 2, &all, &n, &map, &map_n, &maps, -1, 0, 1, &ierr);
  }
  *failed = ierr != 0;
  for (size_t i = 0; i + 1 < n; i += 2) {
    double area = 0, at[3] = {0};
    if (all[i] == 2) {
      gmshModelOccGetMass(2, all[i + 1], &area, &ierr);
      gmshModelOccGetCenterOfMass(2, all[i + 1], &at[0], &at[1], &at[2], &ierr);
      *volume += 2 * M_PI * area * at[1];
      all[(*count)++] = all[i + 1];
    }
  }
  for (size_t i = 0; i < maps; i++) {
    gmshFree(map[i]);
  }
  gmshFree(map);
  gmshFree(map_n);
  return all;
}

// A solved ring for other programs: mesh and fields as VTU (ParaView), the same problem as an input
// file of CalculiX, free and deformed section as DXF, free or deformed ring as STL.
//
// .vtu: the deformed six-node triangles, x axial, y radial [m], with displacement [m], stresses and
// boundary pressure [Pa] at the nodes. .dxf: polylines in millimetres, x axial, y radial, on the
// layers FREE and DEFORMED (closed), FLOOR and BORE (open lines; a gasket has no FLOOR).
// .stl: text, millimetres, x axial, the deformed section revolved in 72 steps with the corners on
// the surface; .free.stl: the same with the free section.
// .inp (CalculiX, millimetres, newtons, megapascals): a wedge of two degrees, so that forces are
// those of 1/180 of the ring. It has the free mesh, the rubber, groove and bore as rigid rings that
// move to their positions, and the fluid's pressure on the faces that this program found wetted. A
// dry ring that is compressed by at most a fifth is moved from the free state to its position.
// Otherwise the calculation starts from the equilibrium that this program found: a dry ring without
// supports, a ring under fluid with weak springs from the boundary to its equilibrium position,
// whose force CalculiX prints. Rings without friction only.
#pragma once

#include "app/base/error.h"
#include "engine/contact/fit.h"

// Returns whether sb_cae_text() can write `path` for `problem`. Returns false with
// SB_APP_ERROR_INPUT if the ending of `path` is not .vtu, .inp, .dxf, .stl or .free.stl; if the
// model is not SB_FIT_RING; as .inp also with friction, for a groove with draft, rounded or
// chamfered edges or a form of its own, and for a gasket.
bool sb_cae_check(const char *path, const SbFitProblem *problem, GError **error);

// Returns the content of the file `path` (only its ending is used; nothing is written) for `ring`,
// the converged solution of `problem`. `path` and `problem` have passed sb_cae_check().
char *sb_cae_text(const char *path, const SbRing *ring, const SbFitProblem *problem);

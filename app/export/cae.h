// A solved ring for other programs: mesh and fields as VTU (ParaView), the same problem as an input
// file of CalculiX, free and deformed section as DXF, free or deformed ring as STL.
//
// VTU: the deformed six-node triangles, x axial, y radial [m], with displacement [m], stresses and
// contact pressure [Pa] at the nodes. DXF: closed polylines in millimetres, x axial, y radial, on
// the layers FREE, DEFORMED, FLOOR, BORE. STL: text, millimetres, x axial, turned in 72 steps whose
// corners lie on the deformed ring (.stl) or the free one (.free.stl). CalculiX: the free mesh,
// rubber, groove and bore as rigid rings that move to their places, the fluid on the faces that we
// found wetted; millimetres, newtons, megapascals. It turns a section into a wedge of two degrees:
// forces are those of the 180th part of the ring. Squeezed by a fifth at most and dry it goes from
// the free ring to its place; else it starts at the balance that we found, which CalculiX then
// seeks by itself: dry with nothing that holds the ring, under fluid with weak springs from the
// boundary to where we found it, whose force it prints. Rings without friction only.
#pragma once

#include "app/base/error.h"
#include "engine/contact/fit.h"

// Whether a path has an ending that is written (.vtu, .inp, .dxf or .stl) and such a fitment can
// be: a solved ring, as .inp one without friction.
bool sb_cae_check(const char *path, const SbFitProblem *problem, GError **error);

// The text of such a file for a solved fitment; free it.
char *sb_cae_text(const char *path, const SbRing *ring, const SbFitProblem *problem);

// What solid.c and solid_mesh.c share. Private to this folder.
#pragma once

#include "engine/mechanism/solid.h"

// Fills solid->principal from solid->inertia.
void sb_solid_principal(SbSolid *solid);

// A valve whose stem slides through two gaskets that the body clamps.
//
// The stem gasket (SB_OUTER) parts chamber and open air, the chamber gasket (SB_INNER) canister and
// chamber. At rest the stem's neck stands in the chamber gasket, which touches nothing: the chamber
// fills past it. On the in-stroke the shoulder behind the neck meets that gasket's contact at
// bore.land_edge and both gaskets close on the full chamber; then the stem's side port passes the
// stem gasket and the chamber empties through it. The way back is the same in reverse but that the
// chamber stays empty until the neck opens it to the canister. Stages: C the chamber is shut, D the
// dose, at the stop; F the chamber gasket opens.
//
// Lengths: a gasket's section_diameter is its radial extent, inner_diameter its free bore; the
// model's bore_diameter is the stem's, on which the contacts lie, axial_width the room between the
// plates. bore.diameter bounds the chamber outwards and stem.seal_spacing parts the gaskets.
// Leaves out: what the port's hole takes off the contact that it passes, the neck's taper, and that
// chamber gasket and stem gasket may differ.
#pragma once

#include "engine/valve/model.h"

// What the gaskets' sizes make of rings', gland's and bore's; before temperature.
void sb_gasket_take(SbModel *model);

// Sizes that follow, of a seal whose storage is known; those that only rings have are NaN.
void sb_gasket_derive(SbSealModel *seal, const SbModel *model);

// Sizes that make no valve.
void sb_gasket_check(const SbModel *model, SbProblems *problems);

// The chamber between the gaskets [m3], and the way past the neck into it [m2].
double sb_gasket_volume(const SbModel *model);
double sb_gasket_neck(const SbModel *model);

// Displacement of the stem at which the edge of its side port leaves the stem gasket's contact [m].
double sb_gasket_port_opens(const SbModel *model);

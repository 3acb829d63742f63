// A valve whose stem slides through two gaskets that are clamped in the body.
//
// The stem gasket (SB_OUTER) separates chamber and ambient, the chamber gasket (SB_INNER) canister
// and chamber. At rest the stem's neck is in the chamber gasket without contact, and the chamber
// fills through this gap. On the in-stroke the shoulder reaches the chamber gasket at
// bore.land_edge, and both gaskets close the full chamber. Then the stem's side port passes the
// stem gasket and the chamber empties through it. On the return the chamber stays empty until the
// neck opens it to the canister. Stages: C the chamber is closed, D dose at the stop, F the chamber
// gasket opens.
//
// section_diameter is a gasket's radial extent, inner_diameter its free bore; the model's
// bore_diameter is the stem's, on which the contacts are; axial_width is the distance of the
// plates. bore.diameter is the outer diameter of the chamber, stem.seal_spacing the distance of the
// gaskets. Not modelled: loss of contact at the port, the neck's taper, different gaskets.
#pragma once

#include "engine/valve/model/model.h"

// Sets the fields of *model that describe rings, gland and bore (seal[].stored sizes, profile,
// radial_space, axial_width, bore_diameter, wall friction) from the gasket.* fields and
// stem_diameter, and switches off what only pistons have (floor friction, vent_on_return,
// refill_travel). All are sizes of new parts at 20 degC: sb_model_compile() calls this for
// valve.kind = gasket when the parameters are set, before thermal expansion and storage.
void sb_gasket_take(SbModel *model);

// Sets squeeze [1] (the crimp), stretch_inner [1] and interference [m] (stem diameter minus free
// bore) of a seal whose inner_diameter after storage is set, as is the bore_diameter of `model`;
// stretch_mean, section_fitted and gland_fill, which only rings have, are set to NaN.
void sb_gasket_derive(SbSealModel *seal, const SbModel *model);

// Adds the problems of the gaskets' sizes, and of models that gaskets do not support, to
// `problems`. Only the parameters of `model` need to be set.
void sb_gasket_check(const SbModel *model, SbProblems *problems);

// Returns the volume of the chamber between the gaskets at the temperature of use [m3]; not above 0
// if they leave no chamber. This and the next two functions need the sizes of a compiled model.
double sb_gasket_volume(const SbModel *model);

// Returns the flow area past the neck into the chamber [m2].
double sb_gasket_neck(const SbModel *model);

// Returns the stem displacement at which the edge of the side port, on the in-stroke, leaves the
// stem gasket's contact and opens the chamber to the outside [m].
double sb_gasket_port_opens(const SbModel *model);

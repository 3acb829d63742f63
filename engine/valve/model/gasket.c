// Sizes of a gasket valve; see the header.
#include "engine/valve/model/gasket.h"

#include "engine/valve/model/motion_kind.h"

#include <math.h>

// Radius of a stamped edge over the thickness. Loads of sharp edges are known by extrapolation:
// this one's is 0.1 % above on smooth plates, 0.2 % below on rough ones (tests/engine).
static const double EDGE = 0.015;

// Smallest edge radius over the radial height of the section: the solver's own limit is 0.005
// (ring_profile.c); the difference covers rounding. It acts on gaskets whose radial height exceeds
// three thicknesses.
static const double EDGE_MIN = 0.00505;

// Thickness over radial height of the sections that the solver meshes (ring_profile.c).
static const double THIN = 0.2, THICK = 5;

static double radial_height(const SbModel *model) {
  return (model->gasket_outer - model->gasket_bore) / 2;
}

void sb_gasket_take(SbModel *model) {
  const double high = radial_height(model);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    model->seal[seal].stored.section_diameter = high;
    model->seal[seal].stored.inner_diameter = model->gasket_bore;
  }
  model->profile = SB_SEAL_PROFILE_RECTANGLE;
  model->profile_axial_height = model->gasket_thickness;
  model->profile_corner_radius = fmax(EDGE * model->gasket_thickness, EDGE_MIN * high);
  // Squeeze as the storage model uses it.
  model->radial_space = (1 - model->gasket_crimp) * high;
  model->axial_width = (1 - model->gasket_crimp) * model->gasket_thickness;
  model->bore_diameter = model->stem_diameter;
  model->floor_friction = 0;
  model->wall_friction = model->gasket_friction;
  model->start_at_wall = false;
  model->vent_on_return = false;
  model->refill_travel = 0;
}

void sb_gasket_derive(SbSealModel *seal, const SbModel *model) {
  seal->squeeze = model->gasket_crimp;
  seal->stretch_inner = model->bore_diameter / seal->inner_diameter - 1;
  seal->interference = model->bore_diameter - seal->inner_diameter;
  seal->stretch_mean = seal->section_fitted = seal->gland_fill = NAN;
}

void sb_gasket_check(const SbModel *model, SbProblems *problems) {
  const double stem = model->stem_diameter, chamber = sb_model_value(model, SB_P_BORE_DIAMETER);
  if (model->gasket_outer < 1.2 * model->gasket_bore) {
    sb_model_refuse(problems, "gasket.outer_diameter", 1.2 * model->gasket_bore, NAN,
                    "leaves no gasket around its bore of %.4g mm", 1e3 * model->gasket_bore);
  }
  const double high = radial_height(model);
  if (high > 0 &&
      (model->gasket_thickness < THIN * high || model->gasket_thickness > THICK * high)) {
    sb_model_refuse(problems, "gasket.thickness", THIN * high, THICK * high,
                    "does not suit a gasket whose section is %.4g mm high radially", 1e3 * high);
  }
  if (stem < 0.5 * model->gasket_bore || stem > 1.6 * model->gasket_bore) {
    sb_model_refuse(problems, "gasket.bore_diameter", stem / 1.6, 2 * stem,
                    "no such bore fits the stem (stem.pressure_diameter %.4g mm)", 1e3 * stem);
  }
  if (chamber <= stem || chamber >= model->gasket_outer) {
    sb_model_refuse(problems, "bore.diameter", stem, model->gasket_outer,
                    "the chamber is between the stem and the rim that clamps its gaskets");
  }
  if (model->shape.seal_spacing <= model->gasket_thickness) {
    sb_model_refuse(problems, "stem.seal_spacing", model->gasket_thickness, NAN,
                    "leaves no chamber between two gaskets of %.4g mm",
                    1e3 * model->gasket_thickness);
  }
  if (model->film_history) {
    sb_model_refuse(
        problems, "models.film_time", NAN, NAN,
        "a gasket's film is computed from its edge's pressure, steady, not followed in time");
  }
  if (sb_motion_kind(model)->joints) {
    sb_model_refuse(problems, "models.motion", NAN, NAN,
                    "bodies are those of the piston valve; a gasket valve moves by quasi-static or "
                    "dynamic");
  }
}

double sb_gasket_volume(const SbModel *model) {
  const double grown = model->bore_diameter / model->stem_diameter;
  const double bore = grown * sb_model_value(model, SB_P_BORE_DIAMETER);
  return M_PI / 4 * (bore * bore - model->bore_diameter * model->bore_diameter) *
         (grown * (model->shape.seal_spacing - 2 * SB_GASKET_PLATE * model->gasket_thickness) -
          model->axial_width);
}

double sb_gasket_neck(const SbModel *model) {
  const double bore = model->seal[SB_INNER].inner_diameter;
  const double neck = fmax(0, model->bore_diameter - 2 * model->shape.chamber_depth);
  return M_PI / 4 * fmax(0, bore * bore - neck * neck);
}

double sb_gasket_port_opens(const SbModel *model) {
  return model->port_travel - model->port_diameter / 2;
}

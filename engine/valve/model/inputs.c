// The only place that maps the inputs of the rooms below the valve to the valve's inputs; params.h.
#include "engine/contact/inputs.h"
#include "engine/film/film.h"
#include "engine/fluid/fluid.h"
#include "engine/mechanism/inputs.h"
#include "engine/rubber/rubber_time.h"
#include "engine/valve/model/params.h"

#include <string.h>

static const struct {
  int from; // an input of a room
  int to;   // SbParamId, or SB_PARAM_COUNT + the index of a file
} map[] = {{SB_CONTACT_IN_SECTION_DIAMETER, SB_P_SEAL_SECTION_DIAMETER},
           {SB_CONTACT_IN_INNER_DIAMETER, SB_P_SEAL_INNER_DIAMETER},
           {SB_CONTACT_IN_MODULUS, SB_P_SEAL_MODULUS},
           {SB_CONTACT_IN_POISSON_RATIO, SB_P_SEAL_POISSON_RATIO},
           {SB_CONTACT_IN_MOONEY_SHARE, SB_P_SEAL_MOONEY_SHARE},
           {SB_CONTACT_IN_RADIAL_SPACE, SB_P_GLAND_RADIAL_SPACE},
           {SB_CONTACT_IN_GLAND_WIDTH, SB_P_GLAND_AXIAL_WIDTH},
           {SB_CONTACT_IN_WALL_DRAFT, SB_P_GLAND_DRAFT},
           {SB_CONTACT_IN_GROOVE_CORNER, SB_P_GLAND_CORNER_RADIUS},
           {SB_CONTACT_IN_GROOVE_CHAMFER, SB_P_GLAND_EDGE_CHAMFER},
           {SB_CONTACT_IN_FLOOR_FRICTION, SB_P_GLAND_FLOOR_FRICTION},
           {SB_CONTACT_IN_WALL_FRICTION, SB_P_GLAND_WALL_FRICTION},
           {SB_CONTACT_IN_BORE_DIAMETER, SB_P_BORE_DIAMETER},
           {SB_CONTACT_IN_LAND_EDGE, SB_P_BORE_LAND_EDGE},
           {SB_CONTACT_IN_LAND_DIAMETER, SB_P_STEM_PRESSURE_DIAMETER},
           {SB_CONTACT_IN_HOUSING_MODULUS, SB_P_HOUSING_MODULUS},
           {SB_CONTACT_IN_HOUSING_POISSON, SB_P_HOUSING_POISSON_RATIO},
           {SB_CONTACT_IN_PRESSURE, SB_P_CANISTER_PRESSURE},
           {SB_CONTACT_IN_DRAG, SB_P_FRICTION_LOAD_COEFFICIENT},
           {SB_CONTACT_IN_MODEL, SB_P_MODELS_FIT},
           {SB_CONTACT_IN_PROFILE, SB_P_SEAL_PROFILE},
           {SB_CONTACT_IN_DRAWING, SB_INPUT_SECTION_FILE - SB_VALVE_INPUTS},
           {SB_CONTACT_IN_AXIAL_HEIGHT, SB_P_SEAL_AXIAL_HEIGHT},
           {SB_CONTACT_IN_CORNER_RADIUS, SB_P_SEAL_CORNER_RADIUS},
           {SB_CONTACT_IN_VALLEY_DEPTH, SB_P_SEAL_VALLEY_DEPTH},
           {SB_CONTACT_IN_WEB_WIDTH, SB_P_SEAL_WEB_WIDTH},
           {SB_CONTACT_IN_FLANGE_HEIGHT, SB_P_SEAL_FLANGE_HEIGHT},
           {SB_CONTACT_IN_LIP_THICKNESS, SB_P_SEAL_LIP_THICKNESS},
           {SB_CONTACT_IN_LIP_DEPTH, SB_P_SEAL_LIP_DEPTH},
           {SB_CONTACT_IN_LIP_FLARE, SB_P_SEAL_LIP_FLARE},
           {SB_CONTACT_IN_CRIMP, SB_P_GASKET_CRIMP},
           {SB_CONTACT_IN_GASKET_BORE, SB_P_GASKET_BORE_DIAMETER},
           {SB_CONTACT_IN_ASPERITY_PRODUCT, SB_P_SURFACE_GT_PRODUCT},
           {SB_CONTACT_IN_WORK_OF_ADHESION, SB_P_SURFACE_WORK_OF_ADHESION},
           {SB_FILM_IN_SPEED, SB_P_DRIVE_SPEED},
           {SB_FILM_IN_RADIUS, SB_P_SEAL_SECTION_DIAMETER},
           {SB_FILM_IN_MODULUS, SB_P_SEAL_MODULUS},
           {SB_FILM_IN_VISCOSITY, SB_P_FLUID_VISCOSITY},
           {SB_FILM_IN_PRESSURE, SB_P_CANISTER_PRESSURE},
           {SB_FILM_IN_PRESSURE_VISCOSITY, SB_P_FLUID_PRESSURE_VISCOSITY},
           {SB_FILM_IN_EYRING_STRESS, SB_P_FLUID_EYRING_STRESS},
           {SB_FILM_IN_RUPTURE_PRESSURE, SB_P_FLUID_RUPTURE_PRESSURE},
           {SB_FILM_IN_ASPERITY_PRODUCT, SB_P_SURFACE_GT_PRODUCT},
           {SB_FILM_IN_SIGMA, SB_P_SURFACE_SIGMA},
           {SB_FILM_IN_SIGMA_OVER_BETA, SB_P_SURFACE_SIGMA_OVER_BETA},
           {SB_FILM_IN_HAMAKER, SB_P_SURFACE_HAMAKER_CONSTANT},
           {SB_FILM_IN_WORK_OF_ADHESION, SB_P_SURFACE_WORK_OF_ADHESION},
           {SB_FILM_IN_SHEAR_STRENGTH, SB_P_FRICTION_SHEAR_STRENGTH},
           {SB_FILM_IN_LOAD_COEFFICIENT, SB_P_FRICTION_LOAD_COEFFICIENT},
           {SB_FILM_IN_INLET, SB_P_MODELS_INLET},
           {SB_FILM_IN_MODEL, SB_P_MODELS_FILM},
           {SB_RUBBER_IN_RING, SB_P_SEAL_SECTION_DIAMETER},
           {SB_RUBBER_IN_STORAGE_TIME, SB_P_STORAGE_TIME},
           {SB_RUBBER_IN_TEMPERATURE, SB_P_STORAGE_TEMPERATURE},
           {SB_RUBBER_IN_USE_TEMPERATURE, SB_P_CANISTER_TEMPERATURE},
           {SB_RUBBER_IN_GLASS_TEMPERATURE, SB_P_RUBBER_GLASS_TEMPERATURE},
           {SB_RUBBER_IN_MODULUS_SLOPE, SB_P_RUBBER_MODULUS_SLOPE},
           {SB_RUBBER_IN_NETWORK, SB_P_RUBBER_NETWORK_RATE},
           {SB_RUBBER_IN_SWELL, SB_P_RUBBER_SWELL_MASS},
           {SB_RUBBER_IN_SWELL_MODULUS, SB_P_RUBBER_SWELL_MODULUS},
           {SB_RUBBER_IN_RELAXATION, SB_P_RUBBER_RELAXATION_SHARE_1},
           {SB_FLUID_IN_TEMPERATURE, SB_P_CANISTER_TEMPERATURE},
           {SB_FLUID_IN_NAME, SB_P_FLUID_NAME},
           {SB_MECHANISM_IN_PRESSURE, SB_P_CANISTER_PRESSURE},
           {SB_MECHANISM_IN_STATIC_RATIO, SB_P_FRICTION_STATIC_RATIO},
           {SB_MECHANISM_IN_DRIVE, SB_P_DRIVE_STIFFNESS}};

#define FILE_AT(input) [(input)-SB_INPUT_SECTION_FILE]
static const char *const file[] = {FILE_AT(SB_INPUT_SECTION_FILE) = "seal.profile_file",
                                   FILE_AT(SB_INPUT_GROOVE_FILE) = "gland.profile_file",
                                   FILE_AT(SB_INPUT_DRIVE_FILE) = "drive.file",
                                   FILE_AT(SB_INPUT_SHELF_FILE) = "shelf.file"};
#undef FILE_AT
_Static_assert(sizeof file / sizeof file[0] == SB_INPUT_END - SB_INPUT_SECTION_FILE, "files");

int sb_input_resolve(int input) {
  for (size_t i = 0; i < sizeof map / sizeof map[0]; i++) {
    if (map[i].from == input) {
      return SB_VALVE_INPUTS + map[i].to;
    }
  }
  return input;
}

int sb_input_parameter(int input) {
  const int id = sb_input_resolve(input) - SB_VALVE_INPUTS;
  return id >= 0 && id < SB_PARAM_COUNT ? id : -1;
}

const char *sb_input_key(int input) {
  const int id = sb_input_parameter(input), at = sb_input_resolve(input) - SB_INPUT_SECTION_FILE;
  return id >= 0                                                ? sb_param((SbParamId)id)->key
         : at >= 0 && at < SB_INPUT_END - SB_INPUT_SECTION_FILE ? file[at]
                                                                : "";
}

int sb_input_find(const char *key) {
  for (int input = SB_VALVE_INPUTS; input < SB_INPUT_END; input++) {
    if (strcmp(sb_input_key(input), key) == 0) {
      return input;
    }
  }
  return 0;
}

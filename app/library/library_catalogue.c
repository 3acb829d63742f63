// The catalogues of the installed interface (include/sealbench.h): parameters, figures, quantities
// of frames, and the version.
#define _GNU_SOURCE // dladdr()
#include "app/library/library_private.h"

#include "app/document/shipped.h"

#include <dlfcn.h>
#include <gsl/gsl_errno.h>
#include <pthread.h>
#include <stddef.h>
#include <string.h>

// ---- What one frame has ----

#define FRAME(name, unit, member)                                                                  \
  { {name, unit}, offsetof(SbFrame, member), sizeof((SbFrame){0}.member) == sizeof(float) }
#define SEAL(which, name, unit, member) FRAME("seals." which "." name, unit, member)
#define SEAL_QUANTITIES(which, index)                                                              \
  SEAL(which, "contact_left_m", "m", seal[index].contact_left),                                    \
      SEAL(which, "contact_right_m", "m", seal[index].contact_right),                              \
      SEAL(which, "land_share", "1", seal[index].land_fraction),                                   \
      SEAL(which, "pressure_left_Pa", "Pa", seal[index].pressure_left),                            \
      SEAL(which, "pressure_right_Pa", "Pa", seal[index].pressure_right),                          \
      SEAL(which, "load_N", "N", seal[index].load),                                                \
      SEAL(which, "pressure_peak_Pa", "Pa", seal[index].pressure_peak),                            \
      SEAL(which, "film_min_m", "m", seal[index].film_min),                                        \
      SEAL(which, "film_central_m", "m", seal[index].film_central),                                \
      SEAL(which, "lambda", "1", seal[index].lambda),                                              \
      SEAL(which, "friction_boundary_N", "N", seal[index].friction_boundary),                      \
      SEAL(which, "friction_viscous_N", "N", seal[index].friction_viscous),                        \
      SEAL(which, "friction_N", "N", seal[index].friction)

static const SbFrameQuantity quantities[] = {
    FRAME("time_s", "s", time),
    FRAME("displacement_m", "m", displacement),
    FRAME("velocity_m_per_s", "m/s", velocity),
    FRAME("platen_m", "m", platen),
    FRAME("force_N", "N", force),
    FRAME("pressure_force_N", "N", pressure_force),
    FRAME("stop_force_N", "N", stop_force),
    FRAME("spring_force_N", "N", spring_force),
    FRAME("chamber_pressure_Pa", "Pa", chamber_pressure),
    SEAL_QUANTITIES("outer", SB_OUTER),
    SEAL_QUANTITIES("inner", SB_INNER),
};

// ---- Catalogues, filled once ----

static SbParameterInfo parameter_infos[SB_PARAM_COUNT];
static SbFigureInfo figure_infos[SB_FIGURE_COUNT];
static SbFigureInfo quantity_infos[G_N_ELEMENTS(quantities)];
static pthread_once_t once = PTHREAD_ONCE_INIT;

locale_t sb_catalogue_locale;

void sb_catalogue_restore_locale(locale_t *before) {
  (void)uselocale(*before);
}

static void set_up(void) {
  sb_catalogue_locale = newlocale(LC_ALL_MASK, "C.UTF-8", (locale_t)0);
  if (sb_catalogue_locale == (locale_t)0) {
    sb_catalogue_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  }
  // A special function outside its domain must not end the program; the engine checks results.
  gsl_set_error_handler_off();
  // Shipped files are found from the library, as the program is the caller's.
  Dl_info library;
  if (dladdr(&once, &library) != 0) {
    sb_shipped_set_library(library.dli_fname);
  }
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    parameter_infos[i] =
        (SbParameterInfo){param->key,   param->symbol, param->si,  param->unit, param->choices,
                          param->label, param->help,   param->min, param->max,  param->fallback};
  }
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    figure_infos[i] = (SbFigureInfo){sb_figure(i)->path, sb_figure(i)->si};
  }
  for (size_t i = 0; i < G_N_ELEMENTS(quantities); i++) {
    quantity_infos[i] = quantities[i].info;
  }
}

void sb_catalogue_set_up(void) {
  pthread_once(&once, set_up);
}

const char *sb_library_version(void) {
  return sb_version();
}

const char *sb_library_source(void) {
  return sb_engine_identity()->source;
}

const SbParameterInfo *sb_list_parameters(size_t *count) {
  sb_catalogue_set_up();
  *count = SB_PARAM_COUNT;
  return parameter_infos;
}

const SbFigureInfo *sb_list_figures(size_t *count) {
  sb_catalogue_set_up();
  *count = SB_FIGURE_COUNT;
  return figure_infos;
}

const SbFigureInfo *sb_list_quantities(size_t *count) {
  sb_catalogue_set_up();
  *count = G_N_ELEMENTS(quantities);
  return quantity_infos;
}

const SbFrameQuantity *sb_catalogue_quantity(const char *key) {
  for (size_t q = 0; q < G_N_ELEMENTS(quantities); q++) {
    if (strcmp(quantities[q].info.key, key) == 0) {
      return &quantities[q];
    }
  }
  return NULL;
}

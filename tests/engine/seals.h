// The outer seal of the thesis' valve, as a problem of every contact model and as a ring.
#pragma once

#include "engine/contact/fit.h"
#include "engine/contact/ring/ring.h"
#include "engine/valve/model/params.h"

#include <glib.h>

static const SbRingBody BODY = {.section_diameter = 1.61e-3,
                                .inner_diameter = 2.84e-3,
                                .modulus = 2.5e6,
                                .poisson_ratio = 0.49};

// Tables 7.1 and section 7.2.1, unpressurised.
static inline SbFitProblem thesis(SbFitModel model) {
  return (SbFitProblem){
      .model = model,
      .section_diameter = 1.61e-3,
      .inner_diameter = 2.84e-3,
      .modulus = 2.5e6,
      .poisson_ratio = 0.49,
      .housing_modulus = 2.6e9,
      .housing_poisson = 0.35,
      .radial_space = 1.36e-3,
      .bore_diameter = 6.0e-3,
      .gland_width = 2.0e-3,
  };
}

// The linear disc in it as a ring without stretch, so that its section is the disc; the pressure on
// its left.
static inline SbFitProblem unstretched(double diameter, double squeeze, double pressure) {
  SbFitProblem problem = thesis(SB_FIT_DISC);
  problem.section_diameter = diameter;
  problem.inner_diameter = 3.03e-3;
  problem.radial_space = diameter * (1.0 - squeeze);
  problem.bore_diameter = problem.inner_diameter + diameter + problem.radial_space;
  problem.gland_width = 2.0 * diameter;
  problem.housing_modulus = problem.housing_poisson = 0.0;
  problem.pressure = pressure;
  return problem;
}

// Between its bore and its floor, without walls.
static inline SbRingLoad open_groove(void) {
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.floor_radius = 1.64e-3;
  load.bore_radius = 3e-3;
  return load;
}

static inline SbRingLoad groove(double pressure) {
  SbRingLoad load = open_groove();
  load.wall_left = -1e-3;
  load.wall_right = 1e-3;
  load.pressure_left = pressure;
  return load;
}

// A fitted ring of elements of `size`; fails the test otherwise.
static inline SbRing *fitted(const SbRingBody *body, const SbRingLoad *load, double size) {
  SbRing *ring = NULL;
  SbReport report = {0};
  SbRingOptions options = {.element_size = size, .fit_mesh = true};
  SbStatus status = sb_ring_create(&ring, body, load, &options, &report);
  if (status != SB_OK) {
    g_test_message("%s", report.text);
  }
  g_assert_cmpint(status, ==, SB_OK);
  return ring;
}

// All drawing data of a ring; free with fields_free.
static inline SbRingFields fields_of(const SbRing *ring, int *nodes, int *triangles, int *outline) {
  sb_ring_sizes(ring, nodes, triangles, outline);
  SbRingFields fields = {
      .place = g_new(double, 2 * *nodes),
      .displacement = g_new(double, 2 * *nodes),
      .mises = g_new(double, *nodes),
      .hydrostatic = g_new(double, *nodes),
      .shear = g_new(double, *nodes),
      .contact = g_new(double, *nodes),
      .triangle = g_new(int, 3 * *triangles),
      .outline = g_new(int, *outline),
  };
  sb_ring_fields(ring, &fields);
  return fields;
}

static inline void fields_free(const SbRingFields *fields) {
  void *owned[] = {fields->place, fields->displacement, fields->mises,    fields->hydrostatic,
                   fields->shear, fields->contact,      fields->triangle, fields->outline};
  for (size_t i = 0; i < G_N_ELEMENTS(owned); i++) {
    g_free(owned[i]);
  }
}

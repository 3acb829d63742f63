// Meshes and starting guesses of the film solver, laid out by the inlet and outlet layers (private
// to engine/film). Everything is scaled and in the flow frame: inlet left, X = x / b.
#pragma once

#include "engine/contact/compliance.h"
#include "engine/film/ehl_mesh.h"

// How the film ends.
typedef enum {
  SB_EHL_RUPTURE, // breaks at the end of the mesh, p = 0 and p' = 0 there
  SB_EHL_FULL,    // flooded outlet under pressure
  SB_EHL_REFORM   // breaks, and forms again at `reform` before the flooded outlet
} SbEhlEnd;

// What fixes a mesh.
typedef struct {
  double lambda;
  double inlet, outlet; // end pressures over the rupture pressure, scaled
  double starvation;    // flux over the flooded flux, 1 when flooded
  double meniscus;      // where the film begins; -infinity when flooded
  double reform;        // where it forms again
  SbEhlEnd end;
  int degree;
  int steps[2]; // elements between a layer and the middle, -1 to choose them
  // Of a fitted body (scale.h), zero on a half-plane: middle of the contact, rest of its dry
  // pressure.
  double middle;
  double bow[SB_COMPLIANCE_PRESSURES];
} SbEhlLayers;

// Flux film (h where dp/dx = 0) of a flooded contact, scaled, to a few per cent.
double sb_ehl_layers_flux(const SbEhlLayers *layers);

// Width of the inlet layer, about lambda^0.4.
double sb_ehl_layers_width(const SbEhlLayers *layers);

// Width of the outlet layer, at most that of the inlet.
double sb_ehl_layers_outlet_width(const SbEhlLayers *layers);

// Length that a thick film lives on, that of the rigid wedge between the end pressures; 0 where the
// film is thin.
double sb_ehl_layers_wedge(const SbEhlLayers *layers);

// That, or the width of a thin film's inlet layer.
double sb_ehl_layers_length(const SbEhlLayers *layers);

// Slope factor of the dry pressure at the inlet edge: 1 for Hertz's.
double sb_ehl_layers_inlet_slope(const SbEhlLayers *layers);

// Pressure of the dry contact at X, the end pressures outside it.
double sb_ehl_layers_dry_pressure(const SbEhlLayers *layers, double X);

// Dry gap of Hertz's contact, with the bend that unequal end pressures add outside it.
double sb_ehl_layers_dry_gap(const SbEhlLayers *layers, double X);

// Builds the mesh. Returns false if it does not fit.
SB_CHECKED bool sb_ehl_layers_mesh(SbEhlMesh *mesh, SbEhlTables *tables, const SbEhlLayers *layers);

// Pressure and film of the joined layers of a thin film at X.
void sb_ehl_layers_shape(double *pressure, double *film, const SbEhlLayers *layers, double flux,
                         double X);

// Fills nodal pressures, gaps at all targets, and the shift and flux of a cold start.
void sb_ehl_layers_guess(double *nodal, double *gap, double *shift, double *flux,
                         const SbEhlMesh *mesh, SbEhlTables *tables, const SbEhlLayers *layers);

// Pressure that a film formed again at X gains until infinity, by Reynolds' equation on the dry
// gap.
double sb_ehl_layers_gain(const SbEhlLayers *layers, double flux, double X);

// Where the film forms again, by that measure.
double sb_ehl_layers_reform(const SbEhlLayers *layers, double flux);

// Starting pressure and gap of the elements behind the cavity.
void sb_ehl_layers_fill_reformed(double *nodal, double *gap, const SbEhlMesh *mesh,
                                 SbEhlTables *tables, const SbEhlLayers *layers, double flux);

// Shared by the panels (profiles.c), the charts of the pressure (profiles_pressure.c) and those of
// the film (profiles_film.c).
#pragma once

#include "app/chart/contact_curve.h"
#include "app/chart/profiles.h"
#include "app/draw/axis.h"

// The chart of one seal in a panel.
typedef struct {
  SbCanvas *canvas;        // borrowed
  SbAxes at;               // position in the seal's frame [mm]; pressure [MPa] or film [m]
  SbLabels *labels;        // borrowed
  const SbChartData *data; // borrowed
  const SbSealFrame *seal; // NULL: no frame at all
  int index;               // SB_OUTER, SB_INNER
  bool *band_named;        // set when the band below the continuum limit has its label
  SbRole role;             // colour of the seal
} SbProfileChart;

// Writes a figure of the seal at this instant to out[SB_FORMAT_MAX], with the unit, the digits and
// the error of the run's figure seals.SEAL.`name` ("film_min_m").
void sb_profile_figure(char *out, const SbProfileChart *s, const char *name, double value);

// Returns the style of the seal's figures.
SbTextStyle sb_profile_style(const SbProfileChart *s);

// Returns the *count pixels of the pressure of `seal` from one end of its contact to the other;
// ends of a solved film are where the pressure is that of the fluid. `seal`, which is in contact,
// and `curve` may be of another run than the chart's. Freed by g_free(); two more points have room.
SbPoint *sb_profile_pressure_points(const SbProfileChart *s, const SbContactCurve *curve,
                                    const SbSealFrame *seal, size_t *count);

// Returns the *count pixels (may be 0) of the film of `seal`, without points where there is no
// film. `seal` and `curve` as in sb_profile_pressure_points(). Freed by g_free().
SbPoint *sb_profile_film_points(const SbProfileChart *s, const SbContactCurve *curve,
                                const SbSealFrame *seal, size_t *count);

// Draws the pressure of the seal with its labels.
void sb_profile_pressure(SbProfileChart *s);

// Draws the film of the seal with its labels.
void sb_profile_film(SbProfileChart *s);

// Draws a band where a film is thinner than a few molecules.
void sb_profile_continuum(SbProfileChart *s);

// Shared by the charts (propellants.c) and the cards (propellants_cards.c) of the page Propellants.
// `k` and `propellant` are 0 to SB_PROPELLANTS - 1. Panels 0 to SB_PROPELLANTS_CHARTS - 1 of the
// study are the charts.
#pragma once

#include "app/base/format.h"
#include "app/chart/propellants.h"

#include <glib.h>

// 0 degC [K].
#define ZERO 273.15

// Whether the stem returns.
typedef enum {
  SB_PROPELLANT_UNKNOWN, // the return force is not known
  SB_PROPELLANT_STUCK,   // it is not above 0
  SB_PROPELLANT_WEAKLY,  // it is below sb_propellants_weak_below()
  SB_PROPELLANT_RETURNS
} SbPropellantsAnswer;

// Returns a propellant's curve in a panel of the study; NULL: none, or no such panel.
const SbStudySeries *sb_propellants_series(const SbStudy *study, int panel, int propellant);

// Returns the value of a curve (NULL: none) at T [K], linear between its points; NaN: none.
double sb_propellants_value(const SbStudySeries *series, double T);

// Returns the lowest temperature [K] at which a curve (NULL: none) rises through the value `level`;
// NaN: nowhere.
double sb_propellants_rises(const SbStudySeries *series, double level);

// Returns the return force below which a return is weak [N]: the scene's limit, else 2 N.
double sb_propellants_weak_below(const SbStudy *study);

// Returns the answer for a return force [N]; NaN: unknown.
SbPropellantsAnswer sb_propellants_answer(const SbStudy *study, double force);

// Returns the role of the colour of an answer.
SbRole sb_propellants_role(SbPropellantsAnswer answer);

// Writes a force of a panel [N] to out[SB_FORMAT_MAX] as its figure of a run is printed, with the
// digits that the error of the study supports; a dash for NaN. Returns `out`.
const char *sb_propellants_force(char *out, const SbStudy *study, int panel, double force);

// Writes the temperature T [K] in degrees Celsius to out[SB_FORMAT_MAX], with a tenth only if it is
// not 0. Returns `out`.
const char *sb_propellants_degrees(char *out, double T);

// Returns a text on the modulus at T [K] compared with that at 20 °C, and the origin of this value.
char *sb_propellants_modulus(const SbModel *model, double T);

// Draws a piece of the line of propellant k, `width` px long, from the pixel (x, y) to the right.
void sb_propellants_sample(SbCanvas *c, int k, double x, double y, double width);

// Draws the card of propellant k, which is not hidden, into layout->card[k].
void sb_propellants_card(SbCanvas *c, const SbPropellantsLayout *layout, const SbStudy *study,
                         const SbModel *model, const SbPropellantsLook *look, int k);

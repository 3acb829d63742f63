// What the swap page's charts (propellants.c) and cards (propellants_cards.c) share.
#pragma once

#include "app/base/format.h"
#include "app/chart/propellants.h"

#include <glib.h>

// 0 degC [K].
#define ZERO 273.15

typedef enum {
  SB_PROPELLANT_UNKNOWN,
  SB_PROPELLANT_STUCK,
  SB_PROPELLANT_WEAKLY,
  SB_PROPELLANT_RETURNS
} SbPropellantsAnswer;

// A propellant's curve in a panel, NULL: there is none; its value at T; where it rises through a
// level, NAN: nowhere.
const SbStudySeries *sb_propellants_series(const SbStudy *study, int panel, int propellant);
double sb_propellants_value(const SbStudySeries *series, double T);
double sb_propellants_rises(const SbStudySeries *series, double level);

// Below this a return is weak [N]: the scene's limit, or 2 N.
double sb_propellants_weak_below(const SbStudy *study);
SbPropellantsAnswer sb_propellants_answer(const SbStudy *study, double force);
SbRole sb_propellants_role(SbPropellantsAnswer answer);

// Both in `out`, of SB_FORMAT_MAX bytes: a force of a panel as its figure of a run is printed, with
// the digits that the error of the study supports, a dash where there is none; whole degrees
// Celsius, with a tenth where they have one.
const char *sb_propellants_force(char *out, const SbStudy *study, int panel, double force);
const char *sb_propellants_degrees(char *out, double T);

// The modulus at T [K] against that at 20 degC, and the tag of where this comes from (g_free).
char *sb_propellants_modulus(const SbModel *model, double T);

// A stretch of a propellant's line.
void sb_propellants_sample(SbCanvas *c, int k, double x, double y, double width);

void sb_propellants_card(SbCanvas *c, const SbPropellantsLayout *layout, const SbStudy *study,
                         const SbModel *model, const SbPropellantsLook *look, int k);

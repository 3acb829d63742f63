// States of fluids and of mixtures with ethanol; equations in fluid.h.
#include "engine/fluid/fluid.h"

#include "engine/base/check.h"
#include "engine/numeric/root.h"

#include <math.h>
#include <string.h>
#include <strings.h>

const SbFluidProperty sb_fluid_property[SB_FLUID_PROPERTY_COUNT] = {
#define SB_FLUID_PROPERTY_ROW(id, name, suffix, si, shown, label, origin)                          \
  {name, name suffix, label, si, shown, SB_FLUID_FROM_##origin},
    SB_FLUID_PROPERTY_LIST(SB_FLUID_PROPERTY_ROW)
#undef SB_FLUID_PROPERTY_ROW
};

const SbFluid *sb_fluid_find(const char *name, size_t length) {
  for (int i = 0; i < sb_fluid_count; i++) {
    if (strlen(sb_fluids[i].name) == length && strncasecmp(sb_fluids[i].name, name, length) == 0) {
      return &sb_fluids[i];
    }
  }
  return NULL;
}

static SbStatus check_temperature(const SbFluid *fluid, double temperature, SbReport *report) {
  const double zero = 273.15, rounding = 1e-9; // of a value converted from degrees
  if (temperature >= fluid->temperature_min - rounding &&
      temperature <= fluid->temperature_max + rounding) {
    return SB_OK;
  }
  char critical[64] = "";
  if (fluid->temperature_critical > 0.0 && temperature >= fluid->temperature_critical) {
    sb_text(critical, sizeof critical, ", above its critical temperature of %.2f °C",
            fluid->temperature_critical - zero);
  }
  return sb_fail(report, SB_ERROR_RANGE,
                 "%s at %g °C: outside the range of its figures, %g to %g °C%s", fluid->name,
                 temperature - zero, fluid->temperature_min - zero, fluid->temperature_max - zero,
                 critical);
}

static SbStatus saturated(double *value, const SbFluid *fluid, double temperature,
                          SbReport *report) {
  SbSaturation at;
  SbStatus status = sb_helmholtz_saturation(&at, fluid->equation, temperature, report);
  if (status == SB_OK && fluid->viscosity == NULL) {
    status = sb_viscosity_corresponding(&value[SB_FLUID_VISCOSITY], fluid->corresponding,
                                        fluid->equation, fluid->mass, &at.liquid_state, at.liquid,
                                        temperature, report);
  } else if (status == SB_OK) {
    value[SB_FLUID_VISCOSITY] = sb_viscosity(NULL, fluid->viscosity, at.liquid, temperature);
  }
  if (status != SB_OK) {
    return status;
  }
  value[SB_FLUID_PRESSURE] = at.pressure;
  value[SB_FLUID_LIQUID] = at.liquid * fluid->mass;
  value[SB_FLUID_VAPOUR] = at.vapour * fluid->mass;
  value[SB_FLUID_ENTHALPY] = at.enthalpy / fluid->mass;
  value[SB_FLUID_TENSION] = 0.0;
  for (size_t i = 0; i < 3 && fluid->tension[i][0] != 0.0; i++) {
    value[SB_FLUID_TENSION] +=
        fluid->tension[i][0] *
        pow(1.0 - temperature / fluid->tension_temperature, fluid->tension[i][1]);
  }
  return SB_OK;
}

static void silicone(double *value, const SbFluid *fluid, double temperature) {
  const double above = temperature - 298.15;
  value[SB_FLUID_LIQUID] = fluid->density / (1.0 + 0.95e-3 * above);
  value[SB_FLUID_VISCOSITY] =
      value[SB_FLUID_LIQUID] * fluid->grade * pow(10.0, 763.1 / (temperature - 0.15) - 2.559);
  value[SB_FLUID_TENSION] = fluid->tension_25 - 0.06e-3 * above;
}

static SbStatus pure(SbFluidState *out, SbWarnings *warnings, const SbFluid *fluid,
                     double temperature, SbReport *report) {
  *out = (SbFluidState){.temperature = temperature};
  double value[SB_FLUID_PROPERTY_COUNT];
  for (int i = 0; i < SB_FLUID_PROPERTY_COUNT; i++) {
    value[i] = NAN;
  }
  SbStatus status = check_temperature(fluid, temperature, report);
  if (status == SB_OK && fluid->equation != NULL) {
    status = saturated(value, fluid, temperature, report);
  } else if (status == SB_OK) {
    silicone(value, fluid, temperature);
  }
  if (status != SB_OK) {
    return status;
  }
  value[SB_FLUID_MASS] = fluid->mass;
  value[SB_FLUID_GWP] = fluid->gwp100;
  for (int i = 0; i < SB_FLUID_PROPERTY_COUNT; i++) {
    const char *source = fluid->source[sb_fluid_property[i].origin];
    if (isnan(value[i])) {
      source = i == SB_FLUID_GWP ? "not listed by the IPCC" : "the oil does not evaporate";
    }
    const double uncertainty = fluid->uncertainty[i];
    out->figure[i] = (SbFluidFigure){.value = value[i],
                                     .uncertainty = uncertainty != 0.0 ? fabs(uncertainty) : NAN,
                                     .source = source,
                                     .estimated = uncertainty < 0.0};
  }
  if (temperature < fluid->viscosity_min) {
    const double zero = 273.15;
    out->figure[SB_FLUID_VISCOSITY].uncertainty = NAN;
    sb_warn(warnings, "viscosity-extrapolated", SB_FLUID_IN_TEMPERATURE,
            "the viscosity of %s at %g °C is extrapolated: its correlation is valid from %g °C",
            fluid->name, temperature - zero, fluid->viscosity_min - zero);
  }
  return sb_succeed(report);
}

// A figure of a mixture, by a rule.
static SbFluidFigure by_rule(double value, const char *rule) {
  return (SbFluidFigure){.value = value, .uncertainty = NAN, .source = rule};
}

static void mix(SbFluidState *out, SbWarnings *warnings, const SbFluidState *ethanol,
                double share) {
  const double w[2] = {1.0 - share, share};
  const SbFluidState own = *out, *const part[2] = {&own, ethanol};
  double moles = 0.0, pressure = 0.0, volume = 0.0, logarithm = 0.0;
  for (int k = 0; k < 2; k++) {
    const SbFluidFigure *figure = part[k]->figure;
    const double n = w[k] / figure[SB_FLUID_MASS].value;
    moles += n;
    pressure += n * figure[SB_FLUID_PRESSURE].value;
    volume += w[k] / figure[SB_FLUID_LIQUID].value;
    logarithm += n * log(figure[SB_FLUID_VISCOSITY].value);
  }
  for (int i = 0; i < SB_FLUID_PROPERTY_COUNT; i++) {
    out->figure[i] = by_rule(NAN, "no rule for a mixture with ethanol");
  }
  out->figure[SB_FLUID_PRESSURE] = by_rule(pressure / moles, "Raoult's law");
  out->figure[SB_FLUID_LIQUID] = by_rule(1.0 / volume, "ideal volumes");
  out->figure[SB_FLUID_VISCOSITY] =
      by_rule(exp(logarithm / moles), "Grunberg and Nissan (1949), no interaction");
  out->figure[SB_FLUID_MASS] = by_rule(1.0 / moles, "mean of the liquid");
  out->figure[SB_FLUID_GWP] =
      by_rule(w[0] * own.figure[SB_FLUID_GWP].value, "the propellant's mass fraction");
  out->estimate = true;
  sb_warn(warnings, "mixture-estimate", 0,
          "mixtures with ethanol deviate from Raoult's law: the pressure is between this estimate "
          "and the propellant's own, %.4g kPa",
          1e-3 * own.figure[SB_FLUID_PRESSURE].value);
}

SbStatus sb_fluid_state(SbFluidState *out, SbWarnings *warnings, const SbFluid *fluid,
                        double temperature, double ethanol, SbReport *report) {
  if (fluid->source[SB_FLUID_FROM_EQUATION] == NULL) {
    return sb_fail_input(report, SB_ERROR_INPUT, SB_FLUID_IN_NAME,
                         "%s has no properties of its own", fluid->name);
  }
  if (ethanol != 0.0 && !fluid->propellant) {
    return sb_fail(report, SB_ERROR_INPUT, "ethanol is a cosolvent of propellants; %s is none",
                   fluid->name);
  }
  SbStatus status =
      SB_CHECK(report, {0, "the mass fraction of ethanol", ethanol, 0.0, SB_FLUID_ETHANOL_MAX});
  if (status == SB_OK) {
    status = pure(out, warnings, fluid, temperature, report);
  }
  if (status == SB_OK && ethanol > 0.0) {
    SbFluidState other;
    status =
        pure(&other, warnings, sb_fluid_find("ethanol", strlen("ethanol")), temperature, report);
    if (status == SB_OK) {
      mix(out, warnings, &other, ethanol);
    }
  }
  return status;
}

typedef struct {
  const SbHelmholtz *equation;
  double temperature, pressure;
} Vapour;

static double lacks(double density, const void *context) {
  const Vapour *v = context;
  return v->pressure - sb_helmholtz_pressure(v->equation, density, v->temperature);
}

double sb_fluid_vapour(const SbFluid *fluid, double temperature, double pressure) {
  SbSaturation at;
  if (fluid->equation == NULL || check_temperature(fluid, temperature, NULL) != SB_OK ||
      sb_helmholtz_saturation(&at, fluid->equation, temperature, NULL) != SB_OK ||
      !(pressure <= at.pressure)) {
    return NAN;
  }
  const Vapour vapour = {fluid->equation, temperature, pressure};
  return fluid->mass * sb_bisect(lacks, &vapour, 0, at.vapour);
}

// sealbench fluid: the saturated state of a named fluid.
#include "app/cli/cli.h"
#include "app/table/json.h"

#include "engine/fluid/fluid.h"

#include <math.h>
#include <string.h>

static char *state_json(const SbFluid *fluid, const SbFluidState *state, double ethanol,
                        const SbWarnings *warnings) {
  enum { SOURCES, UNCERTAINTY, UNCERTAINTY_BY, REASONS, BLOCKS };
  static const char *const names[BLOCKS] = {"sources", "uncertainty", "uncertainty_by", "reasons"};
  SbJson json;
  sb_json_document(&json);
  sb_json_string(&json, "fluid", fluid->name);
  sb_json_number(&json, "temperature_K", state->temperature);
  if (ethanol > 0) {
    sb_json_number(&json, "ethanol_mass_share", ethanol);
  }
  for (int i = 0; i < SB_FLUID_PROPERTY_COUNT; i++) {
    sb_json_number(&json, sb_fluid_property[i].key, state->figure[i].value);
  }
  sb_json_bool(&json, "estimate", state->estimate);
  for (int k = 0; k < BLOCKS; k++) {
    sb_json_object(&json, names[k]);
    for (int i = 0; i < SB_FLUID_PROPERTY_COUNT; i++) {
      const SbFluidProperty *property = &sb_fluid_property[i];
      const SbFluidFigure *figure = &state->figure[i];
      // Who states the uncertainty.
      const char *by = !isfinite(figure->uncertainty) ? NULL
                       : figure->estimated            ? "estimated here"
                                                      : "source";
      const SbTableCell cell[BLOCKS] = {[SOURCES] = sb_cell_text(figure->source),
                                        [UNCERTAINTY] = sb_cell_number(figure->uncertainty),
                                        [UNCERTAINTY_BY] = sb_cell_text(by),
                                        [REASONS] = sb_cell_text(figure->source)};
      if (isnan(figure->value) == (k == REASONS)) {
        sb_json_cell(&json, k == REASONS ? property->key : property->name, &cell[k]);
      }
    }
    sb_json_object_end(&json);
  }
  sb_json_warnings(&json, warnings);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

static const char *fluid_name(int index) {
  return sb_fluids[index].name;
}

int sb_command_fluid(int argc, char **argv) {
  char *target = NULL, *temperature_text = NULL, *ethanol_text = NULL;
  const GOptionEntry entries[] = {
      {"temperature", 0, 0, G_OPTION_ARG_FILENAME, &temperature_text, "In °C, degC or K", "T"},
      {"ethanol", 0, 0, G_OPTION_ARG_FILENAME, &ethanol_text,
       "Mass fraction of ethanol, up to 30 %: an estimate", "SHARE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, "JSON to a file or -", "FILE|-"},
      {0},
  };
  double temperature = 0, ethanol = 0;
  if (!sb_cli_parse(&argc, &argv, entries, 1, 1, "`sealbench list fluids` names the fluids.")) {
    return SB_EXIT_INPUT;
  }
  const SbFluid *fluid = sb_fluid_find(argv[1], strlen(argv[1]));
  if (fluid == NULL) {
    g_autofree char *names = sb_cli_names(fluid_name, sb_fluid_count);
    return sb_cli_unknown("there is no fluid", argv[1], names, NULL);
  }
  if (!sb_cli_quantity(&temperature, "--temperature", temperature_text, true, "K", "°C") ||
      !sb_cli_quantity(&ethanol, "--ethanol", ethanol_text, false, "1", "")) {
    return SB_EXIT_INPUT;
  }
  SbFluidState state;
  g_autofree SbWarnings *warnings = g_new0(SbWarnings, 1);
  SbReport report = {0};
  const SbStatus status = sb_fluid_state(&state, warnings, fluid, temperature, ethanol, &report);
  if (report.input == SB_FLUID_IN_NAME) {
    g_strlcat(report.text, ": set canister.pressure, fluid.viscosity and fluid.density", SB_TEXT);
  }
  int code = sb_cli_status(status, &report);
  if (status == SB_OK && target != NULL) {
    g_autofree char *json = state_json(fluid, &state, ethanol, warnings);
    code = sb_cli_emit(json, target);
  } else if (status == SB_OK && !sb_cli_quiet()) {
    printf("%s%s\n", fluid->label, fluid->equation != NULL ? ", saturated" : "");
    sb_cli_figure("Temperature", temperature, "K", "°C");
    for (int i = 0; i < SB_FLUID_PROPERTY_COUNT; i++) {
      const SbFluidProperty *property = &sb_fluid_property[i];
      sb_cli_figure(property->label, state.figure[i].value, property->si, property->shown);
    }
    sb_cli_warnings(warnings);
  }
  return code;
}

// The commands of sealbench.
#include "app/cli/cli.h"

static const SbCommand commands[] = {
    {"run", "FILE.scene...", "Computes the cycle of scenes", sb_command_run},
    {"render", "FILE.scene... -o OUT.{mp4,png,svg,pdf}", "Draws a view of scenes",
     sb_command_render},
    {"plan", "FILE.scene...", "Says what scenes would compute, and why", sb_command_plan},
    {"check", "FILE...", "Reports every problem of valves, scenes, studies, rubbers, sections and grooves", sb_command_check},
    {"fit", "FILE.valve --seal NAME", "Fits one seal into its gland", sb_command_fit},
    {"film", "--load W --speed U --radius R --modulus E --viscosity ETA",
     "Computes the film of a sliding line contact", sb_command_film},
    {"asperity", "--lambda L", "Greenwood and Tripp's integrals F2 and F5/2", sb_command_asperity},
    {"fluid", "NAME --temperature T", "Properties of a propellant, ethanol or a silicone oil",
     sb_command_fluid},
    {"sensitivity", "FILE.scene...", "Derivatives of figures by parameters, with their errors",
     sb_command_sensitivity},
    {"study", "FILE.study", "Computes figures of many valves: grids, samples, sensitivities",
     sb_command_study},
    {"calibrate", "FILE.study", "Fits parameters to measured loops, and says what those tell",
     sb_command_calibrate},
    {"compare", "FILE.scene... [--measured FILE]",
     "Sets runs side by side, and a measured loop beside them", sb_command_compare},
    {"design", "FILE.study", "Finds the best valve within bounds and limits", sb_command_design},
    {"merge", "STORE FROM...", "Joins stores of studies", sb_command_merge},
    {"surface", "SCAN", "Roughness, asperities and spectrum of a measured surface",
     sb_command_surface},
    {"cad", "FILE.{dxf,step}", "Bodies of a drawing, and a scene with the parts shaped by them",
     sb_command_cad},
    {"thesis", "[ITEM]", "Computes a table or figure of the thesis anew, beside what it prints",
     sb_command_thesis},
    {"report", "FILE.scene|FILE.study -o OUT.pdf",
     "Writes inputs, pictures, figures with their errors and the verdict as pages",
     sb_command_report},
    {"list", "params|figures|models|views|fluids|scenes|studies|valves|rubbers",
     "Lists parameters, figures, models, views, fluids, or files that ship", sb_command_list},
    {"bench", "[-o DIR]", "Measures error against time for every solver", sb_command_bench},
    {"open", "[FILE]", "Starts the window", sb_command_open},
    {"tui", "[FILE]", "Starts the workbench in a terminal", sb_command_tui},
    {NULL, NULL, NULL, NULL},
};

const SbCommand *sb_commands(void) {
  return commands;
}

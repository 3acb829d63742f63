// sealbench surface: roughness parameters of a scan.
#include "app/base/output.h"
#include "app/base/unit.h"
#include "app/cli/cli.h"
#include "app/document/shipped.h"
#include "app/export/surface.h"

#include <math.h>
#include <string.h>

typedef struct {
  char *form, *outliers, *missing, *cutoff_short, *cutoff_long;
  char *channel, *decimal, *spacing, *unit, *lateral_unit, *json, *scene, *output, *plot;
  gboolean ignore_mask;
  SbSurfaceChoices choices;
} SurfaceOptions;

// ---- Options ----

static int read_surface_options(SurfaceOptions *options) {
  const struct {
    const char *name, *text;
  } named[] = {
      {"form", options->form},
      {"missing", options->missing},
      {"outliers", options->outliers},
      {"cutoff-short", options->cutoff_short},
      {"cutoff-long", options->cutoff_long},
      {"decimal", options->decimal},
      {"spacing", options->spacing},
      {"unit", options->unit},
      {"lateral-unit", options->lateral_unit},
      {"channel", options->channel},
  };
  sb_surface_choices_init(&options->choices);
  for (size_t i = 0; i < G_N_ELEMENTS(named); i++) {
    g_autoptr(GError) error = NULL;
    if (named[i].text != NULL &&
        !sb_surface_choose(&options->choices, named[i].name, named[i].text, &error)) {
      return sb_cli_fail("--%s: %s", named[i].name, error->message);
    }
  }
  options->choices.scan.ignore_mask = options->ignore_mask;
  if ((options->scene == NULL) != (options->output == NULL)) {
    return sb_cli_fail(
        "--scene requires --output and the reverse: the scene, and the file for its copy");
  }
  if (options->plot != NULL && !sb_output_ends_in(options->plot, ".png") &&
      !sb_output_ends_in(options->plot, ".svg") && !sb_output_ends_in(options->plot, ".pdf")) {
    return sb_cli_fail("--plot: a name ending in .png, .svg or .pdf is needed");
  }
  return SB_EXIT_DONE;
}

// ---- What people read ----

static char *shown(double value, const char *si, const char *unit) {
  char digits[SB_NUMBER_SIZE];
  return isfinite(value)
             ? g_strdup(sb_number_round(digits, sb_quantity_to_shown(value, si, unit), 4))
             : g_strdup("-");
}

static char *length_text(double length, const char *none) {
  g_autofree char *number = shown(length, "m", "µm");
  return length > 0 ? g_strdup_printf("%s µm", number) : g_strdup(none);
}

static void print_origin(const SbSurface *surface) {
  const SbScan *scan = surface->scan;
  const SbHeights *h = &scan->heights;
  const SbHeightsReport *done = &surface->figures->done;
  g_autofree char *choices = sb_surface_choices_text(surface);
  g_autofree char *step = length_text(h->dx, "-");
  printf("%s%s%s%s, ", scan->format, scan->title != NULL ? " \"" : "",
         scan->title != NULL ? scan->title : "", scan->title != NULL ? "\"" : "");
  if (h->rows > 1) {
    g_autofree char *step_y = length_text(h->dy, "-");
    printf("%zu x %zu points %s x %s apart\n", h->columns, h->rows, step, step_y);
  } else {
    printf("a profile of %zu points %s apart\n", h->columns, step);
  }
  for (guint i = 0; i < scan->notes->len; i++) {
    printf("%s\n", (const char *)scan->notes->pdata[i]);
  }
  printf("%s\n", choices);
  if (done->missing + done->outliers > 0) {
    printf("%zu points missing, %zu removed, %zu filled\n", done->missing, done->outliers,
           done->filled);
  }
  if (isfinite(done->form_radius)) {
    g_autofree char *radius = shown(done->form_radius, "m", "mm");
    printf("cylinder of radius %s mm\n", radius);
  }
}

static void print_moments(const SbSurface *surface) {
  static const char *const labels[] = {"m0 / µm²", "m2", "m4 / µm⁻²"};
  static const double scale[] = {1e12, 1, 1e-12};
  const SbScanFigures *figures = surface->figures;
  printf("Moments                              by differences   by the spectrum\n");
  for (int m = 0; m < 3; m++) {
    char one[SB_NUMBER_SIZE], other[SB_NUMBER_SIZE];
    g_autofree char *text =
        g_strdup_printf("%-16s %s", sb_number_round(one, scale[m] * figures->figures.moment[m], 4),
                        sb_number_round(other, scale[m] * figures->spectrum.moment[m], 4));
    sb_cli_line(labels[m], text);
  }
}

static void print_asperities(const SbScanFigures *figures) {
  const SbAsperityFigures *columns[] = {&figures->figures.neighbours, &figures->figures.moments,
                                        &figures->scene};
  printf("Asperities                           %-16s %-16s %s\n", "by neighbours", "by moments",
         "for a scene");
  for (const SbResultRow *row = sb_surface_asperities; row->key != NULL; row++) {
    g_autofree char *label =
        g_strdup_printf("%s%s%s", row->label, *row->shown != '\0' ? " / " : "", row->shown);
    g_autoptr(GString) line = g_string_new(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(columns); i++) {
      g_autofree char *number = shown(sb_result_value(row, columns[i]), row->si, row->shown);
      g_string_append_printf(line, "%-16s ", number);
    }
    sb_cli_line(label, g_strchomp(line->str));
  }
}

static void print_spectrum(const SbHeightSpectrum *spectrum) {
  g_autofree char *roll_off = length_text(2 * M_PI / spectrum->roll_off, NULL);
  g_autofree char *cut_off = length_text(2 * M_PI / spectrum->cut_off, NULL);
  char digits[SB_NUMBER_SIZE];
  if (isnan(spectrum->hurst)) {
    sb_cli_line("Hurst exponent", "-");
    printf("    %s\n", spectrum->reason);
    return;
  }
  sb_cli_line("Hurst exponent", sb_number_round(digits, spectrum->hurst, 3));
  sb_cli_line("Roll-off, wave length", roll_off != NULL ? roll_off : "-");
  sb_cli_line("Cut-off, wave length", cut_off != NULL ? cut_off : "-");
}

static void print_scatter(const SbScanFigures *figures) {
  if (figures->part_rows == 0) {
    return;
  }
  printf("Over %d x %d parts                     mean             deviation\n",
         figures->part_columns, figures->part_rows);
  for (const SbSurfaceScatter *row = sb_surface_scatter; row->key != NULL; row++) {
    const SbScanScatter scatter = sb_scan_scatter(figures, row->value);
    g_autofree char *label =
        g_strdup_printf("%s%s%s", row->label, *row->shown != '\0' ? " / " : "", row->shown);
    g_autofree char *mean = shown(scatter.mean, row->si, row->shown);
    g_autofree char *deviation = shown(scatter.deviation, row->si, row->shown);
    g_autofree char *text = g_strdup_printf("%-16s %s", mean, deviation);
    sb_cli_line(label, text);
  }
}

static void print_cutoffs(const SbScanFigures *figures) {
  static const SbTableColumn columns[] = {
      {.layout = "  %-12s", .head = "short"}, {.layout = "%-12s", .head = "long"},
      {.layout = "%-12s", .head = "σ / µm"},  {.layout = "%-12s", .head = "ζ / mm⁻²"},
      {.layout = "%-12s", .head = "β / µm"},  {.layout = "%-12s", .head = "ζβσ"},
      {.layout = "%s", .head = "σ/β"},
  };
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int i = 0; i < figures->cutoff_count; i++) {
    const SbScanCutoff *row = &figures->cutoff[i];
    const SbAsperityFigures *a = &row->asperities;
    g_autofree char *low = length_text(row->cutoff_short, "none");
    g_autofree char *high = length_text(row->cutoff_long, "none");
    sb_table_add(table, SB_CELLS(sb_cell_text(low), sb_cell_text(high),
                                 sb_cell_quantity(1e6 * a->sigma, "1", "", 4),
                                 sb_cell_quantity(1e-6 * a->density, "1", "", 4),
                                 sb_cell_quantity(1e6 * a->radius, "1", "", 4),
                                 sb_cell_quantity(a->product, "1", "", 4),
                                 sb_cell_quantity(a->sigma_over_beta, "1", "", 4)));
  }
  printf("Cut-offs (by the spectrum)\n");
  sb_cli_table(table, NULL);
}

static void print_surface_table(const SbSurface *surface) {
  const char *reason = NULL;
  g_auto(GStrv) settings = sb_surface_settings(&reason, surface);
  print_origin(surface);
  sb_cli_rows(sb_surface_heights, &surface->figures->figures);
  print_moments(surface);
  print_asperities(surface->figures);
  print_spectrum(&surface->figures->spectrum);
  print_scatter(surface->figures);
  print_cutoffs(surface->figures);
  printf("In a scene (this surface against a smooth one)\n");
  for (char **each = settings; each != NULL && *each != NULL; each++) {
    printf("  --set '%s'\n", *each);
  }
  if (reason != NULL) {
    printf("  none: %s\n", reason);
  }
  sb_cli_warnings(&surface->figures->warnings);
}

// ---- Into a scene ----

// Lines that tell the origin of a scene's surface begin so.
#define ORIGIN "# Scan: "

// A copy of the scene with the surface and, above its keys, where that comes from. An exit code.
static int write_surface_scene(const SbSurface *surface, const SurfaceOptions *options) {
  const char *reason = NULL;
  g_auto(GStrv) settings = sb_surface_settings(&reason, surface);
  if (settings == NULL) {
    return sb_cli_fail("--scene: the surface is none for a scene: %s", reason);
  }
  SbModel *model = NULL;
  g_autoptr(SbDocument) document = sb_cli_open(&model, options->scene, settings);
  sb_model_destroy(model);
  if (document == NULL) {
    return SB_EXIT_INPUT;
  }
  g_autofree char *text = sb_document_to_text(document, options->output);
  g_autofree char *name = g_path_get_basename(surface->path);
  g_autofree char *shown_name = sb_printable(name, strlen(name));
  g_autofree char *choices = sb_surface_choices_text(surface);
  g_auto(GStrv) lines = g_strsplit(text, "\n", -1);
  g_autoptr(GString) out = g_string_new(NULL);
  for (char **line = lines; *line != NULL; line++) {
    if (g_str_has_prefix(*line, ORIGIN)) {
      continue; // of an earlier scan
    }
    g_string_append_printf(out, "%s%s", *line, line[1] != NULL ? "\n" : "");
    if (strcmp(*line, "[surface]") == 0) {
      g_string_append_printf(out, ORIGIN "%s, SHA-256 %s\n" ORIGIN "%s\n", shown_name,
                             surface->scan->sha256, choices);
    }
  }
  GError *error = NULL;
  return sb_output_write(options->output, out->str, out->len, &error) ? SB_EXIT_DONE
                                                                      : sb_cli_error(error);
}

// ---- The command ----

static int compute_surface(const char *path, SurfaceOptions *options) {
  GError *error = NULL;
  SbScan scan;
  if (!sb_scan_read(&scan, NULL, 0, &options->choices.scan, path, &error)) {
    return sb_cli_error(error);
  }
  int code =
      sb_cli_check_targets((const char *const[]){options->json, options->output, options->plot}, 3);
  if (code != SB_EXIT_DONE) {
    sb_scan_clear(&scan);
    return code;
  }
  g_autofree SbScanFigures *figures = g_new0(SbScanFigures, 1);
  SbReport report = {0}, named = {0};
  const SbStatus status =
      sb_scan_figures(figures, &scan.heights, &options->choices.heights, &report);
  sb_text(named.text, sizeof named.text, "%s: %s", path, report.text);
  code = sb_cli_status(status, &named);
  const SbSurface surface = {path, &scan, &options->choices.heights, figures};
  if (code == SB_EXIT_DONE && options->scene != NULL) {
    code = write_surface_scene(&surface, options);
  }
  if (code == SB_EXIT_DONE && options->plot != NULL &&
      !sb_surface_still(&surface, options->plot, &error)) {
    code = sb_cli_error(error);
  }
  if (code == SB_EXIT_DONE && options->json != NULL) {
    g_autofree char *json = sb_surface_json(&surface);
    code = sb_cli_emit(json, options->json);
  } else if (code == SB_EXIT_DONE && !sb_cli_quiet()) {
    print_surface_table(&surface);
  }
  sb_scan_figures_clear(figures);
  sb_scan_clear(&scan);
  return code;
}

int sb_command_surface(int argc, char **argv) {
  SurfaceOptions options = {0};
  const GOptionEntry entries[] = {
      {"form", 0, 0, G_OPTION_ARG_FILENAME, &options.form,
       "Form to remove: none, plane (default), quadratic or cylinder", "FORM"},
      {"outliers", 0, 0, G_OPTION_ARG_FILENAME, &options.outliers,
       "Leaves out points beyond so many robust deviations; default all stay", "N"},
      {"missing", 0, 0, G_OPTION_ARG_FILENAME, &options.missing,
       "Missing points: leave (default) them out, or fill them from their neighbours",
       "leave|fill"},
      {"cutoff-short", 0, 0, G_OPTION_ARG_FILENAME, &options.cutoff_short,
       "Smooths waves shorter than this away (Gaussian, ISO 16610); default none", "LENGTH"},
      {"cutoff-long", 0, 0, G_OPTION_ARG_FILENAME, &options.cutoff_long,
       "Removes waves longer than this; default none", "LENGTH"},
      {"channel", 0, 0, G_OPTION_ARG_FILENAME, &options.channel,
       "Number or title of a channel (.gwy); default the only one of heights", "NAME"},
      {"ignore-mask", 0, 0, G_OPTION_ARG_NONE, &options.ignore_mask,
       "Uses masked points as if they were measured (.gwy)", NULL},
      {"decimal", 0, 0, G_OPTION_ARG_FILENAME, &options.decimal,
       "Decimal mark of a text; default found", "point|comma"},
      {"spacing", 0, 0, G_OPTION_ARG_FILENAME, &options.spacing,
       "Distance of points, in place of the file's", "LENGTH"},
      {"unit", 0, 0, G_OPTION_ARG_FILENAME, &options.unit, "Unit of a text's heights", "UNIT"},
      {"lateral-unit", 0, 0, G_OPTION_ARG_FILENAME, &options.lateral_unit,
       "Unit of a text's lengths; default the file's, else that of heights", "UNIT"},
      {"plot", 0, 0, G_OPTION_ARG_FILENAME, &options.plot, "Map, spectrum and heights on a page",
       "FILE.{png,svg,pdf}"},
      {"scene", 0, 0, G_OPTION_ARG_FILENAME, &options.scene,
       "Scene or valve of which a copy gets the surface, with its origin", "FILE"},
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &options.output, "That copy", "FILE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json, "JSON to a file or -", "FILE|-"},
      {0},
  };
  int code = SB_EXIT_INPUT;
  if (sb_cli_parse(
          &argc, &argv, entries, 1, 1,
          "A scan is a text of heights (matrix, x z or x y z), .gwy, .sur, .sdf or .x3p.")) {
    code = read_surface_options(&options);
    if (code == SB_EXIT_DONE) {
      g_autofree char *path = sb_shipped_resolve(argv[1], SB_SHIPPED_FOR_IMPORT);
      code = compute_surface(path, &options);
    }
  }
  sb_surface_choices_clear(&options.choices);
  return code;
}

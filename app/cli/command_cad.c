// sealbench cad: bodies of a drawing, and a scene with the valve's parts shaped by them.
#include "app/base/number.h"
#include "app/base/output.h"
#include "app/chart/half_sections.h"
#include "app/cli/cli.h"
#include "app/document/cad_parts.h"
#include "app/document/shipped.h"
#include "app/export/still.h"

#include <math.h>
#include <string.h>

typedef struct {
  char *unit, *axis, *through, *angle, *join, *shift, *density, *scene, *output, *json, *plot;
  char **parts; // NAME=BODY
  gboolean flip;
  SbCadSettings settings;
} Options;

static const char *const kind_names[] = {"land", "bore", "groove"};

// ---- Options ----

static int choose(SbCadSettings *settings, const char *option, const char *name, const char *text) {
  g_autoptr(GError) error = NULL;
  return sb_cad_choose(settings, name, text, &error)
             ? SB_EXIT_DONE
             : sb_cli_fail("--%s: %s", option, error->message);
}

static int read_options(Options *options) {
  const struct {
    const char *name, *text;
  } named[] = {{"unit", options->unit},       {"axis", options->axis},
               {"through", options->through}, {"angle", options->angle},
               {"join", options->join},       {"shift", options->shift},
               {"density", options->density}, {"flip", options->flip ? "yes" : NULL}};
  for (size_t i = 0; i < G_N_ELEMENTS(named); i++) {
    if (named[i].text != NULL &&
        choose(&options->settings, named[i].name, named[i].name, named[i].text) != SB_EXIT_DONE) {
      return SB_EXIT_INPUT;
    }
  }
  for (char **each = options->parts; each != NULL && *each != NULL; each++) {
    g_auto(GStrv) sides = g_strsplit(*each, "=", 2);
    if (sides[0] == NULL || sides[1] == NULL || sb_cad_part_of(sides[0]) < 0) {
      return sb_cli_fail(
          "--part: NAME=BODY with housing, stem_centre, stem_top or stem_bottom, not "
          "'%s'",
          *each);
    }
    (void)choose(&options->settings, "part", sides[0], sides[1]);
  }
  if ((options->scene == NULL) != (options->output == NULL)) {
    return sb_cli_fail(
        "--scene requires --output and the reverse: the scene, and the file for its copy");
  }
  return SB_EXIT_DONE;
}

// ---- What people read ----

static double across(const SbSolid *solid) {
  return (solid->inertia[1][1] + solid->inertia[2][2]) / 2;
}

static void print_body(const SbCadBody *body, guint number, const int *chosen) {
  const char *part = NULL;
  for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
    part = chosen[i] == (int)number ? sb_shape_parts[i] : part;
  }
  printf("%u %s%s%s%s\n", number + 1, body->name, part != NULL ? " (" : "",
         part != NULL ? part : "", part != NULL ? ")" : "");
  char volume[SB_NUMBER_SIZE], share[SB_NUMBER_SIZE], x[3][SB_NUMBER_SIZE];
  if (body->measured || body->profile->len > 0) {
    g_autofree char *text = g_strdup_printf(
        "%s mm3, centre at %s mm", sb_number_round(volume, 1e9 * body->solid.volume, 6),
        sb_number_round(x[0], fabs(body->solid.centre[0]) < 1e-12 ? 0 : 1e3 * body->solid.centre[0],
                        5));
    sb_cli_line("Volume", text);
  }
  if (body->profile->len == 0) {
    g_autofree char *text = g_strdup_printf("none: %s", body->why);
    sb_cli_line("Half-section", text);
    return;
  }
  const double off = body->revolved.volume / body->solid.volume - 1;
  g_autofree char *section = g_strdup_printf(
      "%u points; revolved it has %s %% %s volume", body->profile->len,
      sb_number_round(share, fabs(off) < 5e-7 ? 0 : 100 * fabs(off), 3), off < 0 ? "less" : "more");
  sb_cli_line("Half-section", section);
  for (guint i = 0; i < body->features->len; i++) {
    const SbCadFeature *f = &g_array_index(body->features, SbCadFeature, i);
    char depth[SB_NUMBER_SIZE];
    g_autofree char *label =
        g_strdup_printf("%s, %s .. %s", kind_names[f->kind], sb_number_round(x[0], 1e3 * f->x0, 5),
                        sb_number_round(x[1], 1e3 * f->x1, 5));
    g_autofree char *deep =
        f->kind == SB_CAD_GROOVE
            ? g_strdup_printf(", %s deep", sb_number_round(depth, 1e3 * f->depth, 5))
            : g_strdup("");
    g_autofree char *text =
        g_strdup_printf("diameter %s mm%s", sb_number_round(x[2], 1e3 * f->diameter, 6), deep);
    sb_cli_line(label, text);
  }
}

static void print_bodies(const SbCad *cad, const int *chosen) {
  printf("%s%s%s, x on the axis %s; lengths in mm\n", cad->format, cad->unit != NULL ? " in " : "",
         cad->unit != NULL ? cad->unit : "", cad->axis);
  for (guint i = 0; i < cad->bodies->len; i++) {
    print_body(cad->bodies->pdata[i], i, chosen);
  }
  for (guint i = 0; i < cad->warnings->len; i++) {
    printf("  %s\n", (const char *)cad->warnings->pdata[i]);
  }
}

// ---- JSON ----

static char *to_cad_json(const SbCad *cad, const int *chosen) {
  SbJson json;
  sb_json_document(&json);
  sb_json_string(&json, "format", cad->format);
  sb_json_string(&json, "unit", cad->unit);
  sb_json_string(&json, "axis", cad->axis);
  sb_json_array(&json, "bodies");
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    const bool known = body->measured || body->profile->len > 0;
    const char *part = NULL;
    for (int k = 0; k < SB_CAD_PART_COUNT; k++) {
      part = chosen[k] == (int)i ? sb_shape_parts[k] : part;
    }
    g_autofree char *profile = sb_cad_profile_text(body);
    sb_json_object(&json, NULL);
    sb_json_string(&json, "name", body->name);
    sb_json_string(&json, "part", part);
    sb_json_number(&json, "volume_m3", known ? body->solid.volume : NAN);
    sb_json_number(&json, "centre_m", known ? body->solid.centre[0] : NAN);
    sb_json_number(&json, "inertia_axial_m5", known ? body->solid.inertia[0][0] : NAN);
    sb_json_number(&json, "inertia_transverse_m5", known ? across(&body->solid) : NAN);
    sb_json_number(&json, "revolved_volume_m3",
                   body->profile->len > 0 ? body->revolved.volume : NAN);
    sb_json_string(&json, "profile", profile);
    sb_json_string(&json, "profile_reason", profile != NULL ? NULL : body->why);
    sb_json_array(&json, "features");
    for (guint k = 0; k < body->features->len; k++) {
      const SbCadFeature *f = &g_array_index(body->features, SbCadFeature, k);
      sb_json_object(&json, NULL);
      sb_json_string(&json, "kind", kind_names[f->kind]);
      sb_json_number(&json, "from_m", f->x0);
      sb_json_number(&json, "to_m", f->x1);
      sb_json_number(&json, "diameter_m", f->diameter);
      sb_json_number(&json, "depth_m", f->kind == SB_CAD_GROOVE ? f->depth : NAN);
      sb_json_object_end(&json);
    }
    sb_json_array_end(&json);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  sb_json_array(&json, "left_out");
  for (guint i = 0; i < cad->warnings->len; i++) {
    sb_json_string(&json, NULL, cad->warnings->pdata[i]);
  }
  sb_json_array_end(&json);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

// ---- The command ----

static int write_scene(const SbCad *cad, const int *chosen, const char *path,
                       const Options *options) {
  SbModel *model = NULL;
  g_autoptr(SbDocument) base = sb_cli_open(&model, options->scene, NULL);
  sb_model_destroy(model);
  if (base == NULL) {
    return SB_EXIT_INPUT;
  }
  bool any = false;
  for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
    any = any || chosen[i] >= 0;
  }
  if (!any) {
    return sb_cli_fail("--scene: no body is named like a part of the valve: specify one with "
                       "--part stem_centre=1");
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) after = NULL;
  g_autofree char *text = sb_cad_scene(&after, cad, chosen, options->settings.density, base, path,
                                       options->output, issues);
  if (text == NULL) {
    sb_cli_issues(issues);
    return SB_EXIT_INPUT;
  }
  if (!sb_cli_quiet()) {
    g_autofree char *lines = sb_cad_differences(base, after);
    printf("In force → drawing\n%s", *lines != '\0' ? lines : "no value differs\n");
  }
  GError *error = NULL;
  return sb_output_write(options->output, text, strlen(text), &error) ? SB_EXIT_DONE
                                                                      : sb_cli_error(error);
}

typedef struct {
  const SbCad *cad;
  const int *chosen;
} Picture;

static void draw(cairo_t *cr, double width, double height, void *user) {
  const Picture *picture = user;
  const SbTheme *theme = sb_theme(false);
  const SbColor ground = theme->role[SB_ROLE_BACKGROUND];
  cairo_set_source_rgb(cr, ground.r, ground.g, ground.b);
  cairo_paint(cr);
  sb_half_sections_draw(cr,
                        (SbRect){SB_GRID_MARGIN, SB_GRID_MARGIN, width - 2 * SB_GRID_MARGIN,
                                 height - 2 * SB_GRID_MARGIN},
                        theme, picture->cad, picture->chosen);
}

static int compute(const char *path, const Options *options) {
  GError *error = NULL;
  g_autoptr(SbCad) cad = sb_cad_read(path, &options->settings.read, &error);
  if (cad == NULL) {
    return sb_cli_error(error);
  }
  int chosen[SB_CAD_PART_COUNT];
  if (!sb_cad_parts(chosen, cad, &options->settings, &error)) {
    return sb_cli_error(error);
  }
  int code =
      sb_cli_check_targets((const char *const[]){options->json, options->output, options->plot}, 3);
  if (code == SB_EXIT_DONE && options->plot != NULL) {
    Picture picture = {cad, chosen};
    const SbStill still = {
        .width = 1200, .height = 640, .title = "Drawing", .draw = draw, .user = &picture};
    code = sb_still_write(&still, options->plot, &error) ? SB_EXIT_DONE : sb_cli_error(error);
  }
  if (code == SB_EXIT_DONE && options->json != NULL) {
    g_autofree char *json = to_cad_json(cad, chosen);
    code = sb_cli_emit(json, options->json);
  } else if (code == SB_EXIT_DONE && !sb_cli_quiet()) {
    print_bodies(cad, chosen);
  }
  if (code == SB_EXIT_DONE && options->scene != NULL) {
    code = write_scene(cad, chosen, path, options);
  }
  return code;
}

int sb_command_cad(int argc, char **argv) {
  Options options = {0};
  sb_cad_settings_init(&options.settings);
  const GOptionEntry entries[] = {
      {"unit", 0, 0, G_OPTION_ARG_FILENAME, &options.unit,
       "Unit of a DXF; default the file's; of an STL, default guessed by its size", "UNIT"},
      {"axis", 0, 0, G_OPTION_ARG_FILENAME, &options.axis,
       "Direction of the axis; default found, in a DXF the longest centre line, else x",
       "x|y|z|X,Y,Z"},
      {"through", 0, 0, G_OPTION_ARG_FILENAME, &options.through,
       "A point of the axis, in mm unless it has a unit; default found", "X,Y,Z"},
      {"angle", 0, 0, G_OPTION_ARG_FILENAME, &options.angle,
       "Half-plane that cuts the bodies; default 37.7 deg for a STEP, a far vertex for an STL",
       "ANGLE"},
      {"join", 0, 0, G_OPTION_ARG_FILENAME, &options.join,
       "Largest gap in the outlines of a DXF that is closed; default 1um", "LENGTH"},
      {"flip", 0, 0, G_OPTION_ARG_NONE, &options.flip,
       "Reverses x, which must point out of the canister", NULL},
      {"shift", 0, 0, G_OPTION_ARG_FILENAME, &options.shift, "Added to x afterwards", "LENGTH"},
      {"part", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.parts,
       "Body (number or name) that is a part of the valve; default by names", "NAME=BODY"},
      {"density", 0, 0, G_OPTION_ARG_FILENAME, &options.density,
       "Of the parts; default 1410 kg/m3, acetal", "DENSITY"},
      {"scene", 0, 0, G_OPTION_ARG_FILENAME, &options.scene,
       "Scene or valve of which a copy gets the parts; differences are shown", "FILE"},
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &options.output, "That copy", "FILE"},
      {"plot", 0, 0, G_OPTION_ARG_FILENAME, &options.plot, "The half-sections",
       "FILE.{png,svg,pdf}"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json, "JSON to a file or -", "FILE|-"},
      {0},
  };
  int code = SB_EXIT_INPUT;
  if (sb_cli_parse(&argc, &argv, entries, 1, 1,
                   "FILE is a DXF drawing (text) of half or full sections (.dxf), a STEP file "
                   "(.step, .stp) or an "
                   "STL mesh (.stl).")) {
    code = read_options(&options);
    if (code == SB_EXIT_DONE) {
      g_autofree char *path = sb_shipped_resolve(argv[1], SB_SHIPPED_FOR_IMPORT);
      code = compute(path, &options);
    }
  }
  sb_cad_settings_clear(&options.settings);
  return code;
}

// sealbench surface: its JSON, its table, what it refuses, and the copy of a scene.
#include "tests/app/cli_fixture.h"
#include "tests/app/scan_files.h"
#include "tests/engine/random_surface.h"

#include "engine/contact/rough/height_figures.h"

#include <glib/gstdio.h>

static char *scan_path; // a random surface on a slope
static double known[3];

static char *path_of(const char *name) {
  return g_build_filename(cli.folder, name, NULL);
}

static void write_scan(void) {
  SbHeights h = random_surface(known, &(RandomSurface){960, 0.5e-6, 1e-6, 32, 96, 0.8, 2});
  for (size_t i = 0; i < h.rows * h.columns; i++) {
    h.z[i] += 5e-3 * (double)(i % h.columns) * h.dx + 1e-3;
  }
  GByteArray *bytes = write_gwy(&h, 1);
  scan_path = path_of("ring.gwy");
  g_assert_true(g_file_set_contents(scan_path, (char *)bytes->data, bytes->len, NULL));
  g_byte_array_unref(bytes);
  g_free(h.z);
}

static void assert_share(JsonNode *root, const char *path, double expected, double share) {
  const double value = cli_number(root, path);
  if (fabs(value / expected - 1) > share) {
    g_error("%s is %g, not %g", path, value, expected);
  }
}

static void test_json(void) {
  CliResult result = CLI("surface", scan_path, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  JsonNode *root = cli_parse(result.out);
  cli_has_keys(root, "sq_m sa_m ssk sku sdq summit_density_per_m2 summit_radius_m summit_sigma_m "
                     "gt_product sigma_over_beta moments.m0 moments.m2 moments.m4 "
                     "psd.wave_number_rad_per_m psd.density_m4 psd.hurst psd.roll_off_rad_per_m "
                     "asperities.neighbours.density_per_m2 asperities.moments.radius_m "
                     "asperities.scene.gt_product scatter.sigma_m.standard_deviation "
                     "cutoffs.3.gt_product choices.form sha256 warnings reasons");
  const SbAsperityFigures nayak = sb_asperities_of_moments(known, true);
  assert_share(root, "moments.m0", known[0], 0.02);
  assert_share(root, "moments.m2", known[1], 0.02);
  assert_share(root, "moments.m4", known[2], 0.02);
  assert_share(root, "summit_density_per_m2", nayak.density, 0.05);
  assert_share(root, "summit_radius_m", nayak.radius, 0.05);
  assert_share(root, "summit_sigma_m", nayak.sigma, 0.05);
  // Of the figures beside them.
  const double sigma = cli_number(root, "summit_sigma_m");
  const double radius = cli_number(root, "summit_radius_m");
  assert_share(root, "gt_product", sigma * radius * cli_number(root, "summit_density_per_m2"),
               1e-12);
  assert_share(root, "sigma_over_beta", sigma / radius, 1e-12);
  assert_share(root, "asperities.scene.sigma_m", cli_number(root, "sq_m"), 1e-12);
  json_node_unref(root);
  cli_clear(&result);

  // To a file, quietly; the scan itself is no output.
  g_autofree char *json = path_of("s.json");
  result = CLI("surface", scan_path, "--json", json, "-q");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.out, ==, "");
  g_autofree char *text = cli_contents(cli.folder, "s.json");
  json_node_unref(cli_parse(text));
  cli_clear(&result);
  result = CLI("surface", scan_path, "--json", scan_path);
  g_assert_cmpint(result.code, ==, 1);
  cli_clear(&result);
  g_assert_cmpint(g_remove(json), ==, 0);
}

static void test_table(void) {
  CliResult result = CLI("surface", scan_path, "--cutoff-long", "80um", "--form", "quadratic");
  g_assert_cmpint(result.code, ==, 0);
  static const char *const wanted[] = {
      "960 x 960 points 0.5 µm x 0.5 µm apart",
      "quadratic removed, no outliers sought, missing points left out, Gaussian long cut-off",
      "80 µm\n",
      "Sq, standard deviation",
      "by neighbours",
      "Over 3 x 3 parts",
      "--set 'surface.gt_product=0."};
  for (size_t i = 0; i < G_N_ELEMENTS(wanted); i++) {
    if (strstr(result.out, wanted[i]) == NULL) {
      g_error("no \"%s\" in\n%s", wanted[i], result.out);
    }
  }
  cli_clear(&result);
}

static void test_refused(void) {
  const struct {
    const char *arguments[6], *why;
  } cases[] = {{{"nothing.gwy"}, "nothing.gwy: "},
               {{scan_path, "--form", "sphere"}, "there is no \"sphere\""},
               {{scan_path, "--cutoff-long", "80"}, "--cutoff-long"},
               {{scan_path, "--cutoff-long", "2 um", "--cutoff-short", "3um"}, "must be below"},
               {{scan_path, "--missing", "guess"}, "there is no \"guess\" (allowed leave, fill)"},
               {{scan_path, "--outliers", "-1"}, "a value above 0"},
               {{scan_path, "--unit", "kg"}, "--unit"},
               {{scan_path, "--unit", "nm"}, "states its own units"},
               {{scan_path, "--channel", "7"}, "no channel 7"},
               {{scan_path, "--spacing", "1e-13m"}, "ring.gwy: the distance of columns"},
               {{scan_path, "--scene", "x.scene"}, "requires --output"},
               {{cli.scene}, "thesis-cycle.scene: "}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    const char *arguments[8] = {"surface"};
    memcpy(arguments + 1, cases[i].arguments, sizeof cases[i].arguments);
    CliResult result = cli_run(arguments, NULL, NULL);
    if (result.code != 1 || strstr(result.err, cases[i].why) == NULL ||
        strchr(result.err, '\n') != result.err + strlen(result.err) - 1) {
      g_error("case %zu ended with %d: %s", i, result.code, result.err);
    }
    g_assert_cmpstr(result.out, ==, "");
    cli_clear(&result);
  }
}

// A copy of the scene has the surface and says where it is from; doing it again says it once.
static void test_scene(void) {
  g_autofree char *copy = path_of("scanned.scene"), *again = path_of("again.scene");
  CliResult result = CLI("surface", scan_path, "--scene", cli.scene, "-o", copy, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  const double product = cli_number(root, "asperities.scene.gt_product");
  json_node_unref(root);
  cli_clear(&result);
  result = CLI("surface", scan_path, "--scene", copy, "-o", again, "-q");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  g_autofree char *text = cli_contents(cli.folder, "again.scene");
  g_auto(GStrv) pieces = g_strsplit(text, "# Scan: ring.gwy, SHA-256 ", -1);
  g_assert_cmpuint(g_strv_length(pieces), ==, 2);
  g_auto(GStrv) values = g_strsplit(text, "gt_product = ", -1);
  g_assert_cmpuint(g_strv_length(values), ==, 2);
  g_assert_cmpfloat_with_epsilon(g_ascii_strtod(values[1], NULL), product, 1e-6 * product);
  result = CLI("check", again);
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  g_assert_cmpint(g_remove(copy) | g_remove(again), ==, 0);
}

// The page, the same bytes each time; another ending is refused before the work.
static void test_plot(void) {
  static const char *const names[] = {"page.png", "page.svg", "page.pdf"};
  static const char *const starts[] = {"\x89PNG", "<?xml", "%PDF"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    g_autofree char *path = path_of(names[i]);
    gsize length[2] = {0};
    g_autofree char *first = NULL, *second = NULL;
    for (int k = 0; k < 2; k++) {
      CliResult result = CLI("surface", scan_path, "--plot", path, "-q");
      g_assert_cmpint(result.code, ==, 0);
      g_assert_true(g_file_get_contents(path, k == 0 ? &first : &second, &length[k], NULL));
      cli_clear(&result);
    }
    g_assert_true(g_str_has_prefix(first, starts[i]));
    g_assert_cmpmem(first, length[0], second, length[1]);
    g_assert_cmpint(g_remove(path), ==, 0);
  }
  CliResult result = CLI("surface", "nothing.gwy", "--plot", "page.gif");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_true(strstr(result.err, "--plot: a name ending in .png, .svg or .pdf") != NULL);
  cli_clear(&result);
}

// A profile: what only a surface has is null, with its reason.
static void test_profile(void) {
  g_autoptr(GString) text = g_string_new("x [um], z [nm]\n");
  for (int i = 0; i < 400; i++) {
    g_string_append_printf(text, "%d, %.3f\n", i, 100 * (sin(i / 2.0) + sin(i / 5.3)));
  }
  g_autofree char *path = path_of("profile.csv");
  g_assert_true(g_file_set_contents(path, text->str, (gssize)text->len, NULL));
  CliResult result = CLI("surface", path, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  g_assert_true(json_node_is_null(cli_at(root, "gt_product")));
  g_assert_true(json_node_is_null(cli_at(root, "summit_density_per_m2")));
  cli_has_keys(root, "reasons.gt_product reasons.summit_radius_m psd.density_m3 moments.m4");
  assert_share(root, "moments.m0", 1e-14, 0.02);
  json_node_unref(root);
  cli_clear(&result);
  g_assert_cmpint(g_remove(path), ==, 0);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  write_scan();
  g_test_add_func("/cli-surface/json", test_json);
  g_test_add_func("/cli-surface/table", test_table);
  g_test_add_func("/cli-surface/refused", test_refused);
  g_test_add_func("/cli-surface/scene", test_scene);
  g_test_add_func("/cli-surface/plot", test_plot);
  g_test_add_func("/cli-surface/profile", test_profile);
  const int code = g_test_run();
  g_assert_cmpint(g_remove(scan_path), ==, 0);
  g_free(scan_path);
  cli_tear_down();
  return code;
}

// One identity of the engine on every surface: --version, every JSON document, pictures, PDF.
#define _GNU_SOURCE // memmem
#include "tests/app/cli_fixture.h"

#include "engine/base/version.h"

#include <glib/gstdio.h>
#include <string.h>

static char *path_of(const char *name) {
  return g_build_filename(cli.folder, name, NULL);
}

static void test_version(void) {
  const SbEngineIdentity *engine = sb_engine_identity();
  CliResult result = CLI("--version");
  g_assert_cmpint(result.code, ==, 0);
  g_auto(GStrv) lines = g_strsplit(result.out, "\n", -1);
  g_assert_cmpuint(g_strv_length(lines), >, 12);
  g_autofree char *version = g_strdup_printf("sealbench %s", engine->version);
  g_autofree char *commit =
      g_strdup_printf("commit %s", engine->commit != NULL ? engine->commit : "none");
  g_autofree char *source = g_strdup_printf("source %s", engine->source);
  g_autofree char *compiler = g_strdup_printf("compiler %s", engine->options);
  g_assert_cmpstr(lines[0], ==, version);
  g_assert_cmpstr(lines[1], ==, commit);
  g_assert_cmpstr(lines[2], ==, source);
  g_assert_cmpstr(lines[3], ==, compiler);
  g_assert_true(g_str_has_prefix(lines[4], "features "));
  g_assert_nonnull(strstr(result.out, "\nSQLite "));
  g_assert_nonnull(strstr(result.out, "\nOpenBLAS "));
  g_assert_cmpstr(engine->version, ==, "0.2.0");
  g_assert_cmpuint(strlen(engine->source), ==, 64);
  g_assert_true(engine->commit == NULL || strlen(engine->commit) == 40 ||
                strlen(engine->commit) == 64);
  cli_clear(&result);
}

static void check_engine(JsonNode *document) {
  const SbEngineIdentity *engine = sb_engine_identity();
  JsonObject *block = json_node_get_object(cli_at(document, "engine"));
  g_assert_cmpuint(json_object_get_size(block), ==, 4);
  g_assert_cmpstr(json_object_get_string_member(block, "version"), ==, engine->version);
  g_assert_cmpstr(json_object_get_string_member(block, "source"), ==, engine->source);
  g_assert_cmpstr(json_object_get_string_member(block, "options"), ==, engine->options);
  JsonNode *commit = json_object_get_member(block, "commit");
  g_assert_cmpint(json_node_is_null(commit), ==, engine->commit == NULL);
  g_assert_cmpstr(json_node_get_string(commit), ==, engine->commit);
}

#define FILM                                                                                       \
  "film", "--load=850N/m", "--speed=10mm/s", "--radius=0.8mm", "--modulus=6MPa",                   \
      "--viscosity=0.2mPa.s"

// Every command that writes a document. The lists of the contract are arrays, without a block.
static void test_json(void) {
  g_autofree char *folder = g_path_get_dirname(cli.scene);
  g_autofree char *quick = g_build_filename(folder, "quick-look.scene", NULL);
  g_autofree char *study = path_of("x.study"), *store = path_of("x.store");
  g_autofree char *out = path_of("results");
  g_autofree char *text = g_strdup_printf(
      "[sealbench]\nformat = 1\nkind = study\nscene = %s\n\n[vary]\n"
      "gland.radial_space = uniform 1.34 mm .. 1.38 mm\n\n[study]\nmethod = monte-carlo\n"
      "samples = 4\nfigures = seals.outer.load_N\n\n[design]\nobjective = minimise "
      "seals.outer.load_N\n",
      quick);
  g_assert_true(g_file_set_contents(study, text, -1, NULL));
  const char *const command[][12] = {
      {"run", quick},
      {"run", quick, quick, "--set=output.frames=20"},
      {"plan", quick},
      {"fit", cli.valve, "--seal", "outer"},
      {FILM},
      {"asperity", "--lambda", "3"},
      {"fluid", "hfa-134a", "--temperature", "20degC"},
      {"sensitivity", quick, "--parameters=gland.radial_space", "--figures=seals.outer.load_N"},
      {"study", study, "-o", store},
      {"design", study},
      {"compare", quick, quick},
      {"thesis", "table-7.5"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(command); i++) {
    const char *arguments[16] = {NULL};
    size_t count = 0;
    for (; command[i][count] != NULL; count++) {
      arguments[count] = command[i][count];
    }
    arguments[count++] = "--json";
    arguments[count++] = "-";
    CliResult result = cli_run(arguments, NULL, NULL);
    g_test_message("%s", command[i][0]);
    g_assert_cmpint(result.code, ==, 0);
    g_autoptr(JsonNode) root = cli_parse(result.out);
    if (JSON_NODE_HOLDS_ARRAY(root)) {
      JsonArray *array = json_node_get_array(root);
      g_assert_cmpuint(json_array_get_length(array), >, 0);
      for (guint k = 0; k < json_array_get_length(array); k++) {
        check_engine(json_array_get_element(array, k));
      }
    } else {
      check_engine(root);
    }
    cli_clear(&result);
  }
  // The folder's file is the same document.
  CliResult result = CLI("run", quick, "-o", out, "-q");
  g_assert_cmpint(result.code, ==, 0);
  g_autofree char *results = cli_contents(out, "results.json");
  g_autoptr(JsonNode) root = cli_parse(results);
  check_engine(root);
  cli_clear(&result);
  cli_remove_results(out);
  g_unlink(study);
  g_unlink(store);
}

// Pictures and films of all formats name the engine and the commit.
static void test_pictures(void) {
  static const char *const names[] = {"a.png",  "a.svg",  "a.pdf", "a.mp4",
                                      "a.webp", "a.apng", "a.gif"};
  CliResult features = CLI("--version");
  const size_t count = strstr(features.out, "MP4") != NULL ? G_N_ELEMENTS(names) : 3;
  cli_clear(&features);
  const SbEngineIdentity *engine = sb_engine_identity();
  g_autofree char *folder = g_path_get_dirname(cli.scene);
  g_autofree char *quick = g_build_filename(folder, "quick-look.scene", NULL);
  for (size_t i = 0; i < count; i++) {
    g_autofree char *path = path_of(names[i]);
    const char *const arguments[] = {
        "render", quick,        "-o", path,
        "--view", "hysteresis", "-q", i >= 3 ? "--duration=0.1s" : NULL,
        NULL};
    CliResult result = cli_run(arguments, NULL, NULL);
    g_assert_cmpint(result.code, ==, 0);
    char *bytes = NULL;
    gsize size = 0;
    g_assert_true(g_file_get_contents(path, &bytes, &size, NULL));
    GBytes *of = g_bytes_new_take(bytes, size);
    g_assert_nonnull(memmem(bytes, size, engine->source, strlen(engine->source)));
    g_assert_true(engine->commit == NULL ||
                  memmem(bytes, size, engine->commit, strlen(engine->commit)) != NULL);
    g_bytes_unref(of);
    g_unlink(path);
    cli_clear(&result);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli/identity/version", test_version);
  g_test_add_func("/cli/identity/json", test_json);
  g_test_add_func("/cli/identity/pictures", test_pictures);
  const int failed = g_test_run();
  cli_tear_down();
  return failed;
}

// See cli_fixture.h.
#include "tests/app/cli_fixture.h"

#include <glib/gstdio.h>
#include <stdlib.h>
#include <sys/wait.h>

CliFixture cli;

void cli_set_up(void) {
  cli.program = g_getenv("SEALBENCH_PROGRAM");
  g_assert_nonnull(cli.program);
  const char *assets = g_getenv("SEALBENCH_ASSETS");
  cli.valve = g_build_filename(assets, "valves", "piston.valve", NULL);
  cli.scene = g_build_filename(assets, "scenes", "thesis-cycle.scene", NULL);
  cli.folder = g_dir_make_tmp("sealbench-test-XXXXXX", NULL);
}

void cli_tear_down(void) {
  g_rmdir(cli.folder);
  g_free(cli.folder);
  g_free(cli.scene);
  g_free(cli.valve);
}

void cli_clear(CliResult *result) {
  g_free(result->out);
  g_free(result->err);
}

CliResult cli_run(const char *const *arguments, char **environment, GSpawnChildSetupFunc setup) {
  return cli_run_in(NULL, arguments, environment, 0, setup);
}

CliResult cli_run_in(const char *folder, const char *const *arguments, char **environment,
                     GSpawnFlags flags, GSpawnChildSetupFunc setup) {
  GPtrArray *argv = g_ptr_array_new();
  g_ptr_array_add(argv, (gpointer)cli.program);
  for (const char *const *a = arguments; *a != NULL; a++) {
    g_ptr_array_add(argv, (gpointer)*a);
  }
  g_ptr_array_add(argv, NULL);
  CliResult result = {0};
  int status = 0;
  GError *error = NULL;
  g_spawn_sync(folder, (char **)argv->pdata, environment, flags, setup, NULL, &result.out,
               &result.err, &status, &error);
  g_assert_no_error(error);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  g_ptr_array_unref(argv);
  return result;
}

JsonNode *cli_parse(const char *text) {
  GError *error = NULL;
  JsonNode *node = json_from_string(text, &error);
  g_assert_no_error(error);
  g_assert_false(g_regex_match_simple("[:,\\[] *-?(nan|inf)", text, G_REGEX_CASELESS, 0));
  return node;
}

JsonNode *cli_at(JsonNode *node, const char *path) {
  char **parts = g_strsplit(path, ".", -1);
  for (char **part = parts; *part != NULL && node != NULL; part++) {
    if (JSON_NODE_HOLDS_ARRAY(node)) {
      node = json_array_get_element(json_node_get_array(node), (guint)atoi(*part));
    } else {
      node = json_object_get_member(json_node_get_object(node), *part);
    }
  }
  if (node == NULL) {
    g_error("no key %s", path);
  }
  g_strfreev(parts);
  return node;
}

double cli_number(JsonNode *root, const char *path) {
  return json_node_get_double(cli_at(root, path));
}

void cli_has_keys(JsonNode *root, const char *keys) {
  char **list = g_strsplit(keys, " ", -1);
  for (char **key = list; *key != NULL; key++) {
    cli_at(root, *key);
  }
  g_strfreev(list);
}

char *cli_contents(const char *where, const char *name) {
  char *path = g_build_filename(where, name, NULL);
  char *text = NULL;
  GError *error = NULL;
  g_file_get_contents(path, &text, NULL, &error);
  g_assert_no_error(error);
  g_free(path);
  return text;
}

void cli_remove_results(const char *where) {
  static const char *const names[] = {"results.json", "cycle.csv", "profiles.csv", "figures.csv",
                                      ".sealbench-run.manifest"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    char *path = g_build_filename(where, names[i], NULL);
    g_unlink(path);
    g_free(path);
  }
  g_assert_cmpint(g_rmdir(where), ==, 0); // fails if anything else was left
}

// Files that commands read and write: shipped files and paths, check of every kind, files with
// errors, pipes.
#include "tests/app/cli_fixture.h"

#include <glib/gstdio.h>
#include <string.h>

static CliResult in_folder(const char *const *arguments) {
  return cli_run_in(cli.folder, arguments, NULL, 0, NULL);
}
#define IN(...) in_folder((const char *const[]){__VA_ARGS__, NULL})

static void in_says(int code, const char *text, const char *const *arguments) {
  CliResult result = in_folder(arguments);
  if (result.code != code || strstr(result.err, text) == NULL) {
    g_error("%s %s: exit %d: \"%s\" lacks \"%s\"", arguments[0], arguments[1], result.code,
            result.err, text);
  }
  cli_clear(&result);
}
#define IN_SAYS(code, text, ...) in_says(code, text, (const char *const[]){__VA_ARGS__, NULL})

static char *path_of(const char *name) {
  return g_build_filename(cli.folder, name, NULL);
}

static void write_file(const char *name, const char *text) {
  g_autofree char *path = path_of(name);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
}

static void remove_file(const char *name) {
  g_autofree char *path = path_of(name);
  g_assert_cmpint(g_unlink(path), ==, 0);
}

// A shipped file goes by its name without ending; a path that does not exist is an error of every
// command, and so is the name of a shipped file with its ending.
static void test_shipped(void) {
  const char *missing = "No such file or directory; the shipped file is named without its ending";
  IN_SAYS(1, missing, "run", "quick-look.scene");
  IN_SAYS(1, missing, "plan", "quick-look.scene");
  IN_SAYS(1, missing, "check", "piston.valve");
  IN_SAYS(1, missing, "study", "gland.study");
  IN_SAYS(1, missing, "fit", "piston.valve", "--seal", "inner");
  IN_SAYS(1, "No such file or directory", "run", "./quick-look");
  IN_SAYS(1, "No such file or directory, do you mean quick-look?", "run", "quick-lok");
  CliResult result = IN("run", "quick-look", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  const char *scene = json_node_get_string(cli_at(root, "scene"));
  g_assert_true(g_path_is_absolute(scene));
  g_assert_true(g_str_has_suffix(scene, "/scenes/quick-look.scene"));
  json_node_unref(root);
  cli_clear(&result);
}

// A user's own file has precedence over the shipped file of its name; the JSON holds its full path.
static void test_own(void) {
  g_autofree char *text = NULL;
  const char *assets = g_getenv("SEALBENCH_ASSETS");
  g_autofree char *shipped = g_build_filename(assets, "valves", "piston.valve", NULL);
  g_assert_true(g_file_get_contents(shipped, &text, NULL, NULL));
  write_file("quick-look", text);
  g_autofree char *real = g_canonicalize_filename("quick-look", cli.folder);
  static const char *const commands[][7] = {
      {"run", "quick-look", "--set", "output.frames=10", "--json", "-", NULL},
      {"plan", "quick-look", "--json", "-", NULL}};
  for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
    CliResult result = in_folder(commands[i]);
    g_assert_cmpint(result.code, ==, 0);
    JsonNode *root = cli_parse(result.out);
    g_assert_cmpstr(json_node_get_string(cli_at(root, "scene")), ==, real);
    json_node_unref(root);
    cli_clear(&result);
  }
  CliResult fit = IN("fit", "quick-look", "--seal", "outer", "--json", "-");
  JsonNode *root = cli_parse(fit.out);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "file")), ==, real);
  json_node_unref(root);
  cli_clear(&fit);
  remove_file("quick-look");
  // A folder of that name is not a file.
  g_autofree char *folder = path_of("quick-look");
  g_assert_cmpint(g_mkdir(folder, 0700), ==, 0);
  CliResult result = IN("plan", "quick-look");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  g_rmdir(folder);
}

static void test_lists(void) {
  static const struct {
    const char *list, *name, *ending;
  } lists[] = {{"scenes", "thesis-cycle", ".scene"},
               {"valves", "piston", ".valve"},
               {"studies", "gland", ".study"},
               {"rubbers", "nitrile", ".rubber"}};
  for (size_t i = 0; i < G_N_ELEMENTS(lists); i++) {
    CliResult result = IN("list", lists[i].list, "--json", "-");
    g_assert_cmpint(result.code, ==, 0);
    JsonNode *root = cli_parse(result.out);
    JsonArray *array = json_node_get_array(root);
    bool found = false;
    for (guint k = 0; k < json_array_get_length(array); k++) {
      JsonObject *each = json_array_get_object_element(array, k);
      const char *file = json_object_get_string_member(each, "file");
      g_assert_true(g_path_is_absolute(file) && g_str_has_suffix(file, lists[i].ending));
      g_assert_nonnull(json_object_get_string_member(each, "title"));
      found |= strcmp(json_object_get_string_member(each, "name"), lists[i].name) == 0;
    }
    g_assert_true(found);
    json_node_unref(root);
    cli_clear(&result);
    result = IN("list", lists[i].list);
    g_assert_nonnull(strstr(result.out, lists[i].name));
    cli_clear(&result);
  }
}

// ---- check ----

// Checks a file; the only document of its JSON.
static JsonNode *check_json(const char *file, int code) {
  CliResult result = IN("check", file, "--json", "-");
  g_assert_cmpint(result.code, ==, code);
  JsonNode *root = cli_parse(result.out);
  g_assert_true(g_path_is_absolute(json_node_get_string(cli_at(root, "files.0.file"))));
  g_assert_true((code != 0) == (*result.err != '\0'));
  cli_clear(&result);
  return root;
}

static void is_kind(const char *file, const char *kind) {
  JsonNode *root = check_json(file, 0);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "files.0.kind")), ==, kind);
  json_node_unref(root);
}

// Every kind of file that the program reads is checked; a study or rubber is not called a bad
// valve.
static void test_check_kinds(void) {
  is_kind("quick-look", "scene");
  is_kind("gland", "study");
  is_kind("nitrile", "rubber");
  is_kind(cli.valve, "valve");
  write_file("a.txt", "# a ring\nmm 0,0 1.2,0 1.2,1.6 0,1.6 0,0\n");
  is_kind("a.txt", "section");
  write_file("b.txt", "mm 0,1.4 0,0 2,0 2,1.4\n");
  is_kind("b.txt", "groove");
  write_file("a.txt", "mm 0,0 1.2\n");
  CliResult result = IN("check", "a.txt", "gland", "-q");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_cmpstr(result.out, ==, "");
  g_assert_cmpstr(result.err, ==,
                  "sealbench: a.txt: point 2 is not x,r or x,r,bulge (as in \"mm 0,0 10,0 10,2 "
                  "0,2\")\n");
  cli_clear(&result);
  remove_file("a.txt");
  remove_file("b.txt");
}

static void is_issue(JsonNode *root, int index, int line, const char *group, const char *key) {
  g_autofree char *path = g_strdup_printf("files.0.issues.%d", index);
  JsonObject *issue = json_node_get_object(cli_at(root, path));
  g_assert_cmpstr(json_object_get_string_member(issue, "severity"), ==, "error");
  g_assert_cmpint(json_object_get_int_member(issue, "line"), ==, line);
  g_assert_cmpstr(json_object_get_string_member(issue, "group"), ==, group);
  if (key == NULL) {
    g_assert_true(json_object_get_null_member(issue, "key"));
  } else {
    g_assert_cmpstr(json_object_get_string_member(issue, "key"), ==, key);
  }
  g_assert_cmpstr(json_object_get_string_member(issue, "text"), !=, "");
}

// Every issue has its line, group and key.
static void test_check_issues(void) {
  write_file("bad.valve", "[sealbench]\nformat = 1\nkind = valve\n[seal]\nsection_diameter = 1 N\n"
                          "foo = 3\n[nonsense]\nx = y\n");
  JsonNode *root = check_json("bad.valve", 1);
  is_issue(root, 0, 5, "seal", "section_diameter");
  is_issue(root, 1, 6, "seal", "foo");
  is_issue(root, 2, 7, "nonsense", NULL);
  json_node_unref(root);
  write_file("bad.rubber", "[sealbench]\nformat = 1\nkind = rubber\n[seal]\nmodulus = 3 MPa\n");
  root = check_json("bad.rubber", 1);
  is_issue(root, 0, 5, "seal", "modulus");
  json_node_unref(root);
  write_file("bad.study", "[sealbench]\nformat = 1\nkind = study\nscene = bad.valve\n[vary]\n"
                          "seal.nothing = 1 .. 2\n");
  root = check_json("bad.study", 1);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "files.0.kind")), ==, "study");
  json_node_unref(root);
  // Values that contradict each other have the line of the key to change.
  write_file("bad.valve", "[sealbench]\nformat = 1\nkind = valve\n[bore]\ndiameter = 5 mm\n");
  root = check_json("bad.valve", 1);
  is_issue(root, 0, 5, "bore", "diameter");
  json_node_unref(root);
  remove_file("bad.valve");
  remove_file("bad.rubber");
  remove_file("bad.study");
}

// ---- Files with errors ----

// No command computes from a scene with errors or without its valve; each error is printed.
static void test_faulty(void) {
  write_file("no-valve.scene", "[sealbench]\nformat = 1\nkind = scene\nvalve = missing.valve\n");
  write_file("bad.valve",
             "[sealbench]\nformat = 1\nkind = valve\n[seal]\nsection_diameter = 1 N\n");
  write_file("bad.scene", "[sealbench]\nformat = 1\nkind = scene\nvalve = bad.valve\n");
  write_file("of-bad.study", "[sealbench]\nformat = 1\nkind = study\nscene = bad.scene\n[vary]\n"
                             "gland.radial_space = uniform 1.3 mm .. 1.4 mm, 3\n[study]\n"
                             "method = grid\n");
  static const char *const commands[][6] = {{"run"},         {"plan"},
                                            {"sensitivity"}, {"compare"},
                                            {"check"},       {"render", "-o", "x.png"},
                                            {"tui"},         {"report", "-o", "x.pdf"}};
  for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
    const char *const *c = commands[i];
    IN_SAYS(1, "missing.valve: No such file", c[0], "no-valve.scene", c[1] != NULL ? c[1] : "-q",
            c[2] != NULL ? c[2] : "-q");
    IN_SAYS(1, "bad.valve: [seal] section_diameter: \"N\" is a unit of another kind", c[0],
            "bad.scene", c[1] != NULL ? c[1] : "-q", c[2] != NULL ? c[2] : "-q");
  }
  IN_SAYS(1, "section_diameter", "study", "of-bad.study");
  g_autofree char *picture = path_of("x.png"), *pages = path_of("x.pdf");
  g_assert_false(g_file_test(picture, G_FILE_TEST_EXISTS));
  g_assert_false(g_file_test(pages, G_FILE_TEST_EXISTS));
  remove_file("no-valve.scene");
  remove_file("bad.valve");
  remove_file("bad.scene");
  remove_file("of-bad.study");
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli-files/shipped", test_shipped);
  g_test_add_func("/cli-files/own", test_own);
  g_test_add_func("/cli-files/lists", test_lists);
  g_test_add_func("/cli-files/check-kinds", test_check_kinds);
  g_test_add_func("/cli-files/check-issues", test_check_issues);
  g_test_add_func("/cli-files/faulty", test_faulty);
  int result = g_test_run();
  cli_tear_down();
  return result;
}

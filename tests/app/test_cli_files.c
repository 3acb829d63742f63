// Files that commands read and write: shipped files and paths, check of every kind, files with
// errors, pipes.
#define _GNU_SOURCE // posix_openpt, ptsname
#include "tests/app/cli_fixture.h"

#include <fcntl.h>
#include <glib/gstdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

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

// Each shipped example is listed with its ending, and the commands that read its kind find it by
// that name. Other files of its folder are no examples, and a user's own file has precedence.
static void test_examples(void) {
  CliResult list = IN("list", "examples");
  g_assert_cmpstr(list.out, ==,
                  "bench-loop.csv       Force over displacement of a bench machine (simulated)\n"
                  "bore-scan.txt        Roughness of a bore, 64 µm square (simulated)\n"
                  "valve-stem.step      The stem as a solid body\n"
                  "valve-stem.stl       The stem as triangles\n"
                  "valve.dxf            Half-sections of a stem and its housing\n");
  cli_clear(&list);
  static const char *const commands[][7] = {
      {"surface", "bore-scan.txt", "--form", "cylinder", NULL},
      {"cad", "valve.dxf", NULL},
      {"cad", "valve-stem.stl", NULL},
      {"check", "bench-loop.csv", NULL},
      {"compare", "quick-look", "--measured", "bench-loop.csv", NULL},
      {"run", "quick-look", "--measured", "bench-loop.csv", NULL}};
  for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
    CliResult result = in_folder(commands[i]);
    g_assert_cmpint(result.code, ==, 0);
    cli_clear(&result);
  }
  IN_SAYS(1, "titles.ini: No such file or directory", "cad", "titles.ini");
  IN_SAYS(1, "No such file or directory", "cad", "./valve.dxf");
  write_file("valve.dxf", "");
  IN_SAYS(1, "valve.dxf", "cad", "valve.dxf");
  remove_file("valve.dxf");
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
  write_file("bad.valve", "[sealbench]\nformat = 1\nkind = valve\n[seal]\ninner_diameter = 1 mm\n");
  root = check_json("bad.valve", 1);
  is_issue(root, 0, 5, "seal", "inner_diameter");
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

// ---- Pipes ----

// Runs a line of a shell in the test's folder, "$SB" is the program.
static CliResult shell(const char *line) {
  const char *argv[] = {"bash", "-c", line, NULL};
  char **environment = g_environ_setenv(g_get_environ(), "SB", cli.program, TRUE);
  CliResult result = {0};
  int status = 0;
  GError *error = NULL;
  g_spawn_sync(cli.folder, (char **)argv, environment, G_SPAWN_SEARCH_PATH, NULL, NULL, &result.out,
               &result.err, &status, &error);
  g_assert_no_error(error);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  g_strfreev(environment);
  return result;
}

// A reader that stops early ends the program silently, whether it prints or writes a document.
static void test_head(void) {
  static const char *const lines[] = {
      "$SB list params | head -n 1; exit ${PIPESTATUS[0]}",
      "$SB list params --json - | head -n 1; exit ${PIPESTATUS[0]}",
      "$SB run quick-look --json - | head -c 1; exit ${PIPESTATUS[0]}",
      "$SB run quick-look -o out | true; exit ${PIPESTATUS[0]}"};
  for (size_t i = 0; i < G_N_ELEMENTS(lines); i++) {
    CliResult result = shell(lines[i]);
    if (result.code != 0 || *result.err != '\0') {
      g_error("%s: exit %d, \"%s\"", lines[i], result.code, result.err);
    }
    cli_clear(&result);
  }
  // Results in a folder are complete.
  g_autofree char *out = path_of("out");
  g_autofree char *json = cli_contents(out, "results.json");
  json_node_unref(cli_parse(json));
  cli_remove_results(out);
}

// Scenes, tables and other files are read from pipes, also slow ones and named ones. The names in
// them are those of the current folder.
static void test_pipes(void) {
  static const char *const lines[] = {
      "$SB plan <(sleep 0.2; cat own.valve) --json -",
      "$SB check <(cat own.valve) --json -",
      "$SB plan <(cat own.scene) --json -",
      "$SB check <(cat own.study) --json -",
      "$SB plan /dev/stdin --json - < own.scene",
      "mkfifo named; cat own.valve > named & $SB plan named --json -; rm named",
      "$SB compare quick-look --measured <(cat nul.csv) --json -"};
  g_autofree char *valve = NULL, *table = NULL;
  g_assert_true(g_file_get_contents(cli.valve, &valve, NULL, NULL));
  write_file("own.valve", valve);
  write_file("own.scene", "[sealbench]\nformat = 1\nkind = scene\nvalve = own.valve\n");
  write_file("own.study", "[sealbench]\nformat = 1\nkind = study\nscene = own.scene\n[vary]\n"
                          "seal.modulus = levels 2 MPa, 3 MPa\n[study]\nmethod = grid\n"
                          "figures = seals.outer.load_N\n");
  const char *assets = g_getenv("SEALBENCH_ASSETS");
  g_autofree char *bench = g_build_filename(assets, "series", "bench.csv", NULL);
  g_assert_true(g_file_get_contents(bench, &table, NULL, NULL));
  write_file("nul.csv", table);
  for (size_t i = 0; i < G_N_ELEMENTS(lines); i++) {
    CliResult result = shell(lines[i]);
    if (result.code != 0 || *result.err != '\0') {
      g_error("%s: exit %d, \"%s\"", lines[i], result.code, result.err);
    }
    json_node_unref(cli_parse(result.out));
    cli_clear(&result);
  }
  remove_file("own.valve");
  remove_file("own.scene");
  remove_file("own.study");
  remove_file("nul.csv");
}

// ---- Terminals ----

// Runs the program in a terminal of its own of this type and width; what it showed. Never NULL.
static char *in_terminal(int *code, const char *type, int columns, const char *const *arguments) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  g_assert_cmpint(master, >=, 0);
  g_assert_cmpint(grantpt(master), ==, 0);
  g_assert_cmpint(unlockpt(master), ==, 0);
  const char *name = ptsname(master);
  const struct winsize size = {.ws_row = 24, .ws_col = (unsigned short)columns};
  g_assert_cmpint(ioctl(master, TIOCSWINSZ, &size), ==, 0);
  const pid_t child = fork();
  if (child == 0) {
    setsid();
    const int slave = open(name, O_RDWR);
    for (int fd = 0; fd < 3; fd++) {
      dup2(slave, fd);
    }
    g_setenv("TERM", type, TRUE);
    g_unsetenv("COLORTERM");
    execv(cli.program, (char *const *)arguments);
    _exit(127);
  }
  GString *shown = g_string_new(NULL);
  char bytes[4096];
  for (ssize_t got; (got = read(master, bytes, sizeof bytes)) > 0;) {
    g_string_append_len(shown, bytes, got);
  }
  int status = 0;
  waitpid(child, &status, 0);
  close(master);
  *code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return g_string_free(shown, FALSE);
}

// Terminals that cannot show the workbench: one sentence and exit code 1.
static void test_poor_terminals(void) {
  static const char *const types[] = {"dumb", "vt100", "vt102", "sun", "cons25", "pcansi"};
  const char *const arguments[] = {"sealbench", "tui", NULL};
  for (size_t i = 0; i < G_N_ELEMENTS(types); i++) {
    int code;
    g_autofree char *shown = in_terminal(&code, types[i], 200, arguments);
    if (strstr(shown, "no workbench") != NULL) {
      g_test_skip("built without the workbench");
      return;
    }
    if (code != 1 || !g_str_has_prefix(shown, "sealbench: a terminal of type \"") ||
        strchr(shown, '\n') != shown + strlen(shown) - 1) {
      g_error("%s: exit %d: %s", types[i], code, shown);
    }
  }
}

// Whatever the width, a progress bar stays on its line and no other line is wider than the
// terminal.
static void test_narrow_terminals(void) {
  static const int widths[] = {10, 20, 30, 40, 71, 72, 100};
  const char *const run[] = {"sealbench", "run",
                             cli.scene,   "--no-plot",
                             "--set",     "models.film=reynolds",
                             "--set",     "output.frames=20000",
                             NULL};
  for (size_t i = 0; i < G_N_ELEMENTS(widths); i++) {
    int code;
    g_autofree char *shown = in_terminal(&code, "xterm", widths[i], run);
    g_assert_cmpint(code, ==, 0);
    // Lines end in a line feed, what a carriage return starts again is one line.
    g_auto(GStrv) lines = g_strsplit_set(shown, "\r\n", -1);
    for (char **line = lines; *line != NULL; line++) {
      const bool one_word = strchr(g_strstrip(*line), ' ') == NULL;
      if (g_utf8_strlen(*line, -1) > widths[i] && !one_word && widths[i] >= 20) {
        g_error("%d columns: \"%s\"", widths[i], *line);
      }
      g_assert_true(strstr(*line, " %") == NULL || strstr(*line, "left") == NULL ||
                    g_utf8_strlen(*line, -1) < widths[i]);
    }
  }
}

// ---- Options and messages ----

// An empty value of an option is a usage error.
static void test_empty_options(void) {
  IN_SAYS(1, "-o, --output: is empty", "run", "quick-look", "-o", "");
  IN_SAYS(1, "operand 1: the name is empty", "run", "");
  IN_SAYS(1, "operand 2: the name is empty", "compare", "quick-look", "");
  IN_SAYS(1, "--json: is empty", "run", "quick-look", "--json", "");
  IN_SAYS(1, "--set: is empty", "plan", "quick-look", "--set", "");
  IN_SAYS(1, "-o, --output: is empty", "study", "gland", "-o", "");
  IN_SAYS(1, "--progress: is empty", "plan", "quick-look", "--progress", "");
}

// -q prints no progress, whatever --progress asks for.
static void test_quiet(void) {
  static const char *const styles[] = {"lines", "json"};
  for (size_t i = 0; i < G_N_ELEMENTS(styles); i++) {
    CliResult result = IN("run", "quick-look", "-q", "--progress", styles[i]);
    g_assert_cmpint(result.code, ==, 0);
    g_assert_cmpstr(result.out, ==, "");
    g_assert_cmpstr(result.err, ==, "");
    cli_clear(&result);
    result = IN("run", "quick-look", "--json", "/dev/null", "--progress", styles[i]);
    g_assert_cmpstr(result.err, !=, "");
    cli_clear(&result);
  }
}

// The reason behind a long path or a long value is in the message.
static void test_long_messages(void) {
  g_autofree char *part = g_strnfill(200, 'x');
  g_autofree char *path = g_strjoin("/", part, part, part, "missing.scene", NULL);
  g_autofree char *expected =
      g_strconcat("sealbench: ", path, ": No such file or directory\n", NULL);
  CliResult result = IN("run", path);
  g_assert_cmpstr(result.err, ==, expected);
  cli_clear(&result);
  g_autofree char *setting = g_strconcat("nonsense", part, part, NULL);
  IN_SAYS(1, setting, "plan", "quick-look", "--set", setting);
}

// ---- Measured tables ----

// A row with a NUL or an unreadable cell counts as dropped, a line of another kind as skipped.
static void test_dropped_rows(void) {
  g_autofree char *bench =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "series", "bench.csv", NULL);
  g_autofree char *table = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(bench, &table, &length, NULL));
  GString *text = g_string_new_len(table, (gssize)length);
  // The 20th, 30th and 40th line from the end: a NUL in a number, a letter in one, a heading.
  char *line = text->str + text->len;
  for (int i = 1; i <= 41; i++) {
    do {
      line--;
    } while (line[-1] != '\n');
    if (i == 20 || i == 30) {
      line[strcspn(line, "0123456789") + 1] = i == 20 ? '\0' : 'x';
    }
  }
  g_string_insert(text, line - text->str, "second part\n");
  g_autofree char *path = path_of("nul.csv");
  g_assert_true(g_file_set_contents(path, text->str, (gssize)text->len, NULL));
  g_string_free(text, TRUE);
  CliResult result = IN("compare", "quick-look", "--measured", "nul.csv", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  g_assert_cmpfloat(cli_number(root, "measured.recognised.rows_dropped"), ==, 2);
  g_assert_cmpfloat(cli_number(root, "measured.recognised.lines_skipped"), ==, 1);
  json_node_unref(root);
  cli_clear(&result);
  remove_file("nul.csv");
}

// ---- Studies in the JSON of a run ----

// Every array of numbers with a null in it has a reason by its path.
static guint count_nulls(JsonNode *node, const char *path, JsonObject *reasons) {
  guint count = 0;
  if (JSON_NODE_HOLDS_NULL(node)) {
    g_error("%s is null without a reason", path);
  } else if (JSON_NODE_HOLDS_OBJECT(node)) {
    JsonObjectIter iter;
    const char *name;
    JsonNode *inside;
    json_object_iter_init(&iter, json_node_get_object(node));
    while (json_object_iter_next(&iter, &name, &inside)) {
      g_autofree char *at = g_strdup_printf("%s.%s", path, name);
      const bool explained = json_object_has_member(reasons, at);
      count += explained ? 1 : count_nulls(inside, at, reasons);
    }
  } else if (JSON_NODE_HOLDS_ARRAY(node)) {
    JsonArray *array = json_node_get_array(node);
    for (guint i = 0; i < json_array_get_length(array); i++) {
      g_autofree char *at = g_strdup_printf("%s[%u]", path, i);
      count += count_nulls(json_array_get_element(array, i), at, reasons);
    }
  }
  return count;
}

static void test_study_reasons(void) {
  CliResult result = IN("run", "leak-study", "--set", "output.frames=50", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  JsonObject *reasons = json_node_get_object(cli_at(root, "reasons"));
  g_assert_cmpuint(count_nulls(cli_at(root, "studies"), "studies", reasons), >, 0);
  json_node_unref(root);
  cli_clear(&result);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli-files/shipped", test_shipped);
  g_test_add_func("/cli-files/examples", test_examples);
  g_test_add_func("/cli-files/own", test_own);
  g_test_add_func("/cli-files/lists", test_lists);
  g_test_add_func("/cli-files/check-kinds", test_check_kinds);
  g_test_add_func("/cli-files/check-issues", test_check_issues);
  g_test_add_func("/cli-files/faulty", test_faulty);
  g_test_add_func("/cli-files/head", test_head);
  g_test_add_func("/cli-files/pipes", test_pipes);
  g_test_add_func("/cli-files/poor-terminals", test_poor_terminals);
  g_test_add_func("/cli-files/narrow-terminals", test_narrow_terminals);
  g_test_add_func("/cli-files/empty-options", test_empty_options);
  g_test_add_func("/cli-files/quiet", test_quiet);
  g_test_add_func("/cli-files/long-messages", test_long_messages);
  g_test_add_func("/cli-files/dropped-rows", test_dropped_rows);
  g_test_add_func("/cli-files/study-reasons", test_study_reasons);
  int result = g_test_run();
  cli_tear_down();
  return result;
}

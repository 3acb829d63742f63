// The program's pictures and films from outside: what it writes, keeps when it is interrupted, and
// leaves on a full disk.
#include "tests/app/cli_fixture.h"

#include <gio/gio.h>
#include <glib/gstdio.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

static void test_render(void) {
  static const struct {
    const char *view, *ending, *magic;
  } cases[] = {
      {"hysteresis", "png", "\x89PNG"}, {"hysteresis", "svg", "<?xml"},
      {"profiles", "pdf", "%PDF"},      {"section", "png", "\x89PNG"},
      {"section", "svg", "<?xml"},      {"dashboard", "png", "\x89PNG"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    char *name = g_strdup_printf("picture.%s", cases[i].ending);
    char *path = g_build_filename(cli.folder, name, NULL);
    CliResult result = CLI("render", cli.scene, "-o", path, "--view", cases[i].view, "--quiet",
                           "--size", "640x400", "--at", "C");
    g_assert_cmpstr(result.err, ==, "");
    g_assert_cmpint(result.code, ==, 0);
    char *picture = cli_contents(cli.folder, name);
    g_assert_true(strncmp(picture, cases[i].magic, 4) == 0);
    cli_clear(&result);
    g_free(picture);
    g_unlink(path);
    g_free(path);
    g_free(name);
  }
  static const struct {
    const char *arguments[8];
    int code;
  } bad[] = {
      {{"-o", "x.bmp"}, 1},
      {{"-o", "x.webp", "--at", "C"}, 1},
      {{"-o", "x.gif", "--fps", "60"}, 1},
      {{"-o", "x.apng", "--view", "tolerances"}, 1},
      {{"-o", "-", "--format", "bmp"}, 1},
      {{"-o", "x.png", "--view", "clouds"}, 1},
      {{"-o", "x.png", "--size", "12"}, 1},
      {{"-o", "x.png", "--size", "1x1"}, 1},
      {{"-o", "x.png", "--at", "Q"}, 1},
      {{"-o", "x.png", "--at", ""}, 1},
      {{"-o", "x.png", "--at", "900 s"}, 1},
      {{"-o", "x.png", "--fps", "30"}, 1},
      {{"-o", "x.mp4", "--at", "C"}, 1},
      {{"-o", "x.mp4", "--fps", "0"}, 1},
      {{"-o", "x.mp4", "--duration", "3"}, 1},
      {{"-o", "x.mp4", "--backend", "vulkan"}, 1},
      {{"-o", "x.mp4", "--speed", "0"}, 1},
      {{"-o", "x.mp4", "--speed", "2", "--duration", "3 s"}, 1},
      {{"-o", "x.mp4", "--from", "C", "--to", "B"}, 1},
      {{"-o", "x.mp4", "--from", "Q"}, 1},
      {{"-o", "x.png", "--from", "B"}, 1},
      {{"-o", "x.png", "--size", "8k"}, 1},
      {{"-o", "x.png", "--field", "heat"}, 1},
      {{"-o", "x.png", "--insets", "both"}, 1},
      {{"-o", "x.png", "--zoom", "stem"}, 1},
      {{"-o", "%d/x.png"}, 1},
      {{"--view", "section"}, 1},
      {{"-o", "/no/such/x.mp4"}, 3},
      {{"-o", "/no/such/x.png"}, 3},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    const char *arguments[12] = {"render", cli.scene, "--quiet"};
    for (size_t k = 0; bad[i].arguments[k] != NULL; k++) {
      arguments[k + 3] = bad[i].arguments[k];
    }
    CliResult result = cli_run(arguments, NULL, NULL);
    if (result.code != bad[i].code) {
      g_error("case %zu: exit %d, not %d: %s", i, result.code, bad[i].code, result.err);
    }
    g_assert_cmpstr(result.err, !=, "");
    g_assert_false(g_file_test("x.png", G_FILE_TEST_EXISTS));
    cli_clear(&result);
  }
}

// Starts the program, sends it `number` at its first byte of progress that starts with `word`, and
// returns its exit code.
static int interrupted_run(const char *const *argv, const char *word, int number) {
  GPid pid;
  int err = -1;
  GError *error = NULL;
  g_spawn_async_with_pipes(NULL, (char **)argv, NULL,
                           G_SPAWN_DO_NOT_REAP_CHILD | G_SPAWN_STDOUT_TO_DEV_NULL, NULL, NULL, &pid,
                           NULL, NULL, &err, &error);
  g_assert_no_error(error);
  GString *seen = g_string_new(NULL);
  bool sent = false;
  char c;
  while (read(err, &c, 1) == 1) {
    g_string_append_c(seen, c);
    if (!sent && strstr(seen->str, word) != NULL) {
      kill(pid, number);
      sent = true;
    }
  }
  g_assert_true(sent);
  g_string_free(seen, TRUE);
  close(err);
  int status = 0;
  waitpid(pid, &status, 0);
  g_assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

// Film: whole with its pictures, or partial but under its name after Ctrl-C.
// Studies: pictures without a run, tables and JSON where the scene asks, films refused.
static void test_studies(void) {
  char *picture = g_build_filename(cli.folder, "storage.svg", NULL);
  char *film = g_build_filename(cli.folder, "storage.mp4", NULL);
  char *tables = g_build_filename(cli.folder, "studied", NULL);
  CliResult result = CLI("render", cli.scene, "-o", film, "--view", "storage");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "--view storage is a study, which does not move"));
  cli_clear(&result);
  result = CLI("render", cli.scene, "-o", picture, "--view", "storage", "--at", "C");
  g_assert_cmpint(result.code, ==, 1);
  cli_clear(&result);
  result = CLI("render", cli.scene, "-o", picture, "--view", "storage", "--quiet");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  cli_clear(&result);
  char *text = NULL;
  g_assert_true(g_file_get_contents(picture, &text, NULL, NULL));
  g_assert_nonnull(strstr(text, "<svg"));
  g_free(text);
  result = CLI("list", "views");
  g_assert_nonnull(strstr(result.out, "\nstorage "));
  cli_clear(&result);

  // Only what is asked for is computed and planned.
  result = CLI("plan", cli.scene, "--set", "output.studies=storage");
  g_assert_nonnull(strstr(result.out, "study storage"));
  g_assert_null(strstr(result.out, "study squeeze"));
  cli_clear(&result);
  result = CLI("run", cli.scene, "--json", "-", "--quiet");
  JsonNode *root = cli_parse(result.out);
  g_assert_false(json_object_has_member(json_node_get_object(root), "studies"));
  json_node_unref(root);
  cli_clear(&result);
  result = CLI("run", cli.scene, "--set", "output.studies=storage", "-o", tables, "--json", "-",
               "--quiet");
  g_assert_cmpint(result.code, ==, 0);
  root = cli_parse(result.out);
  cli_has_keys(root,
               "studies.0.name studies.0.x.quantity studies.0.panels.0.series.0.y "
               "studies.0.table.columns.0.unit studies.0.table.rows.0.values studies.0.warnings");
  g_assert_cmpstr(json_node_get_string(cli_at(root, "studies.0.name")), ==, "storage");
  json_node_unref(root);
  cli_clear(&result);
  static const char *const names[] = {"results.json",           "cycle.csv",
                                      "profiles.csv",           "figures.csv",
                                      "study-storage.csv",      "study-storage-table.csv",
                                      ".sealbench-run.manifest"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    char *path = g_build_filename(tables, names[i], NULL);
    g_assert_cmpint(g_remove(path), ==, 0);
    g_free(path);
  }
  g_assert_cmpint(g_rmdir(tables), ==, 0);
  g_assert_cmpint(g_remove(picture), ==, 0);
  g_free(picture);
  g_free(film);
  g_free(tables);
}

static void test_film_file(void) {
  char *path = g_build_filename(cli.folder, "film.mp4", NULL);
  CliResult result = CLI("render", cli.scene, "-o", path, "--view", "hysteresis", "--quiet",
                         "--size", "320x180", "--fps", "5", "--duration", "1 s");
  g_assert_cmpstr(result.err, ==, "");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  char *bytes = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(path, &bytes, &length, NULL));
  g_assert_cmpuint(length, >, 1000);
  g_assert_cmpint(memcmp(bytes + 4, "ftyp", 4), ==, 0);
  g_free(bytes);
  g_unlink(path);
  const char *const argv[] = {cli.program, "render",     cli.scene, "-o",      path,
                              "--view",    "hysteresis", "--size",  "320x180", "--duration",
                              "20 s",      "--progress", "lines",   NULL};
  g_assert_cmpint(interrupted_run(argv, "drawing 10", SIGINT), ==, 130);
  g_assert_true(g_file_get_contents(path, &bytes, &length, NULL));
  g_assert_cmpuint(length, >, 1000);
  g_free(bytes);
  g_unlink(path);
  g_free(path);
}

// Animations: the options of films; an unknown ending is answered by all that there are; what is
// interrupted leaves nothing.
static void test_animations(void) {
  CliResult result = CLI("render", cli.scene, "-o", "x.bmp");
  g_assert_nonnull(strstr(result.err, ".png, .svg, .pdf, .mp4, .webp, .apng or .gif"));
  cli_clear(&result);
  result = CLI("render", cli.scene, "-o", "x.gif", "--fps", "60");
  g_assert_cmpstr(result.err, ==,
                  "sealbench: --fps: 60 is too fast for .gif (allowed at most 50)\n");
  cli_clear(&result);
  result = CLI("--help");
  g_assert_nonnull(strstr(result.out, "OUT.{png,svg,pdf,mp4,webp,apng,gif}"));
  cli_clear(&result);
  static const struct {
    const char *name, *magic;
  } cases[] = {{"loop.webp", "RIFF"}, {"loop.apng", "\x89PNG"}, {"loop.gif", "GIF8"}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autofree char *path = g_build_filename(cli.folder, cases[i].name, NULL);
    result = CLI("render", cli.scene, "-o", path, "--view", "hysteresis", "--quiet", "--size",
                 "320x180", "--fps", "5", "--duration", "1 s");
    g_assert_cmpstr(result.err, ==, "");
    g_assert_cmpint(result.code, ==, 0);
    cli_clear(&result);
    g_autofree char *bytes = cli_contents(cli.folder, cases[i].name);
    g_assert_cmpint(memcmp(bytes, cases[i].magic, 4), ==, 0);
    g_unlink(path);
    const char *const argv[] = {cli.program, "render",     cli.scene, "-o",      path,
                                "--view",    "hysteresis", "--size",  "320x180", "--duration",
                                "20 s",      "--progress", "lines",   NULL};
    g_assert_cmpint(interrupted_run(argv, "drawing 10", SIGINT), ==, 130);
    g_assert_false(g_file_test(path, G_FILE_TEST_EXISTS));
  }
}

static gint by_name(gconstpointer a, gconstpointer b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

// Names in a folder, sorted, in one line.
static char *listing(const char *path) {
  GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
  GDir *dir = g_dir_open(path, 0, NULL);
  g_assert_nonnull(dir);
  for (const char *name; (name = g_dir_read_name(dir)) != NULL;) {
    g_ptr_array_add(names, g_strdup(name));
  }
  g_dir_close(dir);
  g_ptr_array_sort(names, by_name);
  g_ptr_array_add(names, NULL);
  char *line = g_strjoinv(" ", (char **)names->pdata);
  g_ptr_array_unref(names);
  return line;
}

static void remove_pictures(const char *path) {
  char *line = listing(path);
  char **names = g_strsplit(line, " ", 0);
  for (char **name = names; *name != NULL; name++) {
    char *file = g_build_filename(path, *name, NULL);
    g_unlink(file);
    g_free(file);
  }
  g_strfreev(names);
  g_free(line);
  g_rmdir(path);
}

// A sequence: as many files as range, speed and rate make, each with the scene and its look; a
// folder gets names of its own; Ctrl-C keeps what was finished.
static void test_sequence(void) {
  char *pictures = g_build_filename(cli.folder, "frames", NULL);
  char *pattern = g_build_filename(pictures, "p%03d.png", NULL);
  // B to C lasts 9.9 s of the run: 4.97 s at twice the speed, five pictures at one a second.
  CliResult result =
      CLI("render", cli.scene, "-o", pattern, "--quiet", "--size", "320x180", "--fps", "1",
          "--from", "B", "--to", "C", "--speed", "2", "--field", "shear", "--full");
  g_assert_cmpstr(result.err, ==, "");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  char *names = listing(pictures);
  g_assert_cmpstr(names, ==, "p001.png p002.png p003.png p004.png p005.png");
  g_free(names);
  // Any of them is a scene again, which remembers the look.
  char *third = g_build_filename(pictures, "p003.png", NULL);
  result = CLI("plan", third, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  char *again = g_build_filename(cli.folder, "again.png", NULL);
  result = CLI("render", third, "-o", again, "--quiet", "--size", "320x180", "--at", "C");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  // That picture holds the scene again, with the options of the first.
  char *restored = g_build_filename(cli.folder, "restored.json", NULL);
  result = CLI("run", again, "--json", restored, "--quiet");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  result = CLI("run", cli.scene, "--json", "-", "--quiet", "--set", "output.field=shear", "--set",
               "output.section=full");
  char *from_picture = cli_contents(cli.folder, "restored.json");
  JsonNode *one = cli_parse(from_picture);
  JsonNode *two = cli_parse(result.out);
  g_assert_cmpstr(json_node_get_string(cli_at(one, "parameters_sha256")), ==,
                  json_node_get_string(cli_at(two, "parameters_sha256")));
  json_node_unref(one);
  json_node_unref(two);
  g_free(from_picture);
  cli_clear(&result);
  g_unlink(restored);
  g_free(restored);
  g_unlink(again);
  g_free(again);
  g_free(third);
  remove_pictures(pictures);

  g_assert_cmpint(g_mkdir(pictures, 0777), ==, 0);
  const char *const argv[] = {cli.program, "render",     cli.scene,    "-o",   pictures,
                              "--size",    "320x180",    "--duration", "20 s", "--fps",
                              "30",        "--progress", "lines",      NULL};
  g_assert_cmpint(interrupted_run(argv, "drawing 10", SIGINT), ==, 130);
  names = listing(pictures);
  g_assert_true(
      g_str_has_prefix(names, ".sealbench-render.manifest frame-0001.png frame-0002.png "));
  g_assert_null(strstr(names, "frame-0600.png"));
  g_assert_null(strstr(names, ".part"));
  g_free(names);
  remove_pictures(pictures);
  g_free(pattern);
  g_free(pictures);
}

// A small disk that runs full: exit 3, one line that says so, an earlier file as it was, and of a
// sequence only whole pictures.
static void test_full_disk(void) {
  char *disk = g_build_filename(cli.folder, "disk", NULL);
  g_mkdir(disk, 0700);
  if (mount("none", disk, "tmpfs", 0, "size=192k") != 0) {
    g_test_skip("mounting a tmpfs is not permitted here");
    g_rmdir(disk);
    g_free(disk);
    return;
  }
  char *film = g_build_filename(disk, "film.mp4", NULL);
  g_assert_true(g_file_set_contents(film, "earlier", -1, NULL));
  const char *const outputs[] = {film, disk};
  for (size_t i = 0; i < G_N_ELEMENTS(outputs); i++) {
    CliResult result = CLI("render", cli.scene, "-o", outputs[i], "--view", "dashboard", "--quiet",
                           "--size", "960x540", "--fps", "10", "--duration", "6 s");
    char *earlier = cli_contents(disk, "film.mp4");
    char *names = listing(disk);
    bool whole = true;
    for (int k = 1; i == 1 && strstr(names, "frame-") != NULL && k < 60; k++) {
      char *name = g_strdup_printf("frame-%04d.png", k);
      if (strstr(names, name) != NULL) {
        char *bytes = NULL;
        gsize length = 0;
        char *path = g_build_filename(disk, name, NULL);
        g_file_get_contents(path, &bytes, &length, NULL);
        whole = whole && length > 20 && memcmp(bytes + length - 8, "IEND", 4) == 0;
        g_free(path);
        g_free(bytes);
      }
      g_free(name);
    }
    if (i == G_N_ELEMENTS(outputs) - 1) {
      umount(disk);
    }
    g_assert_cmpint(result.code, ==, 3);
    g_assert_true(strstr(result.err, "disk is full") != NULL ||
                  strstr(result.err, "No space left") != NULL);
    g_assert_nonnull(strstr(result.err, disk));
    g_assert_cmpstr(strchr(result.err, '\n'), ==, "\n");
    g_assert_cmpstr(earlier, ==, "earlier");
    g_assert_true(whole);
    g_assert_null(strstr(names, ".part"));
    cli_clear(&result);
    g_free(earlier);
    g_free(names);
  }
  g_rmdir(disk);
  g_free(film);
  g_free(disk);
}

static void interrupt_by(int number) {
  char *out = g_build_filename(cli.folder, "part", NULL);
  const char *const argv[] = {
      cli.program,  "run",  cli.scene, "-o", out, "--set", "output.frames=1000000",
      "--progress", "json", NULL};
  // At the first percent: what is written are some ten thousand frames.
  g_assert_cmpint(interrupted_run(argv, "fraction", number), ==, 130);
  char *json = cli_contents(out, "results.json");
  JsonNode *root = cli_parse(json);
  g_assert_true(json_node_get_boolean(cli_at(root, "partial")));
  g_assert_cmpfloat(cli_number(root, "solver.frames"), >, 1000);
  g_assert_cmpfloat(cli_number(root, "solver.frames"), <, 1000000);
  json_node_unref(root);
  g_free(json);
  cli_remove_results(out);
  g_free(out);
}

// A closed terminal keeps what was finished as Ctrl-C does.
static void test_interrupt(void) {
  interrupt_by(SIGINT);
  interrupt_by(SIGTERM);
  interrupt_by(SIGHUP);
}

// What --set changes is in the picture, even where it changes no figure.
static void test_settings_shown(void) {
  char *picture[2];
  for (int i = 0; i < 2; i++) {
    char *path = g_build_filename(cli.folder, "set.svg", NULL);
    CliResult result = CLI("render", cli.scene, "-o", path, "--view", "hysteresis", "--set",
                           i == 0 ? "canister.pressure=0.55MPa" : "canister.pressure=0.550MPa");
    g_assert_cmpint(result.code, ==, 0);
    picture[i] = cli_contents(cli.folder, "set.svg");
    cli_clear(&result);
    g_free(path);
  }
  g_assert_cmpstr(picture[0], !=, picture[1]);
  g_free(picture[0]);
  g_free(picture[1]);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli-pictures/render", test_render);
  g_test_add_func("/cli-pictures/settings-shown", test_settings_shown);
  g_test_add_func("/cli-pictures/studies", test_studies);
  g_test_add_func("/cli-pictures/film-file", test_film_file);
  g_test_add_func("/cli-pictures/animations", test_animations);
  g_test_add_func("/cli-pictures/sequence", test_sequence);
  g_test_add_func("/cli-pictures/full-disk", test_full_disk);
  g_test_add_func("/cli-pictures/interrupt", test_interrupt);
  int result = g_test_run();
  cli_tear_down();
  return result;
}

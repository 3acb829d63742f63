// Broken input: each case gives exactly the one clear line that the user needs, and nothing hangs.
#include "app/document/document.h"

#include "tests/sanitized.h"

#include <fcntl.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static char *folder;

// All lines of what is wrong with `text`, joined.
static char *complaints(const char *text, size_t length) {
  GPtrArray *issues = sb_issues_new();
  SbDocument *document = sb_document_parse(text, length, "x.valve", folder, issues);
  GString *all = g_string_new(NULL);
  for (guint i = 0; i < issues->len; i++) {
    char *line = sb_issue_line(issues->pdata[i]);
    g_assert_null(strchr(line, '\n'));
    g_assert_null(strchr(line, '\x1b'));
    g_assert_true(g_utf8_validate(line, -1, NULL));
    g_string_append_printf(all, "%s%s", i > 0 ? "\n" : "", line);
    g_free(line);
  }
  g_assert_true(document != NULL || issues->len > 0);
  sb_document_free(document);
  g_ptr_array_unref(issues);
  return g_string_free(all, FALSE);
}

#define VALVE "[sealbench]\nformat = 1\nkind = valve\n"
#define SCENE "[sealbench]\nformat = 1\nkind = scene\n"

static void test_table(void) {
  static const struct {
    const char *text, *says;
  } cases[] = {
      {VALVE, ""},
      {"\xef\xbb\xbf" VALVE, ""},
      {"[sealbench]\r\nformat = 1\r\nkind = valve\r\n[seal]\r\nmodulus = 2 MPa\r\n", ""},
      {"", "x.valve: is not a valve or scene: the first group must be [sealbench]"},
      {"# only a comment\n",
       "x.valve: is not a valve or scene: the first group must be [sealbench]"},
      {"[seal]\nmodulus = 2 MPa\n",
       "x.valve: is not a valve or scene: the first group must be [sealbench]"},
      {"[sealbench]\nkind = valve\n", "x.valve: [sealbench] format: is missing (allowed 1)"},
      {"[sealbench]\nformat = 2\nkind = valve\n",
       "x.valve: [sealbench] format: is a format that this version cannot read (allowed 1)"},
      {"[sealbench]\nformat = 1\n",
       "x.valve: [sealbench] kind: is missing (allowed valve, scene, project)"},
      {"[sealbench]\nformat = 1\nkind = pump\n",
       "x.valve: [sealbench] kind: is unknown (allowed valve, scene, project)"},
      {VALVE "colour = red\n",
       "x.valve: [sealbench] colour: unknown key (allowed format, kind, title, valve)"},
      // Unknown key and group.
      {VALVE "[seal]\nsection_diametre = 1 mm\n",
       "x.valve: [seal] section_diametre: unknown key, do you mean seal.section_diameter?"},
      {VALVE "[seal]\ncolour_of_the_ring = red\n",
       "x.valve: [seal] colour_of_the_ring: unknown key"},
      {VALVE "[paint]\ncolour = red\n", "x.valve: line 4: unknown group [paint]"},
      // Units.
      {VALVE "[seal]\nsection_diameter = 1.61\n",
       "x.valve: [seal] section_diameter: \"1.61\" has no unit, write for example \"1.61 mm\" "
       "(allowed 0.2 to 20 mm)"},
      {VALVE "[seal]\nsection_diameter = 1.61 MPa\n",
       "x.valve: [seal] section_diameter: \"MPa\" is a unit of another kind, expected mm or "
       "another unit of that kind (allowed 0.2 to 20 mm)"},
      {VALVE "[seal]\nsection_diameter =\n",
       "x.valve: [seal] section_diameter: no value (allowed 0.2 to 20 mm)"},
      {VALVE "[seal]\nmodulus = 2.5 MPa # soft\n",
       "x.valve: [seal] modulus: \"2.5 MPa # soft\": a comment must be on a line of its own "
       "(allowed 0.1 to 10000 MPa)"},
      // Range and NaN.
      {VALVE "[seal]\nsection_diameter = 21 mm\n",
       "x.valve: [seal] section_diameter: 21 mm is out of range (allowed 0.2 to 20 mm)"},
      {VALVE "[seal]\nmodulus = nan MPa\n",
       "x.valve: [seal] modulus: \"nan MPa\" is not a finite number (allowed 0.1 to 10000 MPa)"},
      {VALVE "[output]\nframes = 1.5\n",
       "x.valve: [output] frames: \"1.5\" is not a whole number (allowed 2 to 20000000)"},
      {VALVE "[models]\nsurface = sandpaper\n",
       "x.valve: [models] surface: \"sandpaper\" is not one of the names (allowed "
       "greenwood-tripp, persson)"},
      // Lines.
      {VALVE "[seal]\nsection_diam",
       "x.valve: line 5: \"section_diam\" is not \"key = value\" (is the file cut off?)"},
      {VALVE "[sea", "x.valve: line 4: \"[sea\" is not a [group]"},
      {VALVE "[seal]\nmodulus = 2 MPa\nmodulus = 3 MPa\n",
       "x.valve: [seal] modulus: is given twice (again on line 6)"},
      {VALVE "[seal]\n[gland]\n[seal]\n", "x.valve: line 6: group [seal] appears twice"},
      {"kind = valve\n" VALVE, "x.valve: line 1: a key is before the first [group]"},
      {VALVE "title = a\x1b[31mb\nvalve = y\n",
       "x.valve: [sealbench] valve: only a scene names a valve"},
      // Scenes.
      {SCENE, "x.valve: [sealbench] valve: is missing: a scene names its valve's file"},
      // Combinations.
      {VALVE "[stem]\npressure_diameter = 7 mm\n",
       "x.valve: [bore] diameter: the bore is smaller than the stem (stem.pressure_diameter "
       "7 mm) (allowed at least 7 mm)"},
      // Several at once, in the order of the file.
      {VALVE "[seal]\nmodulus = 1\nfoo = 2\n[gland]\nradial_space = -1 mm\n",
       "x.valve: [seal] modulus: \"1\" has no unit, write for example \"1 MPa\" (allowed 0.1 to "
       "10000 MPa)\n"
       "x.valve: [seal] foo: unknown key\n"
       "x.valve: [gland] radial_space: -1 mm is out of range (allowed 0.1 to 20 mm)"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    char *lines = complaints(cases[i].text, strlen(cases[i].text));
    if (strcmp(lines, cases[i].says) != 0) {
      g_error("case %zu:\n%s\nsays\n%s\nnot\n%s", i, cases[i].text, lines, cases[i].says);
    }
    g_free(lines);
  }
}

static void test_binary(void) {
  static const char nul[] = VALVE "[seal]\nmodulus = 2\0 MPa\n";
  char *lines = complaints(nul, sizeof nul - 1);
  g_assert_cmpstr(lines, ==, "x.valve: is binary, not text");
  g_free(lines);
  lines = complaints(VALVE "\xff\xfe\n", strlen(VALVE) + 3);
  g_assert_cmpstr(lines, ==, "x.valve: line 4: is not UTF-8 text");
  g_free(lines);

  // The first bytes of a program and of a picture.
  char *program = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents("/proc/self/exe", &program, &length, NULL));
  lines = complaints(program, MIN(length, 4096));
  g_assert_cmpstr(lines, ==, "x.valve: is binary, not text");
  g_free(lines);
  g_free(program);
}

// A file cut anywhere is read or complained about; without its kind it is always refused.
static void test_truncated(void) {
  char *path = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "valves", "piston.valve", NULL);
  char *text = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(path, &text, &length, NULL));
  gsize head = (gsize)(strstr(text, "kind = valve") - text) + strlen("kind = valve");
  for (gsize cut = 0; cut < length; cut += SB_SANITIZED ? 61 : 7) {
    char *lines = complaints(text, cut);
    if (cut < head) {
      g_assert_cmpstr(lines, !=, "");
    }
    g_free(lines);
  }
  g_free(text);
  g_free(path);
}

static char *load_complaint(const char *path) {
  GPtrArray *issues = sb_issues_new();
  SbDocument *document = sb_document_load(path, issues);
  g_assert_cmpuint(issues->len, ==, 1);
  char *line = sb_issue_line(issues->pdata[0]);
  g_ptr_array_unref(issues);
  sb_document_free(document);
  return line;
}

static void expect(const char *path, const char *says) {
  char *line = load_complaint(path);
  char *expected = g_strdup_printf("%s: %s", path, says);
  g_assert_cmpstr(line, ==, expected);
  g_free(expected);
  g_free(line);
}

// Most memory that was resident so far [kB].
static long most_memory(void) {
  struct rusage usage;
  g_assert_cmpint(getrusage(RUSAGE_SELF, &usage), ==, 0);
  return usage.ru_maxrss;
}

static void test_files(void) {
  expect("/no/such.valve", "No such file or directory");
  expect(folder, "is a folder, not a file");
  expect("/dev/zero", "is not a regular file");

  char *path = g_build_filename(folder, "pipe.valve", NULL);
  g_assert_cmpint(mkfifo(path, 0600), ==, 0);
  expect(path, "is not a regular file");
  g_unlink(path);
  g_free(path);

  // A gigabyte is refused by its size, and not read.
  path = g_build_filename(folder, "huge.valve", NULL);
  int fd = open(path, O_WRONLY | O_CREAT, 0600);
  g_assert_cmpint(ftruncate(fd, 1 << 30), ==, 0);
  close(fd);
  long before = most_memory();
  expect(path, "is too large (1024.0 MiB) (allowed at most 1 MiB)");
  g_assert_cmpint(most_memory() - before, <, 64 * 1024);
  g_unlink(path);
  g_free(path);

  // The valve of a scene: missing, a folder, a scene, broken.
  char *scene = g_build_filename(folder, "s.scene", NULL);
  g_assert_true(g_file_set_contents(scene, SCENE "valve = gone.valve\n", -1, NULL));
  char *says = g_strdup_printf("[sealbench] valve: the valve's file %s/gone.valve: No such file or "
                               "directory",
                               folder);
  expect(scene, says);
  g_free(says);
  g_assert_true(g_file_set_contents(scene, SCENE "valve = s.scene\n", -1, NULL));
  char *line = load_complaint(scene);
  g_assert_nonnull(strstr(line, "s.scene: [sealbench] kind: a scene needs a valve here"));
  g_free(line);
  char *valve = g_build_filename(folder, "v.valve", NULL);
  g_assert_true(g_file_set_contents(valve, VALVE "[seal]\nmodulus = 2 mm\n", -1, NULL));
  g_assert_true(g_file_set_contents(scene, SCENE "valve = v.valve\n", -1, NULL));
  line = load_complaint(scene);
  g_assert_true(g_str_has_prefix(line, valve));
  g_assert_nonnull(strstr(line, "[seal] modulus: \"mm\" is a unit of another kind"));
  g_free(line);
  // A combination is told where its value stands.
  g_assert_true(g_file_set_contents(
      valve, VALVE "[bore]\ndiameter = 5 mm\n[stem]\npressure_diameter = 7 mm\n", -1, NULL));
  line = load_complaint(scene);
  g_assert_true(g_str_has_prefix(line, valve));
  g_free(line);
  g_unlink(valve);
  g_unlink(scene);
  g_free(valve);
  g_free(scene);
}

// A full mebibyte of nonsense: bounded output.
static void test_flood(void) {
  GString *text = g_string_new(VALVE "[seal]\n");
  for (int i = 0; text->len < SB_DOCUMENT_BYTES_MAX - 40; i++) {
    g_string_append_printf(text, "k%d = 1\n", i);
  }
  GPtrArray *issues = sb_issues_new();
  SbDocument *document = sb_document_parse(text->str, text->len, "x.valve", NULL, issues);
  g_assert_cmpuint(issues->len, ==, SB_ISSUES_MAX + 1);
  SbIssue *last = issues->pdata[SB_ISSUES_MAX];
  g_assert_true(g_str_has_prefix(last->text, "and "));
  sb_document_free(document);
  g_ptr_array_unref(issues);
  g_string_free(text, TRUE);
}

static void test_options(void) {
  static const struct {
    const char *option, *says;
  } cases[] = {
      {"seal.modulus=3MPa", ""},
      {"seal.modulus", "--set: \"seal.modulus\" is not KEY=VALUE"},
      {"=3", "--set: \"=3\" is not KEY=VALUE"},
      {"seal.moduls=3MPa", "--set: [seal] moduls: unknown key, do you mean seal.modulus?"},
      {"modulus=3MPa", "--set: modulus: unknown key"},
      {"seal.modulus=3", "--set: [seal] modulus: \"3\" has no unit, write for example \"3 MPa\" "
                         "(allowed 0.1 to 10000 MPa)"},
      {"seal.modulus=\xff", "--set: \"seal.modulus=?\" is not KEY=VALUE"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbDocument *document = sb_document_new();
    GPtrArray *issues = sb_issues_new();
    bool good = sb_document_set_option(document, cases[i].option, issues);
    g_assert_cmpint(good, ==, issues->len == 0);
    char *line = issues->len > 0 ? sb_issue_line(issues->pdata[0]) : g_strdup("");
    g_assert_cmpstr(line, ==, cases[i].says);
    g_free(line);
    g_ptr_array_unref(issues);
    sb_document_free(document);
  }
}

// Checks that a document's text is read without an issue and gives the same keys, with their
// values.
static void assert_reads_back(const SbDocument *document) {
  g_autofree char *text = sb_document_to_text(document, NULL);
  g_autofree char *found = complaints(text, strlen(text));
  g_assert_cmpstr(found, ==, "");
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbDocument *copy = sb_document_parse(text, strlen(text), "x.valve", folder, issues);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParamId id = (SbParamId)i;
    g_assert_true(sb_document_gives(copy, id) == sb_document_gives(document, id));
    g_assert_true(!sb_document_gives(copy, id) ||
                  sb_document_value(copy, id) == sb_document_value(document, id));
  }
  sb_document_free(copy);
}

// Whatever keys are set, in whatever order, the text has each group once: groups are interleaved in
// the catalogue. Then keys are added to that text and removed from it.
static void test_written(void) {
  g_autoptr(GRand) random = g_rand_new_with_seed(52);
  for (int run = 0; run < 60; run++) {
    g_autofree char *path = g_build_filename(folder, "written.valve", NULL);
    g_autoptr(GPtrArray) issues = sb_issues_new();
    SbDocument *document = sb_document_parse(VALVE, strlen(VALVE), "x.valve", folder, issues);
    for (int round = 0; round < 3; round++) {
      const double fraction = g_rand_double(random);
      for (int i = 0; i < SB_PARAM_COUNT; i++) {
        const SbParamId id = (SbParamId)i;
        const double value = sb_document_value(document, id);
        if (g_rand_double(random) < 0.1) {
          sb_document_unset(document, id);
        } else if (g_rand_double(random) < fraction && isfinite(value)) {
          g_assert_true(sb_document_set_value(document, id, value, false, NULL));
        }
      }
      assert_reads_back(document);
      g_assert_true(sb_document_save(document, path, NULL));
    }
    sb_document_free(document);
    g_assert_cmpint(g_remove(path), ==, 0);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  folder = g_dir_make_tmp("sealbench-test-XXXXXX", NULL);
  g_assert_nonnull(folder);
  g_test_add_func("/issues/table", test_table);
  g_test_add_func("/issues/binary", test_binary);
  g_test_add_func("/issues/truncated", test_truncated);
  g_test_add_func("/issues/files", test_files);
  g_test_add_func("/issues/flood", test_flood);
  g_test_add_func("/issues/options", test_options);
  g_test_add_func("/issues/written", test_written);
  int result = g_test_run();
  g_rmdir(folder);
  g_free(folder);
  return result;
}

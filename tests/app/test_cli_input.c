// What the program takes from people: words mistyped, values as they are written, standard input,
// and a machine with little memory.
#include "tests/app/cli_fixture.h"
#include "tests/sanitized.h"

#include <fcntl.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static void says(const char *const *arguments, int code, const char *text) {
  CliResult result = cli_run(arguments, NULL, NULL);
  if (result.code != code || strstr(result.err, text) == NULL) {
    g_error("%s %s: exit %d: \"%s\" lacks \"%s\"", arguments[0], arguments[1], result.code,
            result.err, text);
  }
  cli_clear(&result);
}
#define SAYS(code, text, ...) says((const char *const[]){__VA_ARGS__, NULL}, code, text)

static void test_mistyped(void) {
  const char *scene = cli.scene, *valve = cli.valve;
  SAYS(1, "no command \"rnu\", do you mean run?", "rnu", scene);
  SAYS(1, "no command \"--versoin\", do you mean --version?", "--versoin");
  SAYS(1, "no command \"dance\" (", "dance");
  SAYS(1, "Unknown option --qiet, do you mean --quiet?", "run", "--qiet", scene);
  SAYS(1, "Unknown option --frob (", "run", "--frob", scene);
  SAYS(1, "do you mean hysteresis?", "render", scene, "-o", "x.png", "--view", "hystersis");
  SAYS(1, "do you mean leak?", "render", scene, "-o", "x.png", "--view", "laek");
  SAYS(1, "do you mean outer?", "render", scene, "-o", "x.png", "--zoom", "otuer");
  SAYS(1, "do you mean egl?", "render", scene, "-o", "x.png", "--backend", "elg");
  SAYS(1, "do you mean inner?", "fit", valve, "--seal", "iner");
  SAYS(1, "do you mean ring?", "fit", valve, "--seal", "inner", "--model", "rnig");
  SAYS(1, "do you mean reynolds?", "film", "--load=850N/m", "--speed=10mm/s", "--radius=0.8mm",
       "--modulus=6MPa", "--viscosity=0.2mPa.s", "--model", "Reynods");
  SAYS(1, "do you mean params?", "list", "parms");
  SAYS(1, "do you mean gland.radial_space?", "plan", scene, "--set", "gland.radialspace=1.3mm");
  SAYS(1, "thesis-cylce: No such file or directory, do you mean thesis-cycle?", "run",
       "thesis-cylce");
  g_autofree char *near_valve = g_strndup(valve, strlen(valve) - 1);
  SAYS(1, "No such file or directory, do you mean piston.valve?", "check", near_valve);
  SAYS(1, "xyzzy.scene: No such file or directory\n", "run", "xyzzy.scene");
  SAYS(1, "xyzzy.scene: No such file or directory\n", "open", "xyzzy.scene");
  SAYS(1, "do you mean persson?", "plan", scene, "--set", "models.surface=person");
}

// An error of a solver states what is needed, not the range of the catalogue, which the value is
// in.
static void test_overfilled(void) {
  CliResult result = CLI("fit", cli.valve, "--seal", "outer", "--model", "ring", "--set",
                         "gland.axial_width=1.3 mm");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "the groove must be at least 1."));
  g_assert_null(strstr(result.err, "allowed"));
  cli_clear(&result);
}

// Help reads the same in every locale, signs of degree and all.
static void test_help(void) {
  static const char *const commands[] = {"run",     "render",   "plan",  "check",       "fit",
                                         "film",    "list",     "bench", "open",        "asperity",
                                         "fluid",   "study",    "merge", "sensitivity", "design",
                                         "compare", "calibrate"};
  char **environment = g_environ_setenv(g_get_environ(), "LC_ALL", "C", TRUE);
  for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
    const char *const arguments[] = {commands[i], "--help", NULL};
    CliResult result = cli_run(arguments, environment, NULL);
    g_assert_cmpint(result.code, ==, 0);
    g_assert_true(g_utf8_validate(result.out, -1, NULL));
    g_assert_null(strchr(result.out, '?'));
    g_assert_nonnull(strstr(result.out, "--help"));
    if (strcmp(commands[i], "render") == 0) {
      g_assert_nonnull(strstr(result.out, "\"-30°\""));
    }
    cli_clear(&result);
  }
  g_strfreev(environment);
}

static double load_of(const char *setting) {
  CliResult result = CLI("fit", cli.valve, "--seal", "outer", "--json", "-", "--set", setting);
  g_assert_cmpstr(result.err, ==, "");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  double load = cli_number(root, "load_N");
  json_node_unref(root);
  cli_clear(&result);
  return load;
}

// A percentage with a sign changes the value in force; one without is a number.
static void test_percent(void) {
  double whole = load_of("seal.modulus=2.5 MPa");
  g_assert_cmpfloat_with_epsilon(load_of("seal.modulus=+5 %") / whole, 1.05, 1e-9);
  g_assert_cmpfloat_with_epsilon(load_of("seal.modulus=-20%") / whole, 0.8, 1e-9);
  g_assert_cmpfloat_with_epsilon(load_of("seal.poisson_ratio=-2%"),
                                 load_of("seal.poisson_ratio=0.4802"), 1e-9);
  g_assert_cmpfloat_with_epsilon(load_of("seal.poisson_ratio=48 %"),
                                 load_of("seal.poisson_ratio=0.48"), 1e-9);
  const char *scene = cli.scene;
  SAYS(1, "another kind", "plan", scene, "--set", "seal.modulus=5 %");
  SAYS(1, "changes it to 50 MPa, out of range", "plan", scene, "--set", "canister.pressure=0.5 MPa",
       "--set", "canister.pressure=+9900%");
  SAYS(1, "no percentage changes", "plan", scene, "--set", "storage.swell_mass=0 %", "--set",
       "rubber.thermal_expansion=0 1/K", "--set", "rubber.thermal_expansion=+5%");
  SAYS(1, "whole number", "plan", scene, "--set", "output.frames=+0.3%");
}

// ---- Standard input ----

static const char *input; // path

static void from_input(gpointer data) {
  int fd = open(input, O_RDONLY | O_CLOEXEC);
  dup2(fd, STDIN_FILENO);
}

static CliResult with_input(const char *const *arguments, const char *path) {
  input = path;
  g_autofree char *folder = g_path_get_dirname(cli.scene);
  return cli_run_in(folder, arguments, NULL, G_SPAWN_CHILD_INHERITS_STDIN, from_input);
}
#define WITH(path, ...) with_input((const char *const[]){__VA_ARGS__, NULL}, path)

static void test_standard_input(void) {
  CliResult result = WITH(cli.scene, "plan", "-", "--json", "-");
  CliResult same = CLI("plan", cli.scene, "--json", "-");
  g_assert_cmpstr(result.err, ==, "");
  // The documents differ in the file's name only.
  g_assert_nonnull(strstr(result.out, "\"scene\": \"-\""));
  g_assert_cmpstr(strstr(result.out, "\"fields\""), ==, strstr(same.out, "\"fields\""));
  cli_clear(&result);
  cli_clear(&same);
  result = WITH(cli.valve, "check", "-", cli.scene);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.out, "-: a valve without problems\n"));
  g_assert_nonnull(strstr(result.out, "thesis-cycle.scene: a scene without problems\n"));
  cli_clear(&result);
  // What is wrong is said of it; it ends, whatever comes.
  result = WITH("/dev/zero", "check", "-");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "standard input: is too large"));
  cli_clear(&result);
  result = WITH("/", "check", "-");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "standard input: Is a directory"));
  cli_clear(&result);
  result = WITH("/dev/null", "run", "-");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "standard input: is not a valve or scene"));
  cli_clear(&result);
  result = WITH(cli.scene, "plan", "-", "--set", "bore.diameter=5 mm", "--set",
                "stem.pressure_diameter=7 mm");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "standard input: [bore] diameter"));
  cli_clear(&result);
}

// A valve runs, and it is said what.
static void test_valve(void) {
  CliResult result = CLI("run", cli.valve, "--json", "/dev/null");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.err, "piston.valve is a valve, no scene: its default cycle"));
  cli_clear(&result);
  result = CLI("run", cli.valve, "--json", "/dev/null", "--quiet");
  g_assert_cmpstr(result.err, ==, "");
  cli_clear(&result);
  result = CLI("run", cli.scene, "--json", "/dev/null");
  g_assert_null(strstr(result.err, "default cycle"));
  cli_clear(&result);
}

// ---- Little memory ----

static rlim_t most; // [B], of what the setup limits

static void limit_memory(gpointer data) {
  setrlimit(RLIMIT_AS, &(struct rlimit){most, most});
  alarm(30); // instead of for ever
}

static void limit_stack(gpointer data) {
  setrlimit(RLIMIT_STACK, &(struct rlimit){256 << 10, 256 << 10});
  alarm(60);
}

// Without a word in the environment on the threads of OpenBLAS.
static char **plain_environment(void) {
  return g_environ_unsetenv(g_get_environ(), "OPENBLAS_NUM_THREADS");
}

// Whatever the address space, the program ends: it answers, or says what is missing.
static void test_memory(void) {
  if (SB_SANITIZED) {
    g_test_skip("sanitizers take the address space");
    return;
  }
  char **environment = plain_environment();
  const char *const version[] = {"--version", NULL};
  const char *const film[] = {"film",
                              "--load=850N/m",
                              "--speed=10mm/s",
                              "--radius=0.8mm",
                              "--modulus=6MPa",
                              "--viscosity=0.2mPa.s",
                              NULL};
  g_autofree char *folder = g_path_get_dirname(cli.scene);
  g_autofree char *scene = g_build_filename(folder, "quick-look.scene", NULL);
  const char *const run[] = {"run", scene, "--quiet", NULL};
  int refused = 0, solved = 0;
  for (most = (rlim_t)140000 << 10; most <= (rlim_t)380000 << 10; most += (rlim_t)40000 << 10) {
    CliResult result = cli_run(version, environment, limit_memory);
    g_assert_cmpint(result.code, ==, 0);
    g_assert_true(g_str_has_prefix(result.out, "sealbench "));
    g_assert_cmpstr(result.err, ==, "");
    cli_clear(&result);
    result = cli_run(run, environment, limit_memory);
    g_assert_cmpint(result.code, ==, 0);
    cli_clear(&result);
    result = cli_run(film, environment, limit_memory);
    refused += result.code == 3;
    solved += result.code == 0;
    g_assert_true(result.code == 0 || strstr(result.err, "not enough memory") != NULL);
    cli_clear(&result);
  }
  g_assert_cmpint(refused, >, 0);
  g_assert_cmpint(solved, >, 0);
  g_assert_cmpint(refused + solved, ==, 7);
  g_strfreev(environment);
}

// A scene of closed forms runs on a small stack.
static void test_stack(void) {
  if (SB_SANITIZED) {
    g_test_skip("sanitizers widen the stack's frames");
    return;
  }
  g_autofree char *folder = g_path_get_dirname(cli.scene);
  g_autofree char *scene = g_build_filename(folder, "quick-look.scene", NULL);
  const char *const run[] = {"run", scene, "--quiet", NULL};
  CliResult result = cli_run(run, NULL, limit_stack);
  g_assert_cmpstr(result.err, ==, "");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli-input/mistyped", test_mistyped);
  g_test_add_func("/cli-input/overfilled", test_overfilled);
  g_test_add_func("/cli-input/help", test_help);
  g_test_add_func("/cli-input/percent", test_percent);
  g_test_add_func("/cli-input/standard-input", test_standard_input);
  g_test_add_func("/cli-input/valve", test_valve);
  g_test_add_func("/cli-input/memory", test_memory);
  g_test_add_func("/cli-input/stack", test_stack);
  int result = g_test_run();
  cli_tear_down();
  return result;
}

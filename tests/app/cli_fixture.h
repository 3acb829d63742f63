// The program run from a test: its exit code, what it printed, and a look into its JSON.
#pragma once

#include <glib.h>
#include <json-glib/json-glib.h>
#include <stdbool.h>

// What the tests run, and a folder for what it writes. Set up by cli_set_up().
typedef struct {
  const char *program;
  char *valve, *scene; // piston.valve, thesis-cycle.scene
  char *folder;        // empty, of this process
} CliFixture;

extern CliFixture cli;

void cli_set_up(void);
void cli_tear_down(void);

typedef struct {
  int code; // 128 + signal if it was killed
  char *out, *err;
} CliResult;

void cli_clear(CliResult *result);

// Runs the program with arguments up to NULL; `environment` NULL: ours; `setup` runs in the child.
CliResult cli_run(const char *const *arguments, char **environment, GSpawnChildSetupFunc setup);

// The same in a folder (NULL: this one) and with flags of its start.
CliResult cli_run_in(const char *folder, const char *const *arguments, char **environment,
                     GSpawnFlags flags, GSpawnChildSetupFunc setup);

#define CLI(...) cli_run((const char *const[]){__VA_ARGS__, NULL}, NULL, NULL)

// Strict JSON; fails the test on anything else.
JsonNode *cli_parse(const char *text);

// The node at "a.b.c" (numbers index arrays), and its number; fails if there is none.
JsonNode *cli_at(JsonNode *node, const char *path);
double cli_number(JsonNode *root, const char *path);

// All of "a.b c.d" are there.
void cli_has_keys(JsonNode *root, const char *keys);

// Text of a file in a folder.
char *cli_contents(const char *where, const char *name);

// Removes the folder of a run's results; fails if anything else is in it.
void cli_remove_results(const char *where);

// Starts programs and reads the processor time that the system reports for each; see the header.
#include "app/cli/start_up.h"

#include "app/base/number.h"

#include <fcntl.h>
#include <glib.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const char program[] = "/proc/self/exe";
static const char *const started_commands[SB_START_UP_COMMANDS] = {"--version", "--help",
                                                                   "run --help", "list params"};

// Processor time of one start [s]; negative if it failed.
static double start(const char *path, const char *words, int out, char **environment) {
  g_autofree char *line = g_strconcat("sealbench ", words, NULL);
  g_auto(GStrv) arguments = g_strsplit(line, " ", -1);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  pid_t child = 0;
  const int problem = posix_spawn(&child, path, &actions, NULL, arguments, environment);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  struct rusage used;
  if (problem != 0 || wait4(child, &status, 0, &used) != child || status != 0) {
    return -1;
  }
  return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

// Median of `repeats` starts after a warm-up [s]; negative if one failed.
static double measure(const char *path, const char *words, int repeats) {
  g_auto(GStrv) environment = g_get_environ();
  g_autofree double *times = g_new(double, repeats);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  double least = start(path, words, nowhere, environment);
  for (int i = 0; i < repeats && least >= 0; i++) {
    times[i] = start(path, words, nowhere, environment);
    least = MIN(least, times[i]);
  }
  close(nowhere);
  return least < 0 ? -1 : sb_number_median(times, (size_t)repeats);
}

// Number of shared objects that the dynamic linker lists instead of running the program, as ldd
// does; 0: it did not.
static int count_shared_objects(void) {
  g_auto(GStrv) environment =
      g_environ_setenv(g_get_environ(), "LD_TRACE_LOADED_OBJECTS", "1", TRUE);
  char *arguments[] = {(char *)program, NULL};
  g_autofree char *text = NULL;
  int count = 0;
  if (g_spawn_sync(NULL, arguments, environment, G_SPAWN_DEFAULT, NULL, NULL, &text, NULL, NULL,
                   NULL)) {
    for (const char *end = strchr(text, '\n'); end != NULL; end = strchr(end + 1, '\n')) {
      count++;
    }
  }
  return count;
}

bool sb_start_up_measure(SbStartUp *out, int repeats) {
  out->empty_s = measure("/bin/true", "", repeats);
  out->limit_s = MAX(15e-3, 4 * out->empty_s);
  out->shared_objects = count_shared_objects();
  bool good = out->empty_s >= 0 && out->shared_objects > 0;
  for (int i = 0; i < SB_START_UP_COMMANDS && good; i++) {
    out->processor_s[i] = measure(program, started_commands[i], repeats);
    good = out->processor_s[i] >= 0;
  }
  return good;
}

void sb_start_up_put(SbJson *json, const SbStartUp *of) {
  sb_json_object(json, "start_up");
  sb_json_number(json, "empty_program_s", of->empty_s);
  sb_json_number(json, "limit_s", of->limit_s);
  sb_json_count(json, "shared_objects", (size_t)of->shared_objects);
  sb_json_array(json, "commands");
  for (int i = 0; i < SB_START_UP_COMMANDS; i++) {
    sb_json_object(json, NULL);
    sb_json_string(json, "command", started_commands[i]);
    sb_json_number(json, "processor_s", of->processor_s[i]);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
  sb_json_object_end(json);
}

void sb_start_up_print(const SbStartUp *of) {
  printf("\nStart-up (processor time; limit %.3g ms, an empty program takes %.3g ms; %d shared "
         "objects)\n",
         1e3 * of->limit_s, 1e3 * of->empty_s, of->shared_objects);
  for (int i = 0; i < SB_START_UP_COMMANDS; i++) {
    printf("  %-14s %8.3f ms\n", started_commands[i], 1e3 * of->processor_s[i]);
  }
}

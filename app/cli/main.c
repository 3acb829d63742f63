// sealbench: the command line. Finds the command and hands over.
#include "app/cli/cli.h"
#include "app/cli/wrap.h"

#include "app/base/output.h"
#include "app/base/reader.h"
#include "app/run/process.h"

#include "sealbench_features.h"

#include <errno.h>
#include <glib.h>
#include <gsl/gsl_version.h>
#include <locale.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// One item a line: the identity, what this build contains, the versions of the libraries that the
// program is linked with, and those of the other libraries as the build found them.
static void print_version(void) {
  const SbEngineIdentity *engine = sb_engine_identity();
  printf("sealbench %s\ncommit %s\nsource %s\ncompiler %s\nfeatures %s\n", engine->version,
         engine->commit != NULL ? engine->commit : "none", engine->source, engine->options,
         SB_FEATURES);
  printf("GLib %u.%u.%u\nGSL %s\n", glib_major_version, glib_minor_version, glib_micro_version,
         gsl_version);
  fputs(SB_BUILT_WITH, stdout);
}

static void print_help(FILE *stream) {
  fprintf(stream, "Sealbench %s: a workbench for the seals of inhaler valves.\n\nUsage:\n",
          sb_version());
  for (const SbCommand *command = sb_commands(); command->name != NULL; command++) {
    g_autofree char *head = g_strdup_printf("%s %s", command->name, command->usage);
    if (strlen(head) > 32) {
      fprintf(stream, "  sealbench %s\n  %43s%s\n", head, "", command->help);
    } else {
      fprintf(stream, "  sealbench %-32s %s\n", head, command->help);
    }
  }
  fputs("  sealbench --version | --help | COMMAND --help\n\n"
        "Values carry units: --load 850.2N/m, --set seal.section_diameter=1.63mm.\n"
        "--set KEY=+5% changes the value in force by a percentage. FILE - is standard input.\n"
        "Exit codes: 0 done, 1 bad input, 2 not converged, 3 input/output failed, "
        "130 interrupted.\n",
        stream);
}

// Whether the reader of standard output has closed its end, as `head` does when it has enough.
static bool reader_is_gone(void) {
  struct stat info;
  struct pollfd out = {.fd = STDOUT_FILENO, .events = POLLOUT};
  return fstat(STDOUT_FILENO, &info) == 0 && (S_ISFIFO(info.st_mode) || S_ISSOCK(info.st_mode)) &&
         poll(&out, 1, 0) > 0 && (out.revents & (POLLERR | POLLHUP)) != 0;
}

int main(int argc, char **argv) {
  sb_process_set_up();
  // The workbench saves what it has opened, which must be a file.
  if (argc < 2 || strcmp(argv[1], "tui") != 0) {
    sb_output_protect_inputs();
    sb_reader_read_pipes();
    sb_wrap_standard_output();
  }
  int code = SB_EXIT_INPUT;
  const SbCommand *command = sb_commands();
  while (argc > 1 && command->name != NULL && strcmp(command->name, argv[1]) != 0) {
    command++;
  }
  if (argc < 2) {
    print_help(stderr);
  } else if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
    print_help(stdout);
    code = SB_EXIT_DONE;
  } else if (strcmp(argv[1], "--version") == 0) {
    print_version();
    code = SB_EXIT_DONE;
  } else if (command->name == NULL) {
    g_autoptr(GString) names = g_string_new("--help|--version");
    for (command = sb_commands(); command->name != NULL; command++) {
      g_string_append_printf(names, "|%s", command->name);
    }
    sb_cli_unknown("there is no command", argv[1], names->str, "see sealbench --help");
  } else {
    code = command->main(argc - 1, argv + 1);
  }
  fflush(stdout);
  sb_wrap_end();
  // A full disk behind standard output shows here at the latest.
  if ((fflush(stdout) != 0 || ferror(stdout) != 0) && code == SB_EXIT_DONE && !reader_is_gone()) {
    sb_cli_fail("standard output: %s", g_strerror(errno));
    code = SB_EXIT_IO;
  }
  return code;
}

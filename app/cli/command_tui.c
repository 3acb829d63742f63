// sealbench tui: the workbench in a terminal.
#include "app/cli/cli.h"
#include "app/document/shipped.h"
#include "app/terminal/workbench.h"

#include <string.h>

static const char *const colors[] = {"none", "16", "256", "truecolor"};
static const char *const pictures[] = {"auto",   "sixel", "kitty", "iterm",
                                       "blocks", "lines", "none"};

static bool choose_terminal(int *out, const char *option, const char *text,
                            const char *const *names, size_t count) {
  g_autoptr(GString) list = g_string_new(NULL);
  for (size_t i = 0; i < count; i++) {
    if (strcmp(names[i], text) == 0) {
      *out = (int)i;
      return true;
    }
    g_string_append_printf(list, "%s%s", i > 0 ? "|" : "", names[i]);
  }
  g_autofree char *what = g_strdup_printf("%s: there is no", option);
  sb_cli_unknown(what, text, list->str, NULL);
  return false;
}

int sb_command_tui(int argc, char **argv) {
  char *color = NULL, *picture = NULL;
  gboolean ascii = FALSE;
  const GOptionEntry entries[] = {
      {"colors", 0, 0, G_OPTION_ARG_FILENAME, &color,
       "none, 16, 256 or truecolor; default from NO_COLOR, COLORTERM and TERM", "N"},
      {"pictures", 0, 0, G_OPTION_ARG_FILENAME, &picture,
       "sixel, kitty, iterm, blocks, lines or none; else what the terminal reports", "KIND"},
      {"ascii", 0, 0, G_OPTION_ARG_NONE, &ascii, "No other signs than ASCII's", NULL},
      {0},
  };
  int code = SB_EXIT_INPUT;
  int chosen_colors = (int)sb_colors_of_environment(), chosen_pictures = 0;
  if (sb_cli_parse(&argc, &argv, entries, 0, 1, NULL) &&
      (color == NULL ||
       choose_terminal(&chosen_colors, "--colors", color, colors, G_N_ELEMENTS(colors))) &&
      (picture == NULL || choose_terminal(&chosen_pictures, "--pictures", picture, pictures,
                                          G_N_ELEMENTS(pictures)))) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    const char *path = argc > 1 ? argv[1] : NULL;
    const SbWorkbenchOptions options = {.path = path,
                                        .issues = issues,
                                        .screen = {.colors = (SbColors)chosen_colors,
                                                   .pictures = (SbPictures)chosen_pictures,
                                                   .ascii = ascii || sb_cells_ascii_environment()}};
    GError *error = NULL;
    const bool good = sb_workbench_run(&options, &error);
    if (issues->len > 0 && path != NULL) {
      sb_cli_add_file_hint(path, SB_SHIPPED_FOR_RUN, issues);
    }
    sb_cli_issues(issues);
    code = good ? SB_EXIT_DONE : error != NULL ? sb_cli_error(error) : SB_EXIT_INPUT;
  }
  return code;
}

// sealbench check: every problem of valves, scenes, projects, studies, rubbers, sections, grooves
// and measured tables, as lines or as JSON.
#include "app/base/output.h"
#include "app/base/reader.h"
#include "app/cli/cli.h"
#include "app/document/picture.h"
#include "app/document/rubber_sheet.h"
#include "app/document/seal_file.h"
#include "app/document/shipped.h"
#include "app/study/calibrate.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

typedef enum { SEVERITY_ERROR, SEVERITY_WARNING, SEVERITY_NOTE, SEVERITIES } Severity;

static const char *const severity_names[SEVERITIES] = {
    [SEVERITY_ERROR] = "error", [SEVERITY_WARNING] = "warning", [SEVERITY_NOTE] = "note"};

// One file: its text, and what the check found.
typedef struct {
  const char *path;  // that is read; "-": standard input
  const char *shown; // in messages
  char *directory;   // where other files are looked for; NULL: the current folder
  char *text;
  size_t length;
  const char *kind;              // "valve"; NULL: not recognised. Static
  GPtrArray *issues[SEVERITIES]; // of SbIssue
  SbDocument *document;          // of a valve, scene or project; of a study its scene, borrowed
  SbModel *model;
  SbStudyFile *study;
  SbMeasured *measured; // of a table of measurements
  char **settings;      // of --set, borrowed; NULL: none
} Check;

// ---- Kinds ----

static void take_notes(Check *check, const GPtrArray *notes) {
  for (guint i = 0; i < notes->len; i++) {
    sb_issues_add_copy(check->issues[SEVERITY_NOTE], notes->pdata[i]);
  }
}

static void take_document_notes(Check *check, const SbDocument *document) {
  take_notes(check, sb_document_notes(document));
  sb_document_kept(document, check->issues[SEVERITY_NOTE]);
}

static void check_document(Check *check) {
  GPtrArray *errors = check->issues[SEVERITY_ERROR];
  check->document =
      sb_document_parse(check->text, check->length, check->shown, check->directory, errors);
  if (check->document == NULL) {
    return;
  }
  sb_document_set_options(check->document, check->settings, errors);
  check->kind = sb_document_kind(check->document) != SB_DOCUMENT_SCENE ? "valve"
                : sb_document_is_project(check->document)              ? "project"
                                                                       : "scene";
  if (errors->len == 0 && sb_document_compile(check->document, &check->model, errors)) {
    sb_document_remarks(check->document, check->model, check->issues[SEVERITY_WARNING]);
    if (check->settings != NULL) {
      (void)sb_document_check_cases(check->document, errors);
    }
  }
  take_document_notes(check, check->document);
}

static void check_study(Check *check) {
  check->kind = "study";
  check->study = sb_study_file_parse(check->text, check->length, check->shown, check->directory,
                                     check->settings, NULL, check->issues[SEVERITY_ERROR]);
  if (check->study != NULL) {
    take_document_notes(check, check->study->scene);
    take_notes(check, check->study->notes);
  }
  if (check->study != NULL && check->study->data->len > 0) {
    sb_calibrate_check(check->study, check->issues[SEVERITY_ERROR]);
  }
}

// A table of numbers without any group: a measured loop.
static void check_measured(Check *check) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbData *data = sb_data_of_file(check->shown);
  SbParams params;
  sb_params_init(&params);
  const double speed = sb_data_drive_speed(sb_params_get(&params, SB_P_DRIVE_KIND),
                                           sb_params_get(&params, SB_P_DRIVE_SPEED));
  check->measured = sb_measured_read(data, speed, check->text, check->length, issues);
  sb_data_free(data);
  if (check->measured == NULL) {
    const SbIssue *first = issues->len > 0 ? issues->pdata[0] : NULL;
    sb_issues_add(check->issues[SEVERITY_ERROR], check->shown, first != NULL ? first->line : 0,
                  NULL, first != NULL ? first->allowed : NULL,
                  "has no group such as [sealbench], and is not a table of measurements: %s",
                  first != NULL ? first->text : "it cannot be read");
    return;
  }
  check->kind = "measured table";
  g_autofree char *doubts = sb_measured_doubts(check->measured);
  if (doubts != NULL) {
    sb_issues_add(check->issues[SEVERITY_WARNING], check->shown, 0, NULL, NULL, "%s", doubts);
  }
}

static void check_rubber(Check *check) {
  SbRubberSheet sheet;
  check->kind = "rubber";
  (void)sb_rubber_sheet_parse(&sheet, check->text, check->length, check->shown,
                              check->issues[SEVERITY_ERROR]);
}

static void check_drawing(Check *check) {
  bool groove = false;
  GError *error = NULL;
  const bool good = sb_seal_file_check(&groove, check->text, check->length, check->path, &error);
  check->kind = groove ? "groove" : "section";
  if (!good) {
    // The message begins with the file, which the issue names itself.
    const char *colon = strstr(error->message, ": ");
    sb_issues_add(check->issues[SEVERITY_ERROR], check->shown, 0, NULL, NULL, "%s",
                  colon != NULL ? colon + 2 : error->message);
    g_error_free(error);
  }
}

// Replaces a picture that this program wrote by the text of its scene.
static bool take_picture(Check *check) {
  GError *error = NULL;
  char *scene = sb_picture_find_scene(check->text, check->length, &error);
  if (scene == NULL) {
    sb_issues_add(check->issues[SEVERITY_ERROR], check->shown, 0, NULL, NULL, "%s", error->message);
    g_error_free(error);
    return false;
  }
  g_free(check->text);
  check->text = scene;
  check->length = strlen(scene);
  return true;
}

static void check_text(Check *check) {
  static const char signature[] = "\x89PNG";
  const bool picture = check->length > 4 && memcmp(check->text, signature, 4) == 0;
  if (picture && !take_picture(check)) {
    return;
  }
  bool grouped = false;
  g_autofree char *kind = sb_reader_kind(&grouped, check->text, check->length);
  if (g_strcmp0(kind, "study") == 0) {
    check_study(check);
  } else if (g_strcmp0(kind, "rubber") == 0) {
    check_rubber(check);
  } else if (kind == NULL && sb_seal_file_is_drawing(check->text, check->path)) {
    check_drawing(check);
  } else if (!grouped) {
    check_measured(check);
  } else {
    check_document(check);
  }
  if (check->settings != NULL && check->document == NULL && check->study == NULL &&
      check->issues[SEVERITY_ERROR]->len == 0) {
    sb_issues_add(check->issues[SEVERITY_ERROR], check->shown, 0, NULL, NULL,
                  "is a %s: --set changes valves, scenes, projects and studies", check->kind);
  }
}

// ---- One file ----

// Fills in the lines of issues that name a key of this file but no line.
static void find_lines(Check *check) {
  g_autoptr(GPtrArray) ignored = sb_issues_new();
  g_autoptr(GPtrArray) entries = sb_reader_scan(check->text, check->length, "", ignored);
  for (int k = 0; k < SEVERITIES; k++) {
    for (guint i = 0; i < check->issues[k]->len; i++) {
      SbIssue *issue = check->issues[k]->pdata[i];
      if (issue->line > 0 || issue->key == NULL || g_strcmp0(issue->file, check->shown) != 0) {
        continue;
      }
      for (guint e = 0; e < entries->len && issue->line == 0; e++) {
        const SbEntry *entry = entries->pdata[e];
        g_autofree char *key = entry->name != NULL
                                   ? g_strdup_printf("%s.%s", entry->group, entry->name)
                                   : g_strdup(entry->group);
        issue->line = strcmp(key, issue->key) == 0 ? entry->line : 0;
      }
    }
  }
}

static bool load(Check *check) {
  const bool stream = strcmp(check->path, "-") == 0;
  // Drawings, pictures and tables may be larger than key files.
  static const char *const endings[] = {".png", ".csv", ".tsv", ".txt", ".dat"};
  bool large = sb_seal_file_is_drawing("", check->path);
  for (size_t i = 0; i < G_N_ELEMENTS(endings); i++) {
    large = large || sb_output_ends_in(check->path, endings[i]);
  }
  const size_t most = large ? (size_t)256 << 20 : SB_DOCUMENT_BYTES_MAX;
  check->shown = stream ? "standard input" : check->path;
  check->directory = sb_reader_folder(check->path);
  GPtrArray *errors = check->issues[SEVERITY_ERROR];
  check->text =
      stream ? sb_reader_load_stream(&check->length, STDIN_FILENO, check->shown, most, errors)
             : sb_reader_load(&check->length, check->path, check->shown, most, errors);
  return check->text != NULL;
}

static void clear(Check *check) {
  for (int k = 0; k < SEVERITIES; k++) {
    g_ptr_array_unref(check->issues[k]);
  }
  sb_document_free(check->document);
  sb_model_destroy(check->model);
  sb_study_file_free(check->study);
  sb_measured_free(check->measured);
  g_free(check->directory);
  g_free(check->text);
}

// ---- Output ----

// Values in force that neither the file nor the catalogue gives, but another parameter.
static void print_derived(const SbDocument *document) {
  SbParams params = sb_document_params(document);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    SbParamDefault derived;
    sb_params_default(&derived, &params, (SbParamId)i);
    if (!params.given[i] && derived.from != NULL && sb_param((SbParamId)i)->parent < 0) {
      g_autofree char *value = sb_document_text(document, (SbParamId)i);
      g_autofree char *giver = derived.name != NULL
                                   ? g_strdup(derived.name)
                                   : sb_document_text(document, (SbParamId)derived.giver);
      printf("%s = %s (%s = %s; %s: %s)\n", sb_param((SbParamId)i)->key, value, derived.from, giver,
             derived.tag, derived.source);
    }
  }
}

// Group of an issue: that of its key, else the one around its line; NULL: none. Owned by the
// caller.
static char *group_of(const SbIssue *issue, int key_group_length, const Check *check,
                      const GPtrArray *entries) {
  if (key_group_length > 0) {
    return g_strndup(issue->key, (gsize)key_group_length);
  }
  const char *group = NULL;
  for (guint i = 0; g_strcmp0(issue->file, check->shown) == 0 && i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    group = entry->line <= issue->line ? entry->group : group;
  }
  return g_strdup(group);
}

static void put_issue(SbJson *json, Severity severity, const SbIssue *issue, const Check *check,
                      const GPtrArray *entries) {
  int group_length = 0;
  const char *key = sb_issue_key(issue, &group_length);
  g_autofree char *group = group_of(issue, group_length, check, entries);
  sb_json_object(json, NULL);
  sb_json_string(json, "severity", severity_names[severity]);
  sb_json_string(json, "file", issue->file);
  sb_json_number(json, "line", issue->line > 0 ? issue->line : NAN);
  sb_json_string(json, "group", group);
  sb_json_string(json, "key", key);
  sb_json_string(json, "text", issue->text);
  sb_json_string(json, "allowed", issue->allowed);
  sb_json_object_end(json);
}

static void put_check(SbJson *json, const Check *check) {
  g_autofree char *full =
      strcmp(check->path, "-") == 0 ? g_strdup("-") : g_canonicalize_filename(check->path, NULL);
  sb_json_object(json, NULL);
  sb_json_string(json, "file", full);
  sb_json_string(json, "kind", check->kind);
  sb_json_array(json, "issues");
  g_autoptr(GPtrArray) ignored = sb_issues_new();
  g_autoptr(GPtrArray) entries =
      sb_reader_scan(check->text != NULL ? check->text : "", check->length, "", ignored);
  for (int k = 0; k < SEVERITIES; k++) {
    for (guint i = 0; i < check->issues[k]->len; i++) {
      put_issue(json, (Severity)k, check->issues[k]->pdata[i], check, entries);
    }
  }
  sb_json_array_end(json);
  sb_json_object_end(json);
}

static void print_check(const Check *check, const char *operand) {
  const GPtrArray *warnings = check->issues[SEVERITY_WARNING];
  for (guint i = 0; i < check->issues[SEVERITY_NOTE]->len; i++) {
    const SbIssue *note = check->issues[SEVERITY_NOTE]->pdata[i];
    sb_cli_fail("note: %s", note->text);
  }
  for (guint i = 0; i < warnings->len; i++) {
    g_autofree char *line = sb_issue_line(warnings->pdata[i]);
    printf("warning: %s\n", line);
  }
  if (!sb_cli_quiet() && check->issues[SEVERITY_ERROR]->len == 0) {
    g_autofree char *shown = sb_printable(operand, strlen(operand));
    if (check->document != NULL) {
      print_derived(check->document);
    }
    if (check->measured != NULL) {
      sb_cli_recognised(check->measured);
    }
    printf("%s: a %s without %s\n", shown, check->kind, warnings->len > 0 ? "errors" : "problems");
  }
}

// Checks one operand; an exit code. `json` NULL: lines are printed.
static int check_operand(SbJson *json, const char *operand, char **settings) {
  g_autofree char *path = sb_shipped_resolve(operand, SB_SHIPPED_ANY);
  Check check = {.path = path, .settings = settings};
  for (int k = 0; k < SEVERITIES; k++) {
    check.issues[k] = sb_issues_new();
  }
  GPtrArray *errors = check.issues[SEVERITY_ERROR];
  if (load(&check)) {
    check_text(&check);
    find_lines(&check);
  } else {
    sb_cli_add_file_hint(operand, SB_SHIPPED_ANY, errors);
  }
  if (errors->len == 0 && check.document != NULL) {
    sb_cli_check_data(check.document, json == NULL, errors);
  }
  sb_cli_issues(errors);
  if (json != NULL) {
    put_check(json, &check);
  } else {
    print_check(&check, operand);
  }
  const int code = errors->len > 0 ? SB_EXIT_INPUT : SB_EXIT_DONE;
  clear(&check);
  return code;
}

int sb_command_check(int argc, char **argv) {
  char *target = NULL;
  char **settings = NULL;
  const GOptionEntry entries[] = {
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, "All problems as JSON, to a file or -",
       "FILE|-"},
      {0},
  };
  if (!sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL)) {
    return SB_EXIT_INPUT;
  }
  SbJson json;
  int code = SB_EXIT_DONE, streams = 0;
  for (int i = 1; i < argc; i++) {
    streams += strcmp(argv[i], "-") == 0;
  }
  if (streams > 1) {
    return sb_cli_fail("-: standard input can be only one of the files");
  }
  if (target != NULL) {
    sb_json_document(&json);
    sb_json_array(&json, "files");
  }
  for (int i = 1; i < argc && !sb_cli_interrupted(NULL); i++) {
    const int checked = check_operand(target != NULL ? &json : NULL, argv[i], settings);
    code = MAX(code, checked);
  }
  if (target != NULL) {
    sb_json_array_end(&json);
    sb_json_object_end(&json);
    g_autofree char *text = sb_json_finish(&json);
    const int written = sb_cli_emit(text, target);
    code = MAX(code, written);
  }
  return code;
}

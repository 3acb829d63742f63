// What all commands share: options, messages, exit codes, tables, interrupts, progress.
//
// Results go to standard output, everything else to standard error as "sealbench: ...". The program
// never calls setlocale(): numbers and files are the same everywhere.
#pragma once

#include "app/data/compare.h"
#include "app/document/document.h"
#include "app/document/study_file.h"
#include "app/export/json.h"
#include "app/study/shares.h"

#include "engine/valve/sealbench.h"
#include "engine/valve/studies/study.h"

#include <stdio.h>

enum {
  SB_EXIT_DONE = 0,
  SB_EXIT_INPUT = 1,         // bad input or usage; nothing was written
  SB_EXIT_NOT_CONVERGED = 2, // results are written and flagged
  SB_EXIT_IO = 3,
  SB_EXIT_INTERRUPTED = 130 // what was finished is written and flagged
};

typedef struct {
  const char *name;
  const char *usage; // behind the name
  const char *help;  // one line
  int (*main)(int argc, char **argv);
} SbCommand;

// All commands, ending with a name of NULL.
const SbCommand *sb_commands(void);

// Takes the options that every command has (--quiet, --progress; with `entries` --no-overwrite),
// and those of `entries` (NULL-terminated; strings as G_OPTION_ARG_FILENAME, so that bytes pass
// untouched) out of argv, which keeps its name and the operands. Prints a message and returns false
// for wrong ones or a number of operands outside [min, max]. Handles --help and exits.
bool sb_cli_parse(int *argc, char ***argv, const GOptionEntry *entries, int operands_min,
                  int operands_max, const char *notes);

// Help of --set, the same for every command.
#define SB_CLI_SET_HELP                                                                            \
  "Overrides a parameter; a percentage with a sign, +5% or -5%, changes its value in force"

// Help of --jobs; and its number of threads, one a processor without a text. False with a message.
#define SB_CLI_JOBS_HELP "Threads; default one a processor"
bool sb_cli_jobs(int *threads, const char *text);

// Help of --json where there may be several files.
#define SB_CLI_JSON_HELP "JSON to a file or -; of several files an array"

// "sealbench: ..." on standard error; returns SB_EXIT_INPUT.
int sb_cli_fail(const char *format, ...) G_GNUC_PRINTF(1, 2);

// Prints and frees an error; returns its exit code.
int sb_cli_error(GError *error);

// Says `what` ("--view: there is no view") of a mistyped word, the one most like it in the list
// `names` ("first|second"), and behind that `see`, or where NULL, the list; SB_EXIT_INPUT.
int sb_cli_unknown(const char *what, const char *word, const char *names, const char *see);

// Such a list of names counted from 0, each by a call. Owned by the caller.
char *sb_cli_names(const char *(*name)(int), int count);

// Exit code of an engine's status, with its message printed unless it is SB_OK.
int sb_cli_status(SbStatus status, const SbReport *report);

// Prints each on a line.
void sb_cli_issues(const GPtrArray *issues);

// Reads an option's value with unit; prints what is wrong. `text` NULL: `required` decides.
bool sb_cli_quantity(double *out, const char *option, const char *text, bool required,
                     const char *si, const char *shown);

// --quiet: no table, no notes and no progress, also with --progress.
bool sb_cli_quiet(void);

// "sealbench: ..." on standard error where progress is shown too.
void sb_cli_note(const char *format, ...) G_GNUC_PRINTF(1, 2);

// Opens a valve or scene ("-": standard input), applies KEY=VALUE settings and compiles; prints
// every problem and returns NULL if there is any. It and *model are owned by the caller.
SbDocument *sb_cli_open(SbModel **model, const char *path, char **settings);

// Opens a study or a shipped study ("-": standard input) with KEY=VALUE settings for its scene;
// prints every problem and returns NULL if there is any. Owned by the caller (sb_study_file_free).
SbStudyFile *sb_cli_open_study(const char *path, char **settings);

// Appends a hint to the only issue of an operand that could not be opened: the most similar name
// among the shipped files of these kinds (shipped.h) and the files in the operand's folder.
void sb_cli_add_file_hint(const char *path, unsigned kinds, GPtrArray *issues);

// Full path of the file that an operand names (sb_shipped_resolve()), for results; "-" (standard
// input) stays. Owned by the caller (g_free).
char *sb_cli_full_path(const char *operand, unsigned kinds);

// One operand of a command that takes several.
typedef struct {
  const char *path;     // as given
  char *full;           // full path of the file that it names; "-" for standard input
  char *name;           // of its folder below -o
  char *folder;         // for its results: that of -o, of several files one in it; NULL without -o
  SbDocument *document; // NULL: has a problem, which was told
  SbModel *model;       // compiled from it
} SbCliFile;

typedef struct {
  SbCliFile *file;
  int count, at;   // at: the one being worked on
  int heads;       // printed so far
  int code;        // the highest exit code so far
  GPtrArray *json; // of char *, a document of each file that has one
} SbCliFiles;

enum { SB_CLI_FILES_MAX = 10000 };

// Opens argv[1] and on; prints every problem. False if nothing can be done: none is sound, standard
// input is named twice, or results of two files would go to one folder. To be closed in any case.
bool sb_cli_files_open(SbCliFiles *files, int argc, char **argv, char **settings,
                       const char *folder);
void sb_cli_files_close(SbCliFiles *files);

// The next sound file, which progress and messages name from now on if there are several; NULL
// after the last, and after an interrupt.
SbCliFile *sb_cli_files_next(SbCliFiles *files);

// Prints the name of the file in front of its table, where there are several.
void sb_cli_files_head(SbCliFiles *files);

// Takes the exit code of a file into account.
void sb_cli_files_done(SbCliFiles *files, int code);

// Writes the documents: that of the only operand, or an array. Nothing where there are none.
void sb_cli_files_emit(SbCliFiles *files, const char *target);

// Progress and messages name this file (NULL: none); borrowed.
void sb_cli_name_file(const char *path);

// Whether there is memory for the dense solvers of a run of `model` (NULL: of anything), told
// before the work; prints what is missing.
bool sb_cli_has_memory(const SbModel *model);

// Whether `names` (NULL-terminated, below `folder`, which will be made as theirs are) and then the
// file `target` can be written and are no inputs; any may be NULL. To be called when the inputs are
// read and before the work. An exit code.
int sb_cli_check_outputs(const char *folder, char *const *names, const char *target);

// The same for files that do not go into a folder; any may be NULL.
int sb_cli_check_targets(const char *const *targets, size_t count);

// Tells which files of an earlier result (char *) are still in the folder.
void sb_cli_kept(const char *folder, const GPtrArray *kept);

// Writes `json` to standard output ("-") or a file, whole or not at all; returns an exit code.
int sb_cli_emit(const char *json, const char *target);

// "  Contact width        0.8886 mm": a figure with at most five digits; "-" if it is not finite.
void sb_cli_figure(const char *label, double value, const char *si, const char *shown);
void sb_cli_rows(const SbResultRow *row, const void *of); // those with a label
void sb_cli_line(const char *label, const char *text);
void sb_cli_warnings(const SbWarnings *warnings);

// After this Ctrl-C, SIGTERM and, unless it was ignored, SIGHUP only set a flag; a second one ends
// the program at once, but not between the files of one result.
void sb_cli_catch_interrupts(void);
bool sb_cli_interrupted(void *unused);

// Progress on standard error: a bar on a terminal, otherwise what --progress asks for: a line every
// 10 %, or a JSON object every percent.
typedef struct {
  const char *what; // "drawing ", in front of the percentage; may be empty
  int last;         // last percent (bar, JSON) or decile (lines) shown
  int width;        // columns of the line that the bar printed last
  gint64 start;     // [us]
} SbProgress;

void sb_progress_start(SbProgress *progress, const char *what);
void sb_progress_update(SbProgress *progress, double fraction);
void sb_progress_end(SbProgress *progress);

// Computes a study with progress and interrupts; prints what is wrong. SB_EXIT_DONE or
// SB_EXIT_NOT_CONVERGED (with gaps) leave *out to be written, anything else does not.
int sb_cli_study(SbStudy *out, SbStudyKind kind, const SbModel *model);

// Help of --measured; and the measured loop that it names (a file or a shipped example), read as
// the scene's group [data] of that file says, or without `operand` that of the scene's first group.
// NULL without either, and with messages where *code is no SB_EXIT_DONE. Owned by the caller.
#define SB_CLI_MEASURED_HELP "Force over displacement from a test machine, any table of numbers"
SbMeasured *sb_cli_measured(int *code, const SbDocument *document, const char *operand);

// Reads all groups of data and adds their problems to `issues`; prints what was recognised if
// `print` is set and unless --quiet is given.
void sb_cli_check_data(const SbDocument *document, bool print, GPtrArray *issues);

// Prints what was recognised in a measured table, a line each.
void sb_cli_recognised(const SbMeasured *measured);

// Prints what was recognised, the stages and the differences.
void sb_cli_comparison(const SbComparison *comparison);

// Returns the name of the measured loop and its differences from the run in one line. Owned by the
// caller (g_free).
char *sb_cli_comparison_brief(const SbComparison *comparison);

int sb_command_run(int argc, char **argv);
int sb_command_check(int argc, char **argv);
int sb_command_list(int argc, char **argv);
int sb_command_fit(int argc, char **argv);
int sb_command_film(int argc, char **argv);
int sb_command_asperity(int argc, char **argv);
int sb_command_fluid(int argc, char **argv);
int sb_command_plan(int argc, char **argv);
int sb_command_render(int argc, char **argv);
int sb_command_bench(int argc, char **argv);
int sb_command_study(int argc, char **argv);
int sb_command_merge(int argc, char **argv);
int sb_command_store(int argc, char **argv);
int sb_command_calibrate(int argc, char **argv);
int sb_command_compare(int argc, char **argv);
int sb_command_design(int argc, char **argv);
int sb_command_sensitivity(int argc, char **argv);
int sb_command_surface(int argc, char **argv);
int sb_command_cad(int argc, char **argv);
int sb_command_thesis(int argc, char **argv);
int sb_command_report(int argc, char **argv);
int sb_command_open(int argc, char **argv);
int sb_command_tui(int argc, char **argv);

// ---- Commands that need a study file's answers ----

// Who computes them (app/study/answers.h); borrowed. NULL, as at the start: threads of this
// process. Whether this process only computes what another one's pool asks.
void sb_cli_set_pool(const SbAnswerPool *pool);
bool sb_cli_answers_elsewhere(void);

// The store's file: `given`, or NAME.store next to the study file; in the current folder if the
// study belongs to the installed program or its folder cannot be written. NULL for a study from
// standard input. Owned by the caller.
char *sb_cli_store_path(const char *given, const SbStudyFile *study);

typedef struct {
  const char *store; // NULL: in memory
  int threads;
  size_t shard, shards; // as SbQuestions
} SbCliAsk;

// What there is once they are computed, or interrupted; borrowed.
typedef struct {
  const SbStudyFile *study;
  const double *value; // [samples][vary]
  const SbStudyDrawn *drawn;
  const SbAnswers *answers;
  const char *cpus;
  const char *store; // path, NULL: in memory
} SbCliAnswers;
typedef int (*SbCliAnswered)(void *data, const SbCliAnswers *of);

// Computes them and calls `answered`, whose exit code counts with that of the samples.
int sb_cli_answer(const SbStudyFile *study, const SbCliAsk *ask, SbCliAnswered answered,
                  void *data);

// ---- Commands that answer a study file with a folder ----

typedef struct {
  char *folder, *jobs, *json;
  char **settings;
  int threads;
} SbCliStudyOptions;

// Parses -o, --jobs, --set, --json and one file.
bool sb_cli_study_parse(SbCliStudyOptions *out, int *argc, char ***argv, const char *folder_help);
void sb_cli_study_clear(SbCliStudyOptions *options);

// What a command makes of a study file: whether it asks for that (else an issue), the names of
// what is written into the folder, and the work, whose exit code it returns.
typedef struct {
  bool (*asks)(const SbStudyFile *study, const char *path, GPtrArray *issues);
  void (*names)(GPtrArray *names, const SbStudyFile *study); // of char *, owned by the array
  int (*solve)(const SbCliStudyOptions *options, const SbStudyFile *study);
} SbCliStudyWork;
int sb_cli_study_run(const SbCliStudyOptions *options, const char *path,
                     const SbCliStudyWork *work);

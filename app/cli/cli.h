// Shared by all commands: options, messages, exit codes, tables, interrupts, progress.
//
// Results go to standard output, everything else to standard error as "sealbench: ...". The program
// never calls setlocale(): numbers and files are the same everywhere. All functions run in the main
// thread, except sb_cli_interrupted(). Options, the interrupt flag and the name of the file that
// messages name are state of the process.
#pragma once

#include "app/base/output.h"
#include "app/data/compare.h"
#include "app/document/document.h"
#include "app/document/study_file.h"
#include "app/run/cases.h"
#include "app/study/shares.h"
#include "app/table/table.h"

#include "engine/valve/sealbench.h"
#include "engine/valve/studies/study.h"

#include <stdio.h>

// Exit codes of the program.
enum {
  SB_EXIT_DONE = 0,
  SB_EXIT_INPUT = 1,         // bad input or usage; nothing was written
  SB_EXIT_NOT_CONVERGED = 2, // a solver did not converge; results are written and flagged
  SB_EXIT_IO = 3,            // a file cannot be read or written, or memory is short
  SB_EXIT_INTERRUPTED = 130  // Ctrl-C; what was finished is written and flagged
};

// A command of the program. All texts are static.
typedef struct {
  const char *name;                   // the first argument, such as "run"
  const char *usage;                  // options and operands after the name, for --help
  const char *help;                   // one line
  int (*main)(int argc, char **argv); // argv[0] is the name; returns the exit code
} SbCommand;

// Returns all commands; the last one has the name NULL.
const SbCommand *sb_commands(void);

// Removes from *argv, with their values, the options of `entries` (ends with a name of NULL;
// strings as G_OPTION_ARG_FILENAME, so that bytes are not converted) and those of every command
// (--quiet, --progress and, unless `entries` is NULL, --no-overwrite and --overwrite). (*argv)[0]
// must be the name of a command and stays; the operands follow it. `notes` (NULL: none) are printed
// at the end of --help. Returns false, with a message, for a wrong option or if the number of
// operands is outside of [operands_min, operands_max]. --help prints and ends the program. The
// values of options live until the program ends and are not freed.
bool sb_cli_parse(int *argc, char ***argv, const GOptionEntry *entries, int operands_min,
                  int operands_max, const char *notes);

// Help of --set, the same for every command.
#define SB_CLI_SET_HELP                                                                            \
  "Overrides a parameter; a percentage with a sign, +5% or -5%, changes its value in force"

// Help of --jobs.
#define SB_CLI_JOBS_HELP "Threads; default one a processor"

// Reads the value of --jobs, 1 to 256 threads; `text` NULL: one per processor. Returns false with a
// message if it is not such a number.
bool sb_cli_jobs(int *threads, const char *text);

// Help of --json of a command that takes several files.
#define SB_CLI_JSON_HELP "JSON to a file or -; of several files an array"

// ---- Messages ----

// Prints "sealbench: " and the formatted text on standard error; returns SB_EXIT_INPUT.
int sb_cli_fail(const char *format, ...) G_GNUC_PRINTF(1, 2);

// Prints and frees `error`, which must not be NULL; returns the exit code that belongs to it
// (SB_EXIT_IO for an error of another domain than SB_APP_ERROR).
int sb_cli_error(GError *error);

// Prints that `word` is unknown: `what` ("--view: there is no view"), the word, the most similar
// one of `names` ("first|second"), and `see` in parentheses, or if it is NULL the list. Returns
// SB_EXIT_INPUT.
int sb_cli_unknown(const char *what, const char *word, const char *names, const char *see);

// Returns a list for sb_cli_unknown(): the names that `name` returns for 0 to count - 1, joined by
// "|".
char *sb_cli_names(const char *(*name)(int), int count);

// Returns the exit code of a status of the engine; prints the message of `report` (not NULL) unless
// `status` is SB_OK.
int sb_cli_status(SbStatus status, const SbReport *report);

// Prints each SbIssue of the list on a line.
void sb_cli_issues(const GPtrArray *issues);

// Reads the value of `option` ("--speed"), a number with unit ("10 mm/s"; without a unit only if
// `si` is "1"), to *out [si]. `si` is the SI unit and `shown` the usual unit for messages ("":
// none). `text` NULL: the option is absent; *out stays unchanged, and the result is true unless
// `required`. Returns false with a message for an absent required option or a wrong value.
bool sb_cli_quantity(double *out, const char *option, const char *text, bool required,
                     const char *si, const char *shown);

// Returns whether --quiet was given: no tables, no notes and no progress are printed.
bool sb_cli_quiet(void);

// Prints "sealbench: " and the text on standard error if progress is shown there, too: on a
// terminal or with --progress, without --quiet.
void sb_cli_note(const char *format, ...) G_GNUC_PRINTF(1, 2);

// ---- Inputs ----

// Opens a valve or scene, shipped or a file ("-": standard input), applies the KEY=VALUE `settings`
// (ends with NULL; NULL: none) and compiles it to *model, which must be NULL before. Prints all
// problems and notes. Returns NULL if there is any problem. Freed by sb_document_free(); free
// *model with sb_model_destroy() in any case.
SbDocument *sb_cli_open(SbModel **model, const char *path, char **settings);

// Opens a study, shipped or a file ("-": standard input), with KEY=VALUE settings for its scene.
// Prints all problems; returns NULL if there is any. Freed by sb_study_file_free().
SbStudyFile *sb_cli_open_study(const char *path, char **settings);

// Opens a study as sb_cli_open_study(), or a valve or scene as sb_cli_open(), by the kind that the
// file itself states: sets *study to the study and returns NULL, without a model; or sets *study to
// NULL and returns the document. If both are NULL there was a problem, which is printed.
SbDocument *sb_cli_open_either(SbStudyFile **study, SbModel **model, const char *path,
                               char **settings);

// Appends a hint to the only issue of an operand that does not exist: the most similar name among
// the shipped files of `kinds` (bits of SbShippedKind, app/document/shipped.h) and the files in the
// operand's folder. Does nothing if there is another number of issues.
void sb_cli_add_file_hint(const char *path, unsigned kinds, GPtrArray *issues);

// Returns the full path of the file that an operand names (sb_shipped_resolve()); "-" (standard
// input) stays.
char *sb_cli_full_path(const char *operand, unsigned kinds);

// One operand of a command that takes several files.
typedef struct {
  const char *path;     // as given
  char *full;           // full path of the file that it names; "-" for standard input
  char *name;           // of its folder below -o: its file name without ending
  char *folder;         // for its results: -o, or with several files -o/name; NULL without -o
  SbDocument *document; // NULL: it has a problem, which was printed
  SbModel *model;       // of the document
} SbCliFile;

// The operands of a command.
typedef struct {
  SbCliFile *file; // [count]
  int count;
  int at;          // index of the file being worked on; -1 before the first
  int heads;       // headings printed so far
  int code;        // highest exit code so far: the result of the command
  GPtrArray *json; // of char *: the caller adds the JSON document of each file
} SbCliFiles;

// Largest number of operands.
enum { SB_CLI_FILES_MAX = 10000 };

// What a command does with its files.
typedef struct {
  char **settings;    // of --set
  const char *folder; // of -o; NULL: none
  const char *json;   // where files->json is written: a path or "-"; NULL: not wanted
  // Checks the outputs before the work; NULL: that of `json`. Returns an exit code.
  int (*check)(const SbCliFiles *files, void *data);
  // Works on a sound file, which progress and messages name if there are several. An exit code.
  int (*work)(SbCliFiles *files, const SbCliFile *file, void *data);
  void *data;
} SbCliFilesWork;

// Opens argv[1] to argv[argc - 1] as valves or scenes, prints all problems, works on the sound
// files one after the other until an interrupt, and writes files->json: the document of the only
// operand, or an array. Standard input named twice, or two files that would write to one folder,
// are refused. Returns the highest exit code.
int sb_cli_files_run(int argc, char **argv, const SbCliFilesWork *work);

// Prints the name of the present file as a heading of its table if there are several files.
void sb_cli_files_head(SbCliFiles *files);

// Sets the file that progress and messages name (NULL: none). The text is copied.
void sb_cli_name_file(const char *path);

// ---- Checks before the work ----

// Returns whether there is memory for the dense solvers of a run of `model` (NULL: of any model);
// prints a message if not (exit code SB_EXIT_IO).
bool sb_cli_has_memory(const SbModel *model);

// Checks before the work that the outputs can be written and are none of the inputs that were read:
// the files `names` (ends with NULL) in `folder`, which is created with the first of them, and then
// the file `target`. `folder` with `names`, or `target`, may be NULL. Call it when all inputs are
// read. Returns SB_EXIT_DONE, or another exit code with a message.
int sb_cli_check_outputs(const char *folder, char *const *names, const char *target);

// As sb_cli_check_outputs() for `count` files; an element may be NULL.
int sb_cli_check_targets(const char *const *targets, size_t count);

// Prints a message for each file of an earlier result (`kept`, of char *: names in `folder`) that
// was not deleted because it was changed since.
void sb_cli_kept(const char *folder, const GPtrArray *kept);

// Writes the folder `path` as one result: calls `fill` (app/base/output.h) once with `data`, and
// then gives all files their names. Files of an earlier result of `command` (the command's name)
// that this one does not have are deleted, or named as by sb_cli_kept(). Returns SB_EXIT_DONE, or
// another exit code with a message.
int sb_cli_write_folder(const char *path, const char *command, SbOutputFill fill, void *data);

// ---- Output ----

// Prints a table, or writes its rows as JSON if `target` is not NULL. Returns an exit code.
int sb_cli_table(const SbTable *table, const char *target);

// Writes the text `json` to standard output ("-") or atomically to the file `target`. Returns
// SB_EXIT_DONE, or another exit code with a message.
int sb_cli_emit(const char *json, const char *target);

// Prints a line of a table on standard output, "  Contact width        0.8886 mm": `value` [si] in
// the unit `shown` with five significant digits; "-" if it is not finite.
void sb_cli_figure(const char *label, double value, const char *si, const char *shown);

// Prints a line for each row that has a label; `row` ends with a key of NULL, and `of` is the
// structure from which the rows take their values (app/export/results.h).
void sb_cli_rows(const SbResultRow *row, const void *of);

// Prints a line of a table with a text in place of a number.
void sb_cli_line(const char *label, const char *text);

// Prints the warnings below a heading on standard output; nothing if there are none.
void sb_cli_warnings(const SbWarnings *warnings);

// ---- Interrupts and progress ----

// From this call on, Ctrl-C, SIGTERM and, unless it was ignored, SIGHUP set a flag. A second signal
// ends the program immediately, but not while the files of one result are being replaced.
void sb_cli_catch_interrupts(void);

// Returns whether such a signal came. Any thread; the parameter is not used, so that this can be a
// `cancelled` callback.
bool sb_cli_interrupted(void *unused);

// Progress on standard error: a bar on a terminal; otherwise what --progress requests, a line every
// 10 % or a JSON object every percent; nothing with --quiet.
typedef struct {
  const char *what; // in front of the percentage, such as "drawing "; may be empty; borrowed
  int last;         // last percent (bar, JSON) or tenth (lines) that was printed
  int width;        // columns of the line that the bar printed last
  gint64 start;     // of the work, by g_get_monotonic_time() [us]
} SbProgress;

// Begins; nothing is printed yet.
void sb_progress_start(SbProgress *progress, const char *what);

// Prints the fraction done, 0 to 1, if it differs from what was printed last. `progress` is an
// SbProgress; void, so that this can be a callback.
void sb_progress_update(void *progress, double fraction);

// Removes the bar.
void sb_progress_end(SbProgress *progress);

// ---- Work that several commands share ----

// Computes a drawn study with progress and interrupts. Returns SB_EXIT_DONE, or with a message
// SB_EXIT_NOT_CONVERGED (points are missing); both leave a complete *out. With another exit code,
// *out is not to be written. An SbStudy owns nothing; it is too large for a stack.
int sb_cli_study(SbStudy *out, SbStudyKind kind, const SbModel *model);

// Computes the drawn studies of `mask` (bit 1 << SbStudyKind) in the order of SbStudyKind. Appends
// those with a result to out[], which has room for SB_STUDY_COUNT, and adds their number to *count
// (0 at first). An interrupt ends them. Returns the last exit code other than SB_EXIT_DONE.
int sb_cli_studies(SbStudy *out, size_t *count, const SbModel *model, unsigned mask);

// Creates and executes a run, with the text `what` before its progress; an interrupt ends it with
// SB_ERROR_CANCELLED. After an error *out is the run with its frames so far, or NULL if it could
// not be created. Freed by sb_run_destroy().
SbStatus sb_cli_compute(SbRun **out, const SbModel *model, const SbPlan *plan, const char *what,
                        SbReport *report);

// Writes the worst answers of the finished run of a scene (with its `count` studies) and of its
// cases to verdict[SB_VERDICT_COUNT]; prints the problems and appends them to `problems` (as
// sb_cases_judge()). `verdict` is complete in any case. Returns SB_OK, or the status of the last
// case that failed; SB_ERROR_CANCELLED after an interrupt.
SbStatus sb_cli_judge(SbCaseVerdict *verdict, GPtrArray *problems, const SbRun *run,
                      const SbDocument *document, const SbStudy *studies, size_t count);

// Help of --measured.
#define SB_CLI_MEASURED_HELP "Force over displacement from a test machine, any table of numbers"

// Reads the measured loop that --measured names (a file or a shipped example), with the keys of the
// scene's group [data] for this file if there is one. `operand` NULL: the file of the scene's first
// group. Returns NULL with *code SB_EXIT_DONE if there is neither, or with messages and another
// code if it cannot be read. Freed by sb_measured_free().
SbMeasured *sb_cli_measured(int *code, const SbDocument *document, const char *operand);

// Reads the files of all groups [data] and appends their problems to `issues`; prints what was
// recognised if `print` is set, unless --quiet is given.
void sb_cli_check_data(const SbDocument *document, bool print, GPtrArray *issues);

// Prints what was recognised in a measured table (sb_measured_text()).
void sb_cli_recognised(const SbMeasured *measured);

// Prints what was recognised, the stages and the differences of a comparison.
void sb_cli_comparison(const SbComparison *comparison);

// Returns the name of the measured loop and its differences from the run in one line.
char *sb_cli_comparison_brief(const SbComparison *comparison);

// ---- The commands: argv[0] is the command's name; each returns the exit code ----

// run: computes the cycle of scenes.
int sb_command_run(int argc, char **argv);

// check: reports every problem of valves, scenes, studies, rubbers, sections and grooves.
int sb_command_check(int argc, char **argv);

// list: prints parameters, figures, models, views, fluids, or files that ship.
int sb_command_list(int argc, char **argv);

// fit: fits one seal into its gland.
int sb_command_fit(int argc, char **argv);

// film: computes the film of a sliding line contact.
int sb_command_film(int argc, char **argv);

// asperity: prints Greenwood and Tripp's integrals F2 and F5/2.
int sb_command_asperity(int argc, char **argv);

// fluid: prints the properties of a propellant, ethanol or a silicone oil.
int sb_command_fluid(int argc, char **argv);

// plan: prints what scenes would compute, and why.
int sb_command_plan(int argc, char **argv);

// render: draws a view of scenes.
int sb_command_render(int argc, char **argv);

// bench: measures error against time for every solver.
int sb_command_bench(int argc, char **argv);

// study: computes figures of many valves: grids, samples, sensitivities.
int sb_command_study(int argc, char **argv);

// merge: joins stores of studies.
int sb_command_merge(int argc, char **argv);

// store: verifies the rows of a store, saves the sound ones, or writes them as a table.
int sb_command_store(int argc, char **argv);

// calibrate: fits parameters to measured loops and reports which are identifiable.
int sb_command_calibrate(int argc, char **argv);

// compare: compares runs with each other and with a measured loop.
int sb_command_compare(int argc, char **argv);

// design: finds the best valve within bounds and limits.
int sb_command_design(int argc, char **argv);

// sensitivity: computes the derivatives of figures with respect to parameters, with their errors.
int sb_command_sensitivity(int argc, char **argv);

// surface: computes roughness, asperities and spectrum of a measured surface.
int sb_command_surface(int argc, char **argv);

// cad: lists the bodies of a drawing, and writes a scene whose parts have their shapes.
int sb_command_cad(int argc, char **argv);

// thesis: recomputes a table or figure of the thesis and compares it with the printed values.
int sb_command_thesis(int argc, char **argv);

// report: writes inputs, pictures, figures with their errors and the verdict as pages.
int sb_command_report(int argc, char **argv);

// open: starts the window.
int sb_command_open(int argc, char **argv);

// tui: starts the workbench in a terminal.
int sb_command_tui(int argc, char **argv);

// ---- Commands that compute the samples of a study file ----

// Sets what computes the samples (app/study/answers.h); borrowed. NULL, the initial value: threads
// of this process.
void sb_cli_set_pool(const SbAnswerPool *pool);

// Returns whether this process only computes samples that another process with a pool requests; it
// then prints and writes nothing.
bool sb_cli_answers_elsewhere(void);

// Returns the path of the store: `given`, or if it is NULL, NAME.store next to the study file (in
// the current folder if the study belongs to the installed program or its folder is not writable).
// NULL if `given` is NULL and the study is from standard input.
char *sb_cli_store_path(const char *given, const SbStudyFile *study);

// Options of a computation of samples.
typedef struct {
  const char *store;    // path of the store; NULL: in memory
  int threads;          // number of threads, from 1
  size_t shard, shards; // only the samples i with i % shards == shard; shards 0: all samples
} SbCliAsk;

// The samples once they are computed, or those that are finished after an interrupt. All is
// borrowed and valid during the callback.
typedef struct {
  const SbStudyFile *study;
  const double *value;       // [samples][vary]: the parameters [SI; index of a choice]
  const SbStudyDrawn *drawn; // points of the method (app/study/shares.h)
  const SbAnswers *answers;  // figures and status of each sample
  const char *cpus;          // types of CPU that computed them, for the user
  const char *store;         // path; NULL: in memory
} SbCliAnswers;

// Prints and writes the results; returns an exit code.
typedef int (*SbCliAnswered)(void *data, const SbCliAnswers *of);

// Computes the samples of `study` that the store does not have, with progress and interrupts, and
// calls `answered` once. After an interrupt it has the samples that are finished. `answered` is not
// called after another error, after an interrupt before the first sample, and if
// sb_cli_answers_elsewhere(). Returns the highest of the exit codes of the work, of `answered` and
// of the samples (SB_EXIT_NOT_CONVERGED if a solver did not converge in one). Failures are printed.
int sb_cli_answer(const SbStudyFile *study, const SbCliAsk *ask, SbCliAnswered answered,
                  void *data);

// ---- Commands that write a folder for a study file: design, calibrate ----

// Options of these commands. Initialised by sb_cli_study_parse().
typedef struct {
  char *folder, *jobs, *json; // values of -o, --jobs, --json; NULL: absent
  char **settings;            // values of --set, ends with NULL; NULL: none
  int threads;                // from --jobs
} SbCliStudyOptions;

// Parses -o, --jobs, --set, --json and one operand, as sb_cli_parse(); `folder_help` is the help of
// -o. Returns false with a message.
bool sb_cli_study_parse(SbCliStudyOptions *out, int *argc, char ***argv, const char *folder_help);

// The work of such a command.
typedef struct {
  // Returns whether the study file has the groups that the command needs; else appends an issue.
  bool (*asks)(const SbStudyFile *study, const char *path, GPtrArray *issues);
  // Appends the names of the files that `solve` writes into the folder (char *, owned by the
  // array).
  void (*names)(GPtrArray *names, const SbStudyFile *study);
  // Computes, prints and writes; returns the exit code.
  int (*solve)(const SbCliStudyOptions *options, const SbStudyFile *study);
} SbCliStudyWork;

// Opens the study file `path`, checks it and the outputs, and calls work->solve(). Returns the exit
// code; failures are printed.
int sb_cli_study_run(const SbCliStudyOptions *options, const char *path,
                     const SbCliStudyWork *work);

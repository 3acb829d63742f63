// A study file: the scene, the parameters that vary and how, and the requested results.
//
// GKeyFile text like a scene's. [sealbench] has kind = study and scene = FILE; [vary] has a line
// for each parameter; [correlation]; [study] has the method, samples, seed and figures; [limits];
// [design] and [tolerances] are for `sealbench design`, which uses the ranges of [vary] as bounds;
// [data] is for `sealbench calibrate`, which uses them as priors; [leakage_test] simulates tests
// whose cans are the samples (engine/valve/answer/leakage_test.h).
//
// A grid can be extended. Each group [vary NAME] is an additional grid, of its own lines and those
// of [vary]; samples are in the order of the groups, and the last line varies fastest. A name
// without a dot is a variable, which sets no parameter. `KEY = by EXPRESSION` is computed from
// variables and from the scene's values, which keys in an expression mean (expression.h). A
// variable that a group does not have is 0. Ends of ranges and levels can be expressions of the
// scene's values; `uniform A .. B, N and C, D` adds levels after the N of the range. `hold` in
// [study] names groups of the scene's parameters that are fixed (SB_HOLDS of
// engine/valve/studies/hold.h).
#pragma once

#include "app/document/document.h"

#include "engine/numeric/sampling.h"
#include "engine/valve/answer/leakage_test.h"

// X(enumerator, name in the file): the methods.
#define SB_STUDY_METHODS(X)                                                                        \
  X(SB_METHOD_GRID, "grid")                                                                        \
  X(SB_METHOD_MONTE_CARLO, "monte-carlo")                                                          \
  X(SB_METHOD_SOBOL_SEQUENCE, "sobol-sequence")                                                    \
  X(SB_METHOD_MORRIS, "morris")                                                                    \
  X(SB_METHOD_SOBOL_INDICES, "sobol-indices")                                                      \
  X(SB_METHOD_RELIABILITY, "reliability")

// How the samples are chosen.
typedef enum {
#define SB_STUDY_METHOD_ENUM(code, name) code,
  SB_STUDY_METHODS(SB_STUDY_METHOD_ENUM)
#undef SB_STUDY_METHOD_ENUM
      SB_METHOD_COUNT
} SbStudyMethod;

// Returns the name of a method as the file has it ("monte-carlo").
const char *sb_study_method_name(SbStudyMethod method);

// Largest numbers of varied parameters, of samples and of simulated leakage tests.
enum { SB_VARY_MAX = 64, SB_SAMPLES_MAX = 10000000, SB_LEAKAGE_TESTS = 1000 };

// One line of [vary], or of [tolerances].
typedef struct {
  SbParamId id;                // the parameter, or SB_VARY_VARIABLE
  bool offset;                 // a tolerance: added to the parameter's value
  SbDistribution distribution; // of the values [SI]; its levels are `levels`
  double *levels;              // freed by g_free(); NULL: no levels
  const SbModel *base;         // whose values expressions use; borrowed
  // Only for lines of an extended grid:
  char *name;   // of a variable; NULL: a parameter
  char *by;     // the expression; NULL: a distribution
  int line;     // number of the line in the file, from 1
  guint grid;   // number of the group [vary NAME], from 1; 0: [vary]
  guint column; // index of its value in a row of values
} SbVary;

// SbVary.id of a variable.
#define SB_VARY_VARIABLE ((SbParamId)-1)

// Returns the parameter's key or the variable's name.
const char *sb_vary_name(const SbVary *vary);

// Returns the SI unit of its values ("m"); "1" for a variable or a choice.
const char *sb_vary_si(const SbVary *vary);

// [design] and [tolerances].
typedef struct {
  bool asked;         // there is a group [design]
  bool maximise;      // the objective is maximised, else minimised
  int figure;         // the objective, an index of sb_figure(); negative: none
  double robust;      // required probability that all limits hold over the tolerances; NaN: none
  size_t starts;      // number of starts of the search
  GArray *tolerances; // of SbVary with `offset`: normal or uniform
} SbDesignWish;

// A study. Freed by sb_study_file_free(), with everything in it.
typedef struct {
  char *path;        // NULL: standard input or memory
  char *title;       // of [sealbench], else the file's name
  SbDocument *scene; // NULL: read by sb_study_file_of_model()
  SbModel *base;     // the compiled scene, with --set and `hold` applied
  char *base_sha256; // hash (hexadecimal) of the scene's values and of the files that it reads
  GArray *vary;      // of SbVary: one for each column of a row of values
  GArray *lines;     // of SbVary: all lines of an extended grid; NULL: no extended grid
  guint grids;       // number of groups [vary NAME]
  double *root; // [vary][vary] lower Cholesky factor of the normal variates' correlation; NULL:
                // independent
  SbStudyMethod method;
  size_t samples; // number of samples, rounded down to full trajectories or blocks; 0: not given
  guint64 seed;
  GArray *figures; // of int, indices of sb_figure(): the requested ones (default all), then those
                   // of the objective and the limits
  SbLimits limits; // the scene's, replaced by its own
  SbDesignWish design;
  SbLeakageTest leakage; // of [leakage_test]
  size_t leakage_tests;  // number of simulated tests; 0: none
  GPtrArray *data;       // of SbData
  GPtrArray *notes;      // of SbIssue: the moduli that follow from hardnesses in its own lines
  bool borrowed;         // all members but the arrays belong to another study
} SbStudyFile;

// Reads the study file `path` ("-": standard input) and its scene, and applies the KEY=VALUE
// settings (ends with NULL; NULL: none) to the scene. Returns NULL with at least one issue.
SbStudyFile *sb_study_file_load(const char *path, char **settings, GPtrArray *issues);

// As sb_study_file_load(), from the content of `path` that sb_document_load_text() returned.
SbStudyFile *sb_study_file_read(const char *path, const char *text, size_t length, char **settings,
                                GPtrArray *issues);

// As sb_study_file_load(), from the `length` bytes of a file. `name` is used as its path in
// messages; the scene is looked for in `directory` (NULL: the current folder). If `scene` is not
// NULL, it is used in place of the scene that the text names and is owned by the study, also after
// a failure.
SbStudyFile *sb_study_file_parse(const char *text, size_t length, const char *name,
                                 const char *directory, char **settings, SbDocument *scene,
                                 GPtrArray *issues);

// Reads the study file `path` for another scene, `scene`, which is copied. The scene that the file
// names is not read. Returns NULL with at least one issue.
SbStudyFile *sb_study_file_of_model(const char *path, const SbModel *scene, GPtrArray *issues);

// Returns the study of a design's scatter, method `reliability` with `samples` samples: the
// tolerances of `study` vary about value[vary] (SI, in the order of study->vary) or, for other
// parameters, about the scene's values; parameters of study->vary without a tolerance are fixed at
// value[vary]. It borrows from `study`, which must outlive it. Freed by sb_study_file_free().
SbStudyFile *sb_study_file_about(const SbStudyFile *study, const double *value, size_t samples);

// Frees a study.
void sb_study_file_free(SbStudyFile *study);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbStudyFile, sb_study_file_free)

// ---- Samples. Values are [SI], of a choice its index, in the order of study->vary ----

// Writes value[vary] at the independent standard normal variates u[vary]. If `slope` is not NULL,
// writes slope[vary][vary], the derivative of each value (row) by each variate (column).
void sb_study_file_place(double *value, double *slope, const SbStudyFile *study, const double *u);

// Writes the values [samples][vary] of all samples to *value and, if `unit` is not NULL, the points
// [samples][vary] in the unit cube, which the method's estimates need, to *unit (zeros for a grid).
// Both are freed by free(). Not for the method `reliability` (app/study/reliability.h). Returns
// SB_ERROR_MEMORY, or the error of the sampling (engine/numeric/sampling.h); both are then NULL.
SbStatus sb_study_file_points(double **value, double **unit, const SbStudyFile *study,
                              SbReport *report);

// Returns the number of samples of the `grid`-th group [vary NAME], from 1. The samples of the
// groups before it come first.
size_t sb_study_grid_samples(const SbStudyFile *study, guint grid);

// Only for an extended grid. A line of samples is a combination of the levels of all lines but the
// fastest. Writes the number of the line to which `sample` belongs, counted over all groups from 0,
// and the value of the fastest line at the sample.
void sb_study_grid_place(size_t *line, double *x, const SbStudyFile *study, size_t sample);

// Only for an extended grid. Computes the expressions of group `grid` (0: of [vary] only) in the
// row of values row[vary], which contains the levels, with NaN for what the group does not have. An
// expression without a finite value gives NaN.
void sb_study_grid_follow(double *row, const SbStudyFile *study, guint grid);

// Only for an extended grid. Writes row[vary] of line number `line` (see sb_study_grid_place()) at
// the first level of the fastest parameter, without expressions (NaN); its group to *grid; and the
// column of the fastest parameter to *column.
void sb_study_grid_row(double *row, guint *grid, guint *column, const SbStudyFile *study,
                       size_t line);

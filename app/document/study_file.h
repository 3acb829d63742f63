// A study file: the scene that is asked, the parameters that vary and how, what is asked for.
//
// GKeyFile text like a scene's: [sealbench] with kind = study and scene = FILE; [vary] a line a
// parameter; [correlation]; [study]; [limits]; [design] and [tolerances] of `sealbench design`,
// which takes the ranges of [vary] as bounds; [data] of `sealbench calibrate`, which takes them as
// priors; [leakage_test], whose cans are the samples (engine/valve/answer/leakage_test.h).
//
// A grid may say more. Each group [vary NAME] is a grid of its own beside the others, with the
// lines of [vary] added; samples stand in the order of the groups, the last line runs fastest. A
// name without a dot is a variable, which overrides nothing; `KEY = by EXPRESSION` follows from
// variables and from the scene's values, which keys in an expression mean (expression.h). A
// variable that a group leaves out is 0. Ends of ranges and levels may be expressions of the
// scene's values; `uniform A .. B, N and C, D` adds levels behind the N. `hold` in [study] names
// what of the scene is held (SB_HOLDS of engine/valve/studies/hold.h).
#pragma once

#include "app/document/document.h"

#include "engine/numeric/sampling.h"
#include "engine/valve/answer/leakage_test.h"

// code, name
#define SB_STUDY_METHODS(X)                                                                        \
  X(SB_METHOD_GRID, "grid")                                                                        \
  X(SB_METHOD_MONTE_CARLO, "monte-carlo")                                                          \
  X(SB_METHOD_SOBOL_SEQUENCE, "sobol-sequence")                                                    \
  X(SB_METHOD_MORRIS, "morris")                                                                    \
  X(SB_METHOD_SOBOL_INDICES, "sobol-indices")                                                      \
  X(SB_METHOD_RELIABILITY, "reliability")

typedef enum {
#define SB_STUDY_METHOD_ENUM(code, name) code,
  SB_STUDY_METHODS(SB_STUDY_METHOD_ENUM)
#undef SB_STUDY_METHOD_ENUM
      SB_METHOD_COUNT
} SbStudyMethod;

// Borrowed, static.
const char *sb_study_method_name(SbStudyMethod method);

enum { SB_VARY_MAX = 64, SB_SAMPLES_MAX = 10000000, SB_LEAKAGE_TESTS = 1000 };

// One line of [vary], or of [tolerances].
typedef struct {
  SbParamId id;
  bool offset;                 // a tolerance: what is added to the parameter's value
  SbDistribution distribution; // its levels are owned by the file
  double *levels;
  const SbModel *base; // whose values expressions name; borrowed
  // Of lines of a grid that says more:
  char *name; // of a variable, whose id is SB_VARY_VARIABLE; owned
  char *by;   // expression, instead of a distribution; owned
  int line;   // in the file
  guint grid; // the how-many-th [vary NAME], from 1; 0: [vary]
  guint column;
} SbVary;

#define SB_VARY_VARIABLE ((SbParamId)-1)

// Key or variable's name; its SI unit. Borrowed.
const char *sb_vary_name(const SbVary *vary);
const char *sb_vary_si(const SbVary *vary);

// [design] and [tolerances].
typedef struct {
  bool asked;         // there is a [design]
  bool maximise;      // else minimise
  int figure;         // the objective, figures.def
  double robust;      // probability that all limits hold over the tolerances; NaN: not asked
  size_t starts;      // of the search
  GArray *tolerances; // of SbVary, offsets: normal or uniform
} SbDesignWish;

typedef struct {
  char *path;        // NULL: standard input
  char *title;       // of [sealbench], else the file's name
  SbDocument *scene; //
  SbModel *base;     // the scene, --set included
  char *base_sha256; // hex, of the scene's values and of what it reads beside them
  GArray *vary;      // of SbVary: what there are values of
  GArray *lines;     // of SbVary, of a grid that says more; NULL: `vary`
  guint grids;       // groups [vary NAME]
  double *root;      // [vary][vary] lower root of the normal variates' correlation; NULL: none
  SbStudyMethod method;
  size_t samples; // points of the method, rounded down to whole trajectories or blocks; 0: not said
                  // (a design's)
  guint64 seed;
  GArray *figures; // of int, figures.def: those named (default all), then those of limits
  SbLimits limits; // the scene's, its own in their place
  SbDesignWish design;
  SbLeakageTest leakage; // of [leakage_test]
  size_t leakage_tests;  // simulated; 0: not asked for
  GPtrArray *data;       // of SbData
  bool borrowed;         // all but the lists is another study's
} SbStudyFile;

// Reads a study ("-": standard input) and its scene, with KEY=VALUE settings upon that. NULL with
// at least one issue. Owned by the caller.
SbStudyFile *sb_study_file_load(const char *path, char **settings, GPtrArray *issues);

// The same from memory; `name` stands in messages, `directory` is where the scene is looked for
// (NULL: the current one). A `scene` that is not NULL is taken in place of that which the text
// names, and owned from then on.
SbStudyFile *sb_study_file_parse(const char *text, size_t length, const char *name,
                                 const char *directory, char **settings, SbDocument *scene,
                                 GPtrArray *issues);

// The same of a file for another scene, which is copied: that of the file is not looked at.
SbStudyFile *sb_study_file_of_model(const char *path, const SbModel *scene, GPtrArray *issues);

// The study of a design's scatter, `reliability` with so many samples: what varies are the
// tolerances about these values [vary], or about the scene's of parameters that [vary] has not. It
// borrows from `study` and lives no longer. Owned by the caller.
SbStudyFile *sb_study_file_about(const SbStudyFile *study, const double *value, size_t samples);

// Takes NULL.
void sb_study_file_free(SbStudyFile *study);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbStudyFile, sb_study_file_free)

// Values [vary] in SI at independent standard normal variates u[vary], and where `slope` is not
// NULL the derivative [vary][vary] of each value by each variate.
void sb_study_file_place(double *value, double *slope, const SbStudyFile *study, const double *u);

// Values [samples][vary] of all points in SI (the index of a choice), and where `unit` is not NULL,
// the points in the unit cube [samples][vary] that the method's estimates need. Those of
// `reliability` are in app/study/reliability.h. SB_ERROR_MEMORY.
SbStatus sb_study_file_points(double **value, double **unit, const SbStudyFile *study,
                              SbReport *report);

// Samples of the how-many-th group [vary NAME], from 1; those of the groups before it come first.
size_t sb_study_grid_samples(const SbStudyFile *study, guint grid);

// Of a grid that says more: the combination of all but the last line that a sample has, counted
// through the file from 0, and the last line's value.
void sb_study_grid_place(size_t *line, double *x, const SbStudyFile *study, size_t sample);

// Fills what follows in a row [vary] of values, NaN elsewhere for what it has not, of a group [vary
// NAME] (0: of none). A value that is none, such as a quotient by 0, is NaN.
void sb_study_grid_follow(double *row, const SbStudyFile *study, guint grid);

// The row of a line of the grid at its first level, what follows left out; its group, and the
// column of its last parameter.
void sb_study_grid_row(double *row, guint *grid, guint *column, const SbStudyFile *study,
                       size_t line);

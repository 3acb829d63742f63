// A study file: the scene that is asked, the parameters that vary and how, what is asked for.
//
// GKeyFile text like a scene's: [sealbench] with kind = study and scene = FILE; [vary] a line a
// parameter; [correlation]; [study]; [limits]; [design] and [tolerances] of `sealbench design`,
// which takes the ranges of [vary] as bounds. [data] belongs to another command and is passed over
// here.
#pragma once

#include "app/document/document.h"

#include "engine/numeric/sampling.h"

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

enum { SB_VARY_MAX = 64, SB_SAMPLES_MAX = 10000000 };

// One line of [vary], or of [tolerances].
typedef struct {
  SbParamId id;
  bool offset;                 // a tolerance: what is added to the parameter's value
  SbDistribution distribution; // its levels are owned by the file
  double *levels;
} SbVary;

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
  GArray *vary;      // of SbVary
  double *root;      // [vary][vary] lower root of the normal variates' correlation; NULL: none
  SbStudyMethod method;
  size_t samples; // points of the method, rounded down to whole trajectories or blocks; 0: not said
                  // (a design's)
  guint64 seed;
  GArray *figures; // of int, figures.def: those named (default all), then those of limits
  SbLimits limits; // the scene's, its own in their place
  SbDesignWish design;
  bool borrowed; // all but the lists is another study's
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

// libsealbench: elastomer seals of inhaler valves for other programs.
//
//   SbScene *scene;
//   double force;
//   if (sb_scene_open(&scene, "thesis-cycle.scene") == SB_SCENE_OK &&
//       sb_scene_set_text(scene, "seal.section_diameter", "1.63 mm") == SB_SCENE_OK &&
//       sb_scene_run(scene) == SB_SCENE_OK &&
//       sb_scene_figure(scene, "cycle.force_breakaway_N", &force) == SB_SCENE_OK) {
//     printf("%g N\n", force);
//   } else {
//     fprintf(stderr, "%s\n", scene != NULL ? sb_scene_message(scene) : "out of memory");
//   }
//   sb_scene_close(scene);
//
// A scene is a valve file or a scene file in memory, with the caller's changes and, after
// sb_scene_run(), one computed cycle. Keys of parameters, figures (results) and quantities (results
// of each frame) are those of the files and of the program's JSON (`sealbench list params`, `list
// figures`). sb_list_parameters(), sb_list_figures() and sb_list_quantities() return them with
// units.
//
// Units and signs. Numbers are SI; a text may have a unit ("1.63 mm"). Pressures are gauge. x is
// axial in the seal's frame: the origin is the centre of the section, the canister is on the left.
// The displacement of the stem is positive into the canister, compression forces are positive. NaN
// means not computed, and sb_scene_reason() states why; 0 is a computed value.
//
// Threads. One scene is used by one thread at a time; different scenes may be used concurrently.
// Callbacks run in the calling thread. Results do not depend on the locale. The library prints
// nothing. The first call switches off GSL's error handler for the process, which would abort it;
// set your own handler afterwards if you use GSL. For bit-identical results set
// OPENBLAS_NUM_THREADS=1 in the environment.
//
// Ownership. sb_scene_open(), sb_scene_parse() and sb_scene_new() create a scene; free it with
// sb_scene_close(). Every `const` pointer that a function returns or writes is borrowed from the
// scene: strings until the next call with that scene, arrays until the next run or close. Results
// of sb_list_...() are static. The library copies what the caller passes, except the callbacks and
// their data.
//
// Errors. A function that can fail returns SbSceneStatus; sb_scene_message() is then one sentence
// with file, key and allowed range. Comments abbreviate SB_SCENE_ERROR_INPUT as _INPUT. A scene
// remains usable after any error. Pointers must not be NULL unless a comment allows it.
#pragma once

#include <stddef.h>

#define SB_LIBRARY_VERSION_MAJOR 0
#define SB_LIBRARY_VERSION_MINOR 2
#define SB_LIBRARY_VERSION_MICRO 0

// True if this header has at least the version major.minor.micro; for #if.
#define SB_LIBRARY_AT_LEAST(major, minor, micro)                                                   \
  (SB_LIBRARY_VERSION_MAJOR > (major) ||                                                           \
   (SB_LIBRARY_VERSION_MAJOR == (major) && SB_LIBRARY_VERSION_MINOR > (minor)) ||                  \
   (SB_LIBRARY_VERSION_MAJOR == (major) && SB_LIBRARY_VERSION_MINOR == (minor) &&                  \
    SB_LIBRARY_VERSION_MICRO >= (micro)))

#ifdef __cplusplus
extern "C" {
#endif

// A scene with its parameters and its last results.
typedef struct SbScene SbScene;

// Status of a call.
typedef enum {
  SB_SCENE_OK = 0,
  SB_SCENE_ERROR_INPUT = 1,         // a file, key, unit or combination of values is wrong
  SB_SCENE_ERROR_RANGE = 2,         // a value is out of range
  SB_SCENE_ERROR_INFEASIBLE = 3,    // no solution exists for these values
  SB_SCENE_ERROR_NOT_CONVERGED = 4, // a solver did not converge; what was computed can be read
  SB_SCENE_ERROR_CANCELLED = 5,     // `cancelled` returned true; what was computed can be read
  SB_SCENE_ERROR_MEMORY = 6,        // out of memory
  SB_SCENE_ERROR_IO = 7             // a file cannot be read
} SbSceneStatus;

// Returns the version of the loaded library, "0.2.0"; static.
const char *sb_library_version(void);

// Returns the SHA-256 of the engine's sources and compiler options, 64 hexadecimal digits; static.
// Libraries and programs with the same hash compute the same results.
const char *sb_library_source(void);

// ---- Catalogues ----

// A parameter. All strings are static.
typedef struct {
  const char *key;      // "gland.radial_space"
  const char *symbol;   // "g"; "" if none
  const char *unit;     // SI, "1" if dimensionless
  const char *shown;    // display unit, "" if none
  const char *choices;  // "first|second": the value is the index of a choice; of output.views and
                        // output.studies a bit mask (1: the first), as text "first, second";
                        // else NULL
  const char *label;    // "Radial space"
  const char *help;     // one line
  double low, high;     // allowed range, SI, inclusive; both 0 for choices
  double default_value; // SI
} SbParameterInfo;

// A figure or a quantity of frames. All strings are static.
typedef struct {
  const char *key;  // "cycle.force_breakaway_N"
  const char *unit; // SI, "1" if dimensionless
} SbFigureInfo;

// Returns all parameters, an array of *count; static.
const SbParameterInfo *sb_list_parameters(size_t *count);

// Returns all figures, an array of *count; static.
const SbFigureInfo *sb_list_figures(size_t *count);

// Returns all quantities of frames (for sb_scene_frames()), an array of *count; static.
const SbFigureInfo *sb_list_quantities(size_t *count);

// ---- Scenes ----

// Creates a scene from a valve or scene file (and the valve that a scene names). If the file `path`
// does not exist, the shipped scene or valve of this name is opened ("quick-look"; `sealbench list
// scenes`). After an error *out is a scene too, for its message, and must be closed; *out is NULL
// only after SB_SCENE_ERROR_MEMORY. Runs and evaluations of a scene with a faulty file fail with
// that error. _INPUT: the contents are wrong (sb_scene_issue() returns each issue). _IO: the file
// cannot be read.
SbSceneStatus sb_scene_open(SbScene **out, const char *path);

// Creates a scene from text[length], the contents of a file, which need not end with NUL. `folder`
// is the folder of the files that it names (NULL: the current folder). *out and errors as for
// sb_scene_open().
SbSceneStatus sb_scene_parse(SbScene **out, const char *text, size_t length, const char *folder);

// Creates a scene with default values only: the thesis' valve. *out is NULL after
// SB_SCENE_ERROR_MEMORY.
SbSceneStatus sb_scene_new(SbScene **out);

// Frees the scene and everything borrowed from it. Takes NULL.
void sb_scene_close(SbScene *scene);

// Returns the message of the last call that failed; "" if none has failed.
const char *sb_scene_message(const SbScene *scene);

// Returns the key of the parameter at fault in the last call that failed; "" if there is none.
const char *sb_scene_message_key(const SbScene *scene);

// Returns issue number `index` (from 0) of the scene's file as one line with file, line, key and
// range; NULL after the last one.
const char *sb_scene_issue(const SbScene *scene, size_t index);

// Returns the path of the file that sb_scene_open() opened; NULL for other scenes.
const char *sb_scene_path(const SbScene *scene);

// Returns the title of the scene; never NULL.
const char *sb_scene_title(const SbScene *scene);

// Returns the text of the scene's file with its changes. sb_scene_parse() of it with the same
// folder creates an equal scene.
const char *sb_scene_text(SbScene *scene);

// ---- Parameters ----

// Sets a parameter from a text: a number with or without unit ("1.63 mm"), or the name of a choice
// ("reynolds"). After an error (_INPUT: unknown key, or a text that is not a valid value of it,
// such as a number out of range) nothing has changed. Results of the last run remain.
SbSceneStatus sb_scene_set_text(SbScene *scene, const char *key, const char *text);

// Sets a parameter from a number in SI (the index of a choice). After an error (_INPUT: unknown
// key; _RANGE: value out of range) nothing has changed. Results of the last run remain.
SbSceneStatus sb_scene_set(SbScene *scene, const char *key, double value);

// Removes the scene's own value of a parameter, so that the value of its valve or the default
// applies. _INPUT: unknown key.
SbSceneStatus sb_scene_unset(SbScene *scene, const char *key);

// Writes the value of a parameter in SI to *value (NaN after _INPUT: unknown key).
SbSceneStatus sb_scene_get(SbScene *scene, const char *key, double *value);

// Returns the value of a parameter as text with unit; NULL with a message for an unknown key.
const char *sb_scene_get_text(SbScene *scene, const char *key);

// ---- A run ----

// Sets the callbacks of runs and evaluations; NULL: none. `progress` receives the completed
// fraction, 0 to 1. If `cancelled` returns a value other than 0, the computation ends within about
// 50 ms with SB_SCENE_ERROR_CANCELLED. `data` is passed to both. They must not call functions with
// this scene.
void sb_scene_callbacks(SbScene *scene, void (*progress)(void *data, double fraction),
                        int (*cancelled)(void *data), void *data);

// Computes the scene's cycle: figures, frames and profiles, which replace those of the last run. It
// takes milliseconds with closed forms, and a second or more with solved rings. After
// _NOT_CONVERGED, _INFEASIBLE and _CANCELLED the completed part can be read. _INPUT: the values
// describe no valid valve, or the scene's file is faulty; nothing is computed.
SbSceneStatus sb_scene_run(SbScene *scene);

// Writes the figure with the key `path` of the last run to *value, in SI; NaN if it was not
// computed. _INPUT: unknown path, or no run yet.
SbSceneStatus sb_scene_figure(SbScene *scene, const char *path, double *value);

// Writes the estimated error of that figure, relative to its magnitude, to *error: 0 for inputs and
// closed forms; NaN where it is not known or cannot be stated. It is the numerical error, not that
// of the model. _INPUT as above.
SbSceneStatus sb_scene_error(SbScene *scene, const char *path, double *error);

// Returns why a figure of the last run is NaN, one sentence, also before the first run; NULL if it
// has a value, or if the path is unknown.
const char *sb_scene_reason(const SbScene *scene, const char *path);

// Returns the sentence of warning number `index` (from 0) of the last run; NULL after the last one.
const char *sb_scene_warning(const SbScene *scene, size_t index);

// Returns the code of warning number `index` of the last run, stable between versions
// ("karaszkiewicz-squeeze"); NULL after the last one.
const char *sb_scene_warning_code(const SbScene *scene, size_t index);

// Returns the number of frames of the last run; 0 before the first run.
size_t sb_scene_frame_count(const SbScene *scene);

// Writes a quantity ("time_s", "seals.outer.friction_N") of all frames of the last run to
// out[sb_scene_frame_count()], in SI; NaN where it was not computed. _INPUT: unknown quantity.
SbSceneStatus sb_scene_frames(SbScene *scene, const char *quantity, double *out);

// Pressure and film in a seal's contact; arrays of `count`, borrowed until the next run or close.
typedef struct {
  size_t count;           // number of points; 0: no contact
  const double *x;        // position in the seal's frame, increasing [m]
  const double *pressure; // contact pressure minus the lower one of the two fluid pressures [Pa]
  const double *film;     // film thickness [m]; 0 at rest
  const double *asperity_pressure; // part of the pressure that asperities carry at this film [Pa]
  const char *model;               // name of the model that computed it
} SbSceneProfile;

// Writes the profile of the seal "outer" or "inner" at frame number `frame` (from 0) of the last
// run. Without contact its count is 0. _INPUT: another seal, or no such frame.
SbSceneStatus sb_scene_profile(SbScene *scene, size_t frame, const char *seal, SbSceneProfile *out);

// ---- Verdict ----

// Answer to one question of the verdict.
typedef struct {
  const char *question; // "seals", "presses", "returns", "doses", "leak" or "fits"
  int ok;               // 1: yes; 0: no; -1: not known
  const char *reason;   // one sentence about the answer; NULL: none is needed
  const char *figure;   // key of the figure that decides; NULL: none, for example without a limit
  double value, limit;  // of this figure and its limit, in the figure's SI unit; NaN: none
  const char *of_case;  // name of the case that gives the answer; NULL: the scene itself
} SbSceneVerdict;

// Computes the scene as sb_scene_run() does, then each of its [cases], and takes the worst answer
// to each question: the verdict of `sealbench run`. Returns the status of the run, else that of the
// last case that failed; its message names the case. A case that failed makes every answer unknown,
// unless the scene or another case answers no.
SbSceneStatus sb_scene_judge(SbScene *scene);

// Returns answer number `index` (from 0) of the last sb_scene_judge(); NULL after the last one,
// before the first judgement, and after a later sb_scene_run(). Borrowed until the next of both.
const SbSceneVerdict *sb_scene_verdict(const SbScene *scene, size_t index);

// ---- Evaluation ----

// Computes figures of the scene with some parameters replaced. The results equal those of a run of
// that scene to the bit, but only what the figures need is computed. The scene's parameters and the
// frames of its last run do not change.
//   keys, values   [count] parameters and their values in SI; the last one of a key applies
//   figures        [figure_count] keys of figures
//   out            [figure_count] values in SI; NaN: sb_scene_evaluation_reason()
// `keys` and `values` may be NULL if `count` is 0. After _INPUT and _RANGE all of `out` is NaN, and
// the message names key and range. After other errors `out` has the values that were computed.
SbSceneStatus sb_scene_evaluate(SbScene *scene, const char *const *keys, const double *values,
                                size_t count, const char *const *figures, size_t figure_count,
                                double *out);

// Returns the sentence of warning number `index` (from 0) of the models used by the last
// evaluation; NULL after the last one, and if that evaluation failed. Borrowed until the next
// evaluation.
const char *sb_scene_evaluation_warning(const SbScene *scene, size_t index);

// Returns the code of warning number `index` of the last evaluation; NULL if
// sb_scene_evaluation_warning() returns NULL.
const char *sb_scene_evaluation_warning_code(const SbScene *scene, size_t index);

// Returns why a figure of the last evaluation is NaN; NULL if it has a value, or if the path is
// unknown.
const char *sb_scene_evaluation_reason(const SbScene *scene, const char *path);

#ifdef __cplusplus
}
#endif

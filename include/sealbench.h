// libsealbench: elastomer seals of inhaler valves for other programs.
//
//   SbScene *scene;
//   double force;
//   if (sb_scene_open(&scene, "thesis-cycle.scene") == SB_SCENE_OK &&
//       sb_scene_set_text(scene, "seal.section_diameter", "1.63 mm") == SB_SCENE_OK &&
//       sb_scene_run(scene) == SB_SCENE_OK) {
//     sb_scene_figure(scene, "cycle.force_breakaway_N", &force);
//   } else {
//     fprintf(stderr, "%s\n", sb_scene_message(scene));
//   }
//   sb_scene_close(scene);
//
// A scene is a valve file or a scene file in memory, with its changes and, after sb_scene_run(),
// one computed cycle. Parameters, figures and quantities of frames go by the keys of the files and
// of the program's JSON (`sealbench list params`, `list figures`); sb_list_parameters() and the
// others below have them with units and help.
//
// Units. Numbers are SI unless a text carries a unit ("1.63 mm"). Pressures are gauge; x is axial
// in the seal's frame, the canister on the left; compression is positive. A figure that was not
// computed is NaN, and sb_scene_reason() says why. 0 means computed and nil.
//
// Threads. A scene belongs to one thread at a time; different scenes may be used in different
// threads at once. Callbacks run on the thread that called. Nothing depends on the locale. The
// library prints nothing. The first call turns off GSL's error handler of the process, which would
// end it; set your own afterwards if you use GSL. OpenBLAS should have one thread a process where
// results are to repeat to the last bit (environment OPENBLAS_NUM_THREADS=1).
//
// Ownership. What sb_scene_open(), _parse() and _new() give is the caller's, to be closed. Every
// `const` pointer that a function returns or fills in is borrowed from the scene: strings until the
// next call with that scene, arrays until the next run or close. What sb_list_*() return lives as
// long as the program. Nothing that the caller passes is kept but the callbacks and their data.
//
// Errors. A function that can fail returns SbSceneStatus; sb_scene_message() is one sentence with
// file, key and allowed range. A scene can be used after any error. Programming errors (NULL for a
// scene) are not caught, but for sb_scene_close(NULL), which does nothing.
#pragma once

#include <stddef.h>

#define SB_LIBRARY_VERSION_MAJOR 0
#define SB_LIBRARY_VERSION_MINOR 2
#define SB_LIBRARY_VERSION_MICRO 0
// Whether the header is of at least this version.
#define SB_LIBRARY_AT_LEAST(major, minor, micro)                                                   \
  (SB_LIBRARY_VERSION_MAJOR > (major) ||                                                           \
   (SB_LIBRARY_VERSION_MAJOR == (major) && SB_LIBRARY_VERSION_MINOR > (minor)) ||                  \
   (SB_LIBRARY_VERSION_MAJOR == (major) && SB_LIBRARY_VERSION_MINOR == (minor) &&                  \
    SB_LIBRARY_VERSION_MICRO >= (micro)))

#ifdef __cplusplus
extern "C" {
#endif

typedef struct SbScene SbScene;

typedef enum {
  SB_SCENE_OK = 0,
  SB_SCENE_ERROR_INPUT = 1,         // a file, key, unit or combination of values is wrong
  SB_SCENE_ERROR_RANGE = 2,         // a value is outside its range
  SB_SCENE_ERROR_INFEASIBLE = 3,    // no solution exists for these values
  SB_SCENE_ERROR_NOT_CONVERGED = 4, // a solver gave up; what there is can be read
  SB_SCENE_ERROR_CANCELLED = 5,     // the callback asked to stop; what there is can be read
  SB_SCENE_ERROR_MEMORY = 6,
  SB_SCENE_ERROR_IO = 7 // a file cannot be read
} SbSceneStatus;

// Version of the library that is loaded, "0.2.0".
const char *sb_library_version(void);

// SHA-256 of the sources of its engine and of what compiled them, 64 hexadecimal digits: libraries
// and programs of the same hash compute the same figures.
const char *sb_library_source(void);

// ---- Catalogues ----

typedef struct {
  const char *key;      // "gland.radial_space"
  const char *symbol;   // "g"; may be empty
  const char *unit;     // SI, "1" if none
  const char *shown;    // unit that people read, "" if none
  const char *choices;  // "first|second" (a value is an index, or a bit mask of flags), else NULL
  const char *label;    // "Radial space"
  const char *help;     // one line
  double low, high;     // allowed range, SI, inclusive; 0 for choices
  double default_value; // SI
} SbParameterInfo;

typedef struct {
  const char *key;  // "cycle.force_breakaway_N"
  const char *unit; // SI, "1" if none
} SbFigureInfo;

// All parameters, all figures, all quantities of frames (sb_scene_frames): arrays of *count.
const SbParameterInfo *sb_list_parameters(size_t *count);
const SbFigureInfo *sb_list_figures(size_t *count);
const SbFigureInfo *sb_list_quantities(size_t *count);

// ---- Scenes ----

// Opens a valve or scene file (and a scene's valve). If there is no file `path`, the scene or valve
// of this name that ships with the program is opened ("quick-look"; `sealbench list scenes`). *out
// is a scene even after an error, for its message, and must be closed; NULL only after
// SB_SCENE_ERROR_MEMORY. After an error of the file, runs and evaluations fail with that error:
// nothing is computed from defaults in place of what the file should give. _INPUT: the file says
// something wrong (every issue: sb_scene_issue()); _IO: it cannot be read.
SbSceneStatus sb_scene_open(SbScene **out, const char *path);

// The same from `length` bytes of a file's text; `folder` is where other files are looked for
// (NULL: the current one).
SbSceneStatus sb_scene_parse(SbScene **out, const char *text, size_t length, const char *folder);

// The thesis' valve: all defaults.
SbSceneStatus sb_scene_new(SbScene **out);

// Frees the scene and all that was borrowed from it. Takes NULL.
void sb_scene_close(SbScene *scene);

// What went wrong in the last call that failed, "" before one; and the parameter at fault, "" if
// none.
const char *sb_scene_message(const SbScene *scene);
const char *sb_scene_message_key(const SbScene *scene);

// Issue `index` of the last file that was opened, as one line with file, line, key and range; NULL
// beyond the last.
const char *sb_scene_issue(const SbScene *scene, size_t index);

// Path of the file that sb_scene_open() opened; NULL for a scene that was made otherwise. Borrowed
// from the scene.
const char *sb_scene_path(const SbScene *scene);

// Title of the scene.
const char *sb_scene_title(const SbScene *scene);

// Text of the scene's file with its changes: sb_scene_parse() with the same folder makes an equal
// scene of it. Borrowed until the next call with this scene.
const char *sb_scene_text(SbScene *scene);

// ---- Parameters ----

// Sets a parameter from a text with unit ("1.63 mm", "reynolds"), or from a number in SI (the index
// of a choice). On failure (_INPUT, _RANGE) nothing changes. Results of an earlier run stay until
// the next.
SbSceneStatus sb_scene_set_text(SbScene *scene, const char *key, const char *text);
SbSceneStatus sb_scene_set(SbScene *scene, const char *key, double value);

// Takes a value of the scene's own back: its valve's or the default is in force again.
SbSceneStatus sb_scene_unset(SbScene *scene, const char *key);

// The value in force: SI; or as text with unit, borrowed, NULL with a message for an unknown key.
SbSceneStatus sb_scene_get(SbScene *scene, const char *key, double *value);
const char *sb_scene_get_text(SbScene *scene, const char *key);

// ---- A run ----

// `progress` is told the fraction done, 0 to 1; an answer of `cancelled` other than 0 ends the run
// or evaluation within some 50 ms with SB_SCENE_ERROR_CANCELLED. Both may be NULL. They must not
// call functions with this scene.
void sb_scene_callbacks(SbScene *scene, void (*progress)(void *data, double fraction),
                        int (*cancelled)(void *data), void *data);

// Computes the scene's cycle: figures, frames, profiles. Takes milliseconds with closed forms, a
// second or more with solved rings. After _NOT_CONVERGED, _INFEASIBLE and _CANCELLED what was
// finished can be read.
SbSceneStatus sb_scene_run(SbScene *scene);

// A figure of the last run in SI; NaN where it was not computed.
// _INPUT for an unknown path, or before the first run.
SbSceneStatus sb_scene_figure(SbScene *scene, const char *path, double *value);

// Why a figure is NaN: one sentence; NULL where it has a value, or for an unknown path.
const char *sb_scene_reason(const SbScene *scene, const char *path);

// Warning `index` of the last run: a sentence; NULL beyond the last.
const char *sb_scene_warning(const SbScene *scene, size_t index);

// Code of that warning, stable between versions ("karaszkiewicz-squeeze"); NULL beyond the last.
const char *sb_scene_warning_code(const SbScene *scene, size_t index);

// Frames of the last run.
size_t sb_scene_frame_count(const SbScene *scene);

// One quantity of all frames ("time_s", "seals.outer.friction_N") into out[sb_scene_frame_count()].
// NaN where it was not computed. _INPUT for an unknown name.
SbSceneStatus sb_scene_frames(SbScene *scene, const char *quantity, double *out);

// Pressure and film over a seal's contact; arrays of `count`, borrowed. x rises.
typedef struct {
  size_t count;
  const double *x;        // in the seal's frame [m]
  const double *pressure; // of the contact, above the lower of the two fluid pressures [Pa]
  const double *film;     // [m]; 0 at rest
  const double *asperity_pressure; // borne by the asperities at this film [Pa]
  const char *model;               // that made it
} SbSceneProfile;

// Profile of seal "outer" or "inner" at a frame of the last run. count is 0 without contact. _INPUT
// for another seal or frame.
SbSceneStatus sb_scene_profile(SbScene *scene, size_t frame, const char *seal, SbSceneProfile *out);

// ---- Evaluation ----

// Figures of the scene with parameters replaced, as a run of that scene would give them to the bit;
// computes no more than these figures need (a load one fitment, a film one film). Changes neither
// the scene's parameters nor the frames of its last run.
//   keys, values   [count]: parameters and what they are to be, SI; the last of a key counts
//   figures        [figure_count]: paths
//   out            [figure_count]: values in SI, NaN with a reason
// All of `out` is NaN after _INPUT and _RANGE, whose message names key and range.
SbSceneStatus sb_scene_evaluate(SbScene *scene, const char *const *keys, const double *values,
                                size_t count, const char *const *figures, size_t figure_count,
                                double *out);

// Warning `index` of the last evaluation, of the models that its figures needed: a sentence, and
// its code. NULL beyond the last, and after an evaluation that failed. Borrowed until the next
// evaluation.
const char *sb_scene_evaluation_warning(const SbScene *scene, size_t index);
const char *sb_scene_evaluation_warning_code(const SbScene *scene, size_t index);

// Why a figure that the last evaluation was asked for is NaN; NULL where it has a value, or for an
// unknown path.
const char *sb_scene_evaluation_reason(const SbScene *scene, const char *path);

#ifdef __cplusplus
}
#endif

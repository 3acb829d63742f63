// The kinds of drawn studies (charts with a table, studies/study.h), as named in output.studies and
// on the command line.
#pragma once

#include "engine/base/label.h"
#include "engine/base/status.h"

// X(enumerator, identifier of the SbStudyDesign sb_study_..., name, title, help): all kinds.
#define SB_STUDY_LIST(X)                                                                           \
  X(SB_STUDY_SQUEEZE, squeeze, "squeeze", SB_LABEL("Load over squeeze"),                           \
    SB_LABEL("load, peak and width of every fitment model over the squeeze, compared with the "    \
             "solved ring"))                                                                       \
  X(SB_STUDY_MODELS, models, "models", SB_LABEL("Fitment models side by side"),                    \
    SB_LABEL("thesis, linear disc and finite-strain ring: loads, peaks, widths, sensitivities, "   \
             "friction"))                                                                          \
  X(SB_STUDY_FILM_LAW, film_law, "film-law", SB_LABEL("Film law from our own solutions"),          \
    SB_LABEL("h/R = k U^b W^a regressed over a range, with residuals, compared with eq. 7.5, 7.6 " \
             "and the limit"))                                                                     \
  X(SB_STUDY_STORAGE, storage, "storage", SB_LABEL("Storage time"),                                \
    SB_LABEL("load, friction, squeeze and modulus against storage time: relaxation, set, swell"))  \
  X(SB_STUDY_LEAK, leak, "leak", SB_LABEL("Leak over squeeze"),                                    \
    SB_LABEL("leak at rest and leakage per stroke against the squeeze: below which squeeze the "   \
             "valve leaks"))                                                                       \
  X(SB_STUDY_STRIBECK, stribeck, "stribeck", SB_LABEL("Stribeck curve"),                           \
    SB_LABEL("friction, real contact and film of both seals against the speed, as computed in "    \
             "the cycle"))                                                                         \
  X(SB_STUDY_TOLERANCE, tolerance, "tolerance", SB_LABEL("Tolerances"),                            \
    SB_LABEL("loads, break-away and return force over the tolerances of the sizes: worst case "    \
             "and RSS"))                                                                           \
  X(SB_STUDY_PROPELLANTS, propellants, "propellants",                                              \
    SB_LABEL("Propellants over the temperature"),                                                  \
    SB_LABEL("pressure force, break-away, minimum return force and dose of each propellant in "    \
             "this valve"))

// A kind of study; bit i of output.studies is kind i.
typedef enum {
#define SB_STUDY_ENUM(code, function, name, title, help) code,
  SB_STUDY_LIST(SB_STUDY_ENUM)
#undef SB_STUDY_ENUM
      SB_STUDY_COUNT
} SbStudyKind;

// Returns the name of a study for command line and files ("squeeze"); static; NULL outside the
// enumeration.
const char *sb_study_name(SbStudyKind kind);

// Returns the title of a study; static; NULL outside the enumeration.
const char *sb_study_title(SbStudyKind kind);

// Returns one line of help; static; NULL outside the enumeration.
const char *sb_study_help(SbStudyKind kind);

// Finds a study by its name. Returns false, and leaves *out, if there is none.
SB_CHECKED bool sb_study_from_name(SbStudyKind *out, const char *name);

// The results of a search for a design, as far as they are computed: a map of the figures over two
// parameters, the best design, and for the present and the best design the effects of tolerances
// and a sample of valves.
//
// Every point of the map is an evaluation (engine/valve/answer/evaluate.h) at two parameters; the
// others have the values of the scene. Between points figures are linear in triangles. Around a
// point without figures (infeasible, or not converged) the map has none.
#pragma once

#include "app/study/design.h"

enum {
  SB_DESIGN_FIGURES = 12, // largest number of figures: the objective and those of the limits
  SB_DESIGN_EFFECTS = 10, // effects that are shown of each figure
};

// The map. Index 0 of a pair is across (x), 1 is up (y).
typedef struct {
  SbParamId axis[2];      // the parameters
  double low[2], high[2]; // ranges [SI]
  size_t n;               // points in each direction, a power of two plus 1
  size_t figures;         // number of figures
  double *value; // [n up][n across][figures], in the order of study->figures [SI]; NaN: none
  unsigned char *status; // [n up][n across]: SbStatus, or SB_ANSWER_MISSING
  size_t done, refused;  // points computed; of these, points without figures
  double seconds;        // time that the points took [s]
} SbDesignMap;

// A design.
typedef struct {
  bool known;                        // the members below are computed
  double axis[2];                    // its position on the map [SI]
  double value[SB_VARY_MAX];         // [vary]: all varied parameters [SI]
  double figure[SB_DESIGN_FIGURES];  // [SI]; NaN: none
  double error[SB_DESIGN_FIGURES];   // relative errors of `figure`; NaN: not known
  size_t effects[SB_DESIGN_FIGURES]; // number of effects of each figure
  struct {
    SbParamId id;   // a parameter is changed by
    double step;    // this much [SI], and
    double change;  // the figure changes by this much [SI of the figure], with its sign
    bool tolerance; // `step` is the parameter's tolerance; else 5 % of its value
  } effect[SB_DESIGN_FIGURES][SB_DESIGN_EFFECTS]; // the largest first
  // [figure]: variance by all tolerances, each a half-width of 3 standard deviations [SI squared].
  double variance[SB_DESIGN_FIGURES];
  double *sample; // [samples][figures]: valves drawn from the tolerances [SI]
  size_t samples;
  double fails; // fraction of the samples that violate a limit; NaN: there are no samples
} SbDesignPlace;

// Index of SbDesignAnswer.place.
enum { SB_DESIGN_PRESENT, SB_DESIGN_BEST, SB_DESIGN_PLACES };

// All results. Freed by sb_design_answer_free().
typedef struct {
  SbStudyFile *study; // owned; its figures are the objective and those of the limits
  SbDesignMap map;
  SbDesign found; // the best design; its member `found` states whether there is one
  bool searched;  // the search has ended
  SbDesignPlace place[SB_DESIGN_PLACES];
} SbDesignAnswer;

// Frees the results.
void sb_design_answer_free(SbDesignAnswer *answer);

// Returns the column (from 0) of a figure (index of sb_figure()) in value, figure and sample; -1:
// it was not requested.
int sb_design_answer_figure(const SbDesignAnswer *answer, int figure);

// Returns the figure of column `figure` at the parameter values (across, up) [SI], linear between
// the points; NaN outside of the map or next to a point without figures.
double sb_design_map_at(const SbDesignMap *map, size_t figure, double across, double up);

// Returns whether a design (index of SbDesignAnswer.place) is a point of the map: it is known,
// inside of its ranges, and all other parameters have the scene's values.
bool sb_design_on_map(const SbDesignAnswer *answer, int place);

// Returns whether a design violates limit number `limit`; false if its figure is not known. A best
// design that is feasible violates none: it is beyond a limit by rounding (SbDesign.breach).
bool sb_design_violates(const SbDesignAnswer *answer, int place, size_t limit);

// Returns the margin to limit number `limit` (of study->limits) divided by the standard deviation
// of its figure (from the design's variance); negative if the limit is violated. NaN: not known.
double sb_design_sigmas(const SbDesignAnswer *answer, int place, size_t limit);

// Writes the parameters of the best design to values[SB_VARY_MAX], rounded to a thousandth of their
// range, and returns their number; 0: no best design is known.
size_t sb_design_best_values(SbOverride *values, const SbDesignAnswer *answer);

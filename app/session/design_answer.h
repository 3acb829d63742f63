// The answer to a design question, as far as it has come: the map of two parameters, the best
// design found, and of it and the present one what tolerances do and valves drawn from them.
//
// Every point of the map is an answer of evaluate.h at two parameters, the others as in the base.
// Between points figures are linear in the triangles of each three neighbours. A point without
// figures (no valve, or a solver that gave up) takes the cells around it with it.
#pragma once

#include "app/study/design.h"

enum {
  SB_DESIGN_FIGURES = 12, // that a question asks for, the goal first
  SB_DESIGN_EFFECTS = 10, // drawn of each figure
};

typedef struct {
  SbParamId axis[2];      // across, up
  double low[2], high[2]; // SI
  size_t n;               // points each way, 1 more than a power of two
  size_t figures;
  double *value;         // [n up][n across][figures], NaN: none
  unsigned char *status; // [n][n], SbStatus or SB_ANSWER_MISSING
  size_t done, refused;  // points with an answer; of these, without figures
  double seconds;
} SbDesignMap;

// A design: the present one, or the best.
typedef struct {
  bool known;
  double axis[2];                   // SI, its place on the map
  double value[SB_VARY_MAX];        // [vary], SI
  double figure[SB_DESIGN_FIGURES]; // NaN: none
  size_t effects[SB_DESIGN_FIGURES];
  struct {
    SbParamId id;
    double step, change;                          // SI, the change signed
    bool tolerance;                               // its own; else 5 %
  } effect[SB_DESIGN_FIGURES][SB_DESIGN_EFFECTS]; // the greatest first
  double variance[SB_DESIGN_FIGURES]; // of all effects by tolerances, a half-width 3 deviations
  double *sample;                     // [samples][figures]
  size_t samples;
  double fails; // share of the samples beyond any limit; NaN: none were drawn
} SbDesignPlace;

enum { SB_DESIGN_PRESENT, SB_DESIGN_BEST, SB_DESIGN_PLACES };

typedef struct {
  SbStudyFile *study; // owned; its figures are the goal and those of the limits
  SbDesignMap map;
  SbDesign found; // `found` of it says whether there is one
  bool searched;
  SbDesignPlace place[SB_DESIGN_PLACES];
} SbDesignAnswer;

void sb_design_answer_free(SbDesignAnswer *answer); // takes NULL

// Index of a figure among the answer's, -1: not asked.
int sb_design_answer_figure(const SbDesignAnswer *answer, int figure);

// A figure anywhere on the map, linear between its points; NaN: none there.
double sb_design_map_at(const SbDesignMap *map, size_t figure, double across, double up);

// Whether a place lies in the map's plane: its other parameters are the base's.
bool sb_design_on_map(const SbDesignAnswer *answer, int place);

// Margin to its limit over the figure's scatter (by the place's effects); NaN: not known.
double sb_design_sigmas(const SbDesignAnswer *answer, int place, size_t limit);

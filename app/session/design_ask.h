// The request for a search for a design: objective, parameters with bounds, and limits; and the
// study file that `sealbench design` would need for the same request.
#pragma once

#include "app/document/study_file.h"

// Largest numbers of ranges and of limits.
enum { SB_DESIGN_RANGES = 16, SB_DESIGN_LIMITS = 10 };

// Probability that a robust design requires.
#define SB_DESIGN_ROBUST 0.999

// A parameter that can vary.
typedef struct {
  SbParamId id;
  bool free;        // the search varies it
  double low, high; // bounds of the search and of the map [SI]
} SbDesignRange;

// The request. It owns no memory. The caller may change goal, maximise, robust, closed, axis and
// the members of `range`; limits by sb_design_ask_limit().
typedef struct {
  int goal;      // the objective, an index of sb_figure()
  bool maximise; // else minimise
  bool robust;   // all limits must be met over the tolerances with probability SB_DESIGN_ROBUST
  bool closed;   // use the thesis' closed forms (milliseconds a valve), else the document's models
  size_t count;  // number of ranges
  SbDesignRange range[SB_DESIGN_RANGES];
  size_t axis[2];  // indices into `range` of the map's parameters: across, up
  SbLimits limits; // at most SB_DESIGN_LIMITS
  size_t left_out; // number of the document's limits that are not in `limits`: those beyond this
  bool usual;      // the document has no limits; `limits` are usual ones
} SbDesignAsk;

// Sets the initial request for a document: minimum break-away force within the document's limits or
// usual ones, with closed forms if these know its seals. The ranges are those of its main real
// parameters, 10 % about their values. Free, and the axes of the map, are section diameter and
// radial space (of a gasket valve bore diameter and crimp).
void sb_design_ask_init(SbDesignAsk *ask, const SbDocument *document);

// Writes the figures (indices of sb_figure()) that can be the objective or have a limit to
// figure[room] and returns their number. Further figures than `room` are omitted; SB_FIGURE_COUNT
// is enough for all.
size_t sb_design_ask_figures(int *figure, size_t room);

// As sb_design_ask_figures(), the figures that can be the objective.
size_t sb_design_ask_goals(int *figure, size_t room);

// Sets the objective: a figure of sb_design_ask_goals(), which is maximised if more is better.
void sb_design_ask_set_goal(SbDesignAsk *ask, int figure);

// Sets the limit from `low` to `high` [SI] on a figure (index of sb_figure()), in place of an
// earlier one; an infinite end is open. Both ends open removes the limit. `usual` becomes false. A
// limit on another figure than the present SB_DESIGN_LIMITS is ignored.
void sb_design_ask_limit(SbDesignAsk *ask, int figure, double low, double high);

// Returns the study file of the request with a copy of the document as its scene, with closed forms
// if `closed` is set. `issues` must be empty. Returns NULL with at least one issue: the document
// does not compile, or the request is not a valid study (no range is free, a range is empty).
// Freed by sb_study_file_free().
SbStudyFile *sb_design_ask_study(const SbDesignAsk *ask, const SbDocument *document,
                                 GPtrArray *issues);

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

typedef struct {
  int goal;      // the objective, an index of sb_figure()
  bool maximise; // else minimise
  bool robust;   // all limits must be met over the tolerances with probability SB_DESIGN_ROBUST
  bool closed;   // use the thesis' closed forms (milliseconds a valve), else the document's models
  size_t count;  // ranges
  SbDesignRange range[SB_DESIGN_RANGES];
  size_t axis[2]; // indices into `range` of the map's parameters: across, up
  SbLimits limits;
  size_t
      left_out; // number of the file's limits that exceed SB_DESIGN_LIMITS and are not in `limits`
  bool usual;   // the file has no limits; `limits` are usual ones
} SbDesignAsk;

// Sets the initial request for a document: minimum break-away force by section diameter and radial
// space, within the document's limits or usual ones. The ranges are those of its main real
// parameters.
void sb_design_ask_init(SbDesignAsk *ask, const SbDocument *document);

// Writes the figures (indices of sb_figure()) that can be the objective or have a limit to
// figure[room] and returns their number, at most `room`.
size_t sb_design_ask_figures(int *figure, size_t room);

// Sets a limit low .. high [SI] on a figure, in place of an earlier one; infinite ends are open.
// Both ends open removes it. Does nothing if there are SB_DESIGN_LIMITS others.
void sb_design_ask_limit(SbDesignAsk *ask, int figure, double low, double high);

// Returns the study file of the request with a copy of the document as its scene; NULL with issues.
// Freed by sb_study_file_free().
SbStudyFile *sb_design_ask_study(const SbDesignAsk *ask, const SbDocument *document,
                                 GPtrArray *issues);

// Returns the text of this study file, which names the file `scene` as its scene. Freed by
// g_free().
char *sb_design_ask_text(const SbDesignAsk *ask, const SbDocument *document, const char *scene);

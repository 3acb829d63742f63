// The question that a search for a design asks of a document: goal, parameters with bounds, limits;
// and the study file that says the same to `sealbench design`.
#pragma once

#include "app/document/study_file.h"

enum { SB_DESIGN_RANGES = 16, SB_DESIGN_LIMITS = 10 };

#define SB_DESIGN_ROBUST 0.999

typedef struct {
  SbParamId id;
  bool free;        // the search moves it
  double low, high; // SI: bounds of the search and of the map
} SbDesignRange;

typedef struct {
  int goal; // figures.def
  bool maximise;
  bool robust; // all limits are to hold with SB_DESIGN_ROBUST over the tolerances
  bool closed; // by the thesis' closed forms, milliseconds a valve; else by the document's models
  size_t count;
  SbDesignRange range[SB_DESIGN_RANGES];
  size_t axis[2]; // ranges of the map, across and up
  SbLimits limits;
  size_t left_out; // limits of the file beyond SB_DESIGN_LIMITS
  bool usual;      // nobody set the limits: they are usual ones
} SbDesignAsk;

// What a document is asked at first: the least break-away force of section diameter and radial
// space, within its own limits or usual ones. The ranges are those of its main real parameters.
void sb_design_ask_init(SbDesignAsk *ask, const SbDocument *document);

// Figures that may be a goal or be limited, the brief ones of the catalogue; their number.
size_t sb_design_ask_figures(int *figure, size_t room);

// Sets a limit, of at most SB_DESIGN_LIMITS, in place of an earlier one on its figure; both ends
// open: takes it away.
void sb_design_ask_limit(SbDesignAsk *ask, int figure, double low, double high);

// The study, NULL with issues. Its scene is a copy.
SbStudyFile *sb_design_ask_study(const SbDesignAsk *ask, const SbDocument *document,
                                 GPtrArray *issues);

// The text of a study file whose scene is `scene`. Owned by the caller.
char *sb_design_ask_text(const SbDesignAsk *ask, const SbDocument *document, const char *scene);

// Sentences and names of a search for a design, for the window and the terminal: translated.
// Strings are freed by g_free().
#pragma once

#include "app/session/design_job.h"

// Returns the label of a figure (index of sb_figure()) with its seal or stage.
char *sb_design_figure_name(int figure);

// Returns "minimum break-away force": a figure (index of sb_figure()) as the objective.
char *sb_design_goal_text(int figure);

// Returns what is being computed in a part of the job. Static.
const char *sb_design_part_text(SbDesignPart part);

// Returns how a search ended, in a sentence; "" if there was no search. `answer` and `why` are
// those of sb_design_job_take().
char *sb_design_end_text(const SbDesignAnswer *answer, const char *why);

// Returns what marks the best design, a line each: that the search did not converge, the bounds
// that the design is on, its warnings of validity. NULL: nothing, or no best design.
char *sb_design_marks_text(const SbDesignAnswer *answer);

// Returns the step of a parameter (SbDesignPlace.effect): "± 0.03 mm", or "± 5 %" without a
// tolerance.
char *sb_design_step_text(SbParamId id, double step, bool tolerance);

// Returns the fraction of the variance of the figure in `column` that the tolerance of its effect
// `k` (from 0) causes; an en dash without a tolerance.
char *sb_design_share_text(const SbDesignPlace *at, size_t column, size_t k);

// Returns the fraction of the valves drawn about a design that violate a limit; an en dash if none
// were drawn.
char *sb_design_fails_text(const SbDesignPlace *at);

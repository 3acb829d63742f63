// What the section view draws: the displayed frame of a session, with a section whose scales hold
// for the full run. Before the first run it is the valve at rest, from a run with closed forms and
// two frames, which takes less than a millisecond.
#pragma once

#include "app/section/section.h"
#include "app/session/session.h"

typedef struct SbSectionSource SbSectionSource;

// What to draw. All is borrowed until the session's next signal or the source's next call.
typedef struct {
  SbSection *section;   // with scales for `run`
  const SbRun *run;     // of the session, or of the valve at rest
  const SbFrame *frame; // of that run
} SbSectionSourceNow;

// Returns a source for `session`, which is borrowed and must outlive it. Freed by
// sb_section_source_free().
SbSectionSource *sb_section_source_new(SbSession *session);

// Frees the source.
void sb_section_source_free(SbSectionSource *source);

// Discards the section and the valve at rest. Must be called when another run is displayed, or when
// values change while no run is displayed.
void sb_section_source_forget(SbSectionSource *source);

// Writes what to draw now to *out. Returns FALSE if there is nothing, because there is no run and
// the values are inconsistent.
gboolean sb_section_source_now(SbSectionSource *source, SbSectionSourceNow *out);

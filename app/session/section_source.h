// What the section view draws: the session's frame with a section made for its run and for scales
// that hold over the whole of it. Before the first run it is the valve at rest, from a run of the
// closed forms with two frames that takes a fraction of a millisecond.
#pragma once

#include "app/section/section.h"
#include "app/session/session.h"

typedef struct SbSectionSource SbSectionSource;

// All borrowed until the session's next signal or the source's next call.
typedef struct {
  SbSection *section;
  const SbRun *run;     // of the session, or of the resting valve
  const SbFrame *frame; // of that run
} SbSectionSourceNow;

// The session is borrowed and must outlive the source. Owned by the caller.
SbSectionSource *sb_section_source_new(SbSession *session);

// Takes NULL.
void sb_section_source_free(SbSectionSource *source);

// To be called when another run is shown, or when values change while none is: what was made so far
// belongs to the past (a new run may even stand at an old one's address).
void sb_section_source_forget(SbSectionSource *source);

// Fills `out` with what to draw now; false if there is nothing, because the values do not go
// together and nothing has run.
gboolean sb_section_source_now(SbSectionSource *source, SbSectionSourceNow *out);

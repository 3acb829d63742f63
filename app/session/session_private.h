// The inside of a session, shared by session.c (document), session_run.c (runs) and
// session_playhead.c (playhead).
#pragma once

#include "app/session/displayed_run.h"
#include "app/session/playhead.h"
#include "app/session/session.h"

typedef enum {
  SB_SIGNAL_PARAMS,
  SB_SIGNAL_RUN,
  SB_SIGNAL_FRAMES,
  SB_SIGNAL_PLAYHEAD,
  SB_SIGNAL_COUNT
} SbSessionSignal;

typedef struct SbSessionInbox SbSessionInbox;

struct _SbSession {
  GObject parent_instance;

  // The document and what is wrong with its fields.
  SbDocument *document; // owned
  char *rejected[SB_PARAM_COUNT];
  char *error[SB_PARAM_COUNT];
  int last_edited; // parameter, or -1
  SbModel *model;  // of the present values, owned; NULL: they do not go together

  // Runs. `fresh` is what the runner computes; `shown` is what the pictures show: `fresh` as soon
  // as it is worth it, else the run before.
  SbRunner *runner; // owned
  SbSessionInbox *inbox;
  unsigned ticket; // of the request under way; 0 if none is
  SbParams asked;  // its values
  SbDisplayedRun *fresh, *shown, *earlier, *pinned;
  char *pinned_name;
  SbSessionState state;
  char *failure;
  gboolean auto_run;
  guint debounce;  // source of the delayed start
  gboolean former; // the displayed run is of former values, and stays
  gint64 started;  // [us]

  double azimuth, elevation; // of the cutaway's camera [rad]

  SbPlayhead playhead;
  SbChartData chart; // what views are given
  char *hash;
};

void sb_session_emit(SbSession *session, SbSessionSignal signal);

// After each change of values: asks for a run soon.
void sb_session_values_changed(SbSession *session);

// Tells the views and listeners that the playhead, or whether it plays, is another.
void sb_session_playhead_changed(SbSession *session);

// Forgets runs and the playhead (another document).
void sb_session_clear_runs(SbSession *session);

void sb_session_init_runs(SbSession *session);
void sb_session_dispose_runs(SbSession *session);

// Runs stored in files, so that results which take seconds are available when the window opens. A
// file contains the hash of its values, the hash of the engine's sources, the date and a checksum.
// A file whose hashes or checksum do not match is ignored, so that only results are displayed that
// this program would compute itself.
#pragma once

#include "app/base/error.h"
#include "app/document/document.h"
#include "app/run/runner.h"

#include <glib.h>

// Returns what a run must compute in order to be stored: everything that the window displays.
SbPlanWishes sb_stored_run_wishes(void);

// Writes a run of the document's values, which has ended with SB_OK, atomically to the file `path`,
// with the present date (SOURCE_DATE_EPOCH if that is set). Returns false with SB_APP_ERROR_INPUT
// if the run has not what sb_stored_run_wishes() requests, and with SB_APP_ERROR_IO if the file
// cannot be written.
SB_CHECKED bool sb_stored_run_write(const char *path, const SbDocument *document, const SbRun *run,
                                    GError **error);

// Returns the run of the values with this `hash` (sb_document_sha256(); `model` is their model)
// from the files NAME.run in `folder`, with one reference for the caller, released by
// sb_run_handle_unref(). *date is the day on which it was computed ("2026-11-23"), freed by
// g_free(). NULL if no file matches; *date is then not changed.
SbRunHandle *sb_stored_run_find(char **date, const char *folder, const char *hash,
                                const SbModel *model);

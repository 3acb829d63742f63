// Runs kept in files, so that what takes seconds to solve is there when the window opens. A file
// says of which values (their hash), by which engine (the hash of its sources) and when it was
// computed, and has a checksum: one that does not fit is as good as none, so that no result is
// shown that this program would not compute itself.
#pragma once

#include "app/base/error.h"
#include "app/document/document.h"
#include "app/run/runner.h"

#include <glib.h>

// What a run that is to be kept is planned for: everything that the window shows.
SbPlanWishes sb_stored_run_wishes(void);

// Writes a run of the document's values, which has ended well, with the present date
// (SOURCE_DATE_EPOCH if that is set).
SB_CHECKED bool sb_stored_run_write(const char *path, const SbDocument *document, const SbRun *run,
                                    GError **error);

// Reads the run of these values (`hash`: sb_document_sha256(); `model`: theirs) from the files
// NAME.run of a folder, NULL if none fits. A reference for the caller, with the day it was computed
// ("2026-11-23", g_free()) in *date.
SbRunHandle *sb_stored_run_find(char **date, const char *folder, const char *hash,
                                const SbModel *model);

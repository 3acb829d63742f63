// The store of evaluations that persists between sessions: a file in the user's cache folder, one
// for each version of the engine's sources.
#pragma once

#include "app/study/store.h"

// Opens this store. Opens one in memory instead if another process or window uses the file, the
// folder is not writable, or the file is damaged (then a new one is created the next time). Files
// of other engines, and a file of more than 200 MB, are deleted first. Returns NULL only if memory
// is short. Closed by sb_store_close(), which commits the evaluations since the last commit, or by
// sb_store_discard(), which does not.
SbStore *sb_kept_store_open(void);

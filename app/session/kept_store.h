// The store of answers that stays from one session to the next: in the user's cache folder, one for
// this engine's sources.
#pragma once

#include "app/study/store.h"

// Opens it, or one in memory where that cannot be: another process or window has it, the folder
// cannot be written, the file is damaged (it is made anew the next time). Files of other engines,
// and one that has grown beyond 200 MB, are removed first. NULL only without memory.
SbStore *sb_kept_store_open(void);

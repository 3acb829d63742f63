// The identity of this program as one line for metadata of files.
#pragma once

// Returns "Sealbench 0.2.0, engine SOURCE, commit COMMIT" with the hashes in full, without the
// commit outside of a repository (engine/base/version.h).
char *sb_identity_text(void);

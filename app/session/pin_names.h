// What a kept design is called.
#pragma once

#include "app/document/document.h"

// The name that somebody gave it, else what it differs in from the document's values, "section
// diameter 1.63 mm"; in the user's language. Owned by the caller (g_free).
char *sb_pin_name(const SbDocument *document, size_t index);

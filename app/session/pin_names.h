// Names of saved designs (pins) for the user.
#pragma once

#include "app/document/document.h"

// Returns the name of pin `index` of the document, or if it has none, how it differs from the
// values in force ("section diameter 1.63 mm", or "as now"), translated.
char *sb_pin_name(const SbDocument *document, size_t index);

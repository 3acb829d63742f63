// Marks of literal texts that the window shows in the user's language. xgettext finds both
// (po/meson.build); the engine itself translates nothing.
#pragma once

// The text is translated.
#define SB_LABEL(text) text

// A text "NAME [UNIT]", of which NAME is translated.
#define SB_QUANTITY(name, unit) name " [" unit "]"

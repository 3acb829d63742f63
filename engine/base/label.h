// Marks of string literals that the window shows in the user's language. xgettext finds the
// arguments of both macros (po/meson.build); the engine itself translates nothing.
#pragma once

// Expands to `text`, a literal that the window translates.
#define SB_LABEL(text) text

// Expands to the literal "NAME [UNIT]", of which the window translates `name`.
#define SB_QUANTITY(name, unit) name " [" unit "]"

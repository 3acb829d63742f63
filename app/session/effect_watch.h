// The effects of a session's main parameters kept up with its values: found anew once they have
// stood for a moment and their run is there. The former ones stay until then.
#pragma once

#include "app/session/effect_job.h"
#include "app/session/session.h"

typedef struct SbEffectWatch SbEffectWatch;

// Begins at once. `changed` is called on the main thread when there are new ones. `is_busy`, which
// may be NULL, says what else goes first. The session is borrowed; owned by the caller.
SbEffectWatch *sb_effect_watch_new(SbSession *session, void (*changed)(void *data),
                                   bool (*is_busy)(const void *data), void *data);

// Cancels, waits, frees. Takes NULL.
void sb_effect_watch_free(SbEffectWatch *watch);

// What there is: NULL before the first; whether it is of other values.
const SbEffects *sb_effect_watch_effects(const SbEffectWatch *watch, bool *former);

// A parameter's effect over the largest one of that goal, -1 to 1; NaN: not known. Takes NULL.
double sb_effect_share(const SbEffects *effects, int goal, int id);

// "Return −0.97 N per 0.02 mm"; NULL: not known. Takes NULL. Owned by the caller.
char *sb_effect_text(const SbEffects *effects, int goal, SbParamId id);

// The effects of the main parameters of a session with a valve (effect_job.h), recomputed when its
// values have changed: once they have not changed for a moment and their run has ended. Until then
// the earlier effects remain available.
#pragma once

#include "app/session/effect_job.h"
#include "app/session/session.h"

typedef struct SbEffectWatch SbEffectWatch;

// Starts to follow `session`, which is borrowed and must outlive the result. changed(data) is
// called in the main thread when new effects are available or their computation failed; it may call
// sb_effect_watch_effects(), but not sb_effect_watch_free(). The computation waits while
// is_busy(data) returns true (NULL: never). Freed by sb_effect_watch_free().
SbEffectWatch *sb_effect_watch_new(SbSession *session, void (*changed)(void *data),
                                   bool (*is_busy)(const void *data), void *data);

// Cancels, waits for the thread and frees `watch`.
void sb_effect_watch_free(SbEffectWatch *watch);

// Returns the effects computed last; NULL: none yet. *former is set to whether they belong to other
// values than the present ones. Borrowed until `changed`.
const SbEffects *sb_effect_watch_effects(const SbEffectWatch *watch, bool *former);

// Returns the effect of parameter `id` on goal `goal` (0 to SB_EFFECT_GOALS - 1) divided by the
// largest effect of any parameter on it, -1 to 1; NaN: not known. `effects` may be NULL.
double sb_effect_share(const SbEffects *effects, int goal, int id);

// Returns the effect as text, "Return −0.97 N per 0.02 mm"; NULL: not known. `effects` may be NULL.
char *sb_effect_text(const SbEffects *effects, int goal, SbParamId id);

// Copies of models for objects of app and ui.
#pragma once

#include "engine/valve/model/valve.h"

// Returns a copy of `model`, to be freed by sb_model_destroy(). Like g_new() it ends the program
// with a message if there is no memory, so the result is never NULL. May be called concurrently.
SbModel *sb_own_model(const SbModel *model);

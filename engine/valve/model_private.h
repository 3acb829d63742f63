// Between the files that compile a model.
#pragma once

#include "engine/valve/model.h"

// Fills what parameters say by themselves, and products of them.
void sb_model_read(SbModel *model, const SbParams *params);

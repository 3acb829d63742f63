// Everything of the engine that app/ uses, by one include.
#pragma once

#include "engine/base/status.h"
#include "engine/valve/figures.h"
#include "engine/valve/frame.h"
#include "engine/valve/model.h"
#include "engine/valve/params.h"
#include "engine/valve/plan.h"
#include "engine/valve/run/run.h"

// Version of the program, "0.1.0"; borrowed.
const char *sb_version(void);

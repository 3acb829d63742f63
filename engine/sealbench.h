// Everything of the engine that app/ uses, by one include.
#pragma once

#include "engine/figures.h"
#include "engine/frame.h"
#include "engine/model.h"
#include "engine/params.h"
#include "engine/plan.h"
#include "engine/run.h"
#include "engine/status.h"

// Version of the program, "0.1.0"; borrowed.
const char *sb_version(void);

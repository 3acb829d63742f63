// What most of app/ uses of the engine, by one include.
#pragma once

#include "engine/base/status.h"
#include "engine/base/version.h"
#include "engine/film/film.h"
#include "engine/valve/answer/evaluate.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/model/params.h"
#include "engine/valve/model/valve.h"
#include "engine/valve/run/frame.h"
#include "engine/valve/run/plan.h"
#include "engine/valve/run/run.h"

// Measured series from CSV files: time against displacement or force, to drive a valve with.
//
// Two columns of any table (app/base/table.h), named with their units: "time [s]" and "displacement
// [mm]" or "force [N]". Unlike in a measured loop every line behind the header must be a row. Time
// counts from the first row and must increase. What lies between the rows is for the engine
// (straight lines).
#pragma once

#include "app/base/issue.h"
#include "engine/valve/model/valve.h"

enum { SB_SERIES_BYTES_MAX = 1 << 20 };

// Reads `path` into *out. False with one issue (file, line, column, allowed range) if it is not
// such a series, larger than SB_SERIES_BYTES_MAX or longer than SB_MODEL_SERIES_MAX rows; *out is
// then empty.
bool sb_series_read(SbModelSeries *out, const char *path, GPtrArray *issues);

// The same for "speed [m/s]" in the second column; quantity is left as it is.
SB_CHECKED bool sb_series_read_speed(SbModelSeries *out, const char *path, GPtrArray *issues);

// And for "temperature [degC]", a shelf's, over times up to 3.2e9 s.
bool sb_series_read_temperature(SbModelSeries *out, const char *path, GPtrArray *issues);

// The first from memory; `name` stands for the file in messages.
SB_CHECKED bool sb_series_parse(SbModelSeries *out, const char *text, size_t length,
                                const char *name, GPtrArray *issues);

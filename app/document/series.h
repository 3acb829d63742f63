// Time series from CSV files that drive a valve or give the temperatures of a shelf.
//
// A series has two columns of any table (app/base/text_table.h), named with their units: "time [s]"
// and the values. Every line after the header must be a row, at most SB_MODEL_SERIES_MAX. Times
// must increase strictly; the series that is read begins at time 0. The engine interpolates
// linearly.
//
// All functions return false with at least one issue (file, line, column, allowed range) if the
// file is not such a series, is larger than SB_SERIES_BYTES_MAX or has a value out of range; *out
// is then empty. An SbModelSeries owns nothing.
#pragma once

#include "app/base/issue.h"
#include "engine/valve/model/valve.h"

// Largest size of a file [bytes].
enum { SB_SERIES_BYTES_MAX = 1 << 20 };

// Reads the file `path` with "displacement [mm]" or "force [N]" in the second column; out->quantity
// states which. Units of the columns are converted to SI.
bool sb_series_read(SbModelSeries *out, const char *path, GPtrArray *issues);

// Reads the file `path` with "speed [m/s]" in the second column. out->quantity is not changed.
SB_CHECKED bool sb_series_read_speed(SbModelSeries *out, const char *path, GPtrArray *issues);

// Reads the file `path` with "temperature [degC]" in the second column, over times up to 3.2e9 s;
// the values are in K. out->quantity is not changed.
bool sb_series_read_temperature(SbModelSeries *out, const char *path, GPtrArray *issues);

// As sb_series_read(), from the `length` bytes of a file; `name` is used as its path in messages.
SB_CHECKED bool sb_series_parse(SbModelSeries *out, const char *text, size_t length,
                                const char *name, GPtrArray *issues);

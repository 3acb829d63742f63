// Time series from CSV files that drive a valve or give the temperatures of a shelf: two columns of
// any table (app/base/text_table.h), named with their units: "time [s]" and the values. Every line
// after the header must be a row, at most SB_MODEL_SERIES_MAX. Times must increase strictly; the
// first one is subtracted from all: the series begins at 0. The engine interpolates linearly.
// The function returns false, *out then empty, with at least one issue (file, line, column, allowed
// range): no such series, above SB_SERIES_BYTES_MAX, value out of range. A series owns nothing.
#pragma once

#include "app/base/issue.h"
#include "engine/valve/model/valve.h"

// Largest size of a file [bytes].
enum { SB_SERIES_BYTES_MAX = 1 << 20 };

// What the second column holds.
typedef enum {
  SB_SERIES_DRIVE,      // "displacement [mm]" or "force [N]"; SbModelSeries.quantity states which
  SB_SERIES_SPEED,      // "speed [m/s]"; SbModelSeries.quantity is not changed
  SB_SERIES_TEMPERATURE // "temperature [degC]", times up to 3.2e9 s; quantity is not changed
} SbSeriesKind;

// Reads the `length` bytes of the file `path`, NULL: the file itself. Units of the columns are
// converted to SI, temperatures to K.
SB_CHECKED bool sb_series_read(SbModelSeries *out, SbSeriesKind kind, const char *text,
                               size_t length, const char *path, GPtrArray *issues);

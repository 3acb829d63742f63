// See drive.h.
#include "engine/mechanism/drive.h"

#include "engine/base/check.h"

#include <math.h>

static SbStatus check_table(const SbDrive *d, SbReport *report) {
  if (d->time == NULL || d->value == NULL || d->count < 2) {
    return sb_fail(report, SB_ERROR_INPUT, "a measured series needs at least two points");
  }
  for (size_t i = 0; i < d->count; i++) {
    if (!isfinite(d->time[i]) || !isfinite(d->value[i])) {
      return sb_fail(report, SB_ERROR_INPUT, "point %zu of the measured series is not a number", i);
    }
    if (i > 0 && !(d->time[i] > d->time[i - 1])) {
      return sb_fail(report, SB_ERROR_INPUT,
                     "time does not increase at point %zu of the measured series", i);
    }
  }
  return sb_succeed(report);
}

SbStatus sb_drive_check(const SbDrive *d, SbReport *report) {
  const SbBound start = {"", "the drive's start", d->start, SB_FINITE};
  const SbBound cycle[] = {
      {"drive.speed", "the platen's speed [m/s]", d->speed, SB_ABOVE_ZERO},
      {"", "the platen's speed back [m/s]", d->speed_back, SB_NOT_NEGATIVE},
      {"", "the platen's hold [s]", d->hold, SB_NOT_NEGATIVE},
      {"", "the pause between cycles [s]", d->pause, SB_NOT_NEGATIVE},
      {"drive.reversal_force", "the reversal force [N]", d->reversal_force, DBL_MIN, INFINITY},
  };
  SbStatus status = sb_check_bounds(&start, 1, report);
  if (status != SB_OK) {
    return status;
  }
  switch (d->kind) {
  case SB_DRIVE_NONE:
    return sb_succeed(report);
  case SB_DRIVE_CYCLE:
    status = sb_check_bounds(cycle, sizeof cycle / sizeof *cycle, report);
    if (status == SB_OK && d->quantity != SB_DRIVE_OF_POSITION) {
      return sb_fail(report, SB_ERROR_INPUT, "a platen cycle prescribes a position, not a force");
    }
    if (status == SB_OK && (!(d->end > d->start) || (isinf(d->reversal_force) && isinf(d->end)))) {
      return sb_fail_parameter(report, SB_ERROR_RANGE, "drive.reversal_force",
                               "a platen cycle needs a reversal force or an end beyond its start");
    }
    break;
  case SB_DRIVE_RAMP:
    status = SB_CHECK(report, {"", "the ramp's rate", d->rate, SB_ABOVE_ZERO},
                      {"", "the ramp's end", d->end, SB_FINITE});
    break;
  case SB_DRIVE_PRESS:
    status = SB_CHECK(report, {"", "the press's rise [s]", d->rise, SB_ABOVE_ZERO},
                      {"", "the press's fall [s]", d->fall, SB_ABOVE_ZERO},
                      {"", "the press's hold [s]", d->hold, SB_NOT_NEGATIVE},
                      {"", "the pause between presses [s]", d->pause, SB_NOT_NEGATIVE},
                      {"", "the press's end", d->end, SB_FINITE});
    break;
  case SB_DRIVE_SINE:
    status = SB_CHECK(report, {"", "the sinusoid's frequency [Hz]", d->frequency, SB_ABOVE_ZERO},
                      {"", "its amplitude", d->amplitude, SB_FINITE},
                      {"", "its phase [rad]", d->phase, SB_FINITE});
    break;
  case SB_DRIVE_TABLE:
    return check_table(d, report);
  }
  if (status == SB_OK && (d->kind == SB_DRIVE_CYCLE || d->kind == SB_DRIVE_PRESS)) {
    status = SB_CHECK(report, {"", "the number of cycles", d->cycles, 1.0, DBL_MAX});
  }
  return status == SB_OK ? sb_succeed(report) : status;
}

void sb_drive_start(SbDriveState *state, const SbDrive *drive) {
  *state = (SbDriveState){.phase = drive->kind == SB_DRIVE_NONE ? SB_DRIVE_DONE : SB_DRIVE_FORWARD,
                          .from = drive->start};
}

void sb_drive_sine(const SbDrive *d, double t, double *value, double *rate) {
  double w = 2.0 * M_PI * d->frequency;
  *value = d->start + d->amplitude * sin(w * t + d->phase);
  *rate = d->amplitude * w * cos(w * t + d->phase);
}

// Duration and value at the end of the present phase of a cycle, press or ramp.
static void phase_end(const SbDrive *d, const SbDriveState *s, double *lasts, double *value) {
  double back = d->speed_back > 0.0 ? d->speed_back : d->speed;
  *lasts = INFINITY;
  *value = s->from;
  switch (s->phase) {
  case SB_DRIVE_FORWARD:
    *value = d->end;
    *lasts = d->kind == SB_DRIVE_CYCLE   ? (d->end - s->from) / d->speed
             : d->kind == SB_DRIVE_PRESS ? d->rise
                                         : fabs(d->end - s->from) / d->rate;
    break;
  case SB_DRIVE_HOLD:
    *lasts = d->hold;
    break;
  case SB_DRIVE_BACK:
    *value = d->start;
    *lasts = d->kind == SB_DRIVE_CYCLE ? fmax(0.0, (s->from - d->start) / back) : d->fall;
    break;
  case SB_DRIVE_PAUSE:
    *lasts = d->pause;
    break;
  case SB_DRIVE_DONE:
    break;
  }
}

static void next_phase(SbDriveState *s, const SbDrive *d, double t, double value) {
  bool last = s->cycle + 1 >= d->cycles;
  s->since = t;
  s->from = value;
  switch (s->phase) {
  case SB_DRIVE_FORWARD:
    s->phase = d->kind == SB_DRIVE_RAMP ? SB_DRIVE_DONE : SB_DRIVE_HOLD;
    break;
  case SB_DRIVE_HOLD:
    s->phase = SB_DRIVE_BACK;
    break;
  case SB_DRIVE_BACK:
    s->phase = last ? SB_DRIVE_DONE : SB_DRIVE_PAUSE;
    break;
  case SB_DRIVE_PAUSE:
    s->phase = SB_DRIVE_FORWARD;
    s->cycle++;
    break;
  case SB_DRIVE_DONE:
    break;
  }
}

static void table_piece(SbDrivePiece *p, SbDriveState *s, const SbDrive *d, double t) {
  while (s->cursor < d->count && d->time[s->cursor] <= t) {
    s->cursor++;
  }
  size_t i = s->cursor;
  if (i == 0) {
    *p = (SbDrivePiece){.at = t, .value = d->value[0], .until = d->time[0]};
  } else if (i >= d->count) {
    s->phase = SB_DRIVE_DONE;
    *p = (SbDrivePiece){.at = t, .value = d->value[d->count - 1], .until = INFINITY};
  } else {
    double rate = (d->value[i] - d->value[i - 1]) / (d->time[i] - d->time[i - 1]);
    *p = (SbDrivePiece){
        .at = d->time[i - 1], .value = d->value[i - 1], .rate = rate, .until = d->time[i]};
  }
}

void sb_drive_piece(SbDrivePiece *p, SbDriveState *s, const SbDrive *d, double t) {
  if (d->kind == SB_DRIVE_NONE) {
    *p = (SbDrivePiece){.at = t, .until = INFINITY};
    return;
  }
  if (d->kind == SB_DRIVE_TABLE) {
    table_piece(p, s, d, t);
    return;
  }
  if (d->kind == SB_DRIVE_SINE) {
    *p = (SbDrivePiece){.at = t, .until = INFINITY, .curved = true};
    p->step = 0.1 / (2.0 * M_PI * d->frequency);
    sb_drive_sine(d, t, &p->value, &p->rate);
    return;
  }
  double lasts, value;
  phase_end(d, s, &lasts, &value);
  while (s->since + lasts <= t && s->phase != SB_DRIVE_DONE) {
    next_phase(s, d, s->since + lasts, value);
    phase_end(d, s, &lasts, &value);
  }
  *p = (SbDrivePiece){.at = s->since, .value = s->from, .until = s->since + lasts};
  bool moves = s->phase == SB_DRIVE_FORWARD || s->phase == SB_DRIVE_BACK;
  if (moves && lasts > 0.0) {
    // A forward run to a force only has no end: its rate is the speed itself.
    p->rate = isinf(lasts) ? d->speed : (value - s->from) / lasts;
  }
}

void sb_drive_reverse(SbDriveState *s, const SbDrive *d, double t) {
  if (s->phase == SB_DRIVE_FORWARD && d->kind == SB_DRIVE_CYCLE) {
    next_phase(s, d, t, s->from + d->speed * (t - s->since));
  }
}

bool sb_drive_done(const SbDriveState *state) {
  return state->phase == SB_DRIVE_DONE;
}

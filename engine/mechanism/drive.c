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
  SbStatus status = SB_CHECK(report, {0, "the drive's start", d->start, SB_FINITE});
  if (status != SB_OK || d->kind == SB_DRIVE_NONE) {
    return status;
  }
  switch (d->kind) {
  case SB_DRIVE_PRESS:
    return SB_CHECK(report, {0, "the press's rise [s]", d->rise, SB_ABOVE_ZERO},
                    {0, "the press's fall [s]", d->fall, SB_ABOVE_ZERO},
                    {0, "the press's hold [s]", d->hold, 0.0, INFINITY},
                    {0, "the pause between presses [s]", d->pause, SB_NOT_NEGATIVE},
                    {0, "the press's end", d->end, SB_FINITE},
                    {0, "the number of cycles", d->cycles, 1.0, DBL_MAX});
  case SB_DRIVE_SINE:
    return SB_CHECK(report, {0, "the sinusoid's frequency [Hz]", d->frequency, SB_ABOVE_ZERO},
                    {0, "its amplitude", d->amplitude, SB_FINITE},
                    {0, "its phase [rad]", d->phase, SB_FINITE});
  default:
    return check_table(d, report);
  }
}

void sb_drive_start(SbDriveState *state, const SbDrive *drive) {
  *state = (SbDriveState){.phase = SB_DRIVE_FORWARD, .from = drive->start};
}

void sb_drive_sine(const SbDrive *d, double t, double *value, double *rate) {
  double w = 2.0 * M_PI * d->frequency;
  *value = d->start + d->amplitude * sin(w * t + d->phase);
  *rate = d->amplitude * w * cos(w * t + d->phase);
}

static void table_piece(SbDrivePiece *p, SbDriveState *s, const SbDrive *d, double t) {
  while (s->cursor < d->count && d->time[s->cursor] <= t) {
    s->cursor++;
  }
  size_t i = s->cursor;
  if (i == 0) {
    *p = (SbDrivePiece){.at = t, .value = d->value[0], .until = d->time[0]};
  } else if (i >= d->count) {
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
  const struct {
    double lasts, to; // s, value at the end
  } phase[] = {[SB_DRIVE_FORWARD] = {d->rise, d->end},
               [SB_DRIVE_HOLD] = {d->hold, d->end},
               [SB_DRIVE_BACK] = {d->fall, d->start},
               [SB_DRIVE_PAUSE] = {d->pause, d->start},
               [SB_DRIVE_DONE] = {INFINITY, 0.0}};
  while (s->since + phase[s->phase].lasts <= t) {
    s->since += phase[s->phase].lasts;
    s->from = phase[s->phase].to;
    bool last = s->phase == SB_DRIVE_BACK && s->cycle + 1 >= d->cycles;
    s->phase = last ? SB_DRIVE_DONE : (s->phase + 1) % SB_DRIVE_DONE;
    s->cycle += s->phase == SB_DRIVE_FORWARD;
  }
  *p = (SbDrivePiece){.at = s->since,
                      .until = s->since + phase[s->phase].lasts,
                      .value = s->from,
                      .rate = (phase[s->phase].to - s->from) / phase[s->phase].lasts};
}

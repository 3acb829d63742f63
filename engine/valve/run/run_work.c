#include "engine/valve/run/run_work.h"

#include "engine/valve/model/params.h"

enum { SEGMENTS_PER_STEP = 40 };

static bool stops(SbWork *work) {
  return work->spent || (work->cancelled != NULL && work->cancelled(work->data));
}

bool sb_work_step(void *data) {
  SbWork *work = data;
  if (work->done >= work->limit) {
    work->spent = true;
  }
  work->done += work->spent ? 0 : 1;
  return stops(work);
}

bool sb_work_segment(void *data) {
  SbWork *work = data;
  if (++work->segments < SEGMENTS_PER_STEP) {
    return stops(work);
  }
  work->segments = 0;
  return sb_work_step(work);
}

SbWork sb_work_part(const SbWork *work, size_t parts) {
  const size_t left = work->limit > work->done ? work->limit - work->done : 0;
  return (SbWork){.limit = left / parts, .spent = work->spent};
}

void sb_work_add(SbWork *work, const SbWork *part) {
  const size_t left = work->limit > work->done ? work->limit - work->done : 0;
  work->spent = work->spent || part->spent || part->done > left;
  work->done += part->done < left ? part->done : left;
}

SbStatus sb_work_status(const SbWork *work, SbStatus status, SbReport *report) {
  return status == SB_ERROR_CANCELLED && work->spent
             ? sb_fail_input(report, SB_ERROR_NOT_CONVERGED, sb_input(SB_P_OUTPUT_WORK_LIMIT),
                             "the run has used up its work limit (output.work_limit): raise "
                             "it, or reduce the work by a larger output.tolerance")
             : status;
}

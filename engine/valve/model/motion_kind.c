// See motion_kind.h.
#include "engine/valve/model/motion_kind.h"

#include "engine/valve/model/model.h"

static const SbMotionKind kinds[] = {
    [SB_MODEL_MOTION_QUASI_STATIC] = {.valve = true, .lives = true},
    [SB_MODEL_MOTION_DYNAMIC] = {.valve = true, .inertia = true, .lives = true},
    [SB_MODEL_MOTION_RIG] = {.inertia = true},
    [SB_MODEL_MOTION_BODIES] = {.valve = true, .inertia = true, .joints = true},
};

const SbMotionKind *sb_motion_choice(int choice) {
  return &kinds[choice];
}

const SbMotionKind *sb_motion_kind(const SbModel *model) {
  return sb_motion_choice((int)model->motion);
}

// Names of stages.
#include "engine/valve/frame.h"

const char *sb_stage_name(SbStage stage) {
  static const char *const names[SB_STAGE_COUNT] = {"A", "B", "C", "D", "E", "F"};
  return (unsigned)stage < SB_STAGE_COUNT ? names[stage] : "?";
}

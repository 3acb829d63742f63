// A section for the session's frame (section_source.h). The scales widen while a run grows, and the
// section is then rebuilt; frames that are included in the scales are not read again.
#include "app/session/section_source.h"

#include <math.h>
#include <string.h>

enum { LIMIT_SAMPLES = 400 }; // frames read per update for the scales

struct SbSectionSource {
  SbSession *session; // borrowed
  SbSection *section; // of `run`'s model; NULL: to be made
  const SbRun *run;   // what `section` was made for; never read through
  SbRun *rest;        // owned: the resting valve
  SbSectionLimits limits;
  size_t limits_frames; // frames that the limits have seen
};

// The resting valve ------------------------------------------------------------------------------

// Whatever the models of the scene are, closed forms do for a picture at rest.
static SbRun *make_rest(const SbModel *model) {
  static const SbOverride closed[] = {{SB_P_MODELS_FIT, SB_FIT_KARASZKIEWICZ},
                                      {SB_P_MODELS_FIT_VARIANT, 0},
                                      {SB_P_MODELS_FILM, SB_FILM_THESIS}};
  g_autoptr(SbModel) quick = NULL;
  if (sb_model_derive(&quick, model, closed, G_N_ELEMENTS(closed), NULL) != SB_OK) {
    return NULL;
  }
  const SbPlanWishes wishes = {.views = SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES | SB_VIEW_SECTION,
                               .resting = true};
  SbPlan plan;
  sb_plan_wished(&plan, quick, &wishes);
  SbRun *run = NULL;
  SbReport report = {0};
  if (sb_run_create(&run, quick, &plan, &report) != SB_OK) {
    return NULL;
  }
  // What frames there are will do, whatever the run ended by.
  (void)sb_run_execute(run, NULL, &report);
  size_t count = 0;
  sb_run_frames(run, &count);
  if (count == 0) {
    sb_run_destroy(run);
    return NULL;
  }
  return run;
}

// Scales -----------------------------------------------------------------------------------------

// Widens the limits by frames that have come since, reading at most LIMIT_SAMPLES of them. True if
// they grew.
static gboolean widen_limits(SbSectionSource *source, const SbFrame *frames, size_t count) {
  SbSectionLimits *limits = &source->limits;
  SbSectionLimits before = *limits;
  size_t stride = MAX((count - source->limits_frames) / LIMIT_SAMPLES, 1);
  for (size_t i = source->limits_frames; i < count; i += stride) {
    const SbFrame *frame = &frames[i];
    for (int k = 0; k < SB_SEAL_COUNT; k++) {
      const SbSealFrame *seal = &frame->seal[k];
      limits->pressure_max = fmax(limits->pressure_max, seal->pressure_peak);
      limits->film_max = fmax(limits->film_max, seal->film_central);
      limits->contact_left[k] = fmin(limits->contact_left[k], seal->contact_left);
      limits->contact_right[k] = fmax(limits->contact_right[k], seal->contact_right);
    }
    const SbSealFrame *inner = &frame->seal[SB_INNER];
    if (frame->stage <= SB_STAGE_B && inner->land_fraction >= 1 &&
        inner->contact_right > inner->contact_left) {
      limits->inner_contact_left = inner->contact_left;
    }
  }
  source->limits_frames = count;
  return memcmp(&before, limits, sizeof before) != 0;
}

// Answers ----------------------------------------------------------------------------------------

SbSectionSource *sb_section_source_new(SbSession *session) {
  SbSectionSource *source = g_new0(SbSectionSource, 1);
  source->session = session;
  return source;
}

void sb_section_source_free(SbSectionSource *source) {
  if (source != NULL) {
    sb_section_source_forget(source);
    g_free(source);
  }
}

void sb_section_source_forget(SbSectionSource *source) {
  g_clear_pointer(&source->section, sb_section_destroy);
  g_clear_pointer(&source->rest, sb_run_destroy);
  source->run = NULL;
}

gboolean sb_section_source_now(SbSectionSource *source, SbSectionSourceNow *out) {
  const SbRun *run = sb_session_run(source->session);
  const SbFrame *frame = sb_session_frame(source->session);
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(source->session, &count);
  if (run == NULL || frame == NULL) {
    const SbModel *model = sb_session_model(source->session);
    if (source->rest == NULL && model != NULL) {
      source->rest = make_rest(model);
    }
    run = source->rest;
    if (run == NULL) {
      return FALSE;
    }
    frames = sb_run_frames(run, &count);
    frame = frames;
  }
  gboolean other = run != source->run;
  if (other) {
    source->limits = (SbSectionLimits){0};
    sb_section_limits_add_run(&source->limits, run);
    source->limits_frames = 0;
    source->run = run;
  }
  if (widen_limits(source, frames, count) || other || source->section == NULL) {
    sb_section_destroy(source->section);
    source->section = sb_section_create(sb_run_model(run), &source->limits);
  }
  *out = (SbSectionSourceNow){.section = source->section, .run = run, .frame = frame};
  return TRUE;
}

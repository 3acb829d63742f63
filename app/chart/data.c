// Small questions that several views ask of their data. Computes nothing of its own.
#include "app/chart/data.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

const SbFrame *sb_chart_frame(const SbChartData *data) {
  if (data->run.count == 0) {
    return NULL;
  }
  size_t i = data->playhead < data->run.count ? data->playhead : data->run.count - 1;
  const SbFrame *frame = &data->run.frames[i];
  return isfinite(frame->time) && isfinite(frame->displacement) && isfinite(frame->force) ? frame
                                                                                          : NULL;
}

size_t sb_chart_nearest(const SbChartRun *run, double time) {
  size_t lo = 0, hi = run->count - 1;
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (run->frames[mid].time < time) {
      lo = mid + 1;
    } else {
      hi = mid;
    }
  }
  return lo > 0 && time - run->frames[lo - 1].time < run->frames[lo].time - time ? lo - 1 : lo;
}

bool sb_chart_complete(const SbChartData *data) {
  return data->run.state == SB_CHART_DONE && data->run.trace &&
         sb_trace_frames(data->run.trace) >= data->run.count;
}

const char *sb_chart_seal_name(const SbModel *model, int seal) {
  return _(sb_device(model)->seal[seal]);
}

size_t sb_chart_forces(SbChartForce *force, const SbModel *model, const SbFrame *frame) {
  const SbDevice *device = sb_device(model);
  size_t n = 0;
  force[n++] = (SbChartForce){_("drive"), frame->force, SB_ROLE_INK};
  force[n++] = (SbChartForce){_("pressure"), frame->pressure_force, SB_ROLE_FLUID};
  if (sb_model_has_spring(model)) {
    force[n++] = (SbChartForce){_("spring"), frame->spring_force, SB_ROLE_SECOND};
  }
  force[n++] =
      (SbChartForce){_(device->friction[SB_INNER]), frame->seal[SB_INNER].friction, SB_ROLE_INNER};
  force[n++] =
      (SbChartForce){_(device->friction[SB_OUTER]), frame->seal[SB_OUTER].friction, SB_ROLE_OUTER};
  return n;
}

const char *sb_chart_phase(const SbChartRun *run, int stage) {
  const char *phase =
      stage >= 0 && stage < SB_STAGE_COUNT ? sb_device(run->model)->phase[stage] : NULL;
  if (phase != NULL) {
    return _(phase);
  }
  // Whether the inner seal touches at all is the run's own business: look at its frames.
  bool inner = true, outer = true;
  if (run->trace && stage >= 0 && stage < SB_STAGE_COUNT) {
    const SbStageMark *mark = &sb_trace_marks(run->trace)[stage];
    size_t i = mark->frame + 1;
    if (mark->reached && i < run->count) {
      inner = run->frames[i].seal[SB_INNER].load > 0;
      outer = run->frames[i].seal[SB_OUTER].load > 0;
    }
  }
  switch (stage) {
  case SB_STAGE_A:
    return _("at rest, force builds up");
  case SB_STAGE_B:
    return inner && outer ? _("both seals slide")
           : outer        ? _("outer seal slides")
           : inner        ? _("inner seal slides")
                          : _("stem slides free");
  case SB_STAGE_C:
    return _("chamber open");
  case SB_STAGE_D:
    return _("at the stop");
  case SB_STAGE_E:
    return _("return, chamber open");
  case SB_STAGE_F:
    return inner && outer ? _("both seals slide back")
           : outer        ? _("outer seal slides back")
                          : _("stem slides back");
  default:
    return "";
  }
}

const char *sb_chart_cycle_name(char *out, const SbChartRun *run, int cycle) {
  const SbModel *m = run->model;
  out[0] = '\0';
  if (m && sb_model_number(m, SB_P_LIFE_ACTUATIONS) > 1 && sb_model_shown_actuation(m) > 1) {
    g_snprintf(out, SB_FORMAT_MAX, _("actuation %d"), cycle == 0 ? 1 : sb_model_shown_actuation(m));
  } else if (m && sb_model_number(m, SB_P_DRIVE_CYCLES) > 1 && sb_device(m)->stem) {
    g_snprintf(out, SB_FORMAT_MAX, _("cycle %d"), cycle + 1);
  }
  return out;
}

const char *sb_chart_span(const SbChartRun *run, int stage) {
  if (run != NULL && !sb_device(run->model)->stem && stage == SB_STAGE_B) {
    return "B";
  }
  static const char *const spans[SB_STAGE_COUNT] = {"A\xe2\x80\x93"
                                                    "B",
                                                    "B\xe2\x80\x93"
                                                    "C",
                                                    "C\xe2\x80\x93"
                                                    "D",
                                                    "D\xe2\x80\x93"
                                                    "E",
                                                    "E\xe2\x80\x93"
                                                    "F",
                                                    "F\xe2\x80\x93"
                                                    "A"};
  return stage >= 0 && stage < SB_STAGE_COUNT ? spans[stage] : "";
}

static const SbContactProfile *run_profile(const void *source, uint32_t index) {
  return sb_run_profile(source, index);
}

static const SbSealShape *run_shape(const void *source, uint32_t index) {
  return sb_run_shape(source, index);
}

SbChartState sb_chart_state_of(const SbSummary *summary) {
  return summary->status == SB_OK                ? SB_CHART_DONE
         : summary->status == SB_ERROR_CANCELLED ? SB_CHART_PARTIAL
                                                 : SB_CHART_FAILED;
}

void sb_chart_run_init(SbChartRun *out, const SbRun *run, const SbTrace *trace,
                       SbChartState state) {
  *out = (SbChartRun){
      .state = state, .trace = trace, .profile = run_profile, .shape = run_shape, .source = run};
  out->frames = sb_run_frames(run, &out->count);
  out->model = sb_run_model(run);
  bool ended = state != SB_CHART_RUNNING && state != SB_CHART_EMPTY;
  out->summary = ended ? sb_run_summary(run) : NULL;
  out->life = ended ? sb_run_life(run, &out->life_count) : NULL;
}

static double known(double error) {
  return isfinite(error) && error > 0 ? error : 0;
}

char *sb_chart_stage_force(char *out, const SbChartRun *run, SbStage stage, double force) {
  const int figure = sb_figure_stage_force(stage);
  const bool known = run->summary != NULL && isfinite(sb_figure_value(run->summary, figure));
  return known ? sb_format_figure(out, run->summary, figure)
               : sb_figure_text(out, figure, force, NAN);
}

double sb_chart_error_force(const SbChartRun *run) {
  return run->summary ? known(run->summary->error_force) : 0;
}

double sb_chart_error_film(const SbChartRun *run) {
  return run->summary ? known(run->summary->error_film) : 0;
}

double sb_chart_error_load(const SbChartRun *run) {
  return run->summary ? known(run->summary->error_load) : 0;
}

SbRole sb_chart_pin_role(int look) {
  return look == 0 ? SB_ROLE_VIOLET : SB_ROLE_TEAL;
}

SbStroke sb_chart_pin_stroke(int look) {
  return (SbStroke){sb_chart_pin_role(look), SB_LINE_PINNED,
                    look == 0 ? &sb_dash_pinned : &sb_dash_now};
}

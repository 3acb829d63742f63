// Small questions that several views ask of their data. Computes nothing of its own.
#include "app/chart/data.h"

#include "app/chart/format.h"

#include <glib.h>
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

bool sb_chart_is_rig(const SbChartRun *run) {
  return run && run->model && run->model->motion == SB_MODEL_MOTION_RIG;
}

bool sb_chart_complete(const SbChartData *data) {
  return data->run.state == SB_CHART_DONE && data->run.trace &&
         sb_trace_frames(data->run.trace) >= data->run.count;
}

const char *sb_chart_phase(const SbChartRun *run, int stage) {
  if (sb_chart_is_rig(run)) {
    return stage == SB_STAGE_A ? "force builds up" : "sticks and slips";
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
    return "at rest, force builds up";
  case SB_STAGE_B:
    return inner && outer ? "both seals slide"
           : outer        ? "outer seal slides"
           : inner        ? "inner seal slides"
                          : "stem slides free";
  case SB_STAGE_C:
    return "chamber open";
  case SB_STAGE_D:
    return "at the stop";
  case SB_STAGE_E:
    return "return, chamber open";
  case SB_STAGE_F:
    return inner && outer ? "both seals slide back"
           : outer        ? "outer seal slides back"
                          : "stem slides back";
  default:
    return "";
  }
}

const char *sb_chart_span(const SbChartRun *run, int stage) {
  if (sb_chart_is_rig(run) && stage == SB_STAGE_B) {
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

static void say(GString *out, const char *label, SbQuantity quantity, double value, double error) {
  char text[SB_FORMAT_MAX];
  g_string_append_printf(out, "%s %s", label,
                         isfinite(value) ? sb_format_text(text, quantity, value, error)
                                         : "not computed");
}

char *sb_chart_summary(const SbChartData *data) {
  const SbChartRun *run = &data->run;
  const SbFrame *f = sb_chart_frame(data);
  GString *out = g_string_new(NULL);
  if (!f) {
    g_string_append(out, run->state == SB_CHART_RUNNING ? "The run has begun." : "No run yet.");
    return g_string_free(out, FALSE);
  }
  switch (run->state) {
  case SB_CHART_RUNNING:
    g_string_append_printf(out, "Being computed, %zu frames so far. ", run->count);
    break;
  case SB_CHART_PARTIAL:
    g_string_append(out, "Partial: the run was cancelled. ");
    break;
  case SB_CHART_FAILED:
    g_string_append(out, "The solver did not converge; up to the last good state. ");
    break;
  default:
    break;
  }

  // The instant.
  double force_error = sb_chart_error_force(run), film_error = sb_chart_error_film(run);
  g_string_append_printf(out, "Stage %s, %s:", sb_chart_span(run, f->stage),
                         sb_chart_phase(run, f->stage));
  say(out, "", SB_QUANTITY_TIME, f->time, 0);
  say(out, ", displacement", SB_QUANTITY_LENGTH, f->displacement, 0);
  if (sb_chart_is_rig(run)) {
    say(out, ", force in the thread", SB_QUANTITY_FORCE, f->force, force_error);
    g_string_append(out, ".");
    if (run->summary && run->summary->rig.found && sb_chart_complete(data)) {
      const SbRigCoefficients *of = &run->summary->rig.of;
      say(out, " Static coefficient", SB_QUANTITY_NUMBER, of->static_coefficient, 0);
      say(out, ", dynamic", SB_QUANTITY_NUMBER, of->dynamic_coefficient, 0);
      say(out, " (mean of the peaks), of the mean force", SB_QUANTITY_NUMBER, of->mean_coefficient,
          0);
      g_string_append(out, "; the thesis measured 0.51 and predicted 0.4.");
    }
    return g_string_free(out, FALSE);
  }
  say(out, ", force on the stem", SB_QUANTITY_FORCE, f->force, force_error);
  say(out, ", pressure force", SB_QUANTITY_FORCE, f->pressure_force, 0);
  g_string_append(out, ".");
  static const int order[SB_SEAL_COUNT] = {SB_INNER, SB_OUTER};
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealFrame *s = &f->seal[order[i]];
    const char *name = order[i] == SB_INNER ? " Inner seal:" : " Outer seal:";
    if (!(s->load > 0)) {
      g_string_append_printf(out, "%s no contact.", name);
      continue;
    }
    g_string_append(out, name);
    say(out, " friction", SB_QUANTITY_FORCE, s->friction, force_error);
    say(out, ", contact", SB_QUANTITY_LENGTH, s->contact_right - s->contact_left, 0);
    say(out, ", peak", SB_QUANTITY_PRESSURE, s->pressure_peak, 0);
    if (s->film_central > 0) {
      say(out, ", film", SB_QUANTITY_FILM, s->film_central, film_error);
      say(out, ", least", SB_QUANTITY_FILM, s->film_min, film_error);
    } else {
      g_string_append(out, isnan(s->film_central) ? ", film not computed" : ", at rest");
    }
    g_string_append(out, ".");
  }

  if (run->life_count > 1 && sb_chart_complete(data)) {
    const SbLifeActuation *last = &run->life[run->life_count - 1];
    g_string_append_printf(out, " Life of %zu actuations:", run->life_count);
    say(out, " break-away", SB_QUANTITY_FORCE, run->life[0].force_breakaway, force_error);
    say(out, " to", SB_QUANTITY_FORCE, last->force_breakaway, force_error);
    say(out, ", least return", SB_QUANTITY_FORCE, run->life[0].force_return, force_error);
    say(out, " to", SB_QUANTITY_FORCE, last->force_return, force_error);
    say(out, ", leakage carried out", SB_QUANTITY_VOLUME, run->summary->life.carried, 0);
    g_string_append(out, ".");
  }
  // The whole loop.
  if (run->summary && sb_chart_complete(data)) {
    say(out, " Break-away", SB_QUANTITY_FORCE, run->summary->force_breakaway, force_error);
    say(out, ", least return", SB_QUANTITY_FORCE, run->summary->force_return_min, force_error);
    say(out, ", loss per cycle", SB_QUANTITY_ENERGY, run->summary->energy.loop, 0);
    g_string_append(out, isnan(run->summary->returned) ? "; whether the stem returns is not known."
                         : run->summary->returns       ? "; the stem returns."
                                                       : "; the stem does not return.");
  }
  return g_string_free(out, FALSE);
}

static double known(double error) {
  return isfinite(error) && error > 0 ? error : 0;
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

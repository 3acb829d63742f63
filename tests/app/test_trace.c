// The thinned trace: bounded, complete, the same however the frames arrive; and finding the frame
// under a point.
#include "app/base/format.h"
#include "app/chart/hysteresis.h"
#include "app/chart/profiles.h"
#include "app/chart/timeline.h"
#include "tests/app/synthetic.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static void test_events(void) {
  Synthetic run;
  synthetic_init(&run, 1250, 1);
  const SbStageMark *mark = sb_trace_marks(run.trace);
  static const double force[SB_STAGE_COUNT] = {0, 28.7, 27.4, 22.5, 6.5, 6.5};
  static const double place[SB_STAGE_COUNT] = {0, 0, 3.3e-3, 6.6e-3, 6.6e-3, 3.3e-3};
  for (int s = 0; s < SB_STAGE_COUNT; s++) {
    g_assert_true(mark[s].reached);
    g_assert_cmpfloat(fabs(mark[s].force - force[s]), <, 1e-6);
    g_assert_cmpfloat(fabs(mark[s].displacement - place[s]), <, 1e-9);
    g_assert_cmpfloat(run.frames[mark[s].frame].force, ==, mark[s].force);
  }
  synthetic_clear(&run);
}

// Events of a second cycle are marked like those of the first, and told apart from them; the first
// cycle's marks stay its own.
static void test_second_cycle(void) {
  Synthetic run;
  synthetic_init(&run, 1250, 1);
  size_t count = 2 * run.count, events = 0;
  SbFrame *frames = g_new(SbFrame, count);
  for (size_t i = 0; i < count; i++) {
    frames[i] = run.frames[i % run.count];
    frames[i].time += i < run.count ? 0 : run.frames[run.count - 1].time;
  }
  SbTrace *trace = sb_trace_create(run.model);
  sb_trace_extend(trace, frames, count, 0);
  const SbTraceEvent *event = sb_trace_events(trace, &events);
  g_assert_cmpuint(events, ==, 2 * SB_STAGE_COUNT);
  for (size_t i = 0; i < events; i++) {
    g_assert_cmpint((int)event[i].stage, ==, (int)(i % SB_STAGE_COUNT));
    g_assert_cmpint(event[i].cycle, ==, (int)(i / SB_STAGE_COUNT));
  }
  const SbStageMark *second = sb_trace_mark(trace, SB_STAGE_C, 1);
  g_assert_cmpuint(second->frame, >=, run.count);
  g_assert_cmpfloat(fabs(second->force - 27.4), <, 1e-6);
  g_assert_cmpuint(sb_trace_marks(trace)[SB_STAGE_C].frame, <, run.count);
  g_assert_cmpuint(sb_trace_stage_end(trace, SB_STAGE_F, 0, count), ==,
                   sb_trace_mark(trace, SB_STAGE_A, 1)->frame);
  g_assert_cmpint(sb_trace_event_of(trace, frames, second->frame + 1), ==, SB_STAGE_COUNT + 2);
  SbModel *life = NULL;
  const SbOverride lives = {SB_P_LIFE_ACTUATIONS, 400};
  g_assert_cmpint(sb_model_derive(&life, run.model, &lives, 1, NULL), ==, SB_OK);
  SbChartRun shown = {.model = life};
  char name[SB_FORMAT_MAX];
  g_assert_cmpstr(sb_chart_cycle_name(name, &shown, 1), ==, "actuation 400");
  sb_model_destroy(life);
  sb_trace_destroy(trace);
  g_free(frames);
  synthetic_clear(&run);
}

// Every frame lies within the gap of the polyline, and pieces give the same as the whole.
static void test_faithful(void) {
  Synthetic run;
  synthetic_init(&run, 100000, 1);
  size_t n, m;
  const SbTracePoint *p = sb_trace_points(run.trace, &n);
  g_assert_cmpuint(n, <, 20000);
  size_t k = 0;
  double worst = 0;
  for (size_t i = 0; i < run.count; i++) {
    while (k + 1 < n && p[k + 1].frame <= i) {
      k++;
    }
    const SbFrame *f = &run.frames[i];
    size_t next = MIN(k + 1, n - 1);
    double d = INFINITY;
    for (size_t q = k; q <= next; q++) {
      d = fmin(d,
               hypot((f->displacement - p[q].displacement) / 6.6e-3, (f->force - p[q].force) / 35));
    }
    worst = fmax(worst, d);
  }
  g_test_message("%zu points of %zu frames, furthest %.2g of the range", n, run.count, worst);
  g_assert_cmpfloat(worst, <, 4.0 / 4000);

  SbTrace *pieces = sb_trace_create(run.model);
  size_t turns = 0;
  while (sb_trace_extend(pieces, run.frames, run.count, 777)) {
    turns++;
  }
  g_assert_cmpuint(turns, ==, run.count / 777);
  const SbTracePoint *q = sb_trace_points(pieces, &m);
  g_assert_cmpuint(m, ==, n);
  g_assert_cmpint(memcmp(p, q, n * sizeof *p), ==, 0);
  sb_trace_destroy(pieces);
  synthetic_clear(&run);
}

// A run that lasts far longer than its model says, and jitters: memory stays bounded.
static void test_bounded(void) {
  SbTrace *trace = sb_trace_create(NULL);
  enum { COUNT = 200000 };
  SbFrame *frames = g_new0(SbFrame, COUNT);
  for (size_t i = 0; i < COUNT; i++) {
    frames[i] = (SbFrame){.time = (double)i,
                          .displacement = 3e-3 * (1 + sin(0.1 * (double)i)),
                          .force = 20 * cos(0.37 * (double)i)};
  }
  sb_trace_extend(trace, frames, COUNT, 0);
  size_t n;
  const SbTracePoint *p = sb_trace_points(trace, &n);
  g_assert_cmpuint(n, <=, 60001);
  for (size_t i = 1; i < n; i++) {
    g_assert_cmpuint(p[i].frame, >, p[i - 1].frame);
  }
  g_free(frames);
  sb_trace_destroy(trace);
  sb_trace_destroy(NULL);
}

static void test_hit(void) {
  Synthetic run;
  synthetic_init(&run, 1250, 1);
  SbChartData data;
  synthetic_data(&data, &run, 7.27);
  const SbRect rect = {10, 20, 640, 560};
  SbAxes at;
  sb_hysteresis_layout(&at, rect, &data, SB_CHART_PANEL);
  int exact = 0, tried = 0;
  for (size_t i = 40; i < run.count; i += 37, tried++) {
    const SbFrame *f = &run.frames[i];
    double x = sb_axis_at(&at.x, f->displacement * 1e3), y = sb_axis_at(&at.y, f->force);
    size_t hit = SIZE_MAX;
    g_assert_true(sb_hysteresis_hit(&hit, rect, &data, SB_CHART_PANEL, x, y, 6));
    const SbFrame *h = &run.frames[hit];
    // The frame found is at the same place on the picture, within its neighbours' spacing.
    double d = hypot(sb_axis_at(&at.x, h->displacement * 1e3) - x, sb_axis_at(&at.y, h->force) - y);
    g_assert_cmpfloat(d, <, 3);
    exact += hit == i;
  }
  g_test_message("%d of %d hit exactly", exact, tried);
  g_assert_cmpint(exact, >, tried / 2);
  size_t none;
  g_assert_false(sb_hysteresis_hit(&none, rect, &data, SB_CHART_PANEL, 200, 300, 6));
  synthetic_clear(&run);
}

static void test_timeline_hit(void) {
  Synthetic run;
  synthetic_init(&run, 1250, 1);
  SbChartData data;
  synthetic_data(&data, &run, 0);
  const SbRect rect = {30, 0, 1300, 104};
  SbScale scale = sb_timeline_scale(rect, &data);
  for (size_t i = 0; i < run.count; i += 7) {
    size_t hit = SIZE_MAX;
    g_assert_true(sb_timeline_hit(&hit, rect, &data, sb_axis_at(&scale, run.frames[i].time)));
    g_assert_cmpfloat(run.frames[hit].time, ==, run.frames[i].time);
  }
  // Beyond the ends: the first and the last frame.
  size_t hit;
  g_assert_true(sb_timeline_hit(&hit, rect, &data, -50));
  g_assert_cmpuint(hit, ==, 0);
  g_assert_true(sb_timeline_hit(&hit, rect, &data, 5000));
  g_assert_cmpuint(hit, ==, run.count - 1);
  data.run.count = 0;
  g_assert_false(sb_timeline_hit(&hit, rect, &data, 100));
  synthetic_clear(&run);
}

// A bookmark is hit at its name, above the strips; where its name would cover another's, at a bare
// flag. Names stand in the order of their times, whatever that of the bookmarks.
static void test_marker_hit(void) {
  Synthetic run;
  synthetic_init(&run, 1250, 1);
  SbChartData data;
  synthetic_data(&data, &run, 0);
  const SbRect rect = {30, 0, 1300, 104};
  const SbScale scale = sb_timeline_scale(rect, &data);
  const double last = run.frames[run.count - 1].time, near = 20 * last / 1300;
  const SbChartMarker markers[] = {
      {0.5 * last + near, "second"}, {0.5 * last, "a long first name"}, {last, "end"}};
  data.marker = markers;
  data.marker_count = G_N_ELEMENTS(markers);
  size_t hit = SIZE_MAX;
  const double first = sb_axis_at(&scale, markers[1].time);
  g_assert_true(sb_timeline_marker_hit(&hit, rect, &data, first + 50, 8));
  g_assert_cmpuint(hit, ==, 1);
  g_assert_true(sb_timeline_marker_hit(&hit, rect, &data, first + 24, 8));
  g_assert_cmpuint(hit, ==, 0);
  g_assert_true(sb_timeline_marker_hit(&hit, rect, &data, 1325, 8));
  g_assert_cmpuint(hit, ==, 2);
  g_assert_false(sb_timeline_marker_hit(&hit, rect, &data, first + 50, 40));
  g_assert_false(sb_timeline_marker_hit(&hit, rect, &data, first - 20, 8));
  data.marker_count = 0;
  g_assert_false(sb_timeline_marker_hit(&hit, rect, &data, first + 50, 8));
  synthetic_clear(&run);
}

// What is read off the loop at a displacement lies between the forces of the frames beside it, each
// way; beyond the stroke there is nothing to read.
static void test_cursor(void) {
  Synthetic run;
  SbChartData data;
  synthetic_init(&run, 1250, 1);
  synthetic_data(&data, &run, 7.27);
  for (double s = 0.4e-3; s < 6.4e-3; s += 0.37e-3) {
    double force[2];
    sb_hysteresis_forces(force, &data.run, s);
    int found[2] = {0, 0};
    for (size_t i = 1; i < run.count; i++) {
      const SbFrame *a = &run.frames[i - 1], *b = &run.frames[i];
      const int way = b->displacement < a->displacement;
      if ((a->displacement - s) * (b->displacement - s) < 0) {
        found[way]++;
        const double low = fmin(a->force, b->force), high = fmax(a->force, b->force);
        g_assert_cmpfloat(force[way], >, low - 0.2);
        g_assert_cmpfloat(force[way], <, high + 0.2);
      }
    }
    g_assert_cmpint(found[0], ==, 1);
    g_assert_cmpint(found[1], ==, 1);
    g_assert_cmpfloat(force[0], >, force[1]);
  }
  double beyond[2];
  sb_hysteresis_forces(beyond, &data.run, 8e-3);
  g_assert_true(isnan(beyond[0]) && isnan(beyond[1]));
  // A point of the picture is the displacement that is drawn there; the title is none.
  const SbRect rect = {16, 12, 400, 300};
  SbAxes at;
  sb_hysteresis_layout(&at, rect, &data, SB_CHART_COMPACT);
  double s = 0;
  g_assert_true(sb_hysteresis_cursor(&s, rect, &data, SB_CHART_COMPACT, sb_axis_at(&at.x, 2),
                                     at.plot.y + 20));
  g_assert_cmpfloat(fabs(s - 2e-3), <, 1e-9);
  g_assert_false(sb_hysteresis_cursor(&s, rect, &data, SB_CHART_COMPACT, at.plot.x + 20, 15));
  // Enlarged about a point that stays where it is, twice, and back to all of it; never beyond.
  SbChartZoom zoom;
  SbAxes near;
  const double x = sb_axis_at(&at.x, 2), y = sb_axis_at(&at.y, 20);
  g_assert_false(sb_hysteresis_zoom(&zoom, rect, &data, SB_CHART_COMPACT, 1, x, y));
  for (int i = 0; i < 2; i++) {
    g_assert_true(sb_hysteresis_zoom(&zoom, rect, &data, SB_CHART_COMPACT, 2, x, y));
    data.zoom = &zoom;
  }
  sb_hysteresis_layout(&near, rect, &data, SB_CHART_COMPACT);
  g_assert_cmpfloat(fabs(sb_axis_at(&near.x, 2) - x), <, 1e-6);
  g_assert_cmpfloat(fabs(sb_axis_at(&near.y, 20) - y), <, 1e-6);
  g_assert_cmpfloat(fabs((near.x.hi - near.x.lo) / (at.x.hi - at.x.lo) - 0.25), <, 1e-9);
  g_assert_cmpint(near.x_ticks.count, >=, 3);
  for (int i = 0; i < 60; i++) { // at the corner: no nearer than told
    g_assert_true(sb_hysteresis_zoom(&zoom, rect, &data, SB_CHART_COMPACT, 2, at.plot.x, y));
  }
  g_assert_cmpfloat(zoom.x1 - zoom.x0, >=, (at.x.hi - at.x.lo) / SB_HYSTERESIS_ZOOM_MAX);
  gboolean part = TRUE;
  for (int i = 0; i < 60 && part; i++) {
    part = sb_hysteresis_zoom(&zoom, rect, &data, SB_CHART_COMPACT, 0.5, at.plot.x + 300, y);
    g_assert_cmpfloat(zoom.x0, >=, at.x.lo - 1e-9);
    g_assert_cmpfloat(zoom.x1, <=, at.x.hi + 1e-9);
  }
  g_assert_false(part);
  synthetic_clear(&run);
}

// What is read off a contact's panel is what its curve has there, and lies where that is drawn;
// beside the plots and in a title there is nothing to read.
static void test_contact_cursor(void) {
  Synthetic run;
  SbChartData data;
  synthetic_init(&run, 1250, 1);
  synthetic_data(&data, &run, 2);
  const SbRect rect = {16, 12, 400, 160};
  const SbFrame *frame = sb_chart_frame(&data);
  for (int film = 0; film < 2; film++) {
    unsigned found = 0;
    double most[SB_SEAL_COUNT] = {0}, last[SB_SEAL_COUNT] = {-1, -1};
    for (double x = rect.x; x < rect.x + rect.width; x++) {
      SbProfileReading at;
      if (sb_profiles_read(&at, rect, &data, SB_CHART_COMPACT, film, x, rect.y + 80)) {
        found |= 1u << at.seal;
        most[at.seal] = fmax(most[at.seal], at.value);
        g_assert_cmpfloat(at.at.x, ==, x);
        g_assert_true(x >= at.plot.x && x <= at.plot.x + at.plot.width);
        g_assert_cmpfloat(at.position, >, last[at.seal]);
        last[at.seal] = at.position;
      }
    }
    g_assert_cmpuint(found, ==, 3);
    for (int i = 0; i < SB_SEAL_COUNT && !film; i++) {
      g_assert_cmpfloat(fabs(most[i] / frame->seal[i].pressure_peak - 1), <, 0.05);
    }
    SbProfileReading none;
    g_assert_false(sb_profiles_read(&none, rect, &data, SB_CHART_COMPACT, film, 20, 60));
    g_assert_false(sb_profiles_read(&none, rect, &data, SB_CHART_COMPACT, film, 200, 16));
  }
  synthetic_clear(&run);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/trace/events", test_events);
  g_test_add_func("/trace/second-cycle", test_second_cycle);
  g_test_add_func("/trace/faithful", test_faithful);
  g_test_add_func("/trace/bounded", test_bounded);
  g_test_add_func("/trace/hit", test_hit);
  g_test_add_func("/trace/timeline-hit", test_timeline_hit);
  g_test_add_func("/trace/marker-hit", test_marker_hit);
  g_test_add_func("/trace/cursor", test_cursor);
  g_test_add_func("/trace/contact-cursor", test_contact_cursor);
  return g_test_run();
}

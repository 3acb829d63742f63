// A finished run as bytes and back, for a program that shows it without computing it: its frames,
// profiles, shapes, actuations and summary, as they are in memory. The bytes are valid only for the
// build that wrote them; the caller ensures that (sb_engine_identity(), app/session/stored_run.h),
// and that they are complete. What is read is still checked, so that no index is outside its array.
// Data from which other runs start are not stored: a run that was read computes nothing.
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_private.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { MAGIC = 0x31724253, MODEL_NAME = 64 };

// Sizes that another build may have otherwise.
typedef struct {
  unsigned magic, profiles, shapes, figures;
  size_t frame, summary, actuation;
} Head;

static Head head_of_build(void) {
  Head head;
  memset(&head, 0, sizeof head); // padding too: it is compared
  head.magic = MAGIC;
  head.profiles = SB_RUN_PROFILE_SLOTS;
  head.shapes = SB_RUN_SHAPES;
  head.figures = SB_FIGURE_COUNT;
  head.frame = sizeof(SbFrame);
  head.summary = sizeof(SbSummary);
  head.actuation = sizeof(SbLifeActuation);
  return head;
}

// Writing ----------------------------------------------------------------------------------------

typedef struct {
  unsigned char *to; // NULL: only counted
  size_t size;
} Writer;

static void put(Writer *writer, const void *from, size_t size) {
  if (writer->to != NULL && size > 0) {
    memcpy(writer->to + writer->size, from, size);
  }
  writer->size += size;
}

static void put_profile(Writer *writer, const SbContactProfile *view) {
  const size_t n = view->count;
  put(writer, &n, sizeof n);
  if (n > 0) {
    char model[MODEL_NAME] = "";
    sb_text(model, sizeof model, "%s", view->model);
    put(writer, model, sizeof model);
    // The rows are next to each other (sb_run_profile_view()).
    put(writer, view->x, SB_PROFILE_ROWS * n * sizeof *view->x);
  }
}

static void put_shape(Writer *writer, const SbSealShape *view) {
  put(writer, &view->nodes, sizeof view->nodes);
  if (view->nodes > 0) {
    put(writer, &view->triangles, sizeof view->triangles);
    put(writer, &view->outline, sizeof view->outline);
    const double numbers[] = {view->contact_left, view->contact_right, view->load, view->drag};
    put(writer, numbers, sizeof numbers);
    put(writer, view->place, 2 * view->nodes * sizeof *view->place);
    for (int f = 0; f < SB_FIELD_COUNT; f++) {
      put(writer, view->field[f], view->nodes * sizeof(float));
    }
    put(writer, view->triangle, 3 * view->triangles * sizeof(int));
    put(writer, view->outline_node, view->outline * sizeof(int));
  }
}

static void put_run(Writer *writer, const SbRun *run) {
  const Head head = head_of_build();
  put(writer, &head, sizeof head);
  put(writer, &run->count, sizeof run->count);
  put(writer, run->frames, run->count * sizeof *run->frames);
  const size_t actuations = run->life != NULL ? (size_t)run->summary.life.done : 0;
  put(writer, &actuations, sizeof actuations);
  put(writer, run->life, actuations * sizeof *run->life);
  for (int i = 0; i < SB_RUN_PROFILE_SLOTS; i++) {
    put_profile(writer, &run->profile[i].view);
  }
  for (int i = 0; i < SB_RUN_SHAPES; i++) {
    put_shape(writer, &run->shape[i].view);
  }
  put(writer, &run->summary, sizeof run->summary);
}

SbStatus sb_run_pack(void **out, size_t *size, const SbRun *run, SbReport *report) {
  *out = NULL;
  *size = 0;
  if (!run->summary.converged || run->summary.bodies.joints > 0) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "only a run that converged, and has no joints' reactions, can be stored");
  }
  Writer writer = {0};
  put_run(&writer, run);
  *size = writer.size;
  *out = malloc(writer.size);
  if (*out == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a stored run");
  }
  writer = (Writer){.to = *out};
  put_run(&writer, run);
  return sb_succeed(report);
}

// Reading ----------------------------------------------------------------------------------------

typedef struct {
  const unsigned char *from;
  size_t left;
  bool good;
} Reader;

// Takes the next bytes; nothing once they were not enough.
static bool take(void *to, Reader *reader, size_t size) {
  reader->good = reader->good && size <= reader->left;
  if (reader->good && size > 0) {
    memcpy(to, reader->from, size);
    reader->from += size;
    reader->left -= size;
  }
  return reader->good;
}

// Reads a number of items, of at least `each` bytes, that the remaining bytes can contain.
static size_t take_count(Reader *reader, size_t each) {
  size_t count = 0;
  if (take(&count, reader, sizeof count) && count > reader->left / each) {
    reader->good = false;
  }
  return reader->good ? count : 0;
}

static void *room_for(Reader *reader, size_t size) {
  void *room = reader->good ? malloc(size) : NULL;
  reader->good = room != NULL;
  return room;
}

static void take_profile(SbRunProfile *profile, Reader *reader) {
  const size_t n = take_count(reader, SB_PROFILE_ROWS * sizeof(double));
  if (n == 0) {
    return;
  }
  char model[MODEL_NAME];
  take(model, reader, sizeof model);
  profile->data = room_for(reader, SB_PROFILE_ROWS * n * sizeof(double) + sizeof model);
  if (!take(profile->data, reader, SB_PROFILE_ROWS * n * sizeof(double))) {
    return;
  }
  // The name of its model follows the numbers.
  char *name = (char *)(profile->data + SB_PROFILE_ROWS * n);
  model[MODEL_NAME - 1] = '\0';
  memcpy(name, model, sizeof model);
  profile->view = sb_run_profile_view(profile->data, n, name);
}

static void take_shape(SbRunShape *shape, Reader *reader) {
  const size_t each = 2 * sizeof(double) + SB_FIELD_COUNT * sizeof(float);
  const size_t n = take_count(reader, each);
  if (n == 0) {
    return;
  }
  const size_t triangles = take_count(reader, 3 * sizeof(int));
  const size_t outline = take_count(reader, sizeof(int));
  double numbers[4];
  take(numbers, reader, sizeof numbers);
  const size_t numbers_of_nodes = 3 * triangles + outline;
  double *place = shape->data = room_for(reader, n * each + numbers_of_nodes * sizeof(int));
  if (!take(place, reader, n * each + numbers_of_nodes * sizeof(int))) {
    return;
  }
  float *field = (float *)(place + 2 * n);
  int *node = (int *)(field + SB_FIELD_COUNT * n);
  for (size_t i = 0; i < numbers_of_nodes; i++) {
    reader->good = reader->good && node[i] >= 0 && (size_t)node[i] < n;
  }
  shape->view = (SbSealShape){.nodes = reader->good ? n : 0,
                              .triangles = triangles,
                              .outline = outline,
                              .place = place,
                              .triangle = node,
                              .outline_node = node + 3 * triangles,
                              .contact_left = numbers[0],
                              .contact_right = numbers[1],
                              .load = numbers[2],
                              .drag = numbers[3]};
  for (size_t f = 0; f < SB_FIELD_COUNT; f++) {
    shape->view.field[f] = field + f * n;
  }
}

static void take_frames(SbRun *run, Reader *reader) {
  run->count = take_count(reader, sizeof *run->frames);
  reader->good = reader->good && run->count <= run->capacity;
  if (!reader->good || !take(run->frames, reader, run->count * sizeof *run->frames)) {
    run->count = 0;
  }
  for (size_t i = 0; i < run->count; i++) {
    const SbFrame *frame = &run->frames[i];
    reader->good = reader->good && frame->stage < SB_STAGE_COUNT &&
                   frame->chamber < SB_CYCLE_CHAMBERS &&
                   (i == 0 || frame->time >= run->frames[i - 1].time);
  }
}

static void take_life(SbRun *run, Reader *reader) {
  const size_t count = take_count(reader, sizeof *run->life);
  reader->good = reader->good && count < LONG_MAX;
  if (count > 0 && reader->good) {
    free(run->life);
    run->life = room_for(reader, count * sizeof *run->life);
    take(run->life, reader, count * sizeof *run->life);
  }
  run->summary.life.done = (long)count; // compared when the summary is read
}

static void end_text(char *text, size_t size) {
  text[size - 1] = '\0';
}

#define END(text) end_text(text, sizeof(text))

static void take_summary(SbRun *run, Reader *reader) {
  const long actuations = run->summary.life.done;
  SbSummary *summary = &run->summary;
  if (!take(summary, reader, sizeof *summary)) {
    memset(summary, 0, sizeof *summary);
    return;
  }
  summary->warnings.subject = NULL;
  bool good = summary->warnings.count <= SB_WARNINGS_MAX &&
              summary->reasons.count <= SB_REASONS_MAX && summary->frames == run->count &&
              summary->life.done == actuations && summary->bodies.joints == 0;
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    good = good && summary->reasons.of[i] <= summary->reasons.count;
  }
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    good = good && (!summary->stage[i].reached || summary->stage[i].frame < run->count);
  }
  for (int i = 0; i < SB_WARNINGS_MAX; i++) {
    SbWarning *warning = &summary->warnings.item[i];
    END(warning->code);
    END(warning->text);
    END(warning->subject);
  }
  for (int i = 0; i < SB_REASONS_MAX; i++) {
    END(summary->reasons.text[i]);
  }
  END(summary->bodies.text);
  reader->good = good;
  if (good) {
    // Limits are the model's, and no part of what a run is known by.
    sb_verdict_fill(summary, run->model);
  }
}

SbStatus sb_run_unpack(SbRun **out, const SbModel *model, const SbPlan *plan, const void *bytes,
                       size_t size, SbReport *report) {
  Reader reader = {.from = bytes, .left = size, .good = true};
  const Head mine = head_of_build();
  Head head;
  *out = NULL;
  if (!take(&head, &reader, sizeof head) || memcmp(&head, &mine, sizeof head) != 0) {
    return sb_fail(report, SB_ERROR_INPUT, "this stored run belongs to another program");
  }
  SbRun *run;
  SbStatus status = sb_run_create(&run, model, plan, report);
  if (status != SB_OK) {
    return status;
  }
  take_frames(run, &reader);
  take_life(run, &reader);
  for (int i = 0; i < SB_RUN_PROFILE_SLOTS; i++) {
    take_profile(&run->profile[i], &reader);
  }
  for (int i = 0; i < SB_RUN_SHAPES; i++) {
    take_shape(&run->shape[i], &reader);
  }
  take_summary(run, &reader);
  if (!reader.good || reader.left > 0) {
    sb_run_destroy(run);
    return sb_fail(report, SB_ERROR_INPUT, "this stored run is incomplete");
  }
  sb_run_publish(run, run->count);
  *out = run;
  return sb_succeed(report);
}

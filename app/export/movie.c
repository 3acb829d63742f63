// Two threads over a short row of pictures: this one draws into free pictures, the other encodes
// full ones. POSIX threads and a mutex, so that the thread sanitizer understands them.
#include "app/export/movie.h"

#include "app/base/identity.h"
#include "app/base/output.h"
#include "app/export/movie_encoder.h"
#include "app/export/movie_remark.h"

#include <glib.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

enum { ROW = 3 }; // pictures in flight

// A format's largest rate, and whether a cancelled film is kept.
static const struct {
  int fps_max;
  bool keeps_partial;
} traits[SB_MOVIE_FORMATS] = {
    [SB_MOVIE_MP4] = {1000, true},
    [SB_MOVIE_WEBP] = {1000, false},
    [SB_MOVIE_APNG] = {1000, false},
    // Delays are multiples of 10 ms, and browsers slow down those below 20 ms.
    [SB_MOVIE_GIF] = {50, false},
};

typedef struct {
  SbMovieEncoder *encoder;
  size_t stride;
  uint8_t *picture[ROW];
  pthread_mutex_t lock;
  pthread_cond_t changed;
  size_t drawn, encoded; // counts; drawn - encoded <= ROW
  bool last;             // no more will be drawn
  SbStatus status;       // of the encoder
  SbReport report;
  double convert_s, encode_s;
} Pipe;

static double seconds(void) {
  return 1e-6 * (double)g_get_monotonic_time();
}

static void *encode(void *data) {
  Pipe *line = data;
  for (;;) {
    pthread_mutex_lock(&line->lock);
    while (line->drawn == line->encoded && !line->last) {
      pthread_cond_wait(&line->changed, &line->lock);
    }
    bool end = line->drawn == line->encoded;
    size_t index = line->encoded;
    pthread_mutex_unlock(&line->lock);
    if (end) {
      return NULL;
    }
    SbReport report = {0};
    double convert_s = 0, encode_s = 0;
    SbStatus status = sb_movie_encoder_add(line->encoder, line->picture[index % ROW], line->stride,
                                           &convert_s, &encode_s, &report);
    pthread_mutex_lock(&line->lock);
    line->convert_s += convert_s;
    line->encode_s += encode_s;
    line->encoded++;
    if (status != SB_OK) {
      line->status = status;
      line->report = report;
    }
    pthread_cond_broadcast(&line->changed);
    pthread_mutex_unlock(&line->lock);
    if (status != SB_OK) {
      return NULL;
    }
  }
}

// Draws all pictures. Returns the status of drawing; SB_ERROR_CANCELLED if the hooks said so.
static SbStatus draw_all(Pipe *line, size_t frames, SbMovieDraw draw, void *draw_data,
                         const SbMovieHooks *hooks, SbMovieResult *result, SbReport *report) {
  for (size_t i = 0; i < frames; i++) {
    if (hooks != NULL && hooks->cancelled != NULL && hooks->cancelled(hooks->data)) {
      return sb_fail(report, SB_ERROR_CANCELLED, "cancelled after %zu of %zu pictures", i, frames);
    }
    pthread_mutex_lock(&line->lock);
    while (line->drawn - line->encoded == ROW && line->status == SB_OK) {
      pthread_cond_wait(&line->changed, &line->lock);
    }
    bool good = line->status == SB_OK;
    pthread_mutex_unlock(&line->lock);
    if (!good) {
      return SB_OK; // the encoder's own failure is reported by the caller
    }
    double begin = seconds();
    SbStatus status = draw(draw_data, i, line->picture[i % ROW], line->stride, report);
    result->draw_s += seconds() - begin;
    if (status != SB_OK) {
      return status;
    }
    pthread_mutex_lock(&line->lock);
    line->drawn++;
    pthread_cond_broadcast(&line->changed);
    pthread_mutex_unlock(&line->lock);
    if (hooks != NULL && hooks->progress != NULL) {
      hooks->progress(hooks->data, i + 1, frames);
    }
  }
  return SB_OK;
}

// Draws and encodes; the file is complete or the status says why not.
static SbStatus run_pipe(Pipe *line, const SbMovieOptions *options, SbMovieDraw draw,
                         void *draw_data, const SbMovieHooks *hooks, SbMovieResult *result,
                         SbReport *report) {
  pthread_t thread;
  if (pthread_create(&thread, NULL, encode, line) != 0) {
    return sb_fail(report, SB_ERROR_MEMORY, "no thread for the encoder");
  }
  SbStatus status = draw_all(line, options->frames, draw, draw_data, hooks, result, report);
  pthread_mutex_lock(&line->lock);
  line->last = true;
  pthread_cond_broadcast(&line->changed);
  pthread_mutex_unlock(&line->lock);
  pthread_join(thread, NULL);
  result->convert_s = line->convert_s;
  result->encode_s = line->encode_s;
  result->frames = line->encoded;
  if (line->status != SB_OK) {
    if (report != NULL) {
      *report = line->report;
    }
    return line->status;
  }
  const bool keeps = status == SB_ERROR_CANCELLED && traits[options->format].keeps_partial;
  if (status != SB_OK && !(keeps && result->frames > 0)) {
    return status;
  }
  // A cancelled film is finished too, and says that it is partial.
  result->partial = status == SB_ERROR_CANCELLED;
  char *comment = NULL;
  const char *given = options->comment != NULL ? options->comment : "";
  if (result->partial) {
    comment = g_strdup_printf("partial: %zu of %zu frames%s%s", result->frames, options->frames,
                              given[0] != '\0' ? "; " : "", given);
  } else if (given[0] != '\0') {
    comment = g_strdup(given);
  }
  SbReport finish = {0};
  double begin = seconds();
  SbStatus finished = sb_movie_encoder_finish(line->encoder, comment, &finish);
  result->encode_s += seconds() - begin;
  g_free(comment);
  if (finished != SB_OK) {
    if (report != NULL) {
      *report = finish;
    }
    return finished;
  }
  return status;
}

int sb_movie_fps_max(SbMovieFormat format) {
  return traits[format].fps_max;
}

static SbStatus check_options(const SbMovieOptions *options, SbReport *report) {
  int least = MIN(options->width, options->height), most = MAX(options->width, options->height);
  if (least < SB_MOVIE_SIZE_MIN || most > SB_MOVIE_SIZE_MAX) {
    return sb_fail(report, SB_ERROR_RANGE, "a movie of %d x %d pixels: sides run from %d to %d",
                   options->width, options->height, SB_MOVIE_SIZE_MIN, SB_MOVIE_SIZE_MAX);
  }
  const int most_fps = sb_movie_fps_max(options->format);
  if (options->fps_num < 1 || options->fps_den < 1 ||
      options->fps_num > most_fps * (double)options->fps_den) {
    return sb_fail(report, SB_ERROR_RANGE, "%d/%d frames per second: 1/1000 to %d can be made",
                   options->fps_num, options->fps_den, most_fps);
  }
  if (options->frames < 1) {
    return sb_fail(report, SB_ERROR_RANGE, "a movie needs at least one frame");
  }
  return SB_OK;
}

// Moves a GError into a report.
static SbStatus take_error(GError *error, SbReport *report) {
  SbStatus status = sb_fail(report, SB_ERROR_IO, "%s", error->message);
  g_error_free(error);
  return status;
}

// The program's identity and the comment, in animations; the encoder writes those of MP4.
static SbStatus write_remark(const char *path, const SbMovieOptions *options, SbReport *report) {
  g_autofree char *identity = sb_identity_text();
  const char *comment = options->comment != NULL ? options->comment : "";
  g_autofree char *text = g_strconcat(identity, *comment != '\0' ? "; " : "", comment, NULL);
  return sb_movie_remark(path, options->format, text, report);
}

SbStatus sb_movie_write(const char *path, const SbMovieOptions *given, SbMovieDraw draw,
                        void *draw_data, const SbMovieHooks *hooks, SbMovieResult *result,
                        SbReport *report) {
  SbMovieResult own;
  result = result != NULL ? result : &own;
  *result = (SbMovieResult){0};
  double begin = seconds();
  SbMovieOptions options = *given;
  if (options.fps_num == 0 && options.fps_den == 0) {
    options.fps_num = 30;
    options.fps_den = 1;
  }
  SbStatus status = check_options(&options, report);
  if (status != SB_OK) {
    return status;
  }
  GError *error = NULL;
  SbOutput file;
  if (!sb_output_begin(&file, path, &error)) {
    return take_error(error, report);
  }
  Pipe line = {.stride = 4 * (size_t)options.width};
  status = sb_movie_encoder_open(&line.encoder, file.written_at, &options, report);
  for (int i = 0; i < ROW && status == SB_OK; i++) {
    line.picture[i] = g_try_malloc(line.stride * (size_t)options.height);
    if (line.picture[i] == NULL) {
      status = sb_fail(report, SB_ERROR_MEMORY, "no memory for pictures of %d x %d", options.width,
                       options.height);
    }
  }
  if (status == SB_OK) {
    pthread_mutex_init(&line.lock, NULL);
    pthread_cond_init(&line.changed, NULL);
    status = run_pipe(&line, &options, draw, draw_data, hooks, result, report);
    pthread_cond_destroy(&line.changed);
    pthread_mutex_destroy(&line.lock);
  }
  sb_movie_encoder_destroy(line.encoder);
  for (int i = 0; i < ROW; i++) {
    g_free(line.picture[i]);
  }
  if (status == SB_OK) {
    status = write_remark(file.written_at, &options, report);
  }
  if (status == SB_OK || result->partial) {
    if (!sb_output_commit(&file, &error)) {
      result->frames = 0;
      result->partial = false;
      status = take_error(error, report);
    }
  } else {
    result->frames = 0;
    sb_output_abort(&file);
  }
  result->wall_s = seconds() - begin;
  return status == SB_OK ? sb_succeed(report) : status;
}

size_t sb_movie_frames(double duration, int fps_num, int fps_den) {
  double frames = round(duration * fps_num / fps_den);
  return frames < 1 ? 1 : frames > 1e9 ? (size_t)1e9 : (size_t)frames;
}

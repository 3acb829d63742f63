// libavcodec and libavformat. pts is the picture's index in units of 1/fps. MP4: the index (moov)
// is moved to the file's front; colours are tagged BT.709, limited range, chroma at the block's
// centre. Every write is checked, the last ones too: a full disk shows first in either.
#include "app/export/movie_encoder.h"

#include "app/base/identity.h"
#include "app/export/colour.h"
#include "app/export/quantise.h"
#include "app/lazy/lazy.h"

#include <errno.h>
#include <glib.h>
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <string.h>

static char *no_movie(const char *why) {
  return g_strdup_printf("%s: write frames/%%04d.png, a sequence of pictures", why);
}

// Returns NULL, or why libav cannot be opened.
static void *find_problem(void *unused) {
  const char *problem = sb_lazy_missing(&sb_lazy_video);
  return problem != NULL ? no_movie(problem) : NULL;
}

// How a format is written; strings are static. Options are pairs of key and value.
typedef struct {
  const char *muxer, *encoder;
  enum AVPixelFormat pixels;
  int even; // sides are multiples of this many pixels
  const char *codec_option[3][2], *muxer_option[1][2];
  void (*convert)(SbMovieEncoder *encoder, const uint8_t *pixels, size_t stride);
} Format;

struct SbMovieEncoder {
  const Format *how;
  SbQuantiser *quantiser; // of GIF
  AVFormatContext *format;
  AVCodecContext *codec;
  AVStream *stream;
  AVFrame *frame;
  AVPacket *packet;
  int width, height;
  int64_t next;
  bool header;
};

static SbStatus fail_encoder(SbReport *report, const char *what, int code) {
  if (code == AVERROR(ENOSPC) || code == AVERROR(EDQUOT)) {
    return sb_fail(report, SB_ERROR_IO, "the disk is full");
  }
  char text[AV_ERROR_MAX_STRING_SIZE] = "";
  av_strerror(code, text, sizeof text);
  return sb_fail(report, SB_ERROR_IO, "%s: %s", what, text);
}

// An error that the buffered output met since.
static SbStatus check_output(SbMovieEncoder *encoder, SbReport *report) {
  int code = encoder->format->pb->error;
  return code < 0 ? fail_encoder(report, "writing the movie", code) : SB_OK;
}

// ---- Pixels: cairo's ARGB32 to the encoder's picture ----

static void convert_yuv(SbMovieEncoder *encoder, const uint8_t *pixels, size_t stride) {
  sb_colour_to_yuv420(encoder->frame->data, encoder->frame->linesize, pixels, stride,
                      encoder->width, encoder->height);
}

// AV_PIX_FMT_RGB32 has the same bytes.
static void convert_argb(SbMovieEncoder *encoder, const uint8_t *pixels, size_t stride) {
  for (int y = 0; y < encoder->height; y++) {
    memcpy(encoder->frame->data[0] + (ptrdiff_t)y * encoder->frame->linesize[0],
           pixels + (size_t)y * stride, 4 * (size_t)encoder->width);
  }
}

static void convert_rgb(SbMovieEncoder *encoder, const uint8_t *pixels, size_t stride) {
  for (int y = 0; y < encoder->height; y++) {
    const uint32_t *row = (const uint32_t *)(const void *)(pixels + (size_t)y * stride);
    uint8_t *to = encoder->frame->data[0] + (ptrdiff_t)y * encoder->frame->linesize[0];
    for (int x = 0; x < encoder->width; x++) {
      to[3 * x] = (uint8_t)(row[x] >> 16);
      to[3 * x + 1] = (uint8_t)(row[x] >> 8);
      to[3 * x + 2] = (uint8_t)row[x];
    }
  }
}

static void convert_palette(SbMovieEncoder *encoder, const uint8_t *pixels, size_t stride) {
  AVFrame *frame = encoder->frame;
  const uint32_t *entry = sb_quantise(encoder->quantiser, frame->data[0], frame->linesize[0],
                                      pixels, stride, encoder->width, encoder->height);
  memcpy(frame->data[1], entry, AVPALETTE_SIZE);
}

// ---- Formats ----

// MP4: the encoder holds few pictures, since for drawings like ours neither more lookahead nor
// pictures between others make the file smaller, and one thread keeps up with the drawing.
// clang-format off
static const Format encoder_formats[SB_MOVIE_FORMATS] = {
    [SB_MOVIE_MP4] = {"mp4", "libx264", AV_PIX_FMT_YUV420P, 2,
                      {{"x264-params", "rc-lookahead=1:sync-lookahead=0"},
                       {"preset", "veryfast"},
                       {"crf", "18"}},
                      {{"movflags", "+faststart"}},
                      convert_yuv},
    [SB_MOVIE_WEBP] = {"webp", "libwebp_anim", AV_PIX_FMT_RGB32, 1,
                       {{"lossless", "1"}, {"compression_level", "3"}},
                       {{"loop", "0"}},
                       convert_argb},
    [SB_MOVIE_APNG] = {"apng", "apng", AV_PIX_FMT_RGB24, 1,
                       {{"pred", "none"}}, // filters make flat drawings larger
                       {{"plays", "0"}},
                       convert_rgb},
    [SB_MOVIE_GIF] = {"gif", "gif", AV_PIX_FMT_PAL8, 1,
                      {{"gifflags", "+offsetting+transdiff"}},
                      {{"loop", "0"}},
                      convert_palette},
};
// clang-format on

// Adds `count` options that have a key.
static void add_options(AVDictionary **set, const char *const (*option)[2], size_t count) {
  for (size_t i = 0; i < count && option[i][0] != NULL; i++) {
    av_dict_set(set, option[i][0], option[i][1], 0);
  }
}

static void tag_colours(AVCodecContext *codec) {
  codec->color_range = AVCOL_RANGE_MPEG;
  codec->color_primaries = AVCOL_PRI_BT709;
  codec->color_trc = AVCOL_TRC_BT709;
  codec->colorspace = AVCOL_SPC_BT709;
  codec->chroma_sample_location = AVCHROMA_LOC_CENTER;
}

static SbStatus set_up_codec(SbMovieEncoder *encoder, const SbMovieOptions *options,
                             SbReport *report) {
  const Format *how = encoder->how;
  const AVCodec *found = avcodec_find_encoder_by_name(how->encoder);
  AVCodecContext *codec = encoder->codec = avcodec_alloc_context3(found);
  if (codec == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the encoder");
  }
  codec->width = (options->width + how->even - 1) / how->even * how->even;
  codec->height = (options->height + how->even - 1) / how->even * how->even;
  codec->pix_fmt = how->pixels;
  codec->time_base = (AVRational){options->fps_den, options->fps_num};
  codec->framerate = (AVRational){options->fps_num, options->fps_den};
  codec->gop_size = MAX(1, 2 * options->fps_num / options->fps_den);
  codec->sample_aspect_ratio = (AVRational){1, 1};
  codec->thread_count = options->threads > 0 ? options->threads : 1;
  codec->max_b_frames = 0;
  if (options->format == SB_MOVIE_MP4) {
    tag_colours(codec);
  }
  if (encoder->format->oformat->flags & AVFMT_GLOBALHEADER) {
    codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  }
  if (options->bit_exact) {
    codec->flags |= AV_CODEC_FLAG_BITEXACT;
  }
  AVDictionary *set = NULL;
  add_options(&set, how->codec_option, G_N_ELEMENTS(how->codec_option));
  if (options->preset != NULL) {
    av_dict_set(&set, "preset", options->preset, 0);
  }
  if (options->quality > 0) {
    av_dict_set_int(&set, "crf", options->quality, 0);
  }
  int code = avcodec_open2(codec, found, &set);
  av_dict_free(&set);
  return code < 0 ? fail_encoder(report, "the encoder does not open", code) : SB_OK;
}

const char *sb_movie_missing(SbMovieFormat format) {
  static GOnce once = G_ONCE_INIT;
  const char *why = g_once(&once, find_problem, NULL);
  if (why != NULL || avcodec_find_encoder_by_name(encoder_formats[format].encoder) != NULL) {
    return why;
  }
  static char *missing[SB_MOVIE_FORMATS];
  if (g_once_init_enter(&missing[format])) {
    g_autofree char *no =
        g_strdup_printf("libavcodec has no encoder %s", encoder_formats[format].encoder);
    g_once_init_leave(&missing[format], no_movie(no));
  }
  return missing[format];
}

static SbStatus write_header(SbMovieEncoder *encoder, const SbMovieOptions *options,
                             SbReport *report) {
  if (options->bit_exact) {
    encoder->format->flags |= AVFMT_FLAG_BITEXACT;
  }
  if (options->title != NULL) {
    av_dict_set(&encoder->format->metadata, "title", options->title, 0);
  }
  // libavformat writes its own name as the encoder.
  g_autofree char *identity = sb_identity_text();
  av_dict_set(&encoder->format->metadata, "description", identity, 0);
  AVDictionary *set = NULL;
  add_options(&set, encoder->how->muxer_option, G_N_ELEMENTS(encoder->how->muxer_option));
  const int code = avformat_write_header(encoder->format, &set);
  av_dict_free(&set);
  encoder->header = code >= 0;
  return code < 0 ? fail_encoder(report, "the movie's header", code)
                  : check_output(encoder, report);
}

SbStatus sb_movie_encoder_open(SbMovieEncoder **out, const char *path,
                               const SbMovieOptions *options, SbReport *report) {
  *out = NULL;
  const char *missing = sb_movie_missing(options->format);
  if (missing != NULL) {
    return sb_fail(report, SB_ERROR_IO, "%s", missing);
  }
  av_log_set_level(AV_LOG_QUIET);
  SbMovieEncoder *encoder = g_new0(SbMovieEncoder, 1);
  encoder->how = &encoder_formats[options->format];
  encoder->quantiser = encoder->how->pixels == AV_PIX_FMT_PAL8 ? sb_quantiser_create() : NULL;
  encoder->width = options->width;
  encoder->height = options->height;
  g_autofree char *url = g_strdup_printf("file:%s", path);
  SbStatus status = SB_OK;
  int code = avformat_alloc_output_context2(&encoder->format, NULL, encoder->how->muxer, url);
  if (code < 0) {
    status = fail_encoder(report, "no writer of this format", code);
  } else {
    status = set_up_codec(encoder, options, report);
  }
  if (status == SB_OK) {
    encoder->stream = avformat_new_stream(encoder->format, NULL);
    encoder->frame = av_frame_alloc();
    encoder->packet = av_packet_alloc();
    if (encoder->stream == NULL || encoder->frame == NULL || encoder->packet == NULL) {
      status = sb_fail(report, SB_ERROR_MEMORY, "no memory for the movie");
    }
  }
  if (status == SB_OK) {
    encoder->stream->time_base = encoder->codec->time_base;
    encoder->stream->avg_frame_rate = encoder->codec->framerate;
    code = avcodec_parameters_from_context(encoder->stream->codecpar, encoder->codec);
    encoder->frame->format = encoder->how->pixels;
    encoder->frame->width = encoder->codec->width;
    encoder->frame->height = encoder->codec->height;
    if (code >= 0) {
      code = av_frame_get_buffer(encoder->frame, 0);
    }
    if (code >= 0) {
      code = avio_open(&encoder->format->pb, url, AVIO_FLAG_WRITE);
    }
    if (code < 0) {
      status = fail_encoder(report, "the movie does not open", code);
    }
  }
  if (status == SB_OK) {
    status = write_header(encoder, options, report);
  }
  if (status != SB_OK) {
    sb_movie_encoder_destroy(encoder);
    return status;
  }
  *out = encoder;
  return sb_succeed(report);
}

// Hands a picture (or NULL: the end) to the encoder and writes what comes out.
static SbStatus push(SbMovieEncoder *encoder, const AVFrame *frame, SbReport *report) {
  int code = avcodec_send_frame(encoder->codec, frame);
  if (code < 0) {
    return fail_encoder(report, "encoding", code);
  }
  while ((code = avcodec_receive_packet(encoder->codec, encoder->packet)) >= 0) {
    encoder->packet->stream_index = encoder->stream->index;
    encoder->packet->duration = 1;
    av_packet_rescale_ts(encoder->packet, encoder->codec->time_base, encoder->stream->time_base);
    code = av_interleaved_write_frame(encoder->format, encoder->packet);
    if (code < 0) {
      return fail_encoder(report, "writing the movie", code);
    }
  }
  if (code != AVERROR(EAGAIN) && code != AVERROR_EOF) {
    return fail_encoder(report, "encoding", code);
  }
  return check_output(encoder, report);
}

SbStatus sb_movie_encoder_add(SbMovieEncoder *encoder, const uint8_t *pixels, size_t stride,
                              double *convert_s, double *encode_s, SbReport *report) {
  int64_t begin = g_get_monotonic_time();
  int code = av_frame_make_writable(encoder->frame);
  if (code < 0) {
    return fail_encoder(report, "no memory for a picture", code);
  }
  encoder->how->convert(encoder, pixels, stride);
  encoder->frame->pts = encoder->next++;
  int64_t middle = g_get_monotonic_time();
  SbStatus status = push(encoder, encoder->frame, report);
  int64_t end = g_get_monotonic_time();
  *convert_s += 1e-6 * (double)(middle - begin);
  *encode_s += 1e-6 * (double)(end - middle);
  return status;
}

SbStatus sb_movie_encoder_finish(SbMovieEncoder *encoder, const char *comment, SbReport *report) {
  SbStatus status = push(encoder, NULL, report);
  if (status != SB_OK) {
    return status;
  }
  if (comment != NULL) {
    av_dict_set(&encoder->format->metadata, "comment", comment, 0);
  }
  int code = av_write_trailer(encoder->format);
  encoder->header = false;
  status =
      code < 0 ? fail_encoder(report, "the movie's index", code) : check_output(encoder, report);
  code = avio_closep(&encoder->format->pb);
  if (status == SB_OK && code < 0) {
    status = fail_encoder(report, "closing the movie", code);
  }
  return status;
}

void sb_movie_encoder_destroy(SbMovieEncoder *encoder) {
  if (encoder == NULL) {
    return;
  }
  sb_quantiser_destroy(encoder->quantiser);
  av_packet_free(&encoder->packet);
  av_frame_free(&encoder->frame);
  avcodec_free_context(&encoder->codec);
  if (encoder->format != NULL) {
    if (encoder->header) {
      av_write_trailer(encoder->format); // frees the pictures that some formats keep
    }
    if (encoder->format->pb != NULL) {
      avio_closep(&encoder->format->pb);
    }
    avformat_free_context(encoder->format);
  }
  g_free(encoder);
}

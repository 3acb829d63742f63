// One vertex buffer per picture, uploaded once, drawn in batches: consecutive items of the same
// program, clip and parameters share a draw call. Blending is premultiplied and in sRGB values, as
// cairo does.
#include "app/section/gl_renderer.h"

#include "app/section/gl_atlas.h"
#include "app/section/gl_shaders.h"
#include "app/section/mesh.h"

#include <glib.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

typedef enum {
  PROGRAM_FLAT,
  PROGRAM_DASH,
  PROGRAM_HATCH,
  PROGRAM_FIELD,
  PROGRAM_TEXT,
  PROGRAM_COUNT
} ProgramId;

typedef struct {
  GLuint id;
  GLint to_clip, flip, pattern, line_color, line, levels, sampler;
} Program;

typedef struct {
  ProgramId program;
  int clip;
  size_t first, count;
  const SbDrawItem *item; // parameters of dash, hatch, field
} Batch;

enum { MAPS_MAX = 8 };

struct SbGlRenderer {
  SbGlContext *context;
  const SbGlApi *gl;
  Program program[PROGRAM_COUNT];
  GLuint array, buffer;
  size_t buffer_size;
  GLuint framebuffer, color;
  int width, height, size_max;
  SbGlAtlas *atlas;
  SbMesh mesh;
  size_t batch_count, batch_capacity;
  Batch *batch;
  struct {
    const SbDrawMap *map;
    GLuint texture;
  } maps[MAPS_MAX];
};

static SbStatus compile(const SbGlApi *gl, GLuint *out, GLenum type, const char *text,
                        SbReport *report) {
  GLuint shader = gl->CreateShader(type);
  gl->ShaderSource(shader, 1, &text, NULL);
  gl->CompileShader(shader);
  GLint good = 0;
  gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    char log[160] = "";
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    gl->DeleteShader(shader);
    return sb_fail(report, SB_ERROR_IO, "a shader does not compile: %s", log);
  }
  *out = shader;
  return SB_OK;
}

static SbStatus build_program(SbGlRenderer *renderer, ProgramId id, GLuint vertex, const char *text,
                              SbReport *report) {
  const SbGlApi *gl = renderer->gl;
  GLuint fragment;
  SbStatus status = compile(gl, &fragment, GL_FRAGMENT_SHADER, text, report);
  if (status != SB_OK) {
    return status;
  }
  Program *program = &renderer->program[id];
  program->id = gl->CreateProgram();
  gl->AttachShader(program->id, vertex);
  gl->AttachShader(program->id, fragment);
  gl->LinkProgram(program->id);
  gl->DeleteShader(fragment);
  GLint good = 0;
  gl->GetProgramiv(program->id, GL_LINK_STATUS, &good);
  if (!good) {
    char log[160] = "";
    gl->GetProgramInfoLog(program->id, sizeof log, NULL, log);
    return sb_fail(report, SB_ERROR_IO, "a shader program does not link: %s", log);
  }
  program->to_clip = gl->GetUniformLocation(program->id, "to_clip");
  program->flip = gl->GetUniformLocation(program->id, "flip");
  program->pattern = gl->GetUniformLocation(program->id, "pattern");
  program->line_color = gl->GetUniformLocation(program->id, "line_colour");
  program->line = gl->GetUniformLocation(program->id, "line");
  program->levels = gl->GetUniformLocation(program->id, "levels");
  program->sampler = gl->GetUniformLocation(program->id, id == PROGRAM_TEXT ? "atlas" : "map");
  return SB_OK;
}

static SbStatus build_programs(SbGlRenderer *renderer, SbReport *report) {
  static const char *const text[PROGRAM_COUNT] = {
      [PROGRAM_FLAT] = sb_shader_flat_frag,   [PROGRAM_DASH] = sb_shader_dash_frag,
      [PROGRAM_HATCH] = sb_shader_hatch_frag, [PROGRAM_FIELD] = sb_shader_field_frag,
      [PROGRAM_TEXT] = sb_shader_text_frag,
  };
  GLuint vertex;
  SbStatus status =
      compile(renderer->gl, &vertex, GL_VERTEX_SHADER, sb_shader_section_vert, report);
  if (status != SB_OK) {
    return status;
  }
  for (int i = 0; i < PROGRAM_COUNT && status == SB_OK; i++) {
    status = build_program(renderer, (ProgramId)i, vertex, text[i], report);
  }
  renderer->gl->DeleteShader(vertex);
  return status;
}

// The vertex format of SbMeshVertex.
static void describe_vertices(SbGlRenderer *renderer) {
  const SbGlApi *gl = renderer->gl;
  gl->GenVertexArrays(1, &renderer->array);
  gl->GenBuffers(1, &renderer->buffer);
  gl->BindVertexArray(renderer->array);
  gl->BindBuffer(GL_ARRAY_BUFFER, renderer->buffer);
  const GLsizei size = sizeof(SbMeshVertex);
  gl->VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, size, NULL);
  gl->VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, size,
                          (const void *)offsetof(SbMeshVertex, color));
  gl->VertexAttribPointer(2, 4, GL_FLOAT, GL_FALSE, size,
                          (const void *)offsetof(SbMeshVertex, extra));
  for (GLuint i = 0; i < 3; i++) {
    gl->EnableVertexAttribArray(i);
  }
}

SbStatus sb_gl_renderer_create(SbGlRenderer **out, SbGlContext *context, SbReport *report) {
  *out = NULL;
  SbGlRenderer *renderer = g_new0(SbGlRenderer, 1);
  renderer->context = context;
  renderer->gl = sb_gl_context_api(context);
  const SbGlApi *gl = renderer->gl;
  sb_mesh_init(&renderer->mesh);
  SbStatus status = build_programs(renderer, report);
  if (status != SB_OK) {
    sb_gl_renderer_destroy(renderer);
    return status;
  }
  describe_vertices(renderer);
  GLint texture_max = 0, buffer_max = 0;
  gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture_max);
  gl->GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &buffer_max);
  renderer->size_max = MIN(texture_max, buffer_max);
  renderer->atlas = sb_gl_atlas_create(gl);
  *out = renderer;
  return sb_succeed(report);
}

void sb_gl_renderer_destroy(SbGlRenderer *renderer) {
  if (renderer == NULL) {
    return;
  }
  const SbGlApi *gl = renderer->gl;
  for (int i = 0; i < PROGRAM_COUNT; i++) {
    if (renderer->program[i].id != 0) {
      gl->DeleteProgram(renderer->program[i].id);
    }
  }
  for (int i = 0; i < MAPS_MAX; i++) {
    if (renderer->maps[i].texture != 0) {
      gl->DeleteTextures(1, &renderer->maps[i].texture);
    }
  }
  if (renderer->array != 0) {
    gl->DeleteVertexArrays(1, &renderer->array);
    gl->DeleteBuffers(1, &renderer->buffer);
  }
  if (renderer->framebuffer != 0) {
    gl->DeleteFramebuffers(1, &renderer->framebuffer);
    gl->DeleteRenderbuffers(1, &renderer->color);
  }
  sb_gl_atlas_destroy(renderer->atlas);
  sb_mesh_finish(&renderer->mesh);
  g_free(renderer->batch);
  g_free(renderer);
}

// Starts or continues a batch for what is about to be added to the mesh.
static Batch *begin_batch(SbGlRenderer *renderer, ProgramId program, const SbDrawItem *item) {
  Batch *last = renderer->batch_count > 0 ? &renderer->batch[renderer->batch_count - 1] : NULL;
  bool plain = program == PROGRAM_FLAT || program == PROGRAM_TEXT;
  if (last != NULL && plain && last->program == program && last->clip == item->clip) {
    return last;
  }
  if (renderer->batch_count == renderer->batch_capacity) {
    renderer->batch_capacity = MAX(2 * renderer->batch_capacity, (size_t)128);
    renderer->batch = g_realloc_n(renderer->batch, renderer->batch_capacity, sizeof(Batch));
  }
  Batch *batch = &renderer->batch[renderer->batch_count++];
  *batch = (Batch){program, item->clip, renderer->mesh.count, 0, item};
  return batch;
}

// Quads of a line of text. False if the atlas is full.
static bool add_text(SbGlRenderer *renderer, const SbDrawItem *item, const char *text,
                     double scale) {
  SbGlLine line;
  if (!sb_gl_atlas_line(renderer->atlas, text, (double)item->size * scale, item->weight, &line)) {
    return false;
  }
  double x = (double)item->x * scale;
  if (item->align == SB_MIDDLE) {
    x -= line.advance / 2;
  } else if (item->align == SB_RIGHT) {
    x -= line.advance;
  }
  if (line.width > 0) {
    sb_mesh_glyphs(&renderer->mesh, round(x) + line.left,
                   round((double)item->y * scale) - line.ascent, line.width, line.height, line.u,
                   line.v, item->color);
  }
  return true;
}

// The whole list as batches. False if the atlas is full.
static bool build(SbGlRenderer *renderer, const SbDrawList *list, double scale) {
  SbMesh *mesh = &renderer->mesh;
  mesh->count = 0;
  renderer->batch_count = 0;
  for (size_t i = 0; i < list->item_count; i++) {
    const SbDrawItem *item = &list->item[i];
    const SbPoint *points = list->point != NULL ? list->point + item->first : NULL;
    Batch *batch = NULL;
    switch (item->kind) {
    case SB_DRAW_FILL:
      batch = begin_batch(renderer, item->hatch.width > 0.0f ? PROGRAM_HATCH : PROGRAM_FLAT, item);
      sb_mesh_fill(mesh, item, points, scale);
      break;
    case SB_DRAW_STROKE:
      batch = begin_batch(renderer, item->dash == NULL ? PROGRAM_FLAT : PROGRAM_DASH, item);
      sb_mesh_stroke(mesh, item, points, scale);
      break;
    case SB_DRAW_MESH:
      batch = begin_batch(renderer, item->shaded ? PROGRAM_FLAT : PROGRAM_FIELD, item);
      sb_mesh_field(mesh, item, points, list->scalar + item->first_scalar, scale);
      break;
    case SB_DRAW_TEXT:
      batch = begin_batch(renderer, PROGRAM_TEXT, item);
      if (!add_text(renderer, item, list->text + item->first, scale)) {
        return false;
      }
      break;
    }
    if (batch != NULL) {
      batch->count = mesh->count - batch->first;
    }
  }
  return true;
}

static GLuint map_texture(SbGlRenderer *renderer, const SbDrawMap *map) {
  const SbGlApi *gl = renderer->gl;
  int slot = 0;
  while (slot < MAPS_MAX - 1 && renderer->maps[slot].map != NULL &&
         renderer->maps[slot].map != map) {
    slot++;
  }
  if (renderer->maps[slot].map != map) {
    uint8_t rgb[256 * 3];
    for (int i = 0; i < 256; i++) {
      rgb[3 * i] = (uint8_t)(255.0f * map->entry[i].r + 0.5f);
      rgb[3 * i + 1] = (uint8_t)(255.0f * map->entry[i].g + 0.5f);
      rgb[3 * i + 2] = (uint8_t)(255.0f * map->entry[i].b + 0.5f);
    }
    if (renderer->maps[slot].texture == 0) {
      gl->GenTextures(1, &renderer->maps[slot].texture);
    }
    gl->BindTexture(GL_TEXTURE_2D, renderer->maps[slot].texture);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, 256, 1, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    renderer->maps[slot].map = map;
  }
  return renderer->maps[slot].texture;
}

static void set_parameters(SbGlRenderer *renderer, const Batch *batch, const Program *program,
                           double scale) {
  const SbGlApi *gl = renderer->gl;
  const SbDrawItem *item = batch->item;
  float s = (float)scale;
  if (batch->program == PROGRAM_DASH) {
    // The shader wants four lengths: a pattern of two is repeated.
    float length[4];
    for (int i = 0; i < 4; i++) {
      length[i] = (float)(scale * item->dash->length[i % item->dash->count]);
    }
    gl->Uniform4f(program->pattern, length[0], length[1], length[2], length[3]);
  } else if (batch->program == PROGRAM_HATCH) {
    SbColor c = item->hatch.color;
    gl->Uniform4f(program->line_color, c.r * c.a, c.g * c.a, c.b * c.a, c.a);
    gl->Uniform2f(program->line, s * item->hatch.pitch, s * item->hatch.width / 2.0f);
  } else if (batch->program == PROGRAM_FIELD) {
    SbColor c = item->line_color;
    gl->Uniform1f(program->levels, item->isolines);
    gl->Uniform4f(program->line_color, c.r, c.g, c.b, c.a);
    gl->Uniform2f(program->line, 0.0f, s * item->width / 2.0f);
    gl->BindTexture(GL_TEXTURE_2D, map_texture(renderer, item->map));
  } else if (batch->program == PROGRAM_TEXT) {
    gl->BindTexture(GL_TEXTURE_2D, sb_gl_atlas_texture(renderer->atlas));
  }
}

// Clears the bound framebuffer and draws. flip: +1 rows top down, -1 a window's.
static void draw(SbGlRenderer *renderer, const SbDrawList *list, int width, int height,
                 double scale, float flip) {
  const SbGlApi *gl = renderer->gl;
  for (int attempt = 0; !build(renderer, list, scale) && attempt < 4; attempt++) {
    sb_gl_atlas_clear(renderer->atlas, attempt > 0);
  }
  gl->BindVertexArray(renderer->array);
  gl->BindBuffer(GL_ARRAY_BUFFER, renderer->buffer);
  size_t bytes = renderer->mesh.count * sizeof(SbMeshVertex);
  if (bytes > renderer->buffer_size) {
    renderer->buffer_size = 2 * bytes;
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)renderer->buffer_size, NULL, GL_STREAM_DRAW);
  }
  gl->BufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)bytes, renderer->mesh.vertex);

  gl->Viewport(0, 0, width, height);
  gl->Disable(GL_DEPTH_TEST);
  gl->Disable(GL_CULL_FACE);
  gl->Disable(GL_SCISSOR_TEST);
  SbColor ground = list->background;
  gl->ClearColor(ground.r, ground.g, ground.b, 1.0f);
  gl->Clear(GL_COLOR_BUFFER_BIT);
  gl->Enable(GL_BLEND);
  gl->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl->Enable(GL_SCISSOR_TEST);
  gl->ActiveTexture(GL_TEXTURE0);
  for (int i = 0; i < PROGRAM_COUNT; i++) {
    const Program *program = &renderer->program[i];
    gl->UseProgram(program->id);
    gl->Uniform2f(program->to_clip, 2.0f / (float)width, 2.0f / (float)height);
    gl->Uniform1f(program->flip, flip);
    if (program->sampler >= 0) {
      gl->Uniform1i(program->sampler, 0);
    }
  }
  ProgramId current = PROGRAM_COUNT;
  for (size_t i = 0; i < renderer->batch_count; i++) {
    const Batch *batch = &renderer->batch[i];
    if (batch->count == 0) {
      continue;
    }
    const Program *program = &renderer->program[batch->program];
    if (batch->program != current) {
      gl->UseProgram(program->id);
      current = batch->program;
    }
    const SbRect *clip = &list->clip[batch->clip];
    int x0 = (int)lround((double)clip->x * scale);
    int y0 = (int)lround((double)clip->y * scale);
    int x1 = (int)lround((double)(clip->x + clip->width) * scale);
    int y1 = (int)lround((double)(clip->y + clip->height) * scale);
    int low = flip > 0.0f ? y0 : height - y1;
    gl->Scissor(x0, low, MAX(x1 - x0, 0), MAX(y1 - y0, 0));
    set_parameters(renderer, batch, program, scale);
    gl->DrawArrays(GL_TRIANGLES, (GLint)batch->first, (GLsizei)batch->count);
  }
  gl->Disable(GL_SCISSOR_TEST);
}

// The own framebuffer in the size wanted.
static SbStatus prepare_framebuffer(SbGlRenderer *renderer, int width, int height,
                                    SbReport *report) {
  const SbGlApi *gl = renderer->gl;
  if (width < 1 || height < 1 || width > renderer->size_max || height > renderer->size_max) {
    return sb_fail(report, SB_ERROR_RANGE, "%d x %d pixels: %s draws 1 to %d a side", width, height,
                   sb_gl_context_name(renderer->context), renderer->size_max);
  }
  if (renderer->framebuffer == 0) {
    gl->GenFramebuffers(1, &renderer->framebuffer);
    gl->GenRenderbuffers(1, &renderer->color);
  }
  gl->BindFramebuffer(GL_FRAMEBUFFER, renderer->framebuffer);
  if (renderer->width == width && renderer->height == height) {
    return SB_OK;
  }
  gl->BindRenderbuffer(GL_RENDERBUFFER, renderer->color);
  gl->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              renderer->color);
  if (gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    renderer->width = renderer->height = 0;
    return sb_fail(report, SB_ERROR_MEMORY, "no framebuffer of %d x %d pixels", width, height);
  }
  renderer->width = width;
  renderer->height = height;
  return SB_OK;
}

SbStatus sb_gl_renderer_draw(SbGlRenderer *renderer, const SbDrawList *list, int width, int height,
                             double scale, SbReport *report) {
  SbStatus status = prepare_framebuffer(renderer, width, height, report);
  if (status != SB_OK) {
    return status;
  }
  draw(renderer, list, width, height, scale, 1.0f);
  return sb_succeed(report);
}

void sb_gl_renderer_read(SbGlRenderer *renderer, uint8_t *pixels, size_t stride) {
  const SbGlApi *gl = renderer->gl;
  gl->BindFramebuffer(GL_FRAMEBUFFER, renderer->framebuffer);
  gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl->PixelStorei(GL_PACK_ROW_LENGTH, (GLint)(stride / 4));
  gl->ReadPixels(0, 0, renderer->width, renderer->height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                 pixels);
  gl->PixelStorei(GL_PACK_ROW_LENGTH, 0);
}

void sb_gl_renderer_draw_bound(SbGlRenderer *renderer, const SbDrawList *list, int width,
                               int height, double scale) {
  draw(renderer, list, width, height, scale, -1.0f);
}

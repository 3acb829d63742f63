// Choice of a back end and loading of its functions.
#include "app/section/gl_private.h"

#include <glib.h>
#include <string.h>

struct SbGlContext {
  const SbGlBackendTable *table; // NULL: wrapped
  void *state;
  SbGlApi api;
  char name[64];
  char reason[SB_TEXT];
};

int sb_gl_backend_find(const char *name) {
  if (strcmp(name, "osmesa") == 0) {
    return SB_GL_OSMESA;
  }
  return strcmp(name, "egl") == 0 ? SB_GL_EGL : -1;
}

// The functions are there and the version is at least 3.3.
static SbStatus load(SbGlContext *context, SbGlGetProc get_proc, void *data, SbReport *report) {
  const char *missing;
  if (!sb_gl_api_load(&context->api, get_proc, data, &missing)) {
    return sb_fail(report, SB_ERROR_IO, "%s has no %s", context->name, missing);
  }
  GLint major = 0, minor = 0;
  context->api.GetIntegerv(GL_MAJOR_VERSION, &major);
  context->api.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (10 * major + minor < 33) {
    return sb_fail(report, SB_ERROR_IO, "%s offers OpenGL %d.%d, 3.3 is needed", context->name,
                   major, minor);
  }
  return sb_succeed(report);
}

static SbStatus create(SbGlContext **out, const SbGlBackendTable *table, const char *why,
                       SbReport *report) {
  SbGlContext *context = g_new0(SbGlContext, 1);
  context->table = table;
  g_strlcpy(context->name, table->name, sizeof context->name);
  SbStatus status = table->open(&context->state, report);
  if (status == SB_OK) {
    status = load(context, table->get_proc, context->state, report);
  }
  if (status != SB_OK) {
    sb_gl_context_destroy(context);
    return status;
  }
  const char *renderer = (const char *)context->api.GetString(GL_RENDERER);
  sb_text(context->reason, sizeof context->reason, "%s (%s): %s", table->name,
          renderer != NULL ? renderer : "unknown renderer", why);
  *out = context;
  return SB_OK;
}

SbStatus sb_gl_context_create(SbGlContext **out, SbGlBackend backend, SbReport *report) {
  *out = NULL;
  if (backend == SB_GL_OSMESA) {
    return create(out, &sb_gl_osmesa_table, "as requested", report);
  }
  if (backend == SB_GL_EGL) {
    return create(out, &sb_gl_egl_table, "as requested", report);
  }
  SbReport first = {0}, second = {0};
  if (create(out, &sb_gl_osmesa_table, "it works without display or driver", &first) == SB_OK) {
    return sb_succeed(report);
  }
  char why[SB_TEXT];
  sb_text(why, sizeof why, "no OSMesa (%s)", first.text);
  if (create(out, &sb_gl_egl_table, why, &second) == SB_OK) {
    return sb_succeed(report);
  }
  return sb_fail(report, SB_ERROR_IO, "no OpenGL: %s; %s", first.text, second.text);
}

SbStatus sb_gl_context_wrap(SbGlContext **out, SbGlGetProc get_proc, void *data,
                            const char *description, SbReport *report) {
  *out = NULL;
  SbGlContext *context = g_new0(SbGlContext, 1);
  g_strlcpy(context->name, description, sizeof context->name);
  SbStatus status = load(context, get_proc, data, report);
  if (status != SB_OK) {
    sb_gl_context_destroy(context);
    return status;
  }
  const char *renderer = (const char *)context->api.GetString(GL_RENDERER);
  sb_text(context->reason, sizeof context->reason, "%s (%s): the caller's context", description,
          renderer != NULL ? renderer : "unknown renderer");
  *out = context;
  return SB_OK;
}

void sb_gl_context_destroy(SbGlContext *context) {
  if (context == NULL) {
    return;
  }
  if (context->table != NULL && context->state != NULL) {
    context->table->close(context->state);
  }
  g_free(context);
}

bool sb_gl_context_make_current(SbGlContext *context) {
  return context->table == NULL || context->table->make_current(context->state);
}

void sb_gl_context_release(SbGlContext *context) {
  if (context->table != NULL) {
    context->table->release(context->state);
  }
}

const SbGlApi *sb_gl_context_api(const SbGlContext *context) {
  return &context->api;
}

const char *sb_gl_context_name(const SbGlContext *context) {
  return context->name;
}

const char *sb_gl_context_reason(const SbGlContext *context) {
  return context->reason;
}

// An OpenGL 3.3 core context without a window (OSMesa, or EGL surfaceless), or the context that the
// caller has made current (GtkGLArea).
//
// A context is used only in the thread that created it. The libraries are opened at run time;
// OSMesa with RTLD_LOCAL, so that its GL symbols do not conflict with those of a window's GL. The
// program links neither.
#pragma once

#include "app/section/gl_api.h"
#include "engine/base/status.h"

// Library that provides a context; SB_GL_AUTO: the first that works.
typedef enum { SB_GL_AUTO, SB_GL_OSMESA, SB_GL_EGL } SbGlBackend;

typedef struct SbGlContext SbGlContext;

// Returns the SbGlBackend with the name "osmesa" or "egl"; -1: another name.
int sb_gl_backend_find(const char *name);

// Creates a context and makes it current in this thread. SB_GL_AUTO tries OSMesa before EGL (both
// draw the same picture, and OSMesa needs no driver). Returns SB_ERROR_IO with the reasons if none
// works. Freed by sb_gl_context_destroy().
SbStatus sb_gl_context_create(SbGlContext **out, SbGlBackend backend, SbReport *report);

// Creates an object for the context that is current now; get_proc(data, name) finds its functions,
// and `description` (copied) becomes its name. Returns SB_ERROR_IO if it lacks a function of
// OpenGL 3.3.
SbStatus sb_gl_context_wrap(SbGlContext **out, SbGlGetProc get_proc, void *data,
                            const char *description, SbReport *report);

// Destroys a created context, or of a wrapped one only this object. Call it in the context's
// thread.
void sb_gl_context_destroy(SbGlContext *context);

// Makes a created context current in its thread; returns whether that worked. Does nothing for a
// wrapped one, whose owner makes it current, and returns true. Needed before GL functions are
// called if sb_gl_context_release() or other code changed the current context since the creation.
bool sb_gl_context_make_current(SbGlContext *context);

// Leaves the thread without a current context; does nothing for a wrapped one. If a toolkit uses GL
// in the same thread, call it after sb_gl_context_create() and after each later use, because Mesa's
// libraries share the current context.
void sb_gl_context_release(SbGlContext *context);

// Returns the functions of the context, to be called while it is current.
const SbGlApi *sb_gl_context_api(const SbGlContext *context);

// Returns "osmesa", "egl", or the description of a wrapped context.
const char *sb_gl_context_name(const SbGlContext *context);

// Returns which library is used and why: "osmesa (llvmpipe ...): first that works".
const char *sb_gl_context_reason(const SbGlContext *context);

// An OpenGL 3.3 core context without a window: OSMesa or EGL surfaceless, or whatever context the
// caller (GtkGLArea) has made current, behind one table.
//
// A context belongs to the thread that made it. The libraries are opened at run time, OSMesa with
// RTLD_LOCAL so that its GL symbols do not meet those of a window's GL; the program links neither.
#pragma once

#include "app/section/gl_api.h"
#include "engine/base/status.h"

typedef enum { SB_GL_AUTO, SB_GL_OSMESA, SB_GL_EGL } SbGlBackend;

typedef struct SbGlContext SbGlContext;

// Index of "osmesa" or "egl" (SbGlBackend), -1 for another name.
int sb_gl_backend_find(const char *name);

// Makes a context and makes it current on this thread. SB_GL_AUTO takes the first that works,
// OSMesa before EGL (where both exist they draw the same picture, and OSMesa needs no driver).
// SB_ERROR_IO with the reasons if none works. *out is owned by the caller.
SbStatus sb_gl_context_create(SbGlContext **out, SbGlBackend backend, SbReport *report);

// Wraps the context that is current now. `get_proc` finds functions in it.
SbStatus sb_gl_context_wrap(SbGlContext **out, SbGlGetProc get_proc, void *data,
                            const char *description, SbReport *report);

// Ends it; a wrapped context stays with its owner. NULL is allowed. On its own thread.
void sb_gl_context_destroy(SbGlContext *context);

// Makes it current on this thread again (nothing to do for a wrapped one).
bool sb_gl_context_make_current(SbGlContext *context);

// Leaves this thread without a context (nothing to do for a wrapped one). Where a toolkit has GL of
// its own on the thread this has to follow each use: Mesa's libraries share what is current.
void sb_gl_context_release(SbGlContext *context);

// The functions; borrowed.
const SbGlApi *sb_gl_context_api(const SbGlContext *context);

// "osmesa" , "egl" or the wrapped one's description.
const char *sb_gl_context_name(const SbGlContext *context);

// One sentence on which back end was taken and why: "osmesa (llvmpipe ...), first that works".
const char *sb_gl_context_reason(const SbGlContext *context);

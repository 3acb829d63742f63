// What a library that provides GL contexts implements for gl_context.c: functions on its own state.
// All are called in the context's thread.
#pragma once

#include "app/section/gl_context.h"

typedef struct {
  const char *name; // "osmesa"; static
  // Creates a context and makes it current; *state is the implementation's own. Returns SB_ERROR_IO
  // with the reason if it does not work; *state is then not used.
  SbStatus (*open)(void **state, SbReport *report);
  void (*close)(void *state);        // destroys the context and frees `state`
  bool (*make_current)(void *state); // makes the context current; false if that failed
  void (*release)(void *state);      // leaves the thread without a context
  SbGlGetProc get_proc;              // finds a function; its `data` is `state`
} SbGlBackendTable;

extern const SbGlBackendTable sb_gl_osmesa_table; // OSMesa
extern const SbGlBackendTable sb_gl_egl_table;    // EGL without a surface

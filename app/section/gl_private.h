// What a back end is to gl_context.c: a small table of functions on its own state.
#pragma once

#include "app/section/gl_context.h"

typedef struct {
  const char *name;
  // Opens a context and makes it current; *state is the back end's own.
  SbStatus (*open)(void **state, SbReport *report);
  void (*close)(void *state);
  bool (*make_current)(void *state);
  void (*release)(void *state); // leaves the thread without a context
  SbGlGetProc get_proc;         // called with the state
} SbGlBackendTable;

extern const SbGlBackendTable sb_gl_osmesa_table;
extern const SbGlBackendTable sb_gl_egl_table;

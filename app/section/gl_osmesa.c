// OSMesa: Mesa's software renderer on memory of our own. Left out of Mesa since 25.1, hence opened
// at run time. The context draws into framebuffer objects; the buffer it insists on is a dummy.
#include "app/section/gl_private.h"

#include <dlfcn.h>
#include <glib.h>
#include <string.h>

// Of GL/osmesa.h, which cannot be included beside the core profile's header.
enum {
  OSMESA_RGBA_FORMAT = GL_RGBA,
  OSMESA_FORMAT_KEY = 0x22,
  OSMESA_DEPTH_BITS_KEY = 0x30,
  OSMESA_STENCIL_BITS_KEY = 0x31,
  OSMESA_PROFILE_KEY = 0x33,
  OSMESA_CORE = 0x34,
  OSMESA_MAJOR_KEY = 0x36,
  OSMESA_MINOR_KEY = 0x37,
  DUMMY_SIZE = 16
};

typedef void (*AnyFunction)(void);

typedef struct {
  void *library;
  void *context;
  void *(*create)(const int *attributes, void *share);
  void (*destroy)(void *context);
  GLboolean (*make_current)(void *context, void *buffer, GLenum type, GLsizei width,
                            GLsizei height);
  AnyFunction (*get_proc_address)(const char *name);
  unsigned char dummy[4 * DUMMY_SIZE * DUMMY_SIZE];
} OsMesa;

static bool find_osmesa(void *library, const char *name, void *target) {
  void *address = dlsym(library, name);
  memcpy(target, &address, sizeof address);
  return address != NULL;
}

static bool osmesa_make_current(void *data) {
  OsMesa *state = data;
  return state->make_current(state->context, state->dummy, GL_UNSIGNED_BYTE, DUMMY_SIZE,
                             DUMMY_SIZE) != GL_FALSE;
}

static void osmesa_close(void *data) {
  OsMesa *state = data;
  if (state->context != NULL) {
    state->make_current(NULL, NULL, 0, 0, 0);
    state->destroy(state->context);
  }
  // The library stays: Mesa's threads do not survive an unloading.
  g_free(state);
}

static void osmesa_release(void *data) {
  OsMesa *state = data;
  state->make_current(NULL, NULL, 0, 0, 0);
}

static void *osmesa_get_proc(void *data, const char *name) {
  OsMesa *state = data;
  AnyFunction function = state->get_proc_address(name);
  void *address;
  memcpy(&address, &function, sizeof address);
  return address;
}

static SbStatus osmesa_open(void **out, SbReport *report) {
  static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  OsMesa *state = g_new0(OsMesa, 1);
  *out = state;
  for (size_t i = 0; i < G_N_ELEMENTS(names) && state->library == NULL; i++) {
    state->library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
  }
  if (state->library == NULL) {
    return sb_fail(report, SB_ERROR_IO, "libOSMesa cannot be loaded");
  }
  if (!find_osmesa(state->library, "OSMesaCreateContextAttribs", &state->create) ||
      !find_osmesa(state->library, "OSMesaDestroyContext", &state->destroy) ||
      !find_osmesa(state->library, "OSMesaMakeCurrent", &state->make_current) ||
      !find_osmesa(state->library, "OSMesaGetProcAddress", &state->get_proc_address)) {
    return sb_fail(report, SB_ERROR_IO, "libOSMesa is too old");
  }
  const int attributes[] = {OSMESA_FORMAT_KEY,
                            OSMESA_RGBA_FORMAT,
                            OSMESA_DEPTH_BITS_KEY,
                            0,
                            OSMESA_STENCIL_BITS_KEY,
                            0,
                            OSMESA_PROFILE_KEY,
                            OSMESA_CORE,
                            OSMESA_MAJOR_KEY,
                            3,
                            OSMESA_MINOR_KEY,
                            3,
                            0};
  state->context = state->create(attributes, NULL);
  if (state->context == NULL || !osmesa_make_current(state)) {
    return sb_fail(report, SB_ERROR_IO, "OSMesa offers no OpenGL 3.3 core context");
  }
  return sb_succeed(report);
}

const SbGlBackendTable sb_gl_osmesa_table = {
    "osmesa", osmesa_open, osmesa_close, osmesa_make_current, osmesa_release, osmesa_get_proc};

// EGL without a surface (EGL_MESA_platform_surfaceless): a GPU's driver if there is one, else
// Mesa's software renderer. Opened at run time like OSMesa.
#include "app/section/gl_private.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <glib.h>
#include <string.h>

typedef void (*AnyFunction)(void);

typedef struct {
  void *library;
  EGLDisplay display;
  EGLContext context;
  EGLBoolean (*make)(EGLDisplay, EGLSurface, EGLSurface, EGLContext);
  EGLBoolean (*destroy)(EGLDisplay, EGLContext);
  EGLBoolean (*initialise)(EGLDisplay, EGLint *, EGLint *);
  EGLBoolean (*bind)(EGLenum);
  EGLBoolean (*choose)(EGLDisplay, const EGLint *, EGLConfig *, EGLint, EGLint *);
  EGLContext (*create)(EGLDisplay, EGLConfig, EGLContext, const EGLint *);
  EGLDisplay (*display_of)(EGLenum, void *, const EGLAttrib *);
  AnyFunction (*get_proc_address)(const char *name);
} Egl;

static bool find(void *library, const char *name, void *target) {
  void *address = dlsym(library, name);
  memcpy(target, &address, sizeof address);
  return address != NULL;
}

static bool egl_make_current(void *data) {
  Egl *state = data;
  return state->bind(EGL_OPENGL_API) != EGL_FALSE &&
         state->make(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->context) != EGL_FALSE;
}

static void egl_release(void *data) {
  Egl *state = data;
  state->make(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

static void egl_close(void *data) {
  Egl *state = data;
  // The display stays initialised: it is one per process and others may use it.
  if (state->context != EGL_NO_CONTEXT) {
    state->make(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    state->destroy(state->display, state->context);
  }
  g_free(state);
}

static void *egl_get_proc(void *data, const char *name) {
  Egl *state = data;
  AnyFunction function = state->get_proc_address(name);
  void *address;
  memcpy(&address, &function, sizeof address);
  return address;
}

static SbStatus egl_open(void **out, SbReport *report) {
  Egl *state = g_new0(Egl, 1);
  *out = state;
  state->library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (state->library == NULL) {
    return sb_fail(report, SB_ERROR_IO, "libEGL cannot be loaded");
  }
  if (!find(state->library, "eglMakeCurrent", &state->make) ||
      !find(state->library, "eglDestroyContext", &state->destroy) ||
      !find(state->library, "eglInitialize", &state->initialise) ||
      !find(state->library, "eglBindAPI", &state->bind) ||
      !find(state->library, "eglChooseConfig", &state->choose) ||
      !find(state->library, "eglCreateContext", &state->create) ||
      !find(state->library, "eglGetPlatformDisplay", &state->display_of) ||
      !find(state->library, "eglGetProcAddress", &state->get_proc_address)) {
    return sb_fail(report, SB_ERROR_IO, "libEGL is too old");
  }
  state->display = state->display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  EGLint major, minor;
  if (state->display == EGL_NO_DISPLAY ||
      state->initialise(state->display, &major, &minor) == EGL_FALSE) {
    return sb_fail(report, SB_ERROR_IO, "EGL has no surfaceless display");
  }
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = EGL_NO_CONFIG_KHR;
  EGLint count = 0;
  if (state->choose(state->display, wanted, &config, 1, &count) == EGL_FALSE || count == 0) {
    config = EGL_NO_CONFIG_KHR;
  }
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  if (state->bind(EGL_OPENGL_API) != EGL_FALSE) {
    state->context = state->create(state->display, config, EGL_NO_CONTEXT, attributes);
  }
  if (state->context == EGL_NO_CONTEXT || !egl_make_current(state)) {
    return sb_fail(report, SB_ERROR_IO, "EGL offers no OpenGL 3.3 core context");
  }
  return sb_succeed(report);
}

const SbGlBackendTable sb_gl_egl_table = {"egl",       egl_open,    egl_close, egl_make_current,
                                          egl_release, egl_get_proc};

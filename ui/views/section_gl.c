// A GtkGLArea around the renderer. Functions are looked up in the library that GDK's back end uses:
// GLX on X11, EGL on Wayland.
#include "ui/views/section_gl.h"

#include "app/section/gl_renderer.h"

#ifdef GDK_WINDOWING_X11
#include <gdk/gdkx.h>
#endif

#include <dlfcn.h>
#include <string.h>

typedef void (*AnyFunction)(void);

typedef struct {
  GtkWidget *area;
  const SbDrawList *list;
  void (*decided)(void *data);
  void *data;
  void *library;
  AnyFunction (*get_proc_address)(const char *name);
  SbGlContext *context;
  SbGlRenderer *renderer;
  gboolean works;
  char reason[320];
} Area;

static void *get_proc(void *data, const char *name) {
  Area *area = data;
  AnyFunction function = area->get_proc_address(name);
  void *address;
  memcpy(&address, &function, sizeof address);
  return address;
}

// Opens the library and finds its look-up function.
static gboolean open_library(Area *area) {
  const char *library = "libEGL.so.1";
  const char *function = "eglGetProcAddress";
#ifdef GDK_WINDOWING_X11
  if (GDK_IS_X11_DISPLAY(gtk_widget_get_display(area->area))) {
    library = "libGL.so.1";
    function = "glXGetProcAddress";
  }
#endif
  area->library = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void *found = area->library != NULL ? dlsym(area->library, function) : NULL;
  memcpy(&area->get_proc_address, &found, sizeof found);
  return found != NULL;
}

static gboolean is_software(const char *text) {
  return strstr(text, "llvmpipe") != NULL || strstr(text, "softpipe") != NULL ||
         strstr(text, "swrast") != NULL;
}

// Tries the window's GL and leaves the reason.
static gboolean open_gl(Area *area) {
  const char *wish = g_getenv("SEALBENCH_SECTION");
  if (g_strcmp0(wish, "picture") == 0) {
    g_strlcpy(area->reason, "SEALBENCH_SECTION asks for a picture", sizeof area->reason);
    return FALSE;
  }
  gtk_gl_area_make_current(GTK_GL_AREA(area->area));
  const GError *error = gtk_gl_area_get_error(GTK_GL_AREA(area->area));
  if (error != NULL) {
    g_snprintf(area->reason, sizeof area->reason, "the window has no GL: %.240s", error->message);
    return FALSE;
  }
  SbReport report = {0};
  if (!open_library(area) ||
      sb_gl_context_wrap(&area->context, get_proc, area, "window", &report) != SB_OK ||
      sb_gl_renderer_create(&area->renderer, area->context, &report) != SB_OK) {
    g_snprintf(area->reason, sizeof area->reason, "the window's GL does not do: %.240s",
               report.text[0] != '\0' ? report.text : "its library is missing");
    return FALSE;
  }
  const char *context = sb_gl_context_reason(area->context);
  if (is_software(context) && g_strcmp0(wish, "window") != 0) {
    g_snprintf(area->reason, sizeof area->reason, "the window's GL is software: %.240s", context);
    return FALSE;
  }
  g_strlcpy(area->reason, context, sizeof area->reason);
  return TRUE;
}

static void close_gl(Area *area) {
  if (area->context != NULL) {
    gtk_gl_area_make_current(GTK_GL_AREA(area->area));
    g_clear_pointer(&area->renderer, sb_gl_renderer_destroy);
    g_clear_pointer(&area->context, sb_gl_context_destroy);
  }
  area->works = FALSE;
}

static void on_realize(GtkWidget *widget, Area *area) {
  area->works = open_gl(area);
  if (!area->works) {
    close_gl(area);
  }
  area->decided(area->data);
}

static gboolean on_render(GtkGLArea *widget, GdkGLContext *gl, Area *area) {
  if (area->works && area->list->item_count > 0) {
    int scale = gtk_widget_get_scale_factor(area->area);
    sb_gl_renderer_draw_bound(area->renderer, area->list,
                              gtk_widget_get_allocated_width(area->area) * scale,
                              gtk_widget_get_allocated_height(area->area) * scale, scale);
  }
  return TRUE;
}

static void area_free(gpointer data) {
  Area *area = data;
  if (area->library != NULL) {
    dlclose(area->library);
  }
  g_free(area);
}

GtkWidget *sb_section_gl_new(const SbDrawList *list, void (*decided)(void *data), void *data) {
  Area *area = g_new0(Area, 1);
  area->area = gtk_gl_area_new();
  area->list = list;
  area->decided = decided;
  area->data = data;
  gtk_gl_area_set_required_version(GTK_GL_AREA(area->area), 3, 3);
  gtk_gl_area_set_auto_render(GTK_GL_AREA(area->area), FALSE);
  g_object_set_data_full(G_OBJECT(area->area), "sb-section-gl", area, area_free);
  g_signal_connect(area->area, "realize", G_CALLBACK(on_realize), area);
  g_signal_connect_swapped(area->area, "unrealize", G_CALLBACK(close_gl), area);
  g_signal_connect(area->area, "render", G_CALLBACK(on_render), area);
  return area->area;
}

static const Area *area_of(GtkWidget *widget) {
  return g_object_get_data(G_OBJECT(widget), "sb-section-gl");
}

gboolean sb_section_gl_works(GtkWidget *widget) {
  return area_of(widget)->works;
}

const char *sb_section_gl_reason(GtkWidget *widget) {
  return area_of(widget)->reason;
}

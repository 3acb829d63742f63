// A GtkGLArea around the renderer. Functions are looked up in the library that GDK's back end uses:
// GLX on X11, EGL on Wayland.
//
// GDK paints a window through GL from its first GL context on, and in software that copies the
// whole window for every small change. So the GL is tried on a window that is never shown, and
// where it is not taken the widget is no GtkGLArea.
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
  char reason[SB_TEXT];
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
  if (GDK_IS_X11_DISPLAY(gdk_display_get_default())) {
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

// Wraps the GL that is current; leaves the reason where it does not do.
static gboolean wrap_gl(Area *area, SbReport *report) {
  if (open_library(area) &&
      sb_gl_context_wrap(&area->context, get_proc, area, "window", report) == SB_OK) {
    return TRUE;
  }
  sb_text(area->reason, sizeof area->reason, "the window's GL does not do: %s",
          report->text[0] != '\0' ? report->text : "its library is missing");
  return FALSE;
}

// Whether the display's GL is worth a GtkGLArea, by a window that is never shown; leaves the reason
// where it is not.
static gboolean is_wanted(Area *area) {
  const char *wish = g_getenv("SEALBENCH_SECTION");
  if (g_strcmp0(wish, "picture") == 0) {
    g_strlcpy(area->reason, "SEALBENCH_SECTION requests a picture", sizeof area->reason);
    return FALSE;
  }
  if (g_strcmp0(wish, "window") == 0) {
    return TRUE;
  }
  // The display's GL stays what it is: one look for all windows.
  static gboolean looked, wanted;
  static char reason[sizeof area->reason];
  if (looked) {
    g_strlcpy(area->reason, reason, sizeof area->reason);
    return wanted;
  }
  looked = TRUE;
  GtkWidget *window = gtk_window_new(GTK_WINDOW_TOPLEVEL);
  gtk_widget_realize(window);
  g_autoptr(GError) error = NULL;
  GdkGLContext *gl = gdk_window_create_gl_context(gtk_widget_get_window(window), &error);
  if (gl == NULL || !gdk_gl_context_realize(gl, &error)) {
    sb_text(area->reason, sizeof area->reason, "the window has no GL: %s", error->message);
  } else {
    gdk_gl_context_make_current(gl);
    SbReport report = {0};
    if (wrap_gl(area, &report)) {
      const char *context = sb_gl_context_reason(area->context);
      wanted = !is_software(context);
      sb_text(area->reason, sizeof area->reason, "the window's GL is software: %s", context);
      g_clear_pointer(&area->context, sb_gl_context_destroy);
    }
    gdk_gl_context_clear_current();
  }
  g_clear_object(&gl);
  gtk_widget_destroy(window);
  g_strlcpy(reason, area->reason, sizeof reason);
  return wanted;
}

// Opens the widget's GL and leaves the reason.
static gboolean open_gl(Area *area) {
  gtk_gl_area_make_current(GTK_GL_AREA(area->area));
  const GError *error = gtk_gl_area_get_error(GTK_GL_AREA(area->area));
  if (error != NULL) {
    sb_text(area->reason, sizeof area->reason, "the window has no GL: %s", error->message);
    return FALSE;
  }
  SbReport report = {0};
  if (!wrap_gl(area, &report)) {
    return FALSE;
  }
  if (sb_gl_renderer_create(&area->renderer, area->context, &report) != SB_OK) {
    sb_text(area->reason, sizeof area->reason, "the window's GL does not do: %s", report.text);
    return FALSE;
  }
  g_strlcpy(area->reason, sb_gl_context_reason(area->context), sizeof area->reason);
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
  area->works = GTK_IS_GL_AREA(widget) && open_gl(area);
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
  area->list = list;
  area->decided = decided;
  area->data = data;
  if (is_wanted(area)) {
    area->area = gtk_gl_area_new();
    gtk_gl_area_set_required_version(GTK_GL_AREA(area->area), 3, 3);
    gtk_gl_area_set_auto_render(GTK_GL_AREA(area->area), FALSE);
    g_signal_connect_swapped(area->area, "unrealize", G_CALLBACK(close_gl), area);
    g_signal_connect(area->area, "render", G_CALLBACK(on_render), area);
  } else {
    area->area = gtk_drawing_area_new();
  }
  g_object_set_data_full(G_OBJECT(area->area), "sb-section-gl", area, area_free);
  g_signal_connect(area->area, "realize", G_CALLBACK(on_realize), area);
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

// The window's own GL and a context without a window draw the same section: the GtkGLArea's picture
// against OSMesa's (or EGL's) at equal size. On a display without GL the widget says so and does
// not draw.
#include "app/section/section.h"
#include "tests/app/picture.h"
#include "tests/gl_picture.h"
#include "ui/views/section_gl.h"

#include "tests/executed.h"

enum { WIDTH = 900, HEIGHT = 600 };

// The section of the default valve in the middle of its cycle.
static void fill(SbDrawList *list, bool dark) {
  SbParams params;
  sb_params_init(&params);
  SbReport report = {0};
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_VIEWS, SB_VIEW_SECTION, &report), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_FRAMES, 20, &report), ==, SB_OK);
  SbModel *model = NULL;
  g_assert_cmpint(sb_model_create(&model, &params, NULL, NULL, NULL), ==, SB_OK);
  SbRun *run = executed_run(model);
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  SbSectionLimits limits;
  sb_section_limits_of_frames(&limits, frames, count);
  SbSection *section = sb_section_create(model, &limits);
  SbSectionView view = {.width = WIDTH, .height = HEIGHT, .margin = 8, .dark = dark};
  SbSectionInstant instant = {.frame = &frames[count / 4]};
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    instant.profile[i] = sb_run_profile(run, instant.frame->seal[i].profile);
  }
  sb_section_draw(section, list, &view, &instant);
  sb_section_destroy(section);
  sb_run_destroy(run);
  sb_model_destroy(model);
}

static cairo_surface_t *headless(const SbDrawList *list) {
  SbReport report = {0};
  SbGlContext *context;
  g_assert_cmpint(sb_gl_context_create(&context, SB_GL_AUTO, &report), ==, SB_OK);
  return gl_picture(context, list, CAIRO_FORMAT_RGB24, 1);
}

static void on_decided(void *data) {
  *(gboolean *)data = TRUE;
}

// What the widget shows of a list; NULL where it does not draw.
static cairo_surface_t *windowed(const SbDrawList *list) {
  gboolean decided = FALSE;
  GtkWidget *window = gtk_window_new(GTK_WINDOW_TOPLEVEL);
  GtkWidget *area = sb_section_gl_new(list, on_decided, &decided);
  gtk_widget_set_size_request(area, WIDTH, HEIGHT);
  gtk_container_add(GTK_CONTAINER(window), area);
  gtk_widget_show_all(window);
  while (gtk_events_pending()) {
    gtk_main_iteration();
  }
  g_assert_true(decided);
  g_test_message("%s", sb_section_gl_reason(area));
  cairo_surface_t *surface = NULL;
  if (sb_section_gl_works(area)) {
    gtk_gl_area_queue_render(GTK_GL_AREA(area));
    surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
    cairo_t *cr = cairo_create(surface);
    gtk_widget_draw(area, cr);
    cairo_destroy(cr);
  }
  gtk_widget_destroy(window);
  return surface;
}

static void test_same_picture(void) {
  SbDrawList list;
  sb_draw_list_init(&list);
  for (int dark = 0; dark < 2; dark++) {
    fill(&list, dark);
    cairo_surface_t *shown = windowed(&list);
    if (g_getenv("SEALBENCH_TEST_NO_GL") != NULL) {
      g_assert_null(shown);
      continue;
    }
    if (shown == NULL) {
      g_test_skip("this display has no GL");
      break;
    }
    cairo_surface_t *expected = headless(&list);
    g_assert_cmpfloat(picture_distance(expected, shown, NULL), <=, 0.001);
    // The other theme is another picture.
    fill(&list, !dark);
    cairo_surface_t *other = headless(&list);
    g_assert_cmpfloat(picture_distance(other, shown, NULL), >, 0.001);
    cairo_surface_destroy(other);
    cairo_surface_destroy(expected);
    cairo_surface_destroy(shown);
  }
  sb_draw_list_finish(&list);
}

// Software GL is left alone unless asked for.
static void test_choice(void) {
  SbDrawList list;
  sb_draw_list_init(&list);
  fill(&list, false);
  g_setenv("SEALBENCH_SECTION", "picture", TRUE);
  g_assert_null(windowed(&list));
  g_setenv("SEALBENCH_SECTION", "window", TRUE);
  sb_draw_list_finish(&list);
}

int main(int argc, char **argv) {
  g_setenv("SEALBENCH_SECTION", "window", TRUE);
  g_test_init(&argc, &argv, NULL);
  if (!gtk_init_check(&argc, &argv)) {
    return 77;
  }
  g_test_add_func("/section-gl/same-picture", test_same_picture);
  g_test_add_func("/section-gl/choice", test_choice);
  return g_test_run();
}

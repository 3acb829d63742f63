// The GL renderer: both back ends draw the same picture, the pictures are the golden ones (light,
// dark, zoomed; each with a partner a little wrong that must be caught), and drawing on and on
// neither grows nor leaks.
#include "app/section/gl_private.h"
#include "app/section/gl_renderer.h"
#include "app/section/section.h"
#include "tests/app/picture.h"
#include "tests/gl_picture.h"

#include "tests/sanitized.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 1216, HEIGHT = 568, SAMPLES = 201 };
enum { AROUND = 40, RINGS = 5, NODES = 1 + AROUND * RINGS, TRIANGLES = AROUND * (2 * RINGS - 1) };

// An instant made by hand, so that the golden pictures depend on the drawing alone.
typedef struct {
  SbModel *model;
  SbFrame frame;
  double x[SB_SEAL_COUNT][SAMPLES], pressure[SB_SEAL_COUNT][SAMPLES];
  double film[SB_SEAL_COUNT][SAMPLES], asperities[SB_SEAL_COUNT][SAMPLES];
  SbContactProfile profile[SB_SEAL_COUNT];
  // A ring's mesh by hand: a fan of rings about the section's middle.
  double place[2 * NODES];
  float field[SB_FIELD_COUNT][NODES];
  int triangle[3 * TRIANGLES], outline[AROUND];
  SbSealShape shape;
} Scene;

static void set_seal(Scene *scene, int i, double half, double peak, double left, double right,
                     double film, double friction, double land) {
  scene->frame.seal[i] = (SbSealFrame){.land_fraction = (float)land,
                                       .pressure_left = (float)left,
                                       .pressure_right = (float)right,
                                       .contact_left = land > 0 ? -half : 0,
                                       .contact_right = land > 0 ? half : 0,
                                       .pressure_peak = peak,
                                       .film_central = film,
                                       .film_min = 0.8 * film,
                                       .friction = friction};
  for (int j = 0; j < SAMPLES; j++) {
    double x = half * (2.0 * j / (SAMPLES - 1) - 1) * 1.4;
    double t = x / half;
    scene->x[i][j] = x;
    scene->pressure[i][j] = fmax(fabs(t) < 1 ? peak * sqrt(1 - t * t) : 0, t < 0 ? left : right);
    scene->film[i][j] = film * (fabs(t) < 1 ? 1 : 1 + 4e5 * (fabs(t) - 1));
    scene->asperities[i][j] = 0.9 * scene->pressure[i][j];
  }
  scene->profile[i] = (SbContactProfile){
      SAMPLES,   scene->x[i], scene->pressure[i], scene->film[i], scene->asperities[i],
      "by hand", NULL,        "by hand"};
}

static void make_scene(Scene *scene, double displacement, double half) {
  SbParams params;
  sb_params_init(&params);
  sb_model_destroy(scene->model); // of the scene before
  g_assert_cmpint(sb_model_create(&scene->model, &params, NULL, NULL, NULL), ==, SB_OK);
  bool open = displacement > 4.1e-3;
  scene->frame = (SbFrame){.time = displacement / 3.333e-4,
                           .displacement = displacement,
                           .velocity = 3.333e-4,
                           .force = open ? 22.5 : 27.4,
                           .pressure_force = 14.5,
                           .stage = open ? SB_STAGE_C : SB_STAGE_B,
                           .chamber = open ? SB_CHAMBER_OPEN : SB_CHAMBER_AT_REST};
  set_seal(scene, SB_OUTER, half, 1.2e6, 0.55e6, 0, 0.9e-9, 8.0, 1);
  set_seal(scene, SB_INNER, 0.3e-3, 0.7e6, 0.55e6, 0.55e6, 1e-9, open ? 0 : 4.9, open ? 0 : 1);
}

// An ellipse that fills the radial space, its fields smooth in the place.
static void make_shape(Scene *scene, double half_width) {
  double half_height = sb_model_value(scene->model, SB_P_GLAND_RADIAL_SPACE) / 2;
  for (int i = 0; i < NODES; i++) {
    double r = i == 0 ? 0 : (double)((i - 1) / AROUND + 1) / RINGS;
    double angle = i == 0 ? 0 : 2 * G_PI * ((i - 1) % AROUND) / AROUND;
    double x = r * cos(angle), y = r * sin(angle);
    scene->place[2 * i] = half_width * x;
    scene->place[2 * i + 1] = half_height * (1 + y);
    scene->field[SB_FIELD_VON_MISES][i] = (float)(1e6 * (1 - r * r + 0.3 * y * y));
    scene->field[SB_FIELD_HYDROSTATIC][i] = (float)(1e6 * y * y);
    scene->field[SB_FIELD_SHEAR][i] = (float)(4e5 * x * y);
    scene->field[SB_FIELD_CONTACT][i] = (float)(r > 0.99 ? 1e6 * y * y : 0);
    scene->field[SB_FIELD_DISPLACEMENT][i] = (float)(2e-4 * r);
  }
  int n = 0;
  for (int a = 0; a < AROUND; a++) {
    int b = (a + 1) % AROUND;
    int corner[3] = {0, 1 + a, 1 + b};
    memcpy(scene->triangle + n, corner, sizeof corner);
    n += 3;
    for (int k = 1; k < RINGS; k++) {
      int in = 1 + (k - 1) * AROUND, out = in + AROUND;
      int pair[6] = {in + a, out + a, out + b, in + a, out + b, in + b};
      memcpy(scene->triangle + n, pair, sizeof pair);
      n += 6;
    }
    scene->outline[a] = 1 + (RINGS - 1) * AROUND + a;
  }
  scene->shape = (SbSealShape){.nodes = NODES,
                               .triangles = TRIANGLES,
                               .outline = AROUND,
                               .place = scene->place,
                               .triangle = scene->triangle,
                               .outline_node = scene->outline,
                               .contact_left = -0.37e-3,
                               .contact_right = 0.37e-3};
  for (int f = 0; f < SB_FIELD_COUNT; f++) {
    scene->shape.field[f] = scene->field[f];
  }
}

// What a golden picture shows.
typedef struct {
  const char *name;
  double displacement;
  bool dark;
  SbSectionZoom zoom;
  bool full, undeformed, solved, cutaway;
  SbField field;
  double turned; // of the cutaway's camera [rad]
} Golden;

static void draw_list_as(SbDrawList *list, const Scene *scene, const Golden *how);

static void draw_list(SbDrawList *list, const Scene *scene, bool dark, SbSectionZoom zoom) {
  Golden how = {.dark = dark, .zoom = zoom};
  draw_list_as(list, scene, &how);
}

static void draw_list_as(SbDrawList *list, const Scene *scene, const Golden *how) {
  SbSectionLimits limits = {.inner_contact_left = -0.3e-3,
                            .pressure_max = 1.2e6,
                            .film_max = 1e-9,
                            .contact_left = {-0.4e-3, -0.3e-3},
                            .contact_right = {0.4e-3, 0.3e-3}};
  if (how->solved) {
    sb_section_limits_add_shape(&limits, &scene->shape);
  }
  SbSection *section = sb_section_create(scene->model, &limits);
  SbSectionView view = {.width = WIDTH,
                        .height = HEIGHT,
                        .margin = 20,
                        .dark = how->dark,
                        .inset_seal = SB_OUTER,
                        .zoom = how->zoom,
                        .full = how->full,
                        .undeformed = how->undeformed,
                        .cutaway = how->cutaway,
                        .azimuth = (how->dark ? 0.6 : -0.52) + how->turned,
                        .elevation = 0.35,
                        .field = how->field};
  SbSectionInstant instant = {.frame = &scene->frame,
                              .profile = {&scene->profile[0], &scene->profile[1]}};
  if (how->solved) {
    instant.ring[SB_OUTER] = instant.ring[SB_INNER] = &scene->shape;
  }
  sb_section_draw(section, list, &view, &instant);
  sb_section_destroy(section);
}

static cairo_surface_t *render(SbGlBackend backend, const SbDrawList *list, double scale) {
  SbReport report = {0};
  SbGlContext *context;
  if (sb_gl_context_create(&context, backend, &report) != SB_OK) {
    g_test_message("%s", report.text);
    return NULL;
  }
  return gl_picture(context, list, CAIRO_FORMAT_ARGB32, scale);
}

static void test_backends(void) {
  static Scene scene;
  make_scene(&scene, 2.15e-3, 0.37e-3);
  SbDrawList list;
  sb_draw_list_init(&list);
  for (int i = 0; i < 5; i++) {
    Golden how = {.dark = i == 1 || i == 4,
                  .zoom = i == 2 ? SB_SECTION_ZOOM_OUTER : SB_SECTION_WHOLE,
                  .cutaway = i >= 3};
    draw_list_as(&list, &scene, &how);
    double scale = i == 1 || i == 4 ? 1.5 : 1;
    cairo_surface_t *osmesa = render(SB_GL_OSMESA, &list, scale);
    cairo_surface_t *egl = render(SB_GL_EGL, &list, scale);
    if (osmesa == NULL || egl == NULL) {
      g_test_skip("one of the back ends is missing");
    } else {
      g_assert_cmpfloat(picture_distance(osmesa, egl, NULL), <=, 0.001);
    }
    if (osmesa != NULL) {
      cairo_surface_destroy(osmesa);
    }
    if (egl != NULL) {
      cairo_surface_destroy(egl);
    }
  }
  sb_draw_list_finish(&list);
}

static const Golden goldens[] = {
    {.name = "section", .displacement = 2.15e-3},
    {.name = "section-dark", .displacement = 2.15e-3, .dark = true},
    {.name = "section-open-dark", .displacement = 5.5e-3, .dark = true},
    {.name = "section-zoom", .displacement = 2.15e-3, .zoom = SB_SECTION_ZOOM_OUTER},
    {.name = "section-zoom-dark",
     .displacement = 2.15e-3,
     .dark = true,
     .zoom = SB_SECTION_ZOOM_OUTER,
     .solved = true,
     .field = SB_FIELD_SHEAR},
    {.name = "section-full",
     .displacement = 2.15e-3,
     .full = true,
     .undeformed = true,
     .solved = true},
    {.name = "section-pressure",
     .displacement = 2.15e-3,
     .zoom = SB_SECTION_ZOOM_OUTER,
     .solved = true,
     .field = SB_FIELD_CONTACT},
    {.name = "section-pressure-dark",
     .displacement = 2.15e-3,
     .dark = true,
     .zoom = SB_SECTION_ZOOM_OUTER,
     .solved = true,
     .field = SB_FIELD_CONTACT},
    {.name = "section-full-dark",
     .displacement = 5.5e-3,
     .dark = true,
     .full = true,
     .solved = true},
    {.name = "cutaway", .displacement = 2.15e-3, .solved = true, .cutaway = true},
    {.name = "cutaway-dark", .displacement = 5.5e-3, .dark = true, .cutaway = true},
};

static void test_golden(void) {
  static Scene scene;
  SbDrawList list;
  sb_draw_list_init(&list);
  for (size_t i = 0; i < G_N_ELEMENTS(goldens); i++) {
    const Golden *golden = &goldens[i];
    make_scene(&scene, golden->displacement, 0.37e-3);
    make_shape(&scene, 0.86e-3);
    draw_list_as(&list, &scene, golden);
    cairo_surface_t *picture = render(SB_GL_AUTO, &list, 1);
    g_assert_nonnull(picture);
    picture_check(picture, golden->name);
    cairo_surface_destroy(picture);
    // A contact wider by a hundredth of a millimetre, and a camera half a degree beside.
    make_scene(&scene, golden->displacement, 0.375e-3);
    make_shape(&scene, 0.87e-3);
    Golden beside = *golden;
    beside.turned = 0.009;
    draw_list_as(&list, &scene, &beside);
    picture = render(SB_GL_AUTO, &list, 1);
    g_assert_true(picture_rejects(picture, golden->name));
    cairo_surface_destroy(picture);
  }
  sb_draw_list_finish(&list);
}

// A context of somebody else's, and a framebuffer of its own whose rows run upwards: the same
// picture, upside down in memory.
static void test_wrapped(void) {
  static Scene scene;
  SbReport report = {0};
  void *state = NULL;
  if (sb_gl_egl_table.open(&state, &report) != SB_OK) {
    sb_gl_egl_table.close(state);
    g_test_skip(report.text);
    return;
  }
  SbGlContext *context;
  g_assert_cmpint(sb_gl_context_wrap(&context, sb_gl_egl_table.get_proc, state, "window", &report),
                  ==, SB_OK);
  g_assert_cmpstr(sb_gl_context_name(context), ==, "window");
  SbGlRenderer *renderer;
  g_assert_cmpint(sb_gl_renderer_create(&renderer, context, &report), ==, SB_OK);
  SbDrawList list;
  sb_draw_list_init(&list);
  make_scene(&scene, 2.15e-3, 0.37e-3);
  draw_list(&list, &scene, false, SB_SECTION_WHOLE);
  const SbGlApi *gl = sb_gl_context_api(context);
  GLuint framebuffer, buffer;
  gl->GenFramebuffers(1, &framebuffer);
  gl->GenRenderbuffers(1, &buffer);
  gl->BindRenderbuffer(GL_RENDERBUFFER, buffer);
  gl->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, WIDTH, HEIGHT);
  gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer);
  sb_gl_renderer_draw_bound(renderer, &list, WIDTH, HEIGHT, 1);
  uint8_t *pixels = g_malloc((size_t)4 * WIDTH * HEIGHT);
  gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl->ReadPixels(0, 0, WIDTH, HEIGHT, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, pixels);
  cairo_surface_t *upright = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, WIDTH, HEIGHT);
  cairo_surface_flush(upright);
  for (size_t j = 0; j < HEIGHT; j++) {
    memcpy(cairo_image_surface_get_data(upright) + j * 4 * WIDTH,
           pixels + (HEIGHT - 1 - j) * 4 * WIDTH, 4 * WIDTH);
  }
  cairo_surface_mark_dirty(upright);
  g_free(pixels);
  gl->DeleteFramebuffers(1, &framebuffer);
  gl->DeleteRenderbuffers(1, &buffer);
  sb_gl_renderer_destroy(renderer);
  sb_gl_context_destroy(context);
  sb_gl_egl_table.close(state);
  cairo_surface_t *own = render(SB_GL_AUTO, &list, 1);
  g_assert_cmpfloat(picture_distance(upright, own, NULL), <=, 0.001);
  cairo_surface_destroy(own);
  cairo_surface_destroy(upright);
  sb_draw_list_finish(&list);
}

// Resident memory [kB].
static long resident(void) {
  char *text = NULL;
  long pages = 0;
  if (g_file_get_contents("/proc/self/statm", &text, NULL, NULL)) {
    long total;
    g_assert_cmpint(sscanf(text, "%ld %ld", &total, &pages), ==, 2);
    g_free(text);
  }
  return 4 * pages;
}

// Pictures with ever new texts: the atlas is emptied when full, and nothing grows.
static void test_steady(void) {
  static Scene scene;
  SbReport report = {0};
  SbGlContext *context;
  g_assert_cmpint(sb_gl_context_create(&context, SB_GL_AUTO, &report), ==, SB_OK);
  SbGlRenderer *renderer;
  g_assert_cmpint(sb_gl_renderer_create(&renderer, context, &report), ==, SB_OK);
  SbDrawList list;
  sb_draw_list_init(&list);
  make_scene(&scene, 2.15e-3, 0.37e-3);
  int rounds = g_test_slow() ? 10000 : 500;
  long before = 0;
  gint64 start = g_get_monotonic_time();
  for (int i = 0; i < rounds; i++) {
    sb_draw_list_clear(&list, 320, 180, (SbColor){1.0f, 1.0f, 1.0f, 1.0f});
    for (int j = 0; j < 20; j++) {
      char text[64];
      g_snprintf(text, sizeof text, "%d.%03d N", i, 37 * j);
      sb_draw_text(&list, 10 + 3 * j, 8 * j + 10, 12, 600, SB_LEFT,
                   (SbColor){0.0f, 0.0f, 0.0f, 1.0f}, text);
    }
    g_assert_cmpint(sb_gl_renderer_draw(renderer, &list, 320, 180, 1, &report), ==, SB_OK);
    if (i == rounds / 2) {
      before = resident();
    }
  }
  g_test_message("%.0f pictures a second",
                 rounds / (1e-6 * (double)(g_get_monotonic_time() - start)));
  // The address sanitizer holds freed memory back.
  if (!SB_SANITIZED) {
    g_assert_cmpint(resident() - before, <, 4096);
  }
  sb_draw_list_finish(&list);
  sb_gl_renderer_destroy(renderer);
  sb_gl_context_destroy(context);
}

// Sizes that cannot be are refused with a reason, and a wrong name is no back end.
static void test_refusals(void) {
  SbReport report = {0};
  SbGlContext *context;
  g_assert_cmpint(sb_gl_context_create(&context, SB_GL_AUTO, &report), ==, SB_OK);
  g_assert_cmpuint(strlen(sb_gl_context_reason(context)), >, 10);
  SbGlRenderer *renderer;
  g_assert_cmpint(sb_gl_renderer_create(&renderer, context, &report), ==, SB_OK);
  SbDrawList list;
  sb_draw_list_init(&list);
  sb_draw_list_clear(&list, 10, 10, (SbColor){0.0f, 0.0f, 0.0f, 1.0f});
  g_assert_cmpint(sb_gl_renderer_draw(renderer, &list, 1 << 20, 10, 1, &report), ==,
                  SB_ERROR_RANGE);
  g_assert_cmpint(sb_gl_renderer_draw(renderer, &list, 0, 10, 1, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpint(sb_gl_backend_find("vulkan"), ==, -1);
  sb_draw_list_finish(&list);
  sb_gl_renderer_destroy(renderer);
  sb_gl_context_destroy(context);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/renderer/backends", test_backends);
  g_test_add_func("/renderer/wrapped", test_wrapped);
  g_test_add_func("/renderer/golden", test_golden);
  g_test_add_func("/renderer/steady", test_steady);
  g_test_add_func("/renderer/refusals", test_refusals);
  return g_test_run();
}

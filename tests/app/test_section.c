// The section says what the engine says: drawn contacts, areas and walls, read from the shapes and
// from the display list, over every frame of a thesis cycle.
#include "app/section/draw_cairo.h"
#include "app/section/section.h"
#include "engine/contact/fit.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <glib.h>
#include <math.h>
#include <string.h>

typedef struct {
  SbModel *model;
  SbRun *run;
  size_t count;
  const SbFrame *frames;
  SbSection *section;
  SbDrawList list;
  SbSectionView view;
  bool ring;   // the finite-element ring as the fitment
  bool solved; // films by Reynolds' equation
} Fixture;

static void fixture_open(Fixture *f) {
  SbParams params;
  sb_params_init(&params);
  SbReport report = {0};
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_VIEWS, SB_VIEW_SECTION, &report), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_FRAMES, 150, &report), ==, SB_OK);
  if (f->ring) {
    g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FIT, SB_FIT_RING, &report), ==, SB_OK);
    // Held and rubbed so that it slides.
    g_assert_cmpint(sb_params_set(&params, SB_P_GLAND_FLOOR_FRICTION, 0.3, &report), ==, SB_OK);
    g_assert_cmpint(sb_params_set(&params, SB_P_GLAND_WALL_FRICTION, 0.1, &report), ==, SB_OK);
    g_assert_cmpint(sb_params_set(&params, SB_P_FRICTION_SHEAR_STRENGTH, 2e6, &report), ==, SB_OK);
  }
  if (f->solved) {
    g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FILM, SB_FILM_REYNOLDS, &report), ==, SB_OK);
  }
  g_assert_cmpint(sb_model_create(&f->model, &params, NULL, NULL, NULL), ==, SB_OK);
  SbPlan plan;
  sb_plan_make(&plan, f->model);
  g_assert_cmpint(sb_run_create(&f->run, f->model, &plan, &report), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(f->run, NULL, &report), ==, SB_OK);
  f->frames = sb_run_frames(f->run, &f->count);
  SbSectionLimits limits;
  sb_section_limits_of_frames(&limits, f->frames, f->count);
  f->section = sb_section_create(f->model, &limits);
  sb_draw_list_init(&f->list);
  f->view = (SbSectionView){.width = 1216, .height = 568, .margin = 20, .inset_seal = SB_OUTER};
}

static void fixture_close(Fixture *f) {
  sb_draw_list_finish(&f->list);
  sb_section_destroy(f->section);
  sb_model_destroy(f->model);
  sb_run_destroy(f->run);
}

static void draw(Fixture *f, size_t index) {
  SbSectionInstant instant = {.frame = &f->frames[index]};
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    instant.profile[i] = sb_run_profile(f->run, f->frames[index].seal[i].profile);
    instant.ring[i] = sb_run_shape(f->run, f->frames[index].seal[i].shape);
  }
  sb_section_draw(f->section, &f->list, &f->view, &instant);
}

// In the room that a window of 1024 by 700 px leaves, both halves without insets are 240 px high.
static void test_low_picture(void) {
  Fixture f = {0};
  fixture_open(&f);
  f.view = (SbSectionView){.width = 660, .height = 420, .margin = 4, .read_outs = true};
  SbSectionInstant instant = {.frame = f.frames};
  double beside = sb_section_strip_height(f.section, &f.view, &instant);
  f.view.hide_insets = true;
  f.view.full = true;
  double alone = sb_section_strip_height(f.section, &f.view, &instant);
  g_test_message("%.0f px beside insets, %.0f px alone", beside, alone);
  g_assert_cmpfloat(beside, <, 150);
  g_assert_cmpfloat(alone, >=, 240);
  fixture_close(&f);
}

// Area within 1e-6, no point beyond floor, walls or housing.
static void test_ring_invariants(void) {
  Fixture f = {0};
  fixture_open(&f);
  size_t whole = 0, partial = 0, free_rings = 0;
  for (size_t k = 0; k < f.count; k++) {
    draw(&f, k);
    const SbValveOutline *valve = sb_section_valve(f.section);
    for (int i = 0; i < SB_SEAL_COUNT; i++) {
      const SbRingShape *ring = sb_section_ring(f.section, i);
      const SbSealFrame *seal = &f.frames[k].seal[i];
      double origin = valve->origin[i] - f.frames[k].displacement;
      double area = sb_ring_shape_area(ring->x, ring->y, ring->count);
      g_assert_true(ring->area_conserved);
      g_assert_cmpfloat_with_epsilon(area, valve->section_area[i], 2e-6 * valve->section_area[i]);
      for (size_t j = 0; j < ring->count; j++) {
        double x = ring->x[j] + valve->origin[i];
        g_assert_cmpfloat(x, >=, valve->groove_left[i] - 1e-12);
        g_assert_cmpfloat(x, <=, valve->groove_right[i] + 1e-12);
        g_assert_cmpfloat(ring->y[j], >=, 0);
        g_assert_cmpfloat(ring->y[j] + valve->floor, <=,
                          sb_valve_outline_bore(valve, ring->x[j] + origin) + 1e-9);
      }
      // Points on the bore: exactly the contact where all of it is on the land.
      if (seal->land_fraction >= 1) {
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (size_t j = 0; j < ring->count; j++) {
          if (ring->y[j] >= sb_model_value(f.model, SB_P_GLAND_RADIAL_SPACE) - 1e-12) {
            least = fmin(least, ring->x[j]);
            most = fmax(most, ring->x[j]);
          }
        }
        g_assert_cmpfloat_with_epsilon(least, seal->contact_left, 1e-9);
        g_assert_cmpfloat_with_epsilon(most, seal->contact_right, 1e-9);
        whole++;
      } else if (seal->land_fraction > 0) {
        partial++;
      } else {
        g_assert_false(ring->contact);
        free_rings++;
      }
    }
  }
  g_assert_cmpuint(whole, >, 100);
  g_assert_cmpuint(free_rings, >, 20);
  g_test_message("%zu whole, %zu partial, %zu free", whole, partial, free_rings);
  fixture_close(&f);
}

// The contact bar in the list is as long as the reported contact, within a pixel.
static void test_contact_bar(void) {
  Fixture f = {0};
  fixture_open(&f);
  size_t found = 0;
  for (size_t k = 0; k < f.count; k += 7) {
    draw(&f, k);
    double scale, x0, y0;
    sb_section_transform(f.section, &scale, &x0, &y0);
    const SbValveOutline *valve = sb_section_valve(f.section);
    double bore = y0 - valve->bore * scale;
    for (size_t i = 0; i < f.list.item_count; i++) {
      const SbDrawItem *item = &f.list.item[i];
      const SbPoint *point = f.list.point + item->first;
      if (item->kind != SB_DRAW_STROKE || item->width != 4.0 || item->count != 2 ||
          fabs(point[0].y - bore) > 0.01) {
        continue;
      }
      double middle = (double)(point[0].x + point[1].x) / 2;
      int seal = fabs(middle - x0 - (valve->origin[SB_OUTER] - f.frames[k].displacement) * scale) <
                         1.5e-3 * scale
                     ? SB_OUTER
                     : SB_INNER;
      const SbSealFrame *at = &f.frames[k].seal[seal];
      if (at->land_fraction >= 1) {
        double width = (at->contact_right - at->contact_left) * scale;
        g_assert_cmpfloat_with_epsilon((double)(point[1].x - point[0].x), width, 1);
        found++;
      }
    }
  }
  g_assert_cmpuint(found, >, 20);
  fixture_close(&f);
}

static bool shows(const SbDrawList *list, const char *text) {
  for (size_t i = 0; i < list->item_count; i++) {
    if (list->item[i].kind == SB_DRAW_TEXT &&
        strstr(list->text + list->item[i].first, text) != NULL) {
      return true;
    }
  }
  return false;
}

// With the finite-element ring the drawn outline is the ring's own: it touches the bore over the
// contact that the run reports, stays inside the walls and keeps its volume of
// revolution within what the rubber's compressibility (K = 42 MPa, 1.2 MPa at most) allows.
static void test_ring_mesh(void) {
  Fixture f = {.ring = true};
  fixture_open(&f);
  draw(&f, 0);
  double scale, x0, y0;
  sb_section_transform(f.section, &scale, &x0, &y0);
  double pixel = 1 / scale;
  const double seen = 0.02 * pixel, radial_space = sb_model_value(f.model, SB_P_GLAND_RADIAL_SPACE);
  const SbValveOutline *valve = sb_section_valve(f.section);
  size_t whole = 0, partial = 0, other = 0;
  for (size_t k = 0; k < f.count; k++) {
    for (int i = 0; i < SB_SEAL_COUNT; i++) {
      const SbSealFrame *seal = &f.frames[k].seal[i];
      const SbSealShape *ring = sb_run_shape(f.run, seal->shape);
      bool on_land = seal->land_fraction >= 1.0;
      if ((on_land && k % 10 != 0) || ring == NULL) {
        continue;
      }
      double least = HUGE_VAL, most = -HUGE_VAL;
      for (size_t j = 0; j < ring->outline; j++) {
        double x = ring->place[2 * ring->outline_node[j]];
        double y = ring->place[2 * ring->outline_node[j] + 1];
        g_assert_cmpfloat(fabs(x), <=,
                          sb_model_value(f.model, SB_P_GLAND_AXIAL_WIDTH) / 2 + 0.1 * pixel);
        g_assert_cmpfloat(y, >=, -0.1 * pixel);
        // Nowhere in the housing, on the way over the land's edge and its chamfer neither.
        double place = x + valve->origin[i] - f.frames[k].displacement;
        g_assert_cmpfloat(y, <=, sb_valve_outline_bore(valve, place) - valve->floor + 0.02 * pixel);
        if (seal->land_fraction < 1.0 && place < 0) {
          continue; // the contact on the land is right of the edge
        }
        // What is drawn is straight from node to node: the contact ends where that leaves the bore.
        const size_t next = ring->outline_node[(j + 1) % ring->outline];
        const double gap = radial_space - y, gap_next = radial_space - ring->place[2 * next + 1];
        const bool in = gap <= seen, in_next = gap_next <= seen;
        if (in || in_next) {
          const double along = in == in_next ? 0 : (seen - gap) / (gap_next - gap);
          const double end = x + along * (ring->place[2 * next] - x);
          least = fmin(least, in ? fmin(x, end) : end);
          most = fmax(most, in ? fmax(x, end) : end);
        }
      }
      if (on_land) {
        // One ring: at rest, dragged in, dragged out.
        g_assert_cmpfloat_with_epsilon(least, seal->contact_left, pixel);
        g_assert_cmpfloat_with_epsilon(most, seal->contact_right, pixel);
        whole++;
      } else if (seal->land_fraction > 0.3 && seal->land_fraction < 1.0) {
        // The edge has taken the left of the contact, the right end stays within a pixel.
        g_assert_cmpfloat_with_epsilon(most, seal->contact_right, pixel);
        partial++;
      } else {
        other++;
      }
      double volume = 0;
      for (size_t j = 0; j < ring->triangles; j++) {
        const int *t = ring->triangle + 3 * j;
        const double *a = ring->place + 2 * t[0], *b = ring->place + 2 * t[1];
        const double *c = ring->place + 2 * t[2];
        double area = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
        volume += 2 * G_PI * (valve->floor + (a[1] + b[1] + c[1]) / 3) * area;
      }
      const SbSealModel *body = sb_model_seal(f.model, i);
      double d = body->section_diameter;
      double kept = G_PI * (body->inner_diameter + d) * G_PI / 4 * d * d;
      g_assert_cmpfloat_with_epsilon(volume, kept, 0.03 * kept);
    }
  }
  g_test_message("%zu on the land, %zu over the edge, %zu others", whole, partial, other);
  g_assert_cmpuint(partial, >, 5);
  g_assert_cmpuint(whole, >=, 2);
  g_assert_cmpuint(other, >, 10);
  fixture_close(&f);
}

// The insets' curves reach over the whole contact, however large the insets are.
static void test_inset_curves(void) {
  Fixture f = {.solved = true};
  fixture_open(&f);
  const SbSummary *summary = sb_run_summary(f.run);
  size_t k = (summary->stage[SB_STAGE_B].frame + summary->stage[SB_STAGE_C].frame) / 2;
  static const double sizes[][2] = {{1216, 568}, {700, 1200}, {1600, 2400}};
  for (size_t s = 0; s < G_N_ELEMENTS(sizes); s++) {
    f.view.width = sizes[s][0];
    f.view.height = sizes[s][1];
    draw(&f, k);
    size_t curves = 0;
    for (size_t i = 0; i < f.list.item_count; i++) {
      const SbDrawItem *item = &f.list.item[i];
      if (item->kind != SB_DRAW_STROKE || item->width != 2.4) {
        continue;
      }
      const SbPoint *point = f.list.point + item->first;
      const SbRect *inset = &f.list.clip[item->clip];
      double left = HUGE_VAL, right = -HUGE_VAL;
      for (size_t j = 0; j < item->count; j++) {
        left = fmin(left, point[j].x);
        right = fmax(right, point[j].x);
      }
      // Both show at most 1.9 widths of the widest contact, which this one is.
      double least = inset->width / 1.9;
      g_assert_cmpfloat(right - left, >, 0.99 * least);
      curves++;
    }
    g_assert_cmpuint(curves, ==, 2);
  }
  fixture_close(&f);
}

// Shapes that a user may ask for: the area stays, or the shape says that it does not.
static void test_ring_extremes(void) {
  double space = 1.36e-3, area = 1.95e-6;
  for (double half = 0.05e-3; half < 1.4e-3; half += 0.05e-3) {
    SbRingRoom room = {space, -1e-3, 1e-3, area, 1.576e-3, NULL, NULL};
    SbRingShape ring;
    sb_ring_shape_make(&ring, &room, -half, half, 1);
    for (size_t i = 0; i < ring.count; i++) {
      g_assert_true(isfinite(ring.x[i]) && fabs(ring.x[i]) <= 1e-3 + 1e-12);
      g_assert_true(ring.y[i] >= 0 && ring.y[i] <= space);
    }
    if (ring.area_conserved) {
      g_assert_cmpfloat_with_epsilon(ring.area, area, 1e-5 * area);
    } else {
      g_assert_cmpfloat(half, >, 0.5e-3);
    }
  }
  // A groove too narrow for the section cannot keep the area, and says so.
  SbRingRoom narrow = {space, -0.5e-3, 0.5e-3, area, 1.576e-3, NULL, NULL};
  SbRingShape ring;
  sb_ring_shape_make(&ring, &narrow, -0.2e-3, 0.2e-3, 1);
  g_assert_false(ring.area_conserved);
}

// Labels state the frame's numbers, and what is schematic is called so.
static void test_labels(void) {
  Fixture f = {0};
  fixture_open(&f);
  const SbSummary *summary = sb_run_summary(f.run);
  size_t c = summary->stage[SB_STAGE_C].frame, d = summary->stage[SB_STAGE_D].frame;
  draw(&f, c - 3);
  g_assert_true(shows(&f.list, "schematic"));
  g_assert_true(shows(&f.list, "drive 27.4 N"));
  g_assert_true(shows(&f.list, "inner seal leaves in"));
  g_assert_false(shows(&f.list, "no contact"));
  // A peak has the digits that its error leaves.
  SbSummary rough = *summary;
  const int peak = sb_figure_find("seals.outer.pressure_peak_Pa");
  rough.error[peak] = 0.03 * sb_figure_value(summary, peak);
  g_assert_true(shows(&f.list, "1.407"));
  SbSectionInstant instant = {.frame = &f.frames[c - 3], .summary = &rough};
  sb_section_draw(f.section, &f.list, &f.view, &instant);
  g_assert_true(shows(&f.list, "1.41") && !shows(&f.list, "1.407"));
  draw(&f, (c + d) / 2);
  g_assert_true(shows(&f.list, "Inner seal, no contact"));
  g_assert_true(shows(&f.list, "dose path open"));
  g_assert_true(shows(&f.list, "of axial"));
  fixture_close(&f);
}

// Filling the list again and again allocates nothing more.
static void test_no_growth(void) {
  Fixture f = {0};
  fixture_open(&f);
  for (size_t k = 0; k < f.count; k++) {
    draw(&f, k);
  }
  size_t items = f.list.item_capacity, points = f.list.point_capacity, text = f.list.text_capacity;
  for (int i = 0; i < 1000; i++) {
    draw(&f, (size_t)(i * 37) % f.count);
  }
  g_assert_cmpuint(f.list.item_capacity, ==, items);
  g_assert_cmpuint(f.list.point_capacity, ==, points);
  g_assert_cmpuint(f.list.text_capacity, ==, text);
  fixture_close(&f);
}

static cairo_status_t write_bytes(void *data, const unsigned char *bytes, unsigned length) {
  g_string_append_len(data, (const char *)bytes, length);
  return CAIRO_STATUS_SUCCESS;
}

// Returns how often a text is in `in`, which may hold bytes of value 0.
static size_t count(const GString *in, const char *text) {
  const size_t length = strlen(text);
  size_t found = 0;
  for (size_t i = 0; i + length <= in->len; i++) {
    found += memcmp(in->str + i, text, length) == 0;
  }
  return found;
}

// Paints a mesh of two squares (x from 0 to 20, from 40 to 60) with scalars that rise from 0 at x =
// 0 to 1 at x = 60.
static void paint_mesh(cairo_t *cr, const SbDrawMap *map) {
  SbPoint point[12];
  float scalar[12];
  for (int i = 0; i < 12; i++) {
    static const int right[6] = {0, 1, 1, 0, 1, 0}, low[6] = {0, 0, 1, 0, 1, 1};
    point[i] = (SbPoint){40.0 * (i / 6) + 20 * right[i % 6], 20 * low[i % 6]};
    scalar[i] = (float)(point[i].x / 60);
  }
  SbDrawList list;
  sb_draw_list_init(&list);
  sb_draw_list_clear(&list, 60, 20, (SbColor){1, 1, 1, 1});
  sb_draw_mesh(&list, point, scalar, 12, map, 0, 1);
  SbText *text = sb_text_create();
  sb_draw_list_to_cairo(&list, text, cr);
  sb_text_destroy(text);
  sb_draw_list_finish(&list);
}

// A field is smooth: each pixel of a linear field has the colour of its middle, to 4 levels of 255
// (a pixel is 4.25 levels wide; a triangle of one colour is up to 42 levels off). PDF has it as a
// mesh, without pixels; SVG has one picture, which covers the field alone.
static void test_smooth_field(void) {
  SbDrawMap map;
  for (int i = 0; i < 256; i++) {
    map.entry[i] = (SbColor){i / 255.0, 0, 1 - i / 255.0, 1};
  }
  cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 60, 20);
  cairo_t *cr = cairo_create(surface);
  paint_mesh(cr, &map);
  cairo_surface_flush(surface);
  const unsigned char *data = cairo_image_surface_get_data(surface);
  for (int y = 1; y < 19; y++) {
    const uint32_t *row =
        (const uint32_t *)(const void *)(data + y * cairo_image_surface_get_stride(surface));
    for (int x = 1; x < 59; x++) {
      const double red = x > 21 && x < 38 ? 255 : 255 * (x + 0.5) / 60;
      if (x < 19 || (x > 21 && x < 38) || x > 41) { // not at the squares' ends
        g_assert_cmpfloat_with_epsilon((double)(row[x] >> 16 & 255), red, 4);
      }
    }
  }
  cairo_destroy(cr);
  cairo_surface_destroy(surface);
  for (int svg = 0; svg < 2; svg++) {
    g_autoptr(GString) out = g_string_new(NULL);
    surface = svg ? cairo_svg_surface_create_for_stream(write_bytes, out, 60, 20)
                  : cairo_pdf_surface_create_for_stream(write_bytes, out, 60, 20);
    cr = cairo_create(surface);
    paint_mesh(cr, &map);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    g_assert_cmpuint(count(out, svg ? "<image" : "/ShadingType 7"), ==, 1);
    g_assert_cmpuint(count(out, svg ? "width=\"180\" height=\"60\"" : "/Subtype /Image"), ==, svg);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/section/low-picture", test_low_picture);
  g_test_add_func("/section/ring-invariants", test_ring_invariants);
  g_test_add_func("/section/contact-bar", test_contact_bar);
  if (g_test_slow()) {
    g_test_add_func("/section/ring-mesh", test_ring_mesh);
  }
  g_test_add_func("/section/inset-curves", test_inset_curves);
  g_test_add_func("/section/ring-extremes", test_ring_extremes);
  g_test_add_func("/section/labels", test_labels);
  g_test_add_func("/section/no-growth", test_no_growth);
  g_test_add_func("/section/smooth-field", test_smooth_field);
  return g_test_run();
}

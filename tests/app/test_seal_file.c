// Sections of seals from files: the outline that was drawn, wherever and whichever way round, and
// what is no section.
#include "app/document/seal_file.h"

#include "app/document/document.h"

#include "engine/valve/sealbench.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static char *folder;

static char *write_file(const char *name, const char *text) {
  char *path = g_build_filename(folder, name, NULL);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  return path;
}

static void read_text(SbSealDrawing *out, double *height, const char *text) {
  g_autofree char *path = write_file("section.txt", text);
  GError *error = NULL;
  sb_seal_file_read(out, height, path, &error);
  g_assert_no_error(error);
}

// How far two outlines lie apart at the same share of their length, in heights.
static double apart(const SbRingOutline *a, const SbRingOutline *b) {
  double most = fabs(a->area - b->area);
  for (int i = 0; i < 500; i++) {
    double x[2], y[2];
    sb_ring_outline_place(a, a->length * i / 500, x);
    sb_ring_outline_place(b, b->length * i / 500, y);
    most = fmax(most, hypot(x[0] - y[0], x[1] - y[1]));
  }
  return most;
}

static SbRingOutline drawn(const char *text, double radius) {
  SbSealProfile profile = {.kind = SB_SEAL_PROFILE_FILE};
  double height;
  read_text(&profile.drawn, &height, text);
  profile.corner_radius = radius * height;
  SbRingOutline outline;
  SbReport report = {0};
  if (sb_ring_outline_of_profile(&outline, &profile, height, &report) != SB_OK) {
    g_error("%s", report.text);
  }
  return outline;
}

// A rectangle by its corners, from any corner either way, is the named one; so is a circle by its
// arcs, and one of 200 sides to within its sides.
static void test_alike(void) {
  static const char *const rectangles[] = {"mm 0,0 1.2,0 1.2,1.6 0,1.6 0,0",
                                           "# a ring\nmm 7,-3 7,-1.4\n5.8,-1.4 5.8,-3 7,-3",
                                           "m 1e-3,0 1e-3,1.6e-3 2.2e-3,1.6e-3 2.2e-3,0 1e-3,0",
                                           "mm 0.3,0 1.2,0 1.2,1.6 0,1.6 0,0 0.3,0"};
  const SbSealProfile named = {
      .kind = SB_SEAL_PROFILE_RECTANGLE, .axial_height = 1.2, .corner_radius = 0.16};
  SbRingOutline wanted;
  g_assert_cmpint(sb_ring_outline_of_profile(&wanted, &named, 1.6, NULL), ==, SB_OK);
  for (size_t i = 0; i < G_N_ELEMENTS(rectangles); i++) {
    const SbRingOutline is = drawn(rectangles[i], 0.1);
    g_assert_cmpfloat(apart(&is, &wanted), <, 1e-12);
    g_assert_false(sb_ring_outline_has_sides(&is));
  }
  const SbSealProfile round = {0};
  g_assert_cmpint(sb_ring_outline_of_profile(&wanted, &round, 1, NULL), ==, SB_OK);
  const SbRingOutline arcs =
      drawn("mm 0,-0.8,0.414213562373095 0.8,0,0.414213562373095 0,0.8,0.414213562373095 "
            "-0.8,0,0.414213562373095 0,-0.8",
            0.1);
  g_assert_cmpfloat(apart(&arcs, &wanted), <, 1e-5); // areas are those of 256 sides an arc
  g_autoptr(GString) many = g_string_new("mm");
  for (int i = 0; i <= 200; i++) {
    g_string_append_printf(many, " %.9f,%.9f", 0.8 * cos(M_PI * (i % 200) / 100),
                           0.8 * sin(M_PI * (i % 200) / 100));
  }
  const SbRingOutline sides = drawn(many->str, 0.1);
  g_assert_cmpint(sides.count, <, 20);
  g_assert_cmpfloat(apart(&sides, &wanted), <, 1e-3);
}

// x points out of the canister: a hollow drawn at the lower x is open to its side.
static void test_sides(void) {
  const SbRingOutline open = drawn("mm 0,0 2,0 2,2 0,2 0,1.5 1,1.5 1,0.5 0,0.5 0,0", 0.05);
  double low = 0;
  g_assert_true(sb_ring_outline_has_sides(&open));
  for (int i = 0; i < 400; i++) {
    double x[2];
    sb_ring_outline_place(&open, open.length * i / 400, x);
    low += fabs(x[0]) < 0.2 && x[1] < -0.1 && x[1] > -0.4 ? 1 : 0; // nothing between the lips
  }
  g_assert_cmpfloat(low, ==, 0);
}

static void test_refused(void) {
  static const struct {
    const char *text, *said;
  } cases[] = {
      {"mm 0,0 1,0 1,1 0,1", "does not close"},
      {"mm 0,0 1,1 1,0 0,1 0,0", "cross"},
      {"mm 0,0 1,0 1,a 0,0", "point 3 is not x,r"},
      {"stone 0,0 1,0 1,1 0,0", "starts with the unit"},
      {"mm 0,0 20,0 20,1 0,1 0,0", "20 mm wide (x) and 1 mm high (r)"},
      {"mm 0,0 1,0 0,0", ""},
      {"", "is empty"},
      {"0\nSECTION\n", "dxf"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autofree char *path = write_file("bad.txt", cases[i].text);
    SbSealDrawing out;
    double height;
    GError *error = NULL;
    g_assert_false(sb_seal_file_read(&out, &height, path, &error));
    g_assert_nonnull(error);
    g_test_message("%s", error->message);
    g_assert_cmpint(out.count, ==, 0);
    g_assert_nonnull(strstr(error->message, "bad.txt"));
    if (i < 5 && strstr(error->message, cases[i].said) == NULL) {
      g_error("%s without %s", error->message, cases[i].said);
    }
    g_error_free(error);
  }
}

static void read_groove(SbGrooveDrawing *out, const char *text) {
  g_autofree char *path = write_file("groove.txt", text);
  GError *error = NULL;
  if (!sb_groove_file_read(out, path, &error)) {
    g_error("%s", error->message);
  }
}

// A groove's outline goes either way, may be closed by its opening, and lies anywhere; what is none
// is refused by name.
static void test_groove(void) {
  static const char *const same[] = {"mm -1.2,1.3 -1,0 1,0 1.1,1.3",
                                     "# a groove\nmm 6.1,4.3 6,3\n4,3 3.8,4.3",
                                     "m -1.2e-3,1.3e-3 -1e-3,0 1e-3,0 1.1e-3,1.3e-3 -1.2e-3,1.3e-3",
                                     "mm 1,0 1.1,1.3 -1.2,1.3 -1,0 1,0"};
  SbGrooveDrawing wanted;
  read_groove(&wanted, same[0]);
  g_assert_cmpfloat_with_epsilon(wanted.width, 2e-3, 1e-12);
  g_assert_cmpfloat_with_epsilon(wanted.depth, 1.3e-3, 1e-12);
  for (size_t i = 1; i < G_N_ELEMENTS(same); i++) {
    SbGrooveDrawing is;
    read_groove(&is, same[i]);
    g_assert_cmpfloat_with_epsilon(is.width, wanted.width, 1e-12);
    g_assert_cmpfloat_with_epsilon(is.depth, wanted.depth, 1e-12);
    for (int k = 0; k < 2; k++) {
      g_assert_cmpfloat_with_epsilon(is.wall[k].slope, wanted.wall[k].slope, 1e-9);
      g_assert_cmpfloat_with_epsilon(is.wall[k].offset, wanted.wall[k].offset, 1e-12);
    }
  }
  // A DXF has it closed, on a layer of that name beside a part.
  static const char layer[] = "0\nLWPOLYLINE\n8\n%s\n90\n4\n70\n1\n%s";
  g_autofree char *outline = g_strdup_printf(
      layer, "groove", "10\n-1.2\n20\n9.3\n10\n-1\n20\n8\n10\n1\n20\n8\n10\n1.1\n20\n9.3\n");
  g_autofree char *part =
      g_strdup_printf(layer, "stem", "10\n0\n20\n1\n10\n5\n20\n1\n10\n5\n20\n2\n10\n0\n20\n2\n");
  g_autofree char *dxf = g_strconcat("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\n"
                                     "SECTION\n2\nENTITIES\n",
                                     outline, part, "0\nENDSEC\n0\nEOF\n", NULL);
  g_autofree char *dxf_path = write_file("groove.dxf", dxf);
  SbGrooveDrawing of_dxf;
  g_assert_true(sb_groove_file_read(&of_dxf, dxf_path, NULL));
  g_assert_cmpfloat_with_epsilon(of_dxf.width, wanted.width, 1e-9);
  g_assert_cmpfloat_with_epsilon(of_dxf.wall[0].slope, wanted.wall[0].slope, 1e-6);
  static const char *const bad[] = {
      "mm -1,1 -1,0 1,0", "mm 0,0 1,0 1,1,0.5 0,1 0,0", "mm 0,2 0.5,3 1,2 1,0 0,0 0,2",
      "mm 0,0",           "stone 0,1 0,0 1,0 1,1",      ""};
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    g_autofree char *path = write_file("bad.txt", bad[i]);
    SbGrooveDrawing out;
    GError *error = NULL;
    g_assert_false(sb_groove_file_read(&out, path, &error));
    g_test_message("%s", error->message);
    g_assert_cmpint(out.count, ==, 0);
    g_assert_nonnull(strstr(error->message, "bad.txt"));
    g_error_free(error);
  }
}

static SbDocument *load(const char *path, guint problems) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbDocument *document = sb_document_load(path, issues);
  for (guint i = 0; i < issues->len && problems == 0; i++) {
    g_autofree char *line = sb_issue_line(issues->pdata[i]);
    g_test_message("%s", line);
  }
  g_assert_cmpuint(issues->len, ==, problems);
  return document;
}

// A valve names its section's file from where it is, a scene takes it over, a document saved
// elsewhere still finds it; other points make another model, and a height that is not the seals' is
// told.
static void test_document(void) {
  g_free(write_file("section.txt", "mm 0,0 1.2,0 1.2,2 0,2 0,0"));
  g_autofree char *valve =
      write_file("own.valve", "[sealbench]\nformat = 1\nkind = valve\n[seal]\nprofile = file\n"
                              "profile_file = section.txt\nsection_diameter = 1.61 mm\n");
  g_autofree char *scene = write_file(
      "own.scene", "[sealbench]\nformat = 1\nkind = scene\nvalve = own.valve\n[drive]\nspeed = "
                   "20 mm/min\n");
  g_autoptr(SbDocument) document = load(scene, 0);
  g_autofree char *hash = sb_document_sha256(document);
  const GPtrArray *notes = sb_document_notes(document);
  g_assert_cmpuint(notes->len, ==, 2);
  g_assert_nonnull(strstr(((const SbIssue *)notes->pdata[0])->text, "is 2 mm high"));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbModel) model = NULL;
  g_assert_true(sb_document_compile(document, &model, issues));
  g_assert_cmpint(sb_model_profile(model, SB_OUTER).drawn.count, ==, 4);

  g_autofree char *other = g_build_filename(folder, "sub", NULL);
  g_assert_cmpint(g_mkdir(other, 0755), ==, 0);
  g_autofree char *copy = g_build_filename(other, "copy.valve", NULL);
  g_autoptr(SbDocument) moved = load(valve, 0);
  g_assert_true(sb_document_save(moved, copy, NULL));
  g_autoptr(SbDocument) again = load(copy, 0);
  g_autofree char *text = sb_document_to_text(again, copy);
  g_assert_nonnull(strstr(text, "profile_file = ../section.txt"));
  g_autofree char *flat = sb_document_to_flat_text(document);
  g_autoptr(SbDocument) alone = sb_document_parse(flat, strlen(flat), "flat", NULL, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_autofree char *same = sb_document_sha256(alone);
  g_assert_cmpstr(same, ==, hash);

  g_autofree char *wider = write_file("wider.txt", "mm 0,0 1.3,0 1.3,2 0,2 0,0");
  g_autofree char *option = g_strconcat("seal.profile_file=", wider, NULL);
  g_assert_true(sb_document_set_option(document, option, issues));
  g_autofree char *differs = sb_document_sha256(document);
  g_assert_cmpstr(differs, !=, hash);
  g_assert_false(sb_document_set_option(document, "seal.profile_file=none.txt", issues));
  g_assert_cmpuint(issues->len, ==, 1);

  // One that somebody chooses is named where the document is saved next, and found from there.
  SbSealDrawing chosen;
  double height;
  g_assert_true(sb_seal_file_read(&chosen, &height, wider, NULL));
  g_autoptr(SbDocument) own = load(copy, 0);
  sb_document_set_section(own, wider, &chosen, height);
  g_autofree char *set = g_build_filename(folder, "set.valve", NULL);
  g_assert_true(sb_document_save(own, set, NULL));
  g_autofree char *saved = sb_document_to_flat_text(own);
  g_autofree char *line = g_strdup_printf("profile_file = %s\n", wider);
  g_assert_nonnull(strstr(saved, line));
  g_autoptr(SbDocument) found = load(set, 0);
  g_assert_cmpstr(sb_document_section(found), ==, wider);
  g_autofree char *like = sb_document_sha256(found);
  g_autofree char *was = sb_document_sha256(own);
  g_assert_cmpstr(like, ==, was);

  // One step back is the section before, one more choice the section after; what was chosen is to
  // be saved, what was taken back is not.
  g_assert_false(sb_document_is_modified(own));
  g_autofree char *another = g_build_filename(folder, "another.txt", NULL);
  sb_document_set_section(own, another, &chosen, height);
  g_assert_true(sb_document_is_modified(own));
  g_assert_cmpint(sb_document_undo(own), ==, SB_DOCUMENT_SECTION);
  g_assert_false(sb_document_is_modified(own));
  g_autofree char *before = sb_document_sha256(own);
  g_assert_cmpstr(before, ==, was);
  g_assert_cmpstr(sb_document_section(own), ==, wider);
  g_assert_cmpint(sb_document_redo(own), ==, SB_DOCUMENT_SECTION);
  g_assert_cmpstr(sb_document_section(own), ==, another);

  // From a named profile it is one step with the profile; saved and taken back it leaves the file.
  g_autofree char *plain_path =
      write_file("plain.valve", "[sealbench]\nformat = 1\nkind = valve\n[seal]\n");
  g_autoptr(SbDocument) plain = load(plain_path, 0);
  sb_document_set_section(plain, wider, &chosen, height);
  g_assert_cmpfloat(sb_document_value(plain, SB_P_SEAL_PROFILE), ==, SB_SEAL_PROFILE_FILE);
  g_assert_true(sb_document_save(plain, plain_path, NULL));
  g_assert_false(sb_document_is_modified(plain));
  (void)sb_document_undo(plain);
  g_assert_null(sb_document_section(plain));
  g_assert_cmpfloat(sb_document_value(plain, SB_P_SEAL_PROFILE), ==, SB_SEAL_PROFILE_CIRCLE);
  g_assert_false(sb_document_can_undo(plain));
  g_assert_true(sb_document_is_modified(plain));
  g_assert_true(sb_document_save(plain, plain_path, NULL));
  g_autoptr(SbDocument) bare_again = load(plain_path, 0);
  g_assert_null(sb_document_section(bare_again));

  // A groove likewise: its walls stand as far apart as the valve says, which is told; it refuses
  // the sizes of grooves that are not drawn.
  g_free(write_file("groove.txt", "mm -1.2,1.3 -1.1,0 1.1,0 1.2,1.3"));
  g_autofree char *grooved_path =
      write_file("grooved.valve", "[sealbench]\nformat = 1\nkind = valve\n[gland]\nprofile_file = "
                                  "groove.txt\n");
  g_autoptr(SbDocument) grooved = load(grooved_path, 0);
  g_assert_cmpuint(sb_document_notes(grooved)->len, ==, 1);
  g_assert_nonnull(
      strstr(((const SbIssue *)sb_document_notes(grooved)->pdata[0])->text, "are 2.2 mm apart"));
  g_autoptr(SbModel) with_groove = NULL;
  g_assert_true(sb_document_compile(grooved, &with_groove, issues));
  g_assert_cmpint(sb_model_groove(with_groove)->count, ==, 4);
  SbWarnings warnings = {0};
  sb_model_warn(with_groove, &warnings);
  g_assert_cmpstr(warnings.item[0].code, ==, "groove-unused");
  g_autofree char *drawn_hash = sb_document_sha256(grooved);
  sb_document_set_groove(grooved, NULL, NULL);
  g_assert_null(sb_document_groove(grooved));
  g_autofree char *flat_hash = sb_document_sha256(grooved);
  g_assert_cmpstr(flat_hash, !=, drawn_hash);
  g_assert_true(sb_document_is_modified(grooved));
  g_autofree char *without = sb_document_to_text(grooved, grooved_path);
  g_assert_null(strstr(without, "profile_file"));
  g_assert_cmpint(sb_document_undo(grooved), ==, SB_DOCUMENT_GROOVE);
  g_autofree char *undone = sb_document_sha256(grooved);
  g_assert_cmpstr(undone, ==, drawn_hash);
  g_assert_false(sb_document_is_modified(grooved));
  // Taken back after it was saved elsewhere, it is found from there.
  g_autofree char *wide_path = write_file("wide.txt", "mm -1.3,1.3 -1.2,0 1.2,0 1.3,1.3");
  SbGrooveDrawing wide;
  g_assert_true(sb_groove_file_read(&wide, wide_path, NULL));
  g_autoptr(SbDocument) away = load(grooved_path, 0);
  g_autofree char *away_path = g_build_filename(other, "away.valve", NULL);
  sb_document_set_groove(away, wide_path, &wide);
  g_assert_true(sb_document_save(away, away_path, NULL));
  g_assert_cmpint(sb_document_undo(away), ==, SB_DOCUMENT_GROOVE);
  g_assert_true(sb_document_is_modified(away));
  g_assert_true(sb_document_save(away, away_path, NULL));
  g_autoptr(SbDocument) back = load(away_path, 0);
  g_autofree char *back_hash = sb_document_sha256(back);
  g_assert_cmpstr(back_hash, ==, drawn_hash);
  // A scene cannot do without its valve's.
  g_autofree char *scene_path =
      write_file("grooved.scene", "[sealbench]\nformat = 1\nkind = scene\nvalve = grooved.valve\n");
  g_autoptr(SbDocument) of_valve = load(scene_path, 0);
  g_assert_nonnull(sb_document_groove(of_valve));
  g_assert_false(sb_document_may_drop_groove(of_valve));
  g_assert_true(sb_document_may_drop_groove(back));
  g_assert_true(sb_document_set_option(grooved, "gland.draft=5deg", issues));
  g_clear_pointer(&with_groove, sb_model_destroy);
  const guint before_draft = issues->len;
  g_assert_false(sb_document_compile(grooved, &with_groove, issues));
  const SbIssue *draft = issues->pdata[before_draft];
  g_assert_cmpstr(draft->key, ==, "gland.draft");

  // Without a file, and with one that is none.
  g_autofree char *bare =
      write_file("bare.valve", "[sealbench]\nformat = 1\nkind = valve\n[seal]\nprofile = file\n");
  sb_document_free(load(bare, 1));
  g_free(write_file("section.txt", "mm 0,0 1,0"));
  sb_document_free(load(valve, 1));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  folder = g_dir_make_tmp("seal-XXXXXX", NULL);
  g_test_add_func("/seal-file/alike", test_alike);
  g_test_add_func("/seal-file/sides", test_sides);
  g_test_add_func("/seal-file/refused", test_refused);
  g_test_add_func("/seal-file/groove", test_groove);
  g_test_add_func("/seal-file/document", test_document);
  return g_test_run();
}

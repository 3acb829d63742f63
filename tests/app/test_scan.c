// Readers of scans: what was written comes back, in every form; what is cut short, ambiguous or no
// scan is refused with the place.
#include "app/data/scan/scan.h"
#include "tests/app/choices.h"
#include "tests/app/scan_files.h"

#include "app/base/error.h"
#include "engine/numeric/sampling.h"

enum { COLUMNS = 20, ROWS = 17 };
static double height[COLUMNS * ROWS];

// Uneven in both directions, two points missing.
static SbHeights written(void) {
  for (int k = 0; k < COLUMNS * ROWS; k++) {
    height[k] = 1e-9 * round(1e3 * (sb_random(7, (guint64)k, 0) - 0.4));
  }
  height[45] = height[139] = NAN;
  return (SbHeights){COLUMNS, ROWS, COLUMNS, 0.5e-6, 2e-6, height};
}

static const SbScanChoices plain;

static void assert_same(const SbScan *scan, const SbHeights *h, double error) {
  g_assert_cmpuint(scan->heights.columns, ==, h->columns);
  g_assert_cmpuint(scan->heights.rows, ==, h->rows);
  g_assert_cmpfloat_with_epsilon(scan->heights.dx, h->dx, 1e-7 * h->dx);
  if (h->rows > 1) {
    g_assert_cmpfloat_with_epsilon(scan->heights.dy, h->dy, 1e-7 * h->dy);
  }
  for (gsize i = 0; i < h->columns * h->rows; i++) {
    if (isnan(h->z[i])) {
      g_assert_true(isnan(scan->heights.z[i]));
    } else {
      g_assert_cmpfloat_with_epsilon(scan->heights.z[i], h->z[i], error);
    }
  }
}

static void parse(SbScan *out, const GByteArray *bytes, const SbScanChoices *choices) {
  GError *error = NULL;
  if (!sb_scan_read(out, (const char *)bytes->data, bytes->len, choices, "scan", &error)) {
    g_error("%s", error->message);
  }
}

// Refused, every shorter form of it too, with one sentence that begins with the name.
static void assert_refused(const char *data, gsize length, const SbScanChoices *choices,
                           const char *why) {
  SbScan scan;
  GError *error = NULL;
  g_assert_false(sb_scan_read(&scan, data, length, choices, "scan", &error));
  g_assert_nonnull(error);
  g_assert_true(error->domain == SB_APP_ERROR && g_str_has_prefix(error->message, "scan: "));
  g_assert_true(g_utf8_validate(error->message, -1, NULL) && strchr(error->message, '\n') == NULL);
  if (strstr(error->message, why) == NULL) {
    g_error("\"%s\" does not say \"%s\"", error->message, why);
  }
  g_assert_null(scan.heights.z);
  g_error_free(error);
}

// Refused with a choice: its key and its values, one a line.
static void assert_chosen(const char *data, gsize length, const SbScanChoices *choices,
                          const char *key, const char *values) {
  SbScan scan;
  g_autoptr(GError) error = NULL;
  g_assert_false(sb_scan_read(&scan, data, length, choices, "scan", &error));
  assert_choice(sb_app_error_choice(error), error->message, key, values);
}

static void assert_cut_refused(const GByteArray *bytes) {
  for (gsize length = 4; length < bytes->len; length += 1 + length / 9) {
    // In memory of its own, so that a look beyond its end is seen.
    g_autofree char *copy = g_memdup2(bytes->data, length);
    assert_refused(copy, length, &plain, "");
  }
}

static void test_gwy(void) {
  const SbHeights h = written();
  SbScan scan;
  GByteArray *bytes = write_gwy(&h, 1);
  parse(&scan, bytes, &plain);
  assert_same(&scan, &h, 1e-30);
  g_assert_cmpstr(scan.format, ==, "Gwyddion");
  g_assert_cmpstr(scan.title, ==, "Topography 0");
  g_assert_cmpuint(scan.notes->len, ==, 1);
  sb_scan_clear(&scan);
  parse(&scan, bytes, &(SbScanChoices){.ignore_mask = TRUE});
  g_assert_cmpfloat(scan.heights.z[45], ==, 0);
  sb_scan_clear(&scan);
  assert_refused((char *)bytes->data, bytes->len, &(SbScanChoices){.channel = "9"}, "not lengths");
  assert_refused((char *)bytes->data, bytes->len, &(SbScanChoices){.channel = "4"},
                 "no channel 4 (numbers and titles: 0 \"Topography 0\", 9)");
  assert_refused((char *)bytes->data, bytes->len, &(SbScanChoices){.unit = 1}, "--unit");
  assert_chosen((char *)bytes->data, bytes->len, &(SbScanChoices){.unit = 1}, "unit", "");
  assert_chosen((char *)bytes->data, bytes->len, &(SbScanChoices){.lateral_unit = 1},
                "lateral-unit", "");
  assert_cut_refused(bytes);
  g_byte_array_unref(bytes);
  // Several channels are not chosen from.
  bytes = write_gwy(&h, 2);
  assert_refused((char *)bytes->data, bytes->len, &plain, "--channel");
  assert_chosen((char *)bytes->data, bytes->len, &plain, "channel", "0\n1");
  parse(&scan, bytes, &(SbScanChoices){.channel = "Topography 1"});
  assert_same(&scan, &h, 1e-30);
  sb_scan_clear(&scan);
  g_byte_array_unref(bytes);
}

static void test_sur(void) {
  SbHeights h = written();
  for (int bits = 16; bits <= 32; bits += 16) {
    for (int rows = 1; rows <= ROWS; rows += ROWS - 1) {
      h.rows = (size_t)rows;
      SbScan scan;
      GByteArray *bytes = write_sur(&h, bits, 1e-9);
      parse(&scan, bytes, &plain);
      assert_same(&scan, &h, 1e-15);
      g_assert_cmpstr(scan.title, ==, "ring");
      sb_scan_clear(&scan);
      assert_cut_refused(bytes);
      bytes->data[98] = 8;
      assert_refused((char *)bytes->data, bytes->len, &plain, "8 bits");
      g_byte_array_unref(bytes);
    }
  }
}

static void test_x3p(void) {
  SbHeights h = written();
  GError *error = NULL;
  SbScan none;
  if (!sb_scan_read(&none, "PK\3\4", 4, &plain, "scan", &error) &&
      strstr(error->message, "option `x3p`") != NULL) {
    g_test_skip("built without libzip");
    g_error_free(error);
    return;
  }
  g_clear_error(&error);
  for (const char *type = "ILFD"; *type != '\0'; type++) {
    for (int rows = 1; rows <= ROWS; rows += ROWS - 1) {
      h.rows = (size_t)rows;
      SbScan scan;
      const bool whole = *type == 'I' || *type == 'L';
      GByteArray *bytes = write_x3p(&h, *type, whole ? 1e-9 : 1);
      parse(&scan, bytes, &plain);
      assert_same(&scan, &h, *type == 'F' ? 1e-13 : 1e-22);
      g_assert_cmpstr(scan.format, ==, "X3P");
      sb_scan_clear(&scan);
      assert_cut_refused(bytes);
      // A point changed on the way: the check sum of the member says so.
      guchar *end = bytes->data + bytes->len - 60;
      while (memcmp(end, "PK\1\2", 4) != 0 || memcmp(end + 46, "main.xml", 8) != 0) {
        end--;
      }
      end[-1] ^= 1;
      if (!whole) {
        assert_refused((char *)bytes->data, bytes->len, &plain, "cannot be unpacked");
      }
      g_byte_array_unref(bytes);
    }
  }
  // What the XML announces is looked at.
  const struct {
    const char *from, *to, *why;
  } wrong[] = {{"<SizeX>20<", "<SizeX>21<", "is cut short: 21 x 17 points announced"},
               {"<SizeX>20<", "<SizeX>-4<", "matrix of \"-4\""},
               {"<AxisType>I<", "<AxisType>A<", "CX is not an incremental axis"},
               {">SUR<", ">PCL<", "feature type \"PCL\""},
               {">D<", ">Q<", "data type \"Q\""},
               {"bindata/data.bin<", "bindata/date.bin<", "no member \"bindata/date.bin\""},
               {"</Axes>", "</Oxes>", "main.xml: "}};
  for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
    h.rows = ROWS;
    GByteArray *bytes = write_x3p(&h, 'D', 1);
    // The last one of >D<, CZ's.
    gsize length = strlen(wrong[i].from);
    guchar *at = NULL;
    for (guchar *p = bytes->data; p + length < bytes->data + 1500; p++) {
      at = memcmp(p, wrong[i].from, length) == 0 && (at == NULL || wrong[i].to[1] == 'Q') ? p : at;
    }
    g_assert_nonnull(at);
    memcpy(at, wrong[i].to, length);
    // Its sum, in the local head and in the directory.
    const guchar *begin = bytes->data + 30 + strlen("main.xml");
    guint32 size, sum;
    memcpy(&size, bytes->data + 18, 4);
    sum = GUINT32_TO_LE(crc(begin, GUINT32_FROM_LE(size)));
    memcpy(bytes->data + 14, &sum, 4);
    guchar *end = bytes->data + bytes->len - 60;
    while (memcmp(end, "PK\1\2", 4) != 0 || memcmp(end + 46, "main.xml", 8) != 0) {
      end--;
    }
    memcpy(end + 16, &sum, 4);
    assert_refused((char *)bytes->data, bytes->len, &plain, wrong[i].why);
    g_byte_array_unref(bytes);
  }
}

// ---- Text ----

// A matrix in nanometres in some dialect.
static GString *matrix(const char *header, const char *separator, char decimal,
                       const char *missing) {
  GString *out = g_string_new(header);
  for (int i = 0; i < ROWS; i++) {
    for (int j = 0; j < COLUMNS; j++) {
      const double z = height[i * COLUMNS + j] * 1e9;
      g_autofree char *number = g_strdup_printf("%.2f", z);
      if (decimal != '.' && !isnan(z)) {
        *strchr(number, '.') = decimal;
      }
      g_string_append_printf(out, "%s%s", j > 0 ? separator : "", isnan(z) ? missing : number);
    }
    g_string_append(out, "\r\n");
  }
  return out;
}

static void assert_text(const GString *text, const SbScanChoices *choices, const SbHeights *h) {
  SbScan scan;
  GError *error = NULL;
  if (!sb_scan_read(&scan, text->str, text->len, choices, "scan", &error)) {
    g_error("%s\n%.300s", error->message, text->str);
  }
  assert_same(&scan, h, 1e-20);
  sb_scan_clear(&scan);
}

static void test_matrix(void) {
  SbHeights h = written();
  static const char *const gwyddion =
      "# Channel: Height\n# Width: 10.0 \xc2\xb5m\n# Height: 34 \xc2\xb5m\n# Value units: nm\n";
  static const char *const latin =
      "# Channel: H\xf6he\n# Width: 10.0 \xb5m\n# Height: 34 \xb5m\n# Value units: nm\n";
  static const char *const spip =
      "# File Format = ASCII\n# x-pixels = 20\n# y-pixels = 17\n# x-length = 10000\n"
      "# y-length = 34000\n# Bit2nm = 1\n# Start of Data:\n";
  static const char *const spip_unit =
      "# File Format = ASCII\r\n# x-pixels = 20\r\n# y-pixels = 17\r\n# x-length = 10000\r\n"
      "# y-length = 34000\r\n# z-unit = [nm]\r\n# voidpixels = 2\r\n# Start of Data:\r\n";
  static const char *const esri = "ncols 20\nnrows 17\nxllcorner 0\nyllcorner 0\ncellsize 0.5\n"
                                  "NODATA_value -9999\n";
  const struct {
    const char *header, *separator, *missing;
    char decimal;
  } dialects[] = {{gwyddion, "\t", "nan", '.'}, {gwyddion, ";", "", '.'},
                  {gwyddion, "\t", "---", ','}, {latin, " ", "NaN", '.'},
                  {gwyddion, ", ", "nan", '.'}, {gwyddion, " ", "bad", ','},
                  {spip, "  ", "nan", '.'},     {spip_unit, "\t", "3.402823466e+38", '.'}};
  for (size_t i = 0; i < G_N_ELEMENTS(dialects); i++) {
    GString *text =
        matrix(dialects[i].header, dialects[i].separator, dialects[i].decimal, dialects[i].missing);
    assert_text(text, &plain, &h);
    g_string_free(text, TRUE);
  }
  // UTF-16, as Windows' programs write it.
  GString *text = matrix(gwyddion, "\t", '.', "nan");
  gsize count = 0;
  g_autofree char *wide =
      g_convert(text->str, (gssize)text->len, "UTF-16", "UTF-8", NULL, &count, NULL);
  GString *copy = g_string_new_len(wide, (gssize)count);
  assert_text(copy, &plain, &h);
  g_string_free(copy, TRUE);
  g_string_free(text, TRUE);
  // Units that are not there are asked for.
  h.dy = h.dx;
  text = matrix(esri, " ", '.', "-9999");
  assert_refused(text->str, text->len, &plain,
                 "the unit of its heights: specify it with --unit=nm|um|mm");
  assert_chosen(text->str, text->len, &plain, "unit", "nm\num\nmm");
  assert_chosen(text->str, text->len, &(SbScanChoices){.channel = "1"}, "channel", "");
  assert_text(text, &(SbScanChoices){.unit = 1e-9, .lateral_unit = 1e-6}, &h);
  g_string_free(text, TRUE);
  text = matrix("", "\t", '.', "nan");
  assert_refused(text->str, text->len, &(SbScanChoices){.unit = 1e-9}, "--spacing");
  assert_chosen(text->str, text->len, &(SbScanChoices){.unit = 1e-9}, "spacing", "");
  assert_text(text, &(SbScanChoices){.unit = 1e-9, .spacing = 0.5e-6}, &h);
  g_string_append(text, "1 2 3\n");
  assert_refused(text->str, text->len, &(SbScanChoices){.unit = 1e-9, .spacing = 1e-6},
                 "line 18 has not 20 numbers");
  g_string_free(text, TRUE);
  // A row of other numbers above, and results behind; but not another matrix, and no damaged row.
  text = matrix("1;2;3\n", "\t", '.', "nan");
  g_string_append(text, "\nSq = 0.76 um\n");
  assert_text(text, &(SbScanChoices){.unit = 1e-9, .spacing = 0.5e-6}, &h);
  GString *twice = g_string_new_len(text->str, (gssize)text->len);
  g_string_append(twice, text->str + strlen("1;2;3\n"));
  assert_refused(twice->str, twice->len, &(SbScanChoices){.unit = 1e-9, .spacing = 1e-6},
                 "are another table");
  g_string_free(twice, TRUE);
  text->str[text->len / 2] = 'x';
  assert_refused(text->str, text->len, &(SbScanChoices){.unit = 1e-9, .spacing = 1e-6},
                 "numbers expected");
  g_string_free(text, TRUE);
  // Marks between thousands, in quotes or next to a decimal mark.
  static const char *const grouped[] = {"1,000.5;2,000.5\n3,000.5;4,000.5\n",
                                        "\"1,000,000\",\"2,000\"\n3,\"4,000\"\n"};
  for (size_t i = 0; i < G_N_ELEMENTS(grouped); i++) {
    SbScan scan;
    g_assert_true(sb_scan_read(&scan, grouped[i], strlen(grouped[i]),
                               &(SbScanChoices){.unit = 1, .spacing = 1, .lateral_unit = 1}, "scan",
                               NULL));
    g_assert_cmpfloat(scan.heights.z[1], ==, i == 0 ? 4000.5 : 4000);
    sb_scan_clear(&scan);
  }
  // Positions in front of the heights and above them are no heights.
  text = g_string_new("0");
  for (int i = -1; i < ROWS; i++) {
    for (int j = i < 0 ? 0 : -1; j < COLUMNS; j++) {
      const double number = i < 0 ? 0.5 * j : j < 0 ? 2.0 * i : i * j % 7;
      g_string_append_printf(text, "%s%.2f", j < 0 ? "" : "\t", number);
    }
    g_string_append(text, "\n");
  }
  assert_refused(text->str, text->len, &(SbScanChoices){.unit = 1e-9, .spacing = 1e-6},
                 "its first column has even steps");
  g_string_free(text, TRUE);
  text = matrix(spip, " ", '.', "0");
  g_string_truncate(text, text->len - 100);
  assert_refused(text->str, text->len, &plain, "where the header announces 20 x 17");
  g_string_free(text, TRUE);
}

// A line that may multiply the heights, but does not, is named.
static void test_resolution(void) {
  SbScan scan;
  static const char text[] =
      "dx: 1 um\ndy: 1 um\nZ resolution: 2 nm\nZ unit: nm\n1 2 3 4\n2 3 4 1\n";
  g_assert_true(sb_scan_read(&scan, text, strlen(text), &plain, "scan", NULL));
  g_assert_cmpuint(scan.notes->len, ==, 1);
  g_assert_cmpstr(scan.notes->pdata[0], ==,
                  "line 3: \"z resolution\" 2 nm does not multiply the heights");
  g_assert_cmpfloat_with_epsilon(scan.heights.z[1], 2e-9, 1e-20);
  sb_scan_clear(&scan);
}

// Commas that separate numbers and are their decimal marks too: zeros before other digits or a line
// of names decide, else a choice does.
static void test_commas(void) {
  const SbHeights h = written();
  for (int blank = 0; blank < 2; blank++) {
    GString *text =
        matrix("Width: 10 um\nHeight: 34 um\nZ unit: nm\n", blank ? ", " : ",", ',', "nan");
    assert_text(text, &plain, &h);
    g_string_free(text, TRUE);
  }
  static const char either[] = "1,523,2,518,4,600\n3,530,4,511,5,620\n",
                    integers[] = "1,5,2,18\n3,53,4,5\n";
  static const char names[] = "x [um],z [nm]\n0,523\n1,518\n2,530\n";
  const SbScanChoices scale = {.unit = 1e-9, .spacing = 1e-6};
  assert_chosen(either, strlen(either), &scale, "decimal", "point\ncomma");
  static const char profile[] = "0,0,123\n1,0,045\n2,0,500\n"; // x, and z with a decimal comma
  assert_chosen(profile, strlen(profile), &scale, "decimal", "point");
  static const char grouped[] = "-869\t-1,400\t-856\n-1,001\t-1,347\t-829\n"; // thousands?
  assert_chosen(grouped, strlen(grouped), &scale, "decimal", "point\ncomma");
  const struct {
    const char *text;
    char decimal;
    size_t columns, rows;
    double first; // height [nm]
  } cases[] = {{grouped, '.', 3, 2, -869}, {either, ',', 3, 2, 1.523}, {either, '.', 6, 2, 1},
               {integers, '\0', 4, 2, 1},  {profile, '.', 3, 3, 0},    {names, '\0', 3, 1, 523}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    const SbScanChoices choices = {.unit = 1e-9, .spacing = 1e-6, .decimal = cases[i].decimal};
    SbScan scan;
    GError *error = NULL;
    sb_scan_read(&scan, cases[i].text, strlen(cases[i].text), &choices, "scan", &error);
    g_assert_no_error(error);
    g_assert_cmpuint(scan.heights.columns, ==, cases[i].columns);
    g_assert_cmpuint(scan.heights.rows, ==, cases[i].rows);
    g_assert_cmpfloat_with_epsilon(scan.heights.z[0], 1e-9 * cases[i].first, 1e-20);
    sb_scan_clear(&scan);
  }
}

static void test_sdf(void) {
  SbHeights h = written();
  h.dx = 0.5e-6;
  h.dy = 2e-6;
  static const char *const format =
      "aISO-1.0\r\nManufacID   = bench 3\r\nNumPoints   = 20\r\nNumProfiles = 17\r\n"
      "Xscale      = 5e-07\r\nYscale      = 2e-06\r\nZscale      = 1e-9\r\nZresolution = -1\r\n"
      "Compression = 0\r\nDataType    = 7\r\nCheckType   = 0\r\n*\r\n";
  GString *text = matrix(format, "\r\n", '.', "BAD");
  g_string_append(text, "*\r\n");
  assert_text(text, &plain, &h);
  assert_refused(text->str, text->len - 40, &plain, "the header announces 20 x 17");
  g_string_free(text, TRUE);
  // Binary, 32-bit integers.
  GByteArray *bytes = g_byte_array_new();
  guint8 head[81] = "bISO-1.0";
  const guint16 size[2] = {GUINT16_TO_LE(COLUMNS), GUINT16_TO_LE(ROWS)};
  const double scale[4] = {0.5e-6, 2e-6, 1e-9, -1};
  memcpy(head + 42, size, 4);
  memcpy(head + 46, scale, 32);
  head[79] = 6;
  g_byte_array_append(bytes, head, sizeof head);
  for (int i = 0; i < COLUMNS * ROWS; i++) {
    const gint32 value = isnan(height[i]) ? G_MININT32 : (gint32)lround(1e9 * height[i]);
    const gint32 little = GINT32_TO_LE(value);
    g_byte_array_append(bytes, (const guint8 *)&little, 4);
  }
  SbScan scan;
  parse(&scan, bytes, &plain);
  assert_same(&scan, &h, 1e-20);
  sb_scan_clear(&scan);
  assert_cut_refused(bytes);
  // Of double precision, whose end marks missing points.
  g_byte_array_set_size(bytes, sizeof head);
  bytes->data[79] = 7;
  for (int i = 0; i < COLUMNS * ROWS; i++) {
    put_double(bytes, isnan(height[i]) ? -DBL_MAX : 1e9 * height[i]);
  }
  parse(&scan, bytes, &plain);
  assert_same(&scan, &h, 1e-20);
  sb_scan_clear(&scan);
  g_byte_array_unref(bytes);
}

// Headers in other languages, with a factor of heights, with decimal commas; `--unit` replaces the
// factor and its unit, which a note states.
static void test_headers(void) {
  SbHeights h = written();
  static const char *const german =
      "# Kanal: H\xc3\xb6he\n# Breite: 10,0 \xc2\xb5m\n# H\xc3\xb6he: 34 \xc2\xb5m\n"
      "# Einheit der Werte: nm\n";
  static const char *const french =
      "# Canal : Hauteur\n# Largeur : 10,0 \xc2\xb5m\n# Hauteur : 34 \xc2\xb5m\n"
      "# Unit\xc3\xa9 des valeurs : nm\n";
  static const char *const factor = "Width: 10 um\nHeight: 34 um\nZ unit: um\nZ factor: 0.001\n";
  static const char *const times = "X step: 0.5 um\nY step: 2 um\nHeight: x 0.001 um\n";
  static const char *const scale = "Width: 10 um\nHeight: 34 um\nZ-Scale [pm]: 1000\n";
  const struct {
    const char *header;
    char decimal;
  } headers[] = {
      {german, ','},
      {french, ','},
      {factor, '.'},
      {scale, '.'},
      {times, '.'},
      {"X step: 0.5 um\nY step: 2 um\nZ: \xc3\x97 1 nm\n", '.'},
      {"Width: 10 um\nHeight: 34 um\nUnit: nm\n", '.'},
      {"\"Breite\";\"10,0\";\"um\"\n\"H\xc3\xb6he\";\"34\";\"um\"\n\"Einheit\";\"nm\"\n", ','}};
  // Lines that may be factors; lines that contradict the header.
  static const char *const doubts[] = {"dz = 0.25",
                                       "Zinc 0.25",
                                       "Z step: 0.25 um",
                                       "Sensitivity: 0.25 um/V",
                                       "Data in 1/10 um",
                                       "Unit: 0.1 um",
                                       "Vertical magnification: x 50",
                                       "Counts per um: 4000",
                                       "Z\xe4\xbf\x82\xe6\x95\xb0: 0.25",
                                       "Columns: 17\nRows: 20"};
  for (size_t i = 0; i < G_N_ELEMENTS(doubts); i++) {
    g_autofree char *header =
        g_strdup_printf("%s\nX step: 0.5 um\nY step: 2 um\nZ unit: nm\n", doubts[i]);
    GString *text = matrix(header, "\t", '.', "nan");
    assert_refused(text->str, text->len, &plain,
                   doubts[i][0] == 'C' && doubts[i][2] == 'l' ? "header announces 17 x 20"
                                                              : "it is not clear whether");
    g_string_free(text, TRUE);
  }
  for (size_t i = 0; i < G_N_ELEMENTS(headers); i++) {
    GString *text = matrix(headers[i].header, "\t", headers[i].decimal, "nan");
    assert_text(text, &plain, &h);
    g_string_free(text, TRUE);
  }
  GString *text = NULL;
  for (int i = 0; i < 2; i++) {
    text = matrix(i == 0 ? factor : times, "\t", '.', "nan");
    SbScan scan;
    g_assert_true(
        sb_scan_read(&scan, text->str, text->len, &(SbScanChoices){.unit = 1e-9}, "x", NULL));
    assert_same(&scan, &h, 1e-20);
    g_assert_nonnull(strstr(scan.notes->pdata[0], "factor 0.001 is not used"));
    sb_scan_clear(&scan);
    g_string_free(text, TRUE);
  }
  // ESRI with decimal commas; a profile whose units follow the names; blocks of results above.
  h.dy = h.dx;
  text = matrix("ncols 20\nnrows 17\nxllcorner 0,0\nyllcorner 0,0\ncellsize 0,5\n"
                "NODATA_value -9999\n",
                " ", ',', "-9999");
  assert_text(text, &(SbScanChoices){.unit = 1e-9, .lateral_unit = 1e-6}, &h);
  g_string_free(text, TRUE);
  h.rows = 1;
  text = g_string_new("Scan Parameters\nLength,64.0 um\nRa,10.0 um,0.6 um\n\nScan Data\n"
                      "Lateral um,Raw Micrometer,\n");
  GString *linked = g_string_new("x in \xc2\xb5m;z in nm\n");
  for (int j = 0; j < COLUMNS; j++) {
    g_string_append_printf(text, "%.2f,%.6f,,\n", 0.5 * j, 1e6 * height[j]);
    g_string_append_printf(linked, "%.2f;%.4f\n", 0.5 * j, 1e9 * height[j]);
  }
  g_strdelimit(linked->str + 18, ".", ',');
  assert_text(text, &plain, &h);
  assert_text(linked, &plain, &h);
  g_string_free(text, TRUE);
  g_string_free(linked, TRUE);
}

// Lengths with and without units, factors by any name between separators, and profiles of one
// column or with units in two places. What is not clear is refused.
static void test_lengths(void) {
  SbHeights h = written();
  static const struct {
    const char *header, *separator;
  } headers[] = {
      {"Width: 20\nHeight: 17\nX step: 0.5 um\nY step: 2 um\nZ unit: nm\n", " "},
      {"Width: 20 px\nHeight: 17 px\nX range: 10 um\nY range: 34 um\nZ unit: nm\n", " "},
      {"X size: 20\nY size: 17\nX pixel size: 0.5 um\nY pixel size: 2 um\nZ unit: nm\n", " "},
      {"X size\t10 um\nY size\t34 um\nZ unit\tum\nZ factor\t0.001\n", "\t"},
      {"X size;10;um\nY size;34;um\nZ unit;um\nHeight scale;0.001\n", "\t"},
      {"Width 10 um\nHeight 34 um\nZ unit: um\nScaling factor 0.001\n", " "},
      {"Width: 10 um\nHeight: 34 um\nZ unit: um\n\xc3\x89"
       "chelle Z: 0.001\n",
       "\t"},
      {"Width: 10 um\nHeight: 34 um\nZ unit: um\nVertical scaling = 0.001\n", "\t"},
      {"Width: 10 um\nHeight: 34 um\nZ unit: nm\nX scale factor: 3\nZoom factor: 50\n", "\t"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(headers); i++) {
    GString *text = matrix(headers[i].header, headers[i].separator, '.', "nan");
    assert_text(text, &plain, &h);
    g_string_free(text, TRUE);
  }
  GString *text = matrix("Width: 10 um\nHeight: 34 um\nZ unit: nm\nGain: 3\n", " ", '.', "nan");
  assert_refused(text->str, text->len, &plain,
                 "scan: line 4: it is not clear whether \"gain\" multiplies the heights");
  assert_chosen(text->str, text->len, &plain, "unit", "nm\num\nmm");
  assert_text(text, &(SbScanChoices){.unit = 1e-9}, &h);
  g_string_free(text, TRUE);
  // Bare sizes that are the numbers of points are no lengths.
  text = matrix("Width: 20\nHeight: 17\nZ unit: nm\n", " ", '.', "nan");
  assert_refused(text->str, text->len, &plain, "the distance of its points");
  g_string_free(text, TRUE);
  // Positions above the heights; an inclined plane has none.
  text = g_string_new("");
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < COLUMNS; j++) {
      g_string_append_printf(text, "%.1f%s", i == 0 ? 0.5 * j : i * j % 7,
                             j + 1 < COLUMNS ? "\t" : "\n");
    }
  }
  assert_refused(text->str, text->len, &(SbScanChoices){.unit = 1e-9, .spacing = 1e-6},
                 "its first row has even steps");
  g_string_free(text, TRUE);
  h.rows = 1;
  static const char *const profiles[] = {"Z unit: nm\nx (um);z\n",
                                         "Z factor: 1 nm\nx (um);z (digit)\n",
                                         "dx: 0.5 um\nZ unit: nm\n", "Pas: 0.5 um\nz (nm)\n"};
  for (size_t i = 0; i < G_N_ELEMENTS(profiles) + 1; i++) {
    const bool two = i == G_N_ELEMENTS(profiles);
    text = g_string_new(two ? "Z unit: um\nx (um);z (nm)\n" : profiles[i]);
    for (int j = 0; j < COLUMNS; j++) {
      if (i < 2 || two) {
        g_string_append_printf(text, "%.2f;", 0.5 * j);
      }
      g_string_append_printf(text, "%.4f\n", 1e9 * height[j]);
    }
    if (two) {
      assert_refused(text->str, text->len, &plain, "states two units of its heights");
    } else {
      assert_text(text, &plain, &h);
    }
    g_string_free(text, TRUE);
  }
}

static void test_points(void) {
  const SbHeights h = written();
  // Columns first, and rows first; missing points not there.
  for (int order = 0; order < 2; order++) {
    GString *text = g_string_new("x [um], y [um], z [nm]\n");
    for (int k = 0; k < COLUMNS * ROWS; k++) {
      const int i = order == 0 ? k / COLUMNS : k % ROWS, j = order == 0 ? k % COLUMNS : k / ROWS;
      if (!isnan(height[i * COLUMNS + j])) {
        g_string_append_printf(text, "%.4f,%.4f,%.4f\n", 7 + 0.5 * j, 2.0 * i,
                               1e9 * height[i * COLUMNS + j]);
      }
    }
    assert_text(text, &plain, &h);
    g_string_append(text, "7,0,3\n");
    assert_refused(text->str, text->len, &plain, "is there twice");
    g_string_free(text, TRUE);
  }
}

// Columns by their names, in any order and next to others, and results before and behind them.
static void test_named(void) {
  static const struct {
    const char *head, *row, *tail; // x, y, z of a row as 1, 2, 3; 4 is its number
    const char *refused;           // NULL: read
  } cases[] = {
      {"Y [um];X [um];Z [nm]\n", "2;1;3", "", NULL},
      {"Height (nm),X-Position (um),Y-Position (um)\n", "3,1,2", "", NULL},
      {"i;j;x [um];y [um];z [nm]\n", "4;4;1;2;3", "", NULL},
      {"x [um],y [um],z [nm],I\n", "1,2,3,4", "", NULL},
      {"x [um],Quer [um],z [nm]\n", "1,2,3", "", NULL},
      {"No,Sa (nm),Sq (nm)\n1,0.6,0.76\n2,0.61,0.77\nX (um),Y (um),Z (nm)\n", "1,2,3", "", NULL},
      {"x_um;y_um;z_nm\n", "1;2;3", "\nSa;0.6;nm\n\nNo;Sa;Sq\n1;2;3\n", NULL},
      {"x;z [nm];z 2 [nm]\n", "1;3;4", "", "columns 2 and 3 may both be z"},
      {"i;x [um];y [um];z [nm]\n", "4;1;4;3", "", "form no grid"},
      {"x [um];y [um];z [nm]\num;um;um\n", "1;2;3", "", "states two units of its heights"},
      {"x [um];y [um];z [nm]\n", "1;2;3", "\nx [um];y [um];z [nm]\n1;2;3\n", "the table again"},
      {"x [um];y [um];z [nm]\n", "1;2;3", "over;over;3\n1;2;3\n", "numbers expected"},
  };
  const SbHeights h = written();
  for (size_t c = 0; c < G_N_ELEMENTS(cases); c++) {
    GString *text = g_string_new(cases[c].head);
    for (int k = 0; k < COLUMNS * ROWS; k++) {
      for (const char *at = cases[c].row; *at != '\0' && !isnan(height[k]); at++) {
        const int i = k / COLUMNS, j = k % COLUMNS;
        if (*at < '1' || *at > '4') {
          g_string_append_c(text, *at);
        } else {
          g_string_append_printf(text, "%.4f",
                                 *at == '1'   ? 0.5 * j
                                 : *at == '2' ? 2.0 * i
                                 : *at == '3' ? 1e9 * height[k]
                                              : k);
        }
      }
      g_string_append(text, isnan(height[k]) ? "" : "\n");
    }
    g_string_append(text, cases[c].tail);
    g_test_message("case %zu", c);
    if (cases[c].refused != NULL) {
      assert_refused(text->str, text->len, &plain, cases[c].refused);
    } else {
      assert_text(text, &plain, &h);
    }
    g_string_free(text, TRUE);
  }
}

static void test_profile(void) {
  SbHeights h = written();
  h.rows = 1;
  GString *text = g_string_new("x (mm);z (nm)\n"), *single = g_string_new("");
  for (int j = 0; j < COLUMNS; j++) {
    g_string_append_printf(text, "%.5f;%.4f\n", 1 + 0.0005 * j, 1e9 * height[j]);
    g_string_append_printf(single, "%.4f\n", 1e9 * height[j]);
  }
  assert_text(text, &plain, &h);
  assert_text(single, &(SbScanChoices){.unit = 1e-9, .spacing = 0.5e-6}, &h);
  assert_refused(single->str, single->len, &(SbScanChoices){.unit = 1e-9}, "--spacing");
  assert_refused(single->str, single->len, &plain, "--unit");
  g_string_append(text, "1.2;3\n");
  assert_refused(text->str, text->len, &plain, "x is not even");
  g_string_append(text, "word\n");
  assert_refused(text->str, text->len, &plain, "line 23: numbers expected, not \"word\"");
  g_string_free(text, TRUE);
  g_string_free(single, TRUE);
}

// Numbers are those of the library to the last digit.
static void test_numbers(void) {
  static const char *const numbers[] = {"0.1",
                                        "-17e-3",
                                        "1.7976931348623157e308",
                                        "123456789012345678901234",
                                        "4.35",
                                        "+.5",
                                        "5.",
                                        "9007199254740993",
                                        "1e-320",
                                        "0.000000000000000000001234",
                                        "2.2250738585072011e-308"};
  g_autoptr(GString) text = g_string_new("z [m]\n");
  for (size_t i = 0; i < G_N_ELEMENTS(numbers); i++) {
    g_string_append_printf(text, "%s\n", numbers[i]);
  }
  SbScan scan;
  g_assert_true(
      sb_scan_read(&scan, text->str, text->len, &(SbScanChoices){.spacing = 1}, "scan", NULL));
  for (size_t i = 0; i < G_N_ELEMENTS(numbers); i++) {
    g_assert_cmpfloat(scan.heights.z[i], ==, g_ascii_strtod(numbers[i], NULL));
  }
  sb_scan_clear(&scan);
}

static void test_refused(void) {
  assert_refused("", 0, &plain, "it is empty");
  assert_refused("hello\nworld\n", 12, &plain, "no numbers");
  assert_refused("\0\1\2", 3, &plain, "not a scan that is known");
  assert_refused("0,5\n0,6\n0,7\n", 12, &plain, "is ambiguous");
  assert_refused("ncols 100000\nnrows 100000\ncellsize 1\n1 2 3\n", 43,
                 &(SbScanChoices){.unit = 1e-9}, "3 numbers where the header announces");
  SbScan scan;
  GError *error = NULL;
  g_assert_false(sb_scan_read(&scan, NULL, 0, &plain, "/dev/null/nothing.gwy", &error));
  g_assert_true(g_str_has_prefix(error->message, "/dev/null/nothing.gwy: "));
  g_clear_error(&error);
  g_assert_false(sb_scan_read(&scan, NULL, 0, &plain, "/dev/zero", &error));
  g_assert_true(strstr(error->message, "regular file") != NULL);
  g_clear_error(&error);
}

// Parts, scatter and cut-offs of a scan.
static void test_figures(void) {
  enum { N = 192 };
  g_autofree double *z = g_new(double, N *N);
  for (int k = 0; k < N * N; k++) {
    const double x = k % N, y = (double)k / N;
    z[k] = 1e-6 * (sin(x / 3) + sin(y / 3) + 0.3 * sin(x / 7 + y / 5));
  }
  SbHeights h = {N, N, N, 1e-6, 1e-6, z};
  const SbHeightsChoices choices = {.form = SB_FORM_PLANE};
  g_autofree SbScanFigures *figures = g_new0(SbScanFigures, 1);
  g_assert_cmpint(sb_scan_figures(figures, &h, &choices, NULL), ==, SB_OK);
  g_assert_cmpint(figures->part_rows * figures->part_columns, ==, 9);
  g_assert_cmpint(figures->cutoff_count, >, 5);
  for (int i = 1; i < figures->cutoff_count; i++) {
    // Every filter takes something away.
    g_assert_cmpfloat(figures->cutoff[i].moment[0], <, figures->cutoff[0].moment[0]);
    g_assert_cmpfloat(figures->cutoff[i].moment[2], <, figures->cutoff[0].moment[2]);
  }
  g_assert_cmpfloat_with_epsilon(figures->scene.sigma, figures->figures.sq, 1e-20);
  sb_scan_figures_clear(figures);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/scan/gwy", test_gwy);
  g_test_add_func("/scan/sur", test_sur);
  g_test_add_func("/scan/x3p", test_x3p);
  g_test_add_func("/scan/matrix", test_matrix);
  g_test_add_func("/scan/resolution", test_resolution);
  g_test_add_func("/scan/commas", test_commas);
  g_test_add_func("/scan/sdf", test_sdf);
  g_test_add_func("/scan/headers", test_headers);
  g_test_add_func("/scan/lengths", test_lengths);
  g_test_add_func("/scan/points", test_points);
  g_test_add_func("/scan/named", test_named);
  g_test_add_func("/scan/profile", test_profile);
  g_test_add_func("/scan/numbers", test_numbers);
  g_test_add_func("/scan/refused", test_refused);
  g_test_add_func("/scan/figures", test_figures);
  return g_test_run();
}

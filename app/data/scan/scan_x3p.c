// X3P (ISO 25178-72, ISO 5436-2): a zip whose main.xml says what the binary members hold. Taken are
// surfaces and profiles on an even grid: Record1's axes (CX, CY with increments, CZ of type I, L, F
// or D with increment and offset) in metres, Record3's matrix dimension and data link; points are
// missing where a bit of the valid-points member is 0 (lowest first) or a number is none. The zip
// may have a root folder, its names and the XML's in any case, and main.xml in UTF-16. Leaves
// out lists of points, data within the XML, several layers, the check sums (the zip has its own).
#include "app/data/scan/scan_private.h"

#include "app/base/number.h"

#include <math.h>
#include <zip.h>

enum { XML_MAX = 1 << 20 };

// ---- main.xml ----

typedef struct {
  const char *path; // of elements without name spaces, after the root
  char *text;       // owned
} Entry;

enum {
  FEATURE,
  X_TYPE,
  X_STEP,
  Y_TYPE,
  Y_STEP,
  Z_TYPE,
  Z_STEP,
  COLUMNS,
  ROWS,
  LAYERS,
  DATA,
  VALID,
  ENTRIES
};

typedef struct {
  Entry entry[ENTRIES];
  GString *path;
} Main;

// The name behind a name space's colon.
static const char *local(const char *name) {
  const char *colon = strchr(name, ':');
  return colon != NULL ? colon + 1 : name;
}

static void on_start(GMarkupParseContext *context, const char *element, const char **names,
                     const char **values, gpointer user, GError **error) {
  Main *main = user;
  g_string_append_printf(main->path, "/%s", local(element));
  if (main->path->len > 1000) {
    g_set_error_literal(error, G_MARKUP_ERROR, G_MARKUP_ERROR_INVALID_CONTENT, "too deep");
  }
}

static void on_end(GMarkupParseContext *context, const char *element, gpointer user,
                   GError **error) {
  Main *main = user;
  g_string_truncate(main->path, (gsize)(strrchr(main->path->str, '/') - main->path->str));
}

static void on_text(GMarkupParseContext *context, const char *text, gsize length, gpointer user,
                    GError **error) {
  Main *main = user;
  // Behind the root.
  const char *path = main->path->len > 0 ? strchr(main->path->str + 1, '/') : NULL;
  for (int i = 0; path != NULL && i < ENTRIES; i++) {
    Entry *entry = &main->entry[i];
    if (g_ascii_strcasecmp(path + 1, entry->path) == 0 && entry->text == NULL) {
      entry->text = g_strstrip(g_strndup(text, length));
    }
  }
}

static void main_clear(Main *main) {
  for (int i = 0; i < ENTRIES; i++) {
    g_free(main->entry[i].text);
  }
  g_string_free(main->path, TRUE);
}

// Number of an entry; `missing` without one, NaN with another text.
static double number(const Main *main, int entry, double missing) {
  double value = NAN;
  const char *text = main->entry[entry].text;
  if (text == NULL || *text == '\0') {
    return missing;
  }
  return sb_number_parse(&value, text) ? value : NAN;
}

static const char *text_of(const Main *main, int entry) {
  return main->entry[entry].text != NULL ? main->entry[entry].text : "";
}

// ---- The zip ----

// Returns the index of a member by the path after the folder of main.xml; -1 without one. The exact
// path wins; the case of letters, the kind of slashes and a folder around everything do not matter.
static zip_int64_t find_member(zip_t *zip, const char *path) {
  enum { MEMBERS_MAX = 10000 };
  g_autofree char *plain = g_strdelimit(g_strdup(path), "\\", '/');
  const char *wanted = g_str_has_prefix(plain, "./") ? plain + 2 : plain;
  wanted += *wanted == '/';
  zip_int64_t found = -1, best = G_MAXINT64;
  const zip_int64_t count = MIN(zip_get_num_entries(zip, 0), MEMBERS_MAX);
  const size_t length = strlen(wanted);
  for (zip_int64_t i = 0; i < count && best > 0; i++) {
    const char *raw = zip_get_name(zip, (zip_uint64_t)i, 0);
    g_autofree char *name = g_strdelimit(g_strdup(raw != NULL ? raw : ""), "\\", '/');
    const size_t size = strlen(name);
    if (size < length || g_ascii_strcasecmp(name + size - length, wanted) != 0 ||
        (size > length && name[size - length - 1] != '/')) {
      continue;
    }
    // The least deep one; the folders of a resource fork that archivers add are deeper.
    const zip_int64_t depth = (zip_int64_t)(size - length);
    if (depth < best) {
      best = depth;
      found = i;
    }
  }
  return found;
}

// A member's bytes; NULL with an error. Deflate packs at most 1032 to one: more is announced by a
// bomb alone.
static guchar *member(zip_t *zip, const char *member_name, guint64 *size, guint64 most,
                      const SbScanBytes *bytes, GError **error) {
  zip_stat_t about;
  const guint64 length = (guint64)(bytes->end - bytes->at);
  const zip_int64_t at = find_member(zip, member_name);
  if (at < 0 || zip_stat_index(zip, (zip_uint64_t)at, 0, &about) != 0 ||
      (about.valid & ZIP_STAT_SIZE) == 0) {
    sb_scan_fail(error, bytes->name, "has no member \"%s\"", member_name);
    return NULL;
  }
  if (about.size > most || about.size / 1100 > length) {
    sb_scan_fail(error, bytes->name,
                 "\"%s\" is announced with %" G_GUINT64_FORMAT " bytes: too many", member_name,
                 (guint64)about.size);
    return NULL;
  }
  guchar *out = g_try_malloc(about.size + 1);
  zip_file_t *file = out != NULL ? zip_fopen_index(zip, (zip_uint64_t)at, 0) : NULL;
  const zip_int64_t got = file != NULL ? zip_fread(file, out, about.size) : -1;
  // The check sum is looked at when there is no more.
  char end;
  const gboolean good = got >= 0 && (guint64)got == about.size && zip_fread(file, &end, 1) == 0;
  if (file != NULL) {
    zip_fclose(file);
  }
  if (!good) {
    sb_scan_fail(error, bytes->name, "\"%s\" cannot be unpacked", member_name);
    g_clear_pointer(&out, g_free);
    return NULL;
  }
  out[about.size] = '\0';
  *size = about.size;
  return out;
}

static gboolean read_main(Main *main, zip_t *zip, const SbScanBytes *bytes, GError **error) {
  static const GMarkupParser parser = {on_start, on_end, on_text, NULL, NULL};
  guint64 size = 0;
  g_autofree char *xml = (char *)member(zip, "main.xml", &size, XML_MAX, bytes, error);
  if (xml == NULL) {
    return FALSE;
  }
  g_autofree char *utf8 = NULL;
  if (size >= 2 && (memcmp(xml, "\xff\xfe", 2) == 0 || memcmp(xml, "\xfe\xff", 2) == 0 ||
                    memcmp(xml, "<", 2) == 0 || memcmp(xml, "\0<", 2) == 0)) {
    const char *wide = xml[0] == '\0' ? "UTF-16BE" : xml[1] == '\0' ? "UTF-16LE" : "UTF-16";
    gsize count = 0;
    utf8 = g_convert(xml, (gssize)size, "UTF-8", wide, NULL, &count, NULL);
    if (utf8 == NULL) {
      return sb_scan_fail(error, bytes->name, "main.xml is not sound UTF-16");
    }
    size = count;
  }
  const char *plain = utf8 != NULL ? utf8 : xml;
  const guint64 mark = g_str_has_prefix(plain, "\xef\xbb\xbf") ? 3 : 0;
  g_autoptr(GMarkupParseContext) context =
      g_markup_parse_context_new(&parser, G_MARKUP_TREAT_CDATA_AS_TEXT, main, NULL);
  g_autoptr(GError) problem = NULL;
  if (!g_markup_parse_context_parse(context, plain + mark, (gssize)(size - mark), &problem) ||
      !g_markup_parse_context_end_parse(context, &problem)) {
    return sb_scan_fail(error, bytes->name, "main.xml: %s", problem->message);
  }
  return TRUE;
}

// Even steps from column to column: an incremental axis.
static gboolean read_step(double *out, const Main *main, int type, const char *axis,
                          const SbScanBytes *bytes, GError **error) {
  *out = number(main, type + 1, NAN);
  if (g_ascii_strcasecmp(text_of(main, type), "I") != 0) {
    return sb_scan_fail(error, bytes->name,
                        "%s is not an incremental axis: points at any place are "
                        "not read",
                        axis);
  }
  return (isfinite(*out) && *out > 0) ||
         sb_scan_fail(error, bytes->name, "%s has no increment above 0", axis);
}

static gboolean read_points(SbScan *out, const Main *main, zip_t *zip, const SbScanBytes *bytes,
                            GError **error) {
  static const struct {
    char type;
    guint64 size;
  } kinds[] = {{'I', 2}, {'L', 4}, {'F', 4}, {'D', 8}};
  const char *name = bytes->name, *type = text_of(main, Z_TYPE);
  const double columns = number(main, COLUMNS, NAN), rows = number(main, ROWS, 1);
  gsize kind = 0;
  while (kind < G_N_ELEMENTS(kinds) &&
         (g_ascii_toupper(type[0]) != kinds[kind].type || type[1] != '\0')) {
    kind++;
  }
  if (kind == G_N_ELEMENTS(kinds)) {
    return sb_scan_fail(error, name, "CZ has the data type \"%s\" (allowed I, L, F, D)", type);
  }
  if (!(columns >= 1 && rows >= 1 && columns * rows <= (double)SB_HEIGHTS_POINTS_MAX)) {
    return sb_scan_fail(error, name, "has a matrix of \"%s\" x \"%s\" points",
                        text_of(main, COLUMNS), text_of(main, ROWS));
  }
  if (number(main, LAYERS, 1) != 1) {
    return sb_scan_fail(error, name, "has %s layers (allowed 1)", text_of(main, LAYERS));
  }
  if (*text_of(main, DATA) == '\0') {
    return sb_scan_fail(error, name, "has its points in the XML or as a list, which is not read");
  }
  const guint64 points = (guint64)columns * (guint64)rows, size = kinds[kind].size;
  guint64 got = 0, valid_got = 0;
  g_autofree guchar *data = member(zip, text_of(main, DATA), &got, points * size, bytes, error);
  if (data == NULL) {
    return FALSE;
  }
  if (got != points * size) {
    return sb_scan_fail(error, name,
                        "%" G_GUINT64_FORMAT " bytes of points where %.0f x %.0f of %d "
                        "are announced",
                        got, columns, rows, (int)size);
  }
  g_autofree guchar *valid = NULL;
  if (*text_of(main, VALID) != '\0') {
    valid = member(zip, text_of(main, VALID), &valid_got, points, bytes, error);
    if (valid == NULL) {
      return FALSE;
    }
    if (valid_got < (points + 7) / 8) {
      return sb_scan_fail(error, name, "its valid points are cut short");
    }
  }
  const double step = number(main, Z_STEP, 1);
  if (!isfinite(step) || step == 0) {
    return sb_scan_fail(error, name, "CZ has the increment \"%s\"", text_of(main, Z_STEP));
  }
  if (!sb_scan_allocate(out, (guint64)columns, (guint64)rows, name, error)) {
    return FALSE;
  }
  for (guint64 i = 0; i < points; i++) {
    const guchar *p = data + size * i;
    const double value = kinds[kind].type == 'I'   ? (double)(gint16)sb_scan_u16(p)
                         : kinds[kind].type == 'L' ? (double)(gint32)sb_scan_u32(p)
                         : kinds[kind].type == 'F' ? sb_scan_float(p)
                                                   : sb_scan_double(p);
    const gboolean there = valid == NULL || (valid[i / 8] >> (i % 8) & 1) != 0;
    out->heights.z[i] = there ? step * value : NAN;
  }
  return TRUE;
}

gboolean sb_scan_parse_x3p(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                           GError **error) {
  out->format = "X3P";
  zip_error_t problem;
  zip_error_init(&problem);
  zip_source_t *source =
      zip_source_buffer_create(bytes.at, (zip_uint64_t)(bytes.end - bytes.at), 0, &problem);
  zip_t *zip = source != NULL ? zip_open_from_source(source, ZIP_RDONLY, &problem) : NULL;
  if (zip == NULL) {
    zip_source_free(source);
    sb_scan_fail(error, bytes.name, "is not a sound zip: %s", zip_error_strerror(&problem));
    zip_error_fini(&problem);
    return FALSE;
  }
  Main main = {.entry = {[FEATURE] = {"Record1/FeatureType", NULL},
                         [X_TYPE] = {"Record1/Axes/CX/AxisType", NULL},
                         [X_STEP] = {"Record1/Axes/CX/Increment", NULL},
                         [Y_TYPE] = {"Record1/Axes/CY/AxisType", NULL},
                         [Y_STEP] = {"Record1/Axes/CY/Increment", NULL},
                         [Z_TYPE] = {"Record1/Axes/CZ/DataType", NULL},
                         [Z_STEP] = {"Record1/Axes/CZ/Increment", NULL},
                         [COLUMNS] = {"Record3/MatrixDimension/SizeX", NULL},
                         [ROWS] = {"Record3/MatrixDimension/SizeY", NULL},
                         [LAYERS] = {"Record3/MatrixDimension/SizeZ", NULL},
                         [DATA] = {"Record3/DataLink/PointDataLink", NULL},
                         [VALID] = {"Record3/DataLink/ValidPointsLink", NULL}},
               .path = g_string_new(NULL)};
  gboolean good = read_main(&main, zip, &bytes, error);
  const char *feature = text_of(&main, FEATURE);
  if (good && g_ascii_strcasecmp(feature, "SUR") != 0 && g_ascii_strcasecmp(feature, "PRF") != 0) {
    good =
        sb_scan_fail(error, bytes.name, "has the feature type \"%s\" (allowed SUR, PRF)", feature);
  }
  good =
      good && read_points(out, &main, zip, &bytes, error) &&
      read_step(&out->heights.dx, &main, X_TYPE, "CX", &bytes, error) &&
      (out->heights.rows == 1 || read_step(&out->heights.dy, &main, Y_TYPE, "CY", &bytes, error));
  main_clear(&main);
  zip_discard(zip);
  zip_error_fini(&problem);
  return good;
}

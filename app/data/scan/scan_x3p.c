// X3P (ISO 25178-72, ISO 5436-2): a zip whose main.xml says what the binary members hold. Taken are
// surfaces and profiles on an even grid: Record1's axes (CX, CY with increments, CZ of type I, L, F
// or D with increment and offset) in metres, Record3's matrix dimension and data link; points are
// missing where a bit of the valid-points member is 0 (lowest first) or a number is none. The zip
// may have a root folder, its names and the XML's in any case, and main.xml in UTF-16. Leaves
// out lists of points, data within the XML, several layers, the check sums (the zip has its own).
#include "app/data/scan/scan_private.h"

#include "app/base/number.h"

#include <zip.h>

enum { XML_MAX = 1 << 20 };

// Takes the text of an element: path after the root, without name spaces, in lower case -> text.
static void on_text(GMarkupParseContext *context, const char *text, gsize length, gpointer user,
                    GError **error) {
  enum { DEPTH = 6 }; // deeper elements are not read
  GHashTable *texts = user;
  g_autoptr(GString) path = g_string_new(NULL);
  const GSList *at = g_markup_parse_context_get_element_stack(context);
  if (g_slist_nth((GSList *)at, DEPTH + 1) != NULL) {
    return;
  }
  // The stack begins with the element itself and ends with the root.
  for (; at != NULL && at->next != NULL; at = at->next) {
    const char *name = at->data, *colon = strchr(name, ':');
    g_string_prepend(path, path->len > 0 ? "/" : "");
    g_string_prepend(path, colon != NULL ? colon + 1 : name);
  }
  g_autofree char *key = g_ascii_strdown(path->str, -1);
  if (!g_hash_table_contains(texts, key)) {
    g_hash_table_insert(texts, g_steal_pointer(&key), g_strstrip(g_strndup(text, length)));
  }
}

static const char *text_of(GHashTable *texts, const char *path) {
  const char *text = g_hash_table_lookup(texts, path);
  return text != NULL ? text : "";
}

// Number of an element; `missing` without one, NaN with another text.
static double number(GHashTable *texts, const char *path, double missing) {
  double value = *text_of(texts, path) == '\0' ? missing : NAN;
  (void)sb_number_parse(&value, text_of(texts, path));
  return value;
}

// A path in lower case, with slashes, after a slash.
static char *tidy_path(const char *path) {
  path += g_str_has_prefix(path, "./") ? 2 : *path == '/';
  g_autofree char *lower = g_ascii_strdown(path, -1);
  return g_strconcat("/", g_strdelimit(lower, "\\", '/'), NULL);
}

// Returns the bytes of a member by the path after the folder of main.xml; NULL with an error. The
// case of letters, the kind of slashes and a folder around everything do not matter: it is the
// least deep one, unlike resource forks. Deflate packs 1032 to one at most: else it is a bomb.
static guchar *member(zip_t *zip, const char *name, size_t *size, size_t most, size_t packed,
                      GError **error) {
  enum { MEMBERS_MAX = 10000, KNOWN = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_INDEX };
  zip_stat_t about = {0}, each;
  size_t best = SIZE_MAX;
  g_autofree char *wanted = tidy_path(name);
  for (zip_int64_t i = 0; i < MIN(zip_get_num_entries(zip, 0), MEMBERS_MAX); i++) {
    const bool known =
        zip_stat_index(zip, (zip_uint64_t)i, 0, &each) == 0 && (each.valid & KNOWN) == KNOWN;
    g_autofree char *path = tidy_path(known ? each.name : "");
    if (g_str_has_suffix(path, wanted) && strlen(path) < best) {
      best = strlen(path);
      about = each;
    }
  }
  if (best == SIZE_MAX) {
    sb_app_error_input(error, "has no member \"%s\"", name);
    return NULL;
  }
  if (about.size > most || about.size / 1100 > packed) {
    sb_app_error_input(error, "\"%s\" is announced with %zu bytes: too many", name,
                       (size_t)about.size);
    return NULL;
  }
  guchar *out = g_try_malloc0(about.size + 1);
  zip_file_t *file = out != NULL ? zip_fopen_index(zip, about.index, 0) : NULL;
  const zip_int64_t got = file != NULL ? zip_fread(file, out, about.size) : -1;
  // The check sum is looked at when there is no more.
  char end;
  if (got < 0 || (size_t)got != about.size || zip_fread(file, &end, 1) != 0) {
    sb_app_error_input(error, "\"%s\" cannot be unpacked", name);
    g_clear_pointer(&out, g_free);
  }
  g_clear_pointer(&file, zip_fclose);
  *size = about.size;
  return out;
}

static bool read_main(GHashTable *texts, zip_t *zip, size_t packed, GError **error) {
  static const GMarkupParser parser = {.text = on_text};
  size_t size = 0;
  g_autofree char *xml = (char *)member(zip, "main.xml", &size, XML_MAX, packed, error);
  if (xml == NULL) {
    return false;
  }
  const bool marked =
      sb_bytes_begin(xml, size, "\xff\xfe") || sb_bytes_begin(xml, size, "\xfe\xff");
  if (size >= 2 && (marked || xml[0] == '\0' || xml[1] == '\0')) {
    const char *wide = marked ? "UTF-16" : xml[0] == '\0' ? "UTF-16BE" : "UTF-16LE";
    g_autofree char *raw = xml;
    xml = g_convert(raw, (gssize)size, "UTF-8", wide, NULL, &size, NULL);
    if (xml == NULL) {
      return sb_app_error_input(error, "main.xml is not sound UTF-16");
    }
  }
  const size_t mark = sb_bytes_begin(xml, size, "\xef\xbb\xbf") ? 3 : 0;
  g_autoptr(GMarkupParseContext) context =
      g_markup_parse_context_new(&parser, G_MARKUP_TREAT_CDATA_AS_TEXT, texts, NULL);
  g_autoptr(GError) problem = NULL;
  return (g_markup_parse_context_parse(context, xml + mark, (gssize)(size - mark), &problem) &&
          g_markup_parse_context_end_parse(context, &problem)) ||
         sb_app_error_input(error, "main.xml: %s", problem->message);
}

// Even steps along an axis, 'x' or 'y': an incremental one.
static bool read_step(double *out, GHashTable *texts, char axis, GError **error) {
  g_autofree char *type = g_strdup_printf("record1/axes/c%c/axistype", axis);
  g_autofree char *step = g_strdup_printf("record1/axes/c%c/increment", axis);
  *out = number(texts, step, NAN);
  if (g_ascii_strcasecmp(text_of(texts, type), "I") != 0) {
    return sb_app_error_input(error,
                              "C%c is not an incremental axis: points at any place are not read",
                              g_ascii_toupper(axis));
  }
  return (isfinite(*out) && *out > 0) ||
         sb_app_error_input(error, "C%c has no increment above 0", g_ascii_toupper(axis));
}

static bool read_points(SbScan *out, GHashTable *texts, zip_t *zip, size_t packed, GError **error) {
  static const char types[] = "ILFD", kinds[] = "hifd";
  const char *link = text_of(texts, "record3/datalink/pointdatalink");
  const char *valid_link = text_of(texts, "record3/datalink/validpointslink");
  const char *feature = text_of(texts, "record1/featuretype"),
             *type = text_of(texts, "record1/axes/cz/datatype");
  const double columns = number(texts, "record3/matrixdimension/sizex", NAN),
               rows = number(texts, "record3/matrixdimension/sizey", 1);
  const double step = number(texts, "record1/axes/cz/increment", 1);
  if (g_ascii_strcasecmp(feature, "SUR") != 0 && g_ascii_strcasecmp(feature, "PRF") != 0) {
    return sb_app_error_input(error, "has the feature type \"%s\" (allowed SUR, PRF)", feature);
  }
  const char *known = strlen(type) == 1 ? strchr(types, g_ascii_toupper(*type)) : NULL;
  if (known == NULL) {
    return sb_app_error_input(error, "CZ has the data type \"%s\" (allowed I, L, F, D)", type);
  }
  if (!(columns >= 1 && rows >= 1 && columns * rows <= (double)SB_HEIGHTS_POINTS_MAX)) {
    return sb_app_error_input(error, "has a matrix of \"%s\" x \"%s\" points",
                              text_of(texts, "record3/matrixdimension/sizex"),
                              text_of(texts, "record3/matrixdimension/sizey"));
  }
  if (number(texts, "record3/matrixdimension/sizez", 1) != 1) {
    return sb_app_error_input(error, "has %s layers (allowed 1)",
                              text_of(texts, "record3/matrixdimension/sizez"));
  }
  if (*link == '\0') {
    return sb_app_error_input(error, "has its points in the XML or as a list, which is not read");
  }
  if (!isfinite(step) || step == 0) {
    return sb_app_error_input(error, "CZ has the increment \"%s\"",
                              text_of(texts, "record1/axes/cz/increment"));
  }
  const size_t points = (size_t)columns * (size_t)rows;
  size_t got = 0, valid_got = 0;
  const bool voids = *valid_link != '\0';
  g_autofree guchar *data = member(zip, link, &got, 8 * points, packed, error);
  g_autofree guchar *valid =
      data != NULL && voids ? member(zip, valid_link, &valid_got, points, packed, error) : NULL;
  if (valid != NULL && valid_got < (points + 7) / 8) {
    return sb_app_error_input(error, "its valid points are cut short");
  }
  if (data == NULL || (valid == NULL && voids) ||
      !sb_scan_take_grid(out, (size_t)columns, (size_t)rows, kinds[known - types],
                         (SbScanBytes){data, data + got}, step, NAN, error)) {
    return false;
  }
  for (size_t i = 0; valid != NULL && i < points; i++) {
    out->heights.z[i] = (valid[i / 8] >> (i % 8) & 1) != 0 ? out->heights.z[i] : NAN;
  }
  return true;
}

bool sb_scan_parse_x3p(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error) {
  const size_t packed = (size_t)(file.end - file.at);
  out->format = "X3P";
  zip_error_t problem;
  zip_error_init(&problem);
  zip_source_t *source = zip_source_buffer_create(file.at, packed, 0, &problem);
  zip_t *zip = source != NULL ? zip_open_from_source(source, ZIP_RDONLY, &problem) : NULL;
  bool good = zip != NULL;
  if (good) {
    g_autoptr(GHashTable) texts = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
    SbHeights *h = &out->heights;
    good = read_main(texts, zip, packed, error) && read_points(out, texts, zip, packed, error) &&
           read_step(&h->dx, texts, 'x', error) &&
           (h->rows == 1 || read_step(&h->dy, texts, 'y', error));
    zip_discard(zip);
  } else {
    zip_source_free(source);
    sb_app_error_input(error, "is not a sound zip: %s", zip_error_strerror(&problem));
  }
  zip_error_fini(&problem);
  return good;
}

// Text files: which of the forms one has, its sizes and units; see scan.h.
#include "app/data/scan/scan_private.h"

#include "app/base/number.h"

#include <math.h>

enum { ENTRIES_MAX = 1000 };

// ---- Header ----

static void entry_free(gpointer data) {
  SbScanEntry *entry = data;
  g_free(entry->key);
  g_free(entry->value);
  g_free(entry->unit);
  g_free(entry);
}

// Returns the text in the first brackets, which are removed; empty without. Owned by the caller.
static char *take_brackets(char *text) {
  char *open = strpbrk(text, "[(");
  char *close = open != NULL ? strpbrk(open, "])") : NULL;
  if (close == NULL) {
    return g_strdup("");
  }
  char *inside = g_strstrip(g_strndup(open + 1, (gsize)(close - open - 1)));
  memmove(open, close + 1, strlen(close + 1) + 1);
  return inside;
}

// Appends the entry of a header line: "Width: 5 µm", "x-pixels = 512", "ncols 512", "Length,64 µm".
static void take_entry(GPtrArray *entries, const char *line, const SbTextTableDialect *dialect) {
  const char separator[] = {dialect->separator, '\0'};
  gsize at = strcspn(line, "=:");
  at = line[at] == '\0' ? strcspn(line, separator) : at;
  at = line[at] == '\0' ? strcspn(line, " ") : at;
  if (line[at] == '\0' || at == 0) {
    return;
  }
  g_autofree char *key = g_strndup(line, at);
  SbScanEntry *entry = g_new0(SbScanEntry, 1);
  entry->unit = take_brackets(key);
  g_autofree char *folded = g_utf8_strdown(key, -1);
  GString *plain = g_string_new(NULL);
  for (const char *c = folded; *c != '\0'; c = g_utf8_next_char(c)) {
    const gunichar letter = g_utf8_get_char(c);
    if (g_unichar_isalnum(letter)) {
      g_string_append_unichar(plain, letter);
    }
  }
  entry->key = g_string_free(plain, FALSE);
  entry->value = g_strstrip(g_strdup(line + at + 1));
  const gsize number = sb_text_table_number_at(&entry->number, entry->value, dialect->decimal);
  entry->number = number > 0 ? entry->number : NAN;
  if (number > 0 && *entry->unit == '\0') {
    g_free(entry->unit);
    entry->unit = g_strstrip(g_strdup(entry->value + number));
  }
  g_ptr_array_add(entries, entry);
}

// Returns the entry of the first of the patterns (separated by |, * for any letters) that the
// header has; NULL without.
static const SbScanEntry *find(const SbScanText *text, const char *patterns) {
  g_auto(GStrv) each = g_strsplit(patterns, "|", -1);
  for (char **pattern = each; *pattern != NULL; pattern++) {
    for (guint i = 0; i < text->entries->len; i++) {
      const SbScanEntry *entry = text->entries->pdata[i];
      if (g_pattern_match_simple(*pattern, entry->key)) {
        return entry;
      }
    }
  }
  return NULL;
}

static double number_of(const SbScanEntry *entry) {
  return entry != NULL ? entry->number : NAN;
}

// What the header says of a matrix; NaN or 0 where it does not.
typedef struct {
  double columns, rows;
  double width, height; // with their units, or in the unit of lengths (`bare`)
  double step_x, step_y;
  double missing;           // value of missing points, as written
  double vertical, lateral; // units [m]
  double factor;            // of written heights; NaN: none
  gboolean bare;
} Header;

// A length by itself where it has a unit, else in units of lengths.
static double length_of(const SbScanEntry *entry, gboolean *bare) {
  const double value = number_of(entry);
  const double unit = entry != NULL ? sb_scan_length(entry->unit) : 0;
  if (!isnan(value) && unit == 0) {
    *bare = TRUE;
  }
  return unit > 0 ? value * unit : value;
}

static double unit_of(const SbScanText *text, const char *names) {
  const SbScanEntry *entry = find(text, names);
  return entry != NULL ? sb_scan_length(entry->value) : 0;
}

static Header header_of(const SbScanText *text) {
  Header h = {0};
  h.columns = number_of(find(text, "ncols|xpixels|columns|pixelsx|spalten|colonnes|colonne"));
  h.rows = number_of(find(text, "nrows|ypixels|rows|lines|pixelsy|zeilen|lignes|righe"));
  h.step_x = length_of(
      find(text, "cellsize|dx|xspacing|xstep|xscale|pixelsize|spacing|schrittweite|pas|passo"),
      &h.bare);
  h.step_y = length_of(
      find(text, "cellsize|dy|yspacing|ystep|yscale|pixelsize|spacing|schrittweite|pas|passo"),
      &h.bare);
  h.width = length_of(
      find(text, "xlength|width|xsize|xreal|xrange|breite|largeur|larghezza|ancho*"), &h.bare);
  h.height = length_of(
      find(text, "ylength|height|ysize|yreal|yrange|höhe|hauteur|altezza|altura|alto"), &h.bare);
  h.missing = number_of(find(text, "nodatavalue|nodata|fehlwert"));
  h.vertical = unit_of(text, "zunit*|valueunit*|heightunit*|unitz|*einheit*wert*|wert*einheit*|"
                             "*unit*val*|einheitz|zeinheit|unitéz|unitàz");
  h.lateral = unit_of(text, "xunit*|lateralunit*|xyunit*|unitxy|unitx|einheitx*|xeinheit|unitéx*|"
                            "unitàx*");
  // A factor of the written heights, with its own unit or in the unit of heights.
  const SbScanEntry *factor = find(
      text, "zfactor|zscale|zscaling|heightfactor|heightscale|factor*|scalefactor|*skalierung*|"
            "höhenfaktor|zfaktor|facteur*|fattore*|bit2nm|*faktor");
  const double unit = factor != NULL ? sb_scan_length(factor->unit) : 0;
  h.factor = number_of(factor);
  h.vertical = unit > 0 && isfinite(h.factor) ? unit : h.vertical;
  // SPIP's lengths are in nanometres; so are its heights times Bit2nm where no unit is given.
  const SbScanEntry *format = find(text, "fileformat");
  if (format != NULL && g_ascii_strcasecmp(format->value, "ASCII") == 0) {
    h.lateral = h.lateral > 0 ? h.lateral : 1e-9;
    const gboolean bits = factor != NULL && strcmp(factor->key, "bit2nm") == 0;
    h.factor = bits && h.vertical > 0 ? NAN : h.factor;
    h.vertical = bits && h.vertical == 0 ? 1e-9 : h.vertical;
  }
  return h;
}

// Metres per unit of a column by the header; 0 without.
static double column_unit(const SbScanText *text, gsize column) {
  return sb_scan_length(sb_text_table_column(text->table, column)->unit);
}

// Units by precedence: the caller's, the file's, for lengths the caller's of heights. The caller's
// unit is that of the numbers as written: it replaces the header's factor too, which a note states.
// FALSE with an error where one is needed and nowhere.
static gboolean find_units(Header *h, SbScan *out, const SbScanText *text,
                           const SbScanChoices *choices, gboolean needs_lateral, GError **error) {
  if (text->columns <= 3 && h->vertical == 0) {
    h->vertical = column_unit(text, text->columns - 1);
    h->lateral = h->lateral > 0 || text->columns == 1 ? h->lateral : column_unit(text, 0);
    if (text->columns == 3 && column_unit(text, 1) != h->lateral && column_unit(text, 1) > 0) {
      return sb_scan_fail(error, text->name, "x and y have different units");
    }
  }
  if (choices->unit > 0 && isfinite(h->factor)) {
    g_ptr_array_add(out->notes,
                    g_strdup_printf("the header's height factor %g is not used: the unit of the "
                                    "heights was specified",
                                    h->factor));
    h->factor = NAN;
  }
  h->vertical = choices->unit > 0 ? choices->unit : h->vertical;
  h->lateral = choices->lateral_unit > 0 ? choices->lateral_unit
               : h->lateral > 0          ? h->lateral
                                         : choices->unit;
  if (h->vertical == 0) {
    return sb_scan_fail(error, text->name,
                        "does not state the unit of its heights: specify it with --unit");
  }
  if (needs_lateral && h->lateral == 0) {
    return sb_scan_fail(error, text->name,
                        "does not state the unit of its lengths: specify it with --lateral-unit");
  }
  if (isfinite(h->factor)) {
    g_ptr_array_add(out->notes,
                    g_strdup_printf("heights are multiplied by the header's factor %g", h->factor));
    h->vertical *= h->factor;
  }
  return TRUE;
}

static gboolean read_matrix(SbScan *out, SbScanText *text, const SbScanChoices *choices,
                            GError **error) {
  Header h = header_of(text);
  const double *value = (const double *)(const void *)text->numbers->data;
  const gboolean announced = h.columns >= 1 && h.rows >= 1;
  if (announced && h.columns * h.rows != (double)text->numbers->len) {
    return sb_scan_fail(error, text->name, "%u numbers where the header announces %.0f x %.0f",
                        text->numbers->len, h.columns, h.rows);
  }
  if (!announced && text->ragged > 0) {
    return sb_scan_fail(error, text->name,
                        "line %d has not %" G_GSIZE_FORMAT " numbers as the first", text->ragged,
                        text->columns);
  }
  if (!find_units(&h, out, text, choices, h.bare && !(choices->spacing > 0), error) ||
      !sb_scan_allocate(out, announced ? (guint64)h.columns : text->columns,
                        announced ? (guint64)h.rows : text->rows, text->name, error)) {
    return FALSE;
  }
  SbHeights *to = &out->heights;
  for (gsize i = 0; i < to->columns * to->rows; i++) {
    to->z[i] = value[i] == h.missing ? NAN : value[i] * h.vertical;
  }
  const double lateral = h.bare ? h.lateral : 1;
  to->dx = lateral * (isnan(h.step_x) ? h.width / (double)to->columns : h.step_x);
  to->dy = lateral * (isnan(h.step_y) ? h.height / (double)to->rows : h.step_y);
  if (!(to->dx > 0 && to->dy > 0) && !(choices->spacing > 0)) {
    return sb_scan_fail(error, text->name,
                        "does not state the distance of its points: specify it with --spacing");
  }
  return TRUE;
}

static gboolean read_text(SbScan *out, SbScanText *text, const SbScanChoices *choices,
                          GError **error) {
  const Header sizes = header_of(text);
  const gboolean sized =
      isfinite(sizes.columns) || (text->columns > 2 && (isfinite(sizes.width + sizes.height) ||
                                                        isfinite(sizes.step_x + sizes.step_y)));
  out->format = sized ? "text, a matrix with a header" : "text";
  const SbScanEntry *title = find(text, "channel|title|kanal|canal|canale|titel|titre|titolo");
  out->title = title != NULL ? g_strdup(title->value) : NULL;
  const gboolean points =
      !sized && text->columns == 3 && text->ragged == 0 && sb_scan_is_grid(text);
  if (sized || (text->columns > 2 && !points)) {
    return read_matrix(out, text, choices, error);
  }
  if (text->ragged > 0) {
    return sb_scan_fail(error, text->name,
                        "line %d has not %" G_GSIZE_FORMAT " numbers as the first", text->ragged,
                        text->columns);
  }
  Header h = header_of(text);
  if (!find_units(&h, out, text, choices, text->columns > 1, error)) {
    return FALSE;
  }
  const double missing = h.missing;
  for (gsize i = 0; i < text->rows; i++) {
    double *z = &g_array_index(text->numbers, double, (i + 1) * text->columns - 1);
    *z = *z == missing ? NAN : *z;
  }
  if (points) {
    out->format = "text, x y z on a grid";
    return sb_scan_grid(out, text, h.lateral, h.vertical, error);
  }
  out->format = text->columns == 2 ? "text, a profile x z" : "text, a profile";
  if (!sb_scan_profile(out, text, h.lateral, h.vertical, error)) {
    return FALSE;
  }
  if (text->columns == 1 && !(choices->spacing > 0)) {
    return sb_scan_fail(error, text->name,
                        "does not state the distance of its points: specify it with --spacing");
  }
  return TRUE;
}

// Numbers at the end of single precision mark void points.
static void drop_voids(GArray *numbers) {
  const double low = 0x1p127 * (1 - 1e-4), high = 0x1p128;
  for (guint i = 0; i < numbers->len; i++) {
    double *value = &g_array_index(numbers, double, i);
    *value = fabs(*value) >= low && fabs(*value) <= high ? NAN : *value;
  }
}

gboolean sb_scan_parse_text(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                            GError **error) {
  static const SbTextTableDialect wish = {.matrix = true};
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbTextTable) table =
      sb_text_table_parse(bytes.at, (gsize)(bytes.end - bytes.at), &wish, bytes.name, issues);
  SbTextTableMatrix matrix;
  if (table == NULL || !sb_text_table_read_matrix(&matrix, table, SB_HEIGHTS_POINTS_MAX, issues)) {
    const SbIssue *issue = issues->pdata[0];
    return issue->line > 0
               ? sb_scan_fail(error, bytes.name, "line %d: %s", issue->line, issue->text)
               : sb_scan_fail(error, bytes.name,
                              "is not a scan that is known (text, .gwy, .sur, .sdf or .x3p): it %s",
                              issue->text);
  }
  SbScanText text = {.name = bytes.name,
                     .entries = g_ptr_array_new_with_free_func(entry_free),
                     .table = table,
                     .numbers = matrix.value,
                     .rows = matrix.rows,
                     .columns = matrix.columns,
                     .ragged = matrix.ragged};
  drop_voids(text.numbers);
  char *const *line = sb_text_table_header(table);
  for (; *line != NULL && text.entries->len < ENTRIES_MAX; line++) {
    take_entry(text.entries, *line, sb_text_table_dialect(table));
  }
  const gboolean good = read_text(out, &text, choices, error);
  g_ptr_array_unref(text.entries);
  g_array_unref(text.numbers);
  return good;
}

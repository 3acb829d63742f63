// Text files: which of the forms one has, its sizes and units; see scan.h.
#include "app/data/scan/scan_private.h"

#include "app/base/number.h"

#include <math.h>
#include <string.h>

enum { ENTRIES_MAX = 1000 };

#define SB_SCAN_KEY(name, expression) static const char KEY_##name[] = expression;
#include "app/data/scan/scan_text_keys.def"
#undef SB_SCAN_KEY

// ---- Header ----

static void entry_free(gpointer data) {
  SbScanEntry *entry = data;
  g_free(entry->name);
  g_free(entry->key);
  g_free(entry->value);
  g_free(entry);
}

// Appends the entry of a header line: "Width: 5 µm", "Z factor;2.5", "Length,64 µm", "ncols 512".
static void take_entry(GPtrArray *entries, const char *line, int number,
                       const SbTextTableDialect *dialect) {
  static const char *const forms[] = {"^(.+?)[=:;|][=:;| ]*(.*)$", "^(.+?),(.*)$",
                                      "^(.+?) ([-+]?[0-9].*)$", "^(.+?) (.*)$"};
  g_autofree char *key = NULL, *value = NULL;
  for (size_t i = 0; i < G_N_ELEMENTS(forms) && key == NULL; i++) {
    g_autoptr(GRegex) form = g_regex_new(forms[i], 0, 0, NULL);
    g_autoptr(GMatchInfo) match = NULL;
    if ((i != 1 || dialect->separator == ',') && g_regex_match(form, line, 0, &match)) {
      key = g_match_info_fetch(match, 1);
      value = g_match_info_fetch(match, 2);
    }
  }
  if (key == NULL) {
    return;
  }
  SbScanEntry *entry = g_new0(SbScanEntry, 1);
  char *bracket = key + strcspn(key, "[(");
  entry->unit = *bracket != '\0' ? sb_scan_length(bracket) : 0;
  *bracket = entry->unit > 0 ? '\0' : *bracket;
  g_autofree char *folded = g_utf8_strdown(key, -1);
  entry->line = number;
  g_autoptr(GRegex) marks = g_regex_new("[^\\pL\\pN]+", 0, 0, NULL);
  entry->name = g_strstrip(g_regex_replace_literal(marks, folded, -1, 0, " ", 0, NULL));
  g_auto(GStrv) words = g_strsplit(entry->name, " ", -1);
  entry->key = g_strjoinv("", words);
  entry->value = g_strstrip(g_strdelimit(g_strdup(value), ";|", ' '));
  const gsize end = sb_text_table_number_at(&entry->number, entry->value, dialect->decimal);
  entry->number = end > 0 ? entry->number : NAN;
  const char *rest = entry->value + end + strspn(entry->value + end, " ");
  if (end > 0 && entry->unit == 0) { // "32 px", "32 points"
    const double unit = sb_scan_length(rest);
    entry->unit = unit == 0 && g_ascii_tolower(*rest) == 'p' ? NAN : unit;
  }
  g_ptr_array_add(entries, entry);
}

// Returns the first entry that a key matches, an empty one without; of a `length` the first with a
// unit, else the first number that is not one of points.
static const SbScanEntry *find_entry(const SbScanText *text, const char *key, bool length) {
  static const SbScanEntry none = {(char *)"", (char *)"", (char *)"", NAN, 0, 0};
  const SbScanEntry *found = &none;
  for (guint i = 0; i < text->entries->len; i++) {
    const SbScanEntry *entry = text->entries->pdata[i];
    const bool fits = g_regex_match_simple(key, entry->key, 0, 0);
    if (fits && (!length || entry->unit > 0)) {
      return entry;
    }
    const bool bare = isfinite(entry->number) && entry->unit == 0;
    found = fits && bare && found == &none ? entry : found;
  }
  return found;
}

// Finds the columns x, y and z by their names. Of two or three columns, those
// with other names are the remaining ones in this order. False with an error if two columns may be
// one of them, or if the places form no grid.
static bool find_columns(SbScan *out, SbScanText *text, GError **error) {
  static const char *const keys[] = {KEY_X, KEY_Y, KEY_Z};
  const gsize columns = text->table->columns, none = SB_TEXT_TABLE_COLUMNS_MAX;
  gsize use[3] = {none, none, none}, twice[3] = {none, none, none}, other[3], others = 0;
  for (gsize i = 0; i < columns; i++) {
    int axis = 0;
    const char *name = text->table->column[i].name;
    while (axis < 3 && !g_regex_match_simple(keys[axis], name, G_REGEX_CASELESS, 0)) {
      axis += columns == 2 ? 2 : 1;
    }
    if (axis < 3) {
      twice[axis] = use[axis];
      use[axis] = i;
    } else if (others < 3) {
      other[others++] = i;
    }
  }
  const bool few = columns <= 3, between = use[1] == none && use[2] < none;
  if (columns != text->matrix.columns || columns < 2 ||
      (few ? others == columns : MAX(use[0], use[2]) == none)) {
    return true;
  }
  for (int axis = 0, next = 0; axis < 3; axis++) {
    if (twice[axis] < none) {
      return sb_app_error_input(error, "columns %zu and %zu may both be %c: remove one",
                                twice[axis] + 1, use[axis] + 1, "xyz"[axis]);
    }
    if (few && use[axis] == none && (axis != 1 || columns == 3)) {
      use[axis] = other[next++];
    }
  }
  memcpy(text->use, use, sizeof use);
  text->axes = use[1] < none ? 3 : 2;
  if (text->axes == 3 && !sb_scan_is_grid(text)) {
    if (!between) {
      return sb_app_error_input(error, "x and y of its points form no grid of equal steps");
    }
    text->axes = 2;
  }
  text->use[1] = text->axes == 2 ? use[2] : use[1];
  if (columns > text->axes || use[0] != 0 || text->use[1] != 1) {
    sb_note_add(out->notes, "the columns are used by their names: x is number %zu, z number %zu",
                use[0] + 1, use[2] + 1);
  }
  return true;
}

// What the header says of a matrix; NaN or 0 where it does not.
typedef struct {
  double columns, rows;
  double step[2];           // of x and y [m], or in a unit (`bare`)
  bool bare[2];             // `step` is in the unit of lengths
  double missing;           // value of missing points, as written
  double vertical, lateral; // units [m]
  double factor;            // of written heights; NaN: none
  double usual;             // unit of the format [m]; 0: none
} Header;

// Takes the step along an axis, 0 or 1, or the size divided by the number of points (NaN: not by
// the size). What has a unit takes precedence. A size without a unit that equals the number of
// points states that number.
static void take_step(Header *h, const SbScanText *text, int axis, double count) {
  const SbScanEntry *step = find_entry(text, axis == 0 ? KEY_STEP_X : KEY_STEP_Y, true);
  const SbScanEntry *size = find_entry(text, axis == 0 ? KEY_SIZE_X : KEY_SIZE_Y, true);
  const bool by_size = step->unit == 0 && (size->unit > 0 || isnan(step->number));
  const SbScanEntry *use = by_size ? size : step;
  const bool counts = by_size && use->unit == 0 && use->number == count && h->lateral == 0;
  h->step[axis] = counts ? NAN : use->unit > 0 ? use->number * use->unit : use->number;
  h->step[axis] /= by_size ? count : 1;
  h->bare[axis] = isfinite(h->step[axis]) && use->unit == 0;
}

static Header header_of(const SbScanText *text) {
  const SbTextTableMatrix *matrix = &text->matrix;
  Header h = {.columns = find_entry(text, KEY_COLUMNS, false)->number,
              .rows = find_entry(text, KEY_ROWS, false)->number,
              .missing = find_entry(text, KEY_MISSING, false)->number,
              .vertical = sb_scan_length(find_entry(text, KEY_UNIT_Z, false)->value),
              .lateral = sb_scan_length(find_entry(text, KEY_UNIT_XY, false)->value)};
  // SPIP's lengths are in nanometres, those of surface data files in metres.
  h.usual = g_ascii_strcasecmp(find_entry(text, KEY_FORMAT, false)->value, "ASCII") == 0 ? 1e-9
            : isfinite(find_entry(text, KEY_METRES, false)->number)                      ? 1
                                                                                         : 0;
  h.lateral = h.lateral > 0 ? h.lateral : h.usual;
  // A size may be one step more than the distance between the ends of a profile.
  const double columns = h.columns >= 1 ? h.columns : (double)matrix->columns;
  take_step(&h, text, 0, matrix->columns == 1 ? NAN : columns);
  take_step(&h, text, 1, h.rows >= 1 ? h.rows : (double)matrix->rows);
  return h;
}

// Takes the factor of written heights, with its own unit or in the unit of heights. False with an
// error if a line may state one, unless the caller specified the unit of the written numbers.
static bool take_factor(Header *h, SbScan *out, const SbScanText *text,
                        const SbScanChoices *choices, GError **error) {
  const SbScanEntry *factor = NULL, *doubt = NULL, *resolution = NULL;
  for (guint i = 0; i < text->entries->len && factor == NULL; i++) {
    const SbScanEntry *entry = text->entries->pdata[i];
    if (isfinite(entry->number) && entry->number != 0 &&
        g_regex_match_simple(KEY_RESOLUTION, entry->name, 0, 0)) {
      resolution = entry;
    } else if (isfinite(entry->number) && entry->number != 0 &&
               !g_regex_match_simple(KEY_OTHER, entry->name, 0, 0)) {
      factor = g_regex_match_simple(KEY_FACTOR, entry->name, 0, 0) ? entry : NULL;
      doubt = doubt == NULL && entry->number != 1 &&
                      g_regex_match_simple(KEY_PERHAPS, entry->name, 0, 0)
                  ? entry
                  : doubt;
    }
  }
  if (factor == NULL && doubt != NULL && choices->unit == 0) {
    return sb_app_error_choose(error, "unit", "nm\num\nmm",
                               "line %d: it is not clear whether \"%s\" multiplies the heights, "
                               "which decides the unit of the numbers",
                               doubt->line, doubt->name);
  }
  resolution = doubt != NULL ? doubt : resolution;
  if (factor == NULL && resolution != NULL) {
    sb_note_add(out->notes, "line %d: \"%s\" %s does not multiply the heights", resolution->line,
                resolution->name, resolution->value);
  }
  h->factor = factor != NULL ? factor->number : NAN;
  h->vertical = factor != NULL && factor->unit > 0 ? factor->unit : h->vertical;
  // The factors of these formats are in this unit, Bit2nm only where no unit is given.
  const bool bits = factor != NULL && strcmp(factor->key, "bit2nm") == 0;
  h->factor = bits && h->vertical > 0 ? NAN : h->factor;
  h->vertical = factor == NULL || h->vertical > 0 ? h->vertical : bits ? 1e-9 : h->usual;
  return true;
}

// Settles a unit by precedence: the caller's, the header's, that of the column's name. Returns
// false with an error that `key` resolves if the latter two differ, or if it is needed and unknown.
static bool settle_unit(double *unit, double column, double chosen, bool needed, const char *key,
                        const char *what, GError **error) {
  const bool two = *unit > 0 && column > 0 && *unit != column && chosen == 0;
  *unit = chosen > 0 ? chosen : *unit > 0 ? *unit : column;
  return !(two || (needed && *unit == 0)) ||
         sb_app_error_choose(
             error, key, "nm\num\nmm",
             two ? "states two units of its %s" : "does not state the unit of its %s", what);
}

// The caller's unit of heights is that of the numbers as written: it replaces the header's factor
// too, which a note states. Without any other, it is the unit of lengths. False with an error.
static bool find_units(Header *h, SbScan *out, const SbScanText *text, const SbScanChoices *choices,
                       bool needs_lateral, GError **error) {
  const gsize columns = text->axes, *use = text->use;
  const SbTextTableColumn *column = text->table->column;
  const double x = columns > 1 && columns <= 3 ? sb_scan_length(column[use[0]].unit) : 0;
  const double y = columns == 3 ? sb_scan_length(column[use[1]].unit) : 0;
  const double z = columns <= 3 ? sb_scan_length(column[use[columns - 1]].unit) : 0;
  if (y > 0 && y != x) {
    return sb_app_error_input(error, "x and y have different units");
  }
  if (choices->unit > 0 && isfinite(h->factor)) {
    sb_note_add(out->notes,
                "the header's height factor %g is not used: the unit of the heights was specified",
                h->factor);
    h->factor = NAN;
  }
  h->lateral = h->lateral == 0 && x == 0 ? choices->unit : h->lateral;
  if (!settle_unit(&h->vertical, z, choices->unit, true, "unit", "heights", error) ||
      !settle_unit(&h->lateral, x, choices->lateral_unit, needs_lateral, "lateral-unit", "lengths",
                   error)) {
    return false;
  }
  if (isfinite(h->factor)) {
    sb_note_add(out->notes, "heights are multiplied by the header's factor %g", h->factor);
    h->vertical *= h->factor;
  }
  return true;
}

static bool take_matrix(SbScan *out, const SbScanText *text, const Header *h, GError **error) {
  const bool announced = h->columns >= 1 && h->rows >= 1;
  SbHeights *to = &out->heights;
  if (!sb_scan_allocate(out, announced ? (guint64)h->columns : text->matrix.columns,
                        announced ? (guint64)h->rows : text->matrix.rows, error)) {
    return false;
  }
  for (gsize i = 0; i < to->columns * to->rows; i++) {
    to->z[i] = g_array_index(text->matrix.value, double, i) * h->vertical;
  }
  to->dx = h->step[0] * (h->bare[0] ? h->lateral : 1);
  to->dy = h->step[1] * (h->bare[1] ? h->lateral : 1);
  return true;
}

static bool read_entry_text(SbScan *out, SbScanText *text, const SbScanChoices *choices,
                            GError **error) {
  Header h = header_of(text);
  const SbScanEntry *title = find_entry(text, KEY_TITLE, false);
  const bool sized =
      isfinite(h.columns) || (text->matrix.columns > 2 && isfinite(h.step[0] + h.step[1]));
  if (!sized && text->matrix.ragged == 0 && !find_columns(out, text, error)) {
    return false;
  }
  const gsize columns = text->axes;
  const bool points = !sized && columns == 3 && text->matrix.ragged == 0 && sb_scan_is_grid(text);
  const bool matrix = sized || (columns > 2 && !points), spaced = choices->spacing > 0;
  out->title = *title->key != '\0' ? g_strdup(title->value) : NULL;
  out->format = sized          ? "text, a matrix with a header"
                : matrix       ? "text"
                : points       ? "text, x y z on a grid"
                : columns == 2 ? "text, a profile x z"
                               : "text, a profile";
  const bool announced = h.columns >= 1 && h.rows >= 1;
  if (matrix && announced) {
    if (h.columns * h.rows != (double)text->matrix.value->len) {
      return sb_app_error_input(error, "%u numbers where the header announces %.0f x %.0f",
                                text->matrix.value->len, h.columns, h.rows);
    }
  } else if (text->matrix.ragged > 0) {
    return sb_app_error_input(error, "line %d has not %zu numbers as the first",
                              text->matrix.ragged, columns);
  }
  const char *placed = matrix ? sb_scan_placed(text, announced) : NULL;
  if (placed != NULL) {
    return sb_app_error_input(error,
                              "its first %s has even steps, as positions have and "
                              "heights have not: remove the positions",
                              placed);
  }
  const bool bare = !spaced && (h.bare[0] || (matrix && h.bare[1]));
  if (!take_factor(&h, out, text, choices, error) ||
      !find_units(&h, out, text, choices, matrix || columns == 1 ? bare : true, error)) {
    return false;
  }
  // Heights are in the last column; those at the end of single precision mark void points.
  const gsize step = matrix ? 1 : text->matrix.columns;
  const double low = 0x1p127 * (1 - 1e-4), high = 0x1p128;
  for (gsize i = matrix ? 0 : text->use[columns - 1]; i < text->matrix.value->len; i += step) {
    double *z = &g_array_index(text->matrix.value, double, i);
    *z = *z == h.missing || (fabs(*z) >= low && fabs(*z) <= high) ? NAN : *z;
  }
  if (!(matrix   ? take_matrix(out, text, &h, error)
        : points ? sb_scan_grid(out, text, h.lateral, h.vertical, error)
                 : sb_scan_profile(out, text, h.lateral, h.vertical, error))) {
    return false;
  }
  if (columns == 1) {
    out->heights.dx = h.step[0] * (h.bare[0] ? h.lateral : 1);
  }
  return spaced || (out->heights.dx > 0 && (!matrix || out->heights.dy > 0)) ||
         sb_app_error_choose(error, "spacing", NULL, "does not state the distance of its points");
}

bool sb_scan_parse_text(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                        GError **error) {
  const SbTextTableDialect wish = {.matrix = true, .decimal = choices->decimal};
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(GPtrArray) entries = g_ptr_array_new_with_free_func(entry_free);
  g_autoptr(SbTextTable) table =
      sb_text_table_parse(bytes.at, (gsize)(bytes.end - bytes.at), &wish, "", issues);
  SbScanText text = {.entries = entries, .table = table, .use = {0, 1, 2}};
  const bool read = table != NULL &&
                    sb_text_table_read_matrix(&text.matrix, table, SB_HEIGHTS_POINTS_MAX, issues);
  if (!read) {
    const SbIssue *issue = issues->pdata[0];
    return issue->choice.key != NULL || issue->line > 0
               ? sb_issue_error(error, issue)
               : sb_app_error_input(
                     error, "is not a scan that is known (text, .gwy, .sur, .sdf or .x3p): it %s",
                     issue->text);
  }
  for (int i = 0; table->header[i] != NULL && entries->len < ENTRIES_MAX; i++) {
    take_entry(entries, table->header[i], i + 1, &table->dialect);
  }
  if (text.matrix.other > 0) {
    sb_note_add(out->notes, "%zu rows of numbers are not read, as they are another table (line %d)",
                text.matrix.other, text.matrix.other_line);
  }
  text.axes = text.matrix.columns;
  const bool good = read_entry_text(out, &text, choices, error);
  g_array_unref(text.matrix.value);
  return good;
}

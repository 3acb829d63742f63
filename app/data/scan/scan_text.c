// Text files: which of the forms one has, its sizes and units; see scan.h.
#include "app/data/scan/scan_private.h"

#include "app/base/number.h"

#include <stdlib.h>

enum { ENTRIES_MAX = 1000 };

#define SB_SCAN_KEY(name, expression) static const char KEY_##name[] = expression;
#include "app/data/scan/scan_text_keys.def"
#undef SB_SCAN_KEY

// A header line "key = value unit".
typedef struct {
  char *name;    // the key in small letters, with blanks for marks
  char *key;     // without blanks: "Z Unit" is "zunit"
  char *value;   // as it is in the file
  double number; // with which the value begins; NaN: none
  bool times;    // a multiplication sign is before the number, of a factor of the heights
  double unit;   // metres of the one in brackets in the key or after a number; 0: no length; NaN:
                 // the number counts points
  int line;      // from 1
} Entry;

// A text file split into the entries of its header and all its numbers.
typedef struct {
  GPtrArray *entries;       // of Entry
  const SbTextTable *table; // its columns and their units
  SbTextTableMatrix matrix; // its numbers
  gsize axes, use[3];       // columns in use: x, y, z; x, z; or z; above 3: a matrix
} Text;

static void entry_free(gpointer data) {
  Entry *entry = data;
  g_free(entry->name);
  g_free(entry->key);
  g_free(entry->value);
  g_free(entry);
}

// Appends the entry of a header line: "Width: 5 µm", "Z factor;2.5", "Length,64 µm", "ncols 512".
static void take_entry(GPtrArray *entries, const char *line, int number,
                       const SbTextTableDialect *dialect) {
  g_autofree char *form =
      g_strconcat("^(?|(.+?)[=:;|][=:;| ]*(.*)|", dialect->separator == ',' ? "(.+?),(.*)|" : "",
                  "(.+?) ([-+]?[0-9].*)|(.+?) (.*))$", NULL);
  g_autoptr(GRegex) forms = g_regex_new(form, 0, 0, NULL);
  g_autoptr(GMatchInfo) match = NULL;
  g_autofree char *plain = *line == '"' ? g_strdelimit(g_strdup(line), "\"", ' ') : g_strdup(line);
  if (!g_regex_match(forms, plain, 0, &match)) {
    return;
  }
  g_autofree char *key = g_match_info_fetch(match, 1);
  Entry *entry = g_new0(Entry, 1);
  char *bracket = key + strcspn(key, "[(");
  entry->unit = *bracket != '\0' ? sb_scan_length(bracket) : 0;
  *bracket = entry->unit > 0 ? '\0' : *bracket;
  g_autofree char *folded = g_utf8_strdown(key, -1);
  entry->line = number;
  g_autoptr(GRegex) marks = g_regex_new("[^\\pL\\pN]+", 0, 0, NULL);
  entry->name = g_strstrip(g_regex_replace_literal(marks, folded, -1, 0, " ", 0, NULL));
  g_auto(GStrv) words = g_strsplit(entry->name, " ", -1);
  entry->key = g_strjoinv("", words);
  entry->value = g_strstrip(g_strdelimit(g_match_info_fetch(match, 2), ";|", ' '));
  const gsize sign = strspn(entry->value, "x*\xc3\x97 ");
  entry->times = sign > 0 && g_regex_match_simple(KEY_HIGH, entry->name, 0, 0);
  const char *rest = entry->value + (entry->times ? sign : 0);
  const gsize end = sb_text_table_number_at(&entry->number, rest, dialect->decimal);
  entry->number = end > 0 ? entry->number : NAN;
  rest += end + strspn(rest + end, " ");
  if (end > 0 && entry->unit == 0) { // "32 px", "32 points"
    const double unit = sb_scan_length(rest);
    entry->unit = unit == 0 && g_ascii_tolower(*rest) == 'p' ? NAN : unit;
  }
  g_ptr_array_add(entries, entry);
}

// Returns the first entry that a key matches, an empty one without; of a `length` the first with a
// unit, else the first number that is not one of points.
static const Entry *find_entry(const Text *text, const char *key, bool length) {
  static const Entry none = {(char *)"", (char *)"", (char *)"", .number = NAN};
  const Entry *found = &none;
  for (guint i = 0; i < text->entries->len; i++) {
    const Entry *entry = text->entries->pdata[i];
    const bool fits = !entry->times && g_regex_match_simple(key, entry->key, 0, 0);
    if (fits && (!length || entry->unit > 0)) {
      return entry;
    }
    const bool bare = isfinite(entry->number) && entry->unit == 0;
    found = fits && bare && found == &none ? entry : found;
  }
  return found;
}

// A step may differ by this part of the mean one: coordinates are rounded.
static const double uneven_max = 0.02;

// The number of a row for an axis in use.
static double at(const Text *text, gsize row, gsize axis) {
  return g_array_index(text->matrix.value, double, row * text->matrix.columns + text->use[axis]);
}

// Even places along an axis; count 0 where there are none.
typedef struct {
  double first, step;
  gsize count;
} Axis;

// Of the `rows` numbers from `first`, each `stride` behind the last.
static Axis find_axis(const Text *text, gsize first, gsize stride, gsize rows) {
  g_autofree double *value = g_try_new(double, rows);
  bool good = value != NULL;
  for (gsize i = 0; good && i < rows; i++) {
    value[i] = g_array_index(text->matrix.value, double, first + stride * i);
    good = isfinite(value[i]);
  }
  if (!good) {
    return (Axis){0};
  }
  qsort(value, rows, sizeof *value, sb_number_compare);
  const double range = value[rows - 1] - value[0];
  double least = INFINITY, most = 0, last = value[0];
  gsize count = 1;
  for (gsize i = 1; i < rows; i++) {
    const double gap = value[i] - last;
    if (gap > 1e-6 * range) {
      least = fmin(least, gap);
      most = fmax(most, gap);
      last = value[i];
      count++;
    }
  }
  good = count > 1 && isfinite(range) && most - least <= 2 * uneven_max * most;
  return good ? (Axis){value[0], range / (double)(count - 1), count} : (Axis){0};
}

// Finds the axes of the grid whose coordinates are the first two of three columns; false: of none.
static bool find_grid(Axis axis[2], const Text *text) {
  const gsize rows = text->matrix.rows;
  for (int k = 0; k < 2; k++) {
    axis[k] = find_axis(text, text->use[k], text->matrix.columns, rows);
  }
  // Of a matrix of three columns the first two do not repeat themselves evenly.
  return MIN(axis[0].count, axis[1].count) > 1 && MAX(axis[0].count, axis[1].count) < rows &&
         (double)axis[0].count * (double)axis[1].count <= 4.0 * (double)rows;
}

// Returns "column" or "row" if the first one of a matrix has even steps, as positions have and
// heights not; NULL: neither. A first row is not one of positions if the header states the number
// of heights (`announced`), or if the second one has even steps too, as an inclined plane has.
static const char *positions(const Text *text, bool announced) {
  const gsize rows = text->matrix.rows, columns = text->matrix.columns;
  if (text->matrix.ragged > 0) {
    return NULL;
  }
  // One place may be void, where the row and the column of positions meet.
  const bool column = rows > 8 && find_axis(text, 0, columns, rows).count + 1 >= rows;
  const bool row = columns > 8 && rows > 1 && !announced &&
                   find_axis(text, 0, 1, columns).count + 1 >= columns &&
                   find_axis(text, columns, 1, columns).count + 1 < columns;
  return column ? "column" : row ? "row" : NULL;
}

// Writes points x, y, z to their grid; NaN: no point. `lateral`: metres per unit of x and y.
static bool take_grid(SbScan *out, const Text *text, const Axis axis[2], double lateral,
                      GError **error) {
  const Axis x = axis[0], y = axis[1];
  if (!sb_scan_allocate(out, x.count, y.count, error)) {
    return false;
  }
  for (gsize k = 0; k < x.count * y.count; k++) {
    out->heights.z[k] = NAN;
  }
  for (gsize i = 0; i < text->matrix.rows; i++) {
    const double j = round((at(text, i, 0) - x.first) / x.step);
    const double k = round((at(text, i, 1) - y.first) / y.step);
    double *z = &out->heights.z[(gsize)k * x.count + (gsize)j];
    if (!isnan(*z)) {
      return sb_app_error_input(error, "the point x = %g, y = %g is there twice", at(text, i, 0),
                                at(text, i, 1));
    }
    *z = at(text, i, 2);
  }
  out->heights.dx = lateral * x.step;
  out->heights.dy = lateral * y.step;
  return true;
}

// Sets dx to the mean step of the first of columns x, z. False with an error: unequal steps.
static bool find_step(SbScan *out, const Text *text, double lateral, GError **error) {
  const gsize rows = text->matrix.rows;
  const double step = rows > 1 ? (at(text, rows - 1, 0) - at(text, 0, 0)) / (double)(rows - 1) : 0;
  for (gsize i = 1; i < rows; i++) {
    const double each = at(text, i, 0) - at(text, i - 1, 0);
    if (!(fabs(each - step) <= uneven_max * fabs(step)) || step == 0) {
      return sb_app_error_input(error,
                                "x is not even: a step of %g before row %zu where %g is the mean",
                                each, i + 1, step);
    }
  }
  out->heights.dx = lateral * fabs(step);
  return true;
}

// Finds the columns x, y and z by their names. Of two or three columns, those with other names are
// the remaining ones in this order. False with an error: two may be one of them, or form no grid.
static bool find_columns(SbScan *out, Text *text, GError **error) {
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
  Axis grid[2];
  if (text->axes == 3 && !find_grid(grid, text)) {
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
  double step[2]; // of x and y [m]; of `bare` in the unit of lengths, until that is found
  bool bare[2];
  double missing;           // value of missing points, as written
  double vertical, lateral; // units [m]
  double factor;            // of written heights; NaN: none
  double usual;             // unit of the format [m]; 0: none
} Header;

// Takes the step along an axis, 0 or 1, or the size divided by `count` points (NaN: not by it);
// what has a unit takes precedence. A size of `count` without a unit is the number of points.
static void take_step(Header *h, const Text *text, int axis, double count) {
  const Entry *step = find_entry(text, axis == 0 ? KEY_STEP_X : KEY_STEP_Y, true);
  const Entry *size = find_entry(text, axis == 0 ? KEY_SIZE_X : KEY_SIZE_Y, true);
  const bool by_size = step->unit == 0 && (size->unit > 0 || isnan(step->number));
  const Entry *use = by_size ? size : step;
  const bool counts = by_size && use->unit == 0 && use->number == count && h->lateral == 0;
  h->step[axis] = counts ? NAN : use->unit > 0 ? use->number * use->unit : use->number;
  h->step[axis] /= by_size ? count : 1;
  h->bare[axis] = isfinite(h->step[axis]) && use->unit == 0;
}

static Header header_of(const Text *text) {
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
  h.vertical =
      h.vertical > 0 ? h.vertical : sb_scan_length(find_entry(text, KEY_UNIT, false)->value);
  // A size may be one step more than the distance between the ends of a profile.
  const double columns = h.columns >= 1 ? h.columns : (double)matrix->columns;
  take_step(&h, text, 0, matrix->columns == 1 ? NAN : columns);
  take_step(&h, text, 1, h.rows >= 1 ? h.rows : (double)matrix->rows);
  return h;
}

// Takes the factor of written heights, with its own unit or in the unit of heights. False with an
// error if a line may state one, unless the caller specified the unit of the written numbers.
static bool take_factor(Header *h, SbScan *out, const Text *text, const SbScanChoices *choices,
                        GError **error) {
  const Entry *factor = NULL, *doubt = NULL, *resolution = NULL;
  for (guint i = 0; i < text->entries->len && factor == NULL; i++) {
    const Entry *entry = text->entries->pdata[i];
    if (!isfinite(entry->number) || entry->number == 0) {
      continue;
    }
    if (g_regex_match_simple(KEY_RESOLUTION, entry->name, 0, 0)) {
      resolution = entry;
    } else if (!g_regex_match_simple(KEY_OTHER, entry->name, 0, 0)) {
      const bool perhaps = g_regex_match_simple(KEY_PERHAPS, entry->name, 0, 0);
      const bool times = entry->times && !perhaps;
      factor = times || g_regex_match_simple(KEY_FACTOR, entry->name, 0, 0) ? entry : NULL;
      doubt = doubt == NULL && perhaps && (entry->number != 1 || entry->value[1] == '/') ? entry
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
static bool settle_unit(double *unit, const SbTextTableColumn *named, double chosen, bool needed,
                        const char *key, const char *what, GError **error) {
  const double column = named != NULL ? sb_scan_length(named->unit) : 0;
  const double other = column > 0 && named->other != NULL ? sb_scan_length(named->other) : 0;
  const bool two = chosen == 0 && column > 0 &&
                   ((*unit > 0 && *unit != column) || (other > 0 && other != column));
  *unit = chosen > 0 ? chosen : *unit > 0 ? *unit : column;
  return !(two || (needed && *unit == 0)) ||
         sb_app_error_choose(
             error, key, "nm\num\nmm",
             two ? "states two units of its %s" : "does not state the unit of its %s", what);
}

// The caller's unit of heights is that of the numbers as written: it replaces the header's factor
// too, which a note states. Without any other, it is the unit of lengths. False with an error.
static bool find_units(Header *h, SbScan *out, const Text *text, const SbScanChoices *choices,
                       bool needs_lateral, GError **error) {
  const gsize columns = text->axes, *use = text->use;
  const SbTextTableColumn *column = text->table->column;
  const double x = columns > 1 && columns <= 3 ? sb_scan_length(column[use[0]].unit) : 0;
  const double y = columns == 3 ? sb_scan_length(column[use[1]].unit) : 0;
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
  if (!settle_unit(&h->vertical, columns <= 3 ? &column[use[columns - 1]] : NULL, choices->unit,
                   true, "unit", "heights", error) ||
      !settle_unit(&h->lateral, columns > 1 && columns <= 3 ? &column[use[0]] : NULL,
                   choices->lateral_unit, needs_lateral, "lateral-unit", "lengths", error)) {
    return false;
  }
  if (isfinite(h->factor)) {
    sb_note_add(out->notes, "heights are multiplied by the header's factor %g", h->factor);
    h->vertical *= h->factor;
  }
  for (int axis = 0; axis < 2; axis++) {
    h->step[axis] *= h->bare[axis] ? h->lateral : 1;
  }
  return true;
}

// Writes the numbers `first`, first + `stride`, ... as heights. False with an error.
static bool take_numbers(SbScan *out, const Text *text, gsize first, gsize stride, gsize columns,
                         gsize rows, GError **error) {
  const bool good = sb_scan_allocate(out, columns, rows, error);
  for (gsize i = 0; good && i < columns * rows; i++) {
    out->heights.z[i] = g_array_index(text->matrix.value, double, first + stride * i);
  }
  return good;
}

// Whether the lines are as the header announces, though numbers may go on in the next line.
static bool check_sizes(const Header *h, const Text *text, bool announced, GError **error) {
  const double columns = (double)text->matrix.columns, rows = (double)text->matrix.rows;
  const int ragged = text->matrix.ragged;
  if (!announced) {
    return ragged == 0 ||
           sb_app_error_input(error, "line %d has not %.0f numbers as the first", ragged, columns);
  }
  return (h->columns * h->rows == (double)text->matrix.value->len &&
          (h->columns == h->rows || h->columns != rows || h->rows != columns)) ||
         sb_app_error_input(
             error, "%u numbers where the header announces %.0f x %.0f, in %.0f lines of %.0f",
             text->matrix.value->len, h->columns, h->rows, rows, columns);
}

static bool read_entry_text(SbScan *out, Text *text, const SbScanChoices *choices, GError **error) {
  Header h = header_of(text);
  const Entry *title = find_entry(text, KEY_TITLE, false);
  const bool sized =
      isfinite(h.columns) || (text->matrix.columns > 2 && isfinite(h.step[0] + h.step[1]));
  if (!sized && text->matrix.ragged == 0 && !find_columns(out, text, error)) {
    return false;
  }
  const gsize columns = text->axes;
  Axis grid[2];
  const bool points = !sized && columns == 3 && text->matrix.ragged == 0 && find_grid(grid, text);
  const bool matrix = sized || (columns > 2 && !points), spaced = choices->spacing > 0;
  out->title = *title->key != '\0' ? g_strdup(title->value) : NULL;
  out->format = sized          ? "text, a matrix with a header"
                : matrix       ? "text"
                : points       ? "text, x y z on a grid"
                : columns == 2 ? "text, a profile x z"
                               : "text, a profile";
  const bool announced = matrix && h.columns >= 1 && h.rows >= 1;
  if (!check_sizes(&h, text, announced, error)) {
    return false;
  }
  const char *placed = matrix ? positions(text, announced) : NULL;
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
  const gsize step = matrix ? 1 : text->matrix.columns, first = matrix ? 0 : text->use[columns - 1];
  const double low = 0x1p127 * (1 - 1e-4), high = 0x1p128;
  for (gsize i = first; i < text->matrix.value->len; i += step) {
    double *z = &g_array_index(text->matrix.value, double, i);
    *z = *z == h.missing || (fabs(*z) >= low && fabs(*z) <= high) ? NAN : h.vertical * *z;
  }
  const gsize width = announced ? (gsize)h.columns : text->matrix.columns;
  const gsize height = announced ? (gsize)h.rows : text->matrix.rows;
  out->heights.dx = h.step[0];
  out->heights.dy = h.step[1];
  if (!(matrix   ? take_numbers(out, text, 0, 1, width, height, error)
        : points ? take_grid(out, text, grid, h.lateral, error)
                 : take_numbers(out, text, first, step, height, 1, error) &&
                       (columns == 1 || find_step(out, text, h.lateral, error)))) {
    return false;
  }
  return spaced || (out->heights.dx > 0 && (!matrix || out->heights.dy > 0)) ||
         sb_app_error_choose(error, "spacing", NULL, "does not state the distance of its points");
}

bool sb_scan_parse_text(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error) {
  const SbTextTableDialect form = {.matrix = true, .decimal = wish->decimal};
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(GPtrArray) entries = g_ptr_array_new_with_free_func(entry_free);
  g_autoptr(SbTextTable) table =
      sb_text_table_parse(file.at, (gsize)(file.end - file.at), &form, "", issues);
  Text text = {.entries = entries, .table = table, .use = {0, 1, 2}};
  if (table == NULL ||
      !sb_text_table_read_matrix(&text.matrix, table, SB_HEIGHTS_POINTS_MAX, issues)) {
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
  const bool good = read_entry_text(out, &text, wish, error);
  g_array_unref(text.matrix.value);
  return good;
}

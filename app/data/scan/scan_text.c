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
  g_autofree char *unit = take_brackets(key);
  g_autofree char *folded = g_utf8_strdown(key, -1);
  g_autoptr(GRegex) other = g_regex_new("[^\\pL\\pN]", 0, 0, NULL);
  entry->key = g_regex_replace_literal(other, folded, -1, 0, "", 0, NULL);
  entry->value = g_strstrip(g_strdup(line + at + 1));
  const gsize number = sb_text_table_number_at(&entry->number, entry->value, dialect->decimal);
  entry->number = number > 0 ? entry->number : NAN;
  entry->unit = sb_scan_length(number > 0 && *unit == '\0' ? entry->value + number : unit);
  g_ptr_array_add(entries, entry);
}

// Returns the entry of the first of the patterns (separated by |, * for any letters) that the
// header has; an empty one without.
static const SbScanEntry *find_entry(const SbScanText *text, const char *patterns) {
  static const SbScanEntry none = {(char *)"", (char *)"", NAN, 0};
  g_auto(GStrv) each = g_strsplit(patterns, "|", -1);
  for (char **pattern = each; *pattern != NULL; pattern++) {
    for (guint i = 0; i < text->entries->len; i++) {
      const SbScanEntry *entry = text->entries->pdata[i];
      if (g_pattern_match_simple(*pattern, entry->key)) {
        return entry;
      }
    }
  }
  return &none;
}

// What the header says of a matrix; NaN or 0 where it does not.
typedef struct {
  double columns, rows;
  double width, height; // with their units, or in the unit of lengths (`bare`)
  double step_x, step_y;
  double missing;           // value of missing points, as written
  double vertical, lateral; // units [m]
  double factor;            // of written heights; NaN: none
  bool bare;
} Header;

// A length by itself where it has a unit, else in units of lengths.
static double length_of(const SbScanEntry *entry, bool *bare) {
  *bare |= !isnan(entry->number) && entry->unit == 0;
  return entry->unit > 0 ? entry->number * entry->unit : entry->number;
}

static Header header_of(const SbScanText *text) {
#define ANY_STEP "|pixelsize|spacing|schrittweite|pas|passo"
  Header h = {0};
  h.columns = find_entry(text, "ncols|xpixels|columns|pixelsx|spalten|colonnes|colonne")->number;
  h.rows = find_entry(text, "nrows|ypixels|rows|lines|pixelsy|zeilen|lignes|righe")->number;
  h.step_x = length_of(find_entry(text, "cellsize|dx|xspacing|xstep|xscale" ANY_STEP), &h.bare);
  h.step_y = length_of(find_entry(text, "cellsize|dy|yspacing|ystep|yscale" ANY_STEP), &h.bare);
  h.width = length_of(
      find_entry(text, "xlength|width|xsize|xreal|xrange|breite|largeur|larghezza|anch*"), &h.bare);
  h.height = length_of(
      find_entry(text, "ylength|height|ysize|yreal|yrange|höhe|hauteur|altezza|altura|alto"),
      &h.bare);
  h.missing = find_entry(text, "nodatavalue|nodata|fehlwert")->number;
  h.vertical = sb_scan_length(
      find_entry(text,
                 "zunit*|valueunit*|heightunit*|unitz|*einheit*wert*|wert*einheit*|*unit*val*|"
                 "*unid*valor*|einheitz|zeinheit|unitéz|unitàz|unidadz")
          ->value);
  h.lateral = sb_scan_length(find_entry(text, "xunit*|lateralunit*|xyunit*|unitxy|unitx|einheitx*|"
                                              "xeinheit|unitéx*|unitàx*")
                                 ->value);
  // A factor of the written heights, with its own unit or in the unit of heights.
  const SbScanEntry *factor = find_entry(
      text, "zfactor|zscale|zscaling|heightfactor|heightscale|factor*|scalefactor|*skalierung*|"
            "höhenfaktor|zfaktor|facteur*|fattore*|*multipl*|bit2nm|*faktor");
  h.factor = factor->number;
  h.vertical = factor->unit > 0 && isfinite(h.factor) ? factor->unit : h.vertical;
  // SPIP's lengths are in nanometres; so are its heights times Bit2nm where no unit is given.
  if (g_ascii_strcasecmp(find_entry(text, "fileformat")->value, "ASCII") == 0) {
    const bool bits = strcmp(factor->key, "bit2nm") == 0;
    h.lateral = h.lateral > 0 ? h.lateral : 1e-9;
    h.factor = bits && h.vertical > 0 ? NAN : h.factor;
    h.vertical = bits && h.vertical == 0 ? 1e-9 : h.vertical;
  }
  return h;
}

// Units by precedence: the caller's, the file's, for lengths the caller's of heights. The caller's
// unit is that of the numbers as written: it replaces the header's factor too, which a note states.
// False with an error where one is needed and nowhere.
static bool find_units(Header *h, SbScan *out, const SbScanText *text, const SbScanChoices *choices,
                       bool needs_lateral, GError **error) {
  if (text->matrix.columns <= 3 && h->vertical == 0) {
    const SbTextTableColumn *column = text->table->column;
    const double y = text->matrix.columns == 3 ? sb_scan_length(column[1].unit) : 0;
    h->vertical = sb_scan_length(column[text->matrix.columns - 1].unit);
    h->lateral =
        h->lateral > 0 || text->matrix.columns == 1 ? h->lateral : sb_scan_length(column[0].unit);
    if (y > 0 && y != h->lateral) {
      return sb_app_error_input(error, "x and y have different units");
    }
  }
  if (choices->unit > 0 && isfinite(h->factor)) {
    sb_note_add(out->notes,
                "the header's height factor %g is not used: the unit of the heights was specified",
                h->factor);
    h->factor = NAN;
  }
  h->vertical = choices->unit > 0 ? choices->unit : h->vertical;
  h->lateral = choices->lateral_unit > 0 ? choices->lateral_unit
               : h->lateral > 0          ? h->lateral
                                         : choices->unit;
  if (h->vertical == 0 || (needs_lateral && h->lateral == 0)) {
    return sb_app_error_choose(error, h->vertical == 0 ? "unit" : "lateral-unit", "nm\num\nmm",
                               "does not state the unit of its %s",
                               h->vertical == 0 ? "heights" : "lengths");
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
  const double lateral = h->bare ? h->lateral : 1;
  to->dx = lateral * (isnan(h->step_x) ? h->width / (double)to->columns : h->step_x);
  to->dy = lateral * (isnan(h->step_y) ? h->height / (double)to->rows : h->step_y);
  return true;
}

static bool read_entry_text(SbScan *out, const SbScanText *text, const SbScanChoices *choices,
                            GError **error) {
  Header h = header_of(text);
  const SbScanEntry *title =
      find_entry(text, "channel|title|kanal|canal|canale|titel|titre|titolo");
  const gsize columns = text->matrix.columns;
  const bool sized =
      isfinite(h.columns) ||
      (columns > 2 && (isfinite(h.width + h.height) || isfinite(h.step_x + h.step_y)));
  const bool points = !sized && columns == 3 && text->matrix.ragged == 0 && sb_scan_is_grid(text);
  const bool matrix = sized || (columns > 2 && !points), spaced = choices->spacing > 0;
  out->title = *title->key != '\0' ? g_strdup(title->value) : NULL;
  out->format = sized          ? "text, a matrix with a header"
                : matrix       ? "text"
                : points       ? "text, x y z on a grid"
                : columns == 2 ? "text, a profile x z"
                               : "text, a profile";
  if (matrix && h.columns >= 1 && h.rows >= 1) {
    if (h.columns * h.rows != (double)text->matrix.value->len) {
      return sb_app_error_input(error, "%u numbers where the header announces %.0f x %.0f",
                                text->matrix.value->len, h.columns, h.rows);
    }
  } else if (text->matrix.ragged > 0) {
    return sb_app_error_input(error, "line %d has not %" G_GSIZE_FORMAT " numbers as the first",
                              text->matrix.ragged, columns);
  }
  if (matrix && sb_scan_is_placed(text)) {
    return sb_app_error_input(error, "its first column has even steps, as positions have and "
                                     "heights have not: remove the positions");
  }
  if (!find_units(&h, out, text, choices, matrix ? h.bare && !spaced : columns > 1, error)) {
    return false;
  }
  // Heights are in the last column; those at the end of single precision mark void points.
  const gsize step = matrix ? 1 : columns;
  const double low = 0x1p127 * (1 - 1e-4), high = 0x1p128;
  for (gsize i = step - 1; i < text->matrix.value->len; i += step) {
    double *z = &g_array_index(text->matrix.value, double, i);
    *z = *z == h.missing || (fabs(*z) >= low && fabs(*z) <= high) ? NAN : *z;
  }
  if (!(matrix   ? take_matrix(out, text, &h, error)
        : points ? sb_scan_grid(out, text, h.lateral, h.vertical, error)
                 : sb_scan_profile(out, text, h.lateral, h.vertical, error))) {
    return false;
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
  SbScanText text = {.entries = entries, .table = table};
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
  for (char **line = table->header; *line != NULL && entries->len < ENTRIES_MAX; line++) {
    take_entry(entries, *line, &table->dialect);
  }
  const bool good = read_entry_text(out, &text, choices, error);
  g_array_unref(text.matrix.value);
  return good;
}

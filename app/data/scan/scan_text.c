// Text files: which of the forms one has, its sizes and units; see scan.h.
#include "app/data/scan/scan_private.h"

#include "app/base/number.h"

#include <math.h>

// The entry of the first of the names (separated by |) that the header has; NULL without.
static const SbScanEntry *find(const SbScanText *text, const char *names) {
  g_auto(GStrv) each = g_strsplit(names, "|", -1);
  for (char **name = each; *name != NULL; name++) {
    for (guint i = 0; i < text->entries->len; i++) {
      const SbScanEntry *entry = text->entries->pdata[i];
      if (strcmp(entry->key, *name) == 0) {
        return entry;
      }
    }
  }
  return NULL;
}

// Number of an entry; NaN without.
static double number_of(const SbScanEntry *entry) {
  double value = NAN;
  if (entry != NULL && sb_number_read(&value, entry->value) == 0) {
    return NAN;
  }
  return value;
}

// What the header says of a matrix; NaN or 0 where it does not.
typedef struct {
  double columns, rows;
  double width, height; // with their units, or in the unit of lengths (`bare`)
  double step_x, step_y;
  double missing;           // value of missing points, as written
  double vertical, lateral; // units [m]
  double factor;            // of written heights
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
  Header h = {.factor = 1};
  h.columns = number_of(find(text, "ncols|xpixels|columns|pixelsx"));
  h.rows = number_of(find(text, "nrows|ypixels|rows|lines|pixelsy"));
  h.step_x = length_of(find(text, "cellsize|dx|xspacing|xstep|pixelsize|spacing"), &h.bare);
  h.step_y = length_of(find(text, "cellsize|dy|yspacing|ystep|pixelsize|spacing"), &h.bare);
  h.width = length_of(find(text, "xlength|width|xsize|xreal|xrange"), &h.bare);
  h.height = length_of(find(text, "ylength|height|ysize|yreal|yrange"), &h.bare);
  h.missing = number_of(find(text, "nodatavalue|nodata"));
  h.vertical = unit_of(text, "zunit|zunits|valueunits|valueunit|heightunit|unitz");
  h.lateral = unit_of(text, "xunit|xunits|lateralunit|lateralunits|xyunit|unitxy|unitx");
  // SPIP's lengths are in nanometres; so are its heights times Bit2nm where no unit is given.
  const SbScanEntry *format = find(text, "fileformat");
  if (format != NULL && g_ascii_strcasecmp(format->value, "ASCII") == 0) {
    h.lateral = h.lateral > 0 ? h.lateral : 1e-9;
    const double factor = number_of(find(text, "bit2nm"));
    if (h.vertical == 0 && isfinite(factor)) {
      h.factor = factor;
      h.vertical = 1e-9;
    }
  }
  return h;
}

// Units by precedence: the caller's, the file's, for lengths the caller's of heights. FALSE with an
// error where one is needed and nowhere.
static gboolean find_units(Header *h, const SbScanText *text, const SbScanChoices *choices,
                           gboolean needs_lateral, GError **error) {
  const GPtrArray *units = text->units;
  if (units->len == text->columns && h->vertical == 0) {
    h->vertical = sb_scan_length(units->pdata[units->len - 1]);
    h->lateral = h->lateral > 0 || units->len == 1 ? h->lateral : sb_scan_length(units->pdata[0]);
    if (units->len == 3 && sb_scan_length(units->pdata[1]) != h->lateral) {
      return sb_scan_fail(error, text->name, "x and y have different units");
    }
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
  if (!find_units(&h, text, choices, h.bare && !(choices->spacing > 0), error) ||
      !sb_scan_allocate(out, announced ? (guint64)h.columns : text->columns,
                        announced ? (guint64)h.rows : text->rows, text->name, error)) {
    return FALSE;
  }
  SbHeights *to = &out->heights;
  for (gsize i = 0; i < to->columns * to->rows; i++) {
    to->z[i] = value[i] == h.missing ? NAN : value[i] * h.factor * h.vertical;
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
  const gboolean sized = find(text, "ncols|xpixels|width|xlength|cellsize|pixelsx") != NULL;
  out->format = sized ? "text, a matrix with a header" : "text";
  const SbScanEntry *title = find(text, "channel|title");
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
  if (!find_units(&h, text, choices, text->columns > 1, error)) {
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

gboolean sb_scan_parse_text(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                            GError **error) {
  SbScanText text;
  const gboolean good =
      sb_scan_text_read(&text, bytes, error) && read_text(out, &text, choices, error);
  sb_scan_text_clear(&text);
  return good;
}

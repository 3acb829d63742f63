// Headers of tables: names and units of the columns; see text_table.h.
#include "app/base/number.h"
#include "app/base/text_table_private.h"

enum { HEADER_LINES = 1000, HEADER_BYTES = 4096 };

static const struct {
  const char *unit, *all; // all spellings between bars
} known_units[] = {
#define SB_TEXT_UNIT(unit, also) {unit, "|" unit "|" also "|"},
#include "app/base/text_table_units.def"
#undef SB_TEXT_UNIT
};

const char *sb_text_table_unit(const char *text) {
  g_auto(GStrv) parts = g_strsplit(text, "\xce\xbc", -1); // the other letter that looks like a µ
  g_autofree char *plain = g_strstrip(g_strjoinv("\xc2\xb5", parts));
  plain[strlen(plain) - (g_str_has_suffix(plain, ".") && plain[1] != '\0')] = '\0';
  g_autofree char *folded = g_utf8_strdown(plain, -1);
  g_autofree char *entry = g_strconcat("|", folded, "|", NULL);
  const bool word = *folded != '\0' && strchr(folded, '|') == NULL;
  const char *found = NULL;
  for (size_t i = 0; i < G_N_ELEMENTS(known_units); i++) {
    g_autofree char *all = g_utf8_strdown(known_units[i].all, -1);
    if (strcmp(known_units[i].unit, plain) == 0) {
      return known_units[i].unit;
    }
    found = found == NULL && word && strstr(all, entry) != NULL ? known_units[i].unit : found;
  }
  return found;
}

// Returns a unit without brackets, in its usual spelling where that is known. Owned by the caller.
static char *unit_text(const char *text, size_t length) {
  g_autofree char *one = g_strstrip(g_strndup(text, length));
  const size_t end = strlen(one);
  if (end >= 2 && strchr("[({<", *one) != NULL && strchr("])}>", one[end - 1]) != NULL) {
    return unit_text(one + 1, end - 2);
  }
  const char *known = sb_text_table_unit(one);
  return known != NULL ? g_strdup(known) : g_steal_pointer(&one);
}

// Whether a text is a unit: a known one, or a quotient of known ones.
static bool is_unit(const char *text) {
  g_auto(GStrv) parts = g_strsplit(text, "/", 3);
  bool all = parts[0] != NULL;
  for (char **part = parts; *part != NULL; part++) {
    for (size_t end = strlen(*part); end > 1 && strchr("^23", (*part)[end - 1]) != NULL; end--) {
      (*part)[end - 1] = '\0';
    }
    all = all && sb_text_table_unit(*part) != NULL;
  }
  return all;
}

// "Force [N]", "Kraft / N", "load_N", "x in µm" -> name and unit. Both owned by the caller.
static void split_name(char **name, char **unit, const char *text) {
  static const char *const links[] = {" in ", " en ", "/", "_", ",", ":", " "};
  const size_t length = strlen(text);
  const char *open = NULL, *close = NULL, *behind = "";
  bool known = false;
  *unit = NULL;
  for (const char *c = text + length; c > text && !known; c--) {
    // The last brackets with a unit; else what is in brackets at the end.
    if (strchr("])}>", c[-1]) != NULL) {
      close = c - 1;
    } else if (close != NULL && strchr("[({<", c[-1]) != NULL) {
      g_autofree char *inside = unit_text(c, (size_t)(close - c));
      known = is_unit(inside);
      if (known || (close == text + length - 1 && open == NULL)) {
        open = c - 1;
        behind = close + 1;
        g_free(*unit);
        *unit = g_steal_pointer(&inside);
      }
      close = NULL;
    }
  }
  for (size_t i = 0; i < G_N_ELEMENTS(links) && *unit == NULL; i++) {
    const char *link = g_strrstr(text, links[i]);
    g_autofree char *tail =
        link != NULL ? unit_text(link + strlen(links[i]), strlen(link + strlen(links[i]))) : NULL;
    if (link != NULL && link > text && is_unit(tail)) {
      open = link;
      *unit = g_steal_pointer(&tail);
    }
  }
  *name =
      g_strdup_printf("%.*s%s", (int)(open != NULL ? open - text : (gssize)length), text, behind);
  g_strstrip(*name);
  *unit = *unit != NULL ? *unit : g_strdup("");
}

// Cells of a header line with a separator; 0 for two blanks or more.
static char **cells_by(const char *line, size_t length, char separator) {
  SbTextTableCell cell[SB_TEXT_TABLE_COLUMNS_MAX];
  if (separator == '\0') {
    g_autofree char *copy = g_strstrip(g_strndup(line, length));
    g_autoptr(GRegex) blanks = g_regex_new(" {2,}", G_REGEX_RAW, 0, NULL);
    g_autofree char *text = g_regex_replace_literal(blanks, copy, -1, 0, "\t", 0, NULL);
    return cells_by(text, strlen(text), '\t');
  }
  GPtrArray *out = g_ptr_array_new();
  const size_t cells = sb_text_table_split(cell, line, length, separator);
  for (size_t i = 0; i < cells; i++) {
    // Letters and brackets of full width are those of ASCII.
    g_autofree char *printed = sb_printable(cell[i].text, cell[i].length);
    const bool wide = strstr(printed, "\xef\xbc") != NULL;
    g_autofree char *plain = wide ? g_utf8_normalize(printed, -1, G_NORMALIZE_NFKC) : NULL;
    g_auto(GStrv) parts = g_strsplit(wide ? plain : printed, "\"\"", -1);
    char *text = g_strjoinv("\"", parts);
    // A unit between blanks is part of the name before it, unless that is a unit too.
    if (separator == ' ' && out->len > 0 && strspn(text, "[(") > 0 &&
        strspn(out->pdata[out->len - 1], "[(") == 0) {
      g_autofree char *before = g_ptr_array_steal_index(out, out->len - 1), *unit = text;
      text = g_strconcat(before, " ", unit, NULL);
    }
    g_ptr_array_add(out, text);
  }
  g_ptr_array_add(out, NULL);
  return (char **)g_ptr_array_free(out, FALSE);
}

// With the separator of the rows; if that gives another number of cells than the rows have, with
// the first one that gives it, also without a label in front ("columns: t x F").
char **sb_text_table_header_cells(const SbTextTable *table, const GString *line) {
  const char separators[] = {table->dialect.separator, '\t', ';', ',', '|', '\0'};
  const char *at = line->str, *const end = at + MIN(line->len, HEADER_BYTES);
  while (at < end && memchr("#%! ", *at, at > line->str ? 4 : 3) != NULL) {
    at++;
  }
  char **best = NULL;
  for (int label = 0; label < 2 && at != NULL; label++) {
    for (size_t i = 0; i < sizeof separators; i++) {
      char **other = cells_by(at, (size_t)(end - at), separators[i]);
      const bool fits = g_strv_length(other) == table->columns;
      g_strfreev(fits ? best : best != NULL ? other : NULL);
      best = fits || best == NULL ? other : best;
      if (fits) {
        return best;
      }
    }
    at = memchr(at, ':', (size_t)(end - at));
    at = at != NULL ? at + 1 : NULL;
  }
  return best;
}

// Most cells are units.
static bool are_units(char *const *cells) {
  int texts = 0, known = 0;
  for (char *const *cell = cells; *cell != NULL; cell++) {
    const size_t length = strlen(*cell);
    const bool bracketed =
        length >= 2 && strchr("[(", **cell) != NULL && strchr("])", (*cell)[length - 1]) != NULL;
    texts += length > 0;
    known += length > 0 && (bracketed || is_unit(*cell));
  }
  return known > 0 && 2 * known > texts;
}

// Whether a header line can name the columns: a text for nearly all that have numbers, no value.
static bool names_columns(const SbTextTable *table, char *const *cells) {
  size_t texts = 0, numbers = 0, count = 0;
  double value;
  SbTextTableClock clock;
  for (; cells[count] != NULL; count++) {
    const SbTextTableCell cell = {cells[count], strlen(cells[count])};
    const bool empty = sb_text_table_void(&cell);
    if (!empty && (sb_text_table_number(&value, &cell, &table->dialect, NULL) ||
                   sb_text_table_clock(&clock, &cell, table->dialect.dates))) {
      return false;
    }
    texts += count < table->columns && !empty;
  }
  for (size_t i = 0; i < table->columns; i++) {
    numbers += table->column[i].numeric || table->column[i].clock;
  }
  return count > 0 && texts + (numbers > 2) >= numbers &&
         (count <= table->columns || texts == table->columns);
}

// Whether a quote that begins a cell, at most 3 lines before, is open behind line count - 1.
static bool is_open(const SbTextTable *table, size_t count) {
  const char *quote = NULL;
  const size_t low = count - MIN(count, 3);
  while (count > low && (quote = strrchr(sb_text_table_line(table, count - 1)->str, '"')) == NULL) {
    count--;
  }
  return quote != NULL && (quote == sb_text_table_line(table, count - 1)->str ||
                           quote[-1] == table->dialect.separator);
}

// Takes the unit of a column that has none yet; another one is kept apart.
static void take_unit(SbTextTableColumn *column, char *unit) {
  const bool differs = *unit != '\0' && strcmp(unit, column->unit) != 0;
  char **to = *column->unit == '\0' ? &column->unit : differs ? &column->other : &unit;
  g_free(*to);
  *to = to != &unit ? unit : NULL;
}

// Whether a line directly after a row names each column, with different texts ("OVER" in each names
// none); of a comment or matrix, or with blanks between cells, with a unit, unlike a remark.
static bool names_each(const SbTextTable *table, const GString *line, char *const *cells) {
  const SbTextTableShape *rows = &table->file->shape;
  int named = 0;
  for (char *const *cell = cells; *cell != NULL; cell++) {
    named += **cell != '\0' && (cell == cells || strcmp(cell[0], cell[-1]) != 0);
  }
  const bool words =
      table->dialect.separator == ' ' || table->dialect.matrix || strspn(line->str, "#%!") > 0;
  return named >= MAX(__builtin_popcountll(rows->numeric | rows->clocks | rows->texts), 2) &&
         (!words || strpbrk(line->str, "[(") != NULL);
}

void sb_text_table_block_next(SbTextTableBlock *block, bool row, const GString *line,
                              const SbTextTable *table) {
  const bool after_row = block->after_row, matrix = table->dialect.matrix;
  block->after_row = row;
  block->headed = !row && block->headed;
  if (row || line->len == 0 || (matrix && strspn(line->str, "#%!") > 0)) {
    return;
  }
  g_auto(GStrv) cells = sb_text_table_header_cells(table, line);
  const bool any = matrix && !after_row, units = !any && are_units(cells) && cells[1] != NULL;
  if (!any && ((!units && !names_columns(table, cells)) ||
               (after_row && !names_each(table, line, cells)))) {
    return;
  }
  // Names and units, with a newline between. Without a line of units, the same names have those
  // that they had.
  const char *old = block->names != NULL ? block->names : "\n";
  g_autofree char *text = g_strjoinv("\t", cells);
  char *both = units ? g_strdup_printf("%.*s\n%s", (int)strcspn(old, "\n"), old, text)
                     : g_strconcat(text, "\n", NULL);
  const bool other = units || !g_str_has_prefix(old, both);
  g_free(other ? block->names : both);
  block->names = other ? both : block->names;
  block->headed = true;
}

void sb_text_table_take_header(SbTextTable *table) {
  enum { LOOKED = 12 };
  bool found[2] = {false}, stopped = false; // names, units
  for (size_t i = table->header_lines, back = 0; i-- > 0 && back < LOOKED && !stopped; back++) {
    // A cell in quotes may have several lines.
    g_autoptr(GString) all = g_string_new(sb_text_table_line(table, i)->str);
    for (; is_open(table, i); i--) {
      g_string_prepend_c(all, ' ');
      g_string_prepend(all, sb_text_table_line(table, i - 1)->str);
    }
    const SbTextTableShape shape = sb_text_table_shape(all, &table->dialect);
    g_auto(GStrv) cells = sb_text_table_header_cells(table, all);
    const bool units = are_units(cells), titled = names_columns(table, cells);
    // The rows of a block above, or the first line above the names that is not units, end it.
    stopped = (shape.numeric | shape.clocks) != 0 && shape.texts == 0;
    if (stopped || (!titled && !units)) {
      stopped |= found[0] && cells[0] != NULL;
    } else {
      stopped = found[units];
      const bool use = !stopped || (units && found[0]); // units above the names too
      for (size_t k = 0; use && k < table->columns && cells[k] != NULL; k++) {
        SbTextTableColumn *column = &table->column[k];
        char *unit = NULL, *name = NULL, *inner = NULL;
        if (units) {
          take_unit(column, unit_text(cells[k], strlen(cells[k])));
          continue;
        }
        split_name(&name, &unit, cells[k]);
        take_unit(column, unit);
        g_free(column->name);
        column->name = name;
        split_name(&name, &inner, column->name); // "Disp_mm [um]"
        take_unit(column, inner);
        g_free(name);
      }
      found[units] = true;
    }
  }
  const size_t lines = MIN(table->header_lines, HEADER_LINES);
  table->header = g_new0(char *, lines + 1);
  for (size_t i = 0; i < lines; i++) {
    g_autofree char *copy = g_strndup(sb_text_table_line(table, i)->str, HEADER_BYTES);
    const char *text = g_strdelimit(copy + strspn(copy, "#;%!/ \t"), "\t", ';');
    table->header[i] = sb_printable(text, strlen(text));
  }
}

size_t sb_text_table_number_at(double *out, const char *text, char decimal) {
  const size_t whole = strspn(text, "+-0123456789");
  const size_t part = text[whole] == ',' ? strspn(text + whole + 1, "0123456789") : 0;
  if (part == 0 || (decimal != ',' && part == 3)) {
    return sb_number_read(out, text);
  }
  g_autofree char *point = g_strdup(text);
  point[whole] = '.';
  return sb_number_read(out, point);
}

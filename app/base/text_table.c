// Recognises the format of a table: tries every dialect on lines from its start, middle and end,
// and uses the one in which most lines are equivalent rows of numbers. Two dialects that fit
// equally but give other values are an issue. See text_table.h.
#include "app/base/text_table.h"

#include "app/base/output.h"
#include "app/base/reader.h"
#include "app/base/text_table_private.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Lines that are looked at, copied.
typedef struct {
  GPtrArray *line;   // of GString
  size_t head;       // of them from the start of the file, without a gap
  const char *wrong; // why the file cannot be read; NULL: it can
} Sample;

enum { PIPE_BYTES = 1 << 30 }; // largest table that is read from a pipe, into memory

enum { SAMPLE_LINES = 3000, SAMPLE_BYTES = 1 << 18, SAMPLE_TAIL = 300, LINE_BYTES = 1 << 16 };

static const char *const encodings[SB_TEXT_TABLE_ENCODING_COUNT] = {"", "utf-8", "latin-1",
                                                                    "utf-16le", "utf-16be"};

const char *sb_text_table_encoding_name(SbTextTableEncoding encoding) {
  return (unsigned)encoding < SB_TEXT_TABLE_ENCODING_COUNT ? encodings[encoding] : "";
}

// ---- Bytes ----

enum { ENCODING_BYTES = 1 << 16 };

// From the first `looked` of `length` bytes.
static SbTextTableEncoding find_encoding(const guint8 *bytes, size_t looked, size_t length) {
  if (looked >= 2 &&
      ((bytes[0] == 0xff && bytes[1] == 0xfe) || (bytes[0] == 0xfe && bytes[1] == 0xff))) {
    return bytes[0] == 0xff ? SB_TEXT_TABLE_UTF16LE : SB_TEXT_TABLE_UTF16BE;
  }
  // Half of the bytes of digits in UTF-16 are zero, those of one side.
  size_t zero[2] = {0};
  for (size_t i = 0; i < looked; i++) {
    zero[i % 2] += bytes[i] == 0;
  }
  if (zero[0] + zero[1] > looked / 4) {
    return zero[1] > zero[0] ? SB_TEXT_TABLE_UTF16LE : SB_TEXT_TABLE_UTF16BE;
  }
  // The look may end inside of a character.
  const char *bad = NULL;
  const bool good = g_utf8_validate((const char *)bytes, (gssize)looked, &bad) ||
                    (looked < length && (const char *)bytes + looked - bad < 4);
  return good ? SB_TEXT_TABLE_UTF8 : SB_TEXT_TABLE_LATIN1;
}

char *sb_text_table_utf8(const char *text, size_t length, SbTextTableEncoding encoding) {
  if (encoding != SB_TEXT_TABLE_LATIN1) {
    return sb_printable(text, length);
  }
  g_autoptr(GString) out = g_string_sized_new(length);
  for (size_t i = 0; i < length; i++) {
    g_string_append_unichar(out, (guchar)text[i]);
  }
  return sb_printable(out->str, out->len);
}

static void string_free(gpointer data) {
  g_string_free(data, TRUE);
}

static void take_lines(Sample *sample, const SbTextTable *table, size_t from, size_t lines_max) {
  SbTextTableLines lines;
  const char *text;
  size_t length;
  sb_text_table_lines_init(&lines, &table->bytes, from, table->dialect.encoding);
  if (from > 0) {
    (void)sb_text_table_next(&lines, &text, &length); // the rest of a line
  }
  const size_t end = sb_text_table_lines_place(&lines) + SAMPLE_BYTES;
  for (size_t i = 0; i < lines_max && sb_text_table_lines_place(&lines) < end &&
                     sb_text_table_next(&lines, &text, &length);
       i++) {
    GString *line = g_string_new_len(text, (gssize)MIN(length, LINE_BYTES));
    g_ptr_array_add(sample->line, line);
    sample->head += from == 0;
  }
  sample->wrong = sample->wrong != NULL ? sample->wrong : lines.wrong;
  sb_text_table_lines_clear(&lines);
}

static Sample take_sample(const SbTextTable *table) {
  Sample sample = {.line = g_ptr_array_new_with_free_func(string_free)};
  take_lines(&sample, table, 0, SAMPLE_LINES);
  for (size_t part = 1; part <= 3; part++) {
    // Places behind the first look; the last near the end.
    const size_t from = part < 3 ? part * (table->bytes.length / 3)
                                 : table->bytes.length - MIN(table->bytes.length, SAMPLE_BYTES / 8);
    if (from > SAMPLE_BYTES) {
      take_lines(&sample, table, from & ~(size_t)1, SAMPLE_TAIL);
    }
  }
  return sample;
}

// ---- Dialects ----

// How well a dialect fits: rows of the same number of cells and the same kinds in their columns.
typedef struct {
  SbTextTableDialect dialect;
  size_t cells, rows;
  guint64 numeric, clocks; // of the columns of most rows, a bit each
  unsigned saw;
  double score;
} Fit;

typedef struct {
  size_t cells, rows;
  guint64 numeric, clocks;
  unsigned saw;
} Shape;

static Shape shape_of(const GString *line, const SbTextTableDialect *dialect) {
  SbTextTableCell cell[SB_TEXT_TABLE_COLUMNS_MAX];
  Shape shape = {.rows = 1};
  if (line->len == 0 || line->str[0] == '#') {
    return shape;
  }
  shape.cells = sb_text_table_split(cell, line->str, line->len, dialect->separator);
  for (size_t i = 0; i < shape.cells; i++) {
    double value;
    SbTextTableClock clock;
    if (sb_text_table_number(&value, &cell[i], dialect, &shape.saw)) {
      shape.numeric |= G_GUINT64_CONSTANT(1) << i;
    } else if (sb_text_table_clock(&clock, &cell[i])) {
      shape.clocks |= G_GUINT64_CONSTANT(1) << i;
    }
  }
  return shape;
}

static int count_bits(guint64 bits) {
  int count = 0;
  for (; bits != 0; bits &= bits - 1) {
    count++;
  }
  return count;
}

static bool same_shape(const Shape *a, const Shape *b) {
  return a->cells == b->cells && a->numeric == b->numeric && a->clocks == b->clocks;
}

static Fit try_dialect(const Sample *sample, const SbTextTableDialect *dialect) {
  enum { SHAPES = 32 };
  Shape seen[SHAPES];
  size_t count = 0;
  for (guint i = 0; i < sample->line->len; i++) {
    const Shape shape = shape_of(sample->line->pdata[i], dialect);
    size_t at = 0;
    while (at < count && !same_shape(&seen[at], &shape)) {
      at++;
    }
    if (count_bits(shape.numeric | shape.clocks) < 2 || at == SHAPES) {
      continue;
    }
    if (at == count) {
      seen[count++] = shape;
    } else {
      seen[at].rows++;
      seen[at].saw |= shape.saw;
    }
  }
  Fit fit = {.dialect = *dialect};
  for (size_t i = 0; i < count; i++) {
    const double share =
        (double)count_bits(seen[i].numeric | seen[i].clocks) / (double)seen[i].cells;
    const double score = (double)seen[i].rows * share * share;
    if (seen[i].rows >= 2 && score > fit.score) {
      fit = (Fit){*dialect,       seen[i].cells, seen[i].rows, seen[i].numeric,
                  seen[i].clocks, seen[i].saw,   score};
    }
  }
  // Who sets marks between thousands mostly sets them everywhere.
  const unsigned both = SB_TEXT_TABLE_SAW_GROUPS | SB_TEXT_TABLE_SAW_LONG;
  if ((fit.saw & both) == both) {
    fit.score *= 0.5;
  }
  return fit;
}

// The first cell of the sample that has another value in another dialect; "" without one.
static char *find_two_ways(const Sample *sample, const Fit *one, const Fit *two) {
  for (guint i = 0; i < sample->line->len; i++) {
    const GString *line = sample->line->pdata[i];
    SbTextTableCell cell[SB_TEXT_TABLE_COLUMNS_MAX];
    const size_t cells = sb_text_table_split(cell, line->str, line->len, one->dialect.separator);
    for (size_t k = 0; k < cells; k++) {
      double a, b;
      if (sb_text_table_number(&a, &cell[k], &one->dialect, NULL) &&
          sb_text_table_number(&b, &cell[k], &two->dialect, NULL) && a != b) {
        return sb_printable(cell[k].text, MIN(cell[k].length, 40));
      }
    }
  }
  return NULL;
}

// The best fit of all that are wished for; false with an issue.
static bool find_dialect(Fit *best, const SbTextTable *table, const Sample *sample,
                         const SbTextTableDialect *wish, GPtrArray *issues) {
  static const char separators[] = {'\t', ';', ',', ' '}, marks[] = {'.', ','};
  bool quoted = false;
  for (guint i = 0; i < sample->line->len; i++) {
    quoted |= strchr(((GString *)sample->line->pdata[i])->str, '"') != NULL;
  }
  *best = (Fit){0};
  Fit rival = {0};
  for (size_t s = 0; s < G_N_ELEMENTS(separators); s++) {
    for (size_t m = 0; m < G_N_ELEMENTS(marks); m++) {
      const char other = marks[1 - m];
      const SbTextTableDialect dialect = {.encoding = table->dialect.encoding,
                                          .separator = separators[s],
                                          .decimal = marks[m],
                                          .thousands = other != separators[s] ? other : '\0'};
      if ((wish->separator != '\0' && wish->separator != separators[s]) ||
          (wish->decimal != '\0' && wish->decimal != marks[m]) ||
          (separators[s] == marks[m] && !quoted)) {
        continue;
      }
      const Fit fit = try_dialect(sample, &dialect);
      if (fit.score > best->score) {
        rival = (Fit){0};
        *best = fit;
      } else if (fit.score == best->score && fit.score > 0 &&
                 fit.dialect.separator == best->dialect.separator) {
        rival = fit;
      }
    }
  }
  if (best->score == 0) {
    sb_issues_add(
        issues, table->shown, 0, NULL, NULL,
        "has no rows of two numbers or more, separated by tab, semicolon, comma or blank");
    return false;
  }
  g_autofree char *cell =
      rival.score > 0 && ((best->saw | rival.saw) & SB_TEXT_TABLE_SAW_GROUPS) != 0
          ? find_two_ways(sample, best, &rival)
          : NULL;
  if (cell != NULL) {
    const SbTextTableCell text = {cell, strlen(cell)};
    double value[2] = {0};
    (void)sb_text_table_number(&value[0], &text, &best->dialect, NULL);
    (void)sb_text_table_number(&value[1], &text, &rival.dialect, NULL);
    sb_issues_add(issues, table->shown, 0, "decimal", "point, comma",
                  "is ambiguous: \"%s\" is %g with a decimal %s, %g with a decimal %s", cell,
                  value[0], best->dialect.decimal == '.' ? "point" : "comma", value[1],
                  rival.dialect.decimal == '.' ? "point" : "comma");
    return false;
  }
  return true;
}

// ---- Header ----

static bool is_unit(const char *text) {
  static const char *const units[] = {
      "s",    "sec",    "ms",  "min", "h",  "m",  "cm", "mm", "µm",  "um",  "nm",  "in",
      "inch", "mil",    "ft",  "N",   "kN", "mN", "cN", "gf", "kgf", "kp",  "lbf", "ozf",
      "g",    "kg",     "V",   "mV",  "%",  "°C", "K",  "Pa", "kPa", "MPa", "bar", "psi",
      "mm/s", "mm/min", "m/s", "Nm",  "J",  "-",  "1",  "Hz", "µs",  NULL};
  return g_strv_contains(units, text);
}

// The two letters that look like a µ are one.
static char *unit_text(const char *text, size_t length) {
  g_autofree char *one = g_strndup(text, length);
  g_auto(GStrv) parts = g_strsplit(g_strstrip(one), "\xce\xbc", -1);
  return g_strjoinv("\xc2\xb5", parts);
}

// "Force [N]", "Kraft / N", "load_N" -> name and unit. Both owned by the caller.
static void split_name(char **name, char **unit, const char *text) {
  const size_t length = strlen(text);
  const char last = length > 0 ? text[length - 1] : '\0';
  const char *open = last == ']' ? strrchr(text, '[') : last == ')' ? strrchr(text, '(') : NULL;
  const char *end = NULL, *start = NULL;
  if (open != NULL) {
    end = open;
    start = open + 1;
    *unit = unit_text(start, length - 1 - (size_t)(start - text));
  } else {
    static const char *const links[] = {" in ", "/", "_", ",", " "};
    *unit = NULL;
    for (size_t i = 0; i < G_N_ELEMENTS(links) && *unit == NULL; i++) {
      const char *link = g_strrstr(text, links[i]);
      start = link != NULL ? link + strlen(links[i]) : NULL;
      g_autofree char *tail = link != NULL ? unit_text(start, strlen(start)) : NULL;
      if (link != NULL && link > text && is_unit(tail)) {
        end = link;
        *unit = g_steal_pointer(&tail);
      }
    }
  }
  *name = g_strndup(text, end != NULL ? (size_t)(end - text) : length);
  g_strstrip(*name);
  if (*unit == NULL) {
    *unit = g_strdup("");
  }
}

// A header line's cells as texts, NULL-terminated; with blanks as separators a unit goes to the
// name before it.
static char **header_cells(const GString *line, const SbTextTableDialect *dialect) {
  SbTextTableCell cell[SB_TEXT_TABLE_COLUMNS_MAX];
  const bool comment = line->len > 0 && line->str[0] == '#';
  const size_t cells =
      sb_text_table_split(cell, line->str + comment, line->len - comment, dialect->separator);
  GPtrArray *out = g_ptr_array_new();
  for (size_t i = 0; i < cells; i++) {
    char *text = sb_text_table_utf8(cell[i].text, cell[i].length, dialect->encoding);
    if (dialect->separator == ' ' && out->len > 0 && *text != '\0' && strchr("[(", *text) != NULL) {
      char *before = out->pdata[out->len - 1];
      out->pdata[out->len - 1] = g_strconcat(before, " ", text, NULL);
      g_free(before);
      g_free(text);
    } else {
      g_ptr_array_add(out, text);
    }
  }
  g_ptr_array_add(out, NULL);
  return (char **)g_ptr_array_free(out, FALSE);
}

static bool are_units(char **cells) {
  bool any = false;
  for (char **cell = cells; *cell != NULL; cell++) {
    const size_t length = strlen(*cell);
    const bool bracketed = length >= 2 && ((**cell == '[' && (*cell)[length - 1] == ']') ||
                                           (**cell == '(' && (*cell)[length - 1] == ')'));
    g_autofree char *plain = unit_text(*cell, length);
    if (length > 0 && !bracketed && !is_unit(plain)) {
      return false;
    }
    any |= length > 0;
  }
  return any;
}

static void set_unit(SbTextTableColumn *column, const char *text) {
  const size_t length = strlen(text);
  const bool bracketed = length >= 2 && strchr("[(", *text) != NULL;
  g_free(column->unit);
  column->unit = bracketed ? unit_text(text + 1, length - 2) : unit_text(text, length);
}

// Names and units from the last header lines that have as many cells as the rows.
static void read_header(SbTextTable *table, const Sample *sample) {
  bool named = false, united = false;
  for (size_t i = table->header_lines, back = 0; i-- > 0 && back < 4 && !named; back++) {
    const GString *line = sample->line->pdata[i];
    g_auto(GStrv) cells = header_cells(line, &table->dialect);
    const size_t count = g_strv_length(cells);
    if (line->len == 0) {
      continue;
    }
    if (count != table->columns || count < 2) {
      break;
    }
    const bool units = !united && are_units(cells);
    for (size_t k = 0; k < count; k++) {
      SbTextTableColumn *column = &table->column[k];
      if (units) {
        set_unit(column, cells[k]);
        continue;
      }
      char *name, *unit;
      split_name(&name, &unit, cells[k]);
      g_free(column->name);
      column->name = name;
      if (*column->unit == '\0') {
        g_free(column->unit);
        column->unit = unit;
      } else {
        g_free(unit);
      }
    }
    united |= units;
    named = !units;
  }
}

// Half as many names as cells, and no point anywhere: the comma may be both.
static bool refuse_double_comma(const SbTextTable *table, const Sample *sample, const Fit *fit,
                                const SbTextTableDialect *wish, GPtrArray *issues) {
  if (fit->dialect.separator != ',' || (fit->saw & SB_TEXT_TABLE_SAW_DECIMAL) != 0 ||
      table->header_lines == 0 || wish->separator != '\0') {
    return false;
  }
  g_auto(GStrv) cells = header_cells(sample->line->pdata[table->header_lines - 1], &table->dialect);
  const size_t names = g_strv_length(cells);
  if (names < 2 || fit->cells != 2 * names) {
    return false;
  }
  sb_issues_add(
      issues, table->shown, (int)table->header_lines + 1, "separator", NULL,
      "is ambiguous: %zu cells a row separated by commas, or %zu numbers with "
      "decimal commas under the %zu names of the header: export it with another separator",
      fit->cells, names, names);
  return true;
}

// ---- The file ----

static SbTextTableEncoding encoding_of(const SbTextTableBytes *bytes) {
  size_t looked = MIN(bytes->length, ENCODING_BYTES);
  if (bytes->file < 0) {
    return find_encoding(bytes->bytes, looked, bytes->length);
  }
  g_autofree guint8 *head = g_malloc0(ENCODING_BYTES);
  const ssize_t got = pread(bytes->file, head, looked, 0);
  return find_encoding(head, got > 0 ? (size_t)got : 0, bytes->length);
}

static bool recognise(SbTextTable *table, const SbTextTableDialect *wish, GPtrArray *issues) {
  static const SbTextTableDialect nothing = {0};
  wish = wish != NULL ? wish : &nothing;
  table->dialect.encoding =
      wish->encoding != SB_TEXT_TABLE_ANY_ENCODING ? wish->encoding : encoding_of(&table->bytes);
  Sample sample = take_sample(table);
  if (sample.wrong != NULL) {
    sb_issues_add(issues, table->shown, 0, NULL, NULL, "%s", sample.wrong);
    g_ptr_array_unref(sample.line);
    return false;
  }
  Fit fit;
  bool good = find_dialect(&fit, table, &sample, wish, issues);
  if (good) {
    table->dialect = fit.dialect;
    table->columns = fit.cells;
    for (size_t i = 0; i < fit.cells; i++) {
      table->column[i] = (SbTextTableColumn){.name = g_strdup(""),
                                             .unit = g_strdup(""),
                                             .numeric = (fit.numeric >> i & 1) != 0,
                                             .clock = (fit.clocks >> i & 1) != 0};
    }
    const Shape row = {.cells = fit.cells, .numeric = fit.numeric, .clocks = fit.clocks};
    for (size_t i = 0; i < sample.head; i++) {
      const Shape shape = shape_of(sample.line->pdata[i], &table->dialect);
      if (same_shape(&shape, &row)) {
        break;
      }
      table->header_lines++;
    }
    if (refuse_double_comma(table, &sample, &fit, wish, issues)) {
      good = false;
    } else {
      read_header(table, &sample);
      // Marks between thousands are taken where a decimal mark tells them apart.
      const bool grouped = (fit.saw & SB_TEXT_TABLE_SAW_GROUPS) != 0;
      if (!grouped && fit.saw != SB_TEXT_TABLE_SAW_DECIMAL) {
        table->dialect.thousands = '\0';
      }
    }
  }
  g_ptr_array_unref(sample.line);
  return good;
}

SbTextTable *sb_text_table_parse(const void *bytes, size_t length, const SbTextTableDialect *wish,
                                 const char *name, GPtrArray *issues) {
  g_autoptr(SbTextTable) table = g_new0(SbTextTable, 1);
  table->shown = g_strdup(name);
  table->bytes = (SbTextTableBytes){-1, g_malloc0(length + 1), length}; // never NULL
  if (length > 0) {
    memcpy(table->bytes.bytes, bytes, length);
  }
  return recognise(table, wish, issues) ? g_steal_pointer(&table) : NULL;
}

SbTextTable *sb_text_table_open(const char *path, const SbTextTableDialect *wish,
                                GPtrArray *issues) {
  g_autoptr(SbTextTable) table = g_new0(SbTextTable, 1);
  table->shown = g_strdup(path);
  table->bytes.file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  struct stat info;
  if (table->bytes.file < 0 || fstat(table->bytes.file, &info) != 0) {
    sb_issues_add(issues, path, 0, NULL, NULL, "%s", g_strerror(errno));
  } else if (S_ISFIFO(info.st_mode) && sb_reader_reads_pipes()) {
    size_t length = 0;
    g_autofree char *text =
        sb_reader_load_stream(&length, table->bytes.file, path, PIPE_BYTES, issues);
    return text != NULL ? sb_text_table_parse(text, length, wish, path, issues) : NULL;
  } else if (!S_ISREG(info.st_mode)) {
    sb_issues_add(issues, path, 0, NULL, NULL, "is not a regular file");
  } else if (info.st_size == 0) {
    sb_issues_add(issues, path, 0, NULL, NULL, "is empty");
  } else {
    sb_output_note_input(&info);
    table->bytes.length = (size_t)info.st_size;
    return recognise(table, wish, issues) ? g_steal_pointer(&table) : NULL;
  }
  return NULL;
}

void sb_text_table_free(SbTextTable *table) {
  if (table == NULL) {
    return;
  }
  if (table->bytes.file >= 0) {
    close(table->bytes.file);
  }
  g_free(table->bytes.bytes);
  for (size_t i = 0; i < table->columns; i++) {
    g_free(table->column[i].name);
    g_free(table->column[i].unit);
  }
  g_free(table->shown);
  g_free(table);
}

const SbTextTableDialect *sb_text_table_dialect(const SbTextTable *table) {
  return &table->dialect;
}

size_t sb_text_table_columns(const SbTextTable *table) {
  return table->columns;
}

const SbTextTableColumn *sb_text_table_column(const SbTextTable *table, size_t index) {
  return &table->column[index];
}

size_t sb_text_table_header_lines(const SbTextTable *table) {
  return table->header_lines;
}

void sb_text_table_rename(SbTextTable *table, size_t index, const char *name, const char *unit) {
  SbTextTableColumn *column = &table->column[index];
  if (name != NULL) {
    g_free(column->name);
    column->name = g_strdup(name);
  }
  if (unit != NULL) {
    g_free(column->unit);
    column->unit = unit_text(unit, strlen(unit));
  }
}

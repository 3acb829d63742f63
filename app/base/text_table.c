// Recognises the format of a table: tries every dialect on lines from its start, middle and end,
// and uses the one in which most lines are equivalent rows of numbers. Two dialects that fit
// equally but give other values are an issue. See text_table.h.
#include "app/base/bytes.h"
#include "app/base/text_table_private.h"

// Lines that are looked at.
typedef struct {
  GArray *line; // of GString
  size_t head;  // of them from the start of the file, without a gap
  bool quoted;  // one has a quote
} Sample;

// Longest line, and start that is looked at for the encoding [bytes].
enum { LONGEST_LINE = 1 << 26, HEAD_BYTES = 1 << 16 };
enum { SAMPLE_LINES = 3000, SAMPLE_BYTES = 1 << 18, SAMPLE_TAIL = 300, LINE_BYTES = 1 << 16 };

const char *const sb_text_table_encodings[] = {"any",      "utf-8",     "latin-1", "utf-16le",
                                               "utf-16be", "shift-jis", "gbk",     NULL};

// Whether text that is not UTF-8 is Shift-JIS, or GBK, rather than Windows-1252: pairs of bytes
// only, of which some begin where Windows-1252 has rare signs, or all have two bytes beyond 0xa0.
static bool is_paired(const guint8 *bytes, size_t length, bool gbk) {
  size_t common = 0;
  for (size_t i = 0; i < length; i++) {
    const guint8 c = bytes[i], next = i + 1 < length ? bytes[i + 1] : 0xa1;
    const bool pair = gbk ? c >= 0x80 : (c >= 0x81 && c <= 0x9f) || (c >= 0xe0 && c <= 0xfc);
    const bool good = gbk ? MIN(c, next) > 0xa0 : next >= 0x40 && next != 0x7f && next <= 0xfc;
    if (pair && !good) {
      return false;
    }
    common += pair && (gbk || c <= 0x9f);
    i += pair;
  }
  return common >= 2;
}

static SbTextTableEncoding find_encoding(const guint8 *bytes, size_t length) {
  const size_t looked = MIN(length, HEAD_BYTES);
  // Half of the bytes of digits in UTF-16 are zero, those of one side; a mark states it too.
  size_t zero[2] = {sb_bytes_begin(bytes, length, "\xfe\xff") ? looked : 0,
                    sb_bytes_begin(bytes, length, "\xff\xfe") ? looked : 0};
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
  return good                              ? SB_TEXT_TABLE_UTF8
         : is_paired(bytes, looked, false) ? SB_TEXT_TABLE_SHIFT_JIS
         : is_paired(bytes, looked, true)  ? SB_TEXT_TABLE_GBK
                                           : SB_TEXT_TABLE_LATIN1;
}

// Returns text in UTF-16 as UTF-8, with ? for half of a pair. Freed by g_string_free().
static GString *narrow(const guint8 *bytes, size_t length, bool big) {
  GString *text = g_string_sized_new(length / 2);
  for (size_t i = 0; i + 1 < length; i += 2) {
    const gunichar unit = (gunichar)(bytes[i + !big] << 8 | bytes[i + big]);
    if (i > 0 || (unit != 0xfeff && unit != 0xfffe)) {
      g_string_append_unichar(text, unit >= 0xd800 && unit < 0xe000 ? '?' : unit);
    }
  }
  return text;
}

// Appends a line in an old encoding; without one of its codes, each byte is a character.
static void add_old(GString *text, const char *line, size_t length, SbTextTableEncoding encoding) {
  const char *from = encoding == SB_TEXT_TABLE_LATIN1 ? "CP1252"
                     : encoding == SB_TEXT_TABLE_GBK  ? "GB18030"
                                                      : "CP932";
  gsize size;
  g_autofree char *known = g_convert(line, (gssize)length, "UTF-8", from, NULL, &size, NULL);
  g_string_append_len(text, known, known != NULL ? (gssize)size : 0);
  for (size_t i = 0; known == NULL && i < length; i++) {
    g_string_append_unichar(text, (guchar)line[i]);
  }
}

// Splits bytes into lines. Returns NULL, or why they are not the text of a table; static.
static const char *split_lines(SbTextTableFile *file, const char *bytes, size_t length,
                               SbTextTableEncoding code) {
  const size_t looked = MIN(length, HEAD_BYTES);
  const bool big = code == SB_TEXT_TABLE_UTF16BE, wide = big || code == SB_TEXT_TABLE_UTF16LE;
  const bool newline = memchr(bytes, '\n', looked) != NULL || memchr(bytes, '\r', looked) == NULL;
  g_autoptr(GString) narrowed = wide ? narrow((const guint8 *)bytes, length, big) : NULL;
  const char *from = wide ? narrowed->str : bytes, *end = from + (wide ? narrowed->len : length);
  from += sb_bytes_begin(from, (size_t)(end - from), "\xef\xbb\xbf") ? 3 : 0;
  bool good = true;
  for (const char *stop; from < end && good; from = stop + 1) {
    stop = memchr(from, newline ? '\n' : '\r', (size_t)(end - from));
    stop = stop != NULL ? stop : end;
    const char *last = stop;
    while (last > from && last[-1] == '\r') {
      last--;
    }
    GString line = {.allocated_len = file->text->len};
    // Programs mix encodings.
    if (wide || code == SB_TEXT_TABLE_UTF8 || g_utf8_validate(from, last - from, NULL)) {
      g_string_append_len(file->text, from, last - from);
    } else {
      add_old(file->text, from, (size_t)(last - from), code);
    }
    line.len = file->text->len - line.allocated_len;
    good = line.len <= LONGEST_LINE;
    g_string_append_c(file->text, '\0');
    g_array_append_val(file->line, line);
  }
  for (guint i = 0; i < file->line->len; i++) {
    GString *line = &g_array_index(file->line, GString, i);
    line->str = file->text->str + line->allocated_len;
  }
  return good ? NULL : "has a line of more than 64 MiB";
}

// Takes lines from the start and, behind them, from three places, the last one at the end.
static Sample take_sample(GArray *taken, const GArray *lines) {
  Sample sample = {.line = taken};
  for (size_t part = 0; part <= 3; part++) {
    const size_t end = lines->len - MIN(lines->len, SAMPLE_TAIL);
    size_t i = MIN(part * (lines->len / 3), end),
           bytes = part == 0 || i > sample.head ? 0 : SAMPLE_BYTES;
    const size_t stop = MIN(i + (part == 0 ? SAMPLE_LINES : SAMPLE_TAIL), lines->len);
    for (; i < stop && bytes < SAMPLE_BYTES; i++) {
      GString line = g_array_index(lines, GString, i);
      bytes += line.len + 1;
      line.len = MIN(line.len, LINE_BYTES);
      g_array_append_val(taken, line);
      sample.head += part == 0;
      sample.quoted |= memchr(line.str, '"', line.len) != NULL;
    }
  }
  return sample;
}

// How well a dialect fits: rows of the same number of cells and the same kinds in their columns.
typedef struct {
  SbTextTableDialect dialect;
  SbTextTableShape shape; // of most rows
  double score;
} Fit;

SbTextTableShape sb_text_table_shape(const GString *line, const SbTextTableDialect *dialect) {
  SbTextTableCell cell;
  SbTextTableShape shape = {0};
  const bool pairs = dialect->separator == SB_TEXT_TABLE_PAIRS;
  const char *at = line->len > 0 && strspn(line->str, "#%!") == 0 ? line->str : NULL;
  for (size_t i = 0; (dialect->matrix || i < SB_TEXT_TABLE_COLUMNS_MAX) &&
                     sb_text_table_cell(&cell, &at, line->str + line->len, dialect->separator);
       i++) {
    const guint64 bit = G_GUINT64_CONSTANT(1) << MIN(i, SB_TEXT_TABLE_COLUMNS_MAX - 1);
    const char *mark = pairs ? memchr(cell.text, ',', cell.length) : NULL;
    const size_t decimals = mark != NULL ? (size_t)(cell.text + cell.length - mark - 1) : 0;
    shape.decimals = shape.decimals == 0 ? decimals : shape.decimals;
    double value;
    SbTextTableClock clock;
    if (sb_text_table_number(&value, &cell, dialect, &shape.saw) &&
        (!pairs || isnan(value) || (decimals > 0 && decimals == shape.decimals))) {
      shape.numeric |= bit;
    } else if (!dialect->matrix && sb_text_table_clock(&clock, &cell, dialect->dates)) {
      shape.clocks |= bit;
    } else if (!sb_text_table_void(&cell)) {
      shape.texts |= bit;
    }
    shape.cells = cell.length > 0 ? i + 1 : shape.cells;
    shape.span = i + 1;
  }
  return shape;
}

// Whether two lines are rows of one table: numbers, times and texts are in the same columns. A cell
// may be empty; in a matrix, a row may have another length.
static bool same_shape(const SbTextTableShape *a, const SbTextTableShape *b, bool matrix) {
  const guint64 values = a->numeric | a->clocks, others = b->numeric | b->clocks;
  return matrix ? a->cells > 0 && b->cells > 0 && (a->texts | b->texts) == 0 &&
                      a->decimals == b->decimals
                : a->cells <= b->span && b->cells <= a->span && (a->texts & others) == 0 &&
                      (b->texts & values) == 0 && (a->numeric & b->clocks) == 0 &&
                      (b->numeric & a->clocks) == 0;
}

static Fit try_dialect(const Sample *sample, const SbTextTableDialect *dialect) {
  enum { SHAPES = 32 };
  SbTextTableShape seen[SHAPES];
  size_t count = 0, names = 0, rows[SHAPES] = {0};
  for (guint i = 0; i < sample->line->len; i++) {
    const SbTextTableShape shape =
        sb_text_table_shape(&g_array_index(sample->line, GString, i), dialect);
    names = (size_t)__builtin_popcountll(shape.texts) == shape.cells ? shape.cells : names;
    size_t at = 0;
    while (at < count && !same_shape(&seen[at], &shape, dialect->matrix)) {
      at++;
    }
    const bool row = dialect->matrix ? shape.cells > 0 && shape.texts == 0
                                     : __builtin_popcountll(shape.numeric | shape.clocks) >= 2;
    if (!row || at == SHAPES) {
      continue;
    }
    if (at == count) {
      seen[count++] = shape;
    }
    seen[at].cells = MAX(seen[at].cells, shape.cells);
    seen[at].span = MAX(seen[at].span, shape.span);
    seen[at].numeric |= shape.numeric;
    seen[at].clocks |= shape.clocks;
    seen[at].texts |= shape.texts;
    seen[at].saw |= shape.saw;
    rows[at]++;
  }
  Fit fit = {.dialect = *dialect};
  for (size_t i = 0; i < count; i++) {
    const double columns = (double)MIN(seen[i].cells, SB_TEXT_TABLE_COLUMNS_MAX);
    const double share = (double)__builtin_popcountll(seen[i].numeric | seen[i].clocks) / columns;
    const double score = (double)rows[i] * share * share;
    if (rows[i] >= (dialect->matrix ? 1 : 2) && score > fit.score) {
      fit = (Fit){*dialect, seen[i], score};
    }
  }
  // Commas are separators, or decimal marks, as in a line of names.
  fit.score *= dialect->matrix && names > 1 && names == fit.shape.cells ? 1.01 : 1;
  // Who sets marks between thousands mostly sets them everywhere.
  const unsigned both = SB_TEXT_TABLE_SAW_GROUPS | SB_TEXT_TABLE_SAW_LONG;
  if ((fit.shape.saw & both) == both || (fit.shape.saw & SB_TEXT_TABLE_SAW_BLANK) != 0 ||
      (dialect->matrix && (fit.shape.saw & SB_TEXT_TABLE_SAW_PADDED) != 0)) {
    fit.score *= 0.5;
  }
  return fit;
}

// Refuses a file that two dialects read equally well with other values: false with an issue.
static bool accept(const SbTextTable *table, const Sample *sample, const Fit *best,
                   const Fit *rival, GPtrArray *issues) {
  if (best->shape.cells != rival->shape.cells) {
    return sb_issues_add_choice(
        issues, table->file->shown, 0, "decimal", "point\ncomma", false,
        "is ambiguous: %zu columns with decimal commas or %zu columns separated by commas",
        best->shape.cells, rival->shape.cells);
  }
  const bool grouped = ((best->shape.saw | rival->shape.saw) & SB_TEXT_TABLE_SAW_GROUPS) != 0;
  SbTextTableCell cell[SB_TEXT_TABLE_COLUMNS_MAX];
  // The first cell that has another value in the other dialect.
  for (guint i = 0; grouped && i < sample->line->len; i++) {
    const GString *line = &g_array_index(sample->line, GString, i);
    const size_t cells = sb_text_table_split(cell, line->str, line->len, best->dialect.separator);
    for (size_t k = 0; k < cells; k++) {
      double a, b;
      if (sb_text_table_number(&a, &cell[k], &best->dialect, NULL) &&
          sb_text_table_number(&b, &cell[k], &rival->dialect, NULL) && a != b) {
        return sb_issues_add_choice(
            issues, table->file->shown, 0, "decimal", "point\ncomma", false,
            "is ambiguous: \"%.*s\" is %g with a decimal %s, %g with a decimal %s",
            (int)MIN(cell[k].length, 40), cell[k].text, a,
            best->dialect.decimal == '.' ? "point" : "comma", b,
            rival->dialect.decimal == '.' ? "point" : "comma");
      }
    }
  }
  return true;
}

// The best fit of all that are wished for; false with an issue.
static bool find_dialect(Fit *best, const SbTextTable *table, const Sample *sample,
                         const SbTextTableDialect *wish, GPtrArray *issues) {
  static const char separators[] = {'\t', ';', SB_TEXT_TABLE_PAIRS, ',', '|', ' '};
  static const char marks[] = {'.', ','};
  *best = (Fit){0};
  Fit rival = {0};
  for (size_t i = 0; i < G_N_ELEMENTS(separators) * G_N_ELEMENTS(marks); i++) {
    const char separator = separators[i / 2], mark = marks[i % 2];
    const bool pairs = separator == SB_TEXT_TABLE_PAIRS;
    if ((wish->separator != '\0' && wish->separator != separator) ||
        (wish->decimal != '\0' && wish->decimal != mark) ||
        (separator == mark && !sample->quoted) || (pairs && (mark != ',' || !wish->matrix))) {
      continue;
    }
    SbTextTableDialect dialect = *wish;
    dialect.encoding = table->dialect.encoding;
    dialect.separator = separator;
    dialect.decimal = mark;
    dialect.thousands = pairs ? '\0' : marks[1 - i % 2]; // in quotes also the separator
    const Fit fit = try_dialect(sample, &dialect);
    const bool commas = wish->matrix && best->dialect.decimal == ',' && separator == ',';
    if (fit.score > best->score) {
      rival = (Fit){0};
      *best = fit;
    } else if (fit.score == best->score && fit.score > 0 &&
               (fit.dialect.separator == best->dialect.separator || commas)) {
      rival = fit;
    }
  }
  if (best->score == 0) {
    return sb_issues_add(
        issues, table->file->shown, 0, NULL, NULL, "%s",
        wish->matrix
            ? "contains no numbers"
            : "has no rows of two numbers or more, separated by tab, semicolon, comma, | or blank");
  }
  const unsigned zeros = SB_TEXT_TABLE_SAW_PADDED, marks_seen = zeros | SB_TEXT_TABLE_SAW_DECIMAL;
  if (wish->matrix && best->dialect.separator == ',' && wish->decimal == '\0' &&
      (best->shape.saw & marks_seen) == zeros) {
    return sb_issues_add_choice(
        issues, table->file->shown, 0, "decimal", "point", false,
        "is ambiguous: cells such as 012 are integers, or the decimals behind a decimal comma");
  }
  return rival.score == 0 || accept(table, sample, best, &rival, issues);
}

bool sb_text_table_is_row(const SbTextTable *table, const GString *line) {
  const SbTextTableShape s = sb_text_table_shape(line, &table->dialect);
  return (s.numeric | s.clocks) != 0 && same_shape(&s, &table->file->shape, table->dialect.matrix);
}

// Finds the line where the longest block of rows begins, and the names and units above the block.
static void find_block(SbTextTable *table, const Sample *sample) {
  // Names, of a matrix with the number of cells -> index of the first row, number of rows.
  g_autoptr(GHashTable) blocks = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
  size_t most = 0, votes = 0;
  SbTextTableBlock block = {0};
  table->header_lines = sample->head;
  for (size_t i = 0; i < sample->head; i++) {
    const GString *line = &g_array_index(sample->line, GString, i);
    const bool row = sb_text_table_is_row(table, line);
    sb_text_table_block_next(&block, row, line, table);
    if (!row) {
      continue;
    }
    const SbTextTableShape shape = sb_text_table_shape(line, &table->dialect);
    const size_t span = table->dialect.matrix ? shape.span : 0;
    table->file->texts = votes == 0 ? shape.texts : table->file->texts;
    votes += shape.texts == table->file->texts ? 1 : (size_t)-1;
    g_autofree char *names = g_strdup_printf("%zu%s", span, block.names != NULL ? block.names : "");
    size_t *found = g_hash_table_lookup(blocks, names);
    if (found == NULL) {
      found = g_new0(size_t, 2);
      found[0] = i;
      g_hash_table_insert(blocks, g_steal_pointer(&names), found);
    }
    if (++found[1] > most) {
      most = found[1];
      table->header_lines = found[0];
      g_free(table->file->names);
      table->file->names = g_strdup(block.names);
    }
  }
  g_free(block.names);
}

// Half as many names as cells, and no point anywhere: the comma may be both. False with an issue.
static bool accept_commas(const SbTextTable *table, const Sample *sample, const Fit *fit,
                          const SbTextTableDialect *wish, GPtrArray *issues) {
  if (fit->dialect.separator != ',' || (fit->shape.saw & SB_TEXT_TABLE_SAW_DECIMAL) != 0 ||
      table->header_lines == 0 || wish->separator != '\0' || wish->matrix) {
    return true;
  }
  g_auto(GStrv) cells =
      sb_text_table_header_cells(table, sb_text_table_line(table, table->header_lines - 1));
  const size_t names = g_strv_length(cells);
  return names < 2 || fit->shape.cells != 2 * names ||
         sb_issues_add_choice(
             issues, table->file->shown, (int)table->header_lines + 1, "separator", "comma", false,
             "is ambiguous: %zu cells a row separated by commas, or %zu numbers with "
             "decimal commas under the %zu names of the header: export it with another separator",
             fit->shape.cells, names, names);
}

static bool recognise(SbTextTable *table, const Sample *sample, const SbTextTableDialect *wish,
                      GPtrArray *issues) {
  Fit fit;
  if (!find_dialect(&fit, table, sample, wish, issues)) {
    return false;
  }
  table->dialect = fit.dialect;
  table->file->shape = fit.shape;
  table->columns = MIN(fit.shape.cells, SB_TEXT_TABLE_COLUMNS_MAX);
  for (size_t i = 0; i < table->columns; i++) {
    table->column[i] = (SbTextTableColumn){.name = g_strdup(""),
                                           .unit = g_strdup(""),
                                           .numeric = (fit.shape.numeric >> i & 1) != 0,
                                           .clock = (fit.shape.clocks >> i & 1) != 0};
  }
  find_block(table, sample);
  if (!accept_commas(table, sample, &fit, wish, issues)) {
    return false;
  }
  sb_text_table_take_header(table);
  // Marks between thousands are taken where a decimal mark distinguishes them.
  const unsigned saw = fit.shape.saw;
  const bool grouped = (saw & SB_TEXT_TABLE_SAW_GROUPS) != 0 || saw == SB_TEXT_TABLE_SAW_DECIMAL;
  table->dialect.thousands = grouped ? table->dialect.thousands : '\0';
  return true;
}

SbTextTable *sb_text_table_parse(const void *bytes, size_t length, const SbTextTableDialect *wish,
                                 const char *name, GPtrArray *issues) {
  // Beginnings of files that are not text, and their formats.
  static const char *const formats[][2] = {{"PK\x03\x04", "a workbook (.xlsx, .ods) or zip file"},
                                           {"\xd0\xcf\x11\xe0", "a workbook (.xls)"},
                                           {"TDSm", "a TDMS file"},
                                           {"<", "HTML or XML"},
                                           {"{", "JSON"},
                                           {"[{", "JSON"},
                                           {"%PDF", "a PDF"},
                                           {"", NULL}};
  g_autoptr(SbTextTable) table = g_new0(SbTextTable, 1);
  SbTextTableFile *file = table->file = g_new0(SbTextTableFile, 1);
  file->shown = g_strdup(name);
  file->line = g_array_new(FALSE, FALSE, sizeof(GString));
  file->text = g_string_sized_new(length + 1);
  bytes = length > 0 ? bytes : "";
  wish = wish != NULL ? wish : &(const SbTextTableDialect){0};
  const SbTextTableEncoding key = wish->encoding;
  table->dialect.encoding = key != SB_TEXT_TABLE_ANY_ENCODING ? key : find_encoding(bytes, length);
  size_t known = 0;
  while (!sb_bytes_begin(bytes, length, formats[known][0])) {
    known++;
  }
  const char *format = formats[known][1];
  const char *wrong = length == 0      ? "is empty"
                      : format != NULL ? format
                                       : split_lines(file, bytes, length, table->dialect.encoding);
  if (wrong != NULL) {
    sb_issues_add(issues, name, 0, NULL, NULL,
                  format != NULL ? "is %s: export it as text, such as CSV" : "%s", wrong);
    return NULL;
  }
  g_autoptr(GArray) taken = g_array_new(FALSE, FALSE, sizeof(GString));
  const Sample sample = take_sample(taken, file->line);
  return recognise(table, &sample, wish, issues) ? g_steal_pointer(&table) : NULL;
}

void sb_text_table_free(SbTextTable *table) {
  if (table == NULL) {
    return;
  }
  g_array_unref(table->file->line);
  g_string_free(table->file->text, TRUE);
  g_free(table->file->names);
  g_free(table->file->shown);
  g_free(table->file);
  g_strfreev(table->header);
  for (size_t i = 0; i < table->columns; i++) {
    g_free(table->column[i].name);
    g_free(table->column[i].unit);
    g_free(table->column[i].other);
  }
  g_free(table);
}

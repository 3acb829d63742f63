// Cells and numbers. A number's digits go into a whole number; up to 2^53 and powers of ten
// up to 22 one multiplication or division of exact doubles rounds right (Clinger 1990), all others
// go to the C library's conversion.
#include "app/base/number.h"
#include "app/base/text_table_private.h"

#include <math.h>
#include <string.h>

// ---- Cells ----

static bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

static SbTextTableCell trimmed(const char *text, const char *end) {
  while (text < end && is_blank(*text)) {
    text++;
  }
  while (end > text && is_blank(end[-1])) {
    end--;
  }
  if (end - text >= 2 && *text == '"' && end[-1] == '"') {
    return trimmed(text + 1, end - 1);
  }
  return (SbTextTableCell){text, (size_t)(end - text)};
}

static bool ends_cell(char c, char separator) {
  return separator == ' ' ? is_blank(c) : c == separator;
}

// Returns the end of the text in quotes with which a cell begins at `c`; `c` if it begins with none
// or no quote before a separator closes it: the quote is then a character, as in inches.
static const char *skip_quoted(const char *c, const char *end, char separator) {
  enum { QUOTED_MAX = 4096 };
  const char *at = c;
  while (at < end && is_blank(*at) && !ends_cell(*at, separator)) {
    at++;
  }
  if (at == end || *at++ != '"') {
    return c;
  }
  for (const char *most = end - at > QUOTED_MAX ? at + QUOTED_MAX : end; at < most; at++) {
    if (*at == '"' && at + 1 < end && at[1] == '"') {
      at++; // a quote within the text
    } else if (*at == '"') {
      const char *next = at + 1;
      while (next < end && is_blank(*next) && !ends_cell(*next, separator)) {
        next++;
      }
      if (next == end || ends_cell(*next, separator)) {
        return next;
      }
    }
  }
  return c;
}

bool sb_text_table_cell(SbTextTableCell *cell, const char **at, const char *end, char separator) {
  const char *c = *at;
  while (separator == ' ' && c != NULL && c < end && is_blank(*c)) {
    c++;
  }
  if (c == NULL || (separator == ' ' && c == end)) {
    return false;
  }
  const char *const first = c;
  c = skip_quoted(c, end, separator);
  while (c < end && !ends_cell(*c, separator)) {
    c++;
  }
  *cell = trimmed(first, c);
  *at = c < end ? c + 1 : NULL;
  return true;
}

size_t sb_text_table_split(SbTextTableCell *cell, const char *line, size_t length, char separator) {
  const char *at = line;
  size_t count = 0;
  while (count < SB_TEXT_TABLE_COLUMNS_MAX &&
         sb_text_table_cell(&cell[count], &at, line + length, separator)) {
    count++;
  }
  // An end of line behind a separator is not a cell.
  while (count > 0 && cell[count - 1].length == 0) {
    count--;
  }
  return count;
}

// ---- Numbers ----

// Returns the length of the first of the texts with which [c, end) begins; 0: none.
static size_t skip_one(const char *c, const char *end, const char *const *texts) {
  for (; *texts != NULL; texts++) {
    const size_t length = strlen(*texts);
    if ((size_t)(end - c) >= length && memcmp(c, *texts, length) == 0) {
      return length;
    }
  }
  return 0;
}

// Skips a sign: +, - or the minus signs and dashes of UTF-8, Windows-1252 and Shift-JIS.
static const char *skip_sign(bool *negative, const char *c, const char *end) {
  static const char *const minus[] = {"-",    "\xe2\x88\x92", "\xe2\x80\x93",
                                      "\x96", "\x81\x7c",     NULL};
  const bool digit = c < end && g_ascii_isdigit(*c); // the usual case, quickly
  const size_t length = digit ? 0 : skip_one(c, end, minus);
  *negative = length > 0;
  return c + (length > 0 ? length : (size_t)(c < end && *c == '+'));
}

// Returns the length of a mark between thousands at `c`, which three digits and no fourth follow:
// the dialect's, an apostrophe, or a blank of any kind. 0: none.
static size_t group_mark(const char *c, const char *end, char thousands) {
  static const char *const marks[] = {"'",    " ",        "\xe2\x80\x99", "\xe2\x80\xaf",
                                      "\xa0", "\xc2\xa0", "\xe2\x80\x89", NULL};
  const size_t length = thousands != '\0' && *c == thousands ? 1 : skip_one(c, end, marks);
  const char *digit = c + length;
  for (int i = 0; i < 3 && length > 0; i++, digit++) {
    if (digit >= end || !g_ascii_isdigit(*digit)) {
      return 0;
    }
  }
  return digit < end && g_ascii_isdigit(*digit) ? 0 : length;
}

// The C library's conversion of a number without sign that has too many digits, its marks replaced.
static bool read_slowly(double *out, const char *c, const char *end,
                        const SbTextTableDialect *dialect) {
  char text[SB_NUMBER_LENGTH_MAX + 1];
  size_t count = 0;
  while (c < end) {
    const size_t mark = group_mark(c, end, dialect->thousands);
    if (mark == 0 && count == SB_NUMBER_LENGTH_MAX) {
      return false;
    }
    if (mark == 0) {
      text[count++] = *c == dialect->decimal ? '.' : *c;
    }
    c += MAX(mark, 1);
  }
  text[count] = '\0';
  return sb_number_parse(out, text);
}

// Whether an instrument writes this where it has no value.
static bool is_void(const SbTextTableCell *cell) {
  static const char *const words[] = {"",        "nan",     "-nan",   "bad", "void", "nodata",
                                      "null",    "inf",     "-inf",   "*",   "***",  "---",
                                      "1.#qnan", "-1.#ind", "masked", NULL};
  const char *const *word = words;
  while (*word != NULL && (strlen(*word) != cell->length ||
                           g_ascii_strncasecmp(cell->text, *word, cell->length) != 0)) {
    word++;
  }
  return *word != NULL;
}

// Reads the digits of a number before its decimal mark.
typedef struct {
  guint64 digits;
  int taken, run; // digits from the first that is not 0; since the last mark
  unsigned saw;
} Whole;

static Whole read_whole_part(const char **at, const char *end, char thousands) {
  const char *const first = *at;
  Whole w = {0};
  const char *c = first;
  while (c < end && w.taken <= 18) {
    const bool grouped = (w.saw & SB_TEXT_TABLE_SAW_GROUPS) != 0;
    size_t mark;
    if (g_ascii_isdigit(*c)) {
      w.digits = w.digits * 10 + (guint64)(*c++ - '0');
      w.taken += w.taken > 0 || c[-1] != '0';
      w.run++;
    } else if (w.run > 0 && (grouped ? w.run == 3 : w.run <= 3 && *first != '0') &&
               (mark = group_mark(c, end, thousands)) > 0) {
      w.saw |= SB_TEXT_TABLE_SAW_GROUPS | (*c == ' ' ? SB_TEXT_TABLE_SAW_BLANK : 0);
      w.run = 0;
      c += mark;
    } else {
      break;
    }
  }
  w.saw |= w.saw == 0 && w.run > 3 ? SB_TEXT_TABLE_SAW_LONG : 0;
  *at = c;
  return w;
}

bool sb_text_table_number(double *out, const SbTextTableCell *cell,
                          const SbTextTableDialect *dialect, unsigned *saw) {
  static const double power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const char *c = cell->text, *const end = c + cell->length;
  if (dialect->matrix && is_void(cell)) {
    *out = NAN;
    return true;
  }
  bool negative, down = false;
  const char *const first = c = skip_sign(&negative, c, end);
  Whole w = read_whole_part(&c, end, dialect->thousands);
  bool any = w.run > 0;
  int exponent = 0;
  if (w.taken <= 18 && c < end && *c == dialect->decimal) {
    const char *behind = c + 1;
    for (c = behind; c < end && g_ascii_isdigit(*c) && w.taken <= 18; c++) {
      w.digits = w.digits * 10 + (guint64)(*c - '0');
      w.taken += w.taken > 0 || *c != '0';
      exponent--;
    }
    if (c == behind && (!any || dialect->decimal == ',')) {
      return false;
    }
    any = true;
    w.saw |= SB_TEXT_TABLE_SAW_DECIMAL;
  }
  if (w.taken <= 18 && c < end && (*c == 'e' || *c == 'E')) {
    int by = 0;
    c = skip_sign(&down, c + 1, end);
    any = any && c < end;
    for (; c < end && g_ascii_isdigit(*c); c++) {
      by = MIN(by * 10 + (*c - '0'), 100000);
    }
    exponent += down ? -by : by;
  }
  double size;
  if (w.taken <= 18 && (!any || c != end)) {
    return false;
  }
  if (w.taken > 18 || w.digits > (G_GUINT64_CONSTANT(1) << 53) || exponent < -22 || exponent > 22) {
    if (!read_slowly(&size, first, end, dialect)) {
      return false;
    }
  } else {
    size = exponent < 0 ? (double)w.digits / power[-exponent] : (double)w.digits * power[exponent];
  }
  *out = negative ? -size : size;
  if (saw != NULL) {
    *saw |= w.saw;
  }
  return true;
}

// ---- Clocks ----

static bool read_whole(int *out, const char **at, const char *end, int digits_max) {
  const char *c = *at;
  *out = 0;
  for (; c < end && c - *at < digits_max && g_ascii_isdigit(*c); c++) {
    *out = *out * 10 + (*c - '0');
  }
  const bool any = c > *at;
  *at = c;
  return any;
}

bool sb_text_table_clock(SbTextTableClock *out, const SbTextTableCell *cell) {
  const char *c = cell->text, *const end = c + cell->length;
  SbTextTableClock clock = {0};
  if (memchr(c, ':', cell->length) == NULL) {
    return false;
  }
  // A date: three numbers, one mark.
  const char *start = c;
  if (read_whole(&clock.date[0], &c, end, 4) && c < end && strchr("./-", *c) != NULL) {
    clock.mark = *c++;
    if (!read_whole(&clock.date[1], &c, end, 2) || c == end || *c++ != clock.mark ||
        !read_whole(&clock.date[2], &c, end, 4) || c == end || (*c != ' ' && *c != 'T')) {
      return false;
    }
    c++;
  } else {
    clock.date[0] = 0;
    c = start;
  }
  int hours, minutes, seconds = 0;
  if (!read_whole(&hours, &c, end, 2) || c == end || *c++ != ':' ||
      !read_whole(&minutes, &c, end, 2) || c == end || *c++ != ':' ||
      !read_whole(&seconds, &c, end, 2) || hours > 23 || minutes > 59 || seconds > 60) {
    return false;
  }
  double fraction = 0, unit = 1;
  if (c < end && (*c == '.' || *c == ',')) {
    for (c++; c < end && g_ascii_isdigit(*c) && unit < 1e15; c++) {
      fraction = fraction * 10 + (*c - '0');
      unit *= 10;
    }
  }
  if (end - c == 3 && c[0] == ' ' && g_ascii_toupper(c[2]) == 'M') {
    const bool after = g_ascii_toupper(c[1]) == 'P';
    hours = hours % 12 + (after ? 12 : 0);
    c = end;
  }
  clock.seconds = hours * 3600 + minutes * 60 + seconds + fraction / unit;
  if (c != end) {
    return false;
  }
  *out = clock;
  return true;
}

bool sb_text_table_days(long *days, const SbTextTableClock *clock) {
  const int *date = clock->date;
  int year = date[2], month = date[1], day = date[0];
  if (date[0] > 31) {
    year = date[0];
    day = date[2];
  } else if (date[1] > 12) {
    month = date[0];
    day = date[1];
  } else if (date[0] <= 12 && clock->mark != '.' && date[0] != date[1]) {
    return false; // 03/02: a point stands between day and month alone
  }
  GDate at;
  if (!g_date_valid_dmy((GDateDay)CLAMP(day, 0, 200), (GDateMonth)CLAMP(month, 0, 200),
                        (GDateYear)CLAMP(year, 0, 9999))) {
    return false;
  }
  g_date_clear(&at, 1);
  g_date_set_dmy(&at, (GDateDay)day, (GDateMonth)month, (GDateYear)year);
  *days = (long)g_date_get_julian(&at);
  return true;
}

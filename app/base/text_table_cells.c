// Cells, numbers and times of day.
#include "app/base/number.h"
#include "app/base/text_table_private.h"

#include <math.h>
#include <stdio.h>
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
  return separator == ' ' ? is_blank(c) : c == (separator == SB_TEXT_TABLE_PAIRS ? ',' : separator);
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
  c += separator == ' ' && end - c >= 7 && g_ascii_strncasecmp(c, "no data", 7) == 0 ? 7 : 0;
  int marks = separator == SB_TEXT_TABLE_PAIRS; // of decimals, in the cell
  while (c < end &&
         (!ends_cell(*c, separator) || (c > first && g_ascii_isdigit(c[-1]) && marks-- > 0))) {
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

// Skips a sign: +, -, or another minus sign or dash.
static const char *skip_sign(bool *negative, const char *c, const char *end) {
  static const char *const minus[] = {"-", "\xe2\x88\x92", "\xe2\x80\x93", "\xef\xbc\x8d", NULL};
  const bool digit = c < end && g_ascii_isdigit(*c); // the usual case, quickly
  const size_t length = digit ? 0 : skip_one(c, end, minus);
  *negative = length > 0;
  return c + (length > 0 ? length : (size_t)(c < end && *c == '+'));
}

// Returns the length of a mark between thousands at `c`, which three digits and no fourth follow:
// the dialect's, an apostrophe, or a blank of any kind. 0: none.
static size_t group_mark(const char *c, const char *end, char thousands) {
  static const char *const marks[] = {
      "'", " ", "\xe2\x80\x99", "\xe2\x80\xaf", "\xc2\xa0", "\xe2\x80\x89", NULL};
  const size_t length = thousands != '\0' && *c == thousands ? 1 : skip_one(c, end, marks);
  const char *digit = c + length;
  for (int i = 0; i < 3 && length > 0; i++, digit++) {
    if (digit >= end || !g_ascii_isdigit(*digit)) {
      return 0;
    }
  }
  return digit < end && g_ascii_isdigit(*digit) ? 0 : length;
}

bool sb_text_table_void(const SbTextTableCell *cell) {
  static const char *const words[] = {"",       "nan",     "-nan", "bad",     "void",    "nodata",
                                      "null",   "inf",     "-inf", "*",       "***",     "---",
                                      "masked", "no data", "n/a",  "1.#qnan", "-1.#ind", NULL};
  const char *const *word = words;
  while (*word != NULL && (strlen(*word) != cell->length ||
                           g_ascii_strncasecmp(cell->text, *word, cell->length) != 0)) {
    word++;
  }
  return *word != NULL;
}

// Writes the number with a decimal point and without other marks to `plain`, which
// sb_number_parse() reads.
bool sb_text_table_number(double *out, const SbTextTableCell *cell,
                          const SbTextTableDialect *dialect, unsigned *saw) {
  const char *c = cell->text, *const end = c + cell->length;
  if (dialect->matrix && sb_text_table_void(cell)) {
    *out = NAN;
    return true;
  }
  char plain[SB_NUMBER_LENGTH_MAX + 1];
  size_t count = 1, mark;
  unsigned seen = 0;
  int run = 0; // digits since the last mark, before the decimal mark
  bool negative, whole = true, power = false;
  const char *const first = c = skip_sign(&negative, c, end);
  plain[0] = negative ? '-' : '+';
  while (c < end && count + 1 < sizeof plain) {
    const bool grouped = (seen & SB_TEXT_TABLE_SAW_GROUPS) != 0;
    if (g_ascii_isdigit(*c)) {
      run += whole;
      plain[count++] = *c++;
    } else if (whole && run > 0 && (grouped ? run == 3 : run <= 3 && *first != '0') &&
               (mark = group_mark(c, end, dialect->thousands)) > 0) {
      seen |= SB_TEXT_TABLE_SAW_GROUPS | (*c == ' ' ? SB_TEXT_TABLE_SAW_BLANK : 0) |
              (*c == dialect->thousands ? SB_TEXT_TABLE_SAW_MARK : 0);
      run = 0;
      c += mark;
    } else if (whole && *c == dialect->decimal) {
      c++;
      if (dialect->decimal == ',' && (c == end || !g_ascii_isdigit(*c))) {
        return false;
      }
      seen |= SB_TEXT_TABLE_SAW_DECIMAL;
      whole = false;
      plain[count++] = '.';
    } else if (!power && (*c == 'e' || *c == 'E')) {
      c = skip_sign(&negative, c + 1, end);
      whole = false;
      power = true;
      plain[count++] = 'e';
      plain[count] = negative ? '-' : '+';
      count += count + 1 < sizeof plain;
    } else {
      return false;
    }
  }
  plain[count] = '\0';
  if (c < end || !sb_number_parse(out, plain)) {
    return false;
  }
  if (saw != NULL) {
    const bool padded = *first == '0' && (run > 1 || (whole && plain[0] == '-'));
    *saw |= (padded ? SB_TEXT_TABLE_SAW_PADDED : 0) | seen |
            (run > 3 && (seen & SB_TEXT_TABLE_SAW_GROUPS) == 0 ? SB_TEXT_TABLE_SAW_LONG : 0);
  }
  return true;
}

// ---- Clocks ----

bool sb_text_table_clock(SbTextTableClock *out, const SbTextTableCell *cell) {
  char text[48], mark[3] = "", half = '\0';
  SbTextTableClock clock = {0};
  int time[3], *date = clock.date, used = 0;
  if (memchr(cell->text, ':', cell->length) == NULL || cell->length >= sizeof text ||
      strspn(cell->text, "0123456789") == 0) {
    return false;
  }
  memcpy(text, cell->text, cell->length);
  text[cell->length] = '\0';
  const char *c = text;
  if (sscanf(c, "%4d%c%2d%c%4d%c%n", &date[0], &mark[0], &date[1], &mark[1], &date[2], &mark[2],
             &used) == 6 &&
      mark[0] != ':') {
    if (strchr("./-", mark[0]) == NULL || mark[1] != mark[0] ||
        (mark[2] != ' ' && mark[2] != 'T')) {
      return false;
    }
    clock.mark = mark[0];
    c += used;
  } else {
    memset(clock.date, 0, sizeof clock.date);
  }
  used = 0;
  if (sscanf(c, "%2d:%2d:%2d%n", &time[0], &time[1], &time[2], &used) != 3 || used == 0 ||
      time[0] > 23 || time[1] > 59 || time[2] > 60 || strpbrk(c, "+-") != NULL) {
    return false;
  }
  double fraction = 0;
  c += used;
  if (*c == '.' || *c == ',') {
    text[c - text] = '.';
    c += MAX(sb_number_read(&fraction, c), 1);
  }
  used = 0;
  if (sscanf(c, " %c%*1[mM]%n", &half, &used) == 1 && used == 3) {
    time[0] = time[0] % 12 + (g_ascii_toupper(half) == 'P' ? 12 : 0);
    c += used;
  }
  clock.seconds = time[0] * 3600 + time[1] * 60 + time[2] + fraction;
  *out = *c == '\0' ? clock : *out;
  return *c == '\0';
}

bool sb_text_table_days(long *days, const SbTextTableClock *clock, char dates) {
  const int *date = clock->date;
  const bool year_first = date[0] > 31;
  const bool month_first = !year_first && (date[1] > 12 || (dates == 'm' && date[0] <= 12));
  const int year = year_first ? date[0] : date[2];
  const int month = month_first ? date[0] : date[1];
  const int day = year_first ? date[2] : month_first ? date[1] : date[0];
  // 03/02: a point alone is between day and month.
  const bool ambiguous = dates == '\0' && !year_first && !month_first && date[0] <= 12 &&
                         clock->mark != '.' && date[0] != date[1];
  if (ambiguous ||
      !g_date_valid_dmy((GDateDay)MIN(day, 200), (GDateMonth)MIN(month, 200), (GDateYear)year)) {
    return false;
  }
  g_autoptr(GDate) at = g_date_new_dmy((GDateDay)day, (GDateMonth)month, (GDateYear)year);
  *days = (long)g_date_get_julian(at);
  return true;
}

// Cells, numbers and times of day.
#include "app/base/number.h"
#include "app/base/text_table_private.h"

#include <stdlib.h>

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
  const gssize length = cell->length <= strlen("no data") ? (gssize)cell->length : 0; // the longest
  g_autofree char *text = g_ascii_strdown(cell->text, length);
  return strlen(text) == cell->length && g_strv_contains(words, text);
}

// Rewrites the number with no mark but a decimal point for sb_number_parse(), which checks it.
bool sb_text_table_number(double *out, const SbTextTableCell *cell,
                          const SbTextTableDialect *dialect, unsigned *saw) {
  static const char *const minus[] = {"-", "\xe2\x88\x92", "\xe2\x80\x93", "\xef\xbc\x8d", NULL};
  const char *c = cell->text, *const end = c + cell->length;
  if (dialect->matrix && sb_text_table_void(cell)) {
    *out = NAN;
    return true;
  }
  char plain[SB_NUMBER_LENGTH_MAX + 1], first = '\0'; // first: the first digit
  size_t count = 0, length;
  unsigned seen = 0;
  int run = 0; // digits since the last mark, before the decimal mark
  bool whole = true;
  while (c < end && count + 1 < sizeof plain) {
    const bool grouped = (seen & SB_TEXT_TABLE_SAW_GROUPS) != 0;
    if (g_ascii_isdigit(*c)) {
      first = first == '\0' ? *c : first;
      run += whole;
      plain[count++] = *c++;
    } else if (whole && run > 0 && (grouped ? run == 3 : run <= 3 && first != '0') &&
               (length = group_mark(c, end, dialect->thousands)) > 0) {
      seen |= SB_TEXT_TABLE_SAW_GROUPS | (*c == ' ' ? SB_TEXT_TABLE_SAW_BLANK : 0);
      run = 0;
      c += length;
    } else if (whole && *c == dialect->decimal) {
      c++;
      if (dialect->decimal == ',' && (c == end || !g_ascii_isdigit(*c))) {
        return false;
      }
      seen |= SB_TEXT_TABLE_SAW_DECIMAL;
      whole = false;
      plain[count++] = '.';
    } else if (*c == 'e' || *c == 'E' || *c == '+') {
      whole = whole && *c == '+';
      plain[count++] = *c++;
    } else if ((length = skip_one(c, end, minus)) > 0) {
      plain[count++] = '-';
      c += length;
    } else {
      return false;
    }
  }
  plain[count] = '\0';
  if (c < end || !sb_number_parse(out, plain)) {
    return false;
  }
  if (saw != NULL) {
    const bool padded = first == '0' && (run > 1 || (whole && plain[0] == '-'));
    *saw |= (padded ? SB_TEXT_TABLE_SAW_PADDED : 0) | seen |
            (run > 3 && (seen & SB_TEXT_TABLE_SAW_GROUPS) == 0 ? SB_TEXT_TABLE_SAW_LONG : 0);
  }
  return true;
}

// Returns the number of a day; 0: there is no such date.
static guint32 day_of(int day, int month, int year) {
  const bool valid =
      day <= 31 && month <= 12 && g_date_valid_dmy((GDateDay)day, month, (GDateYear)year);
  g_autoptr(GDate) at = valid ? g_date_new_dmy((GDateDay)day, month, (GDateYear)year) : NULL;
  return valid ? g_date_get_julian(at) : 0;
}

bool sb_text_table_clock(SbTextTableClock *out, const SbTextTableCell *cell, char dates) {
  static const char form[] = "^(?:(\\d{1,4})([./-])(\\d\\d?)\\2(\\d{1,4})[ T])?(\\d\\d?):"
                             "(\\d\\d?):(\\d\\d?)(?:[.,](\\d*))? *(?:([AP])M)?$";
  enum { YEAR = 1, MARK, MONTH, DAY, HOUR, MINUTE, SECOND, FRACTION, HALF, PARTS };
  static GRegex *regex; // compiled once, never freed
  g_autoptr(GMatchInfo) match = NULL;
  if (g_once_init_enter(&regex)) {
    g_once_init_leave(&regex, g_regex_new(form, G_REGEX_CASELESS | G_REGEX_RAW, 0, NULL));
  }
  if (memchr(cell->text, ':', cell->length) == NULL ||
      !g_regex_match_full(regex, cell->text, (gssize)cell->length, 0, 0, &match, NULL)) {
    return false;
  }
  const char *part[PARTS];
  int n[PARTS] = {0}, digits = 0;
  for (int i = 1, begin, end; i < PARTS; i++) {
    const bool has = g_match_info_fetch_pos(match, i, &begin, &end) && begin >= 0;
    part[i] = has ? cell->text + begin : "";
    n[i] = has && i != FRACTION ? atoi(part[i]) : 0;
    digits = has && i == FRACTION ? end - begin : digits;
  }
  const double fraction = digits > 0 ? strtod(part[FRACTION], NULL) / pow(10, digits) : 0;
  const bool late = g_ascii_toupper(*part[HALF]) == 'P';
  const int hour = *part[HALF] != '\0' ? n[HOUR] % 12 + 12 * late : n[HOUR];
  const bool year_first = n[YEAR] > 31;
  const guint32 day_first =
      day_of(year_first ? n[DAY] : n[YEAR], n[MONTH], n[year_first ? YEAR : DAY]);
  const guint32 month_first = year_first ? 0 : day_of(n[MONTH], n[YEAR], n[DAY]);
  const bool either = day_first > 0 && month_first > 0 && day_first != month_first;
  *out = (SbTextTableClock){
      .seconds = hour * 3600 + n[MINUTE] * 60 + n[SECOND] + fraction,
      .day = day_first == 0 || (either && dates == 'm') ? month_first : day_first,
      .ambiguous = either && dates == '\0' && *part[MARK] != '.'}; // a point: day first
  return n[HOUR] <= 23 && n[MINUTE] <= 59 && n[SECOND] <= 60;
}

// Cells and numbers. A number's digits go into a whole number; up to 2^53 and powers of ten
// up to 22 one multiplication or division of exact doubles rounds right (Clinger 1990), all others
// go to the C library's conversion.
#include "app/base/number.h"
#include "app/base/text_table_private.h"

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

size_t sb_text_table_split(SbTextTableCell *cell, const char *line, size_t length, char separator) {
  const char *c = line, *const end = line + length;
  size_t count = 0;
  if (separator == ' ') {
    while (count < SB_TEXT_TABLE_COLUMNS_MAX) {
      while (c < end && is_blank(*c)) {
        c++;
      }
      if (c == end) {
        break;
      }
      const char *first = c;
      while (c < end && !is_blank(*c)) {
        c++;
      }
      cell[count++] = trimmed(first, c);
    }
    return count;
  }
  while (count < SB_TEXT_TABLE_COLUMNS_MAX) {
    const char *first = c;
    bool quoted = false;
    while (c < end && (quoted || *c != separator)) {
      quoted ^= *c == '"';
      c++;
    }
    cell[count++] = trimmed(first, c);
    if (c == end) {
      break;
    }
    c++;
  }
  // An end of line behind a separator is no cell.
  while (count > 0 && cell[count - 1].length == 0) {
    count--;
  }
  return count;
}

// ---- Numbers ----

// The C library's conversion of what has too many digits, its marks replaced.
static bool read_slowly(double *out, const SbTextTableCell *cell,
                        const SbTextTableDialect *dialect) {
  char text[SB_NUMBER_LENGTH_MAX + 1];
  size_t count = 0;
  for (size_t i = 0; i < cell->length; i++) {
    const char c = cell->text[i];
    if (c == dialect->thousands && c != '\0') {
      continue;
    }
    if (count == SB_NUMBER_LENGTH_MAX) {
      return false;
    }
    text[count++] = c == dialect->decimal ? '.' : c;
  }
  text[count] = '\0';
  return sb_number_parse(out, text);
}

// Whether a mark between thousands stands at `c`: three digits behind it and no fourth.
static bool is_group(const char *c, const char *end) {
  return end - c > 3 && g_ascii_isdigit(c[1]) && g_ascii_isdigit(c[2]) && g_ascii_isdigit(c[3]) &&
         !(end - c > 4 && g_ascii_isdigit(c[4]));
}

bool sb_text_table_number(double *out, const SbTextTableCell *cell,
                          const SbTextTableDialect *dialect, unsigned *saw) {
  static const double power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const char *c = cell->text, *const end = c + cell->length;
  const bool negative = c < end && *c == '-';
  c += c < end && (*c == '-' || *c == '+');
  const char *const first = c;
  guint64 digits = 0;
  int taken = 0, exponent = 0, run = 0;
  bool grouped = false;
  for (; c < end; c++) {
    if (g_ascii_isdigit(*c)) {
      digits = digits * 10 + (guint64)(*c - '0');
      taken += taken > 0 || *c != '0';
      run++;
    } else if (dialect->thousands != '\0' && *c == dialect->thousands && run > 0 &&
               (grouped ? run == 3 : run <= 3 && *first != '0') && is_group(c, end)) {
      grouped = true;
      run = 0;
    } else {
      break;
    }
    if (taken > 18) {
      break;
    }
  }
  bool any = run > 0;
  const bool whole_long = !grouped && run > 3;
  bool marked = false;
  if (taken <= 18 && c < end && *c == dialect->decimal) {
    const char *behind = c + 1;
    for (c = behind; c < end && g_ascii_isdigit(*c) && taken <= 18; c++) {
      digits = digits * 10 + (guint64)(*c - '0');
      taken += taken > 0 || *c != '0';
      exponent--;
    }
    if (c == behind && (!any || dialect->decimal == ',')) {
      return false;
    }
    any = marked = true;
  }
  if (taken > 18) {
    // Too long for a whole number.
    if (!read_slowly(out, cell, dialect)) {
      return false;
    }
  } else {
    if (!any) {
      return false;
    }
    if (c < end && (*c == 'e' || *c == 'E')) {
      const bool down = end - c > 1 && c[1] == '-';
      c += 1 + (end - c > 1 && (c[1] == '-' || c[1] == '+'));
      int by = 0;
      const char *start = c;
      for (; c < end && g_ascii_isdigit(*c); c++) {
        by = MIN(by * 10 + (*c - '0'), 100000);
      }
      if (c == start) {
        return false;
      }
      exponent += down ? -by : by;
    }
    if (c != end) {
      return false;
    }
    if (digits > (G_GUINT64_CONSTANT(1) << 53) || exponent < -22 || exponent > 22) {
      if (!read_slowly(out, cell, dialect)) {
        return false;
      }
    } else {
      const double size =
          exponent < 0 ? (double)digits / power[-exponent] : (double)digits * power[exponent];
      *out = negative ? -size : size;
    }
  }
  if (saw != NULL) {
    *saw |= (marked ? SB_TEXT_TABLE_SAW_DECIMAL : 0) | (grouped ? SB_TEXT_TABLE_SAW_GROUPS : 0) |
            (whole_long ? SB_TEXT_TABLE_SAW_LONG : 0);
  }
  return true;
}

bool sb_text_table_number_of(double *out, const char *text, size_t length, char decimal) {
  const SbTextTableDialect dialect = {.decimal = decimal};
  const SbTextTableCell cell = {text, length};
  return sb_text_table_number(out, &cell, &dialect, NULL);
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

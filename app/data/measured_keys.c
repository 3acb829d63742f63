// Keys of measured data: reads what they choose, and writes what was recognised; see measured.h.
#include "app/data/measured_private.h"

// Characters of the keys `separator` and `decimal`; the first one, without a key: recognised.
static const char separators[] = "\0,;\t| ", decimals[] = "\0.,";

bool sb_measured_dialect(SbTextTableDialect *wish, const SbData *data, GPtrArray *issues) {
  static const char *const signals[] = {"force over displacement", NULL};
  const guint before = issues->len;
  wish->separator = separators[sb_data_word(data, SB_DATA_SEPARATOR, sb_data_separators, issues)];
  wish->decimal = decimals[sb_data_word(data, SB_DATA_DECIMAL, sb_data_decimals, issues)];
  wish->encoding = (SbTextTableEncoding)sb_data_word(data, SB_DATA_ENCODING,
                                                     sb_text_table_encodings + 1, issues);
  wish->dates = "\0dm"[sb_data_word(data, SB_DATA_DATES, sb_data_dates, issues)];
  (void)sb_data_word(data, SB_DATA_SIGNAL, signals, issues);
  return issues->len == before;
}

// Returns the name of a mark.
static const char *name_of(const char *const *names, const char *marks, char mark) {
  return names[strchr(marks + 1, mark) - marks - 1];
}

char *sb_measured_layout(const SbMeasured *m, bool units) {
  char *layout = g_strdup("-");
  for (int c = 0; c < SB_CHANNELS; c++) {
    const char *unit = m->column[c].clock ? "-" : m->column[c].unit;
    sb_choice_place(&layout, m->column[c].at, units ? unit : sb_channel_names[c]);
  }
  return layout;
}

// Returns the value of the key `cycle`, owned by the caller.
static char *cycle_of(const SbMeasured *m) {
  const bool all = m->first == 0 && m->last + 1 == m->cycle->len;
  return all ? g_strdup("all") : g_strdup_printf("%zu", m->first + 1);
}

char *sb_measured_keys(const SbMeasured *m) {
  GString *out = g_string_new(NULL);
  g_string_append_printf(out, "separator = %s\ndecimal = %s\nencoding = %s\n",
                         name_of(sb_data_separators, separators, m->dialect.separator),
                         name_of(sb_data_decimals, decimals, m->dialect.decimal),
                         sb_text_table_encodings[m->dialect.encoding]);
  g_autofree char *columns = sb_measured_layout(m, false), *units = sb_measured_layout(m, true);
  g_string_append_printf(out, "columns = %s\nunits = %s\n", columns, units);
  if (m->dialect.dates != '\0') {
    g_string_append_printf(out, "dates = %s\n", sb_data_dates[m->dialect.dates == 'm']);
  }
  if (m->speed > 0) {
    g_autofree char *speed = sb_quantity_format(m->speed, "m/s", "mm/min");
    g_string_append_printf(out, "speed = %s\n", speed);
  }
  g_autofree char *rest = sb_quantity_format(m->at_rest, "m", "mm");
  g_autofree char *load = sb_quantity_format(m->no_load, "N", "N");
  g_autofree char *slope = sb_quantity_format(m->slope, "m/N", "mm/N");
  g_autofree char *cycle = cycle_of(m);
  g_string_append_printf(out, "direction = %s\nzero = %s, %s\ncompliance = %s\ncycle = %s\n",
                         sb_data_directions[m->turned_force + 2 * m->turned_displacement], rest,
                         load, slope, cycle);
  return g_string_free(out, FALSE);
}

char *sb_measured_doubts(const SbMeasured *m) {
  GString *out = g_string_new(NULL);
  if (m->specimens > 1) {
    g_string_append_printf(out, "; %zu specimens side by side: the first is used (`columns`)",
                           m->specimens);
  }
  if (m->tests > 0) {
    g_string_append_printf(out, "; %zu tests one below the other: the first is used (`cycle`)",
                           m->tests + 1);
  }
  if (m->dropped > 0) {
    g_string_append_printf(out,
                           "; %zu rows are dropped: a cell is empty or cannot be read, or they do "
                           "not continue the table at a blank line, names or a label",
                           m->dropped);
  }
  if (m->lines.skipped > 0) {
    g_string_append_printf(out, "; %zu other lines are left out (line %d: \"%s\")",
                           m->lines.skipped, m->lines.left_line, m->lines.left_text);
  }
  g_string_append(out, m->jumps ? "; time or displacement jumps at a blank line or names" : "");
  g_string_erase(out, 0, out->len > 0 ? 2 : 0);
  return g_string_free(out, out->len == 0);
}

char *sb_measured_text(const SbMeasured *m) {
  static const char *const hows[] = {"not in the data, used unchanged", "found", "as specified"};
  GString *out = g_string_new(NULL);
  g_string_append_printf(out, "separator %s, decimal %s, %s, %zu header lines\n",
                         name_of(sb_data_separators, separators, m->dialect.separator),
                         name_of(sb_data_decimals, decimals, m->dialect.decimal),
                         sb_text_table_encodings[m->dialect.encoding], m->header_lines);
  for (int c = 0; c < SB_CHANNELS; c++) {
    if (m->column[c].at > 0) {
      g_string_append_printf(out, "%s: column %zu \"%s\" in %s (%s)\n", sb_channel_names[c],
                             m->column[c].at, m->column[c].name, m->column[c].unit,
                             hows[m->column[c].how]);
    }
  }
  if (m->speed > 0) {
    g_autofree char *speed = sb_quantity_format(m->speed, "m/s", "mm/min");
    g_string_append_printf(
        out, "displacement: by the time at %s (%s), up to the maximum force and back\n", speed,
        m->speed_how == SB_HOW_SAID ? "as specified" : "the drive's, assumed");
  }
  g_string_append_printf(out, "%zu rows", m->count);
  if (m->behind > 0) {
    g_string_append_printf(out, ", %zu after the first cycle left out", m->behind);
  }
  char digits[3][SB_NUMBER_SIZE];
  g_autofree char *cycle = cycle_of(m), *doubts = sb_measured_doubts(m);
  g_string_append_printf(out, "%s%s\n%u cycles, %s%s used\n", doubts != NULL ? "; " : "",
                         doubts != NULL ? doubts : "", m->cycle->len,
                         *cycle == 'a' ? "" : "number ", cycle);
  g_string_append_printf(out, "reversed: %s (%s)\nat rest %s mm (%s), without load %s N (%s)\n",
                         m->turned_force || m->turned_displacement
                             ? sb_data_directions[m->turned_force + 2 * m->turned_displacement]
                             : "nothing",
                         hows[m->direction], sb_number_round(digits[0], m->at_rest * 1e3, 6),
                         hows[m->zero], sb_number_round(digits[1], m->no_load, 5),
                         hows[m->force_zero]);
  g_string_append_printf(out, "compliance %s um/N (%s), noise %s\n",
                         sb_number_round(digits[0], m->slope * 1e6, 4), hows[m->compliance],
                         isfinite(m->noise) ? strcat(sb_number_round(digits[1], m->noise, 3), " N")
                                            : "not found");
  return g_string_free(out, FALSE);
}

// Reads measured loops: which column is what, in which unit; see measured.h.
#include "app/data/measured_private.h"

#include "app/base/reader.h"

#include <gsl/gsl_statistics_double.h>

#define SPEED_MAX 10.0                                                   // of a test machine [m/s]
#define FACTOR    "fa[ckt]?t[oe]|multipl|s[ck]al|échelle|gain|倍率|係数" // in a line with a factor

enum { BYTES_MAX = 1 << 30 }; // largest file

const char *const sb_channel_names[SB_CHANNELS] = {"time", "displacement", "force"};

static const struct {
  const char *si;
  double most;       // either way, SI
  const char *words; // pattern of a column's name
  const char *units; // usual units, one a line
} channels[SB_CHANNELS] = {
#define SB_CHANNEL(name, si, most, words, units) {si, most, words, units},
#include "app/data/measured_channels.def"
#undef SB_CHANNEL
};

void sb_measured_free(SbMeasured *measured) {
  if (measured == NULL) {
    return;
  }
  for (int i = 0; i < SB_CHANNELS; i++) {
    g_free(measured->column[i].name);
    g_free(measured->column[i].unit);
    g_free(measured->value[i]);
  }
  g_free(measured->name);
  g_free(measured->lines.left_text);
  g_clear_pointer(&measured->cycle, g_array_unref);
  g_free(measured);
}

// Whether a column's name has one of the channel's words.
static bool name_fits(const char *name, SbChannel channel) {
  g_autofree char *spaced = g_strdelimit(g_strdup(name), "_", ' ');
  return g_regex_match_simple(channels[channel].words, spaced, G_REGEX_CASELESS, 0);
}

static bool is_known(const char *name) {
  return name_fits(name, SB_CHANNEL_TIME) || name_fits(name, SB_CHANNEL_DISPLACEMENT) ||
         name_fits(name, SB_CHANNEL_FORCE);
}

// Returns the unit without a number before it ("x10 N", "0.1 s"), which is *factor; else 1.
static const char *skip_factor(double *factor, const char *unit) {
  const char *c = unit + strspn(unit, "x*\xc3\x97 ");
  const size_t length = g_ascii_isdigit(*c) || *c == '.' ? sb_number_read(factor, c) : 0;
  *factor = length > 0 ? *factor : 1;
  return length > 0 ? c + length + strspn(c + length, " ") : unit;
}

static bool unit_scale(double *scale, const char *unit, SbChannel channel) {
  double factor;
  const char *si = channels[channel].si, *plain = skip_factor(&factor, unit);
  g_autofree char *force = g_strconcat(plain, "f", NULL); // "g" of a force is gram-force
  const bool good = *plain != '\0' && factor > 0 &&
                    (sb_unit_scale(scale, plain, si, si, NULL) ||
                     (channel == SB_CHANNEL_FORCE && sb_unit_scale(scale, force, si, si, NULL)));
  *scale *= good ? factor : 1;
  return good;
}

// Columns and units that keys name, into the table.
static bool take_said(SbMeasured *m, SbTextTable *table, const SbData *data, GPtrArray *issues) {
  const SbDataKey keys[] = {SB_DATA_COLUMNS, SB_DATA_UNITS};
  for (size_t k = 0; k < G_N_ELEMENTS(keys); k++) {
    if (data->text[keys[k]] == NULL) {
      continue;
    }
    g_auto(GStrv) words = g_strsplit(data->text[keys[k]], ",", -1);
    if (g_strv_length(words) > table->columns) {
      return sb_data_add_issue(data, keys[k], NULL, issues,
                               "names more than the %zu columns of the file", table->columns);
    }
    for (size_t i = 0; words[i] != NULL; i++) {
      const char *word = g_strstrip(words[i]);
      if (keys[k] == SB_DATA_UNITS) {
        const char *unit = strcmp(word, "-") != 0 ? word : "";
        const char *known = sb_text_table_unit(unit);
        g_free(table->column[i].unit);
        table->column[i].unit = g_strdup(known != NULL ? known : unit);
        continue;
      }
      int channel = 0;
      while (channel < SB_CHANNELS && strcmp(word, sb_channel_names[channel]) != 0) {
        channel++;
      }
      if (channel == SB_CHANNELS && strcmp(word, "-") != 0) {
        return sb_data_add_issue(data, keys[k], "time, displacement, force, -", issues,
                                 "\"%s\" is not a column that is read", word);
      }
      if (channel < SB_CHANNELS) {
        m->column[channel].at = i + 1;
        m->column[channel].how = SB_HOW_SAID;
      }
    }
  }
  return true;
}

// How well a column fits a channel, best first: by its name with a unit of the kind, by its name
// without a unit, by its name alone, by its unit where no word of its name is known, as a number.
enum { FIT_NAME_UNIT, FIT_NAME, FIT_NAME_OTHER, FIT_UNIT, FIT_NUMBER, FIT_NONE };

// Sets of columns have a bit for each column.
#define BIT(column)    (G_GUINT64_CONSTANT(1) << (column))
#define FIRST(columns) ((size_t)__builtin_ctzll(columns))

// Returns the columns that fit a channel best, at least as well as `last`.
static guint64 find_columns(const SbTextTable *table, SbChannel channel, int last) {
  guint64 columns = 0;
  for (size_t i = 0; i < table->columns; i++) {
    const SbTextTableColumn *column = &table->column[i];
    const bool clock = column->clock && channel == SB_CHANNEL_TIME;
    double scale;
    const bool kind = clock || unit_scale(&scale, column->unit, channel);
    const int fit = !column->numeric && !clock ? FIT_NONE
                    : !name_fits(column->name, channel)
                        ? (kind && !is_known(column->name) ? FIT_UNIT : FIT_NUMBER)
                    : kind                  ? FIT_NAME_UNIT
                    : *column->unit == '\0' ? FIT_NAME
                                            : FIT_NAME_OTHER;
    columns = (fit < last ? 0 : columns) | (fit <= last ? BIT(i) : 0);
    last = MIN(fit, last);
  }
  return columns;
}

// Whether two names are equal but for the number or letter of a specimen.
static bool same_name(const char *a, const char *b) {
  g_autoptr(GRegex) lone = g_regex_new("\\PL|(?<!\\pL)\\pL(?!\\pL)", 0, 0, NULL);
  g_autofree char *one = g_regex_replace_literal(lone, a, -1, 0, "", 0, NULL);
  g_autofree char *other = g_regex_replace_literal(lone, b, -1, 0, "", 0, NULL);
  return g_strcmp0(one, other) == 0;
}

// Whether columns are those of specimens side by side: pairs in one order with the same names.
static bool are_specimens(const SbTextTable *table, guint64 place, guint64 force) {
  const bool before = FIRST(place) < FIRST(force);
  guint64 low = before ? place : force, high = before ? force : place;
  const SbTextTableColumn *left = &table->column[FIRST(low)], *right = &table->column[FIRST(high)];
  bool pairs = __builtin_popcountll(low) == __builtin_popcountll(high);
  for (size_t last = 0; pairs && low != 0; low &= low - 1, high &= high - 1) {
    pairs = FIRST(low) >= last && FIRST(low) < FIRST(high) &&
            same_name(left->name, table->column[FIRST(low)].name) &&
            same_name(right->name, table->column[FIRST(high)].name);
    last = FIRST(high);
  }
  return pairs;
}

// The column of each channel; 0 where several may be it, but for those of specimens.
static void find_channels(SbMeasured *m, const SbTextTable *table) {
  guint64 fits[SB_CHANNELS];
  for (int c = 0; c < SB_CHANNELS; c++) {
    fits[c] = find_columns(table, (SbChannel)c, FIT_UNIT);
    m->column[c].how = fits[c] != 0 ? SB_HOW_FOUND : SB_HOW_ASSUMED;
  }
  const guint64 place = fits[SB_CHANNEL_DISPLACEMENT], force = fits[SB_CHANNEL_FORCE];
  const int pairs = __builtin_popcountll(place);
  m->specimens = pairs > 1 && force != 0 && are_specimens(table, place, force) ? (size_t)pairs : 0;
  for (int c = 0; c < SB_CHANNELS; c++) {
    const bool one = (fits[c] & (fits[c] - 1)) == 0 || m->specimens > 0 || c == SB_CHANNEL_TIME;
    m->column[c].at = one && fits[c] != 0 ? FIRST(fits[c]) + 1 : 0;
  }
}

// Whether time is to make the displacement, at which speed; false with an issue.
static bool settle_speed(SbMeasured *m, const SbTextTable *table, const SbData *data, double speed,
                         GPtrArray *issues) {
  const char *said = data->text[SB_DATA_SPEED];
  const bool column = m->column[SB_CHANNEL_DISPLACEMENT].how != SB_HOW_ASSUMED;
  const bool timed = m->column[SB_CHANNEL_TIME].at > 0;
  if (said != NULL && (!sb_quantity_parse(&speed, said, "m/s", "mm/min", NULL) ||
                       !(speed > 0 && speed <= SPEED_MAX))) {
    return sb_data_add_issue(data, SB_DATA_SPEED, "as in 20 mm/min, up to 10 m/s", issues,
                             "\"%s\" is not a speed of a machine", said);
  }
  if (said != NULL && (column || !timed)) {
    return sb_data_add_issue(data, SB_DATA_SPEED, NULL, issues,
                             column ? "the displacement has a column of its own: one of them only"
                                    : "there is no column of the time that it would need");
  }
  // Another column of numbers may be the displacement, by a name that is not known.
  size_t numbers = 0;
  for (size_t i = 0; i < table->columns; i++) {
    numbers += table->column[i].numeric || table->column[i].clock;
  }
  if (!column && timed && m->column[SB_CHANNEL_FORCE].at > 0 &&
      (said != NULL || (speed > 0 && (numbers == 2 || data->text[SB_DATA_COLUMNS] != NULL)))) {
    m->speed = speed;
    m->speed_how = said != NULL ? SB_HOW_SAID : SB_HOW_ASSUMED;
  }
  return true;
}

// Refuses a file in which no column or several ones are known as `channel`.
static bool miss_column(const SbMeasured *m, const SbTextTable *table, const SbData *data,
                        int channel, GPtrArray *issues) {
  const bool several = m->column[channel].how == SB_HOW_FOUND;
  guint64 fits = find_columns(table, (SbChannel)channel, several ? FIT_UNIT : FIT_NUMBER);
  g_autoptr(GString) list = g_string_new(NULL);
  for (size_t i = 0; i < table->columns && i < 8; i++) {
    g_string_append_printf(list, "%s\"%s\"", i > 0 ? ", " : "", table->column[i].name);
  }
  for (int c = 0; c < SB_CHANNELS; c++) {
    fits &= !several && m->column[c].at > 0 ? ~BIT(m->column[c].at - 1) : ~0ULL;
  }
  const char *name = sb_channel_names[channel];
  g_autofree char *layout = sb_measured_layout(m, false);
  g_autofree char *layouts = sb_choice_layouts(layout, fits, name);
  const bool timed = fits == 0 && channel != SB_CHANNEL_FORCE && m->column[SB_CHANNEL_TIME].at > 0;
  if (several) {
    const size_t first = FIRST(fits), second = FIRST(fits & (fits - 1));
    return sb_data_add_choice(data, SB_DATA_COLUMNS, layouts, issues,
                              "column %zu \"%s\" and column %zu \"%s\" may both be the %s",
                              first + 1, table->column[first].name, second + 1,
                              table->column[second].name, name);
  }
  return sb_data_add_choice(
      data, timed ? SB_DATA_SPEED : SB_DATA_COLUMNS, layouts, issues,
      "no column of the %zu (%s) is known as the %s%s", table->columns, list->str, name,
      timed ? ": specify the constant speed of the machine, as in speed = 20 mm/min" : "");
}

// Returns what may state a factor of a column, which it writes: its name ("Force x 0.001"), or a
// line of the header for its channel, with a cell for each column, or of no channel. NULL: nothing.
static const char *find_factor(double *factor, const SbTextTable *table, size_t at, SbChannel c) {
  const char *text = table->column[at].name;
  for (size_t i = 0; text != NULL; text = table->header[i++]) {
    g_auto(GStrv) cells = g_strsplit_set(text, table->dialect.separator == ',' ? ",;" : ";|", -1);
    const bool each = i > 0 && g_strv_length(cells) == table->columns && !is_known(text);
    const char *cell = each ? cells[at] : text;
    const bool known = i == 0 || each || name_fits(text, c) ||
                       (c == SB_CHANNEL_FORCE &&
                        g_regex_match_simple("^\\W*(" FACTOR ")", text, G_REGEX_CASELESS, 0));
    const char *number = cell + strlen(cell);
    while (number > cell && strchr("0123456789.,+-eE) ", number[-1]) != NULL) {
      number--;
    }
    number += strcspn(number, "0123456789");
    const bool word =
        g_regex_match_simple(i > 0 ? "^(?!.*(full|safe)).*(" FACTOR ")" : "[x*×] ?[0-9.,]+\\W*$",
                             text, G_REGEX_CASELESS, 0);
    if (known && word && sb_text_table_number_at(factor, number, table->dialect.decimal) > 0 &&
        *factor != 1 && *factor != 0) {
      return text;
    }
  }
  return NULL;
}

// Writes the scale of a column to SI. A number before the unit may be a remark, and names and units
// may differ: the key decides. False with an issue.
static bool settle_unit(double *scale, const SbMeasured *m, const SbTextTable *table,
                        const SbData *data, SbChannel c, GPtrArray *issues) {
  const char *unit = m->column[c].unit, *other = table->column[m->column[c].at - 1].other;
  const bool good = unit_scale(scale, unit, c), none = *unit == '\0';
  double factor, second;
  const char *plain = skip_factor(&factor, unit);
  g_autofree char *doubt = NULL, *both = NULL;
  if (good && data->text[SB_DATA_UNITS] != NULL) {
    return true;
  }
  if (!good) {
    doubt = g_strdup(none ? "" : ", which is none of its kind");
  } else if (other != NULL && unit_scale(&second, other, c) && second != *scale) {
    doubt = g_strdup_printf(", in another place \"%s\"", other);
    both = g_strdup_printf("%s\n%s", unit, other);
  } else if (plain != unit) {
    doubt = g_strdup(", of which the number may be a remark");
  } else {
    const char *line = find_factor(&factor, table, m->column[c].at - 1, c);
    doubt = line != NULL ? g_strdup_printf(", which \"%s\" may multiply", line) : NULL;
  }
  if (doubt == NULL) {
    return true;
  }
  char size[SB_NUMBER_SIZE];
  both = both != NULL ? both
                      : g_strdup_printf("%s %s\n%s", sb_number_format(size, factor), plain, plain);
  g_autofree char *layout = sb_measured_layout(m, true);
  g_autofree char *all =
      sb_choice_layouts(layout, BIT(m->column[c].at - 1), good ? both : channels[c].units);
  return sb_data_add_choice(data, SB_DATA_UNITS, good || none ? all : NULL, issues,
                            "column %zu \"%s\" (%s) has %s%s%s%s", m->column[c].at,
                            m->column[c].name, sb_channel_names[c],
                            none ? "no unit" : "the unit \"", unit, none ? "" : "\"", doubt);
}

static bool settle_columns(SbMeasured *m, SbTextTable *table, const SbData *data, double speed,
                           double *scale, GPtrArray *issues) {
  const bool said = take_said(m, table, data, issues);
  if (said && data->text[SB_DATA_COLUMNS] == NULL) {
    find_channels(m, table);
  }
  if (!said || !settle_speed(m, table, data, speed, issues)) {
    return false;
  }
  for (int c = 0; c < SB_CHANNELS; c++) {
    const size_t at = m->column[c].at;
    if (at == 0 && (c == SB_CHANNEL_TIME || (c == SB_CHANNEL_DISPLACEMENT && m->speed > 0))) {
      continue;
    }
    if (at == 0) {
      return miss_column(m, table, data, c, issues);
    }
    const SbTextTableColumn *column = &table->column[at - 1];
    m->column[c].name = g_strdup(column->name);
    m->column[c].clock = column->clock;
    m->column[c].unit = g_strdup(column->clock ? "clock" : column->unit);
  }
  for (int c = 0; c < SB_CHANNELS; c++) {
    if (m->column[c].unit != NULL && !m->column[c].clock &&
        !settle_unit(&scale[c], m, table, data, (SbChannel)c, issues)) {
      return false;
    }
  }
  return true;
}

// To SI in place, dropping rows with a gap; false with an issue on a value that is none of a valve.
static bool settle_rows(SbMeasured *m, const SbData *data, const double *scale, GPtrArray *issues) {
  size_t kept = 0;
  for (size_t i = 0; i < m->count; i++) {
    bool whole = true;
    for (int c = 0; c < SB_CHANNELS; c++) {
      whole = whole && (m->value[c] == NULL || isfinite(m->value[c][i]));
    }
    for (int c = 0; c < SB_CHANNELS && whole; c++) {
      double *value = m->value[c];
      if (value == NULL) {
        continue;
      }
      // A division where the inverse is whole: 1.61 mm is 1.61/1000.
      const double inverse = 1 / scale[c];
      const bool divide = inverse > 1 && inverse == round(inverse);
      value[kept] = divide ? value[i] / inverse : value[i] * scale[c];
      if (!(fabs(value[kept]) <= channels[c].most)) {
        return sb_data_add_issue(
            data, SB_DATA_UNITS, NULL, issues, "row %zu has a %s of %g %s, more than %g %s", i + 1,
            sb_channel_names[c], value[kept], channels[c].si, channels[c].most, channels[c].si);
      }
    }
    kept += whole;
  }
  m->dropped += m->count - kept;
  m->count = kept;
  return true;
}

// When the force turned: midway between nine tenths of the peak, whose own row noise moves.
static double turn_time(const SbMeasured *m, double sign, size_t peak) {
  const double level = 0.9 * sign * m->force[peak];
  double side[2];
  for (int k = 0; k < 2; k++) {
    size_t at = peak;
    const size_t end = k == 0 ? 0 : m->count - 1;
    while (at != end && sign * m->force[at] > level) {
      at = k == 0 ? at - 1 : at + 1;
    }
    const size_t in = at == peak ? peak : k == 0 ? at + 1 : at - 1;
    const double rise = sign * (m->force[in] - m->force[at]);
    const double part = rise > 0 ? fmin(fmax((level - sign * m->force[at]) / rise, 0), 1) : 0;
    side[k] = m->time[at] + part * (m->time[in] - m->time[at]);
  }
  return 0.5 * (side[0] + side[1]);
}

// The displacement of a crosshead that goes out to the greatest force and comes back, at one speed,
// from where the record begins; rows behind that are left out.
static bool displace(SbMeasured *m, const SbData *data, GPtrArray *issues) {
  enum { LEAST = 5 };
  for (size_t i = 1; i < m->count; i++) {
    if (!(m->time[i] >= m->time[i - 1])) {
      return sb_data_add_issue(
          data, SB_DATA_FILE, NULL, issues,
          "its time decreases at row %zu, and nothing else gives the displacement", i + 1);
    }
  }
  const double sign = gsl_stats_mean(m->force, 1, m->count) < 0 ? -1 : 1;
  const size_t peak = sign > 0 ? gsl_stats_max_index(m->force, 1, m->count)
                               : gsl_stats_min_index(m->force, 1, m->count);
  size_t first = 0;
  // The first of several peaks that are all but as high.
  while (first < peak && !(sign * m->force[first] > 0.95 * sign * m->force[peak])) {
    first++;
  }
  const double until = 1.1 * (m->time[first] - m->time[0]) + m->time[0];
  size_t turn = first;
  for (size_t i = first; i < m->count && m->time[i] <= until; i++) {
    turn = sign * m->force[i] > sign * m->force[turn] ? i : turn;
  }
  const double turned = turn_time(m, sign, turn), end = 2 * turned - m->time[0];
  size_t count = turn;
  m->displacement = g_new(double, m->count);
  while (count < m->count && m->time[count] <= end) {
    count++;
  }
  if (turn < LEAST || count < turn + LEAST) {
    return sb_data_add_issue(
        data, SB_DATA_FILE, NULL, issues,
        "its maximum force, where a machine of constant speed reverses, is at row %zu "
        "of %zu: that is not a stroke and return",
        turn + 1, m->count);
  }
  for (size_t i = 0; i < count; i++) {
    const double time = m->time[i] <= turned ? m->time[i] - m->time[0] : end - m->time[i];
    m->displacement[i] = m->speed * time;
  }
  if (!(m->displacement[turn] <= channels[SB_CHANNEL_DISPLACEMENT].most)) {
    return sb_data_add_issue(data, SB_DATA_SPEED, NULL, issues,
                             "the machine would travel %g m to the maximum force, more than %g m",
                             m->displacement[turn], channels[SB_CHANNEL_DISPLACEMENT].most);
  }
  m->behind = m->count - count;
  m->count = count;
  return true;
}

static SbMeasured *read_all(SbTextTable *table, const SbData *data, double speed, GPtrArray *list) {
  g_autoptr(SbMeasured) m = g_new0(SbMeasured, 1);
  double scale[SB_CHANNELS] = {1, 1, 1};
  m->name = g_path_get_basename(data->path);
  m->dialect = table->dialect;
  m->header_lines = table->header_lines;
  if (!settle_columns(m, table, data, speed, scale, list)) {
    return NULL;
  }
  size_t column[SB_CHANNELS + 1], count = 0;
  double *read[SB_CHANNELS + 1];
  for (int c = 0; c < SB_CHANNELS; c++) {
    if (m->column[c].at > 0) {
      column[count++] = m->column[c].at - 1;
    }
  }
  column[count] = table->columns;
  if (!sb_text_table_read(&m->lines, read, table, column, count + 1, list)) {
    return NULL;
  }
  for (int c = 0, k = 0; c < SB_CHANNELS; c++) {
    m->value[c] = m->column[c].at > 0 ? read[k++] : NULL;
  }
  m->count = m->lines.rows;
  m->dropped = m->lines.damaged;
  sb_measured_tests(m, table, read[count]);
  g_free(read[count]);
  const bool good =
      (m->lines.skipped <= m->lines.rows ||
       sb_issues_add(list, data->path, m->lines.left_line, NULL, NULL,
                     "%zu lines are not rows of the table and %zu are, the first is \"%s\"",
                     m->lines.skipped, m->count, m->lines.left_text)) &&
      settle_rows(m, data, scale, list) &&
      (m->count >= ROWS_MIN || sb_issues_add(list, data->path, 0, NULL, "at least 8 rows",
                                             "has too few rows for a loop")) &&
      (m->speed == 0 || displace(m, data, list)) && sb_measured_find(m, data, list);
  return good ? g_steal_pointer(&m) : NULL;
}

SbMeasured *sb_measured_read(const SbData *data, double speed, const void *bytes, size_t length,
                             GPtrArray *issues) {
  SbTextTableDialect wish = {0};
  const char *path = data->path;
  const bool good = sb_measured_dialect(&wish, data, issues);
  g_autofree char *own =
      good && bytes == NULL ? sb_reader_load(&length, path, path, BYTES_MAX, issues) : NULL;
  bytes = bytes != NULL ? bytes : own;
  g_autoptr(SbTextTable) table =
      good && bytes != NULL ? sb_text_table_parse(bytes, length, &wish, path, issues) : NULL;
  return table != NULL ? read_all(table, data, speed, issues) : NULL;
}

// Measured loops: the same curve in every dialect, what a file shows found and told, what it does
// not show refused with both readings.
#include "app/data/measured.h"
#include "app/document/document.h"

#include "engine/numeric/sampling.h"
#include "tests/app/choices.h"
#include "tests/executed.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

enum { ROWS = 2040, AIR = 40 };

// A loop of the closed-form cycle as a machine would export it.
typedef struct {
  double time[ROWS], place[ROWS], force[ROWS]; // [s], [mm], [N]
  double breakaway, land;                      // of the run [N], [mm]
} Bench;

static Bench bench;

static double noise(guint row) {
  double sum = 0;
  for (guint k = 0; k < 12; k++) {
    sum += sb_random(7, row, k);
  }
  return 0.16 * (sum - 6); // near enough to normal
}

static void make_bench(void) {
  g_autofree char *path =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", "quick-look.scene", NULL);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_load(path, issues);
  g_autoptr(SbModel) model = NULL;
  g_assert_true(sb_document_compile(document, &model, issues));
  SbRun *run = executed_run(model);
  size_t count, at = 0;
  const SbFrame *frame = sb_run_frames(run, &count);
  for (guint i = 0; i < ROWS; i++) {
    double place = -0.2 + 0.2 * i / AIR, force = 0, time = -0.6 + 0.6 * i / AIR;
    if (i >= AIR) {
      time = frame[count - 1].time * (i - AIR) / (ROWS - AIR - 1);
      while (at + 2 < count && frame[at + 1].time <= time) {
        at++;
      }
      const double span = frame[at + 1].time - frame[at].time;
      const double t = span > 0 ? (time - frame[at].time) / span : 0;
      place = 1e3 * (frame[at].platen + t * (frame[at + 1].platen - frame[at].platen));
      force = frame[at].force + t * (frame[at + 1].force - frame[at].force);
    }
    bench.time[i] = time + 0.6;
    bench.place[i] = place + 3.1;
    bench.force[i] = force + 0.35 + noise(i);
  }
  bench.breakaway = sb_run_summary(run)->force_breakaway;
  bench.land = 1e3 * sb_run_summary(run)->stage[SB_STAGE_C].displacement;
  sb_run_destroy(run);
}

// How a file is written.
typedef struct {
  const char *header, *separator;
  char decimal;
  const char *encoding, *mark; // iconv's name, bytes in front
  size_t mark_length;
  int cycles;
  double force_sign, place_sign;
} Dialect;

static GBytes *write_file(const Dialect *d) {
  GString *text = g_string_new(d->header);
  for (int c = 0; c < MAX(d->cycles, 1); c++) {
    for (guint i = c == 0 ? 0 : AIR; i < ROWS; i++) {
      const double value[3] = {bench.time[i] + c * 42, d->place_sign * bench.place[i],
                               d->force_sign * bench.force[i]};
      for (int k = 0; k < 3; k++) {
        char digits[40];
        g_ascii_formatd(digits, sizeof digits, "%.4f", value[k]);
        *strchr(digits, '.') = d->decimal;
        g_string_append_printf(text, "%s%s", k > 0 ? d->separator : "", digits);
      }
      g_string_append(text, "\r\n");
    }
  }
  gsize length = 0;
  g_autofree char *bytes =
      g_convert(text->str, (gssize)text->len, d->encoding, "UTF-8", NULL, &length, NULL);
  g_assert_nonnull(bytes);
  GByteArray *all = g_byte_array_new();
  g_byte_array_append(all, (const guint8 *)d->mark, (guint)d->mark_length);
  g_byte_array_append(all, (const guint8 *)bytes, (guint)length);
  g_string_free(text, TRUE);
  return g_byte_array_free_to_bytes(all);
}

static SbMeasured *read_bytes(GBytes *bytes, const SbData *data) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  gsize length;
  const void *text = g_bytes_get_data(bytes, &length);
  SbMeasured *measured = sb_measured_read(data, 0, text, length, issues);
  for (guint i = 0; i < issues->len; i++) {
    g_autofree char *line = sb_issue_line(issues->pdata[i]);
    g_error("%s", line);
  }
  return measured;
}

static SbMeasured *read_dialect(const Dialect *d) {
  SbData *data = sb_data_of_file("x.csv");
  g_autoptr(GBytes) bytes = write_file(d);
  SbMeasured *measured = read_bytes(bytes, data);
  sb_data_free(data);
  return measured;
}

static const Dialect plain = {
    "Time [s],Extension [mm],Load [N]\r\n", ",", '.', "UTF-8", "", 0, 1, 1, 1};

// The same digits, the same doubles.
static void test_dialects(void) {
  static const Dialect dialects[] = {
      {"Prüfung: Ventil µ\r\nDatum;03.02.2026\r\n\r\nZeit;Standardweg;Standardkraft\r\ns;mm;N\r\n",
       ";", ',', "ISO-8859-1", "", 0, 1, 1, 1},
      {"Time (s)\tCrosshead (mm)\tForce (N)\r\n", "\t", '.', "UTF-8", "\xef\xbb\xbf", 3, 1, 1, 1},
      {"Zeit / s;Weg / mm;Kraft / N\r\n", ";", ',', "UTF-16LE", "\xff\xfe", 2, 1, 1, 1},
      {"Zeit;Weg;Kraft\r\n[s];[mm];[N]\r\n", ";", '.', "UTF-16BE", "\xfe\xff", 2, 1, 1, 1},
      {"Zeit;Weg;Kraft\r\n[s];[mm];[N]\r\n", ";", '.', "UTF-16LE", "", 0, 1, 1, 1},
      {"# bench 4\r\nTime (s) Position (mm) Force (N)\r\n", "  ", '.', "UTF-8", "", 0, 1, 1, 1},
      {"\"Time in s\",\"Position in mm\",\"Force in N\"\r\n", " , ", '.', "UTF-8", "", 0, 1, 1, 1},
  };
  g_autoptr(SbMeasured) first = read_dialect(&plain);
  for (size_t i = 0; i < G_N_ELEMENTS(dialects); i++) {
    g_autoptr(SbMeasured) other = read_dialect(&dialects[i]);
    g_assert_cmpuint(other->count, ==, first->count);
    const size_t size = first->count * sizeof(double);
    g_assert_cmpmem(other->time, size, first->time, size);
    g_assert_cmpmem(other->displacement, size, first->displacement, size);
    g_assert_cmpmem(other->force, size, first->force, size);
    g_assert_cmpuint(other->lines.skipped, ==, 0);
  }
  // What is written reads as the number nearest to it.
  char digits[40];
  g_ascii_formatd(digits, sizeof digits, "%.4f", bench.time[777]);
  g_assert_cmpfloat(first->time[777], ==, g_ascii_strtod(digits, NULL));
}

// Direction, zero, compliance, cycles, noise and stages against those that the bench was made with.
static void test_found(void) {
  for (int turn = 0; turn < 4; turn++) {
    Dialect d = plain;
    d.cycles = 3;
    d.force_sign = turn & 1 ? -1 : 1;
    d.place_sign = turn & 2 ? -1 : 1;
    g_autoptr(SbMeasured) m = read_dialect(&d);
    g_assert_cmpuint(m->cycle->len, ==, 3);
    g_assert_cmpint(m->turned_force, ==, (turn & 1) != 0);
    g_assert_cmpint(m->turned_displacement, ==, (turn & 2) != 0);
    g_assert_cmpint(m->direction, ==, SB_HOW_FOUND);
    g_assert_cmpint(m->zero, ==, SB_HOW_FOUND);
    g_assert_cmpint(m->force_zero, ==, SB_HOW_FOUND);
    g_assert_cmpfloat_with_epsilon(m->at_rest, 3.1e-3, 2e-6);
    g_assert_cmpfloat_with_epsilon(m->no_load, 0.35, 3 * 0.16 / sqrt(32));
    g_assert_cmpfloat_with_epsilon(m->slope, 1e-5, 2e-7); // 100 N/mm
    g_assert_cmpfloat_with_epsilon(m->noise, 0.16, 0.02);
    const double rate = bench.force[AIR + 10] - bench.force[AIR + 9];
    g_assert_cmpfloat_with_epsilon(m->stage[SB_STAGE_B].force, bench.breakaway,
                                   3 * hypot(0.16, fabs(rate)));
    g_assert_cmpfloat_with_epsilon(1e3 * m->stage[SB_STAGE_C].displacement, bench.land, 0.02);
    for (int s = SB_STAGE_B; s <= SB_STAGE_F; s++) {
      g_assert_true(m->stage[s].found);
    }
  }
}

// Rows at the peak of a loop without noise whose force rises by 0.5 N a row up to 20.2 N.
typedef enum { PEAK_BETWEEN, PEAK_ROW, PEAK_BOTH_STATES } PeakRows;

static SbMeasured *read_peak(PeakRows rows, bool time) {
  const double rate = 0.5, slip = 40.4, sliding = 18; // [N] a row, row, [N]
  GString *text =
      g_string_new(time ? "Time [s],Travel [mm],Force [N]\n" : "Travel [mm],Force [N]\n");
  for (int i = 0; i < 400; i++) {
    const bool in = i < 220;
    const double place = i < slip ? 0 : in ? 0.03 * (i - slip) : 0.03 * (400 - i);
    const double force = i < slip ? rate * i : in ? sliding : 8;
    for (int more = 0; more <= (i == 41 ? (int)rows : 0); more++) {
      // The row itself comes last; before it, those of the event: the peak, then the sliding state.
      const bool own = more == (i == 41 ? (int)rows : 0);
      if (time) {
        g_string_append_printf(text, "%.4f,", own ? 0.1 * i : 0.1 * slip);
      }
      g_string_append_printf(text, "%.5f,%.5f\n", own ? place : 0,
                             own         ? force
                             : more == 0 ? rate * slip
                                         : sliding);
    }
  }
  SbData *data = sb_data_of_file("x.csv");
  data->text[SB_DATA_ZERO] = g_strdup("as-is");
  data->text[SB_DATA_COMPLIANCE] = g_strdup("none");
  g_autoptr(GBytes) bytes = g_string_free_to_bytes(text);
  SbMeasured *measured = read_bytes(bytes, data);
  sb_data_free(data);
  return measured;
}

// A row exactly at the peak is the peak. Without one the force may have risen by up to one row's
// 0.5 N; its middle is taken, and its deviation covers the truth. Files without a column of time
// have rows at equal spacing.
static void test_peak(void) {
  const double peak = 20.2;
  for (int rows = PEAK_BETWEEN; rows <= PEAK_BOTH_STATES; rows++) {
    g_autoptr(SbMeasured) m = read_peak((PeakRows)rows, true);
    const SbMeasuredStage *b = &m->stage[SB_STAGE_B];
    g_assert_true(b->found);
    if (rows == PEAK_BETWEEN) {
      g_assert_cmpfloat_with_epsilon(b->force, 20.25, 1e-4);
      g_assert_cmpfloat(fabs(b->force - peak), <, 1.7321 * b->deviation);
    } else {
      g_assert_cmpfloat_with_epsilon(b->force, peak, 1e-4);
      g_assert_cmpfloat_with_epsilon(b->deviation, 0, 1e-3);
    }
  }
  g_autoptr(SbMeasured) without = read_peak(PEAK_BETWEEN, false);
  g_assert_cmpfloat_with_epsilon(without->stage[SB_STAGE_B].force, 20.25, 1e-4);
}

// Habits of exporters: other headers, units, encodings, blocks and marks, the same forces within
// the rounding of the file. `row` gets time [s], place [mm] and force [N].
typedef struct {
  const char *before, *row, *after;
  char decimal;
  double force_scale, place_scale; // of what is written
} Habit;

static SbMeasured *read_habit(const Habit *h) {
  GString *text = g_string_new(h->before);
  for (int i = 0; i < ROWS; i++) {
    char cell[3][40];
    const double value[3] = {bench.time[i], bench.place[i] * h->place_scale,
                             bench.force[i] * h->force_scale};
    for (int k = 0; k < 3; k++) {
      g_ascii_formatd(cell[k], sizeof cell[k], "%.5f", value[k]);
      *strchr(cell[k], '.') = h->decimal;
    }
    g_auto(GStrv) parts = g_strsplit(h->row, "@", -1);
    for (int k = 0; parts[k] != NULL; k++) {
      const char *which = k > 0 ? parts[k] : NULL;
      g_string_append(text, which != NULL ? cell[*which == 't' ? 0 : *which == 'x' ? 1 : 2] : "");
      g_string_append(text, which != NULL ? which + 1 : parts[k]);
    }
  }
  g_string_append(text, h->after);
  SbData *data = sb_data_of_file("x.csv");
  g_autoptr(GBytes) bytes = g_string_free_to_bytes(text);
  SbMeasured *measured = read_bytes(bytes, data);
  sb_data_free(data);
  return measured;
}

static void test_habits(void) {
  static const Habit habits[] = {
      // Quoted decimal commas, units in a row of their own that is shorter, properties above.
      {"Area,\"100,0\",mm^2\n\nTime,Extension,Load,Strain,Count\n(s),(mm),(N),(mm/mm)\n",
       "\"@t\",\"@x\",\"@f\",\"0,1\",\"0,0\"\n", "", ',', 1, 1},
      // A results block of the same shape before the data, and one behind.
      {"Results\n\"No\",\"Maximum Load\",\"Extension\"\n,\"(N)\",\"(mm)\"\n1,\"35.1\",\"16.2\"\n\n"
       "\"Raw Data\"\n\"Time\",\"Extension\",\"Load\"\n\"(s)\",\"(mm)\",\"(N)\"\n",
       "\"@t\",\"@x\",\"@f\"\n", "\nResults\nNo,Peak,Mean\n1,900.0,800.0\n2,900.0,1.5\n", '.', 1,
       1},
      // The same without blank lines, with cells between blanks, and a limit that was reached.
      {"No.,Max Load (N),Ext (mm)\n1,35.1,16.2\nTime (s),Ext (mm),Load (N)\n", "@t,@x,@f\n",
       "OVER,OVER,OVER\n,,\nNo,Peak (N),Ext (mm)\n1,900.0,800.0\n", '.', 1, 1},
      {"No. Peak (N) Ext (mm)\n1 35.1 16.2\nTime (s) Ext (mm) Load (N)\n", "@t @x @f\n",
       "end of test\n", '.', 1, 1},
      // Blocks with the same names and other units; names again without units; of a comment.
      {"Time,Ext,Load\n(s),(mm),(kN)\n0,0,900\n1,1,900\n\nTime,Ext,Load\n(s),(mm),(N)\n0,0,\n"
       "Time,Ext,Load\n",
       "@t,@x,@f\n", "Time,Ext,Load\n(s),(um),(N)\n1,900,1\n2,900,1\n", '.', 1, 1},
      {"# t [s]; s [mm]; F [N]\n", "@t;@x;@f\n", "# t [s]; s [mm]; F [kN]\n1;900;1\n2;800;1\n", '.',
       1, 1},
      {"Operator;Miller\nZeit;Weg;Kraft\ns;mm;N\n", "@t;@x;@f\n",
       "s;mm;kN\n1;900;1\ns;mm;N\n;;\nOperator;Miller\nZeit;Weg;Kraft\ns;mm;kN\n1;900;1\n", ',', 1,
       1},
      // Rows of results with a label, directly above and below.
      {"Name;Zeit;Weg;Kraft\nEinheit;s;mm;N\nMin;0;0,3;900\nMax;41,7;900;1\n", ";@t;@x;@f\n",
       "Mittel;20;900;900\nMax;41,7;900;900\n", ',', 1, 1},
      {"No;Time;Ext;Load\n;s;mm;N\n", "7;@t;@x;@f\n", "Mean;20;900;900\n", '.', 1, 1},
      // A label before the names, ends of lines in quotes.
      {"# test\n# columns: time[s] displacement[mm] force[N]\n", "@t @x @f\n", "", '.', 1, 1},
      {"\"Time\n(s)\",\"Extension\nby LVDT\n(mm)\",\"Load\n(N)\"\n", "@t,@x,@f\n", "", '.', 1, 1},
      // No value in the last column of the first row.
      {"Time (s),Ext (mm),Load (N)\n0.00,0.0,\n", "@t,@x,@f\n", "", '.', 1, 1},
      {"Time (s),Ext (mm),Load (N)\n0.00,0.0,OVER\n", "@t,@x,@f\n", "", '.', 1, 1},
      // A remark behind the unit; letters and brackets of full width, in Chinese.
      {"Time (s) (abs),Ext (mm) (LVDT),Load (N) (Cell 1)\n", "@t,@x,@f\n", "", '.', 1, 1},
      {"\u65f6\u95f4\uff08\uff53\uff09,\u4f4d\u79fb\uff08mm\uff09,\u529b\uff08N\uff09\n",
       "@t,@x,@f\n", "", '.', 1, 1},
      {"\u65f6\u95f4,\u4f4d\u79fb,\u8bd5\u9a8c\u529b\n\u79d2,\u6beb\u7c73,\u5343\u514b\u529b\n",
       "@t,@x,@f\n", "", '.', 1 / 9.80665, 1},
      // Gram-force, inches by their sign, doubled ends of lines.
      {"Distance (\"),Force (g),Time (s)\r\r\n", "@x,@f,@t\r\r\n", "", '.', 1 / 9.80665e-3,
       1 / 25.4},
      {"Displacement (\"\");Force_LBF;Time_S\n", "@x;@f;@t\n", "", '.', 1 / 4.4482216152605,
       1 / 25.4},
      {"Corsa in mil;Forza in kp;Tempo in s\n", "@x;@f;@t\n", "", ',', 1 / 9.80665, 1000 / 25.4},
      {"\xc9"
       "crasement (mm)\tEffort (N)\tTemps (s)\n",
       "@x\t@f\t@t\n", "", ',', 1, 1},
      // Shift-JIS.
      {"\x95\xcf\x88\xca (mm),\x89\xd7\x8f\x64 (N),\x8e\x9e\x8a\xd4 (s)\n", "@x,@f,@t\n", "", '.',
       1, 1},
      // Two specimens with the same names.
      {"Probe 1;;;Probe 2;;\nZeit;Weg;Kraft;Zeit;Weg;Kraft\ns;mm;N;s;mm;N\n", "@t;@x;@f;@t;@f;@x\n",
       "", ',', 1, 1},
      // A unit of another kind excludes a column.
      {"Time (Sec),Position Millimeters,Strain position (%),Load Newtons,Load rate (N/s)\n",
       "@t,@x,@f,@f,@t\n", "", '.', 1, 1},
  };
  g_autoptr(SbMeasured) first =
      read_habit(&(Habit){"Time (s),Position (mm),Force (N)\n", "@t,@x,@f\n", "", '.', 1, 1});
  for (size_t i = 0; i < G_N_ELEMENTS(habits); i++) {
    g_autoptr(SbMeasured) other = read_habit(&habits[i]);
    g_test_message("habit %zu", i);
    g_assert_cmpuint(other->count, ==, ROWS);
    // Roundings of a row's five digits, of those of the zero and of the slope.
    const double force = 2e-5 / habits[i].force_scale + 2e-5;
    for (int k = 0; k < ROWS; k++) {
      g_assert_cmpfloat_with_epsilon(other->force[k], first->force[k], force);
      g_assert_cmpfloat_with_epsilon(other->displacement[k], first->displacement[k],
                                     1e-3 * (4e-5 / habits[i].place_scale + 4e-5));
    }
  }
  // A typographic minus, and groups of thousands by commas in quotes.
  static const char text[] = "a,b\n\"\xe2\x88\x92"
                             "1,729.2\",0.5\n\"12,345.0\",1\n4.7,2\n";
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbTextTable) table = sb_text_table_parse(text, strlen(text), NULL, "x", issues);
  SbTextTableRows rows;
  double *value;
  g_assert_true(sb_text_table_read(&rows, &value, table, (size_t[]){0}, 1, issues));
  g_assert_cmpuint(rows.rows, ==, 3);
  g_assert_true(value[0] == -1729.2 && value[1] == 12345 && value[2] == 4.7);
  g_free(value);
}

// What was found, written as keys, gives the same rows again; and a key stands against the data.
static void test_said(void) {
  g_autoptr(GBytes) bytes = write_file(&plain);
  SbData *data = sb_data_of_file("x.csv");
  g_autoptr(SbMeasured) found = read_bytes(bytes, data);
  g_autofree char *keys = sb_measured_keys(found);
  g_auto(GStrv) lines = g_strsplit(g_strchomp(keys), "\n", -1);
  for (char **line = lines; *line != NULL; line++) {
    char *equal = strstr(*line, " = ");
    *equal = '\0';
    for (int k = 0; k < SB_DATA_KEY_COUNT; k++) {
      if (strcmp(*line, sb_data_key_name((SbDataKey)k)) == 0) {
        data->text[k] = g_strdup(equal + 3);
      }
    }
  }
  g_assert_nonnull(data->text[SB_DATA_ZERO]);
  g_autoptr(SbMeasured) said = read_bytes(bytes, data);
  g_assert_cmpint(said->compliance, ==, SB_HOW_SAID);
  g_assert_cmpmem(said->displacement, said->count * sizeof(double), found->displacement,
                  found->count * sizeof(double));
  g_free(data->text[SB_DATA_ZERO]);
  data->text[SB_DATA_ZERO] = g_strdup("as-is");
  g_autoptr(SbMeasured) moved = read_bytes(bytes, data);
  g_assert_cmpfloat_with_epsilon(moved->force[100] - found->force[100], found->no_load, 1e-12);
  sb_data_free(data);
}

// What cannot be read in one way only is one complaint that says so.
static void test_refused(void) {
  static const struct {
    const char *text, *key_text, *said;
    SbDataKey key;
  } cases[] = {
      {"", NULL, "is empty", SB_DATA_FILE},
      {"Weg [mm];Kraft [N]\n1,234;5,678\n1,235;5,679\n", NULL,
       "\"1,234\" is 1234 with a decimal point, 1.234 with a decimal comma", SB_DATA_FILE},
      {"Weg,Kraft\n0,001,12,5\n0,002,12,6\n0,003,12,7\n", NULL,
       "4 cells a row separated by commas, or 2 numbers with decimal commas", SB_DATA_FILE},
      {"0.1,1.5\n0.2,1.6\n0.3,1.7\n", NULL, "no column of the 2 (\"\", \"\") is known as the",
       SB_DATA_FILE},
      {"Weg;Kraft\n0.1;1.5\n0.2;1.6\n0.3;1.7\n", NULL, "(displacement) has no unit", SB_DATA_FILE},
      {"Weg [mm];Stroke [mm];Kraft [N]\n0.1;1.5;1\n0.2;1.6;2\n0.3;1.7;2\n", NULL,
       "column 1 \"Weg\" and column 2 \"Stroke\" may both be the displacement", SB_DATA_FILE},
      {"Time;Weg [mm];Kraft [N]\n03/02/2026 23:59:59;1.5;1\n04/02/2026 00:00:01;1.6;2\n", NULL,
       "the date advances by a day or by a month", SB_DATA_FILE},
      {"Weg [mm];Kraft [N]\n0.1;1.5\n0.2;1.6\n", "dots", "\"dots\" is not one of these",
       SB_DATA_DECIMAL},
      {"Weg [mm];Kraft [N]\n0.1;1.5\n0.2;1.6\n", "force, force2", "is not a column that is read",
       SB_DATA_COLUMNS},
      {"Time [s];Kraft [N]\n0;1.5\n1;1.6\n2;1\n", NULL,
       "specify the constant speed of the machine, as in speed = 20 mm/min", SB_DATA_FILE},
      {"Time [s];Kraft [N]\n0;1\n1;2\n2;3\n3;4\n4;5\n5;6\n6;7\n7;8\n", "20 mm/min",
       "at row 8 of 8: that is not a stroke and return", SB_DATA_SPEED},
      {"Time [s];Kraft [N]\n0;1\n1;2\n2;3\n", "20 mm", "\"20 mm\" is not a speed", SB_DATA_SPEED},
      {"Weg [mm];Kraft [N]\n0;1\n1;2\n2;3\n", "20 mm/min", "the displacement has a column",
       SB_DATA_SPEED},
      {"Weg [km];Kraft [N]\n0.1;1.5\n0.2;1.6\n", NULL, "row 1 has a displacement of 100 m",
       SB_DATA_FILE},
      {"Weg [mm];Kraft [MN]\n0.1;0.1\n0.2;1.6\n", NULL, "row 2 has a force of 1.6e+06 N",
       SB_DATA_FILE},
      {"Weg [mm];Kraft [dyn]\n0.1;1.5\n0.2;1.6\n", NULL, "\"dyn\", which is none of its kind",
       SB_DATA_FILE},
      {"Weg [mm];Kraft [x10 N]\n0.1;1.5\n0.2;2e4\n", "mm, 10 N", "row 2 has a force of 200000 N",
       SB_DATA_UNITS},
      {"PK\x03\x04\nA [mm];F [N]\n1;1\n2;2\n", NULL, "is a workbook (.xlsx, .ods)", SB_DATA_FILE},
      {"<table>\nA [mm];F [N]\n1;1\n2;2\n", NULL, "is HTML or XML: export it as text",
       SB_DATA_FILE},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    SbData *data = sb_data_of_file("x.csv");
    if (cases[i].key_text != NULL) {
      data->text[cases[i].key] = g_strdup(cases[i].key_text);
    }
    g_assert_null(sb_measured_read(data, 0, cases[i].text, strlen(cases[i].text), issues));
    g_assert_cmpuint(issues->len, ==, 1);
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    if (strstr(line, cases[i].said) == NULL) {
      g_error("%s instead of %s", line, cases[i].said);
    }
    sb_data_free(data);
  }
}

// A refusal has the key that decides and its plausible values; each of them is accepted.
static void test_choices(void) {
  static const struct {
    const char *text, *key, *values;
  } cases[] = {
      {"Weg [mm];Kraft [N]\n1,234;5,678\n1,235;5,679\n", "decimal", "point\ncomma"},
      {"Weg,Kraft\n0,001,12,5\n0,002,12,6\n0,003,12,7\n", "separator", "comma"},
      {"Time;Weg [mm];Kraft [N]\n03/02/2026 23:59:59;1.5;1\n04/02/2026 00:00:01;1.6;2\n"
       "04/02/2026 00:00:03;1.7;2\n",
       "dates", "day-month\nmonth-day"},
      {"Weg [mm];Stroke [mm];Kraft [N]\n0.1;1.5;1\n0.2;1.6;2\n0.3;1.7;2\n", "columns",
       "displacement, -, force\n-, displacement, force"},
      // Of two forces too, none is chosen with the displacement.
      {"Weg [mm];Stroke [mm];Kraft [N];Load [N]\n0.1;1.5;1;1\n0.2;1.6;2;2\n0.3;1.7;2;2\n",
       "columns", "displacement\n-, displacement"},
      {"s;a;b;Kraft [N]\n0;0.1;1.5;1\n1;0.2;1.6;2\n2;0.3;1.7;2\n", "units",
       "mm, -, -, N\nµm, -, -, N\nin, -, -, N"},
      {"0.1,1.5\n0.2,1.6\n0.3,1.7\n", "columns", "displacement\n-, displacement"},
      {"Weg;Kraft\n0.1;1.5\n0.2;1.6\n0.3;1.7\n", "units", "mm, -\nµm, -\nin, -"},
      {"Weg (mm);Kraft (N)\nmm;kN\n0.1;1.5\n0.2;1.6\n0.3;1.7\n", "units", "mm, kN\nmm, N"},
      {"Weg_mm [um];Kraft (N)\n0.1;1.5\n0.2;1.6\n0.3;1.7\n", "units", "µm, N\nmm, N"},
      {"Force factor: 0.001\nWeg;Kraft\nmm;N\n0.1;1.5\n0.2;1.6\n0.3;1.7\n", "units",
       "mm, 0.001 N\nmm, N"},
      {"Kraftfaktor;0,001\nKraft;Weg\nN;mm\n0,1;1,5\n0,2;1,6\n0,3;1,7\n", "units",
       "0.001 N, mm\nN, mm"},
      {"Weg;Kraft\nmm;N\nScale;0.001\n0.1;1.5\n0.2;1.6\n0.3;1.7\n", "units", "mm, 0.001 N\nmm, N"},
      {"Weg (mm);Kraft (N) x 0.001\n0.1;1.5\n0.2;1.6\n0.3;1.7\n", "units", "mm, 0.001 N\nmm, N"},
      {"mm;N\nWeg;Kraft\nin;N\n0.1;1.5\n0.2;1.6\n0.3;1.7\n", "units", "in, N\nmm, N"},
      {"Weg [mm];Kraft\n0.1;1.5\n0.2;1.6\n0.3;1.7\n", "units",
       "mm, N\nmm, kN\nmm, gf\nmm, kgf\nmm, lbf"},
      {"Time [s];Kraft [N]\n0;1.5\n1;1.6\n2;1\n", "speed", ""},
      {"Zeit [0.1 s];Weg [mm];Kraft [N]\n0;0;1.5\n1;1;1.6\n2;1;1\n", "units",
       "0.1 s, mm, N\ns, mm, N"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    SbData *data = sb_data_of_file("x.csv");
    g_assert_null(sb_measured_read(data, 0, cases[i].text, strlen(cases[i].text), issues));
    g_assert_cmpuint(issues->len, ==, 1);
    sb_issues_add_copy(issues, issues->pdata[0]);
    const SbIssue *issue = issues->pdata[1];
    assert_choice(&issue->choice, issue->text, cases[i].key, cases[i].values);
    g_autofree char *line = sb_issue_line(issue), *problem = sb_issue_problem(issue);
    g_autofree char *start = g_strndup(line, strlen(problem));
    g_assert_cmpstr(start, ==, problem);
    for (char **value = issue->choice.value; *value != NULL; value++) {
      g_autoptr(GPtrArray) after = sb_issues_new();
      g_autofree char *keys = g_strdup_printf("%s = %s\n", cases[i].key, *value);
      SbData *chosen = sb_data_copy(data);
      sb_data_set_keys(chosen, keys);
      SbMeasured *m = sb_measured_read(chosen, 0, cases[i].text, strlen(cases[i].text), after);
      g_assert_true(m == NULL && after->len == 1); // three rows are no loop
      g_autofree char *next = sb_issue_line(after->pdata[0]);
      g_assert_cmpstr(next, !=, line);
      sb_data_free(chosen);
    }
    sb_data_free(data);
  }
}

// A record over time alone of a machine: its displacement is that of the columns, at the speed that
// a key or the drive says; crossed signs and rows of a second cycle change nothing.
static void test_time_alone(void) {
  g_autoptr(SbMeasured) with = read_dialect(&plain);
  for (int k = 0; k < 3; k++) {
    GString *text = g_string_new("Zeit;Kraft\ns;N\n");
    for (guint i = 0; i < ROWS + (k == 2 ? ROWS / 2 : 0); i++) {
      char cell[2][40];
      g_ascii_formatd(cell[0], 40, "%.4f", bench.time[i % ROWS] + (i < ROWS ? 0 : 42.5));
      g_ascii_formatd(cell[1], 40, "%.4f", (k == 1 ? -1 : 1) * bench.force[i % ROWS]);
      g_string_append_printf(text, "%s;%s\n", cell[0], cell[1]);
    }
    SbData *data = sb_data_of_file("x.csv");
    data->text[SB_DATA_SPEED] = k == 0 ? g_strdup("20 mm/min") : NULL;
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autoptr(SbMeasured) m =
        sb_measured_read(data, k == 0 ? 0 : 20e-3 / 60, text->str, text->len, issues);
    g_assert_nonnull(m);
    g_assert_true(m->speed_how == (k == 0 ? SB_HOW_SAID : SB_HOW_ASSUMED));
    g_assert_cmpuint(m->cycle->len, ==, 1);
    g_assert_cmpuint(m->count + m->behind, ==, ROWS + (k == 2 ? ROWS / 2 : 0));
    g_assert_cmpuint(m->count, >, ROWS - 20);
    const size_t count = MIN(m->count, with->count);
    for (size_t i = AIR; i < count; i++) {
      g_assert_cmpfloat_with_epsilon(m->displacement[i], with->displacement[i], 5e-6);
    }
    for (int s = SB_STAGE_B; s < SB_STAGE_COUNT; s++) {
      g_assert_true(m->stage[s].found == with->stage[s].found);
      g_assert_cmpfloat_with_epsilon(m->stage[s].force, with->stage[s].force, 0.05);
    }
    // What was found, said as keys, is found again.
    g_autofree char *keys = sb_measured_keys(m);
    g_assert_nonnull(strstr(keys, "speed = 20 mm/min\n"));
    sb_data_free(data);
    g_string_free(text, TRUE);
  }
}

// A key settles what reads in two ways.
static void test_settled(void) {
  static const char text[] = "Weg [um];Kraft [mN]\n1,234;5,678\n1,235;5,679\n1,240;5,678\n"
                             "1,250;5,671\n1,260;5,672\n1,250;3,671\n1,240;3,671\n1,230;3,671\n";
  for (int comma = 0; comma < 2; comma++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    SbData *data = sb_data_of_file("x.csv");
    data->text[SB_DATA_DECIMAL] = g_strdup(comma ? "comma" : "point");
    data->text[SB_DATA_ZERO] = g_strdup("as-is");
    data->text[SB_DATA_COMPLIANCE] = g_strdup("none");
    g_autoptr(SbMeasured) m = sb_measured_read(data, 0, text, strlen(text), issues);
    g_assert_nonnull(m);
    g_assert_cmpfloat_with_epsilon(m->displacement[0], comma ? 1.234e-6 : 1.234e-3, 1e-15);
    sb_data_free(data);
  }
}

// Numbers behind a blank line that do not continue the table are dropped, and counted; a cycle
// with a clock of its own, pages and lines apart are read.
static void test_blocks(void) {
#define HEAD "Zeit [s];Weg [mm];Kraft [N]\n"
#define LOOP "0;0;20\n1;1;20\n2;2;20\n3;3;20\n4;4;20\n5;3;5\n6;2;5\n7;0;5\n"
  enum { HALF = 40, COUNT = 2 * HALF + 1 };
  static const struct {
    const char *head, *tail; // before and behind the rows
    int every;               // rows between blank lines; 0: no blank line
    size_t rows, dropped;
    bool jumps, timeless;
    size_t tests; // below the first one
  } cases[] = {
      {"", "", 0, COUNT, 0, false, false, 0},
      {"", "", 1, COUNT, 0, false, false, 0},
      {"", "", 7, COUNT, 0, false, false, 0},
      {"", "", 7, COUNT, 0, false, true, 0},
      {"", "\n8,1;9,75;20,0\n0,1;0,0;5,0\n", 0, COUNT, 2, false, false, 0},
      {"", ";;\n;;\n4,1;0,0;20,0\n", 0, COUNT, 1, false, false, 0},
      {"", "\n9,75;20,0\n0,0;5,0\n", 0, COUNT, 2, false, false, 0},
      {"", "\n9,75\n", 7, COUNT, 1, false, false, 0},
      {"", "\n;9,75;20,0\n", 0, COUNT, 1, false, true, 0},
      {"8,1;9,75;20,0\n0,1;0,0;5,0\n\n", "", 0, COUNT, 2, false, false, 0},
      {"", "\n9,9;9,75;20,0\n9,9;8,0;5,0\n", 0, COUNT, 2, false, false, 0},
      {"", "\n" LOOP, 0, COUNT + 8, 0, true, false, 1},
      {"", HEAD LOOP, 0, COUNT + 8, 0, true, false, 1},
      {"", LOOP, 0, COUNT + 8, 0, true, false, 1},
      {"1;1;1\n", "", 0, COUNT, 1, false, false, 0},
      {"60;50;1000\n", "", 0, COUNT, 1, false, false, 0}, // full scales
      {"60;50;1000\n", "", 0, COUNT, 1, false, true, 0},
      {"", "\nProbe 2\n" HEAD LOOP, 0, COUNT + 8, 0, true, false, 1},
      {"", "\nZyklus 2\n" HEAD LOOP, 0, COUNT + 8, 0, true, false, 0},
      {"0;0;1\n1;9;2\n" HEAD, "", 0, COUNT, 2, false, false, 0},
      {"", "\n0;7;20\n1;6;20\n2;7;20\n3;6;20\n4;7;20\n5;6;5\n6;7;5\n7;6;5\n", 0, COUNT, 8, false,
       false, 0},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GString) text = g_string_new(cases[i].timeless ? "n;Weg [mm];Kraft [N]\n"
                                                             : "Zeit [s];Weg [mm];Kraft [N]\n");
    g_string_append(text, cases[i].head);
    for (int k = 0; k < COUNT; k++) {
      const int place = 25 * (HALF - ABS(k - HALF));
      g_string_append_printf(text, "%d,%d;%d,%02d;%d,0\n%s", k / 10, k % 10, place / 100,
                             place % 100, k <= HALF ? 20 : 5,
                             cases[i].every > 0 && k % cases[i].every == 0 ? "\n" : "");
    }
    g_string_append(text, cases[i].tail);
    SbData *data = sb_data_of_file("x.csv");
    g_autoptr(GBytes) bytes = g_bytes_new(text->str, text->len);
    g_autoptr(SbMeasured) m = read_bytes(bytes, data);
    sb_data_free(data);
    g_test_message("case %zu", i);
    g_assert_cmpuint(m->count, ==, cases[i].rows);
    g_assert_cmpuint(m->dropped, ==, cases[i].dropped);
    g_assert_true(m->jumps == cases[i].jumps);
    g_autofree char *words = sb_measured_text(m);
    g_assert_true((strstr(words, "continue the table") != NULL) == (cases[i].dropped > 0));
    g_assert_true((strstr(words, "jumps at a blank line") != NULL) == cases[i].jumps);
    g_assert_cmpuint(m->tests, ==, cases[i].tests);
    g_assert_cmpuint(m->last, ==, cases[i].tests > 0 ? 0 : m->cycle->len - 1);
    g_assert_true((strstr(words, "one below the other") != NULL) == (cases[i].tests > 0));
  }
}

// A labelled row within the rows is left out if it does not continue them; a remark is none.
static void test_labels(void) {
  for (int timed = 0; timed < 2; timed++) {
    GString *text =
        g_string_new(timed ? "Name,Ext (mm),Load (N),Time (s)\n" : "Name,Ext (mm),Load (N)\n");
    for (int k = 0; k < 80; k++) {
      const int place = k < 40 ? k : 80 - k;
      g_string_append_printf(text, "%s,%d.5,%d.5", k == 25 ? "peak" : "", place, k < 40 ? 20 : 5);
      g_string_append_printf(text, timed ? ",%d.5\n" : "\n", k);
      if (k == 50) {
        g_string_append(text, timed ? "Mean,15.5,12.5,2.5\nMax,40.5,20.5,79.5\n"
                                    : "Mean,15.5,12.5\nMax,40.5,20.5\n");
      }
    }
    SbData *data = sb_data_of_file("x.csv");
    g_autoptr(GBytes) bytes = g_string_free_to_bytes(text);
    g_autoptr(SbMeasured) m = read_bytes(bytes, data);
    sb_data_free(data);
    g_assert_cmpuint(m->count, ==, 80);
    g_assert_cmpuint(m->dropped, ==, 2);
    g_assert_cmpuint(m->cycle->len, ==, 1);
  }
}

// Two specimens below each other, that a column names though the time goes on; a counter is none.
static void test_specimens(void) {
  static const char *const names[] = {"Specimen", "Sample ID", "Test No.",
                                      "試験片",   "Sample",    "Note"};
  for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
    GString *text = g_string_new(names[k]);
    g_string_append(text, ",Time (s),Ext (mm),Load (N)\n");
    for (int i = 0; i < 80; i++) {
      const int phase = i % 40;
      g_string_append_printf(text, "A%d,%d.5,%d.5,%d.5\n", k == 4 ? i : i / 40, i,
                             phase < 20 ? phase : 40 - phase, phase < 20 ? 20 : 5);
    }
    SbData *data = sb_data_of_file("x.csv");
    g_autoptr(GBytes) bytes = g_string_free_to_bytes(text);
    g_autoptr(SbMeasured) m = read_bytes(bytes, data);
    sb_data_free(data);
    g_assert_cmpuint(m->count, ==, 80);
    g_assert_cmpuint(m->tests, ==, k < 4);
    g_assert_cmpuint(m->last, ==, k < 4 ? 0 : m->cycle->len - 1);
  }
}

// Cells that are numbers, and such that are none.
static void test_numbers(void) {
  static const struct {
    const char *cell;
    double value;
  } cells[] = {{"1234567,5", 1234567.5},
               {"1.234.567,5", 1234567.5},
               {"-0,1", -0.1},
               {"+3e-3", 3e-3},
               {"123456789012345678901234567890", 1.2345678901234568e29},
               {"0,1000000000000000055511151231257827", 0.1},
               {"179769313486231570000E+288", 1.7976931348623157e308},
               {"1.23", NAN},
               {"1.2345", NAN},
               {"0.123", NAN},
               {"1e400", NAN},
               {"nan", NAN},
               {"0x10", NAN},
               {"1,", NAN},
               {"--1", NAN},
               {"1 N", NAN}};
  for (size_t i = 0; i < G_N_ELEMENTS(cells); i++) {
    // Among rows that leave no doubt of the dialect.
    GString *text = g_string_new("a;b\n");
    for (int k = 0; k < 5; k++) {
      g_string_append(text, "1.000.000,5;0,25\n");
    }
    g_string_append_printf(text, "%s;0,5\n", cells[i].cell);
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autoptr(SbTextTable) table = sb_text_table_parse(text->str, text->len, NULL, "x", issues);
    g_assert_nonnull(table);
    SbTextTableRows rows;
    double *value;
    const size_t first = 0;
    g_assert_true(sb_text_table_read(&rows, &value, table, &first, 1, issues));
    if (isnan(cells[i].value)) {
      g_assert_cmpuint(rows.rows, ==, 5);
      g_assert_cmpint(rows.left_line, ==, 7);
    } else {
      g_assert_cmpuint(rows.rows, ==, 6);
      g_assert_cmpfloat(value[5], ==, cells[i].value);
    }
    g_free(value);
    g_free(rows.left_text);
    g_string_free(text, TRUE);
  }
}

// The message names the first line that is not a row, not a damaged row before it.
static void test_left_line(void) {
  static const char text[] = "a;b\n1;2\n1;3\n1;\0002\n3;4\nabc;\n5;6\n";
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbTextTable) table = sb_text_table_parse(text, sizeof text - 1, NULL, "x", issues);
  g_assert_nonnull(table);
  SbTextTableRows rows;
  double *value[2];
  g_assert_true(sb_text_table_read(&rows, value, table, (size_t[]){0, 1}, 2, issues));
  g_assert_cmpuint(rows.damaged, ==, 1);
  g_assert_cmpuint(rows.skipped, ==, 1);
  g_assert_cmpint(rows.left_line, ==, 6);
  g_assert_cmpstr(rows.left_text, ==, "abc;");
  g_free(value[0]);
  g_free(value[1]);
  g_free(rows.left_text);
}

// Clocks, past midnight too.
static void test_clocks(void) {
  static const char text[] = "Time;x\n2026-02-03 23:59:59.50;1\n2026-02-04 00:00:01.25;2\n";
  static const char bare[] = "Time;x\n23:59:59,50;1,0\n00:00:01,25;2,0\n";
  const char *const texts[] = {text, bare};
  for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autoptr(SbTextTable) table =
        sb_text_table_parse(texts[i], strlen(texts[i]), NULL, "x", issues);
    g_assert_nonnull(table);
    SbTextTableRows rows;
    double *value;
    const size_t first = 0;
    g_assert_true(sb_text_table_read(&rows, &value, table, &first, 1, issues));
    g_assert_cmpfloat(value[1] - value[0], ==, 1.75);
    g_free(value);
  }
}

// A scene keeps its data, also when it moves to another folder.
// The bytes of a table are not needed after it was recognised, in any encoding.
static void test_bytes(void) {
  enum { LINES = 60000 };
  for (int wide = 0; wide < 2; wide++) {
    GString *text = g_string_new("t;x;F\n");
    for (int i = 0; i < LINES; i++) {
      g_string_append_printf(text, "%d;%d;%d%s\n", i, 3 * i % 1001, 7 * i % 911,
                             i == LINES / 2 ? ";                                " : "");
    }
    gsize length = text->len;
    char *bytes =
        wide ? g_convert(text->str, (gssize)text->len, "UTF-16LE", "UTF-8", NULL, &length, NULL)
             : g_strndup(text->str, text->len);
    g_string_free(text, TRUE);
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autoptr(SbTextTable) table = sb_text_table_parse(bytes, length, NULL, "x", issues);
    g_free(bytes);
    g_assert_nonnull(table);
    SbTextTableRows rows;
    double *value[2];
    g_assert_true(sb_text_table_read(&rows, value, table, (size_t[]){0, 2}, 2, issues));
    g_assert_cmpuint(rows.rows, ==, LINES);
    for (int i = 0; i < LINES; i++) {
      g_assert_true(value[0][i] == i && value[1][i] == 7 * i % 911);
    }
    g_free(value[0]);
    g_free(value[1]);
    g_free(rows.left_text);
  }
}

static void test_document_moves(void) {
  g_autofree char *from = g_dir_make_tmp("sealbench-XXXXXX", NULL);
  g_autofree char *to = g_dir_make_tmp("sealbench-XXXXXX", NULL);
  g_autofree char *one = g_build_filename(from, "a.valve", NULL);
  g_autofree char *two = g_build_filename(to, "a.valve", NULL);
  g_autofree char *file = g_build_filename(from, "lot.csv", NULL);
  g_assert_true(g_file_set_contents(one,
                                    "[sealbench]\nformat = 1\nkind = valve\n[data lot 2]\n"
                                    "file = lot.csv\nunits = mm, N\n",
                                    -1, NULL));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_load(one, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_true(sb_document_save(document, two, NULL));
  g_autoptr(SbDocument) moved = sb_document_load(two, issues);
  const SbDocument *const both[] = {document, moved};
  for (size_t i = 0; i < G_N_ELEMENTS(both); i++) {
    g_assert_cmpuint(sb_document_data_count(both[i]), ==, 1);
    const SbData *data = sb_document_data(both[i], 0);
    g_autofree char *path = g_canonicalize_filename(data->path, NULL);
    g_assert_cmpstr(path, ==, file);
    g_assert_cmpstr(data->name, ==, "lot 2");
    g_assert_cmpstr(data->text[SB_DATA_UNITS], ==, "mm, N");
  }
  g_unlink(one);
  g_unlink(two);
  g_rmdir(from);
  g_rmdir(to);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  make_bench();
  g_test_add_func("/measured/dialects", test_dialects);
  g_test_add_func("/measured/habits", test_habits);
  g_test_add_func("/measured/found", test_found);
  g_test_add_func("/measured/peak", test_peak);
  g_test_add_func("/measured/said", test_said);
  g_test_add_func("/measured/refused", test_refused);
  g_test_add_func("/measured/choices", test_choices);
  g_test_add_func("/measured/time-alone", test_time_alone);
  g_test_add_func("/measured/settled", test_settled);
  g_test_add_func("/measured/blocks", test_blocks);
  g_test_add_func("/measured/labels", test_labels);
  g_test_add_func("/measured/specimens", test_specimens);
  g_test_add_func("/measured/numbers", test_numbers);
  g_test_add_func("/measured/left-line", test_left_line);
  g_test_add_func("/measured/clocks", test_clocks);
  g_test_add_func("/measured/files", test_bytes);
  g_test_add_func("/measured/document", test_document_moves);
  return g_test_run();
}

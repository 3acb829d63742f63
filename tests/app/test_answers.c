// Answers and their store: the same from any number of threads, in shards, after an interruption,
// from a store that was joined; what is no store is refused.
#define _GNU_SOURCE // memmem
#include "app/study/answers.h"

#include "app/base/error.h"

#include "engine/valve/sealbench.h"

#include <glib/gstdio.h>
#include <math.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 24, FIGURES = 3 };

static char *folder;
static SbModel *base;
static double value[SAMPLES];
static int figure[FIGURES];
static const SbParamId parameter[] = {SB_P_GLAND_RADIAL_SPACE};

static char *in_folder(const char *name) {
  return g_build_filename(folder, name, NULL);
}

static SbStore *open_store(const char *path) {
  static const char *const parameters[] = {"gland.radial_space", NULL};
  static const char *const figures[] = {"a", "b", "c", NULL};
  g_autoptr(GError) error = NULL;
  SbStore *store = sb_store_open(path, &error);
  g_assert_no_error(error);
  g_assert_true(sb_store_set_list(store, parameters, figures, &error));
  return store;
}

static void close_store(SbStore *store) {
  g_assert_true(sb_store_close(store, NULL));
}

static SbQuestions questions(SbStore *store, int jobs) {
  return (SbQuestions){.base = base,
                       .base_sha256 = "base",
                       .parameter = parameter,
                       .parameters = 1,
                       .figure = figure,
                       .figures = FIGURES,
                       .value = value,
                       .samples = SAMPLES,
                       .jobs = jobs,
                       .store = store};
}

static void same(const SbAnswers *a, const SbAnswers *b) {
  g_assert_cmpmem(a->status, SAMPLES, b->status, SAMPLES);
  g_assert_cmpmem(a->value, SAMPLES * FIGURES * sizeof(double), b->value,
                  SAMPLES * FIGURES * sizeof(double));
}

static void test_threads(void) {
  SbAnswers one, four;
  SbStore *store = open_store(NULL), *other = open_store(NULL);
  SbQuestions asked = questions(store, 1);
  g_assert_true(sb_answers_get(&one, &asked, NULL));
  asked = questions(other, 4);
  g_assert_true(sb_answers_get(&four, &asked, NULL));
  g_assert_cmpuint(four.computed, ==, SAMPLES);
  same(&one, &four);
  // The last sample's radial space is more than its ring: no valve, and why.
  g_assert_cmpint(one.status[SAMPLES - 1], !=, SB_OK);
  g_assert_nonnull(g_hash_table_lookup(one.reason, GSIZE_TO_POINTER(SAMPLES - 1)));
  g_assert_true(isnan(one.value[(SAMPLES - 1) * FIGURES]));
  g_assert_cmpint(one.status[0], ==, SB_OK);
  g_assert_true(one.value[0] > one.value[FIGURES]); // less space, more load
  sb_answers_release(&one);
  sb_answers_release(&four);
  close_store(store);
  close_store(other);
}

static void count_seen(void *data, size_t sample, SbStatus status, const SbReport *report,
                       const SbEvaluator *evaluator) {
  int *seen = data;
  g_assert_true((sb_evaluator_summary(evaluator) != NULL) == (status == SB_OK));
  g_assert_true(status == SB_OK || report->text[0] != '\0');
  seen[sample]++;
}

// Without a store: what is asked twice is computed once, a value that is none is the base's, a
// variable overrides nothing.
static void test_without_store(void) {
  enum { ROWS = 5, COLUMNS = 2 };
  static const SbParamId columns[] = {SB_P_GLAND_RADIAL_SPACE, (SbParamId)SB_QUESTION_NONE};
  const double space = sb_model_value(base, SB_P_GLAND_RADIAL_SPACE);
  const double row[ROWS * COLUMNS] = {1.3e-3, 1, NAN, 2, 1.3e-3, 3, space, NAN, 9e-3, 1};
  int seen[ROWS] = {0};
  SbAnswers answers;
  SbQuestions asked = questions(NULL, 2);
  asked.parameter = columns;
  asked.parameters = COLUMNS;
  asked.value = row;
  asked.samples = ROWS;
  asked.seen = count_seen;
  asked.data = seen;
  g_assert_true(sb_answers_get(&answers, &asked, NULL));
  g_assert_cmpuint(answers.computed, ==, ROWS - 1);
  for (int i = 0; i < ROWS; i++) {
    g_assert_cmpint(seen[i], ==, i != 2);
    g_assert_cmpint(answers.status[i] == SB_OK, ==, i < 4);
  }
  // A valve that sticks has no dose: not a number, twice the same one.
  const size_t bytes = FIGURES * sizeof *answers.value;
  g_assert_cmpmem(answers.value + 2 * FIGURES, bytes, answers.value, bytes);
  g_assert_cmpmem(answers.value + 3 * FIGURES, bytes, answers.value + FIGURES, bytes);
  g_assert_cmpfloat(answers.value[0], !=, answers.value[FIGURES]);
  sb_answers_release(&answers);
}

static bool after_five(void *data) {
  return *(size_t *)data >= 5;
}

static void count(void *data, size_t done, size_t of) {
  *(size_t *)data = done;
}

// What was finished is not computed again.
static void test_resume(void) {
  g_autofree char *path = in_folder("resumed.store");
  SbAnswers whole, part;
  SbStore *fresh = open_store(NULL), *store = open_store(path);
  SbQuestions asked = questions(fresh, 2);
  g_assert_true(sb_answers_get(&whole, &asked, NULL));
  size_t done = 0;
  asked = questions(store, 1);
  asked.progress = count;
  asked.cancelled = after_five;
  asked.data = &done;
  g_autoptr(GError) error = NULL;
  if (!sb_answers_get(&part, &asked, &error)) {
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_CANCELLED);
  }
  const size_t before = part.computed;
  g_assert_cmpuint(before, >=, 5);
  sb_answers_release(&part);
  close_store(store);
  store = open_store(path);
  g_assert_cmpuint(sb_store_count(store), ==, before);
  asked = questions(store, 2);
  g_assert_true(sb_answers_get(&part, &asked, NULL));
  g_assert_cmpuint(part.computed, ==, SAMPLES - before);
  same(&whole, &part);
  g_assert_nonnull(g_hash_table_lookup(part.reason, GSIZE_TO_POINTER(SAMPLES - 1)));
  sb_answers_release(&part);
  // Another base is another question.
  asked.base_sha256 = "other";
  g_assert_true(sb_answers_get(&part, &asked, NULL));
  g_assert_cmpuint(part.computed, ==, SAMPLES);
  sb_answers_release(&part);
  sb_answers_release(&whole);
  close_store(store);
  close_store(fresh);
  g_unlink(path);
}

// Four shards, joined in two orders.
static void test_shards(void) {
  enum { SHARDS = 4 };
  SbAnswers whole, joined;
  SbStore *fresh = open_store(NULL);
  SbQuestions asked = questions(fresh, 2);
  g_assert_true(sb_answers_get(&whole, &asked, NULL));
  char *path[SHARDS];
  size_t computed = 0;
  for (size_t i = 0; i < SHARDS; i++) {
    g_autofree char *name = g_strdup_printf("shard-%zu.store", i);
    path[i] = in_folder(name);
    SbStore *store = open_store(path[i]);
    SbAnswers part;
    asked = questions(store, 1);
    asked.shard = i;
    asked.shards = SHARDS;
    g_assert_true(sb_answers_get(&part, &asked, NULL));
    g_assert_cmpint(part.status[(i + 1) % SHARDS], ==, SB_ANSWER_MISSING);
    computed += part.computed;
    sb_answers_release(&part);
    close_store(store);
  }
  g_assert_cmpuint(computed, ==, SAMPLES);
  static const int order[][SHARDS] = {{0, 1, 2, 3}, {2, 3, 1, 0}};
  for (size_t k = 0; k < G_N_ELEMENTS(order); k++) {
    SbStore *all = open_store(NULL);
    g_autoptr(GError) error = NULL;
    for (int i = 0; i < SHARDS; i++) {
      g_assert_true(sb_store_merge(all, path[order[k][i]], &error));
      g_assert_no_error(error);
    }
    asked = questions(all, 1);
    g_assert_true(sb_answers_get(&joined, &asked, NULL));
    g_assert_cmpuint(joined.computed, ==, 0);
    same(&whole, &joined);
    sb_answers_release(&joined);
    close_store(all);
  }
  for (int i = 0; i < SHARDS; i++) {
    g_unlink(path[i]);
    g_free(path[i]);
  }
  sb_answers_release(&whole);
  close_store(fresh);
}

// Two answers to one question are reported with the figure that differs; nothing is merged.
static void test_disagree(void) {
  guint8 key[SB_STORE_KEY] = {7}, own[SB_STORE_KEY] = {8};
  const double at = 1, low[] = {1, 2, 3}, high[] = {1, 2, 4};
  char *paths[] = {in_folder("a.store"), in_folder("b.store")};
  for (int i = 0; i < 2; i++) {
    SbStore *store = open_store(paths[i]);
    const SbStoredAnswer answer = {.value = (double *)(i == 0 ? low : high)};
    g_assert_true(sb_store_put(store, own, &at, &answer, NULL) || i > 0);
    own[1] = 1;
    g_assert_true(sb_store_put(store, key, &at, &answer, NULL));
    close_store(store);
  }
  for (int k = 0; k < 2; k++) {
    g_autoptr(GError) error = NULL;
    SbStore *all = open_store(NULL);
    // The same answer twice is no difference.
    g_assert_true(sb_store_merge(all, paths[k], NULL) && sb_store_merge(all, paths[k], NULL));
    g_assert_true(sb_store_commit(all, NULL));
    g_assert_cmpuint(sb_store_count(all), ==, 2);
    g_assert_false(sb_store_merge(all, paths[1 - k], &error));
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
    g_assert_nonnull(strstr(error->message, paths[1 - k]));
    g_assert_nonnull(strstr(error->message, k == 0 ? "c is 3 and 4" : "c is 4 and 3"));
    sb_store_discard(all);
  }
  for (int i = 0; i < 2; i++) {
    g_unlink(paths[i]);
    g_free(paths[i]);
  }
}

typedef struct {
  const SbAnswers *truth;
  int sound, damaged;
  char *name;
} Seen;

// A row that is not named as damaged is the truth, to the bit.
static bool see(void *data, const SbStoreRow *row) {
  Seen *seen = data;
  if (row->damage != NULL) {
    seen->damaged++;
    g_free(seen->name);
    seen->name = sb_store_row_name(row);
    return true;
  }
  int at = 0;
  seen->sound++;
  g_assert_cmpuint(row->parameters, ==, 1);
  while (at < SAMPLES && value[at] != row->parameter[0]) {
    at++;
  }
  g_assert_cmpint(at, <, SAMPLES);
  g_assert_cmpmem(row->figure, FIGURES * sizeof(double), seen->truth->value + at * FIGURES,
                  FIGURES * sizeof(double));
  g_assert_cmpint(row->status, ==, seen->truth->status[at]);
  return true;
}

static Seen see_all(SbStore *store, const SbAnswers *truth, GError **error) {
  Seen seen = {.truth = truth};
  (void)sb_store_visit(store, see, &seen, error);
  return seen;
}

static void write_bytes(const char *path, const char *bytes, gsize length) {
  g_assert_true(g_file_set_contents(path, bytes, (gssize)length, NULL));
}

// A store of all samples as bytes, and their answers.
static char *make_store(gsize *length, SbAnswers *truth, const char *path) {
  SbStore *store = open_store(path);
  SbQuestions asked = questions(store, 2);
  char *bytes = NULL;
  g_assert_true(sb_answers_get(truth, &asked, NULL));
  close_store(store);
  g_assert_true(g_file_get_contents(path, &bytes, length, NULL));
  return bytes;
}

// One bit of a figure: the row is named and computed again, the others are not.
static void test_flipped_figure(void) {
  g_autofree char *path = in_folder("flipped.store");
  gsize length = 0;
  SbAnswers truth, again;
  g_autofree char *bytes = make_store(&length, &truth, path);
  char *of = memmem(bytes, length, &truth.value[5 * FIGURES], sizeof(double));
  g_assert_nonnull(of);
  of[0] ^= 1;
  write_bytes(path, bytes, length);
  SbStore *store = open_store(path);
  Seen seen = see_all(store, &truth, NULL);
  g_assert_cmpint(seen.damaged, ==, 1);
  g_assert_cmpint(seen.sound, ==, SAMPLES - 1);
  g_autofree char *where = g_strdup_printf("gland.radial_space = %.9g)", value[5]);
  g_assert_nonnull(strstr(seen.name, where));
  g_free(seen.name);
  SbQuestions asked = questions(store, 1);
  g_assert_true(sb_answers_get(&again, &asked, NULL));
  g_assert_cmpuint(again.computed, ==, 1);
  same(&truth, &again);
  seen = see_all(store, &truth, NULL);
  g_assert_cmpint(seen.damaged, ==, 0);
  sb_answers_release(&again);
  sb_answers_release(&truth);
  close_store(store);
  g_unlink(path);
}

// Bits all over the file: it is refused, or no row lies, and what a study does not find sound it
// computes again. Repaired, it has sound rows alone.
static void test_damage(void) {
  enum { FLIPS = 80 };
  g_autofree char *path = in_folder("damaged.store");
  gsize length = 0;
  SbAnswers truth, again;
  g_autofree char *bytes = make_store(&length, &truth, path);
  int refused = 0, found = 0;
  for (gsize k = 0; k < FLIPS; k++) {
    const gsize at = 100 + k * (length - 101) / FLIPS;
    bytes[at] = (char)(bytes[at] ^ (1 << (k % 8)));
    write_bytes(path, bytes, length);
    bytes[at] = (char)(bytes[at] ^ (1 << (k % 8)));
    g_autoptr(GError) error = NULL, structure = NULL;
    SbStore *store = sb_store_open(path, &error);
    if (store == NULL) {
      g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
      refused++;
      continue;
    }
    Seen seen = see_all(store, &truth, &structure);
    g_free(seen.name);
    if (seen.damaged > 0 || structure != NULL || seen.sound < SAMPLES) {
      found++;
      g_assert_true(sb_store_repair(store, &error));
      g_assert_no_error(error);
      seen = see_all(store, &truth, &error);
      g_assert_no_error(error);
      g_assert_cmpint(seen.damaged, ==, 0);
    }
    static const char *const parameters[] = {"gland.radial_space", NULL};
    static const char *const figures[] = {"a", "b", "c", NULL};
    g_assert_true(sb_store_set_list(store, parameters, figures, NULL));
    SbQuestions asked = questions(store, 1);
    g_assert_true(sb_answers_get(&again, &asked, &error));
    g_assert_no_error(error);
    same(&truth, &again);
    sb_answers_release(&again);
    close_store(store);
  }
  g_test_message("%d refused, %d found damaged", refused, found);
  g_assert_cmpint(found, >, FLIPS / 10);
  sb_answers_release(&truth);
  g_unlink(path);
}

// Two readers of a finished store at the same time, neither of which changes it.
static void test_finished(void) {
  g_autofree char *path = in_folder("finished.store");
  gsize length = 0, after = 0;
  SbAnswers truth, again;
  g_autofree char *bytes = make_store(&length, &truth, path), *now = NULL;
  SbStore *one = open_store(path), *two = open_store(path);
  for (int i = 0; i < 2; i++) {
    SbQuestions asked = questions(i == 0 ? one : two, 1);
    g_assert_true(sb_answers_get(&again, &asked, NULL));
    g_assert_cmpuint(again.computed, ==, 0);
    same(&truth, &again);
    // Validity is stored with the figures.
    g_assert_cmpstr(g_hash_table_lookup(again.warnings, GSIZE_TO_POINTER(0)), ==,
                    g_hash_table_lookup(truth.warnings, GSIZE_TO_POINTER(0)));
    sb_answers_release(&again);
  }
  close_store(one);
  close_store(two);
  g_assert_true(g_file_get_contents(path, &now, &after, NULL));
  g_assert_cmpmem(bytes, length, now, after);
  sb_answers_release(&truth);
  g_unlink(path);
}

// A store of Sealbench 0.1: refused by a study, its rows can be read, none can be recovered.
static void test_old_format(void) {
  static const char list[] = "INSERT INTO list VALUES (5, 'gland.radial_space', 'a,b,c')";
  static const char make[] =
      "PRAGMA application_id = 1398951523; PRAGMA user_version = 1;"
      "CREATE TABLE list (id INTEGER PRIMARY KEY, parameters TEXT NOT NULL, figures TEXT NOT NULL);"
      "CREATE TABLE answer (key BLOB PRIMARY KEY, list INTEGER NOT NULL, status INTEGER NOT NULL, "
      "reason TEXT, parameters BLOB NOT NULL, figures BLOB NOT NULL) WITHOUT ROWID;"
      "CREATE TABLE origin (version TEXT, cpu TEXT, PRIMARY KEY (version, cpu));"
      "INSERT INTO answer VALUES (zeroblob(32), 5, 0, NULL, zeroblob(8), zeroblob(24))";
  g_autofree char *path = in_folder("old.store"), *to = in_folder("new.store");
  sqlite3 *file = NULL;
  g_assert_cmpint(sqlite3_open(path, &file), ==, SQLITE_OK);
  g_assert_cmpint(sqlite3_exec(file, make, NULL, NULL, NULL), ==, SQLITE_OK);
  g_assert_cmpint(sqlite3_exec(file, list, NULL, NULL, NULL), ==, SQLITE_OK);
  sqlite3_close(file);
  g_autoptr(GError) error = NULL, unverified = NULL;
  g_assert_null(sb_store_open(path, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
  g_assert_nonnull(strstr(error->message, "Sealbench 0.1"));
  SbStore *store = sb_store_open_rows(path, NULL);
  g_assert_nonnull(store);
  g_assert_cmpint(sb_store_format(store), ==, 1);
  SbStoreHealth health;
  sb_store_health(&health, store);
  g_assert_cmpuint(health.rows, ==, 1);
  g_assert_cmpuint(health.unnamed, ==, 0);
  sb_store_health_release(&health);
  guint64 saved = 0;
  g_assert_false(sb_store_recover(&saved, store, to, &unverified));
  g_assert_nonnull(strstr(unverified->message, "no row can be verified"));
  g_assert_false(g_file_test(to, G_FILE_TEST_EXISTS));
  sb_store_discard(store);
  g_unlink(path);
}

// Returns the number of rows that are saved from a file of these bytes; *sound: whether it has no
// damage.
static guint64 saved_rows(bool *sound, const char *bytes, gsize length) {
  g_autofree char *path = in_folder("pages.store"), *to = in_folder("saved.store");
  g_autoptr(GError) error = NULL;
  g_assert_true(g_file_set_contents(path, bytes, (gssize)length, NULL));
  SbStore *store = sb_store_open_rows(path, &error);
  g_assert_no_error(error);
  SbStoreHealth health;
  sb_store_health(&health, store);
  *sound = health.structure == NULL && health.damaged == 0;
  sb_store_health_release(&health);
  guint64 saved = 0, rows;
  g_assert_true(sb_store_recover(&saved, store, to, &error));
  sb_store_discard(store);
  store = sb_store_open_rows(to, &error);
  g_assert_no_error(error);
  rows = sb_store_count(store);
  g_assert_cmpuint(rows, ==, saved);
  sb_store_discard(store);
  g_unlink(path);
  g_unlink(to);
  return rows;
}

// A file that is cut, and one whose root is another page: both are damaged, and the rows of their
// intact pages are saved.
static void test_pages(void) {
  enum { ROWS = 4000, PAGE = 4096 };
  static const char *const names[] = {"a", NULL};
  g_autofree char *path = in_folder("rows.store"), *bytes = NULL;
  SbStore *store = open_store(path);
  g_assert_true(sb_store_set_list(store, names, names, NULL));
  for (int i = 0; i < ROWS; i++) {
    guint8 key[SB_STORE_KEY] = {(guint8)(i * 37), (guint8)(i / 256)};
    double number = i;
    const SbStoredAnswer answer = {.value = &number};
    g_assert_true(sb_store_put(store, key, &number, &answer, NULL));
  }
  close_store(store);
  gsize length = 0;
  g_assert_true(g_file_get_contents(path, &bytes, &length, NULL));
  bool sound;
  g_assert_cmpuint(saved_rows(&sound, bytes, length), ==, ROWS);
  g_assert_true(sound);
  for (int percent = 40; percent < 100; percent += 10) {
    const guint64 saved = saved_rows(&sound, bytes, length * (gsize)percent / 100);
    g_assert_false(sound);
    g_assert_cmpuint(saved * 100, >, (guint64)((percent - 30) * ROWS));
    g_assert_cmpuint(saved, <, ROWS);
  }
  memcpy(bytes + PAGE * 2, bytes + PAGE * 7, PAGE);
  const guint64 saved = saved_rows(&sound, bytes, length);
  g_assert_false(sound);
  g_assert_cmpuint(saved, >, ROWS * 9 / 10);
  // A header that states 16 GB takes no memory.
  g_autoptr(GError) error = NULL;
  memcpy(bytes + 16, (const char[]){0, 1}, 2);
  memcpy(bytes + 28, (const char[]){0, 4, 0, 0}, 4);
  g_assert_true(g_file_set_contents(path, bytes, (gssize)length, NULL));
  g_assert_null(sb_store_open(path, &error));
  g_clear_error(&error);
  g_unlink(path);
  g_assert_null(sb_store_open(folder, &error));
  g_assert_nonnull(strstr(error->message, "is a folder"));
}

static void test_names(void) {
  static const char *const names[] = {"", "-", ":memory:", "file:x.store", "file:x?mode=memory"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    g_autoptr(GError) error = NULL;
    g_assert_null(sb_store_open(names[i], &error));
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
  }
}

static void test_no_store(void) {
  g_autofree char *path = in_folder("x.store");
  g_autoptr(GError) error = NULL;
  g_assert_true(g_file_set_contents(path, "seal = 1\nbench = 2, and no database at all", -1, NULL));
  g_assert_null(sb_store_open(path, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
  g_clear_error(&error);
  // Every cut of a store's file is told, or has fewer answers; nothing else happens.
  g_unlink(path);
  SbStore *store = open_store(path);
  SbAnswers answers;
  SbQuestions asked = questions(store, 1);
  g_assert_true(sb_answers_get(&answers, &asked, NULL));
  sb_answers_release(&answers);
  // While it is written it is one process' alone.
  g_assert_null(sb_store_open(path, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_IO);
  g_assert_nonnull(strstr(error->message, "is in use by another process"));
  g_clear_error(&error);
  close_store(store);
  char *bytes = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(path, &bytes, &length, NULL));
  for (gsize cut = 100; cut < length; cut += length / 7) {
    g_assert_true(g_file_set_contents(path, bytes, (gssize)cut, NULL));
    SbStore *torn = sb_store_open(path, &error);
    if (torn != NULL) {
      g_assert_cmpuint(sb_store_count(torn), <=, SAMPLES);
      (void)sb_store_close(torn, NULL);
    }
    g_clear_error(&error);
  }
  g_free(bytes);
  g_unlink(path);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  folder = g_dir_make_tmp("sealbench-answers-XXXXXX", NULL);
  SbParams params;
  sb_params_init(&params);
  const SbLimits limits = {0};
  SbProblems problems;
  g_assert_cmpint(sb_model_create(&base, &params, NULL, &limits, &problems), ==, SB_OK);
  for (int i = 0; i < SAMPLES; i++) {
    value[i] = (1.33 + 0.002 * i) * 1e-3;
  }
  value[SAMPLES - 1] = 3e-3;
  figure[0] = sb_figure_find("seals.outer.load_N");
  figure[1] = sb_figure_find("seals.outer.pressure_peak_Pa");
  figure[2] = sb_figure_find("cycle.dose_mass_kg");
  g_test_add_func("/answers/threads", test_threads);
  g_test_add_func("/answers/without-store", test_without_store);
  g_test_add_func("/answers/resume", test_resume);
  g_test_add_func("/answers/shards", test_shards);
  g_test_add_func("/answers/disagree", test_disagree);
  g_test_add_func("/answers/flipped-figure", test_flipped_figure);
  g_test_add_func("/answers/damage", test_damage);
  g_test_add_func("/answers/finished", test_finished);
  g_test_add_func("/answers/old-format", test_old_format);
  g_test_add_func("/answers/pages", test_pages);
  g_test_add_func("/answers/names", test_names);
  g_test_add_func("/answers/no-store", test_no_store);
  const int failed = g_test_run();
  sb_model_destroy(base);
  g_rmdir(folder);
  g_free(folder);
  return failed;
}

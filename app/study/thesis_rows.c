// Rows of a table of the thesis: printed, computed, and the steps between.
#include "app/study/thesis_private.h"

#include "app/base/unit.h"

#include <math.h>
#include <string.h>

// Samples and printed rows belong together to this.
#define SAME 1e-6

const char *sb_thesis_verdict_name(SbThesisVerdict verdict) {
  static const char *const names[] = {
      "agrees",      "explained",    "within bounds", "partly explained",
      "not printed", "not computed", "fails"};
  return (unsigned)verdict < G_N_ELEMENTS(names) ? names[verdict] : "";
}

static bool same(double a, double b) {
  return fabs(a - b) <= SAME * fmax(fabs(a), fabs(b));
}

// The grid's sample of a printed row, by "KEY = EXPRESSION; ..."; false, told, where there is none.
static bool find_sample(SbThesisPlace *at, const char *matches, const char *group,
                        const char *key) {
  g_auto(GStrv) parts = g_strsplit(matches != NULL ? matches : "", ";", -1);
  for (at->sample = 0; at->sample < at->grid->samples; at->sample++) {
    bool meant = true;
    for (char **part = parts; meant && *part != NULL && **part != '\0'; part++) {
      const char *equal = strchr(*part, '=');
      g_autofree char *name =
          g_strstrip(g_strndup(*part, equal != NULL ? (gsize)(equal - *part) : 0));
      double wanted, have;
      SbThesisPlace printed = *at;
      printed.grid = NULL;
      if (equal == NULL || !sb_thesis_value(&wanted, &printed, equal + 1, group, "at") ||
          !sb_thesis_value(&have, at, name, group, "at")) {
        return false;
      }
      meant = same(wanted, have);
    }
    if (meant) {
      return true;
    }
  }
  sb_thesis_add_issue(at->work, group, key, "no sample of [vary %s] is the printed row %d",
                      at->grid->name, at->row + 1);
  return false;
}

// "GRID: EXPRESSION" at a printed row. Why there is no value goes to *why (owned by the caller).
static double evaluate(const SbThesisPlace *from, const char *text, const char *group,
                       const char *key, char **why) {
  SbThesisPlace at = *from;
  g_autofree char *whole = sb_thesis_with_cells(from, text);
  const char *expression;
  double value = NAN;
  if (g_str_has_prefix(whole, "none ")) {
    if (why != NULL) {
      *why = g_strdup(whole + strlen("none "));
    }
    return NAN;
  }
  if (!sb_thesis_grid(&at.grid, &expression, at.work, whole, group, key)) {
    return NAN;
  }
  const char *matches = sb_thesis_key(at.work, group, "at");
  if (at.grid != NULL && !find_sample(&at, matches, group, key)) {
    return NAN;
  }
  (void)sb_thesis_value(&value, &at, expression, group, key);
  if (!isfinite(value) && why != NULL) {
    const char *reason =
        at.grid != NULL ? g_hash_table_lookup(at.grid->reason, GSIZE_TO_POINTER(at.sample)) : NULL;
    *why = g_strdup(reason != NULL ? reason : "not computed");
  }
  return value;
}

const char *sb_thesis_bound(bool *within, bool *about, const char *text) {
  static const char WITHIN[] = "within ", ABOUT[] = "about ";
  const bool is_within = g_str_has_prefix(text, WITHIN), is_about = g_str_has_prefix(text, ABOUT);
  if (within != NULL && about != NULL) {
    *within = is_within;
    *about = is_about;
  }
  return text + (is_within ? strlen(WITHIN) : is_about ? strlen(ABOUT) : 0);
}

// What our value becomes by a step, and its bound where the step is one.
static void take_step(SbThesisPart *part, SbThesisPlace *at, const char *text, double target,
                      const char *group, const char *key) {
  bool within, about;
  text = sb_thesis_bound(&within, &about, text);
  const double value = evaluate(at, text, group, key, NULL), ours = at->ours;
  part->becomes = value;
  if (within || about) {
    const double from = about ? ours - value : fmin(ours, value);
    part->becomes = fmax(from, fmin(target, about ? ours + value : fmax(ours, value)));
    part->bound = about ? copysign(value, target - ours) : value - ours;
  }
}

// The steps `prefix`.1, .2 ... of a group: each takes our value on. `left` is what is left to be
// explained behind the last.
static void read_parts(GArray *out, SbThesisPlace *at, const char *group, const char *prefix,
                       double target, bool last_takes_rest) {
  for (int k = 1;; k++) {
    g_autofree char *key = g_strdup_printf("%s.%d", prefix, k);
    g_autofree char *next = g_strdup_printf("%s.%d", prefix, k + 1);
    const char *text = sb_thesis_key(at->work, group, key);
    if (text == NULL) {
      return;
    }
    g_auto(GStrv) parts = g_strsplit(text, "|", 3);
    const bool rest =
        last_takes_rest && sb_thesis_key(at->work, group, next) == NULL && parts[1] != NULL;
    if (parts[1] == NULL || (parts[2] == NULL && !rest)) {
      sb_thesis_add_issue(at->work, group, key,
                          parts[1] == NULL ? "names no command or test: TEXT | COMMAND | EXPRESSION"
                                           : "does not compute what it explains: TEXT | COMMAND | "
                                             "EXPRESSION");
      return;
    }
    SbThesisPart part = {.becomes = NAN, .explains = NAN, .bound = NAN};
    if (parts[2] != NULL) {
      take_step(&part, at, g_strstrip(parts[2]), target, group, key);
    } else {
      part.becomes = target;
    }
    part.text = sb_thesis_filled(at, g_strstrip(parts[0]), group, key);
    part.shown_by = g_strdup(g_strstrip(parts[1]));
    part.explains = part.becomes - at->ours;
    at->ours = isfinite(part.becomes) ? part.becomes : at->ours;
    g_array_append_val(out, part);
  }
}

static double share_of(const SbThesisWork *work, const char *group, const char *key) {
  const char *text = sb_thesis_key(work, group, key);
  double value = 0;
  g_autoptr(GError) error = NULL;
  if (text != NULL && strcmp(text, "unknown") == 0) {
    return -1;
  }
  if (text != NULL && !sb_quantity_parse(&value, text, "1", "%", &error)) {
    sb_thesis_add_issue((SbThesisWork *)work, group, key, "%s", error->message);
  }
  return value;
}

// Whether a step that is a bound alone explains anything.
static bool is_bounded(const SbThesisRow *row) {
  for (guint i = 0; i < row->reasons->len; i++) {
    const SbThesisPart *part = &g_array_index(row->reasons, SbThesisPart, i);
    if (isfinite(part->bound) && part->explains != 0) {
      return true;
    }
  }
  return false;
}

static void judge_rows(SbThesisRow *row, double most) {
  const double ours = isfinite(row->thesis) ? row->thesis : row->consistent;
  const double slack = row->rounding + 1e-12 * fabs(row->printed);
  if (!isfinite(row->thesis) && row->no_thesis == NULL) {
    row->fault = g_strdup("no value by the thesis' model");
  } else if (!isfinite(row->printed)) {
    row->verdict = SB_THESIS_NOT_PRINTED;
    return;
  } else if (!isfinite(ours)) {
    row->verdict = SB_THESIS_NOT_COMPUTED;
  } else if (fabs(row->difference) <= slack) {
    row->verdict = SB_THESIS_AGREES;
  } else if (row->reasons->len == 0) {
    row->fault = g_strdup("a difference without a reason");
  } else if (fabs(row->remains) <= fmax(slack, most * fabs(row->printed))) {
    row->verdict = is_bounded(row) ? SB_THESIS_BOUNDED : SB_THESIS_EXPLAINED;
  } else if (most < 0) {
    row->verdict = SB_THESIS_PARTLY;
  } else {
    row->fault = g_strdup("the reasons leave more than they may");
  }
  if (row->fault == NULL && isfinite(row->consistent) && isfinite(row->thesis) &&
      fabs(row->consistent - row->printed) > slack && row->models->len == 0 &&
      !same(row->consistent, row->thesis)) {
    row->fault = g_strdup("no reason for what the consistent set makes of it");
  }
  row->verdict = row->fault != NULL ? SB_THESIS_FAILS : row->verdict;
}

static void take_unit(SbThesisRow *row, const SbThesisPlace *at, const char *group) {
  const char *unit = sb_thesis_key(at->work, group, "unit");
  g_autofree char *text = sb_thesis_with_cells(at, unit != NULL ? unit : "1");
  g_auto(GStrv) words = g_strsplit(text, " ", 2);
  g_strlcpy(row->si, words[0], sizeof row->si);
  g_strlcpy(row->shown,
            words[1] != NULL             ? words[1]
            : strcmp(words[0], "1") == 0 ? ""
                                         : words[0],
            sizeof row->shown);
}

static void take_rows_printed(SbThesisRow *row, const SbThesisPlace *at, const char *group) {
  const char *text = sb_thesis_key(at->work, group, "printed");
  row->printed = row->difference = row->remains = NAN;
  row->rounding = 0;
  if (text != NULL) {
    row->printed = evaluate(at, text, group, "printed", NULL);
    g_autofree char *column = sb_thesis_with_cells(at, text);
    const char *cell = at->work->printed != NULL
                           ? sb_printed_cell(at->work->printed, (guint)at->row, column)
                           : NULL;
    double value;
    (void)sb_printed_number(&value, &row->rounding, cell);
  }
}

static void clear_part(void *data) {
  SbThesisPart *part = data;
  g_free(part->text);
  g_free(part->shown_by);
}

static GArray *new_parts(void) {
  GArray *parts = g_array_new(FALSE, FALSE, sizeof(SbThesisPart));
  g_array_set_clear_func(parts, clear_part);
  return parts;
}

static SbThesisRow *row_of(SbThesisPlace *at, const char *group) {
  SbThesisWork *work = at->work;
  SbThesisRow *row = g_new0(SbThesisRow, 1);
  row->reasons = new_parts();
  row->models = new_parts();
  const char *label = sb_thesis_key(work, group, "label");
  const char *thesis = sb_thesis_key(work, group, "thesis");
  const char *consistent = sb_thesis_key(work, group, "consistent");
  g_autofree char *named =
      sb_thesis_with_cells(at, label != NULL ? label : group + strlen("rows "));
  row->label = sb_thesis_filled(at, named, group, "label");
  take_unit(row, at, group);
  take_rows_printed(row, at, group);
  at->printed = row->printed;
  row->thesis = thesis != NULL ? evaluate(at, thesis, group, "thesis", &row->no_thesis) : NAN;
  at->thesis = row->thesis;
  row->consistent =
      consistent != NULL ? evaluate(at, consistent, group, "consistent", &row->no_consistent) : NAN;
  if (consistent == NULL) {
    row->no_consistent = g_strdup("the same in both sets, or of no model");
  }
  at->consistent = row->consistent;
  const double start = isfinite(row->thesis) ? row->thesis : row->consistent;
  row->difference = start - row->printed;
  const double most = share_of(work, group, "remains");
  const bool needed = fabs(row->difference) > row->rounding;
  at->ours = start;
  if (needed) {
    read_parts(row->reasons, at, group, "reason", row->printed, false);
  }
  row->remains = at->ours - row->printed;
  at->ours = start;
  if (isfinite(row->consistent) && isfinite(row->thesis)) {
    read_parts(row->models, at, group, "model", row->consistent, true);
  }
  judge_rows(row, most);
  return row;
}

// "COLUMN = TEXT" or "COLUMN != TEXT" of a row.
static bool holds(const SbThesisWork *work, guint row, const char *condition) {
  const char *equal = strchr(condition, '=');
  if (equal == NULL) {
    return true;
  }
  const bool not = equal > condition && equal[-1] == '!';
  g_autofree char *column = g_strstrip(g_strndup(condition, (gsize)(equal - condition - not )));
  g_autofree char *text = g_strstrip(g_strdup(equal + 1));
  const char *cell = sb_printed_cell(work->printed, row, column);
  return cell != NULL && (strcmp(cell, text) == 0) != not ;
}

bool sb_thesis_is_meant(const SbThesisWork *work, guint row, const char *where) {
  g_auto(GStrv) parts = g_strsplit(where != NULL ? where : "", ";", -1);
  for (char **part = parts; *part != NULL; part++) {
    if (!holds(work, row, *part)) {
      return false;
    }
  }
  return true;
}

static SbThesisPlace place_of(SbThesisWork *work, guint row) {
  return (SbThesisPlace){.work = work,
                         .row = work->printed != NULL ? (int)row : SB_THESIS_NO_ROW,
                         .printed = NAN,
                         .thesis = NAN,
                         .consistent = NAN,
                         .ours = NAN};
}

// How many rows a group may have.
static guint rows_of(const SbThesisWork *work) {
  return work->printed != NULL ? work->printed->rows->len : 1;
}

static bool is_row(const SbThesisWork *work, const char *group, guint row) {
  return work->printed == NULL ||
         sb_thesis_is_meant(work, row, sb_thesis_key(work, group, "where"));
}

void sb_thesis_want(SbThesisWork *work, SbThesisGrid *grid, const char *group) {
  const char *matches = sb_thesis_key(work, group, "at");
  const guint before = work->issues->len;
  for (guint i = 0; i < rows_of(work); i++) {
    SbThesisPlace at = place_of(work, i);
    at.grid = grid;
    if (is_row(work, group, i) && find_sample(&at, matches, group, "at")) {
      grid->wanted[at.sample] = true;
    }
  }
  g_ptr_array_set_size(work->issues, (gint)before); // told where it is used
}

void sb_thesis_rows(SbThesisItem *item, SbThesisWork *work, const char *group) {
  guint count = 0;
  for (guint i = 0; i < rows_of(work); i++) {
    if (is_row(work, group, i)) {
      SbThesisPlace at = place_of(work, i);
      g_ptr_array_add(item->rows, row_of(&at, group));
      count++;
    }
  }
  if (count == 0) {
    sb_thesis_add_issue(work, group, "where", "means no printed row");
  }
}

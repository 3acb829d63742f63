#include "app/export/thesis_results.h"

#include "app/base/identity.h"
#include "app/base/unit.h"
#include "app/chart/study.h"
#include "app/export/still.h"
#include "app/export/studies.h"
#include "app/table/table.h"

#include "engine/valve/sealbench.h"

#include <math.h>
#include <string.h>

// ---- Words ----

// Returns a value of a row [row->si] with its unit and at most five significant digits.
static char *row_text(const SbThesisRow *row, double value) {
  return sb_quantity_round(value, row->si, row->shown, 5);
}

// As row_text(), of a part of the row's values: to the place of their fifth digit, so that parts
// add up as they are printed and none shows digits that a difference of five digits does not have.
static char *thesis_share_text(const SbThesisRow *row, double value) {
  // NaN are ignored.
  const double most = fmax(fmax(fabs(row->printed), fabs(row->thesis)), fabs(row->consistent));
  const double place = value != 0 && most > 0 ? floor(log10(most)) - floor(log10(fabs(value))) : 0;
  return sb_quantity_round(value, row->si, row->shown, (int)fmax(fmin(5 - place, 5), 1));
}

// What a step explains; rounding is nothing. Owned by the caller.
static char *part_text(const SbThesisRow *row, const SbThesisPart *part) {
  if (!isfinite(part->explains)) {
    return g_strdup("not computed");
  }
  const double scale = isfinite(row->printed) ? fabs(row->printed) : fabs(row->thesis);
  const double explains = fabs(part->explains) <= 1e-9 * scale ? 0 : part->explains;
  g_autofree char *text = thesis_share_text(row, explains);
  g_autofree char *bound = isfinite(part->bound) ? thesis_share_text(row, part->bound) : NULL;
  return g_strconcat(explains > 0 ? "+" : "", text, bound != NULL ? " of at most " : "",
                     bound != NULL ? bound : "", NULL);
}

// Owned by the caller; NULL where nothing is printed.
static char *rest_text(const SbThesisRow *row) {
  if (!isfinite(row->remains)) {
    return NULL;
  }
  g_autofree char *left = thesis_share_text(row, -row->remains);
  const bool rounding = fabs(row->remains) <= row->rounding + 1e-12 * fabs(row->printed);
  return g_strdup_printf("remains %s", rounding ? "rounding" : left);
}

// "text (shown by COMMAND): +3 nm".
static void put_thesis_parts(GString *out, const SbThesisRow *row, const GArray *parts) {
  for (guint i = 0; i < parts->len; i++) {
    const SbThesisPart *part = &g_array_index(parts, SbThesisPart, i);
    g_autofree char *by = part_text(row, part);
    g_string_append_printf(out, "%s%s (%s): %s", out->len > 0 ? "; " : "", part->text,
                           part->shown_by, by);
  }
}

// Returns the reasons of a row as one sentence, with the part of the difference that each explains
// and what remains; NULL: it has no reasons.
static char *reason_text(const SbThesisRow *row) {
  if (row->reasons->len == 0) {
    return NULL;
  }
  GString *out = g_string_new(NULL);
  put_thesis_parts(out, row, row->reasons);
  g_autofree char *rest = rest_text(row);
  if (rest != NULL) {
    g_string_append_printf(out, "; %s", rest);
  }
  return g_string_free(out, FALSE);
}

// Of the difference to the consistent set; NULL: none. Owned by the caller.
static char *model_reason(const SbThesisRow *row) {
  if (row->models->len == 0) {
    return NULL;
  }
  GString *out = g_string_new(NULL);
  put_thesis_parts(out, row, row->models);
  return g_string_free(out, FALSE);
}

// Place of a part in the list, from 1; 0: it is not there.
static guint thesis_place_of(const GPtrArray *reasons, const SbThesisPart *part) {
  g_autofree char *text = g_strdup_printf("%s (%s)", part->text, part->shown_by);
  for (guint i = 0; i < reasons->len; i++) {
    if (strcmp(reasons->pdata[i], text) == 0) {
      return i + 1;
    }
  }
  return 0;
}

// Returns all reasons of an item, each once: those of its rows, then those of the consistent set.
// Elements are char *, "TEXT (COMMAND)".
static GPtrArray *all_reasons(const SbThesisItem *item) {
  GPtrArray *out = g_ptr_array_new_with_free_func(g_free);
  for (int models = 0; models < 2; models++) {
    for (guint i = 0; i < item->rows->len; i++) {
      const SbThesisRow *row = item->rows->pdata[i];
      const GArray *parts = models != 0 ? row->models : row->reasons;
      for (guint k = 0; k < parts->len; k++) {
        const SbThesisPart *part = &g_array_index(parts, SbThesisPart, k);
        if (thesis_place_of(out, part) == 0) {
          g_ptr_array_add(out, g_strdup_printf("%s (%s)", part->text, part->shown_by));
        }
      }
    }
  }
  return out;
}

// Returns the state of a row in terms of the numbers (from 1) of `reasons`: "agrees", or "1: +3 nm,
// 2: -1 nm; remains 0.1 nm". `models`: the steps to the consistent set instead, "" without any.
static char *standing_text(const SbThesisRow *row, const GPtrArray *reasons, bool models) {
  GString *out = g_string_new(NULL);
  const GArray *parts = models ? row->models : row->reasons;
  for (guint i = 0; i < parts->len; i++) {
    const SbThesisPart *part = &g_array_index(parts, SbThesisPart, i);
    g_autofree char *by = part_text(row, part);
    g_string_append_printf(out, "%s%u: %s", i > 0 ? ", " : "", thesis_place_of(reasons, part), by);
  }
  g_autofree char *rest = parts->len > 0 && !models ? rest_text(row) : NULL;
  if (rest != NULL) {
    g_string_append_printf(out, "; %s", rest);
  }
  if (!models && parts->len == 0) {
    g_string_append(out, sb_thesis_verdict_name(row->verdict));
  }
  const char *const more[] = {row->fault, row->no_thesis};
  for (size_t i = 0; i < G_N_ELEMENTS(more) && !models; i++) {
    g_string_append_printf(out, "%s%s", more[i] != NULL ? "; " : "",
                           more[i] != NULL ? more[i] : "");
  }
  return g_string_free(out, FALSE);
}

// ---- The table ----

// In per cent of the printed value, or with a unit where that is nothing.
static char *difference_text(const SbThesisRow *row) {
  char digits[SB_NUMBER_SIZE];
  if (isfinite(row->difference) && row->printed != 0) {
    const double share = row->difference / fabs(row->printed);
    return g_strdup_printf("%s %%",
                           sb_number_round(digits, fabs(share) > 1e-9 ? 100 * share : 0, 2));
  }
  return row_text(row, row->difference);
}

static const SbTableColumn columns[] = {
    {"label", "  %-*s", "", "", 0},
    {"printed", " %14s", "printed", "printed", 0},
    {"thesis_model", " %14s", "thesis' model", "thesis' model", 0},
    {"consistent", " %14s", "consistent", "consistent", 0},
    {.key = "unit"},
    {.key = "difference", .label = "difference"},
    {.key = "remains"},
    {.key = "verdict"},
    {.key = "reason", .layout = "  %s", .label = "reason"},
    {.key = "model", .label = "to the consistent"},
};

// Returns the rows of an item, for people with the numbers of `reasons` (all_reasons()).
static SbTable *make_table(const SbThesisItem *item, const GPtrArray *reasons) {
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (guint i = 0; i < item->rows->len; i++) {
    const SbThesisRow *row = item->rows->pdata[i];
    const char *si = row->si, *unit = row->shown;
    g_autofree char *reason = reason_text(row), *numbered = standing_text(row, reasons, false);
    g_autofree char *model = model_reason(row), *steps = standing_text(row, reasons, true);
    g_autofree char *difference = difference_text(row);
    sb_table_add(table,
                 SB_CELLS(sb_cell_text(row->label), sb_cell_quantity(row->printed, si, unit, 5),
                          sb_cell_quantity(row->thesis, si, unit, 5),
                          sb_cell_quantity(row->consistent, si, unit, 5), sb_cell_text(si),
                          sb_cell_number_as(row->difference, difference),
                          sb_cell_number(row->remains),
                          sb_cell_text(sb_thesis_verdict_name(row->verdict)),
                          sb_cell_text_as(reason, numbered), sb_cell_text_as(model, steps)));
    if (row->verdict == SB_THESIS_FAILS) {
      sb_table_mark(table, SB_TABLE_WRONG);
    }
  }
  return table;
}

char *sb_thesis_table(const SbThesisItem *item) {
  g_autoptr(GPtrArray) reasons = all_reasons(item);
  g_autoptr(SbTable) table = make_table(item, reasons);
  g_autofree char *rows = sb_table_text(table);
  GString *out = g_string_new(NULL);
  g_string_append_printf(out, "%s\n%s", item->title, rows);
  for (guint i = 0; i < reasons->len; i++) {
    g_string_append_printf(out, "  %u. %s\n", i + 1, (const char *)reasons->pdata[i]);
  }
  for (guint i = 0; i < item->notes->len; i++) {
    g_string_append_printf(out, "  %s\n", (const char *)item->notes->pdata[i]);
  }
  return g_string_free(out, FALSE);
}

void sb_csv_thesis(FILE *stream, const SbThesisItem *item) {
  g_autoptr(GPtrArray) reasons = all_reasons(item);
  g_autoptr(SbTable) table = make_table(item, reasons);
  sb_table_csv(stream, table);
}

// ---- Introduction ----

// The row of an item; NULL: there is none.
static const SbThesisRow *find_row(SbThesisItem *const *items, size_t count, const char *name,
                                   const char *label) {
  for (size_t i = 0; i < count; i++) {
    for (guint k = 0; strcmp(items[i]->name, name) == 0 && k < items[i]->rows->len; k++) {
      const SbThesisRow *row = items[i]->rows->pdata[k];
      if (strcmp(row->label, label) == 0) {
        return row;
      }
    }
  }
  return NULL;
}

// "printed", "thesis", "consistent" or "ratio", printed over the thesis' model. Owned by the
// caller.
static char *thesis_value_text(const SbThesisRow *row, const char *what) {
  char digits[SB_NUMBER_SIZE];
  if (strcmp(what, "ratio") == 0) {
    return g_strdup(sb_number_round(digits, row->printed / row->thesis, 3));
  }
  const double value = strcmp(what, "printed") == 0      ? row->printed
                       : strcmp(what, "consistent") == 0 ? row->consistent
                                                         : row->thesis;
  return row_text(row, value);
}

char *sb_thesis_introduction(const char *text, SbThesisItem *const *items, size_t count) {
  GString *out = g_string_new(NULL);
  for (const char *c = text; *c != '\0'; c++) {
    const char *close = *c == '{' ? strchr(c, '}') : NULL;
    if (close == NULL) {
      g_string_append_c(out, *c);
      continue;
    }
    g_autofree char *inside = g_strndup(c + 1, (gsize)(close - c - 1));
    g_auto(GStrv) part = g_strsplit(inside, "|", 3);
    const bool whole = g_strv_length(part) == 3;
    const SbThesisRow *row =
        whole ? find_row(items, count, g_strstrip(part[0]), g_strstrip(part[1])) : NULL;
    g_autofree char *value = row != NULL ? thesis_value_text(row, g_strstrip(part[2])) : NULL;
    g_string_append(out, value != NULL ? value : "?");
    c = close;
  }
  return g_string_free(out, FALSE);
}

// ---- JSON ----

static void put_json_parts(SbJson *json, const char *key, const GArray *parts) {
  sb_json_array(json, key);
  for (guint i = 0; i < parts->len; i++) {
    const SbThesisPart *part = &g_array_index(parts, SbThesisPart, i);
    sb_json_object(json, NULL);
    sb_json_string(json, "text", part->text);
    sb_json_string(json, "shown_by", part->shown_by);
    sb_json_number(json, "becomes", part->becomes);
    sb_json_number(json, "explains", part->explains);
    sb_json_number(json, "bound", part->bound);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
}

static void put_json_row(SbJson *json, const SbThesisRow *row) {
  g_autofree char *reason = reason_text(row);
  sb_json_object(json, NULL);
  sb_json_string(json, "label", row->label);
  sb_json_number(json, "printed", row->printed);
  sb_json_number(json, "thesis_model", row->thesis);
  sb_json_number(json, "consistent", row->consistent);
  sb_json_string(json, "unit", row->si);
  sb_json_number(json, "difference", row->difference);
  sb_json_string(json, "reason", reason);
  sb_json_number(json, "rounding", row->rounding);
  sb_json_number(json, "remains", row->remains);
  sb_json_string(json, "verdict", sb_thesis_verdict_name(row->verdict));
  sb_json_string(json, "fault", row->fault);
  put_json_parts(json, "reasons", row->reasons);
  put_json_parts(json, "models", row->models);
  sb_json_string(json, "no_thesis_model", row->no_thesis);
  sb_json_string(json, "no_consistent", row->no_consistent);
  sb_json_object_end(json);
}

void sb_json_thesis(SbJson *json, const SbThesisItem *item) {
  sb_json_object(json, NULL);
  sb_json_engine(json);
  sb_json_string(json, "item", item->name);
  sb_json_string(json, "title", item->title);
  sb_json_string(json, "source", item->source);
  sb_json_array(json, "rows");
  for (guint i = 0; i < item->rows->len; i++) {
    put_json_row(json, item->rows->pdata[i]);
  }
  sb_json_array_end(json);
  if (item->chart != NULL) {
    sb_json_study_curves(json, item->chart);
  }
  sb_json_array(json, "notes");
  for (guint i = 0; i < item->notes->len; i++) {
    sb_json_string(json, NULL, item->notes->pdata[i]);
  }
  sb_json_array_end(json);
  sb_json_count(json, "fails", item->fails);
  sb_json_object_end(json);
}

// ---- Pages ----

static const char style[] =
    "body{font:15px/1.5 sans-serif;margin:2em auto;max-width:75em;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;width:100%}td,th{border-bottom:1px solid #ccc;padding:.25em "
    ".6em;"
    "text-align:left;vertical-align:top}td.n{text-align:right;white-space:nowrap;"
    "font-variant-numeric:tabular-nums}h2{margin-top:2em;border-top:2px solid #888}"
    ".fails{background:#fdd}.source,td:nth-child(7),th:nth-child(7){color:#666;font-size:87%}img{"
    "max-width:100%}"
    "nav table{width:auto}code{font-size:92%}th{position:sticky;top:0;background:#fff}";

static void put_escaped(FILE *stream, const char *text) {
  g_autofree char *escaped = g_markup_escape_text(text != NULL ? text : "", -1);
  fputs(escaped, stream);
}

// Writes how many rows of an item have each verdict: "7 agree, 2 explained".
static void put_counts(FILE *stream, const SbThesisItem *item) {
  static const struct {
    SbThesisVerdict verdict;
    const char *words;
  } states[] = {{SB_THESIS_AGREES, "agree"},
                {SB_THESIS_EXPLAINED, "explained"},
                {SB_THESIS_BOUNDED, "within bounds"},
                {SB_THESIS_PARTLY, "partly explained"},
                {SB_THESIS_NOT_PRINTED, "not printed"},
                {SB_THESIS_NOT_COMPUTED, "not computed"},
                {SB_THESIS_FAILS, "without a reason"}};
  bool any = false;
  for (size_t i = 0; i < G_N_ELEMENTS(states); i++) {
    guint count = 0;
    for (guint k = 0; k < item->rows->len; k++) {
      count += ((SbThesisRow *)item->rows->pdata[k])->verdict == states[i].verdict;
    }
    if (count > 0) {
      fprintf(stream, "%s%u %s", any ? ", " : "", count, states[i].words);
      any = true;
    }
  }
  fputs(any                   ? ""
        : item->chart != NULL ? "curves, no numbers printed"
                              : "missing in the source",
        stream);
}

void sb_html_thesis_begin(FILE *stream, SbThesisItem *const *items, size_t count) {
  g_autofree char *identity = sb_identity_text();
  fprintf(
      stream,
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>The thesis, "
      "regenerated</title><style>%s</style></head><body id=\"top\">\n<h1>The thesis, "
      "regenerated</h1>\n"
      "<p>D. Grimble, <i>Ultra-thin film tribology of elastomeric seals in pressurised metered "
      "dose inhalers</i>, Loughborough University, 2009: its tables and figures in their order, "
      "computed by %s.</p>\n"
      "<ul><li><b>Difference</b>: ours by the thesis' model less printed; a row <b>agrees</b> "
      "where "
      "that is within the printed digits.</li>\n"
      "<li><b>Reason</b>: the number before a colon is that of a reason below the table, then "
      "follows the computed part of the difference that it explains (&ldquo;of at most&rdquo; if "
      "only a bound is known); "
      "<b>remains</b> is the difference that no reason explains. Each reason names the command or "
      "the test that shows it.</li>\n"
      "<li><b>To the consistent</b>: in grey, the difference between the consistent set and the "
      "thesis' model (<code>models.set</code>).</li></ul>\n"
      "<nav><table><tr><th>Table or figure</th><th>rows</th></tr>\n",
      style, identity);
  for (size_t i = 0; i < count; i++) {
    fprintf(stream, "<tr%s><td><a href=\"#%s\">", items[i]->fails > 0 ? " class=\"fails\"" : "",
            items[i]->name);
    put_escaped(stream, items[i]->title);
    fputs("</a></td><td>", stream);
    put_counts(stream, items[i]);
    fputs("</td></tr>\n", stream);
  }
  fputs("</table></nav>\n", stream);
}

void sb_html_thesis_end(FILE *stream) {
  fputs("</body></html>\n", stream);
}

// "TEXT (COMMAND)", the command as such.
static void put_html_reason(FILE *stream, const char *reason) {
  const char *open = strstr(reason, "(sealbench "), *test = strstr(reason, "(meson test ");
  open = open != NULL ? open : test;
  const size_t length = open != NULL ? (size_t)(open - reason) : strlen(reason);
  g_autofree char *text = g_strndup(reason, length);
  fputs("<li>", stream);
  put_escaped(stream, text);
  if (open != NULL) {
    g_autofree char *command = g_strndup(open + 1, strlen(open) - 2);
    fputs("<br><code>", stream);
    put_escaped(stream, command);
    fputs("</code>", stream);
  }
  fputs("</li>\n", stream);
}

// Lines of a comment, each on its own.
static void put_html_lines(FILE *stream, const char *text) {
  g_auto(GStrv) lines = g_strsplit(text, "\n", -1);
  for (char **line = lines; *line != NULL; line++) {
    fputs(line == lines ? "" : "<br>", stream);
    put_escaped(stream, *line);
  }
}

void sb_html_thesis(FILE *stream, const SbThesisItem *item, const char *picture) {
  fprintf(stream, "<h2 id=\"%s\">", item->name);
  put_escaped(stream, item->title);
  fputs("</h2>\n", stream);
  if (picture != NULL) {
    fprintf(stream, "<img src=\"%s\" alt=\"", picture);
    put_escaped(stream, item->title);
    fputs("\">\n", stream);
  }
  g_autoptr(GPtrArray) reasons = all_reasons(item);
  if (item->rows->len > 0) {
    g_autoptr(SbTable) table = make_table(item, reasons);
    g_autofree char *rows = sb_table_html(table);
    fprintf(stream, "%s<ol>\n", rows);
    for (guint i = 0; i < reasons->len; i++) {
      put_html_reason(stream, reasons->pdata[i]);
    }
    fputs("</ol>\n", stream);
  }
  for (guint i = 0; i < item->notes->len; i++) {
    fputs("<p>", stream);
    put_escaped(stream, item->notes->pdata[i]);
    fputs("</p>\n", stream);
  }
  fprintf(stream, "<p class=\"source\"><code>sealbench thesis %s</code>", item->name);
  fputs("<br>", stream);
  put_html_lines(stream, item->source != NULL ? item->source : "Nothing is printed in numbers.");
  fputs("</p>\n<p class=\"source\"><a href=\"#top\">All tables and figures</a></p>\n", stream);
}

void sb_markdown_thesis(FILE *stream, const SbThesisItem *item) {
  g_autoptr(GPtrArray) reasons = all_reasons(item);
  fprintf(stream, "### %s\n\n`sealbench thesis %s`\n\n", item->title, item->name);
  if (item->rows->len > 0) {
    g_autoptr(SbTable) table = make_table(item, reasons);
    g_autofree char *rows = sb_table_markdown(table);
    fprintf(stream, "%s\n", rows);
  }
  for (guint i = 0; i < reasons->len; i++) {
    fprintf(stream, "%u. %s\n", i + 1, (const char *)reasons->pdata[i]);
  }
  fputs(reasons->len > 0 ? "\n" : "", stream);
  for (guint i = 0; i < item->notes->len; i++) {
    fprintf(stream, "%s\n\n", (const char *)item->notes->pdata[i]);
  }
}

// ---- The chart ----

static void draw_thesis(cairo_t *cr, double width, double height, void *user) {
  const SbThesisItem *item = user;
  const SbTheme *theme = sb_theme(false);
  const SbColor ground = theme->role[SB_ROLE_BACKGROUND];
  cairo_set_source_rgb(cr, ground.r, ground.g, ground.b);
  cairo_paint(cr);
  sb_study_draw(cr, (SbRect){16, 16, width - 32, height - 32}, theme, item->chart);
}

bool sb_thesis_still(FILE *stream, const SbThesisItem *item, const char *ending, GError **error) {
  SbStill still = {.width = item->chart->panel_count > 1 ? 1280 : 800,
                   .height = item->chart->panel_count > 2 ? 800 : 440,
                   .title = item->title,
                   .draw = draw_thesis,
                   .user = (void *)item};
  return sb_still_put(stream, &still, ending, error);
}

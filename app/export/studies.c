// Pages and tables of studies.
#include "app/export/studies.h"

#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/chart/page.h"
#include "app/chart/propellants.h"
#include "app/chart/study.h"
#include "app/export/still.h"
#include "app/table/table.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// ---- page ----

// The swap page's least height; a page of less has no table below it.
#define SWAP 720.0

// Sets the size that the page is designed for [logical pixels]: wide enough for the table, high
// enough for panels and table.
static void page_size(double *width, double *height, const SbStudy *study) {
  if (study->kind == SB_STUDY_PROPELLANTS) {
    *width = 1600;
    *height = ceil(SB_PAGE_HEADER + SWAP + 40 + 16 + sb_study_table_height(study) + SB_PAGE_FOOTER);
    return;
  }
  *width = study->column_count > 6 || study->panel_count > 2 ? 1600 : 1280;
  double charts = study->panel_count == 0 ? 0 : study->panel_count > 3 ? 640 : 400;
  double table = sb_study_table_height(study);
  double notes = 16.0 * (double)(study->note_count + 1) + 14;
  *height = fmax(ceil(SB_PAGE_HEADER + charts + 16 + table + notes + SB_PAGE_FOOTER + 8), 480);
}

static void errors_text(char *out, size_t size, const SbStudy *study) {
  if (study->error > 1e-9) { // below it is rounding
    char digits[SB_FORMAT_MAX];
    g_snprintf(
        out, size,
        _("at most %s\xc2\xa0%% of a film or of the largest load solved  (discretisation, not "
          "the choice of model)"),
        sb_format_digits(digits, 100 * study->error, 2));
  } else {
    g_strlcpy(out, _("closed forms: rounding only  (not the choice of model)"), size);
  }
}

static void draw_swap(cairo_t *cr, SbRect body, const SbTheme *theme, const SbStudy *study,
                      const SbModel *model) {
  const double table = sb_study_table_height(study);
  if (body.height >= SWAP + 16 + table) {
    body.height -= 16 + table;
    SbCanvas canvas;
    sb_canvas_init(&canvas, cr, theme);
    sb_study_table_draw(&canvas, (SbRect){body.x, body.y + body.height + 16, body.width, table},
                        study);
    sb_canvas_finish(&canvas);
  }
  const SbPropellantsLook look = sb_propellants_look(model);
  sb_propellants_draw(cr, body, theme, study, model, &look);
}

void sb_study_page_draw(cairo_t *cr, SbRect rect, const SbStudy *study, const SbStudyPage *page) {
  const SbTheme *theme = sb_theme(page->dark);
  double width, height;
  page_size(&width, &height, study);
  SbPage frame = sb_page_begin(cr, rect, width, height, theme);

  // The header and its state are those of every page; the title is the study's and the scene's.
  const char *name = sb_study_title(study->kind);
  const char *scene = page->title != NULL && strcmp(page->title, name) != 0 ? page->title : "";
  g_autofree char *title = g_strdup_printf("%s%s%s", sb_translation(name),
                                           scene[0] != '\0' ? "  \xc2\xb7  " : "", scene);
  SbChartData data = {.title = title, .subtitle = page->subtitle, .stale = page->stale};
  data.run.model = page->model;
  data.run.state = SB_CHART_DONE;
  data.failure = study->complete ? NULL : _("incomplete: a solver did not converge at every point");
  sb_page_header_draw(cr, frame.whole, theme, &data, SB_CHART_WHOLE);
  if (study->kind == SB_STUDY_PROPELLANTS) {
    draw_swap(cr, frame.body, theme, study, page->model);
  } else {
    sb_study_draw(cr, frame.body, theme, study);
  }

  char errors[192], version[64];
  errors_text(errors, sizeof errors, study);
  g_snprintf(version, sizeof version, "Sealbench %s", sb_version());
  if (page->hash != NULL && page->hash[0] != '\0') {
    size_t used = strlen(version);
    g_snprintf(version + used, sizeof version - used, _("  \xc2\xb7  scene %.8s"), page->hash);
  }
  SbPageFoot foot = {study->models, errors, version, &study->warnings};
  sb_page_foot_draw(cr, frame.whole, theme, &foot);
  cairo_restore(cr);
}

typedef struct {
  const SbStudy *study;
  const SbStudyPage *page;
} Drawing;

static void draw_study_picture(cairo_t *cr, double width, double height, void *user) {
  const Drawing *drawing = user;
  sb_study_page_draw(cr, (SbRect){0, 0, width, height}, drawing->study, drawing->page);
}

bool sb_study_still(const SbStudy *study, const SbStudyPage *page, const char *path,
                    GError **error) {
  char errors[160];
  const locale_t paused = sb_translation_pause();
  errors_text(errors, sizeof errors, study);
  sb_translation_resume(paused);
  g_autoptr(GString) comment = g_string_new(NULL);
  g_string_append_printf(comment, "Models: %s\nError estimates: %s\nValid: %s", study->models,
                         errors, study->validity);
  if (page->stale != NULL) {
    g_string_append_printf(comment, "\nStale: %s", page->stale);
  }
  for (size_t i = 0; i < study->note_count; i++) {
    g_string_append_printf(comment, "\nNote: %s", study->note[i]);
  }
  for (size_t i = 0; i < study->warnings.count; i++) {
    g_string_append_printf(comment, "\nWarning: %s", study->warnings.item[i].text);
  }
  Drawing drawing = {study, page};
  SbStill still = {.width = page->width,
                   .height = page->height,
                   .scale = page->scale,
                   .title = sb_study_title(study->kind),
                   .scene = page->scene,
                   .hash = page->hash,
                   .comment = comment->str,
                   .ending = page->ending,
                   .draw = draw_study_picture,
                   .user = &drawing};
  if (!(still.width > 0)) {
    page_size(&still.width, &still.height, study);
  }
  return sb_still_write(&still, path, error);
}

// ---- tables ----

void sb_csv_study(FILE *stream, const SbStudy *study) {
  g_autofree char *abscissa = g_strdup_printf("%s [%s]", study->x.quantity, study->x.si);
  const SbTableColumn columns[] = {
      {.key = "panel"}, {.key = "unit"}, {.key = "series"}, {.key = abscissa}, {.key = "value"}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (size_t p = 0; p < study->panel_count; p++) {
    const SbStudyPanel *panel = &study->panel[p];
    for (size_t s = 0; s < panel->series_count; s++) {
      const SbStudySeries *series = &panel->series[s];
      for (size_t i = 0; i < series->count; i++) {
        if (isfinite(series->y[i])) {
          sb_table_add(table, SB_CELLS(sb_cell_text(panel->y.quantity), sb_cell_text(panel->y.si),
                                       sb_cell_text(series->name), sb_cell_number(series->x[i]),
                                       sb_cell_number(series->y[i])));
        }
      }
    }
  }
  sb_table_csv(stream, table);
}

void sb_csv_study_table(FILE *stream, const SbStudy *study) {
  SbTableCell cell[SB_STUDY_COLUMNS + 2] = {sb_cell_text(study->row_heading),
                                            sb_cell_text("unit of the row")};
  char heading[SB_STUDY_COLUMNS][128];
  for (size_t k = 0; k < study->column_count; k++) {
    g_snprintf(heading[k], sizeof heading[k], "%s [%s]", study->column[k].name,
               study->column[k].si);
    cell[k + 2] = sb_cell_text(heading[k]);
  }
  sb_csv_row(stream, cell, study->column_count + 2);
  for (size_t r = 0; r < study->row_count && ferror(stream) == 0; r++) {
    const SbStudyRow *row = &study->row[r];
    cell[0] = sb_cell_text(row->name);
    cell[1] = sb_cell_text(row->si);
    for (size_t k = 0; k < study->column_count; k++) {
      cell[k + 2] = sb_cell_number(row->value[k]);
    }
    sb_csv_row(stream, cell, study->column_count + 2);
  }
}

// ---- JSON ----

static void put_axis(SbJson *json, const char *key, const SbStudyAxis *axis) {
  sb_json_object(json, key);
  sb_json_string(json, "quantity", axis->quantity);
  sb_json_string(json, "unit", axis->si);
  sb_json_bool(json, "logarithmic", axis->logarithmic);
  sb_json_object_end(json);
}

static void put_panels(SbJson *json, const SbStudy *study) {
  static const char *const styles[] = {"curve", "reference", "dots"};
  sb_json_array(json, "panels");
  for (size_t p = 0; p < study->panel_count; p++) {
    const SbStudyPanel *panel = &study->panel[p];
    sb_json_object(json, NULL);
    put_axis(json, "y", &panel->y);
    sb_json_array(json, "series");
    for (size_t s = 0; s < panel->series_count; s++) {
      const SbStudySeries *series = &panel->series[s];
      sb_json_object(json, NULL);
      sb_json_string(json, "name", series->name);
      sb_json_string(json, "style", styles[series->style]);
      sb_json_numbers(json, "x", series->x, series->count);
      sb_json_numbers(json, "y", series->y, series->count);
      sb_json_object_end(json);
    }
    sb_json_array_end(json);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
}

static void put_table(SbJson *json, const SbStudy *study) {
  sb_json_object(json, "table");
  sb_json_string(json, "heading", study->row_heading);
  sb_json_array(json, "columns");
  for (size_t k = 0; k < study->column_count; k++) {
    sb_json_object(json, NULL);
    sb_json_string(json, "name", study->column[k].name);
    sb_json_string(json, "unit", study->column[k].si);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
  sb_json_array(json, "rows");
  for (size_t r = 0; r < study->row_count; r++) {
    const SbStudyRow *row = &study->row[r];
    sb_json_object(json, NULL);
    sb_json_string(json, "name", row->name);
    sb_json_string(json, "unit", row->si); // empty: the columns have units
    sb_json_numbers(json, "values", row->value, study->column_count);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
  sb_json_object_end(json);
}

void sb_json_study_curves(SbJson *json, const SbStudy *study) {
  put_axis(json, "x", &study->x);
  put_panels(json, study);
}

static bool has_gap(const double *value, size_t count) {
  for (size_t i = 0; i < count; i++) {
    if (!isfinite(value[i])) {
      return true;
    }
  }
  return false;
}

// Why a study has no value at some points: the first gap that a model left, else `otherwise`.
static const char *gap_reason(const SbStudy *study, const char *otherwise) {
  return study->missing > 0 ? study->warnings.item[study->missing - 1].text : otherwise;
}

void sb_json_study_reasons(SbJson *json, const SbStudy *study, size_t index) {
  for (size_t p = 0; p < study->panel_count; p++) {
    const SbStudyPanel *panel = &study->panel[p];
    const char *otherwise =
        panel->empty[0] != '\0' ? panel->empty : "the model has no value at these points";
    for (size_t s = 0; s < panel->series_count; s++) {
      if (has_gap(panel->series[s].y, panel->series[s].count)) {
        g_autofree char *path =
            g_strdup_printf("studies[%zu].panels[%zu].series[%zu].y", index, p, s);
        sb_json_string(json, path, gap_reason(study, otherwise));
      }
    }
  }
  for (size_t r = 0; r < study->row_count; r++) {
    if (has_gap(study->row[r].value, study->column_count)) {
      g_autofree char *path = g_strdup_printf("studies[%zu].table.rows[%zu].values", index, r);
      sb_json_string(json, path, gap_reason(study, "this row has no value in that column"));
    }
  }
  for (size_t i = 0; i < study->warnings.count; i++) {
    if (study->warnings.item[i].input == 0) {
      g_autofree char *path = g_strdup_printf("studies[%zu].warnings[%zu].parameter", index, i);
      sb_json_string(json, path, "the warning is not about one parameter");
    }
  }
}

void sb_json_study(SbJson *json, const SbStudy *study) {
  sb_json_object(json, NULL);
  sb_json_string(json, "name", sb_study_name(study->kind));
  sb_json_string(json, "title", sb_study_title(study->kind));
  sb_json_string(json, "models", study->models);
  sb_json_string(json, "validity", study->validity);
  sb_json_number(json, "error_estimate", study->error);
  sb_json_bool(json, "complete", study->complete);
  sb_json_count(json, "solves", study->solves);
  sb_json_count(json, "work", study->work);
  sb_json_study_curves(json, study);
  put_table(json, study);
  sb_json_array(json, "marks");
  for (size_t i = 0; i < study->mark_count; i++) {
    sb_json_object(json, NULL);
    sb_json_number(json, "x", study->mark[i].x);
    sb_json_string(json, "text", study->mark[i].text);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
  sb_json_array(json, "notes");
  for (size_t i = 0; i < study->note_count; i++) {
    sb_json_string(json, NULL, study->note[i]);
  }
  sb_json_array_end(json);
  sb_json_warnings(json, &study->warnings);
  sb_json_object_end(json);
}

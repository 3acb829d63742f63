// The table of a study: one heading column, then figures in the column's or the row's unit, three
// significant digits, an en dash where there is none. Headings wrap at words.
#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/chart/study.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#define TABLE_ROW 21.0
#define HEAD_LINE 15.0

enum { HEAD_LINES = 2 };

// A figure with its sign where it is a difference ("... against ...").
static void cell_text(char *out, const SbStudyColumn *column, const SbStudyRow *row, double value) {
  if (!isfinite(value)) {
    g_strlcpy(out, "\xe2\x80\x93", SB_FORMAT_MAX);
    return;
  }
  bool own = row->si[0] != '\0';
  double shown =
      sb_quantity_to_shown(value, own ? row->si : column->si, own ? row->unit : column->unit);
  double size = fabs(shown);
  if (size > 0 && (size < 1e-4 || size >= 1e6)) {
    int exponent = (int)floor(log10(size) + 1e-12);
    char mantissa[SB_FORMAT_MAX], power[SB_FORMAT_MAX];
    sb_format_digits(mantissa, shown / pow(10, exponent), column->digits);
    sb_format_power(power, exponent);
    g_snprintf(out, SB_FORMAT_MAX, "%s\xc2\xb7%s", mantissa, power);
    return;
  }
  if (column->digits == 0) {
    sb_format_fixed(out, shown, 0);
    return;
  }
  char digits[SB_FORMAT_MAX];
  sb_format_digits(digits, shown, column->digits);
  g_snprintf(out, SB_FORMAT_MAX, "%s%s", column->difference && shown > 0 ? "+" : "", digits);
}

// Breaks a heading into at most HEAD_LINES lines that fit `width`; returns their number.
static int wrap(SbCanvas *c, const char *text, const SbTextStyle *style, double width,
                char lines[HEAD_LINES][48]) {
  int count = 0;
  lines[0][0] = '\0';
  g_auto(GStrv) words = g_strsplit(text, " ", -1);
  for (int i = 0; words[i] != NULL; i++) {
    char tried[96];
    g_snprintf(tried, sizeof tried, "%s%s%s", lines[count], lines[count][0] ? " " : "", words[i]);
    bool fits = sb_canvas_text_width(c, tried, style) <= width;
    if (!fits && lines[count][0] && count + 1 < HEAD_LINES) {
      count++;
      g_strlcpy(lines[count], words[i], sizeof lines[count]);
    } else {
      g_strlcpy(lines[count], tried, sizeof lines[count]);
    }
  }
  return count + 1;
}

double sb_study_table_height(const SbStudy *study) {
  return study->row_count == 0
             ? 0
             : 14 + (HEAD_LINES + 1) * HEAD_LINE + 4 + TABLE_ROW * (double)study->row_count + 10;
}

void sb_study_table_draw(SbCanvas *c, SbRect rect, const SbStudy *study) {
  sb_canvas_panel(c, rect);
  double left = rect.x + SB_GRID_PADDING, right = rect.x + rect.width - SB_GRID_PADDING;
  SbTextStyle head = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  SbTextStyle unit = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_THIRD);
  SbTextStyle name = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  SbTextStyle value = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);

  // The first column is as wide as its longest entry, the others share the rest.
  g_autofree char *heading = sb_translation_of_case(study->row_heading);
  double first = sb_canvas_text_width(c, heading, &head);
  for (size_t r = 0; r < study->row_count; r++) {
    char label[96];
    g_autofree char *shown = sb_translation_of_case(study->row[r].name);
    g_snprintf(label, sizeof label, "%s / %s", shown, study->row[r].unit);
    first = fmax(first, sb_canvas_text_width(c, label, &name));
  }
  first = fmin(first + 16, 0.4 * (right - left));
  double each = study->column_count > 0 ? (right - left - first) / (double)study->column_count : 0;
  each = fmin(each, 150);

  double units_y = rect.y + 14 + (HEAD_LINES + 0.75) * HEAD_LINE;
  for (size_t k = 0; k < study->column_count; k++) {
    double x = left + first + each * (double)(k + 1);
    char lines[HEAD_LINES][48];
    int count = wrap(c, sb_translation(study->column[k].name), &head, each - 10, lines);
    for (int i = 0; i < count; i++) {
      sb_canvas_text(c, lines[i], &head, x, units_y - HEAD_LINE * (count - i), SB_RIGHT);
    }
    sb_canvas_text(c, study->column[k].unit, &unit, x, units_y, SB_RIGHT);
  }
  sb_canvas_text_fit(c, heading, &head, left, units_y, first - 8);
  double y = units_y + 7;
  double end = left + first + each * (double)study->column_count;
  sb_canvas_hairline(c, left, y, end, y, sb_canvas_role(c, SB_ROLE_AXIS));
  for (size_t r = 0; r < study->row_count; r++) {
    const SbStudyRow *row = &study->row[r];
    double base = y + TABLE_ROW * (double)r + 15;
    if (base > rect.y + rect.height - 4) {
      break;
    }
    g_autofree char *shown = sb_translation_of_case(row->name);
    double used = sb_canvas_text_fit(c, shown, &name, left, base, first - 8);
    if (row->unit[0] != '\0') {
      g_autofree char *text = g_strdup_printf(" / %s", row->unit);
      sb_canvas_text(c, text, &unit, left + used, base, SB_LEFT);
    }
    for (size_t k = 0; k < study->column_count; k++) {
      char text[SB_FORMAT_MAX];
      cell_text(text, &study->column[k], row, row->value[k]);
      sb_canvas_text(c, text, &value, left + first + each * (double)(k + 1), base, SB_RIGHT);
    }
    double rule = y + TABLE_ROW * (double)(r + 1);
    if (r + 1 < study->row_count) {
      sb_canvas_hairline(c, left, rule, end, rule, sb_canvas_role(c, SB_ROLE_GRID));
    }
  }
}

char *sb_study_text(const SbStudy *study) {
  GString *out = g_string_new(sb_translation(sb_study_title(study->kind)));
  g_string_append_c(out, '\n');
  if (study->row_count > 0) {
    g_autofree char *heading = sb_translation_of_case(study->row_heading);
    g_string_append(out, heading);
    for (size_t k = 0; k < study->column_count; k++) {
      const SbStudyColumn *column = &study->column[k];
      g_string_append_printf(out, "\t%s%s%s", sb_translation(column->name),
                             column->unit[0] ? " / " : "", column->unit);
    }
    g_string_append_c(out, '\n');
    for (size_t r = 0; r < study->row_count; r++) {
      const SbStudyRow *row = &study->row[r];
      g_autofree char *shown = sb_translation_of_case(row->name);
      g_string_append_printf(out, "%s%s%s", shown, row->unit[0] ? " / " : "", row->unit);
      for (size_t k = 0; k < study->column_count; k++) {
        char text[SB_FORMAT_MAX];
        cell_text(text, &study->column[k], row, row->value[k]);
        g_string_append_printf(out, "\t%s", text);
      }
      g_string_append_c(out, '\n');
    }
  }
  for (size_t i = 0; i < study->note_count; i++) {
    g_string_append_printf(out, "%s\n", sb_translation(study->note[i]));
  }
  return g_string_free(out, FALSE);
}

// The page of a scan: map, spectrum, heights, and the asperities as a table.
#include "app/export/surface.h"

#include "app/base/issue.h"
#include "app/chart/page.h"
#include "app/chart/study.h"
#include "app/chart/surface_map.h"
#include "app/export/still.h"
#include "engine/valve/sealbench.h"

#include <math.h>
#include <string.h>

enum { SURFACE_BINS = 60 };

static const double reach = 4; // of the histogram, in standard deviations

// Shares of the heights per length, beside the Gaussian's of the same deviation.
static SbStudy *heights_study(const SbSurface *surface) {
  const SbHeights *h = &surface->scan->heights;
  const double sq = surface->figures->figures.sq, width = 2 * reach * sq / SURFACE_BINS;
  SbStudy *study = g_new0(SbStudy, 1);
  double count = 0, sum = 0, bin[SURFACE_BINS] = {0};
  for (size_t i = 0; i < h->rows * h->columns; i++) {
    sum += isnan(h->z[i]) ? 0 : h->z[i];
    count += !isnan(h->z[i]);
  }
  for (size_t i = 0; i < h->rows * h->columns; i++) {
    const double at = (h->z[i] - sum / count) / width + SURFACE_BINS / 2.0;
    if (at >= 0 && at < SURFACE_BINS) {
      bin[(int)at]++;
    }
  }
  study->x = (SbStudyAxis){"height", "m", "µm", false};
  SbStudyPanel *panel = sb_study_panel(
      study, &(SbStudyAxis){"fraction of heights", "m-1", "1/µm", false}, "no heights");
  SbStudySeries *heights = sb_study_series(panel, SB_STUDY_CURVE, "heights");
  SbStudySeries *gauss = sb_study_series(panel, SB_STUDY_REFERENCE, "Gaussian of Sq");
  for (int k = 0; k < SURFACE_BINS; k++) {
    const double z = (k + 0.5 - SURFACE_BINS / 2.0) * width;
    sb_study_point(heights, z, bin[k] / (count * width));
    sb_study_point(gauss, z, exp(-z * z / (2 * sq * sq)) / (sq * sqrt(2 * M_PI)));
  }
  return study;
}

static void add_mark(SbStudy *study, double x, const char *text) {
  if (isfinite(x)) {
    SbStudyMark *mark = &study->mark[study->mark_count++];
    mark->x = x;
    g_strlcpy(mark->text, text, sizeof mark->text);
  }
}

static void add_surface_table(SbStudy *study, const SbScanFigures *figures) {
  static const char *const names[] = {"by neighbours", "by moments", "for a scene"};
  const SbAsperityFigures *columns[] = {&figures->figures.neighbours, &figures->figures.moments,
                                        &figures->scene};
  g_strlcpy(study->row_heading, "asperities", sizeof study->row_heading);
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    SbStudyColumn *column = &study->column[study->column_count++];
    *column = (SbStudyColumn){.si = "1", .digits = 4};
    g_strlcpy(column->name, names[i], sizeof column->name);
  }
  for (const SbResultRow *each = sb_surface_asperities; each->key != NULL; each++) {
    SbStudyRow *row = &study->row[study->row_count++];
    g_strlcpy(row->name, each->label, sizeof row->name);
    g_strlcpy(row->si, each->si, sizeof row->si);
    g_strlcpy(row->unit, each->shown, sizeof row->unit);
    for (size_t i = 0; i < G_N_ELEMENTS(columns); i++) {
      row->value[i] = sb_result_value(each, columns[i]);
    }
  }
}

static SbStudy *spectrum_study(const SbSurface *surface) {
  const SbHeightSpectrum *spectrum = &surface->figures->spectrum;
  const bool is_surface = surface->scan->heights.rows > 1;
  SbStudy *study = g_new0(SbStudy, 1);
  study->x = (SbStudyAxis){"wave number q", "m-1", "1/µm", true};
  const SbStudyAxis area = {"spectrum C(q)", "m4", "µm4", true};
  const SbStudyAxis line = {"spectrum C(q)", "m3", "µm3", true};
  SbStudyPanel *panel = sb_study_panel(study, is_surface ? &area : &line, "no waves");
  SbStudySeries *curve = sb_study_series(panel, SB_STUDY_CURVE, "measured");
  double most = 0;
  for (size_t i = 0; i < spectrum->count; i++) {
    most = fmax(most, spectrum->c[i]);
  }
  for (size_t i = 0; i < spectrum->count; i++) {
    // Further down the window's leakage and rounding are seen.
    if (spectrum->c[i] > 1e-9 * most) {
      sb_study_point(curve, spectrum->q[i], spectrum->c[i]);
    }
  }
  g_autofree char *hurst = g_strdup_printf("cut-off, H = %.2f", spectrum->hurst);
  add_mark(study, spectrum->roll_off, "roll-off");
  add_mark(study, spectrum->cut_off, hurst);
  add_surface_table(study, surface->figures);
  return study;
}

void sb_surface_draw(cairo_t *cr, double width, double height, const SbSurface *surface,
                     bool dark) {
  const SbScanFigures *figures = surface->figures;
  const SbTheme *theme = sb_theme(dark);
  g_autofree SbStudy *heights = heights_study(surface), *spectrum = spectrum_study(surface);
  SbPage page = sb_page_begin(cr, (SbRect){0, 0, width, height}, width, height, theme);
  g_autofree char *title = g_path_get_basename(surface->path);
  g_autofree char *shown = sb_printable(title, strlen(title));
  g_autofree char *choices = sb_surface_choices_text(surface);
  SbChartData data = {.title = shown, .subtitle = choices};
  data.run.state = SB_CHART_DONE;
  sb_page_header_draw(cr, page.whole, theme, &data, SB_CHART_WHOLE);
  const SbRect b = page.body;
  const double left = floor(0.54 * b.width), gap = 16, upper = floor(0.60 * b.height);
  sb_surface_map_draw(cr, (SbRect){b.x, b.y, left, b.height}, theme, &surface->scan->heights,
                      figures->figures.sq);
  const double x = b.x + left + gap, rest = b.width - left - gap;
  sb_study_draw(cr, (SbRect){x, b.y, rest, upper}, theme, spectrum);
  sb_study_draw(cr, (SbRect){x, b.y + upper + gap, rest, b.height - upper - gap}, theme, heights);
  char models[160], errors[160], version[64];
  g_snprintf(models, sizeof models,
             "asperities by eight neighbours and by Nayak's and McCool's closed forms");
  const SbScanScatter scatter = sb_scan_scatter(figures, sb_surface_scatter[3].value);
  if (isfinite(scatter.deviation)) {
    g_snprintf(errors, sizeof errors,
               "\xce\xb6\xce\xb2\xcf\x83 scatters by %.1f\xc2\xa0%% over %d parts",
               100 * scatter.deviation / scatter.mean, figures->part_rows * figures->part_columns);
  } else {
    g_snprintf(errors, sizeof errors, "the scan is too small to be parted");
  }
  g_snprintf(version, sizeof version, "Sealbench %s  \xc2\xb7  scan %.8s", sb_version(),
             surface->scan->sha256 != NULL ? surface->scan->sha256 : "");
  const SbPageFoot foot = {models, errors, version, &figures->warnings};
  sb_page_foot_draw(cr, page.whole, theme, &foot);
  cairo_restore(cr);
}

static void draw_surface(cairo_t *cr, double width, double height, void *user) {
  sb_surface_draw(cr, width, height, user, false);
}

bool sb_surface_still(const SbSurface *surface, const char *path, GError **error) {
  g_autofree char *choices = sb_surface_choices_text(surface);
  g_autofree char *comment =
      g_strdup_printf("Scan: %s, SHA-256 %s\nChoices: %s", surface->path,
                      surface->scan->sha256 != NULL ? surface->scan->sha256 : "-", choices);
  const SbStill still = {.width = 1440,
                         .height = 900,
                         .title = "Measured surface",
                         .comment = comment,
                         .draw = draw_surface,
                         .user = (void *)(gintptr)surface};
  return sb_still_write(&still, path, error);
}

// Pictures of a study's report: histograms, and sensitivities as tornado diagrams.
#include "app/export/report_study_private.h"

#include "app/base/figure_text.h"
#include "engine/numeric/statistics.h"

#include <math.h>
#include <string.h>

// ---- Pictures ----

static void draw_histogram(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  sb_histogram_draw(cr, rect, theme, of);
}

static void draw_tornado(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  sb_tornado_draw(cr, rect, theme, of);
}

void sb_report_study_histograms(SbReportPages *pages, const SbReportStudyParts *study) {
  const size_t count = MIN(study->answers->figures, SB_REPORT_STUDY_CHARTS);
  g_autofree SbHistogram *each = g_new0(SbHistogram, count + 1);
  g_autoptr(GPtrArray) labels = g_ptr_array_new_with_free_func(g_free);
  size_t used = 0;
  for (size_t k = 0; k < count; k++) {
    const int figure = sb_report_study_figure(study, k);
    const SbFigure *of = sb_figure(figure);
    bool any = false;
    for (size_t i = 0; i < study->answers->samples && !any; i++) {
      any = isfinite(study->answers->value[i * study->answers->figures + k]);
    }
    const SbLimit limit = sb_report_study_limit(study, figure);
    if (any && of->digits > 0) {
      g_ptr_array_add(labels, sb_figure_label(figure));
      each[used++] = (SbHistogram){.title = g_ptr_array_index(labels, labels->len - 1),
                                   .si = of->si,
                                   .unit = of->shown,
                                   .value = study->answers->value + k,
                                   .count = study->answers->samples,
                                   .stride = study->answers->figures,
                                   .low = limit.low,
                                   .high = limit.high};
    }
  }
  if (used > 0) {
    sb_report_heading(pages, "How the figures are spread", 240);
  }
  for (size_t k = 0; k < used; k += 2) {
    sb_report_pair(pages, 220, draw_histogram, &each[k], k + 1 < used ? &each[k + 1] : NULL);
  }
  if (study->answers->figures > count) {
    sb_report_text(pages, "The other figures are in the tables alone.", SB_TYPE_NOTE, 400,
                   SB_ROLE_SECOND);
  }
}

void sb_report_study_tornados(SbReportPages *pages, const SbReportStudyParts *study) {
  if (study->tornados == 0) {
    return;
  }
  sb_report_heading(pages, "Sensitivities", 200);
  for (size_t k = 0; k < study->tornados; k += 2) {
    const size_t bars = MIN(study->tornado[k].count, SB_TORNADO_MAX);
    sb_report_pair(pages, 70 + 18 * (double)bars, draw_tornado, &study->tornado[k],
                   k + 1 < study->tornados ? &study->tornado[k + 1] : NULL);
  }
}

// ---- Sensitivities ----

// Correlation of a column of values with a parameter's; NaN without scatter.
static double correlation(const SbReportStudyParts *study, size_t figure, size_t parameter) {
  const SbAnswers *answers = study->answers;
  const size_t n = study->study->vary->len;
  double count = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  if (!sb_samples_vary(answers->value + figure, answers->samples, answers->figures)) {
    return 0;
  }
  for (int pass = 0; pass < 2; pass++) {
    const double mx = pass == 1 ? sx / count : 0, my = pass == 1 ? sy / count : 0;
    for (size_t i = 0; i < answers->samples; i++) {
      const double y = answers->value[i * answers->figures + figure];
      const double x = study->of->value[i * n + parameter];
      if (!isfinite(x) || !isfinite(y)) {
      } else if (pass == 0) {
        count++;
        sx += x;
        sy += y;
      } else {
        sxx += (x - mx) * (x - mx);
        syy += (y - my) * (y - my);
        sxy += (x - mx) * (y - my);
      }
    }
  }
  return count > 2 && sxx > 0 && syy > 0 ? sxy / sqrt(sxx * syy) : NAN;
}

static void set_bar(SbTornado *of, const char *name, double value, double low, double high) {
  if (of->count < G_N_ELEMENTS(of->bar)) {
    of->bar[of->count].name = name;
    of->bar[of->count].value = value;
    of->bar[of->count].low = low;
    of->bar[of->count++].high = high;
  }
}

// Bars of one figure by what the method knows: total shares of the variance, elementary effects, or
// what a straight line over each parameter explains.
static void fill_tornado(SbTornado *out, SbReportStudyParts *study, size_t k) {
  const SbStudyFile *file = study->study;
  const SbFigure *figure = sb_figure(sb_report_study_figure(study, k));
  const size_t n = file->vary->len, samples = study->answers->samples;
  g_autofree double *column = g_new(double, samples + 1);
  for (size_t i = 0; i < samples; i++) {
    column[i] = study->answers->value[i * study->answers->figures + k];
  }
  const char *name[SB_VARY_MAX];
  for (size_t i = 0; i < n; i++) {
    g_ptr_array_add(study->names, sb_report_study_vary_label(sb_report_study_vary(study, i)));
    name[i] = g_ptr_array_index(study->names, study->names->len - 1);
  }
  out->unit = "%";
  if (file->method == SB_METHOD_SOBOL_INDICES) {
    SbIndex first[SB_VARY_MAX], total[SB_VARY_MAX];
    SbReport report = {0};
    const SbStatus status =
        sb_sobol_indices(first, total, column, samples / (n + 2), n, file->seed, &report);
    study->status = status != SB_OK ? status : study->status;
    out->note = "fraction of the variance, with interactions; line: 95 % interval";
    for (size_t i = 0; status == SB_OK && i < n; i++) {
      set_bar(out, name[i], 100 * total[i].value, 100 * total[i].low, 100 * total[i].high);
    }
  } else if (file->method == SB_METHOD_MORRIS) {
    SbElementaryEffects effect[SB_VARY_MAX];
    sb_morris_effects(effect, column, study->of->drawn->unit, samples, n);
    out->note = "mean elementary effect over the parameter's range";
    out->unit = figure->shown;
    for (size_t i = 0; i < n; i++) {
      set_bar(out, name[i], sb_quantity_to_shown(effect[i].mean, figure->si, figure->shown), NAN,
              NAN);
    }
  } else {
    out->note = "fraction of the variance by linear correlation, with its sign";
    for (size_t i = 0; i < n; i++) {
      const double r = correlation(study, k, i);
      set_bar(out, name[i], 100 * r * fabs(r), NAN, NAN);
    }
  }
}

void sb_report_study_make_tornados(SbReportStudyParts *study) {
  const SbStudyFile *file = study->study;
  const bool knows =
      file->method == SB_METHOD_SOBOL_INDICES || file->method == SB_METHOD_MORRIS ||
      ((file->method == SB_METHOD_MONTE_CARLO || file->method == SB_METHOD_SOBOL_SEQUENCE) &&
       file->root == NULL);
  study->names = g_ptr_array_new_with_free_func(g_free);
  study->tornado = g_new0(SbTornado, SB_REPORT_STUDY_CHARTS);
  for (size_t k = 0;
       knows && k < study->answers->figures && study->tornados < SB_REPORT_STUDY_CHARTS; k++) {
    SbTornado *each = &study->tornado[study->tornados];
    fill_tornado(each, study, k);
    bool any = false;
    for (size_t i = 0; i < each->count; i++) {
      any |= isfinite(each->bar[i].value) && each->bar[i].value != 0;
    }
    if (any) {
      g_ptr_array_add(study->names, sb_figure_label(sb_report_study_figure(study, k)));
      each->title = g_ptr_array_index(study->names, study->names->len - 1);
      study->tornados++;
    } else {
      *each = (SbTornado){0};
    }
  }
}

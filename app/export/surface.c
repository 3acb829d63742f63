// See surface.h.
#include "app/export/surface.h"

#include "app/base/unit.h"

#include <math.h>
#include <stddef.h>

const SbResultRow sb_surface_heights[] = {
    {"sq_m", "Sq, standard deviation", "m", "µm", offsetof(SbHeightFigures, sq), 0},
    {"sa_m", "Sa, mean magnitude", "m", "µm", offsetof(SbHeightFigures, sa), 0},
    {"ssk", "Ssk, skewness", "1", "", offsetof(SbHeightFigures, ssk), 0},
    {"sku", "Sku, kurtosis", "1", "", offsetof(SbHeightFigures, sku), 0},
    {"sdq", "Sdq, slope", "1", "", offsetof(SbHeightFigures, sdq), 0},
    {0},
};

const SbResultRow sb_surface_asperities[] = {
    {"density_per_m2", "ζ, density", "m-2", "mm-2", offsetof(SbAsperityFigures, density), 0},
    {"radius_m", "β, tip radius", "m", "µm", offsetof(SbAsperityFigures, radius), 0},
    {"sigma_m", "σ, deviation of heights", "m", "µm", offsetof(SbAsperityFigures, sigma), 0},
    {"gt_product", "ζβσ", "1", "", offsetof(SbAsperityFigures, product), 0},
    {"sigma_over_beta", "σ/β", "1", "", offsetof(SbAsperityFigures, sigma_over_beta), 0},
    {0},
};

// At the top, of summits by neighbours.
static const SbResultRow summits[] = {
    {"summit_density_per_m2", NULL, "m-2", "mm-2", offsetof(SbAsperityFigures, density), 0},
    {"summit_radius_m", NULL, "m", "µm", offsetof(SbAsperityFigures, radius), 0},
    {"summit_sigma_m", NULL, "m", "µm", offsetof(SbAsperityFigures, sigma), 0},
    {"gt_product", NULL, "1", "", offsetof(SbAsperityFigures, product), 0},
    {"sigma_over_beta", NULL, "1", "", offsetof(SbAsperityFigures, sigma_over_beta), 0},
    {0},
};

// ---- Scatter ----

static double part_sigma(const SbHeightFigures *part) {
  return part->sq;
}

static double part_density(const SbHeightFigures *part) {
  return part->moments.density;
}

static double part_radius(const SbHeightFigures *part) {
  return part->moments.radius;
}

static SbAsperityFigures part_scene(const SbHeightFigures *part) {
  return sb_asperities_of_moments(part->moment, false);
}

static double part_product(const SbHeightFigures *part) {
  return part_scene(part).product;
}

static double part_ratio(const SbHeightFigures *part) {
  return part_scene(part).sigma_over_beta;
}

static double part_summits(const SbHeightFigures *part) {
  return part->neighbours.density;
}

const SbSurfaceScatter sb_surface_scatter[] = {
    {"sigma_m", "σ, deviation of heights", "m", "µm", part_sigma},
    {"density_per_m2", "ζ, density", "m-2", "mm-2", part_density},
    {"radius_m", "β, tip radius", "m", "µm", part_radius},
    {"gt_product", "ζβσ", "1", "", part_product},
    {"sigma_over_beta", "σ/β", "1", "", part_ratio},
    {"summit_density_per_m2", "Summits by neighbours", "m-2", "mm-2", part_summits},
    {0},
};

// ---- Words ----

static void add_length(GString *text, const char *label, double length) {
  g_autofree char *value = sb_quantity_format(length, "m", "µm");
  g_string_append_printf(text, ", %s%s", label, value);
}

char *sb_surface_choices_text(const SbSurface *surface) {
  const SbHeightsChoices *choices = surface->choices;
  GString *text =
      g_string_new(choices->form == SB_FORM_NONE ? "mean" : sb_form_name(choices->form));
  g_string_append(text, " removed");
  if (choices->outliers > 0) {
    g_string_append_printf(text, ", points beyond %g robust deviations out", choices->outliers);
  } else {
    g_string_append(text, ", no outliers sought");
  }
  g_string_append(text, choices->fill ? ", missing points filled" : ", missing points left out");
  if (choices->cutoff_short > 0) {
    add_length(text, "Gaussian short cut-off ", choices->cutoff_short);
  }
  if (choices->cutoff_long > 0) {
    add_length(text, "Gaussian long cut-off ", choices->cutoff_long);
  }
  if (choices->cutoff_short == 0 && choices->cutoff_long == 0) {
    g_string_append(text, ", no cut-off");
  }
  return g_string_free(text, FALSE);
}

char **sb_surface_settings(const char **reason, const SbSurface *surface) {
  const SbAsperityFigures *scene = &surface->figures->scene;
  const struct {
    SbParamId id;
    double value;
    const char *beyond;
  } values[] = {{SB_P_SURFACE_GT_PRODUCT, scene->product, "surface.gt_product is beyond its range"},
                {SB_P_SURFACE_SIGMA, scene->sigma, "surface.sigma is beyond its range"},
                {SB_P_SURFACE_SIGMA_OVER_BETA, scene->sigma_over_beta,
                 "surface.sigma_over_beta is beyond its range"}};
  *reason = NULL;
  g_autoptr(GPtrArray) out = g_ptr_array_new_with_free_func(g_free);
  for (size_t i = 0; i < G_N_ELEMENTS(values); i++) {
    const SbParam *param = sb_param(values[i].id);
    const double value = values[i].value;
    if (!isfinite(value)) {
      *reason = "no random isotropic surface has these moments: m0 m4/m2^2 is not above 1.5";
    } else if (value < param->min || value > param->max) {
      *reason = values[i].beyond;
    } else {
      g_autofree char *text = sb_quantity_round(value, param->si, param->unit, 6);
      g_ptr_array_add(out, g_strconcat(param->key, "=", text, NULL));
    }
  }
  if (*reason != NULL) {
    return NULL;
  }
  g_ptr_array_add(out, NULL);
  g_ptr_array_set_free_func(out, NULL);
  return (char **)g_ptr_array_free(g_steal_pointer(&out), FALSE);
}

// ---- JSON ----

static void put_asperities(SbJson *json, const char *key, const SbAsperityFigures *asperities) {
  sb_json_object(json, key);
  sb_json_rows(json, sb_surface_asperities, asperities, true);
  sb_json_object_end(json);
}

static void put_moments(SbJson *json, const double moment[3]) {
  static const char *const keys[] = {"m0", "m2", "m4"};
  for (int m = 0; m < 3; m++) {
    sb_json_number(json, keys[m], moment[m]);
  }
}

static double or_nan(double length) {
  return length > 0 ? length : NAN;
}

static void put_origin(SbJson *json, const SbSurface *surface) {
  const SbScan *scan = surface->scan;
  const SbHeights *h = &scan->heights;
  const SbHeightsChoices *choices = surface->choices;
  const SbHeightsReport *done = &surface->figures->done;
  sb_json_string(json, "scan", surface->path);
  sb_json_string(json, "sha256", scan->sha256);
  sb_json_string(json, "format", scan->format);
  sb_json_string(json, "title", scan->title);
  sb_json_array(json, "notes");
  for (guint i = 0; i < scan->notes->len; i++) {
    sb_json_string(json, NULL, scan->notes->pdata[i]);
  }
  sb_json_array_end(json);
  sb_json_object(json, "grid");
  sb_json_string(json, "kind", h->rows > 1 ? "surface" : "profile");
  sb_json_count(json, "columns", h->columns);
  sb_json_count(json, "rows", h->rows);
  sb_json_number(json, "spacing_x_m", h->dx);
  sb_json_number(json, "spacing_y_m", h->rows > 1 ? h->dy : NAN);
  sb_json_count(json, "missing", done->missing);
  sb_json_count(json, "outliers", done->outliers);
  sb_json_count(json, "filled", done->filled);
  sb_json_object_end(json);
  sb_json_object(json, "choices");
  sb_json_string(json, "form", sb_form_name(choices->form));
  sb_json_number(json, "outliers", or_nan(choices->outliers));
  sb_json_string(json, "missing", choices->fill ? "fill" : "leave");
  sb_json_number(json, "cutoff_short_m", or_nan(choices->cutoff_short));
  sb_json_number(json, "cutoff_long_m", or_nan(choices->cutoff_long));
  sb_json_object_end(json);
  sb_json_number(json, "form_share", done->form_share);
  sb_json_number(json, "form_radius_m", done->form_radius);
}

static void put_spectrum(SbJson *json, const SbSurface *surface) {
  const SbHeightSpectrum *spectrum = &surface->figures->spectrum;
  const bool is_surface = surface->scan->heights.rows > 1;
  sb_json_object(json, "psd");
  sb_json_numbers(json, "wave_number_rad_per_m", spectrum->q, spectrum->count);
  // Of a profile along x alone.
  sb_json_numbers(json, is_surface ? "density_m4" : "density_m3", spectrum->c, spectrum->count);
  sb_json_number(json, "hurst", spectrum->hurst);
  sb_json_number(json, "roll_off_rad_per_m", spectrum->roll_off);
  sb_json_number(json, "cut_off_rad_per_m", spectrum->cut_off);
  sb_json_string(json, "window", "hann");
  sb_json_count(json, "columns", spectrum->columns);
  sb_json_count(json, "rows", spectrum->rows);
  sb_json_object(json, "moments");
  put_moments(json, spectrum->moment);
  sb_json_object_end(json);
  sb_json_object_end(json);
}

static void put_parts(SbJson *json, const SbScanFigures *figures) {
  sb_json_object(json, "scatter");
  sb_json_count(json, "part_rows", (guint64)figures->part_rows);
  sb_json_count(json, "part_columns", (guint64)figures->part_columns);
  for (const SbSurfaceScatter *row = sb_surface_scatter; row->key != NULL; row++) {
    const SbScanScatter scatter = sb_scan_scatter(figures, row->value);
    double values[SB_SCAN_PARTS_MAX];
    const int count = figures->part_rows * figures->part_columns;
    for (int k = 0; k < count; k++) {
      values[k] = row->value(&figures->part[k]);
    }
    sb_json_object(json, row->key);
    sb_json_number(json, "mean", scatter.mean);
    sb_json_number(json, "standard_deviation", scatter.deviation);
    sb_json_numbers(json, "parts", values, (size_t)count);
    sb_json_object_end(json);
  }
  sb_json_object_end(json);
}

static void put_cutoffs(SbJson *json, const SbScanFigures *figures) {
  sb_json_array(json, "cutoffs");
  for (int i = 0; i < figures->cutoff_count; i++) {
    const SbScanCutoff *row = &figures->cutoff[i];
    sb_json_object(json, NULL);
    sb_json_number(json, "cutoff_short_m", or_nan(row->cutoff_short));
    sb_json_number(json, "cutoff_long_m", or_nan(row->cutoff_long));
    put_moments(json, row->moment);
    sb_json_rows(json, sb_surface_asperities, &row->asperities, true);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
}

static void put_surface_reasons(SbJson *json, const SbSurface *surface, const char *scene) {
  const SbScanFigures *figures = surface->figures;
  const bool is_surface = surface->scan->heights.rows > 1;
  sb_json_object(json, "reasons");
  for (const SbResultRow *row = summits; row->key != NULL; row++) {
    if (isnan(sb_result_value(row, &figures->figures.neighbours))) {
      sb_json_string(json, row->key,
                     is_surface ? "fewer than two summits"
                                : "a profile has no summits; asperities.moments treats it as a cut "
                                  "through an isotropic surface");
    }
  }
  if (!(figures->figures.breadth > 1.5)) {
    sb_json_string(json, "asperities.moments", "m0 m4/m2^2 is not above 1.5");
  }
  if (figures->spectrum.reason != NULL) {
    sb_json_string(json, "psd.hurst", figures->spectrum.reason);
  }
  if (figures->spectrum.roll_off_reason != NULL) {
    sb_json_string(json, "psd.roll_off_rad_per_m", figures->spectrum.roll_off_reason);
  }
  if (isnan(figures->spectrum.cut_off)) {
    sb_json_string(json, "psd.cut_off_rad_per_m",
                   figures->spectrum.reason != NULL ? figures->spectrum.reason
                                                    : "the points end before the slope does");
  }
  if (surface->choices->form != SB_FORM_CYLINDER) {
    sb_json_string(json, "form_radius_m", "no cylinder was fitted");
  }
  if (!is_surface) {
    sb_json_string(json, "grid.spacing_y_m", "a profile");
  }
  if (figures->part_rows == 0) {
    sb_json_string(json, "scatter", "fewer than 128 points on a side are not parted");
  }
  if (scene != NULL) {
    sb_json_string(json, "settings", scene);
  }
  sb_json_object_end(json);
}

char *sb_surface_json(const SbSurface *surface) {
  const SbScanFigures *figures = surface->figures;
  const char *reason = NULL;
  g_auto(GStrv) settings = sb_surface_settings(&reason, surface);
  SbJson json;
  sb_json_document(&json);
  put_origin(&json, surface);
  sb_json_rows(&json, sb_surface_heights, &figures->figures, true);
  sb_json_rows(&json, summits, &figures->figures.neighbours, true);
  sb_json_object(&json, "moments");
  put_moments(&json, figures->figures.moment);
  sb_json_object_end(&json);
  sb_json_number(&json, "breadth", figures->figures.breadth);
  put_spectrum(&json, surface);
  sb_json_object(&json, "asperities");
  put_asperities(&json, "neighbours", &figures->figures.neighbours);
  put_asperities(&json, "moments", &figures->figures.moments);
  put_asperities(&json, "scene", &figures->scene);
  sb_json_object_end(&json);
  put_parts(&json, figures);
  put_cutoffs(&json, figures);
  sb_json_array(&json, "settings");
  for (char **each = settings; each != NULL && *each != NULL; each++) {
    sb_json_string(&json, NULL, *each);
  }
  sb_json_array_end(&json);
  sb_json_warnings(&json, &figures->warnings);
  put_surface_reasons(&json, surface, reason);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

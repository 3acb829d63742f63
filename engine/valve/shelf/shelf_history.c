// The shelf over time: temperatures, the ring's ageing, and the sums of what passes.
//
// Rates are tabled over the temperature at equal steps of 1/T, their logarithms straight between
// them (permeation is nearly so), for each of the times at which the ring is solved, and straight
// in the root of time between those.
#include "engine/fluid/fluid.h"
#include "engine/valve/model/model.h"
#include "engine/valve/shelf/shelf.h"

#include <math.h>
#include <stdlib.h>

enum { AGES = 5, TEMPERATURES = 9, QUANTITIES = 4, HOURS = 24, DAYS = 4 };
static const double AGE[AGES] = {0, 1.0 / 36, 1.0 / 9, 1.0 / 3, 1};
static const double DAY = 86400, YEAR = 365 * 86400.0;

// Returns the temperature [K] of the history (shelf.history) at `time` [s] >= 0 from its start. A
// file repeats after its last row.
static double temperature_at(const SbModel *model, double time) {
  const SbShelfInput *in = &model->shelf;
  if (in->history == SB_SHELF_WAREHOUSE) {
    return model->temperature + in->season * sin(2 * M_PI * time / YEAR) +
           in->day * sin(2 * M_PI * time / DAY);
  }
  const SbModelSeries *series = model->data != NULL ? &model->data->shelf : NULL;
  if (in->history != SB_SHELF_FILE || series == NULL || series->count == 0) {
    return model->temperature;
  }
  // The file repeats until the time is over.
  const size_t n = series->count;
  const double span = series->time[n - 1];
  const double at = span > 0 ? fmod(time, span) : 0;
  size_t low = 0, high = n - 1;
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    *(series->time[middle] <= at ? &low : &high) = middle;
  }
  const double step = series->time[high] - series->time[low];
  const double share = step > 0 ? (at - series->time[low]) / step : 0;
  return series->value[low] + share * (series->value[high] - series->value[low]);
}

// Sets *low and *high to the lowest and the highest temperature of the history [K]; both are the
// canister's temperature if it is constant.
static void temperature_range(double *low, double *high, const SbModel *model) {
  const SbShelfInput *in = &model->shelf;
  *low = *high = model->temperature;
  if (in->history == SB_SHELF_WAREHOUSE) {
    *low -= in->season + in->day;
    *high += in->season + in->day;
  } else if (in->history == SB_SHELF_FILE && model->data != NULL && model->data->shelf.count > 0) {
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < model->data->shelf.count; i++) {
      *low = fmin(*low, model->data->shelf.value[i]);
      *high = fmax(*high, model->data->shelf.value[i]);
    }
  }
}

// Tables of what passes.
typedef struct {
  int ages, temperatures;
  double low, high;                            // 1/T of the first and the last
  double rate[QUANTITIES][AGES][TEMPERATURES]; // seal, contact, plastic; water
  SbShelfRest rest[AGES];
} Tables;

static void take(Tables *t, int age, int temperature, const SbShelfRates *rates) {
  t->rate[0][age][temperature] = rates->permeation;
  t->rate[1][age][temperature] = rates->interface;
  t->rate[2][age][temperature] = rates->plastic;
  t->rate[3][age][temperature] = rates->moisture + rates->plastic_moisture;
}

static double between(double a, double b, double share) {
  return a > 0 && b > 0 ? a * pow(b / a, share) : a + share * (b - a);
}

// A rate at an age of 0 .. 1 of the time and a temperature.
static double rate_at(const Tables *t, int quantity, double age, double temperature) {
  int a = 0, k = 0;
  double older = 0, warmer = 0;
  if (t->ages > 1) {
    while (a < t->ages - 2 && age > AGE[a + 1]) {
      a++;
    }
    older = (sqrt(age) - sqrt(AGE[a])) / (sqrt(AGE[a + 1]) - sqrt(AGE[a]));
  }
  if (t->temperatures > 1) {
    const double place = (1 / temperature - t->low) / (t->high - t->low) * (t->temperatures - 1);
    k = (int)fmin(fmax(place, 0), t->temperatures - 2);
    warmer = place - k;
  }
  double value[2] = {0, 0};
  for (int i = 0; i < (t->ages > 1 ? 2 : 1); i++) {
    const double *row = t->rate[quantity][a + i];
    value[i] = t->temperatures > 1 ? between(row[k], row[k + 1], warmer) : row[0];
  }
  return t->ages > 1 ? value[0] + older * (value[1] - value[0]) : value[0];
}

// Mean kinetic temperature of the history.
static double kinetic(const SbModel *model) {
  enum { SAMPLES = 8766 };
  const double energy = 83144.0 / 8.314462618;
  double sum = 0;
  if (model->shelf.history == SB_SHELF_CONSTANT) {
    return model->temperature;
  }
  for (int i = 0; i < SAMPLES; i++) {
    sum += exp(-energy / temperature_at(model, model->shelf.time * (i + 0.5) / SAMPLES));
  }
  return energy / -log(sum / SAMPLES);
}

// The model at another temperature of use, after another time of storage.
static SbStatus derive(SbModel *out, const SbModel *model, double temperature, double age,
                       double stored_at, SbReport *report) {
  const SbOverride overrides[] = {
      {SB_P_CANISTER_TEMPERATURE, temperature},
      {SB_P_STORAGE_TIME, model->storage_time + age * model->shelf.time},
      {SB_P_STORAGE_TEMPERATURE, stored_at},
  };
  return sb_model_override(out, model, overrides, sizeof overrides / sizeof overrides[0], report);
}

static bool ages(const SbSealModel *a, const SbSealModel *b) {
  return a->modulus != b->modulus || a->section_diameter != b->section_diameter ||
         a->inner_diameter != b->inner_diameter;
}

static SbStatus fill_tables(Tables *t, SbModel *work, const SbModel *model, int seal,
                            const SbShelfRest *now, bool (*cancel)(void *), void *data,
                            SbReport *report) {
  double low, high;
  const double stored_at = kinetic(model);
  temperature_range(&low, &high, model);
  t->temperatures = high > low ? TEMPERATURES : 1;
  t->low = 1 / low;
  t->high = 1 / high;
  SbStatus status = derive(work, model, model->temperature, 1, stored_at, report);
  t->ages = status == SB_OK && ages(&work->seal[seal], &model->seal[seal]) ? AGES : 1;
  for (int a = 0; status == SB_OK && a < t->ages; a++) {
    status = derive(work, model, model->temperature, AGE[a], stored_at, report);
    t->rest[a] = *now;
    if (status == SB_OK && a > 0) {
      status = sb_shelf_rest(&t->rest[a], work, seal, cancel, data, report);
    }
    for (int k = 0; status == SB_OK && k < t->temperatures; k++) {
      const double share = t->temperatures > 1 ? k / (TEMPERATURES - 1.0) : 0;
      const double temperature = 1 / (t->low + share * (t->high - t->low));
      SbShelfRates rates;
      status = derive(work, model, temperature, AGE[a], stored_at, report);
      if (status == SB_OK) {
        sb_shelf_rates(&rates, work, &t->rest[a]);
        take(t, a, k, &rates);
      }
    }
  }
  return status;
}

// Adds what passes between two times; returns the mean temperature.
static double add_interval(double sum[QUANTITIES], const SbModel *model, const Tables *t,
                           double from, double to) {
  const int samples = t->temperatures > 1 ? HOURS * DAYS : 1;
  double mean = 0;
  for (int i = 0; i < samples; i++) {
    // Hours of days that are evenly spaced in the interval, whatever its length.
    double time = from + (to - from) * (i + 0.5) / samples;
    if (samples > 1 && model->shelf.history == SB_SHELF_WAREHOUSE) {
      time = floor(time / DAY) * DAY + DAY * (i % HOURS + 0.5) / HOURS;
    }
    const double temperature = temperature_at(model, time);
    mean += temperature / samples;
    for (int q = 0; q < QUANTITIES; q++) {
      sum[q] +=
          rate_at(t, q, 0.5 * (from + to) / model->shelf.time, temperature) * (to - from) / samples;
    }
  }
  return mean;
}

// Returns the number of complete doses in a remaining mass; 0 without a metered volume.
static double doses_of(const SbModel *model, double mass) {
  SbDoseSupply supply = model->supply;
  supply.liquid = fmax(mass, 0) / model->density;
  return (double)sb_chamber_doses(&supply);
}

static void sum_up(SbShelf *out, const SbModel *model, const Tables *t) {
  const double filled = model->supply.liquid * model->density;
  double sum[QUANTITIES] = {0, 0, 0, 0};
  for (int i = 0; i < SB_SHELF_POINTS; i++) {
    const double step = model->shelf.time / (SB_SHELF_POINTS - 1);
    out->point[i].time = step * i;
    out->point[i].temperature =
        i > 0 ? add_interval(sum, model, t, step * (i - 1), step * i) : temperature_at(model, 0);
    out->point[i].permeated = sum[0];
    out->point[i].passed = sum[1];
    out->point[i].plastic = sb_shelf_lacks_plastic(model) == NULL ? sum[2] : NAN;
    out->point[i].moisture = sum[3];
    out->point[i].doses = doses_of(model, filled - sum[0] - sum[1] - sum[2]);
  }
  out->points = SB_SHELF_POINTS;
  out->loss = sum[0] + sum[1] + sum[2];
  out->moisture = sum[3];
  // A can that has lost all of it is empty.
  out->mass_left = isnan(out->loss) ? NAN : fmax(filled - out->loss, 0);
  out->doses_left = isnan(out->loss) ? NAN : doses_of(model, out->mass_left);
}

SbStatus sb_shelf_history(SbShelf *out, const SbModel *model, int seal, const SbShelfRest *now,
                          bool (*cancel)(void *), void *data, SbReport *report) {
  SbModel *work = malloc(sizeof *work);
  Tables *tables = calloc(1, sizeof *tables);
  SbStatus status = work == NULL || tables == NULL
                        ? sb_fail(report, SB_ERROR_MEMORY, "no memory for the shelf's history")
                        : fill_tables(tables, work, model, seal, now, cancel, data, report);
  if (status == SB_OK) {
    sum_up(out, model, tables);
  }
  free(tables);
  free(work);
  return status;
}

// [leakage_test] of a study file; see study_file.h.
#include "app/document/study_file_private.h"

#include "app/base/unit.h"
#include "engine/valve/figures/figures.h"

#include <math.h>
#include <string.h>

// Quantities among the keys: unit, place, range.
static const struct {
  const char *key, *si, *shown;
  size_t offset;
  double least, most;
} leakage_quantities[] = {
#define AT(member) offsetof(SbLeakageTest, member)
    {"temperature", "K", "°C", AT(temperature), 250, 350},
    {"duration", "s", "h", AT(duration), 3600, 3.2e7},
    {"small_fill", "kg", "g", AT(small_fill), 0, 10},
    {"mean", "kg", "mg", AT(mean), 0, 10},
    {"single", "kg", "mg", AT(single), 0, 10},
    {"most", "kg", "mg", AT(most), 0, 10},
    {"mean_share", "1", "%", AT(mean_share), 0, 1},
    {"single_share", "1", "%", AT(single_share), 0, 1},
    {"most_share", "1", "%", AT(most_share), 0, 1},
    {"balance", "kg", "mg", AT(balance), 0, 1},
#undef AT
};

static const struct {
  const char *key;
  size_t offset;
  int least, most;
} counts[] = {
    {"containers", offsetof(SbLeakageTest, containers), 1, 500},
    {"more", offsetof(SbLeakageTest, more), 0, 500},
    {"beyond", offsetof(SbLeakageTest, beyond), 0, 500},
    {"beyond_all", offsetof(SbLeakageTest, beyond_all), 0, 1000},
};

static void refuse_range(SbStudyReader *reader, const SbEntry *entry, double least, double most,
                         const char *unit) {
  g_autofree char *range =
      g_strdup_printf("%g to %g%s%s", least, most, *unit != '\0' ? " " : "", unit);
  g_autofree char *text = g_strdup_printf("\"%s\" is out of range or no such number", entry->value);
  sb_study_add_issue(reader, entry, range, text);
}

void sb_study_read_leakage(SbStudyReader *reader, const SbEntry *entry) {
  SbStudyFile *study = reader->study;
  char *test = (char *)&study->leakage;
  double value = 0;
  for (size_t i = 0; i < G_N_ELEMENTS(leakage_quantities); i++) {
    if (strcmp(entry->name, leakage_quantities[i].key) == 0) {
      const bool good = sb_quantity_parse(&value, entry->value, leakage_quantities[i].si,
                                          leakage_quantities[i].shown, NULL) &&
                        value >= leakage_quantities[i].least && value <= leakage_quantities[i].most;
      if (good) {
        *(double *)(test + leakage_quantities[i].offset) = value;
      } else {
        refuse_range(reader, entry,
                     sb_quantity_to_shown(leakage_quantities[i].least, leakage_quantities[i].si,
                                          leakage_quantities[i].shown),
                     sb_quantity_to_shown(leakage_quantities[i].most, leakage_quantities[i].si,
                                          leakage_quantities[i].shown),
                     leakage_quantities[i].shown);
      }
      return;
    }
  }
  for (size_t i = 0; i < G_N_ELEMENTS(counts); i++) {
    if (strcmp(entry->name, counts[i].key) == 0) {
      if (sb_study_read_count(&value, entry->value, counts[i].least, counts[i].most)) {
        *(int *)(test + counts[i].offset) = (int)value;
      } else {
        refuse_range(reader, entry, counts[i].least, counts[i].most, "");
      }
      return;
    }
  }
  if (strcmp(entry->name, "tests") == 0) {
    if (sb_study_read_count(&value, entry->value, 10, 1e6)) {
      study->leakage_tests = (size_t)value;
    } else {
      refuse_range(reader, entry, 10, 1e6, "");
    }
  } else if (strcmp(entry->name, "edition") == 0) {
    g_strlcpy(study->leakage.edition, entry->value, sizeof study->leakage.edition);
  } else {
    sb_study_add_issue(reader, entry,
                       "edition, tests, temperature, duration, containers, more, beyond, "
                       "beyond_all, small_fill, mean, single, "
                       "most, mean_share, single_share, most_share, balance",
                       "unknown key");
  }
}

void sb_study_check_leakage(SbStudyReader *reader) {
  const SbStudyFile *study = reader->study;
  const int loss = sb_figure_find("shelf.loss_kg_per_year");
  bool has = false;
  for (guint i = 0; i < study->figures->len; i++) {
    has = has || g_array_index(study->figures, int, i) == loss;
  }
  if (!has) {
    sb_study_take_figure(study->figures, loss);
  }
  if (study->method != SB_METHOD_MONTE_CARLO) {
    sb_issues_add(reader->issues, reader->shown, 0, GROUP_STUDY ".method", "monte-carlo",
                  "a leakage test draws its cans from valves that are drawn");
  }
  const double temperature = study->base != NULL
                                 ? sb_model_value(study->base, SB_P_CANISTER_TEMPERATURE)
                                 : study->leakage.temperature;
  if (fabs(temperature - study->leakage.temperature) > 0.5) {
    sb_issues_add(reader->issues, reader->shown, 0, GROUP_LEAKAGE ".temperature", NULL,
                  "the test is at %.1f °C and the scene's canister.temperature %.1f °C",
                  study->leakage.temperature - 273.15, temperature - 273.15);
  }
}

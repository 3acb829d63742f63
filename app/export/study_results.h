// The results of a study file (many samples of a scene): a table of all samples, statistics as
// JSON and as texts. `answers` are the results of the samples of `study`, complete or not.
#pragma once

#include "app/document/study_file.h"
#include "app/study/shares.h"
#include "app/table/table.h"
#include "engine/valve/shelf/shelf.h"

#include <stdio.h>

// Returns a statistic [SI] of the samples' values of a figure (index of sb_figure()) in its display
// unit, "28.70 N"; a number for a figure that is yes or no. "-" for NaN.
char *sb_study_statistic(int figure, double value);

// Returns the number of samples that are computed, those that failed included.
size_t sb_study_done(const SbAnswers *answers);

// Returns the number of samples that are computed and failed.
size_t sb_study_failed(const SbAnswers *answers);

// Computes the probability that the leakage test of the study is passed. A sample that is open has
// an infinite loss. study->leakage_tests must be above 0, and shelf.loss_kg_per_year one of the
// figures of the study. Without a sample that has a loss the probability is NaN and SB_OK is
// returned. SB_ERROR_RANGE: fewer than ten samples or tests, or invalid rules.
SbStatus sb_study_leakage(SbLeakageOdds *out, const SbStudyFile *study, const SbAnswers *answers,
                          SbReport *report);

// Returns the contract's name of a sample's status (SbStatus or SB_ANSWER_MISSING): "ok",
// "not-converged", "infeasible", "not-computed", else "refused". Static.
const char *sb_study_status_name(uint8_t status);

// What the intervals of probabilities account for: the errors of sampling, neither those of the
// models nor those of the distributions.
#define SB_INTERVAL_COVERS "sampling alone"

// A code of a warning and the number of samples that have it.
typedef struct {
  char code[48];
  size_t count;
} SbCodeCount;

// Returns the validity warnings of all samples, sorted by code; *count is set to their number.
// Freed by g_free().
SbCodeCount *sb_study_warnings(size_t *count, const SbAnswers *answers);

// Returns the value [SI] of a parameter as a cell: of a choice its name, written to `name`; NaN:
// empty. `param` NULL: a variable of a study.
SbTableCell sb_study_cell(char name[64], const SbParam *param, double value);

// Writes comma-separated values, a row for each sample: number from 1, varied parameters [SI],
// figures [SI] (empty: none), status, codes of validity warnings separated by ";". `value`:
// [samples][study->vary->len] parameters of the samples [SI]; NaN: as in the scene. The bytes
// depend on the arguments alone; errors of writing are left in the stream (ferror()).
void sb_study_csv(FILE *stream, const SbStudyFile *study, const double *value,
                  const SbAnswers *answers);

// Returns a sentence if the study's figures of storage use a typical value of permeation that was
// not measured for this rubber. NULL: they do not, or the study varies that parameter.
char *sb_study_typical(const SbStudyFile *study, SbShelfSpecies species);

// Writes the members "study" (title), "file" (full path of the study) and "scene" (full path of its
// scene) of the open object; "-" is standard input.
void sb_json_study_files(SbJson *json, const SbStudyFile *study);

// Writes the member "missing" of the open object: the samples with status SB_OK that have no value
// of a figure, at most 100, each with its number (from 1) and reason.
void sb_study_put_missing(SbJson *json, const SbAnswers *answers);

// Writes the member "reasons" of the open object: why figures, indices and probabilities of limits
// are null or do not account for all samples, by their path in the document of sb_study_json().
// Returns SB_OK or SB_ERROR_MEMORY.
SbStatus sb_study_put_reasons(SbJson *json, const SbStudyFile *study, const SbStudyDrawn *drawn,
                              const SbAnswers *answers, SbReport *report);

// Returns the JSON document of `sealbench study`. `drawn`: the points of the method (shares.h);
// `cpus`: name and number of processors, `store`: path of the store (NULL: none), for the document.
// NULL with `report` if a statistic could not be computed.
char *sb_study_json(const SbStudyFile *study, const SbStudyDrawn *drawn, const SbAnswers *answers,
                    const char *cpus, const char *store, SbReport *report);

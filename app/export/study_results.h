// What a study's answers say: a table of all samples, statistics as JSON and for people.
#pragma once

#include "app/document/study_file.h"
#include "app/export/json.h"
#include "app/study/shares.h"

#include <stdio.h>

// Samples with an answer, and those of them that failed.
size_t sb_study_done(const SbAnswers *answers);
// The odds of the leakage test that the study asks for; NaN without a sample that has a loss. A can
// that has none is open. SB_ERROR_RANGE, SB_ERROR_MEMORY.
SbStatus sb_study_leakage(SbLeakageOdds *out, const SbStudyFile *study, const SbAnswers *answers,
                          SbReport *report);

size_t sb_study_failed(const SbAnswers *answers);

// "ok", "not-converged", "infeasible", "refused", "not-computed"; borrowed.
const char *sb_study_status_name(uint8_t status);

// What intervals of probabilities from samples cover: neither the models' errors nor those of the
// distributions.
#define SB_INTERVAL_COVERS "sampling alone"

// Samples with a warning of validity.
typedef struct {
  char code[48];
  size_t count;
} SbCodeCount;

// Returns how many samples carry each code of validity, *count of them, sorted by code. Owned by
// the caller: g_free().
SbCodeCount *sb_study_warnings(size_t *count, const SbAnswers *answers);

// A row for each sample: number from 1, parameters, figures (empty: none), status, codes of
// validity
// (";" between). The bytes depend on the answers alone; errors show in the stream.
void sb_study_csv(FILE *stream, const SbStudyFile *study, const double *value,
                  const SbAnswers *answers);

// What the study's figures of the shelf rest on that is typical of such rubbers and not measured,
// of propellant (0) or water (1); owned by the caller, NULL: nothing, or the samples have their
// own.
char *sb_study_typical(const SbStudyFile *study, int which);

// Puts the title "study" and the full paths "file" of the study and "scene" of its scene; "-" is
// standard input.
void sb_json_study_files(SbJson *json, const SbStudyFile *study);

// The contract's JSON. Owned by the caller; NULL without memory.
char *sb_study_json(const SbStudyFile *study, const SbStudyDrawn *drawn, const SbAnswers *answers,
                    const char *cpus, SbReport *report);

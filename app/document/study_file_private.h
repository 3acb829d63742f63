// Inside of the reader of study files, shared by study_file.c and study_design.c.
#pragma once

#include "app/document/document_private.h"
#include "app/document/study_file.h"

#include "app/base/reader.h"
#include "engine/valve/studies/hold.h"

#define GROUP_VARY        "vary"
#define GROUP_STUDY       "study"
#define GROUP_CORRELATION "correlation"
#define GROUP_DESIGN      "design"
#define GROUP_TOLERANCES  "tolerances"
#define GROUP_LEAKAGE     "leakage_test"

// An objective that was not read, or that is none.
enum { SB_FIGURE_NONE = -1, SB_FIGURE_REFUSED = -2 };

// What is being read.
typedef struct {
  SbStudyFile *study;
  const GPtrArray *entries;
  const char *shown;
  GPtrArray *issues;
  guint grid; // of the group [vary NAME] that is read, 0: another
} SbStudyReader;

void sb_study_complain(const SbStudyReader *reader, const SbEntry *entry, const char *allowed,
                       const char *text);

// A line of [vary], or an offset of [tolerances], into a list of SbVary. The forms that it may
// have.
void sb_study_read_vary(SbStudyReader *reader, const SbEntry *entry, GArray *list, bool offset);
extern const char sb_study_vary_forms[];

// Place of a parameter in [vary], or -1.
int sb_study_vary_index(const SbStudyFile *study, const char *key);

// Adds a figure that the list has not.
void sb_study_take_figure(GArray *figures, int figure);

// Index of a figure, -1 with an issue.
int sb_study_read_figure(const SbStudyReader *reader, const SbEntry *entry, const char *path);

// A whole number from `least` to `most`.
SB_CHECKED bool sb_study_read_count(double *out, const char *text, double least, double most);

// A line of [design]; and when all groups are read, what a design needs of them.
void sb_study_read_design(SbStudyReader *reader, const SbEntry *entry);
void sb_study_check_design(SbStudyReader *reader);

// A line of [leakage_test]; and when all groups are read, what a test needs of them.
void sb_study_read_leakage(SbStudyReader *reader, const SbEntry *entry);
void sb_study_check_leakage(SbStudyReader *reader);

// Level of a range with a number of points.
double sb_study_grid_level(const SbDistribution *of, size_t index);

// A value of the base by its key; `data` is the model.
bool sb_study_base_value(double *out, const char *name, void *data);

// A line of [vary] or [vary NAME] that says more than a parameter's distribution is kept among
// `lines`; when all are read, what varies is taken from them.
void sb_study_take_lines(SbStudyReader *reader);

// Points of a grid that says more; its values [samples][vary].
size_t sb_study_grid_points(const SbStudyFile *study);
void sb_study_grid_fill(double *value, const SbStudyFile *study);

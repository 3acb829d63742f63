// Shared by the files that read study files: study_file.c, study_vary.c, study_grid.c,
// study_design.c and study_leakage.c.
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

// SbDesignWish.figure without an objective: not given, or given and refused with an issue.
enum { SB_FIGURE_NONE = -1, SB_FIGURE_REFUSED = -2 };

// State of reading one file; everything is borrowed.
typedef struct {
  SbStudyFile *study;       // being filled
  const GPtrArray *entries; // of SbEntry: the lines of the file
  const char *shown;        // the file, for messages
  GPtrArray *issues;        // of SbIssue
  guint grid; // number of the group [vary NAME] that is read, from 1; 0: another group
} SbStudyReader;

// Appends an issue on the key of `entry` with the sentence `text`. `allowed` is the allowed range
// or NULL.
void sb_study_add_issue(const SbStudyReader *reader, const SbEntry *entry, const char *allowed,
                        const char *text);

// Reads a line of [vary], or with `offset` of [tolerances], and appends it to `list` (of SbVary).
// Appends an issue instead if the line is wrong.
void sb_study_read_vary(SbStudyReader *reader, const SbEntry *entry, GArray *list, bool offset);

// The forms that such a line may have, for messages.
extern const char sb_study_vary_forms[];

// Returns the index in study->vary of the parameter `key`; -1: it does not vary.
int sb_study_vary_index(const SbStudyFile *study, const char *key);

// Appends an index of sb_figure() to `figures` (of int) if it is not in the list yet.
void sb_study_take_figure(GArray *figures, int figure);

// Returns the index of the figure `path`; -1 with an issue on the key of `entry` if there is none.
int sb_study_read_figure(const SbStudyReader *reader, const SbEntry *entry, const char *path);

// Reads an integer from `least` to `most` to *out. Returns false if `text` is none.
SB_CHECKED bool sb_study_read_count(double *out, const char *text, double least, double most);

// Reads a line of [design] to study->design; appends an issue if it is wrong.
void sb_study_read_design(SbStudyReader *reader, const SbEntry *entry);

// Checks, after all groups were read, what a design requires of them; appends issues.
void sb_study_check_design(SbStudyReader *reader);

// Called after all groups were read. Appends a note to study->notes for each size that the scene
// gives and that stays while the study varies the size with which a drawing would change it
// (sb_params_keeps()). A normal distribution is scatter of manufacture and gives no note.
void sb_study_note_kept(SbStudyReader *reader);

// Reads a line of [leakage_test] to study->leakage; appends an issue if it is wrong.
void sb_study_read_leakage(SbStudyReader *reader, const SbEntry *entry);

// Checks, after all groups were read, what leakage tests require of them; appends issues.
void sb_study_check_leakage(SbStudyReader *reader);

// Returns value `index` (from 0) of a distribution with levels, or of a range with a number of
// points [SI].
double sb_study_grid_level(const SbDistribution *of, size_t index);

// Writes the value of the parameter `name` in the model `data` (const SbModel *) [SI]. Returns
// false if there is no such key. An SbExpressionName.
bool sb_study_base_value(double *out, const char *name, void *data);

// Called after all lines of [vary] and [vary NAME] were read into study->vary. If one of them
// extends the grid (a variable, an expression or a group with a name), moves them to study->lines
// and makes study->vary the list of columns. Appends issues.
void sb_study_take_lines(SbStudyReader *reader);

// Returns the number of samples of an extended grid.
size_t sb_study_grid_points(const SbStudyFile *study);

// Writes the values [samples][vary] of an extended grid, with expressions computed.
void sb_study_grid_fill(double *value, const SbStudyFile *study);

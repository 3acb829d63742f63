// Blocks of rows: which continue the table, and which are tests of their own; see measured.h.
#include "app/data/measured_private.h"

#define SB_WORDS(name, expression) static const char name[] = expression;
#include "app/data/measured_words.def"
#undef SB_WORDS

// Blocks behind a blank line, names or a label do not continue the table where two of these are
// true: the time goes back; the displacement jumps further than between rows of a long block; there
// are too few rows for a loop. The shorter side of the line is dropped. A block whose time, or
// without time whose displacement, goes back is another test. Where the time begins again, a block
// begins; a first row beyond all others, as of full scales, is one.
void sb_measured_tests(SbMeasured *m, const SbTextTable *table, double *block) {
  const double *time = m->time, *place = m->displacement;
  double step = 0, more = 0;
  for (size_t i = 1, begin = 0; time != NULL && i < m->count; i++) {
    more += time[i] - time[begin] < 0.9 * (time[i - 1] - time[begin]);
    block[i] += more;
    begin = block[i] != block[i - 1] ? i : begin;
  }
  const size_t blocks = m->count > 0 ? (size_t)(block[m->count - 1] - block[0]) + 1 : 1;
  const size_t most = MAX(m->count / blocks / 2, ROWS_MIN);
  for (size_t i = most; place != NULL && i < m->count; i++) {
    step = block[i] == block[i - most] ? fmax(step, fabs(place[i] - place[i - 1])) : step;
  }
  bool beyond = place != NULL && m->count > 1;
  for (size_t i = 1; beyond && i < m->count; i++) {
    beyond = fabs(place[i]) < fabs(place[0]) && fabs(m->force[i]) < fabs(m->force[0]);
  }
  block[0] -= beyond;
  const char *line = m->lines.left_text != NULL ? m->lines.left_text : "";
  const bool cycles = g_regex_match_simple(CYCLE, line, G_REGEX_CASELESS, 0);
  for (size_t i = 0, end, kept = 0, last = 0; i < m->count; i = end) {
    for (end = i + 1; end < m->count && block[end] == block[i];) {
      end++;
    }
    const bool back = kept > 0 && time != NULL && time[i] < time[last];
    const bool jump = kept > 0 && step > 0 && fabs(place[i] - place[last]) > 2 * step;
    const bool apart = back + jump + (MIN(kept, end - i) < ROWS_MIN) > 1;
    const bool before = apart && kept < end - i;
    for (size_t k = before ? 0 : i; apart && k < (before ? i : end); k++) {
      m->force[k] = NAN;
    }
    m->jumps |= (back || jump) && !apart;
    const bool again = time == NULL && place != NULL && MIN(kept, end - i) >= ROWS_MIN &&
                       2 * (end - i) >= kept &&
                       fabs(place[i] - place[0]) <= fabs(place[i] - place[last]);
    m->tests += (back || again) && !apart && !cycles;
    kept = apart ? MAX(kept, end - i) : kept + end - i;
    last = apart && !before ? last : end - 1;
  }
  size_t specimens = 0;
  // A column may number cycles, which are no tests, or name specimens, which are.
  for (size_t i = 0; i < table->columns; i++) {
    const char *name = table->column[i].name;
    const bool named = g_regex_match_simple(SPECIMEN, name, G_REGEX_CASELESS, 0);
    const size_t changes = named ? sb_text_table_changes(table, i) : 0;
    specimens = (changes + 1) * ROWS_MIN <= m->count ? MAX(specimens, changes) : specimens;
    m->tests = g_regex_match_simple(CYCLE, name, G_REGEX_CASELESS, 0) ? 0 : m->tests;
  }
  m->tests = MAX(m->tests, specimens);
}

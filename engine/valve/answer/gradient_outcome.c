// What a gradient compares in an answer in addition to its figures.
#include "engine/valve/answer/gradient_private.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

void sb_gradient_outcome(SbGradientOutcome *out, const SbSummary *summary) {
  *out = (SbGradientOutcome){.known = summary != NULL};
  for (int i = 0; summary != NULL && i < SB_STAGE_COUNT; i++) {
    out->stage[i] = summary->stage[i].reached;
  }
  for (int i = 0; summary != NULL && i < SB_SEAL_COUNT; i++) {
    const SbSealState *seal = &summary->seal[i];
    out->seal[i].touches = seal->touches;
    out->seal[i].opened = seal->opened;
    out->seal[i].film_fitted = seal->film_fitted;
    out->seal[i].leak = seal->leak_state;
    out->seal[i].in = summary->contact[i].in_stroke.section;
    out->seal[i].out = summary->contact[i].back.section;
  }
  out->end = summary != NULL ? summary->outcome : SB_OUTCOME_UNKNOWN;
}

bool sb_gradient_differ(char *text, size_t size, const SbGradientOutcome *a,
                        const SbGradientOutcome *b) {
  if (!a->known || !b->known) {
    return false;
  }
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    if (a->stage[i] != b->stage[i]) {
      sb_text(text, size, "stage %s is reached on one side only", sb_stage_name((SbStage)i));
      return true;
    }
  }
  if (a->end != b->end) {
    sb_text(text, size, "the stem's motion has another outcome on each side");
    return true;
  }
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const char *what =
        a->seal[i].touches != b->seal[i].touches ? "has contact with the bore on one side only"
        : a->seal[i].opened != b->seal[i].opened ? "is opened by the fluid on one side only"
        : a->seal[i].film_fitted != b->seal[i].film_fitted
            ? "has a film on its fitted body on one side only"
        : a->seal[i].leak != b->seal[i].leak ? "leaks at rest differently on each side"
        : a->seal[i].in != b->seal[i].in || a->seal[i].out != b->seal[i].out
            ? "slides, rolls or jams differently on each side"
            : NULL;
    if (what != NULL) {
      sb_text(text, size, "the %s seal %s", sb_seal_name(i), what);
      return true;
    }
  }
  return false;
}

void sb_gradient_contacts(SbGradientContacts *out, const SbSummary *summary) {
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealState *in = &summary->seal[i];
    const SbContact *back = &summary->contact[i].back;
    const double sizes[SB_GRADIENT_WAYS][SB_GRADIENT_SIZES] = {
        {in->load, in->contact_right - in->contact_left, in->pressure_peak},
        {back->load, back->width, back->pressure_peak}};
    memcpy(out->size[i], sizes, sizeof sizes);
  }
}

double sb_gradient_size(const SbSummary *summary, int figure) {
  const double value = fabs(sb_figure_value(summary, figure));
  const SbFigure *row = sb_figure(figure);
  const bool energy = row->quantity == SB_FIGURE_QUANTITY_ENERGY;
  const bool leak = row->verdict == SB_VERDICT_LEAK && row->seal == SB_SEAL_COUNT &&
                    row->quantity == SB_FIGURE_QUANTITY_VOLUME;
  const bool closure = row->offset == offsetof(SbSummary, energy.closure);
  const double whole = energy    ? summary->energy.external_max
                       : leak    ? summary->leakage_carried
                       : closure ? 1
                                 : 0;
  return fmax(value, whole); // leaves out what is not known
}

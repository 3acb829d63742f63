// See own_model.h.
#include "app/base/own_model.h"

#include <glib.h>

SbModel *sb_own_model(const SbModel *model) {
  SbModel *copy = NULL;
  if (sb_model_copy(&copy, model) != SB_OK) {
    g_error("no memory for a model");
  }
  return copy;
}

// Large data of a model, shared by reference count, and its drawings.
#include "engine/valve/model/model.h"

#include <stdlib.h>

SbStatus sb_model_data_create(SbModelData **out) {
  *out = calloc(1, sizeof **out);
  if (*out == NULL) {
    return SB_ERROR_MEMORY;
  }
  atomic_init(&(*out)->holders, 1);
  return SB_OK;
}

// The count alone changes behind the const.
static atomic_uint *holders(const SbModelData *data) {
  return &((SbModelData *)data)->holders;
}

void sb_model_data_release(const SbModelData *data) {
  if (data != NULL && atomic_fetch_sub_explicit(holders(data), 1, memory_order_acq_rel) == 1) {
    free((SbModelData *)data);
  }
}

void sb_model_data_hold(const SbModelData *data) {
  atomic_fetch_add_explicit(holders(data), 1, memory_order_relaxed);
}

// FNV-1a: Fowler, Noll and Vo; Internet draft draft-eastlake-fnv.
static void mix(uint64_t *sum, const double *numbers, int count) {
  const unsigned char *byte = (const unsigned char *)numbers;
  for (size_t i = 0; i < sizeof *numbers * (size_t)count; i++) {
    *sum = (*sum ^ byte[i]) * 0x100000001b3U;
  }
}

static void mix_line(uint64_t *sum, const SbGrooveLine *line) {
  mix(sum, (const double[]){line->offset, line->slope, line->count}, 3);
  for (int i = 0; i < line->count; i++) {
    mix(sum, (const double[]){line->bend[i].at, line->bend[i].turn, line->bend[i].length}, 3);
  }
}

uint64_t sb_model_data_drawings(const SbModelData *data) {
  const SbSealDrawing *section = &data->profile;
  const SbGrooveDrawing *groove = &data->groove;
  if (section->count == 0 && groove->count == 0) {
    return 0;
  }
  uint64_t sum = 0xcbf29ce484222325U;
  for (int i = 0; i < section->count; i++) {
    const SbSealPoint *p = &section->point[i];
    mix(&sum, (const double[]){p->r, p->z, p->bulge}, 3);
  }
  mix(&sum, (const double[]){section->count, groove->width, groove->depth}, 3);
  for (int k = 0; k < 2; k++) {
    mix_line(&sum, &groove->floor[k]);
    mix_line(&sum, &groove->wall[k]);
  }
  return sum;
}

uint64_t sb_model_drawings(const SbModel *model) {
  return model->data != NULL ? sb_model_data_drawings(model->data) : 0;
}

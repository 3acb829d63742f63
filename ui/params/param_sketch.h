// A sketch for a parameter's help: where on the valve its size is measured.
#pragma once

#include "engine/valve/model/valve.h"

#include <gtk/gtk.h>

// A half-section of the valve at rest, to scale, with the size of parameter `id` (or the one that
// its tolerance belongs to) marked by a dimension line. NULL where it is no size of the valve. The
// model is read here only.
GtkWidget *sb_param_sketch_new(const SbModel *model, SbParamId id);

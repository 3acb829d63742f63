// A sketch for the help of a parameter: where on the valve its size is measured.
#pragma once

#include "engine/valve/model/valve.h"

#include <gtk/gtk.h>

// Returns a new widget (floating reference) that draws a half-section of the valve at rest, to
// scale, with a dimension line for parameter `id` (of a tolerance, for its size). NULL if the
// parameter is not a size of the valve. `model` is read only during the call.
GtkWidget *sb_param_sketch_new(const SbModel *model, SbParamId id);

// Headers of libraries that most files of ui/ need, compiled once per build; see
// app/precompiled/app.h.
#include <glib/gi18n.h>
#include <gtk/gtk.h>
#include <math.h>
#include <string.h>

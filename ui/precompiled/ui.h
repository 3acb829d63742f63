// Headers of libraries that most files of ui/ need, compiled once per build (Meson's `c_pch`).
// The compiler includes this header before each source of ui/; it declares nothing itself and no
// file includes it. Each file still includes the headers that it uses, because builds with
// -Db_pch=false and builds with clang in ./check have no precompiled headers.
#include <glib/gi18n.h>
#include <gtk/gtk.h>
#include <math.h>
#include <string.h>

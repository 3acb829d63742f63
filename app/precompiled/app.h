// Headers of libraries that most files of app/ need, compiled once per build (Meson's `c_pch`).
// The compiler includes this header before each source of app/; it declares nothing itself and no
// file includes it. Each file still includes the headers that it uses, because builds with
// -Db_pch=false and builds with clang in ./check have no precompiled headers.
#include <gio/gio.h>
#include <glib.h>
#include <math.h>
#include <pango/pangocairo.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

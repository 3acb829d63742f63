// Headers of libraries that most files of app/ need, compiled once per build (c_pch). Each file
// still includes what it uses: builds with -Db_pch=false, and ./check's with clang, have no
// precompiled headers.
#include <gio/gio.h>
#include <glib.h>
#include <math.h>
#include <pango/pangocairo.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

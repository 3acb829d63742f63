// See error.h.
#include "app/base/error.h"

// clang-format off
G_DEFINE_QUARK(sb-app-error-quark, sb_app_error)

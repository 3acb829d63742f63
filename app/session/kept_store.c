#include "app/session/kept_store.h"

#include "app/base/error.h"

#include "engine/base/version.h"

#include <glib/gstdio.h>
#include <sys/stat.h>

static const goffset LARGEST = 200000000;

// An engine has its own: versions under development answer differently under the same number.
static char *file_name(void) {
  return g_strdup_printf("answers-%.16s.store", sb_engine_identity()->source);
}

static void remove_others(const char *folder, const char *name) {
  GDir *dir = g_dir_open(folder, 0, NULL);
  for (const char *entry; dir != NULL && (entry = g_dir_read_name(dir)) != NULL;) {
    g_autofree char *path = g_build_filename(folder, entry, NULL);
    GStatBuf is;
    const gboolean ours = g_str_has_prefix(entry, "answers-") && g_str_has_suffix(entry, ".store");
    if (ours &&
        (g_strcmp0(entry, name) != 0 || (g_lstat(path, &is) == 0 && is.st_size > LARGEST))) {
      g_unlink(path);
    }
  }
  if (dir != NULL) {
    g_dir_close(dir);
  }
}

SbStore *sb_kept_store_open(void) {
  g_autofree char *folder = g_build_filename(g_get_user_cache_dir(), "sealbench", NULL);
  g_autofree char *name = file_name();
  g_autofree char *path = g_build_filename(folder, name, NULL);
  g_autoptr(GError) error = NULL;
  g_mkdir_with_parents(folder, 0700);
  remove_others(folder, name);
  SbStore *store = sb_store_open(path, &error);
  // Another window may have it.
  if (store != NULL && !sb_store_open_for_writing(store, &error)) {
    sb_store_discard(store);
    store = NULL;
  }
  if (store == NULL && g_error_matches(error, SB_APP_ERROR, SB_APP_ERROR_INPUT)) {
    g_unlink(path);
  }
  return store != NULL ? store : sb_store_open(NULL, NULL);
}

// Checks of output files before the work; see output.h.
#include "app/base/output_private.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// The nearest folder of `path` that exists, itself if it does. Owned by the caller.
static char *nearest_folder(const char *path) {
  char *at = g_path_get_dirname(path);
  while (!g_file_test(at, G_FILE_TEST_EXISTS)) {
    char *up = g_path_get_dirname(at);
    g_free(at);
    at = up;
  }
  return at;
}

// A file without a name is made and dropped, which finds what permissions do not show.
static int try_folder(const char *folder) {
  int in = open(folder, O_PATH | O_DIRECTORY | O_CLOEXEC);
  char *name = NULL;
  int fd = in >= 0 ? sb_output_open_temporary(&name, in) : -1;
  int code = fd >= 0 ? 0 : errno;
  if (name != NULL) {
    unlinkat(in, name, 0);
    g_free(name);
  }
  if (fd >= 0) {
    close(fd);
  }
  if (in >= 0) {
    close(in);
  }
  return code;
}

bool sb_output_check(SbOutputCheck *check, const char *path, bool makes_folder, GError **error) {
  struct stat info;
  if (path == NULL || sb_output_names_descriptor(path) ||
      (stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode))) {
    return true;
  }
  bool exists = stat(path, &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) {
    return sb_output_fail_errno(error, path, EISDIR);
  }
  if (exists && !sb_output_may_replace(path, &info, error)) {
    return false;
  }
  char *target = sb_output_follow(path);
  if (target == NULL) {
    return sb_output_fail_errno(error, path, errno);
  }
  // A file is known by its inode, one that is not there yet by its folder and name.
  g_autofree char *folder = makes_folder ? nearest_folder(target) : g_path_get_dirname(target);
  g_autofree char *whole = g_canonicalize_filename(target, NULL);
  char *identity = NULL;
  int code = try_folder(folder);
  if (code != 0) {
    sb_output_fail_errno(error, makes_folder ? folder : path, code);
  } else if (exists) {
    identity = g_strdup_printf("%" G_GUINT64_FORMAT " %" G_GUINT64_FORMAT "", (guint64)info.st_dev,
                               (guint64)info.st_ino);
  } else if (stat(folder, &info) == 0) {
    g_autofree char *in = g_canonicalize_filename(folder, NULL);
    identity =
        g_strdup_printf("%" G_GUINT64_FORMAT " %" G_GUINT64_FORMAT "%s", (guint64)info.st_dev,
                        (guint64)info.st_ino, whole + (strcmp(in, "/") == 0 ? 0 : strlen(in)));
  }
  if (check->targets == NULL) {
    check->targets = g_ptr_array_new_with_free_func(g_free);
  }
  bool good = identity != NULL;
  if (good && g_ptr_array_find_with_equal_func(check->targets, identity, g_str_equal, NULL)) {
    good = sb_output_fail(error, SB_APP_ERROR_INPUT, path, "two outputs would go to this file");
  }
  if (identity != NULL) {
    g_ptr_array_add(check->targets, identity);
  }
  g_free(target);
  return good;
}

void sb_output_check_clear(SbOutputCheck *check) {
  g_clear_pointer(&check->targets, g_ptr_array_unref);
}

// Temporary files are named ".NAME.part-PID": those of processes that are gone can be told and
// removed by the next one.
#include "app/document/atomic.h"

#include "app/document/issue.h"

#include <errno.h>
#include <fcntl.h>
#include <glib/gstdio.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool fail(GError **error, const char *path, int code) {
  char *shown = sb_printable(path, strlen(path));
  g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s: %s", shown, g_strerror(code));
  g_free(shown);
  return false;
}

// Whether a process is over: no number, or dead and only not waited for yet.
static bool is_over(pid_t pid) {
  if (kill(pid, 0) != 0) {
    return errno == ESRCH;
  }
  char *path = g_strdup_printf("/proc/%ld/stat", (long)pid);
  char *text = NULL;
  // The state follows the command's name, which is in brackets.
  const char *state = g_file_get_contents(path, &text, NULL, NULL) ? strrchr(text, ')') : NULL;
  bool over = state != NULL && (g_str_has_prefix(state, ") Z") || g_str_has_prefix(state, ") X"));
  g_free(text);
  g_free(path);
  return over;
}

// Removes temporaries of `prefix` (".NAME.part-") whose process does not live any more.
static void remove_stale(const char *directory, const char *prefix) {
  GDir *dir = g_dir_open(directory, 0, NULL);
  if (dir == NULL) {
    return;
  }
  const char *name;
  while ((name = g_dir_read_name(dir)) != NULL) {
    if (!g_str_has_prefix(name, prefix)) {
      continue;
    }
    char *end = NULL;
    long pid = strtol(name + strlen(prefix), &end, 10);
    if (*end == '\0' && pid > 1 && is_over((pid_t)pid)) {
      char *stale = g_build_filename(directory, name, NULL);
      g_unlink(stale);
      g_free(stale);
    }
  }
  g_dir_close(dir);
}

bool sb_atomic_file_begin(SbAtomicFile *out, const char *path, GError **error) {
  // Devices and pipes are written to as they are.
  struct stat info;
  if (stat(path, &info) == 0 && !S_ISREG(info.st_mode)) {
    FILE *direct = S_ISDIR(info.st_mode) ? NULL : fopen(path, "wbe");
    if (direct == NULL) {
      return fail(error, path, S_ISDIR(info.st_mode) ? EISDIR : errno);
    }
    *out = (SbAtomicFile){g_strdup(path), NULL, direct};
    return true;
  }
  // Renaming would replace what its owner has write-protected.
  if (access(path, F_OK) == 0 && access(path, W_OK) != 0) {
    return fail(error, path, errno);
  }
  char *directory = g_path_get_dirname(path);
  char *name = g_path_get_basename(path);
  char *prefix = g_strdup_printf(".%s.part-", name);
  remove_stale(directory, prefix);
  char *own = g_strdup_printf("%s%ld", prefix, (long)getpid());
  char *temporary = g_build_filename(directory, own, NULL);
  int fd = open(temporary, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  FILE *stream = fd >= 0 ? fdopen(fd, "wb") : NULL;
  int code = errno;
  if (stream != NULL) {
    *out = (SbAtomicFile){g_strdup(path), g_steal_pointer(&temporary), stream};
  } else {
    if (fd >= 0) {
      close(fd);
      g_unlink(temporary);
    }
    fail(error, path, code);
  }
  g_free(temporary);
  g_free(own);
  g_free(prefix);
  g_free(name);
  g_free(directory);
  return stream != NULL;
}

bool sb_atomic_file_seal(SbAtomicFile *file, GError **error) {
  int code = EIO;
  bool good = ferror(file->stream) == 0;
  if (!good && write(fileno(file->stream), "", 1) < 0) {
    // The stream has forgotten why; the next write says it again.
    code = errno;
  }
  if (good && fflush(file->stream) != 0) {
    good = false;
    code = errno;
  }
  // Pipes and devices cannot be synced.
  if (good && file->temporary != NULL && fsync(fileno(file->stream)) != 0) {
    good = false;
    code = errno;
  }
  if (fclose(file->stream) != 0 && good) {
    good = false;
    code = errno;
  }
  file->stream = NULL;
  if (!good) {
    fail(error, file->path, code);
    sb_atomic_file_abort(file);
  }
  return good;
}

bool sb_atomic_file_commit(SbAtomicFile *file, GError **error) {
  if (file->stream != NULL && !sb_atomic_file_seal(file, error)) {
    return false;
  }
  if (file->temporary != NULL && g_rename(file->temporary, file->path) != 0) {
    fail(error, file->path, errno);
    sb_atomic_file_abort(file);
    return false;
  }
  g_clear_pointer(&file->temporary, g_free);
  g_clear_pointer(&file->path, g_free);
  return true;
}

void sb_atomic_file_abort(SbAtomicFile *file) {
  if (file->stream != NULL) {
    fclose(file->stream);
    file->stream = NULL;
  }
  if (file->temporary != NULL) {
    g_unlink(file->temporary);
  }
  g_clear_pointer(&file->temporary, g_free);
  g_clear_pointer(&file->path, g_free);
}

bool sb_atomic_write(const char *path, const char *text, size_t length, GError **error) {
  SbAtomicFile file;
  if (!sb_atomic_file_begin(&file, path, error)) {
    return false;
  }
  fwrite(text, 1, length, file.stream);
  return sb_atomic_file_commit(&file, error);
}

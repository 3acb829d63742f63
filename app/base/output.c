// One file. See output.h.
#include "app/base/output_private.h"

#include "app/base/issue.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#define TEMPORARY_PREFIX ".sealbench-"
#define TEMPORARY_SUFFIX ".part"

// ---- Policy ----

typedef struct {
  dev_t device;
  ino_t inode;
} Identity;

static struct {
  GMutex lock;
  GArray *inputs; // of Identity; NULL: inputs are not protected
  bool keep_existing;
} policy;

static atomic_int committing;

void sb_output_protect_inputs(void) {
  policy.inputs = g_array_new(FALSE, FALSE, sizeof(Identity));
}

void sb_output_note_input(const struct stat *info) {
  g_mutex_lock(&policy.lock);
  if (policy.inputs != NULL) {
    Identity identity = {info->st_dev, info->st_ino};
    g_array_append_val(policy.inputs, identity);
  }
  g_mutex_unlock(&policy.lock);
}

void sb_output_keep_existing(bool keep) {
  policy.keep_existing = keep;
}

bool sb_output_keeps_existing(void) {
  return policy.keep_existing;
}

bool sb_output_is_committing(void) {
  return atomic_load(&committing) > 0;
}

bool sb_output_ends_in(const char *path, const char *ending) {
  size_t length = strlen(path);
  size_t tail = strlen(ending);
  return length >= tail && g_ascii_strcasecmp(path + length - tail, ending) == 0;
}

bool sb_output_fail(GError **error, SbAppError kind, const char *path, const char *text) {
  char *shown =
      strcmp(path, "-") == 0 ? g_strdup("standard output") : sb_printable(path, strlen(path));
  g_set_error(error, SB_APP_ERROR, kind, "%s: %s", shown, text);
  g_free(shown);
  return false;
}

bool sb_output_fail_errno(GError **error, const char *path, int code) {
  return sb_output_fail(error, SB_APP_ERROR_IO, path, g_strerror(code));
}

bool sb_output_may_replace(const char *path, const struct stat *info, GError **error) {
  bool is_input = false;
  g_mutex_lock(&policy.lock);
  for (guint i = 0; policy.inputs != NULL && i < policy.inputs->len; i++) {
    const Identity *input = &g_array_index(policy.inputs, Identity, i);
    is_input |= input->device == info->st_dev && input->inode == info->st_ino;
  }
  g_mutex_unlock(&policy.lock);
  if (is_input) {
    return sb_output_fail(error, SB_APP_ERROR_INPUT, path,
                          "is an input of this command and would be replaced");
  }
  if (policy.keep_existing) {
    return sb_output_fail(error, SB_APP_ERROR_INPUT, path, "exists already (--no-overwrite)");
  }
  int fd = open(path, O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) {
    return sb_output_fail_errno(error, path, errno);
  }
  close(fd);
  return true;
}

// ---- Folders and temporary files ----

char *sb_output_follow(const char *path) {
  enum { LINKS_MAX = 40 };
  char *at = g_strdup(path);
  for (int i = 0; i < LINKS_MAX; i++) {
    char *to = g_file_read_link(at, NULL);
    if (to == NULL) {
      return at;
    }
    g_autofree char *in = g_path_get_dirname(at);
    g_free(at);
    at = g_path_is_absolute(to) ? g_strdup(to) : g_build_filename(in, to, NULL);
    g_free(to);
  }
  g_free(at);
  errno = ELOOP;
  return NULL;
}

bool sb_output_names_descriptor(const char *path) {
  return strcmp(path, "-") == 0 || g_str_has_prefix(path, "/dev/std") ||
         g_str_has_prefix(path, "/dev/fd/") ||
         (g_str_has_prefix(path, "/proc/") && strstr(path, "/fd/") != NULL);
}

// Returns a random hidden file name without a folder.
static char *temporary_name(void) {
  guint64 number = 0;
  if (getrandom(&number, sizeof number, 0) != (ssize_t)sizeof number) {
    number = (guint64)g_random_int() << 32 | g_random_int();
  }
  return g_strdup_printf(TEMPORARY_PREFIX "%016" G_GINT64_MODIFIER "x" TEMPORARY_SUFFIX, number);
}

void sb_output_sweep(int folder) {
  int own = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  DIR *dir = own >= 0 ? fdopendir(own) : NULL;
  if (dir == NULL && own >= 0) {
    close(own);
  }
  const struct dirent *entry;
  while (dir != NULL && (entry = readdir(dir)) != NULL) {
    const char *name = entry->d_name;
    if (!g_str_has_prefix(name, TEMPORARY_PREFIX) || !g_str_has_suffix(name, TEMPORARY_SUFFIX)) {
      continue;
    }
    int fd = openat(folder, name, O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
    // Its writer holds a lock as long as it lives.
    if (fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) == 0) {
      unlinkat(folder, name, 0);
    }
    if (fd >= 0) {
      close(fd);
    }
  }
  if (dir != NULL) {
    closedir(dir);
  }
}

// A file under a random name of its own. A sweep can take it before it is locked: then another.
static int open_named(char **name, int folder) {
  for (;;) {
    char *own = temporary_name();
    int fd = openat(folder, own, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd < 0 && errno != EEXIST) {
      g_free(own);
      return -1;
    }
    struct stat info;
    if (fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) == 0 && fstat(fd, &info) == 0 &&
        info.st_nlink > 0) {
      *name = own;
      return fd;
    }
    if (fd >= 0) {
      close(fd);
    }
    g_free(own);
  }
}

int sb_output_open_temporary(char **name, int folder) {
  *name = NULL;
  int fd = openat(folder, ".", O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
  if (fd >= 0) {
    char at[32];
    g_snprintf(at, sizeof at, "/proc/self/fd/%d", fd);
    if (access(at, F_OK) == 0 && flock(fd, LOCK_EX | LOCK_NB) == 0) {
      return fd;
    }
    close(fd);
  }
  return open_named(name, folder);
}

// ---- Begin, seal ----

// Opens what gets the bytes in the end: a folder, or a device or pipe (then *name stays NULL).
static int open_target(char **name, const char *path, bool own_way, GError **error) {
  *name = NULL;
  struct stat info;
  bool exists = strcmp(path, "-") != 0 && stat(path, &info) == 0;
  int fd;
  if (strcmp(path, "-") == 0) {
    fflush(stdout);
    fd = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  } else if (exists && S_ISDIR(info.st_mode)) {
    sb_output_fail_errno(error, path, EISDIR);
    return -1;
  } else if (sb_output_names_descriptor(path) || (exists && !S_ISREG(info.st_mode))) {
    fd = open(path, O_WRONLY | O_TRUNC | O_CLOEXEC);
  } else {
    if (exists && !own_way && !sb_output_may_replace(path, &info, error)) {
      return -1;
    }
    g_autofree char *target = sb_output_follow(path);
    g_autofree char *folder = target != NULL ? g_path_get_dirname(target) : NULL;
    fd = folder != NULL ? open(folder, O_PATH | O_DIRECTORY | O_CLOEXEC) : -1;
    if (fd >= 0) {
      *name = g_path_get_basename(target);
    }
  }
  if (fd < 0) {
    sb_output_fail_errno(error, path, errno);
  }
  return fd;
}

bool sb_output_begin_at(SbOutput *out, const char *path, bool own_way, bool sweep, GError **error) {
  *out = (SbOutput){.path = g_strdup(path), .own_way = own_way, .folder = -1};
  out->folder = open_target(&out->name, path, own_way, error);
  if (out->folder < 0) {
    g_clear_pointer(&out->path, g_free);
    return false;
  }
  int fd;
  if (out->name == NULL) {
    fd = memfd_create("sealbench", MFD_CLOEXEC);
  } else {
    if (sweep) {
      sb_output_sweep(out->folder);
    }
    fd = sb_output_open_temporary(&out->temporary, out->folder);
  }
  out->stream = fd >= 0 ? fdopen(fd, "w+b") : NULL;
  if (out->stream == NULL) {
    sb_output_fail_errno(error, path, errno);
    if (fd >= 0) {
      close(fd);
    }
    sb_output_abort(out);
    return false;
  }
  if (out->temporary != NULL) {
    g_autofree char *target = sb_output_follow(path);
    g_autofree char *in = g_path_get_dirname(target);
    out->written_at = g_build_filename(in, out->temporary, NULL);
  } else {
    out->written_at = g_strdup_printf("/proc/self/fd/%d", fd);
  }
  return true;
}

bool sb_output_begin(SbOutput *out, const char *path, GError **error) {
  return sb_output_begin_at(out, path, false, true, error);
}

bool sb_output_seal(SbOutput *out, GError **error) {
  int code = 0;
  errno = 0;
  if (ferror(out->stream) != 0) {
    // The stream has forgotten why; the next write says it again.
    code = write(fileno(out->stream), "", 1) < 0 ? errno : EIO;
  } else if (fflush(out->stream) != 0 ||
             (out->name != NULL && fsync(fileno(out->stream)) != 0 && errno != EINVAL)) {
    code = errno;
  }
  if (code != 0) {
    sb_output_fail_errno(error, out->path, code);
    sb_output_abort(out);
  }
  return code == 0;
}

// ---- Commit ----

// Copies all of a file to a descriptor; an errno, 0 for success.
static int copy_all(int to, int from) {
  char bytes[1 << 13];
  for (off_t at = 0;;) {
    ssize_t got = pread(from, bytes, sizeof bytes, at);
    if (got == 0) {
      return 0;
    }
    if (got < 0 && errno != EINTR) {
      return errno;
    }
    for (ssize_t done = 0; done < got;) {
      ssize_t put = write(to, bytes + done, (size_t)(got - done));
      if (put < 0 && errno != EINTR) {
        return errno;
      }
      done += MAX(put, 0);
    }
    at += MAX(got, 0);
  }
}

// Gives the new file the old one's mode and owner. False if that is not possible, or would not be
// all: other names of the old file, an access list.
static bool take_over(int fd, const struct stat *old, int old_fd) {
  struct stat own;
  if (old->st_nlink > 1 || fstat(fd, &own) != 0 ||
      fgetxattr(old_fd, "system.posix_acl_access", NULL, 0) > 0) {
    return false;
  }
  bool same = own.st_uid == old->st_uid && own.st_gid == old->st_gid;
  return (same || fchown(fd, old->st_uid, old->st_gid) == 0) &&
         fchmod(fd, old->st_mode & 07777) == 0;
}

// The complete new bytes into the old file. Room for them is taken first.
static int rewrite(int old_fd, const struct stat *old, int fd) {
  struct stat own;
  if (fstat(fd, &own) != 0) {
    return errno;
  }
  int code = own.st_size > old->st_size ? posix_fallocate(old_fd, 0, own.st_size) : 0;
  if (code == ENOSPC || code == EDQUOT || code == EFBIG) {
    return ftruncate(old_fd, old->st_size) == 0 ? code : errno;
  }
  code = copy_all(old_fd, fd);
  return code != 0 ? code : ftruncate(old_fd, own.st_size) == 0 && fsync(old_fd) == 0 ? 0 : errno;
}

// Gives a file without a name one; an errno.
static int link_as(const SbOutput *out, const char *name) {
  g_autofree char *at = g_strdup_printf("/proc/self/fd/%d", fileno(out->stream));
  return linkat(AT_FDCWD, at, out->folder, name, AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
}

static int put_in_place(SbOutput *out) {
  int fd = fileno(out->stream);
  struct stat old;
  int old_fd = openat(out->folder, out->name, O_WRONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  if (old_fd >= 0) {
    bool regular = fstat(old_fd, &old) == 0 && S_ISREG(old.st_mode);
    int code = 0;
    bool copied = regular && !take_over(fd, &old, old_fd);
    if (copied) {
      code = rewrite(old_fd, &old, fd);
    }
    close(old_fd);
    if (copied) {
      return code;
    }
  } else if (errno != ENOENT) {
    return errno;
  } else if (out->temporary == NULL) {
    int code = link_as(out, out->name);
    if (code != EEXIST || (policy.keep_existing && !out->own_way)) {
      return code;
    }
  }
  while (out->temporary == NULL) {
    char *name = temporary_name();
    int code = link_as(out, name);
    if (code == 0) {
      out->temporary = g_steal_pointer(&name);
    }
    g_free(name);
    if (code != 0 && code != EEXIST) {
      return code;
    }
  }
  if (renameat(out->folder, out->temporary, out->folder, out->name) != 0) {
    return errno;
  }
  g_clear_pointer(&out->temporary, g_free);
  return 0;
}

bool sb_output_commit_sealed(SbOutput *out, GError **error) {
  struct stat info;
  if (out->name != NULL && !out->own_way && policy.keep_existing &&
      fstatat(out->folder, out->name, &info, AT_SYMLINK_NOFOLLOW) == 0) {
    sb_output_fail(error, SB_APP_ERROR_INPUT, out->path, "exists already (--no-overwrite)");
    sb_output_abort(out);
    return false;
  }
  atomic_fetch_add(&committing, 1);
  int code = out->name != NULL ? put_in_place(out) : copy_all(out->folder, fileno(out->stream));
  atomic_fetch_sub(&committing, 1);
  if (code == EPIPE && out->name == NULL) {
    code = 0; // the reader of a pipe has read what it wanted
  }
  if (code != 0) {
    sb_output_fail_errno(error, out->path, code);
  }
  sb_output_abort(out);
  return code == 0;
}

bool sb_output_commit(SbOutput *out, GError **error) {
  return sb_output_seal(out, error) && sb_output_commit_sealed(out, error);
}

void sb_output_abort(SbOutput *out) {
  if (out->path == NULL) {
    return;
  }
  if (out->temporary != NULL) {
    unlinkat(out->folder, out->temporary, 0);
  }
  if (out->stream != NULL) {
    fclose(out->stream);
  }
  close(out->folder);
  g_free(out->path);
  g_free(out->name);
  g_free(out->temporary);
  g_free(out->written_at);
  *out = (SbOutput){.folder = -1};
}

bool sb_output_write_locked(int *lock, const char *path, const void *text, size_t length,
                            GError **error) {
  SbOutput file;
  if (!sb_output_begin(&file, path, error)) {
    return false;
  }
  fwrite(text, 1, length, file.stream);
  // Temporary files are locked from their beginning; the lock is the open file's, not the name's.
  int kept = fcntl(fileno(file.stream), F_DUPFD_CLOEXEC, 3);
  if (!sb_output_commit(&file, error)) {
    close(kept);
    return false;
  }
  *lock = kept;
  return true;
}

bool sb_output_write(const char *path, const void *text, size_t length, GError **error) {
  int lock;
  if (!sb_output_write_locked(&lock, path, text, length, error)) {
    return false;
  }
  close(lock);
  return true;
}

bool sb_output_is_locked(const char *path) {
  int fd = open(path, O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  bool locked = fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) != 0;
  if (fd >= 0) {
    close(fd);
  }
  return locked;
}

// Several files of one result. See output.h. The line of a file is added to the manifest before the
// file gets its final name, and the manifest is rewritten at the end. Therefore each file has a
// line in the manifest at any time, also if the process is killed.
#include "app/base/output_private.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LOCK_WAIT_MS = 10000, LOCK_STEP_MS = 20, MANIFEST_BYTES_MAX = 256 << 20 };

struct SbOutputFolder {
  char *path;
  int descriptor;      // locked
  char *manifest;      // its name in the folder, NULL without one
  GHashTable *former;  // name → lines' hashes (GPtrArray of char *), of the manifest as found
  GHashTable *written; // name → hash
  GArray *pending;     // of SbOutput
};

static bool fail(GError **error, const char *path, int code) {
  return sb_output_fail(error, SB_APP_ERROR_IO, path, g_strerror(code));
}

// SHA-256 of an open file, from its start; NULL if it cannot be read. Owned by the caller.
static char *hash_of(int fd) {
  GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
  guchar bytes[1 << 13];
  ssize_t got;
  for (off_t at = 0; (got = pread(fd, bytes, sizeof bytes, at)) > 0; at += got) {
    g_checksum_update(sum, bytes, got);
  }
  char *hash = got == 0 ? g_strdup(g_checksum_get_string(sum)) : NULL;
  g_checksum_free(sum);
  return hash;
}

// Lines that are none, such as one that a crash cut off, and names that lead elsewhere are left
// out.
static void read_manifest(SbOutputFolder *folder) {
  char *path = g_build_filename(folder->path, folder->manifest, NULL);
  int fd =
      openat(folder->descriptor, folder->manifest, O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  struct stat info;
  bool good = fd >= 0 && fstat(fd, &info) == 0 && S_ISREG(info.st_mode) &&
              info.st_size <= MANIFEST_BYTES_MAX;
  char *text = NULL;
  if (good && g_file_get_contents(path, &text, NULL, NULL)) {
    char **lines = g_strsplit(text, "\n", -1);
    for (char **line = lines; *line != NULL; line++) {
      enum { HASH = 64 };
      const char *name = *line + HASH + 2;
      if (strspn(*line, "0123456789abcdef") != HASH || strncmp(*line + HASH, "  ", 2) != 0 ||
          *name == '\0' || *name == '.' || strchr(name, '/') != NULL) {
        continue;
      }
      GPtrArray *hashes = g_hash_table_lookup(folder->former, name);
      if (hashes == NULL) {
        hashes = g_ptr_array_new_with_free_func(g_free);
        g_hash_table_insert(folder->former, g_strdup(name), hashes);
      }
      g_ptr_array_add(hashes, g_strndup(*line, HASH));
    }
    g_strfreev(lines);
  }
  g_free(text);
  g_free(path);
  if (fd >= 0) {
    close(fd);
  }
}

// Waits for the folder's lock; an errno.
static int lock(int fd) {
  for (gint64 begin = g_get_monotonic_time();;) {
    if (flock(fd, LOCK_EX | LOCK_NB) == 0) {
      return 0;
    }
    if ((errno != EWOULDBLOCK && errno != EINTR) ||
        g_get_monotonic_time() - begin >= 1000 * (gint64)LOCK_WAIT_MS) {
      return errno;
    }
    g_usleep(1000 * LOCK_STEP_MS);
  }
}

bool sb_output_folder_open(SbOutputFolder **out, const char *path, const char *command,
                           GError **error) {
  *out = NULL;
  if (g_mkdir_with_parents(path, 0777) != 0) {
    return fail(error, path, errno);
  }
  int fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  int code = fd >= 0 ? lock(fd) : errno;
  if (code != 0) {
    if (fd >= 0) {
      close(fd);
    }
    return code == EWOULDBLOCK ? sb_output_fail(error, SB_APP_ERROR_IO, path,
                                                "another run writes into this folder (waited 10 s)")
                               : fail(error, path, code);
  }
  SbOutputFolder *folder = g_new0(SbOutputFolder, 1);
  folder->path = g_strdup(path);
  folder->descriptor = fd;
  folder->former =
      g_hash_table_new_full(g_str_hash, g_str_equal, g_free, (GDestroyNotify)g_ptr_array_unref);
  folder->written = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
  folder->pending = g_array_new(FALSE, TRUE, sizeof(SbOutput));
  sb_output_sweep(fd);
  if (command != NULL) {
    folder->manifest = g_strdup_printf(".sealbench-%s.manifest", command);
    read_manifest(folder);
  }
  *out = folder;
  return true;
}

bool sb_output_folder_add(FILE **stream, SbOutputFolder *folder, const char *name, GError **error) {
  SbOutput file;
  g_autofree char *path = g_build_filename(folder->path, name, NULL);
  bool good = sb_output_begin_at(&file, path, false, false, error);
  if (good) {
    g_array_append_val(folder->pending, file);
    *stream = file.stream;
  }
  return good;
}

static void drop_pending(SbOutputFolder *folder) {
  for (guint i = 0; i < folder->pending->len; i++) {
    sb_output_abort(&g_array_index(folder->pending, SbOutput, i));
  }
  g_array_set_size(folder->pending, 0);
}

static void put_line(GString *text, const char *hash, const char *name) {
  g_string_append_printf(text, "%s  %s\n", hash, name);
}

// Adds lines to the manifest; an errno.
static int append_lines(const SbOutputFolder *folder, const GString *lines) {
  int fd = openat(folder->descriptor, folder->manifest,
                  O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (fd < 0) {
    return errno;
  }
  errno = ENOSPC; // of a short write
  int code = write(fd, lines->str, lines->len) == (ssize_t)lines->len ? 0 : errno;
  close(fd);
  return code;
}

bool sb_output_folder_commit(SbOutputFolder *folder, GError **error) {
  bool good = true;
  GString *lines = g_string_new("\n"); // a line that was cut off ends here
  for (guint i = 0; i < folder->pending->len && good; i++) {
    SbOutput *file = &g_array_index(folder->pending, SbOutput, i);
    good = sb_output_seal(file, error);
    char *hash = good && folder->manifest != NULL ? hash_of(fileno(file->stream)) : NULL;
    if (hash != NULL) {
      const char *name = strrchr(file->path, '/') + 1; // not what a symbolic link leads to
      put_line(lines, hash, name);
      g_hash_table_insert(folder->written, g_strdup(name), hash);
    }
  }
  if (good && folder->manifest != NULL) {
    int code = append_lines(folder, lines);
    good = code == 0 || fail(error, folder->path, code);
  }
  for (guint i = 0; i < folder->pending->len && good; i++) {
    good = sb_output_commit_sealed(&g_array_index(folder->pending, SbOutput, i), error);
  }
  g_string_free(lines, TRUE);
  drop_pending(folder);
  return good;
}

// Removes a file of the former result; false if it is another's now. One that is gone is fine.
static bool remove_former(const SbOutputFolder *folder, const char *name, const GPtrArray *hashes) {
  int fd = openat(folder->descriptor, name, O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) {
    return errno == ENOENT;
  }
  struct stat info;
  g_autofree char *hash = fstat(fd, &info) == 0 && S_ISREG(info.st_mode) ? hash_of(fd) : NULL;
  close(fd);
  bool ours = false;
  for (guint i = 0; i < hashes->len && hash != NULL; i++) {
    ours |= strcmp(hashes->pdata[i], hash) == 0;
  }
  return ours && unlinkat(folder->descriptor, name, 0) == 0;
}

static gint by_text(gconstpointer a, gconstpointer b) {
  return strcmp(*(const char *const *)a, *(const char *const *)b);
}

bool sb_output_folder_finish(SbOutputFolder *folder, GPtrArray *kept, GError **error) {
  if (folder->manifest == NULL || g_hash_table_size(folder->written) == 0 ||
      sb_output_keeps_existing()) {
    return true;
  }
  g_autoptr(GPtrArray) lines = g_ptr_array_new_with_free_func(g_free);
  GHashTableIter at;
  gpointer name;
  gpointer value;
  g_hash_table_iter_init(&at, folder->former);
  while (g_hash_table_iter_next(&at, &name, &value)) {
    if (g_hash_table_lookup(folder->written, name) == NULL && !remove_former(folder, name, value) &&
        kept != NULL) {
      g_ptr_array_add(kept, g_strdup(name));
    }
  }
  g_hash_table_iter_init(&at, folder->written);
  while (g_hash_table_iter_next(&at, &name, &value)) {
    g_ptr_array_add(lines, g_strconcat(name, "\n", value, NULL));
  }
  g_ptr_array_sort(lines, by_text);
  g_autoptr(GString) text = g_string_new(NULL);
  for (guint i = 0; i < lines->len; i++) {
    char *line = lines->pdata[i];
    char *hash = strchr(line, '\n');
    *hash = '\0';
    put_line(text, hash + 1, line);
  }
  if (kept != NULL) {
    g_ptr_array_sort(kept, by_text);
  }
  g_autofree char *path = g_build_filename(folder->path, folder->manifest, NULL);
  SbOutput file;
  bool good = sb_output_begin_at(&file, path, true, false, error);
  if (good) {
    fwrite(text->str, 1, text->len, file.stream);
    good = sb_output_commit(&file, error);
  }
  return good;
}

void sb_output_folder_close(SbOutputFolder *folder) {
  if (folder == NULL) {
    return;
  }
  drop_pending(folder);
  close(folder->descriptor);
  g_free(folder->path);
  g_free(folder->manifest);
  g_hash_table_unref(folder->former);
  g_hash_table_unref(folder->written);
  g_array_unref(folder->pending);
  g_free(folder);
}

bool sb_output_folder_add_text(SbOutputFolder *folder, const char *name, const char *text,
                               GError **error) {
  FILE *stream;
  return sb_output_folder_add(&stream, folder, name, error) && (fputs(text, stream), true);
}

bool sb_output_folder_write(const char *path, const char *command, SbOutputFill fill, void *data,
                            GPtrArray *kept, GError **error) {
  SbOutputFolder *folder;
  const bool good = sb_output_folder_open(&folder, path, command, error) &&
                    fill(folder, data, error) && sb_output_folder_commit(folder, error) &&
                    sb_output_folder_finish(folder, kept, error);
  sb_output_folder_close(folder);
  return good;
}

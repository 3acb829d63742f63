// Reads and scans key files from anywhere: sizes are bounded before reading, devices and folders
// refused, and every line that cannot be read is an issue.
#include "app/base/reader.h"

#include "app/base/error.h"
#include "app/base/output.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <poll.h>
#include <string.h>
#include <unistd.h>

static bool reads_pipes;

void sb_reader_read_pipes(void) {
  reads_pipes = true;
}

static void add_too_large(GPtrArray *issues, const char *shown, size_t bytes_max, double bytes) {
  const double mebibyte = 1 << 20;
  g_autofree char *allowed = g_strdup_printf("at most %.0f MiB", (double)bytes_max / mebibyte);
  sb_issues_add(issues, shown, 0, NULL, allowed, "is too large (%.1f MiB)", bytes / mebibyte);
}

static char *add_errno(GPtrArray *issues, const char *shown) {
  sb_issues_add(issues, shown, 0, NULL, NULL, "%s", g_strerror(errno));
  return NULL;
}

char *sb_reader_load_stream(size_t *length, int fd, const char *shown, size_t bytes_max,
                            GPtrArray *issues) {
  struct stat info = {0};
  bool file = fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
  size_t room = file && (guint64)info.st_size <= bytes_max ? (size_t)info.st_size + 2 : 4096;
  size_t count = 0;
  char *text = g_malloc(room);
  // A named pipe without a writer would read as empty.
  while (!file && S_ISFIFO(info.st_mode) && poll(&(struct pollfd){fd, POLLIN, 0}, 1, -1) < 0) {
  }
  // One byte more than allowed shows that there is more.
  while (count <= bytes_max) {
    if (count + 1 == room) {
      room = MIN(2 * room, bytes_max + 2);
      text = g_realloc(text, room);
    }
    ssize_t got = read(fd, text + count, room - 1 - count);
    if (got < 0 && errno == EAGAIN) {
      poll(&(struct pollfd){.fd = fd, .events = POLLIN}, 1, -1);
    } else if (got < 0 && errno != EINTR) {
      g_free(text);
      return add_errno(issues, shown);
    } else if (got == 0) {
      break;
    }
    count += got > 0 ? (size_t)got : 0;
  }
  if (count > bytes_max) {
    add_too_large(issues, shown, bytes_max, (double)count);
    g_free(text);
    return NULL;
  }
  text[count] = '\0';
  *length = count;
  return text;
}

int sb_reader_open(struct stat *info, const char *path, const char *shown, GPtrArray *issues) {
  // O_NONBLOCK: a pipe without a writer must not block the program.
  const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0 && *path == '\0') {
    sb_issues_add(issues, "\"\"", 0, NULL, NULL, "the name of the file is empty");
  } else if (fd < 0 || fstat(fd, info) != 0) {
    add_errno(issues, shown);
  } else if (S_ISDIR(info->st_mode)) {
    sb_issues_add(issues, shown, 0, NULL, NULL, "is a folder, not a file");
  } else if (!S_ISREG(info->st_mode) && !(reads_pipes && S_ISFIFO(info->st_mode))) {
    sb_issues_add(issues, shown, 0, NULL, NULL, "is not a regular file");
  } else {
    if (S_ISREG(info->st_mode)) {
      sb_output_note_input(info);
    }
    return fd;
  }
  if (fd >= 0) {
    close(fd);
  }
  return -1;
}

char *sb_reader_load(size_t *length, const char *path, const char *shown, size_t bytes_max,
                     GPtrArray *issues) {
  struct stat info;
  const int fd = sb_reader_open(&info, path, shown, issues);
  char *text = NULL;
  if (fd >= 0 && S_ISREG(info.st_mode) && (guint64)info.st_size > bytes_max) {
    add_too_large(issues, shown, bytes_max, (double)info.st_size);
  } else if (fd >= 0) {
    text = sb_reader_load_stream(length, fd, shown, bytes_max, issues);
  }
  if (fd >= 0) {
    close(fd);
  }
  return text;
}

char *sb_reader_load_file(size_t *length, const char *path, const char *shown, size_t bytes_max,
                          int code, GError **error) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  char *text = sb_reader_load(length, path, shown, bytes_max, issues);
  if (text == NULL) {
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    g_set_error_literal(error, SB_APP_ERROR, code, line);
  }
  return text;
}

char *sb_reader_folder(const char *path) {
  struct stat info;
  const bool stream = strcmp(path, "-") == 0 || g_str_has_prefix(path, "/dev/fd/") ||
                      strcmp(path, "/dev/stdin") == 0 ||
                      (stat(path, &info) == 0 && S_ISFIFO(info.st_mode));
  return stream ? NULL : g_path_get_dirname(path);
}

static void entry_free(gpointer data) {
  SbEntry *entry = data;
  g_free(entry->group);
  g_free(entry->name);
  g_free(entry->value);
  g_free(entry);
}

static void add_entry(GPtrArray *entries, const char *group, const char *name, const char *value,
                      int line) {
  SbEntry *entry = g_new0(SbEntry, 1);
  *entry = (SbEntry){g_strdup(group), g_strdup(name), g_strdup(value), line};
  g_ptr_array_add(entries, entry);
}

// Line number of byte `at`.
static int line_of(const char *text, const char *at) {
  int line = 1;
  for (const char *c = text; c < at; c++) {
    line += *c == '\n';
  }
  return line;
}

// Name of a "[group]" line, or NULL. Owned by the caller.
static char *group_name(const char *line) {
  size_t length = strlen(line);
  if (length < 3 || line[0] != '[' || line[length - 1] != ']') {
    return NULL;
  }
  char *name = g_strndup(line + 1, length - 2);
  if (strpbrk(name, "[]") != NULL) {
    g_clear_pointer(&name, g_free);
  }
  return name;
}

typedef struct {
  GPtrArray *entries, *issues;
  GHashTable *seen; // headings "[group]" and keys "group.key"
  const char *shown;
  char *group; // NULL: none yet
  bool skip;   // inside a group with an invalid heading
} Scan;

static void take_heading(Scan *scan, const char *line, int number) {
  g_free(scan->group);
  scan->group = group_name(line);
  scan->skip = scan->group == NULL;
  if (scan->skip) {
    sb_issues_add(scan->issues, scan->shown, number, NULL, NULL, "\"%s\" is not a [group]", line);
  } else if (!g_hash_table_add(scan->seen, g_strdup_printf("[%s]", scan->group))) {
    sb_issues_add(scan->issues, scan->shown, number, NULL, NULL, "group [%s] appears twice",
                  scan->group);
  } else {
    add_entry(scan->entries, scan->group, NULL, NULL, number);
  }
}

static void take_line(Scan *scan, char *line, int number) {
  char *equal = strchr(line, '=');
  if (*line == '[') {
    take_heading(scan, line, number);
  } else if (equal == NULL || equal == line) {
    sb_issues_add(scan->issues, scan->shown, number, NULL, NULL,
                  "\"%s\" is not \"key = value\" (is the file cut off?)", line);
  } else if (scan->skip) {
    // Already reported.
  } else if (scan->group == NULL) {
    sb_issues_add(scan->issues, scan->shown, number, NULL, NULL,
                  "a key is before the first [group]");
  } else {
    g_autofree char *name = g_strchomp(g_strndup(line, (size_t)(equal - line)));
    g_autofree char *key = g_strdup_printf("%s.%s", scan->group, name);
    if (!g_hash_table_add(scan->seen, g_strdup(key))) {
      sb_issues_add(scan->issues, scan->shown, number, key, NULL,
                    "is given twice (again on line %d)", number);
    } else {
      add_entry(scan->entries, scan->group, name, g_strchug(equal + 1), number);
    }
  }
}

GPtrArray *sb_reader_scan(const char *text, size_t length, const char *shown, GPtrArray *issues) {
  GPtrArray *entries = g_ptr_array_new_with_free_func(entry_free);
  // Text at all?
  const char *bad = NULL;
  if (memchr(text, '\0', length) != NULL) {
    sb_issues_add(issues, shown, 0, NULL, NULL, "is binary, not text");
    return entries;
  }
  if (!g_utf8_validate(text, (gssize)length, &bad)) {
    sb_issues_add(issues, shown, line_of(text, bad), NULL, NULL, "is not UTF-8 text");
    return entries;
  }
  g_autoptr(GHashTable) seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
  Scan scan = {.entries = entries, .issues = issues, .seen = seen, .shown = shown};
  g_autofree char *copy = g_strndup(text, length);
  const char *start = copy;
  if (length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) {
    start += 3;
  }
  for (int number = 1; *start != '\0'; number++) {
    const char *end = strchr(start, '\n');
    const size_t bytes = end != NULL ? (size_t)(end - start) : strlen(start);
    g_autofree char *line = g_strstrip(g_strndup(start, bytes));
    start += bytes + (end != NULL);
    if (*line != '\0' && *line != '#') {
      take_line(&scan, line, number);
    }
  }
  g_free(scan.group);
  return entries;
}

char *sb_reader_kind(bool *grouped, const char *text, size_t length) {
  *grouped = g_strstr_len(text, (gssize)length, "[sealbench]") != NULL;
  g_autoptr(GPtrArray) ignored = sb_issues_new();
  g_autoptr(GPtrArray) entries = sb_reader_scan(text, length, "", ignored);
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    *grouped = *grouped || entry->group != NULL;
    if (entry->name != NULL && strcmp(entry->group, "sealbench") == 0 &&
        strcmp(entry->name, "kind") == 0) {
      return g_strdup(entry->value);
    }
  }
  return NULL;
}

// The writer of all outputs: what a file keeps when it is replaced, what is refused, what becomes
// of files of an earlier result, of locks and of what killed processes leave.
#define _GNU_SOURCE // unshare
#include "app/base/output.h"
#include "app/base/reader.h"

#include <errno.h>
#include <fcntl.h>
#include <glib/gstdio.h>
#include <sched.h>
#include <signal.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char *folder;

static char *in_folder(const char *name) {
  return g_build_filename(folder, name, NULL);
}

static void put(const char *path, const char *text) {
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
}

static void check_text(const char *path, const char *expected) {
  char *text = NULL;
  GError *error = NULL;
  g_file_get_contents(path, &text, NULL, &error);
  g_assert_no_error(error);
  g_assert_cmpstr(text, ==, expected);
  g_free(text);
}

static void write_text(const char *path, const char *text) {
  GError *error = NULL;
  sb_output_write(path, text, strlen(text), &error);
  g_assert_no_error(error);
}

static void write_fails(const char *path, SbAppError code, const char *says) {
  GError *error = NULL;
  g_assert_false(sb_output_write(path, "new", 3, &error));
  g_assert_error(error, SB_APP_ERROR, (int)code);
  g_assert_nonnull(strstr(error->message, says));
  g_error_free(error);
}

static gint by_name(gconstpointer a, gconstpointer b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

// Names in `path` in one line, hidden ones too.
static char *listing(const char *path) {
  g_autoptr(GPtrArray) names = g_ptr_array_new_with_free_func(g_free);
  g_autoptr(GDir) dir = g_dir_open(path, 0, NULL);
  g_assert_nonnull(dir);
  for (const char *name; (name = g_dir_read_name(dir)) != NULL;) {
    g_ptr_array_add(names, g_strdup(name));
  }
  g_ptr_array_sort(names, by_name);
  g_ptr_array_add(names, NULL);
  return g_strjoinv(" ", (char **)names->pdata);
}

static void check_listing(const char *path, const char *expected) {
  g_autofree char *names = listing(path);
  g_assert_cmpstr(names, ==, expected);
}

static void set_up(void) {
  folder = g_dir_make_tmp("sealbench-output-XXXXXX", NULL);
}

static void remove_all(const char *path) {
  GDir *dir = g_dir_open(path, 0, NULL);
  for (const char *name; dir != NULL && (name = g_dir_read_name(dir)) != NULL;) {
    g_autofree char *inner = g_build_filename(path, name, NULL);
    remove_all(inner);
  }
  if (dir != NULL) {
    g_dir_close(dir);
  }
  g_remove(path);
}

static void tear_down(void) {
  sb_output_keep_existing(false);
  remove_all(folder);
  g_clear_pointer(&folder, g_free);
}

// Mode and owner, symbolic and hard links outlast being written to; new files follow the mask.
static void test_replacing(void) {
  set_up();
  g_autofree char *file = in_folder("file");
  g_autofree char *link = in_folder("link");
  g_autofree char *other = in_folder("other");
  g_autofree char *away = in_folder("away");
  mode_t mask = umask(027);
  write_text(file, "1");
  umask(mask);
  struct stat info;
  g_assert_cmpint(stat(file, &info), ==, 0);
  g_assert_cmpint(info.st_mode & 07777, ==, 0640);
  g_assert_cmpint(chmod(file, 0604), ==, 0);
  if (geteuid() == 0) {
    g_assert_cmpint(chown(file, 1234, 4321), ==, 0);
  }
  write_text(file, "two");
  check_text(file, "two");
  g_assert_cmpint(stat(file, &info), ==, 0);
  g_assert_cmpint(info.st_mode & 07777, ==, 0604);
  if (geteuid() == 0) {
    g_assert_cmpint(info.st_uid, ==, 1234);
    g_assert_cmpint(info.st_gid, ==, 4321);
  }

  // Relative and from elsewhere; a target that is not there yet.
  g_assert_cmpint(symlink("file", link), ==, 0);
  write_text(link, "three");
  g_assert_true(g_file_test(link, G_FILE_TEST_IS_SYMLINK));
  check_text(file, "three");
  g_assert_cmpint(unlink(file), ==, 0);
  write_text(link, "four");
  g_assert_true(g_file_test(link, G_FILE_TEST_IS_SYMLINK));
  check_text(file, "four");

  // Both names show the new text, whether it grows or shrinks.
  g_assert_cmpint(linkat(AT_FDCWD, file, AT_FDCWD, other, 0), ==, 0);
  static const char *const texts[] = {"a text that is longer", "short"};
  for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
    write_text(other, texts[i]);
    check_text(file, texts[i]);
    check_text(other, texts[i]);
  }
  g_assert_cmpint(stat(file, &info), ==, 0);
  g_assert_cmpint(info.st_nlink, ==, 2);

  g_assert_cmpint(symlink("away", away), ==, 0);
  write_fails(away, SB_APP_ERROR_IO, g_strerror(ELOOP));
  check_listing(folder, "away file link other");
  tear_down();
}

// The longest name there can be, in the longest path.
static void test_long_names(void) {
  set_up();
  char name[256];
  memset(name, 'n', 255);
  name[255] = '\0';
  g_autofree char *file = in_folder(name);
  write_text(file, "long");
  check_text(file, "long");
  write_text(file, "longer");
  check_text(file, "longer");
  check_listing(folder, name);
  tear_down();
}

static void test_streams(void) {
  set_up();
  write_fails("/dev/full", SB_APP_ERROR_IO, g_strerror(ENOSPC));
  write_fails(folder, SB_APP_ERROR_IO, g_strerror(EISDIR));
  write_text("/dev/null", "nothing");
  g_assert_true(g_file_test("/dev/null", G_FILE_TEST_EXISTS));
  g_autofree char *pipe = in_folder("pipe");
  g_assert_cmpint(mkfifo(pipe, 0600), ==, 0);
  int reader = open(pipe, O_RDONLY | O_NONBLOCK);
  write_text(pipe, "through");
  char text[16] = "";
  g_assert_cmpint(read(reader, text, sizeof text), ==, 7);
  g_assert_cmpstr(text, ==, "through");
  close(reader);
  check_listing(folder, "pipe");
  tear_down();
}

// What a killed process left goes with the next write; what a living one writes stays.
static void test_left_behind(void) {
  set_up();
  g_autofree char *dead = in_folder(".sealbench-0123456789abcdef.part");
  g_autofree char *alive = in_folder(".sealbench-fedcba9876543210.part");
  g_autofree char *trap = in_folder(".sealbench-00000000deadbeef.part");
  g_autofree char *file = in_folder("file");
  put(dead, "half");
  put(alive, "half");
  g_assert_cmpint(mkfifo(trap, 0600), ==, 0); // must not be waited for
  int fd = open(alive, O_RDONLY);
  g_assert_cmpint(flock(fd, LOCK_EX), ==, 0);
  write_text(file, "text");
  check_listing(folder, ".sealbench-fedcba9876543210.part file");
  close(fd);
  write_text(file, "text");
  check_listing(folder, "file");
  tear_down();
}

// A file system that makes no files without a name, or no /proc: the same outcome.
static void test_named(void) {
  set_up();
  g_autofree char *file = in_folder("file");
  g_autofree char *other = in_folder("other");
  put(file, "old");
  pid_t child = fork();
  if (child == 0) {
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", "none", MS_REC | MS_PRIVATE, NULL) != 0 ||
        mount("none", "/proc", "tmpfs", 0, "") != 0) {
      _exit(77);
    }
    SbOutput output;
    bool good = sb_output_begin(&output, file, NULL) && output.temporary != NULL;
    good = good && g_file_test(output.written_at, G_FILE_TEST_EXISTS);
    fputs("new", output.stream);
    good = good && sb_output_commit(&output, NULL) && sb_output_begin(&output, other, NULL);
    sb_output_abort(&output);
    _exit(good ? 0 : 1);
  }
  int status = 0;
  g_assert_cmpint(waitpid(child, &status, 0), ==, child);
  g_assert_true(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) {
    g_test_skip("no mount namespace here");
  } else {
    g_assert_cmpint(WEXITSTATUS(status), ==, 0);
    check_text(file, "new");
    check_listing(folder, "file");
  }
  tear_down();
}

// A disk without room for the longer text keeps the shorter one, under both its names.
static void test_full_disk(void) {
  set_up();
  g_autofree char *disk = in_folder("disk");
  g_assert_cmpint(g_mkdir(disk, 0700), ==, 0);
  if (mount("none", disk, "tmpfs", 0, "size=64k") != 0) {
    g_test_skip("mounting a tmpfs is not permitted here");
  } else {
    g_autofree char *file = g_build_filename(disk, "file", NULL);
    g_autofree char *other = g_build_filename(disk, "other", NULL);
    put(file, "earlier");
    g_assert_cmpint(link(file, other), ==, 0);
    char *large = g_strnfill(48 << 10, 'x');
    GError *error = NULL;
    g_assert_false(sb_output_write(file, large, strlen(large), &error));
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_IO);
    g_assert_nonnull(strstr(error->message, g_strerror(ENOSPC)));
    g_clear_error(&error);
    g_free(large);
    char *now = NULL;
    g_file_get_contents(file, &now, NULL, NULL);
    g_autofree char *names = listing(disk);
    umount(disk);
    g_assert_cmpstr(now, ==, "earlier");
    g_assert_cmpstr(names, ==, "file other");
    g_free(now);
  }
  tear_down();
}

// ---- Inputs, policies ----

static void check_refused(SbOutputCheck *check, const char *path, SbAppError code,
                          const char *says) {
  GError *error = NULL;
  g_assert_false(sb_output_check(check, path, false, &error));
  g_assert_error(error, SB_APP_ERROR, (int)code);
  g_assert_nonnull(strstr(error->message, says));
  g_error_free(error);
}

static void test_inputs(void) {
  set_up();
  sb_output_protect_inputs();
  g_autofree char *input = in_folder("input");
  g_autofree char *link_path = in_folder("link");
  g_autofree char *other = in_folder("other");
  g_autofree char *fresh = in_folder("fresh");
  g_autofree char *again = g_build_filename(folder, ".", "fresh", NULL);
  g_autofree char *deep = g_build_filename(folder, "a", "b", "c", NULL);
  put(input, "input");
  g_assert_cmpint(symlink("input", link_path), ==, 0);
  g_assert_cmpint(link(input, other), ==, 0);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  size_t length = 0;
  g_free(sb_reader_load(&length, input, input, 100, issues));
  g_assert_cmpuint(issues->len, ==, 0);
  const char *const names[] = {input, link_path, other};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    SbOutputCheck check = {0};
    check_refused(&check, names[i], SB_APP_ERROR_INPUT, "is an input");
    write_fails(names[i], SB_APP_ERROR_INPUT, "is an input");
    sb_output_check_clear(&check);
  }
  check_text(input, "input");

  SbOutputCheck check = {0};
  GError *error = NULL;
  g_assert_true(sb_output_check(&check, fresh, false, &error));
  check_refused(&check, again, SB_APP_ERROR_INPUT, "two outputs");
  check_refused(&check, deep, SB_APP_ERROR_IO, g_strerror(ENOENT));
  g_assert_true(sb_output_check(&check, deep, true, &error));
  g_assert_true(sb_output_check(&check, "-", false, &error));
  g_assert_true(sb_output_check(&check, "-", false, &error));
  g_assert_true(sb_output_check(&check, NULL, false, &error));
  check_refused(&check, folder, SB_APP_ERROR_IO, g_strerror(EISDIR));
  check_refused(&check, "/proc/none", SB_APP_ERROR_IO, "");
  sb_output_check_clear(&check);
  check_listing(folder, "input link other"); // nothing was made

  write_text(fresh, "1");
  sb_output_keep_existing(true);
  check_refused(&check, fresh, SB_APP_ERROR_INPUT, "exists already");
  write_fails(fresh, SB_APP_ERROR_INPUT, "exists already");
  sb_output_check_clear(&check);
  check_text(fresh, "1");
  tear_down();
}

// ---- Folders ----

// One result of the files in `names` (separated by blanks), each holding `text`. Returns the names
// of those kept.
static char *make_result(const char *path, const char *names, const char *text, bool finish) {
  SbOutputFolder *out;
  GError *error = NULL;
  sb_output_folder_open(&out, path, "test", &error);
  g_assert_no_error(error);
  g_auto(GStrv) list = g_strsplit(names, " ", -1);
  for (char **name = list; *name != NULL; name++) {
    FILE *stream;
    g_assert_true(sb_output_folder_add(&stream, out, *name, &error));
    fputs(text, stream);
  }
  g_assert_true(sb_output_folder_commit(out, &error));
  g_autoptr(GPtrArray) kept = g_ptr_array_new_with_free_func(g_free);
  if (finish) {
    g_assert_true(sb_output_folder_finish(out, kept, &error));
  }
  sb_output_folder_close(out);
  g_ptr_array_add(kept, NULL);
  return g_strjoinv(" ", (char **)kept->pdata);
}

#define RESULT(path, names, text, kept_names)                                                      \
  {                                                                                                \
    g_autofree char *kept_ = make_result(path, names, text, true);                                 \
    g_assert_cmpstr(kept_, ==, kept_names);                                                        \
  }

static void test_manifest(void) {
  set_up();
  g_autofree char *where = g_build_filename(folder, "new", "results", NULL);
  g_autofree char *b = g_build_filename(where, "b", NULL);
  g_autofree char *c = g_build_filename(where, "c", NULL);
  g_autofree char *own = g_build_filename(where, "own", NULL);
  RESULT(where, "a b c", "first", "");
  put(own, "the user's");
  check_listing(where, ".sealbench-test.manifest a b c own");
  // Unchanged ones go, changed ones stay and are named, others' are not looked at.
  put(b, "edited");
  RESULT(where, "a", "second", "b");
  check_listing(where, ".sealbench-test.manifest a b own");
  check_text(b, "edited");
  // From then on it is the user's.
  RESULT(where, "a c", "third", "");
  check_listing(where, ".sealbench-test.manifest a b c own");

  // A result that was killed before its end: its files and those before it are known still.
  g_free(make_result(where, "a d", "fourth", false));
  check_listing(where, ".sealbench-test.manifest a b c d own");
  RESULT(where, "a", "fifth", "");
  check_listing(where, ".sealbench-test.manifest a b own");

  // What a manifest says of other folders and hidden files is not believed.
  g_autofree char *manifest = g_build_filename(where, ".sealbench-test.manifest", NULL);
  g_autofree char *outside = in_folder("outside");
  g_autofree char *sum = g_compute_checksum_for_string(G_CHECKSUM_SHA256, "kept", -1);
  g_autofree char *lines =
      g_strdup_printf("%s  ../../outside\n%s  .hidden\n%s  \n%.30s", sum, sum, sum, sum);
  g_autofree char *hidden = g_build_filename(where, ".hidden", NULL);
  put(outside, "kept");
  put(hidden, "kept");
  put(manifest, lines);
  RESULT(where, "a", "sixth", "");
  check_text(outside, "kept");
  check_text(hidden, "kept");
  g_unlink(hidden);

  // A symbolic link in the folder is written through and known by its own name.
  g_assert_cmpint(symlink("../../outside", c), ==, 0);
  RESULT(where, "a c", "seventh", "");
  check_text(outside, "seventh");
  RESULT(where, "a", "eighth", "c");
  check_listing(where, ".sealbench-test.manifest a b c own");

  // All or none.
  SbOutputFolder *out;
  FILE *stream;
  g_assert_true(sb_output_folder_open(&out, where, "test", NULL));
  g_assert_true(sb_output_folder_add(&stream, out, "a", NULL));
  fputs("ninth", stream);
  sb_output_folder_close(out);
  g_autofree char *a = g_build_filename(where, "a", NULL);
  check_text(a, "eighth");
  tear_down();
}

// A process that holds the folder's lock until it is killed.
static pid_t hold(const char *path) {
  int ready[2];
  g_assert_cmpint(pipe(ready), ==, 0);
  pid_t child = fork();
  if (child == 0) {
    SbOutputFolder *out;
    bool good = sb_output_folder_open(&out, path, "test", NULL);
    _exit(good && write(ready[1], "", 1) == 1 && pause() == 0 ? 0 : 1);
  }
  char byte;
  g_assert_cmpint(read(ready[0], &byte, 1), ==, 1);
  close(ready[0]);
  close(ready[1]);
  return child;
}

static gpointer end_later(gpointer data) {
  g_usleep(300000);
  kill(GPOINTER_TO_INT(data), SIGKILL);
  return NULL;
}

// A folder is waited for, not for ever, and free when its writer dies.
static void test_lock(void) {
  set_up();
  pid_t child = hold(folder);
  GThread *thread = g_thread_new("end", end_later, GINT_TO_POINTER(child));
  gint64 begin = g_get_monotonic_time();
  RESULT(folder, "a", "text", "");
  g_assert_cmpint(g_get_monotonic_time() - begin, >, 250000);
  g_thread_join(thread);
  waitpid(child, NULL, 0);
  if (g_test_slow()) {
    child = hold(folder);
    SbOutputFolder *out;
    GError *error = NULL;
    begin = g_get_monotonic_time();
    g_assert_false(sb_output_folder_open(&out, folder, "test", &error));
    gint64 waited = g_get_monotonic_time() - begin;
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_IO);
    g_assert_nonnull(strstr(error->message, "another run writes into this folder"));
    g_clear_error(&error);
    g_assert_cmpint(waited, >=, 10 * G_USEC_PER_SEC);
    g_assert_cmpint(waited, <, 20 * G_USEC_PER_SEC);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
  }
  tear_down();
}

// A file in use is known as such from anywhere, replaced or not, until its writer ends.
static void test_in_use(void) {
  set_up();
  g_autofree char *file = in_folder("file");
  int lock[2];
  g_assert_false(sb_output_is_locked(file));
  for (int i = 0; i < 2; i++) {
    g_assert_true(sb_output_write_locked(&lock[i], file, "text", 4, NULL));
    g_assert_true(sb_output_is_locked(file));
  }
  close(lock[0]); // of what was replaced
  g_assert_true(sb_output_is_locked(file));
  close(lock[1]);
  g_assert_false(sb_output_is_locked(file));
  tear_down();
}

static void test_endings(void) {
  g_assert_true(sb_output_ends_in("a.PNG", ".png"));
  g_assert_true(sb_output_ends_in("b.Mp4", ".mp4"));
  g_assert_false(sb_output_ends_in("png", ".png"));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  signal(SIGPIPE, SIG_IGN);
  g_test_add_func("/output/replacing", test_replacing);
  g_test_add_func("/output/long-names", test_long_names);
  g_test_add_func("/output/streams", test_streams);
  g_test_add_func("/output/left-behind", test_left_behind);
  g_test_add_func("/output/named", test_named);
  g_test_add_func("/output/full-disk", test_full_disk);
  g_test_add_func("/output/manifest", test_manifest);
  g_test_add_func("/output/lock", test_lock);
  g_test_add_func("/output/in-use", test_in_use);
  g_test_add_func("/output/endings", test_endings);
  g_test_add_func("/output/inputs", test_inputs);
  return g_test_run();
}

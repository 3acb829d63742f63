// What ships with the program; see the header.
#include "app/document/shipped.h"

#include "app/base/issue.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// Returns the path of `name` (`whole`) or the folder that contains it, from the first of `places`,
// relative to the folder `in`, that has it; NULL if there is none. Owned by the caller (g_free).
static char *find_from(const char *in, const char *const *places, const char *name, bool whole) {
  for (; *places != NULL; places++) {
    g_autofree char *there = g_build_filename(in, *places, NULL);
    g_autofree char *path = g_build_filename(there, name, NULL);
    if (g_file_test(path, G_FILE_TEST_EXISTS)) {
      return g_canonicalize_filename(whole ? path : there, NULL);
    }
  }
  return NULL;
}

// The same search, relative to the folder of the running program.
static char *find_shipped(const char *const *places, const char *name, bool whole) {
  g_autofree char *program = g_file_read_link("/proc/self/exe", NULL);
  g_autofree char *in = g_path_get_dirname(program != NULL ? program : "/");
  return find_from(in, places, name, whole);
}

// Folder of the shared library that contains this code, with its links resolved; NULL in a program.
// Written once by sb_shipped_set_library(), before any other call.
static char *library_folder;

void sb_shipped_set_library(const char *path) {
  g_autofree char *real = realpath(path, NULL);
  library_folder = real != NULL ? g_path_get_dirname(real) : NULL;
}

char *sb_shipped_folder(void) {
  static const char *const places[] = {"../share/sealbench", "../assets", "../../assets", NULL};
  // A library is installed in lib/ or lib/MACHINE/; the build has it in app/library/.
  static const char *const library_places[] = {"../share/sealbench", "../../share/sealbench",
                                               "../../../assets", NULL};
  return library_folder != NULL ? find_from(library_folder, library_places, "scenes", false)
                                : find_shipped(places, "scenes", false);
}

char *sb_shipped_study(const char *name) {
  // The last is that of tests.
  static const char *const places[] = {"../share/sealbench/studies", "../assets/studies",
                                       "../../assets/studies", "../../../assets/studies", NULL};
  g_autofree char *file = g_strconcat(name, ".study", NULL);
  return find_shipped(places, file, true);
}

char *sb_shipped_thesis(void) {
  static const char *const places[] = {"../share/sealbench/thesis", "../assets/thesis",
                                       "../../assets/thesis", "../../../assets/thesis", NULL};
  return find_shipped(places, "valve.scene", false);
}

typedef struct {
  const char *folder, *ending;
} Kind;

static const Kind kinds[SB_SHIPPED_KINDS] = {[SB_SHIPPED_SCENES] = {"scenes", ".scene"},
                                             [SB_SHIPPED_VALVES] = {"valves", ".valve"},
                                             [SB_SHIPPED_STUDIES] = {"studies", ".study"},
                                             [SB_SHIPPED_RUBBERS] = {"rubbers", ".rubber"},
                                             [SB_SHIPPED_EXAMPLES] = {"examples", ""}};

// Title that titles.ini in the folder of `path` gives to it; NULL if the file has none, and so is
// no example. Owned by the caller.
static char *example_title(const char *path) {
  g_autoptr(GKeyFile) keys = g_key_file_new();
  g_autofree char *folder = g_path_get_dirname(path), *name = g_path_get_basename(path);
  g_autofree char *file = g_build_filename(folder, "titles.ini", NULL);
  return g_key_file_load_from_file(keys, file, G_KEY_FILE_NONE, NULL)
             ? g_key_file_get_string(keys, "titles", name, NULL)
             : NULL;
}

// Whether `path` in the folder of a kind is a file of that kind.
static bool is_of_kind(const char *path, SbShippedKind kind) {
  if (kind == SB_SHIPPED_EXAMPLES) {
    g_autofree char *title = example_title(path);
    return title != NULL;
  }
  return g_str_has_suffix(path, kinds[kind].ending);
}

const char *sb_shipped_kind_name(SbShippedKind kind) {
  return kinds[kind].folder;
}

// Folder of a kind's files; NULL if there is none. Owned by the caller.
static char *kind_folder(SbShippedKind kind) {
  g_autofree char *folder = sb_shipped_folder();
  return folder != NULL ? g_build_filename(folder, kinds[kind].folder, NULL) : NULL;
}

char *sb_shipped_find(const char *name, unsigned wanted) {
  if (*name == '\0' || strchr(name, G_DIR_SEPARATOR) != NULL) {
    return NULL;
  }
  for (int i = 0; i < SB_SHIPPED_KINDS; i++) {
    g_autofree char *folder = (wanted >> i & 1) != 0 ? kind_folder((SbShippedKind)i) : NULL;
    g_autofree char *file = g_strconcat(name, kinds[i].ending, NULL);
    g_autofree char *path = folder != NULL ? g_build_filename(folder, file, NULL) : NULL;
    if (path != NULL && g_file_test(path, G_FILE_TEST_IS_REGULAR) &&
        is_of_kind(path, (SbShippedKind)i)) {
      return g_steal_pointer(&path);
    }
  }
  return NULL;
}

bool sb_shipped_has_ending(const char *name, unsigned wanted) {
  for (int i = 0; i < SB_SHIPPED_KINDS; i++) {
    if ((wanted >> i & 1) != 0 && *kinds[i].ending != '\0' &&
        g_str_has_suffix(name, kinds[i].ending)) {
      return true;
    }
  }
  return false;
}

char *sb_shipped_resolve(const char *operand, unsigned wanted) {
  // A link that leads nowhere is the user's own file too: its error is reported.
  struct stat info;
  const bool own = strcmp(operand, "-") == 0 ||
                   (lstat(operand, &info) == 0 && !g_file_test(operand, G_FILE_TEST_IS_DIR));
  char *shipped = own ? NULL : sb_shipped_find(operand, wanted);
  return shipped != NULL ? shipped : g_strdup(operand);
}

char *sb_shipped_runs(void) {
  static const char *const places[] = {"../share/sealbench/runs", ".", "..", NULL};
  return find_shipped(places, "piston.run", false);
}

GPtrArray *sb_shipped_files(SbShippedKind kind) {
  GPtrArray *out = g_ptr_array_new_with_free_func(g_free);
  g_autofree char *folder = kind_folder(kind);
  g_autoptr(GDir) dir = folder != NULL ? g_dir_open(folder, 0, NULL) : NULL;
  for (const char *name; dir != NULL && (name = g_dir_read_name(dir)) != NULL;) {
    g_autofree char *path = g_build_filename(folder, name, NULL);
    if (is_of_kind(path, kind)) {
      g_ptr_array_add(out, g_steal_pointer(&path));
    }
  }
  g_ptr_array_sort(out, sb_note_compare);
  return out;
}

char *sb_shipped_name(const char *path, SbShippedKind kind) {
  char *name = g_path_get_basename(path);
  name[strlen(name) - strlen(kinds[kind].ending)] = '\0';
  return name;
}

char *sb_shipped_title(const char *path) {
  char *title = example_title(path); // first: an example may be a long file of another kind
  if (title == NULL) {
    g_autoptr(GKeyFile) keys = g_key_file_new();
    g_key_file_load_from_file(keys, path, G_KEY_FILE_NONE, NULL);
    title = g_key_file_get_string(keys, "sealbench", "title", NULL);
  }
  return title != NULL ? title : g_path_get_basename(path);
}

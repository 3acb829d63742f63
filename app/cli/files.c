// The files of a command that takes several: opened before anything is computed, worked on one
// after the other. A file with a problem does not stop the others; the exit code is the highest.
#include "app/cli/cli.h"

#include "app/base/output.h"
#include "app/document/shipped.h"

#include <string.h>

// What a file's folder below -o is called: its name without the ending.
static char *folder_name(const char *path) {
  if (strcmp(path, "-") == 0) {
    return g_strdup("standard-input");
  }
  char *name = g_path_get_basename(path);
  static const char *const endings[] = {".scene", ".valve", ".project", ".png"};
  for (size_t i = 0; i < G_N_ELEMENTS(endings); i++) {
    size_t length = strlen(name), tail = strlen(endings[i]);
    // "..scene" stays as it is: "." and ".." are other folders.
    if (sb_output_ends_in(name, endings[i]) && strspn(name, ".") < length - tail) {
      name[length - tail] = '\0';
      break;
    }
  }
  return name;
}

// Whether the files can be told apart; an exit code.
static int refuse_twins(const SbCliFiles *files, bool in_folders) {
  const SbCliFile *stream = NULL;
  g_autoptr(GHashTable) seen = g_hash_table_new(g_str_hash, g_str_equal);
  for (int i = 0; i < files->count; i++) {
    const SbCliFile *file = &files->file[i];
    if (strcmp(file->path, "-") == 0 && stream != NULL) {
      return sb_cli_fail("-: standard input can be only one of the files");
    }
    stream = strcmp(file->path, "-") == 0 ? file : stream;
    const SbCliFile *twin = g_hash_table_lookup(seen, file->name);
    if (in_folders && twin != NULL) {
      return sb_cli_fail("-o: %s and %s would both be written to %s", twin->path, file->path,
                         file->folder);
    }
    g_hash_table_insert(seen, file->name, (gpointer)file);
  }
  return SB_EXIT_DONE;
}

// Opens the operands. Returns false if no file is sound or two would be written to one place;
// files->code is then the exit code.
static bool open_files(SbCliFiles *files, int argc, char **argv, char **settings,
                       const char *folder) {
  *files = (SbCliFiles){.count = argc - 1, .at = -1};
  files->file = g_new0(SbCliFile, files->count);
  files->json = g_ptr_array_new_with_free_func(g_free);
  for (int i = 0; i < files->count; i++) {
    files->file[i].path = argv[i + 1];
    files->file[i].full = sb_cli_full_path(argv[i + 1], SB_SHIPPED_FOR_RUN);
    files->file[i].name = folder_name(argv[i + 1]);
    if (folder != NULL) {
      files->file[i].folder =
          files->count > 1 ? g_build_filename(folder, files->file[i].name, NULL) : g_strdup(folder);
    }
  }
  files->code = refuse_twins(files, folder != NULL && files->count > 1);
  if (files->code != SB_EXIT_DONE) {
    return false;
  }
  bool any = false;
  for (int i = 0; i < files->count; i++) {
    SbCliFile *file = &files->file[i];
    file->document = sb_cli_open(&file->model, file->path, settings);
    files->code = file->document == NULL ? SB_EXIT_INPUT : files->code;
    any |= file->document != NULL;
  }
  return any;
}

static void close_files(SbCliFiles *files) {
  sb_cli_name_file(NULL);
  for (int i = 0; i < files->count; i++) {
    SbCliFile *file = &files->file[i];
    sb_document_free(file->document);
    sb_model_destroy(file->model);
    g_free(file->full);
    g_free(file->name);
    g_free(file->folder);
  }
  g_free(files->file);
  g_ptr_array_unref(files->json);
}

// Returns the next sound file; NULL after the last one and after an interrupt.
static SbCliFile *next_file(SbCliFiles *files) {
  while (!sb_cli_interrupted(NULL) && ++files->at < files->count) {
    SbCliFile *file = &files->file[files->at];
    if (file->document != NULL) {
      sb_cli_name_file(files->count > 1 ? file->path : NULL);
      return file;
    }
  }
  sb_cli_name_file(NULL);
  int left = 0;
  for (int i = files->at + 1; i < files->count; i++) {
    left += files->file[i].document != NULL;
  }
  if (left > 0) {
    sb_cli_fail("interrupted: %d of %d files were not begun", left, files->count);
  }
  return NULL;
}

void sb_cli_files_head(SbCliFiles *files) {
  if (files->count > 1) {
    const char *path = files->file[files->at].path;
    g_autofree char *shown = sb_printable(path, strlen(path));
    printf("%s%s:\n", files->heads++ > 0 ? "\n" : "", shown);
  }
}

// Writes the documents: that of the only operand, or an array of them. An exit code.
static int emit_file(const GPtrArray *json, int count, const char *target) {
  if (target == NULL || json->len == 0) {
    return SB_EXIT_DONE;
  }
  if (count == 1) {
    return sb_cli_emit(json->pdata[0], target);
  }
  // Strings hold no line ends: each of those begins a line of the document.
  g_autoptr(GString) text = g_string_new("[");
  for (guint i = 0; i < json->len; i++) {
    g_auto(GStrv) lines = g_strsplit(g_strchomp(json->pdata[i]), "\n", -1);
    g_autofree char *inside = g_strjoinv("\n  ", lines);
    g_string_append_printf(text, "%s\n  %s", i > 0 ? "," : "", inside);
  }
  g_string_append(text, "\n]\n");
  return sb_cli_emit(text->str, target);
}

int sb_cli_files_run(int argc, char **argv, const SbCliFilesWork *work) {
  SbCliFiles files;
  if (open_files(&files, argc, argv, work->settings, work->folder)) {
    const int checked = work->check != NULL ? work->check(&files, work->data)
                                            : sb_cli_check_outputs(NULL, NULL, work->json);
    files.code = MAX(files.code, checked);
    for (const SbCliFile *file; checked == SB_EXIT_DONE && (file = next_file(&files)) != NULL;) {
      const int code = work->work(&files, file, work->data);
      files.code = MAX(files.code, code);
    }
    const int written = emit_file(files.json, files.count, work->json);
    files.code = MAX(files.code, written);
  }
  close_files(&files);
  return files.code;
}

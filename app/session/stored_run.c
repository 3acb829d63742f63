// A header of lines, an empty line, and the engine's bytes (sb_run_pack()). See stored_run.h.
#include "app/session/stored_run.h"

#include "app/base/output.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { HEAD_MAX = 512 };
static const char TITLE[] = "sealbench kept run 2";

SbPlanWishes sb_stored_run_wishes(void) {
  return (SbPlanWishes){.views = SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES | SB_VIEW_SECTION,
                        .life = true};
}

// Without the date: all that must be the same. The sum is against damage, not against intent, and a
// session waits for it: GLib's MD5 takes a fifth of the time of its SHA-256.
static char *head_new(const char *hash, const void *bytes, size_t size) {
  g_autofree char *sum = g_compute_checksum_for_data(G_CHECKSUM_MD5, bytes, size);
  return g_strdup_printf("%s\nengine %s\nvalues %s\nchecksum %s\n", TITLE,
                         sb_engine_identity()->source, hash, sum);
}

static char *today(void) {
  const char *fixed = g_getenv("SOURCE_DATE_EPOCH");
  g_autoptr(GDateTime) now = fixed != NULL
                                 ? g_date_time_new_from_unix_utc(g_ascii_strtoll(fixed, NULL, 10))
                                 : g_date_time_new_now_local();
  return now != NULL ? g_date_time_format(now, "%Y-%m-%d") : g_strdup("");
}

bool sb_stored_run_write(const char *path, const SbDocument *document, const SbRun *run,
                         GError **error) {
  void *bytes;
  size_t size;
  SbReport report;
  if (sb_run_pack(&bytes, &size, run, &report) != SB_OK) {
    g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, report.text);
    return false;
  }
  g_autofree char *hash = sb_document_sha256(document);
  g_autofree char *head = head_new(hash, bytes, size), *date = today();
  g_autoptr(GByteArray) text = g_byte_array_new();
  g_autofree char *end = g_strdup_printf("date %s\n\n", date);
  g_byte_array_append(text, (const guint8 *)head, (guint)strlen(head));
  g_byte_array_append(text, (const guint8 *)end, (guint)strlen(end));
  g_byte_array_append(text, bytes, (guint)size);
  free(bytes);
  return sb_output_write(path, text->data, text->len, error);
}

// The run of one file, NULL if it does not fit.
static SbRunHandle *read_one(char **date, const char *path, const char *hash,
                             const SbModel *model) {
  g_autoptr(GMappedFile) file = g_mapped_file_new(path, FALSE, NULL);
  const char *text = file != NULL ? g_mapped_file_get_contents(file) : NULL;
  const size_t length = text != NULL ? g_mapped_file_get_length(file) : 0;
  const char *gap = text != NULL ? g_strstr_len(text, (gssize)MIN(length, HEAD_MAX), "\n\n") : NULL;
  g_autofree char *engine =
      g_strdup_printf("%s\nengine %s\nvalues %s\n", TITLE, sb_engine_identity()->source, hash);
  // What most files fail by comes before the sum over all of the bytes.
  if (gap == NULL || strlen(engine) > length || memcmp(text, engine, strlen(engine)) != 0) {
    return NULL;
  }
  const char *bytes = gap + 2;
  const size_t size = length - (size_t)(bytes - text);
  g_autofree char *head = head_new(hash, bytes, size);
  const size_t before = strlen(head);
  g_autofree char *day = NULL;
  if (before < (size_t)(gap - text) && memcmp(text, head, before) == 0 &&
      g_str_has_prefix(text + before, "date ")) {
    day = g_strndup(text + before + 5, (size_t)(gap - text) - before - 5);
  }
  if (day == NULL || !g_utf8_validate(day, -1, NULL)) {
    return NULL;
  }
  SbPlan plan;
  const SbPlanWishes wishes = sb_stored_run_wishes();
  sb_plan_wished(&plan, model, &wishes);
  SbRun *run;
  if (sb_run_unpack(&run, model, &plan, bytes, size, NULL) != SB_OK) {
    return NULL;
  }
  *date = g_steal_pointer(&day);
  return sb_run_handle_of(run);
}

SbRunHandle *sb_stored_run_find(char **date, const char *folder, const char *hash,
                                const SbModel *model) {
  g_autoptr(GDir) dir = folder != NULL ? g_dir_open(folder, 0, NULL) : NULL;
  SbRunHandle *found = NULL;
  for (const char *name; found == NULL && dir != NULL && (name = g_dir_read_name(dir)) != NULL;) {
    if (g_str_has_suffix(name, ".run")) {
      g_autofree char *path = g_build_filename(folder, name, NULL);
      found = read_one(date, path, hash, model);
    }
  }
  return found;
}

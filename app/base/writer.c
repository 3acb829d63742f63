// Line-wise editing of key files.
#include "app/base/writer.h"

#include "app/base/reader.h"

#include <string.h>

// Entry of a key, else NULL; *last is the last line that belongs to its group, 0 without the group.
static const SbEntry *find(const GPtrArray *entries, const SbChange *change, int *last) {
  *last = 0;
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (strcmp(entry->group, change->group) == 0) {
      *last = entry->line;
      if (entry->name != NULL && strcmp(entry->name, change->name) == 0) {
        return entry;
      }
    }
  }
  return NULL;
}

// Returns the text of the new group `name`, which begins with its heading: the one in `groups`,
// else a new one at its end. Borrowed from `groups`.
static GString *new_group(GPtrArray *groups, const char *name) {
  g_autofree char *heading = g_strdup_printf("\n[%s]\n", name);
  for (guint i = 0; i < groups->len; i++) {
    if (g_str_has_prefix(((const GString *)groups->pdata[i])->str, heading)) {
      return groups->pdata[i];
    }
  }
  g_ptr_array_add(groups, g_string_new(heading));
  return groups->pdata[groups->len - 1];
}

char *sb_writer_apply(const char *text, const GPtrArray *entries, const SbChange *changes,
                      size_t count) {
  // Each line (NULL once removed) and what is to follow it.
  char **lines = g_strsplit(text, "\n", -1);
  size_t line_count = g_strv_length(lines);
  GString **behind = g_new0(GString *, line_count);
  g_autoptr(GPtrArray) groups = g_ptr_array_new(); // new ones, of GString
  for (size_t i = 0; i < count; i++) {
    const SbChange *change = &changes[i];
    int last = 0;
    const SbEntry *entry = find(entries, change, &last);
    if (entry != NULL) {
      char **line = &lines[entry->line - 1];
      g_free(*line);
      *line =
          change->value != NULL ? g_strdup_printf("%s = %s", change->name, change->value) : NULL;
    } else if (change->value != NULL && last > 0) {
      GString **more = &behind[last - 1];
      *more = *more != NULL ? *more : g_string_new(NULL);
      g_string_append_printf(*more, "%s = %s\n", change->name, change->value);
    } else if (change->value != NULL) {
      g_string_append_printf(new_group(groups, change->group), "%s = %s\n", change->name,
                             change->value);
    }
  }
  GString *out = g_string_new(NULL);
  for (size_t i = 0; i < line_count; i++) {
    // The piece behind a final line end is not a line.
    if (lines[i] != NULL && (i + 1 < line_count || *lines[i] != '\0')) {
      g_string_append_printf(out, "%s\n", lines[i]);
    }
    if (behind[i] != NULL) {
      g_string_append(out, behind[i]->str);
      g_string_free(behind[i], TRUE);
    }
    g_free(lines[i]);
  }
  for (guint i = 0; i < groups->len; i++) {
    g_string_append(out, ((const GString *)groups->pdata[i])->str);
    g_string_free(groups->pdata[i], TRUE);
  }
  g_free(behind);
  g_free(lines);
  return g_string_free(out, FALSE);
}

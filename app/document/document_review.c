// What a review adds to a document: [bookmarks] NAME = TIME of the run, [notes] NAME = text, on a
// pin of that name or, by any other name, on the whole. A note's lines are parted by \n. None of it
// changes a figure, and undo leaves it alone.
#include "app/base/reader.h"
#include "app/document/document_private.h"

#include <string.h>

enum { NAME_MAX_BYTES = 80, TEXT_MAX_BYTES = 4000 };

typedef struct {
  char *name, *text; // text: as people read it, lines and all
} Remark;

static const char *const groups[SB_REMARK_KINDS] = {"bookmarks", "notes"};

static void remark_free(gpointer data) {
  Remark *remark = data;
  g_free(remark->name);
  g_free(remark->text);
  g_free(remark);
}

bool sb_document_is_remark_group(const char *group) {
  for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
    if (strcmp(group, groups[kind]) == 0) {
      return true;
    }
  }
  return false;
}

void sb_document_remarks_init(SbDocument *document) {
  for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
    document->remark[kind] = g_ptr_array_new_with_free_func(remark_free);
  }
}

void sb_document_remarks_clear(SbDocument *document) {
  for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
    g_ptr_array_unref(document->remark[kind]);
  }
}

size_t sb_document_remark_count(const SbDocument *document, SbRemarkKind kind) {
  return document->remark[kind]->len;
}

const char *sb_document_remark_name(const SbDocument *document, SbRemarkKind kind, size_t index) {
  return ((const Remark *)document->remark[kind]->pdata[index])->name;
}

const char *sb_document_remark_text(const SbDocument *document, SbRemarkKind kind, size_t index) {
  return ((const Remark *)document->remark[kind]->pdata[index])->text;
}

double sb_document_bookmark(const SbDocument *document, size_t index) {
  double time = 0;
  const char *text = sb_document_remark_text(document, SB_REMARK_BOOKMARK, index);
  return sb_quantity_parse(&time, text, "s", "s", NULL) ? time : 0;
}

// ---- Lines ----

static char *escape(const char *text) {
  GString *out = g_string_new(NULL);
  for (; *text != '\0'; text++) {
    if (*text == '\n' || *text == '\\') {
      g_string_append(out, *text == '\n' ? "\\n" : "\\\\");
    } else if ((unsigned char)*text >= ' ') {
      g_string_append_c(out, *text);
    }
  }
  return g_string_free(out, FALSE);
}

static char *unescape(const char *text) {
  GString *out = g_string_new(NULL);
  for (; *text != '\0'; text++) {
    if (*text == '\\' && (text[1] == 'n' || text[1] == '\\')) {
      text++;
      g_string_append_c(out, *text == 'n' ? '\n' : '\\');
    } else {
      g_string_append_c(out, *text);
    }
  }
  return g_string_free(out, FALSE);
}

// What is wrong with a remark; NULL: nothing. Owned by the caller.
static char *problem_of(SbRemarkKind kind, const char *name, const char *text) {
  double time;
  g_autoptr(GError) error = NULL;
  if (*name == '\0' || strlen(name) > NAME_MAX_BYTES || strpbrk(name, "=[]\n") != NULL ||
      *name == '#' || g_ascii_isspace(*name) || g_ascii_isspace(name[strlen(name) - 1])) {
    return g_strdup_printf("\"%s\" is not a name (1 to %d bytes, none of = [ ])", name,
                           NAME_MAX_BYTES);
  }
  if (strlen(text) > TEXT_MAX_BYTES) {
    return g_strdup_printf("is too long (at most %d bytes)", TEXT_MAX_BYTES);
  }
  if (kind == SB_REMARK_BOOKMARK && !sb_quantity_parse(&time, text, "s", "s", &error)) {
    return g_strdup(error->message);
  }
  return kind == SB_REMARK_BOOKMARK && !(time >= 0) ? g_strdup("is not a time (at least 0 s)")
                                                    : NULL;
}

static Remark *find_remark(const SbDocument *document, SbRemarkKind kind, const char *name,
                           guint *at) {
  for (*at = 0; *at < document->remark[kind]->len; (*at)++) {
    Remark *remark = document->remark[kind]->pdata[*at];
    if (strcmp(remark->name, name) == 0) {
      return remark;
    }
  }
  return NULL;
}

const char *sb_document_remark(const SbDocument *document, SbRemarkKind kind, const char *name) {
  guint at;
  const Remark *remark = find_remark(document, kind, name, &at);
  return remark != NULL ? remark->text : NULL;
}

static void add_remark(SbDocument *document, SbRemarkKind kind, const char *name,
                       const char *text) {
  Remark *remark = g_new(Remark, 1);
  *remark = (Remark){g_strdup(name), g_strdup(text)};
  g_ptr_array_add(document->remark[kind], remark);
}

void sb_document_remarks_read(SbDocument *document, const char *shown, GPtrArray *issues) {
  for (guint i = 0; i < document->entries->len; i++) {
    const SbEntry *entry = document->entries->pdata[i];
    for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
      if (entry->name == NULL || strcmp(entry->group, groups[kind]) != 0) {
        continue;
      }
      g_autofree char *text = unescape(entry->value);
      g_autofree char *problem =
          document->remark[kind]->len >= SB_REMARKS_MAX
              ? g_strdup_printf("is more than the %d there may be", SB_REMARKS_MAX)
              : problem_of((SbRemarkKind)kind, entry->name, text);
      if (problem != NULL) {
        g_autofree char *key = g_strdup_printf("%s.%s", entry->group, entry->name);
        sb_issues_add(issues, shown, entry->line, key, NULL, "%s", problem);
      } else {
        add_remark(document, (SbRemarkKind)kind, entry->name, text);
      }
    }
  }
}

// ---- Edits ----

bool sb_document_put_remark(SbDocument *document, SbRemarkKind kind, const char *name,
                            const char *text, GError **error) {
  guint at;
  Remark *remark = find_remark(document, kind, name, &at);
  if (text == NULL) {
    if (remark != NULL) {
      g_ptr_array_remove_index(document->remark[kind], at);
      document->serial++;
      document->remarks_changed = true;
    }
    return true;
  }
  g_autofree char *problem =
      remark == NULL && at >= SB_REMARKS_MAX
          ? g_strdup_printf("is more than the %d there may be", SB_REMARKS_MAX)
          : problem_of(kind, name, text);
  if (problem != NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s", problem);
    return false;
  }
  if (remark == NULL) {
    add_remark(document, kind, name, text);
  } else {
    g_free(remark->text);
    remark->text = g_strdup(text);
  }
  document->serial++;
  document->remarks_changed = true;
  return true;
}

void sb_document_take_remarks(SbDocument *document, const SbDocument *from) {
  bool same = true;
  for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
    const GPtrArray *a = document->remark[kind], *b = from->remark[kind];
    same = same && a->len == b->len;
    for (guint i = 0; same && i < a->len; i++) {
      const Remark *one = a->pdata[i], *other = b->pdata[i];
      same = strcmp(one->name, other->name) == 0 && strcmp(one->text, other->text) == 0;
    }
  }
  for (int kind = 0; !same && kind < SB_REMARK_KINDS; kind++) {
    g_ptr_array_set_size(document->remark[kind], 0);
    for (guint i = 0; i < from->remark[kind]->len; i++) {
      const Remark *remark = from->remark[kind]->pdata[i];
      add_remark(document, (SbRemarkKind)kind, remark->name, remark->text);
    }
  }
  document->remarks_changed |= !same;
}

// ---- Writing ----

static void change(GArray *changes, const char *group, const char *name, char *value) {
  const SbChange one = {g_strdup(group), g_strdup(name), value};
  g_array_append_val(changes, one);
}

void sb_document_change_remarks(GArray *changes, const SbDocument *document) {
  guint at;
  if (!document->remarks_changed) {
    return;
  }
  for (guint i = 0; i < document->entries->len; i++) {
    const SbEntry *entry = document->entries->pdata[i];
    for (int kind = 0; entry->name != NULL && kind < SB_REMARK_KINDS; kind++) {
      if (strcmp(entry->group, groups[kind]) != 0) {
        continue;
      }
      // A line that could not be read stays.
      g_autofree char *text = unescape(entry->value);
      g_autofree char *problem = problem_of((SbRemarkKind)kind, entry->name, text);
      if (problem == NULL && find_remark(document, (SbRemarkKind)kind, entry->name, &at) == NULL) {
        change(changes, entry->group, entry->name, NULL);
      }
    }
  }
  for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
    for (guint i = 0; i < document->remark[kind]->len; i++) {
      const Remark *remark = document->remark[kind]->pdata[i];
      change(changes, groups[kind], remark->name, escape(remark->text));
    }
  }
}

// What keys do while the user types a line or a popup is over the page, and what this leads to:
// saving, opening, and the conflict with another program's version of the file.
#include "app/terminal/workbench_private.h"

#include "app/session/verdict_text.h"

#include <glib/gi18n.h>
#include <glib/gstdio.h>
#include <string.h>

// A line of text ---------------------------------------------------------------------------------

void sb_bench_type(SbBench *bench, SbInput input, const char *text) {
  bench->input = input;
  g_string_assign(bench->typed, text);
  bench->caret = (int)g_utf8_strlen(text, -1);
}

// Shows lines (of char *) below a heading, over the page.
static void show_lines(SbBench *bench, const char *heading, const GPtrArray *lines) {
  GString *text = g_string_new(heading);
  g_string_append_c(text, '\n');
  for (guint i = 0; i < lines->len; i++) {
    g_string_append_printf(text, "\n%s", (const char *)lines->pdata[i]);
  }
  g_free(bench->lines);
  bench->lines = g_string_free(text, FALSE);
  sb_bench_open_popup(bench, SB_POPUP_LINES);
}

static void say_issues(SbBench *bench, const GPtrArray *issues) {
  if (issues->len == 1) {
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    sb_bench_status(bench, true, "%s", line);
  } else if (issues->len > 1) {
    g_autoptr(GPtrArray) lines = g_ptr_array_new_with_free_func(g_free);
    for (guint i = 0; i < issues->len; i++) {
      g_ptr_array_add(lines, sb_issue_line(issues->pdata[i]));
    }
    show_lines(bench, _("The file has problems:"), lines);
  }
}

void sb_bench_open_popup(SbBench *bench, SbPopup popup) {
  bench->popup = popup;
  bench->popup_scroll = 0;
}

bool sb_bench_save(SbBench *bench, const char *path) {
  g_autoptr(GError) error = NULL;
  const SbDocument *document = sb_session_document(bench->session);
  if (path == NULL && sb_document_path(document) == NULL) {
    sb_bench_type(bench, SB_INPUT_SAVE, "untitled.valve");
    return false;
  }
  if (!sb_session_save(bench->session, path, &error)) {
    if (error->code == SB_APP_ERROR_CHANGED) {
      sb_bench_open_popup(bench, SB_POPUP_DISK);
      return false;
    }
    sb_bench_status(bench, true, "%s", error->message);
    return false;
  }
  sb_bench_status(bench, false, _("saved as %s"), sb_document_path(document));
  return true;
}

static void commit(SbBench *bench) {
  const SbInput input = bench->input;
  g_autofree char *text = g_strdup(bench->typed->str);
  bench->input = SB_INPUT_NONE;
  g_autoptr(GPtrArray) issues = sb_issues_new();
  switch (input) {
  case SB_INPUT_VALUE:
    sb_session_edit(bench->session, (SbParamId)bench->selected, text);
    break;
  case SB_INPUT_SEARCH:
    g_string_assign(bench->search, text);
    sb_bench_list(bench);
    break;
  case SB_INPUT_SAVE:
    sb_bench_save(bench, text);
    break;
  case SB_INPUT_EXPORT:
    sb_bench_export(bench, text);
    break;
  case SB_INPUT_BOUNDS:
    sb_bench_design_bounds(bench, text);
    break;
  case SB_INPUT_OPEN:
    (void)sb_session_open(bench->session, text, issues);
    say_issues(bench, issues);
    sb_bench_list(bench);
    break;
  default:
    break;
  }
}

static void erase(SbBench *bench, int at) {
  const char *from = g_utf8_offset_to_pointer(bench->typed->str, at);
  g_string_erase(bench->typed, from - bench->typed->str, g_utf8_next_char(from) - from);
}

void sb_bench_type_key(SbBench *bench, const SbKey *key) {
  enum { LONGEST = 1000 };
  const int length = (int)g_utf8_strlen(bench->typed->str, -1);
  switch (key->kind) {
  case SB_KEY_ENTER:
    commit(bench);
    return;
  case SB_KEY_ESCAPE:
    bench->input = SB_INPUT_NONE;
    sb_session_clear_error(bench->session, (SbParamId)bench->selected);
    return;
  case SB_KEY_LEFT:
    bench->caret = MAX(bench->caret - 1, 0);
    return;
  case SB_KEY_RIGHT:
    bench->caret = MIN(bench->caret + 1, length);
    return;
  case SB_KEY_HOME:
    bench->caret = 0;
    return;
  case SB_KEY_END:
    bench->caret = length;
    return;
  case SB_KEY_BACKSPACE:
    if (bench->caret > 0) {
      erase(bench, --bench->caret);
    }
    break;
  case SB_KEY_DELETE:
    if (bench->caret < length) {
      erase(bench, bench->caret);
    }
    break;
  case SB_KEY_CHARACTER:
    if (key->control && key->character == 'u') {
      g_string_truncate(bench->typed, 0);
      bench->caret = 0;
    } else if (!key->control && key->character >= ' ' && length < LONGEST) {
      const char *at = g_utf8_offset_to_pointer(bench->typed->str, bench->caret);
      g_string_insert_unichar(bench->typed, at - bench->typed->str, key->character);
      bench->caret++;
    }
    break;
  default:
    return;
  }
  if (bench->input == SB_INPUT_SEARCH) {
    // What is found so far.
    g_string_assign(bench->search, bench->typed->str);
    sb_bench_list(bench);
  }
}

// Over the page ----------------------------------------------------------------------------------

// What a merge could not decide by itself.
static void say_conflicts(SbBench *bench, const GPtrArray *conflicts) {
  if (conflicts->len > 0) {
    show_lines(bench, _("Both versions changed these values. Yours are in force:"), conflicts);
  }
}

// Reload, merge, keep both or overwrite, by the key's letter; others do nothing.
static void resolve_disk(SbBench *bench, uint32_t key) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(GPtrArray) conflicts = g_ptr_array_new_with_free_func(g_free);
  g_autoptr(GError) error = NULL;
  bench->popup = SB_POPUP_NONE;
  gboolean good = TRUE;
  switch (key) {
  case 'r':
    good = sb_session_reload(bench->session, issues);
    break;
  case 'm':
    good = sb_session_merge(bench->session, conflicts, issues);
    break;
  case 'b':
    good = sb_session_keep_both(bench->session, &error);
    break;
  case 'o':
    good = sb_session_save_over(bench->session, &error);
    break;
  default:
    break;
  }
  bench->disk = sb_session_disk_state(bench->session);
  if (error != NULL) {
    sb_bench_status(bench, true, "%s", error->message);
  } else if (!good) {
    say_issues(bench, issues);
  } else {
    sb_bench_status(bench, false, _("the document is %s"),
                    sb_document_path(sb_session_document(bench->session)));
    say_conflicts(bench, conflicts);
  }
  sb_bench_list(bench);
}

void sb_bench_check_disk(SbBench *bench) {
  enum { PAUSE = G_USEC_PER_SEC };
  const gint64 now = g_get_monotonic_time();
  if (now - bench->looked < PAUSE || bench->popup != SB_POPUP_NONE ||
      bench->input != SB_INPUT_NONE) {
    return;
  }
  bench->looked = now;
  const SbDiskState state = sb_session_check_disk(bench->session);
  if (state != bench->disk && (state == SB_DISK_CHANGED || state == SB_DISK_VALVE_CHANGED)) {
    sb_bench_open_popup(bench, SB_POPUP_DISK);
  }
  bench->disk = state;
}

static void restore(SbBench *bench) {
  g_auto(SbUnsaved) unsaved = {0};
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(GPtrArray) conflicts = g_ptr_array_new_with_free_func(g_free);
  if (sb_autosave_read(&unsaved, bench->orphan) &&
      sb_session_restore(bench->session, unsaved.path, unsaved.base, unsaved.text, conflicts,
                         issues)) {
    say_conflicts(bench, conflicts);
    // Another file is kept before the old one goes.
    sb_autosave_write(bench->autosave);
    g_unlink(bench->orphan);
    sb_bench_list(bench);
  } else {
    say_issues(bench, issues);
  }
}

void sb_bench_popup_key(SbBench *bench, const SbKey *key) {
  const uint32_t character = key->kind == SB_KEY_CHARACTER ? key->character : 0;
  const SbPopup popup = bench->popup;
  if (popup == SB_POPUP_QUIT && (character == 's' || character == 'd')) {
    bench->popup = SB_POPUP_NONE;
    if (character == 'd' || sb_bench_save(bench, NULL)) {
      sb_bench_end(bench);
    }
  } else if (popup == SB_POPUP_RESTORE && (character == 'y' || character == 'd')) {
    bench->popup = SB_POPUP_NONE;
    if (character == 'y') {
      restore(bench);
    } else {
      g_unlink(bench->orphan);
    }
  } else if (popup == SB_POPUP_DISK && character != 0 && strchr("rmbo", (int)character) != NULL) {
    resolve_disk(bench, character);
  } else if (popup == SB_POPUP_VERDICT && character >= '1' && character < '1' + SB_VERDICT_COUNT) {
    sb_verdict_show(bench->session, (int)(character - '1'));
  } else if (key->kind == SB_KEY_UP || key->kind == SB_KEY_WHEEL_UP) {
    bench->popup_scroll--;
  } else if (key->kind == SB_KEY_DOWN || key->kind == SB_KEY_WHEEL_DOWN) {
    bench->popup_scroll++;
  } else if (key->kind == SB_KEY_PAGE_UP || key->kind == SB_KEY_PAGE_DOWN) {
    bench->popup_scroll += key->kind == SB_KEY_PAGE_UP ? -10 : 10;
  } else if (key->kind == SB_KEY_ESCAPE || key->kind == SB_KEY_ENTER || popup < SB_POPUP_QUIT) {
    bench->popup = SB_POPUP_NONE;
  }
}

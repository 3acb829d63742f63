// What keys and the mouse do.
#include "app/terminal/workbench_private.h"

#include "app/session/param_list.h"
#include "app/session/worker.h"

#include <glib/gi18n.h>

static void choose_page(SbBench *bench, SbBenchPage page) {
  bench->page = page;
  if (page == SB_PAGE_PROPELLANTS) {
    bench->study_kind = SB_STUDY_PROPELLANTS;
  }
}

// Whether the chosen row has a value to change; why not is told.
static bool may_change(SbBench *bench) {
  const char *lock = sb_session_lock(bench->session, (SbParamId)bench->selected);
  if (bench->rows->len > 0 && lock != NULL) {
    sb_bench_status(bench, true, "%s", lock);
  }
  return bench->rows->len > 0 && lock == NULL;
}

static void step_value(SbBench *bench, const SbKey *key, double direction) {
  if (may_change(bench)) {
    sb_param_step(bench->session, (SbParamId)bench->selected,
                  direction * (key->shift     ? 0.1
                               : key->control ? 10
                                              : 1));
  }
}

static void edit_value(SbBench *bench) {
  const SbParamId id = (SbParamId)bench->selected;
  if (!may_change(bench)) {
    return;
  }
  const char *rejected = sb_session_rejected(bench->session, id);
  g_autofree char *text = sb_document_text(sb_session_document(bench->session), id);
  sb_bench_type(bench, SB_INPUT_VALUE, rejected != NULL ? rejected : text);
  sb_session_prepare(bench->session, id);
}

static void undo(SbBench *bench, bool redo) {
  const SbDocument *document = sb_session_document(bench->session);
  const bool possible = redo ? sb_document_can_redo(document) : sb_document_can_undo(document);
  const int id = redo ? sb_session_redo(bench->session) : sb_session_undo(bench->session);
  if (id >= 0) {
    sb_bench_select(bench, id);
  } else if (!possible) {
    sb_bench_status(bench, false, redo ? _("nothing to redo") : _("nothing to undo"));
  }
}

static void pin(SbBench *bench) {
  if (!sb_session_may_pin(bench->session)) {
    sb_bench_status(bench, true, _("Only a complete run of the present values can be pinned."));
  } else if (sb_session_pin(bench->session)) {
    sb_bench_status(bench, false, _("pinned; P removes the last pin"));
  }
}

static void unpin(SbBench *bench) {
  const size_t count = sb_session_pin_count(bench->session);
  if (count == 0) {
    sb_bench_status(bench, false, _("nothing is pinned"));
    return;
  }
  sb_bench_status(bench, false, _("pin removed: %s"),
                  sb_session_pin_name(bench->session, count - 1));
  sb_session_unpin(bench->session, count - 1);
}

// Ends what a page computes. Returns whether it computes something.
static bool stop_page(SbBench *bench, SbBenchPage page) {
  switch (page) {
  case SB_PAGE_DESIGN:
    return sb_bench_design_stop(bench);
  case SB_PAGE_CALIBRATE:
    return sb_bench_calibrate_stop(bench);
  case SB_PAGE_PROPELLANTS:
  case SB_PAGE_STUDIES:
    return sb_bench_study_stop(bench);
  default:
    return false;
  }
}

static void cancel(SbBench *bench) {
  if (stop_page(bench, bench->page) || stop_page(bench, SB_PAGE_DESIGN) ||
      stop_page(bench, SB_PAGE_CALIBRATE) || stop_page(bench, SB_PAGE_STUDIES)) {
    sb_bench_status(bench, false, _("cancelling…"));
  } else if (bench->export != NULL) {
    sb_worker_cancel(bench->export);
    sb_bench_status(bench, false, _("cancelling…"));
  } else if (sb_session_state(bench->session) == SB_SESSION_RUNNING) {
    sb_session_stop(bench->session);
    sb_bench_status(bench, false, _("cancelled"));
  } else {
    sb_bench_status(bench, false, _("nothing is being computed; q quits"));
  }
}

static void switch_model(SbBench *bench) {
  const bool solved = sb_fit_kind((SbFitModel)sb_document_value(sb_session_document(bench->session),
                                                                SB_P_MODELS_FIT))
                          ->section;
  sb_session_edit(bench->session, SB_P_MODELS_FIT, solved ? "karaszkiewicz" : "ring");
}

static void next_field(SbBench *bench) {
  bench->field = (SbField)((bench->field + 1) % SB_FIELD_COUNT);
}

static void press(SbBench *bench, const SbKey *key) {
  const SbCellRect *list = &bench->list_at, *time = &bench->timeline_at;
  if (bench->page != SB_PAGE_VALVE) {
    return;
  }
  if (key->x >= list->x && key->x < list->x + list->width && key->y >= list->y &&
      key->y < list->y + list->height) {
    const guint row = (guint)(bench->scroll + key->y - list->y);
    if (row < bench->rows->len && g_array_index(bench->rows, SbListRow, row).id >= 0) {
      sb_bench_select(bench, g_array_index(bench->rows, SbListRow, row).id);
    }
  } else if (time->width > 1 && key->y == time->y && key->x >= time->x &&
             key->x < time->x + time->width) {
    const SbChartRun *run = &sb_session_chart(bench->session)->run;
    if (run->count > 0) {
      const double share = (double)(key->x - time->x) / (time->width - 1);
      sb_session_play(bench->session, FALSE);
      sb_session_set_playhead(bench->session,
                              sb_chart_nearest(run, share * run->frames[run->count - 1].time));
    }
  }
}

// A key that means the same on every page; false: it does not.
// Keys with Control.
static bool control_key(SbBench *bench, unsigned character) {
  switch (character) {
  case 'c':
    cancel(bench);
    return true;
  case 'l':
    sb_screen_redraw(bench->screen);
    return true;
  case 'r':
    undo(bench, true);
    return true;
  case 's':
    sb_bench_save(bench, NULL);
    return true;
  case 'z':
    sb_screen_suspend(bench->screen);
    return true;
  default:
    return false;
  }
}

// Keys of the playhead.
static bool time_key(SbBench *bench, unsigned character) {
  switch (character) {
  case ' ':
    sb_session_play(bench->session, !sb_session_is_playing(bench->session));
    return true;
  case '[':
    sb_session_step_event(bench->session, -1);
    return true;
  case ']':
    sb_session_step_event(bench->session, 1);
    return true;
  case ',':
    sb_session_step(bench->session, -1);
    return true;
  case '.':
    sb_session_step(bench->session, 1);
    return true;
  default:
    return false;
  }
}

// Keys of files, edits and saved designs.
static bool file_key(SbBench *bench, unsigned character) {
  switch (character) {
  case 'o':
    sb_bench_type(bench, SB_INPUT_OPEN, "");
    return true;
  case 'p':
    pin(bench);
    return true;
  case 'P':
    unpin(bench);
    return true;
  case 'q':
    if (sb_session_is_modified(bench->session)) {
      sb_bench_open_popup(bench, SB_POPUP_QUIT);
    } else {
      sb_bench_end(bench);
    }
    return true;
  case 's':
    sb_bench_save(bench, NULL);
    return true;
  case 'S':
    sb_bench_type(bench, SB_INPUT_SAVE, "");
    return true;
  case 'u':
    undo(bench, false);
    return true;
  case 'x':
    sb_bench_type(bench, SB_INPUT_EXPORT, "results.json");
    return true;
  default:
    return false;
  }
}

// Keys of pages and what they show.
static bool view_key(SbBench *bench, unsigned character) {
  switch (character) {
  case '1':
  case '2':
  case '3':
  case '4':
  case '5':
    choose_page(bench, (SbBenchPage)(character - '1'));
    return true;
  case '?':
    sb_bench_open_popup(bench, SB_POPUP_HELP);
    return true;
  case 'c':
    cancel(bench);
    return true;
  case 'e':
    if (bench->page == SB_PAGE_DESIGN) {
      sb_bench_design_effect(bench);
    } else {
      bench->goal = (bench->goal + 1) % SB_EFFECT_GOALS;
    }
    return true;
  case 'f':
    next_field(bench);
    return true;
  case 'i':
    bench->zoom = bench->zoom == SB_SECTION_WHOLE        ? SB_SECTION_ZOOM_OUTER
                  : bench->zoom == SB_SECTION_ZOOM_OUTER ? SB_SECTION_ZOOM_INNER
                                                         : SB_SECTION_WHOLE;
    return true;
  case 'm':
    switch_model(bench);
    return true;
  case 'v':
    sb_bench_open_popup(bench, SB_POPUP_VERDICT);
    return true;
  case 'w':
    sb_bench_open_popup(bench, SB_POPUP_WARNINGS);
    return true;
  default:
    return false;
  }
}

static bool common_key(SbBench *bench, const SbKey *key) {
  if (key->kind == SB_KEY_TAB && bench->page == SB_PAGE_VALVE) {
    bench->list = (SbListKind)((bench->list + 1) % SB_LIST_COUNT);
    g_string_truncate(bench->search, 0);
    sb_bench_list(bench);
    return true;
  }
  if (key->kind != SB_KEY_CHARACTER) {
    return false;
  }
  return key->control ? control_key(bench, key->character)
                      : time_key(bench, key->character) || file_key(bench, key->character) ||
                            view_key(bench, key->character);
}

static void valve_key(SbBench *bench, const SbKey *key) {
  const int page = MAX(bench->list_at.height - 1, 1);
  switch (key->kind) {
  case SB_KEY_UP:
  case SB_KEY_WHEEL_UP:
    sb_bench_move(bench, -1);
    break;
  case SB_KEY_DOWN:
  case SB_KEY_WHEEL_DOWN:
    sb_bench_move(bench, 1);
    break;
  case SB_KEY_PAGE_UP:
    sb_bench_move(bench, -page);
    break;
  case SB_KEY_PAGE_DOWN:
    sb_bench_move(bench, page);
    break;
  case SB_KEY_HOME:
    sb_bench_move(bench, -SB_PARAM_COUNT);
    break;
  case SB_KEY_END:
    sb_bench_move(bench, SB_PARAM_COUNT);
    break;
  case SB_KEY_LEFT:
    step_value(bench, key, -1);
    break;
  case SB_KEY_RIGHT:
    step_value(bench, key, 1);
    break;
  case SB_KEY_ENTER:
    edit_value(bench);
    break;
  case SB_KEY_BACKSPACE:
  case SB_KEY_DELETE:
    sb_session_unset(bench->session, (SbParamId)bench->selected);
    break;
  case SB_KEY_ESCAPE:
    g_string_truncate(bench->search, 0);
    sb_bench_list(bench);
    break;
  case SB_KEY_PRESS:
    press(bench, key);
    break;
  case SB_KEY_CHARACTER:
    if (key->character == '/') {
      sb_bench_type(bench, SB_INPUT_SEARCH, bench->search->str);
    }
    break;
  default:
    break;
  }
}

static void study_key(SbBench *bench, const SbKey *key) {
  const bool list = bench->page == SB_PAGE_STUDIES;
  const int kind = (int)bench->study_kind;
  if (key->kind == SB_KEY_ENTER) {
    sb_bench_study_start(bench);
  } else if (list && (key->kind == SB_KEY_UP || key->kind == SB_KEY_DOWN)) {
    bench->study_kind =
        (SbStudyKind)CLAMP(kind + (key->kind == SB_KEY_UP ? -1 : 1), 0, SB_STUDY_COUNT - 1);
  }
}

void sb_bench_key(SbBench *bench, const SbKey *key) {
  if (bench->ended) {
    return;
  }
  if (bench->input == SB_INPUT_NONE) {
    g_clear_pointer(&bench->message, g_free);
  }
  sb_bench_check_disk(bench);
  if (bench->popup != SB_POPUP_NONE) {
    sb_bench_popup_key(bench, key);
  } else if (bench->input != SB_INPUT_NONE) {
    sb_bench_type_key(bench, key);
  } else if (common_key(bench, key)) {
    // done
  } else if (bench->page == SB_PAGE_VALVE) {
    valve_key(bench, key);
  } else if (bench->page == SB_PAGE_DESIGN) {
    sb_bench_design_key(bench, key);
  } else if (bench->page == SB_PAGE_CALIBRATE) {
    sb_bench_calibrate_key(bench, key);
  } else {
    study_key(bench, key);
  }
  sb_bench_changed(bench);
}

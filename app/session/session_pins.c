// Designs kept to compare with. The document holds their values and saves them; here are their
// runs, at most SB_CHART_PINS of which are drawn beside the live one. A pin is the run that was
// shown when it was made; those of a file that was opened are computed one by one while no other
// run is wanted, cold, as `sealbench run` has them.
#include "app/session/session_private.h"

#include "app/session/pin_names.h"

typedef struct {
  SbDisplayedRun *run; // owned reference; NULL: not there yet
  int slot;            // of its look in the charts, -1: not drawn
  bool failed;         // there is no run
  char *name;          // in the user's language
} Pin;

static void pin_free(gpointer data) {
  Pin *pin = data;
  sb_displayed_run_unref(pin->run);
  g_free(pin->name);
  g_free(pin);
}

static Pin *pin_at(const SbSession *session, size_t index) {
  return session->pins->pdata[index];
}

void sb_session_name_pins(SbSession *session) {
  for (size_t i = 0; i < session->pins->len; i++) {
    Pin *pin = pin_at(session, i);
    g_free(pin->name);
    pin->name = sb_pin_name(session->document, i);
  }
  if (session->pins->len > 0) {
    sb_session_refresh_chart(session); // it had the names before
  }
}

static int free_slot(const SbSession *session) {
  for (int slot = 0; slot < SB_CHART_PINS; slot++) {
    bool taken = false;
    for (size_t i = 0; i < session->pins->len; i++) {
      taken = taken || pin_at(session, i)->slot == slot;
    }
    if (!taken) {
      return slot;
    }
  }
  return -1;
}

static void pins_changed(SbSession *session) {
  sb_session_name_pins(session);
  sb_session_run_changed(session);
  sb_session_emit(session, SB_SIGNAL_PARAMS); // there is something to save
}

size_t sb_session_pin_count(SbSession *session) {
  return session->pins->len;
}

const char *sb_session_pin_name(SbSession *session, size_t index) {
  return pin_at(session, index)->name;
}

int sb_session_pin_slot(SbSession *session, size_t index) {
  return pin_at(session, index)->slot;
}

const SbSummary *sb_session_pin_summary(SbSession *session, size_t index) {
  const Pin *pin = pin_at(session, index);
  return pin->run != NULL ? pin->run->chart.summary : NULL;
}

gboolean sb_session_pin_failed(SbSession *session, size_t index) {
  return pin_at(session, index)->failed;
}

gboolean sb_session_may_pin(SbSession *session) {
  return sb_session_may_keep(session) && !sb_session_is_stale(session, NULL, NULL);
}

gboolean sb_session_pin(SbSession *session) {
  if (!sb_session_may_pin(session) || !sb_document_add_pin(session->document, NULL, 0)) {
    return FALSE;
  }
  Pin *pin = g_new0(Pin, 1);
  pin->run = sb_displayed_run_ref(session->shown);
  pin->slot = free_slot(session);
  g_ptr_array_add(session->pins, pin);
  if (pin->slot < 0) { // the new one is what somebody wants to see
    sb_session_draw_pin(session, session->pins->len - 1, TRUE);
  } else {
    pins_changed(session);
  }
  return TRUE;
}

gboolean sb_session_pin_values(SbSession *session, const SbOverride *override, size_t count) {
  if (!sb_document_add_pin(session->document, override, count)) {
    return FALSE;
  }
  Pin *pin = g_new0(Pin, 1); // its run is computed
  pin->slot = free_slot(session);
  g_ptr_array_add(session->pins, pin);
  pins_changed(session);
  sb_session_poll_pins(session);
  return TRUE;
}

void sb_session_unpin(SbSession *session, size_t index) {
  if (session->pin_ticket != 0) { // indices move
    sb_runner_cancel(session->pin_runner);
    session->pin_ticket = 0;
  }
  sb_document_remove_pin(session->document, index);
  g_ptr_array_remove_index(session->pins, (guint)index);
  pins_changed(session);
  sb_session_poll_pins(session);
}

void sb_session_rename_pin(SbSession *session, size_t index, const char *name) {
  sb_document_name_pin(session->document, index, name);
  pins_changed(session);
}

void sb_session_draw_pin(SbSession *session, size_t index, gboolean on) {
  Pin *pin = pin_at(session, index);
  if (on && pin->slot < 0) {
    pin->slot = free_slot(session);
    // No look is free: that of the oldest drawn one.
    for (size_t i = 0; pin->slot < 0 && i < session->pins->len; i++) {
      Pin *other = pin_at(session, i);
      if (other->slot >= 0) {
        pin->slot = other->slot;
        other->slot = -1;
      }
    }
  } else if (!on) {
    pin->slot = -1;
  }
  pins_changed(session);
}

void sb_session_use_pin(SbSession *session, size_t index) {
  sb_document_use_pin(session->document, index);
  sb_session_document_changed(session);
}

// For the charts ---------------------------------------------------------------------------------

size_t sb_session_frame_of(SbSession *session, const SbDisplayedRun *run) {
  const SbDisplayedRun *shown = session->shown;
  return shown != NULL && session->playhead.frame < shown->chart.count
             ? sb_playhead_same_place(&shown->chart, session->playhead.frame, &run->chart)
             : 0;
}

gboolean sb_session_pin_chart(SbSession *session, size_t index, SbChartPin *out) {
  const Pin *pin = pin_at(session, index);
  if (pin->run == NULL || pin->run->chart.count == 0) {
    return FALSE;
  }
  *out = (SbChartPin){.run = &pin->run->chart,
                      .name = pin->name,
                      .look = MAX(pin->slot, 0),
                      .frame = sb_session_frame_of(session, pin->run)};
  return TRUE;
}

SbRunHandle *sb_session_pin_handle(SbSession *session, size_t index) {
  const Pin *pin = pin_at(session, index);
  return pin->run != NULL ? sb_run_handle_ref(pin->run->handle) : NULL;
}

void sb_session_place_pins(SbSession *session) {
  SbChartData *chart = &session->chart;
  for (size_t i = 0; i < chart->pin_count; i++) {
    chart->pin[i].frame = sb_session_frame_of(session, pin_at(session, session->drawn[i])->run);
  }
}

void sb_session_chart_pins(SbSession *session) {
  SbChartData *chart = &session->chart;
  chart->pin_count = 0;
  for (int slot = 0; slot < SB_CHART_PINS; slot++) {
    for (size_t i = 0; i < session->pins->len; i++) {
      const Pin *pin = pin_at(session, i);
      if (pin->slot == slot && pin->run != NULL && pin->run->chart.count > 0) {
        session->drawn[chart->pin_count] = i;
        chart->pin[chart->pin_count++] =
            (SbChartPin){.run = &pin->run->chart, .name = pin->name, .look = slot};
      }
    }
  }
  sb_session_place_pins(session);
}

// Runs that are not there yet --------------------------------------------------------------------

static void take(SbSession *session, SbRunHandle *handle) {
  Pin *pin = pin_at(session, session->pin_index);
  session->pin_ticket = 0;
  if (sb_run_handle_run(handle) == NULL || sb_run_handle_status(handle) != SB_OK) {
    pin->failed = true;
    sb_run_handle_unref(handle);
    return;
  }
  pin->run = sb_displayed_run_new(
      handle, sb_document_pin_params(session->document, session->pin_index), SB_GRADE_WHOLE);
  sb_displayed_run_end(pin->run);
  sb_displayed_run_update(pin->run, G_MAXSIZE);
  sb_run_cache_put(session->cache, pin->run);
}

// Returns whether a run was found without computing it, or cannot be computed.
static bool compute_next(SbSession *session) {
  bool settled = false;
  for (size_t i = 0; i < session->pins->len && session->pin_ticket == 0; i++) {
    Pin *pin = pin_at(session, i);
    if (pin->run != NULL || pin->failed) {
      continue;
    }
    const SbParams *params = sb_document_pin_params(session->document, i);
    SbDisplayedRun *known = sb_run_cache_get(session->cache, params, sb_session_drawings(session));
    if (known != NULL && known->grade == SB_GRADE_WHOLE) {
      pin->run = sb_displayed_run_ref(known);
      settled = true;
      continue;
    }
    g_autoptr(SbModel) model = NULL;
    g_autoptr(GPtrArray) issues = sb_issues_new();
    if (session->pin_runner == NULL) {
      session->pin_runner = sb_runner_create(sb_session_notify, session->inbox, true);
    }
    if (session->pin_runner == NULL ||
        !sb_document_compile_pin(session->document, i, &model, issues)) {
      pin->failed = settled = true;
      continue;
    }
    session->pin_index = i;
    session->pin_ticket = sb_runner_submit(
        session->pin_runner, &(SbRunRequest){.model = model,
                                             .wishes = {.views = SB_SESSION_VIEWS, .life = true},
                                             .alone = true});
  }
  return settled;
}

void sb_session_poll_pins(SbSession *session) {
  SbRunHandle *handle = session->pin_ticket != 0 ? sb_runner_latest(session->pin_runner) : NULL;
  bool done = handle != NULL && sb_run_handle_ticket(handle) == session->pin_ticket &&
              sb_run_handle_is_done(handle);
  if (done) {
    take(session, handle);
  } else {
    sb_run_handle_unref(handle);
  }
  // What somebody waits for goes first.
  if (!sb_session_computes(session) && !sb_session_delays(session) && session->pin_ticket == 0) {
    done |= compute_next(session);
  }
  if (done) {
    sb_session_run_changed(session);
    sb_session_emit(session, SB_SIGNAL_FRAMES);
  }
}

// Life -------------------------------------------------------------------------------------------

void sb_session_load_pins(SbSession *session) {
  if (session->pin_ticket != 0) {
    sb_runner_cancel(session->pin_runner);
    session->pin_ticket = 0;
  }
  session->chart.pin_count = 0;
  g_ptr_array_set_size(session->pins, 0);
  const size_t count = sb_document_pin_count(session->document);
  for (size_t i = 0; i < count; i++) {
    Pin *pin = g_new0(Pin, 1);
    pin->slot = i < SB_CHART_PINS ? (int)i : -1;
    g_ptr_array_add(session->pins, pin);
  }
  sb_session_name_pins(session);
}

void sb_session_init_pins(SbSession *session) {
  session->pins = g_ptr_array_new_with_free_func(pin_free);
}

void sb_session_dispose_pins(SbSession *session) {
  g_clear_pointer(&session->pin_runner, sb_runner_destroy);
  g_clear_pointer(&session->pins, g_ptr_array_unref);
}

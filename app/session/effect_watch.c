#include "app/session/effect_watch.h"

#include "app/base/device.h"
#include "app/base/format.h"
#include "app/base/unit.h"

#include <glib/gi18n.h>
#include <math.h>

enum { STANDS_MS = 400 };

struct SbEffectWatch {
  SbSession *session;
  void (*changed)(void *data);
  bool (*is_busy)(const void *data);
  void *data;
  SbEffectJob *job;
  SbEffects *effects;    // NULL: none yet
  char *hash, *job_hash; // of the document they are of
  guint later;           // source that will ask
};

static void on_watch_done(void *data) {
  SbEffectWatch *watch = data;
  SbEffects *effects = g_new(SbEffects, 1);
  if (sb_effect_job_take(watch->job, effects)) {
    g_free(watch->effects);
    watch->effects = g_steal_pointer(&effects);
    g_free(watch->hash);
    watch->hash = g_steal_pointer(&watch->job_hash);
  }
  g_free(effects);
  g_clear_pointer(&watch->job, sb_effect_job_free);
  watch->changed(watch->data);
}

// Once the values have stood for a moment and their run is there: it goes first.
static gboolean on_later(gpointer data) {
  SbEffectWatch *watch = data;
  const SbModel *model = sb_session_model(watch->session);
  if (sb_session_state(watch->session) == SB_SESSION_RUNNING ||
      (watch->is_busy != NULL && watch->is_busy(watch->data))) {
    return G_SOURCE_CONTINUE;
  }
  watch->later = 0;
  g_autofree char *hash = sb_document_sha256(sb_session_document(watch->session));
  if (model != NULL && sb_device(model)->stem && watch->job == NULL &&
      g_strcmp0(hash, watch->hash) != 0) {
    g_free(watch->job_hash);
    watch->job_hash = g_steal_pointer(&hash);
    watch->job = sb_effect_job_start(model, on_watch_done, watch);
  }
  return G_SOURCE_REMOVE;
}

static void ask(SbEffectWatch *watch) {
  g_clear_pointer(&watch->job, sb_effect_job_free);
  if (watch->later != 0) {
    g_source_remove(watch->later);
  }
  watch->later = g_timeout_add(STANDS_MS, on_later, watch);
}

SbEffectWatch *sb_effect_watch_new(SbSession *session, void (*changed)(void *data),
                                   bool (*is_busy)(const void *data), void *data) {
  SbEffectWatch *watch = g_new0(SbEffectWatch, 1);
  *watch =
      (SbEffectWatch){.session = session, .changed = changed, .is_busy = is_busy, .data = data};
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(ask), watch);
  ask(watch);
  return watch;
}

void sb_effect_watch_free(SbEffectWatch *watch) {
  if (watch == NULL) {
    return;
  }
  g_signal_handlers_disconnect_by_data(watch->session, watch);
  if (watch->later != 0) {
    g_source_remove(watch->later);
  }
  sb_effect_job_free(watch->job);
  g_free(watch->effects);
  g_free(watch->hash);
  g_free(watch->job_hash);
  g_free(watch);
}

const SbEffects *sb_effect_watch_effects(const SbEffectWatch *watch, bool *former) {
  g_autofree char *now = sb_document_sha256(sb_session_document(watch->session));
  *former = g_strcmp0(now, watch->hash) != 0;
  return watch->effects;
}

double sb_effect_share(const SbEffects *effects, int goal, int id) {
  double largest = 0;
  for (int i = 0; effects != NULL && i < SB_PARAM_COUNT; i++) {
    const double change = effects->change[goal][i];
    largest = isfinite(change) ? fmax(largest, fabs(change)) : largest;
  }
  return largest > 0 ? effects->change[goal][id] / largest : NAN;
}

char *sb_effect_text(const SbEffects *effects, int goal, SbParamId id) {
  if (effects == NULL || !isfinite(effects->change[goal][id]) || !isfinite(effects->step[id])) {
    return NULL;
  }
  const SbFigure *figure = sb_figure(sb_effect_goal(goal));
  char change[SB_FORMAT_MAX], step[SB_FORMAT_MAX];
  sb_format_digits(change,
                   sb_quantity_to_shown(effects->change[goal][id], figure->si, figure->shown), 2);
  sb_format_digits(
      step, sb_quantity_to_shown(effects->step[id], sb_param(id)->si, sb_param(id)->unit), 2);
  return g_strdup_printf(_("%s %s %s per %s %s"), sb_effect_goal_name(goal), change, figure->shown,
                         step, sb_param(id)->unit);
}

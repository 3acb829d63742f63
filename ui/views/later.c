// See later.h. GObject invalidates the closures that an object watches when it is disposed, which
// is what destroying a widget does; the source is removed then.
#include "ui/views/later.h"

typedef struct {
  void (*call)(gpointer data);
  gpointer data;
  gboolean repeats;
} Call;

static gboolean run(gpointer data) {
  const Call *call = data;
  if (!call->repeats) {
    // Before the call, which may schedule the next one in the same place. The main loop keeps the
    // closure, and with it `call`, until this function returns.
    g_source_destroy(g_main_current_source());
  }
  call->call(call->data);
  return G_SOURCE_CONTINUE;
}

static void call_free(gpointer data, GClosure *closure) {
  g_free(data);
}

// The owner ended, or the source did and released the closure.
static void end(gpointer source, GClosure *closure) {
  g_source_destroy(source);
  g_source_unref(source);
}

static void schedule(SbLater *later, gpointer owner, guint ms, const Call *wanted) {
  Call *call = g_new(Call, 1);
  *call = *wanted;
  GClosure *closure = g_cclosure_new(G_CALLBACK(run), call, call_free);
  g_object_watch_closure(owner, closure);
  GSource *source = ms > 0 ? g_timeout_source_new(ms) : g_idle_source_new();
  g_source_set_closure(source, closure);
  g_closure_add_invalidate_notifier(closure, source, end);
  later->source = g_source_attach(source, NULL); // this reference is end()'s
}

void sb_later_set(SbLater *later, gpointer owner, guint ms, void (*call)(gpointer data),
                  gpointer data) {
  sb_later_cancel(later);
  schedule(later, owner, ms, &(Call){call, data, FALSE});
}

void sb_later_ensure(SbLater *later, gpointer owner, guint ms, void (*call)(gpointer data),
                     gpointer data) {
  if (!sb_later_is_due(later)) {
    schedule(later, owner, ms, &(Call){call, data, FALSE});
  }
}

void sb_later_repeat(SbLater *later, gpointer owner, guint ms, void (*call)(gpointer data),
                     gpointer data) {
  sb_later_cancel(later);
  schedule(later, owner, ms, &(Call){call, data, TRUE});
}

gboolean sb_later_is_due(const SbLater *later) {
  return later->source != 0 && g_main_context_find_source_by_id(NULL, later->source) != NULL;
}

void sb_later_cancel(SbLater *later) {
  GSource *source =
      later->source != 0 ? g_main_context_find_source_by_id(NULL, later->source) : NULL;
  if (source != NULL) {
    g_source_destroy(source);
  }
  later->source = 0;
}

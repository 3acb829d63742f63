// The session: edits go to the document and, shortly after, to the runner; what the runner
// publishes comes back as the shown run. A refused text stays with its field, so that the value in
// force (and the pictures) remain what they were.
#include "app/session/session.h"

#include "app/session/session_private.h"

#include "app/base/format.h"
#include "app/document/typed.h"
#include "engine/valve/model/motion_kind.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

static guint signals[SB_SIGNAL_COUNT];

G_DEFINE_TYPE(SbSession, sb_session, G_TYPE_OBJECT)

// "9 m is out of range" -> "9 m is out of range."
static char *sentence(const char *text, const char *allowed) {
  g_autofree char *whole =
      allowed != NULL ? g_strdup_printf(_("%s (allowed: %s)"), text, allowed) : g_strdup(text);
  g_autofree char *copy = sb_sentence_case(whole);
  gsize length = strlen(copy);
  return g_strconcat(copy, length > 0 && copy[length - 1] == '.' ? "" : ".", NULL);
}

static void forget_rejected(SbSession *session, int id) {
  g_clear_pointer(&session->rejected[id], g_free);
  g_clear_pointer(&session->error[id], g_free);
  session->out_of_range[id] = FALSE;
}

// Compiles the values; what does not go together becomes errors of the fields named. Errors of
// refused texts stay.
static void compile(SbSession *session) {
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    if (session->rejected[id] == NULL) {
      g_clear_pointer(&session->error[id], g_free);
    }
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  const bool charted = session->model != NULL && session->chart.run.model == session->model;
  g_clear_pointer(&session->model, sb_model_destroy);
  bool valid = sb_document_compile(session->document, &session->model, issues);
  if (charted) { // before the first frame the chart's axes are those of the values
    session->chart.run.model = session->model;
  }
  for (guint i = 0; !valid && i < issues->len; i++) {
    const SbIssue *issue = g_ptr_array_index(issues, i);
    int id = issue->key != NULL ? sb_param_find(issue->key) : -1;
    if (id >= 0 && session->error[id] == NULL) {
      session->error[id] = sentence(issue->text, issue->allowed);
    }
  }
}

void sb_session_emit(SbSession *session, SbSessionSignal signal) {
  g_signal_emit(session, signals[signal], 0);
}

static void take_values(SbSession *session) {
  compile(session);
  sb_session_values_changed(session);
  sb_session_emit(session, SB_SIGNAL_PARAMS);
}

// The same after an edit, for which somebody waits.
static void changed(SbSession *session) {
  session->lone = session->edited == 0;
  session->edited = g_get_monotonic_time();
  session->latency = (SbEditLatency){NAN, NAN};
  compile(session);
  sb_session_name_pins(session);
  sb_session_values_changed(session);
  if (session->predicted) {
    session->latency.predicted = 1e-6 * (double)(g_get_monotonic_time() - session->edited);
  }
  sb_session_emit(session, SB_SIGNAL_PARAMS);
}

void sb_session_document_changed(SbSession *session) {
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    forget_rejected(session, id);
  }
  changed(session);
}

const SbDocument *sb_session_document(SbSession *session) {
  return session->document;
}

void sb_session_replace_document(SbSession *session, SbDocument *document) {
  sb_document_free(session->document);
  session->document = document;
  session->disk = SB_DISK_SAME;
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    forget_rejected(session, id);
  }
  sb_session_load_pins(session);
  sb_session_clear_runs(session);
  sb_session_read_measured(session);
  take_values(session);
}

gboolean sb_session_open(SbSession *session, const char *path, GPtrArray *issues) {
  SbDocument *document = sb_document_load(path, issues);
  if (document == NULL) {
    return FALSE;
  }
  sb_session_replace_document(session, document);
  return TRUE;
}

void sb_session_reset(SbSession *session) {
  sb_session_replace_document(session, sb_document_new());
}

void sb_session_set_camera(SbSession *session, double azimuth, double elevation) {
  session->azimuth = azimuth;
  session->elevation = elevation;
}

void sb_session_camera(SbSession *session, double *azimuth, double *elevation) {
  *azimuth = session->azimuth;
  *elevation = session->elevation;
}

gboolean sb_session_is_modified(SbSession *session) {
  return sb_document_is_modified(session->document);
}

gboolean sb_session_edit(SbSession *session, SbParamId id, const char *text) {
  g_autoptr(GError) error = NULL;
  session->last_edited = (int)id;
  forget_rejected(session, (int)id);
  g_autofree char *meant = sb_typed_text(id, sb_document_value(session->document, id), text);
  gboolean good = sb_document_set(session->document, id, meant, &error);
  if (!good) {
    session->rejected[id] = g_strdup(text);
    session->error[id] = sentence(error->message, NULL);
    session->out_of_range[id] = g_error_matches(error, SB_APP_ERROR, SB_APP_ERROR_RANGE);
  }
  changed(session);
  return good;
}

gboolean sb_session_edit_value(SbSession *session, SbParamId id, double value) {
  g_autoptr(GError) error = NULL;
  session->last_edited = (int)id;
  forget_rejected(session, (int)id);
  gboolean good = sb_document_set_value(session->document, id, value, TRUE, &error);
  changed(session);
  return good;
}

gboolean sb_session_edit_values(SbSession *session, const SbOverride *override, size_t count) {
  const gboolean good = sb_document_set_values(session->document, override, count);
  sb_session_document_changed(session);
  return good;
}

void sb_session_end_merge(SbSession *session) {
  sb_document_end_merge(session->document);
}

void sb_session_unset(SbSession *session, SbParamId id) {
  forget_rejected(session, (int)id);
  if (sb_document_gives(session->document, id)) {
    sb_document_unset(session->document, id);
  }
  changed(session);
}

gboolean sb_session_set_rubber(SbSession *session, const char *name, GPtrArray *issues) {
  gboolean good = sb_document_set_rubber(session->document, name, issues);
  changed(session);
  return good;
}

void sb_session_set_section(SbSession *session, const char *path, const SbSealDrawing *section,
                            double height) {
  sb_document_set_section(session->document, path, section, height);
  forget_rejected(session, SB_P_SEAL_PROFILE);
  changed(session);
}

void sb_session_set_groove(SbSession *session, const char *path, const SbGrooveDrawing *groove) {
  sb_document_set_groove(session->document, path, groove);
  changed(session);
}

static int changed_by(SbSession *session, int id) {
  const bool parameter = id >= 0 && id < SB_PARAM_COUNT;
  if (parameter) {
    forget_rejected(session, id);
  }
  if (id == SB_DOCUMENT_WHOLE) {
    sb_session_whole_changed(session);
  } else if (id == SB_DOCUMENT_MEASURED) {
    sb_session_read_measured(session);
    sb_session_run_changed(session);
    sb_session_emit(session, SB_SIGNAL_PARAMS);
  } else if (id >= 0) {
    changed(session);
  }
  return parameter ? id : -1;
}

int sb_session_undo(SbSession *session) {
  return changed_by(session, sb_document_undo(session->document));
}

int sb_session_redo(SbSession *session) {
  return changed_by(session, sb_document_redo(session->document));
}

const char *sb_session_error(SbSession *session, SbParamId id) {
  return session->error[id];
}

const char *sb_session_rejected(SbSession *session, SbParamId id) {
  return session->rejected[id];
}

gboolean sb_session_is_out_of_range(SbSession *session, SbParamId id) {
  return session->out_of_range[id];
}

int sb_session_error_count(SbSession *session) {
  int count = 0;
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    count += session->error[id] != NULL;
  }
  return count;
}

int sb_session_first_error(SbSession *session) {
  if (session->last_edited >= 0 && session->error[session->last_edited] != NULL) {
    return session->last_edited;
  }
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    if (session->error[id] != NULL) {
      return id;
    }
  }
  return -1;
}

void sb_session_clear_error(SbSession *session, SbParamId id) {
  if (session->rejected[id] != NULL) {
    forget_rejected(session, (int)id);
    changed(session);
  }
}

const SbModel *sb_session_model(SbSession *session) {
  return session->model;
}

const char *sb_session_lock(SbSession *session, SbParamId id) {
  // Values that the chosen models do not read.
  const SbDocument *document = session->document;
  int film = (int)sb_document_value(document, SB_P_MODELS_FILM);
  if (id == SB_P_STEM_MASS &&
      !sb_motion_choice((int)sb_document_value(document, SB_P_MODELS_MOTION))->inertia) {
    return _("Locked: the quasi-static motion has no inertia");
  }
  if (id == SB_P_OUTPUT_TOLERANCE && !sb_film_kind((SbFilmModel)film)->coupled &&
      !sb_fit_kind((SbFitModel)sb_document_value(document, SB_P_MODELS_FIT))->points) {
    return _("Locked: closed forms have no discretisation error");
  }
  const char *shape = sb_document_shape_source(document, id);
  if (shape != NULL) {
    g_autofree char *text = g_strdup_printf(_("Locked: follows from %s in this file"), shape);
    return g_intern_string(text); // a few short ones
  }
  return NULL;
}

static void dispose(GObject *object) {
  sb_session_clear_measured(SB_SESSION(object));
  sb_session_dispose_runs(SB_SESSION(object));
  G_OBJECT_CLASS(sb_session_parent_class)->dispose(object);
}

static void finalize(GObject *object) {
  SbSession *session = SB_SESSION(object);
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    forget_rejected(session, id);
  }
  g_free(session->markers);
  sb_document_free(session->document);
  sb_model_destroy(session->model);
  G_OBJECT_CLASS(sb_session_parent_class)->finalize(object);
}

static void sb_session_class_init(SbSessionClass *class) {
  static const char *const names[SB_SIGNAL_COUNT] = {
      "params-changed", "run-changed", "frames-changed", "progress-changed", "playhead-changed"};
  G_OBJECT_CLASS(class)->dispose = dispose;
  G_OBJECT_CLASS(class)->finalize = finalize;
  for (int i = 0; i < SB_SIGNAL_COUNT; i++) {
    signals[i] = g_signal_new(names[i], SB_TYPE_SESSION, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                              G_TYPE_NONE, 0);
  }
}

static void sb_session_init(SbSession *session) {
  session->document = sb_document_new();
  session->last_edited = -1;
  session->slope_first = -1;
  session->slope_id = SB_SLOPE_NONE;
  sb_session_init_runs(session);
  compile(session);
}

SbSession *sb_session_new(void) {
  return g_object_new(SB_TYPE_SESSION, NULL);
}

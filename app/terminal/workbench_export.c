// Exports of the workbench in a terminal: this screen as text, or what the session's export job
// writes: the run's figures, a view as a picture or a film, the report.
#include "app/terminal/workbench_private.h"

#include "app/base/output.h"
#include "app/export/formats.h"
#include "app/export/render.h"

#include <glib/gi18n.h>
#include <string.h>

static void on_export(void *data) {
  SbBench *bench = data;
  gboolean good = FALSE;
  const char *result = sb_export_job_result(bench->export, &good);
  sb_bench_status(bench, !good, "%s", result);
  g_clear_pointer(&bench->export, sb_export_job_free);
}

static void write_screen(SbBench *bench, const char *path) {
  g_autoptr(GError) error = NULL;
  g_autofree char *text = sb_cells_to_text(&bench->cells);
  if (sb_output_write(path, text, strlen(text), &error)) {
    sb_bench_status(bench, false, _("written: %s"), path);
  } else {
    sb_bench_status(bench, true, "%s", error->message);
  }
}

// At the playhead, in the section's field that is chosen; `view` NULL: the report.
static void start(SbBench *bench, const char *path, const SbRenderView *view) {
  SbRunHandle *handle =
      sb_session_may_keep(bench->session) ? sb_session_handle(bench->session) : NULL;
  // A picture says that it is of earlier values; figures would stand beside the wrong ones.
  if (handle == NULL || (view == NULL && sb_session_is_stale(bench->session, NULL, NULL))) {
    sb_run_handle_unref(handle);
    sb_bench_status(bench, true, _("No complete run is displayed yet."));
    return;
  }
  const SbDocument *document = sb_session_document(bench->session);
  const char *from = sb_document_path(document); // results state the full path
  const SbFrame *frame = sb_session_frame(bench->session);
  char time[G_ASCII_DTOSTR_BUF_SIZE];
  g_ascii_dtostr(time, sizeof time, frame != NULL ? frame->time : 0);
  SbExportRequest request = {
      .path = g_strdup(path),
      .view = view != NULL ? g_strdup(view->name) : NULL,
      .width = view != NULL ? view->width : 0,
      .height = view != NULL ? view->height : 0,
      .style = sb_section_style_of(sb_run_model(sb_session_run(bench->session))),
      .at = g_strdup_printf("%s s", time),
      .fps = 30,
      .duration = SB_PLAY_S,
      .title = g_strdup(sb_document_title(document)),
      .hash = sb_document_sha256(document),
      .scene = sb_document_to_flat_text(document),
      .measured = sb_session_measured(bench->session) != NULL
                      ? sb_data_copy(sb_document_data(document, 0))
                      : NULL,
      .stale = sb_session_stale_text(bench->session),
      .drive_speed = sb_session_drive_speed(bench->session),
      .file = from != NULL ? g_canonicalize_filename(from, NULL) : NULL,
      .document =
          sb_session_is_modified(bench->session) ? sb_document_to_text(document, NULL) : NULL,
  };
  sb_export_request_add_compared(&request, bench->session);
  request.style.field = bench->field;
  request.style.cutaway = view != NULL && view->cutaway;
  bench->export = sb_export_job_start(handle, &request, on_export, bench);
  sb_bench_status(bench, false, _("exporting; c cancels"));
}

void sb_bench_export(SbBench *bench, const char *text) {
  g_autofree char *path = g_strstrip(g_strdup(text));
  const SbRenderView *view = sb_render_view("section");
  // A last word that is a view's.
  char *last = strrchr(path, ' ');
  const SbRenderView *named = last != NULL ? sb_render_view(last + 1) : NULL;
  if (named != NULL || (last != NULL && strcmp(last + 1, "report") == 0)) {
    view = named;
    *last = '\0';
    g_strchomp(path);
  }
  const bool picture = sb_export_format(path) != NULL;
  if (bench->export != NULL) {
    sb_bench_status(bench, true, _("An export is running; c cancels it."));
  } else if (sb_output_ends_in(path, ".txt")) {
    write_screen(bench, path);
  } else if (sb_output_ends_in(path, ".json")) {
    start(bench, path, NULL);
  } else if (view == NULL ? sb_output_ends_in(path, ".pdf") : picture) {
    start(bench, path, view);
  } else {
    g_autofree char *endings = sb_export_endings(SB_FORMAT_ALL, 0, " ", " ");
    sb_bench_status(bench, true,
                    _("%s: .json the figures, .txt this screen, %s a view, .pdf report"), path,
                    endings);
  }
}

// Of the displayed run, or of what is predicted while that one's values are former: it is pale
// then, like the pictures, and says which of both. A pass is quiet, only what fails has a ground.
// In a narrow window figures go before words: first those of what passes or has no limit, then
// those questions' words, then the other figures.
#include "ui/window/verdict_strip.h"

#include "app/base/device.h"
#include "app/session/verdict_text.h"
#include "ui/views/later.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// How much is shown, from all to the least.
enum { ALL, FAILING_FIGURES, FAILING_WORDS, WORDS, LEVELS };

typedef struct {
  SbSession *session;
  GtkWidget *scroller, *box, *predicted;
  GtkWidget *button[SB_VERDICT_COUNT], *sign[SB_VERDICT_COUNT], *word[SB_VERDICT_COUNT],
      *figure[SB_VERDICT_COUNT], *why[SB_VERDICT_COUNT];
  bool fails[SB_VERDICT_COUNT];
  int level, width;
  SbLater later; // fits it to a width
} VerdictStrip;

static void fit_verdict(VerdictStrip *strip, int level) {
  strip->level = level;
  for (int i = 0; i < SB_VERDICT_COUNT; i++) {
    gtk_widget_set_visible(strip->figure[i], level == ALL || (strip->fails[i] && level < WORDS));
    gtk_widget_set_visible(strip->word[i], level < FAILING_WORDS || strip->fails[i]);
  }
}

// The richest that fits the width.
static void on_verdict_later(gpointer data) {
  VerdictStrip *strip = data;
  for (int level = ALL; level < LEVELS; level++) {
    fit_verdict(strip, level);
    int natural = 0;
    gtk_widget_get_preferred_width(strip->box, NULL, &natural);
    if (natural <= strip->width) {
      break;
    }
  }
}

static void refit(VerdictStrip *strip) {
  if (strip->width > 0) {
    sb_later_ensure(&strip->later, strip->box, 0, on_verdict_later, strip);
  }
}

static void on_verdict_allocate(GtkWidget *scroller, GdkRectangle *allocation,
                                VerdictStrip *strip) {
  if (allocation->width != strip->width) {
    strip->width = allocation->width;
    refit(strip);
  }
}

static void refresh_verdict(VerdictStrip *strip) {
  const SbSummary *predicted = sb_session_predicted(strip->session);
  const SbSummary *summary = sb_verdict_summary(strip->session);
  static const char *const signs[] = {
      [SB_ANSWER_UNKNOWN] = "–", [SB_ANSWER_NO] = "✗", [SB_ANSWER_YES] = "✓"};
  for (int i = 0; i < SB_VERDICT_COUNT; i++) {
    const SbVerdict none = {SB_ANSWER_UNKNOWN, -1, NAN, NAN, ""};
    const SbVerdict *verdict = summary != NULL ? &summary->verdict[i] : &none;
    strip->fails[i] = verdict->ok == SB_ANSWER_NO;
    g_autofree char *figure =
        summary != NULL ? sb_verdict_figure_text(summary, i, verdict) : g_strdup("");
    g_autofree char *found = summary != NULL ? sb_verdict_why(summary, i, verdict)
                                             : g_strdup(_("No complete run is displayed yet."));
    g_autofree char *why =
        predicted != NULL ? g_strdup_printf(_("Predicted, until the new run is solved.\n%s"), found)
                          : g_strdup(found);
    gtk_label_set_text(GTK_LABEL(strip->sign[i]), signs[verdict->ok]);
    gtk_label_set_text(GTK_LABEL(strip->figure[i]), figure);
    gtk_label_set_text(GTK_LABEL(strip->why[i]), why);
    GtkStyleContext *style = gtk_widget_get_style_context(strip->button[i]);
    const char *const classes[] = {"pass", "fail"};
    const bool has[] = {verdict->ok == SB_ANSWER_YES, strip->fails[i]};
    for (int k = 0; k < 2; k++) {
      if (has[k]) {
        gtk_style_context_add_class(style, classes[k]);
      } else {
        gtk_style_context_remove_class(style, classes[k]);
      }
    }
    g_autofree char *name =
        g_strdup_printf("%s: %s", sb_verdict_word(i), sb_verdict_answer(verdict->ok));
    sb_style_name(strip->button[i], name, why);
    gtk_widget_set_sensitive(strip->button[i], summary != NULL);
  }
  // The sliding plate has no verdict.
  gtk_widget_set_visible(strip->scroller, sb_device(sb_session_model(strip->session))->stem);
  sb_style_former(strip->box, sb_session_shows_former(strip->session));
  gtk_widget_set_visible(strip->predicted, predicted != NULL);
  refit(strip);
}

// The instant that the answer is of, where the run has it.
static void on_verdict_toggled(GtkToggleButton *button, VerdictStrip *strip) {
  int kind = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(button), "kind"));
  if (gtk_toggle_button_get_active(button)) {
    sb_verdict_show(strip->session, kind);
  }
}

static GtkWidget *add_verdict_label(GtkWidget *box, const char *text, const char *name) {
  GtkWidget *label = sb_style_label(text, name, 0);
  gtk_widget_set_no_show_all(label, TRUE);
  gtk_widget_show(label);
  gtk_box_pack_start(GTK_BOX(box), label, FALSE, FALSE, 0);
  return label;
}

static GtkWidget *make_button(VerdictStrip *strip, int kind) {
  GtkWidget *button = strip->button[kind] = sb_style_menu_button();
  g_object_set_data(G_OBJECT(button), "kind", GINT_TO_POINTER(kind));
  GtkWidget *inside = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 7);
  strip->sign[kind] = add_verdict_label(inside, "", "sb-sign");
  strip->word[kind] = add_verdict_label(inside, sb_verdict_word(kind), "sb-word");
  strip->figure[kind] = add_verdict_label(inside, "", "sb-figure");
  gtk_container_add(GTK_CONTAINER(button), inside);
  GtkWidget *popover = gtk_popover_new(button);
  GtkWidget *why = strip->why[kind] = sb_style_label("", "sb-why", 0);
  g_object_set(why, "margin", 14, "selectable", TRUE, "max-width-chars", 60, NULL);
  gtk_label_set_line_wrap(GTK_LABEL(why), TRUE);
  gtk_widget_show(why);
  gtk_container_add(GTK_CONTAINER(popover), why);
  gtk_menu_button_set_popover(GTK_MENU_BUTTON(button), popover);
  g_signal_connect(button, "toggled", G_CALLBACK(on_verdict_toggled), strip);
  return button;
}

static void on_verdict_destroy(GtkWidget *widget, VerdictStrip *strip) {
  g_signal_handlers_disconnect_by_data(strip->session, strip);
  strip->width = 0; // nothing more is fitted
}

GtkWidget *sb_verdict_strip_new(SbSession *session) {
  VerdictStrip *strip = g_new0(VerdictStrip, 1);
  strip->session = session;
  strip->box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
  for (int i = 0; i < SB_VERDICT_COUNT; i++) {
    gtk_box_pack_start(GTK_BOX(strip->box), make_button(strip, i), FALSE, FALSE, 0);
  }
  strip->predicted = add_verdict_label(strip->box, _("predicted"), "sb-note");
  gtk_widget_hide(strip->predicted);
  // It never decides how narrow the window can be.
  GtkWidget *scroller = strip->scroller = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_EXTERNAL,
                                 GTK_POLICY_NEVER);
  sb_style_class(scroller, "sb-verdicts");
  gtk_container_add(GTK_CONTAINER(scroller), strip->box);
  sb_style_name(scroller, _("Verdict"), NULL);
  g_object_set_data_full(G_OBJECT(scroller), "strip", strip, g_free);
  g_signal_connect(scroller, "size-allocate", G_CALLBACK(on_verdict_allocate), strip);
  g_signal_connect(scroller, "destroy", G_CALLBACK(on_verdict_destroy), strip);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(refresh_verdict), strip);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(refresh_verdict), strip);
  gtk_widget_show_all(scroller);
  gtk_widget_set_no_show_all(scroller, TRUE); // the model decides
  refresh_verdict(strip);
  return scroller;
}

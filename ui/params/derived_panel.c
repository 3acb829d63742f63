// What follows from the values of the displayed run: squeeze, stretch and gland fill from its
// model, the return force from its result, so that all are of one run; before the first run those
// of the values at once. While values differ from that run and what they give is predicted, it is
// that, paler and named so. (gland_panel.c follows the values.) Each has a bar with the recommended
// band, a word and a sign, so that colour is not alone.
//
// Bands of squeeze, stretch and fill are those of the gland's read-outs (engine/contact/gland.h,
// with their sources), of which gland_panel.c shows all. A return force of at least 2 N, an eighth
// of the pressure force of the thesis valve, is this program's own. Metering volumes of 25 to 100
// µl are those of thesis section 1.7.
#include "ui/params/derived_panel.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "app/draw/theme.h"
#include "app/session/verdict_text.h"
#include "engine/valve/figures/figures.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>

// A figure of the catalogue, whose label, help and unit stand there.
typedef struct {
  const char *path, *low, *high, *note; // note: behind the help, or NULL
  double axis_lo, axis_hi;              // ends of the bar
  double lo, hi;                        // recommended band
  int gland;                            // SbGlandQuantity whose band it is, or NO_GLAND
} Item;

enum { NO_GLAND = -1 };

static const Item items[] = {
    {"seals.outer.squeeze", N_("low"), N_("high"), NULL, 0, 0.35, 0, 0, SB_GLAND_SQUEEZE},
    {"seals.outer.stretch_inner", N_("low"), N_("high"), NULL, 0, 0.25, 0, 0,
     SB_GLAND_STRETCH_INNER},
    {"seals.outer.gland_fill", N_("low"), N_("high"), NULL, 0.3, 1.1, 0, 0, SB_GLAND_FILL},
    {"cycle.force_return_margin_N", N_("low"), N_("high"), N_("This program requires 2 N."), -2, 8,
     2, INFINITY, NO_GLAND},
    {"dose.metered_volume_m3", N_("small"), N_("large"), N_("Usual: 25 to 100 µl."), 0, 150e-9,
     25e-9, 100e-9, NO_GLAND},
    {"dose.doses", N_("few"), N_("many"), N_("Usual: 60 to 200."), 0, 300, 60, 200, NO_GLAND},
};
enum { ITEMS = G_N_ELEMENTS(items) };

typedef struct {
  SbSession *session;
  GtkWidget *grid, *note;
  GtkWidget *name[ITEMS], *value[ITEMS], *bar[ITEMS], *icon[ITEMS], *verdict[ITEMS];
  int figure[ITEMS];
  char *tip[ITEMS];
  SbSummary model;             // figures that follow from the model alone
  double shown[ITEMS];         // NAN: not known
  double lo[ITEMS], hi[ITEMS]; // bands in force
  bool judged[ITEMS];          // there is a band
} Panel;

// Bands in force: the item's own, or that of the outer seal's gland, which depends on its section.
static void set_bands(Panel *panel, const SbModel *model) {
  SbGland gland;
  SbGlandReadout readout[SB_GLAND_COUNT];
  bool known = model != NULL && sb_device(model)->gland;
  if (known) {
    sb_model_gland(&gland, model, SB_OUTER);
    known = sb_gland_readouts(readout, &gland, NULL) == SB_OK;
  }
  for (int i = 0; i < ITEMS; i++) {
    const Item *item = &items[i];
    const SbGlandReadout *of = item->gland != NO_GLAND && known ? &readout[item->gland] : NULL;
    const char *more = item->gland == NO_GLAND ? _(item->note)
                       : of == NULL            ? ""
                       : of->source[0] != '\0' ? of->source
                                               : of->why;
    panel->judged[i] = item->gland == NO_GLAND || (of != NULL && of->band != SB_BAND_NONE);
    panel->lo[i] = of != NULL ? of->band_low : item->lo;
    panel->hi[i] = of != NULL ? of->band_high : item->hi;
    g_free(panel->tip[i]);
    panel->tip[i] =
        g_strdup_printf("%s. %s", sb_translation(sb_figure(panel->figure[i])->help), more);
    gtk_widget_set_tooltip_text(panel->bar[i], panel->tip[i]);
    gtk_widget_set_tooltip_text(panel->name[i], panel->tip[i]);
  }
}

static SbBand band_of(const Panel *panel, int index, double value) {
  return panel->judged[index] ? sb_band_of(value, panel->lo[index], panel->hi[index])
                              : SB_BAND_NONE;
}

static SbColor verdict_color(const SbTheme *theme, const Panel *panel, int index, double value) {
  static const SbRole roles[] = {[SB_BAND_NONE] = SB_ROLE_INK,
                                 [SB_BAND_BELOW] = SB_ROLE_WARN,
                                 [SB_BAND_WITHIN] = SB_ROLE_PASS,
                                 [SB_BAND_ABOVE] = SB_ROLE_WARN};
  return theme->role[roles[band_of(panel, index, value)]];
}

static gboolean on_draw(GtkWidget *widget, cairo_t *cr, Panel *panel) {
  int index = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(widget), "index"));
  const Item *item = &items[index];
  const SbTheme *theme = sb_theme(sb_style_is_dark());
  double width = gtk_widget_get_allocated_width(widget);
  double height = gtk_widget_get_allocated_height(widget);
  double y = floor(height / 2) - 3;
  double scale = width / (item->axis_hi - item->axis_lo);

  // The range of the bar, the band in it, and the value as an upright mark.
  SbColor ground = theme->role[SB_ROLE_HAIRLINE];
  cairo_set_source_rgb(cr, ground.r, ground.g, ground.b);
  cairo_rectangle(cr, 0, y, width, 6);
  cairo_fill(cr);
  const double wide = panel->judged[index] ? 1 : 0;
  double from = (fmax(panel->lo[index], item->axis_lo) - item->axis_lo) * scale;
  double to = (fmin(panel->hi[index], item->axis_hi) - item->axis_lo) * scale;
  SbColor band = theme->role[SB_ROLE_PASS];
  cairo_set_source_rgba(cr, band.r, band.g, band.b, 0.55);
  cairo_rectangle(cr, from, y, wide * (to - from), 6);
  cairo_fill(cr);
  double value = panel->shown[index];
  if (!isnan(value)) {
    double x = (fmin(fmax(value, item->axis_lo), item->axis_hi) - item->axis_lo) * scale;
    x = fmin(fmax(floor(x), 1), width - 2);
    SbColor mark = verdict_color(theme, panel, index, value);
    cairo_set_source_rgb(cr, mark.r, mark.g, mark.b);
    cairo_rectangle(cr, x - 1, y - 5, 3, 16);
    cairo_fill(cr);
  }
  return GDK_EVENT_PROPAGATE;
}

static const char *name_of(const Panel *panel, int index) {
  return sb_translation(sb_figure(panel->figure[index])->label);
}

// Shows the figure of `of`, whose value is NaN for the reason `why` (NULL: nothing has run).
static void show(Panel *panel, int index, const SbSummary *of, const char *why) {
  const double value = sb_figure_value(of, panel->figure[index]);
  const Item *item = &items[index];
  panel->shown[index] = value;
  GtkStyleContext *style = gtk_widget_get_style_context(panel->verdict[index]);
  GtkStyleContext *icon_style = gtk_widget_get_style_context(panel->icon[index]);
  gtk_style_context_remove_class(style, "sb-pass");
  gtk_style_context_remove_class(style, "sb-warn");
  gtk_style_context_remove_class(icon_style, "sb-pass");
  gtk_style_context_remove_class(icon_style, "sb-warn");
  const char *word = "";
  char text[SB_FORMAT_MAX] = "–";
  if (isnan(value) && why != NULL) {
    g_strlcpy(text, _("not known"), sizeof text);
  }
  if (!isnan(value)) {
    sb_format_figure(text, of, panel->figure[index]);
  }
  const SbBand band = isnan(value) ? SB_BAND_NONE : band_of(panel, index, value);
  if (band != SB_BAND_NONE) {
    gboolean good = band == SB_BAND_WITHIN;
    word = good ? _("pass") : band == SB_BAND_BELOW ? _(item->low) : _(item->high);
    gtk_style_context_add_class(style, good ? "sb-pass" : "sb-warn");
    gtk_style_context_add_class(icon_style, good ? "sb-pass" : "sb-warn");
    gtk_image_set_from_icon_name(GTK_IMAGE(panel->icon[index]),
                                 good ? "object-select-symbolic" : "dialog-warning-symbolic",
                                 GTK_ICON_SIZE_MENU);
  } else {
    gtk_image_clear(GTK_IMAGE(panel->icon[index]));
  }
  gtk_label_set_text(GTK_LABEL(panel->value[index]), text);
  gtk_label_set_text(GTK_LABEL(panel->verdict[index]), word);
  g_autofree char *spoken = g_strdup_printf("%s %s %s", name_of(panel, index), text, word);
  sb_style_name(panel->value[index], spoken, why != NULL ? why : panel->tip[index]);
  gtk_widget_set_tooltip_text(panel->value[index], why);
  gtk_widget_queue_draw(panel->bar[index]);
}

static void refresh(Panel *panel) {
  const SbRun *run = sb_session_run(panel->session);
  const SbSummary *predicted = sb_session_predicted(panel->session);
  const SbModel *model =
      run != NULL && predicted == NULL ? sb_run_model(run) : sb_session_model(panel->session);
  const SbSummary *summary = sb_verdict_summary(panel->session);
  g_autofree char *former = predicted != NULL ? g_strdup(_("predicted, being solved"))
                                              : sb_session_former_text(panel->session);
  set_bands(panel, model);
  // A plate on its rings has no glands, return or doses.
  gtk_widget_set_visible(panel->grid, sb_device(model)->stem);
  for (int i = 0; i < ITEMS; i++) {
    // What only a ring on a floor has.
    const gboolean shown = sb_device(model)->gland || (items[i].gland != SB_GLAND_FILL &&
                                                       items[i].gland != SB_GLAND_STRETCH_INNER);
    GtkWidget *const row[] = {panel->name[i], panel->value[i], panel->bar[i], panel->icon[i],
                              panel->verdict[i]};
    for (size_t k = 0; k < G_N_ELEMENTS(row); k++) {
      gtk_widget_set_visible(row[k], shown);
    }
  }
  sb_figures_clear(&panel->model);
  if (model != NULL) {
    sb_figures_of_model(&panel->model, model);
  }
  for (int i = 0; i < ITEMS; i++) {
    const bool solved = summary != NULL && isnan(sb_figure_value(&panel->model, panel->figure[i]));
    show(panel, i, solved ? summary : &panel->model,
         solved ? sb_figure_reason(summary, panel->figure[i]) : NULL);
  }
  gtk_label_set_text(GTK_LABEL(panel->note), former != NULL ? former : _("outer seal"));
  gtk_widget_set_tooltip_text(panel->note, former);
  for (int i = 0; i < ITEMS; i++) {
    sb_style_former(panel->value[i], former != NULL);
    sb_style_former(panel->bar[i], former != NULL);
    sb_style_former(panel->verdict[i], former != NULL);
  }
}

static void panel_free(gpointer data) {
  Panel *panel = data;
  for (int i = 0; i < ITEMS; i++) {
    g_free(panel->tip[i]);
  }
  g_free(panel);
}

GtkWidget *sb_derived_panel_new(SbSession *session) {
  Panel *panel = g_new0(Panel, 1);
  panel->session = session;
  GtkWidget *grid = panel->grid = gtk_grid_new();
  gtk_grid_set_row_spacing(GTK_GRID(grid), 6);
  gtk_grid_set_column_spacing(GTK_GRID(grid), 10);
  sb_style_class(grid, "sb-derived");
  sb_style_class(grid, "sb-panel");
  gtk_grid_attach(GTK_GRID(grid), sb_style_label(_("Derived"), "sb-title", 0), 0, 0, 1, 1);
  panel->note = sb_style_label("", "sb-note", 1);
  gtk_label_set_ellipsize(GTK_LABEL(panel->note), PANGO_ELLIPSIZE_MIDDLE);
  gtk_label_set_max_width_chars(GTK_LABEL(panel->note), 24);
  gtk_grid_attach(GTK_GRID(grid), panel->note, 1, 0, 4, 1);
  for (int i = 0; i < ITEMS; i++) {
    panel->figure[i] = sb_figure_find(items[i].path);
    panel->name[i] = sb_style_label(name_of(panel, i), "sb-derived-name", 0);
    panel->value[i] = sb_style_label("", "sb-derived-value", 1);
    // Room for every value and word, so that none moves what is beside the panel.
    gtk_label_set_width_chars(GTK_LABEL(panel->value[i]), 8);
    panel->bar[i] = gtk_drawing_area_new();
    gtk_widget_set_size_request(panel->bar[i], 64, 18);
    gtk_widget_set_hexpand(panel->bar[i], TRUE);
    g_object_set_data(G_OBJECT(panel->bar[i]), "index", GINT_TO_POINTER(i));
    g_signal_connect(panel->bar[i], "draw", G_CALLBACK(on_draw), panel);
    panel->icon[i] = gtk_image_new();
    panel->verdict[i] = sb_style_label("", "sb-verdict", 0);
    gtk_label_set_width_chars(GTK_LABEL(panel->verdict[i]), 5);
    gtk_grid_attach(GTK_GRID(grid), panel->name[i], 0, i + 1, 1, 1);
    gtk_grid_attach(GTK_GRID(grid), panel->value[i], 1, i + 1, 1, 1);
    gtk_grid_attach(GTK_GRID(grid), panel->bar[i], 2, i + 1, 1, 1);
    gtk_grid_attach(GTK_GRID(grid), panel->icon[i], 3, i + 1, 1, 1);
    gtk_grid_attach(GTK_GRID(grid), panel->verdict[i], 4, i + 1, 1, 1);
  }
  g_object_set_data_full(G_OBJECT(grid), "panel", panel, panel_free);
  sb_signals_end_with(grid, panel->session, panel);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(refresh), panel);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(refresh), panel);
  gtk_widget_show_all(grid);
  refresh(panel);
  return grid;
}

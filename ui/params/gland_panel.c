// Stretch, squeeze, fill, extrusion gap and section of both rings in their glands, at once from the
// values (engine/contact/gland.h): one line each with outer and inner seal, the customary band
// below its name, and a word: within, below, above, or tight where only the worst case of the
// tolerances lies outside. The tooltip tells the worst case over the tolerances, the
// root-sum-square range and the band's source. Swell lines are there while a ring has swollen.
#include "ui/params/gland_panel.h"

#include "app/base/device.h"
#include "app/base/format.h"
#include "app/base/translation.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

static const struct {
  SbGlandQuantity quantity;
  const char *name;
  SbQuantity format;
  gboolean swell; // only while a ring has swollen
} rows[] = {
    {SB_GLAND_SQUEEZE, N_("Squeeze"), SB_QUANTITY_FRACTION, FALSE},
    {SB_GLAND_SQUEEZE_FITTED, N_("Squeeze, stretched"), SB_QUANTITY_FRACTION, FALSE},
    {SB_GLAND_INTERFERENCE, N_("Interference"), SB_QUANTITY_LENGTH, FALSE},
    {SB_GLAND_STRETCH_INNER, N_("Stretch, inner"), SB_QUANTITY_FRACTION, FALSE},
    {SB_GLAND_STRETCH_MEAN, N_("Stretch, mean"), SB_QUANTITY_FRACTION, FALSE},
    {SB_GLAND_SECTION_FITTED, N_("Section, stretched"), SB_QUANTITY_LENGTH, FALSE},
    {SB_GLAND_FILL, N_("Gland fill"), SB_QUANTITY_FRACTION, FALSE},
    {SB_GLAND_EXTRUSION_GAP, N_("Extrusion gap"), SB_QUANTITY_LENGTH, FALSE},
    {SB_GLAND_SWELL, N_("Swell by volume"), SB_QUANTITY_FRACTION, TRUE},
    {SB_GLAND_SQUEEZE_SWOLLEN, N_("Squeeze, swollen"), SB_QUANTITY_FRACTION, TRUE},
    {SB_GLAND_SECTION_SWOLLEN, N_("Section, swollen"), SB_QUANTITY_LENGTH, TRUE},
    {SB_GLAND_FILL_SWOLLEN, N_("Gland fill, swollen"), SB_QUANTITY_FRACTION, TRUE},
};
enum { ROWS = G_N_ELEMENTS(rows), CELLS = 4 }; // name over band, outer, inner, word

typedef struct {
  SbSession *session;
  GtkWidget *expander;
  GtkWidget *cell[ROWS][CELLS];
} GlandPanel;

static char *number(SbQuantity format, double value) {
  char text[SB_FORMAT_MAX];
  return g_strdup(sb_format_text(text, format, value, 0));
}

// "15 to 25 %", "at most 5 %"; empty without a band.
static char *band_text(SbQuantity format, const SbGlandReadout *readout) {
  char low[SB_FORMAT_MAX], high[SB_FORMAT_MAX];
  bool has_low = isfinite(readout->band_low) && readout->band_low > 0;
  bool has_high = isfinite(readout->band_high);
  sb_format_given(low, format, readout->band_low);
  sb_format_given(high, format, readout->band_high);
  if (has_low && has_high) {
    // The unit once.
    char *unit = strstr(low, "\xc2\xa0");
    if (unit != NULL && g_str_has_suffix(high, unit)) {
      *unit = '\0';
    }
    return g_strdup_printf(_("%s to %s"), low, high);
  }
  return has_high  ? g_strdup_printf(_("at most %s"), high)
         : has_low ? g_strdup_printf(_("at least %s"), low)
                   : g_strdup("");
}

static char *tip_text(SbQuantity format, SbGlandReadout readout[SB_SEAL_COUNT]) {
  GString *text = g_string_new(NULL);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbGlandReadout *r = &readout[seal];
    g_autofree char *low = number(format, r->worst_low);
    g_autofree char *high = number(format, r->worst_high);
    g_autofree char *rss_low = number(format, r->rss_low);
    g_autofree char *rss_high = number(format, r->rss_high);
    g_string_append_printf(text, "%s", seal > 0 ? "\n" : "");
    g_string_append_printf(text, _("%s: worst case %s to %s, root sum of squares %s to %s."),
                           seal == SB_OUTER ? _("Outer seal") : _("Inner seal"), low, high, rss_low,
                           rss_high);
  }
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbGlandReadout *r = &readout[seal];
    const char *note = r->source[0] != '\0' ? r->source : r->why;
    const bool same = seal > 0 && r->source == readout[0].source && r->why == readout[0].why;
    if (note[0] != '\0' && !same) {
      g_string_append_printf(text, "\n%s", note);
    }
  }
  return g_string_free(text, FALSE);
}

static void set_class(GtkWidget *widget, const char *style) {
  GtkStyleContext *context = gtk_widget_get_style_context(widget);
  gtk_style_context_remove_class(context, "sb-warn");
  gtk_style_context_remove_class(context, "sb-pass");
  if (style != NULL) {
    gtk_style_context_add_class(context, style);
  }
}

static void show_row(GlandPanel *panel, int row, SbGlandReadout readout[SB_SEAL_COUNT]) {
  SbQuantity format = rows[row].format;
  GtkWidget **cell = panel->cell[row];
  g_autofree char *tip = tip_text(format, readout);
  // Sections of another row have another band: the tooltip has both.
  const bool one_band = readout[SB_OUTER].source == readout[SB_INNER].source;
  g_autofree char *band = one_band ? band_text(format, &readout[SB_OUTER]) : g_strdup("");
  g_autofree char *value[SB_SEAL_COUNT] = {NULL, NULL};
  const char *word = "";
  gboolean banded =
      readout[SB_OUTER].band != SB_BAND_NONE && readout[SB_INNER].band != SB_BAND_NONE;
  gboolean by_section = readout[SB_OUTER].why[0] != '\0' || readout[SB_INNER].why[0] != '\0';
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    value[seal] = number(format, readout[seal].nominal);
    gtk_label_set_text(GTK_LABEL(cell[1 + seal]), value[seal]);
    gboolean outside = readout[seal].band == SB_BAND_BELOW || readout[seal].band == SB_BAND_ABOVE;
    set_class(cell[1 + seal], outside ? "sb-warn" : NULL);
    if (outside && word[0] == '\0') {
      word = sb_translation(sb_band_text(readout[seal].band));
    }
  }
  // Inside as sized, but not over the whole of the tolerances.
  for (int seal = 0; seal < SB_SEAL_COUNT && word[0] == '\0' && banded; seal++) {
    if (readout[seal].band_worst != SB_BAND_WITHIN) {
      word = _("tight");
    }
  }
  const char *verdict = word[0] != '\0' ? word
                        : banded        ? _("within")
                        : by_section    ? _("not judged")
                                        : "";
  gtk_label_set_text(GTK_LABEL(cell[3]), verdict);
  set_class(cell[3], !banded && word[0] == '\0' ? NULL : word[0] != '\0' ? "sb-warn" : "sb-pass");
  g_autofree char *name = band[0] != '\0'
                              ? g_strdup_printf("%s\n<small>%s</small>", _(rows[row].name), band)
                              : g_strdup(_(rows[row].name));
  gtk_label_set_markup(GTK_LABEL(cell[0]), name);
  for (int i = 0; i < CELLS; i++) {
    gtk_widget_set_tooltip_text(cell[i], tip);
  }
  g_autofree char *spoken =
      g_strdup_printf(_("%s outer %s inner %s %s, customary %s"), _(rows[row].name),
                      value[SB_OUTER], value[SB_INNER], verdict, band[0] != '\0' ? band : _("any"));
  sb_style_name(cell[1], spoken, tip);
}

static void refresh_gland(GlandPanel *panel) {
  const SbModel *model = sb_session_model(panel->session);
  SbGlandReadout all[SB_SEAL_COUNT][SB_GLAND_COUNT];
  gboolean swollen = FALSE;
  // The rings of the sliding-plate rig lie in no gland, nor do gaskets.
  gtk_widget_set_visible(panel->expander, sb_device(model)->gland);
  model = sb_device(model)->gland ? model : NULL;
  for (int seal = 0; model != NULL && seal < SB_SEAL_COUNT; seal++) {
    SbGland gland;
    sb_model_gland(&gland, model, seal);
    swollen = swollen || gland.volume_swell > 0;
    if (sb_gland_readouts(all[seal], &gland, NULL) != SB_OK) {
      model = NULL; // a corner of the tolerances leaves no gland
    }
  }
  for (int row = 0; row < ROWS; row++) {
    gboolean visible = !rows[row].swell || swollen;
    for (int i = 0; i < CELLS; i++) {
      gtk_widget_set_visible(panel->cell[row][i], visible);
    }
    if (model != NULL) {
      SbGlandReadout both[SB_SEAL_COUNT] = {all[SB_OUTER][rows[row].quantity],
                                            all[SB_INNER][rows[row].quantity]};
      show_row(panel, row, both);
    } else {
      for (int i = 1; i < CELLS; i++) {
        gtk_label_set_text(GTK_LABEL(panel->cell[row][i]), i < 3 ? "\xe2\x80\x93" : "");
        set_class(panel->cell[row][i], NULL);
      }
    }
  }
}

GtkWidget *sb_gland_panel_new(SbSession *session) {
  GlandPanel *panel = g_new0(GlandPanel, 1);
  panel->session = session;
  GtkWidget *grid = gtk_grid_new();
  gtk_grid_set_row_spacing(GTK_GRID(grid), 4);
  gtk_grid_set_column_spacing(GTK_GRID(grid), 10);
  static const char *const heads[CELLS] = {"", N_("outer"), N_("inner"), ""};
  for (int i = 0; i < CELLS; i++) {
    gtk_grid_attach(
        GTK_GRID(grid),
        sb_style_label(heads[i][0] != '\0' ? _(heads[i]) : "", "sb-note", i == 0 || i == 3 ? 0 : 1),
        i, 0, 1, 1);
  }
  for (int row = 0; row < ROWS; row++) {
    for (int i = 0; i < CELLS; i++) {
      GtkWidget *cell = sb_style_label(i == 0 ? _(rows[row].name) : "",
                                       i == 0   ? "sb-derived-name"
                                       : i == 3 ? "sb-verdict"
                                                : "sb-derived-value",
                                       i == 0 || i == 3 ? 0 : 1);
      gtk_widget_set_valign(cell, i == 0 ? GTK_ALIGN_CENTER : GTK_ALIGN_BASELINE);
      gtk_widget_set_hexpand(cell, i == 0);
      panel->cell[row][i] = cell;
      gtk_grid_attach(GTK_GRID(grid), cell, i, row + 1, 1, 1);
    }
  }
  GtkWidget *expander = panel->expander = gtk_expander_new(_("Glands, both seals"));
  sb_style_name(expander, _("Glands, both seals"), NULL);
  sb_style_class(expander, "sb-derived");
  sb_style_class(expander, "sb-panel");
  gtk_container_add(GTK_CONTAINER(expander), grid);
  g_object_set_data_full(G_OBJECT(expander), "panel", panel, g_free);
  sb_signals_end_with(expander, panel->session, panel);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(refresh_gland), panel);
  refresh_gland(panel);
  gtk_widget_show(grid);
  return expander;
}

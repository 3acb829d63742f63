// The cards of the swap page: a propellant's figures at the cursor, the verdict, where it returns.
#include "app/chart/propellants_private.h"
#include "engine/fluid/fluid.h"

#include <glib/gi18n.h>
#include <math.h>

enum { RETURN_CARD = SB_PROPELLANTS_RETURN, DOSE };

// A tick, a triangle, a cross or a dash, 12 px high on the baseline.
static void draw_sign(SbCanvas *c, SbPropellantsAnswer answer, double x, double y) {
  cairo_t *cr = c->cr;
  sb_canvas_pen(c, 2, NULL);
  sb_canvas_color(c, sb_canvas_role(c, sb_propellants_role(answer)), 1);
  if (answer == SB_PROPELLANT_RETURNS) {
    cairo_move_to(cr, x, y - 5);
    cairo_line_to(cr, x + 4, y - 1);
    cairo_line_to(cr, x + 11, y - 9);
  } else if (answer == SB_PROPELLANT_STUCK) {
    cairo_move_to(cr, x + 1, y - 9);
    cairo_line_to(cr, x + 10, y);
    cairo_move_to(cr, x + 10, y - 9);
    cairo_line_to(cr, x + 1, y);
  } else if (answer == SB_PROPELLANT_WEAKLY) {
    cairo_move_to(cr, x + 5.5, y - 10);
    cairo_line_to(cr, x + 11, y);
    cairo_line_to(cr, x, y);
    cairo_close_path(cr);
    cairo_move_to(cr, x + 5.5, y - 6.5);
    cairo_line_to(cr, x + 5.5, y - 2.5);
  } else {
    cairo_move_to(cr, x, y - 4);
    cairo_line_to(cr, x + 11, y - 4);
  }
  cairo_stroke(cr);
}

static char *answer_text(const SbStudy *study, int k, double T, double gauge) {
  char force[SB_FORMAT_MAX], at[SB_FORMAT_MAX];
  const double value = sb_propellants_value(sb_propellants_series(study, RETURN_CARD, k), T);
  sb_propellants_force(force, study, RETURN_CARD, value);
  sb_propellants_degrees(at, T);
  if (gauge <= 0) {
    return g_strdup_printf(_("delivers nothing at %s °C: below ambient"), at);
  }
  switch (sb_propellants_answer(study, value)) {
  case SB_PROPELLANT_STUCK:
    return g_strdup_printf(_("does not return, %s at %s °C"), force, at);
  case SB_PROPELLANT_WEAKLY:
    return g_strdup_printf(_("returns weakly, %s at %s °C"), force, at);
  case SB_PROPELLANT_RETURNS:
    return g_strdup_printf(_("returns with %s at %s °C"), force, at);
  default:
    return g_strdup_printf(_("no value at %s °C"), at);
  }
}

// "from 14 degC, 2 N from 19 degC".
static char *range_text(const SbStudy *study, int k) {
  const SbStudySeries *series = sb_propellants_series(study, RETURN_CARD, k);
  char from[SB_FORMAT_MAX], limit[SB_FORMAT_MAX], full[SB_FORMAT_MAX];
  const double weak = sb_propellants_weak_below(study);
  const double begins = sb_propellants_rises(series, 0),
               enough = sb_propellants_rises(series, weak);
  const bool always = series != NULL && series->count > 0 && series->y[0] > 0;
  if (isnan(begins) && !always) {
    return g_strdup(_("returns nowhere"));
  }
  g_autofree char *first =
      always ? g_strdup(_("returns everywhere"))
             : g_strdup_printf(_("from %s °C"), sb_format_fixed(from, begins - ZERO, 0));
  if (isnan(enough)) {
    return g_steal_pointer(&first);
  }
  return g_strdup_printf(_("%s, %s from %s °C"), first,
                         sb_format_given(limit, SB_QUANTITY_FORCE, weak),
                         sb_format_fixed(full, enough - ZERO, 0));
}

// The scale of temperature: red, amber, green, the cursor, and its ends.
static void draw_cards_strip(SbCanvas *c, SbRect r, const SbStudy *study, int k, double T) {
  static const double strength[] = {0.15, 0.28, 0.5, 0.5};
  const SbStudySeries *series = sb_propellants_series(study, RETURN_CARD, k);
  const int steps = 280;
  if (series == NULL || series->count < 2) {
    return;
  }
  const double lo = series->x[0], hi = series->x[series->count - 1];
  for (int i = 0, from = 0; i < steps; i++) {
    const SbPropellantsAnswer now = sb_propellants_answer(
        study, sb_propellants_value(series, lo + (hi - lo) * (i + 0.5) / steps));
    const SbPropellantsAnswer then =
        i + 1 < steps ? sb_propellants_answer(
                            study, sb_propellants_value(series, lo + (hi - lo) * (i + 1.5) / steps))
                      : 0;
    if (i + 1 == steps || then != now) {
      sb_canvas_fill(
          c, (SbRect){r.x + r.width * from / steps, r.y, r.width * (i + 1 - from) / steps, 8},
          sb_propellants_role(now), strength[now]);
      from = i + 1;
    }
  }
  char text[SB_FORMAT_MAX];
  const SbTextStyle note = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const SbTextStyle bold = sb_canvas_style(c, SB_TYPE_NOTE, 600, SB_ROLE_INK);
  const double x = r.x + r.width * (T - lo) / (hi - lo);
  if (x >= r.x - 1 && x <= r.x + r.width + 1) {
    sb_canvas_fill(c, (SbRect){x - 1, r.y - 4, 2, 16}, SB_ROLE_INK, 1);
  }
  const double base = r.y + 24;
  const double left =
      sb_canvas_text(c, sb_propellants_degrees(text, lo), &note, r.x, base, SB_LEFT);
  g_autofree char *end = g_strdup_printf("%s °C", sb_propellants_degrees(text, hi));
  const double right = sb_canvas_text(c, end, &note, r.x + r.width, base, SB_RIGHT);
  g_autofree char *range = range_text(study, k);
  const double room = r.width - left - right - 16;
  const double width = fmin(sb_canvas_text_width(c, range, &bold), room);
  sb_canvas_text_fit(c, range, &bold, r.x + left + 8 + (room - width) / 2, base, width + 1);
}

// A figure under its name; its unit smaller.
static void draw_figure(SbCanvas *c, const char *name, const char *number, const char *unit,
                        double x, double y) {
  const SbTextStyle note = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const SbTextStyle value = sb_canvas_style(c, SB_TYPE_PANEL, 600, SB_ROLE_INK);
  sb_canvas_text(c, name, &note, x, y, SB_LEFT);
  const double used = sb_canvas_text(c, number, &value, x, y + 20, SB_LEFT);
  sb_canvas_text(c, unit, &note, x + used + 4, y + 20, SB_LEFT);
}

static bool state_of(SbFluidState *out, const SbModel *model, int k, double T) {
  return sb_fluid_state(out, NULL, &sb_fluids[sb_propellants_fluid(k)], T,
                        sb_model_value(model, SB_P_FLUID_ETHANOL), NULL) == SB_OK;
}

static double gauge_of(const SbFluidState *state, const SbModel *model) {
  return state->figure[SB_FLUID_PRESSURE].value -
         sb_model_value(model, SB_P_CANISTER_AMBIENT_PRESSURE);
}

// Figures of propellant k at the temperature T [K], from x over `width`, with the baseline of their
// names at y [px]. `gauge` is its pressure [Pa].
static void draw_figures(SbCanvas *c, const SbModel *model, int k, double T, double gauge, double x,
                         double y, double width) {
  SbFluidState state;
  const bool known = state_of(&state, model, k, T);
  const double gwp = known ? state.figure[SB_FLUID_GWP].value : NAN;
  const struct {
    const char *name, *unit;
    double value, at;
    int decimals;
  } figures[] = {
      {_("gauge pressure"), "MPa", 1e-6 * gauge, 0, 2},
      {_("density"), "kg/m³", known ? state.figure[SB_FLUID_LIQUID].value : NAN, 0.26, 0},
      {_("viscosity"), "mPa s", known ? 1e3 * state.figure[SB_FLUID_VISCOSITY].value : NAN, 0.53,
       3},
      {"GWP", "", gwp, 0.82, gwp < 10}};
  for (size_t i = 0; i < G_N_ELEMENTS(figures); i++) {
    char number[SB_FORMAT_MAX] = "–";
    if (!isnan(figures[i].value)) {
      sb_format_fixed(number, figures[i].value, figures[i].decimals);
    }
    draw_figure(c, figures[i].name, number, figures[i].unit, x + figures[i].at * width, y);
  }
}

void sb_propellants_card(SbCanvas *c, const SbPropellantsLayout *layout, const SbStudy *study,
                         const SbModel *model, const SbPropellantsLook *look, int k) {
  const SbRect card = layout->card[k];
  const double T = look->temperature, x = card.x + 16, width = card.width - 32;
  const bool own = sb_model_number(model, SB_P_FLUID_NAME) == sb_propellants_fluid(k);
  sb_canvas_panel(c, card);
  if (own) {
    sb_canvas_rounded(c, card, SB_GRID_RADIUS);
    sb_canvas_pen(c, 1.6, NULL);
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_INK), 1);
    cairo_stroke(c->cr);
  }
  const SbTextStyle title = sb_canvas_style(c, SB_TYPE_PANEL_WINDOW, 700, SB_ROLE_INK);
  const SbTextStyle note = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const double line = layout->small ? 18 : 34;
  sb_propellants_sample(c, k, x, card.y + 24, line);
  sb_canvas_text_fit(c, sb_propellants_name(k), &title, x + line + 8, card.y + 29,
                     width - line - 8 - (layout->small && own ? 0 : 76));
  if (own && !layout->small) {
    sb_canvas_text(c, _("in this design"), &note, x + width, card.y + 28, SB_RIGHT);
  }
  if (layout->small) {
    draw_cards_strip(c, (SbRect){x, card.y + 50, width, 8}, study, k, T);
    return;
  }
  char number[SB_FORMAT_MAX];
  SbFluidState state;
  const double gauge = state_of(&state, model, k, T) ? gauge_of(&state, model) : NAN;
  draw_figures(c, model, k, T, gauge, x, card.y + 54, width);
  sb_canvas_hairline(c, x, card.y + 92, x + width, card.y + 92,
                     sb_canvas_role(c, SB_ROLE_HAIRLINE));
  const double force = sb_propellants_value(sb_propellants_series(study, RETURN_CARD, k), T);
  const SbPropellantsAnswer answer =
      gauge <= 0 ? SB_PROPELLANT_STUCK : sb_propellants_answer(study, force);
  SbTextStyle verdict = sb_canvas_style(c, SB_TYPE_LABEL, 600, sb_propellants_role(answer));
  g_autofree char *text = answer_text(study, k, T, gauge);
  draw_sign(c, answer, x, card.y + 117);
  const double dose = sb_propellants_value(sb_propellants_series(study, DOSE, k), T);
  double used = 0;
  if (isfinite(dose)) {
    g_autofree char *mass =
        g_strdup_printf(_("dose %s mg"), sb_format_digits(number, 1e6 * dose, 3));
    used = sb_canvas_text(c, mass, &note, x + width, card.y + 116, SB_RIGHT) + 8;
  }
  sb_canvas_text_fit(c, text, &verdict, x + 20, card.y + 117, width - 20 - used);
  draw_cards_strip(c, (SbRect){x, card.y + 140, width, 8}, study, k, T);
}

char *sb_propellants_text(const SbStudy *study, const SbModel *model,
                          const SbPropellantsLook *look) {
  GString *out = g_string_new(NULL);
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    if ((look->hidden >> k & 1u) == 0) {
      SbFluidState state;
      const bool known = state_of(&state, model, k, look->temperature);
      g_autofree char *answer =
          answer_text(study, k, look->temperature, known ? gauge_of(&state, model) : NAN);
      g_autofree char *range = range_text(study, k);
      g_string_append_printf(out, "%s: %s; %s.\n", sb_propellants_name(k), answer, range);
    }
  }
  g_autofree char *modulus = sb_propellants_modulus(model, look->temperature);
  g_string_append_printf(out, "%s: %s.\n", _("Modulus"), modulus);
  return g_string_free(out, FALSE);
}

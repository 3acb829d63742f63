// Sentences and names of a search for a design; see the header.
#include "app/export/design_text.h"

#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/export/design_results.h"

#include <glib/gi18n.h>
#include <math.h>

char *sb_design_figure_name(int figure) {
  const SbFigure *of = sb_figure(figure);
  return *of->where != '\0'
             ? g_strdup_printf("%s, %s", sb_translation(of->label), sb_translation(of->where))
             : g_strdup(sb_translation(of->label));
}

char *sb_design_goal_text(int figure) {
  const SbFigure *of = sb_figure(figure);
  g_autofree char *inside = sb_translation_inside(of->label);
  g_autofree char *name = *of->where != '\0'
                              ? g_strdup_printf("%s, %s", inside, sb_translation(of->where))
                              : g_strdup(inside);
  return g_strdup_printf(of->better == SB_BETTER_MORE ? _("maximum %s") : _("minimum %s"), name);
}

const char *sb_design_part_text(SbDesignPart part) {
  static const char *const parts[] = {N_("Computing the map"), N_("Searching for the best"),
                                      N_("Tolerances"), N_("Drawing valves")};
  return _(parts[part]);
}

char *sb_design_end_text(const SbDesignAnswer *answer, const char *why) {
  const SbDesign *found = &answer->found;
  if (why != NULL && *why == '\0') {
    return g_strdup_printf(_("Cancelled: %zu of %zu points of the map are there."),
                           answer->map.done, answer->map.n * answer->map.n);
  }
  if (why != NULL) {
    return g_strdup_printf(_("Not finished: %s."), why);
  }
  if (!answer->searched) {
    return g_strdup("");
  }
  if (!found->found) {
    return sb_design_lacking_text(answer->study, found);
  }
  return !found->feasible
             ? g_strdup(
                   _("No start meets all limits: the valve with the smallest violation is shown."))
             : g_strdup_printf(_("%zu of %zu starts meet all limits, %zu evaluations."),
                               found->starts_feasible, found->starts, found->evaluations);
}

char *sb_design_marks_text(const SbDesignAnswer *answer) {
  if (!answer->searched || !answer->found.found) {
    return NULL;
  }
  GString *text = g_string_new(NULL);
  g_autofree char *bounds = sb_design_bounds(&answer->found, answer->study);
  g_autofree char *codes = sb_warning_codes(answer->found.warnings, ", ");
  if (!answer->found.converged) {
    g_string_append(text, _("The search did not converge."));
  }
  if (bounds != NULL) {
    g_string_append(text, text->len > 0 ? "\n" : "");
    g_string_append_printf(text, _("On a bound of the search: %s."), bounds);
  }
  if (codes != NULL) {
    g_string_append(text, text->len > 0 ? "\n" : "");
    g_string_append_printf(text, _("Warnings of validity: %s."), codes);
  }
  return g_string_free(text, text->len == 0);
}

char *sb_design_step_text(SbParamId id, double step, bool tolerance) {
  const SbParam *param = sb_param(id);
  g_autofree char *text = sb_quantity_round(step, param->si, param->unit, 3);
  return tolerance ? g_strconcat("± ", text, NULL) : g_strdup("± 5 %");
}

char *sb_design_share_text(const SbDesignPlace *at, size_t column, size_t k) {
  const double sigma = at->effect[column][k].change / 3;
  const double part = at->variance[column] > 0 ? 100 * sigma * sigma / at->variance[column] : NAN;
  return !at->effect[column][k].tolerance ? g_strdup("–")
         : part < 1                       ? g_strdup("< 1 %")
                                          : g_strdup_printf("%.0f %%", part);
}

char *sb_design_fails_text(const SbDesignPlace *at) {
  if (at->samples == 0 || isnan(at->fails)) {
    return g_strdup("–");
  }
  const double count = at->fails * (double)at->samples;
  return count == 0       ? g_strdup_printf(_("none of %zu"), at->samples)
         : at->fails >= 1 ? g_strdup(_("all"))
                          : g_strdup_printf("%.*f %%", at->fails > 0.99 ? 2 : 1, 100 * at->fails);
}

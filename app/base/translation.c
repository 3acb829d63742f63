// Words of the lower layers in the user's language. Labels of parameters are read for translation
// from engine/valve/model/params.def itself (po/meson.build); the others, which are few, are listed
// here, because the engine knows nothing of translations.
#include "app/base/translation.h"

#include <glib/gi18n.h>
#include <string.h>

// For xgettext only.
G_GNUC_UNUSED static const char *const listed[] = {
    // engine/contact/gland.c
    N_("below"),
    N_("within"),
    N_("above"),
    // engine/valve/studies/study.h
    N_("Load over squeeze"),
    N_("load, peak and width of every fitment model over the squeeze, compared with the solved "
       "ring"),
    N_("Fitment models side by side"),
    N_("thesis, linear disc and finite-strain ring: loads, peaks, widths, sensitivities, friction"),
    N_("Film law from our own solutions"),
    N_("h/R = k U^b W^a regressed over a range, with residuals, compared with eq. 7.5, 7.6 and the "
       "limit"),
    N_("Storage time"),
    N_("load, friction, squeeze and modulus against storage time: relaxation, set, swell"),
    N_("Leak over squeeze"),
    N_("leak at rest and leakage per stroke against the squeeze: below which squeeze the valve "
       "leaks"),
    N_("Stribeck curve"),
    N_("friction, real contact and film of both seals against the speed, as computed in the cycle"),
    N_("Tolerances"),
    N_("loads, break-away and return force over the tolerances of the sizes: worst case and RSS"),
    // app/draw/legend.c
    N_("predicted"),
    // app/chart/life.c
    N_("actuation"),
    N_("force"),
    N_("over the given roughness"),
    N_("leakage, summed"),
    N_("roughness"),
    N_("λ against the first"),
    N_("carried out"),
    N_("net"),
    // app/chart/shelf.c
    N_("lost, summed"),
    N_("the loss is not known"),
    N_("lost a year"),
    N_("all paths"),
    N_("through the rubber"),
    N_("along the contact"),
    N_("through the plastic"),
    N_("water absorbed"),
    N_("the water is not known"),
    N_("doses left"),
    N_("water"),
    N_("doses"),
    N_("rubber"),
    N_("contact"),
    N_("plastic"),
    N_("sum"),
    N_("lost a year, as the valve is now"),
    N_("lost over the shelf time"),
    N_("fraction of the loss"),
    N_("time on the shelf"),
    N_("path"),
    // engine/valve/studies/, app/base/unit.c
    N_("day"),
    N_("month"),
    N_("no value in this range"),
    N_("outer seal"),
    N_("inner seal"),
    N_("this scene"),
    // propellants
    N_("canister temperature"),
    N_("pressure force"),
    N_("break-away force"),
    N_("dose"),
    N_("propellant"),
    N_("break-away"),
    N_("return margin"),
    N_("change"),
    N_("by pressure"),
    N_("by film"),
    N_("by rubber"),
    N_("by expansion"),
    // film law
    N_("solved"),
    N_("our law"),
    N_("ours, central"),
    N_("ours, minimum"),
    N_("thesis, eq. 7.5"),
    N_("thin-film limit"),
    N_("thin-film limit, minimum"),
    N_("sliding speed"),
    N_("central film"),
    N_("law over the solved film"),
    N_("solved against our law"),
    N_("residual, rms"),
    N_("residual, largest"),
    N_("film at the drive's speed"),
    N_("solved, central"),
    N_("solved, minimum"),
    N_("drive"),
    // leak
    N_("squeeze of the free section"),
    N_("pressure of the rubber on the bore"),
    N_("leak at rest"),
    N_("carried out per stroke"),
    N_("squeeze, pressure"),
    N_("no leak: every contact is closed"),
    N_("channels close"),
    // models
    N_("thesis, printed"),
    N_("ring"),
    N_("disc"),
    N_("pressure on the outer seal"),
    N_("load"),
    N_("peak pressure"),
    N_("contact width"),
    N_("friction coefficient by shear strength"),
    N_("case"),
    N_("friction by shear strength"),
    N_("friction with m"),
    N_("canister"),
    N_("load thesis"),
    N_("load disc"),
    N_("load ring"),
    N_("peak thesis"),
    N_("peak disc"),
    N_("peak ring"),
    N_("width thesis"),
    N_("width disc"),
    N_("width ring"),
    // squeeze
    N_("ring, not stretched"),
    N_("load against ring"),
    N_("peak"),
    N_("peak against ring"),
    N_("width"),
    N_("width against ring"),
    N_("as designed"),
    N_("load against ring at 10 %"),
    N_("load against ring at 20 %"),
    N_("load against ring at 30 %"),
    N_("load against ring at 40 %"),
    // storage
    N_("storage time"),
    N_("sliding friction"),
    N_("squeeze"),
    N_("modulus after storage"),
    N_("stored for"),
    N_("load, outer seal"),
    N_("load, inner seal"),
    N_("friction, outer seal"),
    N_("friction, inner seal"),
    N_("section, free"),
    N_("network left"),
    N_("compression set"),
    N_("uptake of its equilibrium"),
    N_("new"),
    N_("1 hour"),
    N_("1 day"),
    N_("7 days"),
    N_("30 days"),
    N_("1 year"),
    N_("3 years"),
    // Stribeck curve
    N_("outer seal, in"),
    N_("outer seal, back"),
    N_("inner seal, in"),
    N_("inner seal, back"),
    N_("coefficient of friction"),
    N_("real contact"),
    N_("central film over roughness"),
    N_("outer seal, in, at"),
    N_("minimum film"),
    N_("film over roughness"),
    N_("boundary friction"),
    N_("viscous friction"),
    N_("coefficient"),
    N_("load on asperities"),
    N_("film = roughness"),
    N_("cycle"),
    N_("cycle, in"),
    N_("cycle, back"),
    // tolerances
    N_("load of the outer seal"),
    N_("load of the inner seal"),
    N_("place in the size's tolerance band"),
    N_("figure"),
    N_("nominal"),
    N_("worst case, minimum"),
    N_("worst case, maximum"),
    N_("root sum square, minimum"),
    N_("root sum square, maximum"),
    N_("by d, outer"),
    N_("by d, inner"),
    N_("by ID, outer"),
    N_("by ID, inner"),
    N_("by g"),
    N_("by bore"),
    N_("by stem"),
    N_("section, outer ring"),
    N_("section, inner ring"),
    N_("inner diameter, outer ring"),
    N_("inner diameter, inner ring"),
    N_("radial space"),
    N_("bore"),
    N_("stem"),
    // app/section/section.c
    N_("von Mises stress"),
    N_("hydrostatic pressure"),
    N_("shear stress"),
    N_("contact pressure"),
    N_("displacement"),
    N_("permeation flux over P Δp"),
    // app/export/render.c
    N_("Axial section"),
    N_("Cutaway in three dimensions"),
    N_("Force and displacement"),
    N_("Contact pressure and film"),
    N_("Dashboard"),
    N_("Thread force and coefficients"),
    N_("Life over its actuations"),
    N_("Report, 1600 \xc3\x97 1200"),
};

const char *sb_translation(const char *text) {
  // The empty text stands for a catalogue's header.
  return text != NULL && text[0] != '\0' ? _(text) : "";
}

char *sb_translation_of_case(const char *text) {
  const char *whole = sb_translation(text), *comma = whole == text ? strchr(text, ',') : NULL;
  g_autofree char *name = comma != NULL ? g_strndup(text, (size_t)(comma - text)) : NULL;
  return name != NULL ? g_strconcat(sb_translation(name), comma, NULL) : g_strdup(whole);
}

locale_t sb_translation_pause(void) {
  locale_t own = duplocale(uselocale((locale_t)0));
  locale_t english = own != (locale_t)0 ? newlocale(LC_MESSAGES_MASK, "C", own) : (locale_t)0;
  if (english == (locale_t)0) {
    if (own != (locale_t)0) {
      freelocale(own);
    }
    return (locale_t)0; // no memory: the words stay in the window's language
  }
  return uselocale(english);
}

void sb_translation_resume(locale_t paused) {
  if (paused != (locale_t)0) {
    freelocale(uselocale(paused));
  }
}

char *sb_translation_inside(const char *label) {
  const char *translated = sb_translation(label);
  return translated == label ? g_utf8_strdown(label, -1) : g_strdup(translated);
}

// The folder of the translations: beside the program as it was installed, wherever that was moved
// to, or, while it runs from where it was built, the build's own.
static char *locale_folder(void) {
  g_autofree char *program = g_file_read_link("/proc/self/exe", NULL);
  g_autofree char *in = g_path_get_dirname(program != NULL ? program : "/");
  static const char *const built[] = {"po", "../po"};
  for (size_t i = 0; i < G_N_ELEMENTS(built); i++) {
    g_autofree char *folder = g_build_filename(in, built[i], NULL);
    if (g_file_test(folder, G_FILE_TEST_IS_DIR)) {
      return g_steal_pointer(&folder);
    }
  }
  return g_build_filename(in, SB_LOCALE_FROM_PROGRAM, NULL);
}

void sb_translation_begin(void) {
  g_autofree char *folder = locale_folder();
  bindtextdomain("sealbench", folder);
  bind_textdomain_codeset("sealbench", "UTF-8");
  textdomain("sealbench");
}

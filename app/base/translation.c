// Words of the lower layers in the user's language. Labels of parameters are read for translation
// from engine/valve/params.def itself (po/meson.build); the others, which are few, are listed here,
// because the engine knows nothing of translations.
#include "app/base/translation.h"

#include <glib/gi18n.h>

// For xgettext only.
G_GNUC_UNUSED static const char *const listed[] = {
    // engine/contact/gland.c
    N_("below"),
    N_("within"),
    N_("above"),
    // engine/valve/studies/study.h
    N_("Load over squeeze"),
    N_("load, peak and width of every fitment model over the squeeze, beside the solved ring"),
    N_("Fitment models side by side"),
    N_("thesis, linear disc and finite-strain ring: loads, peaks, widths, sensitivities, friction"),
    N_("Film law from our own solutions"),
    N_("h/R = k U^b W^a regressed over a range, with residuals, beside eq. 7.5, 7.6 and the limit"),
    N_("Storage time"),
    N_("load, friction, squeeze and modulus against storage time: relaxation, set, swell"),
    N_("Leak over squeeze"),
    N_("leak at rest and leakage per stroke over the squeeze: where too little squeeze leaks"),
    N_("Stribeck curve"),
    N_("friction, real contact and film of both seals over the speed, as the cycle takes them"),
    N_("Tolerances"),
    N_("loads, break-away and return force over the tolerances of the sizes: worst case and RSS"),
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

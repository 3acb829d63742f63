// Texts of the lower layers in the user's language. xgettext reads them where they are
// (po/meson.build): the engine marks them (engine/base/label.h), its catalogues have macros of
// their own.
#include "app/base/translation.h"

#include "app/base/beside.h"

#include <glib/gi18n.h>
#include <string.h>

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

// The folder of the translations: relative to the program as it was installed, wherever it was
// moved to, or, while it runs from where it was built, the build's own.
static char *locale_folder(void) {
  static const char *const places[] = {"po", "../po", SB_LOCALE_FROM_PROGRAM, NULL};
  return sb_beside_program(places, ".");
}

void sb_translation_begin(void) {
  g_autofree char *folder = locale_folder();
  bindtextdomain("sealbench", folder);
  bind_textdomain_codeset("sealbench", "UTF-8");
  textdomain("sealbench");
}

#!/usr/bin/python3
"""Translations: the list of files is right, texts of the window are marked, catalogues are sound.

test_po.py SOURCES XGETTEXT-ARGUMENT..., TAP on standard output.
"""
import glob
import os
import re
import subprocess
import sys
import tempfile

root, arguments = sys.argv[1], sys.argv[2:]
os.chdir(root)

# Calls whose text people read. A text without a letter needs no translation.
SHOWN = re.compile(
    r'(?:gtk_label_new|gtk_button_new_with_label|gtk_expander_new|gtk_label_set_text|'
    r'gtk_button_set_label|gtk_widget_set_tooltip_text|gtk_entry_set_placeholder_text|'
    r'gtk_file_chooser_dialog_new|gtk_file_filter_set_name|sb_style_name|toggle_new)'
    r'\((?:[^;"]*,)?\s*"[^"]*[A-Za-z]{2}|\b(?:say|tell)\((?:[\w>-]+,\s*){1,2}"[^"]*[a-z]{2}',
    re.DOTALL)


def listed():
    with open("po/POTFILES") as file:
        return [line.strip() for line in file if line.strip() and not line.startswith("#")]


def sources():
    return [name for folder in ("ui/*", "app/base", "app/chart", "app/draw", "app/export", "app/section", "app/session",
                                "app/terminal")
            for name in glob.glob(folder + "/*.c")]


def files_that_speak():
    found = [name for name in sources()
             if re.search(r'(?<!\w)(_|N_|ngettext|SB_LABEL)\("', open(name).read())]
    found = [name for name in found if name != "ui/window/main.c"]
    found += [name for name in glob.glob("engine/**/*.[ch]", recursive=True)
              if re.search(r'\bSB_(LABEL|QUANTITY)\("', open(name).read())]
    found += [name for name in glob.glob("assets/ui/*.ui") if 'translatable="yes"' in open(name).read()]
    return found


def potfiles_lists_what_speaks():
    extra = {"engine/valve/figures/figures.def", "engine/valve/model/params.def",
             "assets/org.sealbench.Sealbench.desktop"}
    assert sorted(listed()) == sorted(set(files_that_speak()) | extra), \
        set(listed()) ^ (set(files_that_speak()) | extra)
    assert listed() == sorted(listed()), "not in order"


def texts_of_the_window_are_marked():
    bare = []
    for name in sources():
        text = re.sub(r"(?m)^\s*//.*$|\"sb-\w+\"", "", open(name).read())
        bare += ["%s: %s" % (name, match.group(0)) for match in SHOWN.finditer(text)]
    assert not bare, bare
    for name in glob.glob("assets/ui/*.ui"):
        for match in re.finditer(r'<property name="(label|title|tooltip-text|text|accessible-name)">'
                                 r'([^<]*[A-Za-z]{2}[^<]*)<', open(name).read()):
            assert match.group(2) in ("Sealbench", "MPa"), (name, match.group(0))


def catalogues_are_sound():
    with tempfile.TemporaryDirectory() as folder:
        template = os.path.join(folder, "sealbench.pot")
        subprocess.run(["xgettext", "--from-code=UTF-8", "--files-from=po/POTFILES", "-o", template,
                        *arguments], check=True, stderr=subprocess.DEVNULL)
        # Each macro's label is where the keywords say.
        texts = open(template).read()
        for label in ("Section diameter", "Break-away force", "Contact width", "Closing pressure",
                      "External work", "Shelf temperature", "Women below the peak force", "Load over squeeze",
                      "central film", "as designed", "day", "von Mises stress", "Dashboard"):
            assert 'msgid "%s"' % label in texts, label
        languages = [line.strip() for line in open("po/LINGUAS") if not line.startswith("#")]
        assert languages
        for language in languages:
            fresh = os.path.join(folder, language + ".po")
            subprocess.run(["msgmerge", "-q", "-N", "-o", fresh, "po/%s.po" % language, template],
                           check=True)
            # Places of values, escapes and menu letters agree with the English.
            out = subprocess.run(["msgfmt", "--check-format", "--check-domain", "--statistics", "-o",
                                  "/dev/null", fresh], capture_output=True, text=True, check=True,
                                 env=dict(os.environ, LC_ALL="C")).stderr
            counts = {word: int(number) for number, word in
                      re.findall(r"(\d+) (translated|fuzzy|untranslated)", out)}
            total = sum(counts.values())
            # A new text may come before its translation, but not many.
            assert counts["translated"] > 500 and counts["translated"] >= 0.95 * total, counts


print("1..3")
failed = 0
for number, test in enumerate((potfiles_lists_what_speaks, texts_of_the_window_are_marked,
                               catalogues_are_sound), 1):
    try:
        test()
        print("ok %d - %s" % (number, test.__name__))
    except (AssertionError, subprocess.CalledProcessError) as error:
        failed = 1
        print("not ok %d - %s" % (number, test.__name__))
        print("# %s" % str(error).replace("\n", "\n# "))
sys.exit(failed)

"""The window in German: its own words are translated, numbers, files and pictures stay as they are."""
import re

from harness import App, main, scene, wait

GERMAN = {"LC_ALL": "de_DE.UTF-8", "LANGUAGE": "de"}


def the_window_speaks_german(folder):
    path = scene(folder)
    with App(path, env=GERMAN) as app:
        app.find("push button", "Starten")
        for button in ("Speichern", "Exportieren", "Öffnen"):
            app.find("push button", button)
        wait("the run", lambda: app.label(r"^Zustand [A-F]"))
        # A label of the catalogue and a heading of the panel.
        field = app.field("Schnurdurchmesser")
        assert app.text(field) == "1.61 mm", app.text(field)
        app.find("toggle button", "Dichtungen", showing=False)
        # Numbers have a point, whatever the language.
        app.edit("Schnurdurchmesser", "1650 um")
        wait("the value", lambda: app.value("Schnurdurchmesser") == "1.65 mm")
        app.edit("Schnurdurchmesser", "99 m")
        wait("what is wrong", lambda: app.label(r"^Schnurdurchmesser liegt außerhalb des Bereichs\."))
        app.find("push button", re.compile(r"^Auf 1\.6[15] mm setzen$"))
        app.press("push button", "Rückgängig")
        wait("no error", lambda: not app.label(r"zu berichtigen"))


def an_unknown_language_is_english(folder):
    with App(scene(folder), env={"LC_ALL": "C.UTF-8", "LANGUAGE": "tlh"}) as app:
        wait("the run", app.run_done)


if __name__ == "__main__":
    main(the_window_speaks_german, an_unknown_language_is_english)

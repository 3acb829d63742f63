"""The window in German: its own words and what it draws are translated; numbers and files stay as
they are."""
import os
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
        wait("ranges", lambda: app.label(r"^\S+ bis \S+ mm$"))
        # Numbers have a point, whatever the language.
        app.edit("Schnurdurchmesser", "1650 um")
        wait("the value", lambda: app.value("Schnurdurchmesser") == "1.65 mm")
        app.edit("Schnurdurchmesser", "99 m")
        wait("what is wrong", lambda: app.label(r"^Schnurdurchmesser liegt außerhalb des Bereichs\."))
        app.find("push button", re.compile(r"^Auf 1\.6[15] mm setzen$"))
        app.press("push button", "Rückgängig")
        wait("no error", lambda: not app.label(r"zu berichtigen"))


def drawings_speak_german(folder):
    path = os.path.join(folder, "loop.svg")
    with App(scene(folder), env=GERMAN) as app:
        wait("the run", lambda: app.label(r"^Zustand [A-F]"))
        app.waction("present")
        picture = app.find("image", "Gezeigtes Bild")
        wait("the stage in words", lambda: "Kammer offen" in picture.description)
        app.key("Escape")
        wait("the window alone", lambda: app.node.childCount == 1)
        app.press("push button", "Exportieren")
        app.find("combo box", "Format")
        app.choose("Format", "Zeichnung, SVG")
        app.choose("Ansicht", "Kraft und Weg")
        app.field("Datei").queryEditableText().setTextContents(path)
        button = [node for node in app.all("push button", "Exportieren")
                  if node.getState().contains(app.SENSITIVE)][-1]
        app.act(button, "click")
        wait("the result", lambda: app.label(r"^loop\.svg ist geschrieben"))
    # What is in the file beside the drawing is for programs, too.
    with open(path) as file:
        text = file.read()
    assert re.search(r"Models: fit \w+ .*film \w+", text) and "Error estimates: " in text, text[:2000]


def an_unknown_language_is_english(folder):
    with App(scene(folder), env={"LC_ALL": "C.UTF-8", "LANGUAGE": "tlh"}) as app:
        wait("the run", app.run_done)


if __name__ == "__main__":
    main(the_window_speaks_german, drawings_speak_german, an_unknown_language_is_english)

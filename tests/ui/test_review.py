"""A design review in the window: bookmarks, notes, presentation."""
import re

from harness import App, main, scene, wait

TIMELINE_LEFT, TIMELINE_RIGHT = 8, 20  # px beside its scale


def at_time(app, share):
    """The share of the timeline's width where a share of its time stands."""
    width = app.find("slider", "Timeline").queryComponent().getSize()[0]
    return (TIMELINE_LEFT + share * (width - TIMELINE_LEFT - TIMELINE_RIGHT)) / width


def keep_and_change(app):
    """Keeps the run and makes another design."""
    wait("the first run", app.run_done)
    app.waction("pin")
    app.edit("Radial space", "1.40 mm")
    wait("the new run", lambda: app.label(r"edited") and app.run_done())


def a_bookmark_is_clicked(folder):
    with App(scene(folder)) as app:
        wait("the first run", app.run_done)
        line = app.find("slider", "Timeline")
        app.click(line, at_time(app, 0.6), 0.5)
        wait("half way", lambda: "stage E" in app.status())
        app.waction("bookmark")
        told = wait("the bookmark", lambda: app.label(r"^Bookmark at E"))
        place = app.status()
        app.key("Home")
        wait("the start", lambda: app.status().startswith("stage A"))
        # Its name stands right of its place, where a press on the strips would show another instant.
        box = line.queryComponent().getExtents(0)
        app.click(line, at_time(app, 0.6) + 30 / box.width, 16 / box.height)
        wait("the bookmark's instant", lambda: app.status() == place)
        app.press("toggle button", "Notes and bookmarks")
        name = told.replace("Bookmark at ", "")
        entry = app.find("text", "Name of " + name)
        entry.queryEditableText().setTextContents("worst seal")
        app.act(entry, "activate")
        app.find("push button", "Go to worst seal")
        app.press("push button", "Remove worst seal")
        wait("none", lambda: app.label(r"^None yet"))


def save_until(app, path, line):
    """Saves the document until it has the line."""
    def saved():
        app.waction("save")
        with open(path) as file:
            return line + "\n" in file.read()
    wait("%r in %s" % (line, path), saved)


def notes_are_kept(folder):
    path = scene(folder)
    with App(path) as app:
        keep_and_change(app)
        app.waction("bookmark")
        app.press("toggle button", "Notes and bookmarks")
        note = app.find("text", "Note")
        note.queryEditableText().setTextContents("Ask for a cold can.\nAnd a wide one.")
        # Stored a moment after the last letter, while the text still has the focus.
        save_until(app, path, "review = Ask for a cold can.\\nAnd a wide one.")
        # On a design without a name of its own: it gets the one that it is shown by.
        app.choose("Note on", "design: radial space 1.36 mm")
        wait("an empty note", lambda: app.text(note) == "")
        note.queryEditableText().setTextContents("as shipped")
        save_until(app, path, "radial space 1.36 mm = as shipped")
        app.choose("Note on", "the whole")
        wait("the first note", lambda: app.text(note).startswith("Ask for"))
        app.waction("save")
        wait("told", lambda: app.label(r"^thesis-cycle\.scene is saved"))
    with open(path) as file:
        saved = file.read()
    assert "review = Ask for a cold can.\\nAnd a wide one.\n" in saved, saved
    assert "radial space 1.36 mm = as shipped\n" in saved, saved
    assert re.search(r"(?m)^\[bookmarks\]$", saved), saved


def a_presentation_steps(folder):
    with App(scene(folder)) as app:
        keep_and_change(app)
        app.click(app.find("slider", "Timeline"), at_time(app, 0.35), 0.5)
        app.waction("bookmark")
        wait("the bookmark", lambda: app.label(r"^Bookmark at C"))
        app.waction("present")
        picture = app.find("image", "Presented picture")
        wait("the bookmark's name", lambda: re.match(r"C \d", picture.description))
        for key, what in (("Right", "stage D."), ("Next", "stage E."), ("Left", "stage D."),
                          ("Left", "C "), ("Prior", "stage C."), ("3", "Force and displacement"),
                          ("Down", "Design 2 of 2: radial space 1.36 mm"), ("6", "Figures"),
                          ("Up", "Design 1 of 2: live"), ("5", "Dashboard"), ("2", "Cutaway")):
            app.key(key)
            wait("%s after %s" % (what, key), lambda: what in picture.description)
        app.key("Escape")
        wait("the window alone", lambda: app.node.childCount == 1)
        # The document is as it was.
        assert app.value("Radial space") == "1.4 mm"


def panels_are_hidden(folder):
    with App(scene(folder), parameters=0) as app:
        wait("the first run", app.run_done)
        for key, role, name in (("F9", "text", "Radial space"),
                                ("shift+F9", "chart", "Force and displacement"),
                                ("ctrl+F9", "slider", "Timeline")):
            assert app.has(role, name), name
            app.key(key)
            wait("%s gone" % name, lambda: not app.has(role, name))
        # A search needs what it searches in.
        app.key("ctrl+f")
        wait("the parameters", lambda: app.has("text", "Radial space"))
        app.key("shift+F9")
        app.key("ctrl+F9")
        wait("all", lambda: app.has("chart", "Force and displacement") and app.has("slider", "Timeline"))


if __name__ == "__main__":
    main(a_bookmark_is_clicked, notes_are_kept, a_presentation_steps, panels_are_hidden)

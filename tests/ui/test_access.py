"""Names, keyboard, wheel, theme, and what the window remembers."""
import os
import re
import subprocess

from harness import App, Shared, main, scene, wait

ROLES = {"push button", "toggle button", "check box", "text", "combo box", "spin button", "slider",
         "chart", "image", "progress bar", "check menu item", "radio button"}


def every_control_has_a_name(app, _folder):
    nameless = []
    for role in ROLES - {"image"}:
        for node in app.all(role, showing=False):
            if not node.name:
                parent = node.parent
                nameless.append("%s in %s %r" % (role, parent.getRoleName(), parent.name))
    # A combo box's own button speaks through the box; GtkExpander and menus have labels.
    nameless = [text for text in nameless if "combo box" not in text]
    assert not nameless, nameless
    fields = app.all("text", showing=False)
    assert len(fields) > 40, len(fields)


def charts_say_what_they_show(app, _folder):
    text = app.loop_text()
    for word in ("B 28", "C 27", "break-away force", "return margin", "energy of the loop", "now stage"):
        assert word in text, text
    app.key("Home")
    app.press("push button", "Next event")
    pressure = app.find("chart", "Contact pressure")
    wait("the peak", lambda: re.search(r"Outer seal: peak [\d.]+\sMPa", pressure.description))
    film = app.find("chart", "Film thickness")
    assert "seal" in film.description, film.description
    app.find("image", "Section")


def the_wheel_edits_only_with_the_focus(app, _folder):
    field = app.field("Section diameter")
    box = field.queryComponent().getExtents(0)
    middle = [str(box.x + box.width // 2), str(box.y + box.height // 2)]
    subprocess.run(["xdotool", "mousemove", *middle, "click", "4", "click", "4"], check=True)
    # The panel may have scrolled; the value must not have changed.
    assert app.value("Section diameter") == "1.61 mm"
    subprocess.run(["xdotool", "click", "5", "click", "5", "click", "5"], check=True)
    app.act(app.find("push button", "Run"), "click")
    wait("a run", app.run_done)
    assert app.value("Section diameter") == "1.61 mm"
    field.queryComponent().grabFocus()
    app.key("Up")
    wait("a step", lambda: app.value("Section diameter") == "1.62 mm")
    box = field.queryComponent().getExtents(0)
    middle = [str(box.x + box.width // 2), str(box.y + box.height // 2)]
    subprocess.run(["xdotool", "mousemove", *middle, "click", "5"], check=True)
    wait("a step back", lambda: app.value("Section diameter") == "1.61 mm")


def escape_gives_the_old_value_back(app, _folder):
    app.edit("Radial space", "9 m")
    wait("the error", lambda: app.label(r"1 value to fix"))
    app.field("Radial space").queryComponent().grabFocus()
    app.key("Escape")
    wait("the old value", lambda: app.value("Radial space") == "1.36 mm")
    assert not app.label(r"to fix")


def values_without_effect_are_locked(app, _folder):
    app.unfold("Stem")
    mass = app.field("Moving mass")
    assert not mass.getState().contains(App.SENSITIVE)
    app.choose("Motion", "dynamic")
    wait("the mass open", lambda: app.field("Moving mass").getState().contains(App.SENSITIVE))


def theme_and_size_are_remembered(folder):
    with App(scene(folder)) as app:
        wait("the first run", app.run_done)
        subprocess.run(["gdbus", "call", "--session", "--dest", "org.sealbench.Sealbench",
                        "--object-path", "/org/sealbench/Sealbench", "--method",
                        "org.gtk.Actions.SetState", "theme", "<'dark'>", "{}"], check=True,
                       stdout=subprocess.DEVNULL)
        store = os.path.join(app.folder, "sealbench", "window.ini")

        def stored():
            with open(store) as file:
                return file.read()
        wait("the theme", lambda: "theme=dark" in stored())
        app.gaction("quit")
        wait("the end of the program", lambda: app.process.poll() is not None)
        assert re.search(r"width=1\d\d\d", stored()), stored()


def another_locale_changes_no_number(folder):
    path = scene(folder)
    with App(path, env={"LC_ALL": "de_DE.UTF-8"}) as app:
        wait("the first run", app.run_done)
        app.edit("Section diameter", "1.65 mm")
        wait("the value", lambda: app.value("Section diameter") == "1.65 mm")
        wait("a run", app.run_done)
        assert not app.label(r"^\d+,\d+ ?(mm|N|s)"), app.label(r"\d,\d")
        app.press("push button", "Save")
        wait("saved", lambda: not app.label(r"edited"))
    with open(path) as file:
        assert "section_diameter = 1.65 mm" in file.read()


if __name__ == "__main__":
    main(Shared(every_control_has_a_name, charts_say_what_they_show, the_wheel_edits_only_with_the_focus,
                escape_gives_the_old_value_back, values_without_effect_are_locked),
         theme_and_size_are_remembered, another_locale_changes_no_number)

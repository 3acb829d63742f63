"""Editing, files and undo in the window."""
import os
import pyatspi
import re

from harness import App, Shared, main, scene, wait


def edit_with_a_unit_changes_the_breakaway_force(app, _folder):
    before = app.breakaway()
    assert 24 < before < 31, before
    app.edit("Section diameter", "1650 um")
    wait("the value in the panel's unit", lambda: app.value("Section diameter") == "1.65 mm")
    wait("another break-away force", lambda: app.run_done() and app.breakaway() > before + 1)
    # As people type: the field's unit, a decimal comma, a change, a sum; shown as short as it is.
    for text, shown in (("1,6", "1.6 mm"), ("+5 %", "1.68 mm"), ("1.60 + 0.1/2", "1.65 mm")):
        app.edit("Section diameter", text)
        wait("%s for %s" % (shown, text), lambda: app.value("Section diameter") == shown)
    # A thinner ring is squeezed less.
    app.edit("Section diameter", "0.0639 in")
    wait("a lower force", lambda: app.run_done() and app.breakaway() < before + 1.2)


def bad_values_stay_in_their_field(app, _folder):
    before = app.breakaway()
    for text in ("99 m", "1.61.2", "1,6,1 mm", "1.61 kg", "rubbish", "nan mm", ""):
        app.edit("Section diameter", text)
        wait("one value to fix after %r" % text, lambda: app.label(r"1 value to fix"))
        assert app.label(r"0\.2 to 20 mm\).*\.$|0\.2 to 20 mm\.$"), "no range in the sentence"
    assert app.label(r"^Section diameter cannot be read\. Pictures show the last good run"), \
        app.label("^Section diameter .*Pictures")
    assert app.breakaway() == before
    app.press("push button", "Set 1.61 mm")
    wait("no error", lambda: not app.label(r"to fix"))
    assert app.value("Section diameter") == "1.61 mm"


def values_that_do_not_go_together_are_told_at_their_field(app, _folder):
    app.unfold("Bore")
    app.edit("Bore diameter", "2 mm")
    wait("one value to fix", lambda: app.label(r"to fix"))
    wait("the sentence", lambda: app.label(r"^Radial space is inconsistent with the other values"))
    app.press("push button", "Undo")
    wait("no error", lambda: not app.label(r"to fix"))


def a_file_whose_values_do_not_go_together_opens(folder):
    path = scene(folder)
    with open(path, "a") as file:
        file.write("\n[bore]\ndiameter = 2 mm\n")
    with App(path) as app:
        wait("one value to fix", lambda: app.label(r"to fix"))
        app.edit("Bore diameter", "6 mm")
        wait("the run", lambda: app.run_done() and not app.label(r"to fix"))


def undo_and_redo(app, _folder):
    app.edit("Radial space", "1.40 mm")
    wait("edited", lambda: app.label(r"edited"))
    app.edit("Radial space", "1.42 mm")
    app.press("push button", "Undo")
    wait("1.4", lambda: app.value("Radial space") == "1.4 mm")
    app.press("push button", "Undo")
    wait("1.36", lambda: app.value("Radial space") == "1.36 mm")
    assert not app.label(r"edited")
    app.press("push button", "Redo")
    wait("1.4 again", lambda: app.value("Radial space") == "1.4 mm")
    app.press("push button", "Reset Radial space")
    wait("1.36 again", lambda: app.value("Radial space") == "1.36 mm")
    # The rubber is no value, and edited like one.
    app.unfold("Rubber")
    app.choose("Rubber of both rings", "epdm")
    glass = lambda: app.value("Glass transition")
    wait("the rubber's", lambda: glass() == "-54 °C")
    app.press("push button", "Undo")
    wait("none again", lambda: glass() != "-54 °C")
    app.press("push button", "Redo")
    wait("the rubber's again", lambda: glass() == "-54 °C")


def drawn_groove_is_taken_back(folder):
    path = scene(folder)
    with open(os.path.join(folder, "scenes", "groove.txt"), "w") as file:
        file.write("mm -1.1,1.3 -1,0 1,0 1.1,1.3")
    with open(path, "a") as file:
        file.write("\n[gland]\nprofile_file = groove.txt\n")
    with App(path) as app:
        wait("the first run", app.run_done)
        app.find("text", "Search parameters").queryEditableText().setTextContents("groove")
        wait("what it is drawn by", lambda: app.find("push button", "Drawn groove").description == "groove.txt")
        app.press("push button", "No drawn groove")
        wait("none", lambda: not app.has("push button", "No drawn groove"))
        wait("what undo does", lambda: app.find("push button", "Undo").description == "Drawn groove")
        app.press("push button", "Undo")
        wait("the groove again", lambda: app.has("push button", "No drawn groove"))
        wait("the run", app.run_done)


def saved_values_come_back(folder):
    path = scene(folder)
    with App(path) as app:
        wait("the first run", app.run_done)
        app.edit("Section diameter", "1630 um")
        app.edit("Pressure", "2.9 bar")
        app.unfold("Inner seal only")
        app.edit("Inner seal: Modulus", "3 MPa")
        wait("edited", lambda: app.label(r"edited"))
        app.press("push button", "Save")
        wait("saved", lambda: not app.label(r"edited"))
    with open(path) as file:
        assert "# The compression test of the thesis" in file.read(), "the comment was lost"
    with App(path) as app:
        wait("the first run", app.run_done)
        assert app.value("Section diameter") == "1.63 mm"
        assert app.value("Pressure") == "0.29 MPa"
        app.unfold("Inner seal only")
        assert app.value("Inner seal: Modulus") == "3 MPa"
        assert app.value("Modulus") == "2.5 MPa"


def one_run_is_shown_and_values_keep_their_digits(folder):
    path = scene(folder)
    with App(path) as app:
        wait("the first run", app.run_done)
        # Until solved rings have a first frame, all that is shown is the run before, and says so.
        app.choose("Fitment", "ring")
        former = r"^Until the first new frame the pictures show the run with fitment karaszkiewicz\.$"

        def shown():
            names = [label.name for label in app.all("label")]  # of one instant
            return any(re.search(former, name) for name in names) and names

        names = wait("the former run's name", shown)
        assert any(name.startswith("fit karaszkiewicz,") for name in names), "models of another run"
        assert "run with fitment karaszkiewicz" in names, "derived values of another run"
        app.press("push button", "Stop")
        wait("the strip", lambda: app.label(
            r"^Values have changed\. Pictures show the run with fitment karaszkiewicz\.$"))
        assert not app.label(r"(?i)partial") and app.label(r"^Earlier run$")
        app.press("push button", "Undo")
        wait("no strip", lambda: not app.label(r"Pictures show|^Earlier run$"))
        # On the band is in the band; the playhead stays at its event.
        app.press("push button", "Next event")
        app.press("push button", "Next event")
        wait("stage E", lambda: app.status().startswith("stage E,"))
        app.edit("Section diameter", "1.6 mm")
        wait("15 %", lambda: app.all("label", re.compile(r"^Squeeze 15\s% pass$")))
        # Stepped by the keys, and saved, a value stays short.
        app.field("Section diameter").queryComponent().grabFocus()
        for text in ("1.61 mm", "1.62 mm", "1.63 mm"):
            app.key("Up")
            wait(text, lambda: app.value("Section diameter") == text)
        app.press("push button", "Save")
        wait("saved", lambda: not app.label(r"edited"))
        with open(path) as file:
            assert "section_diameter = 1.63 mm\n" in file.read()
        app.unfold("Output")
        app.edit("Frames", "100000")
        count = app.label_node(r"^\d+ frames")
        wait("the long run", lambda: app.text(count).startswith("1000") and " in " in app.text(count))
        # Solved, its frames are still being read, some at each drawing.
        wait("stage E again", lambda: app.status().startswith("stage E,"))


def closing_asks_about_changes(folder):
    with App(scene(folder)) as app:
        wait("the first run", app.run_done)
        app.edit("Section diameter", "1.63 mm")
        wait("edited", lambda: app.label(r"edited"))
        app.gaction("quit")
        app.press("push button", "Cancel")
        wait("the question gone", lambda: not app.has("push button", "Close without Saving"))
        assert app.value("Section diameter") == "1.63 mm"
        app.gaction("quit")
        app.press("push button", "Close without Saving")
        wait("the end of the program", lambda: app.process.poll() is not None)
        assert app.process.returncode == 0


def broken_files_are_told_in_one_dialog(folder):
    path = os.path.join(folder, "broken.valve")
    with open(path, "w") as file:
        file.write("[sealbench]\nformat = 1\nkind = valve\n[seal]\nsection_diameter = 1.61\n"
                   "modulus = 3 kg\n[nonsense]\nx = 1\n")
    with App(path) as app:
        text = wait("the problems", lambda: app.label(r"section_diameter"))
        for word in ("modulus", "nonsense"):
            assert word in text, text


def search_finds_parameters(app, _folder):
    box = app.find("text", "Search parameters")
    box.queryEditableText().setTextContents("no such thing")
    wait("nothing found", lambda: app.label(r"No parameter matches"))
    box.queryEditableText().setTextContents("viscos")
    wait("the viscosity", lambda: app.has("text", "Viscosity"))
    wait("the rest hidden", lambda: not app.has("text", "Section diameter"))
    box.queryEditableText().setTextContents("")
    wait("everything back", lambda: app.has("text", "Section diameter"))
    # By another name, and by a choice.
    for text, role, found in (("durometer", "text", "Modulus"), ("persson", "combo box", "Surface"),
                              ("stiction", "text", "Static ratio")):
        box.queryEditableText().setTextContents(text)
        wait(found, lambda: app.has(role, found) and not app.has("text", "Section diameter"))
    # Actions too, which do what they say.
    box.queryEditableText().setTextContents("movie")
    wait("the export", lambda: app.has("push button", "Export"))
    box.queryEditableText().setTextContents("3d")
    cutaway = app.find("push button", "Cutaway or section")
    app.act(cutaway, "click")
    wait("the cutaway", lambda: app.find("toggle button", "Cutaway").getState().contains(
        pyatspi.STATE_CHECKED))
    box.queryEditableText().setTextContents("")
    wait("no action", lambda: not app.has("push button", "Cutaway or section"))
    # The main ones, what was changed, all.
    app.press("toggle button", re.compile(r"^Main 16$"))
    # All would have the share below the modulus; what is scrolled out of sight does not count.
    wait("the main ones", lambda: app.has("text", "Axial width") and not app.has("text", "Mooney fraction"))
    app.edit("Radial space", "1.38 mm")
    app.press("toggle button", re.compile(r"^Changed \d+$"))
    wait("what changed", lambda: app.has("text", "Radial space") and not app.has("text", "Section diameter"))
    # Undo says what it takes back, and shows it.
    undo = app.find("push button", "Undo")
    wait("what undo does", lambda: undo.description == "Radial space 1.36 → 1.38 mm")
    app.act(undo, "click")
    wait("it is no change any more, and still shown", lambda: app.value("Radial space") == "1.36 mm"
         and app.has("text", "Radial space"))
    wait("what was undone", lambda: app.label(r"^Undone: Radial space 1\.36 → 1\.38 mm$"))
    assert app.find("push button", "Redo").description == "Radial space 1.36 → 1.38 mm"
    app.press("toggle button", re.compile(r"^All \d+$"))


def unsaved_changes_survive_a_crash(folder):
    path = scene(folder)
    with open(path) as file:
        before = file.read()
    data = os.path.join(folder, "data")
    unsaved = os.path.join(data, "sealbench", "unsaved")
    place = {"XDG_DATA_HOME": data}
    with App(path, env=place) as app:
        wait("the first run", app.run_done)
        assert not os.path.exists(unsaved)
        app.edit("Section diameter", "1650 um")
        app.edit("Radial space", "1.4 mm")
        # Undone in the end: nothing is left to lose.
        app.press("push button", "Undo")
        app.press("push button", "Undo")
        wait("nothing kept", lambda: not os.path.exists(unsaved) or not os.listdir(unsaved))
        app.edit("Section diameter", "1650 um")
        # Under its name: killed before, the writing would leave a temporary file only.
        wait("the kept changes",
             lambda: any(name.endswith(".unsaved") for name in os.listdir(unsaved)))
        app.process.kill()
        app.process.wait(120)
    with open(path) as file:
        assert file.read() == before
    # Later: asked again at the next start, nothing changed.
    with App(env=place) as app:
        app.press("push button", "Later")
        wait("the window", lambda: app.has("push button", "Run"))
        assert app.value("Section diameter") == "1.61 mm"
    with App(env=place) as app:
        app.press("push button", "Restore")
        wait("the value", lambda: app.value("Section diameter") == "1.65 mm")
        wait("edited", lambda: app.label(r"edited"))
        wait("the scene's title", lambda: app.label(r"thesis-cycle\.scene"))
        app.key("ctrl+s")
        wait("saved", lambda: not app.label(r"edited"))
        wait("nothing kept", lambda: not os.listdir(unsaved))
    with open(path) as file:
        assert "section_diameter = 1.65 mm" in file.read()


def help_of_the_parameter_that_is_edited(app, _folder):
    app.field("Section diameter").queryComponent().grabFocus()
    app.key("F1")
    wait("its key", lambda: app.label(r"^seal\.section_diameter, d$"))
    assert app.label(r"^0\.2 mm to 20 mm$"), "no range"
    assert app.label(r"^squeeze \(d − g\)/d"), "no equation"
    assert app.has("drawing area", "Sketch"), "no sketch"
    app.key("Escape")
    wait("no page", lambda: not app.label(r"^seal\.section_diameter"))
    assert app.value("Section diameter") == "1.61 mm"


def effects_stand_beside_the_main_parameters(app, _folder):
    app.choose("Effects", "effect on return margin")

    def told():
        return [node.description for node in app.all("drawing area", "Effect") if node.description]

    wait("bars", lambda: any(re.match(r"return margin [−-].* N per 0\.020 mm$", text) for text in told()))
    app.choose("Effects", "no effects")
    wait("no bars", lambda: not told())


if __name__ == "__main__":
    main(Shared(undo_and_redo),
         Shared(bad_values_stay_in_their_field, values_that_do_not_go_together_are_told_at_their_field,
                help_of_the_parameter_that_is_edited, effects_stand_beside_the_main_parameters,
                search_finds_parameters, edit_with_a_unit_changes_the_breakaway_force),
         a_file_whose_values_do_not_go_together_opens, drawn_groove_is_taken_back,
         saved_values_come_back, one_run_is_shown_and_values_keep_their_digits,
         unsaved_changes_survive_a_crash, closing_asks_about_changes, broken_files_are_told_in_one_dialog)

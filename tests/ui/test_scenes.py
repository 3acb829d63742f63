"""Every shipped scene opens in the window, runs by itself and says what it shows."""
import glob
import os
import re
import time

import pyatspi

from harness import ASSETS, App, main, scene, wait


def shown(app, path):
    """Runs the scene at `path`; checks title, loop and status."""
    with open(path) as file:
        title = re.search(r"(?m)^title = (.*)$", file.read()).group(1)
    wait("the run of %s" % path, app.run_done, timeout=120)
    wait("the title", lambda: app.label("^" + re.escape(title)) or app.has("frame", re.compile(
        re.escape(title))))
    text = app.loop_text()
    assert "nan" not in text.lower() and "inf" not in text.lower(), text
    assert not app.label(r"^Run failed"), path
    assert re.match(r"stage [A-F]", app.status()), app.status()
    return text


def every_scene_runs(folder):
    paths = []
    for path in sorted(glob.glob(os.path.join(ASSETS, "scenes", "*.scene"))):
        with open(path) as file:
            text = file.read()
        if (not re.search("fit = (ring|disc)|set = consistent", text)
                and os.path.basename(path) != "sliding-plate.scene"):
            paths.append(path)
    assert len(paths) >= 8, paths
    # One program, a window after the other: that of the scene before closes.
    with App(paths[0]) as app:
        for number, path in enumerate(paths):
            if number > 0:
                app.replace_window(path, number)
            text = shown(app, path)
            for word in ("B ", "break-away force", "return margin", "energy of the loop"):
                assert word in text, (path, text)


def the_rig_shows_its_coefficients(folder):
    with App(os.path.join(ASSETS, "scenes", "sliding-plate.scene")) as app:
        text = shown(app, os.path.join(ASSETS, "scenes", "sliding-plate.scene"))
        match = re.search(r"static coefficient ([\d.]+), dynamic coefficient ([\d.]+),", text)
        assert match, text
        assert float(match.group(1)) > float(match.group(2)) > 0.4, text
        assert "0.51 measured and 0.4 predicted" in text, text
        reasons = app.find("chart", "Why they differ").description
        assert "which exceed the mean force" in reasons, reasons
        app.find("chart", "Friction over load")
        assert not app.all("toggle button", re.compile("^(Seals|Returns|Doses): ")), "a plate has no verdict"
        # The playhead moves over the signal.
        app.key("Home")
        wait("the start", lambda: app.status().startswith("stage A"))
        app.press("push button", "Next event")
        wait("the first slip", lambda: app.status().startswith("stage B"))


def a_small_window_leaves_room_for_the_section(folder):
    path = scene(folder).replace("thesis-cycle", "roughness-plus-30")
    with App(path, size=(1024, 700)) as app:
        # What nobody may miss stands in words.
        wait("the finding", lambda: app.label(r"^The stem does not return: it is stuck at"))
        app.find("toggle button", re.compile(r"^1 serious of \d+ warnings$"))
        # So does the verdict, in one line; a click shows why, and the instant it is of.
        for name in ("Seals: yes", "Presses: not known", "Returns: no", "Doses: not known",
                     "Leak: not known", "Fits: not known"):
            at = app.find("toggle button", name).queryComponent().getExtents(pyatspi.DESKTOP_COORDS)
            assert at.width > 0 and at.x + at.width < 1024 + 64, (name, at)
        verdict = app.find("toggle button", "Returns: no")
        assert "The stem is stuck at" in verdict.description
        app.act(verdict, "click")
        wait("the return", lambda: re.match(r"stage [EF]–A", app.status()) or app.label(
            r"The stem is stuck at"))

        def closed():
            app.key("Escape")  # lost while the popover still opens
            time.sleep(0.3)
            return not app.label(r"The stem is stuck at")

        wait("the reason closed", closed)
        # The charts have given way; nothing of the toolbar is cut.
        toggle = app.find("toggle button", "Charts")
        wait("no charts", lambda: not app.has("chart", "Force and displacement"))
        box = app.find("image", "Section").queryComponent().getExtents(pyatspi.DESKTOP_COORDS)
        assert box.width > 600 and box.height > 400, box
        for role, name in (("toggle button", "Cutaway"), ("push button", "Zoom in")):
            at = app.find(role, name).queryComponent().getExtents(pyatspi.DESKTOP_COORDS)
            assert box.x <= at.x and at.x + at.width <= box.x + box.width, (name, at, box)
        app.act(toggle, "click")
        app.find("chart", "Force and displacement")


def an_unknown_return_is_told_with_its_reason(folder):
    path = scene(folder).replace("thesis-cycle", "hand-press")
    with App(path) as app:
        wait("the first run", app.run_done)
        app.unfold("Drive")
        app.edit("Finger force", "5 N")
        wait("the finding", lambda: app.label(r"^The stem never slips"))
        value = app.find("label", "Return margin not known ")
        assert "the stem never moved" in value.description, value.description
        app.find("toggle button", "Seals: yes")


def the_start_offers_what_ships(folder):
    with App() as app:
        wait("nothing has run", lambda: app.label("^nothing has run"))
        names = [node.name for node in app.all("push button")]
        for name in ("Piston valve", "Thesis cycle", "Quick look", "Tolerances"):
            assert name in names, names
        app.press("push button", "Quick look")
        wait("its run", app.run_done)
        assert not app.has("push button", "Quick look")


if __name__ == "__main__":
    main(the_start_offers_what_ships, every_scene_runs, the_rig_shows_its_coefficients,
         a_small_window_leaves_room_for_the_section, an_unknown_return_is_told_with_its_reason)

"""The first view is a stored result, where the build has made one. A value of solved rings is edited: its run lands whole and may be exported, and undo and redo bring
both runs back at once. What is shown on the way there is of tests/ui/test_session_rings.c."""
import os

import pyatspi

from harness import ASSETS, App, PROGRAM, main, wait

SCENE = """[sealbench]
format = 1
kind = scene
title = Rings under pressure
valve = %s

[models]
set = consistent
motion = quasi-static

[output]
frames = 60
"""


def write(folder):
    path = os.path.join(folder, "rings.scene")
    with open(path, "w") as out:
        out.write(SCENE % os.path.join(ASSETS, "valves", "piston.valve"))
    return path


def an_edit_is_solved_and_back_at_once(folder):
    with App(write(folder)) as app:
        export = app.find("push button", "Export")

        def whole():
            return (app.run_done() and not app.label(r"coarse, to")
                    and export.getState().contains(App.SENSITIVE))

        wait("the first run", whole, timeout=120)
        first = app.breakaway()
        # A field that this run does not have is told, not drawn as zeros.
        # The section's own, above the row of that name.
        fields = min(app.all("combo box", "Field"), key=lambda each: each.queryComponent().getExtents(
            pyatspi.DESKTOP_COORDS).y).querySelection()
        assert not app.label(r"^This run has no permeation")
        fields.selectChild(5)
        wait("why there is none", lambda: app.label(r"^This run has no permeation: .* von Mises"))
        fields.selectChild(0)
        wait("a field that is there", lambda: not app.label(r"^This run has no permeation"))
        app.edit("Radial space", "1.38 mm")
        wait("the whole run", lambda: app.breakaway() != first and whole(), timeout=120)
        last = app.breakaway()
        app.press("push button", "Undo")
        wait("the first run again", lambda: app.breakaway() == first and whole(), timeout=10)
        app.press("push button", "Redo")
        wait("the last run again", lambda: app.breakaway() == last and whole(), timeout=10)


def the_first_view_is_solved(folder):
    if not os.path.exists(os.path.join(os.path.dirname(PROGRAM), "..", "piston.run")):
        print("# this build has no stored result")
        return
    with App(os.path.join(ASSETS, "scenes", "piston.scene")) as app:
        # Solved rings before any run could have ended, half way through stage C.
        wait("the stored result", lambda: app.label(r"stored result of \d{4}-\d\d-\d\d$"), timeout=10)
        app.press("push button", "Stop")  # the run that confirms it
        assert app.status().startswith("stage C"), app.status()
        stored = app.breakaway()
        assert stored and app.has("combo box", "Field")
        rings = app.find("toggle button", "Rings solved")
        assert rings.getState().contains(pyatspi.STATE_CHECKED)
        # The panel Derived has the digits of the verdict.
        assert app.label(r"^Return margin 4\.90\sN pass$")
        assert not app.find("push button", "Export").getState().contains(App.SENSITIVE)
        # The switch sets models.fit, one step of undo; what was shown comes back at once.
        app.press("toggle button", "Closed form")
        wait("closed forms", lambda: app.label(r"fit karaszkiewicz") and app.run_done())
        assert not rings.getState().contains(pyatspi.STATE_CHECKED)
        wait("their loop, with the next picture", lambda: app.breakaway() not in (None, stored))
        app.press("push button", "Undo")
        wait("the stored result again", lambda: app.breakaway() == stored, timeout=5)
        assert rings.getState().contains(pyatspi.STATE_CHECKED)


if __name__ == "__main__":
    main(the_first_view_is_solved, an_edit_is_solved_and_back_at_once)

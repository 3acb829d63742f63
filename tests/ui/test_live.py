"""A value of solved rings is edited: its run lands whole and may be exported, and undo and redo bring
both runs back at once. What is shown on the way there is of tests/ui/test_session_rings.c."""
import os

from harness import ASSETS, App, main, wait

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
            return (app.run_done() and not app.label(r"warm start")
                    and export.getState().contains(App.SENSITIVE))

        wait("the first run", whole, timeout=120)
        first = app.breakaway()
        app.edit("Radial space", "1.38 mm")
        wait("the whole run", lambda: app.breakaway() != first and whole(), timeout=120)
        last = app.breakaway()
        app.press("push button", "Undo")
        wait("the first run again", lambda: app.breakaway() == first and whole(), timeout=10)
        app.press("push button", "Redo")
        wait("the last run again", lambda: app.breakaway() == last and whole(), timeout=10)


if __name__ == "__main__":
    main(an_edit_is_solved_and_back_at_once)

"""Long runs, cancelling, the playhead, and how long the main loop is blocked."""
import re
import subprocess

import pyatspi

from harness import App, Shared, main, scene, wait


def frames_in(app, node):
    match = re.match(r"^(\d+) frames", app.text(node))
    return int(match.group(1)) if match else 0


def a_long_run_grows_and_can_be_cancelled(app, _folder):
    count = app.label_node(r"^\d+ frames")
    # So many cycles with inertia take minutes on any machine; the default work limit would end them after
    # some seconds.
    app.choose("Motion", "dynamic")
    app.edit("Cycles", "1000")
    app.unfold("Output")
    app.edit("Work limit", "2000000000")
    app.watch_latency()
    app.edit("Frames", "2000000")
    first = wait("the first frames", lambda: 412 < frames_in(app, count) and frames_in(app, count))
    wait("more frames", lambda: frames_in(app, count) > first)
    app.press("push button", "Stop")
    wait("the end", lambda: app.label(r"^Partial run"), timeout=5)
    assert app.has("push button", "Run")
    left = frames_in(app, count)
    assert first < left < 2000000, left
    assert app.label(r"^stage [A-F]")
    app.check_latency("a long run grows")
    # The partial run can be played and scrubbed.
    app.press("push button", "Previous event")
    wait("an event", lambda: re.match(r"stage [A-F],", app.status()))


def a_long_run_ends_by_itself(folder):
    with App(scene(folder, film="thesis")) as app:
        wait("the first run", app.run_done)
        app.unfold("Output")
        app.watch_latency()
        app.edit("Frames", "400000")
        count = app.label_node(r"^\d+ frames")
        wait("the last frame", lambda: frames_in(app, count) >= 400000)
        wait("the summary", app.run_done)
        app.key("Home")
        wait("the start", lambda: app.status().startswith("stage A"))
        app.check_latency("a long run grows")


def the_newest_edit_wins(app, _folder):
    app.unfold("Output")
    field = app.field("Frames")
    count = app.label_node(r"^\d+ frames")
    for text in ("2000000", "300"):
        field.queryEditableText().setTextContents(text)
        app.act(field, "activate")
    wait("the short run", lambda: 300 <= frames_in(app, count) < 400)
    wait("its summary", app.run_done)
    assert not app.label(r"^Partial run")


def a_failed_run_keeps_the_pictures_and_says_why(app, _folder):
    before = app.status()
    # The ring's finite elements take at most four times the modulus.
    app.edit("Modulus", "0.1 MPa")
    app.edit("Pressure", "2 MPa")
    app.choose("Fitment", "ring")
    wait("the state", lambda: app.label(r"^Run failed"))
    text = app.label(r"Look at canister\.pressure\.")
    assert text and "Pictures show" in text, text
    assert app.status().startswith("stage"), before
    for _ in range(3):
        app.press("push button", "Undo")
    wait("a good run", lambda: app.run_done() and not app.label(r"^Run failed"))


def scrub_to_stage_c(app, _folder):
    # By the buttons.
    app.key("Home")
    wait("the start", lambda: app.status().startswith("stage A"))
    for stage in "BC":
        app.press("push button", "Next event")
        wait("stage " + stage, lambda: app.status().startswith("stage %s," % stage))
    match = re.match(r"stage C, ([\d.]+)\smm, ([\d.]+)\sN", app.status())
    assert match, app.status()
    assert abs(float(match.group(1)) - 3.30) < 0.02, app.status()
    assert 26 < float(match.group(2)) < 29, app.status()
    at_c = app.status()
    # Under the pointer the forces are read, which moves nothing.
    chart = app.find("chart", "Force and displacement")
    box = chart.queryComponent().getExtents(pyatspi.DESKTOP_COORDS)
    subprocess.run(["xdotool", "mousemove", str(box.x + box.width // 2),
                    str(box.y + box.height // 2)], check=True)
    text = wait("the read-out", lambda: re.search(
        r"Under the pointer: ([\d.]+)\smm  in ([\d.]+)\sN  back ([\d.]+)\sN\.", chart.description))
    assert 2 < float(text.group(1)) < 5 and float(text.group(2)) > 20 > float(text.group(3)), text
    assert app.status() == at_c
    # The wheel enlarges there; 0 shows all again.
    subprocess.run(["xdotool", "click", "--repeat", "4", "4"], check=True)
    wait("a part", lambda: re.search(r"Enlarged: [\d.]+ to [\d.]+ mm", chart.description))
    chart.queryComponent().grabFocus()
    app.key("0")
    wait("all of it", lambda: "Enlarged" not in chart.description)
    assert app.status() == at_c
    # By the keys.
    app.key("Right")
    wait("the frame after", lambda: app.status() != at_c)
    app.key("ctrl+Left")
    wait("stage C again", lambda: app.status() == at_c)
    # By the mouse: the middle of the timeline is past C and before the return's end.
    app.click(app.find("slider", "Timeline"), 0.5, 0.5)
    wait("the middle", lambda: re.match(r"stage [D-E]", app.status()))


def the_space_bar_plays(app, _folder):
    """In a window as it opens, whatever its buttons are; again, it pauses."""
    app.find("push button", "Play")
    app.key("space")
    app.find("push button", "Pause")
    assert app.run_done(), "the run was begun again or stopped"
    app.key("space")
    app.find("push button", "Play")


def playback_moves_the_playhead(app, _folder):
    # Found before: a walk through the whole window takes its time while it draws.
    button = app.find("push button", "Play")
    status = app.label_node(r"^stage [A-F]")
    first = app.text(status)
    app.watch_latency()
    app.act(button, "click")
    seen = {first}
    wait("movement", lambda: seen.add(app.text(status)) or len(seen) > 20)
    assert button.name == "Pause", button.name
    app.check_latency("the cycle plays")
    app.act(button, "click")
    wait("its own name", lambda: button.name == "Play")
    last = app.text(status)
    assert all(app.text(status) == last for _ in range(100))


if __name__ == "__main__":
    main(Shared(the_space_bar_plays, scrub_to_stage_c, playback_moves_the_playhead,
                a_failed_run_keeps_the_pictures_and_says_why, the_newest_edit_wins, a_long_run_grows_and_can_be_cancelled), a_long_run_ends_by_itself)

"""The cutaway in the window: shown by button and key, turned by the mouse and by keys."""
import os
import re
import subprocess
import tempfile

import pyatspi
from harness import App, main, scene, wait


def angles(area):
    area.clear_cache()
    match = re.search(r"azimuth (-?\d+)°, elevation (-?\d+)°", area.description or "")
    return tuple(int(group) for group in match.groups()) if match else None


def drag(node, dx, dy):
    box = node.queryComponent().getExtents(pyatspi.DESKTOP_COORDS)
    x, y = int(box.x + box.width * 0.6), int(box.y + box.height * 0.5)
    steps = ["mousemove", str(x), str(y), "mousedown", "1"]
    for i in range(1, 6):
        steps += ["mousemove", str(x + dx * i // 5), str(y + dy * i // 5), "sleep", "0.02"]
    subprocess.run(["xdotool", *steps, "mouseup", "1"], check=True)


def picture(node):
    """The pixels of a widget."""
    box = node.queryComponent().getExtents(pyatspi.DESKTOP_COORDS)
    with tempfile.NamedTemporaryFile(suffix=".ppm") as file:
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "x11grab", "-video_size",
                        "%dx%d" % (box.width, box.height), "-i",
                        "%s+%d,%d" % (os.environ["DISPLAY"], box.x, box.y), "-frames:v", "1",
                        file.name], check=True)
        return file.read()


def changed(one, other):
    """Share of bytes that differ."""
    return sum(a != b for a, b in zip(one, other)) / len(one)


def the_cutaway_turns(folder):
    with App(scene(folder)) as app:
        wait("the run", app.run_done)
        area = app.find("image", "Section")
        assert angles(area) is None, area.description
        flat = picture(area)
        app.press("toggle button", "Cutaway")
        wait("the scene's own camera", lambda: angles(area) == (-30, 20))
        wait("another picture", lambda: changed(flat, picture(area)) > 0.1)
        solid = picture(area)
        # To the right and down: the camera goes left and up.
        drag(area, 100, 50)
        wait("the camera moved", lambda: angles(area) == (-66, 38))
        wait("the picture turned", lambda: changed(solid, picture(area)) > 0.1)
        app.key("alt+Right")
        app.key("alt+Up")
        wait("five degrees each", lambda: angles(area) == (-61, 43))
        box = area.queryComponent().getExtents(pyatspi.DESKTOP_COORDS)
        subprocess.run(["xdotool", "mousemove", str(box.x + box.width // 2),
                        str(box.y + box.height // 2), "click", "--repeat", "2", "--delay", "60",
                        "1"], check=True)
        wait("the scene's own camera again", lambda: angles(area) == (-30, 20))
        # But for the focus ring, which the section did not have at first.
        wait("the first picture", lambda: changed(solid, picture(area)) < 0.03)
        app.key("ctrl+d")
        wait("the section again", lambda: angles(area) is None)
        wait("its picture", lambda: changed(flat, picture(area)) < 0.03)


main(the_cutaway_turns)

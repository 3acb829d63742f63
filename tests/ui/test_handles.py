"""Sizes as handles on the section: dragged, taken back, moved by keys, typed over."""
import subprocess
import time

import gi
import pyatspi

gi.require_version("Gdk", "3.0")
from gi.repository import Gdk  # noqa: E402

from harness import App, main, scene, wait  # noqa: E402

ACCENT = bytes((0x2A, 0x6D, 0xB0))
NAME = "Section diameter"
HANDLES = 5  # two rings, radial space, axial width, bore


def xdotool(*words):
    subprocess.run(["xdotool", *(str(word) for word in words)], check=True)


def centres(box):
    """The handles' dots on the screen, from left to right."""
    pixels = Gdk.pixbuf_get_from_window(Gdk.get_default_root_window(), box.x, box.y, box.width, box.height)
    data, stride, size = pixels.get_pixels(), pixels.get_rowstride(), pixels.get_n_channels()
    found = []  # x0, y0, x1, y1
    for y in range(8, box.height - 8):
        row = data[y * stride:y * stride + box.width * size]
        x = row.find(ACCENT)
        while x >= 0:
            if x % size == 0 and 8 <= x // size < box.width - 8:
                at = x // size
                for dot in found:
                    if dot[0] - 12 <= at <= dot[2] + 12 and y - dot[3] <= 6:
                        dot[:] = [min(dot[0], at), dot[1], max(dot[2], at), y]
                        break
                else:
                    found.append([at, y, at, y])
            x = row.find(ACCENT, x + 1)
    return sorted((box.x + (d[0] + d[2]) // 2, box.y + (d[1] + d[3]) // 2) for d in found
                  if 6 <= d[3] - d[1] <= 14)


def sizes_are_handles(folder):
    with App(scene(folder), parameters=0) as app:
        wait("the first run", app.run_done)
        area = app.find("image", "Section")

        def extents():
            return area.queryComponent().getExtents(pyatspi.DESKTOP_COORDS)

        place = extents()

        def value():
            return float(app.value(NAME).split()[0])

        def ring():
            """Where the inner ring's edge is, at rest."""
            wait("a shown run", app.run_done)
            box = extents()
            xdotool("mousemove", box.x + box.width - 30, box.y + 30)
            at = []

            def rests():
                at.append(centres(box))
                time.sleep(0.2)  # a run that is shown may still move the picture
                if len(at[-1]) != HANDLES or at[-2:-1] != at[-1:]:
                    raise AssertionError("handles at %s, then at %s" % (at[-2:-1], at[-1]))
                return at[-1][0]

            return wait("the handles", rests)

        def grab(dx, steps=4):
            x, y = ring()
            xdotool("mousemove", x, y, "mousedown", 1)
            for i in range(1, steps + 1):
                xdotool("mousemove", x + dx * i // steps, y)

        assert value() == 1.61
        # Outwards is larger; Escape takes the drag back while it is held, and nothing is left to undo.
        grab(-16)
        wait("a larger ring", lambda: value() > 1.61)
        xdotool("key", "Escape")  # app.key() would let go of the button first
        wait("as before", lambda: value() == 1.61)
        xdotool("mouseup", 1)
        # A whole drag is one step.
        grab(-16)
        wait("a larger ring", lambda: value() > 1.7)
        xdotool("mouseup", 1)
        wait("what undo does", lambda: app.find("push button", "Undo").description.startswith(NAME + " 1.61 → "))
        app.key("ctrl+z")
        wait("as before, at once", lambda: value() == 1.61)
        # A press picks it: arrows, finer with Shift.
        xdotool("mousemove", *ring(), "click", 1)
        for key, now in (("Up", 1.62), ("Right", 1.63), ("Down", 1.62), ("shift+Up", 1.621)):
            app.key(key)
            wait("%g after %s" % (now, key), lambda: abs(value() - now) < 1e-9)
        # What is typed goes to its row.
        xdotool("mousemove", *ring(), "click", 1)
        time.sleep(0.2)  # the press of a double click would be another
        for key in ("1", "period", "5", "7", "Return"):
            app.key(key)
        wait("the typed size", lambda: value() == 1.57)
        # A size that the valve cannot have stays out of reach: the drag ends at the last that it can,
        # however fast the hand is.
        largest = []
        for steps in (40, 1):
            grab(-400, steps)
            xdotool("mouseup", 1)
            wait("a ring of a possible size", lambda: value() > 1.7 and not app.label(r"to fix"))
            largest.append(value())
            app.key("ctrl+z")
            wait("as before", lambda: value() == 1.57)
        assert largest[0] == largest[1], largest
        # What the largest ring's run says above the picture goes with it.
        wait("the run of the last size", app.run_done)
        wait("the picture where it was", lambda: extents() == place)


if __name__ == "__main__":
    main(sizes_are_handles)

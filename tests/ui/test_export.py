"""Exports from the window: pictures, films, and cancelling one."""
import os
import struct
import subprocess

from harness import COMMAND, App, Shared, main, scene, wait


def open_dialog(app, path, kind, view=None):
    wait("the first run", app.run_done)
    app.press("push button", "Export")
    app.find("combo box", "Format")
    app.choose("Format", kind)
    if view is not None:
        app.choose("View", view)
    app.field("File").queryEditableText().setTextContents(path)


def export_button(app):
    return [node for node in app.all("push button", "Export") if node.getState().contains(
        app.SENSITIVE)][-1]


def close_dialog(app):
    # The window has a button of that name too.
    app.act(app.all("push button", "Close")[-1], "click")
    wait("the dialog gone", lambda: not app.has("combo box", "Format"))


def a_picture(app, folder):
    path = os.path.join(folder, "loop.png")
    open_dialog(app, path, "Picture, PNG", "Dashboard")
    app.act(export_button(app), "click")
    wait("the result", lambda: app.label(r"^loop\.png is written"))
    with open(path, "rb") as file:
        head = file.read(24)
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    assert struct.unpack(">II", head[16:24]) == (1920, 1080)
    # A second export of the same name asks first.
    app.act(export_button(app), "click")
    app.press("push button", "Keep")
    assert os.path.exists(path)
    close_dialog(app)


def a_film(app, folder):
    path = os.path.join(folder, "cycle.mp4")
    open_dialog(app, path, "Movie, MP4", "Axial section")
    app.spin("Width", 320)
    app.spin("Height", 180)
    app.spin("Frames per second", 10)
    app.spin("Duration", 2)
    app.act(export_button(app), "click")
    wait("the result", lambda: app.label(r"^cycle\.mp4 is written: 20 frames"))
    close_dialog(app)
    probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v",
                            "-show_entries", "stream=codec_name,pix_fmt,nb_read_frames,width",
                            "-of", "csv=p=0", path], capture_output=True, text=True, check=True)
    assert probe.stdout.strip() == "h264,320,yuv420p,20", probe.stdout


def a_sequence(app, folder):
    path = os.path.join(folder, "cycle.png")
    open_dialog(app, path, "Pictures of a movie, PNG", "Axial section")
    app.spin("Width", 320)
    app.spin("Height", 180)
    app.spin("Frames per second", 10)
    app.choose("From", "Stage B")
    app.choose("To", "Stage C")
    app.choose("Pace", "at a speed of")
    app.spin("Speed", 20)
    app.act(export_button(app), "click")
    # B to C lasts 9.9 s: half a second of film.
    wait("the result", lambda: app.label(r"^5 pictures are written"))
    names = sorted(name for name in os.listdir(folder) if name.startswith("cycle-"))
    assert names == [f"cycle-{i:04d}.png" for i in range(1, 6)], names
    close_dialog(app)


def a_cancelled_film(app, folder):
    path = os.path.join(folder, "cycle.mp4")
    open_dialog(app, path, "Movie, MP4", "Dashboard")
    app.spin("Duration", 600)
    app.watch_latency()
    app.act(export_button(app), "click")
    bar = app.find("progress bar", "Progress of the export")
    wait("progress", lambda: bar.queryValue().currentValue > 0)
    app.check_latency("a film is made")
    app.press("push button", "Cancel")
    text = wait("the result", lambda: app.label(r"^Cancelled: "))
    assert "partial" in text, text
    # The file is there, playable and short; the window goes on.
    assert 0 < os.path.getsize(path) < 50e6
    close_dialog(app)
    assert app.run_done()
    assert not [name for name in os.listdir(folder) if "tmp" in name or name.startswith(".")]


def a_place_that_cannot_be_written(app, _folder):
    open_dialog(app, "/proc/nowhere/loop.png", "Picture, PNG")
    app.act(export_button(app), "click")
    wait("the reason", lambda: app.label(r"^Nothing was written: "))
    close_dialog(app)


def a_report(folder):
    """The pages of the shown run by the menu's action, and a bookmark that they and the file keep."""
    path = os.path.join(folder, "pages.pdf")
    file = scene(folder)
    day = {"SOURCE_DATE_EPOCH": "1700000000"}
    with App(file, env=day) as app:
        wait("the first run", app.run_done)
        app.waction("bookmark")
        wait("an edited document", lambda: app.label(r", edited$"))
        app.waction("save")
        wait("a saved document", lambda: not app.label(r", edited$"))
        with open(file) as saved:
            assert "[bookmarks]\n" in saved.read()
        app.waction("report")
        dialog = app.find("file chooser", "Report to")
        name = wait("the name of the file", lambda: [
            node for node in app.all("text", root=dialog) if app.text(node) == "thesis-cycle.pdf"])[0]
        name.queryEditableText().setTextContents(path)
        # The header has a button of that name, too.
        app.act(app.all("push button", "Save", root=dialog)[0], "click")
        wait("the result", lambda: app.label(r"^pages\.pdf is written"))
    with open(path, "rb") as pages:
        text = pages.read()
    assert text[:4] == b"%PDF"
    for heading in ["Summary", "Figures", "From the review", "Inputs", "Sources"]:
        assert b"/Title (" + heading.encode() + b")" in text, heading
    # The same pages as the command's, byte for byte.
    other = os.path.join(folder, "command.pdf")
    subprocess.run([COMMAND, "report", file, "-o", other], env={**os.environ, **day}, check=True)
    with open(other, "rb") as pages:
        assert pages.read() == text


if __name__ == "__main__":
    main(Shared(a_picture, a_film, a_sequence, a_cancelled_film, a_place_that_cannot_be_written), a_report)

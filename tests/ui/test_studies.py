"""The window of studies: computed beside the window, marked when values change, cancelled, written."""
import os
import re

from harness import App, main, scene, wait


def open_studies(app):
    wait("the first run", app.run_done)
    app.key("ctrl+t")
    return app.find("chart", "Study")


def a_study_of_the_document(folder):
    path = os.path.join(folder, "law.png")
    with App(scene(folder)) as app:
        chart = open_studies(app)
        app.choose("Study", "Film law from our own solutions")
        wait("the law", lambda: "ours, central\t3.8" in (chart.description or ""))
        app.field("Picture").queryEditableText().setTextContents(path)
        app.press("push button", "Write Picture")
        wait("the result", lambda: app.label(r"^law\.png is written\.$"))
        with open(path, "rb") as file:
            assert file.read(8) == b"\x89PNG\r\n\x1a\n"
        # A change of values marks it and computes nothing by itself.
        app.edit("Viscosity", "0.3 mPa.s")
        wait("the mark", lambda: app.label(r"^Values have changed: the study shown is of earlier"))
        app.press("push button", "Compute Again")
        wait("the former one named", lambda: app.label(
            r"^Computing: Film law.*\. The picture is of the study before\.$")
            and "of the one before" in chart.description)
        wait("no mark", lambda: not app.label(r"^(Values have changed: the study|Computing)"))


def a_study_can_be_cancelled(folder):
    with App(scene(folder)) as app:
        open_studies(app)
        app.watch_latency()
        app.choose("Study", "Leak over squeeze")
        wait("enough to judge by", lambda: app.latency()["samples"] > 60)
        app.press("push button", "Cancel")
        wait("the end", lambda: app.label(r"^No study: the study was cancelled"))
        app.find("push button", "Compute Again")
        app.check_latency("a study is computed")


def glands_of_both_seals(folder):
    with App(scene(folder)) as app:
        wait("the first run", app.run_done)
        app.unfold("Glands, both seals")
        app.find("label", re.compile(r"^Squeeze outer 15\.5\s% inner 15\.5\s% tight, customary 15 to 25"))
        app.find("label", re.compile(r"^Extrusion gap outer 0\.206\smm .* above, customary 0\.05 to 0\.13"))
        # A smaller inner ring only; without its tolerances nothing is tight.
        app.unfold("Inner seal only")
        app.edit("Inner seal: Section diameter", "1.5 mm")
        app.find("label", re.compile(r"^Squeeze outer 15\.5\s% inner 9\.33\s% below"))


if __name__ == "__main__":
    main(a_study_of_the_document, a_study_can_be_cancelled, glands_of_both_seals)

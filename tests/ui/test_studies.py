"""The window of studies: computed beside the window, marked when values change, cancelled, written."""
import contextlib
import glob
import json
import os
import re
import sqlite3
import subprocess

from harness import ASSETS, COMMAND, App, Shared, main, scene, wait


def open_studies(app):
    wait("the first run", app.run_done)
    app.key("ctrl+t")
    return app.find("chart", "Study")


def a_study_of_the_document(app, folder):
    path = os.path.join(folder, "law.png")
    chart = open_studies(app)
    app.choose("Study", "Film law from our own solutions")
    wait("the law", lambda: "ours, central\t3.8" in (chart.description or ""))
    app.field("Picture").queryEditableText().setTextContents(path)
    app.press("push button", "Write Picture")
    wait("the result", lambda: app.label(r"^law\.png is written\.$"))
    with open(path, "rb") as file:
        assert file.read(8) == b"\x89PNG\r\n\x1a\n"
    # One that takes a second, so that it can be looked at while it is computed.
    app.choose("Study", "Fitment models side by side")
    wait("the models", lambda: (chart.description or "").startswith("Fitment models side by side")
         and not app.label(r"^Computing"))
    # A change of values marks it and computes nothing by itself.
    app.edit("Viscosity", "0.3 mPa.s")
    wait("the mark", lambda: app.label(r"^Values have changed: the study shown is of earlier"))
    app.press("push button", "Compute Again")
    wait("the former one named", lambda: app.label(
        r"^Computing: Fitment models side by side.*\. The picture is of the study before\.$")
        and "of the one before" in chart.description)
    wait("no mark", lambda: not app.label(r"^(Values have changed: the study|Computing)"))


def a_study_can_be_cancelled(app, _folder):
    open_studies(app)
    app.watch_latency()
    app.choose("Study", "Leak over squeeze")
    wait("enough to judge by", lambda: app.latency()["samples"] > 60)
    app.press("push button", "Cancel")
    wait("the end", lambda: app.label(r"^No study: the study was cancelled"))
    app.find("push button", "Compute Again")
    app.check_latency("a study is computed")


def glands_of_both_seals(app, _folder):
    app.unfold("Glands, both seals")
    app.find("label", re.compile(r"^Squeeze outer 15\.5\s% inner 15\.5\s% tight, customary 15 to 25"))
    app.find("label", re.compile(r"^Extrusion gap outer 0\.206\smm .* above, customary 0\.05 to 0\.13"))
    # A smaller inner ring only, judged by the row of 1.78 mm of the gland tables as well.
    app.unfold("Inner seal only")
    app.edit("Inner seal: Section diameter", "1.56 mm")
    app.find("label", re.compile(r"^Squeeze outer 15\.5\s% inner 12\.8\s% below"))
    # The tables have no section within an eighth of 1.5 mm: there is no judgement of that ring.
    app.edit("Inner seal: Section diameter", "1.5 mm")
    app.find("label", re.compile(r"^Squeeze outer 15\.5\s% inner 9\.33\s% not judged"))


def return_margin(path, *settings):
    """The margin of the return [N] that the command line computes."""
    command = [COMMAND, "run", path, "--json", "-"]
    for setting in settings:
        command += ["--set", setting]
    run = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    return json.loads(run.stdout)["cycle"]["force_return_margin_N"]


def propellants_are_swapped(folder):
    """The page follows edits by itself, a propellant is chosen and the choice undone, and one that is
    hidden has no card."""
    path = os.path.join(os.path.dirname(scene(folder)), "propellant-swap.scene")
    with App(path) as app:
        wait("the first run", app.run_done)
        app.key("ctrl+4")
        chart = app.find("chart", "Propellants over the temperature")
        wait("the study", lambda: "HFA-134a: does not return" in (chart.description or ""))
        # The one of the scene has no button.
        app.find("push button", "Choose HFA-134a")
        assert not app.has("push button", "Choose HFO-1234ze(E)")
        app.press("push button", "Choose HFA-134a")
        app.find("push button", "Choose HFO-1234ze(E)")
        app.key("ctrl+z")
        wait("the choice undone", lambda: not app.has("push button", "Choose HFO-1234ze(E)"))
        app.edit("Temperature of the cursor", "45 °C")
        margin = return_margin(path, "fluid.name=hfa-134a", "canister.temperature=45 degC")
        shown = re.compile(r"HFA-134a: returns with ([\d.]+)\sN at 45")
        number = wait("the cursor", lambda: shown.search(chart.description)).group(1)
        # Rounded by the rule for figures, and interpolated between the temperatures of the study.
        assert abs(float(number) - margin) < 0.06, (number, margin)
        app.key("ctrl+1")
        app.edit("Radial space", "1.45 mm")
        app.key("ctrl+4")
        wait("the study again", lambda: "HFA-134a: returns with " + number not in chart.description)
        app.press("toggle button", "HFA-227ea")
        wait("three", lambda: "HFA-227ea" not in chart.description)
        app.key("ctrl+1")
        app.find("chart", "Force and displacement")


def the_thesis_is_computed(app, _folder):
    """A table and a figure of the thesis, whatever the document; one that is chosen meanwhile counts."""
    app.key("ctrl+5")
    wait("the first table", lambda: app.label(r"(?s)^Table 2\.1.*agrees"))
    app.choose("Table or figure", "Figure 7.8: film over the sliding speed")
    app.choose("Table or figure", "Figure 6.5: full Sommerfeld condition")
    chart = app.find("chart", "Figure 6.5: full Sommerfeld condition")
    assert "Half Sommerfeld" in chart.description, chart.description
    wait("its text", lambda: app.label(r"(?s)^Figure 6\.5"))
    app.key("ctrl+1")
    app.find("chart", "Force and displacement")


def a_loop_is_fitted(folder):
    """A scene with data is fitted when its page is looked at; the estimates go into the valve, can be
    undone, and what was recognised can be said otherwise."""
    path = os.path.join(folder, "bench.scene")
    with open(path, "w") as file:
        file.write("[sealbench]\nformat = 1\nkind = scene\nvalve = %s/valves/piston.valve\n"
                   "[models]\nfit = karaszkiewicz\nfilm = thesis\n"
                   "[data]\nfile = %s/series/bench.csv\n" % (ASSETS, ASSETS))
    with App(path) as app:
        wait("the first run", app.run_done)
        app.key("ctrl+3")
        chart = app.find("chart", "Measured loops and the fitted valve")
        # The bench was made with 0.174 and 3.42 mm.
        wait("the fit", lambda: re.search(r"friction.load_coefficient: 0\.17[345]", chart.description or ""))
        assert re.search(r"bore.land_edge: 3\.4[123]\d* mm, .* yes", chart.description), chart.description
        app.press("push button", "Use estimates")
        # Cancelled, the fit shows the best values so far, without intervals.
        app.press("push button", "Fit again")
        wait("the fit begun", lambda: app.find(
            "progress bar", "Progress of the fit").queryValue().currentValue > 0.1)
        app.press("push button", "Cancel")
        wait("the best so far", lambda: app.label(r"^Interrupted: the best values so far"))
        assert re.search(r"(?m)^bore\.land_edge: 3\.[34]\d* mm$", chart.description), chart.description
        app.press("push button", "Fit again")
        wait("the fit again", lambda: re.search(r"friction.load_coefficient: 0\.17[345]", chart.description))
        app.key("ctrl+z")
        app.key("ctrl+1")
        app.find("chart", "Force and displacement")


def answers_of_a_design_are_kept(folder):
    """What the page Design has computed is there in the next session: nothing is computed again."""
    path, counts = scene(folder, film="thesis"), []
    for _ in range(2):
        with App(path, env={"XDG_CACHE_HOME": folder}) as app:
            wait("the first run", app.run_done)
            app.key("ctrl+2")
            chart = app.find("chart", "Map of the design")
            wait("the map", lambda: "1089 of 1089 points" in (chart.description or ""))
            app.waction("close")
            app.process.wait(10)
        kept, = glob.glob(os.path.join(folder, "sealbench", "answers-*.store"))
        with contextlib.closing(sqlite3.connect(kept)) as store:
            counts.append(store.execute("SELECT count(*) FROM answer").fetchone()[0])
    assert counts[0] >= 1089 and counts[1] == counts[0], counts


def a_better_design_is_found(folder):
    """The page Design: the map fills in, the best is found within limits that can be changed, any two
    parameters are axes, a point is opened or kept, and the best goes into the valve in one step."""
    with App(scene(folder, film="thesis")) as app:
        wait("the first run", app.run_done)
        app.key("ctrl+2")
        chart = app.find("chart", "Map of the design")
        wait("the map", lambda: "1089 of 1089 points" in (chart.description or ""))
        app.press("push button", "Find best")
        wait("the best", lambda: "best found, Section diameter" in chart.description
             and app.has("push button", "Find best"))
        first = float(re.search(r"best found.*Break-away force ([\d.]+)", chart.description).group(1))
        assert app.label(r"^8 of 8 starts meet all limits")
        # A stricter limit costs break-away force.
        app.edit("Minimum Squeeze, outer seal", "12")
        wait("the map again", lambda: "best found" not in chart.description
             and app.has("push button", "Find best"))
        app.press("push button", "Find best")
        wait("the best again", lambda: "best found" in chart.description
             and app.has("push button", "Find best"))
        second = float(re.search(r"best found.*Break-away force ([\d.]+)", chart.description).group(1))
        assert second > first, (first, second)
        squeeze = re.search(r"best found.*Squeeze ([\d.]+)", chart.description).group(1)
        assert float(squeeze) == 12, chart.description
        app.press("push button", "Use best")
        app.key("ctrl+1")
        wait("the values", lambda: app.value("Section diameter") == "1.45 mm")
        app.key("ctrl+z")
        wait("both taken back", lambda: app.value("Section diameter") == "1.63 mm"
             or app.value("Section diameter") == "1.61 mm")
        before = app.value("Radial space")
        assert before == "1.36 mm", before
        # Two other axes.
        app.key("ctrl+2")
        app.choose("Parameter across", "Inner diameter")
        wait("the other map", lambda: "Map of Inner diameter and Radial space: 1089 of 1089"
             in chart.description)
        # A point by keys, kept and opened.
        chart.queryComponent().grabFocus()
        app.key("Up")
        wait("the point", lambda: app.label(r"^inner diameter 2\.84\d* mm, radial space 1\.3"))
        app.press("push button", "Save design")
        wait("it is told", lambda: app.label(r"^The design is saved"))
        app.press("push button", "Open design")
        app.key("ctrl+1")
        wait("its value", lambda: app.value("Radial space") != before)


if __name__ == "__main__":
    main(a_better_design_is_found, answers_of_a_design_are_kept, a_loop_is_fitted, propellants_are_swapped,
         Shared(the_thesis_is_computed, a_study_can_be_cancelled, a_study_of_the_document, glands_of_both_seals))

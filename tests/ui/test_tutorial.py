"""docs/tutorial.md, step by step: each of its headings is a function here, in its order."""
import os
import re

from harness import ASSETS, App, main, scene, wait


def open_the_thesis_cycle(app, folder):
    wait("the run", app.run_done)
    assert round(app.breakaway(), 1) == 28.7, app.breakaway()
    wait("the verdict", lambda: app.label(r"^0\.30\d*\sN"))


def find_what_you_want_to_change(app, folder):
    for words, name in [("groove depth", "Radial space"), ("hardness", "Modulus"),
                        ("von mises", "Field")]:
        app.find("text", "Search parameters").queryEditableText().setTextContents(words)
        wait("%s by %s" % (name, words),
             lambda: app.has("text", name) or app.has("combo box", name))
    app.find("text", "Search parameters").queryEditableText().setTextContents("no such thing")
    wait("nothing", lambda: app.label(r"^No parameter matches"))
    app.find("text", "Search parameters").queryComponent().grabFocus()
    app.key("Escape")
    wait("all again", lambda: app.has("text", "Section diameter"))


def change_it_and_look(app, folder):
    app.edit("Radial space", "1.40")
    wait("a lighter break-away", lambda: app.run_done() and app.breakaway() < 28)
    app.key("ctrl+z")
    wait("as before", lambda: app.run_done() and round(app.breakaway(), 1) == 28.7)


def pin_the_valve_for_comparison(app, folder):
    app.key("ctrl+p")
    wait("the chip", lambda: app.label(r"^as now$"))


def see_where_good_valves_are(app, folder):
    app.key("ctrl+2")
    chart = app.find("chart", "Map of the design")
    wait("the map", lambda: "1089 of 1089 points" in (chart.description or ""))
    assert "present, Section diameter 1.61 mm, Radial space 1.36 mm" in chart.description
    wait("time to ask", lambda: app.has("push button", "Find best"))


def set_the_limits(app, folder):
    app.edit("Minimum Squeeze, outer seal", "10")
    app.press("toggle button", "Bounds")
    app.press("check box", "Meet all limits with a probability of 99.9 % over the tolerances")
    app.key("Escape")


def find_the_best(app, folder):
    chart = app.find("chart", "Map of the design")
    wait("time to ask", lambda: app.has("push button", "Find best"))
    app.press("push button", "Find best")
    wait("the best", lambda: "best found" in chart.description and app.has("push button", "Find best"))
    best = chart.description[chart.description.index("best found"):]
    returns, squeeze = (float(re.search(name + r" (-?[\d.]+)", best).group(1))
                        for name in ("Return margin", "Squeeze"))
    # Room for the tolerances: not at the limits.
    assert returns > 2 and squeeze > 10.5, best
    beyond = app.label(r"^(none of 2000|0\.[0-3] %)$")
    assert beyond, "too many beyond the limits"


def put_it_into_the_valve(app, folder):
    app.press("push button", "Use best")
    app.key("ctrl+1")
    wait("other sizes", lambda: app.value("Section diameter") != "1.61 mm"
         and app.value("Radial space") != "1.36 mm")
    wait("their run", lambda: app.run_done() and app.breakaway() < 28)
    wait("the kept one's name", lambda: app.label(r"^section diameter 1\.61 mm"))


def write_the_report(app, folder):
    path = os.path.join(folder, "valve.pdf")
    app.key("ctrl+s")
    wait("a saved document", lambda: not app.label(r", edited$"))
    app.key("ctrl+shift+e")
    dialog = app.find("file chooser", "Report to")
    name = wait("the name of the file", lambda: [
        node for node in app.all("text", root=dialog) if app.text(node) == "thesis-cycle.pdf"])[0]
    name.queryEditableText().setTextContents(path)
    app.act(app.all("push button", "Save", root=dialog)[0], "click")
    wait("the result", lambda: app.label(r"^valve\.pdf is written"))
    with open(path, "rb") as pages:
        assert pages.read(4) == b"%PDF"


STEPS = [open_the_thesis_cycle, find_what_you_want_to_change, change_it_and_look,
         pin_the_valve_for_comparison, see_where_good_valves_are, set_the_limits,
         find_the_best, put_it_into_the_valve, write_the_report]


def the_tutorial(folder):
    with open(os.path.join(ASSETS, "..", "docs", "tutorial.md")) as text:
        titles = re.findall(r"(?m)^## \d+\. (.*)$", text.read())
    names = [re.sub(r"\W+", "_", title.lower().replace("thesis' ", "thesis ")) for title in titles]
    assert names == [step.__name__ for step in STEPS], names
    with App(scene(folder)) as app:
        for step in STEPS:
            step(app, folder)
            print("# step: " + step.__name__, flush=True)


if __name__ == "__main__":
    main(the_tutorial)

"""Drives sealbench-gtk by accessible names, waiting on states and never for a fixed time.

Each test is one process under `dbus-run-session -- display.sh`. `start()` runs the program with a
configuration folder of its own; everything is looked up by role and name in the accessibility tree.
"""
import functools
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback

import gi

gi.require_version("Atspi", "2.0")
import pyatspi  # noqa: E402
from gi.repository import Atspi, GLib  # noqa: E402

PROGRAM = os.environ["SEALBENCH_GTK"]
COMMAND = os.path.join(os.path.dirname(os.path.dirname(PROGRAM)), "sealbench")
ASSETS = os.environ["SEALBENCH_ASSETS"]
TIMEOUT = 120.0
# On a busy machine an answer takes longer than the 0.8 s that AT-SPI waits by default [ms].
Atspi.set_timeout(20000, 60000)
# By the names that AT-SPI has for them.
ROLES = {Atspi.role_get_name(role): role
         for role in (Atspi.Role(number) for number in range(Atspi.Role.LAST_DEFINED))}


def wait(what, question, timeout=TIMEOUT):
    """Asks again and again until the answer is true; returns it. A question that takes the window long is asked
    less often: the window has most of the time for itself."""
    end = time.monotonic() + timeout
    last = None
    while time.monotonic() < end:
        asked = time.monotonic()
        try:
            answer = question()
            if answer:
                return answer
        except Exception as error:  # a widget that went away while we looked
            last = error
        time.sleep(min(max(0.02, 3 * (time.monotonic() - asked)), 0.5))
    raise AssertionError("waited %.0f s for: %s (%r)" % (timeout, what, last))


def machine_busy():
    """Processor time that the whole machine has used so far [s]."""
    with open("/proc/stat") as file:
        user, nice, system, _idle, _wait, irq, softirq, steal = map(int, file.readline().split()[1:9])
    return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK")


def slowness():
    """How many times longer this machine takes than one on which the limits are meant (at least 1):
    processor time of a fixed piece of work, the least of five, against 15 ms."""
    times = []
    for _ in range(5):
        start = time.process_time()
        sum(i * i for i in range(400000))
        times.append(time.process_time() - start)
    return max(1.0, min(times) / 0.015)


class Slow(AssertionError):
    """A limit of time is missed: asked again, since what else the machine does shows in it."""


class App:
    SENSITIVE = pyatspi.STATE_SENSITIVE

    def __init__(self, *files, env=None, theme="light", size=(1260, 900), parameters=2):
        self.folder = tempfile.mkdtemp(prefix="sealbench-ui-")
        config = os.path.join(self.folder, "sealbench")
        os.makedirs(config)
        with open(os.path.join(config, "window.ini"), "w") as out:
            # Without a choice of its own a test sees all parameters, not the main ones.
            out.write("[window]\ntheme=%s\nwidth=%d\nheight=%d\nparameters=%d\n"
                      % (theme, *size, parameters))
        self.latency_path = os.path.join(self.folder, "latency.json")
        self.surroundings = dict(
            os.environ, XDG_CONFIG_HOME=self.folder, XDG_DATA_HOME=self.folder,
            XDG_CACHE_HOME=self.folder,
            SEALBENCH_LATENCY=self.latency_path, NO_AT_BRIDGE="0", G_DEBUG="fatal-criticals",
            GTK_RECENT_FILES_ENABLED="0")
        self.surroundings.update(env or {})
        self.process = subprocess.Popen([PROGRAM, *files], env=self.surroundings)
        self.node = wait("the program's window", self._find)

    def _find(self):
        if self.process.poll() is not None:
            raise SystemExit("the program ended with %d" % self.process.returncode)
        desktop = pyatspi.Registry.getDesktop(0)
        for i in reversed(range(desktop.childCount)):  # the last one registered last
            try:
                app = desktop.getChildAtIndex(i)
                if app is not None and app.get_process_id() == self.process.pid and app.childCount > 0:
                    return app
            except GLib.GError:
                pass  # one that ends answers no more
        return None

    # Looking -----------------------------------------------------------------------------------

    def all(self, role, name=None, root=None, showing=True):
        """The widgets of a role. The program itself searches (AT-SPI's collections, one question a
        window); asking each of two thousand widgets over the bus takes it a second of its main loop."""
        states = Atspi.StateSet.new([Atspi.StateType.SHOWING] if showing else [])
        every, any_ = Atspi.CollectionMatchType.ALL, Atspi.CollectionMatchType.ANY
        rule = Atspi.MatchRule.new(states, every, {}, every, [ROLES[role]], any_, [], every, False)
        def answer():
            tops = [root] if root is not None else [
                self.node.getChildAtIndex(i) for i in range(self.node.childCount)]
            # What a collection finds lies below its node.
            return [node for top in tops if top is not None
                    for node in (*([top] if top.get_role() == ROLES[role] else []),
                                 *top.get_collection_iface().get_matches(
                                     rule, Atspi.CollectionSortOrder.CANONICAL, 0, True))
                    if self._named(node, name)],
        # On a busy machine an answer may take longer than the 0.8 s that AT-SPI waits.
        return wait("an answer of the window", answer)[0]

    @staticmethod
    def _named(node, name):
        if name is None:
            return True
        if hasattr(name, "search"):
            return name.search(node.name or "") is not None
        return node.name == name

    def find(self, role, name, showing=True, timeout=TIMEOUT):
        return wait("%s %r" % (role, name),
                    lambda: (self.all(role, name, showing=showing) or [None])[0], timeout)

    def has(self, role, name):
        return bool(self.all(role, name))

    def label(self, pattern):
        """The first shown label whose text matches."""
        expression = re.compile(pattern)
        labels = self.all("label")
        # A label's name is its text, unless it was given another.
        for node in labels:
            if expression.search(node.name or ""):
                return self.text(node)
        for node in labels:
            text = self.text(node)
            if expression.search(text):
                return text
        return None

    def label_node(self, pattern):
        """The label itself, for asking often: a walk through the whole window takes its time."""
        expression = re.compile(pattern)
        return wait("a label like %s" % pattern,
                    lambda: ([node for node in self.all("label")
                              if expression.search(self.text(node))] or [None])[0])

    @staticmethod
    def text(node):
        try:
            interface = node.queryText()
            return interface.getText(0, interface.characterCount)
        except NotImplementedError:
            return node.name or ""

    def status(self):
        """Text of the status bar's first label: "stage C, 3.30 mm, 27.4 N"."""
        return self.label(r"^(stage [A-F]|nothing has run)") or ""

    # Doing -------------------------------------------------------------------------------------

    def press(self, role, name, action="click"):
        self.act(self.find(role, name), action)

    @staticmethod
    def act(node, action):
        actions = node.queryAction()
        names = [actions.getName(i) for i in range(actions.nActions)]
        assert action in names, "%r offers %r" % (node.name, names)
        actions.doAction(names.index(action))

    def unfold(self, group):
        node = self.find("toggle button", group, showing=False)
        if not node.getState().contains(pyatspi.STATE_EXPANDED):
            self.act(node, "activate")

    def field(self, name):
        # It may be scrolled out of sight.
        return self.find("text", name, showing=False)

    def edit(self, name, text):
        node = self.field(name)
        node.queryEditableText().setTextContents(text)
        self.act(node, "activate")

    def value(self, name):
        return self.text(self.field(name))

    def choose(self, combo, item):
        """Picks an item of a combo box."""
        node = self.find("combo box", combo, showing=False)

        def names():  # its items may be made again while they are read
            items = self.all("menu item", root=node, showing=False)
            found = [self.text(entry) or entry.name for entry in items]
            return found if item in found else None
        index = wait("the item %r of %r" % (item, combo), names).index(item)
        node.querySelection().selectChild(index)

    def spin(self, name, number):
        self.find("spin button", name).queryValue().currentValue = number

    def key(self, combination):
        subprocess.run(["xdotool", "key", "--clearmodifiers", combination], check=True)

    def click(self, node, share_x, share_y):
        box = node.queryComponent().getExtents(pyatspi.DESKTOP_COORDS)
        x = int(box.x + box.width * share_x)
        y = int(box.y + box.height * share_y)
        subprocess.run(["xdotool", "mousemove", str(x), str(y), "click", "1"], check=True)

    def gaction(self, name):
        """Calls an action of the application, as a desktop would."""
        subprocess.run(["gdbus", "call", "--session", "--dest", "org.sealbench.Sealbench",
                        "--object-path", "/org/sealbench/Sealbench", "--method",
                        "org.gtk.Actions.Activate", name, "[]", "{}"], check=True,
                       stdout=subprocess.DEVNULL)

    def waction(self, name, number=1):
        """Calls an action of a window."""
        subprocess.run(["gdbus", "call", "--session", "--dest", "org.sealbench.Sealbench",
                        "--object-path", "/org/sealbench/Sealbench/window/%d" % number, "--method",
                        "org.gtk.Actions.Activate", name, "[]", "{}"], check=True,
                       stdout=subprocess.DEVNULL)

    def replace_window(self, path, number):
        """Opens a file as a desktop would, which makes a window, and closes window `number` (from 1)."""
        subprocess.run([PROGRAM, path], env=self.surroundings, check=True)
        wait("the other window", lambda: self.node.childCount == 2)
        self.waction("close", number)
        wait("the former window gone", lambda: self.node.childCount == 1)

    def latency(self):
        """What the program's own probe of its main loop has measured."""
        if os.path.exists(self.latency_path):
            os.remove(self.latency_path)
        self.gaction("write-latency")

        def read():
            with open(self.latency_path) as file:
                return json.load(file)
        return wait("the latency file", read)

    def watch_latency(self):
        """Measures from here; check_latency() judges."""
        self.gaction("reset-latency")
        self.since = (time.monotonic(), machine_busy())

    def check_latency(self, what):
        """At most 50 ms at the 99th percentile and 200 ms ever. Where more than half of the processors
        are at work on average (the display server and this script take their part) waiting is for the
        scheduler to answer, and only the window's own part of it is judged; on a machine slower than
        that of the limits, the limits are as much longer."""
        latency = self.latency()
        start, before = self.since
        load = (machine_busy() - before) / (time.monotonic() - start) / os.cpu_count()
        slow = slowness()
        own = "own_" if load > 0.5 else ""
        print("# main loop blocked while %s: %.1f ms at the 99th percentile, %.1f ms at most (own "
              "work %.1f and %.1f ms); processors %.0f %% at work, machine %.2f times as slow" % (
                  what, latency["p99_ms"], latency["max_ms"], latency["own_p99_ms"],
                  latency["own_max_ms"], 100 * load, slow))
        assert latency["samples"] > 50, latency
        if latency[own + "p99_ms"] > 50 * slow or latency[own + "max_ms"] > 200 * slow:
            raise Slow("%s blocks the main loop: %s" % (what, latency))

    def loop_text(self):
        return self.find("chart", "Force and displacement").description or ""

    def breakaway(self):
        """The break-away force that the loop's description tells, in newtons."""
        match = re.search(r"break-away force ([\d.]+)\sN", self.loop_text())
        return float(match.group(1)) if match else None

    def run_done(self):
        return self.has("push button", "Run") and self.breakaway() is not None

    def quit(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            self.process.wait(TIMEOUT)
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *problem):
        self.quit()


def scene(folder, **values):
    """A copy of the shipped scene beside its valve, with keys replaced."""
    shutil.copytree(os.path.join(ASSETS, "valves"), os.path.join(folder, "valves"))
    shutil.copytree(os.path.join(ASSETS, "scenes"), os.path.join(folder, "scenes"))
    path = os.path.join(folder, "scenes", "thesis-cycle.scene")
    with open(path) as file:
        text = file.read()
    for key, value in values.items():
        text = re.sub(r"(?m)^%s = .*$" % key, "%s = %s" % (key, value), text)
    with open(path, "w") as file:
        file.write(text)
    return path


def least_of(test, runs):
    """Runs a test, again where only a limit of time is missed: the least of some runs counts."""
    for left in reversed(range(runs)):
        try:
            with tempfile.TemporaryDirectory() as folder:
                return test(folder)
        except Slow as slow:
            print("# %s" % slow)
            if left == 0:
                raise


class Shared:
    """A window on the shipped scene for tests that run one after the other in it, since its start takes
    seconds. Each leaves it as the next expects it; one that fails, or is too slow and runs again, is followed
    by a new window."""

    def __init__(self, *tests):
        self.tests = tests
        self.app = None

    def run(self, test, folder):
        if self.app is None:
            self.folder = tempfile.TemporaryDirectory()
            self.app = App(scene(self.folder.name))
            wait("the first run", self.app.run_done)
        try:
            test(self.app, folder)
        except Exception:
            self.close()
            raise

    def close(self):
        if self.app is not None:
            self.app.quit()
            self.folder.cleanup()
            self.app = None


def main(*entries):
    """Runs the tests and prints TAP: functions of a folder of their own, and Shared ones of a window and a
    folder. Arguments: none, or `only NAME...` or `without NAME...`."""
    window_of = {test: entry for entry in entries if isinstance(entry, Shared) for test in entry.tests}
    tests = [test for entry in entries for test in getattr(entry, "tests", [entry])]
    how, names = (sys.argv[1:2] or [None])[0], sys.argv[2:]
    unknown = set(names) - {test.__name__ for test in tests}
    assert how in (None, "only", "without") and not unknown, "arguments %r" % sys.argv[1:]
    if how is not None:
        tests = [test for test in tests if (test.__name__ in names) == (how == "only")]
    # The bus and its registry talk on standard output too: results go through a descriptor of their own.
    if "SEALBENCH_TAP_FD" in os.environ:
        sys.stdout = os.fdopen(int(os.environ["SEALBENCH_TAP_FD"]), "w", buffering=1)
    print("1..%d" % len(tests))
    failed = 0
    for number, test in enumerate(tests, 1):
        start, window = time.monotonic(), window_of.get(test)
        try:
            least_of(test if window is None else functools.partial(window.run, test), 3)
            print("ok %d - %s" % (number, test.__name__))
            print("# %.1f s" % (time.monotonic() - start), flush=True)
        except Exception:
            failed += 1
            print("not ok %d - %s" % (number, test.__name__))
            print("# %s" % traceback.format_exc().replace("\n", "\n# "), flush=True)
        if window is not None and window is not window_of.get((tests + [None])[number]):
            window.close()
    sys.exit(1 if failed else 0)

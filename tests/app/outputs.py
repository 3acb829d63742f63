#!/usr/bin/env python3
"""What the program writes, and refuses to write: descriptors closed at its start, inputs as outputs,
targets told before the work, progress, equal files from equal runs, files of earlier results.
Arguments: the program, the assets."""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

program, assets = map(os.path.abspath, sys.argv[1:3])
quick = os.path.join(assets, "scenes", "quick-look.scene")
ring = os.path.join(assets, "scenes", "ring-cycle.scene")
home = tempfile.mkdtemp(prefix="sealbench-outputs-")
tests = []


def test(function):
    tests.append(function)


def run(*arguments, **options):
    options.setdefault("timeout", 100)
    return subprocess.run([program, *arguments], capture_output=True, text=True, **options)


def path(*parts):
    return os.path.join(home, *parts)


def read(name):
    with open(name, "rb") as file:
        return file.read()


def expect(got, wanted, what=""):
    assert got == wanted, f"{what}: got {got!r}, expected {wanted!r}"


def done(result, code=0):
    expect(result.returncode, code, result.stderr)
    return result


film = ("--view", "hysteresis", "--size", "320x200", "--duration", "0.2s")


@test
def closed_descriptors():
    """No output becomes descriptor 0, 1 or 2."""
    done(run("render", quick, "-o", path("open.mp4"), *film))
    for descriptors in [(0,), (1,), (2,), (0, 1, 2)]:
        out = path("closed.mp4")

        def close():
            for fd in descriptors:
                os.close(fd)

        subprocess.run([program, "render", quick, "-o", out, *film, "--progress", "lines"],
                       preexec_fn=close, check=True)
        expect(read(out), read(path("open.mp4")), f"closed {descriptors}")
        json_out = path("closed.json")
        subprocess.run([program, "run", quick, "--json", json_out], preexec_fn=close)
        json.loads(read(json_out))
    # Results that go nowhere are a failure, not silence.
    closed = subprocess.run([program, "list", "views"], preexec_fn=lambda: os.close(1),
                            stderr=subprocess.PIPE, text=True)
    done(closed, 3)


@test
def inputs_are_no_outputs():
    where = path("inputs")
    os.mkdir(where)
    shutil.copy(os.path.join(assets, "valves", "piston.valve"), where)
    with open(os.path.join(where, "drive.csv"), "w") as file:
        file.write("time [s],displacement [mm]\n")
        file.writelines(f"{i},{min(i, 20 - i) * 0.3}\n" for i in range(21))
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    with open(os.path.join(where, "top.stl"), "w") as file:
        file.write("solid t\n")
        for face in faces:
            file.write("facet normal 0 0 0\nouter loop\n")
            file.writelines("vertex %g %g %g\n" % corners[i] for i in face)
            file.write("endloop\nendfacet\n")
        file.write("endsolid t\n")
    scene = os.path.join(where, "a.scene")
    with open(scene, "w") as file:
        file.write("[sealbench]\nformat = 1\nkind = scene\nvalve = piston.valve\n"
                   "[models]\nfit = karaszkiewicz\nfilm = thesis\nmotion = quasi-static\n"
                   "[part.stem_top]\ndensity = 1410 kg/m3\nstl = %s\nunit = mm\n" % os.path.join(where, "top.stl"))
    measured = os.path.join(where, "b.scene")
    with open(measured, "w") as file:
        file.write("[sealbench]\nformat = 1\nkind = scene\nvalve = piston.valve\n"
                   "[drive]\nkind = measured\nfile = drive.csv\n[models]\nmotion = dynamic\n")
    picture = os.path.join(where, "frame-0002.png")
    done(run("render", quick, "-o", picture, "--view", "hysteresis", "--size", "320x200"))
    os.symlink("a.scene", os.path.join(where, "link"))
    os.link(scene, os.path.join(where, "a.pdf"))
    os.link(os.path.join(where, "piston.valve"), os.path.join(where, "second"))
    before = {name: read(os.path.join(where, name)) for name in os.listdir(where)}
    cases = [
        ("run", scene, "--json", "a.scene"), ("run", scene, "--json", "link"),
        ("run", scene, "--json", "piston.valve"), ("run", scene, "--json", "second"),
        ("run", scene, "--json", "top.stl"), ("run", measured, "--json", "drive.csv"),
        ("run", picture, "--json", "frame-0002.png"), ("plan", scene, "--json", "a.scene"),
        ("render", picture, "-o", "frame-0002.png"), ("render", picture, "-o", "."),
        ("render", picture, "-o", "frame-%04d.png"),
        ("report", os.path.join(where, "a.pdf"), "-o", "a.pdf"),
        ("fit", os.path.join(where, "piston.valve"), "--seal", "outer", "--json", "second"),
        ("film", "--load", "850N/m", "--speed", "1m/s", "--radius", "0.8mm", "--modulus", "6MPa",
         "--viscosity", "0.2mPa.s", "--model", "inverse", "--dry-pressure", "dry.csv", "--json",
         "dry.csv"),
    ]
    with open(os.path.join(where, "dry.csv"), "w") as file:
        file.writelines(f"{(i - 20) * 2.5e-5},{1e6 * (1 - ((i - 20) / 20) ** 2) ** 2}\n"
                        for i in range(41))
    before["dry.csv"] = read(os.path.join(where, "dry.csv"))
    for case in cases:
        result = done(run(*case, cwd=where), 1)
        assert "is an input of this command" in result.stderr, result.stderr
        now = {name: read(os.path.join(where, name)) for name in os.listdir(where)}
        expect(now == before, True, case)
    # Series as one of the files of the results' folder.
    os.rename(os.path.join(where, "drive.csv"), os.path.join(where, "cycle.csv"))
    with open(measured) as file:
        text = file.read().replace("drive.csv", "cycle.csv")
    with open(measured, "w") as file:
        file.write(text)
    result = done(run("run", measured, "-o", ".", cwd=where), 1)
    assert "cycle.csv: is an input" in result.stderr, result.stderr
    # Two outputs in one file.
    result = done(run("run", quick, "-o", "r", "--json", "r/cycle.csv", cwd=where), 1)
    assert "two outputs" in result.stderr, result.stderr
    assert not os.path.exists(os.path.join(where, "r"))


@test
def told_before_the_work():
    cases = [("run", ring, "-o", "/proc/none"), ("run", ring, "--json", "/no/such/file"),
             ("run", ring, "-o", path(), "--json", home), ("render", ring, "-o", "/no/such/x.mp4"),
             ("render", ring, "-o", "/proc/none/"), ("render", ring, "-o", "/no/such.pdf"),
             ("run", ring, "-o", quick), ("report", ring, "-o", "/no/such.pdf")]
    for case in cases:
        result = done(run(*case, "--progress", "lines", timeout=20), 3)
        assert " %" not in result.stderr, result.stderr


@test
def overwriting():
    out = path("once.json")
    done(run("run", quick, "--json", out, "--no-overwrite", "--quiet"))
    first = os.stat(out).st_ino
    result = done(run("run", quick, "--json", out, "--no-overwrite", "-q"), 1)
    assert "exists already" in result.stderr, result.stderr
    expect(os.stat(out).st_ino, first)
    done(run("run", quick, "--json", out, "--no-overwrite", "--overwrite", "-q"))


@test
def progress():
    """Silent off a terminal, unless it is asked for; whole lines of JSON; a reader may go."""
    for command in [("run", quick, "--json", "-"), ("render", quick, "-o", path("p.mp4"), *film),
                    ("render", quick, "-o", path("p.png"), "--view", "section")]:
        expect(done(run(*command)).stderr, "")
    lines = done(run("run", quick, "--json", "-", "--progress", "lines")).stderr.split("\n")
    expect(lines[:2] + lines[-2:], ["sealbench: 10 %", "sealbench: 20 %", "sealbench: 100 %", ""])
    result = done(run("render", quick, "-o", path("p.mp4"), *film, "--progress", "json"))
    objects = [json.loads(line) for line in result.stderr.splitlines()]
    fractions = [o["fraction"] for o in objects if o["event"] == "progress"]
    assert fractions and max(fractions) == 1, fractions
    assert {"computing", "drawing"} == {o["work"] for o in objects if o["event"] == "progress"}
    assert all(o["event"] in ("progress", "message") for o in objects)
    done(run("run", quick, "--progress", "dots"), 1)
    expect(done(run("check", quick, "-q")).stdout, "")

    out = path("gone.json")
    reader, writer = os.pipe()
    os.close(reader)
    code = subprocess.run([program, "run", quick, "--json", out, "--progress", "lines"],
                          stderr=writer, restore_signals=True).returncode
    os.close(writer)
    expect(code, 0, "a reader of progress that has gone")
    json.loads(read(out))


def reports():
    """Pages of a scene and of a study: equal bytes, to a stream too; what must be in the outline."""
    studies = os.path.join(assets, "studies")
    study = path("small.study")
    with open(os.path.join(studies, "gland.study")) as file:
        text = file.read().replace("samples = 2000", "samples = 60")
    with open(study, "w") as file:
        file.write(text.replace("../scenes", os.path.join(assets, "scenes")))
    limited = path("limited.scene")
    with open(limited, "w") as file:
        file.write(f"[sealbench]\nformat = 1\nkind = scene\nvalve = {assets}/valves/piston.valve\n"
                   "[models]\nfit = karaszkiewicz\nfilm = thesis\n[output]\nstudies = storage\n"
                   "[limits]\ncycle.force_return_min_N = >= 20 N\n"
                   "[cases]\nwide = gland.radial_space = 1.38 mm\n")
    for source, headings in [(limited, ["Summary", "Force, contact and film", "Figures", "Stages",
                                        "Seals", "Storage time", "Inputs", "Models", "Sources"]),
                             (study, ["Limits", "Figures over the samples", "Varied parameters",
                                      "How the figures are spread", "Sensitivities"])]:
        names = [path(f"report-{i}.pdf") for i in range(2)]
        dated = dict(os.environ, SOURCE_DATE_EPOCH="86400")
        done(run("report", source, "-o", names[0], env=dated))
        done(run("report", source, "-o", names[1], "-q", "--jobs", "1", env=dated)
             if source == study else run("report", source, "-o", names[1], "-q", env=dated))
        expect(read(names[0]) == read(names[1]), True, "report of " + source)
        stream = subprocess.run([program, "report", source, "-o", "-"], capture_output=True, env=dated)
        expect(stream.stdout == read(names[0]), True, "report to a stream")
        # The kind of the file decides, not its name: the same pages from a name without an ending and a stream.
        nameless = path("nameless")
        shutil.copy(source, nameless)
        for operand, stdin in [(nameless, ""), ("-", open(source).read())]:
            piped = subprocess.run([program, "report", operand, "-o", "-"], capture_output=True, env=dated, text=False,
                                   input=stdin.encode())
            expect((piped.stdout[:5], piped.returncode), (b"%PDF-", 0), f"report {operand} of {source}")
        for heading in headings:
            assert f"/Title ({heading})".encode() in read(names[0]), heading
        assert b"19700102000000Z" in read(names[0])
        done(run("report", source, "-o", names[0], "--no-overwrite"), 1)
    for case in [("report", limited), ("report", limited, "-o", "x.png"),
                 ("report", os.path.join(studies, "light-valve.study"), "-o", path("x.pdf")),
                 ("report", os.path.join(studies, "bench.study"), "-o", path("x.pdf")),
                 ("report", study, "-o", path("x.pdf"), "--measured", "y.csv")]:
        result = done(run(*case), 1)
        assert result.stderr, case
    assert not os.path.exists(path("x.pdf")) and not os.path.exists(path("small.store"))


@test
def equal_runs():
    """Equal runs give equal files, endings in capitals or not."""
    for ending in ["pdf", "SVG", "PNG", "Mp4", "Pdf"]:
        names = [path(f"equal-{i}.{ending}") for i in range(2)]
        for name in names:
            more = film if ending == "Mp4" else ("--view", "dashboard")
            done(run("render", quick, "-o", name, *more))
            time.sleep(1.1 if ending == "pdf" else 0)
        expect(read(names[0]) == read(names[1]), True, ending)
        if ending != "Mp4":
            stream = subprocess.run([program, "render", quick, "-o", "-", "--format",
                                     ending.lower(), "--view", "dashboard"], capture_output=True)
            expect(stream.stdout == read(names[0]), True, "-o - " + ending)
    reports()
    dated = path("dated.pdf")
    done(run("render", quick, "-o", dated, env=dict(os.environ, SOURCE_DATE_EPOCH="86400")))
    assert b"19700102000000Z" in read(dated)
    assert b"CreationDate" not in read(path("equal-0.pdf"))
    done(run("render", quick, "-o", "-"), 1)
    done(run("render", quick, "-o", dated, "--format", "pdf"), 1)
    os.mkdir(path("caps"))
    done(run("render", quick, "-o", path("caps", "A%d.PNG"), *film, "--fps", "10"))
    expect(sorted(os.listdir(path("caps"))), ["A1.PNG", "A2.PNG"])
    os.rename(path("caps", "A1.PNG"), path("caps", "scene.PNG"))
    done(run("check", path("caps", "scene.PNG")))


@test
def earlier_results():
    """A folder holds the files of the last result; changed ones are kept and named."""
    where = path("results")
    done(run("run", quick, "-q", "-o", where, "--set", "output.studies=storage"))
    assert os.path.exists(path("results", "study-storage.csv"))
    with open(path("results", "study-storage.csv"), "a") as file:
        file.write("mine\n")
    with open(path("results", "study-mine.csv"), "w") as file:
        file.write("mine\n")
    done(run("run", quick, "-q", "--json", path("results", "named.json"), "-o", where))
    result = done(run("run", quick, "-q", "-o", where))
    expect(result.stderr, "")
    expect(sorted(os.listdir(where)),
           [".sealbench-run.manifest", "cycle.csv", "figures.csv", "named.json", "profiles.csv", "results.json",
            "study-mine.csv", "study-storage.csv"])
    done(run("run", quick, "-q", "-o", where, "--set", "output.studies=storage"))
    with open(path("results", "study-storage-table.csv"), "a") as file:
        file.write("mine\n")
    result = done(run("run", quick, "-q", "-o", where))
    expect(result.stderr, "sealbench: %s: belongs to an earlier result and was changed since; it is not deleted\n" % path("results", "study-storage-table.csv"))
    # The tail of a longer sequence.
    for rate, count in [("20", 4), ("10", 2)]:
        done(run("render", quick, "-o", path("frames/"), *film, "--fps", rate))
        expect(sorted(os.listdir(path("frames"))), [".sealbench-render.manifest"] +
               [f"frame-{i + 1:04d}.png" for i in range(count)])


def scenes(where, **extra):
    """A folder of scenes of the quick look: NAME=what stands below its last group, [output]."""
    os.makedirs(where)
    with open(quick) as file:
        text = file.read().replace("../valves", os.path.join(assets, "valves"))
    text = text.replace("frames = 400\n", "")
    for name, more in extra.items():
        with open(os.path.join(where, name + ".scene"), "w") as file:
            file.write(text + more)
    return [os.path.join(where, name + ".scene") for name in extra]


@test
def several_files():
    """A folder, an object and a table for each; one that fails does not stop the others."""
    a, bad, c = scenes(path("several"), a="", bad="[seal]\nmodulus = 3\n",
                       c="[surface]\ngt_product = 0.14\n")
    out = path("several", "out")
    result = done(run("run", a, bad, c, "-o", out, "--json", os.path.join(out, "all.json")), 1)
    assert bad in result.stderr and "[seal] modulus" in result.stderr, result.stderr
    expect(sorted(os.listdir(out)), ["a", "all.json", "c"])
    every = json.loads(read(os.path.join(out, "all.json")))
    expect([each["scene"] for each in every], [a, c])
    for name, each in zip("ac", every):
        expect(json.loads(read(os.path.join(out, name, "results.json"))), each)
    assert every[0]["cycle"]["force_peak_N"] and \
        every[0]["cycle"]["force_breakaway_N"] != every[1]["cycle"]["force_breakaway_N"]
    # The same as each alone.
    alone = json.loads(done(run("run", c, "--json", "-")).stdout)
    expect(alone["cycle"], every[1]["cycle"])
    table = done(run("run", a, c)).stdout
    assert table.index(a + ":\n") < table.index("Break-away force") < table.index("\n\n" + c + ":\n")
    plans = json.loads(done(run("plan", c, a, "--json", "-")).stdout)
    expect([plan["scene"] for plan in plans], [c, a])
    expect(plans[0]["fields"], json.loads(done(run("plan", c, "--json", "-")).stdout)["fields"])
    result = done(run("run", a, c, "--progress", "json"))
    named = [json.loads(line)["file"] for line in result.stderr.splitlines()]
    expect(sorted(set(named)), [a, c])
    # The highest code: one solver that does not converge, one file with a problem.
    with open(a) as file:
        stuck = file.read()
    with open(path("several", "stuck.scene"), "w") as file:
        file.write(re.sub(r"\[models\]\n(\w+ = .*\n)*", "[models]\nfit = ring\n", stuck)
                   .replace("[output]\n", "[output]\nwork_limit = 10\n"))
    stuck = path("several", "stuck.scene")
    result = done(run("run", bad, stuck, a, "--json", "-"), 2)
    assert f"{stuck}: [output] work_limit: fitment (ring)" in result.stderr, result.stderr
    expect([each["solver"]["converged"] for each in json.loads(result.stdout)], [False, True])


@test
def several_pictures():
    a, c = scenes(path("drawn"), a="", c="")
    out = path("drawn", "out")
    view = ("--view", "hysteresis", "--size", "320x200")
    done(run("render", a, c, "-o", out, *view))
    done(run("render", a, c, "-o", out, *view, "--format", "SVG"))
    done(run("render", a, c, "-o", out, "--view", "storage", "--format", "pdf"))
    for name in "ac":
        expect(sorted(os.listdir(os.path.join(out, name))),
               ["hysteresis.png", "hysteresis.svg", "storage.pdf"])
    done(run("render", a, "-o", path("drawn", "alone.png"), *view))
    expect(read(os.path.join(out, "a", "hysteresis.png")) == read(path("drawn", "alone.png")), True)
    for target in ["-", path("drawn", "x.mp4")]:
        result = done(run("render", a, c, "-o", target), 1)
        assert "2 files need a folder" in result.stderr, result.stderr
    # Refused when it is drawn: no folder stays.
    result = done(run("render", a, c, "-o", path("drawn", "none"), *view, "--at", "Q"), 1)
    assert not os.path.exists(path("drawn", "none"))
    result = done(run("render", a, c, "-o", out, "--format", "pgn"), 1)
    assert "do you mean png?" in result.stderr, result.stderr


@test
def several_refused():
    """Before any work and with nothing written: twins, targets, inputs."""
    a, c = scenes(path("refused"), a="", c="")
    twin, = scenes(path("refused", "deep"), a="")
    where = path("refused")
    before = sorted(os.listdir(where))
    slow = ("--set", "models.fit=ring", "--progress", "lines")
    cases = [
        (1, "would both be written to out/a", ("run", a, twin, "-o", "out")),
        (1, "would both be written to out/a", ("render", a, twin, "-o", "out")),
        (1, "standard input can be only one", ("run", "-", a, "-")),
        (1, "is an input of this command", ("run", a, c, "--json", "c.scene")),
        (1, "two outputs would go to this file", ("run", a, c, "-o", "out", "--json",
                                                  "out/c/cycle.csv")),
        (3, "No such file or directory", ("run", a, c, "--json", "none/all.json")),
        (3, "Not a directory", ("run", a, c, "-o", "a.scene")),
        (3, "", ("render", a, c, "-o", "/proc/none")),
    ]
    for code, text, arguments in cases:
        result = done(run(*arguments, *slow, cwd=where, timeout=20, stdin=subprocess.DEVNULL), code)
        assert text in result.stderr and " %" not in result.stderr, (arguments, result.stderr)
        expect(sorted(os.listdir(where)), before, arguments)
    # A folder of one of them.
    os.makedirs(path("refused", "out", "c", "cycle.csv"))
    result = done(run("run", a, c, "-o", "out", *slow, cwd=where), 3)
    assert "cycle.csv: Is a directory" in result.stderr and " %" not in result.stderr
    expect(os.listdir(path("refused", "out")), ["c"])
    # Without -o two of one name are two objects.
    both = json.loads(done(run("run", a, twin, "--json", "-")).stdout)
    expect([each["scene"] for each in both], [a, twin])


@test
def several_stopped():
    """An interrupt writes what was finished, flagged, and says what was not begun."""
    names = scenes(path("stopped"), a="frames = 1000000\n", b="", c="")
    out = path("stopped", "all.json")
    process = subprocess.Popen([program, "run", *names, "--json", out, "--progress", "lines"],
                               stderr=subprocess.PIPE, text=True)
    seen = []
    for line in process.stderr:
        seen.append(line)
        if line.endswith("a.scene: 10 %\n"):
            process.send_signal(signal.SIGTERM)
    expect(process.wait(), 130, "".join(seen))
    assert "2 of 3 files were not begun" in "".join(seen), seen
    every = json.loads(read(out))
    expect([(each["scene"], each["partial"]) for each in every], [(names[0], True)])


@test
def stopped_twice():
    """A second signal ends the program at once and leaves nothing."""
    where = path("twice")
    os.mkdir(where)
    process = subprocess.Popen([program, "render", quick, "-o", os.path.join(where, "a.mp4"),
                                "--view", "dashboard", "--progress", "lines"],
                               # The tests may run under nohup, which the program keeps to.
                               preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL),
                               stderr=subprocess.PIPE, text=True)
    for line in process.stderr:
        if "drawing 10" in line:
            process.send_signal(signal.SIGSTOP)
            process.send_signal(signal.SIGHUP)
            process.send_signal(signal.SIGTERM)
            process.send_signal(signal.SIGCONT)
            break
    process.communicate()
    assert process.returncode in (-signal.SIGHUP, -signal.SIGTERM), process.returncode
    expect(os.listdir(where), [])


@test
def step_without_its_reader():
    """A build without sealbench-cad refuses a STEP file and names the command that adds it."""
    alone = path("alone", "deep")
    os.makedirs(alone)
    shutil.copy(program, alone)
    with open(path("a.step"), "w", encoding="utf-8") as file:
        file.write("ISO-10303-21;\n")
    refused = subprocess.run([os.path.join(alone, "sealbench"), "cad", path("a.step")],
                             capture_output=True, text=True)
    done(refused, 1)
    assert "tools/setup step" in refused.stderr and refused.stderr.count("\n") == 1, refused.stderr


print(f"1..{len(tests)}")
failed = False
for number, function in enumerate(tests, 1):
    try:
        function()
        print(f"ok {number} {function.__name__}", flush=True)
    except Exception as problem:  # every failure is one line of TAP
        failed = True
        print(f"not ok {number} {function.__name__}")
        print("# " + re.sub(r"\s*\n", "\n# ", f"{type(problem).__name__}: {problem}"), flush=True)
shutil.rmtree(home)
sys.exit(failed)

"""An installation, moved elsewhere: the command line and the window find what ships with them."""
import json
import os
import re
import shutil
import subprocess
import sys

BUILD = os.environ["SEALBENCH_BUILD"]
HERE = os.path.join(os.environ["SEALBENCH_WORK"], "somewhere else")
shutil.rmtree(HERE, ignore_errors=True)
STAGE = HERE + ".stage"
shutil.rmtree(STAGE, ignore_errors=True)
subprocess.run(["meson", "install", "-C", BUILD, "--no-rebuild", "--destdir", STAGE], check=True,
               stdout=subprocess.DEVNULL)
(prefix,) = [folder for folder, inside, _ in os.walk(STAGE) if "bin" in inside]
os.rename(prefix, HERE)
shutil.rmtree(STAGE)
os.environ["SEALBENCH_GTK"] = os.path.join(HERE, "bin", "sealbench-gtk")

from harness import App, main, wait  # noqa: E402

PROGRAM = os.path.join(HERE, "bin", "sealbench")


def another_user(home):
    """Words in front of a command that make it another user's; none where we are not root, or where a
    folder above the build, such as /root, is closed to others."""
    os.makedirs(home, exist_ok=True)
    os.chmod(home, 0o555)
    if os.getuid() != 0:
        return []
    words = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
    return words if subprocess.run([*words, "test", "-r", PROGRAM]).returncode == 0 else []


def what_ships_is_known_by_name(folder):
    home = os.path.join(folder, "home")
    as_other = another_user(home)
    os.chmod(folder, 0o755)
    run = subprocess.run([*as_other, PROGRAM, "run", "quick-look", "--json", "-"], cwd="/",
                         env={"HOME": home, "PATH": os.environ["PATH"]}, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert abs(json.loads(run.stdout)["cycle"]["stages"]["B"]["force_N"] - 28.7) < 0.3
    fit = subprocess.run([*as_other, PROGRAM, "fit", "piston", "--seal", "outer"], cwd="/",
                         env={"HOME": home, "PATH": os.environ["PATH"]}, capture_output=True, text=True)
    assert fit.returncode == 0 and "Contact width" in fit.stdout, fit.stderr
    none = subprocess.run([PROGRAM, "run", "no-such"], capture_output=True, text=True)
    assert none.returncode == 1 and "no-such" in none.stderr, none.stderr


def manual_and_completions_name_every_option(folder):
    share = os.path.join(HERE, "share")
    texts = {}
    for name in ("man/man1/sealbench.1", "bash-completion/completions/sealbench.bash",
                 "zsh/site-functions/_sealbench", "fish/vendor_completions.d/sealbench.fish"):
        with open(os.path.join(share, name), encoding="utf-8") as file:
            texts[name] = file.read().replace("\\-", "-")
    head = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True).stdout
    commands = re.findall(r"^  sealbench (\w+) ", head, re.M)
    assert len(commands) >= 10, commands
    for command in commands:
        help = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True).stdout
        for option in re.findall(r"--([\w-]+)", re.sub(r"(?s)^.*?Application Options:", "", help)):
            for name, text in texts.items():
                assert re.search(r"(--|-l )" + option, text), (name, command, option)
    shell = subprocess.run(
        ["bash", "-c", 'source "$0"; COMP_WORDS=(sealbench render --view ""); COMP_CWORD=3; '
         '_sealbench; echo "${COMPREPLY[@]}"',
         os.path.join(share, "bash-completion/completions/sealbench.bash")],
        capture_output=True, text=True)
    assert "hysteresis" in shell.stdout.split() and "tolerance" in shell.stdout.split(), shell


def the_window_has_its_examples(folder):
    home = os.path.join(folder, "home")
    another_user(home)
    with App(env={"LC_ALL": "de_DE.UTF-8", "LANGUAGE": "de", "HOME": home}) as app:
        app.find("push button", "Starten")
        app.press("toggle button", "Zuletzt geöffnet und Beispiele")
        app.press("menu", "Beispiele")
        app.press("menu item", "Leak over squeeze")
        wait("the example", lambda: app.all("frame", re.compile("^Leak over squeeze")))


if __name__ == "__main__":
    main(what_ships_is_known_by_name, manual_and_completions_name_every_option,
         the_window_has_its_examples)

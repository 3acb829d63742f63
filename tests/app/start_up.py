#!/usr/bin/python3
"""The program starts fast: what it is linked with, what the light commands load, how long they take, and
what happens if a library is missing that is opened later. A build without stubs (-Dlazy=disabled) and
one with a sanitizer are not measured.

start_up.py SEALBENCH SCENE, TAP on standard output.
"""
import os
import re
import statistics
import subprocess
import sys
import tempfile

program, scene = sys.argv[1:]
OBJECTS_MAX = 25  # issue: ldd lists at most 25 shared objects
LIMIT_S = 15e-3  # processor time, or 4 times an empty program's if that is larger
REPEATS = 20


def run(*arguments, **environment):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL, env={**os.environ, **environment})


def light_commands():
    """All commands that must start fast, from what the program prints of itself."""
    text = run('--help').stdout
    names = re.findall(r'^  sealbench (\w+) ', text, re.M)
    lists = re.search(r'sealbench list (\S+)', text)[1].split('|')
    return ([['--version'], ['--help']] + [[name, '--help'] for name in names] +
            [['list', name] for name in lists] + [['list', 'params', '--json', '-']])


def processor_s(command):
    """Median processor time of REPEATS starts after a warm-up [s]."""
    times = []
    with open(os.devnull, 'w', encoding='utf-8') as nowhere:
        for _ in range(REPEATS + 1):
            child = subprocess.Popen(command, stdout=nowhere)
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            assert child.returncode == 0, command
            times.append(used.ru_utime + used.ru_stime)
    return statistics.median(times[1:])


def linked():
    objects = subprocess.run(['ldd', program], capture_output=True, text=True, check=True).stdout.splitlines()
    return [] if 0 < len(objects) <= OBJECTS_MAX else [f'{len(objects)} shared objects'] + objects


def loaded():
    """Objects that a light command opens while it runs, as the dynamic linker reports them."""
    found = []
    for command in light_commands():
        result = run(*command, LD_DEBUG='files', LD_BIND_NOW='1')
        opened = re.findall(r'file=(\S+) \[0\];  dynamically loaded by', result.stderr)
        if result.returncode != 0 or 'calling init' not in result.stderr or opened:
            found.append(f'{" ".join(command)}: exit {result.returncode} {opened}')
    # What the check sees: drawing opens cairo.
    with tempfile.TemporaryDirectory() as folder:
        result = run('render', scene, '-o', folder + '/x.png', '--view', 'hysteresis', LD_DEBUG='files')
    return found if 'libcairo' in result.stderr else found + ['render opens no cairo']


def slow():
    """Commands above the limit in three series: other programs on the processors lengthen these times."""
    found = light_commands()
    for _ in range(3):
        limit = max(LIMIT_S, 4 * processor_s(['/bin/true']))
        times = [(command, processor_s([program, *command])) for command in found]
        found = [command for command, time in times if time > limit]
    return [f'{" ".join(command)}: {1e3 * time:.1f} ms' for command, time in times if command in found]


def missing():
    """A library that cannot be opened ends the program with its name and exit code 3."""
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + '/libcairo.so.2', 'w', encoding='utf-8'):
            pass
        target = folder + '/x.png'
        result = run('render', scene, '-o', target, '--view', 'hysteresis', LD_LIBRARY_PATH=folder)
        good = result.returncode == 3 and 'libcairo.so.2' in result.stderr and not os.path.exists(target)
        fine = run('list', 'models', LD_LIBRARY_PATH=folder).returncode == 0
    return [] if good and fine else [f'exit {result.returncode}', result.stderr]


checks = [('is linked with at most 25 shared objects', linked), ('light commands open no library', loaded),
          ('light commands start within the limit', slow), ('a missing library is named', missing)]
print(f'1..{len(checks)}')
failed = False
for number, (name, check) in enumerate(checks, 1):
    problems = check()
    failed |= bool(problems)
    print(f'{"not ok" if problems else "ok"} {number} {name}')
    for problem in problems:
        print('#', problem)
sys.exit(failed)

#!/usr/bin/python3
"""A study on the processes of an MPI job: every process computes, and the answers are those of one process.

mpi.py MPIRUN SEALBENCH-MPI SEALBENCH ASSETS, TAP on standard output.
"""
import os
import re
import subprocess
import sys
import tempfile

MPIRUN, PARALLEL, PROGRAM, ASSETS = (os.path.abspath(path) for path in sys.argv[1:])
STUDY = f"""[sealbench]
format = 1
kind = study
scene = {ASSETS}/scenes/quick-look.scene
[vary]
gland.radial_space = uniform 1.33 mm .. 1.39 mm
seal.modulus = uniform 2.4 MPa .. 2.8 MPa
[study]
method = monte-carlo
samples = 300
figures = cycle.force_breakaway_N, seals.outer.load_N
"""
results = []


def check(name, good, said=''):
    results.append(bool(good))
    print(f'{"ok" if good else "not ok"} {len(results)} {name}{"" if good else " # " + str(said)}')


def run(folder, *command):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=200)


def parallel(folder, processes, *more):
    return run(folder, MPIRUN, '--allow-run-as-root', '--oversubscribe', '-n', str(processes), PARALLEL, 'study',
               'a.study', '-o', f'{processes}.store', '--csv', f'{processes}.csv', '--progress', 'lines', *more)


with tempfile.TemporaryDirectory() as folder:
    with open(os.path.join(folder, 'a.study'), 'w') as file:
        file.write(STUDY)
    one = run(folder, PROGRAM, 'study', 'a.study', '-o', '1.store', '--csv', '1.csv', '-q')
    check('one process', one.returncode == 0, one.stderr)
    for processes in 2, 3:
        out = parallel(folder, processes)
        found = re.search(rf'{processes} processes: the first computed (\d+) of 300 samples', out.stderr)
        check(f'{processes} processes compute', out.returncode == 0 and found is not None
              and 0 < int(found[1]) < 300, (out.returncode, out.stderr))
        with open(os.path.join(folder, '1.csv')) as a, open(os.path.join(folder, f'{processes}.csv')) as b:
            check(f'{processes} processes give the same bytes', a.read() == b.read())
    again = parallel(folder, 2)
    check('nothing is computed twice', again.returncode == 0 and 'the first computed' not in again.stderr,
          again.stderr)
    bad = run(folder, MPIRUN, '--allow-run-as-root', '--oversubscribe', '-n', '2', PARALLEL, 'study', 'none.study')
    check('bad input ends all processes', bad.returncode == 1 and bad.stderr.count('none.study') >= 1, bad.stderr)
print(f'1..{len(results)}')
sys.exit(not all(results) or os.EX_OK)

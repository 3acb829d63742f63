#!/usr/bin/env python3
"""The ring by CalculiX and by sealbench, in one run: loads (and times, told only).

CalculiX gets the problem that `sealbench fit --export FILE.inp` writes: the free ring's six-node
axisymmetric elements with the same energy, groove floor and bore as rigid rings that move to their
places, in contact face to face. A development check: skipped where ccx is absent.

Usage: compare_ccx.py SEALBENCH VALVE
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

# The thesis' valve, or the reference's D ring; more of `fit`'s settings, the load's limit.
CASES = [('circle', [], 3e-3),
         ('d', ['seal.section_diameter=1.6 mm', 'seal.inner_diameter=3.2 mm',
                'seal.axial_height=1.6 mm', 'seal.corner_radius=0.15 mm'], 5e-3)]
WEDGES = 180  # CalculiX turns the section into a wedge of two degrees


def settings(profile, more):
    return [word for key in ['seal.profile=' + profile] + more for word in ('--set', key)]


def calculix(folder):
    """Bore and floor load in newtons, seconds."""
    environment = dict(os.environ, OMP_NUM_THREADS='1', CCX_NPROC_EQUATION_SOLVER='1')
    start = time.monotonic()
    done = subprocess.run(['ccx', '-i', 'ring'], cwd=folder, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=540)
    seconds = time.monotonic() - start
    if 'Job finished' not in done.stdout:
        raise SystemExit('CalculiX did not finish:\n' + done.stdout[-2000:])
    with open(os.path.join(folder, 'ring.dat')) as file:
        text = file.read()
    force = {}
    for name, value in re.findall(r'total force.*for set (\w+).*\n\s*\n\s*(\S+)', text):
        force[name] = abs(float(value))
    return WEDGES * force['NBORE'], WEDGES * force['NFLOOR'], seconds


def main():
    if shutil.which('ccx') is None:
        print('1..0 # SKIP CalculiX (package calculix-ccx) is not installed')
        return 0
    print(f'1..{len(CASES)}')
    for number, (profile, more, limit) in enumerate(CASES, 1):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.argv[1], 'fit', sys.argv[2], '--seal', 'outer', '--model', 'ring',
                       '--export', os.path.join(folder, 'ring.inp'), '--json', '-']
            fit = json.loads(subprocess.run(command + settings(profile, more), check=True,
                                            stdout=subprocess.PIPE).stdout)
            bore, floor, seconds = calculix(folder)
        load, ours = fit['load_N'], fit['solver']['wall_s']
        print(f'# CalculiX  bore {bore:.4f} N, floor {floor:.4f} N, {seconds:.2f} s')
        print(f'# sealbench bore {load:.4f} N, {fit["solver"]["unknowns"]} unknowns, {ours:.3f} s')
        off = load / bore - 1
        print(f'{"ok" if abs(off) < limit else "not ok"} {number} {profile}: loads agree to '
              f'{100 * limit:g} % ({100 * off:+.3f} %)')
    return 0


if __name__ == '__main__':
    sys.exit(main())

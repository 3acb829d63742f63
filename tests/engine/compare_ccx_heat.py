#!/usr/bin/env python3
"""Permeation of the deformed ring by CalculiX's heat conduction and by sealbench: conductances.

CalculiX gets the very nodes and elements (six-node axisymmetric triangles) of the ring that
ring_section has solved, without quarter points, parted once into four so that what the ends of the
wetted faces leave is below what is compared: temperature 1 at the nodes wetted from inside, 0 at those from
outside, conductivity 1. Dry and at 0.55 MPa. A development check: skipped where ccx is absent.

Usage: compare_ccx_heat.py RING_SECTION
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

SPLITS = 2  # of each element into four; the rest falls with the side


def section(program, pressure):
    words = iter(subprocess.run([program, str(pressure)], check=True, text=True,
                                stdout=subprocess.PIPE).stdout.split())
    conductance, estimate = float(next(words)), float(next(words))
    nodes, elements = int(next(words)), int(next(words))
    place, face = [], []
    for _ in range(nodes):
        place.append((1e3 * float(next(words)), 1e3 * float(next(words))))  # mm
        face.append(int(next(words)))
    triangles = [[int(next(words)) for _ in range(6)] for _ in range(elements)]
    return conductance, estimate, place, face, triangles


def split(place, face, triangles):
    """Each element into four by the middles of its sides, as they are curved."""
    known = {}

    def add(weights, flag):
        place.append(tuple(sum(w * place[n][k] for n, w in weights) for k in (0, 1)))
        face.append(flag)
        return len(place) - 1

    def half(v, m, w):
        if (v, m) not in known:
            known[v, m] = add([(v, 0.375), (m, 0.75), (w, -0.125)], face[m])
        return known[v, m]

    out = []
    for t in triangles:
        inner = [add([(t[(v + 1) % 3], -0.125), (t[(v + 2) % 3], -0.125), (t[3 + v], 0.5),
                      (t[3 + (v + 1) % 3], 0.25), (t[3 + (v + 2) % 3], 0.5)], 0) for v in range(3)]
        for v in range(3):
            before, after = (v + 2) % 3, (v + 1) % 3
            out.append([t[v], t[3 + v], t[3 + before], half(t[v], t[3 + v], t[after]), inner[v],
                        half(t[v], t[3 + before], t[before])])
        out.append([t[3], t[4], t[5], inner[1], inner[2], inner[0]])
    return out


def calculix(place, face, triangles):
    """Flux in and out for a unit of conductivity and of temperature, whole ring [m]."""
    out = ['*NODE, NSET=ALL'] + [f'{i + 1}, {p[0]:.12g}, {p[1]:.12g}, 0' for i, p in enumerate(place)]
    out.append('*ELEMENT, TYPE=CAX6, ELSET=RUBBER')
    out += [', '.join(str(n + 1) for n in [i] + t) for i, t in enumerate(triangles)]
    for name, which in (('INSIDE', 1), ('OUTSIDE', 2)):
        out.append(f'*NSET, NSET={name}')
        out += [f'{i + 1},' for i, f in enumerate(face) if f == which]
    out += ['*MATERIAL, NAME=RUBBER', '*CONDUCTIVITY', '1.0', '*SOLID SECTION, ELSET=RUBBER, MATERIAL=RUBBER',
            '*INITIAL CONDITIONS, TYPE=TEMPERATURE', 'ALL, 0.5', '*STEP', '*HEAT TRANSFER, STEADY STATE, DIRECT',
            '1, 1', '*BOUNDARY', 'INSIDE, 11, 11, 1', 'OUTSIDE, 11, 11, 0',
            '*NODE PRINT, NSET=INSIDE, TOTALS=ONLY', 'RFL', '*NODE PRINT, NSET=OUTSIDE, TOTALS=ONLY', 'RFL',
            '*END STEP']
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, 'heat.inp'), 'w', encoding='utf-8') as file:
            file.write('\n'.join(out) + '\n')
        environment = dict(os.environ, OMP_NUM_THREADS='1', CCX_NPROC_EQUATION_SOLVER='1')
        done = subprocess.run(['ccx', '-i', 'heat'], cwd=folder, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=540, check=False)
        if 'Job finished' not in done.stdout:
            raise SystemExit('CalculiX did not finish:\n' + done.stdout[-2000:])
        with open(os.path.join(folder, 'heat.dat'), encoding='utf-8') as file:
            text = file.read()
    flux = {name: float(value) for name, value in re.findall(
        r'heat generation.*set (\w+).*\n\s*\n\s*(\S+)', text)}
    # A wedge of 2 degrees in millimetres.
    return [180 * 1e-3 * flux[name] for name in ('INSIDE', 'OUTSIDE')]


def main():
    if shutil.which('ccx') is None:
        print('1..0 # SKIP CalculiX (package calculix-ccx) is not installed')
        return 0
    good = True
    print('1..2')
    for number, pressure in enumerate((0.0, 0.55e6), 1):
        ours, estimate, place, face, triangles = section(sys.argv[1], pressure)
        for _ in range(SPLITS):
            triangles = split(place, face, triangles)
        flux = calculix(place, face, triangles)
        theirs = (abs(flux[0]) + abs(flux[1])) / 2
        off = ours / theirs - 1
        good = good and abs(off) < 5e-3
        print(f'# {pressure * 1e-6:g} MPa: CalculiX {1e3 * flux[0]:.5f} and {1e3 * flux[1]:.5f} mm on {len(place)} nodes, '
              f'sealbench {1e3 * ours:.5f} mm (estimate {estimate:.1g})')
        print(f'{"ok" if abs(off) < 5e-3 else "not ok"} {number} conductances agree to 0.5 % ({100 * off:+.3f} %)')
    return 0 if good else 1


if __name__ == '__main__':
    sys.exit(main())

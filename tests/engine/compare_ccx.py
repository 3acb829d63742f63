#!/usr/bin/env python3
"""The unpressurised ring by CalculiX and by sealbench, in one run: loads (and times, told only).

CalculiX gets half of the free section (symmetric in the axial direction) as eight-node axisymmetric
elements with reduced integration, which do not lock at nu = 0.49, neo-Hookean with the same energy,
and the groove floor and bore as rigid rings that move to their places, in contact face to face. Its
penalty is stiff enough for 0.02 % of the load. A development check: skipped where ccx is absent.

Usage: compare_ccx.py SEALBENCH VALVE
"""

import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

# Millimetres, newtons, megapascals: the thesis' outer ring in reference figures.
D, INNER, E, NU, FLOOR, BORE = 1.61, 2.84, 2.5, 0.49, 1.64, 3.00
AROUND, DEPTH, CORE = 8, 6, 0.45  # segments per quarter of the core's outline, layers, core's half side
CLUSTER = 0.65  # how much the segments gather under the contacts
PENALTY = 1e4  # MPa/mm
# CalculiX turns the section into a wedge of 2 degrees, in which a straight element of a rigid ring is
# a chord: moved outwards so that its middle stands at the ring's radius.
CHORD = 1 / math.cos(math.radians(1))


def section():
    """Nodes and eight-node elements of the half section; the outline's sides by element and face."""
    nodes, elements, sides = [], [], []
    index = {}

    def node(r, z):
        key = (round(r, 9), round(z, 9))
        if key not in index:
            nodes.append(key)
            index[key] = len(nodes)
        return index[key]

    def element(corner):
        mid = [[(corner[i][k] + corner[(i + 1) % 4][k]) / 2 for k in (0, 1)] for i in range(4)]
        return corner, mid

    radius, centre = D / 2, INNER / 2 + D / 2
    core, n = CORE * radius, AROUND

    # The core's outline from the bore's side over the top to the floor's side.
    def outline(k):
        if k <= n:
            return core, core * k / n
        if k <= 3 * n:
            return core * (2 * n - k) / n, core
        return -core, core * (4 * n - k) / n

    def angle(k):
        t = k / (4 * n)
        return math.pi * (t - CLUSTER * math.sin(2 * math.pi * t) / (2 * math.pi))

    def ring(k, layer):
        s = 1 - (1 - layer / DEPTH) ** 1.6
        x, y = outline(k)
        a = angle(k)
        return (centre + (1 - s) * x + s * radius * math.cos(a),
                (1 - s) * y + s * radius * math.sin(a))

    def add(corner, arc=None):
        corner, mid = element([list(c) for c in corner])
        if arc is not None:
            mid[1] = list(arc)
        elements.append([node(*p) for p in corner] + [node(*p) for p in mid])

    for i in range(2 * n):
        for j in range(n):
            x, y = [centre - core + core * (i + a) / n for a in (0, 1)], [core * (j + a) / n
                                                                         for a in (0, 1)]
            add([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])])
    for k in range(4 * n):
        for layer in range(DEPTH):
            arc = None
            if layer == DEPTH - 1:
                a = (angle(k) + angle(k + 1)) / 2
                arc = (centre + radius * math.cos(a), radius * math.sin(a))
            add([ring(k, layer), ring(k, layer + 1), ring(k + 1, layer + 1), ring(k + 1, layer)],
                arc)
            if layer == DEPTH - 1:
                sides.append((len(elements), 2, (angle(k) + angle(k + 1)) / 2))
    return nodes, elements, sides


def block(first, inner, outer, length, count):
    """A straight rigid ring as `count` four-node elements; nodes from `first` on."""
    nodes = [(r, -0.2 + (length + 0.2) * i / count) for i in range(count + 1)
             for r in (inner, outer)]
    elements = [[first + 2 * i, first + 2 * i + 1, first + 2 * i + 3, first + 2 * i + 2]
                for i in range(count)]
    return nodes, elements


def write(path):
    """Writes the input file; returns the number of displacement unknowns of the section."""
    nodes, elements, sides = section()
    start = {'floor': INNER / 2 - 0.001, 'bore': INNER / 2 + D + 0.4}
    floor, floor_elements = block(len(nodes) + 1, start['floor'] - 0.3, start['floor'], 1.2, 6)
    bore, bore_elements = block(len(nodes) + len(floor) + 1, start['bore'], start['bore'] + 0.3,
                                1.2, 6)
    shear, bulk = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
    out = ['*NODE, NSET=ALL']
    out += [f'{i + 1}, {p[0]:.10g}, {p[1]:.10g}, 0' for i, p in enumerate(nodes + floor + bore)]
    out.append('*ELEMENT, TYPE=CAX8R, ELSET=RUBBER')
    out += [', '.join(map(str, [i + 1] + e)) for i, e in enumerate(elements)]
    for name, part, first in (('FLOOR', floor_elements, len(elements)),
                              ('BORE', bore_elements, len(elements) + len(floor_elements))):
        out.append(f'*ELEMENT, TYPE=CAX4, ELSET={name}')
        out += [', '.join(map(str, [first + i + 1] + e)) for i, e in enumerate(part)]
    first = len(nodes) + 1
    out += ['*NSET, NSET=NFLOOR, GENERATE', f'{first}, {first + len(floor) - 1}',
            '*NSET, NSET=NBORE, GENERATE',
            f'{first + len(floor)}, {first + len(floor) + len(bore) - 1}', '*NSET, NSET=MIDDLE']
    out += [f'{i + 1},' for i, p in enumerate(nodes) if p[1] == 0]
    for name, chosen in (('SBORE', lambda a: a < 1.2), ('SFLOOR', lambda a: a > math.pi - 1.2)):
        out.append(f'*SURFACE, NAME={name}, TYPE=ELEMENT')
        out += [f'{e}, S{face}' for e, face, a in sides if chosen(a)]
    out.append('*SURFACE, NAME=MFLOOR, TYPE=ELEMENT')
    out += [f'{len(elements) + i + 1}, S2' for i in range(len(floor_elements))]
    out.append('*SURFACE, NAME=MBORE, TYPE=ELEMENT')
    out += [f'{len(elements) + len(floor_elements) + i + 1}, S4' for i in range(len(bore_elements))]
    # The rigid rings are so soft that their own stress does not count; all their nodes are moved.
    out += ['*MATERIAL, NAME=RUBBER', '*HYPERELASTIC, NEO HOOKE', f'{shear / 2:.12g}, {2 / bulk:.12g}',
            '*MATERIAL, NAME=RIGID', '*ELASTIC', '1e-6, 0',
            '*SOLID SECTION, ELSET=RUBBER, MATERIAL=RUBBER',
            '*SOLID SECTION, ELSET=FLOOR, MATERIAL=RIGID',
            '*SOLID SECTION, ELSET=BORE, MATERIAL=RIGID', '*SURFACE INTERACTION, NAME=SMOOTH',
            '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR', f'{PENALTY:g}, 0.0025, 0.01']
    for name in ('FLOOR', 'BORE'):
        out += ['*CONTACT PAIR, INTERACTION=SMOOTH, TYPE=SURFACE TO SURFACE', f'S{name}, M{name}']
    out += ['*BOUNDARY', 'MIDDLE, 2, 2', 'NFLOOR, 2, 2', 'NBORE, 2, 2']
    for bore_move in (0.0, CHORD * BORE - start['bore']):
        out += ['*STEP, NLGEOM, INC=500', '*STATIC', '0.1, 1, 1e-5, 0.5', '*BOUNDARY',
                f'NFLOOR, 1, 1, {CHORD * FLOOR - start["floor"]:.10g}', f'NBORE, 1, 1, {bore_move:.10g}',
                '*NODE PRINT, NSET=NBORE, TOTALS=ONLY, FREQUENCY=1000', 'RF',
                '*NODE PRINT, NSET=NFLOOR, TOTALS=ONLY, FREQUENCY=1000', 'RF', '*END STEP']
    with open(path, 'w') as file:
        file.write('\n'.join(out) + '\n')
    return 2 * len(nodes)


def calculix():
    """Bore and floor load in newtons, seconds, unknowns."""
    with tempfile.TemporaryDirectory() as folder:
        unknowns = write(os.path.join(folder, 'ring.inp'))
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
        # Half of the ring by symmetry, and of it the wedge of 2 degrees that CalculiX makes.
        whole = 2 * 180
        return whole * force['NBORE'], whole * force['NFLOOR'], seconds, unknowns


def sealbench(program, valve):
    sizes = {'seal.outer.section_diameter': f'{D} mm', 'seal.outer.inner_diameter': f'{INNER} mm',
             'seal.outer.modulus': f'{E} MPa', 'seal.outer.poisson_ratio': str(NU),
             'gland.radial_space': f'{BORE - FLOOR:.6g} mm', 'bore.diameter': f'{2 * BORE} mm'}
    command = [program, 'fit', valve, '--seal', 'outer', '--model', 'ring', '--json', '-']
    for key, value in sizes.items():
        command += ['--set', f'{key}={value}']
    best = None
    for _ in range(5):
        fit = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
        if best is None or fit['solver']['wall_s'] < best['solver']['wall_s']:
            best = fit
    return best['load_N'], best['solver']['wall_s'], best['solver']['unknowns']


def main():
    if shutil.which('ccx') is None:
        print('1..0 # SKIP CalculiX (package calculix-ccx) is not installed')
        return 0
    bore, floor, seconds, unknowns = calculix()
    load, ours, our_unknowns = sealbench(*sys.argv[1:3])
    print('1..1')
    print(f'# CalculiX  bore {bore:.4f} N, floor {floor:.4f} N, {unknowns} unknowns, {seconds:.2f} s')
    print(f'# sealbench bore {load:.4f} N, {our_unknowns} unknowns, {ours:.3f} s')
    off = load / bore - 1
    print(f'{"ok" if abs(off) < 3e-3 else "not ok"} 1 loads agree to 0.3 % ({100 * off:+.3f} %)')
    return 0


if __name__ == '__main__':
    sys.exit(main())

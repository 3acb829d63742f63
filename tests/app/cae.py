#!/usr/bin/env python3
"""`sealbench fit --export`: the files hold the same ring, and what cannot be written is refused.

Usage: cae.py SEALBENCH VALVE
"""

import json
import math
import os
import re
import subprocess
import sys
import tempfile
from xml.etree import ElementTree

program, valve = map(os.path.abspath, sys.argv[1:3])


def fit(folder, *words):
    return subprocess.run([program, 'fit', valve, '--seal', 'outer', '--quiet', *words], cwd=folder,
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def numbers(root, name):
    return [float(v) for v in root.find(f'.//DataArray[@Name="{name}"]').text.split()]


def same_ring(folder):
    done = fit(folder, '--set', 'seal.profile=d', '--export', 'a.vtu', '--export', 'a.inp',
               '--export', 'a.dxf')
    assert done.returncode == 0, done.stderr
    root = ElementTree.parse(os.path.join(folder, 'a.vtu')).getroot()
    place, moved = numbers(root, 'place_m'), numbers(root, 'displacement_m')
    count = int(root.find('.//Piece').get('NumberOfPoints'))
    assert len(place) == len(moved) == 3 * count
    corners = numbers(root, 'connectivity')
    assert max(corners) == count - 1 and len(corners) == 6 * len(numbers(root, 'types'))
    # Between floor (1.64 mm) and bore (3 mm), which it touches.
    assert abs(min(place[1::3]) - 1.64e-3) < 1e-9 and abs(max(place[1::3]) - 3e-3) < 1e-9
    with open(os.path.join(folder, 'a.inp')) as file:
        text = file.read()
    assert re.search(rf'^{count}, ', text, re.M) and text.count('*STEP') == 3
    assert text.count('\n*DLOAD') == 0
    # The free section is 1.61 mm high.
    node = [line.split(', ') for line in text.split('*NODE, NSET=ALL\n')[1].split('\n')[:count]]
    radii = [float(n[1]) for n in node]
    assert abs(max(radii) - min(radii) - 1.61) < 1e-3
    with open(os.path.join(folder, 'a.dxf')) as file:
        text = file.read()
    assert text.count('\nPOLYLINE\n') == text.count('\nSEQEND\n') == 4 and text.endswith('EOF\n')


def pressed_ring(folder):
    done = fit(folder, '--model', 'ring', '--pressure', '0.55MPa', '--export', 'p.inp')
    assert done.returncode == 0, done.stderr
    with open(os.path.join(folder, 'p.inp')) as file:
        text = file.read()
    assert text.count('*STEP') == 2 and text.count('*CONTACT PAIR') == 3
    faces = re.findall(r'^\d+, P[123], 0\.55$', text, re.M)
    assert len(faces) > 20 and len(faces) % 2 == 0  # twice the same, in two steps
    # It starts where it was found, every node but one held, and the springs' far ends stay there.
    nodes = text.split('*NODE, NSET=ALL\n')[1].split('*ELEMENT, TYPE=CAX4')[0]
    hung = text.split('*NODE, NSET=NHANG\n')[1].split('*ELEMENT')[0].count('\n')
    rubber = len({n for line in nodes.split('ELSET=RUBBER\n')[1].split('\n')
                  for n in line.split(', ')[1:]})
    start, held = text.split('*STEP')[1:]
    assert len(re.findall(r'^\d+, 1, 1, ', start, re.M)) == rubber - 1 + hung
    assert len(re.findall(r'^\d+, 1, 1, ', held, re.M)) == hung > 100
    # Dry, squeezed by more than a fifth: springs as well, and in the end without them.
    done = fit(folder, '--model', 'ring', '--set', 'seal.section_diameter=1.8mm', '--export', 'q.inp')
    assert done.returncode == 0, done.stderr
    with open(os.path.join(folder, 'q.inp')) as file:
        steps = file.read().split('*STEP')[1:]
    assert [len(re.findall(r'^\d+, 1, 1, ', step, re.M)) > 100 for step in steps] == [True, True, False]


def bodies(folder):
    """The free ring is a torus but for its chords; pressed it stands between floor and bore."""
    done = fit(folder, '--model', 'ring', '--pressure', '0.55MPa', '--export', 'r.stl', '--export',
               'r.free.stl')
    assert done.returncode == 0, done.stderr
    volume = {}
    for name in ('r', 'r.free'):
        read = subprocess.run([program, 'cad', f'{name}.stl', '--json', '-'], cwd=folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True)
        found = json.loads(read.stdout)
        assert found['axis'] == 'along 1, 0, 0' and found['unit'] == 'mm'
        volume[name] = found['bodies'][0]['volume_m3']
    torus = 2 * math.pi ** 2 * (1.42e-3 + 0.805e-3) * 0.805e-3 ** 2
    assert 0.995 < volume['r.free'] / torus < 1, volume
    assert 0.97 < volume['r'] / volume['r.free'] < 1, volume
    with open(os.path.join(folder, 'r.stl')) as file:
        corners = [line.split()[1:] for line in file if line.startswith('vertex')]
    radii = [math.hypot(float(y), float(z)) for _, y, z in corners]
    assert abs(min(radii) - 1.64) < 1e-6 and abs(max(radii) - 3) < 1e-6


def refusals(folder):
    for words, part in ((['--export', 'a.vtu'], 'only the ring model'),
                        (['--model', 'ring', '--export', 'a.step'],
                         'allowed .vtu, .inp, .dxf, .stl, .free.stl'),
                        (['--drag', '0.1', '--export', 'drag.inp'], 'a ring with friction')):
        done = fit(folder, *words)
        assert done.returncode == 1 and part in done.stderr, done.stderr
    assert not os.path.exists(os.path.join(folder, 'drag.inp'))


tests = [same_ring, pressed_ring, bodies, refusals]
print(f'1..{len(tests)}')
for number, test in enumerate(tests, 1):
    with tempfile.TemporaryDirectory() as folder:
        try:
            test(folder)
            print(f'ok {number} {test.__name__}')
        except AssertionError as error:
            print(f'not ok {number} {test.__name__}\n# line {error.__traceback__.tb_lineno}: {error}')

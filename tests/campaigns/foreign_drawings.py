"""The drawings' part of the campaign `foreign`: stems with random sizes in the forms in which other
programs write them. Volume, moments and centre must agree with those of the exact outline or facets."""
import json
import math
import struct
import subprocess

import numpy

UNITS = [(4, 1e-3, 'mm'), (1, 25.4e-3, 'inch'), (5, 1e-2, 'cm'), (6, 1, 'm'), (13, 1e-6, 'um'), (9, 25.4e-6, 'mil'),
         (14, 0.1, 'dm'), (12, 1e-9, 'nm'), (21, 1200 / 3937, 'US survey foot'), (8, 25.4e-9, 'microinch')]
TOLERANCE = 1e-4
NODES, WEIGHTS = numpy.polynomial.legendre.leggauss(24)


# ---- The body and its exact measures ----

def outline(draw):
    """A stem with a groove between rounded edges: (x, r, bulge) from the axis to the axis [mm]."""
    land, floor, edge = draw.uniform(2.5, 3.5), draw.uniform(1.2, 2), draw.uniform(0.1, 0.3)
    a = draw.uniform(3, 5)
    b = a + draw.uniform(1.5, 2.5)
    end = b + draw.uniform(3, 5)
    q = math.tan(math.pi / 8)
    return [(end, 0, 0), (end, land - edge, q), (end - edge, land, 0), (b, land, 0), (b, floor, 0), (a, floor, 0),
            (a, land, 0), (edge, land, q), (0, land - edge, 0), (0, 0, 0)]


def arc_of(p, q):
    """Centre, radius, start and sweep of the piece from p to q."""
    bulge, dx, dy = p[2], q[0] - p[0], q[1] - p[1]
    off = (1 - bulge * bulge) / (4 * bulge)
    centre = ((p[0] + q[0]) / 2 - off * dy, (p[1] + q[1]) / 2 + off * dx)
    return (centre, math.hypot(dx, dy) * (1 + bulge * bulge) / (4 * abs(bulge)),
            math.atan2(p[1] - centre[1], p[0] - centre[0]), 4 * math.atan(bulge))


def measures(points):
    """Volume, centre, axial and transverse moments of the revolved outline [mm], by Green's theorem."""
    sums = numpy.zeros(4)
    for p, q in zip(points, points[1:] + points[:1]):
        t = (NODES + 1) / 2
        if p[2]:
            centre, radius, start, sweep = arc_of(p, q)
            x, r = centre[0] + radius * numpy.cos(start + t * sweep), centre[1] + radius * numpy.sin(start + t * sweep)
            dx = -radius * sweep * numpy.sin(start + t * sweep)
        else:
            x, r, dx = p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), q[0] - p[0]
        for k, value in enumerate((r * r, r * r * x, r ** 4 / 2, r ** 4 / 4 + r * r * x * x)):
            sums[k] -= math.pi / 2 * numpy.sum(WEIGHTS * value * dx)
    volume, moment, axial, about = sums
    return {'volume_m3': volume * 1e-9, 'centre_m': moment / volume * 1e-3, 'inertia_axial_m5': axial * 1e-15,
            'inertia_transverse_m5': (about - moment * moment / volume) * 1e-15}


# ---- DXF ----

class Dxf:
    """A text of pairs. `place` maps points of the drawing [mm] to those of the file."""

    def __init__(self, draw, place=lambda x, y: (x, y)):
        self.draw, self.place, self.pairs = draw, place, []

    def put(self, *pairs):
        self.pairs += pairs

    def number(self, value):
        return self.draw.choice(['%.12g', '%.16g', '%.14E']) % value

    def point(self, x, y, code=10):
        x, y = self.place(x, y)
        self.put((code, self.number(x)), (code + 10, self.number(y)), (code + 20, '0.0'))

    def begin(self, kind, layer, *pairs):
        self.put((0, kind), (5, '%X' % self.draw.randrange(16 ** 4)), (100, 'AcDbEntity'), *pairs, (8, layer))

    def line(self, layer, p, q, *pairs):
        self.begin('LINE', layer, *pairs)
        self.point(*p[:2])
        self.point(*q[:2], code=11)

    def arc(self, layer, p, q):
        (x, y), radius, start, sweep = arc_of(p, q)
        first, last = sorted((start, start + sweep))
        self.begin('ARC', layer)
        self.point(x, y)
        scale = math.dist(self.place(0, 0), self.place(1, 0))
        turn = math.atan2(*reversed([a - b for a, b in zip(self.place(1, 0), self.place(0, 0))]))
        self.put((40, self.number(radius * scale)), (50, self.number(math.degrees(first + turn))),
                 (51, self.number(math.degrees(last + turn))))

    def pieces(self, layer, points):
        each = list(zip(points, points[1:]))
        self.draw.shuffle(each)
        for p, q in each:
            if p[2]:
                self.arc(layer, p, q)
            elif self.draw.random() < 0.5:
                self.line(layer, p, q)
            else:
                self.line(layer, q, p)

    def light(self, layer, points, *pairs, sign=1):
        self.begin('LWPOLYLINE', layer, *pairs)
        self.put((90, str(len(points))), (70, '1'))
        for x, y, bulge in points:
            self.put((10, self.number(sign * x)), (20, self.number(y)), (42, self.number(sign * bulge)))

    def text(self, unit, tables=(), blocks=()):
        end = self.draw.choice(['\n', '\r\n', '\r', '\r\r\n'])
        head = [(0, 'SECTION'), (2, 'HEADER'), (9, '$ACADVER'), (1, 'AC1027'), (9, '$INSUNITS'), (70, str(unit)),
                (0, 'ENDSEC'), (0, 'SECTION'), (2, 'TABLES'), *tables, (0, 'ENDSEC'), (0, 'SECTION'), (2, 'BLOCKS'),
                *blocks, (0, 'ENDSEC'), (0, 'SECTION'), (2, 'ENTITIES')]
        pairs = head + self.pairs + [(0, 'ENDSEC'), (0, 'EOF')]
        if self.draw.random() < 0.3:
            pairs.insert(0, (999, 'made by Größe'))
        text = ''.join(f'{code:3d}{end}{value}{end}' for code, value in pairs)
        return self.draw.choice([b'', b'\xef\xbb\xbf']) + text.encode(self.draw.choice(['utf-8', 'cp1252']))


def lines_and_arcs(draw, points):
    """Lines and arcs in any order and direction, in any unit, about a centre line anywhere."""
    code, metres, _ = draw.choice(UNITS)
    turn, x0, y0, scale = draw.uniform(-1.4, 1.4), draw.uniform(-40, 40), draw.uniform(-40, 40), 1e-3 / metres
    c, s = math.cos(turn), math.sin(turn)
    dxf = Dxf(draw, lambda x, y: (scale * (c * x - s * y + x0), scale * (s * x + c * y + y0)))
    dxf.pieces('stem', points)
    dxf.line('axis', (-5, 0), (30, 0))
    return dxf.text(code), [], x0 * c + y0 * s  # where x = 0 is on the axis, from the point nearest to the origin


def polyline(draw, points):
    """A closed light polyline with bulges, or its mirror image on the back of the plane."""
    dxf = Dxf(draw)
    back = draw.random() < 0.5
    pairs = [(210, '0.0'), (220, '0.0'), (230, '-1.0')] if back else []
    dxf.light('0', points, *pairs, sign=-1 if back else 1)
    return dxf.text(4), [], 0


def old_polyline(draw, points):
    """POLYLINE with VERTEX entities, a dummy point and control points of its frame."""
    dxf = Dxf(draw)
    dxf.begin('POLYLINE', '0', (66, '1'))
    dxf.put((10, '0.0'), (20, '0.0'), (30, '0.0'), (70, '5'))
    for x, y, bulge in points:
        if draw.random() < 0.3:
            dxf.put((0, 'VERTEX'), (8, '0'), (10, '99'), (20, '99'), (30, '0'), (70, '16'))
        dxf.put((0, 'VERTEX'), (8, '0'), (10, dxf.number(x)), (20, dxf.number(y)), (30, '0'), (42, dxf.number(bulge)),
                (70, '0'))
    dxf.put((0, 'SEQEND'), (8, '0'))
    return dxf.text(4), [], 0


def composite_spline(draw, points):
    """One rational spline of degree 2, 3 or 5 with a kink at each knot."""
    degree = draw.choice([2, 3, 5])
    dxf = Dxf(draw)
    control = []
    for p, q in zip(points, points[1:]):
        if p[2]:
            centre, _, _, sweep = arc_of(p, q)
            w = math.cos(sweep / 2)
            x, y = (p[0] + q[0]) / 2 - centre[0], (p[1] + q[1]) / 2 - centre[1]
            row = [(p[0], p[1], 1), (w * (centre[0] + x / w ** 2), w * (centre[1] + y / w ** 2), w), (q[0], q[1], 1)]
        else:
            row = [(p[0], p[1], 1), ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, 1), (q[0], q[1], 1)]
        row = [numpy.array(each) for each in row]
        while len(row) <= degree:  # raised by one degree, in homogeneous coordinates
            n = len(row)
            row = [row[0]] + [i / n * row[i - 1] + (1 - i / n) * row[i] for i in range(1, n)] + [row[-1]]
        control += row[bool(control):]
    knots = [0.0]
    for _ in points[1:]:
        knots.append(knots[-1] + draw.uniform(0.2, 30))
    dxf.begin('SPLINE', '0', (210, '0.0'), (220, '0.0'), (230, draw.choice(['1.0', '-1.0'])))
    dxf.put((70, '4'), (71, str(degree)))
    for i, knot in enumerate(knots):
        for _ in range(degree + (i in (0, len(knots) - 1))):
            dxf.put((40, repr(knot)))
    for x, y, w in control:
        dxf.put((41, repr(float(w))), (10, repr(float(x / w))), (20, repr(float(y / w))), (30, '0'))
    return dxf.text(4), [], 0


def ellipse_arcs(draw, points):
    """Roundings as arcs of ellipses, with either extrusion; lines in space."""
    dxf = Dxf(draw)
    for p, q in zip(points, points[1:]):
        if not p[2]:
            dxf.line('0', p, q, (39, '0.5'), (210, '0.0'), (220, '0.0'), (230, '-1.0'))
            continue
        (x, y), radius, start, sweep = arc_of(p, q)
        up, turn = draw.choice([1, -1]), draw.uniform(0, 6)
        first, last = sorted((up * (start - turn), up * (start + sweep - turn)))
        dxf.begin('ELLIPSE', '0')
        dxf.point(x, y)
        dxf.put((11, repr(radius * math.cos(turn))), (21, repr(radius * math.sin(turn))), (31, '0.0'), (210, '0.0'),
                (220, '0.0'), (230, f'{up}.0'), (40, '1.0'), (41, repr(first % (2 * math.pi))),
                (42, repr(first % (2 * math.pi) + last - first)))
    return dxf.text(4), [], 0


def space_polyline(draw, points):
    """A 3D polyline, whose arcs became chords; its extrusion does not matter."""
    fine = []
    for p, q in zip(points, points[1:]):
        if p[2]:
            centre, radius, start, sweep = arc_of(p, q)
            fine += [(centre[0] + radius * math.cos(start + k / 60 * sweep),
                      centre[1] + radius * math.sin(start + k / 60 * sweep), 0) for k in range(60)]
        else:
            fine.append((p[0], p[1], 0))
    fine.append(points[-1])
    dxf = Dxf(draw)
    dxf.begin('POLYLINE', '0', (66, '1'))
    dxf.put((10, '0.0'), (20, '0.0'), (30, '0.0'), (70, '9'), (230, '-1.0'))
    for x, y, _ in fine:
        dxf.put((0, 'VERTEX'), (8, '0'), (10, repr(x)), (20, repr(y)), (30, '0'), (70, '32'))
    dxf.put((0, 'SEQEND'))
    return dxf.text(4), [], 0, measures(fine)


def nested_blocks(draw, points):
    """A block in a block, moved, turned, scaled and mirrored, on the layer of its insert."""
    sx, x0 = draw.choice([-2.5, 0.4, 3]), draw.uniform(-20, 20)
    dxf = Dxf(draw)
    dxf.pieces('0', [(x / sx + 7, r / abs(sx), bulge * (1 if sx > 0 else -1)) for x, r, bulge in points])
    inner = dxf.pairs
    dxf.pairs = []
    blocks = [(0, 'BLOCK'), (8, '0'), (2, 'Inner'), (70, '0'), (10, '7'), (20, '0'), (30, '0'), *inner, (0, 'ENDBLK'),
              (0, 'BLOCK'), (2, 'OUTER'), (10, '1'), (20, '2'), (0, 'INSERT'), (8, '0'), (2, 'inner'), (10, '3'),
              (20, '2'), (41, repr(sx)), (42, repr(abs(sx))), (0, 'ENDBLK')]
    dxf.begin('INSERT', 'stem')
    dxf.put((2, 'outer'), (10, repr(x0)), (20, '0'), (30, '0'))
    return dxf.text(4, blocks=blocks), [], x0 + 2


def untidy(draw, points):
    """Lines drawn twice, in part and the other way round, and lines of no length."""
    dxf = Dxf(draw)
    for p, q in zip(points, points[1:]):
        pieces = draw.choice([1, 1, 2])
        dxf.pieces('0', [p, q])
        if p[2] and pieces > 1:
            dxf.arc('0', p, q)
        elif pieces > 1:
            a, b = sorted((draw.uniform(0, 0.4), draw.uniform(0.6, 1)))
            at = [(p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])) for t in (a, b)]
            dxf.line('0', at[1], at[0])
        if draw.random() < 0.3:
            dxf.line('0', q, q)
    return dxf.text(4), [], 0


def gaps(draw, points):
    """Ends that a rounding to 0.01 units leaves apart."""
    dxf = Dxf(draw)
    for p, q in zip(points, points[1:]):
        if p[2]:
            dxf.arc('0', p, q)
        else:
            dxf.line('0', [v + draw.uniform(-5e-5, 5e-5) * (v > 0) for v in p[:2]],
                     [v + draw.uniform(-5e-5, 5e-5) * (v > 0) for v in q[:2]])
    return dxf.text(4), ['--join', '0.5um' if draw.random() < 0.1 else '2um'], 0


def touching_circle(draw, points):
    """A circle that touches the axis within the rounding of the file: a ring without a hole."""
    radius, x = draw.uniform(0.5, 3), draw.uniform(4, 20)
    off = draw.choice([0, 1e-7, -1e-7, 4e-4, -4e-4])
    dxf = Dxf(draw)
    dxf.begin('CIRCLE', '0')
    dxf.point(x, radius + off)
    dxf.put((40, dxf.number(radius)))
    middle = radius + max(off, 0)
    volume = 2 * math.pi ** 2 * middle * radius ** 2
    return dxf.text(4), [], 0, {
        'volume_m3': volume * 1e-9, 'centre_m': x * 1e-3, 'inertia_axial_m5': volume * (middle ** 2 + radius ** 2 * 3 / 4) * 1e-15,
        'inertia_transverse_m5': volume * (middle ** 2 / 2 + radius ** 2 * 5 / 8) * 1e-15}


def hidden(draw, points):
    """A sheet's border in paper space; sketches that are invisible or on layers off or frozen."""
    tables = [(0, 'TABLE'), (2, 'LAYER'), (70, '3'), (0, 'LAYER'), (2, 'SKETCH'), (70, '0'), (62, '-3'), (6, 'CONTINUOUS'),
              (0, 'LAYER'), (2, 'Old'), (70, '1'), (62, '7'), (0, 'ENDTAB')]
    dxf = Dxf(draw)
    border = [(-20, 1, 0), (300, 1, 0), (300, 200, 0), (-20, 200, 0)]
    dxf.light('0', border, (67, '1'))
    dxf.light('0', border, (60, '1'))
    dxf.light('sketch', border)
    dxf.light('OLD', border)
    dxf.pieces('0', points)
    return dxf.text(4, tables=tables), [], 0


# ---- STL ----

def facets(points, sides=96, start=0.1):
    """Triangles [mm] of the outline revolved about z, seen from outside counter-clockwise."""
    fine = []
    for p, q in zip(points, points[1:]):
        if p[2]:
            centre, radius, first, sweep = arc_of(p, q)
            fine += [(centre[0] + radius * math.cos(first + k / 12 * sweep),
                      centre[1] + radius * math.sin(first + k / 12 * sweep)) for k in range(12)]
        else:
            fine.append(p[:2])
    fine.append(points[-1][:2])
    angle = start + 2 * math.pi * numpy.arange(sides + 1) / sides
    angle[-1] = angle[0]
    out = []
    for a, b in zip(angle, angle[1:]):
        for (x0, r0), (x1, r1) in zip(fine, fine[1:]):
            p, q = (r0 * math.cos(a), r0 * math.sin(a), x0), (r0 * math.cos(b), r0 * math.sin(b), x0)
            s, t = (r1 * math.cos(a), r1 * math.sin(a), x1), (r1 * math.cos(b), r1 * math.sin(b), x1)
            out += [tri for tri, good in (((t, q, p), r0 > 0), ((s, t, p), r1 > 0)) if good]
    return numpy.array(out)


def polyhedron(triangles):
    """Volume, centre and moments of closed facets, the axis along z."""
    volume = numpy.linalg.det(triangles) / 6
    total = triangles.sum(axis=1)
    centre = (volume[:, None] * total / 4).sum(axis=0) / volume.sum()
    second = numpy.einsum('t,tpi,tpj->ij', volume / 20, triangles, triangles) + numpy.einsum('t,ti,tj->ij', volume / 20,
                                                                                             total, total)
    second -= volume.sum() * numpy.outer(centre, centre)
    xx, yy, zz = numpy.diag(second)
    return {'volume_m3': volume.sum() * 1e-9, 'centre_m': centre[2] * 1e-3, 'inertia_axial_m5': (xx + yy) * 1e-15,
            'inertia_transverse_m5': ((xx + yy) / 2 + zz) * 1e-15}


def stl(draw, triangles):
    if draw.random() < 0.5:
        head = draw.choice([b'solid part', b'binary']).ljust(80)
        return head + struct.pack('<I', len(triangles)) + b''.join(
            struct.pack('<12fH', 0, 0, 0, *tri.ravel(), 0) for tri in triangles)
    form = draw.choice(['%.8g', '%.7e', '%.9f'])
    rows = ['solid part of CAD']
    for tri in triangles:
        rows += ['facet normal 0 0 0', ' outer loop',
                 *('  vertex ' + ' '.join(form % v for v in point) for point in tri), ' endloop', 'endfacet']
    return ('\n'.join(rows + ['endsolid part of CAD', ''])).replace('\n', draw.choice(['\n', '\r\n'])).encode()


def mesh(draw, points):
    """One shell along any axis, away from the origin, in a stated unit."""
    triangles = facets(points)
    exact = polyhedron(triangles)
    name, unit = draw.choice([('mm', 1), ('cm', 10), ('inch', 25.4), ('m', 1e3)])
    turn = draw.randrange(3)
    moved = numpy.roll(triangles, turn, axis=2) / unit
    shift = numpy.array([draw.uniform(-30, 30) for _ in range(3)]) / unit
    along = (2 + turn) % 3
    options = ['--unit', name, '--axis', 'xyz'[along]]
    if draw.random() < 0.5:
        options += ['--angle', f'{draw.uniform(0, 360):.1f}deg']
    return stl(draw, moved + shift), options, shift[along] * unit, exact


def hollow_mesh(draw, points):
    """A shell with a cavity: one body. Without a unit, where only one is plausible."""
    triangles = facets(points)
    inner = facets([(1 + 0.1 * x, 0.2 * r, 0) for x, r, _ in points], sides=24)[:, ::-1]
    both = numpy.concatenate([triangles, inner])
    return stl(draw, both), ['--axis', 'z'], 0, polyhedron(both)


def reversed_mesh(draw, points):
    """Facets of a hollow body of which some, or all, are reversed; blanks before a text."""
    triangles = facets(points)
    inner = facets([(1 + 0.1 * x, 0.2 * r, 0) for x, r, _ in points], sides=24)[:, ::-1]
    both = numpy.concatenate([triangles, inner])
    exact = polyhedron(both)
    if draw.random() < 0.5:
        both = both[:, ::-1]
    some = numpy.array([draw.random() < 0.2 for _ in both])
    both[some] = both[some][:, ::-1]
    data = stl(draw, both)
    data = data + b'\0\0' if len(data) == 84 + 50 * len(both) else b' \n' + data
    return data, ['--axis', 'z', '--unit', 'mm'], 0, exact


def turned_mesh(draw, points):
    """A body in any direction, whose axis the moments give."""
    triangles = facets(points)
    exact = polyhedron(triangles)
    a, b = draw.uniform(0.2, 1.4), draw.uniform(0, 6)
    along = numpy.array([math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)])
    across = numpy.cross(along, [0, 0, 1])
    across /= numpy.linalg.norm(across)
    turn = numpy.array([across, numpy.cross(along, across), along])
    sign = 1 if along[numpy.argmax(abs(along))] > 0 else -1
    shift = numpy.array([draw.uniform(-30, 30) for _ in range(3)])
    exact['centre_m'] *= sign
    return stl(draw, triangles @ turn + shift), ['--unit', 'mm'], sign * float(along @ shift), exact


HABITS = [lines_and_arcs, polyline, old_polyline, composite_spline, ellipse_arcs, space_polyline, nested_blocks, untidy,
          gaps, touching_circle, hidden, mesh, hollow_mesh, reversed_mesh, turned_mesh]


def one(campaign, habit, number):
    draw = campaign.random
    points = outline(draw)
    data, options, start, *exact = habit(draw, points)
    exact = dict(exact[0] if exact else measures(points))
    exact['centre_m'] += start * 1e-3
    path = f'{campaign.folder}/{habit.__name__}-{number}.{"stl" if "mesh" in habit.__name__ else "dxf"}'
    with open(path, 'wb') as file:
        file.write(data)
    command = [campaign.program, 'cad', path, '-q', '--json=-', *options]
    result = subprocess.run(command, check=False, capture_output=True, text=True)
    bodies = json.loads(result.stdout)['bodies'] if result.returncode == 0 else []
    if len(bodies) != 1:
        return campaign.ok(False, f'{" ".join(command)}: {len(bodies)} bodies; {result.stderr}')
    off = {key: abs(bodies[0][key] / value - 1 if key != 'centre_m' else (bodies[0][key] - value) / 10e-3)
           for key, value in exact.items() if bodies[0][key] is not None}
    worst = max(off, key=off.get, default=None)
    return campaign.ok(len(off) == 4 and off[worst] < TOLERANCE,
                       f'{" ".join(command)}: measures to {off.get(worst, math.nan):.1e} ({worst}) '
                       f'{bodies[0]["profile_reason"] or ""}')


def run(campaign, seconds):
    """All habits once, then again until `seconds` of the campaign are left; in full 60 times."""
    number = 0
    while number < len(HABITS) or ((campaign.full or campaign.left() > seconds) and number < 60 * len(HABITS)):
        one(campaign, HABITS[number % len(HABITS)], number)
        number += 1

"""The STEP part of the campaign `foreign`: bodies of revolution as B-spline surfaces, which many exporters
write for all round faces, turned and moved, with and without ports. The axis, the revolved half-section,
the volume and the moments must agree within 1e-4 with those of the outline, by integrals of its own."""
import json
import math
import subprocess
import sys

sys.path.append('/usr/lib/freecad-python3/lib')
try:
    import FreeCAD
    import Part
except ImportError:
    FreeCAD = None

TOLERANCE = 1e-4
STEPS = 2000  # of Simpson's rule


def integral(function, low, high):
    """Simpson's rule in an angle, which takes the roots at the ends of circles."""
    total = 0
    for i in range(STEPS + 1):
        angle = math.pi * i / STEPS
        weight = 1 if i in (0, STEPS) else 4 if i % 2 else 2
        at = (low + high) / 2 - (high - low) / 2 * math.cos(angle)
        total += weight * function(at) * (high - low) / 2 * math.sin(angle)
    return total * math.pi / STEPS / 3


def turned(*pieces):
    """Integrals of 1, x, x2 and y2 + z2 over a body of revolution: pieces (start, end, radius at x)."""
    def over(function):
        return sum(integral(lambda x: math.pi * function(x, radius(x)), a, b) for a, b, radius in pieces)
    return [over(lambda x, r: r ** 2), over(lambda x, r: x * r ** 2), over(lambda x, r: x ** 2 * r ** 2),
            over(lambda x, r: r ** 4 / 2)]


def port(at, radius, land):
    """The same integrals over what a cross bore along y at x = `at` takes from a cylinder of radius `land`."""
    def over(function):
        return integral(lambda z: function(math.sqrt(max(radius ** 2 - z ** 2, 0)), math.sqrt(land ** 2 - z ** 2), z),
                        -radius, radius)
    volume = over(lambda a, h, z: 4 * a * h)
    return [volume, at * volume, at ** 2 * volume + over(lambda a, h, z: 4 / 3 * a ** 3 * h),
            over(lambda a, h, z: 4 / 3 * a * h ** 3 + z ** 2 * 4 * a * h)]


def stem(draw):
    """A stem along x, its integrals, and the volume of its revolved half-section [mm3]."""
    land, floor, a = draw.uniform(2.5, 3.5), draw.uniform(1.2, 2), draw.uniform(3, 5)
    b = a + draw.uniform(1.5, 2.5)
    end = b + draw.uniform(3, 5)
    points = [(0, 0), (end, 0), (end, land), (b, land), (b, floor), (a, floor), (a, land), (0, land)]
    wire = Part.makePolygon([FreeCAD.Vector(x, r, 0) for x, r in points + points[:1]])
    body = Part.Face(wire).revolve(FreeCAD.Vector(0, 0, 0), FreeCAD.Vector(1, 0, 0), 360)
    exact = turned((0, a, lambda x: land), (a, b, lambda x: floor), (b, end, lambda x: land))
    volume = exact[0]
    if draw.random() < 0.5:  # a cross port, which the half-plane does not meet
        body = body.cut(Part.makeCylinder(0.3, 10, FreeCAD.Vector(1, -5, 0), FreeCAD.Vector(0, 1, 0)))
        exact = [whole - hole for whole, hole in zip(exact, port(1, 0.3, land))]
    return body, exact, volume


def ball(draw):
    radius = draw.uniform(1, 4)
    exact = turned((-radius, radius, lambda x: math.sqrt(max(radius ** 2 - x ** 2, 0))))
    return Part.makeSphere(radius), exact, exact[0]


def vase(draw):
    """A body whose outline is a spline of up to 16 waves."""
    curve, count = Part.BSplineCurve(), draw.choice((4, 4, 16, 32))
    wave = 1 / (count - 3)
    curve.interpolate([FreeCAD.Vector(8 * i / (count - 1), draw.uniform(2 - wave, 2 + wave), 0) for i in range(count)])
    first, last = curve.value(curve.FirstParameter), curve.value(curve.LastParameter)
    corners = [last, FreeCAD.Vector(8, 0, 0), FreeCAD.Vector(0, 0, 0), first]
    wire = Part.Wire([curve.toShape(), *(Part.makeLine(p, q) for p, q in zip(corners, corners[1:]))])
    body = Part.Face(wire).revolve(FreeCAD.Vector(0, 0, 0), FreeCAD.Vector(1, 0, 0), 360)
    low, high = curve.FirstParameter, curve.LastParameter

    def over(function):
        return integral(lambda t: math.pi * function(curve.value(t).x, curve.value(t).y) * curve.getD1(t)[1].x,
                        low, high)
    exact = [over(lambda x, r: r ** 2), over(lambda x, r: x * r ** 2), over(lambda x, r: x ** 2 * r ** 2),
             over(lambda x, r: r ** 4 / 2)]
    return body, exact, exact[0]


def one(campaign, kind, number):
    draw = campaign.random
    body, exact, revolved = kind(draw)
    turn = FreeCAD.Rotation(FreeCAD.Vector(*(draw.uniform(-1, 1) for _ in range(3))), draw.uniform(0, 360))
    at = FreeCAD.Vector(*(draw.uniform(-30, 30) for _ in range(3)))
    body = body if kind == vase and draw.random() < 0.5 else body.toNurbs()  # or a surface of revolution
    body.Placement = FreeCAD.Placement(at, turn)
    path = f'{campaign.folder}/{kind.__name__}-{number}.step'
    body.exportStep(path)
    along = turn.multVec(FreeCAD.Vector(1, 0, 0))
    options = []
    if draw.random() < 0.5 and kind != ball:
        options += ['--axis', ','.join(f'{v:.12f}' for v in along)]
        if draw.random() < 0.5:
            options += ['--through', ','.join(f'{v:.9f}mm' for v in at)]
    command = [campaign.program, 'cad', path, '-q', '--json=-', *options]
    result = subprocess.run(command, check=False, capture_output=True, text=True)
    bodies = json.loads(result.stdout)['bodies'] if result.returncode == 0 else []
    off = math.inf
    if len(bodies) == 1:
        volume, first, along, around = exact
        across = around / 2 + along - first ** 2 / volume
        expected = {'revolved_volume_m3': revolved * 1e-9, 'volume_m3': volume * 1e-9,
                    'inertia_axial_m5': around * 1e-15, 'inertia_transverse_m5': across * 1e-15}
        off = max(abs(bodies[0][key] / value - 1) for key, value in expected.items())
    campaign.ok(off < TOLERANCE, f'{" ".join(command)}: volume and moments to {off:.1e} {result.stderr.strip()}')


def run(campaign, seconds):
    """All kinds once, then again until `seconds` of the campaign are left; in full 20 times."""
    kinds, number = [stem, ball, vase], 0
    if FreeCAD is None:
        campaign.say('FreeCAD is not installed: no STEP files')
        return
    while number < len(kinds) or ((campaign.full or campaign.left() > seconds) and number < 20 * len(kinds)):
        one(campaign, kinds[number % len(kinds)], number)
        number += 1

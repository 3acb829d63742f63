"""The STEP part of the campaign `foreign`: bodies of revolution as B-spline surfaces, which many exporters
write for all round faces, turned and moved, with and without ports. The axis and the revolved half-section
must agree with what was drawn within 1e-4."""
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


def stem(draw):
    """A stem along x and the volume of its revolved half-section [mm3]."""
    land, floor, a = draw.uniform(2.5, 3.5), draw.uniform(1.2, 2), draw.uniform(3, 5)
    b = a + draw.uniform(1.5, 2.5)
    end = b + draw.uniform(3, 5)
    points = [(0, 0), (end, 0), (end, land), (b, land), (b, floor), (a, floor), (a, land), (0, land)]
    wire = Part.makePolygon([FreeCAD.Vector(x, r, 0) for x, r in points + points[:1]])
    body = Part.Face(wire).revolve(FreeCAD.Vector(0, 0, 0), FreeCAD.Vector(1, 0, 0), 360)
    if draw.random() < 0.5:  # a cross port, which the half-plane does not meet
        body = body.cut(Part.makeCylinder(0.3, 10, FreeCAD.Vector(1, -5, 0), FreeCAD.Vector(0, 1, 0)))
    return body, math.pi * (land ** 2 * (end - b + a) + floor ** 2 * (b - a))


def ball(draw):
    radius = draw.uniform(1, 4)
    return Part.makeSphere(radius), math.pi * 4 / 3 * radius ** 3


def vase(draw):
    """A body whose outline is a spline: the volume by the kernel's own quadrature of its exact surface."""
    curve = Part.BSplineCurve()
    curve.interpolate([FreeCAD.Vector(x, draw.uniform(1, 3), 0) for x in (0, 2, 5, 8)])
    first, last = curve.value(curve.FirstParameter), curve.value(curve.LastParameter)
    corners = [last, FreeCAD.Vector(8, 0, 0), FreeCAD.Vector(0, 0, 0), first]
    wire = Part.Wire([curve.toShape(), *(Part.makeLine(p, q) for p, q in zip(corners, corners[1:]))])
    body = Part.Face(wire).revolve(FreeCAD.Vector(0, 0, 0), FreeCAD.Vector(1, 0, 0), 360)
    return body, body.Volume


def one(campaign, kind, number):
    draw = campaign.random
    body, volume = kind(draw)
    turn = FreeCAD.Rotation(FreeCAD.Vector(*(draw.uniform(-1, 1) for _ in range(3))), draw.uniform(0, 360))
    at = FreeCAD.Vector(*(draw.uniform(-30, 30) for _ in range(3)))
    body = body.toNurbs()
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
    off = abs(bodies[0]['revolved_volume_m3'] / (volume * 1e-9) - 1) if len(bodies) == 1 else math.inf
    campaign.ok(off < TOLERANCE, f'{" ".join(command)}: revolved volume to {off:.1e} {result.stderr.strip()}')


def run(campaign, seconds):
    """All kinds once, then again until `seconds` of the campaign are left; in full 20 times."""
    kinds, number = [stem, ball, vase], 0
    if FreeCAD is None:
        campaign.say('FreeCAD is not installed: no STEP files')
        return
    while number < len(kinds) or ((campaign.full or campaign.left() > seconds) and number < 20 * len(kinds)):
        one(campaign, kinds[number % len(kinds)], number)
        number += 1

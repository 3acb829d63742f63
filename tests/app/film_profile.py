"""Recomputes film equation, Reynolds flux and load from nothing but the `profile` of `sealbench
film --json`, as a program outside the project would. Tests: reference points of M, the inhaler
seal from 8 m/s to 1 um/s in both directions, pressure at either end. TAP on standard output.

Flux h - h^3 p' / (6 eta U), relative to the larger of h and film_flux, where h is below 200
times the flux film (further out a pressure at that end swallows the digits):
  central   p' by central differences on the uneven grid
  volume    p' between neighbours, h in the middle of their films
  quartic   p' by the polynomial through five points
Load: trapezoids, less the end pressures up to x = 0.
Film: parabola and deflection, the logarithm integrated over
  linear    straight lines of p, exactly: errs by (points in the contact)^-2, against b^2/R
  cubic     cubics through four points, against the film itself down to M of 1e4 (then digits end)
"""
import json
import subprocess
import sys
from math import inf, log, pi, sqrt

SEALBENCH = sys.argv[1]
GAUSS = ((-sqrt(0.6), 5 / 9), (0.0, 8 / 9), (sqrt(0.6), 5 / 9))


def solve(load, speed, radius, modulus, viscosity, left=0.0, right=0.0):
    text = subprocess.run(
        [SEALBENCH, "film", "--load", f"{load!r}N/m", "--speed", f"{speed!r}m/s",
         "--radius", f"{radius!r}m", "--modulus", f"{modulus!r}Pa",
         "--viscosity", f"{viscosity!r}Pa.s", "--pressure-left", f"{left!r}Pa",
         "--pressure-right", f"{right!r}Pa", "--json", "-"],
        capture_output=True, text=True, check=True).stdout
    return json.loads(text)


def lagrange_slopes(x, at):
    """Weights of the derivative of the polynomial through x at `at`."""
    weights = []
    for j, xj in enumerate(x):
        total = 0.0
        for m, xm in enumerate(x):
            if m == j:
                continue
            term = 1 / (xj - xm)
            for k, xk in enumerate(x):
                if k not in (j, m):
                    term *= (at - xk) / (xj - xk)
            total += term
        weights.append(total)
    return weights


def flux_errors(film, speed, viscosity):
    """Largest relative deviation of the flux by each way, with its place."""
    x, p, h = (film["profile"][k] for k in ("x_m", "pressure_Pa", "film_m"))
    want = film["film_flux_m"]
    factor = 1 / (6 * viscosity * speed)
    worst = {"central": 0.0, "volume": 0.0, "quartic": 0.0}

    def note(way, film_here, slope):
        error = abs(film_here - film_here ** 3 * slope * factor - want) / max(want, film_here)
        worst[way] = max(worst[way], error)

    for i in range(2, len(x) - 2):
        if h[i] > 200 * want:
            continue
        a, b = x[i] - x[i - 1], x[i + 1] - x[i]
        note("central", h[i], ((p[i + 1] - p[i]) * a / b + (p[i] - p[i - 1]) * b / a) / (a + b))
        note("volume", 0.5 * (h[i] + h[i + 1]), (p[i + 1] - p[i]) / b)
        weights = lagrange_slopes(x[i - 2:i + 3], x[i])
        note("quartic", h[i], sum(w * q for w, q in zip(weights, p[i - 2:i + 3])))
    return worst


def log_moment(t, k):
    """Integral of t^k ln|t|."""
    return 0.0 if t == 0 else t ** (k + 1) / (k + 1) * (log(abs(t)) - 1 / (k + 1))


def newton_cubics(x, p):
    """Per interval: the cubic through four neighbours, by divided differences about x[i]."""
    n = len(x)
    cubics = []
    for i in range(n - 1):
        first = min(max(i - 1, 0), n - 4)
        nodes = list(range(first, first + 4))
        nodes.sort(key=lambda j: abs(j - i))
        table = [p[j] for j in nodes]
        for level in range(1, 4):
            for k in range(3, level - 1, -1):
                table[k] = (table[k] - table[k - 1]) / (x[nodes[k]] - x[nodes[k - level]])
        # Powers of u = x - x[i]; the first node is i itself.
        d = [x[j] - x[i] for j in nodes]
        cubics.append((table[0],
                       table[1] - table[2] * d[1] + table[3] * d[1] * d[2],
                       table[2] - table[3] * (d[1] + d[2]),
                       table[3]))
    return cubics


def deflection(x, pieces, at):
    """Integral of p ln|x - at| for polynomial pieces in u = x - x[i]."""
    total = 0.0
    for i, c in enumerate(pieces):
        width = x[i + 1] - x[i]
        if max(abs(x[i] - at), abs(x[i + 1] - at)) > 4 * width:
            for r, w in GAUSS:
                u = 0.5 * width * (1 + r)
                value = c[0] + u * (c[1] + u * (c[2] + u * c[3])) if len(c) == 4 else c[0] + u * c[1]
                total += 0.5 * width * w * value * log(abs(x[i] + u - at))
            continue
        # Near: powers of t = x - at, shifted from u = t + s, closed form.
        s = at - x[i]
        if len(c) == 4:
            shifted = (c[0] + s * (c[1] + s * (c[2] + s * c[3])),
                       c[1] + s * (2 * c[2] + 3 * s * c[3]), c[2] + 3 * s * c[3], c[3])
        else:
            shifted = (c[0] + s * c[1], c[1])
        for k, value in enumerate(shifted):
            total += value * (log_moment(x[i + 1] - at, k) - log_moment(x[i] - at, k))
    return total


def film_errors(film, radius, modulus, left, right):
    """Film less parabola and deflection, which is to be the same everywhere: the largest departure
    over the film (cubic) and over b^2/R (linear), for |x| < 2 b. End pressures reach to infinity,
    with the tilt that keeps the dry contact at |x| < b."""
    x, p, h = (film["profile"][k] for k in ("x_m", "pressure_Pa", "film_m"))
    b = film["hertz_half_width_m"]
    n = len(x)
    linear = [(p[i], (p[i + 1] - p[i]) / (x[i + 1] - x[i])) for i in range(n - 1)]
    inside = [i for i in range(n) if abs(x[i]) < 2 * b]
    chosen = inside[7::max(1, len(inside) // 24)]
    worst = {}
    for name, pieces in (("linear", linear), ("cubic", newton_cubics(x, p))):
        rests = []
        for i in chosen:
            at = x[i]
            far = (left - right) * log(2) * at
            for edge, pressure in ((x[0], left), (x[-1], -right)):
                if at != edge:
                    far += pressure * (at - edge) * (log(abs(at - edge) / b) - 1)
            elastic = 4 / (pi * modulus) * (far - deflection(x, pieces, at))
            rests.append((h[i] - 0.5 * at * at / radius - elastic, h[i]))
        # The constant is the thinnest film's.
        level = min(rests, key=lambda rest: rest[1])[0]
        worst[name] = max(abs(r - level) / (b * b / radius if name == "linear" else hi)
                          for r, hi in rests)
    return worst


def load_error(film, load, left, right):
    x, p = film["profile"]["x_m"], film["profile"]["pressure_Pa"]
    total = sum(0.5 * (p[i] + p[i - 1]) * (x[i] - x[i - 1]) for i in range(1, len(x)))
    return abs((total + left * x[0] - right * x[-1]) / load - 1)


def simpson(x, y):
    """Integral by parabolas through points 0 1 2, 2 3 4, ..., the last interval by a trapezoid."""
    total = 0.0
    for i in range(0, len(x) - 2, 2):
        a, b = x[i + 1] - x[i], x[i + 2] - x[i + 1]
        total += (a + b) / 6 * ((2 - b / a) * y[i] + (a + b) ** 2 / (a * b) * y[i + 1]
                                + (2 - a / b) * y[i + 2])
    if len(x) % 2 == 0:
        total += 0.5 * (x[-1] - x[-2]) * (y[-1] + y[-2])
    return total


def parts_error(film, left):
    """Integral of h p' against [h p] less the integral of p h', p above the left end's pressure,
    each with its own derivatives by five points: nothing makes them equal but the curves."""
    x, p, h = (film["profile"][k] for k in ("x_m", "pressure_Pa", "film_m"))
    p = [q - left for q in p]
    inside = range(2, len(x) - 2)
    places = [x[i] for i in inside]
    slopes = [lagrange_slopes(x[i - 2:i + 3], x[i]) for i in inside]
    by_pressure = [h[i] * sum(w * q for w, q in zip(s, p[i - 2:i + 3]))
                   for i, s in zip(inside, slopes)]
    by_film = [p[i] * sum(w * q for w, q in zip(s, h[i - 2:i + 3]))
               for i, s in zip(inside, slopes)]
    work, counter = simpson(places, by_pressure), simpson(places, by_film)
    ends = h[-3] * p[-3] - h[2] * p[2]
    return abs(work - (ends - counter)) / max(abs(work), abs(counter), abs(ends))


def cases():
    for m in (1.0, 5.0, 20.0, 100.0, 1000.0, 10000.0):
        number = 0.5 * (1e-3 / m) ** 2  # U at W = 1e-3, E' = 10 MPa, R = 1 mm
        yield f"M = {m:g}", (10.0, 2 * number * 1e4 / 1e-3, 1e-3, 1e7, 1e-3)
    seal = (0.805e-3, 6.5725e6, 0.211e-3)
    for speed in (8.0, -8.0, 0.1, 20e-3 / 60, -1e-6):
        yield f"inhaler seal, {speed:g} m/s", (850.2, speed) + seal
    for left, right in ((0.55e6, 0.0), (0.0, 0.55e6), (0.55e6, 0.55e6), (0.2e6, 0.5e6)):
        for speed in (8.0, -1e-2):
            name = f"inhaler seal, {speed:g} m/s, {left / 1e6:g} and {right / 1e6:g} MPa"
            yield name, (850.2, speed) + seal + (left, right)


def main():
    count = 0
    for name, case in cases():
        count += 1
        load, speed, radius, modulus, viscosity = case[:5]
        left, right = case[5:] if len(case) > 5 else (0.0, 0.0)
        film = solve(*case)
        x = film["profile"]["x_m"]
        flux = flux_errors(film, speed, viscosity)
        shape = film_errors(film, radius, modulus, left, right)
        errors = {
            **{f"flux by {way}": (error, 1e-4) for way, error in flux.items()},
            "load": (load_error(film, load, left, right), 1e-5),
            "film by linear pieces over b^2/R": (shape["linear"], 1e-5),
            "film by cubics": (shape["cubic"], 1e-4 if film["moes_M"] < 2e4 else inf),
            "by parts": (parts_error(film, left), 1e-6),
            "points out of order": (sum(b <= a for a, b in zip(x, x[1:])), 0),
            "points short of 400": (max(0, 400 - len(x)), 0),
        }
        bad = {k: v for k, v in errors.items() if not v[0] <= v[1]}
        print(f"{'not ok' if bad else 'ok'} {count} - {name}")
        for key, (value, bound) in errors.items():
            print(f"# {key}: {value:.2g}{' ABOVE ' + str(bound) if key in bad else ''}")
    print(f"1..{count}")


main()

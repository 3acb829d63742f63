"""An independent solver of the steady film with asperities: finite volumes and semismooth Newton.

Shares nothing with engine/film but the equations (engine/film/ehl.h):

  d/dX (lambda H - H^3 P') >= 0,  P >= 0,  one of both nil       Reynolds with Swift and Stieber's end
  H = H0 + X^2/2 - (1/pi) integral Q ln|X - X'| dX',  Q = P + p_a(H)
  integral Q dX = pi/2

scaled by Hertz' contact of load w: b = sqrt(8 w R/(pi E')), p_H = 2 w/(pi b), film b^2/R, lambda =
12 eta (u/2) R^2/(b^3 p_H). Cells with constant pressure, the logarithm integrated exactly over each;
fluxes by second-order upwind gaps. Laws of the rough surface are integrated here from their papers
(Greenwood and Tripp 1970; Yang and Persson 2008). Figures are extrapolated from two grids.

Needs Python alone.
"""
import bisect
import math


# ------------------------------------------------------------------ rough surfaces

def simpson(f, a, b, panels):
    h = (b - a) / (2 * panels)
    return h / 3 * (f(a) + f(b) + sum((4 if i % 2 else 2) * f(a + i * h) for i in range(1, 2 * panels)))


class Law:
    """Asperity pressure [Pa] against the mean gap [m], by cubics through ln p (ln h)."""

    def __init__(self, gaps, pressures):
        pairs = sorted((math.log(h), math.log(p)) for h, p in zip(gaps, pressures) if h > 0 and p > 0)
        self.x = [a for a, _ in pairs]
        self.y = [b for _, b in pairs]
        n = len(self.x)
        secant = [(self.y[i + 1] - self.y[i]) / (self.x[i + 1] - self.x[i]) for i in range(n - 1)]
        self.d = [secant[0]] + [
            (secant[i - 1] * (self.x[i + 1] - self.x[i]) + secant[i] * (self.x[i] - self.x[i - 1]))
            / (self.x[i + 1] - self.x[i - 1]) for i in range(1, n - 1)] + [secant[-1]]

    def __call__(self, h):
        """p_a and dp_a/dh."""
        x = math.log(h)
        if x <= self.x[0] or x >= self.x[-1]:
            k = 0 if x <= self.x[0] else -1
            p = math.exp(max(-700.0, min(700.0, self.y[k] + self.d[k] * (x - self.x[k]))))
            return p, p * self.d[k] / h
        i = bisect.bisect_right(self.x, x) - 1
        w = self.x[i + 1] - self.x[i]
        s = (x - self.x[i]) / w
        y0, y1, d0, d1 = self.y[i], self.y[i + 1], self.d[i] * w, self.d[i + 1] * w
        c2, c3 = 3 * (y1 - y0) - 2 * d0 - d1, 2 * (y0 - y1) + d0 + d1
        p = math.exp(y0 + s * (d0 + s * (c2 + s * c3)))
        return p, p * (d0 + s * (2 * c2 + 3 * s * c3)) / (w * h)


def greenwood_tripp(sigma, product, sigma_over_beta, modulus):
    """p_a = (8 sqrt 2/15) pi (zeta beta sigma)^2 sqrt(sigma/beta) E' F_5/2(l), gap sigma F_1(-l)."""
    factor = 8 * math.sqrt(2) / 15 * math.pi * product**2 * math.sqrt(sigma_over_beta) * modulus
    phi = 1 / math.sqrt(2 * math.pi)
    gaps, pressures = [], []
    for i in range(901):
        l = -8 + i * 0.02
        top = math.sqrt(max(0.0, -l) + 9 - 0.5 * min(l, 0))
        f = simpson(lambda v: 2 * v**6 * phi * math.exp(-0.5 * (l + v * v)**2), 0, top, 120)
        gaps.append(sigma * (l * 0.5 * math.erfc(-l / math.sqrt(2)) + phi * math.exp(-0.5 * l * l)))
        pressures.append(factor * f)
    return Law(gaps, pressures)


def persson(sigma, product, sigma_over_beta, modulus):
    """Yang and Persson's mean separation, gamma 0.45; the spectrum has Nayak's moments."""
    hurst = 0.8

    def moment(k, ratio):  # integral of q^k C from 1 to ratio, C = q^(-2(H+1))
        e = k - 2 * (hurst + 1) + 1
        return (ratio**e - 1) / e

    # beta = 3 sqrt(pi/m4)/8, zeta = m4/(6 pi sqrt 3 m2): zeta beta sigma tells m0 m4/m2^2.
    alpha = (product * 8 * 6 * math.pi * math.sqrt(3) / (3 * math.sqrt(math.pi)))**2
    low, high = 1.0 + 1e-9, 1e9
    for _ in range(200):
        middle = math.sqrt(low * high)
        m0, m2, m4 = 2 * moment(1, middle), moment(3, middle), 0.75 * moment(5, middle)
        low, high = (middle, high) if m0 * m4 / m2**2 < alpha else (low, middle)
    ratio = low
    beta = sigma / sigma_over_beta
    # m4 = 9 pi/(64 beta^2) = A 0.75 pi q0^(4 - 2H) I5, sigma^2 = A 2 pi q0^(-2H) I1.
    m4 = 9 * math.pi / (64 * beta**2)
    q0 = (m4 / sigma**2 * 2 * moment(1, ratio) / (0.75 * moment(5, ratio)))**0.25
    amplitude = sigma**2 / (2 * math.pi * q0**(-2 * hurst) * moment(1, ratio))
    gamma, star = 0.45, modulus / 2
    # G(a) = integral from a of [gamma + 3 (1 - gamma) erf^2] exp(-x^2) dx/x, in ln x from above.
    grid = [math.log(1e-7) + i * 0.01 for i in range(int((math.log(6.5) - math.log(1e-7)) / 0.01) + 1)]
    f = [(gamma + 3 * (1 - gamma) * math.erf(math.exp(z))**2) * math.exp(-math.exp(2 * z)) for z in grid]
    total = [0.0] * len(grid)
    for i in range(len(grid) - 2, -1, -1):
        total[i] = total[i + 1] + 0.005 * (f[i] + f[i + 1])

    def g(a):
        z = (math.log(a) - grid[0]) / 0.01
        if z >= len(grid) - 1:
            return 0.0
        if z <= 0:
            return total[0] - gamma * (math.log(a) - grid[0])
        i = int(z)
        return total[i] + (z - i) * (total[i + 1] - total[i])

    # q = q0 + (q1 - q0) v^4 takes the root out of w at q0.
    panels = 400
    points = []
    for i in range(panels):
        v = (i + 0.5) / panels
        x = 1 + (ratio - 1) * v**4
        q = q0 * x
        slope2 = math.pi * amplitude * q0**(2 - 2 * hurst) * moment(3, x)
        w = 1 / math.sqrt(slope2)
        weight = q0 * (ratio - 1) * 4 * v**3 / panels
        points.append((math.sqrt(math.pi) * q * q * amplitude * q**(-2 * (hurst + 1)) * w * weight, w))
    gaps, pressures = [], []
    for i in range(700):
        p = star * math.exp(-30 + 0.05 * i)
        gaps.append(sum(c * g(w * p / star) for c, w in points if w * p / star < 6.4))
        pressures.append(p)
    cut = [(h, p) for h, p in zip(gaps, pressures) if h > 1e-9 * sigma]
    return Law([h for h, _ in cut], [p for _, p in cut])


# ------------------------------------------------------------------ linear algebra

def solve(a, b):
    """Gauss with row pivots, in place."""
    n = len(a)
    for row, value in zip(a, b):
        row.append(value)
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(a[i][k]))
        a[k], a[p] = a[p], a[k]
        pivot = a[k][k]
        tail = a[k][k:]
        for i in range(k + 1, n):
            row = a[i]
            if row[k]:
                f = row[k] / pivot
                row[k:] = [x - f * y for x, y in zip(row[k:], tail)]
    x = [0.0] * n
    for k in range(n - 1, -1, -1):
        row = a[k]
        x[k] = (row[n] - sum(map(lambda u, v: u * v, row[k + 1:n], x[k + 1:]))) / row[k]
    return x


# ------------------------------------------------------------------ film

class Contact:
    """A line contact: load [N/m], radius [m], modulus E' [Pa], viscosity [Pa s]."""

    def __init__(self, load, radius, modulus, viscosity, law=None):
        self.b = math.sqrt(8 * load * radius / (math.pi * modulus))
        self.p_hertz = 2 * load / (math.pi * self.b)
        self.film = self.b**2 / radius
        self.speed_scale = 6 * viscosity * radius**2 / (self.b**3 * self.p_hertz)
        self.law = law

    def asperity(self, h):
        """Scaled asperity pressure and its slope."""
        if not self.law:
            return 0.0, 0.0
        p, slope = self.law(h * self.film)
        return p / self.p_hertz, slope * self.film / self.p_hertz


class Grid:
    """Cells that grow with the distance from the contact's edges."""

    def __init__(self, finest, growth, left=-4.0, right=2.5, inlet=1.0):
        def size(x):
            return min(2.0 * growth, inlet * finest + growth * abs(x + 1), 0.25 * finest + growth * abs(x - 1))
        self.face = [left]
        while self.face[-1] < right:
            x = self.face[-1]
            s = size(x + 0.5 * size(x))
            self.face.append(x + s)
        f = self.face
        self.x = [0.5 * (a + b) for a, b in zip(f, f[1:])]
        self.dx = [b - a for a, b in zip(f, f[1:])]
        self.n = len(self.x)

        def part(z):
            return z * math.log(abs(z)) - z if z else 0.0
        self.kernel = []
        for x in self.x:
            values = [part(x - e) for e in f]
            self.kernel.append([-(a - b) / math.pi for a, b in zip(values, values[1:])])


class State:
    def __init__(self, grid, q, h, H0, p):
        self.grid, self.q, self.h, self.H0, self.p = grid, q, h, H0, p

    def on(self, grid, contact):
        """The state on another grid."""
        def at(values):
            xs, out = self.grid.x, []
            for x in grid.x:
                i = min(max(bisect.bisect_right(xs, x) - 1, 0), len(xs) - 2)
                s = min(max((x - xs[i]) / (xs[i + 1] - xs[i]), 0), 1)
                out.append(values[i] + s * (values[i + 1] - values[i]))
            return out
        logs = at([math.log(v) for v in self.h])
        return State(grid, at(self.q), [math.exp(v) for v in logs], self.H0, at(self.p))


def start(grid, contact, speed):
    """Hertz' pressure, a gap of the inlet's size on Hertz' gap."""
    film = 0.8 * (contact.speed_scale * speed)**0.6
    q = [math.sqrt(max(0.0, 1 - x * x)) for x in grid.x]
    h = []
    for x in grid.x:
        u = abs(x)
        h.append(film + (0.5 * (u * math.sqrt(u * u - 1) - math.log(u + math.sqrt(u * u - 1)))
                         if u > 1 else 0.0))
    H0 = film - 0.25 - 0.5 * math.log(2.0)
    return State(grid, q, h, H0, list(q))


def residuals(contact, state, speed):
    """Divergence of each cell's flux, with its derivatives to p and h of i-2 .. i+1."""
    g, p, h = state.grid, state.p, state.h
    lam = contact.speed_scale * speed
    n = g.n
    flux = []  # value, {p index: derivative}, {h index: derivative}
    for f in range(n + 1):  # face f between cells f-1 and f
        if f == 0 or f == n:
            i = 0 if f == 0 else n - 1
            x = g.face[f]
            # At the ends the pressure is nil.
            d = (g.x[0] - x) if f == 0 else (x - g.x[n - 1])
            s = 1.0 if f == 0 else -1.0
            flux.append((lam * h[i] - h[i]**3 * s * p[i] / d, {i: -h[i]**3 * s / d},
                         {i: lam - 3 * h[i]**2 * s * p[i] / d}))
            continue
        a, c = f - 1, f
        dist = g.x[c] - g.x[a]
        gradient = (p[c] - p[a]) / dist
        w = (g.face[f] - g.x[a]) / dist
        hf = (1 - w) * h[a] + w * h[c]
        hu, du = hf, {a: 1 - w, c: w}
        dh = {k: lam * v for k, v in du.items()}
        dh[a] = dh.get(a, 0) - 3 * hf**2 * gradient * (1 - w)
        dh[c] = dh.get(c, 0) - 3 * hf**2 * gradient * w
        flux.append((lam * hu - hf**3 * gradient, {a: hf**3 / dist, c: -hf**3 / dist}, dh))
    return flux


def newton(contact, state, speed, tolerance=1e-9, limit=60):
    g = state.grid
    n = g.n
    lam = contact.speed_scale * speed
    for iteration in range(limit):
        flux = residuals(contact, state, speed)
        bend = [contact.asperity(v) for v in state.h]
        r1 = [state.H0 + 0.5 * x * x + sum(map(lambda a, b: a * b, row, state.q)) - h
              for x, row, h in zip(g.x, g.kernel, state.h)]
        r2 = [p + a[0] - q for p, a, q in zip(state.p, bend, state.q)]
        matrix, right = [], []
        scale = 1 / lam
        for i in range(n):
            div = (flux[i + 1][0] - flux[i][0]) * scale
            diagonal = (flux[i + 1][1][i] - flux[i][1][i]) * scale
            cavity = state.p[i] * diagonal < div
            dp, dh, value = {}, {}, div
            if cavity:
                dp, value = {i: 1.0}, state.p[i]
            else:
                for part, sign in ((flux[i + 1], scale), (flux[i], -scale)):
                    for k, v in part[1].items():
                        dp[k] = dp.get(k, 0) + sign * v
                    for k, v in part[2].items():
                        dh[k] = dh.get(k, 0) + sign * v
            # dp = dq - p_a' dh - r2, dh = K dq + dH0 + r1
            row = [0.0] * (n + 1)
            rhs = -value
            for k, v in dp.items():
                row[k] += v
                rhs += v * r2[k]
                dh[k] = dh.get(k, 0) - v * bend[k][1]
            for k, v in dh.items():
                kernel = g.kernel[k]
                row[:n] = [a + v * b for a, b in zip(row, kernel)]
                row[n] += v
                rhs -= v * r1[k]
            matrix.append(row)
            right.append(rhs)
        matrix.append(list(g.dx) + [0.0])
        right.append(math.pi / 2 - sum(map(lambda a, b: a * b, g.dx, state.q)))
        for row, i in zip(matrix, range(n + 1)):
            m = max(map(abs, row))
            row[:] = [v / m for v in row]
            right[i] /= m
        step = solve(matrix, right)
        dq, dH0 = step[:n], step[n]
        dh = [sum(map(lambda a, b: a * b, row, dq)) + dH0 + r for row, r in zip(g.kernel, r1)]
        dp = [q - a[1] * h - r for q, a, h, r in zip(dq, bend, dh, r2)]
        share = 1.0
        for h, d in zip(state.h, dh):
            if d < -0.6 * h:
                share = min(share, -0.6 * h / d)
            elif d > 2.0 * h:
                share = min(share, max(2.0 * h / d, 0.1))
        state.q = [a + share * b for a, b in zip(state.q, dq)]
        state.H0 += share * dH0
        state.h = [a + share * b for a, b in zip(state.h, dh)]
        state.p = [a + share * b for a, b in zip(state.p, dp)]
        change = max(abs(d / h) for d, h in zip(dh, state.h))
        if share == 1.0 and change < tolerance:
            return iteration + 1
    raise ArithmeticError(f'no film at {speed} m/s: last change {change:.2g}')


def figures(contact, state):
    """Least gap [m] by a parabola through the least cells; asperities' share of the load."""
    g, h = state.grid, state.h
    i = min(range(1, g.n - 1), key=lambda k: h[k])
    x0, x1, x2 = g.x[i - 1:i + 2]
    d1, d2 = (h[i] - h[i - 1]) / (x1 - x0), (h[i + 1] - h[i]) / (x2 - x1)
    c = (d2 - d1) / (x2 - x0)
    least = h[i]
    if c > 0:
        x = 0.5 * (x0 + x1) - d1 / (2 * c)
        least = h[i - 1] + d1 * (x - x0) + c * (x - x0) * (x - x1)
    share = sum(contact.asperity(v)[0] * d for v, d in zip(h, g.dx)) / (math.pi / 2)
    return least * contact.film, share


def steady(contact, speed, fast, finest, growth):
    """Least film and share on two grids and extrapolated; from `fast` down to `speed` [m/s]."""
    grid = Grid(2 * finest, 2 * growth)
    state = start(grid, contact, fast)
    now = fast
    count = newton(contact, state, now)
    ratio = 3.0
    while now > speed * (1 + 1e-12):
        kept = (list(state.q), list(state.h), state.H0, list(state.p))
        trial = max(speed, now / ratio)
        try:
            count += newton(contact, state, trial, limit=25)
            now = trial
        except (ArithmeticError, OverflowError, ValueError):
            state.q, state.h, state.H0, state.p = kept
            ratio = math.sqrt(ratio)
            if ratio < 1.01:
                raise
    out = [figures(contact, state)]
    fine = state.on(Grid(finest, growth), contact)
    count += newton(contact, fine, speed)
    out.append(figures(contact, fine))
    out.append(tuple(b + (b - a) / 3 for a, b in zip(*out)))
    return out, (grid.n, fine.grid.n), count

"""An independent solver of the film in time: finite volumes with complementarity, BDF2.

Shares nothing with engine/film but the equations (engine/film/transient.h), scaled as in
film_volumes.py, time in seconds:

  d(h - z)/dt + d/dX(v (h - z) - kappa h^3 P') = 0,  P >= 0,  z >= 0,  one of both nil

v = u/(2 b), kappa = film^2 p_H/(12 eta b^2); z is what a cavity lacks of its gap. Transport by the mean
of two full cells, else from upstream. Asperities bear p_a(h) beside P: the gap follows the film's pressure
by the kernel (I - K p_a')^-1 K. The cells are fixed; a Newton step takes the factors of an earlier one
while these still bring it on. Needs Python alone.
"""
import math
from operator import mul

import film_volumes as fv


def factor(a):
    """Factors in place with row pivots; the order of the rows."""
    n = len(a)
    order = list(range(n))
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(a[i][k]))
        a[k], a[p] = a[p], a[k]
        order[k], order[p] = order[p], order[k]
        pivot, tail = a[k][k], a[k][k + 1:]
        for row in a[k + 1:]:
            if row[k]:
                f = row[k] = row[k] / pivot
                row[k + 1:] = [x - f * y for x, y in zip(row[k + 1:], tail)]
    return order


def backward(a, order, b):
    n = len(a)
    y = []
    for k in range(n):
        y.append(b[order[k]] - sum(map(mul, a[k], y)))
    for k in range(n - 1, -1, -1):
        row = a[k]
        y[k] = (y[k] - sum(map(mul, row[k + 1:], y[k + 1:]))) / row[k]
    return y


class Moving:
    """The film of a contact at `speed`, steady; then by steps."""

    def __init__(self, contact, grid, start, speed):
        self.c, self.g = contact, grid
        s = start.on(grid, contact)
        fv.newton(contact, s, speed)
        flux = fv.residuals(contact, s, speed)
        last = max(i for i, p in enumerate(s.p) if p > 1e-12)
        left = flux[last // 2][0] / (contact.speed_scale * speed)
        self.h, self.H0 = s.h, s.H0
        self.z = [0.0 if i <= last else max(0.0, h - left) for i, h in enumerate(s.h)]
        self.full = [z <= 0 for z in self.z]
        self.bear()
        self.p = [p if full else 0.0 for p, full in zip(s.p, self.full)]
        self.old = [[h - z for h, z in zip(self.h, self.z)]] * 2
        self.before = None
        self.kappa = 1 / (2 * contact.b * contact.speed_scale)
        self.kernel, self.rise = grid.kernel, [1.0] * grid.n
        self.factors = None
        self.solves = self.factored = 0

    def faces(self, v):
        """Flows through the faces and their derivatives to P, h and z of the cells beside."""
        g, p, h, z, kappa, n = self.g, self.p, self.h, self.z, self.kappa, self.g.n
        d = g.x[0] - g.face[0]
        inside = 1.0 if v < 0 else 0.0
        out = [(v * (h[0] - inside * z[0]) - kappa * h[0]**3 * p[0] / d, 0.0, -kappa * h[0]**3 / d, 0.0,
                v - 3 * kappa * h[0]**2 * p[0] / d, 0.0, -v * inside)]
        for a in range(n - 1):
            c = a + 1
            distance = g.x[c] - g.x[a]
            slope = (p[c] - p[a]) / distance
            w = (g.face[c] - g.x[a]) / distance
            gap = (1 - w) * h[a] + w * h[c]
            share = w if self.full[a] and self.full[c] else 1.0 if v < 0 else 0.0
            m = (1 - share) * (h[a] - z[a]) + share * (h[c] - z[c])
            push = kappa * gap**3 / distance
            bend = 3 * kappa * gap**2 * slope
            out.append((v * m - kappa * gap**3 * slope, push, -push, v * (1 - share) - bend * (1 - w),
                        v * share - bend * w, -v * (1 - share), -v * share))
        d = g.face[n] - g.x[n - 1]
        inside = 1.0 - inside
        out.append((v * (h[-1] - inside * z[-1]) + kappa * h[-1]**3 * p[-1] / d, kappa * h[-1]**3 / d, 0.0,
                    v + 3 * kappa * h[-1]**2 * p[-1] / d, 0.0, -v * inside, 0.0))
        return out

    def derivatives(self, face, c0):
        """Of every cell's balance to P, h and z of itself and the two beside."""
        rows = []
        for i, dx in enumerate(self.g.dx):
            a, b = face[i], face[i + 1]
            rows.append(((-a[1], b[1] - a[2], b[2]), (-a[3], dx * c0 + b[3] - a[4], b[4]),
                         (-a[5], -dx * c0 + b[5] - a[6], b[6])))
        return rows

    def bear(self):
        """Asperities' pressure and its slope."""
        self.solid, self.slope = zip(*map(self.c.asperity, self.h))

    def yielding(self):
        """The kernel of the film's pressure, asperities giving way, and the gap's rise by H0."""
        if not self.c.law:
            return
        n = self.g.n
        matrix = [[(i == k) - a * s for k, (a, s) in enumerate(zip(row, self.slope))]
                  for i, row in enumerate(self.g.kernel)]
        self.elastic = (matrix, factor(matrix))
        columns = [backward(*self.elastic, [row[k] for row in self.g.kernel]) for k in range(n)]
        self.kernel = list(zip(*columns))
        self.rise = backward(*self.elastic, [1.0] * n)
        # Of the load to the film's pressure and H0.
        borne = [d * s for d, s in zip(self.g.dx, self.slope)]
        self.borne = borne
        self.by_load = [d + sum(map(mul, borne, column)) for d, column in zip(self.g.dx, columns)]
        self.by_load.append(sum(map(mul, borne, self.rise)))

    def refactor(self, rows):
        g, n = self.g, self.g.n
        self.yielding()
        matrix = []
        for i, (dp, dh, dz) in enumerate(rows):
            cells = [k for k in (i - 1, i, i + 1) if 0 <= k < n]
            row = [0.0] * n
            for k in cells:
                by = dh[k - i + 1]
                row = [a + by * b for a, b in zip(row, self.kernel[k])]
            row = [a if full else 0.0 for a, full in zip(row, self.full)]
            row.append(sum(dh[k - i + 1] * self.rise[k] for k in cells))
            for k in cells:
                row[k] += dp[k - i + 1] if self.full[k] else dz[k - i + 1]
            matrix.append(row)
        load = self.by_load if self.c.law else list(g.dx) + [0.0]
        matrix.append([d if full else 0.0 for d, full in zip(load, self.full)] + [load[n]])
        scale = [1 / max(map(abs, row)) for row in matrix]
        matrix = [[a * s for a in row] for row, s in zip(matrix, scale)]
        self.factors = (matrix, factor(matrix), scale, list(self.full))
        self.factored += 1

    def gap(self):
        q = [p + a for p, a in zip(self.p, self.solid)]
        return [self.H0 + 0.5 * x * x + sum(map(mul, row, q)) for x, row in zip(self.g.x, self.g.kernel)]

    def step(self, dt, speed):
        g, n = self.g, self.g.n
        v = speed / (2 * self.c.b)
        if self.before is None:
            c0 = 1 / dt
            past = [-m / dt for m in self.old[0]]
        else:
            r = dt / self.before
            c0 = (1 + 2 * r) / (1 + r) / dt
            past = [-(1 + r) / dt * a + r * r / (1 + r) / dt * b for a, b in zip(*self.old)]
        last, fresh = math.inf, self.factors is None or abs(math.log(c0 / self.c0)) > 0.4
        for _ in range(60):
            face = self.faces(v)
            rows = self.derivatives(face, c0)
            if fresh or self.factors[3] != self.full:
                self.refactor(rows)
                self.c0 = c0
            matrix, order, scale, _full = self.factors
            lacks = [0.0] * n  # of the gap, which the asperities' pressure hangs on
            if self.c.law:
                lacks = backward(*self.elastic, [a - h for a, h in zip(self.gap(), self.h)])
            right = [-(dx * (c0 * (h - z) + old) + face[i + 1][0] - face[i][0])
                     for i, (dx, h, z, old) in enumerate(zip(g.dx, self.h, self.z, past))]
            right.append(math.pi / 2 - sum(d * (p + a) for d, p, a in zip(g.dx, self.p, self.solid)))
            if self.c.law:
                for i, (_, dh, _) in enumerate(rows):
                    right[i] -= sum(dh[k - i + 1] * lacks[k] for k in (i - 1, i, i + 1) if 0 <= k < n)
                right[n] -= sum(map(mul, self.borne, lacks))
            y = backward(matrix, order, [a * b for a, b in zip(right, scale)])
            self.solves += 1
            was = self.h
            share = 1.0
            pushed = [a if full else 0.0 for a, full in zip(y, self.full)]
            change = [sum(map(mul, row, pushed)) + y[n] * up + r
                      for row, up, r in zip(self.kernel, self.rise, lacks)]
            for h, d in zip(was, change):
                if d < -0.6 * h:
                    share = min(share, -0.6 * h / d)
            self.p = [p + share * a if full else 0.0 for p, a, full in zip(self.p, y, self.full)]
            self.z = [0.0 if full else z + share * a for z, a, full in zip(self.z, y, self.full)]
            self.H0 += share * y[n]
            self.h = [h + share * d for h, d in zip(was, change)] if self.c.law else self.gap()
            self.bear()
            moved = max(abs(a / b) for a, b in zip(change, was))
            turned = [k for k in range(n) if (self.p[k] < 0 if self.full[k] else self.z[k] < 0)]
            for k in turned:
                self.full[k] = not self.full[k]
                self.p[k] = self.z[k] = 0.0
            fresh = moved > 0.2 * last or share < 1
            if share == 1.0 and not turned and moved < 1e-6:
                break
            last = moved
        else:
            raise ArithmeticError(f'no step: {moved}')
        self.old = [[h - z for h, z in zip(self.h, self.z)], self.old[0]]
        self.before = dt

    def least(self):
        return fv.figures(self.c, fv.State(self.g, self.p, self.h, self.H0, self.p))


def stop_and_rest(contact, speed, stop, end, finest, growth, steps):
    """The film at `end`, after sliding steadily at `speed`, evenly to rest in `stop`."""
    coarse = fv.Grid(0.008, 0.12)
    start = fv.start(coarse, contact, 8.0)
    now = 8.0
    fv.newton(contact, start, now)
    while now > speed:
        now = max(speed, now / 3)
        fv.newton(contact, start, now)
    film = Moving(contact, fv.Grid(finest, growth, inlet=0.25), start, speed)
    plan = [stop * (1 - (1 - (i + 1) / steps)**1.7) for i in range(steps)]
    dt = plan[-1] - plan[-2]
    while plan[-1] < end * (1 - 1e-9):
        dt = min(dt * 1.2, 0.1 * end)
        plan.append(min(end, plan[-1] + dt))
    t = 0.0
    for at in plan:
        film.step(at - t, max(0.0, speed * (1 - at / stop)))
        t = at
    return film

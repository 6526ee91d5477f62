"""One mass on a spring and a damper, integrated to rounding under a force that is a polynomial of time."""

import math

MAX_NODES = 8
# Enough for parts of a step with omega h <= 1: what is left out is below 1/20! of the amplitude.
SERIES_TERMS = 20
MAX_PARTS = 100_000


class Polynomial:
    """The polynomial through the points (nodes[i], values[i]), in Newton's form."""

    def __init__(self, nodes, values):
        points = f"nodes {list(nodes)} with values {list(values)}"
        if not 1 <= len(nodes) <= MAX_NODES or len(nodes) != len(values) or len(set(nodes)) < len(nodes):
            raise ValueError(f"{points}: 1 to {MAX_NODES} distinct nodes, each with one value, are allowed")
        if not all(map(math.isfinite, [*nodes, *values])):
            raise ValueError(f"{points}: only finite numbers are allowed")
        self.nodes, self.differences = list(nodes), list(values)
        for order in range(1, len(nodes)):
            for i in reversed(range(order, len(nodes))):
                rise = self.differences[i] - self.differences[i - 1]
                self.differences[i] = rise / (nodes[i] - nodes[i - order])

    def powers(self, start, scale):
        """Coefficients a_j of p(start + scale s) = a_0 + a_1 s + a_2 s^2 + ..."""
        coefficients = [0.0] * len(self.nodes)
        for node, difference in zip(reversed(self.nodes), reversed(self.differences)):
            shift = start - node
            products = [scale * lower + shift * same for lower, same in zip(coefficients, coefficients[1:])]
            coefficients = [difference + shift * coefficients[0], *products]
        return coefficients

    def value(self, t):
        return self.powers(t, 0.0)[0]


class Oscillator:
    """m v' = -c x - d v + f, x' = v, in SI units."""

    def __init__(self, m, c, d):
        if m <= 0.0:
            raise ValueError(f"parameters.m = {m} kg: the mass must be > 0")
        for name, value in (("c", c), ("d", d)):
            if value < 0.0:
                raise ValueError(f"parameters.{name} = {value}: it must be >= 0")
        self.m, self.c, self.d = m, c, d

    def acceleration(self, x, v, f):
        return (f - self.c * x - self.d * v) / self.m

    def parts(self, step):
        """Into how many parts of length h a step is cut so that omega h <= 1 and d h / m <= 1."""
        parts = step * max(math.sqrt(self.c / self.m), self.d / self.m)
        if not parts <= MAX_PARTS:
            raise ValueError(f"step = {step} s: it would take {parts:.0f} parts, at most {MAX_PARTS} are allowed")
        return max(1, math.ceil(parts))

    def advance(self, x, v, step, force):
        """Position and velocity `step` seconds later; `force` is a Polynomial of the time since the start."""
        if not (math.isfinite(step) and step > 0.0):
            raise ValueError(f"step = {step} s: it must be finite and > 0")
        parts = self.parts(step)
        h = step / parts
        for part in range(parts):
            x, v = self.sum_series(x, v, h, force.powers(part * h, h))
        return x, v

    def sum_series(self, x, v, h, force):
        """Position and velocity after h from the power series in s = t/h of x and of w = h v:
        (n+1) x_{n+1} = w_n and (n+1) w_{n+1} = (h^2 (f_n - c x_n) - h d w_n) / m."""
        xs, ws = [x], [h * v]
        for n, f in enumerate(force + [0.0] * (SERIES_TERMS - len(force))):
            xs.append(ws[n] / (n + 1))
            ws.append((h * h * (f - self.c * xs[n]) - h * self.d * ws[n]) / self.m / (n + 1))
        # fsum rounds once; v itself stays out of the division so that a short step does not blur it.
        return math.fsum(xs), v + math.fsum(ws[1:]) / h

"""Integrals of outputs over a step, weighted by Legendre's polynomials on it.

With the share `s = tau / H` of a step of length `H`, integral number `i` of an output `y` is the integral of `y L_i ds` over
`0 <= s <= 1`, in the unit of `y`: `L_0 = 1`, `L_1 = 2s - 1`, `(i + 1) L_{i+1} = (2i + 1)(2s - 1) L_i - i L_{i-1}`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache

LEAST_PARTS = 4
"""Internal steps of a Runge-Kutta method in a step with integrals."""


class Integrals:
    """The integrals that a step is asked for, and what the solver has told of them.

    They stand number by number: integral 0 of all integrated outputs, then integral 1, and so on; `len` is how many there are
    together. With none, `add`, `add_along` and `rates` cost next to nothing, so a solver need not ask.
    """

    def __init__(self, names: Sequence[str], places: Sequence[int]) -> None:
        self._names = names
        self._places = places
        self._count = 0
        self._step = 1.0
        self._values: list[float] | None = None

    def __len__(self) -> int:
        """Number of all integrals: outputs times weights."""
        return self._count * len(self._places)

    def weights(self, share: float) -> list[float]:
        """`L_0, L_1, ..` at a share of the step from 0 to 1, as many as there are integrals of each output."""
        return legendre(share, self._count)

    def longest_step(self, step: float) -> float:
        """The longest internal step (s) in a step of this length: a quarter of it, since weights vary; without integrals all.

        With weights up to degree 3 the integrals of a method of order 4 are then as good as the motion.
        """
        return step / LEAST_PARTS if len(self) > 0 else step

    def rates(self, tau: float, outputs: Sequence[float] | Mapping[str, float]) -> list[float]:
        """Rates `q' = y L_i / H` of the integrals at `tau` (s after the start of the step), for solvers with them as unknowns.

        `outputs` are all outputs there, in either form of `Subsystem.outputs`. The unknowns are 0 at the start of the step; at
        its end they are what `set` takes.
        """
        if len(self) == 0:
            return []
        wanted = self._wanted(outputs)
        return [weight / self._step * value for weight in self.weights(tau / self._step) for value in wanted]

    def set(self, values: Sequence[float]) -> None:
        """Tells all integrals at once."""
        self._values = [*values]

    def add(self, tau: float, weight: float, outputs: Sequence[float] | Mapping[str, float]) -> None:
        """Adds one stage of an internal step: `outputs` at `tau` (s after the start of the step), times `weight` (s).

        With the nodes and weights of the solver's own method this is what the method gives for the unknowns of `rates`, so the
        integrals have its order. Internal steps that are longer than `longest_step` are too long for it.
        """
        if len(self) > 0:
            rates = self.rates(tau, outputs)
            before = self._values or [0.0] * len(rates)
            self._values = [value + weight * rate for value, rate in zip(before, rates, strict=True)]

    def add_along(
        self, tau: float, h: float, degree: int, outputs: Callable[[float], Sequence[float] | Mapping[str, float]]
    ) -> None:
        """Adds an internal step from `tau` over `h` (s) with known outputs inside: `outputs(sigma)`, `sigma` from 0 to `h`.

        Gauss's formula is taken with so many points that polynomials of the degree `degree` are integrated exactly under every
        weight. What is left is how far `outputs` is from the motion: the order is that of the interpolation behind it.
        """
        if len(self) > 0:
            for node, weight in gauss((degree + self._count + 1) // 2):
                self.add(tau + node * h, weight * h, outputs(node * h))

    def choose(self, count: int) -> None:
        """Lets the steps that follow have so many integrals of each output. The package calls it."""
        self._count = count

    def begin(self, step: float) -> None:
        """Begins a step of length `step` (s): all integrals are 0. The package calls it."""
        self._step = step
        self._values = None

    def told(self) -> list[float]:
        """What the solver has told in this step; empty if nothing. The package calls it."""
        return [float(value) for value in self._values or ()]

    def of(self, place: int) -> str:
        """Name of the output that integral number `place` of all belongs to. The package calls it."""
        return self._names[self._places[place % len(self._places)]]

    def _wanted(self, outputs: Sequence[float] | Mapping[str, float]) -> list[float]:
        if isinstance(outputs, Mapping):
            return [outputs[self._names[place]] for place in self._places]
        return [outputs[place] for place in self._places]


def legendre(share: float, count: int) -> list[float]:
    """The first `count` of Legendre's polynomials on a step, at a share of it."""
    x = 2.0 * share - 1.0
    before, own, values = 0.0, 1.0, []
    for degree in range(count):
        values.append(own)
        before, own = own, ((2 * degree + 1) * x * own - degree * before) / (degree + 1)
    return values


@lru_cache
def gauss(points: int) -> tuple[tuple[float, float], ...]:
    """Nodes and weights of Gauss's formula on [0, 1]."""
    found = []
    for place in range(points):
        x = math.cos(math.pi * (place + 0.75) / (points + 0.5))
        for _ in range(6):
            value, slope = _of_degree(points, x)
            x -= value / slope
        _, slope = _of_degree(points, x)
        found.append(((1.0 + x) / 2.0, 1.0 / ((1.0 - x * x) * slope * slope)))
    return tuple(found)


def _of_degree(degree: int, x: float) -> tuple[float, float]:
    """Legendre's polynomial on [-1, 1] and its derivative."""
    *_, before, own = legendre((1.0 + x) / 2.0, degree + 1)
    return own, degree * (x * own - before) / (x * x - 1.0)


def add_part(start: float, end: float, part: Sequence[float], whole: list[float], outputs: int) -> None:
    """Adds to the integrals over a step those over its part from share `start` to share `end`, under weights of its own.

    `L_i` of the step is a sum of polynomials of the part, by their recurrence.
    """
    length, count = end - start, len(whole) // outputs
    before, own = [0.0] * (count + 1), [1.0] + [0.0] * count
    for degree in range(count):
        for k in range(degree + 1):
            for place in range(outputs):
                whole[degree * outputs + place] += length * own[k] * part[k * outputs + place]
        following = [-degree * value for value in before]
        for k in range(degree + 1):
            size = (2 * degree + 1) * own[k]
            following[k] += size * (start + end - 1.0)
            following[k + 1] += size * length * (k + 1) / (2 * k + 1)
            if k > 0:
                following[k - 1] += size * length * k / (2 * k + 1)
        before, own = own, [value / (degree + 1) for value in following]

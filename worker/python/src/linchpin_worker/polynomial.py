"""The polynomial of a coupling variable over one macro step."""

from __future__ import annotations

import math
from collections.abc import MutableSequence, Sequence

MAX_NODES = 8
"""Most nodes that a polynomial may have; its degree is one less."""


class Polynomial:
    """`p(tau) = c_0 + c_1 (tau - n_0) + c_2 (tau - n_0)(tau - n_1) + ...` with the nodes `n_i` and divided differences `c_i`.

    `tau` is the time since the start of the step, in s. Calling the polynomial evaluates it.
    """

    __slots__ = ("_differences", "_newton", "_nodes")

    def __init__(self, nodes: Sequence[float], differences: Sequence[float]) -> None:
        self._nodes = nodes
        self._differences = differences
        # Horner's scheme begins with the highest difference; the last node is that of no factor.
        self._newton = [*zip(differences[-2::-1], nodes[-2::-1], strict=True)]

    @classmethod
    def constant(cls, value: float) -> Polynomial:
        """The constant `value`."""
        return cls((0.0,), (value,))

    @classmethod
    def through(cls, nodes: MutableSequence[float], values: MutableSequence[float]) -> Polynomial:
        """The polynomial of degree `len(nodes) - 1` through the points `(nodes[i], values[i])`.

        Raises `ValueError` if the points do not define one.
        """
        nodes, differences = nodes[:], values[:]
        last = len(nodes) - 1
        # A sum is finite only if all its terms are; checked one by one where it is not.
        if not (0 <= last < MAX_NODES and len(differences) == last + 1 and math.isfinite(sum(nodes) + sum(differences))):
            _check(nodes, differences)
        try:
            for order in range(1, last + 1):
                for i in range(last, order - 1, -1):
                    differences[i] = (differences[i] - differences[i - 1]) / (nodes[i] - nodes[i - order])
        except ZeroDivisionError:
            first, second = next((i, k) for k in range(last + 1) for i in range(k) if nodes[i] == nodes[k])
            raise ValueError(f"nodes {first} and {second} coincide") from None
        return cls(nodes, differences)

    @property
    def degree(self) -> int:
        """Highest power that may occur."""
        return len(self._nodes) - 1

    def __call__(self, tau: float) -> float:
        """`p(tau)`."""
        value = self._differences[-1]
        for difference, node in self._newton:
            value = difference + (tau - node) * value
        return value

    def shifted(self, start: float) -> Polynomial:
        """The polynomial `q(tau) = p(start + tau)`: the same, with the time counted from `start` (s) on."""
        return Polynomial([node - start for node in self._nodes], self._differences)

    def powers(self, scale: float) -> list[float]:
        """Coefficients `a_j` of `p(scale s) = a_0 + a_1 s + a_2 s^2 + ...`, `degree + 1` of them.

        With `scale` = the step size the argument `s` runs from 0 to 1, whatever the unit of time.
        """
        powers = [self._differences[-1]]
        for difference, node in self._newton:
            # powers <- difference + (scale s - node) powers
            raised = [0.0, *(scale * power for power in powers)]
            for place, power in enumerate(powers):
                raised[place] -= node * power
            raised[0] += difference
            powers = raised
        return powers


def _check(nodes: Sequence[float], values: Sequence[float]) -> None:
    count = len(nodes)
    if count == 0:
        raise ValueError("a signal needs at least one node")
    if count > MAX_NODES:
        raise ValueError(f"{count} nodes, at most {MAX_NODES} are allowed")
    if len(values) != count:
        raise ValueError(f"{count} nodes but {len(values)} values")
    for place in range(count):
        if not (math.isfinite(nodes[place]) and math.isfinite(values[place])):
            raise ValueError(f"node or value {place} is not a finite number")

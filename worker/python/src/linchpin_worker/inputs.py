"""The inputs of a solver: their values at an instant, and their polynomials over a step."""

from __future__ import annotations

import operator
from collections import namedtuple
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .stepping import equal_parts

if TYPE_CHECKING:
    from .joint_load import JointLoad
    from .polynomial import Polynomial


class Values(tuple[float, ...]):
    """Values of all inputs at an instant, in the order of the description: `u.f`, `u[0]`, or unpacked.

    Names that Python does not allow as attributes, such as "a-b", are reached by their place only.
    """

    __slots__ = ()

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> float:
            """Value of the input `name`."""

    def with_joint_loads(self, poses: Mapping[str, Sequence[float]]) -> Values:
        """The same with the joint loads at this instant added to the load inputs of the markers that take them.

        `poses` has for every marker its position at this instant, in the order of its position outputs. Only models that
        say `joint_loads` are asked for any; where there are none, nothing is added.
        """
        return self

    def plus(self, others: Values) -> Values:
        """The sums with the values of other inputs of the same model, one by one: see `Subsystem.impulse`."""
        return type(self)._make(map(operator.add, self, others))  # type: ignore[attr-defined, no-any-return]


class JoinedValues(Values):
    """Values that know those of the joint inputs, which stand behind those of the inputs in `signals`."""

    signals: Sequence[float]
    joint_loads: Sequence[JointLoad]

    def with_joint_loads(self, poses: Mapping[str, Sequence[float]]) -> Values:
        """See `Values.with_joint_loads`."""
        loaded = list(self)
        for joint_load in self.joint_loads:
            joint_load.add(poses, self.signals, loaded)
        made = type(self)._make(loaded)  # type: ignore[attr-defined]
        made.signals = self.signals
        return made  # type: ignore[no-any-return]

    def plus(self, others: Values) -> Values:
        """See `Values.plus`; joint inputs are added as well."""
        made = type(self)._make(map(operator.add, self, others))  # type: ignore[attr-defined]
        signals: Any = others.signals
        made.signals = [*map(operator.add, self.signals, signals)]
        return made  # type: ignore[no-any-return]


def values_type(
    names: Sequence[str], joint_inputs: int, joint_loads: Sequence[JointLoad]
) -> Callable[[Sequence[float]], Values]:
    """A function that makes the values of inputs `names` of a list in which those of the joint inputs follow."""
    named = namedtuple("Inputs", names, rename=True)  # type: ignore[misc]
    if joint_inputs == 0:
        return type("Inputs", (Values, named), {"__slots__": ()})._make  # type: ignore[attr-defined, no-any-return]
    joined: Any = type("Inputs", (JoinedValues, named), {"joint_loads": joint_loads})

    def make(signals: Sequence[float]) -> Values:
        made = joined._make(signals[: len(names)])
        made.signals = signals
        return made  # type: ignore[no-any-return]

    return make


class Inputs:
    """All inputs over one step: `u(tau)` has their values `tau` seconds after its start."""

    __slots__ = ("_make", "_names", "_polynomials", "_step")

    def __init__(
        self, polynomials: Sequence[Polynomial], step: float, make: Callable[[Sequence[float]], Values], names: Sequence[str]
    ) -> None:
        self._polynomials = polynomials
        self._step = step
        self._make = make
        self._names = names

    def __call__(self, tau: float) -> Values:
        """Values of all inputs `tau` seconds after the start of the step."""
        return self._make([polynomial(tau) for polynomial in self._polynomials])

    @property
    def step(self) -> float:
        """Length of the step in s."""
        return self._step

    @property
    def at_start(self) -> Values:
        """Values at the start of the step."""
        return self(0.0)

    @property
    def at_end(self) -> Values:
        """Values at the end of the step."""
        return self(self._step)

    def polynomial(self, name: str) -> Polynomial:
        """The input `name` as a polynomial of the time since the start of the step."""
        if name not in self._names:
            raise KeyError(f'no input "{name}"; there are: {", ".join(self._names) or "none"}')
        return self._polynomials[self._names.index(name)]

    def stages(self, dt: float, nodes: Sequence[float] = (0.0, 0.5, 1.0)) -> Iterator[tuple[float, float, list[Values]]]:
        """The internal steps of a solver with fixed steps of at most `dt` (s), with the inputs at its stages.

        For each of the equal parts of the step: its start (s after that of the step), its length (s), and the inputs at
        `nodes`, shares of the internal step from 0 to 1. The default serves the classical Runge-Kutta method of order 4.
        """
        for tau, h in equal_parts(self._step, dt):
            yield tau, h, [self(tau + node * h) for node in nodes]

    def starting_at(self, start: float, step: float) -> Inputs:
        """The same inputs with the time counted from `start` (s) on, over a step of length `step` (s)."""
        polynomials = [polynomial.shifted(start) for polynomial in self._polynomials]
        return Inputs(polynomials, step, self._make, self._names)

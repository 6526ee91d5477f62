"""The inputs of a solver: their values at an instant, and their polynomials over a step."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

from .stepping import equal_parts

if TYPE_CHECKING:
    from .joint_load import JointLoad
    from .polynomial import Polynomial


class Values(Protocol):
    """Values of all inputs at an instant, in the order of the description: `u.f`, `u[0]`, or unpacked.

    Names that Python does not allow as attributes, such as "a-b", are reached by their place only.
    """

    def __getitem__(self, place: int) -> float:
        """Value of the input number `place`."""
        ...

    def __len__(self) -> int:
        """Number of inputs."""
        ...

    def __iter__(self) -> Iterator[float]:
        """The values in their order."""
        ...

    def __getattr__(self, name: str) -> float:
        """Value of the input `name`."""
        ...

    def with_joint_loads(self, poses: Mapping[str, Sequence[float]]) -> Values:
        """The same with the joint loads at this instant added to the load inputs of the markers that take them.

        `poses` has for every marker its position at this instant, in the order of its position outputs. Only models that
        say `joint_loads` are asked for any; where there are none, nothing is added.
        """
        ...


class _Plain:
    __slots__ = ()

    def with_joint_loads(self, poses: Mapping[str, Sequence[float]]) -> _Plain:
        return self


class _Joined:
    """Values that know those of the joint inputs, which stand behind the inputs in `signals`."""

    signals: Sequence[float]
    joint_loads: Sequence[JointLoad]

    def with_joint_loads(self, poses: Mapping[str, Sequence[float]]) -> Any:
        loaded = list(self)  # type: ignore[call-overload]
        for joint_load in self.joint_loads:
            joint_load.add(poses, self.signals, loaded)
        return type(self)._of(loaded, self.signals)  # type: ignore[attr-defined]


def values_type(names: Sequence[str], joint_inputs: int, joint_loads: Sequence[JointLoad]) -> Any:
    """A function that makes the values of inputs `names` of a list in which those of the joint inputs follow."""
    plain = namedtuple("Inputs", names, rename=True)  # type: ignore[misc]
    if joint_inputs == 0:
        return type("Inputs", (_Plain, plain), {"__slots__": ()})._make  # type: ignore[attr-defined]
    count = len(names)
    joined = type("Inputs", (_Joined, plain), {"joint_loads": joint_loads})

    def of(values: Sequence[float], signals: Sequence[float]) -> Any:
        made = joined._make(values)  # type: ignore[attr-defined]
        made.signals = signals
        return made

    joined._of = staticmethod(of)  # type: ignore[attr-defined]
    return lambda signals: of(signals[:count], signals)


class Inputs:
    """All inputs over one step: `u(tau)` has their values `tau` seconds after its start."""

    __slots__ = ("_make", "_names", "_polynomials", "_step")

    def __init__(self, polynomials: Sequence[Polynomial], step: float, make: Any, names: Sequence[str]) -> None:
        self._polynomials = polynomials
        self._step = step
        self._make = make
        self._names = names

    def __call__(self, tau: float) -> Values:
        """Values of all inputs `tau` seconds after the start of the step."""
        return self._make([polynomial(tau) for polynomial in self._polynomials])  # type: ignore[no-any-return]

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

"""The signals of requests as the inputs of a subsystem."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ._contract import worker_pb2 as pb
from .description import Description
from .failures import misuse
from .inputs import Inputs, Values, values_type
from .joint_load import JointLoad
from .polynomial import Polynomial
from .variable import Variable

ZERO = Polynomial.constant(0.0)


@dataclass(frozen=True)
class Driven:
    """An input that a master drives: its place among all inputs of the subsystem, and what it is without a signal."""

    input: int
    name: str
    default: Polynomial | None


class Signals:
    """The driven inputs of an instance, the defaults of the others, and the inputs of joint loads."""

    def __init__(self, description: Description, request: pb.InitializeRequest) -> None:
        """Refuses names that are unknown or listed twice, and inputs without a value."""
        known = description.inputs
        self._max_degree = description.max_input_degree
        places = find(known, request.inputs, "inputs")
        driven_places = set(places)
        for place, variable in enumerate(known):
            if variable.default is None and place not in driven_places:
                raise misuse("inputs", f'input "{variable.name}" has no default and must be driven')
        _refuse_twice("inputs", request.inputs)
        _refuse_twice("joint_inputs", request.joint_inputs)
        self._names = [variable.name for variable in known]
        self._joint_inputs = len(request.joint_inputs)
        defaults = [None if own.default is None else Polynomial.constant(own.default) for own in known]
        driven = [Driven(place, known[place].name, defaults[place]) for place in places]
        behind = range(len(known), len(known) + self._joint_inputs)
        driven += [Driven(place, name, None) for place, name in zip(behind, request.joint_inputs, strict=True)]
        self._driven = driven
        self._polynomials = [ZERO if own is None else own for own in defaults] + [ZERO] * self._joint_inputs
        self._make = values_type(self._names, self._joint_inputs, ())

    def take_joint_loads(self, joint_loads: Sequence[JointLoad]) -> None:
        """Lets the values of inputs know the joint loads of the instance."""
        self._make = values_type(self._names, self._joint_inputs, joint_loads)

    def __len__(self) -> int:
        """Number of inputs that have signals."""
        return len(self._driven)

    def input(self, signal: int) -> int | None:
        """Place of signal number `signal` among the inputs of the subsystem."""
        return self._driven[signal].input if signal < len(self._driven) else None

    def set(self, signals: Iterable[pb.Signal]) -> None:
        """Takes the signals of a request; inputs without one go back to their defaults."""
        given: set[int] = set()
        for signal in signals:
            driven = self._named(signal, "signals")
            if driven.input in given:
                raise misuse("signals", f'input "{driven.name}" has two signals')
            given.add(driven.input)
            self._polynomials[driven.input] = self._polynomial(signal, driven, "signals")
        if len(given) == len(self._driven):
            return
        for driven in self._driven:
            if driven.input not in given:
                if driven.default is None:
                    raise misuse("signals", f'input "{driven.name}" has neither a signal nor a default')
                self._polynomials[driven.input] = driven.default

    def impulses(self, loads: Sequence[float]) -> Values:
        """Impulses `loads`, one for each signal, as values of the inputs; 0 for those that are not driven."""
        values = [0.0] * len(self._polynomials)
        for driven, load in zip(self._driven, loads, strict=True):
            values[driven.input] = load
        return self._make(values)

    def inputs(self, step: float) -> Inputs:
        """The present inputs over a step of length `step` (s)."""
        return Inputs(list(self._polynomials), step, self._make, self._names)

    def replaced(self, signal: pb.Signal, step: float) -> Inputs:
        """The present inputs with one replaced, over a step of length `step` (s)."""
        driven = self._named(signal, "signals")
        return self._with(self._polynomials, driven, self._polynomial(signal, driven, "signals"), step)

    def direction(self, signal: pb.Signal, step: float) -> Inputs:
        """The direction in which one input changes, over a step of length `step` (s); all others stay."""
        driven = self._named(signal, "directions")
        zeros = [ZERO] * len(self._polynomials)
        return self._with(zeros, driven, self._polynomial(signal, driven, "directions"), step)

    def _with(self, polynomials: Sequence[Polynomial], driven: Driven, polynomial: Polynomial, step: float) -> Inputs:
        changed = list(polynomials)
        changed[driven.input] = polynomial
        return Inputs(changed, step, self._make, self._names)

    def _named(self, signal: pb.Signal, field: str) -> Driven:
        place = signal.input
        if place < len(self._driven):
            return self._driven[place]
        count = len(self._driven)
        raise misuse(field, f"a signal names input {place}, but Initialize listed {count} inputs (counted from 0)")

    def _polynomial(self, signal: pb.Signal, driven: Driven, field: str) -> Polynomial:
        try:
            polynomial = Polynomial.through(signal.nodes, signal.values)
        except ValueError as error:
            raise misuse(field, f'the signal of input {signal.input} ("{driven.name}"): {error}') from error
        if polynomial.degree > self._max_degree:
            place = f'the signal of input {signal.input} ("{driven.name}") has the degree {polynomial.degree}'
            raise misuse(field, f"{place}; this model takes {self._max_degree} at most, as its capabilities say")
        return polynomial


def find(known: Sequence[Variable], names: Sequence[str], field: str) -> list[int]:
    """Places of `names` among the variables of a model; `field` is where the names stand in the request."""
    places = {variable.name: place for place, variable in enumerate(known)}
    for name in names:
        if name not in places:
            raise misuse(field, f'no variable "{name}" among the model\'s: {", ".join(places) or "none"}')
    return [places[name] for name in names]


def _refuse_twice(field: str, names: Sequence[str]) -> None:
    listed: set[str] = set()
    for name in names:
        if name in listed:
            raise misuse(field, f'input "{name}" is listed twice')
        listed.add(name)

"""Parameters of a model and options of its solvers: what may be given, and what a scene gives."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from . import readable
from ._contract import worker_pb2 as pb
from .failures import Refused

WORDS = {float: "a number", str: "a text", bool: "true or false", list: "a list of numbers"}
KINDS = {"number": float, "text": str, "flag": bool, "numbers": list}


@dataclass(frozen=True)
class Parameter:
    """A parameter of a model or an option of a solver, with its SI unit.

    Without a `default` the scene must give it; only numbers can have one. `kind` is float, str, bool or list (of numbers).
    The limits are for numbers: `above` and `below` are not allowed themselves, `least` and `most` are.
    """

    name: str
    unit: str = "1"
    default: float | None = None
    description: str = ""
    kind: type = float
    above: float = -math.inf
    least: float = -math.inf
    below: float = math.inf
    most: float = math.inf

    def __post_init__(self) -> None:
        """Refuses a parameter that contradicts itself."""
        if self.kind not in WORDS:
            raise ValueError(f'the parameter "{self.name}" has the kind {self.kind}; it may be float, str, bool or list')
        if self.default is not None and self.kind is not float:
            raise ValueError(f'the parameter "{self.name}" is {WORDS[self.kind]}; only numbers can have a default')

    def message(self) -> pb.Parameter:
        """The parameter as the contract tells it."""
        text = "; ".join(part for part in (self.description, self._limits()) if part)
        return pb.Parameter(name=self.name, unit=self.unit, description=text, default=self.default)

    def read(self, field: str, value: pb.Value) -> object:
        """The value that a scene gives at the place `field`: float, str, bool or a list of floats."""
        case = value.WhichOneof("kind")
        if case is None or KINDS[case] is not self.kind:
            raise Refused(field, f"must be {WORDS[self.kind]}", between=" ")
        if case == "numbers":
            return [finite(f"{field}[{place}]", number) for place, number in enumerate(value.numbers.values)]
        if case != "number":
            return getattr(value, case)
        number = finite(field, value.number)
        if not (self.above < number < self.below and self.least <= number <= self.most):
            raise out_of_range(field, number, self._limits())
        return number

    def _limits(self) -> str:
        limits = (
            ("greater than", self.above),
            ("at least", self.least),
            ("less than", self.below),
            ("at most", self.most),
        )
        return " and ".join(f"{words} {readable.number(limit)}" for words, limit in limits if math.isfinite(limit))


@dataclass(frozen=True)
class Solver:
    """One of the solvers that a model offers, with its options. The first one of a model is its default."""

    name: str
    description: str = ""
    options: Sequence[Parameter] = ()

    def message(self) -> pb.SolverKind:
        """The solver as the contract tells it."""
        options = [option.message() for option in self.options]
        return pb.SolverKind(name=self.name, description=self.description, options=options)


def finite(field: str, value: float) -> float:
    """The value of a field, if it is finite."""
    if not math.isfinite(value):
        raise out_of_range(field, value, "a finite number")
    return value


def out_of_range(field: str, value: float, allowed: str) -> Refused:
    """The refusal of a number."""
    return Refused(field, f"{readable.number(value)} is out of range: it must be {allowed}", between=" = ")


def complete(table: str, given: Mapping[str, pb.Value], known: Sequence[Parameter]) -> dict[str, object]:
    """The values of a table of the scene with the defaults of what it leaves out, by name."""
    names = [parameter.name for parameter in known]
    for name in given:
        if name not in names:
            known_names = ", ".join(names) or "none"
            raise Refused(f"{table}.{name}", f"is unknown to this model; known: {known_names}", between=" ")
    values: dict[str, object] = {}
    for parameter in known:
        field = f"{table}.{parameter.name}"
        if parameter.name in given:
            values[parameter.name] = parameter.read(field, given[parameter.name])
        elif parameter.default is not None:
            values[parameter.name] = float(parameter.default)
        else:
            raise Refused(field, f"is missing; the model needs {WORDS[parameter.kind]}", between=" ")
    return values

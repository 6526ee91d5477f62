"""Steps of requests: their intervals, and what lies inside them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ._contract import worker_pb2 as pb
from .failures import misuse
from .readable import number

MAX_INTEGRALS = 8
"""The most integrals of each output that the contract knows."""


class Interval(NamedTuple):
    """From `start` (s) over `length` (s); an evaluation has the length 0."""

    start: float
    length: float

    @property
    def end(self) -> float:
        """Time at which it ends (s)."""
        return self.start + self.length


class Part(NamedTuple):
    """A part of a step that is cut, from one instant to the next: times in s after the start of the step."""

    start: float
    end: float
    is_last: bool


def interval_of_step(start: float, length: float) -> Interval:
    """The interval of a step."""
    if math.isfinite(start) and math.isfinite(length) and length > 0.0:
        return Interval(start, length)
    text = f"a step from t = {number(start)} s over {number(length)} s: both must be finite, the length greater than 0"
    raise misuse("step", text)


def interval_of_look(look: pb.Predict) -> Interval:
    """The interval of a prediction, which may have the length 0."""
    if look.step == 0.0 and math.isfinite(look.t):
        return Interval(look.t, 0.0)
    return interval_of_step(look.t, look.step)


def interval_of_evaluation(evaluate: pb.Predict) -> Interval:
    """The interval of an evaluation beside a prediction: its length is 0."""
    if math.isfinite(evaluate.t) and evaluate.step == 0.0:
        return Interval(evaluate.t, 0.0)
    place = f"an evaluation at t = {number(evaluate.t)} s over {number(evaluate.step)} s"
    raise misuse("evaluate.step", f"{place}: t must be finite, the length 0; a step is a prediction")


def parts(length: float, instants: Sequence[float]) -> Iterator[Part]:
    """The parts of a step that is cut at `instants`."""
    start = 0.0
    for instant in instants:
        yield Part(start, instant, False)
        start = instant
    yield Part(start, length, True)


def check_inside(field: str, what: str, offsets: Sequence[float], step: float) -> None:
    """Samples and instants are ascending and inside the step."""
    earliest = 0.0
    for place, offset in enumerate(offsets):
        if not earliest < offset < step:
            allowed = f"it must be after {number(earliest)} s and before the end of the step at {number(step)} s"
            raise misuse(field, f"{what} {place} is {number(offset)} s after the start of the step; {allowed}")
        earliest = offset


def check_integrals(integrals: int) -> None:
    """No more integrals of each output are asked for than the contract knows."""
    if integrals > MAX_INTEGRALS:
        text = f"{integrals} integrals of each output are asked for; there are weights for {MAX_INTEGRALS} at most"
        raise misuse("integrals", text)

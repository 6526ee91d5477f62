"""Steps of requests: their intervals, and what lies inside them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ._contract import worker_pb2 as pb
from .failures import misuse
from .readable import number

ROUNDING = 1e-9
"""Share of a step that a strike at its end may be behind it."""

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


class Strike(NamedTuple):
    """Impulses of loads within a step, one for each signal, `at` s after its start; empty without any."""

    at: float
    impulses: Sequence[float]

    def is_until(self, length: float) -> bool:
        """Whether it happens within this time (s). Where that ends at the strike but for rounding, the strike belongs to it."""
        return self.at <= length * (1.0 + ROUNDING)


class Part(NamedTuple):
    """A part of a step that is cut: times in s after the start of the step. An instant or a strike ends it, or the step."""

    start: float
    end: float
    is_last: bool
    strike: Strike | None = None


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


def parts(length: float, instants: Sequence[float], strikes: Sequence[Strike]) -> Iterator[Part]:
    """The parts of a step that is cut at `instants` and `strikes`. Where both are at one time, the instant is first."""
    inside = [strike for strike in strikes if strike.is_until(length)]
    cuts: list[tuple[float, Strike | None]] = [(instant, None) for instant in instants]
    cuts += [(min(strike.at, length), strike) for strike in inside]
    start = 0.0
    for end, strike in sorted(cuts, key=lambda cut: cut[0]):
        yield Part(start, end, False, strike)
        start = end
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

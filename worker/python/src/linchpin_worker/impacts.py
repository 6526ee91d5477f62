"""Impacts of a request: impulses of loads for models that take them; none of this package finds any."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ._contract import worker_pb2 as pb
from .description import Description
from .failures import misuse
from .interval import Strike
from .readable import number


class GivenImpacts:
    """The impacts that a request brings for a step of its length, not yet checked."""

    def __init__(self, step: float, impacts: pb.Impacts | None) -> None:
        self._step = step
        self._impacts = impacts

    def strikes(self, description: Description, signals: int) -> Sequence[Strike]:
        """The impulses of loads in their order; misuse if the model takes none, or if they contradict the step."""
        if self._impacts is None:
            return ()
        self._check(self._impacts.impacts, signals)
        if not description.impulses:
            raise misuse("impacts", "this model takes no impulses of loads: its capabilities do not say impulses")
        return [Strike(impact.at, impact.loads) for impact in self._impacts.impacts]

    def _check(self, impacts: Sequence[pb.Impact], signals: int) -> None:
        """Ascending instants of the step, its ends included, with an impulse for each signal or for none."""
        earliest = 0.0
        for place, impact in enumerate(impacts):
            if not earliest <= impact.at <= self._step:
                allowed = f"from {number(earliest)} s on and to the end of the step at {number(self._step)} s"
                text = f"impact {place} is {number(impact.at)} s after the start of the step; it must be {allowed}"
                raise misuse("impacts", text)
            earliest = impact.at
            if len(impact.loads) not in (0, signals):
                needed = f"it must have one for each of the {signals} signals, or none"
                raise misuse("impacts", f"impact {place} has {len(impact.loads)} loads; {needed}")
            for load in impact.loads:
                if not math.isfinite(load):
                    raise misuse("impacts", f"impact {place} has the impulse {number(load)}; it must be finite")


NONE = GivenImpacts(0.0, None)


def impacts_of(request: pb.StepRequest | pb.PerturbedStepRequest | pb.Advance | pb.Predict) -> GivenImpacts:
    """The impacts of a step. An interface is refused: left out silently, the velocities behind impacts would be wrong."""
    if not isinstance(request, pb.Advance) and request.HasField("interface"):
        raise misuse("interface", "this model finds no impacts: its capabilities do not say impacts")
    if request.HasField("impacts"):
        return GivenImpacts(request.step, request.impacts)
    return NONE

"""Impacts, which models of this package neither find nor take."""

from __future__ import annotations

from ._contract import worker_pb2 as pb
from .failures import misuse


def refuse_impacts(request: pb.StepRequest | pb.PerturbedStepRequest | pb.Advance | pb.Predict) -> None:
    """Refuses a step with impacts: left out silently, the velocities behind them would be wrong."""
    if not isinstance(request, pb.Advance) and request.HasField("interface"):
        raise misuse("interface", "this model finds no impacts: its capabilities do not say impacts")
    if request.HasField("impacts"):
        raise misuse("impacts", "this model takes no impulses of loads: its capabilities do not say impulses")

"""One instance: a subsystem with its place in the sequence of calls."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter_ns
from typing import Any, TypeVar

from ._contract import worker_pb2 as pb
from .cancel import is_cancelled
from .description import Description
from .exchange import exchange
from .exported import opened, sealed
from .failures import CallFailed, fatal, misuse
from .impacts import impacts_of
from .interval import interval_of_step
from .motion import Base, Motion
from .signals import Signals
from .state import Snapshots
from .subsystem import Subsystem

NUMBERS = 1 << 64
"""Sequence numbers begin again behind this one."""

Reply = TypeVar("Reply")


class Meter:
    """Counts what one call costs."""

    def __init__(self, motion: Motion) -> None:
        self._solver = motion.solver
        self._before = self._counts()

    def work(self) -> pb.Work:
        """What was done since the start of the call."""
        after = self._counts()
        integrations, steps, derivatives, nanoseconds = (a - b for a, b in zip(after, self._before, strict=True))
        return pb.Work(integrations=integrations, steps=steps, derivatives=derivatives, nanoseconds=nanoseconds)

    def _counts(self) -> tuple[int, int, int, int]:
        solver = self._solver
        return solver.integrations, solver.internal_steps, solver.derivatives, perf_counter_ns()


class Instance:
    """A subsystem that is being driven by a master.

    It has one state: that of the start, of the last Step, Restore or ImportState, or of the last advance of an exchange, which
    can be taken back. A call that fails leaves it as it was.
    """

    def __init__(
        self,
        subsystem: Subsystem,
        signals: Signals,
        description: Description,
        request: pb.InitializeRequest,
        most_snapshots: int,
    ) -> None:
        self._motion = Motion(subsystem, signals, description, request)
        self._snapshots = Snapshots(most_snapshots)
        self._description = description
        if description.exportable_snapshot:
            # A state that cannot leave is a mistake of the model: better told now than where it is needed.
            self._motion.export()
        self.tolerance = subsystem.tolerance
        self._sequence = request.sequence
        # The last request with a sequence number, the name of its call, and the answer: given again when it is repeated.
        self._asked: Any = request
        self._call = "Initialize"
        self._answer: Any = None

    @property
    def is_new(self) -> bool:
        """Whether no call that has a sequence number came after Initialize."""
        return self._call == "Initialize"

    def snapshot(self, request: pb.SnapshotRequest) -> pb.SnapshotReply:
        """Keeps the present state."""

        def keep() -> pb.SnapshotReply:
            replaces = request.replaces if request.HasField("replaces") else None
            return pb.SnapshotReply(snapshot=self._snapshots.keep(self._motion.committed, replaces))

        return self._once("Snapshot", request, keep)

    def restore(self, request: pb.RestoreRequest) -> pb.RestoreReply:
        """Goes back to a kept state."""

        def go_back() -> pb.RestoreReply:
            self._motion.restore(self._snapshots.find(request.snapshot))
            return pb.RestoreReply()

        return self._once("Restore", request, go_back)

    def export_state(self) -> pb.ExportStateReply:
        """The committed state as bytes; it has no sequence number."""
        self._check_exports()
        return pb.ExportStateReply(state=sealed(self._description.name, self._motion.export()))

    def import_state(self, request: pb.ImportStateRequest) -> pb.ImportStateReply:
        """Goes to a state that another instance has exported."""

        def take() -> pb.ImportStateReply:
            self._check_exports()
            self._motion.take_exported(opened(self._description.name, request))
            return pb.ImportStateReply()

        return self._once("ImportState", request, take)

    def step(self, request: pb.StepRequest) -> pb.StepReply:
        """Integrates over one macro step and commits."""

        def step() -> pb.StepReply:
            meter = Meter(self._motion)
            interval = interval_of_step(request.t, request.step)
            self._motion.take(request.signals, request.integrals, impacts_of(request))
            values = self._motion.advance(interval, request.instants, request.outputs)
            self._motion.commit()
            return pb.StepReply(outputs=pb.Outputs(values=values), work=meter.work())

        return self._once("Step", request, step)

    def perturbed_step(self, request: pb.PerturbedStepRequest) -> pb.PerturbedStepReply:
        """Integrates once for every perturbed signal and direction; the state stays."""

        def step() -> pb.PerturbedStepReply:
            meter, motion = Meter(self._motion), self._motion
            interval = interval_of_step(request.t, request.step)
            motion.take(request.signals, request.integrals, impacts_of(request))
            outputs = motion.look_ahead_perturbed(Base.COMMITTED, interval, request.instants, request.perturbed)
            derivatives = motion.look_in_directions(Base.COMMITTED, interval, request.instants, request.directions)
            return pb.PerturbedStepReply(outputs=outputs, derivatives=derivatives, work=meter.work())

        return self._once("PerturbedStep", request, step)

    def exchange(self, request: pb.ExchangeRequest) -> pb.ExchangeReply:
        """Goes on with the corrected inputs and commits, then looks ahead from there."""

        def turn() -> pb.ExchangeReply:
            meter = Meter(self._motion)
            reply = exchange(self._motion, request)
            reply.work.CopyFrom(meter.work())
            return reply

        return self._once("Exchange", request, turn)

    def evaluate(self, request: pb.EvaluateRequest) -> pb.EvaluateReply:
        """Outputs of the present state; it has no sequence number."""
        return self._motion.evaluate(request)

    def _check_exports(self) -> None:
        if not self._description.exportable_snapshot:
            text = f'the states of model "{self._description.name}" cannot leave their process'
            raise misuse("state", f"{text}: its capabilities do not say exportable_snapshot")

    def _once(self, call: str, request: Any, act: Callable[[], Reply]) -> Reply:
        """The answer to a call with a sequence number: a repeated number gets the first answer again."""
        following = (self._sequence + 1) % NUMBERS
        if request.sequence == self._sequence:
            self._check_repeated(call, request)
        elif request.sequence == following:
            before = self._sequence, self._asked, self._call, self._answer
            self._sequence, self._asked, self._call = following, request, call
            self._answer = fatal(f"{call} number {following} did not come to an end")
            try:
                self._answer = act()
            except CallFailed as failed:
                self._answer = failed
                if is_cancelled():
                    # The same request may come again.
                    self._sequence, self._asked, self._call, self._answer = before
                    raise
        else:
            came = f"sequence number {request.sequence} came after {self._sequence}"
            raise misuse("sequence", f"{came}; the next one is {following}")
        if isinstance(self._answer, CallFailed):
            raise CallFailed(self._answer.failure)
        return self._answer  # type: ignore[no-any-return]

    def _check_repeated(self, call: str, request: Any) -> None:
        if call != self._call:
            text = f"{call} has the sequence number of the {self._call} before it; add 1 to it"
            raise misuse("sequence", text)
        # As bytes: a number that is none is equal to itself there.
        if request.SerializeToString(deterministic=True) != self._asked.SerializeToString(deterministic=True):
            came = f"sequence number {self._sequence} came before, for a {call} with another content"
            rule = "only the same request gets its answer again, another one takes the next number"
            raise misuse("sequence", f"{came}; {rule}")

"""The contract around models: one worker with its instances."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from ._contract import worker_pb2 as pb
from .description import Description, DescriptionError
from .failures import CallFailed, Denied, NoInstance, Refused, fatal, misuse
from .hold import Hold
from .instance import Instance
from .joint_load_request import joint_loads_of
from .parameter import KINDS
from .setup import setup_of
from .signals import Signals
from .slot import Slot
from .solver import guarded
from .subsystem import Subsystem, check_model
from .version import PROGRAM, own_version

Made = TypeVar("Made")
Reply = TypeVar("Reply", pb.SnapshotReply, pb.RestoreReply, pb.ImportStateReply, pb.StepReply, pb.PerturbedStepReply)

PROTOCOL = pb.ProtocolVersion(major=1, minor=4)


@dataclass(frozen=True)
class Limits:
    """What a worker allows its masters."""

    instances: int = 256
    """Most instances at a time."""
    snapshots: int = 16
    """Most kept snapshots of an instance."""
    idle: float = 900.0
    """s: an instance that was not called for this long gives way when the worker is full."""
    lease: float = 2.0
    """s: an instance whose stream or connections have ended waits this long for another call."""
    message: int = 16 << 20
    """Largest message, in bytes, that is accepted or sent."""


class Host:
    """A worker: its models and the instances that masters made of them. The calls may come from any thread."""

    def __init__(self, *models: type[Subsystem], limits: Limits | None = None) -> None:
        if not models:
            raise DescriptionError("a worker needs at least one model")
        self._models: dict[str, type[Subsystem]] = {}
        for model in models:
            name = check_model(model).name
            if name in self._models:
                raise DescriptionError(f'two models have the name "{name}"')
            self._models[name] = model
        self._limits = limits or Limits()
        self._slots: dict[int, Slot] = {}
        self._lock = threading.Lock()

    @property
    def limits(self) -> Limits:
        """What it allows its masters."""
        return self._limits

    def describe(self, request: pb.DescribeRequest) -> pb.DescribeReply:
        """What the worker can simulate: the model that is named, with its parameters, or all."""
        if request.HasField("model"):
            descriptions = [self._described(request.model, request.parameters)]
        else:
            descriptions = [model.description for model in self._models.values()]
        models = [description.message() for description in descriptions]
        return pb.DescribeReply(protocol=PROTOCOL, worker=PROGRAM, worker_version=own_version(), models=models)

    def initialize(self, request: pb.InitializeRequest, owner: bytes | None = None) -> pb.InitializeReply:
        """Makes an instance, which belongs to a certificate if one was shown."""
        slot = self._slots.get(request.instance)
        if slot is None:
            slot = self._place(request, self._build(request), owner)
        self.check_owner(request.instance, owner)
        reply = slot.initialized(request)
        reply.instance, reply.sequence = request.instance, request.sequence
        return reply

    def snapshot(self, request: pb.SnapshotRequest) -> pb.SnapshotReply:
        """Keeps the present state."""
        return labelled(self._slot(request).call(lambda instance: instance.snapshot(request)), request)

    def restore(self, request: pb.RestoreRequest) -> pb.RestoreReply:
        """Goes back to a kept state."""
        return labelled(self._slot(request).call(lambda instance: instance.restore(request)), request)

    def export_state(self, request: pb.ExportStateRequest) -> pb.ExportStateReply:
        """The committed state as bytes."""
        reply = self._slot(request).call(lambda instance: instance.export_state())
        reply.instance = request.instance
        return reply

    def import_state(self, request: pb.ImportStateRequest) -> pb.ImportStateReply:
        """Goes to a state that another instance has exported."""
        return labelled(self._slot(request).call(lambda instance: instance.import_state(request)), request)

    def step(self, request: pb.StepRequest) -> pb.StepReply:
        """Integrates over one macro step."""
        return labelled(self._slot(request).call(lambda instance: instance.step(request)), request)

    def perturbed_step(self, request: pb.PerturbedStepRequest) -> pb.PerturbedStepReply:
        """Integrates once for every perturbed signal; the state stays."""
        return labelled(self._slot(request).call(lambda instance: instance.perturbed_step(request)), request)

    def exchange(self, request: pb.ExchangeRequest) -> pb.ExchangeReply:
        """The fused macro step."""
        return self._slot(request).call(lambda instance: instance.exchange(request))

    def evaluate(self, request: pb.EvaluateRequest) -> pb.EvaluateReply:
        """Outputs of the present state."""
        reply = self._slot(request).call(lambda instance: instance.evaluate(request))
        reply.instance = request.instance
        return reply

    def terminate(self, request: pb.TerminateRequest) -> pb.TerminateReply:
        """Ends an instance, if it is there."""
        with self._lock:
            slot = self._slots.pop(request.instance, None)
        if slot is not None:
            slot.end()
        return pb.TerminateReply(instance=request.instance)

    def list_instances(self, request: pb.ListInstancesRequest, owner: bytes | None = None) -> pb.ListInstancesReply:
        """The instances that live here and are the caller's."""
        self.tidy()
        with self._lock:
            slots = [slot for slot in self._slots.values() if slot.belongs_to(owner)]
        return pb.ListInstancesReply(instances=[slot.state() for slot in slots])

    def check_owner(self, instance: int, caller: bytes | None) -> None:
        """Refuses an instance of another certificate."""
        slot = self._slots.get(instance)
        if slot is not None and not slot.belongs_to(caller):
            raise Denied(instance)

    def hold(self, instance: int, by: Hold) -> None:
        """Says what holds an instance from now on."""
        slot = self._slots.get(instance)
        if slot is not None:
            slot.hold(by)

    def tidy(self) -> None:
        """Ends the instances whose lease is over."""
        with self._lock:
            for number in [number for number, slot in self._slots.items() if slot.is_over()]:
                del self._slots[number]

    def _slot(self, request: Any) -> Slot:
        slot = self._slots.get(request.instance)
        if slot is None:
            raise NoInstance(request.instance)
        return slot

    def _described(self, name: str, parameters: Mapping[str, pb.Value]) -> Description:
        model = self._models.get(name)
        if model is None:
            raise misuse("model", f'this worker has no model "{name}"; it has: {", ".join(self._models)}')
        if model.described.__func__ is Subsystem.described.__func__:  # type: ignore[attr-defined]
            return model.description
        defaults = {own.name: own.default for own in model.description.parameters if own.default is not None}
        given = {name: plain(value) for name, value in parameters.items()}
        return built(lambda: model.described({**defaults, **given}))

    def _build(self, request: pb.InitializeRequest) -> Instance:
        theirs = request.protocol
        if theirs.major != PROTOCOL.major:
            own = f"{PROTOCOL.major}.{PROTOCOL.minor}"
            sides = f"this side speaks linchpin {own}, the other side speaks {shown(request)}"
            raise misuse("protocol", f"incompatible protocol: {sides}; use builds with the same major number")
        description = self._described(request.model, request.parameters)
        signals = Signals(description, request)
        signals.take_joint_loads(joint_loads_of(description, request, signals))
        model = self._models[request.model]
        subsystem = built(lambda: model(setup_of(description, request)))
        return Instance(subsystem, signals, description, request, self._limits.snapshots)

    def _place(self, request: pb.InitializeRequest, instance: Instance, owner: bytes | None) -> Slot:
        self.tidy()
        limits = self._limits
        with self._lock:
            if request.instance in self._slots:
                # The same request was repeated while the first one was still being answered.
                return self._slots[request.instance]
            if len(self._slots) >= limits.instances:
                self._slots = {number: own for number, own in self._slots.items() if not own.is_idle(limits.idle)}
            if len(self._slots) >= limits.instances:
                full = f"this worker is full: {len(self._slots)} instances are in use"
                raise fatal(f"{full}; end some with Terminate or start another worker")
            slot = self._slots[request.instance] = Slot(request, instance, limits.lease, owner)
            return slot


def built(make: Callable[[], Made]) -> Made:
    """What the author's code makes of a request; a `Refused` is misuse, anything else ends the run."""

    def refusable() -> Made | CallFailed:
        try:
            return make()
        except Refused as refused:
            return misuse(refused.field, str(refused))

    made = guarded(None, refusable)
    if isinstance(made, CallFailed):
        raise made
    return made


def plain(value: pb.Value) -> object:
    """A value of a scene as Python has it; None if the message has none."""
    case = value.WhichOneof("kind")
    if case is None:
        return None
    return list(value.numbers.values) if KINDS[case] is list else getattr(value, case)


def labelled(reply: Reply, request: Any) -> Reply:
    """The reply with the numbers of its request."""
    reply.instance, reply.sequence = request.instance, request.sequence
    return reply


def shown(request: pb.InitializeRequest) -> str:
    """The version that a master speaks."""
    if not request.HasField("protocol"):
        return "no version at all"
    return f"{request.protocol.major}.{request.protocol.minor}"

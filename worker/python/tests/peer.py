"""A master's side of a worker: raw gRPC calls, and what it says against them."""

import queue
import tempfile
import unittest

import grpc
import models

from linchpin_worker import Address, Host, Limits, Server
from linchpin_worker._contract import wire_pb2
from linchpin_worker._contract import worker_pb2 as pb

PROTOCOL = pb.ProtocolVersion(major=1, minor=4)
FIRST = 41
STEP = 1.7e-3


INSTANTS = (0.13 * STEP, 0.5 * STEP, 0.97 * STEP)


class Refusal(Exception):
    """A status of a worker, or the failure in a reply on a stream."""

    def __init__(self, code, failure):
        super().__init__(f"{code}: {failure}")
        self.code = code
        self.failure = failure


def constant(place, value):
    return through(place, (0.0, value))


def through(place, *points):
    return pb.Signal(input=place, nodes=[node for node, _ in points], values=[value for _, value in points])


# Inflow and leak of a tank over 0.3 s, and what they add to the level.
RAMP = (through(0, (0.3, 1.9), (0.0, 0.7)), constant(1, 0.1))
RISE = (0.5 * (1.9 + 0.7) - 0.1) * 0.3
FLOOD = (constant(0, 100.0), constant(1, 0.0))


def load(end):
    """A force on an oscillator that is not constant over the step, `end` at its end."""
    return [through(0, (STEP, end), (0.0, -17.9), (-STEP, 230.7)), constant(1, 0.01)]


def number(value):
    return pb.Value(number=value)


def tank(**changes):
    fields = {
        "model": "tank",
        "parameters": {"capacity": number(2.5)},
        "inputs": ["inflow", "leak"],
        "coupling_outputs": ["level", "rate"],
    }
    return initialize(**{**fields, **changes})


def oscillator(**changes):
    parameters = {"m": 1.3, "c": 1.7e3, "d": 10.3, "x0": 0.37, "v0": -2.9}
    fields = {
        "model": "oscillator",
        "parameters": {name: number(value) for name, value in parameters.items()},
        "inputs": ["f", "partner_x"],
        "coupling_outputs": ["x", "v"],
        "recorded_outputs": ["a"],
    }
    return initialize(**{**fields, **changes})


def initialize(**fields):
    return pb.InitializeRequest(**{"instance": 5, "sequence": FIRST, "protocol": PROTOCOL, **fields})


class Peer:
    """A worker on a Unix socket in this process, and a connection to it."""

    def __init__(self, test, *, limits=None, classes=()):
        folder = tempfile.TemporaryDirectory()
        test.addCleanup(folder.cleanup)
        self.address = f"unix:{folder.name}/worker"
        self.host = Host(models.Tank, models.Oscillator, models.Stand, *classes, limits=limits or Limits())
        test.enterContext(Server(self.host, Address.of(self.address)))
        self.channel = self.connect()
        test.addCleanup(self.channel.close)

    def connect(self):
        """A connection of its own."""
        return grpc.insecure_channel(self.address, options=[("grpc.use_local_subchannel_pool", 1)])

    def call(self, name, request, channel=None):
        method = pb.DESCRIPTOR.services_by_name["Worker"].methods_by_name[name]
        read = getattr(pb, method.output_type.name).FromString
        call = (channel or self.channel).unary_unary(f"/linchpin.v1.Worker/{name}", type(request).SerializeToString, read)
        try:
            return call(request, timeout=20)
        except grpc.RpcError as error:
            raise refusal(error) from None

    def stream(self, channel=None):
        return Stream(channel or self.channel)


class Stream:
    """An exchange stream."""

    def __init__(self, channel):
        self.requests = queue.SimpleQueue()
        write, read = pb.ExchangeRequest.SerializeToString, pb.ExchangeReply.FromString
        call = channel.stream_stream("/linchpin.v1.Worker/Exchange", write, read)
        self.replies = call(iter(self.requests.get, None))

    def turn(self, request):
        self.requests.put(request)
        try:
            reply = next(self.replies)
        except grpc.RpcError as error:
            raise refusal(error) from None
        if reply.HasField("failure"):
            raise Refusal(None, reply.failure)
        return reply

    def close(self):
        self.requests.put(None)


def refusal(error):
    """What a status says, with its details."""
    details = dict(error.trailing_metadata())["grpc-status-details-bin"]
    status = wire_pb2.Status.FromString(details)
    assert (status.code, status.message) == (error.code().value[0], error.details()), status
    info = wire_pb2.ErrorInfo.FromString(status.details[0].value)
    assert info.domain == "linchpin" and status.details[0].type_url.endswith("/google.rpc.ErrorInfo")
    known = {name: float(text) if name in ("t", "step") else text for name, text in info.metadata.items()}
    return Refusal(error.code(), pb.Failure(severity=info.reason, message=error.details(), **known))


class Driver:
    """One instance as its master drives it: counts its calls."""

    def __init__(self, peer, request, channel=None):
        self.peer, self.channel, self.instance, self.sequence = peer, channel, request.instance, request.sequence
        self.initialized = peer.call("Initialize", request, channel)
        self.stream = None

    def request(self, kind, **fields):
        self.sequence += 1
        return kind(instance=self.instance, sequence=self.sequence, **fields)

    def call(self, name, request):
        return self.peer.call(name, request, self.channel)

    def step(self, t, step, *signals, **fields):
        request = self.request(pb.StepRequest, t=t, step=step, signals=signals, **fields)
        return list(self.call("Step", request).outputs.values)

    def perturbed(self, t, step, signals, **fields):
        return self.call("PerturbedStep", self.request(pb.PerturbedStepRequest, t=t, step=step, signals=signals, **fields))

    def snapshot(self, **fields):
        return self.call("Snapshot", self.request(pb.SnapshotRequest, **fields)).snapshot

    def restore(self, snapshot):
        return self.call("Restore", self.request(pb.RestoreRequest, snapshot=snapshot))

    def export(self):
        return self.call("ExportState", pb.ExportStateRequest(instance=self.instance)).state

    def take_exported(self, state):
        return self.call("ImportState", self.request(pb.ImportStateRequest, state=state))

    def exchange(self, **fields):
        if self.stream is None:
            self.stream = self.peer.stream(self.channel)
        return self.stream.turn(self.request(pb.ExchangeRequest, **fields))

    def evaluate(self, *names, signals=(), **fields):
        request = pb.EvaluateRequest(instance=self.instance, signals=signals, outputs=names, **fields)
        return self.call("Evaluate", request)

    def values(self, *names, signals=()):
        return list(self.evaluate(*names, signals=signals).outputs.values)

    @property
    def level(self):
        """The present level of a tank."""
        return self.values("level", signals=[constant(0, 0.0)])[0]


class PeerTest(unittest.TestCase):
    """A test that asks a worker."""

    def assert_refused(self, severity, call, *words, field=None, variable=None):
        """`call` fails so, and its message has all words."""
        with self.assertRaises(Refusal) as caught:
            call()
        failure, code = caught.exception.failure, caught.exception.code
        self.assertEqual(failure.severity, severity, failure)
        codes = {
            pb.SEVERITY_MISUSE: grpc.StatusCode.INVALID_ARGUMENT,
            pb.SEVERITY_RECOVERABLE: grpc.StatusCode.ABORTED,
            pb.SEVERITY_FATAL: grpc.StatusCode.INTERNAL,
        }
        self.assertIn(code, (None, codes[severity]))
        for name, expected in (("field", field), ("variable", variable)):
            if expected is not None:
                self.assertEqual(getattr(failure, name), expected)
        for word in words:
            self.assertIn(str(word), failure.message)
        return failure

    def assert_no_instance(self, call, instance):
        """`call` ends with the status that has its master make the instance anew."""
        with self.assertRaises(Refusal) as caught:
            call()
        refusal = caught.exception
        self.assertEqual((refusal.code, refusal.failure.field), (grpc.StatusCode.NOT_FOUND, "instance"))
        self.assertIn(f"no instance {instance:#x} here; Initialize makes one", refusal.failure.message)

    def assert_misuse(self, field, call, *words):
        return self.assert_refused(pb.SEVERITY_MISUSE, call, *words, field=field)


class WorkerTest(PeerTest):
    """A test that asks a worker with the default limits."""

    def setUp(self):
        self.peer = Peer(self)

    def drive(self, request=None):
        return Driver(self.peer, request or tank())

"""A foreign worker: the model "oscillator" behind the contract linchpin.v1, in plain Python.

grpcio and the stubs generated from worker.proto, no SDK, unary calls only: this is all that the contract asks of
somebody who writes a worker in another language.
"""

import argparse
import math
import signal
import time
from concurrent import futures

import grpc
from linchpin.v1 import worker_pb2 as pb
from linchpin.v1 import worker_pb2_grpc
from oscillator import MAX_NODES, Oscillator, Polynomial

PROTOCOL = pb.ProtocolVersion(major=1, minor=0)
PARAMETERS = {
    "m": pb.Parameter(name="m", unit="kg", description="mass"),
    "c": pb.Parameter(name="c", unit="N/m", description="stiffness of the spring to the ground"),
    "d": pb.Parameter(name="d", unit="N*s/m", description="damping against the ground"),
    "x0": pb.Parameter(name="x0", unit="m", description="position at the start", default=0.0),
    "v0": pb.Parameter(name="v0", unit="m/s", description="velocity at the start", default=0.0),
}
INPUTS = {"f": pb.Variable(name="f", unit="N", description="external force", default=0.0)}
OUTPUTS = {
    "x": pb.Variable(name="x", unit="m", description="position"),
    "v": pb.Variable(name="v", unit="m/s", description="velocity"),
    "a": pb.Variable(name="a", unit="m/s^2", description="acceleration"),
}
MODEL = pb.Model(
    name="oscillator",
    description="m v' = -c x - d v + f, x' = v",
    inputs=INPUTS.values(),
    outputs=OUTPUTS.values(),
    parameters=PARAMETERS.values(),
    markers=[pb.Marker(name="mass", kind="MARKER_KIND_SCALAR", position="x", velocity="v", acceleration="a", load="f")],
    solvers=[pb.SolverKind(name="exact", description="power series, exact up to rounding")],
    states=[pb.StateVariable(output="x", initial="x0"), pb.StateVariable(output="v", initial="v0")],
    capabilities=pb.Capabilities(exchange=False, repeats_step_sequence=True, max_input_degree=MAX_NODES - 1),
)


class Refusal(Exception):
    """A refused request with its gRPC code. What is out of range is a ValueError and becomes INVALID_ARGUMENT."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def misplaced(message):
    return Refusal(grpc.StatusCode.FAILED_PRECONDITION, message)


def negotiate(theirs):
    if theirs.major != PROTOCOL.major:
        raise misplaced(
            f"incompatible protocol: this worker speaks linchpin {PROTOCOL.major}.{PROTOCOL.minor}, the other side"
            f" speaks {theirs.major}.{theirs.minor}; use builds with the same major number"
        )


def known(field, names, allowed):
    """`names`, if the model has all of them."""
    for name in names:
        if name not in allowed:
            raise ValueError(f"{field}: there is no '{name}', only {', '.join(map(str, allowed)) or 'none'}")
    return list(names)


def parameter_values(given):
    values = {name: parameter.default for name, parameter in PARAMETERS.items() if parameter.HasField("default")}
    for name, value in given.items():
        known(f"parameters.{name} = {str(value).strip()}", [name], PARAMETERS)
        if value.WhichOneof("kind") != "number" or not math.isfinite(value.number):
            raise ValueError(f"parameters.{name} = {str(value).strip()}: it must be a finite number")
        values[name] = value.number
    missing = [name for name in PARAMETERS if name not in values]
    if missing:
        raise ValueError(f"parameters: {', '.join(missing)} must be given")
    return values


class Instance:
    """One oscillator at one point of time, its kept states and its last answer."""

    def __init__(self, request):
        known("model", [request.model], [MODEL.name])
        if request.HasField("solver"):
            known("solver.kind", [request.solver.kind], ["exact"])
            known("solver.options", request.solver.options, [])
        values = parameter_values(request.parameters)
        self.state = values.pop("x0"), values.pop("v0")
        self.oscillator = Oscillator(**values)
        self.inputs = known("inputs", request.inputs, INPUTS)
        self.coupling = known("coupling_outputs", request.coupling_outputs, OUTPUTS)
        self.recorded = known("recorded_outputs", request.recorded_outputs, OUTPUTS)
        self.snapshots = {}
        self.taken = 0
        self.initialized = request
        self.sequence = request.sequence
        self.last_kind = type(request)
        self.last_answer = pb.InitializeReply()

    def answer_once(self, request, act):
        """What `act` answers or raises; if this sequence number had its answer, that answer again."""
        if request.sequence == self.sequence + 1:
            self.sequence, self.last_kind = request.sequence, type(request)
            try:
                self.last_answer = act(self, request)
            except (Refusal, ValueError) as refusal:
                self.last_answer = refusal
        elif request.sequence != self.sequence:
            raise misplaced(f"sequence = {request.sequence}: next is {self.sequence + 1}, or {self.sequence} again")
        elif self.last_kind is not type(request):
            raise misplaced(f"sequence = {request.sequence} was a {self.last_kind.__name__}")
        if isinstance(self.last_answer, Exception):
            raise self.last_answer
        return self.last_answer

    def force(self, signals):
        known("signals.input", [one.input for one in signals], range(len(self.inputs)))
        if len(signals) > 1:
            raise ValueError(f"signals: {len(signals)} for the one input f, one is allowed")
        return Polynomial(signals[0].nodes, signals[0].values) if signals else Polynomial([0.0], [0.0])

    def outputs(self, names, x, v, f):
        values = {"x": x, "v": v, "a": self.oscillator.acceleration(x, v, f)}
        return pb.Outputs(values=[values[name] for name in names])

    def integrate(self, request, signals, work):
        """Position, velocity and force at the end of a step from the present state, which stays as it is."""
        started = time.perf_counter_ns()
        force = self.force(signals)
        x, v = self.oscillator.advance(*self.state, request.step, force)
        work.integrations += 1
        work.steps += self.oscillator.parts(request.step)
        work.nanoseconds += time.perf_counter_ns() - started
        return x, v, force.value(request.step)

    def step(self, request):
        work = pb.Work()
        x, v, f = self.integrate(request, request.signals, work)
        self.state = x, v
        names = self.coupling + (self.recorded if request.outputs == pb.OUTPUT_SET_ALL else [])
        return pb.StepReply(outputs=self.outputs(names, x, v, f), work=work)

    def perturbed_step(self, request):
        work = pb.Work()
        # f is the only input, so each perturbed signal replaces all that `signals` holds.
        ends = [self.integrate(request, [one], work) for one in request.perturbed]
        return pb.PerturbedStepReply(outputs=[self.outputs(self.coupling, *end) for end in ends], work=work)

    def evaluate(self, request):
        names = known("outputs", request.outputs, OUTPUTS)
        return pb.EvaluateReply(outputs=self.outputs(names, *self.state, self.force(request.signals).value(0.0)))

    def snapshot(self, request):
        self.snapshots.pop(request.replaces, None)
        self.taken += 1
        self.snapshots[self.taken] = self.state
        return pb.SnapshotReply(snapshot=self.taken)

    def restore(self, request):
        if request.snapshot not in self.snapshots:
            raise Refusal(grpc.StatusCode.NOT_FOUND, f"snapshot = {request.snapshot}: kept are {list(self.snapshots)}")
        self.state = self.snapshots[request.snapshot]
        return pb.RestoreReply()


def unary(answer):
    """A gRPC handler around `answer(worker, request)`: refusals become statuses."""

    def handler(worker, request, context):
        try:
            return answer(worker, request)
        except Refusal as refusal:
            context.abort(refusal.code, str(refusal))
        except ValueError as out_of_range:
            context.abort(grpc.StatusCode.INVALID_ARGUMENT, str(out_of_range))

    return handler


def sequenced(act):
    """A gRPC handler around `act(instance, request)` that acts once for every sequence number."""
    return unary(lambda worker, request: worker.instance(request).answer_once(request, act))


class Worker(worker_pb2_grpc.WorkerServicer):
    """The unary calls. The server has one thread, so that calls never overlap."""

    def __init__(self):
        self.instances = {}

    def instance(self, request):
        if request.instance not in self.instances:
            raise Refusal(grpc.StatusCode.NOT_FOUND, f"instance = {request.instance}: it was not initialized")
        return self.instances[request.instance]

    @unary
    def Describe(self, request):
        return pb.DescribeReply(protocol=PROTOCOL, worker="oscillator_worker.py", worker_version="1", models=[MODEL])

    @unary
    def Initialize(self, request):
        negotiate(request.protocol)
        existing = self.instances.get(request.instance)
        if existing and existing.initialized != request:
            raise Refusal(grpc.StatusCode.ALREADY_EXISTS, f"instance = {request.instance}: terminate it first")
        self.instances[request.instance] = existing or Instance(request)
        return pb.InitializeReply()

    @unary
    def Evaluate(self, request):
        return self.instance(request).evaluate(request)

    @unary
    def Terminate(self, request):
        self.instances.pop(request.instance, None)
        return pb.TerminateReply()

    Snapshot = sequenced(Instance.snapshot)
    Restore = sequenced(Instance.restore)
    Step = sequenced(Instance.step)
    PerturbedStep = sequenced(Instance.perturbed_step)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--listen", required=True, metavar="ADDRESS", help="unix:/PATH or IP:PORT (0: any port)")
    address = arguments.parse_args().listen
    # Without so_reuseport = 0 a second worker on the same port would start and take half of the connections.
    server = grpc.server(futures.ThreadPoolExecutor(max_workers=1), options=[("grpc.so_reuseport", 0)])
    worker_pb2_grpc.add_WorkerServicer_to_server(Worker(), server)
    port = server.add_insecure_port(address)
    if not address.startswith("unix:"):
        address = f"{address.rpartition(':')[0]}:{port}"
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: server.stop(grace=1.0))
    server.start()
    print(f"listening on {address}", flush=True)
    server.wait_for_termination()


if __name__ == "__main__":
    main()

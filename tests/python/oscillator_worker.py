"""A worker in plain Python: a mass on a spring and a damper behind the contract linchpin.v1.

The example to start from: put your solver in the place of MODEL and Oscillator. It takes grpcio and the stubs generated
from worker.proto; setup.sh brings both:

    bash setup.sh /tmp/python
    PYTHONPATH=/tmp/python/stubs /tmp/python/venv/bin/python oscillator_worker.py --listen 127.0.0.1:50051
"""

import math
import signal
import sys
from concurrent import futures

import grpc
from grpc import StatusCode
from linchpin.v1 import worker_pb2 as pb
from linchpin.v1 import worker_pb2_grpc

PROTOCOL = pb.ProtocolVersion(major=1, minor=1)
MODEL = pb.Model(
    name="oscillator",
    description="m a = -c x - d v + f",
    inputs=[pb.Variable(name="f", unit="N", default=0.0)],
    outputs=[pb.Variable(name=name, unit=unit) for name, unit in (("x", "m"), ("v", "m/s"), ("a", "m/s^2"))],
    parameters=[pb.Parameter(name=name, unit=unit) for name, unit in (("m", "kg"), ("c", "N/m"), ("d", "N s/m"))]
    + [pb.Parameter(name=name, unit=unit, default=0.0) for name, unit in (("x0", "m"), ("v0", "m/s"))],
    markers=[pb.Marker(name="mass", kind="MARKER_KIND_SCALAR", position=["x"], velocity=["v"], acceleration=["a"], load=["f"])],
    states=[pb.StateVariable(output="x", initial="x0"), pb.StateVariable(output="v", initial="v0")],
    capabilities=pb.Capabilities(repeats_step_sequence=True, max_input_degree=7, directional_derivatives=True),
)


class Refused(Exception):
    """Refused(text, status code): the request is not carried out and nothing has changed."""


def require(condition, text, code=StatusCode.INVALID_ARGUMENT):
    if not condition:
        raise Refused(text, code)


class Oscillator:
    """One instance of the model with its snapshots and its last answer. SI units."""

    def __init__(self, request):
        require(math.isfinite(request.t_start), f"t_start = {request.t_start}: it must be finite")
        given = {name: one.number if one.HasField("number") else math.nan for name, one in request.parameters.items()}
        numbers = {"m": math.nan, "c": math.nan, "d": math.nan, "x0": 0.0, "v0": 0.0, **given}
        self.m, self.c, self.d, x, v, *unknown = numbers.values()
        fits = self.m > 0.0 and self.c >= 0.0 and self.d >= 0.0 and all(map(math.isfinite, numbers.values()))
        require(fits and not unknown, f"parameters = {given}: m > 0, c >= 0, d >= 0, x0 and v0 are allowed, all of them finite")
        self.inputs, self.coupling = list(request.inputs), list(request.coupling_outputs)
        self.all = self.coupling + list(request.recorded_outputs)
        require(self.inputs in ([], ["f"]), f"inputs = {self.inputs}: there is no input but f")
        self.state = x, v
        self.outputs(self.all, x, v, 0.0)
        self.snapshots, self.taken = {}, 0
        self.last, self.answer = request, None

    def outputs(self, names, x, v, f):
        values = {"x": x, "v": v, "a": (f - self.c * x - self.d * v) / self.m}
        require(values.keys() >= set(names), f"outputs = {list(names)}: there is no output but x, v and a")
        return pb.Outputs(values=[values[name] for name in names])

    def force(self, signals):
        """The signal of the only input, f; without one f is 0."""
        force = signals[0] if signals else pb.Signal(nodes=[0.0], values=[0.0])
        nodes, values = list(force.nodes), list(force.values)
        driven = not signals or len(signals) == 1 and force.input < len(self.inputs)
        points = 1 <= len(set(nodes)) == len(nodes) == len(values) <= 8 and all(map(math.isfinite, nodes + values))
        allowed = f"one for each of the inputs {self.inputs}, through 1 to 8 finite points at distinct times"
        require(driven and points, f"signals = {list(signals)}: allowed is {allowed}")
        return force

    def derivatives(self, names, step, directions):
        """The equation is linear: the derivative in a direction is the motion from zero under that direction."""
        ends = [self.end(step, [one], (0.0, 0.0)) for one in directions]
        return [self.outputs(names, *end) for end in ends]

    def end(self, step, signals, start=None):
        """Position, velocity and force `step` seconds after `start`, or after the state, which stays. Power series in s = t/h
        over parts of length h that are short beside 1/omega and m/d: x = sum of xs[n] s^n, h v = sum of ws[n] s^n."""
        force, (x, v) = self.force(signals), start or self.state
        parts = step * max(math.sqrt(self.c / self.m), self.d / self.m)
        require(step > 0.0 and parts < 1e5, f"step = {step} s: above 0 and below 1e5 times 1/omega and m/d is allowed")
        parts = max(1, math.ceil(parts))
        h = step / parts
        for part in range(parts):
            f, xs, ws = powers(force, part * h, h), [x], [h * v]
            for n in range(20):
                load = (f[n] if n < len(f) else 0.0) - self.c * xs[n]
                xs.append(ws[n] / (n + 1))
                ws.append((h * h * load - h * self.d * ws[n]) / self.m / (n + 1))
            x, v = math.fsum(xs), v + math.fsum(ws[1:]) / h
        return x, v, powers(force, step, 0.0)[0]


def powers(force, start, scale):
    """Coefficients a_j of p(start + scale s) = a_0 + a_1 s + ..; p passes through the points of a Signal (Newton)."""
    nodes, differences = force.nodes, list(force.values)
    for order in range(1, len(nodes)):
        for i in reversed(range(order, len(nodes))):
            differences[i] = (differences[i] - differences[i - 1]) / (nodes[i] - nodes[i - order])
    result = [0.0] * len(nodes)
    for node, difference in zip(reversed(nodes), reversed(differences)):
        shift = start - node
        result = [difference + shift * result[0]] + [scale * a + shift * b for a, b in zip(result, result[1:])]
    return result


def call(answer):
    """The gRPC handler of a call that `answer(worker, request)` answers or refuses."""

    def handler(worker, request, context):
        try:
            return answer(worker, request)
        except Refused as refused:
            text, code = refused.args
            context.abort(code, text)

    return handler


def sequenced(act):
    """A call that changes an instance: a repeated number gets its first answer, so a lost answer never steps twice."""

    def answer_once(worker, request):
        one = worker.instance(request)
        number, last = one.last.sequence, type(one.last)
        if request.sequence == number + 1:
            one.last = request
            try:
                one.answer = act(one, request)
            except Refused as refused:
                one.answer = refused
        else:
            text = f"sequence = {request.sequence}: {number} was the last, a {last.__name__}, and {number + 1} is next"
            require(request.sequence == number and type(request) is last, text, StatusCode.FAILED_PRECONDITION)
        if isinstance(one.answer, Refused):
            raise one.answer
        return one.answer

    return call(answer_once)


class Worker(worker_pb2_grpc.WorkerServicer):
    """The unary calls, one at a time. Those with a sequence number act on the instance that they name."""

    def __init__(self):
        self.instances = {}

    def instance(self, request):
        require(request.instance in self.instances, f"instance = {request.instance} is not here", StatusCode.NOT_FOUND)
        return self.instances[request.instance]

    @call
    def Describe(self, request):
        return pb.DescribeReply(protocol=PROTOCOL, worker="oscillator_worker.py", worker_version="1", models=[MODEL])

    @call
    def Initialize(self, request):
        ours, theirs = (f"{one.major}.{one.minor}" for one in (PROTOCOL, request.protocol))
        text = f"this worker speaks linchpin {ours}, its master {theirs}: the first numbers must be equal"
        require(request.protocol.major == PROTOCOL.major, text, StatusCode.FAILED_PRECONDITION)
        only = f"model = {request.model}: there is only {MODEL.name}, and no choice of solvers"
        require(request.model == MODEL.name and not request.HasField("solver"), only)
        one = self.instances.get(request.instance) or Oscillator(request)
        require(one.last == request, f"instance = {request.instance}: it exists already", StatusCode.ALREADY_EXISTS)
        self.instances[request.instance] = one
        return pb.InitializeReply()

    @call
    def Evaluate(self, request):
        one = self.instance(request)
        f = powers(one.force(request.signals), 0.0, 0.0)[0]
        through = [powers(one.force([signal]), 0.0, 0.0)[0] for signal in request.directions]
        derivatives = [one.outputs(request.outputs, 0.0, 0.0, direct) for direct in through]
        return pb.EvaluateReply(outputs=one.outputs(request.outputs, *one.state, f), derivatives=derivatives)

    @call
    def Terminate(self, request):
        self.instances.pop(request.instance, None)
        return pb.TerminateReply()

    @sequenced
    def Step(one, request):
        x, v, f = one.end(request.step, request.signals)
        one.state = x, v
        names = one.all if request.outputs == pb.OUTPUT_SET_ALL else one.coupling
        return pb.StepReply(outputs=one.outputs(names, x, v, f), work=pb.Work(integrations=1))

    @sequenced
    def PerturbedStep(one, request):
        # A perturbed signal replaces that of its input, and f is the only input.
        outputs = [one.outputs(one.coupling, *one.end(request.step, [signal])) for signal in request.perturbed]
        derivatives = one.derivatives(one.coupling, request.step, request.directions)
        work = pb.Work(integrations=len(outputs), derivatives=len(derivatives))
        return pb.PerturbedStepReply(outputs=outputs, work=work, derivatives=derivatives)

    @sequenced
    def Snapshot(one, request):
        one.snapshots.pop(request.replaces, None)
        one.taken += 1
        one.snapshots[one.taken] = one.state
        return pb.SnapshotReply(snapshot=one.taken)

    @sequenced
    def Restore(one, request):
        kept = f"snapshot = {request.snapshot}: kept are {list(one.snapshots)}"
        require(request.snapshot in one.snapshots, kept, StatusCode.NOT_FOUND)
        one.state = one.snapshots[request.snapshot]
        return pb.RestoreReply()


def main():
    if len(sys.argv) != 3 or sys.argv[1] != "--listen":
        sys.exit(f"usage: {sys.argv[0]} --listen ADDRESS, where ADDRESS is unix:/PATH or IP:PORT (port 0: any)")
    address = sys.argv[2]
    # Without so_reuseport = 0 a second worker could take half of the connections to a port.
    server = grpc.server(futures.ThreadPoolExecutor(max_workers=1), options=[("grpc.so_reuseport", 0)])
    worker_pb2_grpc.add_WorkerServicer_to_server(Worker(), server)
    port = server.add_insecure_port(address)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: server.stop(grace=1.0))
    server.start()
    host = address.rpartition(":")[0]
    print("listening on", address if host == "unix" else f"http://{host}:{port}", flush=True)
    server.wait_for_termination()


if __name__ == "__main__":
    main()

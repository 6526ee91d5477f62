"""What a macro step costs in Python, against a bare round trip of grpcio: python cost.py

Both are exchanges on one stream over a Unix socket between two processes of this machine. The bare one answers a message
with the bytes that came; the worker's carries the macro step of a free body in space: an advance, an evaluation and a look
ahead, each under six signals, and one look ahead of sixteen also with six perturbed signals, as Jacobians that are kept
have it. The solver itself does next to nothing, so what is measured is the SDK and the transport.
"""

import queue
import statistics
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

import grpc

from linchpin_worker import Address, Description, Host, Server, Subsystem, spatial_marker
from linchpin_worker._contract import worker_pb2 as pb

TURNS, WARM_UP, COLUMNS_EVERY, STEP = 10_000, 200, 16, 1e-3
TIP = spatial_marker("tip")


class Body(Subsystem):
    """A body that keeps its place."""

    description = Description("body", inputs=TIP.inputs, outputs=TIP.outputs, markers=[TIP])

    def __init__(self, setup):
        self.state = (0.0,) * 13

    def advance(self, t, step, u):
        u(0.5 * step)

    def outputs(self, t, u):
        return (*self.state, *u)

    def save(self):
        return self.state

    def load(self, state):
        self.state = state


class Bare:
    """A server whose only call answers with what came."""

    def __init__(self, address):
        def echo(requests, context):
            yield from requests

        handler = grpc.method_handlers_generic_handler("Bare", {"Echo": grpc.stream_stream_rpc_method_handler(echo)})
        self.server = grpc.server(ThreadPoolExecutor(4))
        self.server.add_generic_rpc_handlers((handler,))
        self.server.add_insecure_port(address)

    def __enter__(self):
        self.server.start()

    def __exit__(self, *error):
        self.server.stop(0)


def serve(kind, address):
    """Serves until the standard input ends."""
    with Server(Host(Body), Address.of(address)) if kind == "worker" else Bare(address):
        print("ready", flush=True)
        sys.stdin.read()


class Stream:
    """One stream of a client."""

    def __init__(self, channel, method):
        self.requests = queue.SimpleQueue()
        self.replies = channel.stream_stream(method)(iter(self.requests.get, None))

    def turn(self, request):
        self.requests.put(request)
        return next(self.replies)


def signals(number):
    nodes = [STEP, 0.0, -STEP]
    values = [0.1 * number, 0.2, 0.3]
    return [pb.Signal(input=place, nodes=nodes, values=values) for place in range(6)]


def exchanges(count):
    """The requests of a body, from sequence number 1 on."""
    for number in range(1, count + 1):
        t = number * STEP
        columns = signals(number + 1) if number % COLUMNS_EVERY == 0 else []
        yield pb.ExchangeRequest(
            instance=1,
            sequence=number,
            advance=pb.Advance(t=t, step=STEP, signals=signals(number)),
            evaluate=pb.Predict(t=t + STEP, signals=signals(number)),
            predict=pb.Predict(t=t + STEP, step=STEP, signals=signals(number), perturbed=columns),
        ).SerializeToString()


def initialize(channel):
    names = [variable.name for variable in TIP.outputs]
    request = pb.InitializeRequest(
        instance=1,
        protocol=pb.ProtocolVersion(major=1, minor=4),
        model="body",
        inputs=[variable.name for variable in TIP.inputs],
        coupling_outputs=names,
    )
    channel.unary_unary("/linchpin.v1.Worker/Initialize")(request.SerializeToString())


def seconds(stream, request):
    begun = time.perf_counter()
    stream.turn(request)
    return time.perf_counter() - begun


def measure():
    """Times of both in turn, so that whatever else the machine does slows down one as the other."""
    with tempfile.TemporaryDirectory() as folder:
        kinds = ("bare", "worker")
        addresses = {kind: f"unix:{folder}/{kind}" for kind in kinds}
        servers = [start(kind, addresses[kind]) for kind in kinds]
        with grpc.insecure_channel(addresses["bare"]) as bare, grpc.insecure_channel(addresses["worker"]) as worker:
            initialize(worker)
            streams = Stream(bare, "/Bare/Echo"), Stream(worker, "/linchpin.v1.Worker/Exchange")
            times = [tuple(seconds(stream, request) for stream in streams) for request in exchanges(TURNS)]
            for stream in streams:
                stream.requests.put(None)
        for server in servers:
            server.stdin.close()
            server.wait()
    return times[WARM_UP:]


def start(kind, address):
    command = [sys.executable, __file__, kind, address]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    process.stdout.readline()
    return process


def main():
    if len(sys.argv) == 3:
        serve(*sys.argv[1:])
        return
    bare, worker = (1e3 * statistics.median(times) for times in zip(*measure(), strict=True))
    print(f"bare round trip {bare:.3f} ms, macro step of a body {worker:.3f} ms: {worker / bare:.2f} round trips")


if __name__ == "__main__":
    main()

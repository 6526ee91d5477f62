"""Long steps in a process of their own that nobody waits for any more: they end, and the instance is what it was before."""

import pathlib
import queue
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import grpc
from peer import Driver, constant, initialize, refusal

from linchpin_worker._contract import worker_pb2 as pb

PROGRAM = pathlib.Path(__file__).with_name("slow.py")
SHORT, LONG = 3.7e-3, 600.0
# Long enough for the step to begin, short against it.
MOMENT = 0.3
# Longest time until a step has ended that is cancelled (s).
SOON = 3.0


class Process:
    """A worker process, and a connection to it."""

    def __init__(self, test):
        self.folder = test.enterContext(tempfile.TemporaryDirectory())
        self.address = f"unix:{self.folder}/worker"
        command = [sys.executable, PROGRAM, "--listen", self.address]
        self.process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        test.addCleanup(self.process.communicate)
        test.addCleanup(self.process.kill)
        self.process.stdout.readline()
        self.channel = self.connect(test)

    def connect(self, test):
        channel = grpc.insecure_channel(self.address, options=[("grpc.use_local_subchannel_pool", 1)])
        test.addCleanup(channel.close)
        return channel

    def stub(self, name, request, channel=None):
        read = getattr(pb, pb.DESCRIPTOR.services_by_name["Worker"].methods_by_name[name].output_type.name).FromString
        return (channel or self.channel).unary_unary(f"/linchpin.v1.Worker/{name}", type(request).SerializeToString, read)

    def call(self, name, request, channel=None):
        try:
            return self.stub(name, request, channel)(request, timeout=20)
        except grpc.RpcError as error:
            raise refusal(error) from None

    def begin(self, name, request, **options):
        """A call that is under way."""
        under_way = self.stub(name, request).future(request, **options)
        time.sleep(MOMENT)
        return under_way

    def wait_until_idle(self):
        began = time.monotonic()
        while any(own.idle == 0.0 for own in self.call("ListInstances", pb.ListInstancesRequest()).instances):
            assert time.monotonic() < began + SOON, "the step goes on"
            time.sleep(0.01)


def request(kind, **fields):
    return kind(t=0.0, step=LONG, signals=[constant(0, 2.0)], **fields)


class Cancelled(unittest.TestCase):
    def setUp(self):
        self.worker = Process(self)
        self.driver = Driver(self.worker, initialize(model="slow", inputs=["f"], coupling_outputs=["x", "parts"], instance=77))
        # What is taken back is not the state of the start.
        self.short()
        self.kept = self.driver.export()

    def short(self):
        return self.driver.step(0.0, SHORT, constant(0, 1.7))

    def assert_as_before(self):
        """The number of the cancelled call is free, and the same step has the bits that it has on another instance."""
        self.assertEqual(self.driver.export(), self.kept)
        other = Driver(self.worker, initialize(model="slow", inputs=["f"], coupling_outputs=["x", "parts"], instance=78))
        for _ in range(2):
            expected = other.step(0.0, SHORT, constant(0, 1.7))
        self.assertEqual(self.short(), expected)

    def long(self, name, kind, **options):
        call = request(kind, instance=77, sequence=self.driver.sequence + 1)
        return self.worker.begin(name, call, **options)

    def test_a_call_that_is_dropped(self):
        perturbed = {"perturbed": [constant(0, 2.1)]}
        for name, kind, fields in (("Step", pb.StepRequest, {}), ("PerturbedStep", pb.PerturbedStepRequest, perturbed)):
            with self.subTest(call=name):
                call = request(kind, instance=77, sequence=self.driver.sequence + 1, **fields)
                under_way = self.worker.begin(name, call)
                self.assertFalse(under_way.done())
                under_way.cancel()
                self.worker.wait_until_idle()
                self.assertEqual(self.driver.export(), self.kept)
        self.assert_as_before()

    def test_a_deadline_that_passes(self):
        under_way = self.long("Step", pb.StepRequest, timeout=2 * MOMENT)
        self.assertFalse(under_way.done())
        self.assertEqual(under_way.exception(timeout=20).code(), grpc.StatusCode.DEADLINE_EXCEEDED)
        self.worker.wait_until_idle()
        self.assert_as_before()

    def test_a_stream_that_ends_in_its_turn(self):
        """In the advance, and in the look ahead behind an advance that is done."""
        advances = ({"advance": request(pb.Advance)}, {"advance": pb.Advance(step=SHORT), "predict": request(pb.Predict)})
        for fields in advances:
            requests = queue.SimpleQueue()
            write, read = pb.ExchangeRequest.SerializeToString, pb.ExchangeReply.FromString
            call = self.worker.channel.stream_stream("/linchpin.v1.Worker/Exchange", write, read)
            replies = call(iter(requests.get, None))
            requests.put(pb.ExchangeRequest(instance=77, sequence=self.driver.sequence + 1, **fields))
            time.sleep(MOMENT)
            replies.cancel()
            requests.put(None)
            self.worker.wait_until_idle()
            self.assertEqual(self.driver.export(), self.kept)
        self.assert_as_before()

    def test_an_instance_that_is_ended(self):
        under_way = self.long("Step", pb.StepRequest)
        began = time.monotonic()
        self.worker.call("Terminate", pb.TerminateRequest(instance=77), self.worker.connect(self))
        self.assertIsNotNone(under_way.exception(timeout=20))
        self.assertLess(time.monotonic() - began, SOON)
        self.assertEqual(list(self.worker.call("ListInstances", pb.ListInstancesRequest()).instances), [])

    def test_a_worker_that_is_asked_to_end(self):
        under_way = self.long("Step", pb.StepRequest)
        began = time.monotonic()
        self.worker.process.send_signal(signal.SIGTERM)
        self.assertEqual(self.worker.process.wait(timeout=20), 0)
        self.assertLess(time.monotonic() - began, SOON)
        self.assertIn(under_way.exception(timeout=20).code(), (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.CANCELLED))

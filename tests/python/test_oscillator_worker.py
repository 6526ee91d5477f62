"""The contract as `oscillator_worker.py` keeps it, seen by a plain gRPC client over a Unix socket."""

import pathlib
import socket
import subprocess
import sys
import tempfile
import unittest

import grpc
from grpc import StatusCode
from linchpin.v1 import worker_pb2 as pb
from linchpin.v1 import worker_pb2_grpc
from oscillator_worker import Oscillator

PROGRAM = pathlib.Path(__file__).with_name("oscillator_worker.py")
PROTOCOL = pb.ProtocolVersion(major=1, minor=1)
PARAMETERS = {"m": 1.3, "c": 1700.0, "d": 10.3, "x0": 0.37, "v0": -2.9}
SETUP = {"model": "oscillator", "inputs": ["f"], "coupling_outputs": ["x", "v"], "recorded_outputs": ["a"]}
STEP = 1.7e-3
RAMP = ([STEP, 0.0], [41.3, -17.9])


def start(address):
    return subprocess.Popen(
        [sys.executable, PROGRAM, "--listen", address], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def values(parameters):
    return {name: pb.Value(number=number) for name, number in parameters.items()}


def signal(nodes, given):
    return pb.Signal(input=0, nodes=nodes, values=given)


class Contract(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        address = f"unix:{cls.folder.name}/worker"
        cls.process = start(address)
        cls.addClassCleanup(cls.process.communicate)
        cls.addClassCleanup(cls.process.terminate)
        cls.first_line = cls.process.stdout.readline()
        channel = grpc.insecure_channel(address)
        cls.addClassCleanup(channel.close)
        cls.worker = worker_pb2_grpc.WorkerStub(channel)

    def setUp(self):
        self.sequence = 7
        self.initialize(parameters=PARAMETERS)
        self.addCleanup(self.terminate)

    def terminate(self):
        self.worker.Terminate(pb.TerminateRequest(instance=3))

    def initialize(self, parameters, instance=3, protocol=PROTOCOL, **changes):
        request = pb.InitializeRequest(
            instance=instance,
            sequence=7,
            protocol=protocol,
            parameters=values(parameters),
            **{**SETUP, **changes},
        )
        return self.worker.Initialize(request)

    def next(self, kind, **fields):
        self.sequence += 1
        return kind(instance=3, sequence=self.sequence, **fields)

    def step_request(self, *signals, **fields):
        return self.next(pb.StepRequest, t=0.0, step=STEP, signals=signals, **fields)

    def step(self, *signals):
        return list(self.worker.Step(self.step_request(*signals)).outputs.values)

    def evaluate(self, *signals):
        request = pb.EvaluateRequest(instance=3, signals=signals, outputs=["a", "v", "x"])
        return list(self.worker.Evaluate(request).outputs.values)

    def refused(self, code, call, *words):
        """`call` ends with `code`, and the message has all the words."""
        with self.assertRaises(grpc.RpcError) as caught:
            call()
        self.assertEqual(caught.exception.code(), code, caught.exception.details())
        for word in words:
            self.assertIn(word, caught.exception.details())

    def test_says_where_it_listens(self):
        self.assertEqual(self.first_line, f"listening on unix:{self.folder.name}/worker\n")

    def test_describe(self):
        reply = self.worker.Describe(pb.DescribeRequest(protocol=PROTOCOL))
        self.assertEqual(reply.protocol, PROTOCOL)
        (model,) = reply.models
        self.assertEqual([one.name for one in model.parameters], ["m", "c", "d", "x0", "v0"])
        self.assertEqual([one.name for one in model.outputs], ["x", "v", "a"])
        (marker,) = model.markers
        self.assertEqual(
            (marker.name, marker.kind, marker.position, marker.velocity, marker.acceleration, marker.load),
            ("mass", pb.MARKER_KIND_SCALAR, ["x"], ["v"], ["a"], ["f"]),
        )
        self.assertFalse(model.capabilities.exchange)
        self.assertTrue(model.capabilities.directional_derivatives)
        self.assertEqual([(one.output, one.initial) for one in model.states], [("x", "x0"), ("v", "v0")])
        self.assertEqual(model.inputs[0].default, 0.0)

    def test_exchange_is_not_served(self):
        answers = self.worker.Exchange(iter([pb.ExchangeRequest(instance=3, sequence=8)]))
        self.refused(StatusCode.UNIMPLEMENTED, lambda: next(answers))

    def test_another_major_version_is_refused(self):
        for theirs in (pb.ProtocolVersion(major=2, minor=5), pb.ProtocolVersion(major=0, minor=5)):
            shown = f"{theirs.major}.5"
            described = self.worker.Describe(pb.DescribeRequest(protocol=theirs))
            self.assertEqual(described.protocol, PROTOCOL)
            self.refused(
                StatusCode.FAILED_PRECONDITION,
                lambda: self.initialize(PARAMETERS, instance=4, protocol=theirs),
                "1.1",
                shown,
            )

    def test_a_later_minor_version_is_accepted(self):
        self.initialize(PARAMETERS, instance=4, protocol=pb.ProtocolVersion(major=1, minor=9))
        self.worker.Terminate(pb.TerminateRequest(instance=4))

    def test_wrong_parameters_are_named_with_their_value(self):
        for change, words in (
            ({"m": 0.0}, ("m", "0.0")),
            ({"m": -1.25}, ("m", "-1.25")),
            ({"c": -3.5}, ("c", "-3.5")),
            ({"d": float("nan")}, ("d", "nan")),
            ({"mass": 2.5}, ("mass", "2.5", "x0")),
        ):
            with self.subTest(change=change):
                self.refused(
                    StatusCode.INVALID_ARGUMENT, lambda: self.initialize({**PARAMETERS, **change}, instance=4), *words
                )
        self.refused(StatusCode.INVALID_ARGUMENT, lambda: self.initialize({"m": 1.0, "d": 0.0}, instance=4), "c")

    def test_what_the_model_does_not_have(self):
        for change in (
            {"model": "pendulum"},
            {"inputs": ["g"]},
            {"coupling_outputs": ["y"]},
            {"recorded_outputs": ["y"]},
            {"solver": pb.Solver(kind="radau5")},
        ):
            with self.subTest(change=change):
                self.refused(
                    StatusCode.INVALID_ARGUMENT,
                    lambda: self.initialize(PARAMETERS, instance=4, **change),
                    "there is",
                )

    def test_wrong_signals_and_steps_change_nothing(self):
        before = self.evaluate()
        for fields in (
            {"step": 0.0},
            {"step": float("inf")},
            {"step": STEP, "signals": [pb.Signal(input=1, nodes=[0.0], values=[1.0])]},
            {"step": STEP, "signals": [signal([0.0], [1.0]), signal([0.0], [2.0])]},
            {"step": STEP, "signals": [signal([], [])]},
            {"step": STEP, "signals": [signal([0.0, 0.0], [1.0, 1.0])]},
            {"step": STEP, "signals": [signal([0.0], [float("nan")])]},
        ):
            with self.subTest(fields=fields):
                request = self.next(pb.StepRequest, t=0.0, **fields)
                for _ in range(2):
                    self.refused(StatusCode.INVALID_ARGUMENT, lambda: self.worker.Step(request))
        self.assertEqual(self.evaluate(), before)

    def test_a_step_is_the_models_step_and_the_acceleration_feels_its_end(self):
        oscillator = Oscillator(pb.InitializeRequest(parameters=values(PARAMETERS), inputs=["f"]))
        x, v, _ = oscillator.end(STEP, [signal(*RAMP)])
        request = self.step_request(signal(*RAMP), outputs=pb.OUTPUT_SET_ALL)
        a = (41.3 - 1700.0 * x - 10.3 * v) / 1.3
        reply = self.worker.Step(request)
        self.assertEqual(list(reply.outputs.values[:2]), [x, v])
        self.assertAlmostEqual(reply.outputs.values[2], a, delta=1e-12)
        self.assertEqual(reply.work.integrations, 1)

    def test_an_input_without_a_signal_is_zero(self):
        snapshot = self.worker.Snapshot(self.next(pb.SnapshotRequest)).snapshot
        free = self.step()
        self.worker.Restore(self.next(pb.RestoreRequest, snapshot=snapshot))
        self.assertEqual(self.step(signal([0.0], [0.0])), free)

    def test_evaluate_takes_the_input_at_zero_and_changes_nothing(self):
        a, v, x = self.evaluate(signal(*RAMP))
        self.assertEqual((x, v), (0.37, -2.9))
        self.assertAlmostEqual(a, (-17.9 - 1700.0 * 0.37 + 10.3 * 2.9) / 1.3, delta=1e-12)
        self.assertEqual(self.evaluate(signal(*RAMP)), [a, v, x])

    def test_perturbed_steps_are_the_steps_that_they_stand_for(self):
        raised = ([STEP, 0.0], [41.4, -17.9])
        snapshot = self.worker.Snapshot(self.next(pb.SnapshotRequest)).snapshot
        expected = []
        for points in (raised, RAMP):
            expected.append(self.step(signal(*points)))
            self.worker.Restore(self.next(pb.RestoreRequest, snapshot=snapshot))
        request = self.next(
            pb.PerturbedStepRequest,
            t=0.0,
            step=STEP,
            signals=[signal(*RAMP)],
            perturbed=[signal(*raised), signal(*RAMP)],
        )
        reply = self.worker.PerturbedStep(request)
        self.assertEqual([list(one.values) for one in reply.outputs], expected)
        self.assertEqual(reply.work.integrations, 2)
        self.assertNotEqual(expected[0], expected[1])
        self.assertEqual(self.evaluate()[2], 0.37)

    def test_derivatives_are_the_quotients_of_differences(self):
        # Linear: any increment will do, and a large one leaves no rounding.
        increment, direction = 1e6, ([STEP, 0.0], [0.7, -1.1])
        raised = (RAMP[0], [p + increment * q for p, q in zip(RAMP[1], direction[1])])
        request = self.next(
            pb.PerturbedStepRequest,
            t=0.0,
            step=STEP,
            signals=[signal(*RAMP)],
            perturbed=[signal(*RAMP), signal(*raised)],
            directions=[signal(*direction)],
        )
        reply = self.worker.PerturbedStep(request)
        before, after = (one.values for one in reply.outputs)
        (derivative,) = reply.derivatives
        for found, p, q in zip(derivative.values, after, before, strict=True):
            self.assertAlmostEqual(found / ((p - q) / increment), 1.0, delta=1e-12)
        self.assertEqual((reply.work.integrations, reply.work.derivatives), (2, 1))

    def test_the_derivative_of_an_evaluation_is_the_feed_through(self):
        request = pb.EvaluateRequest(
            instance=3, signals=[signal(*RAMP)], outputs=["a", "v", "x"], directions=[signal([0.0, STEP], [0.7, 9.0])]
        )
        reply = self.worker.Evaluate(request)
        self.assertEqual(list(reply.outputs.values), self.evaluate(signal(*RAMP)))
        self.assertEqual([list(one.values) for one in reply.derivatives], [[0.7 / 1.3, 0.0, 0.0]])

    def test_a_restored_state_replays_bit_by_bit(self):
        self.step(signal(*RAMP))
        snapshot = self.worker.Snapshot(self.next(pb.SnapshotRequest)).snapshot
        first = [self.step(signal(*RAMP)) for _ in range(5)]
        self.worker.Restore(self.next(pb.RestoreRequest, snapshot=snapshot))
        self.assertEqual([self.step(signal(*RAMP)) for _ in range(5)], first)

    def test_a_replaced_snapshot_is_gone(self):
        first = self.worker.Snapshot(self.next(pb.SnapshotRequest)).snapshot
        second = self.worker.Snapshot(self.next(pb.SnapshotRequest, replaces=first)).snapshot
        gone = self.next(pb.RestoreRequest, snapshot=first)
        self.refused(StatusCode.NOT_FOUND, lambda: self.worker.Restore(gone), str(first), str(second))
        self.worker.Restore(self.next(pb.RestoreRequest, snapshot=second))

    def test_a_repeated_number_gets_the_first_answer_and_steps_once(self):
        request = self.step_request(signal(*RAMP))
        first = self.worker.Step(request)
        state = self.evaluate()
        self.assertEqual(self.worker.Step(request), first)
        self.assertEqual(self.evaluate(), state)
        snapshot = self.next(pb.SnapshotRequest)
        self.assertEqual(self.worker.Snapshot(snapshot), self.worker.Snapshot(snapshot))

    def test_only_the_last_and_the_next_number_are_allowed(self):
        request = self.step_request()
        self.worker.Step(request)
        for number in (request.sequence - 1, request.sequence + 2):
            wrong = pb.StepRequest(instance=3, sequence=number, step=STEP)
            self.refused(StatusCode.FAILED_PRECONDITION, lambda: self.worker.Step(wrong), f"sequence = {number}", "9")
        other = pb.SnapshotRequest(instance=3, sequence=request.sequence)
        self.refused(StatusCode.FAILED_PRECONDITION, lambda: self.worker.Snapshot(other), "StepRequest")

    def test_a_number_that_was_refused_is_used_up(self):
        wrong = self.next(pb.StepRequest, t=0.0, step=-STEP)
        self.refused(StatusCode.INVALID_ARGUMENT, lambda: self.worker.Step(wrong), str(-STEP))
        corrected = pb.StepRequest(instance=3, sequence=wrong.sequence, t=0.0, step=STEP)
        self.refused(StatusCode.INVALID_ARGUMENT, lambda: self.worker.Step(corrected), str(-STEP))
        self.step()

    def test_initialize_may_be_repeated_until_the_next_call_but_not_replaced(self):
        state = self.evaluate()
        self.initialize(PARAMETERS)
        self.refused(StatusCode.ALREADY_EXISTS, lambda: self.initialize({**PARAMETERS, "m": 2.0}))
        self.assertEqual(self.evaluate(), state)
        self.step()
        self.refused(StatusCode.ALREADY_EXISTS, lambda: self.initialize(PARAMETERS))

    def test_after_terminate_the_instance_is_gone(self):
        for _ in range(2):
            self.terminate()
        self.refused(StatusCode.NOT_FOUND, self.evaluate, "3")

    def test_an_instance_that_does_not_exist(self):
        for call, request in (
            (self.worker.Step, pb.StepRequest(instance=99)),
            (self.worker.Evaluate, pb.EvaluateRequest(instance=99)),
        ):
            self.refused(StatusCode.NOT_FOUND, lambda: call(request), "99")


class Program(unittest.TestCase):
    def test_a_port_in_use_ends_it_with_an_error(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            address = f"127.0.0.1:{taken.getsockname()[1]}"
            worker = start(address)
            _, said = worker.communicate(timeout=20)
        self.assertNotEqual(worker.returncode, 0)
        self.assertIn(address, said)

    def test_port_0_is_any_port_and_the_first_line_names_it(self):
        worker = start("127.0.0.1:0")
        try:
            address = worker.stdout.readline().removeprefix("listening on http://").strip()
            self.assertRegex(address, "^127.0.0.1:[1-9]")
            with grpc.insecure_channel(address) as channel:
                request = pb.DescribeRequest(protocol=PROTOCOL)
                self.assertEqual(worker_pb2_grpc.WorkerStub(channel).Describe(request).models[0].name, "oscillator")
        finally:
            worker.terminate()
            worker.communicate(timeout=20)

    def test_a_signal_ends_it_cleanly(self):
        with tempfile.TemporaryDirectory() as folder:
            worker = start(f"unix:{folder}/worker")
            worker.stdout.readline()
            worker.terminate()
            worker.communicate(timeout=20)
            self.assertEqual(worker.returncode, 0)


if __name__ == "__main__":
    unittest.main()

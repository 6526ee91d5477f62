"""Whatever a message says: the worker answers, and the instance behind it stays sound."""

import math
import random
import unittest

import models
from peer import FIRST, number, oscillator, tank

from linchpin_worker import Host
from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.encoding import encode
from linchpin_worker.exported import sealed
from linchpin_worker.failures import CallFailed

ODD = (0.0, math.nan, math.inf, -math.inf, 1.7976931348623157e308, 5e-324, -1.0)
ROUNDS = 1000


class Anything(unittest.TestCase):
    def setUp(self):
        self.random = random.Random(20)
        self.host = Host(models.Tank, models.Oscillator)

    def number(self):
        return self.random.choice(ODD) if self.random.random() < 0.05 else self.random.uniform(-3.0, 3.0)

    def numbers(self, most):
        return [self.number() for _ in range(self.random.randint(0, most))]

    def signals(self):
        def signal():
            nodes, values = self.numbers(9), self.numbers(9)
            if self.random.random() < 0.95:
                values = [self.number() for _ in nodes]
            return pb.Signal(input=self.random.choice([0, 0, 0, 1, 1, 7]), nodes=nodes, values=values)

        return [signal() for _ in range(self.random.choice([0, 1, 1, 2]))]

    def instants(self):
        return self.random.choice([[], [], [1e-4, 3e-4], self.numbers(2)])

    def impacts(self):
        return pb.Impacts(impacts=[pb.Impact(at=at, loads=self.random.choice([[], self.numbers(2)])) for at in self.instants()])

    def step(self, **fields):
        step = self.random.choice([1e-3, 1e-3, 0.5, self.number()])
        fields = {
            "integrals": self.random.choice([0, 3, 3, 9]),
            "impacts": self.random.choice([None, self.impacts()]),
            **fields,
        }
        return {"t": self.number(), "step": step, "signals": self.signals(), "instants": self.instants(), **fields}

    def look(self):
        return pb.Predict(**self.step(perturbed=self.signals(), directions=self.signals()))

    def request(self):
        """A call of any kind, mostly with the next sequence number."""
        pick = self.random.random
        sequence = {"instance": 5, "sequence": self.sequence + self.random.choice([1, 1, 1, 0, 2])}
        kind = self.random.choice(["step", "perturbed_step", "exchange", "snapshot", "restore", "import_state", "evaluate"])
        if kind == "step":
            return kind, pb.StepRequest(**sequence, **self.step(outputs=self.random.randint(-1, 2)))
        if kind == "perturbed_step":
            fields = self.step(perturbed=self.signals(), directions=self.signals())
            return kind, pb.PerturbedStepRequest(**sequence, **fields)
        if kind == "exchange":
            advance = pb.Advance(**self.step(samples=self.instants()))
            parts = {"advance": advance, "predict": self.look(), "evaluate": self.look()}
            parts = {name: part for name, part in parts.items() if pick() < 0.5}
            return kind, pb.ExchangeRequest(**sequence, **parts, go_back=pick() < 0.3)
        if kind == "snapshot":
            return kind, pb.SnapshotRequest(**sequence, replaces=self.random.randint(0, 3))
        if kind == "restore":
            return kind, pb.RestoreRequest(**sequence, snapshot=self.random.randint(0, 3))
        if kind == "import_state":
            whole = encode((self.random.uniform(-3.0, 3.0), self.random.uniform(-3.0, 3.0)))
            state = sealed(
                self.random.choice(["oscillator", "oscillator", "tank"]), whole[: self.random.choice([None, None, 9])]
            )
            state.checksum ^= self.random.choice([0, 0, 0, 1])
            return kind, pb.ImportStateRequest(**sequence, state=self.random.choice([state, state, None]))
        outputs = self.random.choices(["x", "level", "y"], k=2)
        return kind, pb.EvaluateRequest(instance=5, t=self.number(), signals=self.signals(), outputs=outputs)

    def call(self):
        """Makes one call; what is refused or fails is told as a failure of the contract and in no other way."""
        kind, request = self.request()
        try:
            getattr(self.host, kind)(request)
        except CallFailed as failed:
            self.assertNotIn("Traceback", failed.failure.message)
            if failed.failure.severity == pb.SEVERITY_FATAL:
                # Only the limit of snapshots; nothing that the solver raised.
                self.assertIn("snapshots are kept", failed.failure.message, request)
            if failed.failure.field == "sequence":
                return
        if kind != "evaluate" and request.sequence == self.sequence + 1:
            self.sequence += 1

    def start(self, request):
        self.sequence = FIRST
        self.host.terminate(pb.TerminateRequest(instance=5))
        self.host.initialize(request)

    def state(self, *names):
        signals = [pb.Signal(input=0, nodes=[0.0], values=[0.0])]
        return list(self.host.evaluate(pb.EvaluateRequest(instance=5, signals=signals, outputs=names)).outputs.values)

    def test_an_oscillator_survives_any_calls(self):
        for _ in range(ROUNDS):
            self.start(oscillator(interior_outputs=["x"], integrated_outputs=["v", "x"]))
            for _ in range(8):
                self.call()
            self.assertTrue(all(map(math.isfinite, self.state("x", "v"))))

    def test_calls_that_fail_change_nothing(self):
        """Wherever this tank goes it overflows, after it has changed its level, or it is empty, which is an error."""
        for _ in range(ROUNDS):
            self.start(tank(parameters={"capacity": number(5e-324)}))
            for _ in range(4):
                try:
                    self.call()
                except AssertionError as error:
                    self.assertIn("the tank is empty", str(error))
                    self.sequence += 1
                self.assertEqual(self.state("level"), [models.START])

    def test_any_initialize_is_answered(self):
        for _ in range(ROUNDS):
            own = oscillator(t_start=self.number(), inputs=self.random.choices(["f", "partner_x", "g"], k=2))
            own.parameters[self.random.choice(["m", "c", "mass"])].number = self.number()
            self.host.terminate(pb.TerminateRequest(instance=5))
            try:
                self.host.initialize(own)
            except CallFailed as failed:
                self.assertEqual(failed.failure.severity, pb.SEVERITY_MISUSE, failed)
                self.assertEqual(len(self.host.list_instances(pb.ListInstancesRequest()).instances), 0)

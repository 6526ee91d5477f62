"""States that leave their process: another instance goes on from them bit by bit, and an instance that is gone is told."""

import math
import zlib

import models
import numpy as np
from peer import STEP, Driver, Peer, WorkerTest, constant, initialize, load, number, oscillator, tank

from linchpin_worker import Description, Parameter, Subsystem, Variable
from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.encoding import decode, encode
from linchpin_worker.version import own_version

SOLVERS = (
    pb.Solver(kind="exact"),
    pb.Solver(kind="radau5"),
    pb.Solver(kind="rk4", options={"step": number(1.3e-4)}),
)


class Chain(Subsystem):
    """`x' = f w` with a state of many types; `kind` says what else is in it."""

    description = Description(
        "chain",
        inputs=[Variable("f", default=0.0)],
        outputs=[Variable("sum"), Variable("last")],
        parameters=[Parameter("kind", kind=str)],
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        self.x = np.asfortranarray(np.arange(12.0).reshape(3, 4) / 7.0)
        self.state = {"x": self.x, "steps": 0, "name": setup.parameters["kind"], "factor": np.float32(0.1)}
        if setup.parameters["kind"] == "handle":
            self.state["handle"] = models.Tank

    def advance(self, t, step, u):
        self.x += step * u(0.5 * step).f * self.state["factor"]
        self.state["steps"] += 1
        if self.state["name"] == "grows a set":
            self.state["set"] = {1.0}

    def outputs(self, t, u):
        # The sum depends on the order of the elements in memory.
        return self.x.sum() + self.state["steps"], self.x[-1, -1]

    def save(self):
        return self.state

    def load(self, state):
        self.state, self.x = state, state["x"]


def chain(kind="plain", **fields):
    return initialize(
        model="chain", parameters={"kind": pb.Value(text=kind)}, inputs=["f"], coupling_outputs=["sum", "last"], **fields
    )


def sealed(exported, **changes):
    """A copy of an exported state in which something is different, with the checksum of its bytes."""
    other = pb.ExportedState()
    other.CopyFrom(exported)
    for name, value in changes.items():
        setattr(other, name, value)
    other.checksum = zlib.crc32(other.state)
    return other


def march(driver, first, steps):
    return [driver.step(i * STEP, STEP, *load(41.3 + i)) for i in range(first, first + steps)]


class Exporting(WorkerTest):
    def test_another_instance_in_another_worker_goes_on_bit_by_bit(self):
        for solver in SOLVERS:
            driver = Driver(Peer(self), oscillator(solver=solver))
            march(driver, 0, 3)
            state = driver.export()
            self.assertEqual((state.model, state.writer), ("oscillator", f"linchpin-worker {own_version()}"))
            self.assertEqual(state.checksum, zlib.crc32(state.state))
            rest = march(driver, 3, 7)
            other = Driver(Peer(self), oscillator(instance=8, solver=solver))
            march(other, 0, 1)
            reply = other.take_exported(state)
            self.assertEqual((reply.instance, reply.sequence), (8, other.sequence))
            self.assertEqual(march(other, 3, 7), rest)

    def test_a_state_of_arrays_and_many_types_goes_on_bit_by_bit(self):
        driver = Driver(Peer(self, classes=[Chain]), chain())
        advance = lambda driver, i: driver.step(i * STEP, STEP, constant(0, 1.0 / (3.0 + i)))
        for i in range(3):
            advance(driver, i)
        state = driver.export()
        saved = decode(state.state)
        self.assertEqual((saved["steps"], saved["name"], saved["factor"]), (3, "plain", np.float32(0.1)))
        self.assertTrue(saved["x"].flags.f_contiguous)
        rest = [advance(driver, i) for i in range(3, 8)]
        other = Driver(Peer(self, classes=[Chain]), chain())
        advance(other, 0)
        other.take_exported(state)
        self.assertEqual(other.export(), state)
        self.assertEqual([advance(other, i) for i in range(3, 8)], rest)

    def test_an_imported_state_can_be_kept_and_stepped_from_but_not_taken_back(self):
        driver = self.drive(oscillator())
        start = driver.export()
        march(driver, 0, 2)
        driver.take_exported(start)
        self.assert_misuse("go_back", lambda: driver.exchange(go_back=True), "nothing to take back")
        snapshot = driver.snapshot()
        first = march(driver, 0, 2)
        driver.restore(snapshot)
        self.assertEqual(march(driver, 0, 2), first)

    def test_what_was_looked_ahead_is_not_exported(self):
        driver = self.drive(oscillator())
        march(driver, 0, 2)
        before = driver.export()
        self.assertEqual(len(decode(before.state)), 2)
        driver.exchange(predict=pb.Predict(t=2 * STEP, step=STEP, signals=load(4.0), perturbed=load(5.0)[:1]))
        self.assertEqual(driver.export(), before)
        march(driver, 2, 1)
        self.assertNotEqual(driver.export(), before)

    def test_an_export_has_no_sequence_number(self):
        driver = self.drive(oscillator())
        request = driver.request(pb.StepRequest, t=0.0, step=STEP, signals=load(4.0))
        first = self.peer.call("Step", request)
        reply = self.peer.call("ExportState", pb.ExportStateRequest(instance=5))
        self.assertEqual(reply.instance, 5)
        self.assertEqual(self.peer.call("Step", request), first)


class Refusing(WorkerTest):
    def test_a_damaged_or_foreign_state_is_refused_and_nothing_changes(self):
        driver, undisturbed = (self.drive(oscillator(instance=instance)) for instance in (5, 6))
        for own in (driver, undisturbed):
            march(own, 0, 2)
        state = driver.export()
        damaged = pb.ExportedState(model=state.model, writer=state.writer, checksum=state.checksum)
        damaged.state = bytes([*state.state[:-1], state.state[-1] ^ 4])
        size = len(state.state)
        for wrong, words in (
            (damaged, [f"this state of {size} bytes is damaged", "checksum", f"{state.checksum:#010x}", "another copy"]),
            (sealed(state, model="pendulum"), ['of model "pendulum"', 'of model "oscillator"']),
            (sealed(state, writer="linchpin 0.1.0"), ['written by "linchpin 0.1.0"', f'"{state.writer}"']),
            (sealed(state, state=state.state[:8]), ["these 8 bytes are no state", "breaks off"]),
            (sealed(state, state=state.state + b"N"), [f"these {size + 1} bytes are no state"]),
            (sealed(state, state=b""), ["these 0 bytes are no state"]),
            (None, ["there is no state", "ExportState"]),
        ):
            with self.subTest(words=words):
                self.assert_misuse("state", lambda wrong=wrong: driver.take_exported(wrong), *words)
        self.assertEqual(march(driver, 2, 3), march(undisturbed, 2, 3))

    def test_a_state_that_the_solver_refuses_changes_nothing(self):
        driver, undisturbed = (self.drive(oscillator(instance=instance)) for instance in (5, 6))
        state = sealed(driver.export(), state=encode((1.0, 2.0, 3.0)))
        self.assert_refused(pb.SEVERITY_FATAL, lambda: driver.take_exported(state), "the solver raised ValueError")
        self.assertEqual(march(driver, 0, 2), march(undisturbed, 0, 2))

    def test_a_repeated_import_gets_its_answer_again(self):
        driver = self.drive(oscillator())
        state = driver.export()
        march(driver, 0, 2)
        request = driver.request(pb.ImportStateRequest, state=state)
        first = self.peer.call("ImportState", request)
        self.assertEqual(self.peer.call("ImportState", request), first)
        other = pb.ImportStateRequest(instance=5, sequence=driver.sequence)
        self.assert_misuse("sequence", lambda: self.peer.call("ImportState", other), "ImportState with another content")
        late = pb.ImportStateRequest(instance=5, sequence=driver.sequence + 2, state=state)
        self.assert_misuse("sequence", lambda: self.peer.call("ImportState", late), f"after {driver.sequence}")
        self.assertEqual(driver.export(), state)
        march(driver, 0, 1)
        repeated = pb.ImportStateRequest(instance=5, sequence=driver.sequence, state=state)
        self.assert_misuse("sequence", lambda: self.peer.call("ImportState", repeated), "ImportState", "Step", "add 1")

    def test_an_import_that_failed_fails_again_and_its_number_is_used_up(self):
        driver = self.drive(oscillator())
        request = driver.request(pb.ImportStateRequest)
        for _ in range(2):
            self.assert_misuse("state", lambda: self.peer.call("ImportState", request), "there is no state")
        march(driver, 0, 1)

    def test_a_model_that_does_not_say_so_exports_nothing(self):
        driver = self.drive(tank())
        words = ('model "tank"', "exportable_snapshot")
        self.assert_misuse("state", driver.export, *words)
        state = pb.ExportedState(model="tank", writer="linchpin-worker 0", state=encode(math.pi))
        self.assert_misuse("state", lambda: driver.take_exported(state), *words)
        self.assertEqual(driver.level, models.START)

    def test_a_state_that_cannot_leave_is_told_at_once(self):
        peer = Peer(self, classes=[Chain])
        words = (
            'the state of model "chain" cannot leave its process',
            "state['handle'] is of type builtins.type",
            "allowed are",
        )
        self.assert_refused(pb.SEVERITY_FATAL, lambda: Driver(peer, chain("handle")), *words)
        self.assertEqual(len(peer.call("ListInstances", pb.ListInstancesRequest()).instances), 0)
        driver = Driver(peer, chain("grows a set"))
        driver.export()
        reached = driver.step(0.0, STEP, constant(0, 1.0))
        self.assert_refused(pb.SEVERITY_FATAL, driver.export, "state['set'] is of type builtins.set")
        self.assertEqual(driver.values("sum", "last"), reached)


class Missing(WorkerTest):
    def test_an_instance_that_is_not_there_is_told_as_such(self):
        for kind in ("Snapshot", "Restore", "ExportState", "ImportState", "Step", "PerturbedStep", "Evaluate"):
            request = getattr(pb, f"{kind}Request")(instance=0x2A)
            self.assert_no_instance(lambda kind=kind, request=request: self.peer.call(kind, request), 0x2A)

    def test_a_stream_ends_where_its_instance_is_not_there(self):
        stream = self.peer.stream()
        self.assert_no_instance(lambda: stream.turn(pb.ExchangeRequest(instance=0x2A, sequence=1)), 0x2A)
        driver = self.drive(oscillator())
        driver.exchange()
        self.peer.call("Terminate", pb.TerminateRequest(instance=5))
        self.assert_no_instance(driver.exchange, 5)
        self.drive(oscillator()).exchange()

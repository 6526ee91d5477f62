"""The calls that change an instance: their sequence, their signals, their snapshots, and every misuse."""

import math

from models import LEAK, START
from peer import (
    FLOOD,
    RAMP,
    RISE,
    STEP,
    Driver,
    Peer,
    WorkerTest,
    constant,
    initialize,
    load,
    number,
    oscillator,
    tank,
    through,
)

from linchpin_worker import Description, Limits, Subsystem, Variable
from linchpin_worker._contract import worker_pb2 as pb


class Array(Subsystem):
    """A state in an array that is changed in place, as solvers in C do; `x' = f`."""

    description = Description("array", inputs=[Variable("f", default=0.0)], outputs=[Variable("x")], exportable_snapshot=True)

    def __init__(self, setup):
        self.state = [setup.t_start, 0.0]

    def advance(self, t, step, u):
        self.state[1] += step * u(0.5 * step).f

    def outputs(self, t, u):
        return self.state[1:]

    def save(self):
        return self.state

    def load(self, state):
        self.state[:] = state


class Calling(WorkerTest):
    def test_a_number_is_answered_once(self):
        driver = self.drive()
        for name, request in (
            ("Step", driver.request(pb.StepRequest, t=0.0, step=0.3, signals=RAMP)),
            ("PerturbedStep", driver.request(pb.PerturbedStepRequest, step=0.3, signals=RAMP, perturbed=[RAMP[0]] * 2)),
            ("Snapshot", driver.request(pb.SnapshotRequest)),
            ("Restore", driver.request(pb.RestoreRequest, snapshot=1)),
        ):
            first = self.peer.call(name, request)
            self.assertEqual((first.instance, first.sequence), (5, request.sequence))
            # Equal to the nanosecond of work: nothing was computed again.
            self.assertEqual(self.peer.call(name, request), first)
        advance = pb.Advance(t=0.3, step=0.3, signals=RAMP)
        request = driver.request(pb.ExchangeRequest, advance=advance)
        stream = self.peer.stream()
        first = stream.turn(request)
        self.assertEqual(stream.turn(request), first)
        self.assertAlmostEqual(driver.level, START + 2.0 * RISE, delta=1e-15)

    def test_a_number_belongs_to_one_call_and_one_content(self):
        driver = self.drive()
        driver.step(0.0, 0.3, *RAMP)
        last = driver.sequence
        for wrong in (last - 1, last + 2, 0, (1 << 64) - 1):
            for kind in ("Step", "PerturbedStep", "Snapshot", "Restore"):
                request = getattr(pb, f"{kind}Request")(instance=5, sequence=wrong)
                call = lambda kind=kind, request=request: self.peer.call(kind, request)
                self.assert_misuse("sequence", call, wrong, f"after {last}", last + 1)
            turn = pb.ExchangeRequest(instance=5, sequence=wrong)
            self.assert_misuse("sequence", lambda turn=turn: self.peer.stream().turn(turn), wrong, last + 1)
        other = pb.StepRequest(instance=5, sequence=last, t=0.0, step=0.2, signals=RAMP)
        self.assert_misuse("sequence", lambda: self.peer.call("Step", other), f"number {last}", "another content")
        snapshot = pb.SnapshotRequest(instance=5, sequence=last)
        self.assert_misuse("sequence", lambda: self.peer.call("Snapshot", snapshot), "Snapshot", "Step", "add 1")
        self.assertAlmostEqual(driver.level, START + RISE, delta=1e-15)

    def test_a_call_that_failed_fails_again_and_its_number_is_used_up(self):
        driver = self.drive()
        request = driver.request(pb.StepRequest, t=0.0, step=0.3, signals=FLOOD)
        for _ in range(2):
            failure = self.assert_refused(pb.SEVERITY_RECOVERABLE, lambda: self.peer.call("Step", request), "overflows")
            self.assertEqual((failure.t, failure.step), (0.3, 0.3))
        self.assertEqual(driver.level, START)
        driver.step(0.0, 0.3, *RAMP)

    def test_sequence_numbers_begin_again(self):
        driver = self.drive(tank(sequence=(1 << 64) - 1))
        driver.sequence = -1
        driver.step(0.0, 0.3, *RAMP)
        self.assertEqual(driver.sequence, 0)

    def test_every_degree_is_followed(self):
        driver = self.drive()
        start = driver.snapshot()
        for n in range(1, 9):
            nodes = [0.7 * (1.0 - 0.3 * i) for i in range(n)]
            inflow = through(0, *((node, n * (node / 0.7) ** (n - 1)) for node in nodes))
            level, rate = driver.step(0.0, 0.7, inflow, constant(1, 0.0))
            self.assertAlmostEqual(level, START + 0.7, delta=1e-13)
            self.assertAlmostEqual(rate, n, delta=1e-12)
            driver.restore(start)

    def test_every_wrong_signal_is_named_and_changes_nothing(self):
        driver = self.drive()
        for signals, words in (
            ([constant(2, 1.0)], ["input 2", "2 inputs"]),
            ([constant(0, 1.0), constant(0, 1.0)], ["inflow", "two signals"]),
            ([constant(1, 1.0)], ["inflow", "neither a signal nor a default"]),
            ([through(0)], ["input 0", "at least one node"]),
            ([through(0, *((float(i), 1.0) for i in range(9)))], ["input 0", "9 nodes", "8"]),
            ([pb.Signal(input=0, nodes=[0.0, 1.0], values=[1.0])], ["2 nodes but 1 values"]),
            ([through(0, (0.0, 1.0), (0.5, 1.0), (0.0, 2.0))], ["inflow", "nodes 0 and 2 coincide"]),
            ([through(0, (0.0, 1.0), (0.5, math.nan))], ["node or value 1", "finite"]),
        ):
            with self.subTest(words=words):
                self.assert_misuse("signals", lambda signals=signals: driver.step(0.0, 0.5, *signals), *words)
                self.assert_misuse("signals", lambda signals=signals: driver.values("level", signals=signals), *words)
                look = pb.Predict(t=0.0, step=0.5, signals=signals)
                self.assert_misuse("signals", lambda look=look: driver.exchange(predict=look), *words)
        for perturbed in (constant(2, 1.0), through(0), constant(1, math.inf)):
            call = lambda one=perturbed: driver.perturbed(0.0, 0.5, RAMP, perturbed=[RAMP[0], one])
            self.assert_misuse("signals", call, "input")
        self.assertEqual(driver.step(0.0, 0.5, constant(0, LEAK)), [START, 0.0])

    def test_wrong_steps_and_evaluations(self):
        driver = self.drive()
        inflow = constant(0, 1.0)
        for t, step, words in ((math.nan, 0.5, "NaN"), (0.0, 0.0, "0 s"), (0.0, -0.5, "-0.5"), (0.0, math.inf, "inf")):
            self.assert_misuse("step", lambda t=t, step=step: driver.step(t, step, inflow), words)
            self.assert_misuse("step", lambda t=t, step=step: driver.perturbed(t, step, [inflow]), words)
            advance = pb.Advance(t=t, step=step, signals=[inflow])
            self.assert_misuse("step", lambda advance=advance: driver.exchange(advance=advance), words)
        for look in (pb.Predict(t=math.nan, signals=[inflow]), pb.Predict(t=0.0, step=-0.5, signals=[inflow])):
            self.assert_misuse("step", lambda look=look: driver.exchange(predict=look))
        for t, step in ((0.0, 0.5), (0.0, -0.5), (math.inf, 0.0)):
            look = pb.Predict(t=t, step=step, signals=[inflow])
            self.assert_misuse("evaluate.step", lambda look=look: driver.exchange(evaluate=look), "the length 0")
        self.assert_misuse("outputs", lambda: driver.values("depth", signals=[inflow]), "depth", "level, rate")
        self.assert_misuse("t", lambda: driver.evaluate(signals=[inflow], t=math.nan), "NaN")
        many = lambda: driver.step(0.0, 0.5, inflow, integrals=9)
        self.assert_misuse("integrals", many, "9 integrals", "8")
        self.assert_misuse("directions", lambda: driver.evaluate("level", signals=[inflow], directions=[inflow]))
        self.assertEqual(driver.level, START)

    def test_impacts_are_refused_wherever_a_request_has_them(self):
        driver = self.drive()
        step = {"t": 0.0, "step": 0.5, "signals": [constant(0, 1.0)]}
        impacts = {"impacts": pb.Impacts(impacts=[pb.Impact(at=0.1)])}
        for offered, fields in (
            ("impulses", impacts),
            ("impulses", {"impacts": pb.Impacts()}),
            ("impacts", {"interface": pb.Interface(rows=1)}),
            ("impacts", {**impacts, "interface": pb.Interface(rows=1)}),
        ):
            field, look = list(fields)[-1], pb.Predict(**step, **fields)
            calls = [
                lambda fields=fields: driver.call("Step", driver.request(pb.StepRequest, **step, **fields)),
                lambda fields=fields: driver.call("PerturbedStep", driver.request(pb.PerturbedStepRequest, **step, **fields)),
                lambda look=look: driver.exchange(predict=look),
            ]
            if "interface" not in fields:
                advance = pb.Advance(**step, **fields)
                calls.append(lambda advance=advance: driver.exchange(advance=advance))
            for call in calls:
                self.assert_misuse(field, call, f"do not say {offered}")
        self.assertEqual(driver.level, START)

    def test_snapshots_have_a_limit_and_a_replaced_one_is_gone(self):
        peer = Peer(self, limits=Limits(snapshots=3))
        driver = Driver(peer, tank())
        kept = [driver.snapshot() for _ in range(3)]
        self.assert_refused(pb.SEVERITY_FATAL, driver.snapshot, "3 snapshots", "replaces")
        driver.step(0.0, 0.5, constant(0, 1.0), constant(1, 0.0))
        newer = driver.snapshot(replaces=kept[1])
        self.assert_misuse("snapshot", lambda: driver.restore(kept[1]), f"no snapshot {kept[1]}", newer, "replaced")
        self.assertEqual(driver.level, START + 0.5)
        driver.restore(kept[2])
        self.assertEqual(driver.level, START)

    def test_a_restored_state_replays_bit_by_bit(self):
        for kind, options in (("exact", {}), ("rk4", {"step": number(1.3e-4)})):
            driver = self.drive(oscillator(instance=len(kind), solver=pb.Solver(kind=kind, options=options)))
            march = lambda driver=driver: [driver.step(i * STEP, STEP, *load(41.3 + i)) for i in range(5)]
            snapshot = driver.snapshot()
            first = march()
            driver.restore(snapshot)
            self.assertEqual(march(), first)

    def test_a_state_that_is_changed_in_place_is_kept_all_the_same(self):
        driver = Driver(Peer(self, classes=[Array]), initialize(model="array", coupling_outputs=["x"], inputs=["f"]))
        start = driver.snapshot()
        self.assertEqual(driver.step(0.0, 0.5, constant(0, 1.0)), [0.5])
        driver.restore(start)
        self.assertEqual(driver.step(0.0, 0.25, constant(0, 1.0)), [0.25])

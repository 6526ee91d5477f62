"""The calls of the contract over gRPC: their answers, their order, and every misuse."""

import math

import models
from models import LEAK, START
from peer import PROTOCOL, STEP, Driver, Peer, PeerTest, constant, initialize, number, oscillator, tank, through

from linchpin_worker import Limits
from linchpin_worker._contract import worker_pb2 as pb

RAMP = (through(0, (0.3, 1.9), (0.0, 0.7)), constant(1, 0.1))
RISE = (0.5 * (1.9 + 0.7) - 0.1) * 0.3
FLOOD = (constant(0, 100.0), constant(1, 0.0))
INSTANTS = (0.13 * STEP, 0.5 * STEP, 0.97 * STEP)


def load(end):
    return [through(0, (STEP, end), (0.0, -17.9), (-STEP, 230.7)), constant(1, 0.01)]


class Calls(PeerTest):
    def setUp(self):
        self.peer = Peer(self)

    def drive(self, request=None):
        return Driver(self.peer, request or tank())

    def test_describe_tells_models_and_capabilities(self):
        reply = self.peer.call("Describe", pb.DescribeRequest(protocol=PROTOCOL))
        self.assertEqual(reply.protocol, PROTOCOL)
        described = {model.name: model for model in reply.models}
        self.assertEqual(list(described), ["tank", "oscillator", "stand"])
        self.assertEqual(
            described["oscillator"].capabilities,
            pb.Capabilities(
                exchange=True,
                repeats_step_sequence=True,
                max_input_degree=7,
                directional_derivatives=True,
                interior_outputs=True,
            ),
        )
        self.assertEqual([one.name for one in described["oscillator"].solvers], ["exact", "radau5", "rk4"])
        self.assertEqual(described["oscillator"].states[1], pb.StateVariable(output="v", initial="v0"))
        self.assertFalse(described["tank"].inputs[0].HasField("default"))
        self.assertEqual(described["tank"].inputs[1].default, LEAK)
        self.assertEqual(described["tank"].parameters[0].description, "greater than 0")

    def test_a_named_model_is_described_with_its_parameters(self):
        parameters = {"marker": pb.Value(text="spatial")}
        reply = self.peer.call("Describe", pb.DescribeRequest(protocol=PROTOCOL, model="stand", parameters=parameters))
        (model,) = reply.models
        self.assertEqual(model.markers[0].kind, pb.MARKER_KIND_SPATIAL)
        self.assertEqual(len(model.outputs), 19)
        for parameters, field in (({}, "parameters.marker"), ({"marker": pb.Value(text="round")}, "parameters.marker")):
            request = pb.DescribeRequest(protocol=PROTOCOL, model="stand", parameters=parameters)
            self.assert_misuse(field, lambda request=request: self.peer.call("Describe", request))
        unknown = pb.DescribeRequest(protocol=PROTOCOL, model="clockwork")
        self.assert_misuse("model", lambda: self.peer.call("Describe", unknown), "clockwork", "tank, oscillator, stand")

    def test_every_mistake_in_initialize_is_named(self):
        text, numbers = pb.Value(text="heavy"), pb.Value(numbers=pb.NumberList(values=[1.0]))
        marker = {"marker": pb.Value(text="planar"), "pose": numbers}
        own = dict(oscillator().parameters)
        for request, field, words in (
            (initialize(model="clockwork"), "model", ["clockwork", "tank, oscillator, stand"]),
            (tank(protocol=pb.ProtocolVersion(major=2, minor=5)), "protocol", ["1.3", "2.5"]),
            (initialize(protocol=None, model="tank"), "protocol", ["no version"]),
            (oscillator(parameters={**own, "mass": number(1.0)}), "parameters.mass", ["m, c, d, x0"]),
            (oscillator(parameters={**own, "m": number(-1.25)}), "parameters.m", ["-1.25", "greater than 0"]),
            (oscillator(parameters={**own, "c": number(math.nan)}), "parameters.c", ["NaN", "finite"]),
            (oscillator(parameters={**own, "d": text}), "parameters.d", ["a number"]),
            (oscillator(parameters={**own, "d": pb.Value(flag=True)}), "parameters.d", ["a number"]),
            (oscillator(parameters={**own, "d": pb.Value()}), "parameters.d", ["a number"]),
            (oscillator(parameters={}), "parameters.m", ["missing", "a number"]),
            (oscillator(solver=pb.Solver(kind="euler")), "solver.kind", ["euler", "exact, radau5, rk4"]),
            (tank(solver=pb.Solver(kind="euler")), "solver.kind", ["euler", "none"]),
            (tank(solver=pb.Solver(options={"dt": number(1.0)})), "solver.dt", ["none"]),
            (oscillator(solver=pb.Solver(kind="rk4")), "solver.step", ["missing"]),
            (oscillator(solver=pb.Solver(kind="radau5", options={"rtoll": number(1.0)})), "solver.rtoll", ["rtol, atol"]),
            (oscillator(solver=pb.Solver(kind="radau5", options={"atol": number(0.0)})), "solver.atol", ["greater"]),
            (oscillator(t_start=-math.inf), "t_start", ["-inf", "finite"]),
            (oscillator(inputs=["f", "force"]), "inputs", ["force", "f, partner_x"]),
            (oscillator(inputs=["f", "f"]), "inputs", ["f", "twice"]),
            (tank(inputs=["leak"]), "inputs", ["inflow", "driven"]),
            (oscillator(coupling_outputs=["y"]), "coupling_outputs", ["y", "x, v, a"]),
            (oscillator(recorded_outputs=["y"]), "recorded_outputs", ["y", "x, v, a"]),
            (oscillator(interior_outputs=["y"]), "interior_outputs", ["y", "x, v, a"]),
            (oscillator(integrated_outputs=["x"]), "integrated_outputs", ["oscillator", "output_integrals"]),
            (oscillator(joint_inputs=["lambda"]), "joint_inputs", ["forces and moments"]),
            (oscillator(joint_loads=[pb.JointLoad()]), "joint_loads", ["forces and moments"]),
            (initialize(model="stand", parameters={**marker, "marker": numbers}), "parameters.marker", ["a text"]),
            (initialize(model="stand", parameters={**marker, "pose": text}), "parameters.pose", ["a list of numbers"]),
            (initialize(model="stand", parameters=marker), "parameters.pose", ["as many numbers"]),
            (
                initialize(
                    model="stand", parameters={**marker, "pose": pb.Value(numbers=pb.NumberList(values=[0.0, math.inf]))}
                ),
                "parameters.pose[1]",
                ["inf", "finite"],
            ),
        ):
            with self.subTest(field=field, words=words):
                self.assert_misuse(field, lambda request=request: self.peer.call("Initialize", request), *words)
        self.assert_misuse("instance", lambda: self.peer.call("Step", pb.StepRequest(instance=5)), "0x5", "Initialize")
        self.assertEqual(len(self.peer.call("ListInstances", pb.ListInstancesRequest()).instances), 0)

    def test_defaults_and_tolerances(self):
        bare = oscillator(parameters={"m": number(2.0)})
        driver = self.drive(bare)
        self.assertEqual(driver.values("x", "v", "a", signals=[constant(0, 3.0)]), [0.0, 0.0, 1.5])
        self.assertFalse(driver.initialized.HasField("tolerance"))
        adaptive = oscillator(instance=6, solver=pb.Solver(kind="radau5"))
        self.assertEqual(self.drive(adaptive).initialized.tolerance, 1e-8)

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

    def test_initialize_may_be_repeated_until_the_next_call(self):
        driver = self.drive()
        self.assertEqual(self.peer.call("Initialize", tank()), driver.initialized)
        again = lambda request: lambda: self.peer.call("Initialize", request)
        self.assert_misuse("instance", again(tank(t_start=0.5)), "0x5", "exists")
        driver.step(0.0, 0.3, *RAMP)
        self.assert_misuse("instance", again(tank()), "0x5", "exists")

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
        driver = Driver(Peer(self, classes=[models.Array]), initialize(model="array", coupling_outputs=["x"], inputs=["f"]))
        start = driver.snapshot()
        self.assertEqual(driver.step(0.0, 0.5, constant(0, 1.0)), [0.5])
        driver.restore(start)
        self.assertEqual(driver.step(0.0, 0.25, constant(0, 1.0)), [0.25])

    def test_an_exchange_is_the_calls_that_it_stands_for(self):
        fused, unary = (self.drive(oscillator(instance=number)) for number in (5, 6))
        perturbed = [load(5.1)[0], constant(1, 0.02)]
        reply = fused.exchange(
            advance=pb.Advance(t=0.0, step=STEP, signals=load(4.0), samples=INSTANTS[:2]),
            evaluate=pb.Predict(t=STEP, signals=load(6.0), perturbed=perturbed, directions=perturbed),
            predict=pb.Predict(t=STEP, step=STEP, signals=load(5.0), perturbed=perturbed, directions=perturbed),
        )
        self.assertEqual((reply.instance, reply.sequence), (5, fused.sequence))
        start = unary.snapshot()
        for sample, found in zip(INSTANTS[:2], reply.samples, strict=True):
            self.assertEqual(unary.step(0.0, sample, *load(4.0), outputs=pb.OUTPUT_SET_ALL), found.values)
            unary.restore(start)
        self.assertEqual(unary.step(0.0, STEP, *load(4.0), outputs=pb.OUTPUT_SET_ALL), reply.advanced.values)
        evaluated = unary.evaluate("x", "v", signals=load(6.0), directions=perturbed)
        self.assertEqual(evaluated.outputs, reply.evaluated)
        self.assertEqual(list(evaluated.derivatives), list(reply.evaluated_derivatives))
        columns = unary.perturbed(STEP, STEP, load(5.0), perturbed=perturbed, directions=perturbed)
        self.assertEqual(list(columns.outputs), list(reply.perturbed))
        self.assertEqual(list(columns.derivatives), list(reply.derivatives))
        self.assertEqual(unary.step(STEP, STEP, *load(5.0)), reply.predicted.values)
        self.assertEqual((reply.work.integrations, reply.work.derivatives), (6, 2))
        self.assertGreater(reply.work.steps, 0)
        self.assertGreater(reply.work.nanoseconds, 0)
        empty = fused.exchange()
        self.assertFalse(any(empty.HasField(name) for name in ("advanced", "evaluated", "predicted")))

    def test_a_failure_while_looking_ahead_leaves_the_committed_state(self):
        driver = self.drive()
        inflow = [constant(0, 1.0), constant(1, 0.0)]
        driver.exchange(advance=pb.Advance(t=0.0, step=0.5, signals=inflow))
        for look in (
            pb.Predict(t=0.5, step=0.5, signals=FLOOD),
            pb.Predict(t=0.5, step=0.5, signals=inflow, perturbed=FLOOD[:1]),
        ):
            for go_back in (False, True):
                call = lambda look=look, go_back=go_back: driver.exchange(
                    advance=pb.Advance(t=0.5, step=0.5, signals=inflow), predict=look, go_back=go_back
                )
                failure = self.assert_refused(pb.SEVERITY_RECOVERABLE, call, "overflows")
                self.assertEqual((failure.t, failure.step), (1.0, 0.5))
                self.assertEqual(driver.level, START + 0.5)
        reply = driver.exchange(advance=pb.Advance(t=0.5, step=0.5, signals=inflow))
        self.assertEqual(reply.advanced.values[0], START + 1.0)

    def test_one_advance_is_taken_back_and_not_two(self):
        driver = self.drive()
        advance = pb.Advance(t=0.0, step=0.5, signals=[constant(0, 1.0), constant(1, 0.0)])
        back = lambda: driver.exchange(go_back=True)
        self.assert_misuse("go_back", back, "nothing to take back", "one advance", "not two")
        driver.exchange(advance=advance)
        driver.exchange(go_back=True, advance=advance)
        self.assertEqual(driver.level, START + 0.5)
        driver.exchange(go_back=True)
        self.assertEqual(driver.level, START)
        self.assert_misuse("go_back", back, "nothing to take back")
        driver.step(0.0, 0.5, *advance.signals)
        driver.exchange(go_back=True)
        start = driver.snapshot()
        driver.exchange(advance=advance)
        driver.restore(start)
        self.assert_misuse("go_back", back, "nothing to take back")

    def test_perturbed_steps_repeat_the_step_before_and_no_other(self):
        driver = self.drive(tank(coupling_outputs=["repeated"]))
        perturbed = [constant(0, 1.1), constant(1, 0.1)]
        inflow = [constant(0, 1.0)]
        reply = driver.exchange(predict=pb.Predict(t=0.0, step=0.5, signals=inflow, perturbed=perturbed))
        self.assertEqual([reply.predicted.values[0], *(one.values[0] for one in reply.perturbed)], [0.0, 1.0, 1.0])
        repeated = lambda step: [one.values[0] for one in driver.perturbed(0.0, step, inflow, perturbed=perturbed).outputs]
        self.assertEqual(repeated(0.25), [0.0, 1.0])
        self.assert_refused(pb.SEVERITY_RECOVERABLE, lambda: driver.step(0.0, 0.5, *FLOOD))
        self.assertEqual(repeated(0.5), [0.0, 1.0])

    def test_a_step_that_is_cut_goes_from_instant_to_instant(self):
        cut, parts = (self.drive(oscillator(instance=number, interior_outputs=["x"])) for number in (5, 6))
        inside, ends = [], [*INSTANTS, STEP]
        for start, end in zip([0.0, *INSTANTS], ends, strict=True):
            signals = load(4.0)
            signals[0].nodes[:] = [node - start for node in signals[0].nodes]
            reached = parts.step(start, end - start, *signals)
            inside.append(reached[0])
        advance = pb.Advance(t=0.0, step=STEP, signals=load(4.0), instants=INSTANTS)
        perturbed = [load(4.0)[0], load(5.0)[0]]
        look = pb.Predict(t=0.0, step=STEP, signals=load(4.0), perturbed=perturbed, instants=INSTANTS)
        predicted = cut.exchange(predict=look)
        self.assertEqual(list(predicted.predicted.values), [*reached, *inside[:-1]])
        self.assertEqual(predicted.perturbed[0], predicted.predicted)
        self.assertNotEqual(predicted.perturbed[1], predicted.predicted)
        self.assertEqual(predicted.work.integrations, 3)
        columns = cut.perturbed(0.0, STEP, load(4.0), perturbed=perturbed, instants=INSTANTS, directions=perturbed)
        self.assertEqual(list(columns.outputs), list(predicted.perturbed))
        self.assertEqual([len(one.values) for one in columns.derivatives], [5, 5])
        advanced = cut.exchange(advance=advance)
        self.assertEqual([*advanced.advanced.values[:2], *advanced.advanced.values[3:]], [*reached, *inside[:-1]])

    def test_instants_and_samples_outside_of_their_step_are_refused(self):
        driver = self.drive(oscillator(interior_outputs=["x"]))
        for offsets, place in (([0.0], 0), ([1e-4, STEP], 1), ([1e-4, 1e-4], 1), ([math.nan], 0)):
            look = pb.Predict(step=STEP, signals=load(4.0), instants=offsets)
            self.assert_misuse("instants", lambda look=look: driver.exchange(predict=look), f"instant {place}", STEP)
            advance = pb.Advance(step=STEP, signals=load(4.0), instants=offsets)
            self.assert_misuse("instants", lambda advance=advance: driver.exchange(advance=advance), f"instant {place}")
            advance = pb.Advance(step=STEP, signals=load(4.0), samples=offsets)
            call = lambda advance=advance: driver.exchange(advance=advance)
            self.assert_misuse("advance.samples", call, f"sample {place}", STEP)

    def test_derivatives_are_quotients_of_differences(self):
        driver = self.drive(oscillator(recorded_outputs=[], coupling_outputs=["x", "v", "a"]))
        direction, raised = through(0, (0.0, 1.0), (STEP, 2.0)), load(4.0)
        raised[0].values[:] = [own + 1e4 * (1.0 + node / STEP) for node, own in zip(*points(raised[0]), strict=True)]
        look = pb.Predict(step=STEP, signals=load(4.0), perturbed=raised[:1], directions=[direction])
        reply = driver.exchange(predict=look)
        for low, high, found in zip(
            reply.predicted.values, reply.perturbed[0].values, reply.derivatives[0].values, strict=True
        ):
            self.assertAlmostEqual(found / ((high - low) / 1e4), 1.0, delta=1e-9)
        wrong = pb.Predict(step=STEP, signals=load(4.0), directions=[constant(7, 1.0)])
        self.assert_misuse("directions", lambda: driver.exchange(predict=wrong), "input 7")

    def test_terminate_ends_an_instance_once_and_again(self):
        driver = self.drive()
        for _ in range(2):
            self.assertEqual(self.peer.call("Terminate", pb.TerminateRequest(instance=5)).instance, 5)
        self.assert_misuse("instance", lambda: driver.step(0.0, 0.3, *RAMP), "0x5")
        self.assert_misuse("instance", driver.exchange, "0x5")


def points(signal):
    return list(signal.nodes), list(signal.values)

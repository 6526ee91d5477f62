"""The fused macro step: its parts, failures in them, and steps that are cut."""

import math

from models import START
from peer import FLOOD, INSTANTS, STEP, WorkerTest, constant, load, oscillator, tank, through

from linchpin_worker._contract import worker_pb2 as pb


class Exchanging(WorkerTest):
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


def points(signal):
    return list(signal.nodes), list(signal.values)

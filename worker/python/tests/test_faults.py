"""What a master is told of a solver that fails, and that the instance goes on from where it was."""

import logging
import unittest

import models
from peer import Driver, Peer, PeerTest, constant, initialize, tank, through

from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.status import shortened

FATAL, RECOVERABLE = pb.SEVERITY_FATAL, pb.SEVERITY_RECOVERABLE


class Faults(PeerTest):
    @classmethod
    def setUpClass(cls):
        # What the solver raises is logged with its trace.
        logging.disable(logging.CRITICAL)
        cls.addClassCleanup(logging.disable, logging.NOTSET)

    def setUp(self):
        self.peer = Peer(self, classes=[models.Faulty])

    def drive(self, fault):
        parameters = {"fault": pb.Value(text=fault)}
        return Driver(self.peer, initialize(model="faulty", parameters=parameters, coupling_outputs=["x", "v"]))

    def end(self):
        self.peer.call("Terminate", pb.TerminateRequest(instance=5))

    def test_what_a_step_raises_has_its_severity(self):
        for fault, severity, words, t in (
            ("failed", RECOVERABLE, ["no convergence at t = 0.35 s"], 0.35),
            ("failed without time", RECOVERABLE, ["no convergence at t = 0.1 s"], 0.1),
            ("overflow", RECOVERABLE, ["OverflowError", "math range error"], 0.1),
            ("nan", RECOVERABLE, ["x = NaN at t = 0.6 s", "finite"], 0.6),
            ("error", FATAL, ["LookupError: no such element"], 0.1),
            ("silent error", FATAL, ["RuntimeError: no message"], 0.1),
            ("exit", FATAL, ["SystemExit: 3"], 0.1),
        ):
            with self.subTest(fault=fault):
                driver = self.drive(fault)
                failure = self.assert_refused(severity, lambda driver=driver: driver.step(0.1, 0.5), *words)
                self.assertEqual((failure.t, failure.step), (t, 0.5))
                look = {"predict": pb.Predict(t=0.1, step=0.5)}
                self.assert_refused(severity, lambda driver=driver, look=look: driver.exchange(**look), *words)
                # The step has changed the state before it failed.
                self.assertEqual(driver.values("x"), [0.0])
                self.end()

    def test_the_variable_that_is_not_finite_is_named(self):
        driver = self.drive("nan")
        self.assert_refused(RECOVERABLE, lambda: driver.step(0.1, 0.5), variable="x")
        driver = self.drive_again("infinite start")
        self.assert_refused(FATAL, lambda: driver.values("x"), "x = inf at t = 0 s", variable="x")
        # Only what is wanted is looked at.
        self.assertEqual(driver.values("v"), [1.0])

    def drive_again(self, fault):
        self.end()
        return self.drive(fault)

    def test_a_degree_that_the_solver_does_not_take_is_refused(self):
        parameters = {"fault": pb.Value(text="named")}
        driver = Driver(self.peer, initialize(model="faulty", parameters=parameters, inputs=["f"], coupling_outputs=["x"]))
        driver.step(0.0, 0.5, through(0, (0.0, 1.0), (0.5, 2.0)))
        parabola = through(0, (0.0, 1.0), (0.5, 2.0), (1.0, 0.0))
        self.assert_misuse("signals", lambda: driver.step(0.0, 0.5, parabola), '"f"', "degree 2", "1 at most")

    def test_outputs_are_as_many_as_described(self):
        for fault, words in (
            ("short", ["outputs gives 1 values; the model has 2 outputs: x, v"]),
            ("misnamed", ["outputs gives no value of v; given: x, w"]),
            ("text", ["ValueError", "fast"]),
        ):
            driver = self.drive(fault)
            self.assert_refused(FATAL, lambda driver=driver: driver.values("x", "v"), *words)
            self.end()
        self.assertEqual(self.drive("named").values("v", "x"), [1.0, 0.0])

    def test_an_instance_that_cannot_be_made(self):
        self.assert_refused(FATAL, lambda: self.drive("setup"), "KeyError: 'no geometry'")
        self.assert_refused(FATAL, lambda: self.drive("unsaved"), "pickle")
        self.assertEqual(len(self.peer.call("ListInstances", pb.ListInstancesRequest()).instances), 0)

    def test_a_state_that_cannot_be_loaded(self):
        driver = self.drive("lost")
        driver.exchange(predict=pb.Predict(t=0.0, step=0.5))
        self.assert_refused(FATAL, lambda: driver.values("x"), "the state is gone")

    def test_a_fault_is_that_of_its_instance_alone(self):
        driver, other = self.drive("error"), Driver(self.peer, tank(instance=6))
        self.assert_refused(FATAL, lambda: driver.step(0.0, 0.5))
        self.assertEqual(other.step(0.0, 0.5, constant(0, 1.0), constant(1, 0.0))[0], models.START + 0.5)


class LongMessages(unittest.TestCase):
    def test_they_say_how_much_is_missing(self):
        self.assertEqual(shortened("short", 2048), "short")
        found = shortened("\u00e9" * 5000, 2048)
        self.assertTrue(found.endswith("(7952 more bytes)") and len(found.encode()) < 2100, found)

"""Exudyn as a worker: against differences, and bit by bit."""

import unittest

from solvers import assert_rates, example, inputs, made, needed

from linchpin_worker.encoding import decode, encode

BODY = {"m": 0.8, "j1": 0.008, "j2": 0.02, "j3": 0.025, "end_x": 0.2, "start_y": 0.1}
MOTION = {"x0": 0.3, "vy0": -1.0, "omega1_0": 1.0, "omega2_0": -2.0, "omega3_0": 3.0}
LOAD = {"end_fx": (0.3, 0.3), "end_fz": (-0.7, -0.7), "end_moment_x": (0.01, 0.01), "start_fy": (1.0, 1.0)}


@needed("exudyn")
class Model(unittest.TestCase):
    """A model without a server."""

    def setUp(self):
        self.model = example("exudyn", "exudyn_worker").Body

    def test_velocities_and_accelerations_are_those_of_the_positions(self):
        for marker in ("start", "end"):
            assert_rates(self, self.model, marker, LOAD, **BODY, **MOTION)

    def test_a_state_that_is_loaded_gives_the_same_bits(self):
        body = made(self.model, **BODY, **MOTION)
        load = inputs(self.model, 0.02, end_fx=(5.0, 9.0), start_moment_x=(-0.2, 0.1))
        for step in range(20):
            body.advance(0.02 * step, 0.02, load)
        kept, expected = body.save(), []
        for step in range(20, 30):
            body.advance(0.02 * step, 0.02, load)
            expected.append(body.outputs(0.02 * (step + 1), load.at_end))
        # Also in an instance that has gone another way; what Exudyn keeps is the motion from the position at the start.
        for other in (body, made(self.model, **BODY, **MOTION)):
            other.advance(0.0, 0.05, inputs(self.model, 0.05))
            other.load(decode(encode(kept)))
            for step, row in zip(range(20, 30), expected, strict=True):
                other.advance(0.02 * step, 0.02, load)
                self.assertEqual(other.outputs(0.02 * (step + 1), load.at_end), row)

    def test_it_has_the_order_of_its_solver(self):
        """One spin of a free body, with steps of twice the length."""
        spin = {**BODY, **MOTION, "gravity": 0.0}
        fine = self.end(5e-4, spin)
        errors = [max(abs(a - b) for a, b in zip(self.end(dt, spin), fine, strict=True)) for dt in (0.04, 0.02, 0.01)]
        # RK67 is the default; its order is 6.
        self.assertGreater(errors[0] / errors[1], 2**5)
        self.assertLess(errors[2], 1e-9)

    def end(self, dt, parameters):
        body = made(self.model, **parameters)
        body.dt = dt
        body.advance(0.0, 0.4, inputs(self.model, 0.4))
        return body.outputs(0.4, inputs(self.model, 0.4).at_end)


if __name__ == "__main__":
    unittest.main()

"""A beam of scikit-fem as a worker: against the formulas of beams, and bit by bit."""

import math
import unittest

from solvers import example, inputs, made, needed

from linchpin_worker import Refused
from linchpin_worker.encoding import decode, encode

BEAM = {"length": 0.7, "radius": 0.01, "elasticity": 3e9, "density": 1200.0}
STIFFNESS = 3e9 * math.pi * 0.01**4 / 4
MASS = 1200.0 * math.pi * 0.01**2
"""Of a meter."""


@needed("skfem")
class Model(unittest.TestCase):
    """A model without a server."""

    def setUp(self):
        self.model = example("scikit_fem", "beam_worker").WallBeam

    def test_at_rest_it_hangs_as_a_beam_does(self):
        load = inputs(self.model, 1.0, tip_fy=(0.3, 0.3))
        beam = made(self.model, **BEAM, damping=1.0, modes=8.0)
        for second in range(5):
            beam.advance(second, 1.0, load)
        _, y, z, *rates = beam.outputs(5.0, load.at_end)
        self.assertAlmostEqual(y / (0.3 * 0.7**3 / (3 * STIFFNESS)), 1.0, delta=1e-3)
        self.assertAlmostEqual(z / (-9.81 * MASS * 0.7**4 / (8 * STIFFNESS)), 1.0, delta=1e-3)
        self.assertLess(max(map(abs, rates)), 1e-9)

    def test_its_period_is_that_of_a_beam(self):
        beam = made(self.model, **BEAM, gravity=0.0)
        period = 2 * math.pi / (1.87510406871**2 * math.sqrt(STIFFNESS / (MASS * 0.7**4)))
        beam.state[0] = [0.01, -0.02]
        start = beam.outputs(0.0, inputs(self.model, period).at_end)
        beam.advance(0.0, period, inputs(self.model, period))
        end = beam.outputs(period, inputs(self.model, period).at_end)
        for name, a, b in zip("xyz", start, end, strict=False):
            self.assertAlmostEqual(a, b, delta=1e-4 * abs(a), msg=name)

    def test_velocity_and_acceleration_are_those_of_the_position(self):
        h, rows = 1e-4, []
        load = inputs(self.model, h, tip_fy=(0.7, 0.7), tip_fz=(-0.2, -0.2))
        beam = made(self.model, **BEAM)
        beam.advance(0.0, 0.1, inputs(self.model, 0.1, tip_fy=(0.0, 2.0)))
        for _ in range(3):
            rows.append(beam.outputs(0.0, load.at_end))
            beam.advance(0.0, h, load)
        for place in range(6):
            rate = rows[1][place + 3]
            self.assertAlmostEqual((rows[2][place] - rows[0][place]) / (2 * h), rate, delta=1e-3 * max(1.0, abs(rate)))

    def test_a_state_that_is_loaded_gives_the_same_bits(self):
        load = inputs(self.model, 0.02, tip_fy=(1.0, -3.0))
        beam = made(self.model, **BEAM)
        beam.advance(0.0, 0.02, load)
        kept, expected = beam.save(), None
        for other in (beam, beam, made(self.model, **BEAM)):
            other.load(decode(encode(kept)))
            other.advance(0.02, 0.02, load)
            expected = expected or other.outputs(0.04, load.at_end)
            self.assertEqual(other.outputs(0.04, load.at_end), expected)

    def test_more_modes_than_there_are_are_refused(self):
        with self.assertRaisesRegex(Refused, "parameters.modes = 5 is more than the 4 that 2 elements have"):
            made(self.model, **BEAM, elements=2.0, modes=5.0)


if __name__ == "__main__":
    unittest.main()

"""Inputs over a step, and how it is divided."""

import unittest

from linchpin_worker import Inputs, Polynomial, equal_parts
from linchpin_worker.inputs import values_type

NAMES = ["f", "a-b"]


def inputs():
    ramp = Polynomial.through([0.0, 0.5], [1.0, 3.0])
    return Inputs([ramp, Polynomial.constant(7.0)], 0.5, values_type(NAMES, 0, ()), NAMES)


class Parts(unittest.TestCase):
    def test_a_step_has_the_fewest_equal_parts_that_are_short_enough(self):
        for step, dt, count in (
            (1.0, 1.0, 1),
            (1.0, 0.3, 4),
            (1e-3, 1e-4, 10),
            (0.3, 0.1, 3),
            (0.7 * 3.0, 0.7, 3),
            (1e-5, 1.0, 1),
        ):
            parts = list(equal_parts(step, dt))
            self.assertEqual(len(parts), count, (step, dt))
            self.assertEqual(parts[0], (0.0, step / count))
            start, length = parts[-1]
            self.assertAlmostEqual(start + length, step, delta=1e-15)

    def test_lengths_that_are_none_are_refused(self):
        for step, dt in ((0.0, 1.0), (1.0, 0.0), (-1.0, 1.0), (1.0, float("nan")), (float("inf"), 1.0), (1.0, 5e-324)):
            with self.assertRaisesRegex(ValueError, "greater than 0"):
                list(equal_parts(step, dt))


class Values(unittest.TestCase):
    def test_they_are_reached_by_name_by_place_and_unpacked(self):
        u = inputs()(0.25)
        self.assertEqual((u.f, u[0], u[1], len(u)), (2.0, 2.0, 7.0, 2))
        self.assertEqual([*u], [2.0, 7.0])

    def test_start_and_end_are_those_of_the_step(self):
        u = inputs()
        self.assertEqual((u.step, u.at_start.f, u.at_end.f), (0.5, 1.0, 3.0))

    def test_an_input_is_also_a_polynomial(self):
        self.assertEqual(inputs().polynomial("f").powers(0.5), [1.0, 2.0])
        with self.assertRaisesRegex(KeyError, 'no input \\\\"g\\\\"; there are: f, a-b|no input "g"; there are: f, a-b'):
            inputs().polynomial("g")

    def test_stages_are_inside_their_parts(self):
        stages = [(tau, h, [u.f for u in sampled]) for tau, h, sampled in inputs().stages(0.25)]
        self.assertEqual(stages, [(0.0, 0.25, [1.0, 1.5, 2.0]), (0.25, 0.25, [2.0, 2.5, 3.0])])
        ((_, _, sampled),) = inputs().stages(1.0, nodes=[0.4])
        self.assertAlmostEqual(sampled[0].f, 1.8)

    def test_without_joint_loads_nothing_is_added(self):
        u = inputs().at_end
        self.assertIs(u.with_joint_loads({}), u)

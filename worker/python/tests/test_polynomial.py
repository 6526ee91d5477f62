"""Polynomials, on the numbers of proto/src/polynomial.rs."""

import math
import unittest

from linchpin_worker import Polynomial


def cubic(t):
    return 2.0 - 3.0 * t + 0.5 * t * t + 4.0 * t * t * t


class Polynomials(unittest.TestCase):
    def test_a_cubic_is_reproduced_by_four_nodes(self):
        nodes = [0.3, 0.0, -0.3, -0.7]
        polynomial = Polynomial.through(nodes, list(map(cubic, nodes)))
        for tau in (-1.0, 0.1, 0.9, 2.5):
            self.assertAlmostEqual(polynomial(tau), cubic(tau), delta=1e-12)
        self.assertEqual(polynomial.degree, 3)
        expected = [2.0, -3.0 * 0.2, 0.5 * 0.04, 4.0 * 0.008]
        for power, own in zip(polynomial.powers(0.2), expected, strict=True):
            self.assertAlmostEqual(power, own, delta=1e-13)

    def test_shifted_it_is_the_same_with_another_start(self):
        nodes = [0.3, 0.0, -0.3, -0.7]
        shifted = Polynomial.through(nodes, list(map(cubic, nodes))).shifted(0.17)
        for tau in (-1.0, 0.0, 0.4):
            self.assertAlmostEqual(shifted(tau), cubic(0.17 + tau), delta=1e-12)

    def test_powers_and_newton_form_agree_for_every_degree(self):
        for count in range(1, 9):
            nodes = [0.01 * (1.0 - number) for number in range(count)]
            polynomial = Polynomial.through(nodes, [math.cos(3.0 * number) for number in range(count)])
            for s in (0.0, 0.3, 1.0):
                value = sum(power * s**n for n, power in enumerate(polynomial.powers(0.01)))
                self.assertAlmostEqual(value, polynomial(0.01 * s), delta=1e-9)

    def test_a_constant_is_the_same_everywhere(self):
        constant = Polynomial.constant(2.5)
        self.assertEqual((constant(0.0), constant(7.0), constant.powers(3.0), constant.degree), (2.5, 2.5, [2.5], 0))

    def test_every_wrong_set_of_points_has_its_error(self):
        for nodes, values, words in (
            ([], [], "at least one node"),
            ([0.0], [], "1 nodes but 0 values"),
            ([0.0] * 9, [0.0] * 9, "9 nodes, at most 8"),
            ([0.0, 1.0], [0.0, math.nan], "node or value 1 is not a finite number"),
            ([0.0, math.inf], [0.0, 1.0], "node or value 1 is not a finite number"),
            ([0.0, 1.0, 0.0], [0.0] * 3, "nodes 0 and 2 coincide"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                Polynomial.through(nodes, values)

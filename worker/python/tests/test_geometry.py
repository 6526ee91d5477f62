"""Rotations and wrenches."""

import itertools
import math
import unittest

from linchpin_worker import moment_about, quaternion_of_matrix, wrench_about
from linchpin_worker.geometry import cross, matrix_of_quaternion, matrix_of_rotation_vector, product, turned


class Rotations(unittest.TestCase):
    def test_quaternions_and_matrices_are_each_others_inverse(self):
        # Angles up to a half turn about axes in all directions, so that every part is the largest somewhere.
        for axis in itertools.product((-1.0, -0.2, 0.0, 0.7), repeat=3):
            for angle in (0.0, 1e-9, 1.0, math.pi - 1e-7, math.pi, 3.0 * math.pi / 2.0):
                length = math.hypot(*axis)
                if length == 0.0:
                    continue
                sine = math.sin(0.5 * angle) / length
                expected = [math.cos(0.5 * angle), *(sine * part for part in axis)]
                found = quaternion_of_matrix(matrix_of_quaternion(expected))
                self.assertGreaterEqual(found[0], 0.0)
                self.assertAlmostEqual(math.hypot(*found), 1.0, delta=1e-15)
                sign = math.copysign(1.0, sum(a * b for a, b in zip(found, expected, strict=True)))
                for own, other in zip(found, expected, strict=True):
                    self.assertAlmostEqual(own, sign * other, delta=1e-14)

    def test_the_convention_is_from_body_to_space_and_the_real_part_first(self):
        # A quarter turn about z takes the body's x axis to the y axis of space.
        quarter = matrix_of_quaternion((math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)))
        for found, expected in zip(turned(quarter, (1.0, 0.0, 0.0)), (0.0, 1.0, 0.0), strict=True):
            self.assertAlmostEqual(found, expected, delta=1e-15)
        self.assertEqual(quaternion_of_matrix(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))), (1.0, 0.0, 0.0, 0.0))

    def test_the_length_of_a_quaternion_does_not_count(self):
        self.assertEqual(matrix_of_quaternion((2.0, 0.0, 2.0, 0.0)), matrix_of_quaternion((1.0, 0.0, 1.0, 0.0)))

    def test_a_rotation_vector_turns_about_itself_by_its_length(self):
        vector = (0.3, -0.5, 0.9)
        rotation = matrix_of_rotation_vector(vector)
        for found, expected in zip(turned(rotation, vector), vector, strict=True):
            self.assertAlmostEqual(found, expected, delta=1e-15)
        self.assertEqual(matrix_of_rotation_vector((0.0, 0.0, 0.0)), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
        twice = product(rotation, rotation)
        for found, expected in zip(twice, matrix_of_rotation_vector([2.0 * part for part in vector]), strict=True):
            for own, other in zip(found, expected, strict=True):
                self.assertAlmostEqual(own, other, delta=1e-15)


class Wrenches(unittest.TestCase):
    def test_the_moment_about_the_centre_has_that_of_the_force(self):
        centre, point, force, moment = (1.0, 2.0, 3.0), (1.5, 2.0, 2.0), (0.0, 4.0, 1.0), (0.1, 0.2, 0.3)
        found = wrench_about(centre, point, force, moment)
        # Arm (0.5, 0, -1): the cross product with (0, 4, 1) is (4, -0.5, 2).
        self.assertEqual(found, (force, (0.1 + 4.0, 0.2 - 0.5, 0.3 + 2.0)))

    def test_in_the_plane_it_is_the_third_component(self):
        in_plane = moment_about((0.2, -0.3), (1.0, 0.9), (3.0, -2.0), 0.5)
        _, in_space = wrench_about((0.2, -0.3, 0.0), (1.0, 0.9, 0.0), (3.0, -2.0, 0.0), (0.0, 0.0, 0.5))
        self.assertAlmostEqual(in_plane, in_space[2], delta=1e-15)

    def test_the_power_is_the_same_about_every_point(self):
        # Of a body that moves by v + omega x r.
        velocity, omega = (0.3, -0.2, 0.9), (1.1, 0.4, -0.6)
        centre, point, force, moment = (0.2, 0.1, -0.4), (1.0, -0.7, 0.5), (2.0, -3.0, 1.5), (0.4, 0.8, -0.2)
        arm = [p - c for p, c in zip(point, centre, strict=True)]
        at_point = [v + w for v, w in zip(velocity, cross(omega, arm), strict=True)]
        power = lambda f, m, v: sum(a * b for a, b in zip((*f, *m), (*v, *omega), strict=True))
        self.assertAlmostEqual(
            power(force, moment, at_point), power(*wrench_about(centre, point, force, moment), velocity), delta=1e-14
        )

"""The step of `oscillator_worker.py` against the closed form in 50 digits."""

import itertools
import math
import unittest

import mpmath
from linchpin.v1 import worker_pb2 as pb
from oscillator_worker import Oscillator, Refused

mpmath.mp.dps = 50
START = (0.37, -2.9)


def end(m, c, d, step, nodes, values):
    """Position and velocity at the end of a step from START."""
    numbers = {"m": m, "c": c, "d": d, "x0": START[0], "v0": START[1]}
    parameters = {name: pb.Value(number=number) for name, number in numbers.items()}
    oscillator = Oscillator(pb.InitializeRequest(parameters=parameters, inputs=["f"]))
    return oscillator.end(step, [pb.Signal(nodes=nodes, values=values)])[:2]


def closed_form(m, c, d, x0, v0, nodes, values, t):
    """x and v at t: the polynomial particular solution and the homogeneous one through complex roots (c > 0)."""
    m, c, d, t = map(mpmath.mpf, (m, c, d, t))
    vandermonde = mpmath.matrix([[mpmath.mpf(node) ** power for power in range(len(nodes))] for node in nodes])
    force = list(mpmath.lu_solve(vandermonde, mpmath.matrix(values)))
    # Comparison of powers in m p'' + d p' + c p = f, from the highest down.
    particular = [mpmath.mpf(0)] * (len(force) + 2)
    for j in reversed(range(len(force))):
        higher = m * (j + 2) * (j + 1) * particular[j + 2] + d * (j + 1) * particular[j + 1]
        particular[j] = (force[j] - higher) / c
    root = mpmath.sqrt(d * d - 4 * m * c)
    first, second = (-d + root) / (2 * m), (-d - root) / (2 * m)
    x_start, v_start = x0 - particular[0], v0 - particular[1]
    one = (v_start - second * x_start) / (first - second)
    other = x_start - one
    x = one * mpmath.exp(first * t) + other * mpmath.exp(second * t)
    v = one * first * mpmath.exp(first * t) + other * second * mpmath.exp(second * t)
    x += sum(a * t**j for j, a in enumerate(particular))
    v += sum(j * a * t ** (j - 1) for j, a in enumerate(particular) if j > 0)
    return mpmath.re(x), mpmath.re(v)


class ExactStep(unittest.TestCase):
    def assert_matches(self, m, c, d, step, nodes, values, allowed):
        x, v = end(m, c, d, step, nodes, values)
        true_x, true_v = closed_form(m, c, d, *START, nodes, values, step)
        amplitude = math.hypot(true_x, true_v / math.sqrt(c / m))
        for got, true, scale in ((x, true_x, amplitude), (v, true_v, amplitude * math.sqrt(c / m))):
            error = float(abs(got - true)) / max(abs(float(true)), scale)
            self.assertLessEqual(error, allowed, f"m={m} c={c} d={d} H={step} nodes={nodes}: {got} for {true}")

    def test_every_degree_stiffness_and_step(self):
        values = [41.3, -17.9, 230.7, 8.81]
        for step, c, d, degree in itertools.product(
            (1e-5, 3.3e-4, 1e-3, 1e-2), (1e2, 1.7e3, 1e6), (0.0, 10.3, 170.0), range(4)
        ):
            nodes = [step, 0.0, -0.7 * step, -1.9 * step][: degree + 1]
            with self.subTest(step=step, c=c, d=d, degree=degree):
                self.assert_matches(1.3, c, d, step, nodes, values[: degree + 1], 1e-14)

    def test_overdamped(self):
        self.assert_matches(0.7, 90.0, 4000.0, 7e-3, [7e-3, 0.0], [3.0, -11.0], 1e-14)

    def test_free_mass_under_constant_force(self):
        step, force, m = 0.031, 5.3, 2.9
        x, v = end(m, 0.0, 0.0, step, [0.0], [force])
        self.assertAlmostEqual(v, START[1] + force / m * step, delta=1e-15)
        self.assertAlmostEqual(x, START[0] + START[1] * step + force / m * step**2 / 2, delta=1e-16)

    def test_what_is_out_of_range(self):
        good = {"m": 1.0, "c": 1.0, "d": 0.0, "step": 1.0, "nodes": [0.0], "values": [1.0]}
        end(**good)
        for wrong in (
            {"m": 0.0},
            {"m": math.inf},
            {"c": -1.0},
            {"d": -0.1},
            {"c": 1e12},
            {"step": 0.0},
            {"step": math.inf},
            {"step": math.nan},
            {"nodes": [], "values": []},
            {"nodes": [0.0, 0.0], "values": [1.0, 2.0]},
            {"nodes": [0.0, 1.0], "values": [1.0]},
            {"values": [math.nan]},
            {"nodes": list(range(9)), "values": [0.0] * 9},
        ):
            with self.subTest(wrong=wrong), self.assertRaises(Refused):
                end(**{**good, **wrong})


if __name__ == "__main__":
    unittest.main()

"""Integrals of outputs over a step: their weights, what helps to find them, and what a master is told of them."""

import itertools
import math
import unittest

from peer import Driver, Peer, WorkerTest, initialize, number

from linchpin_worker import Description, Parameter, Subsystem, Variable
from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.integrals import Integrals, add_part, gauss, legendre

STEP, COUNT = 0.3, 5


def of_power(power, degree):
    """`integral of s^power L_i ds` over the step in closed form."""
    above = math.prod(power - k for k in range(degree))
    return above / math.prod(power + 1 + k for k in range(degree + 1))


class Wave(Subsystem):
    """`x = sin w t` by the classical Runge-Kutta method; `way` says how integrals are found, `parts` by how many steps."""

    description = Description(
        "wave",
        outputs=[Variable("v", "m/s"), Variable("x", "m")],
        parameters=[Parameter("w", "1/s"), Parameter("parts"), Parameter("way", kind=str)],
        output_integrals=True,
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        (self.w, self.parts), self.way = setup.numbers("w", "parts"), setup.parameters["way"]
        self.x, self.v = 0.0, self.w

    def advance(self, t, step, u):
        h = step / self.parts
        for part in range(int(self.parts)):
            tau, (x, v), stages = part * h, (self.x, self.v), []
            for share in (0.0, h / 2, h / 2, h):
                rates = stages[-1] if stages else (0.0, 0.0)
                state = (x + share * rates[0], v + share * rates[1])
                stages.append((state[1], -(self.w**2) * state[0]))
                if self.way in ("stages", "named"):
                    told = {"x": state[0], "v": state[1]} if self.way == "named" else (state[1], state[0])
                    self.integrals.add(tau + share, h / 6 if share in (0.0, h) else h / 3, told)
            self.x, self.v = (
                start + h / 6 * (a + 2 * b + 2 * c + d)
                for start, (a, b, c, d) in zip((x, v), zip(*stages, strict=True), strict=True)
            )
            if self.way == "along":
                start = (x, v), (v, -(self.w**2) * x)
                self.integrals.add_along(tau, h, 4, lambda sigma, start=start: self.cubic(sigma, h, *start))
        if self.way in ("short", "nan", "text"):
            values = [0.0] * len(self.integrals)
            self.integrals.set({"short": values[1:], "nan": [*values[1:], math.nan], "text": ["much", *values[1:]]}[self.way])

    def cubic(self, sigma, h, start, rates):
        """Hermite's interpolation of each variable between both ends of an internal step."""
        s, end, end_rates = sigma / h, (self.x, self.v), (self.v, -(self.w**2) * self.x)
        x, v = (
            (1 + 2 * s) * (1 - s) ** 2 * a + s * (1 - s) ** 2 * h * ra + s * s * (3 - 2 * s) * b + s * s * (s - 1) * h * rb
            for a, ra, b, rb in zip(start, rates, end, end_rates, strict=True)
        )
        return v, x

    def outputs(self, t, u):
        return self.v, self.x

    def save(self):
        return self.x, self.v

    def load(self, state):
        self.x, self.v = state


W = 7.0


def wave(way="stages", parts=8, **fields):
    parameters = {"w": number(W), "parts": number(parts), "way": pb.Value(text=way)}
    fields = {"coupling_outputs": ["x"], "integrated_outputs": ["x", "v"], **fields}
    return initialize(model="wave", parameters=parameters, **fields)


def exact(start):
    """Integrals of `sin w t` and `w cos w t` over the step from `start`, by Gauss's formula on the closed form."""
    values = [0.0] * (2 * COUNT)
    for node, weight in gauss(20):
        t = start + node * STEP
        for degree, polynomial in enumerate(legendre(node, COUNT)):
            values[2 * degree] += weight * polynomial * math.sin(W * t)
            values[2 * degree + 1] += weight * polynomial * W * math.cos(W * t)
    return values


class Weights(unittest.TestCase):
    def test_they_are_legendres_polynomials(self):
        for s in (0.0, 0.13, 0.5, 1.0):
            expected = (1.0, 2 * s - 1, 6 * s * s - 6 * s + 1, ((20 * s - 30) * s + 12) * s - 1)
            for found, value in zip(legendre(s, 4), expected, strict=True):
                self.assertAlmostEqual(found, value, delta=1e-14)

    def test_gauss_integrates_polynomials_of_twice_its_points(self):
        for points in range(1, 17):
            for degree in range(2 * points):
                found = sum(weight * node**degree for node, weight in gauss(points))
                self.assertAlmostEqual(found * (degree + 1), 1.0, delta=1e-13)

    def test_polynomials_are_integrated_to_rounding(self):
        for power in range(9):
            own = Integrals(["y"], [0])
            own.choose(COUNT)
            own.begin(STEP)
            for part, share in enumerate((0.3, 0.7)):
                start = part * 0.3 * STEP
                own.add_along(start, share * STEP, power, lambda sigma, s=start, n=power: [((s + sigma) / STEP) ** n])
            for degree, found in enumerate(own.told()):
                self.assertAlmostEqual(found, of_power(power, degree), delta=1e-15)

    def test_parts_add_up_to_the_whole(self):
        for cuts in ((0.0, 1.0), (0.0, 0.37, 1.0), (0.0, 1e-3, 0.2, 0.71, 1.0)):
            for power in range(9):
                whole = [0.0] * 16
                for start, end in itertools.pairwise(cuts):
                    length, terms = end - start, range(power + 1)
                    binomial = [math.comb(power, k) * start ** (power - k) * length**k for k in terms]
                    part = [sum(binomial[k] * of_power(k, degree) for k in terms) for degree in range(8)]
                    add_part(start, end, [value for own in part for value in (own, 3.0 * own)], whole, 2)
                for place, found in enumerate(whole):
                    self.assertAlmostEqual(found, (1.0, 3.0)[place % 2] * of_power(power, place // 2), delta=1e-13)


class Telling(WorkerTest):
    def setUp(self):
        self.peer = Peer(self, classes=[Wave])
        self.instances = 5

    def driver(self, *arguments, **fields):
        self.instances += 1
        return Driver(self.peer, wave(*arguments, instance=self.instances, **fields))

    def error(self, way, parts):
        found = self.driver(way, parts).step(0.0, STEP, integrals=COUNT)[1:]
        self.assertEqual(len(found), 2 * COUNT)
        return max(abs(a - b) for a, b in zip(found, exact(0.0), strict=True))

    def test_integrals_have_the_order_of_the_method(self):
        """That of the classical method is 4, and so is that of integrals along Hermite's interpolation."""
        for way in ("stages", "named", "along"):
            with self.subTest(way=way):
                coarse, fine = self.error(way, 16), self.error(way, 32)
                self.assertLess(fine, 2e-5)
                self.assertAlmostEqual(math.log2(coarse / fine), 4.0, delta=0.3)

    def test_they_begin_anew_with_every_step_and_belong_to_no_state(self):
        driver, other = self.driver(), self.driver()
        start, state = driver.snapshot(), driver.export()
        first = driver.step(0.0, STEP, integrals=COUNT)
        second = driver.step(STEP, STEP, integrals=COUNT)
        for found, expected in zip(second[1:], exact(STEP), strict=True):
            self.assertAlmostEqual(found, expected, delta=5e-2)
        driver.restore(start)
        self.assertEqual(driver.step(0.0, STEP, integrals=2), first[:5])
        driver.restore(start)
        self.assertEqual(driver.step(0.0, STEP), first[:1])
        other.step(0.0, STEP, integrals=3)
        other.take_exported(state)
        self.assertEqual(other.step(0.0, STEP, integrals=COUNT), first)

    def test_samples_have_none_and_leave_those_of_the_advance(self):
        plain = self.driver().exchange(advance=pb.Advance(step=STEP, integrals=2)).advanced
        reply = self.driver().exchange(advance=pb.Advance(step=STEP, integrals=2, samples=[0.5 * STEP]))
        self.assertEqual(reply.advanced, plain)
        self.assertEqual(len(reply.samples[0].values), 1)

    def test_what_a_step_tells_is_checked(self):
        for way, severity, words in (
            ("nothing", pb.SEVERITY_FATAL, ["told 0 integrals", "4 are asked for", "integrals.set"]),
            ("short", pb.SEVERITY_FATAL, ["told 3 integrals", "4 are asked for"]),
            ("text", pb.SEVERITY_FATAL, ["ValueError"]),
            ("nan", pb.SEVERITY_RECOVERABLE, ["an integral of v = NaN", "finite"]),
        ):
            with self.subTest(way=way):
                driver = self.driver(way)
                call = lambda driver=driver: driver.step(0.0, STEP, integrals=2)
                failure = self.assert_refused(severity, call, *words)
                self.assertEqual(failure.step, STEP)
                self.assertEqual(failure.variable, "v" if way == "nan" else "")
                self.assertEqual(driver.values("x"), [0.0])

"""Every worker of the examples does what the contract and mechanics ask of it, in this process and in a second one."""

import unittest

from linchpin import EXAMPLES, linchpin

OSCILLATOR = ("m=2", "c=1000", "d=10", "v0=1")
LINK = ("m=1.0", "inertia=0.083", "length=1.0", "angle0=-1.0")


class Conformance(unittest.TestCase):
    def assert_conforms(self, worker, parameters, *checks):
        given = [word for parameter in parameters for word in ("-p", parameter)]
        # With shorter macro steps a Runge-Kutta method warns of integrals under the highest weights.
        told = linchpin("conformance", "--step", "5e-3", *given, "--", "python3", worker, folder=EXAMPLES)
        self.assertIn(" 0 with a warning, 0 failed", told)
        for check in ("replay", "exported-states", *checks):
            self.assertRegex(told, rf"pass +{check} ")
        self.assertNotIn("not in another process", told)

    def test_examples(self):
        self.assert_conforms("oscillator.py", OSCILLATOR)
        self.assert_conforms("planar_rod.py", LINK, "integrals")
        self.assert_conforms("scipy_pendulum.py", LINK, "integrals")


if __name__ == "__main__":
    unittest.main()

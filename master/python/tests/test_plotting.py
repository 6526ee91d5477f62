"""Curves."""

import subprocess
import sys
import unittest

import matplotlib
from scenes import OSCILLATOR, PACKAGE, PROGRAM, two_cases

import linchpin_cosim as lc

matplotlib.use("Agg")


class Plot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = lc.run(OSCILLATOR, in_process=True, program=PROGRAM)

    def panels(self, variables=None):
        axes = lc.plot(self.run_, variables)
        self.addCleanup(matplotlib.pyplot.close, axes[0].figure)
        return [(own.get_ylabel(), [line.get_label() for line in own.get_lines()]) for own in axes]

    def test_a_panel_for_every_unit(self):
        panels = [("m", ["mass1.x", "mass2.x"]), ("m/s", ["mass1.v", "mass2.v"]), ("N", ["link.lambda"])]
        self.assertEqual(self.panels(), panels)

    def test_names_and_patterns(self):
        expected = [("m", ["mass2.x", "link.residual.position"]), ("m/s", ["mass2.v"])]
        self.assertEqual(self.panels(["mass2.*", "link.residual.position", "mass2.x"]), expected)
        self.assertEqual(self.panels("link.lambda"), [("N", ["link.lambda"])])
        (axes,) = lc.plot(self.run_, "mass1.x")
        self.assertEqual(list(axes.get_lines()[0].get_ydata()), list(self.run_.results["mass1.x"]))

    def test_what_is_not_there(self):
        with self.assertRaisesRegex(ValueError, 'no column of oscillator matches "mass3.*"; there are: mass1.x, '):
            lc.plot(self.run_, "mass3.*")
        with two_cases() as scene, self.assertRaises(lc.RunFailed) as caught:
            lc.run(scene, in_process=True, program=PROGRAM)
        with self.assertRaisesRegex(ValueError, "has cases; draw one of run.cases: sound, wild"):
            lc.plot(caught.exception.run)

    def test_without_matplotlib_the_package_serves_and_tells_what_to_install(self):
        program = (
            "import sys; sys.modules['matplotlib'] = None\n"
            f"import linchpin_cosim as lc; run = lc.run({str(OSCILLATOR)!r}, in_process=True, program={str(PROGRAM)!r})\n"
            "try: lc.plot(run)\nexcept ImportError as error: print(error)"
        )
        done = subprocess.run(
            [sys.executable, "-c", program], env={"PYTHONPATH": str(PACKAGE / "src")}, capture_output=True, text=True
        )
        self.assertIn("pip install 'linchpin-cosim[plot]'", done.stdout, done.stderr)


if __name__ == "__main__":
    unittest.main()

"""Workers in Python coupled with built-in ones, against built-in ones alone."""

import itertools
import pathlib
import unittest

from linchpin import EXAMPLES, columns, difference

BUILT_IN = [(r'^command = .*oscillator.py"\]', 'model = "oscillator"')]
LINKS_BUILT_IN = [(r'^command = .*pendulum.py"\]', 'model = "pendulum"'), (r'^command = .*rod.py"\]', 'model = "planar-body"')]
TOP_BUILT_IN = [(r'^command = .*top.py"\]', 'model = "spatial-body"\nsolver = { kind = "radau5", rtol = 1e-10, atol = 1e-10 }')]
METHODS = (
    ["coupling.method=weighted", "coupling.macro_step=1e-3", "coupling.degree=1", "coupling.index=1"],
    ["coupling.method=hermite", "coupling.degree=2"],
    ["coupling.method=hermite", "coupling.degree=3"],
    ["coupling.method=hermite", "coupling.degree=4"],
)


class Runs(unittest.TestCase):
    def assert_near(self, found, expected, *limits):
        """Columns that begin or end with a word differ by its limit at most; the last limit is that of all others."""
        *named, rest = limits
        for name, own in found.items():
            if ".residual." in name or name == "error_estimate":
                continue
            limit = next((limit for end, limit in named if name.endswith(end)), rest)
            with self.subTest(column=name):
                self.assertLess(difference(own, expected[name]), limit)

    def test_a_mass_in_python_is_the_built_in_mass(self):
        for settings in METHODS:
            with self.subTest(settings=settings):
                found, expected = columns("oscillator.toml", settings), columns("oscillator.toml", settings, BUILT_IN)
                # The multiplier closes the gap of positions: their differences reach it and accelerations over H^2.
                self.assert_near(found, expected, (".lambda", 1e-8), (".a", 1e-8), 1e-9)
                self.assertEqual(columns("oscillator.toml", settings), found, "a second run has other bits")

    def test_integrals_of_a_mass_in_python_are_those_of_the_built_in_mass(self):
        """Both solve exactly, so only rounding tells them apart; instants in their place make another run."""
        integrating = [(r'^command = .*oscillator.py"\]', 'command = ["python3", "../tests/models.py"]\nmodel = "oscillator"')]
        for degree in (3, 4, 5):
            settings = [f"coupling.degree={degree}", 'coupling.moments="integrals"']
            with self.subTest(degree=degree):
                found = columns("oscillator.toml", settings, integrating)
                expected = columns("oscillator.toml", settings, BUILT_IN)
                self.assert_near(found, expected, (".lambda", 1e-8), (".a", 1e-8), 1e-10)
                instants = columns("oscillator.toml", settings[:1], integrating)
                self.assertNotEqual(instants["link.lambda"], found["link.lambda"])

    def test_integrals_of_links_in_python_are_those_of_the_built_in_links(self):
        """As further unknowns of SciPy's method, and by the weights of a Runge-Kutta method."""
        settings = ["coupling.degree=3", 'coupling.moments="integrals"']
        found, expected = columns("two_links.toml", settings), columns("two_links.toml", settings, LINKS_BUILT_IN)
        self.assert_near(found, expected, ("_ax", 1e-6), ("_ay", 1e-6), ("_alpha", 1e-6), 1e-8)

    def test_an_impact_goes_through_joints_to_a_rod_in_python(self):
        """The block on the end of the rod hits the floor; the rod jumps as the built-in one does that takes the same steps."""
        scene = "../tests/runs/stop.toml"
        command = r'^command = .*rod.py"\]'
        fixed = 'model = "planar-body"\nsolver = { kind = "rk4", step = 5e-4 }'
        found, expected = columns(scene), columns(scene, changes=[(command, fixed)])
        self.assertEqual(sum(found["lower.impacts"]), 1.0)
        for name in (
            "upper.end_rate",
            "upper.end_vy",
            "lower.centre_rate",
            "lower.impacts",
            "lower.impulse",
            "lower.impact_loss",
        ):
            self.assertLess(difference(found[name], expected[name]), 1e-9, name)
        # Forces alone make another motion.
        forces = columns(scene, ['coupling.impacts="forces"'])
        self.assertGreater(difference(forces["upper.end_rate"], expected["upper.end_rate"]), 1e-2)

    def test_steps_that_vary_are_taken_back_and_taken_again(self):
        settings = ["coupling.method=weighted", "coupling.macro_step=1e-3", "coupling.tolerance=1e-7"]
        found, expected = columns("oscillator.toml", settings), columns("oscillator.toml", settings, BUILT_IN)
        self.assertGreater(len({round(b - a, 9) for a, b in itertools.pairwise(found["t"])}), 3)
        for name in ("mass1.x", "mass2.v"):
            self.assertAlmostEqual(found[name][-1], expected[name][-1], delta=1e-5 * max(map(abs, expected[name])))

    def test_links_in_python_are_the_built_in_links(self):
        found, expected = columns("two_links.toml"), columns("two_links.toml", changes=LINKS_BUILT_IN)
        self.assert_near(found, expected, ("_ax", 1e-6), ("_ay", 1e-6), 1e-8)
        self.assertLess(max(map(abs, found["hinge.residual.position.x"])), 1e-8)

    def test_joint_loads_inside_a_solver_in_python_are_those_of_the_built_in_one(self):
        """The end of the lower link slides along the upper one, so the load turns with that."""
        slide = (
            r'^kind = "revolute"\na = .*\nb = .*$',
            'kind = "inplane"\na = "lower.start"\nb = "upper.tip"\naxis_b = [0.0, 1.0]',
        )
        upper, lower = LINKS_BUILT_IN
        rod = (r"planar_rod.py", "../tests/runs/joint_rod.py")
        # Converged, so that it does not count in which steps columns are measured.
        common = ["coupling.method=weighted", "coupling.macro_step=2e-3"]
        common += ["coupling.iterations.most=6", "coupling.iterations.tolerance=1e-11"]
        inside = [*common, "coupling.loads=worker"]
        expected = columns("two_links.toml", inside, [slide, upper, lower])
        found = columns("two_links.toml", inside, [slide, upper, rod])
        self.assert_near(found, expected, ("_ax", 1e-6), ("_ay", 1e-6), ("_alpha", 1e-6), 1e-7)
        # From outside the load is a polynomial, and the motion another one.
        outside = columns("two_links.toml", [*common, "coupling.loads=master"], [slide, upper, rod])
        self.assertNotEqual(outside, found)

    def test_a_top_in_python_is_the_built_in_body(self):
        found, expected = columns("gimbal.toml"), columns("gimbal.toml", changes=TOP_BUILT_IN)
        for name, own in found.items():
            if name.startswith("gimbal.") and "alpha" not in name and any(own):
                self.assertLess(difference(own, expected[name]), 1e-6, name)
        quaternions = ([f[name] for name in f if name.startswith("top.start_q")] for f in (found, expected))
        for own, other in zip(*(zip(*parts, strict=True) for parts in quaternions), strict=True):
            # Both signs are the same rotation.
            self.assertAlmostEqual(abs(sum(a * b for a, b in zip(own, other, strict=True))), 1.0, delta=1e-12)

    def test_every_example_is_run(self):
        scenes = "".join(file.read_text() for file in EXAMPLES.glob("*.toml"))
        for file in EXAMPLES.glob("*.py"):
            self.assertIn(file.name, scenes)
        self.assertLess(len(pathlib.Path(EXAMPLES, "oscillator.py").read_text().splitlines()), 46)

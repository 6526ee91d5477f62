"""Coupled scenes of solvers of others, against the same mechanism without coupling."""

import itertools
import math
import pathlib
import unittest

from arm_and_finger import finger_alone
from beam_and_pendulum import beam_alone
from solvers import EXAMPLES, needed, opening, results

# The mechanism of arm_and_link.toml and arm_and_body.toml.
WHOLE = """
<mujoco>
  <option integrator="RK4" timestep="2e-4" gravity="0 0 -9.81"/>
  <worldbody>
    <body>
      <joint name="shoulder" type="hinge" axis="0.3 1 0.2" stiffness="2" damping="0.05"/>
      <inertial pos="0.25 0 0" mass="1.3" diaginertia="0.01 0.04 0.05"/>
      <body pos="0.7 0 0">
        <joint type="hinge" pos="-0.2 0 0" axis="0 3 4"/>
        <inertial pos="0 0 0" mass="0.8" diaginertia="0.008 0.02 0.025"/>
        <site pos="0.2 0 0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
ARM = ("arm.shoulder", "link.end_x", "link.end_y", "link.end_z")
GAP = 1e-10
"""Largest opening of a joint (m)."""
ORDER = 5


def arm_alone(times):
    """The columns of ARM at given times, multiples of the step of MuJoCo."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(WHOLE)
    data, rows = mujoco.MjData(model), []
    for t in times:
        mujoco.mj_step(model, data, round((t - data.time) / model.opt.timestep))
        mujoco.mj_kinematics(model, data)
        rows.append((data.qpos[0], *data.site_xpos[0]))
    return dict(zip(ARM, map(list, zip(*rows, strict=True)), strict=True))


class Coupled(unittest.TestCase):
    def assert_converges(self, solver, scene, joint, alone, steps):
        """Order and gap; errors are the largest of all columns of the reference over time."""
        errors = []
        for step in steps:
            found = results(solver, scene, f"coupling.macro_step={step}")
            expected = alone(found["t"])
            errors.append(max(abs(a - b) for name in expected for a, b in zip(found[name], expected[name], strict=True)))
        gap = opening(found, joint)
        pairs = [zip(*pair, strict=True) for pair in itertools.pairwise(zip(errors, steps, strict=True))]
        orders = [math.log(a / b) / math.log(c / d) for (a, b), (c, d) in pairs]
        shown = ", ".join(f"{step:g} s: {error:.2e}" for step, error in zip(steps, errors, strict=True))
        print(f"\n{scene}: error by H {shown}; orders {', '.join(f'{order:.2f}' for order in orders)}; gap {gap:.1e} m")
        for order in orders:
            self.assertAlmostEqual(order, ORDER, delta=0.4)
        self.assertLess(errors[-1], 1e-8)
        self.assertLess(gap, GAP)

    @needed("mujoco")
    def test_an_arm_of_mujoco_and_a_built_in_body(self):
        self.assert_converges("mujoco", "arm_and_link.toml", "elbow", arm_alone, (4e-2, 2e-2, 1e-2))

    @needed("mujoco", "exudyn")
    def test_an_arm_of_mujoco_and_a_body_of_exudyn(self):
        self.assert_converges("exudyn", "arm_and_body.toml", "elbow", arm_alone, (4e-2, 2e-2, 1e-2))

    @needed("mujoco", "skfem")
    def test_a_pendulum_of_mujoco_on_a_beam_of_scikit_fem(self):
        self.assert_converges("scikit_fem", "beam_and_pendulum.toml", "hook", beam_alone, (8e-3, 4e-3, 2e-3))

    @needed("mujoco", "skfem")
    def test_a_finger_of_scikit_fem_welded_to_an_arm_of_mujoco(self):
        self.assert_converges("scikit_fem", "arm_and_finger.toml", "weld", finger_alone, (8e-3, 4e-3, 2e-3))

    @needed("mujoco", "exudyn")
    def test_a_second_run_has_the_same_bits(self):
        first, second = (results("exudyn", "arm_and_body.toml", "coupling.macro_step=2e-2") for _ in range(2))
        self.assertEqual(first, second)

    def test_every_scene_of_the_examples_is_run(self):
        text = pathlib.Path(__file__).read_text()
        for scene in EXAMPLES.glob("*/*.toml"):
            self.assertIn(f'"{scene.parent.name}", "{scene.name}"', text)


if __name__ == "__main__":
    unittest.main()

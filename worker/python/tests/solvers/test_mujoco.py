"""MuJoCo as a worker: against MuJoCo alone, against differences, and bit by bit."""

import pathlib
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

from solvers import EXAMPLES, assert_rates, example, inputs, made, needed

from linchpin_worker.encoding import decode, encode

# A ball that falls on a plane and rolls against a cart that a motor drives: contacts, friction, an activation, a limit.
ROUGH = """
<mujoco>
  <option integrator="{integrator}" timestep="2e-3"/>
  <worldbody>
    <geom type="plane" size="5 5 .1"/>
    <body pos="0 0 0.2">
      <joint name="rail" type="slide" axis="1 0 0" range="-0.2 0.2" limited="true" damping="1"/>
      <joint name="turn" type="hinge" axis="0 0.2 1"/>
      <geom type="box" size="0.2 0.1 0.05" mass="2"/>
      <site name="top" pos="0.1 0.05 0.05"/>
    </body>
    <body pos="0.3 0 0.11"><freejoint/><geom type="sphere" size="0.1" mass="0.5"/><site pos="0 0.1 0"/></body>
    <site name="fixed"/>
  </worldbody>
  <actuator><general joint="rail" dyntype="integrator" gainprm="3" dynprm="0.1"/></actuator>
</mujoco>
"""
ONE_HINGE = """
<mujoco>
  <option gravity="0 2 -9.81" integrator="RK4"><flag {flag}/></option>
  <worldbody>
    <body>
      <joint name="hinge" axis="1 0.3 0"/>
      <geom type="box" size="0.1 0.2 0.3" pos="0.1 0.2 0"/>
      <site name="tip" pos="0 0.3 0"/>
    </body>
  </worldbody>
</mujoco>
"""
LOADS = ("fx", "fy", "fz", "moment_x", "moment_y", "moment_z")


@needed("mujoco")
class Model(unittest.TestCase):
    """A model without a server."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def file(self, text):
        file = self.folder / "model.xml"
        file.write_text(text)
        return str(file)

    def model(self, file):
        import mujoco

        worker = example("mujoco", "mujoco_worker")
        mujoco.set_mjcb_passive(None)
        model = worker.mechanism(file)
        mujoco.set_mjcb_passive(worker.apply_loads)
        self.addCleanup(mujoco.set_mjcb_passive, None)
        return model

    def test_every_site_on_a_moving_body_is_a_marker(self):
        description = self.model(self.file(ROUGH.format(integrator="RK4"))).description
        self.assertEqual([marker.name for marker in description.markers], ["top", "site2"])
        self.assertEqual([parameter.name for parameter in description.parameters], ["rail", "rail_rate", "turn", "turn_rate"])
        self.assertEqual([parameter.unit for parameter in description.parameters], ["m", "m/s", "rad", "rad/s"])

    def test_a_state_that_is_loaded_gives_the_same_bits(self):
        for integrator in ("RK4", "Euler", "implicitfast"):
            model = self.model(self.file(ROUGH.format(integrator=integrator)))
            body = made(model, turn_rate=3.0, rail=0.1)
            load = inputs(model, 0.02, top_fx=(5.0, 9.0), site2_fx=(-2.0, 1.0))
            for step in range(20):
                body.advance(0.02 * step, 0.02, load)
            self.assertGreater(body.data.ncon, 0)
            kept, expected = body.save(), []
            for step in range(20, 30):
                body.advance(0.02 * step, 0.02, load)
                expected.append(body.outputs(0.02 * (step + 1), load.at_end))
            # Also in an instance that has gone another way.
            for other in (body, made(model, turn=1.0)):
                other.advance(0.0, 0.05, inputs(model, 0.05))
                other.load(decode(encode(kept)))
                for step, row in zip(range(20, 30), expected, strict=True):
                    other.advance(0.02 * step, 0.02, load)
                    self.assertEqual(other.outputs(0.02 * (step + 1), load.at_end), row)

    def test_instances_on_threads_have_their_own_loads(self):
        model = self.model(self.file(ROUGH.format(integrator="RK4")))

        def end(force):
            body = made(model)
            for step in range(50):
                body.advance(0.02 * step, 0.02, inputs(model, 0.02, top_fy=(force, -force)))
            return body.outputs(1.0, inputs(model, 0.02, top_fy=(force, force)).at_end)

        forces = [0.0, 1.0, 2.0, 3.0]
        with ThreadPoolExecutor(len(forces)) as pool:
            together = list(pool.map(end, forces))
        self.assertEqual(together, [end(force) for force in forces])
        self.assertNotEqual(together[0], together[1])

    def test_without_loads_it_is_mujoco(self):
        import mujoco

        file = self.file(ROUGH.format(integrator="Euler"))
        alone = mujoco.MjModel.from_xml_path(file)
        body, data = made(self.model(file)), mujoco.MjData(alone)
        for step in range(50):
            body.advance(0.01 * step, 0.01, inputs(type(body), 0.01))
            body.outputs(0.01 * (step + 1), inputs(type(body), 0.01).at_end)
            mujoco.mj_step(alone, data, 5)
        self.assertLess(max(abs(body.data.qpos - data.qpos)), 1e-9)

    def test_velocities_and_accelerations_are_those_of_the_positions(self):
        texts = [ONE_HINGE.format(flag=f'gravity="{word}"') for word in ("enable", "disable")]
        for text in (EXAMPLES.joinpath("mujoco", "arm.xml").read_text(), *texts):
            file = self.file(text)
            model = self.model(str(file))
            site = model.description.markers[0].name
            load = {f"{site}_{end}": (0.3 * place, 0.3 * place) for place, end in enumerate(LOADS, 1)}
            with self.subTest(text=text):
                assert_rates(self, model, site, load)

    def test_mistakes_are_told_by_the_program(self):
        off = self.file(ONE_HINGE.format(flag='spring="disable" damper="disable"'))
        for arguments, words in (
            ([], "the first argument is the MJCF file"),
            (["--listen"], "the first argument is the MJCF file"),
            (["nothere.xml"], "nothere.xml"),
            ([off], "spring and damper are both disabled"),
        ):
            with self.subTest(arguments=arguments):
                program = EXAMPLES / "mujoco" / "mujoco_worker.py"
                done = subprocess.run([sys.executable, program, *arguments], capture_output=True, text=True)
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, f"^error: .*{words}")


if __name__ == "__main__":
    unittest.main()

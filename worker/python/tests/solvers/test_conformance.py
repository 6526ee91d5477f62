"""Every worker of the examples does what the contract and mechanics ask of it."""

import unittest

from solvers import EXAMPLES, linchpin, needed

ARM = ("shoulder=0.4", "shoulder_rate=1.3")
BODY = ("m=0.8", "j1=0.008", "j2=0.02", "j3=0.025", "start_x=-0.2", "start_y=0.05", "end_x=0.2", "end_z=0.1")
SPIN = ("omega1_0=1", "omega2_0=-2", "omega3_0=1.5", "vx0=0.4")
BEAM = ("length=1.0", "radius=0.01", "elasticity=3e9", "density=1200.0")

FINGER = ("length=0.3", "radius=0.01", "elasticity=5e7", "density=1200")


class Conformance(unittest.TestCase):
    def assert_conforms(self, solver, command, *parameters):
        given = [word for parameter in parameters for word in ("-p", parameter)]
        told = linchpin("conformance", "--step", "5e-3", *given, "--", "python3", *command, folder=EXAMPLES / solver)
        self.assertIn(" 0 with a warning, 0 failed", told)

    @needed("mujoco")
    def test_mujoco(self):
        self.assert_conforms("mujoco", ["mujoco_worker.py", "arm.xml"], *ARM)
        self.assert_conforms("scikit_fem", ["../mujoco/mujoco_worker.py", "pendulum.xml"])

    @needed("exudyn")
    def test_exudyn(self):
        self.assert_conforms("exudyn", ["exudyn_worker.py"], *BODY, *SPIN)

    @needed("skfem")
    def test_scikit_fem(self):
        self.assert_conforms("scikit_fem", ["beam_worker.py"], *BEAM)
        self.assert_conforms("scikit_fem", ["finger_worker.py"], *FINGER)


if __name__ == "__main__":
    unittest.main()

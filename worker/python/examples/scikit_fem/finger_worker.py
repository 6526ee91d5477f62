"""A flexible finger of finite elements, made by scikit-fem: python finger_worker.py --listen ADDRESS.

It moves and turns freely; seen from its root it bends as a clamped beam does, by small deflections (floating frame of
reference). The sections move as rigid discs along y and z, and its length stays.
"""

import numpy as np
from beam_elements import PARAMETERS, beam

from linchpin_worker import Description, Parameter, Solver, Subsystem, quaternion_of_matrix, serve, spatial_marker

ROOT, TIP = spatial_marker("root"), spatial_marker("tip", orientation=False)
PLACE = [Parameter(name, "m", default=0.0) for name in ("x0", "y0", "z0")]
RK4 = Solver("rk4", options=[Parameter("dt", "s", default=5e-4, above=0.0, description="longest internal step")])


class Finger(Subsystem):
    """The state is, one after the other: position of the root, rotation matrix, velocity, angular velocity in the axes of
    the finger; deflections of the modes in y and z, and their rates. Integrated by the classical Runge-Kutta method.
    """

    description = Description(
        name="finger",
        text="elastic finger of circular section in space, by scikit-fem; at the start along x",
        inputs=[*ROOT.inputs, *TIP.inputs],
        outputs=[*ROOT.outputs, *TIP.outputs],
        parameters=[*PARAMETERS, *PLACE],
        solvers=[RK4],
        markers=[ROOT, TIP],
        repeats_step_sequence=True,
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        modal, self.dt = beam(setup), setup.options["dt"]
        self.modes = len(modal.squares)
        self.squares = np.repeat(modal.squares, 2)
        self.damping = 2.0 * setup["damping"] * np.sqrt(self.squares)
        self.weight = np.array([0.0, 0.0, -setup["gravity"]])
        # Four points stand for each section, so far from its centre that they have its inertia.
        offset = setup["radius"] / np.sqrt(2.0)
        around = np.array([[0, offset, 0], [0, -offset, 0], [0, 0, offset], [0, 0, -offset]])
        centres = np.outer(modal.points, [1.0, 0.0, 0.0])
        self.points = (centres[:, None] + around).reshape(-1, 3)
        self.heavy = np.repeat(modal.masses / 4, 12)
        self.shapes = np.repeat(columns(modal.shapes), 4, axis=0)
        # Accelerations of the points for those of root, attitude and modes; those of the attitude follow the deflection.
        self.levers = np.zeros((len(self.points), 3, 6 + 2 * self.modes))
        self.levers[:, :, :3], self.levers[:, :, 6:] = np.eye(3), self.shapes
        self.end, self.end_shape = np.array([setup["length"], 0.0, 0.0]), columns(modal.tip[None])[0]
        free = np.zeros(4 * self.modes)
        self.state = np.concatenate([setup.numbers("x0", "y0", "z0"), np.eye(3).ravel(), np.zeros(6), free])

    def parts(self, state):
        split = 18 + 2 * self.modes
        return state[:3], state[3:12].reshape(3, 3), state[12:15], state[15:18], state[18:split], state[split:]

    def equations(self, turn, omega, bent, rate):
        """Mass matrix and free forces, in the axes of the finger, for the accelerations of root, attitude and modes."""
        points, rates, spin = self.points + self.shapes @ bent, self.shapes @ rate, skew(omega)
        for row, column, axis in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            self.levers[:, row, 3 + column], self.levers[:, column, 3 + row] = points[:, axis], -points[:, axis]
        bias = points @ (spin @ spin).T + 2.0 * rates @ spin.T - turn.T @ self.weight
        levers, heavy = self.levers.reshape(-1, self.levers.shape[2]), self.heavy
        elastic = np.concatenate([np.zeros(6), -self.squares * bent - self.damping * rate])
        return levers.T @ (heavy[:, None] * levers), elastic - levers.T @ (heavy * bias.ravel())

    def accelerations(self, state, u):
        """Of the root, of the attitude, of the modes, in the axes of the finger."""
        _, turn, _, omega, bent, rate = self.parts(state)
        mass, forces = self.equations(turn, omega, bent, rate)
        force, moment, tip_force = (turn.T @ np.reshape(u, (3, 3)).T).T
        forces[:3] += force + tip_force
        forces[3:6] += moment + np.cross(self.end + self.end_shape @ bent, tip_force)
        forces[6:] += self.end_shape.T @ tip_force
        return np.split(np.linalg.solve(mass, forces), [3, 6])

    def slope(self, state, u):
        _, turn, velocity, omega, _, rate = self.parts(state)
        acceleration, alpha, change = self.accelerations(state, u)
        turning = turn @ skew(omega)
        return np.concatenate([velocity, turning.ravel(), turn @ acceleration, alpha, rate, change])

    def advance(self, t, step, u):
        for _, h, (start, middle, end) in u.stages(self.dt):
            first = self.slope(self.state, start)
            second = self.slope(self.state + h / 2 * first, middle)
            third = self.slope(self.state + h / 2 * second, middle)
            self.state = self.state + h / 6 * (first + 2 * second + 2 * third + self.slope(self.state + h * third, end))
            self.internal_steps += 1

    def outputs(self, t, u):
        position, turn, velocity, omega, bent, rate = self.parts(self.state)
        acceleration, alpha, change = self.accelerations(self.state, u)
        point, relative = self.end + self.end_shape @ bent, self.end_shape @ rate
        tip_velocity = np.cross(omega, point) + relative
        tip_acceleration = np.cross(alpha, point) + np.cross(omega, tip_velocity + relative) + self.end_shape @ change
        root = [*position, *quaternion_of_matrix(turn), *velocity, *(turn @ omega), *(turn @ acceleration), *(turn @ alpha)]
        tip = [position + turn @ point, velocity + turn @ tip_velocity, turn @ (acceleration + tip_acceleration)]
        return [*root, *np.ravel(tip)]

    def save(self):
        return self.state

    def load(self, state):
        self.state = state


def columns(shapes):
    """Deflections in space of points, a row of `shapes` for each: modes in y and z by turns."""
    inside = np.zeros((len(shapes), 3, 2 * shapes.shape[1]))
    inside[:, 1, 0::2] = inside[:, 2, 1::2] = shapes
    return inside


def skew(a):
    """The matrix of the cross product with a vector."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


if __name__ == "__main__":
    serve(Finger)

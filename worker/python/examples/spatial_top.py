"""A free rigid body in space with one marker, integrated by the classical Runge-Kutta method."""

import numpy as np

from linchpin_worker import Description, Parameter, Subsystem, quaternion_of_matrix, serve, spatial_marker, wrench_about

START = spatial_marker("start")
GRAVITY = np.array([0.0, 0.0, -9.81])
NAMES = ("m", "j1", "j2", "j3")
FREE = ("start_x", "start_y", "start_z", "x0", "y0", "z0", "rx0", "ry0", "rz0", "vx0", "vy0", "vz0")
RATES = ("omega1_0", "omega2_0", "omega3_0")


class Top(Subsystem):
    """The state is the position of the centre of mass, the rotation matrix from body to space, velocity, angular velocity.

    The angular velocity is in the axes of the body, which are its principal ones; all else is in inertial axes.
    """

    description = Description(
        name="top",
        text="free rigid body in space, with the parameters of the built-in spatial-body",
        inputs=START.inputs,
        outputs=START.outputs,
        parameters=[Parameter(name, above=0.0) for name in NAMES] + [Parameter(name, default=0.0) for name in (*FREE, *RATES)],
        markers=[START],
        repeats_step_sequence=True,
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        self.m, *inertia = setup.numbers(*NAMES)
        self.inertia = np.array(inertia)
        self.arm, position, vector, velocity = np.reshape(setup.numbers(*FREE), (4, 3))
        turn = rotation(vector)
        self.state = np.concatenate([position, turn.ravel(), velocity, setup.numbers(*RATES)])

    def slope(self, state, u):
        position, turn, velocity, omega = parts(state)
        force, moment = wrench_about(position, position + turn @ self.arm, u[:3], u[3:])
        acceleration = np.array(force) / self.m + GRAVITY
        alpha = (turn.T @ moment - np.cross(omega, self.inertia * omega)) / self.inertia
        return np.concatenate([velocity, (turn @ skew(omega)).ravel(), acceleration, alpha])

    def advance(self, t, step, u):
        for _, h, (start, middle, end) in u.stages(dt=5e-4):
            first = self.slope(self.state, start)
            second = self.slope(self.state + h / 2 * first, middle)
            third = self.slope(self.state + h / 2 * second, middle)
            self.state = self.state + h / 6 * (first + 2 * second + 2 * third + self.slope(self.state + h * third, end))
            self.internal_steps += 1

    def outputs(self, t, u):
        position, turn, velocity, omega = parts(self.state)
        _, _, acceleration, alpha = parts(self.slope(self.state, u))
        arm, omega, alpha = turn @ self.arm, turn @ omega, turn @ alpha
        acceleration = acceleration + np.cross(alpha, arm) + np.cross(omega, np.cross(omega, arm))
        pose = [*(position + arm), *quaternion_of_matrix(turn)]
        return [*pose, *(velocity + np.cross(omega, arm)), *omega, *acceleration, *alpha]

    def save(self):
        return self.state

    def load(self, state):
        self.state = state


def parts(state):
    return state[:3], state[3:12].reshape(3, 3), state[12:15], state[15:]


def skew(a):
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def rotation(vector):
    """Rodrigues' formula for a rotation vector."""
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    axis = skew(vector / angle)
    return np.eye(3) + np.sin(angle) * axis + (1.0 - np.cos(angle)) * axis @ axis


if __name__ == "__main__":
    serve(Top)

"""A pendulum on a ball joint at the tip of a beam, without coupling: its equations with the force in the joint.

The beam is that of the worker, by its modes; body and joint are those of pendulum.xml and beam_and_pendulum.toml.
"""

import numpy as np
from scipy.integrate import solve_ivp
from solvers import example, made

BEAM = {"length": 1.0, "radius": 0.01, "elasticity": 3e9, "density": 1200.0, "damping": 0.01}
MASS, INERTIA = 0.2, np.array([0.001, 0.002, 0.0015])
CENTRE = np.array([0.1, 0.05, -0.2])
"""Of the body, seen from the hook."""
WEIGHT = np.array([0.0, 0.0, -9.81])


def beam_alone(times):
    """Tip of the beam and attitude of the pendulum."""
    beam = made(example("scikit_fem", "beam_worker").WallBeam, **BEAM)
    modes = beam.state.size // 2
    start = np.concatenate([np.zeros(2 * modes), [1.0, 0.0, 0.0, 0.0], np.zeros(3)])
    done = solve_ivp(lambda _, state: slope(beam, state), (0.0, times[-1]), start, "DOP853", times, rtol=1e-12, atol=1e-13)
    tips = np.tensordot(beam.tip, done.y[:modes].reshape(modes // 2, 2, -1), axes=1)
    turns = done.y[2 * modes : 2 * modes + 4]
    # Of the two quaternions of a rotation the one with a positive real part.
    turns = turns * np.sign(turns[0]) / np.linalg.norm(turns, axis=0)
    names = ["beam.tip_y", "beam.tip_z", *(f"pendulum.hook_q{part}" for part in "wxyz")]
    return dict(zip(names, [*tips, *turns], strict=True))


def slope(beam, state):
    """Rates of modes and their rates in y and z, of the quaternion, and of the angular velocity in the axes of the body."""
    modes = beam.state.size // 2
    quaternion, omega = state[2 * modes : 2 * modes + 4], state[2 * modes + 4 :]
    turn = rotation(quaternion / np.linalg.norm(quaternion))
    # Unknown are the accelerations of the modes, that of the rotation, and the force of the beam on the pendulum.
    own, tip = np.zeros((modes + 6, modes + 6)), np.zeros((3, modes))
    tip[1, 0::2] = tip[2, 1::2] = beam.tip
    free = (beam.matrix @ state[: 2 * modes].reshape(-1, 2) + beam.weight)[modes // 2 :].ravel()
    own[:modes, :modes], own[:modes, modes + 3 :] = np.eye(modes), tip.T
    own[modes : modes + 3, modes : modes + 3] = np.diag(INERTIA)
    own[modes : modes + 3, modes + 3 :] = skew(CENTRE) @ turn.T
    own[modes + 3 :, :modes], own[modes + 3 :, modes : modes + 3] = MASS * tip, -MASS * turn @ skew(CENTRE)
    own[modes + 3 :, modes + 3 :] = -np.eye(3)
    turning = turn @ np.cross(omega, np.cross(omega, CENTRE))
    known = np.concatenate([free, -np.cross(omega, INERTIA * omega), MASS * (WEIGHT - turning)])
    found = np.linalg.solve(own, known)
    w, x, y, z = quaternion
    rates = 0.5 * np.array([[-x, -y, -z], [w, -z, y], [z, w, -x], [-y, x, w]]) @ omega
    return np.concatenate([state[modes : 2 * modes], found[:modes], rates, found[modes : modes + 3]])


def skew(a):
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def rotation(quaternion):
    w, axis = quaternion[0], skew(quaternion[1:])
    return np.eye(3) + 2.0 * w * axis + 2.0 * axis @ axis

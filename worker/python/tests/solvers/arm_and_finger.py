"""An arm on a hinge with a flexible finger welded to it, without coupling: the angle of the hinge, and the modes.

The finger is that of the worker; the arm and the weld are those of arm.xml and arm_and_finger.toml.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp
from solvers import example, made

FINGER = {"length": 0.3, "radius": 0.01, "elasticity": 5e7, "density": 1200.0, "elements": 4.0, "modes": 1.0, "damping": 0.01}
AXIS = np.array([0.3, 1.0, 0.2]) / math.sqrt(1.13)
MASS, INERTIA, CENTRE, END = 1.3, np.array([0.01, 0.04, 0.05]), np.array([0.25, 0.0, 0.0]), np.array([0.5, 0.0, 0.0])
STIFFNESS, DAMPING = 2.0, 0.05


def finger_alone(times):
    """Angle of the arm and place of the tip."""
    finger = made(example("scikit_fem", "finger_worker").Finger, **FINGER)
    start = np.zeros(2 + 4 * finger.modes)
    done = solve_ivp(lambda _, state: slope(finger, state), (0.0, times[-1]), start, "DOP853", times, rtol=1e-11, atol=1e-13)
    tips = [rotation(state[0]) @ (END + finger.end + finger.end_shape @ state[1 : 1 + 2 * finger.modes]) for state in done.y.T]
    names = ("arm.shoulder", "finger.tip_x", "finger.tip_y", "finger.tip_z")
    return dict(zip(names, [done.y[0], *np.transpose(tips)], strict=True))


def slope(finger, state):
    """Rates of the angle, the modes, and their rates."""
    size = len(state) // 2
    angle, rate, turn = state[0], state[size], rotation(state[0])
    mass, forces = finger.equations(turn, rate * AXIS, state[1:size], state[size + 1 :])
    # The root, its attitude and the modes accelerate by `own` times the accelerations of angle and modes, plus `rest`.
    own, rest = np.zeros((5 + size, size)), np.zeros(5 + size)
    own[:3, 0], own[3:6, 0], own[6:, 1:] = np.cross(AXIS, END), AXIS, np.eye(size - 1)
    rest[:3] = rate**2 * np.cross(AXIS, np.cross(AXIS, END))
    whole, loads = own.T @ mass @ own, own.T @ (forces - mass @ rest)
    lever = np.cross(AXIS, CENTRE)
    whole[0, 0] += AXIS**2 @ INERTIA + MASS * lever @ lever
    loads[0] += MASS * lever @ (turn.T @ finger.weight) - STIFFNESS * angle - DAMPING * rate
    return np.concatenate([state[size:], np.linalg.solve(whole, loads)])


def rotation(angle):
    """About the axis of the hinge (Rodrigues' formula)."""
    x, y, z = AXIS
    axis = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + math.sin(angle) * axis + (1.0 - math.cos(angle)) * axis @ axis

"""A rigid link on a hinge, integrated by SciPy's solve_ivp."""

import numpy as np
from scipy.integrate import solve_ivp

from linchpin_worker import Description, Parameter, StepFailed, Subsystem, planar_marker, serve

TIP = planar_marker("tip")


class Pendulum(Subsystem):
    tolerance = 1e-10
    description = Description(
        name="pendulum",
        text="a rigid link that hangs on a hinge in the origin, its centre of mass in the middle",
        inputs=TIP.inputs,
        outputs=TIP.outputs,
        parameters=[Parameter("m", "kg", above=0.0), Parameter("inertia", "kg m^2", above=0.0)]
        + [Parameter("length", "m", above=0.0), Parameter("angle0", "rad", default=0.0)],
        markers=[TIP],
        exportable_snapshot=True,
        output_integrals=True,
    )

    def __init__(self, setup):
        self.m, self.inertia, self.length, angle = setup.numbers("m", "inertia", "length", "angle0")
        self.state = np.array([angle, 0.0])

    def rates(self, state, u):
        x, y = self.length * np.cos(state[0]), self.length * np.sin(state[0])
        moment = x * u.tip_fy - y * u.tip_fx + u.tip_moment - 9.81 * self.m * x / 2
        return np.array([state[1], moment / (self.inertia + self.m * self.length**2 / 4)])

    def advance(self, t, step, u):
        def rates(tau, unknowns):  # the state, then the integrals that are asked for
            state, inputs = unknowns[:2], u(tau)
            return [*self.rates(state, inputs), *self.integrals.rates(tau, self.told(state, inputs))]

        limits = {"rtol": self.tolerance, "atol": self.tolerance}
        start = np.append(self.state, np.zeros(len(self.integrals)))
        done = solve_ivp(rates, (0.0, step), start, "DOP853", **limits)
        if not done.success:
            raise StepFailed(done.message, t + done.t[-1])
        self.state = done.y[:2, -1]
        self.integrals.set(done.y[2:, -1])

    def outputs(self, t, u):
        return self.told(self.state, u)

    def told(self, state, u):
        (angle, rate), (_, alpha) = state, self.rates(state, u)
        along, across = self.length * np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        return [*along, angle, *(rate * across), rate, *(alpha * across - rate**2 * along), alpha]

    def save(self):
        return self.state

    def load(self, state):
        self.state = state


if __name__ == "__main__":
    serve(Pendulum)

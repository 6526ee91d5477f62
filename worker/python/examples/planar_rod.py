"""A free rigid rod in the plane with a marker at each end, integrated by the classical Runge-Kutta method."""

import math

from linchpin_worker import Description, Parameter, Subsystem, moment_about, planar_marker, serve

START, END = planar_marker("start"), planar_marker("end")
GRAVITY = 9.81


class Rod(Subsystem):
    """The state is position, angle, velocity and rate of the centre of mass."""

    description = Description(
        name="rod",
        text="free rigid rod, its centre of mass in the middle",
        inputs=[*START.inputs, *END.inputs],
        outputs=[*START.outputs, *END.outputs],
        parameters=[Parameter(name, unit, above=0.0) for name, unit in (("m", "kg"), ("inertia", "kg m^2"), ("length", "m"))]
        + [Parameter(name, unit, default=0.0) for name, unit in (("x0", "m"), ("y0", "m"), ("angle0", "rad"))],
        markers=[START, END],
        repeats_step_sequence=True,
        exportable_snapshot=True,
        output_integrals=True,
        impulses=True,
    )

    def __init__(self, setup):
        self.m, self.inertia, length, x, y, angle = setup.numbers("m", "inertia", "length", "x0", "y0", "angle0")
        self.half = 0.5 * length
        self.state = (x + self.half * math.cos(angle), y + self.half * math.sin(angle), angle, 0.0, 0.0, 0.0)

    def ends(self, state):
        """The two markers, seen from the centre of mass."""
        along = self.half * math.cos(state[2]), self.half * math.sin(state[2])
        return (-along[0], -along[1]), along

    def acceleration(self, state, u):
        """Of the centre of mass and of the angle, under the loads of both markers."""
        fx, fy = u.start_fx + u.end_fx, u.start_fy + u.end_fy
        loads = ((u.start_fx, u.start_fy, u.start_moment), (u.end_fx, u.end_fy, u.end_moment))
        moments = (moment_about((0, 0), end, load[:2], load[2]) for end, load in zip(self.ends(state), loads, strict=True))
        return fx / self.m, fy / self.m - GRAVITY, sum(moments) / self.inertia

    def advance(self, t, step, u):
        for tau, h, (start, middle, end) in u.stages(dt=min(5e-4, self.integrals.longest_step(step))):

            def slope(after, weight, previous, loads, tau=tau):
                state = [own + after * rate for own, rate in zip(self.state, previous, strict=True)]
                if self.integrals:  # by the weights of the method, so they have its order
                    self.integrals.add(tau + after, weight, self.told(state, loads))
                return (*state[3:], *self.acceleration(state, loads))

            first = slope(0.0, h / 6, self.state, start)
            second = slope(h / 2, h / 3, first, middle)
            third = slope(h / 2, h / 3, second, middle)
            slopes = zip(self.state, first, second, third, slope(h, h / 6, third, end), strict=True)
            self.state = tuple(own + h / 6 * (a + 2 * b + 2 * c + d) for own, a, b, c, d in slopes)
            self.internal_steps += 1

    def impulse(self, t, u, impulses):
        raised, own = (self.acceleration(self.state, loads) for loads in (u.plus(impulses), u))
        jump = (0.0, 0.0, 0.0, *(a - b for a, b in zip(raised, own, strict=True)))
        self.state = tuple(a + b for a, b in zip(self.state, jump, strict=True))

    def outputs(self, t, u):
        return self.told(self.state, u)

    def told(self, state, u):
        x, y, angle, vx, vy, rate = state
        ax, ay, alpha = self.acceleration(state, u)
        told = []
        for dx, dy in self.ends(state):
            told += [x + dx, y + dy, angle, vx - rate * dy, vy + rate * dx, rate]
            told += [ax - alpha * dy - rate**2 * dx, ay + alpha * dx - rate**2 * dy, alpha]
        return told

    def save(self):
        return self.state

    def load(self, state):
        self.state = state


if __name__ == "__main__":
    serve(Rod)

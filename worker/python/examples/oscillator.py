"""A mass on a spring and a damper, integrated by the classical Runge-Kutta method."""

from linchpin_worker import Description, Parameter, Subsystem, Variable, scalar_marker, serve


class Oscillator(Subsystem):
    description = Description(
        name="oscillator",
        text="m a = -c x - d v + f",
        inputs=[Variable("f", "N", "force on the mass", default=0.0)],
        outputs=[Variable("x", "m"), Variable("v", "m/s"), Variable("a", "m/s^2")],
        parameters=[Parameter("m", "kg", above=0.0), Parameter("c", "N/m"), Parameter("d", "N s/m")]
        + [Parameter("x0", "m", default=0.0), Parameter("v0", "m/s", default=0.0)],
        markers=[scalar_marker("mass", position="x", velocity="v", acceleration="a", load="f")],
        repeats_step_sequence=True,
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        self.m, self.c, self.d, self.x, self.v = setup.numbers("m", "c", "d", "x0", "v0")

    def acceleration(self, x, v, f):
        return (f - self.c * x - self.d * v) / self.m

    def advance(self, t, step, u):
        for _, h, (start, middle, end) in u.stages(dt=1e-4):
            x, v1, a1 = self.x, self.v, self.acceleration(self.x, self.v, start.f)
            v2, a2 = v1 + h / 2 * a1, self.acceleration(x + h / 2 * v1, v1 + h / 2 * a1, middle.f)
            v3, a3 = v1 + h / 2 * a2, self.acceleration(x + h / 2 * v2, v1 + h / 2 * a2, middle.f)
            v4, a4 = v1 + h * a3, self.acceleration(x + h * v3, v1 + h * a3, end.f)
            self.x, self.v = x + h / 6 * (v1 + 2 * v2 + 2 * v3 + v4), v1 + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
            self.internal_steps += 1

    def outputs(self, t, u):
        return self.x, self.v, self.acceleration(self.x, self.v, u.f)

    def save(self):
        return self.x, self.v

    def load(self, state):
        self.x, self.v = state


if __name__ == "__main__":
    serve(Oscillator)

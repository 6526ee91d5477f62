"""A mass on a spring whose damper warms up; `kept` says where its state is: python forgetful_worker.py --listen ADDRESS.

The warmth is in the state with kept = "state", and in a table of this program with "table": the state has its key, which says
nothing to another process. With "program" it is forgotten wherever a state goes.
"""

import math

from linchpin_worker import Description, Parameter, Subsystem, Variable, scalar_marker, serve

TABLE = {}


class Damped(Subsystem):
    description = Description(
        "damped",
        inputs=[Variable("f", "N", default=0.0)],
        outputs=[Variable("x", "m"), Variable("v", "m/s"), Variable("a", "m/s^2")],
        parameters=[Parameter("kept", kind=str)],
        markers=[scalar_marker("mass", "x", "v", "a", "f")],
        repeats_step_sequence=True,
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        self.kept = setup.parameters["kept"]
        self.x, self.v, self.warmth = 0.1, 0.7, 0.0

    def acceleration(self, x, v, warmth, f):
        return (f - 300.0 * x - 2.0 * math.exp(-warmth) * v) / 1.3

    def advance(self, t, step, u):
        for _, h, (start, middle, end) in u.stages(dt=1e-4):

            def slope(after, previous, f):
                x, v, warmth = (own + after * rate for own, rate in zip((self.x, self.v, self.warmth), previous, strict=True))
                return v, self.acceleration(x, v, warmth, f), 0.05 * v * v

            first = slope(0.0, (0.0, 0.0, 0.0), start.f)
            second = slope(h / 2, first, middle.f)
            third = slope(h / 2, second, middle.f)
            slopes = zip((self.x, self.v, self.warmth), first, second, third, slope(h, third, end.f), strict=True)
            self.x, self.v, self.warmth = (own + h / 6 * (a + 2 * b + 2 * c + d) for own, a, b, c, d in slopes)

    def outputs(self, t, u):
        return self.x, self.v, self.acceleration(self.x, self.v, self.warmth, u.f)

    def save(self):
        if self.kept == "table":
            key = len(TABLE)
            TABLE[key] = self.warmth
            return self.x, self.v, key
        return self.x, self.v, self.warmth if self.kept == "state" else 0.0

    def load(self, state):
        self.x, self.v, self.warmth = state
        if self.kept == "table":
            self.warmth = TABLE.get(self.warmth, 0.0)


if __name__ == "__main__":
    serve(Damped)

#!/bin/sh
set -e
# docs/guide/python-worker.md
python3 -m venv .venv && . .venv/bin/activate
pip install ./worker/python
cat >hardening.py <<'END'
# hardening.py
from linchpin_worker import Description, Parameter, Subsystem, Variable, scalar_marker, serve


class HardeningSpring(Subsystem):
    description = Description(
        name="hardening-spring",
        text="a mass on a spring that hardens: m a = -c x - c3 x^3 + f",
        inputs=[Variable("f", "N", default=0.0)],
        outputs=[Variable("x", "m"), Variable("v", "m/s"), Variable("a", "m/s^2")],
        parameters=[Parameter("m", "kg", above=0.0), Parameter("c", "N/m"), Parameter("c3", "N/m^3"),
                    Parameter("v0", "m/s", default=0.0)],
        markers=[scalar_marker("mass", position="x", velocity="v", acceleration="a", load="f")],
        repeats_step_sequence=True,
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        self.m, self.c, self.c3, self.v = setup.numbers("m", "c", "c3", "v0")
        self.x = 0.0

    def acceleration(self, x, f):
        return (f - self.c * x - self.c3 * x**3) / self.m

    def advance(self, t, step, u):                       # Nystrom's method of order 4
        for tau, h, (start, middle, end) in u.stages(dt=1e-3):
            k1 = self.acceleration(self.x, start.f)
            k2 = self.acceleration(self.x + h / 2 * self.v + h**2 / 8 * k1, middle.f)
            k3 = self.acceleration(self.x + h * self.v + h**2 / 2 * k2, end.f)
            self.x += h * self.v + h**2 / 6 * (k1 + 2 * k2)
            self.v += h / 6 * (k1 + 4 * k2 + k3)

    def outputs(self, t, u):
        return self.x, self.v, self.acceleration(self.x, u.f)

    def save(self):
        return self.x, self.v

    def load(self, state):
        self.x, self.v = state


serve(HardeningSpring)
END
cat >masses.toml <<'END'
# masses.toml
[scene]
name = "masses"
t_end = 1.0                # seconds

[coupling]
method = "hermite"
macro_step = 1e-2          # seconds

[[subsystem]]
name = "own"
command = ["python", "hardening.py"]
parameters = { m = 1.0, c = 100.0, c3 = 4000.0, v0 = 3.0 }

[[subsystem]]
name = "built-in"
model = "oscillator"
parameters = { m = 2.0, c = 400.0, d = 0.5, x0 = 0.0, v0 = 3.0 }

[[joint]]
name = "bolt"
kind = "rigid-link"
a = "own"
b = "built-in"
END
linchpin run masses.toml

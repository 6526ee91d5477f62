"""A template: put your solver in the place of the free mass. python worker.py --help"""

from linchpin_worker import Description, Parameter, StepFailed, Subsystem, Variable, scalar_marker, serve


class Mine(Subsystem):
    """Keep the names of inputs and outputs short: they are the columns of the results."""

    description = Description(
        name="mine",
        text="a free mass: m a = f",
        # What joints and connections drive. With a default an input need not be driven.
        inputs=[Variable("f", "N", "force on the mass", default=0.0)],
        # What joints, connections and results read.
        outputs=[Variable("x", "m", "position"), Variable("v", "m/s", "velocity"), Variable("a", "m/s^2", "acceleration")],
        # What a scene gives. Without a default it must give it.
        parameters=[Parameter("m", "kg", above=0.0, description="mass"), Parameter("v0", "m/s", default=0.0)],
        # Where joints hold. For bodies there are planar_marker and spatial_marker, which name the variables as well.
        markers=[scalar_marker("mass", position="x", velocity="v", acceleration="a", load="f")],
        # True for fixed steps. An adaptive solver leaves it out, and sets the attribute `tolerance`.
        repeats_step_sequence=True,
        # Another process can go on from what `save` gives: numbers, texts, tuples, lists, dicts, arrays. See there.
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        """Brings the solver to its initial state. `raise Refused(field, reason)` if the scene asks for what cannot be."""
        self.m, self.v = setup.numbers("m", "v0")
        self.x = 0.0

    def advance(self, t, step, u):
        """Integrates over the step under inputs that are polynomials of time: u(tau) has them tau seconds after its start."""
        for _tau, h, (start, middle, end) in u.stages(dt=1e-3):
            self.x += h * self.v + h**2 / 6 * (start.f + 2 * middle.f) / self.m
            self.v += h / 6 * (start.f + 4 * middle.f + end.f) / self.m
            self.internal_steps += 1
        if abs(self.x) > 1e6:
            raise StepFailed(f"the mass has left: x = {self.x} m", t + step)

    def outputs(self, t, u):
        """All outputs in the order of the description, under the values `u` of the inputs at `t`."""
        return self.x, self.v, u.f / self.m

    def save(self):
        """The whole state: whatever decides about the next step."""
        return self.x, self.v

    def load(self, state):
        """Goes back to it. The same step must then give the same bits."""
        self.x, self.v = state


if __name__ == "__main__":
    serve(Mine)

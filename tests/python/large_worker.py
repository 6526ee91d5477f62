"""A counter of steps whose state has as many MiB as the parameter says: python large_worker.py --listen ADDRESS."""

from linchpin_worker import Description, Parameter, Subsystem, Variable, serve


class Large(Subsystem):
    description = Description(
        "large", outputs=[Variable("steps")], parameters=[Parameter("mebibytes")], exportable_snapshot=True
    )

    def __init__(self, setup):
        self.steps, self.ballast = 0, bytes(int(setup["mebibytes"]) << 20)

    def advance(self, t, step, u):
        self.steps += 1

    def outputs(self, t, u):
        return [self.steps]

    def save(self):
        return self.steps, self.ballast

    def load(self, state):
        self.steps, self.ballast = state


if __name__ == "__main__":
    serve(Large)

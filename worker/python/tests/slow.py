"""A worker whose long steps take as long as they simulate, unless they are cancelled: python slow.py --listen ADDRESS."""

import time

from linchpin_worker import Description, Subsystem, Variable, serve

PART, SHORT = 1e-3, 5e-3


class Slow(Subsystem):
    """`x' = f` with an internal state that changes in every part of a step."""

    description = Description(
        "slow", inputs=[Variable("f", default=1.0)], outputs=[Variable("x"), Variable("parts")], exportable_snapshot=True
    )

    def __init__(self, setup):
        self.x, self.parts = 0.1, 0

    def advance(self, t, step, u):
        for _, h, (start, middle, end) in u.stages(PART):
            if self.cancelled():
                return
            if step > SHORT:
                time.sleep(h)
            self.x += h / 6 * (start.f + 4 * middle.f + end.f)
            self.parts += 1

    def outputs(self, t, u):
        return self.x, self.parts

    def save(self):
        return self.x, self.parts

    def load(self, state):
        self.x, self.parts = state


if __name__ == "__main__":
    serve(Slow)

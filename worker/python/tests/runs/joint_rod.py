"""The rod of the examples, with joint loads evaluated at every stage: python joint_rod.py --listen ADDRESS."""

import dataclasses
import pathlib
import sys

from linchpin_worker import serve

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples"))

from planar_rod import END, START, Rod


class JointRod(Rod):
    description = dataclasses.replace(Rod.description, joint_loads=True)

    def acceleration(self, state, u):
        x, y, angle, *_ = state
        ends = zip((START, END), self.ends(state), strict=True)
        poses = {marker.name: (x + dx, y + dy, angle) for marker, (dx, dy) in ends}
        return super().acceleration(state, u.with_joint_loads(poses))


serve(JointRod)

"""Laws of joints against differences of their conditions, at the poses of proto/src/joint_load/tests.rs."""

import math
import unittest

from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.geometry import cross, matrix_of_rotation_vector, product, turned
from linchpin_worker.joint_law import A, B, JointLaw, LawError, Pose

POINTS = ((0.3, -0.2, 0.5), (-0.1, 0.4, 0.7))
POSES = (
    Pose.spatial((1.0, -2.0, 0.4), (0.3, 0.5, -0.2, 0.7)),
    Pose.spatial((0.2, 0.6, -1.3), (-0.6, 0.1, 0.4, 0.2)),
)
# Translation and rotation vector of each marker.
DISPLACEMENT = (((0.7, -0.3, 0.2), (-0.5, 0.1, 0.9)), ((-0.2, 0.8, 0.4), (0.6, 0.3, -0.4)))
ZERO = (0.0, 0.0, 0.0)


def unit(*vector):
    return tuple(part / math.hypot(*vector) for part in vector)


def dot(a, b):
    return math.fsum(x * y for x, y in zip(a, b, strict=True))


def added(*vectors):
    return tuple(map(math.fsum, zip(*vectors, strict=True)))


def message(law, end=pb.JOINT_END_A, axis_a=(), axis_b=()):
    return pb.JointLoad(law=law, end=end, point_a=POINTS[A], point_b=POINTS[B], axis_a=axis_a, axis_b=axis_b)


MESSAGES = (
    message(pb.JOINT_LAW_ATPOINT, axis_a=unit(1.0, 2.0, -0.5)),
    message(pb.JOINT_LAW_INPLANE, axis_b=unit(0.3, -1.0, 0.8)),
    message(pb.JOINT_LAW_PERPENDICULAR, axis_a=unit(1.0, 0.2, 0.1), axis_b=unit(-0.4, 0.5, 1.0)),
)
LAWS = tuple(map(JointLaw.of_message, MESSAGES))


def condition(law, poses):
    """The conditions once more, straight from the table."""
    a, b = poses
    apart = [p - q for p, q in zip(a.point(law.points[A]), b.point(law.points[B]), strict=True)]
    if law.law == pb.JOINT_LAW_ATPOINT:
        return dot(apart, law.axes[A])
    normal = turned(b.rotation, law.axes[B])
    if law.law == pb.JOINT_LAW_INPLANE:
        return dot(apart, normal)
    return dot(turned(a.rotation, law.axes[A]), normal)


def moved(scale, parts=((1.0, 1.0), (1.0, 1.0))):
    """The poses after a part of the displacement: shares of the translation and rotation of each marker."""
    poses = []
    for pose, (translation, rotation), (far, much) in zip(POSES, DISPLACEMENT, parts, strict=True):
        position = added(pose.position, [scale * far * part for part in translation])
        turn = matrix_of_rotation_vector([scale * much * part for part in rotation])
        poses.append(Pose(position, product(turn, pose.rotation)))
    return tuple(poses)


class Laws(unittest.TestCase):
    def test_loads_are_gradients_of_the_conditions(self):
        for law in LAWS:
            difference = (condition(law, moved(1e-6)) - condition(law, moved(-1e-6))) / 2e-6
            for end in (A, B):
                force, moment = law.unit_wrench(end, POSES)
                translation, rotation = DISPLACEMENT[end]
                difference -= dot(force, translation) + dot(moment, rotation)
            self.assertAlmostEqual(difference, 0.0, delta=1e-8)

    def test_forces_and_moments_of_the_ends_cancel(self):
        for law in LAWS:
            wrenches = [law.unit_wrench(end, POSES) for end in (A, B)]
            self.assertLess(max(map(abs, added(*(force for force, _ in wrenches)))), 1e-14)
            about_origin = [
                added(moment, cross(pose.position, force)) for (force, moment), pose in zip(wrenches, POSES, strict=True)
            ]
            couple = ZERO
            if law.law == pb.JOINT_LAW_ATPOINT:
                # Where the points are apart, the forces form a couple.
                ends = [pose.point(point) for pose, point in zip(POSES, law.points, strict=True)]
                couple = cross([p - q for p, q in zip(*ends, strict=True)], wrenches[A][0])
            for found, expected in zip(added(*about_origin), couple, strict=True):
                self.assertAlmostEqual(found, expected, delta=1e-14)

    def test_loads_depend_on_what_they_say(self):
        def differs(law, end, parts):
            before, after = (law.unit_wrench(end, poses) for poses in (POSES, moved(1e-3, parts)))
            return max(abs(p - q) for b, a in zip(before, after, strict=True) for p, q in zip(b, a, strict=True)) > 1e-9

        for law in (*LAWS, *(JointLaw(law.law, law.axes, (ZERO, ZERO)) for law in LAWS)):
            for end in (A, B):
                for of in (A, B):
                    only = lambda *parts, of=of: tuple(parts if own == of else (0.0, 0.0) for own in (A, B))
                    reads = law.reads(end, of)
                    self.assertEqual(reads.position, differs(law, end, only(1.0, 0.0)), (law, end, of))
                    self.assertEqual(reads.rotation, differs(law, end, only(0.0, 1.0)), (law, end, of))
                force, moment = law.unit_wrench(end, POSES)
                self.assertEqual(law.acts(end), (any(force), any(moment)), (law, end))

    def test_mistakes_of_messages_are_named(self):
        def mistake(**change):
            wrong = pb.JointLoad()
            wrong.CopyFrom(MESSAGES[2])
            for field, value in change.items():
                if isinstance(value, list):
                    getattr(wrong, field)[:] = value
                else:
                    setattr(wrong, field, value)
            with self.assertRaises(LawError) as caught:
                JointLaw.of_message(wrong)
            return caught.exception.field, str(caught.exception)

        for change, field, words in (
            ({"law": 7}, "law", "law 7 is unknown; known are 1 (atpoint), 2 (inplane) and 3 (perpendicular)"),
            ({"end": 0}, "end", "end 0 is unknown; known are 1 (a) and 2 (b)"),
            ({"point_b": []}, "point_b", "point_b must be three finite numbers"),
            ({"axis_a": [math.nan, 0.0, 0.0]}, "axis_a", "axis_a must be three finite numbers"),
            ({"axis_b": [2.0, 0.0, 0.0]}, "axis_b", "axis_b has the length 2.0; it must be a unit vector"),
        ):
            self.assertEqual(mistake(**change), (field, words))

    def test_planar_poses_turn_about_the_third_axis(self):
        x, y, z = Pose.planar(1.0, 2.0, 0.5 * math.pi).point((1.0, 0.0, 0.0))
        self.assertAlmostEqual(x, 1.0)
        self.assertEqual((y, z), (3.0, 0.0))

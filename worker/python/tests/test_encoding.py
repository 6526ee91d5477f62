"""States as bytes: every value comes back bit by bit, and bytes that are no value are refused and make nothing."""

import collections
import math
import pickle
import random
import struct
import subprocess
import sys
import unittest

import numpy as np

from linchpin_worker.encoding import ALLOWED, DEEPEST, FORMAT, Damaged, NotPortable, decode, encode

# A number that is none, with a payload and a sign.
ODD_NAN = struct.unpack("<d", bytes.fromhex("0df0adba0000f8ff"))[0]
FLOATS = (0.0, -0.0, 0.1 + 0.2, 5e-324, -1.7976931348623157e308, math.inf, -math.inf, ODD_NAN)
INTS = (0, 1, -1, 127, 128, -128, -129, 255, 256, 2**63, -(2**63), 2**64 - 1, 10**5000, -(10**5000))
TEXTS = ("", "x", "h\u00f6he \u2207\U0001f600", "\0", "\ud83d")
RANDOM = 3000


def bits(value):
    return struct.pack("<d", value)


def shown(value):
    """A value as a text in which every bit and every type can be seen."""
    match value:
        case float() if type(value) is float:
            return bits(value).hex()
        case tuple() | list():
            return f"{type(value).__name__}{[shown(own) for own in value]}"
        case dict():
            return str([(shown(key), shown(own)) for key, own in value.items()])
        case np.ndarray() | np.generic():
            return f"{type(value).__name__} {value.dtype.str} {value.shape} {value.tobytes().hex()}"
    return hex(value) if type(value) is int else repr(value)


def arrays():
    """Arrays of every kind of number, in every order in memory."""
    plain = np.arange(24.0).reshape(2, 3, 4) / 7.0
    yield from (plain.astype(kind) for kind in ("?", "i1", "u8", "i4", "f2", "f4", "f8", "g", "c8", "c16", ">f8", ">i2"))
    yield from (plain.transpose(axes).copy("K") for axes in ((0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)))
    yield from (plain[:, ::2, ::-1], plain[:1].T, plain[:, :1].transpose(2, 0, 1), np.broadcast_to(plain, (5, 2, 3, 4)))
    yield from (np.array(ODD_NAN), np.zeros(0), np.zeros((3, 0, 2)), np.zeros((1, 1, 1)), np.zeros((3, 0), order="F"))


class Values(unittest.TestCase):
    def assert_comes_back(self, value):
        found = decode(encode(value))
        self.assertIs(type(found), type(value))
        self.assertEqual(encode(found), encode(value))
        return found

    def test_what_stands_in_the_bytes(self):
        """Written out by hand from the description of the encoding."""
        number = lambda n: struct.pack("<Q", n)
        for value, expected in (
            (None, b"N"),
            ((True, False), b"t" + number(2) + b"TF"),
            ([1.5], b"l" + number(1) + b"d" + struct.pack("<d", 1.5)),
            ({"x": -129}, b"m" + number(1) + b"s" + number(1) + b"xi" + number(2) + b"\x7f\xff"),
            (b"\0\1", b"b" + number(2) + b"\0\1"),
            (np.array([[1, 2]], "i2", order="C"),
             b"a" + number(3) + b"<i2" + b"".join(map(number, (2, 0, 1, 1, 2, 4))) + b"\1\0\2\0"),
        ):  # fmt: skip
            self.assertEqual(encode(value), b"\x01" + expected)

    def test_plain_values_come_back(self):
        for value in (None, True, False, *INTS, *TEXTS, b"", b"\0\xff"):
            self.assertEqual(self.assert_comes_back(value), value)
        for value in FLOATS:
            self.assertEqual(bits(self.assert_comes_back(value)), bits(value))

    def test_containers_come_back_with_their_types_and_order(self):
        value = {"b": [(), [], {}], "a": ((1, 1.0, True), [None]), 3: {(1, "x"): 2.0}, 2.5: b"s", None: "t", True: False}
        found = self.assert_comes_back(value)
        self.assertEqual(found, value)
        self.assertEqual(list(found), list(value))
        self.assertEqual([type(one) for one in found["a"][0]], [int, float, bool])

    def test_arrays_come_back_with_their_order_in_memory(self):
        for array in arrays():
            with self.subTest(dtype=array.dtype, shape=array.shape, strides=array.strides):
                found = self.assert_comes_back(array)
                self.assertEqual((found.dtype, found.shape), (array.dtype, array.shape))
                self.assertEqual(found.tobytes(), array.tobytes())
                own = array.copy("K")
                self.assertEqual(
                    (found.flags.c_contiguous, found.flags.f_contiguous), (own.flags.c_contiguous, own.flags.f_contiguous)
                )
                self.assertTrue(found.flags.writeable and found.flags.owndata)
                np.testing.assert_array_equal(found, array)

    def test_scalars_of_numpy_keep_their_type(self):
        for value in (np.float64(0.1), np.float32(ODD_NAN), np.int8(-3), np.bool_(True), np.complex128(1.0, -0.0)):
            self.assertEqual(self.assert_comes_back(value).tobytes(), value.tobytes())

    def test_a_copy_shares_nothing(self):
        value = [np.zeros(3), [1.0]]
        found = decode(encode(value))
        found[0][1], found[1][0] = 7.0, 7.0
        self.assertEqual((value[0][1], value[1][0]), (0.0, 1.0))

    def test_a_program_without_numpy_needs_none(self):
        program = (
            "import sys; from linchpin_worker.encoding import decode, encode; state = (1.5, ['a', {2: b'c'}]);"
            "assert decode(encode(state)) == state; assert 'numpy' not in sys.modules and 'pickle' not in sys.modules"
        )
        # As the package would be without its first module, which imports all of it.
        lone = "import sys, types; package = types.ModuleType('linchpin_worker'); package.__path__ = [sys.argv[1]];"
        source = sys.modules["linchpin_worker"].__path__[0]
        command = [sys.executable, "-c", f"{lone} sys.modules['linchpin_worker'] = package; {program}", source]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        blocked = (
            f"{lone} sys.modules['linchpin_worker'] = package; sys.modules['numpy'] = None;"
            "from linchpin_worker.encoding import decode; decode(bytes.fromhex(sys.argv[2]))"
        )
        command = [sys.executable, "-c", blocked, source, encode(np.zeros(2)).hex()]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertIn("Damaged: byte 2: an array, and this worker has no NumPy", done.stderr)


Point = collections.namedtuple("Point", "x y")


class Refused(unittest.TestCase):
    def test_what_is_not_allowed_is_named_with_its_place(self):
        records = np.zeros(2, [("x", "f8")])
        for value, words in (
            ({1.0}, "state is of type builtins.set"),
            ((0.0, [object()]), r"state\[1\]\[0\] is of type builtins.object"),
            ({"at": Point(1, 2)}, r"state\['at'\] is of type .*test_encoding.Point"),
            ({frozenset(): 1}, "the key of type frozenset of state is of type builtins.frozenset"),
            ([np.array([None])], r"state\[0\] is an array of object"),
            (records, r"state is an array of \[\('x', '<f8'\)\]"),
            (np.array(["a"]), "state is an array of <U1"),
            (np.datetime64(1, "s"), r"state is a scalar of datetime64\[s\]"),
            (np.ma.zeros(2), "state is of type numpy.ma.MaskedArray"),
            (collections.OrderedDict(), "state is of type collections.OrderedDict"),
            (bytearray(2), "state is of type builtins.bytearray"),
            (len, "state is of type builtins.builtin_function_or_method"),
        ):
            with self.subTest(words=words):
                with self.assertRaisesRegex(NotPortable, words) as caught:
                    encode(value)
                self.assertIn(f"allowed are {ALLOWED}", str(caught.exception))

    def test_what_can_be_changed_in_two_places_is_refused(self):
        own, numbers = [1.0], np.zeros(2)
        own_loop = []
        own_loop.append(own_loop)
        for value, words in (
            ((own, own), r"state\[1\] is state\[0\] once more"),
            ({"a": numbers, "b": (numbers,)}, r"state\['b'\]\[0\] is state\['a'\] once more"),
            (own_loop, r"state\[0\] is state once more"),
        ):
            with self.assertRaisesRegex(NotPortable, words):
                encode(value)
        point = (1.0, 2.0)
        self.assertEqual(decode(encode((point, point))), (point, point))

    def test_depth_has_a_limit(self):
        value = ()
        for _ in range(DEEPEST - 1):
            value = (value,)
        self.assertEqual(decode(encode(value)), value)
        with self.assertRaisesRegex(NotPortable, f"more than {DEEPEST} deep"):
            encode((value,))
        with self.assertRaisesRegex(Damaged, f"more than {DEEPEST} tuples"):
            decode(FORMAT + (b"t" + struct.pack("<Q", 1)) * 100000 + b"N")


class Bytes(unittest.TestCase):
    def setUp(self):
        self.random = random.Random(5)

    def value(self, depth=3):
        pick = self.random
        makers = [
            lambda: pick.choice([None, True, False]),
            lambda: pick.choice(FLOATS),
            lambda: pick.uniform(-1e3, 1e3),
            lambda: pick.choice(INTS[:-2]),
            lambda: pick.choice(TEXTS),
            lambda: pick.randbytes(pick.randint(0, 5)),
            lambda: pick.choice(list(arrays())).copy("K"),
            lambda: np.float64(pick.random()),
            lambda: tuple(self.value(depth - 1) for _ in range(pick.randint(0, 3))),
            lambda: [self.value(depth - 1) for _ in range(pick.randint(0, 3))],
            lambda: {pick.choice(INTS): self.value(depth - 1) for _ in range(pick.randint(0, 3))},
        ]
        return pick.choice(makers if depth else makers[:-3])()

    def assert_value_or_damaged(self, encoded):
        """Bytes are those of one value, or they are refused. Tells whether they are refused."""
        try:
            value = decode(encoded)
        except Damaged as damaged:
            self.assertRegex(str(damaged), "byte|the state ends")
            return True
        self.assertEqual(encode(value), encoded)
        return False

    def test_any_value_has_one_encoding_and_comes_back(self):
        for _ in range(RANDOM // 3):
            value = self.value()
            found = decode(encode(value))
            self.assertEqual(encode(found), encode(value))
            self.assertEqual(shown(found), shown(value))

    def test_what_breaks_off_or_goes_on_is_refused(self):
        for _ in range(RANDOM // 30):
            encoded = encode(self.value())
            cuts = range(len(encoded)) if len(encoded) < 300 else self.random.sample(range(len(encoded)), 300)
            for end in cuts:
                with self.assertRaises(Damaged):
                    decode(encoded[:end])
            with self.assertRaisesRegex(Damaged, f"the state ends after {len(encoded)} of {len(encoded) + 1} bytes"):
                decode(encoded + b"N")

    def test_changed_bytes_are_another_value_or_refused(self):
        refused = 0
        for _ in range(RANDOM):
            changed = bytearray(encode(self.value()))
            for _ in range(self.random.randint(1, 3)):
                changed[self.random.randrange(len(changed))] = self.random.choice([0, 1, 255, self.random.randrange(256)])
            refused += self.assert_value_or_damaged(bytes(changed))
        self.assertGreater(refused, RANDOM // 5)

    def test_random_bytes_are_another_value_or_refused(self):
        tags = b"NTFdisbtlman\0\0\0\0\0\1\2"
        for _ in range(RANDOM):
            count = self.random.randint(0, 40)
            self.assert_value_or_damaged(self.random.randbytes(count))
            self.assert_value_or_damaged(FORMAT + bytes(self.random.choices(tags, k=count)))

    def test_each_damage_is_named(self):
        number = lambda n: struct.pack("<Q", n)
        array = lambda dtype, *numbers, data=b"": b"a" + number(len(dtype)) + dtype + b"".join(map(number, numbers)) + data
        for body, words in (
            (b"", "breaks off: 1 bytes are needed at byte 1, 0 are there"),
            (b"x", "byte 1 is b'x', which begins no value"),
            (b"b" + number(2**63), "breaks off: 9223372036854775808 bytes are needed"),
            (b"t" + number(2**63) + b"N", "breaks off"),
            (b"i" + number(2) + b"\1\0", "byte 2: an int in 2 bytes"),
            (b"i" + number(0), "byte 2: an int in 0 bytes"),
            (b"s" + number(1) + b"\xff", "byte 2: no UTF-8"),
            (b"m" + number(2) + b"NTNT", "byte 2: a dict with the key of type NoneType twice"),
            (b"m" + number(1) + b"l" + number(0) + b"N", "byte 2: a dict with a key of type list"),
            (array(b"|O", 1, 0, 1, 8, data=bytes(8)), r"no numbers of the dtype '\|O'"),
            (array(b"f8,i4", 0, 0), "no numbers of the dtype 'f8,i4'"),
            (array(b"<f3", 0, 0), "no numbers of the dtype '<f3'"),
            (array(b"<i1", 0, 1, data=b"\1"), "no numbers of the dtype '<i1'"),
            (array(b"<f8", 1, 0, 2, 8, data=bytes(8)), r"axes \[0\] of \[2\] elements of float64 in 8 bytes"),
            (array(b"<f8", 1, 1, 1, 8, data=bytes(8)), r"axes \[1\]"),
            (array(b"<f8", 2, 0, 2**62, 1, 0, 0), "that NumPy refuses|axes"),
            (array(b"<f8", 2, 1, 1, 0, 1, 8, data=bytes(8)), r"axes in the order \[1, 0\]"),
            (array(b"|b1", 1, 0, 1, 1, data=b"\2"), "neither 0 nor 1"),
            (b"n" + array(b"<f8", 1, 0, 1, 8, data=bytes(8))[1:], "no scalar of NumPy has 1 axes"),
            (b"n" + array(b">f8", 0, 8, data=bytes(8))[1:], "the order of bytes of >f8"),
        ):
            with self.subTest(words=words), self.assertRaisesRegex(Damaged, words):
                decode(FORMAT + body)
        for foreign in (b"\x02N", pickle.dumps((1.0, 2.0)), b"junk"):
            with self.assertRaisesRegex(Damaged, f"byte 0 is {foreign[0]:#04x}; .* begin with 0x01"):
                decode(foreign)

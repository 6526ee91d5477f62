"""States of solvers as bytes, without pickle: bytes of a peer can make no object but those that are named here.

A value is a tag of one byte and what follows; lengths and counts are 8 bytes, everything is little-endian:

    N T F    None, True, False
    d        float: its 8 bytes
    i        int: length, then its two's complement in as few bytes as hold it
    s b      str in UTF-8, bytes: length, then the bytes
    t l m    tuple, list, dict: count, then the items; of a dict each key before its value
    a        array of NumPy: its dtype as a str (in the form of s), count of axes, for each from the slowest to the fastest its
             place and its length, then length and bytes of the elements in this order
    n        scalar of NumPy, as an array without axes

In front of the whole stands `FORMAT`. A value has one encoding only.
"""

from __future__ import annotations

import importlib
import math
import re
import struct
import sys
from collections.abc import Callable
from typing import Any

FORMAT = b"\x01"

DEEPEST = 64
"""How many tuples, lists and dicts may stand in each other."""

NUMBERS = "biufc"
"""Kinds of NumPy's dtypes that arrays may have: bool, integers, floats, complex numbers."""

ALLOWED = "None, bool, int, float, str, bytes, tuple, list, dict, and arrays and scalars of NumPy that are numbers or bool"


class NotPortable(ValueError):
    """A value that has no bytes of its own; the text says where it is and what is allowed."""


class Damaged(ValueError):
    """Bytes that no value has."""


def encode(value: Any) -> bytes:
    """The bytes of a value; floats bit by bit, arrays with the order of their elements in memory."""
    writer = _Writer()
    writer.put(value, "state", 0)
    return b"".join(writer.parts)


def decode(encoded: bytes) -> Any:
    """The value of these bytes; `Damaged` if no value has them."""
    reader = _Reader(encoded)
    if reader.take(len(FORMAT)) != FORMAT:
        raise Damaged(f"byte 0 is {encoded[0]:#04x}; states of this format begin with {FORMAT[0]:#04x}")
    value = reader.value(0)
    if reader.place < len(encoded):
        raise Damaged(f"the state ends after {reader.place} of {len(encoded)} bytes")
    return value


def _length(number: int) -> bytes:
    return struct.pack("<Q", number)


def _int(number: int) -> bytes:
    # One bit more than the magnitude takes, for the sign.
    bits = (number if number >= 0 else ~number).bit_length() + 1
    return number.to_bytes((bits + 7) // 8, "little", signed=True)


def _axes(array: Any) -> list[int]:
    """The axes of an array from the slowest to the fastest, as they are in memory; first those that lead nowhere."""
    if array.size == 0:
        return list(range(array.ndim))
    return sorted(range(array.ndim), key=lambda axis: -abs(array.strides[axis]) if array.shape[axis] > 1 else -math.inf)


def _shown(key: Any) -> str:
    return f"{key!r:.40}" if isinstance(key, str) else f"of type {type(key).__name__}"


class _Writer:
    def __init__(self) -> None:
        self.parts = [FORMAT]
        # What can be changed in place: another instance would get two of what is one here.
        self._met: dict[int, str] = {}

    def put(self, value: Any, place: str, depth: int) -> None:
        kind = type(value)
        if kind in _WRITERS:
            self.parts.append(_WRITERS[kind](value))
        elif kind in _BEGINNINGS:
            self._put_items(value, place, depth)
        else:
            self._put_numbers(value, place)

    def _put_items(self, value: Any, place: str, depth: int) -> None:
        if depth >= DEEPEST:
            raise NotPortable(f"{place} is more than {DEEPEST} deep in tuples, lists and dicts; make the state flatter")
        if type(value) is not tuple:
            self._meet(value, place)
        self.parts += [_BEGINNINGS[type(value)], _length(len(value))]
        if type(value) is dict:
            for key, item in value.items():
                self.put(key, f"the key {_shown(key)} of {place}", depth + 1)
                self.put(item, f"{place}[{_shown(key)}]", depth + 1)
        else:
            for number, item in enumerate(value):
                self.put(item, f"{place}[{number}]", depth + 1)

    def _put_numbers(self, value: Any, place: str) -> None:
        # A program that has not imported NumPy has nothing of it.
        numpy: Any = sys.modules.get("numpy")
        is_array = numpy is not None and type(value) is numpy.ndarray
        if not is_array and not (numpy is not None and isinstance(value, numpy.generic)):
            raise NotPortable(f"{place} is of type {type(value).__module__}.{type(value).__qualname__}; allowed are {ALLOWED}")
        array = value if is_array else numpy.asarray(value)
        if array.dtype.kind not in NUMBERS:
            raise NotPortable(f"{place} is {'an array' if is_array else 'a scalar'} of {array.dtype}; allowed are {ALLOWED}")
        if is_array:
            self._meet(value, place)
        axes = _axes(array)
        data = array.transpose(axes).tobytes()
        self.parts += [b"a" if is_array else b"n", _text(array.dtype.str), _length(array.ndim)]
        self.parts += [_length(number) for axis in axes for number in (axis, array.shape[axis])]
        self.parts += [_length(len(data)), data]

    def _meet(self, value: Any, place: str) -> None:
        if id(value) in self._met:
            raise NotPortable(f"{place} is {self._met[id(value)]} once more; give a copy of it, or give it once")
        self._met[id(value)] = place


def _text(text: str) -> bytes:
    # Any str, also one that no Unicode text has.
    encoded = text.encode("utf-8", "surrogatepass")
    return _length(len(encoded)) + encoded


_BEGINNINGS: dict[type, bytes] = {tuple: b"t", list: b"l", dict: b"m"}

_WRITERS: dict[type, Callable[[Any], bytes]] = {
    type(None): lambda _: b"N",
    bool: lambda value: b"T" if value else b"F",
    float: lambda value: b"d" + struct.pack("<d", value),
    int: lambda value: b"i" + _length(len(_int(value))) + _int(value),
    str: lambda value: b"s" + _text(value),
    bytes: lambda value: b"b" + _length(len(value)) + value,
}


class _Reader:
    def __init__(self, encoded: bytes) -> None:
        self._encoded = encoded
        self.place = 0

    def take(self, count: int) -> bytes:
        left = len(self._encoded) - self.place
        if count > left:
            raise Damaged(f"the state breaks off: {count} bytes are needed at byte {self.place}, {left} are there")
        self.place += count
        return self._encoded[self.place - count : self.place]

    def value(self, depth: int) -> Any:
        place, tag = self.place, self.take(1)
        match tag:
            case b"N":
                return None
            case b"T" | b"F":
                return tag == b"T"
            case b"d":
                return struct.unpack("<d", self.take(8))[0]
            case b"i":
                return self._int()
            case b"s":
                return self._text()
            case b"b":
                return self.take(self._length())
            case b"t" | b"l" | b"m":
                if depth >= DEEPEST:
                    raise Damaged(f"byte {place}: more than {DEEPEST} tuples, lists and dicts in each other")
                return self._items(tag, depth + 1)
            case b"a" | b"n":
                return self._numbers(is_array=tag == b"a")
        raise Damaged(f"byte {place} is {tag!r}, which begins no value")

    def _length(self) -> int:
        number: int = struct.unpack("<Q", self.take(8))[0]
        return number

    def _int(self) -> int:
        place = self.place
        encoded = self.take(self._length())
        number = int.from_bytes(encoded, "little", signed=True)
        if _int(number) != encoded:
            raise Damaged(f"byte {place}: an int in {len(encoded)} bytes, which are not as few as hold it")
        return number

    def _text(self) -> str:
        place = self.place
        try:
            return self.take(self._length()).decode("utf-8", "surrogatepass")
        except UnicodeDecodeError as error:
            raise Damaged(f"byte {place}: no UTF-8: {error.reason}") from error

    def _items(self, tag: bytes, depth: int) -> Any:
        place, count = self.place, self._length()
        if tag != b"m":
            items = [self.value(depth) for _ in range(count)]
            return tuple(items) if tag == b"t" else items
        found: dict[Any, Any] = {}
        for _ in range(count):
            key = self.value(depth)
            try:
                is_double = key in found
            except TypeError as error:
                raise Damaged(f"byte {place}: a dict with a key of type {type(key).__name__}") from error
            if is_double:
                raise Damaged(f"byte {place}: a dict with the key {_shown(key)} twice")
            found[key] = self.value(depth)
        return found

    def _numbers(self, is_array: bool) -> Any:
        place, dtype = self.place, self._dtype()
        pairs = [(self._length(), self._length()) for _ in range(self._length())]
        axes, lengths = [axis for axis, _ in pairs], [length for _, length in pairs]
        data = self.take(self._length())
        if sorted(axes) != list(range(len(axes))) or dtype.itemsize * math.prod(lengths) != len(data):
            raise Damaged(f"byte {place}: an array with axes {axes} of {lengths} elements of {dtype} in {len(data)} bytes")
        if dtype.kind == "b" and max(data, default=0) > 1:
            raise Damaged(f"byte {place}: an array of bool with an element that is neither 0 nor 1")
        numpy = importlib.import_module("numpy")
        try:
            stored = numpy.ndarray(lengths, dtype, bytearray(data))
        except (ValueError, OverflowError) as error:
            raise Damaged(f"byte {place}: an array that NumPy refuses: {error}") from error
        array = stored.transpose(sorted(range(len(axes)), key=axes.__getitem__)).copy("K")
        if _axes(array) != axes:
            raise Damaged(f"byte {place}: an array with axes in the order {axes}, which is not the one in memory")
        if is_array:
            return array
        if axes or not dtype.isnative:
            raise Damaged(f"byte {place}: no scalar of NumPy has {len(axes)} axes, or the order of bytes of {dtype.str}")
        return array[()]

    def _dtype(self) -> Any:
        place, text = self.place, self._text()
        try:
            # NumPy would read much more than the names of numbers.
            if re.fullmatch(rf"[<>|][{NUMBERS}][0-9]{{1,2}}", text):
                dtype = importlib.import_module("numpy").dtype(text)
                if dtype.str == text:
                    return dtype
        except ImportError as error:
            raise Damaged(f"byte {place}: an array, and this worker has no NumPy") from error
        except TypeError:
            pass
        raise Damaged(f"byte {place}: this machine has no numbers of the dtype {text!r:.40}")

"""Where the program is looked for, and how it is called."""

import os
import pathlib
import tempfile
import unittest
from unittest import mock

import numpy as np
from scenes import OSCILLATOR, PROGRAM

import linchpin_cosim as lc
from linchpin_cosim.messages import read_messages
from linchpin_cosim.settings import set_arguments


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.enterContext(mock.patch.dict(os.environ, {"PATH": str(self.folder / "path")}))
        os.environ.pop("LINCHPIN", None)

    def program(self, *place):
        path = self.folder.joinpath(*place)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
        return path

    def test_argument_variable_path_and_checkout_in_this_order(self):
        inside = self.folder / "checkout" / "a" / "b"
        inside.mkdir(parents=True)
        self.addCleanup(os.chdir, pathlib.Path.cwd())
        os.chdir(inside)
        built = self.folder / "checkout" / "target" / "release" / "linchpin"
        built.parent.mkdir(parents=True)
        built.write_text("#!/bin/sh\n")
        built.chmod(0o755)
        self.assertEqual(lc.find_program(), built)
        for place in ("path/linchpin", "variable", "argument"):
            path = self.program(*place.split("/"))
            path.unlink()
            path.write_text("#!/bin/sh\n")
            path.chmod(0o755)
        self.assertEqual(lc.find_program(), self.folder / "path" / "linchpin")
        os.environ["LINCHPIN"] = str(self.folder / "variable")
        self.assertEqual(lc.find_program(), self.folder / "variable")
        self.assertEqual(lc.find_program(self.folder / "argument"), self.folder / "argument")

    def test_one_that_is_named_must_be_there(self):
        with self.assertRaisesRegex(lc.ProgramNotFound, "program = '/no/where'"):
            lc.find_program("/no/where")
        os.environ["LINCHPIN"] = "/no/there"
        with self.assertRaisesRegex(lc.ProgramNotFound, "LINCHPIN = '/no/there'"):
            lc.check(OSCILLATOR)

    def test_none_at_all_tells_how_to_have_one(self):
        self.addCleanup(os.chdir, pathlib.Path.cwd())
        os.chdir(self.folder)
        with (
            mock.patch("linchpin_cosim.program.BUILT", pathlib.Path("nothere")),
            self.assertRaisesRegex(lc.ProgramNotFound, "cargo build --release.*LINCHPIN"),
        ):
            lc.find_program()


class Settings(unittest.TestCase):
    def test_values_are_those_of_toml(self):
        for value, text in (
            (1e-7, "1e-07"),
            (5, "5"),
            (True, "true"),
            ("2H", '"2H"'),
            ('say "ä"', r'"say \"ä\""'),
            (np.float64(0.1), "0.1"),
            (np.arange(3), "[0, 1, 2]"),
            ([0.5, [1, "a"]], '[0.5, [1, "a"]]'),
            ({"kind": "exact"}, '{ "kind" = "exact" }'),
        ):
            with self.subTest(value=value):
                self.assertEqual(set_arguments({"a.b": value}), ["--set", f"a.b={text}"])

    def test_other_values_are_refused(self):
        with self.assertRaisesRegex(TypeError, "a.b = None is of the type NoneType; it must be a number"):
            set_arguments({"a.b": None})

    def test_the_program_takes_them(self):
        settings = {
            "subsystem.*.solver": {"kind": "radau5", "rtol": 1e-9},
            "coupling.beta": "2H",
            "joint.link.kind": "rigid-link",
        }
        self.assertEqual(lc.check(OSCILLATOR, set=settings, program=PROGRAM), [])


class Check(unittest.TestCase):
    def test_every_mistake_with_its_place_and_help(self):
        problems = lc.check(OSCILLATOR, set={"coupling.indx": 3, "coupling.macro_stp": 1}, program=PROGRAM)
        self.assertEqual([problem.level for problem in problems], ["error", "error"])
        self.assertEqual(problems[0].help, "did you mean `index`?")
        self.assertRegex(str(problems[0]), "(?s)^--set coupling.indx=3: .*\n  help: did")

    def test_a_warning_does_not_refuse(self):
        (problem,) = lc.check(OSCILLATOR, set={"coupling.degree": 2}, program=PROGRAM)
        self.assertEqual(problem.level, "warning")
        self.assertIn("unstable", problem.message)
        self.assertIn("degree = 0", problem.help)

    def test_a_program_that_is_none_of_ours(self):
        with self.assertRaisesRegex(lc.LinchpinError, "told no reason"):
            lc.check(OSCILLATOR, program="false")

    def test_lines_that_go_on_and_lines_of_a_log(self):
        text = "2026 WARN a log\nerror: one\n  two\n  help: three\n  four\n\nwarning: five\n"
        (error, warning), others = read_messages(text)
        self.assertEqual((error.message, error.help, warning.message), ("one two", "three four", "five"))
        self.assertEqual(others, ["2026 WARN a log"])


if __name__ == "__main__":
    unittest.main()

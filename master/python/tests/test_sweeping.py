"""Sweeps over settings."""

import pathlib
import tempfile
import threading
import time
import unittest

from scenes import LONG, OSCILLATOR, PROGRAM, two_cases

import linchpin_cosim as lc


def sweep(settings, scene=OSCILLATOR, **options):
    return lc.sweep(scene, settings, in_process=True, program=PROGRAM, **options)


class Sweep(unittest.TestCase):
    def test_a_row_for_every_combination_in_order(self):
        table = sweep({"coupling.macro_step": [4e-3, 2e-3], "subsystem.mass2.parameters.m": [2.0, 3.0]}, processes=3)
        self.assertEqual(list(table["coupling.macro_step"]), [4e-3, 4e-3, 2e-3, 2e-3])
        self.assertEqual(list(table["subsystem.mass2.parameters.m"]), [2.0, 3.0, 2.0, 3.0])
        self.assertEqual(list(table["macro_steps"]), [250, 250, 500, 500])
        self.assertEqual(set(table["status"]), {"done"})
        self.assertLess(table["error"][2], table["error"][0])

    def test_figures_are_places_in_run_json_or_functions(self):
        figures = {"H": "macro_step", "end": lambda run: run.results["mass1.x"].iloc[-1], "moments": "statistics.moments.a"}
        table = sweep({"coupling.macro_step": [1e-2, 1e-3]}, figures=figures)
        self.assertEqual(list(table["H"]), [1e-2, 1e-3])
        own = lc.run(OSCILLATOR, in_process=True, program=PROGRAM)
        self.assertEqual(table["end"][1], own.results["mass1.x"].iloc[-1])
        self.assertTrue(table["moments"].isna().all())
        with self.assertRaisesRegex(ValueError, 'figure "n": run.json has no statistics.steeps; .*there is: macro_steps'):
            sweep({"coupling.macro_step": [1e-2]}, figures={"n": "statistics.steeps"})

    def test_runs_that_fail_or_are_refused_are_rows_with_their_reason(self):
        table = sweep({"coupling.degree": [0, 2, 9]})
        self.assertEqual(list(table["status"]), ["done", "failed", "refused"])
        self.assertRegex(table["message"][1], "^the run diverged at t = ")
        self.assertRegex(table["message"][2], "coupling.degree=9")
        self.assertTrue(table["macro_steps"][1:].isna().all())

    def test_a_setting_that_no_run_takes_is_an_error(self):
        with self.assertRaisesRegex(lc.SceneError, "did you mean `index`"):
            sweep({"coupling.indx": [1, 2]})

    def test_every_case_has_a_row(self):
        with two_cases() as scene:
            table = sweep({"coupling.macro_step": [1e-3]}, scene)
        self.assertEqual(list(table["case"]), ["sound", "wild", "behind"])
        self.assertEqual(list(table["status"]), ["done", "failed", "missing"])

    def test_no_more_processes_than_allowed(self):
        with tempfile.TemporaryDirectory() as folder:
            # Notes its start and its end, and is the program in between.
            program, notes = pathlib.Path(folder, "program"), pathlib.Path(folder, "notes")
            program.write_text(f'#!/bin/sh\necho 1 >>{notes}\n{PROGRAM} "$@"\nsleep 0.2\necho -1 >>{notes}\n')
            program.chmod(0o755)
            for processes in (1, 3):
                notes.unlink(missing_ok=True)
                steps = {"coupling.macro_step": [1e-2, 9e-3, 8e-3, 7e-3, 6e-3]}
                lc.sweep(OSCILLATOR, steps, in_process=True, processes=processes, program=program)
                under_way = most = 0
                for note in notes.read_text().split():
                    under_way += int(note)
                    most = max(most, under_way)
                self.assertLessEqual(most, processes)
                self.assertEqual((under_way, most > 1), (0, processes > 1))
        with self.assertRaisesRegex(ValueError, "processes = 0: it must be at least 1"):
            sweep({"coupling.macro_step": [1e-2]}, processes=0)

    def test_an_error_ends_the_runs_that_are_under_way(self):
        began = time.monotonic()
        first = threading.Event()

        def figure(run):
            if not first.is_set():
                first.set()
                raise LookupError("no such figure")

        with self.assertRaises(LookupError):
            sweep({"scene.t_end": [0.1, LONG["scene.t_end"]]}, figures={"a": figure}, processes=2)
        self.assertLess(time.monotonic() - began, 30.0)


if __name__ == "__main__":
    unittest.main()

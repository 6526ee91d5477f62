"""Runs: their results, what they tell, how they fail."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest
import warnings

import pandas as pd
from scenes import DIVERGES, LONG, OSCILLATOR, PACKAGE, PROGRAM, SCENES, WARNS, two_cases

import linchpin_cosim as lc


def run(settings=None, scene=OSCILLATOR, **options):
    return lc.run(scene, set=settings, in_process=True, program=PROGRAM, **options)


class Results(unittest.TestCase):
    def test_the_columns_are_those_of_the_program_bit_by_bit_with_their_units(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run(out=folder)
            lines = pathlib.Path(folder, "results.csv").read_text().splitlines()
            self.assertEqual(done.folder, pathlib.Path(folder))
            self.assertFalse(pathlib.Path(folder, "results.svg").exists())
        self.assertEqual(["t", *done.results.columns], lines[0].split(","))
        self.assertEqual(done.results.index.name, "t")
        for place in (1, 500, 1001):
            row = [done.results.index[place - 1], *done.results.iloc[place - 1]]
            self.assertEqual(row, [float(number) for number in lines[place].split(",")])
        self.assertEqual(done.results.attrs["units"], done.units)
        units = {"t": "s", "mass1.x": "m", "mass2.v": "m/s", "link.lambda": "N", "error_estimate": "1"}
        self.assertLessEqual(units.items(), done.units.items())

    def test_a_run_in_worker_processes_has_the_same_bits(self):
        pd.testing.assert_frame_equal(lc.run(OSCILLATOR, program=PROGRAM).results, run().results, check_exact=True)

    def test_what_run_json_tells(self):
        done = run()
        self.assertEqual((done.scene, done.status, done.reason, done.folder), ("oscillator", "done", None, None))
        self.assertEqual(done.verdicts, {"good": 1000, "fair": 0, "poor": 0, "uncorrected": 0})
        self.assertEqual(done.statistics["macro_steps"], 1000)
        self.assertEqual(done.warnings, [])
        estimate = done.error_estimate
        self.assertEqual(estimate.largest, done.info["statistics"]["estimated_errors"]["largest"])
        self.assertLess(0.0, estimate.accumulated)
        self.assertIn(estimate.of, done.results.columns)
        self.assertEqual(repr(done), "<Run of oscillator: done, 1001 macro points, 0 warnings>")

    def test_a_run_without_a_joint_has_no_estimate(self):
        done = run({"scene.t_end": 0.1}, SCENES / "s2" / "bouncing-ball.toml")
        self.assertIsNone(done.error_estimate)

    def test_pictures_and_an_animation_need_a_folder(self):
        for option in ({"plots": True}, {"animate": True}):
            with self.subTest(option=option), self.assertRaisesRegex(ValueError, "out ="):
                run(**option)
        with tempfile.TemporaryDirectory() as folder:
            run(out=folder, plots=True, animate=True)
            names = {file.name for file in pathlib.Path(folder).iterdir()}
        self.assertLessEqual({"results.csv", "run.json", "results.svg", "results.png", "animation.html"}, names)

    def test_threads_are_those_of_models_in_this_process(self):
        with self.assertRaisesRegex(ValueError, "in_process = True"):
            lc.run(OSCILLATOR, threads=True, program=PROGRAM)
        pd.testing.assert_frame_equal(run(threads=True).results, run().results, check_exact=True)

    def test_the_cases_of_a_scene(self):
        with two_cases() as scene, self.assertRaises(lc.RunFailed) as caught:
            run(scene=scene)
        kept = caught.exception.run
        self.assertEqual(list(kept.cases), ["sound", "wild"])
        self.assertTrue(kept.results.empty)
        self.assertEqual([case.status for case in kept.cases.values()], ["done", "failed"])
        self.assertEqual(len(kept.cases["sound"].results), 1001)


class Failures(unittest.TestCase):
    def test_a_failed_run_keeps_what_there_is(self):
        with tempfile.TemporaryDirectory() as folder:
            for out in (None, folder):
                with self.assertRaises(lc.RunFailed) as caught:
                    run(DIVERGES, out=out)
                failed = caught.exception
                self.assertEqual(failed.exit_code, 1)
                self.assertRegex(str(failed), "(?s)^the run diverged at t = .*help: try")
                self.assertEqual(failed.run.status, "failed")
                self.assertGreater(len(failed.run.results), 10)
                # Files that are gone are not pointed at.
                self.assertEqual("results.csv" in str(failed), out is not None)

    def test_a_wrong_scene_or_setting_is_told_as_the_program_tells_it(self):
        for settings, scene, words in (
            ({"coupling.indx": 3}, OSCILLATOR, "--set coupling.indx=3: .*no key `indx`(?s:.*)did you mean `index`"),
            ({"coupling.macro_step": -1.5}, OSCILLATOR, "must be a finite number greater than 0, found -1.5"),
            ({}, "nothere.toml", "there is no scene file nothere.toml"),
            ({}, "-q", "there is no scene file -q"),
        ):
            with self.subTest(settings=settings), self.assertRaisesRegex(lc.SceneError, words) as caught:
                run(settings, scene)
            self.assertEqual(caught.exception.exit_code, 2)

    def test_a_worker_that_cannot_start(self):
        text = OSCILLATOR.read_text().replace('model = "oscillator" ', 'command = ["nothere"]')
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "scene.toml")
            scene.write_text(text)
            with self.assertRaisesRegex(lc.LinchpinError, "nothere"):
                run(scene=scene)

    def test_warnings_are_those_of_python(self):
        with self.assertWarnsRegex(lc.LinchpinWarning, "oscillator: .*coupling.macro_step") as caught:
            done = run(WARNS)
        found = [str(own.message) for own in caught.warnings]
        self.assertEqual(found, [f"oscillator: {text}" for text in done.warnings])
        self.assertIn(f"{len(done.warnings)} warnings", repr(done))
        # They point at the line that calls.
        self.assertEqual(pathlib.Path(caught.filename).name, pathlib.Path(__file__).name)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            run()


class Progress(unittest.TestCase):
    def test_a_function_is_told_how_far_the_run_is(self):
        told = []
        run({"scene.t_end": 20.0}, progress=lambda *reached: told.append(reached))
        self.assertEqual(told, sorted(told))
        self.assertEqual(told[-1], (20.0, 20.0))

    def test_an_exception_ends_the_run(self):
        began = time.monotonic()

        def refuse(t, t_end):
            raise InterruptedError(f"{t} of {t_end}")

        with self.assertRaisesRegex(InterruptedError, "of 10000.0"):
            run(LONG, progress=refuse)
        self.assertLess(time.monotonic() - began, 30.0)

    def test_a_line_on_the_error_output_or_silence(self):
        for progress, expected in ((True, r"t = [\d.]+ of 1 s\n$"), (False, "^$")):
            program = f"import linchpin_cosim as lc; lc.run({str(OSCILLATOR)!r}, in_process=True, progress={progress})"
            done = subprocess.run([sys.executable, "-c", program], env=environment(), capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
            self.assertRegex(done.stderr, expected)

    def test_an_interrupt_ends_the_program_with_python(self):
        program = textwrap.dedent(f"""
            import linchpin_cosim as lc
            lc.run({str(OSCILLATOR)!r}, set={LONG!r}, out="out", progress=lambda t, end: print(t, flush=True))
        """)
        with tempfile.TemporaryDirectory() as folder:
            with subprocess.Popen(
                [sys.executable, "-c", program],
                cwd=folder,
                env=environment(),
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
            ) as python:
                python.stdout.readline()
                python.send_signal(signal.SIGINT)
                _, said = python.communicate(timeout=60)
            self.assertIn("KeyboardInterrupt", said)
            self.assertIn('"interrupted"', pathlib.Path(folder, "out", "run.json").read_text())


def environment():
    return {**os.environ, "LINCHPIN": str(PROGRAM), "PYTHONPATH": str(PACKAGE / "src")}


if __name__ == "__main__":
    unittest.main()

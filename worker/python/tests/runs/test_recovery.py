"""Workers in Python that die: the run goes on from a state that has left their process, with the bits of a run without."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from linchpin import EXAMPLES, PROGRAM, linchpin

MORTAL = pathlib.Path(__file__).resolve().parent / "mortal.py"
EXPORT_EVERY = 10
# Macro steps of the scenes are shorter than this (s).
LATE = 0.05


class Recovery(unittest.TestCase):
    def scene(self, name, worker, model, time):
        """A scene of the examples in a folder of its own, in which `worker` dies once after `time`."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        command = ["python3", str(MORTAL), worker, model, str(time), str(folder / "died")]
        text, count = re.subn(rf'\["python3", "{worker}.py"\]', json.dumps(command), (EXAMPLES / name).read_text())
        self.assertEqual(count, 1)
        text = text.replace('["python3", "', f'["python3", "{EXAMPLES}/').replace(f"{EXAMPLES}/{MORTAL}", str(MORTAL))
        (folder / name).write_text(text)
        return folder

    def run_scene(self, folder, name, *options):
        linchpin("run", name, "--out", "out", "--no-plots", "--quiet", *options, folder=folder)
        return (folder / "out" / "results.csv").read_bytes(), json.loads((folder / "out" / "run.json").read_text())

    def undisturbed(self, folder, name):
        (folder / "died").touch()
        expected, _ = self.run_scene(folder, name)
        (folder / "died").unlink()
        return expected

    def test_another_worker_goes_on_from_the_last_state(self):
        for scene, worker, model in (
            ("oscillator.toml", "oscillator", "Oscillator"),
            ("two_links.toml", "scipy_pendulum", "Pendulum"),
            ("two_links.toml", "planar_rod", "Rod"),
            ("gimbal.toml", "spatial_top", "Top"),
        ):
            with self.subTest(worker=worker):
                folder = self.scene(scene, worker, model, LATE)
                expected = self.undisturbed(folder, scene)
                found, told = self.run_scene(folder, scene, "--set", f"run.export_every={EXPORT_EVERY}")
                self.assertTrue((folder / "died").exists())
                self.assertTrue(found == expected, "other results")
                (done,) = (own for own in recoveries(told) if own["workers"])
                self.assertEqual(done["workers"], 1)
                self.assertLessEqual(done["repeated_steps"], EXPORT_EVERY)

    def test_a_run_goes_on_from_its_checkpoint(self):
        folder = self.scene("oscillator.toml", "oscillator", "Oscillator", 0.5)
        expected = self.undisturbed(folder, "oscillator.toml")
        sets = ["--set", "run.recoveries=0", "--set", "run.checkpoint_steps=20"]
        command = [PROGRAM, "run", "oscillator.toml", "--out", "out", "--no-plots", "--quiet", *sets]
        path = f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"
        died = subprocess.run(command, cwd=folder, capture_output=True, text=True, env={**os.environ, "PATH": path})
        self.assertEqual(died.returncode, 1, died.stderr)
        found, told = self.run_scene(folder, "oscillator.toml", *sets, "--resume")
        self.assertTrue(found == expected, "other results")
        self.assertGreater(told["resumed_at"], 0.3)


def recoveries(told):
    """What the subsystems of a run say of their recoveries."""
    return [own["recoveries"] for own in told["statistics"]["subsystems"]]


if __name__ == "__main__":
    unittest.main()

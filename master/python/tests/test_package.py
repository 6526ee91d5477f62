"""The package itself: its types and style hold, its wheel has what it needs."""

import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

from scenes import PACKAGE


class Package(unittest.TestCase):
    def passes(self, *command):
        done = subprocess.run([sys.executable, "-m", *command], cwd=PACKAGE, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_types_hold(self):
        self.passes("mypy")

    def test_style_holds(self):
        self.passes("ruff", "check", ".")
        self.passes("ruff", "format", "--check", ".")

    def test_files_are_short(self):
        for file in PACKAGE.rglob("*.py"):
            self.assertLess(len(file.read_text().splitlines()), 300, file)

    def test_the_wheel_has_the_package_and_its_types(self):
        with tempfile.TemporaryDirectory() as folder:
            self.passes("pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--wheel-dir", folder, ".")
            (wheel,) = pathlib.Path(folder).iterdir()
            with zipfile.ZipFile(wheel) as archive:
                names = archive.namelist()
                (metadata,) = (name for name in names if name.endswith("METADATA"))
                text = archive.read(metadata).decode()
        self.assertLessEqual({"linchpin_cosim/py.typed", "linchpin_cosim/__init__.py"}, set(names))
        self.assertFalse([name for name in names if "test" in name])
        required = [line for line in text.splitlines() if line.startswith("Requires-Dist")]
        self.assertEqual([line for line in required if "extra" not in line], ["Requires-Dist: pandas>=2.0"])


if __name__ == "__main__":
    unittest.main()

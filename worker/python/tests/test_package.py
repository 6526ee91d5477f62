"""The package itself: its messages are current, its types and style hold, its wheel has what it needs."""

import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
CONTRACT = PACKAGE / "src" / "linchpin_worker" / "_contract"


def run(*command, **options):
    return subprocess.run(command, cwd=PACKAGE, capture_output=True, text=True, **options)


class Package(unittest.TestCase):
    def passes(self, *command):
        done = run(sys.executable, "-m", *command)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done

    def test_the_messages_are_those_of_the_contract(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run(sys.executable, "generate.py", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            for file in pathlib.Path(folder).iterdir():
                current = (CONTRACT / file.name).read_text() == file.read_text()
                self.assertTrue(current, f"{file.name} is not what generate.py writes; run it with the venv of setup.sh")

    def test_the_messages_stand_beside_stubs_of_the_author(self):
        """One process knows a message by one definition only; that of the same contract may be loaded twice."""
        with tempfile.TemporaryDirectory() as folder:
            include = PACKAGE.parents[1] / "proto" / "proto"
            self.passes("grpc_tools.protoc", f"-I{include}", f"--python_out={folder}", "linchpin/v1/worker.proto")
            program = f"import sys; sys.path.insert(0, {folder!r}); import linchpin_worker, linchpin.v1.worker_pb2"
            done = run(sys.executable, "-c", program)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_types_hold(self):
        self.passes("mypy")

    def test_style_holds(self):
        self.passes("ruff", "check", ".")
        self.passes("ruff", "format", "--check", ".")

    def test_files_are_short(self):
        for file in PACKAGE.rglob("*.py"):
            if CONTRACT not in file.parents:
                self.assertLess(len(file.read_text().splitlines()), 300, file)

    def test_the_wheel_has_the_package_its_types_and_its_messages(self):
        with tempfile.TemporaryDirectory() as folder:
            self.passes("pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--wheel-dir", folder, ".")
            (wheel,) = pathlib.Path(folder).iterdir()
            with zipfile.ZipFile(wheel) as archive:
                names = set(archive.namelist())
                (metadata,) = (name for name in names if name.endswith("METADATA"))
                text = archive.read(metadata).decode()
        self.assertLessEqual(
            {"linchpin_worker/py.typed", "linchpin_worker/__init__.py", "linchpin_worker/_contract/worker_pb2.py"}, names
        )
        self.assertFalse([name for name in names if "test" in name])
        requirements = [line.split()[1] for line in text.splitlines() if line.startswith("Requires-Dist")]
        self.assertEqual([name.partition(">")[0] for name in requirements], ["grpcio", "protobuf"])

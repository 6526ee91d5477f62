"""The tutorial as a reader types it: its files are written, its commands run, and its output compared, line by line."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from linchpin import PACKAGE, PROGRAM

TEMPLATE = PACKAGE / "template"
PAGE = PACKAGE.parents[1] / "docs" / "guide" / "python-worker.md"
LEFT_OUT = ".."
# Numbers that a clock has measured.
TIMED = re.compile(r"reached t = |s in its solver|  time: ")


def blocks(text):
    """Language and lines of every code block."""
    found = re.findall(r"^```(\w+)\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)
    return [(language, content.splitlines()) for language, content in found]


def comparable(line):
    line = line.rstrip()
    return re.sub(r"[\d.]+", "#", line) if TIMED.search(line) else line


class Typed(unittest.TestCase):
    """A folder in which a shell goes on from command to command, as that of a reader does."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "worker").symlink_to(PACKAGE.parent)
        binaries = self.folder / "binaries"
        binaries.mkdir()
        (binaries / "linchpin").symlink_to(PROGRAM)
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        self.environment = {**environment, "PATH": f"{binaries}:{os.environ['PATH']}"}
        self.before = "set -e\n"

    def type(self, lines):
        """Code and output of a block, behind all blocks before it that set something up."""
        script = self.before + "\n".join(lines)
        done = subprocess.run(
            ["bash", "-c", script], cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=600
        )
        return done.returncode, done.stdout + done.stderr

    def walk(self, text):
        """Walks along a page; returns how many commands it has typed."""
        page, typed = blocks(text), 0
        for place, (language, lines) in enumerate(page):
            if lines[0].startswith("# ") and language in ("python", "toml"):
                (self.folder / lines[0].removeprefix("# ")).write_text("\n".join(lines) + "\n")
            elif language == "sh":
                code, printed = self.type(lines)
                following, shown = page[place + 1] if place + 1 < len(page) else ("", [])
                expected = shown if following == "text" else []
                is_refused = bool(expected) and expected[0].startswith("error")
                self.assertEqual(code == 0, not is_refused, printed)
                told = set(map(comparable, printed.splitlines()))
                for line in expected:
                    if line != LEFT_OUT:
                        self.assertIn(comparable(line), told, printed)
                if any("activate" in line for line in lines):
                    self.before += ". .venv/bin/activate\n"
                typed += 1
        return typed

    def test_the_tutorial_runs_as_it_is_written(self):
        text = PAGE.read_text()
        self.assertGreaterEqual(self.walk(text), 4)
        ((_, worker),) = (block for block in blocks(text) if block[0] == "python")
        self.assertLessEqual(len([line for line in worker if line.strip()]), 40)

    def test_the_template_runs_as_its_page_says(self):
        for file in ("worker.py", "scene.toml"):
            (self.folder / file).write_text((TEMPLATE / file).read_text())
        self.environment["PATH"] = f"{pathlib.Path(sys.executable).parent}:{self.environment['PATH']}"
        self.environment["PYTHONPATH"] = os.fspath(PACKAGE / "src")
        self.assertEqual(self.walk((TEMPLATE / "README.md").read_text()), 1)
        table = (self.folder / "out" / "mine" / "converge.csv").read_text()
        self.assertGreater(len(table.splitlines()), 3)

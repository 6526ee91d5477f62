"""The tutorial as a reader types it: its files are written, its commands run, and its output compared, line by line.

Blocks of the language `bash` are typed here only; those of `sh` are also looked at by the test of all pages, which starts no
worker and so finds no mistake in the parameters of one.
"""

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


def alike(shown, printed):
    """Whether a line is the one that the page shows, up to the rounding of another machine and times of a clock."""
    if len(shown.split()) != len(printed.split()):
        return False
    return all(
        own == other or near(own, other, TIMED.search(shown)) for own, other in zip(shown.split(), printed.split(), strict=True)
    )


def near(own, other, is_timed):
    numbers = [re.fullmatch(r"\(?([-+]?\d[\d.]*(?:e[-+]?\d+)?)", word) for word in (own, other)]
    if None in numbers:
        return False
    a, b = (float(number[1]) for number in numbers)
    return is_timed or abs(a - b) <= 0.1 * abs(a)


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
            elif language in ("sh", "bash"):
                code, printed = self.type(lines)
                following, shown = page[place + 1] if place + 1 < len(page) else ("", [])
                expected = shown if following == "text" else []
                is_refused = bool(expected) and expected[0].startswith("error")
                self.assertEqual(code == 0, not is_refused, printed)
                for line in expected:
                    is_told = line == LEFT_OUT or any(alike(line, own) for own in printed.splitlines())
                    self.assertTrue(is_told, f"the page shows\n{line}\nbut printed is\n{printed}")
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

"""The guide and the notebook: their code runs, and prints what they show."""

import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest
from unittest import mock

import matplotlib
import nbformat
from nbclient import NotebookClient
from scenes import PACKAGE, PROGRAM, REPOSITORY, SCENES

PAGE = REPOSITORY / "docs" / "guide" / "python.md"
NOTEBOOKS = PACKAGE / "examples"
LEFT_OUT = ".."


def is_alike(shown, printed):
    """Whether a line is the one that the page shows, up to the rounding of another machine."""
    words = shown.split(), printed.split()
    return len(words[0]) == len(words[1]) and all(map(is_near, *words))


def is_near(shown, printed):
    try:
        a, b = float(shown), float(printed)
    except ValueError:
        return shown == printed
    return abs(a - b) <= 0.05 * abs(a)


class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "scenes").symlink_to(SCENES)
        self.enterContext(mock.patch.dict(os.environ, LINCHPIN=str(PROGRAM), PYTHONPATH=str(PACKAGE / "src")))

    def test_the_guide_prints_what_it_shows(self):
        matplotlib.use("Agg")
        self.addCleanup(os.chdir, pathlib.Path.cwd())
        os.chdir(self.folder)
        blocks = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE.read_text(), flags=re.MULTILINE | re.DOTALL)
        names = {}
        for place, (language, code) in enumerate(blocks):
            if language != "python":
                continue
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(compile(code, PAGE, "exec"), names)
            following, shown = blocks[place + 1] if place + 1 < len(blocks) else ("", "")
            for line in shown.splitlines() if following == "text" else []:
                is_told = line == LEFT_OUT or any(is_alike(line, own) for own in printed.getvalue().splitlines())
                self.assertTrue(is_told, f"the page shows\n{line}\nbut printed is\n{printed.getvalue()}")
        self.assertIn("run", names)

    def test_the_notebooks_run(self):
        for file in NOTEBOOKS.glob("*.ipynb"):
            notebook = nbformat.read(file, as_version=4)
            nbformat.validate(notebook)
            self.assertFalse(any(cell.get("outputs") for cell in notebook.cells), f"{file.name}: clear its outputs")
            resources = {"metadata": {"path": str(self.folder)}}
            done = NotebookClient(notebook, timeout=300, kernel_name="python3", resources=resources).execute()
            kinds = [kind for cell in done.cells for output in cell.get("outputs", ()) for kind in output.get("data", ())]
            self.assertIn("image/png", kinds)
            self.assertIn("text/html", kinds)


if __name__ == "__main__":
    unittest.main()

"""The commands of the guide run as they are written."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from solvers import EXAMPLES, PACKAGE, PROGRAM, needed

PAGE = PACKAGE.parents[1] / "docs" / "guide" / "python-solvers.md"


@needed("mujoco", "exudyn", "skfem")
class Page(unittest.TestCase):
    def test_every_scene_is_run(self):
        blocks = re.findall(r"^```bash\n(.*?)^```$", PAGE.read_text(), flags=re.MULTILINE | re.DOTALL)
        self.assertEqual(len(blocks), len(list(EXAMPLES.glob("*/*.toml"))))
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(EXAMPLES, pathlib.Path(folder, EXAMPLES.relative_to(PACKAGE.parents[1])))
            binaries = pathlib.Path(folder, "binaries")
            binaries.mkdir()
            (binaries / "linchpin").symlink_to(PROGRAM)
            (binaries / "python3").write_text(f'#!/bin/sh\nexec {sys.executable} "$@"\n')
            (binaries / "python3").chmod(0o755)
            environment = {**os.environ, "PATH": f"{binaries}:{os.environ['PATH']}"}
            for block in blocks:
                done = subprocess.run(
                    ["bash", "-ec", block], cwd=folder, env=environment, capture_output=True, text=True, timeout=300
                )
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("warning", done.stderr)
                self.assertRegex(done.stdout, r"reached t = ")


if __name__ == "__main__":
    unittest.main()

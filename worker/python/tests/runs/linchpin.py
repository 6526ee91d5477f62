"""The program `linchpin` on scenes with workers in Python; LINCHPIN names it, otherwise it is that of target/release."""

import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PACKAGE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("LINCHPIN", PACKAGE.parents[1] / "target" / "release" / "linchpin")).resolve()
EXAMPLES = PACKAGE / "examples"


def linchpin(*arguments, folder):
    """Runs the program in `folder`, with this interpreter as `python3`; it must succeed."""
    if not PROGRAM.is_file():
        raise FileNotFoundError(f"there is no program {PROGRAM}; build it, or name it by LINCHPIN")
    path = f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"
    done = subprocess.run(
        [PROGRAM, *arguments], cwd=folder, env={**os.environ, "PATH": path}, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def columns(scene, settings=(), changes=()):
    """The columns of the results of a scene, seen from the examples, by their names, under `--set` and with parts replaced."""
    text = (EXAMPLES / scene).read_text()
    for pattern, replacement in changes:
        text, count = re.subn(pattern, replacement, text, flags=re.MULTILINE)
        assert count > 0, pattern
    with tempfile.TemporaryDirectory() as out:
        file = pathlib.Path(out, "scene.toml")
        file.write_text(text.replace('["python3", "', f'["python3", "{EXAMPLES}/'))
        sets = [word for setting in settings for word in ("--set", setting)]
        linchpin("run", file, "--out", f"{out}/results", "--no-plots", "--quiet", *sets, folder=out)
        with open(f"{out}/results/results.csv", newline="") as table:
            rows = list(csv.reader(table))
    return {name: [float(row[place]) for row in rows[1:]] for place, name in enumerate(rows[0])}


def difference(own, other):
    """Largest difference of two columns relative to the largest value."""
    largest = max(map(abs, other))
    return max(abs(a - b) for a, b in zip(own, other, strict=True)) / largest

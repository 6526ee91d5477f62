"""Scenes of the tests: two masses on springs, held together by a rigid link."""

import contextlib
import os
import pathlib
import tempfile

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
REPOSITORY = PACKAGE.parents[1]
PROGRAM = pathlib.Path(os.environ.get("LINCHPIN", REPOSITORY / "target" / "release" / "linchpin")).resolve()
SCENES = REPOSITORY / "scenes"
OSCILLATOR = SCENES / "oscillator.toml"
# More than a minute of macro steps.
LONG = {"scene.t_end": 1e4}
# Index 2 with degree 2 diverges.
DIVERGES = {"coupling.degree": 2}
# A fifth of a period of the masses and more.
WARNS = {"coupling.macro_step": 0.05}


@contextlib.contextmanager
def two_cases():
    """A scene with a case that comes to its end, one that diverges, and one behind it."""
    text = OSCILLATOR.read_text()
    for name, setting in (("sound", '"coupling.degree" = 0'), ("wild", '"coupling.degree" = 2'), ("behind", "")):
        text += f'\n[[case]]\nname = "{name}"\nset = {{ {setting} }}\n'
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "cases.toml")
        file.write_text(text)
        yield file

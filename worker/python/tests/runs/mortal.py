"""A worker of the examples that dies once, in the step that begins at a time: python mortal.py MODULE CLASS TIME FILE

FILE is made when it dies; where it is there already, the worker lives.
"""

import importlib
import os
import pathlib
import signal
import sys

from linchpin_worker import serve

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples"))
module, name, time, file = sys.argv[1:5]
del sys.argv[1:5]
LIVING = getattr(importlib.import_module(module), name)


class Mortal(LIVING):
    def advance(self, t, step, u):
        if t > float(time) and not os.path.exists(file):
            pathlib.Path(file).touch()
            os.kill(os.getpid(), signal.SIGKILL)
        super().advance(t, step, u)


serve(Mortal)

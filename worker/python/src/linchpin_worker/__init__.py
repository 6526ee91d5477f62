"""Makes a Linchpin worker of a solver in Python.

A solver author writes a class with `advance`, `outputs`, `save` and `load` and a `Description`; `serve` does the rest:

    from linchpin_worker import Description, Subsystem, Variable, serve

The guide is docs/guide/python-worker.md.
"""

from .address import Address, ListenError
from .description import Description, DescriptionError
from .failures import Refused, StepFailed
from .geometry import moment_about, quaternion_of_matrix, wrench_about
from .host import Host, Limits
from .inputs import Inputs, Values
from .integrals import Integrals
from .marker import Marker, planar_marker, scalar_marker, spatial_marker
from .parameter import Parameter, Solver
from .polynomial import Polynomial
from .program import serve
from .server import Server
from .setup import Setup
from .stepping import equal_parts
from .subsystem import Subsystem
from .variable import Variable

__all__ = [
    "Address",
    "Description",
    "DescriptionError",
    "Host",
    "Inputs",
    "Integrals",
    "Limits",
    "ListenError",
    "Marker",
    "Parameter",
    "Polynomial",
    "Refused",
    "Server",
    "Setup",
    "Solver",
    "StepFailed",
    "Subsystem",
    "Values",
    "Variable",
    "equal_parts",
    "moment_about",
    "planar_marker",
    "quaternion_of_matrix",
    "scalar_marker",
    "serve",
    "spatial_marker",
    "wrench_about",
]

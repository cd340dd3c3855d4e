"""Buildings that collide in an earthquake: run their scenes, and make FMUs of them, without a compiler.

>>> import pounding_fmu
>>> result = pounding_fmu.simulate(pounding_fmu.example_scene, stop=5)
>>> result["time"].shape, len(result.impacts)
((501,), 28)

A scene says everything that is fixed about a problem: masses, storeys, gaps, contact laws, ground motion. It is

* a path (a ``str`` without a line break, or an ``os.PathLike``): the scene file; its record is relative to its folder,
* a text (a ``str`` with a line break): what such a file holds; a record is relative to the current directory,
* a ``dict``: the same keys, with lists or numpy arrays; a record is relative to the current directory.

Units are SI (m, s, kg, N). Names of parameters and outputs are those of the variables of the FMU (``variables``).
What is allowed in a scene but looks like a slip is told as a ``SceneWarning``.
"""

from pathlib import Path

from ._batch import BatchError, simulate_batch
from ._couple import couple
from ._data import DATA
from ._fmu import build_fmu
from ._native import __version__
from ._scenes import SceneWarning, Variable, buildings, problems, variables
from ._single import Result, simulate
from .record import read_record

__all__ = [
    "BatchError",
    "Result",
    "SceneWarning",
    "Variable",
    "__version__",
    "build_fmu",
    "buildings",
    "couple",
    "example_scene",
    "problems",
    "read_record",
    "simulate",
    "simulate_batch",
    "variables",
]

example_scene: Path = DATA / "scenes" / "feup.toml"
"""The default scene: two laboratory frames under El Centro 1940. Others lie beside it."""

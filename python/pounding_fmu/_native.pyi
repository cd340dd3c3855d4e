"""What is compiled; `pounding_fmu` alone calls it. Names are handed over as places in `Scene.variables`."""

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "IMPACT_COLUMNS",
    "MOST_TIME",
    "STEP",
    "Batch",
    "Record",
    "Scene",
    "__version__",
    "build",
    "run_command",
    "simulate",
    "spare",
    "summary",
    "with_numbers_only",
]

__version__: str
MOST_TIME: float
STEP: float
IMPACT_COLUMNS: list[str]

@final
class Scene:
    @property
    def name(self) -> str: ...
    @property
    def description(self) -> str: ...
    @staticmethod
    def read(file: str) -> tuple[Scene | None, list[str]]: ...
    @staticmethod
    def parse(text: str) -> tuple[Scene | None, list[str]]: ...
    @staticmethod
    def from_dict(scene: Mapping[str, Any]) -> tuple[Scene | None, list[str]]: ...
    def variables(
        self,
    ) -> list[tuple[str, str, str, str, str | None, float | None, float | None, float | str | None, str]]: ...
    def warnings(self) -> list[str]: ...
    def with_record(self, record: Record) -> Scene: ...
    def with_parameters(self, parameters: list[tuple[int, float]]) -> Scene: ...
    def without_contacts(self) -> Scene: ...
    def layout(self) -> str: ...
    def stop(self) -> float: ...
    def record(self) -> Record | None: ...
    def without_ground(self) -> str: ...
    def first_modes(self) -> list[tuple[float, float] | None]: ...

@final
class Record:
    name: str
    @staticmethod
    def read(file: str, key: str) -> Record: ...
    @staticmethod
    def about(file: str, key: str) -> tuple[str, str, list[str]]: ...
    @staticmethod
    def of(times: NDArray[np.float64], accelerations: NDArray[np.float64], key: str) -> Record: ...
    def samples(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...

@final
class Batch:
    def __new__(
        cls,
        count: int,
        scenes: list[Scene],
        which: list[int] | None,
        parameters: list[tuple[int, NDArray[np.float64]]],
    ) -> Batch: ...
    def look(self, threads: int | None) -> list[str]: ...
    def run(
        self,
        references: list[int],
        step: float | None,
        stop: float | None,
        threads: int | None,
        progress: Callable[[int, int], object] | None,
    ) -> tuple[NDArray[np.float64], dict[int, str]]: ...

def simulate(
    scene: Scene, step: float, stop: float, references: list[int], rows_per_impact: int | None = None
) -> tuple[list[NDArray[Any]], list[NDArray[Any]]]: ...
def summary(scene: Scene, step: float, stop: float) -> str: ...
def build(
    scene: Scene, output: str | None, file: str | None, libraries: str, platforms: list[str], is_fmi3: bool
) -> Path: ...
def with_numbers_only(scene: Scene) -> Scene: ...
def spare(
    outputs: Sequence[tuple[str, str | os.PathLike[str] | None]],
    scenes: Sequence[str | os.PathLike[str]],
    records: Sequence[str | os.PathLike[str]],
) -> None: ...
def run_command(arguments: list[str], again: list[str], data: str, overview: str) -> int: ...

"""A study: gap width against peak force and drift, over many scenes, records and intensities.

>>> import pounding_fmu
>>> from pounding_fmu.study import run_study
>>> study = run_study(pounding_fmu.example_scene, gaps=[0.01, 0.05], pga=[1.0, 3.0], synthetic=2)
>>> study
<Study: 18 cases of FeupFrames, 0 failed>
>>> study.column("peak_force_n", gap=0.01, pga=3.0).round()
array([1057.,  919.,  757.])

A case sets its gap (of all contacts, or a factor on those of the scene), its record, the peak ground acceleration and, where `vary` says so, other
parameters of the scene, such as the dashpots of its links. Each runs a second time with a gap
that never closes, for comparison. `docs/study.md` of the project says what the columns of the table mean.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import _native
from .._data import DATA
from .._scenes import SECONDS, by_name, refuse, unknown, warn
from .cases import FACTOR, NEVER_CLOSES, Row, varied_text

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .._scenes import Record, Scene
    from .plan import Plan

__all__ = ["GAPS", "NEVER_CLOSES", "PGA", "Study", "run_study"]

GAPS = (0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.12)
"""m, where nothing is said"""
PGA = (0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0)
"""m/s2, where nothing is said"""
SYNTHETIC = 20


class Study(Sequence[Row]):
    """The table of a study: a row (a ``dict`` by column names) for each case that was run to its end."""

    rows: list[Row]
    failures: list[Row]
    """The cases that could not be run; their column ``error`` says why."""
    path: Path | None
    """The table as a file, where it has a folder."""

    def __init__(self, rows: Sequence[Row], path: Path | None) -> None:
        self.rows = [row for row in rows if not row["error"]]
        self.failures = [row for row in rows if row["error"]]
        self.path = path

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, place: Any) -> Any:
        return self.rows[place]

    def __repr__(self) -> str:
        scenes = ", ".join(self.scenes)
        return f"<Study: {len(self.rows) + len(self.failures)} cases of {scenes}, {len(self.failures)} failed>"

    @property
    def scenes(self) -> list[str]:
        """The names of the scenes."""
        return list(dict.fromkeys(row["scene"] for row in [*self.rows, *self.failures]))

    def column(
        self,
        name: str,
        *,
        scene: str | None = None,
        gap: float | None = None,
        gap_factor: float | None = None,
        pga: float | None = None,
        varied: Mapping[str, float] | None = None,
    ) -> NDArray[Any]:
        """The values of a column in the order of the rows: of all, or of one scene, gap (m) or factor on gaps, intensity
        (m/s2) and of these values of the parameters that were varied.

        Numbers that a building does not have are NaN.

        Raises:
            KeyError: there is no such column.
        """
        import numpy as np

        if self.rows and name not in self.rows[0]:
            raise KeyError(unknown(name, self.rows[0], "the study has no such column"))
        wanted: Row = {"scene": scene, "gap_m": gap, FACTOR: gap_factor, "pga_m_s2": pga}
        if varied is not None:
            wanted["varied"] = varied_text({key: float(value) for key, value in varied.items()})
        rows = [row for row in self.rows if all(value in (None, row.get(of)) for of, value in wanted.items())]
        values = [row[name] for row in rows]
        return np.array([np.nan if value is None else value for value in values])

    def to_dataframe(self) -> Any:
        """All rows, those that failed too, as a ``pandas.DataFrame``, where pandas is installed."""
        return importlib.import_module("pandas").DataFrame([*self.rows, *self.failures])


def run_study(
    scenes: Scene | Sequence[Scene],
    records: Sequence[str | os.PathLike[str]] | Mapping[str, Record] | None = None,
    *,
    gaps: Iterable[float] | None = None,
    gap_factors: Iterable[float] | None = None,
    pga: Iterable[float] = PGA,
    synthetic: int = SYNTHETIC,
    seed: int = 1,
    stop: float | None = None,
    vary: Mapping[str, Iterable[float]] | None = None,
    output: str | os.PathLike[str] | None = None,
    scheduler: str | None = None,
    workers: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Study:
    """Runs every scene with every gap and record at every intensity, and returns the table.

    Args:
        scenes: one or several, each a path, a text or a dict. Their names have to differ.
        records: paths, or by name what ``simulate`` takes as a record. El Centro 1940 and synthetic motions where
            nothing is said.
        gaps: m, each set at all contacts of a scene; below 1000, which is the run without contact. ``GAPS`` where nothing
            is said.
        gap_factors: in place of gaps, by which all gaps of a scene are multiplied.
        pga: m/s2, to which the peak of each record is scaled.
        synthetic: how many synthetic motions, where no records are given.
        seed: of the first of them.
        stop: s, end of each run; where nothing is said the end of its record, or the scene's ``stop_time`` if later.
        vary: values of other parameters, by FMU variable name; ``link[*].dashpot`` sets it at all links,
            ``*.damping_ratio`` that of all buildings. Of several parameters every combination is run.
        output: folder of the table ``results.csv``. Rows are there as soon as they are done, and a study that was
            stopped goes on from them. Without a folder the table is returned alone.
        scheduler: address of a Dask cluster whose workers have this package, or ``local`` for one on this machine.
        workers: threads, or processes of a local cluster; all cores where nothing is said. Rows do not depend on it.
        progress: called with (cases done, all cases), those included that were done before.

    Returns:
        A ``Study``: rows in the order scene, record, varied parameters, intensity, gap; the last gap of each is the run without contact.

    Raises:
        ValueError: everything that is wrong with arguments, scenes and records; a damaged table in ``output``.
        OSError: a file or a folder that cannot be read or written; a cluster that does not answer.
        ImportError: a scheduler without the package ``distributed``.

    Warns:
        SceneWarning: for each thing in a scene that looks like a slip.
    """
    from .plan import plan

    refuse(["gaps, gap_factors: expected one of them"] * (gaps is not None and gap_factors is not None))
    chosen_gaps, chosen_pga = _numbers(GAPS if gaps is None else gaps, pga, (synthetic, seed, stop, workers))
    factors = None if gap_factors is None else [float(value) + 0.0 for value in gap_factors]
    refuse([f"gap_factors: {factor!r}: expected a finite number >= 0" for factor in factors or [] if not 0 <= factor < float("inf")])
    axes = {name: [float(value) + 0.0 for value in values] for name, values in by_name("vary", vary).items()}
    refuse([f"vary: {name}: expected at least one value" for name, values in axes.items() if not values])
    of_scenes: list[Scene] = [scenes] if isinstance(scenes, (str, os.PathLike, Mapping)) else list(scenes)
    if not of_scenes:
        raise ValueError("scenes: expected at least one")
    with tempfile.TemporaryDirectory(prefix="study") as temporary:
        folder = Path(temporary if output is None else output)
        chosen = _records(records, folder, range(seed, seed + synthetic))
        planned = plan(of_scenes, chosen, chosen_gaps, chosen_pga, stop, axes, factors)
        warn(planned.warnings)
        rows = _fill(planned, folder / "results.csv", scheduler, workers or os.cpu_count() or 1, progress)
    return Study(rows, None if output is None else folder / "results.csv")


def _numbers(
    gaps: Iterable[float], pga: Iterable[float], others: tuple[int, int, float | None, int | None]
) -> tuple[list[float], list[float]]:
    """Gaps and intensities, or everything that is wrong with numbers."""
    widths, peaks = ([float(value) + 0.0 for value in values] for values in (gaps, pga))
    synthetic, seed, stop, workers = others
    found = [f"gaps: {gap!r}: expected a number of m below {NEVER_CLOSES:g}" for gap in widths if not abs(gap) < NEVER_CLOSES]
    found += [f"pga: {peak!r}: expected a number of m/s2 > 0" for peak in peaks if not 0 < peak < float("inf")]
    found += ["pga: expected at least one"] * (not peaks)
    found += [
        f"{name} = {value!r}: expected 0 or more" for name, value in (("synthetic", synthetic), ("seed", seed)) if value < 0
    ]
    found += [f"stop = {stop!r}: expected {SECONDS}"] * (stop is not None and not 0 < stop <= _native.MOST_TIME)
    found += [f"workers = {workers!r}: expected at least one"] * (workers is not None and workers < 1)
    refuse(found)
    return widths, peaks


def _records(
    records: Sequence[str | os.PathLike[str]] | Mapping[str, Record] | None, folder: Path, seeds: Iterable[int]
) -> Mapping[str, Record]:
    """The ground motions by name."""
    from . import motions
    from .records import named

    if records is not None:
        return named(records)
    synthetic = [motions.write(folder / "records", seed) for seed in seeds]
    return named([DATA / "records" / "el_centro_1940_ns.csv", *synthetic])


def _fill(
    planned: Plan, path: Path, scheduler: str | None, workers: int, progress: Callable[[int, int], object] | None
) -> list[Row]:
    """Runs the cases that have no row yet, and returns all rows."""
    from . import runners
    from .results import Results

    results = Results(path, planned.storeys)
    try:
        missing = results.missing(planned.cases)
        before = len(planned.cases) - len(missing)

        def tell(done: int) -> None:
            if progress is not None:
                progress(before + done, len(planned.cases))

        tell(0)
        if scheduler is None:
            batches = runners.in_threads(missing, planned.materials, workers, tell)
        else:
            batches = runners.on_cluster(scheduler, missing, planned.materials, workers, tell)
        with contextlib.closing(batches):
            for rows in batches:
                results.add(planned.with_intensity(case, row) for case, row in rows)
        return results.finish(planned.cases)
    finally:
        results.close()

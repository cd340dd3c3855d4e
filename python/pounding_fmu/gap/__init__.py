"""How wide a gap keeps buildings apart, or the force between them below a limit, beside what codes ask for.

>>> import pounding_fmu
>>> from pounding_fmu.gap import required_gap
>>> offices = pounding_fmu.example_scene.with_name("offices.toml")
>>> [row] = required_gap(offices)
>>> print(f"{1e3 * row.gap:.1f} mm, where the root of the sum of squares says {1e3 * row.srss:.1f} mm")
80.4 mm, where the root of the sum of squares says 90.3 mm

The gap is the same at all contacts, whatever theirs are in the scene. Of a row of buildings each two neighbours, and each
building with a wall, have a gap of their own. Links between the buildings are in all runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from .._scenes import warn
from .command import main, search_of
from .search import RequiredGap

if TYPE_CHECKING:
    from .._scenes import Record, Scene

__all__ = ["RequiredGap", "main", "required_gap"]


def required_gap(
    scene: Scene,
    records: Sequence[Record] | Mapping[str, Record] | None = None,
    *,
    pga: Iterable[float] | None = None,
    force: float | None = None,
    between: Sequence[str] | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> list[RequiredGap]:
    """How wide a gap the buildings need in each ground motion.

    In a row of ``[[building]]`` tables each two neighbours have their own: from which on they do not meet if no other
    buildings do, from one run without contact for all. Each run goes to the end of its record, or to the scene's ``stop_time`` where that is later.

    Args:
        scene: a path, a text or a dict, with contacts.
        records: paths, or by name what ``simulate`` takes as a record; that of the scene where nothing is said.
        pga: m/s2, to which the peak of each record is scaled, one after the other; as the scene says without it.
        force: N, a peak force that is not to be exceeded, for ``force_gap``. Since a wider gap may have the larger force,
            200 gaps are tried, and the interval above the last one that exceeds the limit is refined; what exceeds it
            only between two gaps that were tried is not seen. In a row it is one factor on all gaps of the scene.
        between: two neighbours: their gap alone is varied, the others stay as in the scene, with what contact there makes
            of it.
        threads: how many runs at a time; all cores where nothing is said.
        progress: called with (runs done, all runs).

    Returns:
        A ``RequiredGap`` for each record and intensity, in their order; in a row for each two neighbours from the left.

    Raises:
        ValueError: everything that is wrong with the scene, the records or an argument.
        OSError: the scene file cannot be read.
        BatchError: a run that cannot go on.

    Warns:
        SceneWarning: for each thing in the scene that looks like a slip.
    """
    search = search_of(scene, records, pga, force, threads, progress, between)
    warn(search.warnings)
    return search.run()

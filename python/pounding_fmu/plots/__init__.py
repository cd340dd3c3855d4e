"""Pictures of runs. They need matplotlib: ``pip install "pounding-fmu[plot]"``.

Nothing of matplotlib's global state is changed: figures belong to no window, and settings hold while one is drawn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._extras import require

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.figure import Figure

    from .._single import Result


def figure(
    result: Result,
    start: float | None = None,
    stop: float | None = None,
    picture: str = "overview",
    buildings: Sequence[str] | None = None,
) -> Figure:
    """A picture of a run: the buildings to scale with their contacts, and what happens between them over time.

    The scene is run once more to the same end, with rows within each impact, and without its contacts where the picture
    compares with that.

    Args:
        result: of ``simulate``; it need not hold all outputs.
        start: s, where the parts over time begin: the beginning of the run for the overview, else that of the five
            seconds with the largest impulses, where nothing is said.
        stop: s, their end, likewise.
        picture: ``overview``, or one of ``contacts``, ``floors``, ``forces``, ``accelerations``, ``hysteresis``,
            ``drifts``, ``loops`` and ``residual``.
        buildings: one or two names: those whose floors, storeys and loops are charted. Of more than two buildings those of
            the hardest impact, where nothing is said.

    Returns:
        A ``matplotlib.figure.Figure``; a notebook shows it, ``savefig`` writes it.

    Raises:
        ImportError: matplotlib is not installed.
        ValueError: there is no such picture or building, the run has nothing to show in it, or the times are not within the run.
    """
    require("matplotlib", "plot")
    from .command import draw
    from .runs import Runs

    names = [buildings] if isinstance(buildings, str) else buildings
    return draw(Runs(result._scene, float(result["time"][-1]), start, stop, names), picture)

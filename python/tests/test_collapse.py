"""Runs that a collapse ends."""

import csv

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu.study import command, run_study
from pounding_fmu.study.cases import NEVER_CLOSES

LEANING = fmus.EXAMPLES / "scenes/leaning.toml"
RECORD = {"turned round": fmus.RECORD}


def alone(stop=20.0):
    """The left building of the example under a ground that pushes it away from its neighbour: it falls."""
    return LEANING.read_text().replace("scale = -1.0 ", "scale = 1.0 ").replace("../records/el_centro_1940_ns.csv", str(fmus.RECORD))


@pytest.mark.filterwarnings("ignore::pounding_fmu.SceneWarning")
def test_the_last_row_is_at_the_collapse():
    run = pounding_fmu.simulate(alone())
    time, fallen = run["left.collapse_time"][-1], run["left.collapsed"]
    assert run["time"][-1] == time and time % 0.01 and 19.5 < time < 20.0
    assert fallen[-1] and not fallen[:-1].any() and fallen.dtype == bool
    assert abs(run["left.displacement[1]"][-1]) == pytest.approx(1.5)
    assert (run["left.collapse_time"][:-1] == -1).all() and not run["right.collapsed"].any()
    said = f"collapse     storey 1 of the left building collapsed at {time:.6f} s; the run ends there"
    assert said in run.summary() and "0 s to 31.18 s" in pounding_fmu.simulate(alone()).summary()
    dense = pounding_fmu.simulate(alone(), rows_per_impact=3)
    assert dense["time"][-1] == time and fmus.same_bits(dense["left.velocity[1]"][-1], run["left.velocity[1]"][-1])


@pytest.mark.filterwarnings("ignore::pounding_fmu.SceneWarning")
def test_a_batch_has_the_values_then():
    outputs = ["left.collapsed", "left.collapse_time", "left.displacement[1]", "left.peak_stability_index[1]"]
    scale = {"ground.scale": [-1.0, 1.0, 0.1]}
    for step in (None, 0.01):
        ends = pounding_fmu.simulate_batch(LEANING, scale, outputs, step=step)
        assert ends[:, 0].tolist() == [0.0, 1.0, 0.0]
        assert ends[[0, 2], 1].tolist() == [-1.0, -1.0]
        run = pounding_fmu.simulate(alone())
        assert ends[1].tolist() == [float(run[name][-1]) for name in outputs]


@pytest.mark.filterwarnings("ignore::pounding_fmu.SceneWarning")
def test_studies_count_collapses_apart(tmp_path):
    arguments = [LEANING, "--records", fmus.RECORD, "--gaps", 0.02, 2.0, "--pga", 1.0, 3.43, 4.5, "-o", tmp_path]
    assert command.main(list(map(str, arguments))) == 0
    study = run_study(LEANING, RECORD, gaps=[0.02, 2.0], pga=[1.0, 3.43, 4.5])
    fallen = [row for row in study.rows if row["left_collapsed"]]
    assert 0 < len(fallen) < len(study.rows)
    ends = pounding_fmu.simulate_batch(
        LEANING,
        {"contact[1].gap": [row["gap_m"] for row in study.rows], "ground.scale": [row["pga_m_s2"] / np.abs(pounding_fmu.read_record(fmus.RECORD)[1]).max() for row in study.rows]},
        ["left.collapsed", "right.collapsed"],
    )
    assert ends.tolist() == [[row["left_collapsed"], row["right_collapsed"]] for row in study.rows]
    assert all(row["left_drift_ratio"] is None for row in fallen)
    with (tmp_path / "fragility_Leaning.csv").open() as file:
        lines = {(line["demand"], float(line["gap_m"])): line for line in csv.DictReader(file)}
    for gap in (0.02, 2.0, NEVER_CLOSES):
        of_gap = [row for row in study.rows if row["gap_m"] == gap]
        assert int(lines["collapse", gap]["exceeding"]) == sum(row["left_collapsed"] or row["right_collapsed"] for row in of_gap)
        # What has collapsed is beyond every limit of its deformations.
        assert int(lines["residual drift", gap]["exceeding"]) >= int(lines["collapse", gap]["exceeding"])

"""What a study says of earthquakes beyond its runs: how strong they are for a building, and how probable a limit is."""

import csv
import math
from statistics import NormalDist

import numpy as np
import fmus
import pounding_fmu
import pytest
from pounding_fmu import spectra
from pounding_fmu.study import fragility

PERIOD, STEP = 0.7, 2.0


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.4])
def test_the_spectral_acceleration_of_a_step(ratio):
    """Suddenly applied and held: the displacement overshoots by exp(-pi ratio/sqrt(1 - ratio^2))."""
    found = spectra.pseudo_acceleration(np.array([0.0, 0.03, 9.0]), np.full(3, STEP), PERIOD, ratio)
    assert found == pytest.approx(STEP * (1 + math.exp(-math.pi * ratio / math.sqrt(1 - ratio**2))), rel=1e-12)


@pytest.mark.parametrize("length", [0.01, 0.1, 0.3])
def test_the_spectral_acceleration_of_a_pulse_comes_after_it(length):
    """Shorter than half a period, undamped: 2 sin(pi length/period), in the free vibration."""
    found = spectra.pseudo_acceleration(np.array([3.0, 3.0 + length]), np.full(2, STEP), PERIOD, 0.0)
    assert found == pytest.approx(2 * STEP * math.sin(math.pi * length / PERIOD), rel=1e-12)


@pytest.mark.parametrize("rise", [0.01, 0.25, 1.0, 2.3])
def test_the_spectral_acceleration_of_a_ramp(rise):
    """A ramp that is held, undamped: 1 + |sin(pi rise/period)|/(pi rise/period)."""
    times, ground = np.array([0.0, rise, rise + 5.0]), np.array([0.0, -STEP, -STEP])
    angle = math.pi * rise / PERIOD
    found = spectra.pseudo_acceleration(times, ground, PERIOD, 0.0)
    assert found == pytest.approx(STEP * (1 + abs(math.sin(angle)) / angle), rel=1e-12)


def test_the_spectral_acceleration_is_that_of_a_building_of_one_storey(tmp_path):
    """w^2 times the peak displacement that the engine finds for such a building, 5 % of critical damping."""
    scene = tmp_path / "scene.toml"
    buildings = "".join(
        f"[{side}]\nmass = [1e3]\nstiffness = [{stiffness!r}]\ndamping = {{ ratio = 0.05 }}\n"
        for side, stiffness in [("left", 1e7), ("right", 9e3)]
    )
    scene.write_text(f"name = 'One'\n{buildings}[ground]\nrecord = '{fmus.RECORD}'\n")
    run = pounding_fmu.simulate(scene, 10.0, stop=40.0)
    motion = np.loadtxt(fmus.RECORD, delimiter=",", comments=("#", "t"), unpack=True)
    for side, square in [("left", 1e4), ("right", 9.0)]:
        found = spectra.pseudo_acceleration(*motion, 2 * math.pi / math.sqrt(square))
        assert found == pytest.approx(square * run[f"{side}.peak_displacement[1]"][-1], rel=1e-9)


def runs_at(levels, exceeding, of):
    """So many runs at each level of which so many exceed."""
    exceeds = [np.arange(of) < count for count in exceeding]
    return np.repeat(levels, of), np.concatenate(exceeds)


def test_a_curve_through_two_points_goes_through_them():
    """Two levels, two parameters: the likelihood is largest where both shares are met."""
    median, dispersion = fragility.fit_lognormal(*runs_at([1.0, 3.0], [2, 9], 10))
    low, high = NormalDist().inv_cdf(0.2), NormalDist().inv_cdf(0.9)
    assert dispersion == pytest.approx(math.log(3.0) / (high - low), rel=1e-9)
    assert median == pytest.approx(math.exp(-low * dispersion), rel=1e-9)


def test_no_other_curve_is_likelier():
    levels, exceeds = runs_at([0.5, 1.0, 2.0, 4.0, 8.0], [0, 1, 1, 7, 20], 20)
    found = fragility.fit_lognormal(levels, exceeds)

    def likelihood(median, dispersion):
        share = np.array([NormalDist(math.log(median), dispersion).cdf(math.log(level)) for level in levels])
        return np.sum(np.log(np.where(exceeds, share, 1 - share)))

    for factors in [(1.001, 1), (0.999, 1), (1, 1.001), (1, 0.999), (1.01, 1.01), (2, 1), (1, 3)]:
        other = [value * factor for value, factor in zip(found, factors)]
        assert likelihood(*other) < likelihood(*found)


@pytest.mark.parametrize(
    "exceeding",
    [[0, 0, 0], [10, 10, 10], [0, 0, 10], [0, 10, 10], [0, 4, 10], [10, 4, 0], [9, 5, 1], [10, 0, 0], [5, 5, 5]],
    ids=str,
)
def test_there_is_no_curve_where_the_likelihood_has_no_largest_value(exceeding):
    assert fragility.fit_lognormal(*runs_at([1.0, 2.0, 4.0], exceeding, 10)) is None


def test_there_is_no_curve_through_shares_that_fall():
    """30 of 40 at one intensity and 12 at a higher one: 4 standard errors of the difference; 15 and 12: 0.7."""
    levels = [1.0, 2.0, 4.0, 8.0]
    for exceeding, falling in ([0, 30, 12, 39], True), ([0, 15, 12, 39], False):
        runs = runs_at(levels, exceeding, 40)
        assert fragility.falls(*runs) is falling
        assert (fragility.fit_lognormal(*runs) is None) is falling


def test_there_is_no_curve_where_a_constant_share_is_as_likely():
    """6 of 20 and 8 of 20: G = 0.44 by hand, below the 3.84 of chi-squared; 4 and 14 have 10.6."""
    assert fragility.fit_lognormal(*runs_at([1.0, 2.0], [6, 8], 20)) is None
    assert fragility.fit_lognormal(*runs_at([1.0, 2.0], [4, 14], 20)) is not None


DEMAND = fragility.Demand("force", "N", lambda row: row["peak_force_n"], 0.5, "force above 0.5 N")


def curve_of(exceeding, levels=(1.0, 2.0, 4.0, 8.0), of=20, gap=0.01):
    runs = runs_at(list(levels), exceeding, of)
    return fragility.Curve("Frames", DEMAND, "pga", gap, *runs, fragility.fit_lognormal(*runs))


def test_a_median_beyond_all_runs_is_marked(tmp_path):
    within, beyond = curve_of([0, 1, 10, 20]), curve_of([0, 0, 2, 8])
    assert not within.is_extrapolated and 1.0 < within.fit[0] < 8.0
    assert beyond.is_extrapolated and beyond.fit[0] > 8.0
    fragility.write([within, beyond, curve_of([20, 20, 20, 20])], tmp_path / "curves.csv")
    assert [row["extrapolated"] for row in csv.DictReader((tmp_path / "curves.csv").open())] == ["0", "1", ""]


def test_limits_are_said_in_the_units_of_people():
    said = [fragility.shown(*limit) for limit in [(1.3245e6, "N"), (1234.0, "N"), (0.0161, "m"), (4.0, "1"), (9.0, "m/s2")]]
    assert said == ["1.32 MN", "1.23 kN", "16.1 mm", "4", "9 m/s2"]

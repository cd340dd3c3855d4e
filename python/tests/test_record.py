"""Ground motions: `read_record`, and the command that shows and converts them."""

from fractions import Fraction

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu.record import Motion, spectral
from test_command import run, well


def test_read_record():
    time, acceleration = pounding_fmu.read_record(fmus.RECORD)
    rows = [line.split(",") for line in fmus.RECORD.read_text().splitlines() if line[0].isdigit()]
    assert time.dtype == acceleration.dtype == np.float64
    assert time.tolist() == [float(row[0]) for row in rows]
    assert acceleration.tolist() == [float(row[1]) for row in rows]
    with pytest.raises(FileNotFoundError, match="missing.csv"):
        pounding_fmu.read_record("missing.csv")


UNEVEN = "time_s,accel_m_s2\n0.5,0\n0.75,1.1\n1.5,-0.3\n1.625,0.7\n"


def test_a_record_is_shown(tmp_path):
    (tmp_path / "uneven.csv").write_text(UNEVEN)
    text = well("record", "uneven.csv", cwd=tmp_path)
    for line in [
        "  samples     4, uneven, 0.125 s to 0.75 s apart",
        "  duration    1.125 s, from 0.5 s to 1.625 s",
        "  peak        1.1 m/s2, 0.1122 g, at 0.75 s",
        "  lowest      -0.3 m/s2, -0.03059 g, at 1.5 s",
    ]:
        assert line in text.splitlines(), text
    even = well("record", fmus.RECORD)
    assert "1560, every 0.02 s (50 Hz)" in even and "about 0\n" in even and "not about 0" not in even


def test_arias_intensity_is_the_integral():
    """Of the square of straight lines, in exact arithmetic."""
    time, acceleration = [0, Fraction(1, 4), 1, Fraction(9, 8)], [0, Fraction(11, 8), Fraction(-3, 8), Fraction(3, 4)]
    integral = sum(
        (t1 - t0) * (a0 * a0 + a0 * a1 + a1 * a1) / 3
        for t0, t1, a0, a1 in zip(time, time[1:], acceleration, acceleration[1:])
    )
    found = Motion(np.array(time, float), np.array(acceleration, float)).arias_intensity()
    assert found == pytest.approx(np.pi / (2 * 9.80665) * float(integral), rel=1e-14)
    fine = np.linspace(0, 1.125, 2_000_001)
    squares = np.interp(fine, np.array(time, float), np.array(acceleration, float)) ** 2
    assert np.trapezoid(squares, fine) == pytest.approx(float(integral), rel=1e-9)


def test_the_spectrum_is_that_of_a_step():
    """An acceleration that comes at once and stays: the oscillator swings to 1 + exp(-pi z / sqrt(1 - z^2)) times its rest."""
    motion = Motion(np.array([0.0, 1e-9, 100.0]), np.array([0.0, 2.0, 2.0]))
    for period in (0.1, 0.5, 2.0):
        expected = 2.0 * (1 + np.exp(-np.pi * 0.05 / np.sqrt(1 - 0.05**2)))
        assert spectral(motion, period) == pytest.approx(expected, rel=1e-6)


def test_a_record_is_converted_bit_by_bit(tmp_path):
    (tmp_path / "a.AT2").write_text("PEER\nstation\nACCELERATION IN UNITS OF G\nNPTS= 5, DT= .01 SEC\n .1E-1 -.2 .3 .123456789 .5\n")
    well("record", "a.AT2", "-o", "a.csv", cwd=tmp_path)
    one, other = (pounding_fmu.read_record(tmp_path / name) for name in ("a.AT2", "a.csv"))
    assert all(fmus.same_bits(a, b) for a, b in zip(one, other)) and len(one[0]) == 5


def test_a_mean_that_is_not_0_is_told_and_taken_away_on_demand(tmp_path):
    time = np.arange(200) / 100
    acceleration = 0.03 + np.sin(2 * np.pi * 4 * time) * np.exp(-time)
    rows = "".join(f"{t!r},{a!r}\n" for t, a in zip(time.tolist(), acceleration.tolist()))
    (tmp_path / "offset.csv").write_text("time_s,accel_m_s2\n" + rows)
    text = well("record", "offset.csv", "-o", "same.csv", cwd=tmp_path)
    assert "not about 0" in text and "--remove-mean" in text
    assert fmus.same_bits(pounding_fmu.read_record(tmp_path / "same.csv")[1], acceleration)
    text = well("record", "offset.csv", "--remove-mean", "-o", "less.csv", cwd=tmp_path)
    assert "has been taken away" in text and "not about 0" not in text
    less = pounding_fmu.read_record(tmp_path / "less.csv")[1]
    assert fmus.same_bits(less, acceleration - np.float64(sum(map(Fraction, acceleration.tolist())) / 200))
    assert "without its mean of" in (tmp_path / "less.csv").read_text().splitlines()[0]


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_a_record_is_drawn(suffix, tmp_path):
    well("record", fmus.RECORD, "--plot", f"x.{suffix}", cwd=tmp_path)
    beginning = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[suffix]
    assert (tmp_path / f"x.{suffix}").read_bytes().startswith(beginning)


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        ([], 2, "the following arguments are required: FILE"),
        (["missing.csv"], 1, "missing.csv: No such file"),
        (["feup.toml"], 1, "expected a record file, but"),
        (["r.csv", "-o", "r.csv"], 1, "r.csv: this is the record itself"),
        (["r.csv", "-o", "no/such/r.csv"], 1, "no/such/r.csv: No such file"),
        (["large.csv"], 1, "error: large.csv: acceleration 1e+200 m/s2: expected at most 1e+100 m/s2\n"),
        (["r.csv", "--plot", "r.jpg"], 1, "r.jpg: expected a name that ends in .png, .svg, .pdf"),
    ],
)
def test_mistakes_with_records(arguments, code, said, tmp_path):
    (tmp_path / "r.csv").write_text(UNEVEN)
    (tmp_path / "large.csv").write_text(UNEVEN.replace("1.1", "-1e200"))
    (tmp_path / "feup.toml").write_text(fmus.feup())
    done = run("record", *arguments, cwd=tmp_path)
    assert done.returncode == code and said in done.stderr and "Traceback" not in done.stderr
    assert (tmp_path / "r.csv").read_text() == UNEVEN

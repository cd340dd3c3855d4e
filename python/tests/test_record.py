"""Ground motions: `read_record`, and the command that shows and converts them."""

import tomllib
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
    # All of one sign before, which nothing is said about any more.
    (tmp_path / "above.csv").write_text("time_s,accel_m_s2\n" + "".join(f"{t!r},{9 + a!r}\n" for t, a in zip(time.tolist(), acceleration.tolist())))
    assert "of one sign" in run("record", "above.csv", cwd=tmp_path).stderr
    well("record", "above.csv", "--remove-mean", cwd=tmp_path)


WITHOUT = tomllib.loads(fmus.without_record())
# Numbers alone, two in a line; and three components about a level of 0.5 m/s2.
BARE = "by hand\n1 -2\n3 -2\n"
THREE = "t [s],N-S [m/s2],E-W [m/s2],U-D [m/s2]\n" + "".join(f"{k / 100},{k % 7 - 3},{k % 5 - 1.5},1\n" for k in range(35))
SAID = {"step": 0.02, "unit": "g", "skip_lines": 1}
OPTIONS = ["--step", "0.02", "--unit", "g", "--skip-lines", "1"]


def test_what_a_file_does_not_say_is_said(tmp_path):
    (tmp_path / "bare.txt").write_text(BARE)
    (tmp_path / "three.csv").write_text(THREE)
    expected = [0.0, 0.02, 0.04, 0.06], [9.80665, -19.6133, 3 * 9.80665, -19.6133]
    for said in (SAID, SAID | {"column": None, "remove_mean": False}):
        time, acceleration = pounding_fmu.read_record(tmp_path / "bare.txt", **said)
        assert (time.tolist(), acceleration.tolist()) == expected
    text = well("record", "bare.txt", *OPTIONS, "-o", "said.csv", cwd=tmp_path)
    assert "columns of text, in g" in text and "every 0.02 s" in text
    assert pounding_fmu.read_record(tmp_path / "said.csv")[1].tolist() == expected[1]
    for column in (3, "E-W", "ew"):
        components = pounding_fmu.read_record(tmp_path / "three.csv", column=column, remove_mean=True)
        assert components[1].tolist() == pytest.approx([k % 5 - 2 for k in range(35)], abs=1e-15)
        shown = well("record", "three.csv", "--column", str(column), cwd=tmp_path)
        assert "component   E-W [m/s2]" in shown and "channel 3   U-D [m/s2]" in shown
    assert fmus.same_bits(pounding_fmu.read_record(f"{tmp_path}/three.csv#N-S")[1], np.array([k % 7 - 3.0 for k in range(35)]))
    with pytest.raises(ValueError, match="expected column = ...") as refused:
        pounding_fmu.read_record(tmp_path / "three.csv")
    assert "#2 N-S [m/s2], #3 E-W [m/s2], #4 U-D [m/s2]" in str(refused.value)
    with pytest.raises(ValueError, match='record.unit = "kg"') as refused:
        pounding_fmu.read_record(tmp_path / "bare.txt", step=-1, unit="kg", column=0)
    assert len(str(refused.value).splitlines()) == 3
    vertical = run("record", "three.csv", "--column", "U-D", cwd=tmp_path)
    assert "vertical" in vertical.stderr and vertical.returncode == 0


def test_scenes_and_records_say_the_same(tmp_path):
    """A scene, a run, a batch, and the parameter of the FMU: one way, one motion."""
    (tmp_path / "bare.txt").write_text(BARE)
    source = {"file": str(tmp_path / "bare.txt"), **SAID}
    other, outputs = WITHOUT, ["left.displacement[1]", "contact[1].impulse"]
    scene = other | {"ground": {"record": source}}
    own = pounding_fmu.simulate(scene, stop=0.5)
    path = tmp_path / "plain.csv"
    well("record", "bare.txt", *OPTIONS, "-o", "plain.csv", cwd=tmp_path)
    runs = [
        pounding_fmu.simulate(other, record=source, stop=0.5),
        pounding_fmu.simulate(fmus.feup(), parameters={"ground.record": source}, stop=0.5),
        pounding_fmu.simulate(other, record=path, stop=0.5),
    ]
    for name in outputs:
        assert all(fmus.same_bits(found[name], own[name]) for found in runs)
    batch = pounding_fmu.simulate_batch(other, {}, outputs, records=[source, path, source], stop=0.5)
    assert all(fmus.same_bits(row, batch[0]) for row in batch)
    assert fmus.same_bits(pounding_fmu.simulate_batch(other, {}, outputs, records=source, stop=0.5)[0], batch[0])
    built = pounding_fmu.build_fmu(scene, tmp_path / "bare.fmu")
    driven = fmus.Fmu(built, tmp_path / "bare").run(own["time"].tolist())
    assert fmus.same_bits(driven[outputs[0]], own[outputs[0]])


OFFSET = "time_s,accel_m_s2\n" + "".join(f"{k / 100!r},{0.4 + (k % 7 - 3.0)!r}\n" for k in range(350))


def test_no_record_is_scaled_by_its_offset(tmp_path):
    (tmp_path / "offset.csv").write_text(OFFSET)
    (tmp_path / "scene.toml").write_text(fmus.without_record())
    for command in (["study", "scene.toml", "--gaps", "0.01", "-o", "s"], ["gap", "scene.toml"]):
        told = [*command, "--records", "offset.csv", "--pga", "2"]
        done = run(*told, cwd=tmp_path)
        assert done.returncode == 1 and "its mean is 0.4 m/s2" in done.stderr and "--remove-mean" in done.stderr, done.stderr
        done = run(*told, "--remove-mean", cwd=tmp_path)
        assert done.returncode == 0, done.stderr
    # Of another record than that of the scene nothing can be said here.
    done = run("gap", "scene.toml", "--remove-mean", "--step", "0.1", cwd=tmp_path)
    assert done.returncode == 1 and "--step, --remove-mean: expected --records" in done.stderr, done.stderr
    source = {"file": str(tmp_path / "offset.csv")}
    scene = WITHOUT | {"ground": {"record": source, "pga": 2.0}}
    assert "remove_mean" in "".join(pounding_fmu.problems(scene))
    with pytest.warns(pounding_fmu.SceneWarning, match="its mean is 0.4 m/s2"):
        assert pounding_fmu.problems(scene | {"ground": {"record": source}}) == []
    with pytest.warns(pounding_fmu.SceneWarning, match="its mean is 0.4 m/s2"):
        pounding_fmu.simulate_batch(WITHOUT, {}, ["impacts"], records=[source], stop=0.1)
    assert pounding_fmu.problems(scene | {"ground": {"record": source | {"remove_mean": True}, "pga": 2.0}}) == []


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

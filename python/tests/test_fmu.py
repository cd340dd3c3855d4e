"""What Python computes has the bits of the FMU that it builds, as FMPy reads them; that FMU has those of cargo fmu."""

import pickle
import warnings
from pathlib import Path

import fmus
import numpy as np
import pounding_fmu
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

OTHER = {"left.mass[1]": 4.0, "left.stiffness[2]": 3000.0, "right.damping_ratio": 0.02, "contact[2].gap": 0.01}


def same_run(fmu, result, parameters=None):
    of_fmu = fmu.run([float(time) for time in result["time"]], parameters)
    assert len(result) > 5
    assert [name for name in result if name != "time" and not fmus.same_bits(result[name], of_fmu[name])] == []


@pytest.mark.parametrize("scene", fmus.SCENES, ids=lambda scene: scene.stem)
def test_scenes_of_the_examples(build, scene):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pounding_fmu.SceneWarning)
        result = pounding_fmu.simulate(scene, step=0.037, stop=5.0)
        same_run(build(scene), result)
    outputs = [v.name for v in build(scene).description.modelVariables if v.causality == "output"]
    assert list(result) == ["time", *outputs]


def test_parameters(build):
    result = pounding_fmu.simulate(fmus.FEUP, parameters=OTHER)
    same_run(build(fmus.FEUP), result, OTHER)
    assert not fmus.same_bits(result["impacts"], pounding_fmu.simulate(fmus.FEUP)["impacts"])


def test_frequencies_and_parameters_are_outputs_too(build):
    names = ["left.frequency[2]", "contact[2].gap", "ground.scale", "left.mass[1]"]
    result = pounding_fmu.simulate(fmus.FEUP, stop=1, outputs=names, parameters=OTHER)
    assert list(result) == ["time", *names]
    same = build(fmus.FEUP).run([float(time) for time in result["time"]], OTHER)
    assert all(fmus.same_bits(result[name], same[name]) for name in names)


@pytest.fixture
def pulse(tmp_path):
    """A record, as a file and as arrays."""
    times, accelerations = np.linspace(0, 3, 61), 4 * np.sin(2 * np.pi * np.linspace(0, 3, 61))
    file = tmp_path / "pulse.csv"
    rows = "".join(f"{t!r},{a!r}\n" for t, a in zip(times.tolist(), accelerations.tolist()))
    file.write_text("time_s,accel_m_s2\n" + rows)
    return file, (times, accelerations)


def test_another_record(build, pulse):
    file, arrays = pulse
    result = pounding_fmu.simulate(fmus.FEUP, record=file)
    same_run(build(fmus.FEUP), result, {"ground.record": str(file)})
    others = [
        pounding_fmu.simulate(fmus.FEUP, record=arrays),
        pounding_fmu.simulate(fmus.FEUP, record=[list(column) for column in arrays]),
        pounding_fmu.simulate(fmus.FEUP, parameters={"ground.record": file}),
    ]
    for other in others:
        assert all(fmus.same_bits(result[name], other[name]) for name in result)
        assert other.impacts.tobytes() == result.impacts.tobytes()
    own = pounding_fmu.simulate(fmus.FEUP, parameters={"ground.record": ""})
    assert fmus.same_bits(own["impacts"], pounding_fmu.simulate(fmus.FEUP)["impacts"])


def test_a_record_for_a_scene_without_one(build):
    result = pounding_fmu.simulate(fmus.without_record(), record=fmus.RECORD, stop=20)
    same_run(build(fmus.FEUP), result)
    times, accelerations = np.loadtxt(fmus.RECORD, delimiter=",", comments=("#", "t"), unpack=True)
    other = pounding_fmu.simulate(fmus.without_record(), record=(times, accelerations), stop=20)
    assert all(fmus.same_bits(result[name], other[name]) for name in result)
    endless = fmus.without_record().replace("stop_time = 20.0", "")
    assert pounding_fmu.simulate(endless, record=fmus.RECORD)["time"][-1] == times[-1]


def test_rows_and_types():
    result = pounding_fmu.simulate(fmus.FEUP, step=0.3, stop=1.0)
    assert result["time"].tolist() == [0.0, 0.3, 0.6, 3 * 0.3, 1.0]
    kinds = {v.name: v.type for v in pounding_fmu.variables(fmus.FEUP).values()} | {"time": "Real"}
    dtypes = {"Real": np.float64, "Integer": np.int32, "Boolean": np.bool_}
    assert all(result[name].dtype == dtypes[kinds[name]] for name in result)
    assert "nothing" not in result and len(list(result.items())) == len(result)
    again = pickle.loads(pickle.dumps(result))
    assert list(again) == list(result) and again != result and again.impacts.dtype == result.impacts.dtype
    assert "FeupFrames" in again._repr_html_()
    with pytest.raises(KeyError, match="no such column"):
        again["left.displacement[9]"]
    with pytest.raises(RuntimeError, match="pickled"):
        again.summary()


def test_impacts_are_those_of_the_command(tmp_path):
    import subprocess

    table = tmp_path / "impacts.csv"
    subprocess.run(["pounding-fmu", "simulate", fmus.FEUP, "--impacts", table, "--stop", "1.723"], check=True)
    of_command = np.genfromtxt(table, delimiter=",", names=True)
    impacts = pounding_fmu.simulate(fmus.FEUP, stop=1.723).impacts
    assert impacts.dtype.names == of_command.dtype.names and len(impacts) == of_command.size == 1
    assert np.isnan(impacts["end_s"][0]) and impacts["contact"].dtype == np.int32
    assert all(fmus.same_bits(impacts[name], np.atleast_1d(of_command[name])) for name in impacts.dtype.names)


def test_a_run_ends_where_that_of_the_command_does():
    assert pounding_fmu.simulate(fmus.FEUP)["time"][-1] == 20.0
    assert (
        pounding_fmu.simulate(fmus.feup("stop_time = 20.0"))["time"][-1]
        == np.loadtxt(fmus.RECORD, delimiter=",", comments=("#", "t"))[-1, 0]
    )
    assert pounding_fmu.simulate(fmus.without_record().replace("stop_time = 20.0", ""))["time"][-1] == 10.0


@pytest.mark.parametrize("name", ["feup", "isolated", "leaning", "neighbours", "offices", "on_soil", "two_blocks", "yielding"])
def test_bytes_are_those_of_cargo_fmu(tmp_path, name):
    of_cargo = (fmus.REFERENCES / f"{name}.fmu").read_bytes()
    scene = pounding_fmu.example_scene.with_name(f"{name}.toml")
    assert pounding_fmu.build_fmu(scene, tmp_path / "x.fmu", platforms=[fmus.HOST]).read_bytes() == of_cargo


def test_where_an_fmu_goes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert pounding_fmu.build_fmu(fmus.FEUP) == Path("FeupFrames.fmu") and Path("FeupFrames.fmu").is_file()
    shipped = {folder.name for folder in pounding_fmu.example_scene.parents[1].glob("libraries/*")}
    assert set(fmus.libraries("FeupFrames.fmu")) == shipped >= {fmus.HOST}
    made = pounding_fmu.build_fmu(fmus.FEUP, "new/folder/x.fmu", platforms=fmus.HOST)
    assert set(fmus.libraries(made)) == {fmus.HOST}
    assert made.stat().st_mode & 0o444 == 0o444
    with pytest.raises(ValueError, match=r"x.zip: expected a name that ends in .fmu"):
        pounding_fmu.build_fmu(fmus.FEUP, "x.zip")
    Path("file").write_text("")
    with pytest.raises(OSError, match="cannot write"):
        pounding_fmu.build_fmu(fmus.FEUP, "file/x.fmu")
    with pytest.raises(ValueError, match=r"platform win95, beos: expected one of .*" + fmus.HOST):
        pounding_fmu.build_fmu(fmus.FEUP, "y.fmu", platforms=["win95", "beos", fmus.HOST])
    with pytest.raises(ValueError, match="at least one"):
        pounding_fmu.build_fmu(fmus.FEUP, "y.fmu", platforms=[])
    assert not Path("y.fmu").exists()


def test_fmi3(tmp_path, monkeypatch):
    """Found valid by FMPy with the schema of the standard, beside the FMU of FMI 2.0 and not in its place."""
    monkeypatch.chdir(tmp_path)
    made = pounding_fmu.build_fmu(fmus.FEUP, platforms=[fmus.HOST], fmi=3)
    assert made == Path("FeupFrames.fmi3.fmu") and validate_fmu(str(made)) == []
    description = read_model_description(str(made), validate=True)
    assert description.fmiVersion == "3.0"
    assert set(fmus.libraries(made)).isdisjoint({"linux64", "win64", "darwin64"})
    pounding_fmu.build_fmu(fmus.FEUP, fmi=2)
    older = read_model_description("FeupFrames.fmu")
    names = [variable.name for variable in description.modelVariables]
    assert sorted(names) == sorted(["time", *(variable.name for variable in older.modelVariables)])
    for wrong in (1, 4, "3", None, True, 2.5):
        with pytest.raises(ValueError, match=r"fmi = .*: expected 2 or 3"):
            pounding_fmu.build_fmu(fmus.FEUP, "y.fmu", fmi=wrong)
    assert not Path("y.fmu").exists()


@pytest.mark.parametrize(("fmi", "number"), [(2, "Real"), (3, "Float64")])
def test_numbers_only(tmp_path, fmi, number):
    """Valid, of one type, and the impacts that any other counts; the module itself has all variables as ever."""
    made = pounding_fmu.build_fmu(fmus.FEUP, tmp_path / "x.fmu", platforms=[fmus.HOST], fmi=fmi, numbers_only=True)
    assert validate_fmu(str(made)) == []
    description = read_model_description(str(made), validate=True)
    assert {variable.type for variable in description.modelVariables} == {number}
    assert description.coSimulation.maxOutputDerivativeOrder == 1
    read = simulate_fmu(str(made), output=["impacts", "contact[2].active"], output_interval=0.01)
    result = pounding_fmu.simulate(fmus.feup("energy = true", "energy = true\nnumbers_only = true"), step=0.01)
    for name in ("impacts", "contact[2].active"):
        assert read[name].dtype == float and np.array_equal(read[name], result[name])
    assert (result["impacts"].dtype, result["contact[2].active"].dtype) == (np.int32, bool)

"""Scenes in all their forms, what they say of themselves, and every mistake that can be made with them."""

import re
import tomllib
import warnings
from pathlib import Path

import fmus
import numpy as np
import pounding_fmu
import pytest

FEUP = fmus.FEUP


def as_dict():
    return tomllib.loads(fmus.feup())


def test_forms_of_a_scene_are_the_same(tmp_path, monkeypatch):
    monkeypatch.chdir(fmus.EXAMPLES / "scenes")
    scene = as_dict()
    scene["left"]["mass"] = np.array(scene["left"]["mass"])
    scene["right"]["stiffness"] = tuple(np.float32(k) for k in scene["right"]["stiffness"])
    scene["ground"]["record"] = Path("../records/el_centro_1940_ns.csv")
    scene["contact"][0]["left_floor"] = np.int64(1)
    scene["outputs"]["energy"] = np.bool_(True)
    forms = [FEUP, str(FEUP), FEUP.read_text(), as_dict(), scene]
    runs = [pounding_fmu.simulate(form) for form in forms]
    for run in runs[1:]:
        assert list(run) == list(runs[0])
        assert all(fmus.same_bits(run[name], runs[0][name]) for name in run)


def test_a_dict_makes_an_fmu(build, tmp_path):
    fmu = fmus.Fmu(pounding_fmu.build_fmu(as_dict(), tmp_path / "x.fmu"), tmp_path / "x")
    result = pounding_fmu.simulate(as_dict(), step=0.1, stop=4)
    of_fmu = fmu.run([float(time) for time in result["time"]])
    assert all(fmus.same_bits(result[name], of_fmu[name]) for name in result if name != "time")


def test_texts_of_a_dict_survive():
    scene = as_dict() | {"description": 'a "quoted" \\ line\nand another: Gebäude\t1'}
    assert pounding_fmu.problems(scene) == []
    scene["name"] = "no identifier\n"
    assert pounding_fmu.problems(scene)[0].startswith('name = "no identifier')


@pytest.mark.parametrize("scene", [FEUP, fmus.without_record()], ids=["record", "no record"])
def test_variables_are_those_of_the_fmu(build, scene):
    variables = pounding_fmu.variables(scene)
    described = build(scene).description.modelVariables
    assert list(variables) == [v.name for v in described]

    def number(text):
        return None if text is None else float(text)

    for v in described:
        start = v.start if v.type == "String" else number(v.start)
        limits = (number(v.min), number(v.max), start)
        assert variables[v.name] == (v.name, v.causality, v.variability, v.type, v.unit, *limits, v.description)


def test_some_variables():
    variables = pounding_fmu.variables(FEUP)
    assert variables["contact[1].gap"].start == 0.005 and variables["contact[1].active"].unit is None
    variables = pounding_fmu.variables(fmus.without_record())
    assert variables["ground.acceleration"].causality == "input" and "ground.scale" not in variables


def test_problems():
    assert pounding_fmu.problems(FEUP) == []
    found = pounding_fmu.problems(fmus.feup("mass = [3.65, 3.65]\n", "mass = [3.65, -1]\nmasss = 3\n"))
    assert found[0] == "left.mass[2] = -1.0: expected a finite mass > 0 kg" and "did you mean mass?" in found[1]
    for function in (pounding_fmu.simulate, pounding_fmu.variables, pounding_fmu.build_fmu):
        with pytest.raises(ValueError, match=re.escape("\n".join(found)) + "$"):
            function(fmus.feup("mass = [3.65, 3.65]\n", "mass = [3.65, -1]\nmasss = 3\n"))


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"left": None}, TypeError, "left = None: expected a number, a text, a path, a list, an array or a dict"),
        ({"left": {"mass": [1, {2}]}}, TypeError, "left.mass[2] = {2}: expected"),
        ({"left": {"mass": b"12"}}, TypeError, "left.mass = b'12': expected"),
        ({"left": {1: 2}}, TypeError, "left: expected keys that are texts, not 1"),
        ({3: 2}, TypeError, "the scene: expected keys that are texts, not 3"),
        ({"left": {"mass": [2**70]}}, ValueError, "left.mass[1]: expected a whole number of at most 64 bits"),
        ({"left": {"mass": 1j}}, TypeError, "left.mass = 1j: expected"),
        ({"left": {"mass": np.array([[1.0]])}}, ValueError, "left.mass[1] = [1.0]: expected"),
        ({"name": "\ud800"}, ValueError, r"name = '\ud800': expected a text in Unicode"),
        ({"left": {"\ud800": 1}}, TypeError, r"left: expected keys that are texts, not '\ud800'"),
    ],
)
def test_what_a_dict_may_not_hold(change, error, message):
    with pytest.raises(error, match=re.escape(message)):
        pounding_fmu.simulate(as_dict() | change)


def test_a_dict_that_holds_itself():
    scene = as_dict()
    scene["left"]["left"] = scene["left"]
    with pytest.raises(ValueError, match=r"left\.left\..*: expected no more than 16 levels"):
        pounding_fmu.problems(scene)


@pytest.mark.parametrize("scene", [3, None, b"name = 1\n", ["a"]])
def test_no_scene(scene):
    with pytest.raises(TypeError, match="scene: expected a path, a text .with a line break. or a dict, not"):
        pounding_fmu.simulate(scene)


def test_texts_that_no_file_holds():
    assert pounding_fmu.problems("name = 'A'\n\n# \ud800") == [
        r"line 3: '\ud800' is half of a character: expected a text in Unicode"
    ]
    for path in ("", "a\0b", "\ud800", Path("\ud800")):
        for key, call in {
            "scene": lambda path: pounding_fmu.simulate(path),
            "record": lambda path: pounding_fmu.simulate(FEUP, record=path),
            "output": lambda path: pounding_fmu.build_fmu(FEUP, path),
        }.items():
            with pytest.raises(ValueError, match=re.escape(f"{key} = {str(path)!r}: expected a path of a file")):
                call(path)


def test_files_that_are_not_there(tmp_path):
    for function in (pounding_fmu.simulate, pounding_fmu.problems, pounding_fmu.variables, pounding_fmu.build_fmu):
        with pytest.raises(FileNotFoundError, match="missing.toml"):
            function(tmp_path / "missing.toml")
    with pytest.raises(IsADirectoryError):
        pounding_fmu.simulate(tmp_path)
    with pytest.raises(FileNotFoundError, match="missing.csv"):
        pounding_fmu.simulate(FEUP, record=tmp_path / "missing.csv")
    with pytest.raises(ValueError, match="ground.record = .*missing.csv'.*: expected a record file, but No such file"):
        pounding_fmu.simulate(FEUP, parameters={"ground.record": str(tmp_path / "missing.csv")})
    with pytest.raises(ValueError, match="ground.record = .*expected a record file, but"):
        pounding_fmu.simulate(fmus.feup("el_centro", "missing"))
    (tmp_path / "no.csv").write_text("a,b\n1,2\n")
    with pytest.raises(ValueError, match="record = .*no.csv.: expected a record file, but line 2: nothing says the unit"):
        pounding_fmu.simulate(FEUP, record=tmp_path / "no.csv")
    (tmp_path / "no.toml").write_bytes(b"name = '\xff'\n")
    assert "not UTF-8" in pounding_fmu.problems(tmp_path / "no.toml")[0]


@pytest.mark.parametrize(
    ("record", "message"),
    [
        (([0, 1], [0, 1, 2]), "record: 2 times and 3 accelerations: expected as many"),
        (([0, 0], [0, 1]), "record: time 0 s: expected more than the time before it, 0 s"),
        (([0, 1], [0, float("nan")]), "record: acceleration NaN m/s2: expected a finite acceleration"),
        (([0], [1]), "record: 1 sample: expected at least 2"),
        (3, "record: expected a path or a pair of arrays"),
        (([0, 1], ["a", "b"]), "record: expected a path or a pair of arrays"),
        (([[0, 1]], [[0, 1]]), "record: expected a path or a pair of arrays"),
        (([0, 1], [0, 1e300]), "ground.scale = 1.0: expected accelerations up to 1e6 m/s2"),
    ],
)
def test_arrays_that_are_no_record(record, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        pounding_fmu.simulate(FEUP, record=record)


@pytest.mark.parametrize(
    ("parameters", "error", "message"),
    [
        (
            {"contact[1].gapp": 1, "foo": 2},
            KeyError,
            "contact[1].gapp: the scene has no such variable; did you mean contact[1].gap?; foo: the",
        ),
        ({"impacts": 1}, ValueError, "impacts is computed and cannot be set"),
        ({"left.frequency[1]": 1}, ValueError, "left.frequency[1] is computed and cannot be set"),
        ({"left.mass[1]": "3"}, ValueError, "left.mass[1] = '3': expected a number"),
        ({"left.mass[1]": None}, ValueError, "left.mass[1] = None: expected a number"),
        ({"left.mass[1]": np.ones(1)}, ValueError, "left.mass[1] = array([1.]): expected a number"),
        ({"ground.record": 3}, ValueError, "ground.record = 3: expected"),
        (
            {"left.mass[1]": -1, "contact[1].restitution": 1.5},
            ValueError,
            "left.mass[1] = -1.0: expected a finite mass > 0 kg\ncontact[1].restitution = 1.5: expected 0 < e <= 1",
        ),
        ({"left.damping_ratio": float("inf")}, ValueError, "left.damping_ratio = inf: expected"),
        ([1], TypeError, "parameters = [1]: expected a dict by names of parameters"),
        (0, TypeError, "parameters = 0: expected a dict by names of parameters"),
    ],
)
def test_parameters_that_cannot_be(parameters, error, message):
    with pytest.raises(error, match=re.escape(message)):
        pounding_fmu.simulate(FEUP, parameters=parameters)


def test_inputs_are_no_parameters():
    with pytest.raises(ValueError, match="ground.acceleration is an input, which is 0 here"):
        pounding_fmu.simulate(fmus.without_record(), parameters={"ground.acceleration": 1})
    result = pounding_fmu.simulate(fmus.without_record(), stop=1, outputs=["ground.acceleration"])
    assert not result["ground.acceleration"].any()


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"step": 0}, ValueError, "step = 0: expected a number of seconds > 0"),
        ({"stop": -1}, ValueError, "stop = -1: expected a number of seconds > 0"),
        ({"stop": float("nan")}, ValueError, "stop = nan: expected"),
        ({"stop": 1e300}, ValueError, "stop = 1e+300: expected a number of seconds > 0 and at most 1e+12"),
        ({"step": "0.1"}, ValueError, "step = '0.1': expected"),
        ({"outputs": ["no", "contact[1].forces"]}, KeyError, "did you mean contact[1].force?"),
        ({"outputs": "impacts"}, TypeError, "outputs = 'impacts': expected a list of names"),
        ({"outputs": ["ground.record"]}, ValueError, "ground.record is a text: expected names of numbers"),
        ({"step": 1e-12}, MemoryError, "2.0e13 rows of 60 columns: expected fewer, by a larger step"),
        ({"step": 1e-300, "outputs": []}, MemoryError, "rows of 1 columns"),
        ({"record": fmus.RECORD, "parameters": {"ground.record": "a"}}, ValueError, "expected either this or record"),
    ],
)
def test_arguments_that_cannot_be(arguments, error, message):
    with pytest.raises(error, match=re.escape(message)):
        pounding_fmu.simulate(FEUP, **arguments)


def test_slips_are_warnings_of_the_caller():
    scene = fmus.feup("gap = 0.005", "gap = 5.0")
    for function in (pounding_fmu.simulate, pounding_fmu.problems):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            function(scene)
        assert [warning.category for warning in caught] == [pounding_fmu.SceneWarning] * len(caught) and caught
        assert caught[0].filename == __file__
        assert str(caught[0].message).startswith("contact[1].gap = 5.0: 5 m between the buildings")
    with pytest.warns(pounding_fmu.SceneWarning, match=r"contact\[2\].gap = 5.0: "):
        pounding_fmu.simulate(FEUP, parameters={"contact[2].gap": 5})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pounding_fmu.simulate(FEUP)
        with pytest.raises(pounding_fmu.SceneWarning):
            pounding_fmu.build_fmu(scene, "never.fmu")
    assert not Path("never.fmu").exists()


def test_a_row_is_a_list_of_tables():
    house = {"mass": [1e5], "stiffness": np.array([2e7]), "damping": {"ratio": 0.05}}
    contacts = [{"left": left, "right": right, "left_floor": 1, "right_floor": 1, "gap": 0.01, "law": "linear", "stiffness": 1e8} for left, right in (("a", "b2"), ("b2", "c"))]
    scene = {"name": "Row", "building": [{"name": "a", **house}, house, {"name": "c", **house}], "contact": contacts}
    assert pounding_fmu.buildings(scene) == ["a", "b2", "c"]
    assert [name for name in pounding_fmu.variables(scene) if name.endswith(".displacement[1]")] == [f"{name}.displacement[1]" for name in ("a", "b2", "c")]
    scene["contact"][1]["right"] = "a"
    assert pounding_fmu.problems(scene) == ['contact[2].right = "a": expected "c", the right neighbour of "b2"']
    with pytest.raises(ValueError, match="right neighbour"):
        pounding_fmu.buildings(scene)

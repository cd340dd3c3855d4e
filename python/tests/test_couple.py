"""Buildings that another program has, beside the same building wholly inside and the forces of the model itself."""

import pickle
import warnings

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu import SceneWarning, couple, simulate

MASS, STIFFNESS, YIELD, RATIO = [20e3, 20e3, 16e3], np.array([20e6, 19e6, 14e6]), np.array([110e3, 90e3, 55e3]), 0.05
CONTACT = {"gap": 0.004, "law": "kelvin_voigt", "stiffness": 2e8, "restitution": 0.6}
LAWS = {
    "linear": {"stiffness": 2e8},
    "kelvin_voigt": {"stiffness": 2e8, "restitution": 0.6},
    "hertz": {"stiffness": 3e9},
    "jankowski": {"stiffness": 3e9, "restitution": 0.6},
    "hertz_damped": {"stiffness": 3e9, "restitution": 0.6, "damping_formula": "exact"},
    "stereomechanical": {"restitution": 0.6},
}
SOIL = {
    "mass": 15e3,
    "inertia": 120e3,
    "sway": {"stiffness": 60e6, "dashpot": 4e5},
    "rocking": {"stiffness": 900e6, "dashpot": 4e6},
}
INSIDE = {"yield_force": YIELD, "post_yield_ratio": RATIO}


class Bilinear:
    """Storeys with kinematic hardening, and all that they have been asked and have answered."""

    def __init__(self, stiffness=STIFFNESS, strength=YIELD, initial=None):
        self.stiffness, self.strength, self.initial = stiffness, strength, stiffness if initial is None else initial
        self.plastic, self.asked, self.shears = np.zeros(len(stiffness)), [], []

    def initial_stiffness(self):
        return self.initial

    def move(self, displacements):
        drift = np.diff(displacements, prepend=0.0)
        limit = self.strength / self.stiffness
        self.plastic = drift - np.clip(drift - self.plastic, -limit, limit)
        shear = self.stiffness * (RATIO * drift + (1 - RATIO) * (drift - self.plastic))
        self.asked.append(displacements)
        self.shears.append(shear)
        return shear - np.append(shear[1:], 0.0)


def matrix(stiffness=STIFFNESS):
    k = np.append(stiffness, 0.0)
    return np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)


def scene(left=None, right=None, contact=None, **more):
    return {
        "name": "Coupled",
        "stop_time": 6.0,
        "left": {"mass": MASS, "stiffness": STIFFNESS, "damping": {"ratio": 0.03}, "height": [3.0] * 3, **(left or {})},
        "right": {
            "mass": MASS[:2],
            "stiffness": [30e6, 24e6],
            "damping": {"ratio": 0.03},
            "height": [3.0] * 2,
            **(right or {}),
        },
        "contact": [{"left_floor": i, "right_floor": i, **CONTACT, **(contact or {})} for i in (1, 2)],
        "ground": {"record": str(fmus.RECORD), "pga": 3.0},
        "outputs": {"energy": True},
        **more,
    }


def floors(run, side="left"):
    return np.column_stack([run[name] for name in run if name.startswith(f"{side}.displacement[")])


def error(run, truth):
    exact = floors(truth)
    return np.abs(floors(run) - exact).max() / np.abs(exact).max()


def orders(how, steps, **parts):
    errors = []
    for step in steps:
        inside = simulate(scene(**{**parts, "left": {**parts.get("left", {}), **INSIDE}}), step)
        run = couple(scene(**parts), left=Bilinear(), step=step, how=how)
        assert run["left.peak_drift[1]"][-1] > 1.5 * YIELD[0] / STIFFNESS[0], "it yields"
        errors.append(error(run, inside))
    return errors


@pytest.mark.parametrize(("how", "order", "largest"), [("held", 1.0, 3e-2), ("line", 2.0, 5e-4), ("twice", 2.0, 2e-4)])
def test_each_way_comes_to_the_building_inside_with_its_order(how, order, largest):
    errors = orders(how, [0.004, 0.002, 0.001, 0.0005])
    # A yield within a step is a corner that a line does not have: orders scatter from step to step.
    assert np.log2(errors[0] / errors[-1]) / 3 == pytest.approx(order, abs=0.4), errors
    assert errors[-1] < largest, errors


@pytest.mark.parametrize("law", LAWS)
def test_impacts_impulses_and_peaks_are_those_of_the_building_inside_under_every_law(law):
    contact = {"law": law, **LAWS[law]}
    bare = {key: value for key, value in CONTACT.items() if key not in ("stiffness", "restitution")}
    contacts = [{"left_floor": i, "right_floor": i, **bare, **contact} for i in (1, 2)]
    inside = simulate(scene(left=INSIDE) | {"contact": contacts}, 0.0005)
    run = couple(scene() | {"contact": contacts}, left=Bilinear(), step=0.0005, how="twice")
    assert run["impacts"][-1] == inside["impacts"][-1] > 5
    assert error(run, inside) < 1e-3
    names = ["left.peak_base_shear", "left.peak_drift[1]", "left.peak_drift[3]", "right.peak_displacement[2]"]
    names += [f"contact[{p}].impulse" for p in (1, 2)]
    for name in names:
        assert run[name][-1] == pytest.approx(inside[name][-1], rel=3e-3), name


def test_shears_are_those_of_the_model_and_the_energy_account_closes():
    model = Bilinear()
    run = couple(scene(), left=model, step=0.001, how="line")
    shears = np.array(model.shears)
    for i in range(3):
        assert run[f"left.storey_shear[{i + 1}]"] == pytest.approx(shears[:, i], abs=1e-9 * YIELD[0])
        peak = run[f"left.peak_storey_shear[{i + 1}]"][-1]
        # Peaks are those between the steps as well.
        assert np.abs(shears[:, i]).max() <= peak * (1 + 1e-12) <= 1.01 * np.abs(shears[:, i]).max()
    assert run["left.peak_storey_shear[1]"][-1] < 0.5 * STIFFNESS[0] * run["left.peak_drift[1]"][-1], "not those of K0"
    assert np.abs(run["energy.residual"]).max() < 1e-12
    # What the model has taken and not given back: its work by the trapezoidal rule.
    drift = np.diff(np.array(model.asked), axis=1, prepend=0.0)
    taken = np.sum(np.diff(drift, axis=0) * (shears[1:] + shears[:-1]) / 2)
    assert run["energy.strain"][-1] + run["energy.correction"][-1] == pytest.approx(taken, rel=1e-2)
    assert run["energy.correction"][-1] > 0.1 * run["energy.input"][-1]


def test_what_went_in_can_be_read():
    names = [f"left.{what}[{i}]" for i in (1, 2, 3) for what in ("storey_correction", "storey_shear", "displacement")]
    run = couple(scene(), left=Bilinear(), step=0.005, outputs=names)
    for i, stiffness in enumerate(STIFFNESS, 1):
        below = run[f"left.displacement[{i - 1}]"] if i > 1 else 0.0
        resists = stiffness * (run[f"left.displacement[{i}]"] - below) - run[f"left.storey_correction[{i}]"]
        assert run[f"left.storey_shear[{i}]"] == pytest.approx(resists, abs=1e-9 * YIELD[0])
        assert np.abs(run[f"left.storey_correction[{i}]"]).max() > 0.1 * YIELD[0]


def test_a_model_is_moved_once_a_step_to_where_the_floors_are():
    for how in ("held", "line"):
        model = Bilinear()
        run = couple(scene(), left=model, step=0.005, stop=1.0, how=how)
        assert np.array_equal(np.array(model.asked), floors(run)), (
            "the run, made again without the model, is the same to the bit"
        )
    model = Bilinear()
    run = couple(scene(), left=model, step=0.005, stop=1.0, how="twice")
    apart = np.abs(np.array(model.asked) - floors(run)).max()
    assert len(model.asked) == 201 and 0.0 < apart < 1e-2 * np.abs(floors(run)).max()


@pytest.mark.parametrize("both", [False, True])
def test_a_matrix_and_both_buildings_outside(both):
    right = {"yield_force": [120e3, 60e3], "post_yield_ratio": RATIO}
    inside = simulate(scene(left=INSIDE, right=right), 0.0005)
    # A matrix that is that of storeys is taken for one.
    models = {"left": Bilinear(initial=matrix())}
    if both:
        models["right"] = Bilinear(np.array([30e6, 24e6]), np.array([120e3, 60e3]))
    run = couple(scene(right={} if both else right), **models, step=0.0005, how="twice")
    assert "left.storey_shear[1]" in run
    assert run["impacts"][-1] == inside["impacts"][-1]
    assert error(run, inside) < 3e-4
    assert run["right.peak_base_shear"][-1] == pytest.approx(inside["right.peak_base_shear"][-1], rel=2e-3)


def test_a_matrix_that_is_of_no_shear_building():
    """A frame that is elastic all the way, a tenth softer than what it says: closed by the same frame inside."""

    class Softer:
        full = matrix() + 0.1 * np.outer([1.0, -2.0, 1.0], [1.0, -2.0, 1.0]) * 14e6

        def initial_stiffness(self):
            return self.full

        def move(self, displacements):
            return 0.9 * self.full @ displacements

    left = {"mass": MASS, "damping": {"matrix": 0.6 * np.diag(MASS)}}
    inside = simulate(scene() | {"left": {**left, "stiffness_matrix": 0.9 * Softer.full}}, 0.0005)
    run = couple(scene() | {"left": left}, left=Softer(), step=0.0005, how="twice")
    assert "left.storey_shear[1]" not in run
    assert error(run, inside) < 3e-5
    assert run["left.peak_base_shear"][-1] == pytest.approx(inside["left.peak_base_shear"][-1], rel=1e-4)


def test_below_a_coupled_building_there_may_be_soil():
    inside = simulate(scene(left={**INSIDE, "foundation": SOIL}), 0.0005)
    run = couple(scene(left={"foundation": SOIL}), left=Bilinear(), step=0.0005, how="twice")
    assert np.abs(inside["left.foundation.rotation"]).max() * 9.0 > 1e-3, "it rocks by as much as floors move"
    assert error(run, inside) < 5e-4
    for name in ("left.foundation.peak_moment", "left.foundation.peak_displacement", "left.peak_base_shear"):
        assert run[name][-1] == pytest.approx(inside[name][-1], rel=3e-3), name
    assert np.abs(run["energy.residual"]).max() < 1e-12


def test_buildings_that_touch_at_rest():
    inside = simulate(scene(left=INSIDE, contact={"gap": 0.0}), 0.0005)
    run = couple(scene(contact={"gap": 0.0}), left=Bilinear(), step=0.0005, how="twice")
    assert inside["impacts"][-1] > 20
    assert error(run, inside) < 1e-3


def test_the_scene_may_leave_out_what_the_model_has_and_does_not_yield_beside_it():
    one = couple(scene(left=INSIDE), left=Bilinear(), step=0.005)
    left = {key: value for key, value in scene()["left"].items() if key != "stiffness"}
    other = couple(scene() | {"left": left}, left=Bilinear(), step=0.005)
    assert np.array_equal(floors(one), floors(other))
    assert "left.plastic_drift[1]" not in one


def test_a_stiffness_that_is_too_soft_is_told():
    with pytest.warns(
        SceneWarning, match=r"left, storey 2: the model was up to 2\.000 times as stiff .* first at 0\.0"
    ):
        couple(scene(), left=Bilinear(initial=STIFFNESS * [1.0, 0.5, 1.0]), step=0.002, stop=2.0)
    with pytest.warns(SceneWarning, match=r"left: the model was up to 1\.[0-9]+ times as stiff"):
        couple(scene(), left=Bilinear(initial=0.6 * matrix() + np.full((3, 3), 1e5)), step=0.002, stop=2.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        couple(scene(), left=Bilinear(), step=0.002, stop=2.0)
        couple(scene(), left=Bilinear(initial=1.5 * STIFFNESS), step=0.002, stop=2.0)


class Failing(Bilinear):
    def __init__(self, answer, after=300):
        super().__init__()
        self.answer, self.after = answer, after

    def move(self, displacements):
        forces = super().move(displacements)
        if len(self.asked) <= self.after:
            return forces
        if isinstance(self.answer, BaseException):
            raise self.answer
        return self.answer


def test_what_a_model_raises_comes_with_time_and_storey():
    model = Failing(ZeroDivisionError("no equilibrium"))
    with pytest.raises(
        RuntimeError, match=r"left: the model failed at 1\.5 s, .* in storey [123]: no equilibrium"
    ) as caught:
        couple(scene(), left=model, step=0.005)
    assert caught.value.__cause__ is model.answer
    drift = np.abs(np.diff(model.asked[-1], prepend=0.0))
    assert f"in storey {np.argmax(drift) + 1}:" in str(caught.value)


def test_ctrl_c_ends_it():
    model = Failing(KeyboardInterrupt())
    with pytest.raises(KeyboardInterrupt):
        couple(scene(), left=model, step=0.005)
    assert len(model.asked) == 301


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ([1.0, 2.0], "2 numbers: expected 3, the forces on the floors in N"),
        ([1.0, 2.0, 3.0, 4.0], "4 numbers: expected 3"),
        ([1.0, float("nan"), 3.0], "NaN on floor 2: expected a finite force in N"),
        (np.array([np.inf, 0.0, 0.0]), "inf on floor 1: expected a finite force in N"),
        (None, "<class 'NoneType'>: expected 3 numbers, the forces on the floors in N"),
        ("abc", "expected 3 numbers"),
        (np.zeros((3, 1)), "left: the model failed at 1.5 s"),
    ],
)
def test_answers_that_are_no_forces_are_refused(answer, said):
    with pytest.raises(RuntimeError) as caught:
        couple(scene(), left=Failing(answer), step=0.005)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    "kind", [list, tuple, lambda forces: forces.astype(np.float32), lambda forces: np.repeat(forces, 2)[::2]]
)
def test_forces_may_be_any_numbers(kind):
    class Other(Bilinear):
        def move(self, displacements):
            return kind(super().move(displacements))

    run, plain = (couple(scene(), left=model, step=0.005, stop=1.0) for model in (Other(), Bilinear()))
    assert floors(run) == pytest.approx(floors(plain), abs=1e-6 * np.abs(floors(plain)).max())


@pytest.mark.parametrize(
    ("stiffness", "said"),
    [
        ("abc", "left: initial_stiffness(): expected numbers in N/m"),
        ([1e6, np.nan, 1e6], "expected finite numbers in N/m"),
        ([1e6, 1e6], "left.stiffness"),
        ([1e6, -1e6, 1e6], "left.stiffness[2] = -1000000.0"),
        (np.zeros((2, 3)), "of shape (2, 3): expected a finite symmetric matrix"),
        (matrix() + np.triu(np.full((3, 3), 1e6), 1), "differs from its transpose by"),
        (matrix() - 1e8 * np.eye(3), "left.stiffness"),
    ],
)
def test_a_stiffness_that_is_none_is_refused(stiffness, said):
    with pytest.raises(ValueError) as caught:
        couple(scene(), left=Bilinear(initial=stiffness))
    assert said in str(caught.value)


def test_wrong_arguments():
    with pytest.raises(
        ValueError, match=r"how = 'both': expected one of line, twice, held\nleft, right: expected a model"
    ):
        couple(scene(), how="both")
    with pytest.raises(TypeError, match=r"right: expected a model .* it has no move"):
        couple(scene(), right=type("Still", (), {"initial_stiffness": lambda self: STIFFNESS})())
    with pytest.raises(ValueError, match="step = 0"):
        couple(scene(), left=Bilinear(), step=0)
    with pytest.raises(KeyError, match="no such variable"):
        couple(scene(), left=Bilinear(), outputs=["left.displacment[1]"])
    alone = {key: value for key, value in scene().items() if key not in ("right", "contact")}
    with pytest.raises(ValueError, match="right"):
        couple(alone, right=Bilinear())


def test_a_result_is_as_any_other_and_never_asks_the_model_again():
    model = Bilinear()
    run = couple(scene(), left=model, step=0.005, outputs=["left.base_shear"], rows_per_impact=5)
    asked = len(model.asked)
    assert list(run) == ["time", "left.base_shear"] and len(run["time"]) > 1201
    said = run.summary()
    peak = couple(scene(), left=Bilinear(), step=0.005)["left.peak_base_shear"][-1]
    assert f"{peak / 1e3:.5g}" in said and "\n  correction " in said, said
    assert "left         its restoring forces are another program's" in said and "right        its" not in said
    pytest.importorskip("matplotlib")
    for picture in ("overview", "floors", "loops", "drifts", "accelerations"):
        figure = run.plot(picture=picture)
        labels = {text for axes in figure.axes for text in axes.get_legend_handles_labels()[1]}
        assert not any("without contact" in label for label in labels), "the model would have to be asked again"
    assert len(model.asked) == asked
    assert pickle.loads(pickle.dumps(run))["left.base_shear"][-1] == run["left.base_shear"][-1]


def test_a_collapse_of_the_other_building_ends_the_run():
    right = {
        "mass": [20e3, 20e3],
        "yield_force": [30e3, 30e3],
        "post_yield_ratio": 0.0,
        "p_delta": True,
        "gravity_load": [4e6, 2e6],
    }
    run = couple(scene(right=right), left=Bilinear(), step=0.005)
    assert run["right.collapsed"][-1] and run["time"][-1] < 6.0


def row(**middle):
    """The building of these tests between two that are softer."""
    side = {"mass": MASS, "stiffness": 0.6 * STIFFNESS, "damping": {"ratio": 0.03}}
    buildings = [{"name": "west", **side}, {"mass": MASS, "damping": {"ratio": 0.03}, **middle}, {"name": "east", **side}]
    contacts = [{**CONTACT, "left": left, "right": right, "left_floor": 2, "right_floor": 2} for left, right in (("west", "b2"), ("b2", "east"))]
    return {"name": "Row", "stop_time": 6.0, "building": buildings, "contact": contacts, "ground": {"record": str(fmus.RECORD), "scale": 1.5}}


def test_a_model_of_any_building_of_a_row_is_known_by_its_name():
    """As if it were inside, where `b2` is the name of the second one, which has none; its stiffness is the model's."""
    inside = simulate(row(stiffness=STIFFNESS, **INSIDE), 0.0005)
    run = couple(row(), models={"b2": Bilinear()}, step=0.0005, how="twice")
    assert run["impacts"][-1] == inside["impacts"][-1] > 5
    for name in ("west.displacement[2]", "b2.displacement[3]", "east.displacement[3]"):
        assert np.abs(run[name] - inside[name]).max() < 1e-3 * np.abs(inside[name]).max(), name
    other = couple(row(stiffness=STIFFNESS), models={"east": Bilinear(0.6 * STIFFNESS)}, step=0.0005)
    assert np.abs(other["b2.displacement[3]"] - inside["b2.displacement[3]"]).max() > 1e-2 * np.abs(inside["b2.displacement[3]"]).max()


def test_mistakes_with_models_of_a_row():
    with pytest.raises(ValueError, match=r"left: the scene has no such building; expected the name of a building \(west, b2, east\)"):
        couple(row(stiffness=STIFFNESS), left=Bilinear())
    with pytest.raises(ValueError, match=r"wst: the scene has no such building; did you mean west\?"):
        couple(row(stiffness=STIFFNESS), models={"wst": Bilinear()})
    with pytest.raises(ValueError, match="models: left: expected it once, here or by its own argument"):
        couple(scene(), left=Bilinear(), models={"left": Bilinear()})
    with pytest.raises(TypeError, match="east: expected a model"):
        couple(row(stiffness=STIFFNESS), models={"east": object()})

"""Scenes of other shapes: each becomes an FMU that FMPy finds nothing wrong with and that runs like the engine."""

import zipfile

import fmpy.validation
import numpy as np
import pytest

import harness

LEFT = "stiffness = [2910.0, 2910.0]\ndamping = { ratio = 0.01 }"
LEFT_BY_MATRICES = """stiffness_matrix = [[5820.0, -2910.0], [-2910.0, 2910.0]]
damping = { matrix = [[3.0, -1.0], [-1.0, 2.0]] }"""
CONTACTS = harness.FEUP[harness.FEUP.index("[[contact]]") : harness.FEUP.index("[outputs]")]
SCENES = {
    "no contact": [(CONTACTS, "")],
    "no energy account": [("energy = true", "energy = false")],
    "full matrices": [(LEFT, LEFT_BY_MATRICES)],
    "modal damping": [(LEFT, LEFT.replace("ratio = 0.01", "ratios = [0.01, 0.02]"))],
    "Rayleigh damping": [(LEFT, LEFT.replace("ratio = 0.01", "rayleigh = { ratio = 0.05, modes = [1, 2] }"))],
    "storeys that yield": [(LEFT, LEFT + "\nyield_force = [10.0, inf]\npost_yield_ratio = [0.05, 0.0]")],
    "initial conditions": [(LEFT, LEFT + "\ninitial_displacement = [0.01, 0.02]\ninitial_velocity = [0.0, 0.3]")],
    "pressed together": [("gap = 0.005", "gap = -0.001")],
    "hertz": [('law = "kelvin_voigt"', 'law = "hertz"'), ("restitution = 0.65\n", "")],
    "rigid": [('law = "kelvin_voigt"\nstiffness = 1.0e6', 'law = "stereomechanical"')],
    "rigid, touching": [
        ('law = "kelvin_voigt"\nstiffness = 1.0e6', 'law = "stereomechanical"'),
        ("gap = 0.005", "gap = 0.0"),
        ("restitution = 0.65", "restitution = 0.3"),
    ],
    "floor forces": [("[outputs]", "[inputs]\nfloor_forces = true\n[outputs]")],
    "no stop time": [("stop_time = 20.0", "")],
    "scaled to a peak": [('el_centro_1940_ns.csv"', 'el_centro_1940_ns.csv"\npga = 4.903325')],
}


@pytest.mark.parametrize("edits", SCENES.values(), ids=SCENES.keys())
def test_it_is_valid_and_runs_like_the_engine(build, tmp_path, edits):
    text = harness.scene_with_record()
    for old, new in edits:
        text = harness.replaced(text, old, new)
    fmu = build(text)
    assert fmpy.validation.validate_fmu(fmu.path) == []
    run = fmu.simulate(0.01, stop=10.0)
    engine = harness.engine(fmu.scene, tmp_path, 0.01, stop=10.0)
    assert list(engine.dtype.names) == ["time", *fmu.outputs()]
    assert [name for name in engine.dtype.names if not np.array_equal(run[name], engine[name])] == []
    assert np.any(run["left.displacement[1]"])


def test_a_record_in_the_peer_format(build, feup, tmp_path):
    times, accelerations = harness.read_record()
    assert np.allclose(np.diff(times), 0.02)
    header = f"PEER\nEl Centro\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {len(times)}, DT= 0.02 SEC\n"
    record = tmp_path / "el_centro.AT2"
    record.write_text(header + "\n".join(repr(float(a)) for a in accelerations / 9.80665) + "\n")
    fmu = build(harness.scene_with_record(record))
    with zipfile.ZipFile(fmu.path) as archive:
        assert archive.read("resources/record.at2") == record.read_bytes()
    run, by_csv = fmu.simulate(0.01), feup.simulate(0.01)
    # The same motion but for the rounding of its numbers.
    for name in ["left.displacement[1]", "right.displacement[3]"]:
        assert np.max(np.abs(run[name] - by_csv[name])) <= 1e-10 * np.max(np.abs(by_csv[name])), name
    assert run["impacts"][-1] == by_csv["impacts"][-1]


def test_floor_forces_push(build):
    text = harness.replaced(harness.scene_without_record(), CONTACTS, "[inputs]\nfloor_forces = true\n")
    fmu = build(text)
    force = 10.0
    table = np.array([(0.0, force), (100.0, force)], dtype=[("time", float), ("left.force[2]", float)])
    run = fmu.simulate(0.01, stop=100.0, input=table)
    # Two storeys of 2910 N/m in series carry the force once the motion has died out.
    assert run["left.displacement[2]"][-1] == pytest.approx(2 * force / 2910.0, rel=1e-6)
    assert run["left.base_shear"][-1] == pytest.approx(force, rel=1e-6)
    assert not np.any(run["right.displacement[1]"])

"""The numbers of the guide and of the README are those that their commands give."""

import csv
import re
import shutil
import subprocess
import sys

import pytest

import harness

GUIDE = (harness.ROOT / "docs/guide.md").read_text()
README = (harness.ROOT / "README.md").read_text()
SCENE = harness.replaced(
    (harness.ROOT / "examples/scenes/offices.toml").read_text(),
    '"../records/el_centro_1940_ns.csv"',
    f'"{harness.RECORD}"',
)


@pytest.fixture(scope="module")
def offices(build):
    return build(SCENE)


def test_what_yielding_does_is_what_the_guide_quotes():
    program, scene = (harness.ROOT / "examples" / name for name in ("elastic_or_yielding.py", "scenes/yielding.toml"))
    printed = subprocess.run([sys.executable, program, scene], capture_output=True, text=True, check=True).stdout
    assert f"```text\n{printed}```" in GUIDE


def test_the_summary_of_storeys_that_yield_is_what_the_guide_quotes(tmp_path):
    printed = harness.run(harness.CARGO_FMU, "examples/scenes/yielding.toml", "-o", tmp_path / "Yielding.fmu")
    blocks = [block.split("```")[0] for block in GUIDE.split("```text\n")]
    (quoted,) = [block for block in blocks if block.startswith("  storey that can yield")]
    assert quoted in printed


def test_damping_does_to_storeys_that_yield_what_their_page_says(tmp_path):
    page = " ".join((harness.ROOT / "docs/yielding.md").read_text().split())
    frames = example_scene("yielding")
    rayleigh = frames.replace("{ ratio = 0.05 }", "{ rayleigh = { ratio = 0.05, modes = [1, 3] } }")
    isolated = example_scene("isolated").replace("gap = 0.1", "gap = 0.5").replace("[14e3,", "[140e3,")
    yields = "yield_force = [620, inf, inf, inf, inf]\npost_yield_ratio = 0.1\n"
    isolated = isolated.replace("damping =", f"{yields}damping =")
    by_ratio = re.sub("{ dashpots = .* }", "{ ratio = 0.05 }", isolated)
    scenes = [frames, rayleigh, harness.replaced(isolated, "[1350,", "[0,"), by_ratio]
    ends = []
    for text in scenes:
        scene = tmp_path / "scene.toml"
        scene.write_text(text)
        ends.append(harness.engine(scene, tmp_path, 31.18, stop=31.18)[-1])
    ductility = [end["left.ductility[1]"] for end in ends]
    assert f"a ductility of {ductility[1]:.2f} instead of {ductility[0]:.2f}" in page
    drift = [1e3 * end["left.peak_drift[1]"] for end in ends]
    assert f"drifts {drift[2]:.0f} mm on them, with `ratio = 0.05` {drift[3]:.0f} mm" in page


def example_scene(name):
    """An example as text that can lie anywhere."""
    text = (harness.ROOT / f"examples/scenes/{name}.toml").read_text()
    return harness.replaced(text, "../records/el_centro_1940_ns.csv", str(harness.RECORD))


def test_the_readme_quotes_what_its_ten_lines_print(feup, tmp_path):
    (tmp_path / "target/fmu").mkdir(parents=True)
    shutil.copy(feup.path, tmp_path / "target/fmu/FeupFrames.fmu")
    command = [sys.executable, harness.ROOT / "examples/drive_with_fmpy.py"]
    printed = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert f"```text\n{printed}```" in README


def test_the_summary_begins_as_the_guide_quotes(tmp_path):
    printed = harness.run(harness.CARGO_FMU, "examples/scenes/offices.toml", "-o", tmp_path / "Offices.fmu")
    (quoted,) = [block.split("```")[0] for block in GUIDE.split("```text\n") if block.startswith("  record ")]
    assert quoted in printed


def test_the_first_look_is_what_the_guide_says(offices):
    stop = float(offices.description.defaultExperiment.stopTime)
    last = offices.simulate(0.02, stop)[-1]
    force = max(last[f"contact[{p}].peak_force"] for p in (1, 2, 3))
    drifts = {name: last[name] for name in last.dtype.names if ".peak_drift[" in name}
    drift = drifts["left.peak_drift[1]"]
    assert drift == max(drifts.values()) and last["contact[1].impacts"] == 0
    left, right = offices.instance().start().get("left.frequency[1]", "right.frequency[1]")
    said = " ".join(GUIDE.split())
    for sentence in [
        f"{left:.2f} Hz on the left, {right:.2f} Hz on the right, periods of {1 / left:.2f} s and {1 / right:.2f} s.",
        f"{last['impacts']} in {stop:.0f} s, {last['contact[3].impacts']} of them at floor 3 and none at floor 1",
        f"**peak force**: {force / 1e6:.1f} MN.",
        f"{1e3 * drift:.0f} mm in the left building's first storey, 1/{3.2 / drift:.0f} of its height",
    ]:
        assert sentence in said


@pytest.fixture(scope="module")
def on_a_slope(build):
    """The offices of section 7: the right one stands lower."""
    (lower,) = [block.split("```")[0] for block in GUIDE.split("```toml\n") if block.startswith("base_level")]
    return build(harness.replaced(SCENE, "[right]\n", f"[right]\n{lower}"))


def test_the_summary_of_slabs_and_columns_is_what_the_guide_quotes(on_a_slope, tmp_path):
    printed = harness.run(harness.CARGO_FMU, on_a_slope.scene, "-o", tmp_path / "Slope.fmu")
    (quoted,) = [block.split("```")[0] for block in GUIDE.split("```text\n") if block.startswith("  contact ")]
    assert quoted in printed


def test_what_the_guide_makes_of_the_columns(on_a_slope):
    stop = float(on_a_slope.description.defaultExperiment.stopTime)
    last = on_a_slope.simulate(0.02, stop)[-1]
    force, shear = last["left.peak_column_force[3]"], last["left.peak_storey_shear[3]"]
    s, rigidity = 0.625, 30e9 * 0.45**4 / 12 / 2
    share = 3 * s**2 - 2 * s**3
    column = 3 * rigidity / (3.2 * s * (1 - s)) ** 3
    together = shear / 16 + share * force / 4
    softer = {f"contact[{p}].stiffness": 2.05e9 for p in range(1, 6)}
    soft = on_a_slope.simulate(0.02, stop, start_values=softer)[-1]["left.peak_column_force[3]"]
    said = " ".join(GUIDE.split())
    for sentence in [
        f"{last['impacts']} impacts instead of 11, and {1e3 * last['left.peak_drift[1]']:.0f} mm of drift",
        f"with {force / 1e6:.1f} MN.",
        f"storey shear, {shear / 16e6:.2f} MN, and above the blow N = {share:.3f} of a quarter of the force, "
        f"{share * force / 4e6:.2f} MN. Together {together / 1e6:.2f} MN",
        f"stress of {together / 0.45**2 / 1e6:.1f} N/mm2",
        f"over {column / 1e6:.0f} MN/m, so the four of them by {1e3 * force / (4 * column):.1f} mm",
        f"takes the force from {force / 1e6:.1f} to {soft / 1e6:.1f} MN.",
    ]:
        assert sentence in said, sentence


def lasting(scene, folder):
    """The shortest and the longest contact of a run, ms."""
    table = folder / "impacts.csv"
    harness.run(harness.SIMULATE, scene, "--impacts", table)
    times = [1e3 * (float(row["end_s"]) - float(row["start_s"])) for row in csv.DictReader(table.open())]
    return min(times), max(times)


def test_contacts_last_as_long_as_the_documents_say(feup, offices, tmp_path):
    (shortest, longest), frames = lasting(offices.scene, tmp_path), lasting(feup.scene, tmp_path)
    assert f"Here they last {shortest:.0f} to {longest:.0f} ms." in GUIDE
    reference = " ".join((harness.ROOT / "docs/reference.md").read_text().split())
    assert f"in the default scene one lasts {frames[0]:.0f} to {frames[1]:.0f} ms, " in reference
    assert f"between the office buildings of the guide {shortest:.0f} to {longest:.0f} ms." in reference


def rows():
    """The table of contacts: stiffness, restitution, and what is written beside them."""
    lines = [line for line in GUIDE.splitlines() if line.startswith("| 2.75e")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_there_are_five_contacts_in_the_table():
    assert len(rows()) == 5


@pytest.mark.parametrize("row", rows(), ids=lambda row: f"{row[0]}, {row[1]}")
def test_the_table_of_contacts(offices, row):
    stiffness, restitution = map(float, row[:2])
    start = {}
    for p in (1, 2, 3):
        start |= {f"contact[{p}].stiffness": stiffness, f"contact[{p}].restitution": restitution}
    names = ["impacts", "left.peak_drift[5]", "right.peak_drift[1]", *(f"contact[{p}].peak_force" for p in (1, 2, 3))]
    stop = offices.description.defaultExperiment.stopTime
    last = offices.simulate(0.02, stop, start_values=start, output=names)[-1]
    impacts, left, right, *forces = (last[name] for name in names)
    assert row[2:] == [f"{impacts}", f"{max(forces) / 1e6:.1f} MN", f"{1e3 * left:.1f} mm", f"{1e3 * right:.1f} mm"]

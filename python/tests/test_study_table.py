"""The table of a study: what is read is what was written, and what is damaged is told."""

import csv
import subprocess
import sys
import tracemalloc

import pyarrow.parquet
import pytest
from pounding_fmu.study import cases as of_cases
from pounding_fmu.study import results, table

STOREYS = {"left": 2, "right": 3}
NEVER_CLOSES = 1000.0


def results_of(folder, storeys=STOREYS):
    return results.Results(folder / "results.csv", storeys)


def case_of(record="R", pga=1.0, gap=0.01):
    return of_cases.Case("A", "a", record, "r", pga, gap, 5.0)


def row_of(case, *, storeys=STOREYS, drift=0.02, **more):
    numbers = {name: kind(2) for name, kind in table.always(storeys).items()}
    known = results.columns_of(case)
    of_storeys = {f"{side}_drift_m[{i}]": drift * i for side, count in storeys.items() for i in range(1, count + 1)}
    return {**known, **numbers, **of_storeys, "error": "", **more}


def test_what_comes_after_a_torn_row_is_whole(tmp_path):
    """Killed while writing, gone on, killed again: only the torn row is missing."""
    cases = [case_of(pga=pga) for pga in (1.0, 2.0, 3.0)]
    for case in cases[:2]:
        opened = results_of(tmp_path)
        opened.add([row_of(case, peak_force_n=1.5)])
        opened.close()
        with (tmp_path / "results.csv").open("a") as file:
            file.write("A,a,R,r,9.0,0.0")
    opened = results_of(tmp_path)
    assert opened.missing(cases) == cases[2:] and len(opened.rows) == 2
    found = opened.finish(cases)
    assert [line["pga_m_s2"] for line in found] == [1.0, 2.0]
    assert found[1]["peak_force_n"] == 1.5


def test_rows_are_kept_in_the_file_alone(tmp_path):
    """A study of any length: in memory is what names each case, and whether it failed, less than half of a row."""
    opened, count = results_of(tmp_path), 5000
    cases = [case_of(pga=float(pga)) for pga in range(1, count + 1)]
    tracemalloc.start()
    for first in range(0, count, 100):
        opened.add(row_of(case, peak_force_n=1.1 * case.pga) for case in cases[first : first + 100])
    kept = tracemalloc.get_traced_memory()[0] / count
    tracemalloc.stop()
    assert kept < 600, f"{kept:.0f} bytes a case"
    assert not opened.missing(cases) and len(opened.rows) == count


def test_a_taller_building_finds_room_in_a_table_that_is_there(tmp_path):
    low, high = case_of(), case_of(record="S")
    opened = results_of(tmp_path)
    opened.add([row_of(low)])
    opened.close()
    opened = results_of(tmp_path, {"left": 4, "right": 2})
    opened.add([row_of(high, storeys={"left": 4, "right": 2})])
    opened.finish([low, high])
    opened.close()
    with (tmp_path / "results.csv").open() as file:
        lines = list(csv.DictReader(file))
    assert [lines[0][f"left_drift_m[{i}]"] for i in (1, 2, 3, 4)] == ["0.02", "0.04", "", ""]
    assert lines[0]["right_drift_m[3]"] == "0.06" and lines[1]["right_drift_m[3]"] == ""
    assert lines[1]["left_drift_m[4]"] == "0.08"


def test_a_ratio_needs_the_run_without_contact(tmp_path):
    near, far, lonely = case_of(), case_of(gap=NEVER_CLOSES), case_of(record="S")
    opened = results_of(tmp_path)
    opened.add([row_of(near, **{"right_drift_m[1]": 0.06, "right_drift_m[2]": 0.01}), row_of(far), row_of(lonely)])
    found = opened.finish([near, far, lonely])
    assert [row["right_drift_ratio"] for row in found] == [pytest.approx(3.0), 1.0, None]
    assert [row["left_drift_ratio"] for row in found] == [1.0, 1.0, None]


@pytest.mark.parametrize(
    "damage, said",
    [
        (lambda lines: [*lines[:2], b"", *lines[2:]], ["line 3: expected 57 cells, found a blank line"]),
        (lambda lines: [*lines[:2], b"hello", *lines[2:]], ["line 3: expected 57 cells, found 1"]),
        (lambda lines: [*lines[:2], b"\xff\xfe", *lines[2:]], ["line 3: no text: byte 0xff at 1"]),
        (lambda lines: [b"\x00\xc3" + lines[0], *lines[1:]], ["line 1: no text: byte 0xc3 at 2"]),
        (lambda lines: [b"a,b,c", *lines[1:]], ["line 1: no table of this version's studies"]),
        (lambda lines: [b"", *lines], ["line 1: no table"]),
        (
            lambda lines: [*lines[:2], lines[2].replace(b",2,", b",two,"), lines[3].replace(b",2.0,", b",inf,", 1)],
            ["line 3: impacts = 'two': expected a whole number", "line 4: pga_m_s2 = 'inf': expected a number"],
        ),
        (lambda lines: [*lines[:2], lines[2].replace(b",0.01,", b",,")], ["line 3: gap_m: expected a value"]),
        (lambda lines: [*lines[:2], b'"' + lines[2], *lines[3:]], ["line "]),
        (lambda lines: [lines[0], *[b"x"] * 1000], ["line 2: expected 57", "line 11: expected 57", "and 990 more"]),
    ],
)
def test_a_damaged_table_is_told_by_its_lines(tmp_path, damage, said):
    opened = results_of(tmp_path)
    opened.add([row_of(case_of(pga=pga)) for pga in (1.0, 2.0, 2.0)][:2] + [row_of(case_of(pga=2.0, gap=0.02))])
    opened.close()
    path = tmp_path / "results.csv"
    path.write_bytes(b"\n".join([*damage(path.read_bytes().splitlines()), b""]))
    before = path.read_bytes()
    with pytest.raises(ValueError) as stopped:
        results_of(tmp_path)
    assert all(f"{path}, {part}" in str(stopped.value) or part in str(stopped.value) for part in said), stopped.value
    assert len(str(stopped.value).splitlines()) < 13
    assert path.read_bytes() == before


def test_a_building_that_is_not_there_may_lack_its_numbers_but_no_other_may(tmp_path):
    whole = row_of(case_of())
    one_lacks = row_of(case_of(pga=2.0), right_drift_m=None)
    absent = {name: None if name.startswith("right_") else value for name, value in row_of(case_of(pga=3.0)).items()}
    opened = results_of(tmp_path)
    opened.add([whole, absent])
    opened.close()
    opened = results_of(tmp_path)
    assert len(opened.rows) == 2
    opened.add([one_lacks])
    opened.close()
    with pytest.raises(ValueError, match="line 4: right_drift_m: expected a value, or a reason in error"):
        results_of(tmp_path)


NAMES = ["=1+1", "+1", "-1", "@SUM(A1)", "'quoted", "''=x", 'say "a,b"', "\tx", "plain", "ü\u2028"]


def test_no_name_becomes_a_formula_and_each_is_read_as_it_was(tmp_path):
    cases = [case_of(record=name) for name in NAMES]
    opened = results_of(tmp_path)
    opened.add([row_of(case, error="=cmd") if i == 0 else row_of(case) for i, case in enumerate(cases)])
    opened.close()
    with (tmp_path / "results.csv").open(newline="") as file:
        cells = [cell for line in csv.reader(file) for cell in line]
    assert not any(cell[:1] in {*"=+-@\t\r"} for cell in cells)
    opened = results_of(tmp_path)
    assert [row["record"] for row in opened.rows.values()] == NAMES
    assert opened.missing(cases) == cases[:1] and opened.rows[next(iter(opened.rows))]["error"] == "=cmd"


def test_there_is_no_parquet_where_there_is_no_library_for_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    opened = results_of(tmp_path)
    opened.finish([])
    assert not (tmp_path / "results.parquet").exists()


def test_parquet_is_the_same_table(tmp_path):
    cases = [case_of(pga=pga) for pga in (1.0, 2.0, 3.0)]
    opened = results_of(tmp_path)
    opened.add([row_of(case, **{"left_drift_m[1]": 0.1 / 3}) for case in cases[:2]])
    opened.add([{**results.columns_of(cases[2]), "error": "failed"}])
    opened.finish(cases)
    found = pyarrow.parquet.read_table(tmp_path / "results.parquet")
    with (tmp_path / "results.csv").open(newline="") as file:
        names, *lines = csv.reader(file)
    assert found.column_names == names
    assert [["" if value is None else str(value) for value in row.values()] for row in found.to_pylist()] == lines
    assert lines[2][names.index("impacts")] == "" and lines[0][names.index("left_drift_m[1]")] == repr(0.1 / 3)
    kinds = [str(found.schema.field(name).type) for name in ("impacts", "left_drift_m[2]", "scene")]
    assert kinds == ["int64", "double", "string"]
    opened.close()
    # A study that goes on has another table than the last one that ended.
    results_of(tmp_path)
    assert not (tmp_path / "results.parquet").exists()


def test_the_parquet_table_needs_no_pandas():
    """Which takes longer to begin than the table of a study takes to write."""
    program = (
        "import pathlib, sys, tempfile, pyarrow.parquet\n"
        "from pounding_fmu.study import results\n"
        "path = pathlib.Path(tempfile.mkdtemp()) / 'table.parquet'\n"
        "rows = [{'scene': 'ü', 'impacts': 3, 'pga_m_s2': 0.1}, {'scene': '', 'impacts': None, 'pga_m_s2': None}] * 9\n"
        "results.write_parquet(path, {'scene': str, 'impacts': int, 'pga_m_s2': float}, rows)\n"
        "assert 'pandas' not in sys.modules\n"
        "assert pyarrow.parquet.read_table(path).to_pylist() == rows\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)

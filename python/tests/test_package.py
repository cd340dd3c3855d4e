"""The package: its types, what it exports, how soon it is there."""

import importlib.metadata
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pounding_fmu
from elftools.elf.elffile import ELFFile

PACKAGE = Path(pounding_fmu.__file__).parent
USER = """
from pathlib import Path
import numpy as np
import pounding_fmu as p

path: Path = p.build_fmu(Path("a"), "b", platforms=("linux64",))
problems: list[str] = p.problems({"left": {"mass": np.ones(2)}})
unit: str | None = p.variables("a")["b"].unit
result: p.Result = p.simulate("a", 0.01, 2, ["x"], {"y": 1, "ground.record": Path("z")}, ([0, 1], np.ones(2)))
total: float = float(result["time"].sum()) + float(result.impacts["start_s"][0])
ends = p.simulate_batch("a", {"x": [1, 2], "y": 3.0}, ["z"], records=["a", ([0], [1])], threads=2, progress=print)
shape: tuple[int, ...] = ends.shape
try:
    pass
except p.BatchError as error:
    failures: dict[int, str] = error.failures
"""


def mypy(*arguments, module="mypy"):
    environment = {**os.environ, "MYPY_CACHE_DIR": os.devnull}
    command = [sys.executable, "-m", module, *map(str, arguments)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def test_types_of_the_package():
    code, said = mypy("--strict", "-p", "pounding_fmu")
    assert code == 0, said


def test_types_for_users(tmp_path):
    user = tmp_path / "user.py"
    user.write_text(USER)
    code, said = mypy("--strict", user)
    assert code == 0, said
    user.write_text(USER + "p.simulate(3)\nends.no\np.simulate_batch('a', {}, [1])\n")
    code, said = mypy("--strict", user)
    assert said.count("error:") == 3, said


def test_stubs_are_those_of_the_module():
    code, said = mypy("pounding_fmu._native", module="mypy.stubtest")
    assert code == 0, said


def test_all_names_have_docstrings():
    for name in pounding_fmu.__all__:
        assert hasattr(pounding_fmu, name)
        if callable(getattr(pounding_fmu, name)):
            assert len(getattr(pounding_fmu, name).__doc__) > 50, name


def test_the_module_exports_its_beginning_only():
    with (PACKAGE / "_native.abi3.so").open("rb") as file:
        symbols = ELFFile(file).get_section_by_name(".dynsym").iter_symbols()
        exported = {s.name for s in symbols if s["st_shndx"] != "SHN_UNDEF" and s["st_info"]["bind"] != "STB_LOCAL"}
    assert exported == {"PyInit__native"}


def test_it_is_there_at_once_and_without_numpy():
    code = "import sys, pounding_fmu.__main__; assert 'numpy' not in sys.modules"
    times = []
    for _ in range(3):
        began = time.monotonic()
        subprocess.run([sys.executable, "-c", code], check=True)
        times.append(time.monotonic() - began)
    assert min(times) < 1.0, times


def test_data():
    data = pounding_fmu.example_scene.parent.parent
    assert {file.name for file in (data / "scenes").iterdir()} >= {
        f"{name}.toml" for name in ["feup", "isolated", "leaning", "neighbours", "offices", "on_soil", "two_blocks", "yielding"]
    }
    for scene in (data / "scenes").iterdir():
        assert pounding_fmu.problems(scene) == []
    assert (data / "LICENSE-MIT").is_file() and (PACKAGE / "py.typed").is_file()
    metadata = importlib.metadata.metadata("pounding-fmu")
    assert metadata["Requires-Python"] == ">=3.10" and metadata["Version"] == pounding_fmu.__version__
    needed = [re.split(r"[>; ]+", name) for name in metadata.get_all("Requires-Dist")]
    assert [name for name, _, *extra in needed if not extra] == ["numpy"]
    extras = {(name, extra[-1].strip("'\"")) for name, _, *extra in needed if extra}
    assert extras == {("matplotlib", "plot"), ("distributed", "study"), ("pyarrow", "study")}
    page = metadata.get_payload()
    assert page.count("](data:image/png;base64,iVBOR") == 2 and "docs/" not in page

"""Solvers that are programs of their own: the engine, and the peers written in C."""

import os
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from . import OUTPUT_STEP, Outcome

ROOT = Path(__file__).resolve().parents[2]
SOURCES = Path(__file__).parent / "c"
BUILT = ROOT / "target/benchmarks/bin"
SUNDIALS = ["-lsundials_cvode", "-lsundials_nvecserial"]


class Solver:
    """One program with one method and one setting."""

    def __init__(self, program, problem_file, floors, method, setting):
        self.command = [str(word) for word in (program, problem_file, method, setting)]
        self.floors = floors
        self.setup = 0.0

    def run(self, warm_up=False):
        repeats = 2 if warm_up else 1
        with tempfile.NamedTemporaryFile(dir=BUILT.parent) as output:
            command = [*self.command, str(repeats), output.name]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                raise RuntimeError(done.stderr.strip())
            displacements = np.fromfile(output.name).reshape(-1, self.floors)
        times, impacts, *rest = done.stdout.splitlines()
        counters = {name: float(value) for name, value in (line.split("=") for line in rest)}
        self.setup = counters.pop("setup_s", 0.0)
        times = [float(time) for time in times.split()]
        impacts = int(impacts) if int(impacts) >= 0 else None
        return Outcome(times[-1], displacements, impacts, counters, times[0])


def build_engine(environment=None, program="run_time"):
    """The program of benchmarks/run_time.rs, or another one of that folder; BENCHMARK_BUILD says how it is compiled."""
    how = shlex.split(os.environ.get("BENCHMARK_BUILD", "--release"))
    command = ["cargo", "build", *how, "--quiet", "--example", program, "--message-format", "json"]
    done = subprocess.run(command, cwd=ROOT, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    lines = done.stdout.splitlines()
    programs = [line.split('"executable":"')[1].split('"')[0] for line in lines if '"executable":"' in line]
    return Path(programs[-1])


def build_fixed_step():
    return compile_c("fixed_step", [], [])


def build_cvode():
    """With the system's SUNDIALS, or with Debian's package unpacked below target/; an error says why it cannot be."""
    try:
        return compile_c("cvode", [], SUNDIALS)
    except subprocess.CalledProcessError:
        folder = debian_package("libsundials-dev")
        library = next(folder.glob("usr/lib/**/libsundials_cvode.a")).parent
        archives = [library / f"libsundials_{name}.a" for name in ("cvode", "nvecserial", "generic")]
        return compile_c("cvode", [f"-I{folder}/usr/include"], archives)


def compile_c(name, options, libraries):
    BUILT.mkdir(parents=True, exist_ok=True)
    built = BUILT / name
    sources = [SOURCES / f"{name}.c", SOURCES / "problem.c"]
    if not built.exists() or built.stat().st_mtime < max(file.stat().st_mtime for file in SOURCES.iterdir()):
        command = ["gcc", "-O3", "-march=native", *options, "-o", built, *sources, *libraries, "-lm"]
        subprocess.run(command, check=True, capture_output=True)
    return built


def debian_package(name):
    """A package of Debian's, downloaded and unpacked without being installed."""
    folder = BUILT.parent / "debian" / name
    if not folder.exists():
        if not shutil.which("apt-get"):
            raise RuntimeError(f"{name} is not installed")
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as download:
            subprocess.run(["apt-get", "download", name], cwd=download, check=True, capture_output=True)
            subprocess.run(["dpkg", "-x", next(Path(download).glob("*.deb")), folder], check=True)
    return folder


def write_problem(problem, ground, file):
    """The problem as numbers, for the programs in C (format: read_problem in problem.c)."""
    mass, K, C = problem.matrices
    times, accelerations = ground
    links = len(problem.contacts) + len(problem.yielding_storeys)
    lines = [[len(mass), links, len(times), problem.stop, OUTPUT_STEP], mass, K.ravel(), C.ravel()]
    for contact in problem.contacts:
        law = contact.law
        right = contact.floor + problem.floors[0]
        exponent = 0.25 if law == "jankowski" else 0.0
        flags = [law == "kelvin_voigt", law == "jankowski"]
        spring = [contact.stiffness, contact.exponent, contact.damping, exponent, contact.relative_damping]
        lines.append([contact.floor, right, contact.gap, *spring, *flags, 0.0])
    for storey in problem.yielding_storeys:
        lower = -1 if storey.lower is None else storey.lower
        lost = (1.0 - storey.post_yield_ratio) * storey.stiffness
        lines.append([storey.upper, lower, 0.0, lost, *[0.0] * 6, storey.yield_force / storey.stiffness])
    lines += [times, accelerations]
    file.write_text("\n".join(" ".join(repr(float(value)) for value in line) for line in lines) + "\n")

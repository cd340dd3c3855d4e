"""The command `pounding-fmu` as a user runs it, where neither cargo nor a compiler is on the path."""

import os
import shutil
import signal
import subprocess
import time

import fmus
import pytest


def run(*arguments, cwd=None, **more):
    return subprocess.run(
        ["pounding-fmu", *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=120, **more
    )


def well(*arguments, cwd=None):
    done = run(*arguments, cwd=cwd)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_no_compiler_is_here():
    assert [program for program in ("cargo", "rustc", "cc", "gcc") if shutil.which(program)] == []


def test_an_fmu_of_a_scene(tmp_path):
    text = well(fmus.FEUP, cwd=tmp_path)
    assert "FeupFrames.fmu (" in text and "impacts" in text and "target" not in text
    made = tmp_path / "FeupFrames.fmu"
    assert [file.name for file in tmp_path.iterdir()] == ["FeupFrames.fmu"]
    assert "ok" in well("check", made)
    for platforms in ([fmus.HOST], [f"{fmus.HOST},{fmus.HOST}"], [fmus.HOST, fmus.HOST]):
        well(fmus.FEUP, "-o", tmp_path / "new" / "x.fmu", "--platform", *platforms)
        assert (tmp_path / "new" / "x.fmu").read_bytes() == (fmus.REFERENCES / "feup.fmu").read_bytes()


@pytest.mark.skipif(fmus.HOST != "linux64", reason="changes a library for Intel Linux")
def test_several_platforms_are_those_of_merge(tmp_path):
    """A library whose head says Arm is one for Arm, as far as packing goes."""
    library = fmus.libraries(fmus.REFERENCES / "feup.fmu")["linux64"]
    for platform, machine in (("linux64", b"\x3e"), ("aarch64-linux", b"\xb7")):
        (tmp_path / platform).mkdir()
        (tmp_path / platform / "pounding.so").write_bytes(library[:18] + machine + library[19:])
    for platform in ("linux64", "aarch64-linux"):
        well(fmus.FEUP, "--libraries", tmp_path, "--platform", platform, "-o", tmp_path / f"{platform}.fmu")
    well(fmus.FEUP, "--libraries", tmp_path, "-o", tmp_path / "all.fmu")
    well("merge", tmp_path / "aarch64-linux.fmu", tmp_path / "linux64.fmu", "-o", tmp_path / "merged.fmu")
    assert (tmp_path / "merged.fmu").read_bytes() == (tmp_path / "all.fmu").read_bytes()
    assert set(fmus.libraries(tmp_path / "all.fmu")) == {"linux64", "aarch64-linux"}


def test_the_default_scene(tmp_path):
    well(cwd=tmp_path)
    assert (tmp_path / "FeupFrames.fmu").is_file()


def test_it_starts_itself_in_a_folder_full_of_traps(tmp_path):
    """The FMU is tried in a process of its own, which must not take what lies in the current directory for modules."""
    for trap in ("pounding_fmu.py", "signal.py", "numpy.py", "os.py", "site.py"):
        (tmp_path / trap).write_text("raise SystemExit('trapped')")
    well(fmus.FEUP, cwd=tmp_path)


def test_simulate(tmp_path):
    text = well("simulate", fmus.FEUP, "--stop", "3", "--csv", tmp_path / "motion.csv", "--html", tmp_path / "run.html")
    assert text.splitlines()[-1].startswith("solve_seconds=")
    assert (tmp_path / "motion.csv").read_text().startswith("time,ground.acceleration,")
    assert "<html" in (tmp_path / "run.html").read_text()


def test_version_and_help():
    import pounding_fmu

    assert well("--version") == f"pounding-fmu {pounding_fmu.__version__}\n"
    text = well("--help")
    assert "Usage: pounding-fmu" in text and "cargo fmu" not in text
    assert all(command in text for command in ("check", "merge", "simulate"))


@pytest.mark.parametrize(
    "arguments",
    [
        ["--nonsense"],
        ["a.toml", "b.toml"],
        ["check"],
        ["merge", "a.fmu"],
        ["simulate"],
        ["simulate", "x.toml", "--step", "0"],
        ["simulate", "x.toml", "--stop", "nan"],
        ["simulate", "x.toml", "--stop", "1e300"],
    ],
)
def test_wrong_usage(arguments):
    done = run(*arguments)
    assert done.returncode == 2 and done.stdout == ""
    assert "error: " in done.stderr and "Traceback" not in done.stderr


def mistakes(folder):
    (folder / "bad.toml").write_text(fmus.feup("gap = 0.005", "gap = inf").replace("[3.65, 3.65]", "[3.65, -1]"))
    (folder / "no.fmu").write_bytes(b"PK no archive")
    well(fmus.FEUP, "-o", folder / "good.fmu")
    return {
        "a scene with mistakes": (["bad.toml"], ["left.mass[2] = -1.0: expected", "contact[1].gap = inf: expected"]),
        "no scene": (["missing.toml"], ["missing.toml: expected a scene file, but No such file"]),
        "an output that is no FMU": ([fmus.FEUP, "-o", "x.zip"], ["x.zip: expected a name that ends in .fmu"]),
        "a platform": ([fmus.FEUP, "--platform", "win95"], ["platform win95: expected one of", fmus.HOST]),
        "a scene to simulate": (
            ["simulate", "bad.toml"],
            ["bad.toml is not a scene that can be run:", "left.mass[2] = -1.0: expected"],
        ),
        "more rows than can be written": (["simulate", fmus.FEUP, "--step", "1e-300"], ["expected at most 1e12, by a larger step"]),
        "no FMU to check": (["check", "missing.fmu"], []),
        "what is no FMU": (["check", "no.fmu"], []),
        "the same twice": (["merge", "good.fmu", "good.fmu", "-o", "both.fmu"], [fmus.HOST]),
        "no FMU to merge": (["merge", "good.fmu", "no.fmu", "-o", "both.fmu"], ["no.fmu"]),
    }


def test_mistakes(tmp_path):
    for what, (arguments, texts) in mistakes(tmp_path).items():
        done = run(*arguments, cwd=tmp_path)
        said = done.stdout + done.stderr
        assert done.returncode == 1, (what, said)
        assert said.strip() and [text for text in texts if text not in said] == [], (what, said)
        assert "panicked" not in said and "Traceback" not in said, (what, said)
    assert not (tmp_path / "both.fmu").exists()


def test_slips_are_told(tmp_path):
    (tmp_path / "slip.toml").write_text(fmus.feup("gap = 0.005", "gap = 5.0"))
    done = run("slip.toml", cwd=tmp_path)
    assert done.returncode == 0 and done.stderr.startswith("warning: contact[1].gap = 5.0: ")


@pytest.mark.skipif(os.name == "nt", reason="no SIGINT for another process")
def test_ctrl_c(tmp_path):
    arguments = ["pounding-fmu", "simulate", fmus.FEUP, "--stop", "1e7", "--step", "0.001"]
    process = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    time.sleep(1.5)
    assert process.poll() is None
    process.send_signal(signal.SIGINT)
    try:
        output, errors = process.communicate(timeout=10)
    finally:
        process.kill()
    assert (process.returncode, output, errors) == (-signal.SIGINT, "", "")

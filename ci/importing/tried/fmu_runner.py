"""fmu-runner: FMUs from Rust. The program is beside this file."""

from pathlib import Path

NAME = "fmu-runner"
PACKAGES = []
GET = "cargo add fmu-runner@0.4.4"
TAKE = "2.0, numbers only"
KNOW = (
    "A crate; FMI 2.0 only. Takes `maxOutputDerivativeOrder` for true or false, so it reads no FMU of ours but those of numbers "
    "only. Knows no texts"
)

MANIFEST = """
[package]
name = "runs"
version = "0.0.0"
edition = "2024"
[dependencies]
fmu-runner = "=0.4.4"
[workspace]
"""

HERE = Path(__file__).resolve()
PROJECT = HERE.parents[3] / "target/importers/fmu-runner-project"


def run(fmu, names, values, step, stop):
    import subprocess

    (PROJECT / "src").mkdir(parents=True, exist_ok=True)
    (PROJECT / "Cargo.toml").write_text(MANIFEST)
    (PROJECT / "src/main.rs").write_text(HERE.with_suffix(".rs").read_text())
    pairs = ";".join(f"{name}={value!r}" for name, value in values.items())
    command = ["cargo", "run", "--quiet", "--manifest-path", PROJECT / "Cargo.toml", "--"]
    arguments = [fmu, repr(step), repr(stop), ";".join(names), pairs]
    done = subprocess.run([*command, *arguments], stdout=subprocess.PIPE, text=True, check=True)
    return map(float, done.stdout.split())

"""fmu-manipulation-toolbox: an FMU that holds others."""

NAME = "fmu-manipulation-toolbox"
PACKAGES = ["fmu-manipulation-toolbox==2.0", "fmpy==0.3.32"]
TAKE = "a container of the version of what is in it"
KNOW = (
    "The container, here run by FMPy. Of two of ours: [name the outputs](#containers), or those of one building come under the "
    "names of the other. From 2.0 into 3.0 and back Booleans are lost without a word. A container saves no states"
)


def run(fmu, names, values, step, stop):
    import json
    import shutil
    import subprocess
    import sys
    from pathlib import Path

    from fmpy import read_model_description, simulate_fmu

    shutil.copy(fmu, "inner.fmu")
    version = read_model_description("inner.fmu").fmiVersion[0]
    container = {
        "name": "container.fmu",
        "step_size": step,
        "fmu": ["inner.fmu"],
        "start": [["inner.fmu", name, value] for name, value in values.items()],
        "output": [["inner.fmu", name, name] for name in names],
        **{f"auto_{what}": False for what in ["link", "input", "output", "parameter"]},
    }
    Path("container.json").write_text(json.dumps(container))
    command = [Path(sys.executable).parent / "fmucontainer", "-fmu-directory", ".", "-container", "container.json"]
    subprocess.run([*map(str, command), "-fmi", version], check=True)
    result = simulate_fmu(
        "container.fmu", stop_time=stop, step_size=step, output_interval=step, output=names
    )
    return [result[name][-1] for name in names]

"""CoFMUPy: FMUs that are connected by a graph."""

NAME = "CoFMUPy"
PACKAGES = ["cofmupy==1.0.0", "fmpy==0.3.20"]
TAKE = "numbers only, either version"
KNOW = (
    "Reads every output as a number. `time` is the beginning of the step at whose end the values are, and there is no row for "
    "t = 0. Inputs that nothing is connected to are set to 0. Parameters go into `initialization`"
)


def run(fmu, names, values, step, stop):
    from cofmupy import Coordinator

    coordinator = Coordinator()
    unit = {"id": "buildings", "path": fmu, "initialization": values}
    coordinator.start({"fmus": [unit], "connections": []})
    for _ in range(round(stop / step)):
        coordinator.do_step(step)
    results = coordinator.get_results()
    return [results["buildings", name][-1] for name in names]

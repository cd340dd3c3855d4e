"""SOFIRpy: FMUs beside models in Python."""

NAME = "SOFIRpy"
PACKAGES = ["sofirpy==1.0.2", "fmpy==0.3.20"]
TAKE = "2.0"
KNOW = (
    "FMI 2.0 only. Ends one step early for some stop times, whose number of steps is rounded down. What it unpacks stays in the "
    "temporary folder"
)


def run(fmu, names, values, step, stop):
    from sofirpy import simulate

    result = simulate(
        stop_time=stop,
        step_size=step,
        fmu_paths={"buildings": fmu},
        start_values={"buildings": values},
        parameters_to_log={"buildings": names},
    )
    last = result.iloc[-1]
    return [last[f"buildings.{name}"] for name in names]

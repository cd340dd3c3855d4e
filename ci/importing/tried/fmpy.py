"""FMPy: what all others are compared with."""

NAME = "FMPy"
PACKAGES = ["fmpy==0.3.32"]
TAKE = "2.0; 3.0 to [stop at impacts](fmi3.md#all-impacts-from-any-master)"
KNOW = (
    "Say `output_interval`: without it the default step is doubled until there are 1000 steps at most, and an input that comes "
    "from a table loses every sample between. Its exceptions do not cross processes ([below](#many-runs-at-once))"
)


def run(fmu, names, values, step, stop):
    from fmpy import simulate_fmu

    result = simulate_fmu(fmu, stop_time=stop, output_interval=step, start_values=values, output=names)
    return [result[name][-1] for name in names]

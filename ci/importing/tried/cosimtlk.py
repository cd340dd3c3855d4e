"""cosimtlk: FMUs in discrete-event simulations."""

NAME = "cosimtlk"
PACKAGES = ["cosimtlk==0.6.8", "fmpy==0.3.20", "requests==2.32.5", "pydantic==2.12.4"]
TAKE = "2.0"
KNOW = (
    "FMI 2.0 only. `requests` and `pydantic` are to be installed, too. Parameters go into `start_values`: `change_parameters` "
    "writes outputs back, which no FMU takes. Time is a sum of steps, and `advance(t)` goes on to the first step at or beyond t"
)


def run(fmu, names, values, step, stop):
    from cosimtlk import FMU

    with FMU(fmu).instantiate(start_time=0.0, step_size=step, start_values=values) as instance:
        outputs = instance.advance(stop - step / 2)
    return [outputs[name] for name in names]

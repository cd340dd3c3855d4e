"""SysSimX: FMUs beside finite elements and muscles, with units."""

NAME = "SysSimX"
PACKAGES = ["syssimx==0.4.3", "fmpy==0.3.32"]
TAKE = "2.0"
KNOW = (
    "FMI 2.0 only, and says so. Its component runs, tried alone; its `System` begins with a step of length 0, which FMI 2.0 rules "
    "out and this FMU refuses. Parameters have units (pint). FMPy is to be installed, too"
)


def run(fmu, names, values, step, stop):
    from syssimx.components.fmu import FMUComponent

    component = FMUComponent("buildings", fmu)
    component.set_parameters(**values)
    component.initialize(t0=0.0)
    for k in range(round(stop / step)):
        component.do_step(k * step, step)
    outputs = component.get_outputs()
    return [getattr(outputs[name], "magnitude", outputs[name]) for name in names]

"""SysSimX: FMUs beside finite elements and muscles, with units."""

NAME = "SysSimX"
PACKAGES = ["syssimx==0.4.3", "fmpy==0.3.32"]
TAKE = "2.0"
KNOW = "FMI 2.0 only, and says so. Parameters have units (pint). FMPy is not among what it asks for: install it, too"


def run(fmu, names, values, step, stop):
    from syssimx.components.fmu import FMUComponent
    from syssimx.system.system import System

    component = FMUComponent("buildings", fmu)
    component.set_parameters(**values)
    system = System("one")
    system.add_component(component)
    system.initialize(t0=0.0)
    system.run(t0=0.0, tf=stop, dt=step)
    outputs = component.get_outputs()
    return [getattr(outputs[name], "magnitude", outputs[name]) for name in names]

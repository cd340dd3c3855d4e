"""ovfmi: FMUs on a stage of USD; its class of running FMUs, without a stage."""

NAME = "ovfmi"
PACKAGES = ["ovfmi==0.2.0", "fmpy==0.3.25"]
TAKE = "either version"
KNOW = (
    "Tried by its runtime class alone: the public one needs a stage of USD. Asked for t it hands on the last row before t. Its "
    "SSP part sets and gets every variable as a number"
)


def run(fmu, names, values, step, stop):
    from fmpy import extract, instantiate_fmu, read_model_description
    from ovfmi._fmpy_runtime import FmuRuntimeInstance

    description, folder = read_model_description(fmu), extract(fmu)
    instance = FmuRuntimeInstance(None, description, instantiate_fmu(folder, description, "CoSimulation"))
    instance.set_start_values(values)
    row = None
    for k in range(1, round(stop / step) + 2):
        row = instance.step(folder, {}, names, k * step)
    instance.destroy()
    return [row[name] for name in names]

"""fmuloader: the functions of an FMU by ctypes, nothing else."""

NAME = "fmuloader"
PACKAGES = ["fmuloader==0.1.2rc0"]
TAKE = "either version"
KNOW = (
    "Before release: `pip install --pre`. A step that is discarded, as after a collapse, is no exception: look at the status "
    "that `do_step` returns"
)


def run(fmu, names, values, step, stop):
    from fmuloader.fmi2 import Fmi2Slave, Fmi2Type
    from fmuloader.fmi3 import Fmi3Slave

    root = described(fmu)
    identifier = root.get("modelName")
    if root.get("fmiVersion") == "2.0":
        slave = Fmi2Slave(fmu, model_identifier=identifier)
        slave.instantiate("buildings", Fmi2Type.CO_SIMULATION, guid=root.get("guid"))
        slave.setup_experiment(0.0)
        set_number, get = slave.set_real, {"Real": slave.get_real, "Integer": slave.get_integer}
    else:
        slave = Fmi3Slave(fmu, model_identifier=identifier)
        slave.instantiate_co_simulation("buildings", instantiation_token=root.get("instantiationToken"))
        set_number, get = slave.set_float64, {"Float64": slave.get_float64, "Int32": slave.get_int32}
    known = variables(root)
    slave.enter_initialization_mode()
    for name, value in values.items():
        set_number([known[name][0]], [value])
    slave.exit_initialization_mode()
    for k in range(round(stop / step)):
        slave.do_step(k * step, (k + 1) * step - k * step)
    found = [get[kind]([reference])[0] for reference, kind in map(known.get, names)]
    slave.terminate()
    slave.free_instance()
    return found


def described(fmu):
    import zipfile
    from xml.etree import ElementTree

    return ElementTree.fromstring(zipfile.ZipFile(fmu).read("modelDescription.xml"))


def variables(root):
    """Value reference and type of each variable, by its name."""
    found = root.find("ModelVariables")
    typed = [(variable, variable[0].tag if variable.tag == "ScalarVariable" else variable.tag) for variable in found]
    return {variable.get("name"): (int(variable.get("valueReference")), kind) for variable, kind in typed}

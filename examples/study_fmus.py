"""Runs the cases of a study with an FMU in FMPy, one after the other."""

import threading
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE, fmi2Error

from study_worker import failed


class Fmu:
    """An FMU, unpacked beside its file, and an instance of it for each thread."""

    def __init__(self, file, description):
        self.description = description
        self.instance_of = (read_model_description(str(file)), extract(str(file), unzipdir=str(file.with_suffix(""))))
        self.instances = threading.local()

    def run(self, record, scales, gaps, stop, threads):
        return [self.case(str(record), scale, gap, stop) for scale, gap in zip(scales, gaps, strict=True)]

    def case(self, record, scale, gap, stop):
        try:
            if not hasattr(self.instances, "own"):
                self.instances.own = FMU2Instance(*self.instance_of)
            return {**self.description.row(self.end(self.instances.own, record, scale, gap, stop)), "error": ""}
        except Exception as error:
            self.instances.__dict__.pop("own", None)
            return failed(str(error) or type(error).__name__)

    def end(self, instance, record, scale, gap, stop):
        """The values of all outputs at the end of one step over the whole record: events happen inside it."""
        instance.begin()
        try:
            instance.setString(instance.of("ground.record"), [record])
            instance.setReal(instance.of("ground.scale"), [scale])
            instance.setReal(instance.of(*self.description.gaps), [gap] * len(self.description.gaps))
            instance.start(stop)
            instance.doStep(0.0, stop)
            impacts, *reals = instance.of(*self.description.outputs())
            return [*instance.getInteger([impacts]), *instance.getReal(reals)]
        except Exception as error:
            raise RuntimeError("; ".join(instance.said) or str(error)) from error


class FMU2Instance(FMU2Slave):
    """An instance that is reset for each case: the FMU is loaded once. Its messages become the errors.

    FMPy loads the functions that the beginning of the class's name stands for.
    """

    def __init__(self, description, folder):
        identifier = description.coSimulation.modelIdentifier
        super().__init__(guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier, instanceName="study")
        self.reference = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.said, self.used = [], False
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(self.note)
        self.instantiate(callbacks=callbacks)

    def note(self, _environment, _name, status, _category, text):
        """Keeps what is said of a call that has failed, and no warnings."""
        if status >= fmi2Error:
            self.said.append(text.decode())

    def of(self, *names):
        """The value references of these variables."""
        return [self.reference[name] for name in names]

    def begin(self):
        self.said.clear()
        if self.used:
            self.reset()
        self.used = True

    def start(self, stop):
        self.setupExperiment(startTime=0.0, stopTime=stop)
        self.enterInitializationMode()
        self.exitInitializationMode()


def first_values(file, names):
    """What these variables of an FMU are before anything has been set; it is unpacked beside its file."""
    folder = extract(str(file), unzipdir=str(Path(file).with_suffix("")))
    instance = FMU2Instance(read_model_description(str(file)), folder)
    instance.start(None)
    values = instance.getReal(instance.of(*names))
    instance.freeInstance()
    return values

"""estim8: parameters of models estimated from measurements."""

NAME = "estim8"
PACKAGES = ["estim8==0.1.6", "fmpy==0.3.32"]
TAKE = "numbers only, either version; without a record also the others"
KNOW = "Takes every variable with `initial=\"exact\"` for a number: the text `ground.record` is refused when the model is made"


def run(fmu, names, values, step, stop):
    from estim8.models import FmuModel

    model = FmuModel(fmu, fmi_type="CoSimulation")
    simulation = model.simulate(0.0, stop, step, parameters=values, observe=names)
    return [simulation[name].values[-1] for name in names]

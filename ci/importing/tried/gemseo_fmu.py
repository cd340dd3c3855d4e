"""GEMSEO's plug-in for FMUs: the gap as a design variable."""

NAME = "gemseo-fmu"
PACKAGES = ["gemseo-fmu==3.1.1", "fmpy==0.3.19"]
TAKE = "either version; of 2.0 numbers only with `do_step`, and where `input_names` is left out"
KNOW = (
    "Sets every parameter before the initialisation and once more after it, which is allowed to the value that it has. Name "
    "`input_names`: by default it takes all parameters, texts included. With `do_step` an input gets, at the beginning of a "
    "step, its value of the end of that step"
)


def run(fmu, names, values, step, stop):
    from gemseo_fmu.disciplines.fmu_discipline import FMUDiscipline
    from numpy import array

    discipline = FMUDiscipline(
        fmu, input_names=list(values) or None, output_names=names, time_step=step, final_time=stop
    )
    result = discipline.execute({name: array([value]) for name, value in values.items()})
    return [result[name][-1] for name in names]

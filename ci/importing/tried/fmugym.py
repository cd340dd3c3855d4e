"""FMUGym: an FMU as an environment of reinforcement learning."""

NAME = "FMUGym"
PACKAGES = ["fmugym==0.2.0", "fmpy==0.3.32"]
TOLERANCE = 1e-6  # observations are of single precision
TAKE = "numbers only, either version"
KNOW = (
    "Reads every observation as a number, and keeps it in single precision. `_noisy_init` has to be written: that of the class "
    "fails. Actions last one step more or less than `action_step_size`, as its times are sums"
)


def run(fmu, names, values, step, stop):
    import numpy as np
    from fmugym import FMUGym, FMUGymConfig, VarSpace

    class Buildings(FMUGym):
        def _noisy_init(self):
            reference = {variable.name: variable.valueReference for variable in self.fmu_description.modelVariables}
            return {reference[name]: value for name, value in values.items()}

        def _create_action_space(self, inputs):
            return None  # there are none: the record is in the FMU

        def _get_terminated(self):
            return False, False

        def compute_reward(self, observation, info):
            return 0.0

    outputs = VarSpace("outputs")
    for name in names:
        outputs.add_var_box(name, np.array([-1e9]), np.array([1e9]))
    empty = VarSpace("none")
    steps = {"stop_time": stop, "sim_step_size": step, "action_step_size": step}
    config = FMUGymConfig(fmu_path=fmu, inputs=empty, outputs=outputs, random_vars=empty, **steps)
    environment = Buildings(config)
    observed, _ = environment.reset()
    while environment.time < stop - step / 2:
        observed, *_ = environment.step(np.zeros(0))
    found = dict(zip(environment.output_dict, observed))
    return [found[name] for name in names]

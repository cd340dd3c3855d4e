"""moo-sim-interface: variations and optimisation of models."""

NAME = "moo-sim-interface"
PACKAGES = ["moo-sim-interface==0.4.0", "fmpy==0.3.20"]
TAKE = "2.0, numbers only"
KNOW = (
    "Sets and reads by `setReal` and `getReal` alone, FMI 2.0 only. The first 0.02 s of every run are left out of its results. "
    "Its way `sync: true` ends in a NameError: take `sync: false`"
)


def run(fmu, names, values, step, stop):
    from moo_sim_interface.simulation_environment_apis.fmu_simulator import run_fmu_simulation

    outputs = {"parameter_names": names, "result_transformation": "take_last"}
    inputs = {"parameter_names": list(values), "parameter_values": [[value] for value in values.values()], "pairwise": False}
    results = run_fmu_simulation(
        return_results=True,
        model_file=fmu,
        n_chunks=1,
        simulation_setup={
            "start_time": 0.0,
            "stop_time": stop - step / 2,
            "step_size": step,
            "input_configuration": inputs,
            "output_configuration": outputs,
        },
        fmu_settings={"sync": False, "save_all_simulation_parameters": False},
        post_simulation_options={},
    )
    return results[0][1]

"""pathsim-fmi: an FMU as a block of PathSim."""

NAME = "pathsim-fmi"
PACKAGES = ["pathsim-fmi==0.1.1", "pathsim==0.27.1", "fmpy==0.3.32"]
TAKE = "numbers only, either version"
KNOW = (
    "Reads every output as a number. Say `dt`: the step of the FMU is a text to it. A recorded value is that of one step later: "
    "at t the block has gone on to t + `dt` already. What it unpacks stays in the temporary folder"
)


def run(fmu, names, values, step, stop):
    from pathsim import Simulation
    from pathsim_fmi import CoSimulationFMU

    block = CoSimulationFMU(fmu, dt=step, start_values=values)
    # The step at t leads to t + dt: the last one begins half a step before this end.
    Simulation([block], dt=step, log=False).run(stop - step / 2)
    outputs = dict(zip(block.fmu_wrapper.output_refs, block.outputs.to_array()))
    return [outputs[name] for name in names]

"""Ecos (C++, by way of ecospy) runs an FMU: prints the outputs, as exact numbers, of each point that is asked for."""

import sys

from ecospy import EcosSimulation, EcosSimulationStructure

fmu, step, count, every, *names = sys.argv[1:]
with EcosSimulationStructure() as structure:
    structure.add_model("model", fmu)
    with EcosSimulation(structure=structure, step_size=float(step)) as simulation:
        simulation.init()
        for k in range(1, int(count) + 1):
            simulation.step()
            if k % int(every) == 0:
                print("values", *(simulation.get_real(f"model::{name}").hex() for name in names))

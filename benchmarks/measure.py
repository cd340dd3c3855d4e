"""Runs all solvers on one problem, in turn, several times, and compares each with the truth."""

import statistics
import time
from dataclasses import dataclass, field

# The columns of the result file.
COLUMNS = [
    "scene", "law", "solver", "parameter", "setting", "error", "impacts", "true_impacts", "best_s", "median_s",
    "cold_s", "repeats", "setup_s", "remark",
]  # fmt: skip
TOO_LONG = "left out: would take too long"


@dataclass
class Budget:
    """How long one solver with one setting may take."""

    repeats: int  # at most
    seconds: float  # no further repeat once the repeats so far took this long
    longest: float  # s; a finer setting that would probably take longer is left out


@dataclass
class Run:
    entry: object
    setting: float
    solver: object = None
    times: list = field(default_factory=list)
    cold: list = field(default_factory=list)
    spent: float = 0.0
    error: float = float("nan")
    impacts: int | None = None
    remark: str = ""

    def row(self, problem, truth):
        measured = bool(self.times)
        return {
            "scene": problem.scene,
            "law": problem.law,
            "solver": self.entry.name,
            "parameter": self.entry.parameter,
            "setting": f"{self.setting:g}",
            "error": f"{self.error:.3e}" if measured else "",
            "impacts": "" if self.impacts is None else self.impacts,
            "true_impacts": truth.impacts,
            "best_s": f"{min(self.times):.4e}" if measured else "",
            "median_s": f"{statistics.median(self.times):.4e}" if measured else "",
            "cold_s": f"{min(self.cold):.4e}" if measured else "",
            "repeats": len(self.times),
            "setup_s": f"{self.solver.setup:.3g}" if self.solver else "",
            "remark": self.remark,
        }


def compare(case, truth, entries, budget, quick, progress):
    """Rows of the result file. Repeats of all solvers are interleaved: noise of the machine hits all alike."""
    yields = bool(case.problem.yielding_storeys)
    able = [entry for entry in entries if case.problem.law not in entry.without and entry.yields >= yields]
    runs = [Run(entry, setting) for entry in able for setting in entry.chosen(quick)]
    first_round(case, truth, runs, budget, progress)
    for _ in range(1, budget.repeats):
        for run in runs:
            if run.times and run.spent < budget.seconds:
                repeat(run, progress)
    return [run.row(case.problem, truth) for run in runs]


def first_round(case, truth, runs, budget, progress):
    """Makes each solver ready and runs it once: error, impacts and a first time."""
    for coarser, run in zip([None, *runs], runs):
        if coarser and coarser.entry is run.entry and takes_too_long(coarser, run, budget):
            run.remark = TOO_LONG
            continue
        try:
            run.solver = run.entry.make(case, run.setting)
            outcome = repeat(run, progress)
            run.error, run.impacts = truth.error(outcome.displacements), outcome.impacts
        except Exception as error:  # a peer that gives up is a result, not the end of the benchmark
            run.times.clear()
            run.remark = str(error).splitlines()[0][:200] if str(error) else type(error).__name__


def takes_too_long(coarser, run, budget):
    """As far as the next coarser setting tells: a step's cost goes with its number, a tolerance's more slowly."""
    growth = coarser.setting / run.setting if run.entry.parameter.startswith("step") else 3.0
    return coarser.remark == TOO_LONG or bool(coarser.times) and coarser.times[0] * growth > budget.longest


def repeat(run, progress):
    progress.show(f"{run.entry.name} {run.setting:g}")
    start = time.perf_counter()
    outcome = run.solver.run(warm_up=bool(run.times) and run.times[0] < 0.5)
    run.spent += time.perf_counter() - start
    if outcome.cold or not run.times:
        run.cold.append(outcome.cold or outcome.seconds)
    run.times.append(outcome.seconds)
    return outcome

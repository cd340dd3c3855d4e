"""What a study costs beside the runs in it: processor time by its parts, and that of the same runs alone in one thread.

"$(ci/environment)" benchmarks/study_price.py            # 2016 cases of the default scene, half a minute
"$(ci/environment)" benchmarks/study_price.py --quick    # seconds: shows that the command works

The study is that of `pounding-fmu study` without its pictures: records of 20 s, five gaps and none, four intensities. The runs
alone are the same cases in one call of the module, in one thread, of which nothing is written.
"""

import argparse
import contextlib
import tempfile
import time
from collections import Counter
from pathlib import Path

import pounding_fmu
from pounding_fmu import study
from pounding_fmu.study import cases, motions, plan, results

STOP = 20.0  # s
# Where the time goes that is not the runs': what the functions of the study do, one of them inside another or not.
PARTS = {
    "planning": [(plan, "plan")],
    "writing": [(results.Results, "__init__"), (results.Results, "missing"), (results.Results, "add"), (results.Results, "finish")],
    "checking and running": [(cases, "simulate_batch")],
    "rows": [(cases, "run_cases"), (plan.Plan, "with_intensity")],
}


class Clock:
    """Processor time of this process by parts, each without those that it calls."""

    def __init__(self):
        self.spent, self.open = Counter(), []

    @contextlib.contextmanager
    def part(self, name):
        begun = time.process_time()
        self.open.append(0.0)
        yield
        whole = time.process_time() - begun
        self.spent[name] += whole - self.open.pop()
        if self.open:
            self.open[-1] += whole

    def watch(self, name, owner, function):
        """Has each call of a function counted as a part."""
        inner = getattr(owner, function)

        def watched(*arguments, **named):
            with self.part(name):
                return inner(*arguments, **named)

        setattr(owner, function, watched)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    quick = parser.parse_args().quick
    chosen = {"gaps": (0.005, 0.01, 0.02, 0.03, 0.05), "pga": (1.0, 2.0, 3.0, 4.0), "stop": STOP}
    records = 4 if quick else 84
    clock = Clock()
    given = []
    for name, of in PARTS.items():
        for owner, function in of:
            clock.watch(name, owner, function)
    remember(given)
    with tempfile.TemporaryDirectory() as folder:
        texts = [motions.write(Path(folder) / "records", seed) for seed in range(records)]
        with clock.part("reading and the rest"):
            done = study.run_study(pounding_fmu.example_scene, texts, output=Path(folder) / "study", **chosen)
    assert not done.failures, done.failures
    alone = runs_alone(given)
    whole = sum(clock.spent.values())
    print(f"{len(done)} cases: {1e3 * whole / len(done):.2f} ms of processor time each")
    for name, spent in clock.spent.most_common():
        print(f"  {name:24} {spent:7.2f} s {spent / whole:6.1%}")
    print(f"  {'the runs alone':24} {alone:7.2f} s in one thread; the study takes {whole / alone:.2f} times that")


def remember(given):
    """Keeps what the batches of the study are given."""
    inner = cases.simulate_batch

    def remembered(*arguments, **named):
        given.append((arguments, named))
        return inner(*arguments, **named)

    cases.simulate_batch = remembered


def runs_alone(given):
    """Processor time of the same batches in one thread, s."""
    spent = 0.0
    for (scene, parameters, outputs, records, _), named in given:
        begun = time.process_time()
        pounding_fmu.simulate_batch(scene, parameters, outputs, records, 1, stop=named["stop"])
        spent += time.process_time() - begun
    return spent


if __name__ == "__main__":
    main()

"""What a step with another program's building costs beside that program itself: four storeys beside four, the left ones
bilinear in Python, in time and with the error that goes with it.

"$(ci/environment)" benchmarks/couple_price.py            # half a minute
"$(ci/environment)" benchmarks/couple_price.py --quick    # seconds: shows that the command works

The model's own time is that of the same calls once more, without the run. Beside it the same through FMPy, step by
step.
"""

import argparse
import statistics
import sys
import tempfile
import time
from pathlib import Path

import pounding_fmu

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
sys.path.insert(0, str(EXAMPLES))
from couple_opensees import FLOORS, RATIO, YIELD, Storeys, error, left_floors, scene  # noqa: E402
from couple_with_saved_states import STOP as STOP_OF_FMPY  # noqa: E402
from couple_with_saved_states import Buildings  # noqa: E402

STEP, STOP = 0.0025, 20.0  # s
MOST = 10.0  # us a step of ours


class Noted(Storeys):
    """Keeps what it is asked."""

    def __init__(self):
        super().__init__()
        self.asked = []

    def move(self, displacements):
        self.asked.append(displacements)
        return super().move(displacements)


def four(**left):
    """The scene of the examples, with a fourth floor on the right."""
    whole = scene(**left)
    whole["right"] |= {"mass": [170e3, 170e3, 150e3, 130e3], "stiffness": [250e6, 230e6, 200e6, 170e6]}
    whole["right"]["yield_force"] = [1150e3, 940e3, 740e3, 540e3]
    return whole | {"contact": [{**whole["contact"][0], "left_floor": i, "right_floor": i} for i in (1, 2, 3, 4)]}


def timed(work):
    start = time.process_time()
    work()
    return 1e6 * (time.process_time() - start) / (STOP / STEP)


def measure(repetitions):
    """For each way: us a step of ours, the model's own, the same through FMPy, and the error of the left floors."""
    names = [f"left.displacement[{i}]" for i in FLOORS]
    inside = pounding_fmu.simulate(four(yield_force=YIELD, post_yield_ratio=RATIO), STEP, STOP, names)
    with tempfile.TemporaryDirectory() as folder:
        ours = four() | {"inputs": {"restoring_corrections": True}}
        path = pounding_fmu.build_fmu(ours, Path(folder, "four.fmu"))
        for how in ("line", "twice"):
            noted = Noted()
            run = pounding_fmu.couple(four(), left=noted, step=STEP, how=how, outputs=names)
            own, whole, through_fmpy = [], [], []
            for _ in range(repetitions):
                again, model = Storeys(), Storeys()
                own.append(timed(lambda: [again.move(displacements) for displacements in noted.asked]))
                whole.append(timed(lambda: pounding_fmu.couple(four(), left=model, step=STEP, how=how, outputs=names)))
                buildings = Buildings(path, Storeys())
                through_fmpy.append(timed(lambda: buildings.run(STEP, how == "twice")))
            ours_alone = [together - alone for together, alone in zip(whole, own)]
            fmpy_alone = [STOP / STOP_OF_FMPY * together - alone for together, alone in zip(through_fmpy, own)]
            yield (
                how,
                statistics.median(ours_alone),
                statistics.median(own),
                statistics.median(fmpy_alone),
                error(left_floors(run), inside),
            )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    print("how     ours [us a step]   the model's own   FMPy's       error")
    for how, ours, own, fmpy, off in measure(1 if parser.parse_args().quick else 9):
        verdict = "as asked" if ours <= MOST else f"too much: at most {MOST:g}"
        print(f"{how:5}   {ours:16.1f}   {own:15.1f}   {fmpy:6.1f}   {off:.2e}   {verdict}")

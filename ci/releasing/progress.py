"""What is being done, a line each on a terminal. Quiet in a pipe, as `cargo fmu` is."""

import sys
import time

STARTED = time.monotonic()


def step(what):
    if sys.stderr.isatty():
        minutes, seconds = divmod(int(time.monotonic() - STARTED), 60)
        print(f"\033[1m[{minutes:2d}:{seconds:02d}]\033[0m {what}", file=sys.stderr, flush=True)

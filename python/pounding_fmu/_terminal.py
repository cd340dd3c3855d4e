"""What commands of this package say on a terminal, and in a pipe."""

from __future__ import annotations

import sys
import time

INTERRUPTED = 130  # what a shell calls the end of a program by Ctrl-C

WIDTH = 30


def say(text: str) -> None:
    print(text, file=sys.stderr)


class Progress:
    """A line on a terminal that moves with every case; nothing in a pipe until the end."""

    def __init__(self, what: str) -> None:
        self.what, self.before, self.done, self.start = what, 0, 0, time.monotonic()

    def go_on_from(self, before: int, total: int) -> None:
        """Says how many were done by another run."""
        self.before, self.done = before, before
        say(f"{total} {self.what}, {before} of them done")

    def __call__(self, done: int, total: int) -> None:
        self.done = done
        if not sys.stderr.isatty() or not total:
            return
        rate = (done - self.before) / max(time.monotonic() - self.start, 1e-9)
        left = f", {rate:.3g} a second, {(total - done) / rate:.0f} s left" if rate else ""
        bar = "#" * (WIDTH * done // total)
        print(f"\r\x1b[K[{bar:<{WIDTH}}] {done}/{total} {self.what}{left}", end="", file=sys.stderr, flush=True)

    def end(self, quietly: bool = False) -> None:
        """Takes the line away, or says how long it took."""
        seconds = time.monotonic() - self.start
        if quietly and sys.stderr.isatty():
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)
        elif self.done > self.before and not quietly:
            end, count = "\n" if sys.stderr.isatty() else "", self.done - self.before
            say(f"{end}{count} {self.what} in {seconds:.1f} s, {count / seconds:.0f} a second")

"""What commands of this package say on a terminal, and in a pipe."""

from __future__ import annotations

import sys
import time

WIDTH = 30


def say(text: str) -> None:
    print(text, file=sys.stderr)


class Progress:
    """A line on a terminal that moves with every case; nothing in a pipe until the end."""

    def __init__(self, what: str) -> None:
        self.what, self.done, self.total, self.start = what, 0, 0, time.monotonic()

    def __call__(self, done: int, total: int) -> None:
        self.done, self.total = done, total
        if not sys.stderr.isatty() or not total:
            return
        rate = done / max(time.monotonic() - self.start, 1e-9)
        left = f", {rate:.3g} a second, {(total - done) / rate:.0f} s left" if done else ""
        bar = "#" * (WIDTH * done // total)
        print(f"\r\x1b[K[{bar:<{WIDTH}}] {done}/{total} {self.what}{left}", end="", file=sys.stderr, flush=True)

    def end(self, quietly: bool = False) -> None:
        """Takes the line away, or says how long it took."""
        seconds = time.monotonic() - self.start
        if quietly and sys.stderr.isatty():
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)
        elif self.done and not quietly:
            end = "\n" if sys.stderr.isatty() else ""
            say(f"{end}{self.done} {self.what} in {seconds:.1f} s, {self.done / seconds:.0f} a second")

"""What is running, on one line of a terminal; nothing in a pipe."""

import sys
import time


class Progress:
    def __init__(self, total):
        self.total, self.done, self.title, self.start = total, 0, "", time.monotonic()

    def begin(self, title):
        self.title = title

    def end(self):
        self.done += 1

    def show(self, what):
        if sys.stderr.isatty():
            elapsed = time.monotonic() - self.start
            line = f"[{self.done}/{self.total}] {elapsed:.0f} s  {self.title}: {what}"
            print(f"\r\x1b[K{line[:110]}", end="", file=sys.stderr, flush=True)

    def clear(self):
        if sys.stderr.isatty():
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)

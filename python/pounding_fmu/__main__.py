"""The command ``pounding-fmu``."""

import os
import signal
import sys

from . import _native
from ._data import DATA

# What starts this command once more, in a process that tries an FMU: this package and no other of the same name that
# lies in the current directory.
AGAIN = "import sys; sys.path[0] = {folder!r}; from pounding_fmu.__main__ import main; sys.exit(main())"


def main() -> int:
    """Does what the arguments say and returns the exit code."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it at once, without a traceback
    again = [sys.executable, "-c", AGAIN.format(folder=os.fspath(DATA.parent.parent))]
    return _native.run_command(sys.argv, again, os.fspath(DATA))


if __name__ == "__main__":
    sys.exit(main())

"""Other programs: run them, and tell what they said when they fail."""

import os
import shlex
import subprocess
import sys

from releasing.places import ROOT


class Failure(Exception):
    """What the user is told, instead of a traceback."""


def stop_at(problems):
    """Ends with what gates have found, a line each."""
    if problems:
        raise Failure("not fit to be published:\n" + "\n".join(problems))


def run(*command, variables=None, folder=ROOT, aloud=False):
    """Runs a program and returns what it has written. What it says on the way shows on a terminal if it is `aloud`."""
    command = [str(word) for word in command]
    shown = None if aloud and sys.stderr.isatty() else subprocess.PIPE
    try:
        done = subprocess.run(
            command,
            env=environment(variables),
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=shown,
            text=True,
            errors="replace",
        )
    except OSError as error:
        raise Failure(f"cannot start {command[0]}: {error.strerror}") from error
    if done.returncode != 0:
        # On a terminal it has been seen already.
        said = "" if shown is None else done.stderr.strip() or done.stdout.strip()
        raise Failure(f"{shlex.join(command)}\nfailed with exit code {done.returncode}:\n{said}")
    return done.stdout


def environment(variables=None):
    """That of this process with these changed; None takes one away."""
    changed = {**os.environ, **(variables or {})}
    return {name: str(value) for name, value in changed.items() if value is not None}

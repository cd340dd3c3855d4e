"""The command ``pounding-fmu``: what is done in Python, and what goes on to the compiled command."""

from __future__ import annotations

import _thread
import argparse
import difflib
import importlib
import os
import signal
import sys
import threading
import warnings
from pathlib import Path
from typing import NamedTuple

from . import _native
from ._data import DATA
from ._extras import MissingExtra
from ._terminal import INTERRUPTED


class Command(NamedTuple):
    """What ``--help`` says of a command, and where it is."""

    name: str
    about: str
    example: str
    module: str | None = None
    """of this package: its ``main`` takes the arguments and returns the exit code. Without one it is compiled."""


# In the order in which they are used most.
COMMANDS = (
    Command("SCENE.toml", "makes the FMU of a scene, runs it once and says what happened", "offices.toml"),
    Command("example", "lists the scenes that come with this package, or writes one of them", "example offices", "example"),
    Command("simulate", "runs a scene without an FMU; tables as CSV", "simulate offices.toml --csv motion.csv"),
    Command("report", "makes a page of a run, for any browser", "report offices.toml"),
    Command("page", "makes a page that runs, studies and packs scenes in a browser", "page offices.toml", "page"),
    Command("plot", "draws a run: buildings, gaps, forces, the hardest impact", "plot offices.toml", "plots.command"),
    Command("gap", "says how wide a gap keeps the buildings apart", "gap offices.toml", "gap.command"),
    Command("study", "runs many gaps, records and intensities", "study offices.toml --pga 1 2 3", "study.command"),
    Command("record", "shows what is in a ground motion of any format, and converts it", "record MINE.AT2", "record"),
    Command("animate", "shows the buildings in motion", "animate offices.toml -o offices.gif", "plots.animate"),
    Command("check", "opens any FMU of this program, validates and runs it", "check Offices.fmu"),
    Command("merge", "makes one FMU of two for different platforms", "merge A.fmu B.fmu -o C.fmu"),
)  # fmt: skip

# What starts this command once more, in a process that tries an FMU: this package and no other of the same name that
# lies in the current directory.
AGAIN = "import sys; sys.path[0] = {folder!r}; from pounding_fmu.__main__ import main; sys.exit(main())"


def main() -> int:
    """Does what the arguments say and returns the exit code."""
    open_closed_streams()
    arguments = sys.argv[1:]
    if arguments[:1] == ["help"]:
        arguments = [*arguments[1:], "--help"]
    word = arguments[0] if arguments else ""
    known = {command.name: command for command in COMMANDS[1:]}
    if word in known and (module := known[word].module):
        return carry_out(module, arguments[1:])
    if word in known or word == "trial" or not word or word.startswith("-") or could_be_a_scene(word):
        return compiled(arguments)
    close = difflib.get_close_matches(word, known, n=1)
    meant = f"did you mean {close[0]}?" if close else "pounding-fmu --help lists them."
    return say(f"{word}: no such command; {meant} A scene is a file, such as {word}.toml", 2)


def open_closed_streams() -> None:
    """Opens standard streams that are closed to nowhere: nobody reads them, and no file that is written takes their place."""
    for name in ("stdin", "stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "r" if name == "stdin" else "w", encoding="utf-8"))  # noqa: SIM115


def could_be_a_scene(word: str) -> bool:
    """Whether a word is a path rather than a command."""
    return word.lower().endswith(".toml") or "/" in word or os.sep in word or Path(word).exists()


def compiled(arguments: list[str]) -> int:
    """Does what the compiled command does."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it at once, without a traceback
    again = [sys.executable, "-c", AGAIN.format(folder=os.fspath(DATA.parent.parent))]
    return _native.run_command(["pounding-fmu", *arguments], again, os.fspath(DATA), overview())


def overview() -> str:
    """The beginning of ``--help``: a line for each command, and an example below it."""
    lines = ["Buildings that collide in an earthquake: FMUs, runs, pictures and studies of a scene.", ""]
    lines += ["Usage: pounding-fmu SCENE.toml [OPTIONS]", "       pounding-fmu COMMAND ...", ""]
    for command in COMMANDS:
        lines += [f"  {command.name:<12}{command.about}", f"{'':<16}pounding-fmu {command.example}"]
    return "\n".join([*lines, "", "pounding-fmu COMMAND --help says all about a command. Options of SCENE.toml:"])


def carry_out(module: str, arguments: list[str]) -> int:
    """Does what a command in Python does. Whatever goes wrong is said in a line, and is the exit code."""
    warnings.showwarning = lambda message, *_: print(f"warning: {message}", file=sys.stderr)
    sys.unraisablehook = interrupt_again
    # The usual one keeps to itself that a help could not be written.
    setattr(argparse.ArgumentParser, "print_help", lambda parser: print(parser.format_help(), end=""))
    try:
        code = result_of(module, arguments)
        sys.stdout.flush()
    except KeyboardInterrupt:
        return interrupted()
    except BrokenPipeError:
        # A reader that has seen enough (`| head`): no error of ours, and nothing more to write at the end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        what = f"{os.fsdecode(error.filename)}: " if error.filename else ""
        return say(f"{what}{error.strerror or error}")
    except KeyError as error:
        return say(str(error.args[0]) if error.args else "KeyError")
    except (MissingExtra, ValueError, RuntimeError, MemoryError) as error:
        return say(str(error))
    except Exception as error:  # noqa: BLE001
        what = f"{type(error).__name__}: {error}"
        return say(f"pounding-fmu has met a bug of its own ({what}); please report it together with the scene")
    return interrupted() if code == INTERRUPTED else code


def result_of(module: str, arguments: list[str]) -> int:
    """The exit code of a command, also where reading its arguments has ended it."""
    try:
        code: int = importlib.import_module(f"pounding_fmu.{module}").main(arguments)
    except SystemExit as end:
        return int(end.code or 0)
    return code


def interrupt_again(unraisable: sys.UnraisableHookArgs) -> None:
    """Where Ctrl-C comes within a callback that cannot raise, as those of an import, Python says so and goes on. It comes
    once more instead, when the callback is over."""
    if unraisable.exc_type is KeyboardInterrupt:
        again = threading.Timer(0.01, _thread.interrupt_main)
        again.daemon = True  # a command that ends meanwhile has done all that it should
        again.start()
    else:
        sys.__unraisablehook__(unraisable)


def interrupted() -> int:
    """The exit code of Ctrl-C. Where that has come while a library executed a string, as it does for named tuples when it is
    imported, Python remembers it, and would end by the signal after all; executing another string makes it forget."""
    exec("")  # noqa: S102
    return INTERRUPTED


def say(error: str, code: int = 1) -> int:
    """Tells what is wrong, and returns the exit code."""
    print(f"error: {error}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main())

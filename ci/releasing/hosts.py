"""The C host (ci/host/), compiled for a platform and started where that platform runs here."""

import shutil
import subprocess
import sys
from dataclasses import dataclass

from releasing import debian, platforms
from releasing.cargo import VARIABLES
from releasing.commands import environment, run
from releasing.places import CI, WORK

# Where hosts start: all names that they get are relative to it.
FOLDER = WORK / "runs"
FLAGS = ("-std=c99", "-Wall", "-Wextra", "-Werror", "-O1")
WINE = {
    "WINEPREFIX": WORK / "wine",
    "WINEDEBUG": "-all",
    "WINEDLLOVERRIDES": "mscoree=;mshtml=",  # no .NET, no browser: nothing asks whether to install them
}


@dataclass(frozen=True)
class Host:
    """A platform with its host and its library in a folder of its own."""

    platform: platforms.Platform
    is_native: bool

    @property
    def folder(self):
        return FOLDER / self.platform.name

    @property
    def program(self):
        return self.folder / ("host.exe" if self.platform.file.endswith(".dll") else "host")

    @property
    def is_wine(self):
        return not self.is_native and self.platform is platforms.WINDOWS

    def prepare(self, library):
        self.folder.mkdir(parents=True, exist_ok=True)
        shutil.copy(library, self.folder / self.platform.library)
        if self.is_wine:
            # wine before version 9 has no bcryptprimitives.dll, which Rust's standard library asks for random numbers.
            stub = self.folder / "bcryptprimitives.dll"
            run(*self.platform.host_compiler, "-shared", CI / "host/bcryptprimitives.c", "-o", stub, "-ladvapi32")
            WINE["WINEPREFIX"].mkdir(exist_ok=True)
        sources = [CI / f"host/{name}.c" for name in ("host", "host2", "host3")]
        libraries = ["-ldl"] if self.platform.file.endswith(".so") else []
        compiler = [sys.executable if word == "python" else word for word in self.platform.host_compiler]
        run(*compiler, *FLAGS, *sources, "-o", self.program, "-lm", *libraries, variables=VARIABLES)

    def start(self, program, arguments):
        """Runs a program of the platform; returns its exit code and what it has said."""
        if self.is_native:
            command, variables = [program], {}
        elif self.is_wine:
            command, variables = [debian.wine(), program], WINE
        else:
            command, variables = ["qemu-aarch64", "-L", debian.ARM_ROOT, program], {}
        done = subprocess.run(
            [*map(str, command), *arguments],
            cwd=FOLDER,
            env=environment(variables),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
        )
        return done.returncode, "\n".join(text.strip() for text in (done.stdout, done.stderr) if text.strip())

    def uri(self, folder):
        """A folder of this machine as a program of the platform sees it."""
        uri = folder.resolve().as_uri()
        return uri.replace("file:///", "file:///Z:/") if self.is_wine else uri

    def path(self, folder):
        """The same as a path."""
        return f"Z:{folder.resolve().as_posix()}" if self.is_wine else folder.resolve().as_posix()


def stop_wine():
    """Ends the processes that wine has left in our prefix."""
    server = debian.wine_server()
    if server and WINE["WINEPREFIX"].exists():
        subprocess.run([server, "-k"], env=environment(WINE), stdin=subprocess.DEVNULL, capture_output=True)

"""The platforms that a release is for: what compiles for them, and what their libraries may need."""

import platform
from dataclasses import dataclass

GLIBC = "2.17"  # of manylinux2014: RHEL 7, Ubuntu 14.04, and everything since

OF_GLIBC = ("libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1")
OF_WINDOWS = (
    "kernel32.dll",
    "ntdll.dll",
    "msvcrt.dll",
    "ws2_32.dll",
    "userenv.dll",
    "bcryptprimitives.dll",
    "api-ms-win-core-synch-l1-2-0.dll",
)
OF_MACOS = ("/usr/lib/libSystem.B.dylib",)


@dataclass(frozen=True)
class Platform:
    """A platform, called like its folder below `libraries/` and in an FMU below `binaries/`."""

    name: str
    triple: str  # of the Rust toolchain
    machine: str  # that the library's file names
    file: str  # that cargo writes
    system_libraries: tuple = ()  # the only ones that the library may need
    glibc: str | None = None  # the newest version that it may need; cargo-zigbuild links against this one
    flags: tuple = ()  # of rustc
    host_compiler: tuple = ("python", "-m", "ziglang", "cc")  # that of the C host; python is the one that runs this

    @property
    def library(self):
        return "pounding." + self.file.rsplit(".", 1)[1]


LINUX = Platform(
    "linux64",
    "x86_64-unknown-linux-gnu",
    "x86-64",
    "libpounding.so",
    (*OF_GLIBC, "ld-linux-x86-64.so.2"),
    GLIBC,
    host_compiler=("python", "-m", "ziglang", "cc", "-target", f"x86_64-linux-gnu.{GLIBC}"),
)
WINDOWS = Platform(
    "win64", "x86_64-pc-windows-gnu", "x86-64", "pounding.dll", OF_WINDOWS, host_compiler=("x86_64-w64-mingw32-gcc",)
)
ARM = Platform(
    "aarch64-linux",
    "aarch64-unknown-linux-gnu",
    "aarch64",
    "libpounding.so",
    (*OF_GLIBC, "ld-linux-aarch64.so.1"),
    GLIBC,
    host_compiler=("python", "-m", "ziglang", "cc", "-target", f"aarch64-linux-gnu.{GLIBC}"),
)

# What a Debian machine builds and runs; the first is what the others are compared with.
CROSS = (LINUX, WINDOWS, ARM)

# What ci/native builds on a machine of the platform itself; with +crt-static no redistributable of Microsoft's is
# needed.
NATIVE = {
    ("Linux", "x86_64"): LINUX,
    ("Linux", "aarch64"): ARM,
    ("Windows", "AMD64"): Platform(
        "win64", "x86_64-pc-windows-msvc", "x86-64", "pounding.dll", OF_WINDOWS, flags=("-Ctarget-feature=+crt-static",)
    ),
    ("Darwin", "x86_64"): Platform("darwin64", "x86_64-apple-darwin", "x86-64", "libpounding.dylib", OF_MACOS),
    ("Darwin", "arm64"): Platform("aarch64-darwin", "aarch64-apple-darwin", "aarch64", "libpounding.dylib", OF_MACOS),
}


def here():
    """The platform of this machine; None if there are no libraries for it."""
    return NATIVE.get((platform.system(), platform.machine()))

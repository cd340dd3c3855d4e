"""The options of ci/release."""

import argparse

from releasing.platforms import CROSS


def parse():
    parser = argparse.ArgumentParser(prog="ci/release", description="Builds everything that is published.")
    parser.add_argument(
        "--std",
        choices=("auto", "rustup", "debian"),
        default="auto",
        help="where the standard libraries of other platforms come from: rustup, Debian's sources of "
        "Rust, or (auto) rustup where it can be reached",
    )
    parser.add_argument(
        "--here",
        nargs="*",
        choices=[platform.name for platform in CROSS],
        metavar="PLATFORM",
        help="a rehearsal of a few minutes, for these platforms, or for all that can be compiled and run here: "
        "every step and gate, the module of the wheel compiled quickly, nothing put into target/release-files",
    )
    parser.add_argument(
        "--missing", action="store_true", help="only print the names of the Debian packages that are missing"
    )
    return parser.parse_args()

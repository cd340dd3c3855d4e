"""What ci/native does."""

import argparse
import shutil
import sys
from pathlib import Path

from releasing import cases, comparison, gates, needs, platforms, reading, remapping
from releasing.cargo import Toolchain, compile_library
from releasing.commands import Failure, stop_at
from releasing.hosts import Host


def main():
    parser = argparse.ArgumentParser(prog="ci/native", description="The part of a release for the platform it runs on.")
    commands = parser.add_subparsers(required=True)
    for name, function, *folders in (
        ("build", build, "libraries"),
        ("compare", compare, "libraries", "cases_folder"),
        ("list", list_files, "files"),
    ):
        command = commands.add_parser(name)
        command.set_defaults(function=function)
        for folder in folders:
            command.add_argument(folder, type=Path if function is build else existing_folder)
    arguments = vars(parser.parse_args())
    try:
        arguments.pop("function")(**arguments)
    except Failure as failure:
        sys.exit(str(failure))


def existing_folder(name):
    if not Path(name).is_dir():
        raise argparse.ArgumentTypeError(f"{name!r} is no folder")
    return Path(name)


def build(libraries):
    platform = this_platform()
    file = compile_library(platform, Toolchain(), libraries)
    stop_at(gates.of_file(file, reading.read(file), platform, remapping.private_paths()))
    print(f"{file}: {needs.of(file)}")


def compare(libraries, cases_folder):
    platform = this_platform()
    if cases_folder.resolve() != cases.FOLDER:
        shutil.rmtree(cases.FOLDER, ignore_errors=True)
        shutil.copytree(cases_folder, cases.FOLDER)
    host = Host(platform, is_native=True)
    library = libraries / platform.name / platform.library
    if not library.is_file():
        raise Failure(f"{library}: no such file")
    host.prepare(library)
    reference = cases.found()
    stop_at(comparison.same_outputs(reference, [host]))
    stop_at(comparison.versions(reference, [host]))
    stop_at(comparison.from_kept_states(reference, host))
    print(f"{platform.name}: the same bits in {len(reference)} scenes")


def list_files(files):
    print("\n".join(needs.write(files)))


def this_platform():
    found = platforms.here()
    if found is None:
        raise Failure("there are no libraries for machines like this one")
    return found


if __name__ == "__main__":
    main()

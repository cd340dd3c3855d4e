"""What ci/release does once the packages of ci/requirements.txt are there."""

import shutil
import sys
import tomllib
import unittest

from releasing import archives, cases, comparison, gates, hosts, needs, options, progress, reading, remapping
from releasing import standard_library, unit_tests
from releasing.cargo import VARIABLES, compile_library
from releasing.commands import Failure, run, stop_at
from releasing.places import CI, FILES, ROOT, WORK
from releasing.platforms import CROSS, LINUX, WINDOWS

# What is not known to be good stays here.
DRAFT = WORK / "files"
LIBRARIES = DRAFT / "libraries"


def main():
    try:
        for line in release(options.parse()):
            print(line)
    except Failure as failure:
        sys.exit(str(failure))
    except KeyboardInterrupt:
        sys.exit(130)
    finally:
        hosts.stop_wine()


def release(arguments):
    """Makes all files, checks them and puts them into their place; returns what each of them needs."""
    WORK.mkdir(parents=True, exist_ok=True)
    progress.step("testing the gates themselves")
    test_gates()
    shutil.rmtree(DRAFT, ignore_errors=True)
    progress.step("the standard libraries of other platforms")
    toolchain = standard_library.toolchain(CROSS, arguments.std)
    for platform in CROSS:
        progress.step(f"compiling the library for {platform.name}")
        compile_library(platform, toolchain, LIBRARIES)
    stop_at(check_libraries())
    check_behaviour(toolchain)
    progress.step("the wheel")
    make_wheel()
    progress.step("the FMUs of the examples")
    make_fmus()
    stop_at(check_archives())
    lines = needs.write(DRAFT)
    shutil.rmtree(FILES, ignore_errors=True)
    DRAFT.rename(FILES)
    return lines


def test_gates():
    tests = unittest.defaultTestLoader.discover(CI / "tests", top_level_dir=CI)
    with open(WORK / "tests.log", "w+") as log:
        if not unittest.TextTestRunner(log).run(tests).wasSuccessful():
            log.seek(0)
            raise Failure("the tests of the gates fail:\n" + log.read())


def library(platform):
    return LIBRARIES / platform.name / platform.library


def check_libraries():
    private = remapping.private_paths()
    files = [(library(platform), platform) for platform in CROSS]
    return [
        problem for file, platform in files for problem in gates.of_file(file, reading.read(file), platform, private)
    ]


def check_behaviour(toolchain):
    """The same bits on all platforms, and the unit tests that only Windows has."""
    all_hosts = [hosts.Host(platform, is_native=platform is LINUX) for platform in CROSS]
    for host in all_hosts:
        progress.step(f"the C host for {host.platform.name}")
        host.prepare(library(host.platform))
    progress.step("the FMUs of the reference scenes")
    reference = cases.prepare(LIBRARIES)
    progress.step(f"{len(reference)} scenes on {LINUX.name}")
    stop_at(comparison.expect(reference, all_hosts[0]))
    progress.step("the same bits on the other platforms")
    stop_at(comparison.same_outputs(reference, all_hosts[1:]))
    progress.step("saved states from each platform to each")
    stop_at(comparison.crosswise(reference, all_hosts))
    progress.step("unit tests on Windows")
    windows = next(host for host in all_hosts if host.platform is WINDOWS)
    stop_at(unit_tests.on_windows(windows, toolchain))


def make_wheel():
    (DRAFT / "wheels").mkdir()
    run(CI / "wheel", "--libraries", LIBRARIES, "--output", DRAFT / "wheels", "--zig", variables=VARIABLES, aloud=True)


def make_fmus():
    (DRAFT / "fmus").mkdir()
    for scene in sorted((ROOT / "examples/scenes").glob("*.toml")):
        name = tomllib.loads(scene.read_text())["name"]
        run("cargo", "fmu", scene, "--libraries", LIBRARIES, "-o", DRAFT / f"fmus/{name}.fmu")


def check_archives():
    files = sorted([*DRAFT.glob("wheels/*.whl"), *DRAFT.glob("fmus/*.fmu")])
    return [problem for file in files for problem in archives.check(file, LINUX, remapping.private_paths())]


if __name__ == "__main__":
    main()

"""What ci/release does once the packages of ci/requirements.txt are there."""

import shutil
import sys
import tomllib
import unittest
import zipfile
from dataclasses import replace

from releasing import archives, cases, comparison, debian, gates, hosts, needs, options, progress, reading, remapping
from releasing import page, standard_library, unit_tests
from releasing.cargo import VARIABLES, compile_library, fmu_command
from releasing.commands import Failure, run, stop_at
from releasing.places import CI, FILES, ROOT, WORK
from releasing.platforms import CROSS, LINUX, WINDOWS

# What is not known to be good stays here.
DRAFT = WORK / "files"
LIBRARIES = DRAFT / "libraries"
PAGE = DRAFT / "pounding.html"
# The page without libraries: the wheel has them beside it.
TEMPLATE = WORK / "page.html"

# The library that `cargo fmu` compiles on this machine: another build of the same platform.
SECOND = replace(LINUX, name="linux64-cargo-fmu", glibc=None)
# The module of the wheel in a rehearsal: the same steps, flags and gates, without the minutes of the optimiser.
QUICKLY = {"LTO": "off", "CODEGEN_UNITS": "16", "OPT_LEVEL": "0"}


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
    """Makes all files, checks them and puts them into their place; returns what each of them needs.

    A rehearsal (`--here`) does the same for some platforms, or those that this machine compiles and runs, and publishes
    nothing.
    """
    is_rehearsal = arguments.here is not None
    wanted = [platform for platform in CROSS if not arguments.here or platform.name in arguments.here]
    platforms = tuple(filter(is_here, wanted)) if is_rehearsal else CROSS
    WORK.mkdir(parents=True, exist_ok=True)
    progress.step("testing the gates themselves")
    test_gates()
    shutil.rmtree(DRAFT, ignore_errors=True)
    progress.step("the standard libraries of other platforms")
    toolchain = standard_library.toolchain((*platforms, page.PLATFORM), arguments.std)
    for platform in platforms:
        progress.step(f"compiling the library for {platform.name}")
        compile_library(platform, toolchain, LIBRARIES)
    stop_at(check_libraries(platforms))
    check_behaviour(platforms, toolchain, is_rehearsal)
    progress.step("the page")
    make_page(toolchain)
    progress.step("the wheel")
    make_wheel({f"CARGO_PROFILE_RELEASE_{key}": value for key, value in QUICKLY.items()} if is_rehearsal else {})
    progress.step("the FMUs of the examples")
    make_fmus()
    stop_at(check_archives() + check_wheel())
    lines = needs.write(DRAFT)
    if is_rehearsal:
        return [*lines, "a release can be made of " + ", ".join(platform.name for platform in platforms)]
    shutil.rmtree(FILES, ignore_errors=True)
    DRAFT.rename(FILES)
    return lines


def is_here(platform):
    """Whether what is needed for a platform is on this machine; says so where it is not."""
    missing = debian.missing_for(platform)
    if missing:
        print(f"left out: {platform.name}, for want of {', '.join(missing)}", file=sys.stderr)
    return not missing


def test_gates():
    tests = unittest.defaultTestLoader.discover(CI / "tests", top_level_dir=CI)
    with open(WORK / "tests.log", "w+") as log:
        if not unittest.TextTestRunner(log).run(tests).wasSuccessful():
            log.seek(0)
            raise Failure("the tests of the gates fail:\n" + log.read())


def library(platform):
    return LIBRARIES / platform.name / platform.library


def check_libraries(platforms):
    private = remapping.private_paths()
    files = [(library(platform), platform) for platform in platforms]
    return [
        problem for file, platform in files for problem in gates.of_file(file, reading.read(file), platform, private)
    ]


def check_behaviour(platforms, toolchain, is_rehearsal):
    """The same bits on all platforms, and the unit tests that only Windows has."""
    all_hosts = [hosts.Host(platform, is_native=platform is LINUX) for platform in platforms]
    files = [library(platform) for platform in platforms]
    if is_rehearsal:
        all_hosts.append(hosts.Host(SECOND, is_native=True))
        files.append(second_library())
        stop_at(gates.exports(reading.read(files[-1]), gates.functions_of_fmi()))
    for host, file in zip(all_hosts, files, strict=True):
        progress.step(f"the C host for {host.platform.name}")
        host.prepare(file)
    progress.step("the FMUs of the reference scenes")
    reference = cases.prepare(LIBRARIES)
    progress.step(f"{len(reference)} scenes on {LINUX.name}")
    stop_at(comparison.expect(reference, all_hosts[0]))
    progress.step("the same bits on the others")
    stop_at(comparison.same_outputs(reference, all_hosts[1:]))
    progress.step("the same bits in FMI 3.0")
    stop_at(comparison.versions(reference, all_hosts))
    progress.step("saved states from each to each")
    stop_at(comparison.crosswise(reference, all_hosts))
    for windows in (host for host in all_hosts if host.platform is WINDOWS):
        progress.step("unit tests on Windows")
        stop_at(unit_tests.on_windows(windows, toolchain))


def second_library():
    """What `cargo fmu` packs without --libraries."""
    fmu, file = WORK / "second.fmu", WORK / SECOND.name / SECOND.library
    run("cargo", "fmu", ROOT / "examples/scenes/two_blocks.toml", "-o", fmu, aloud=True)
    file.parent.mkdir(exist_ok=True)
    with zipfile.ZipFile(fmu) as archive:
        (name,) = archives.libraries(archive)
        file.write_bytes(archive.read(name))
    return file


def make_page(toolchain):
    TEMPLATE.write_text(page.template(page.compile_engine(toolchain)))
    page.write(PAGE, TEMPLATE.read_text(), LIBRARIES)


def make_wheel(profile):
    (DRAFT / "wheels").mkdir()
    options = ["--libraries", LIBRARIES, "--page", TEMPLATE, "--output", DRAFT / "wheels", "--zig"]
    run(CI / "wheel", *options, variables={**VARIABLES, **profile}, aloud=True)


def make_fmus():
    (DRAFT / "fmus").mkdir()
    for scene in sorted((ROOT / "examples/scenes").glob("*.toml")):
        name = tomllib.loads(scene.read_text())["name"]
        run(fmu_command(), scene, "--libraries", LIBRARIES, "-o", DRAFT / f"fmus/{name}.fmu")
        run(fmu_command(), scene, "--fmi", "3", "--libraries", LIBRARIES, "-o", DRAFT / f"fmus/{name}.fmi3.fmu")


def check_wheel():
    """The wheel packs the bytes that `cargo fmu` packs, in both versions, and makes the page that is published, and one that
    opens with a scene."""
    folder, made, made_page = WORK / "wheel", WORK / "by-wheel.fmu", WORK / "by-wheel.html"
    shutil.rmtree(folder, ignore_errors=True)
    (wheel,) = DRAFT.glob("wheels/*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
    problems = []
    for version, file in (("2", "FeupFrames.fmu"), ("3", "FeupFrames.fmi3.fmu")):
        command = [sys.executable, "-m", "pounding_fmu", ROOT / "examples/scenes/feup.toml"]
        run(*command, "--fmi", version, "-o", made, variables={"PYTHONPATH": folder})
        if made.read_bytes() != (DRAFT / "fmus" / file).read_bytes():
            problems.append(f"{file}: the wheel makes other bytes than cargo fmu")
    run(sys.executable, "-m", "pounding_fmu", "page", "-o", made_page, variables={"PYTHONPATH": folder})
    if made_page.read_bytes() != PAGE.read_bytes():
        problems.append(f"{PAGE.name}: the wheel makes another page")
    scene = ROOT / "examples/scenes/feup.toml"
    run(sys.executable, "-m", "pounding_fmu", "page", scene, "-o", made_page, variables={"PYTHONPATH": folder})
    given = page.assembly.element(made_page.read_text(), "given")[1]
    if given != page.assembly.spoken({"file": scene.name, "text": scene.read_text()}):
        problems.append(f"{made_page.name}: it does not open with {scene.name}")
    return problems


def check_archives():
    files = sorted([*DRAFT.glob("wheels/*.whl"), *DRAFT.glob("fmus/*.fmu")])
    return [problem for file in files for problem in archives.check(file, LINUX, remapping.private_paths())]


if __name__ == "__main__":
    main()

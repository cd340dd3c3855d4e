import pytest

import harness


@pytest.fixture(scope="session")
def build(tmp_path_factory):
    """Turns the text of a scene into an FMU of either version; the same text is built once for each."""
    built = {}

    def build(text, fmi=2):
        if (text, fmi) not in built:
            folder = tmp_path_factory.mktemp("fmu")
            scene, fmu = folder / "scene.toml", folder / "a name with blanks.fmu"
            scene.write_text(text)
            harness.run(harness.CARGO_FMU, scene, "--fmi", fmi, "-o", fmu)
            built[text, fmi] = harness.Fmu(fmu, folder / "unpacked")
            built[text, fmi].scene = scene
        return built[text, fmi]

    return build


@pytest.fixture(scope="session")
def feup(build):
    """The default scene with its record inside."""
    return build(harness.scene_with_record())


@pytest.fixture(scope="session")
def feup_input(build):
    """The default scene with the ground acceleration as an input."""
    return build(harness.scene_without_record())

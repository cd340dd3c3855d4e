import fmus
import pounding_fmu
import pytest


@pytest.fixture(scope="session")
def build(tmp_path_factory):
    """The FMU of a scene, for FMPy; the same scene is built once."""
    built = {}

    def build(scene):
        if scene not in built:
            folder = tmp_path_factory.mktemp("fmu")
            path = pounding_fmu.build_fmu(scene, folder / "a name with blanks.fmu")
            built[scene] = fmus.Fmu(path, folder / "unpacked")
        return built[scene]

    return build

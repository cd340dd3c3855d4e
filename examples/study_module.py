"""Runs the cases of a study with the Python module of this project: all in one call, on as many threads as it may use."""

import tomllib
import warnings
import zipfile

import numpy as np
import pounding_fmu

from study_worker import failed


class Module:
    """The scene of an FMU, unpacked beside its file."""

    def __init__(self, file, description):
        self.description = description
        self.scene = scene_of(file)

    def run(self, record, scales, gaps, stop, threads):
        """The rows. What fails says where an FMU would have failed: when it is set, or in its only step."""
        parameters = {"ground.scale": np.array(scales)} | dict.fromkeys(self.description.gaps, np.array(gaps))
        failures = {}
        try:
            ends = run_batch(self.scene, parameters, self.description.outputs(), record, stop, threads)
        except pounding_fmu.BatchError as error:
            ends, failures = error.results, error.failures
        except ValueError as error:
            if len(gaps) == 1:
                return [failed(f"fmi2SetReal: {str(error).removeprefix('case 0: ')}")]
            each = zip(scales, gaps, strict=True)
            return [self.run(record, [scale], [gap], stop, 1)[0] for scale, gap in each]
        return [
            failed(f"fmi2DoStep: {failures[i]}") if i in failures else {**self.description.row(end), "error": ""}
            for i, end in enumerate(ends.tolist())
        ]


def run_batch(scene, parameters, outputs, record, stop, threads):
    with warnings.catch_warnings():
        # They have been seen when the FMU was built.
        warnings.simplefilter("ignore", pounding_fmu.SceneWarning)
        return pounding_fmu.simulate_batch(scene, parameters, outputs, records=record, stop=stop, threads=threads)


def scene_of(file):
    """The scene inside an FMU, with its record where it has been unpacked."""
    folder = file.with_suffix("")
    with zipfile.ZipFile(file) as archive:
        archive.extractall(folder, [name for name in archive.namelist() if name.startswith("resources/")])
    scene = tomllib.loads((folder / "resources/scene.toml").read_text(encoding="utf-8"))
    [record] = folder.glob("resources/record.*")
    scene["ground"]["record"] = str(record)
    return scene


def first_values(scene, names):
    """What these variables are before anything has been set."""
    start = pounding_fmu.simulate(scene, step=1e-3, stop=1e-3, outputs=names)
    return [float(start[name][0]) for name in names]

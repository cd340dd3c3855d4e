"""Runs an FMU in one importer, in the environment of that importer, and prints the last values of some variables.

    PYTHON ci/importing/one.py IMPORTER.py FMU '{"names": [...], "values": {...}, "step": 0.01, "stop": 20.0}'

In the current folder, where importers leave what they like.
"""

import importlib.util
import json
import sys


def load(path):
    """The file of an importer, whose packages are not imported before it runs."""
    specification = importlib.util.spec_from_file_location("importer", path)
    importer = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(importer)
    return importer


if __name__ == "__main__":
    path, fmu, wanted = sys.argv[1:]
    values = load(path).run(fmu, **json.loads(wanted))
    print("\nvalues", json.dumps([float(value) for value in values]))

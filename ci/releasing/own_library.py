"""The library of an FMU that `cargo fmu` makes for this machine."""

import os
import tempfile
import zipfile
from pathlib import Path

from releasing.commands import run
from releasing.places import ROOT


def compile_into(folder: Path) -> None:
    """Puts it into the folder of its platform below `folder`."""
    with tempfile.TemporaryDirectory() as directory:
        fmu = Path(directory) / "any.fmu"
        run(os.environ.get("CARGO", "cargo"), "fmu", ROOT / "examples/scenes/feup.toml", "-o", fmu, aloud=True)
        with zipfile.ZipFile(fmu) as archive:
            for name in archive.namelist():
                if name.startswith("binaries/") and not name.endswith("/"):
                    _, platform, file = name.split("/")
                    place = folder / platform / f"pounding{Path(file).suffix}"
                    place.parent.mkdir(parents=True, exist_ok=True)
                    place.write_bytes(archive.read(name))

"""Where things are. Whatever a release needs or makes lies below the checkout's target directory."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CI = ROOT / "ci"
TARGET = ROOT / "target"

# What is published, and what is needed for that.
FILES = TARGET / "release-files"
WORK = TARGET / "release-work"


def cargo_home():
    return Path(os.environ.get("CARGO_HOME") or Path.home() / ".cargo")

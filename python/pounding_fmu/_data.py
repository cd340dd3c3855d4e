"""The files that come with the package: ``scenes/``, ``records/`` and ``libraries/<platform>/``."""

from pathlib import Path

DATA: Path = Path(__file__).parent / "data"

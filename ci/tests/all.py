"""Runs these tests: `"$(ci/environment ci)" ci/tests/all.py`."""

import unittest
from pathlib import Path

CI = Path(__file__).resolve().parents[1]

if __name__ == "__main__":
    unittest.main(
        module=None, argv=["all", "discover", "--start-directory", str(CI / "tests"), "--top-level-directory", str(CI)]
    )

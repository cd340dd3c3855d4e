"""What `ci/importers` is made of: `tried/` has a file for each importer, `fmus.py` builds what they are given, `one.py` runs one of
them in its own environment, `trial.py` compares with FMPy, `table.py` writes docs/importers.md."""

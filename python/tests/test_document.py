"""The examples of docs/python.md give what stands there."""

import doctest

import fmus


def test_examples():
    done = doctest.testfile(str(fmus.EXAMPLES.parent / "docs/python.md"), module_relative=False)
    assert done.attempted > 10 and done.failed == 0

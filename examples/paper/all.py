"""The paper figure by figure, and the validation: draws every picture and writes docs/paper.md and docs/validation.md.

    python3 examples/run.py examples/paper/all.py                  # the ground motion of section 4.3 is El Centro
    python3 examples/run.py examples/paper/all.py --kobe FILE      # and your record of Kobe besides
    python3 examples/run.py examples/paper/all.py --check          # only says whether the documents are up to date

A record of Kobe is a file of yours; without one, what the documents say of Kobe stays as it is.
"""

import argparse
import sys
from pathlib import Path

import energies
import engine
import exponents
import feup
import filiatrault
import force_laws
import heights
import statement
import towers
import validation

FIGURES = [force_laws, exponents, energies, heights, feup, filiatrault]


def main():
    arguments = argparse.ArgumentParser(formatter_class=argparse.RawDescriptionHelpFormatter, description=__doc__)
    arguments.add_argument("--kobe", type=Path, metavar="FILE", help="your record of Kobe: time_s,accel_m_s2")
    arguments.add_argument("--check", action="store_true", help="write nothing; exit code 1 where a document is out of date")
    arguments.add_argument("--pictures", type=Path, metavar="FOLDER", default=statement.PICTURES, help="where to draw")
    arguments = arguments.parse_args()
    paper = {name: part for figure in FIGURES for name, part in figure.parts().items()}
    if arguments.kobe is not None:
        paper |= heights.parts_under(arguments.kobe)
    documents = {statement.PAGE: paper, validation.PAGE: validation.parts()}
    if arguments.check:
        sys.exit(max([check(page, written) for page, written in documents.items()]))
    for page, written in documents.items():
        statement.publish(written, page)
    for figure in [*FIGURES, towers]:
        figure.draw(arguments.pictures)
    if arguments.kobe is not None:
        heights.draw_under(arguments.kobe, arguments.pictures)
    print("drew the pictures in", arguments.pictures)


def check(page, written):
    """1 where a document is not what its parts say, with the first line that differs."""
    old = page.read_text().splitlines()
    new = statement.renewed(page.read_text(), written).splitlines()
    if old == new:
        return 0
    first = next((pair for pair in zip(old, new) if pair[0] != pair[1]), (len(old), len(new)))
    name = page.relative_to(engine.ROOT)
    print(f"{name} is out of date; first difference:\n- {first[0]}\n+ {first[1]}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    main()

"""The paper figure by figure, and the validation: draws every picture and writes docs/paper.md and docs/validation.md.

    "$(ci/environment)" examples/paper/all.py                  # the ground motion of section 4.3 is El Centro
    "$(ci/environment)" examples/paper/all.py --kobe FILE      # and your record of Kobe besides
    "$(ci/environment)" examples/paper/all.py --check          # only says whether the documents are up to date

A record of Kobe is a file of yours; without one, what the documents say of Kobe stays as it is. With --check, pictures
are drawn only where --pictures FOLDER says.
"""

import argparse
import sys
from itertools import zip_longest
from pathlib import Path

import energies
import exponents
import feup
import filiatrault
import force_laws
import heights
import scenes
import statement
import towers
import validation

FIGURES = [force_laws, exponents, energies, heights, feup, filiatrault]


def main():
    arguments = read_arguments()
    paper = {name: part for figure in FIGURES for name, part in figure.parts().items()}
    if arguments.kobe is not None:
        paper |= heights.parts_under(arguments.kobe)
    documents = {statement.PAGE: paper, validation.PAGE: validation.parts()}
    changed = [page for page, parts in documents.items() if arguments.check and not is_up_to_date(page, parts)]
    if not arguments.check:
        for page, parts in documents.items():
            statement.publish(parts, page)
    folder = arguments.pictures or (None if arguments.check else statement.PICTURES)
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        for figure in [*FIGURES, towers]:
            figure.draw(folder)
        if arguments.kobe is not None:
            heights.draw_under(arguments.kobe, folder)
        print("drew the pictures in", folder)
    sys.exit(1 if changed else 0)


def read_arguments():
    parser = argparse.ArgumentParser(formatter_class=argparse.RawDescriptionHelpFormatter, description=__doc__)
    parser.add_argument("--kobe", type=heights.existing, metavar="FILE", help="your record of Kobe, CSV or AT2")
    parser.add_argument("--check", action="store_true", help="write no document; exit code 1 where one is out of date")
    parser.add_argument("--pictures", type=Path, metavar="FOLDER", help="draw there instead of in docs/images/paper")
    return parser.parse_args()


def is_up_to_date(page, parts):
    """Whether a document is what its parts say; the first line that differs goes to stderr."""
    old, name = page.read_text(), page.relative_to(scenes.ROOT)
    new = statement.renewed(old, parts)
    print(f"{name}: compared {', '.join(parts)}")
    if old != new:
        first = next(pair for pair in zip_longest(old.splitlines(), new.splitlines()) if pair[0] != pair[1])
        print(f"{name} is out of date; first difference:\n- {first[0]}\n+ {first[1]}", file=sys.stderr)
    return old == new


if __name__ == "__main__":
    main()

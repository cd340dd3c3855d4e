"""The table of docs/importers.md that `ci/importers` writes: a row for each importer, by its name."""

from importing.fmus import KINDS

HEADINGS = ["importer", "tried", *KINDS, "gap", "take", "to know"]


def split(text):
    """What stands above the table, its rows by the names in them, and what stands below."""
    lines = text.splitlines(keepends=True)
    first = lines.index(row(HEADINGS))
    last = next((i for i in range(first, len(lines)) if not lines[i].startswith("|")), len(lines))
    rows = {cells(line)[0]: line for line in lines[first + 2 : last]}
    return "".join(lines[:first]), rows, "".join(lines[last:])


def join(above, rows, below):
    """The text of the page, with its rows in the order of the alphabet."""
    ruler = "|" + "---|" * len(HEADINGS) + "\n"
    ordered = sorted(rows, key=str.lower)
    return "".join([above, row(HEADINGS), ruler, *(rows[name] for name in ordered), below])


def row(texts):
    return "| " + " | ".join(texts) + " |\n"


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split(" | ")]


def of(importer, outcome, month):
    """The row of an importer."""
    get = getattr(importer, "GET", "pip install " + (importer.PACKAGES or [""])[0])
    results = [outcome.get(column, "") for column in [*KINDS, "gap"]]
    return row([importer.NAME, f"`{get}`, {month}", *results, importer.TAKE, importer.KNOW])


def losses(old, new):
    """What has run and runs no more."""
    columns = list(zip(HEADINGS, cells(old), cells(new), strict=True))
    return [heading for heading, before, now in columns if before == "runs" and now == "no"]

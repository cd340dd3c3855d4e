"""What the paper says, beside what the runs show; and the parts of documents that are written from runs."""

import re
from dataclasses import dataclass

import scenes

PAGE = scenes.ROOT / "docs/paper.md"
PICTURES = scenes.ROOT / "docs/images/paper"

HOLDS, FAILS, IN_PART = "holds", "does not hold", "holds in part"
# The paper leaves out what decides the number, or contradicts itself.
NOT_TO_BE_HAD = "cannot be obtained"


@dataclass(frozen=True)
class Statement:
    """`paper` is what the paper says, in our words; `found` what the runs show, with their numbers."""

    place: str
    paper: str
    verdict: str
    found: str


def holds(condition):
    return HOLDS if condition else FAILS


def percent(share, digits=1):
    return f"{100 * share:.{digits}f} %"


def change(ratio, digits=1):
    """By how much a ratio differs from 1."""
    return f"{100 * (ratio - 1):+.{digits}f} %"


def of_an_ordering(cases):
    """The verdict on a statement that was looked at in several cases."""
    return HOLDS if all(cases) else IN_PART if any(cases) else FAILS


def verdicts(statements):
    body = [[f"{of.place}: {of.paper}", f"**{of.verdict}**", of.found] for of in statements]
    return table(["the paper says", "verdict", "the runs show"], body)


def numbers(head, body):
    """A table whose columns hold numbers, but for the first."""
    return table(head, body, ["---", *["---:"] * (len(head) - 1)])


def table(head, body, rule=None):
    lines = [head, rule or ["---"] * len(head), *body]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def marks(name):
    return f"<!-- {name}: written by examples/paper -->\n", f"<!-- end of {name} -->"


def renewed(document, parts):
    """The document with its parts, by name, as they are now."""
    for name, part in parts.items():
        first, last = marks(name)
        pattern = re.compile(f"({re.escape(first)}).*?({re.escape(last)})", re.DOTALL)
        if not pattern.search(document):
            raise ValueError(f"expected {first.strip()} and {last}")
        document = pattern.sub(lambda found: f"{found[1]}\n{part}\n\n{found[2]}", document)
    return document


def publish(parts, page=PAGE):
    """Writes parts into a document."""
    page.write_text(renewed(page.read_text(), parts))
    print(f"{page.relative_to(scenes.ROOT)}: {', '.join(parts)}")

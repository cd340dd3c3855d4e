"""What a program has printed against what the page shows below it."""

import re


def difference(shown, printed, varies=()):
    """None where all lines shown stand in what was printed, one after another; else what is wrong.

    They are compared to the last digit: runs have the same bits on every machine. `varies` are patterns of what differs
    from run to run, such as times taken.
    """
    shown, found = (lines(text, varies) for text in (shown, printed))
    starts = [at for at, line in enumerate(found) if line == shown[0]]
    if any(found[at : at + len(shown)] == shown for at in starts):
        return None
    nearest = max(starts, key=lambda at: common(found[at:], shown), default=None)
    if nearest is None:
        return f"not printed: {shown[0]!r}; printed was\n{printed.rstrip()}"
    same = common(found[nearest:], shown)
    instead = found[nearest + same] if nearest + same < len(found) else "the end"
    return f"shown:   {shown[same]}\nprinted: {instead}"


def lines(text, varies):
    for pattern in varies:
        text = re.sub(pattern, "~", text)
    return [line.rstrip() for line in text.strip("\n").split("\n")]


def common(one, other):
    """How many lines the two have in common at their beginnings."""
    return next((at for at, pair in enumerate(zip(one, other)) if pair[0] != pair[1]), min(len(one), len(other)))

"""What ci/documents does."""

import argparse
import re
import subprocess
import sys
import tomllib
from pathlib import Path

from documenting import compare, pages
from documenting.environment import Reader, development_wheel, in_checkout
from releasing.commands import Failure
from releasing.places import CI, ROOT

LIST = CI / "documents.toml"


def main():
    parser = argparse.ArgumentParser(prog="ci/documents", description="Follows the documents as a reader does.")
    parser.add_argument("pages", nargs="*", help="their paths from the root of the checkout; without, all of them")
    parser.add_argument("--wheel", type=Path, help="the wheel that readers have; without, that of ci/wheel --dev")
    arguments = parser.parse_args()
    try:
        problems = check(arguments.pages, arguments.wheel)
    except Failure as failure:
        sys.exit(str(failure))
    sys.exit("\n".join(problems) if problems else 0)


def check(names, wheel):
    """What is wrong with the pages, a line or a paragraph each."""
    listed = tomllib.loads(LIST.read_text())
    every = [read(name) for name in tracked()]
    problems = unaccounted(every, listed)
    wanted = [page for page in every if not names or page.name in names]
    reader = Reader(wheel or development_wheel())
    reader.prepare()
    problems += command_problems(wanted, lambda *words: reader.run("sh", " ".join(words), ROOT))
    problems += name_problems(wanted, lambda text: reader.run("python", text, ROOT)[0] == 0)
    for page in wanted:
        problems += follow(page, listed, reader)
    return problems


def tracked():
    listing = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, check=True, capture_output=True, text=True)
    return listing.stdout.split()


def read(name):
    return pages.read(name, (ROOT / name).read_text())


def unaccounted(every, listed):
    """Blocks that nothing runs and nothing explains; explanations of blocks that are not there."""
    entries = {(entry["page"], entry["block"]): entry for entry in listed["listed"]}
    seen, problems = set(), []
    for page in every:
        pairs = list(page.pairs())
        compared = {id(below) for block, below in pairs if below is not None and runs(block, listed, entries)}
        for block in page.blocks:
            if not (block.is_program or block.kind == "text"):
                continue
            key = (page.name, block.first)
            seen.add(key)
            if key not in entries and id(block) not in compared and not runs(block, listed, entries):
                problems.append(f"{block.place}: nothing runs or compares this block: {block.first}")
    problems += [f"ci/documents.toml: {page} has no block {first!r}" for page, first in entries if (page, first) not in seen]
    problems += [f"ci/documents.toml: there is no page {name}" for name in listed["wheel"] if not (ROOT / name).exists()]
    return problems


def runs(block, listed, entries):
    """Whether a block is run with the wheel."""
    return block.is_program and block.page in listed["wheel"] and (block.page, block.first) not in entries


def follow(page, listed, reader):
    """Runs the blocks of a page in their order; after one that fails the rest means nothing."""
    entries = {(entry["page"], entry["block"]): entry for entry in listed["listed"]}
    by_hand = {entry["before"]: entry["do"] for entry in listed["by_hand"] if entry["page"] == page.name}
    folder = reader.folder(page.name)
    for block, below in page.pairs():
        if not runs(block, listed, entries):
            continue
        print(f"{block.place}: {block.first}", file=sys.stderr, flush=True)
        if block.first in by_hand:
            reader.run("sh", by_hand[block.first], folder)
        problems = judged(block, reader.run(*block.program, folder), below, listed)
        if problems:
            return problems
    commands = [(block, entries.get((page.name, block.first), {}).get("checkout")) for block in page.blocks]
    return [line for block, command in commands if command for line in judged(block, in_checkout(command), block, listed)]


def judged(block, ended, below, listed):
    """What is wrong with how a block has ended, and with what it has printed."""
    code, printed = ended
    if code != 0:
        return [f"{block.place}: ended with code {code}:\n{printed.rstrip()}"]
    found = below and compare.difference(below.text, printed, listed["varies"])
    return [f"{below.place}: {found}"] if found else []


def command_problems(every, run):
    """Commands and options of `pounding-fmu` that the pages name and its help does not."""
    helps, problems = {}, []
    for page in every:
        for line, words in page.commands():
            command = words[1] if re.fullmatch(r"[a-z]+", words[1]) else ""
            if command not in helps:
                helps[command] = run("pounding-fmu", command, "--help")
            code, text = helps[command]
            if code != 0:
                problems.append(f"{page.name}:{line}: there is no command pounding-fmu {command}")
                continue
            options = [re.split(r"[=\]]", word)[0] for word in words if word.lstrip("[").startswith("-") and word != "-"]
            for option in (option.lstrip("[") for option in options):
                if not re.search(rf"(^|[\s,\[|]){re.escape(option)}\b", text, re.MULTILINE):
                    problems.append(f"{page.name}:{line}: pounding-fmu {command} has no option {option}")
    return problems


def name_problems(every, succeeds):
    """Names of the Python package that the pages mention and that it does not have."""
    pattern = re.compile(r"pounding_fmu\.((?!toml|py\b)[A-Za-z_]\w*)")
    named = {name: page.name for page in every for text in texts(page) for name in pattern.findall(text)}
    # A name in the package, or a module of it.
    missing = [name for name in named if not succeeds(f"from pounding_fmu import {name}")]
    return [f"{named[name]}: pounding_fmu has no {name}" for name in missing]


def texts(page):
    return [text for _, text in page.spans] + [block.text for block in page.blocks if block.is_program]


if __name__ == "__main__":
    main()

"""The blocks of a page and the commands that it names."""

import re
from dataclasses import dataclass, replace

from markdown_it import MarkdownIt

COMMANDS = ("sh", "console", "bash")
SESSION = """
import doctest
test = doctest.DocTestParser().get_doctest({text!r}, {{}}, {name!r}, None, 0)
done = doctest.DocTestRunner().run(test)
raise SystemExit(done.failed or not done.attempted)
"""
PROGRAMS = {"python": "python", **dict.fromkeys(COMMANDS, "sh")}


@dataclass(frozen=True)
class Block:
    page: str
    line: int
    kind: str  # what stands behind the opening fence
    text: str

    @property
    def place(self):
        return f"{self.page}:{self.line}"

    @property
    def first(self):
        """Its first line without the remark: by this ci/documents.toml names it."""
        return self.text.split("\n", 1)[0].split("  #")[0].strip()

    @property
    def is_program(self):
        return self.kind in PROGRAMS

    @property
    def is_session(self):
        return self.kind == "python" and self.text.startswith(">>>")

    @property
    def program(self):
        """What runs it, and its text; what a Python session prints stands in it."""
        if self.is_session:
            return "python", SESSION.format(text=self.text, name=self.place)
        return PROGRAMS[self.kind], self.text


@dataclass(frozen=True)
class Page:
    name: str
    blocks: list
    spans: list  # (line, text) of inline code

    def pairs(self):
        """Blocks that are run, each with the block of text that stands below it, if there is one."""
        shown = [block for block in self.blocks if block.is_program or block.kind == "text"]
        for block, below in zip(shown, [*shown[1:], None]):
            if block.is_program:
                yield block, below if below is not None and below.kind == "text" else None

    def commands(self):
        """Every `pounding-fmu ...` that the page names, in blocks and in sentences, by its line."""
        lines = list(self.spans)
        for block in self.blocks:
            if block.kind in COMMANDS:
                text = block.text.replace("\\\n", " ")
                lines += [(block.line, re.split(r"\s#|&&|\|", line)[0]) for line in text.split("\n")]
        # In a checkout the same command is called cargo fmu.
        lines = [(line, re.sub(r"^cargo fmu\b", "pounding-fmu", text)) for line, text in lines]
        return [(line, text.split()) for line, text in lines if re.match(r"pounding-fmu +\S", text)]


def read(name, text):
    blocks, spans = [], []
    for token in MarkdownIt("commonmark").enable("table").parse(text):
        line = token.map[0] + 1 if token.map else 0
        if token.type in ("fence", "code_block"):
            blocks.append(Block(name, line, token.info.strip(), token.content))
        elif token.type == "inline":
            spans += [(line, child.content) for child in token.children if child.type == "code_inline"]
    return Page(name, in_one_session(blocks), spans)


def in_one_session(blocks):
    """The parts of a Python session go on from each other: all that a page has stand where the first of them is."""
    parts = [block for block in blocks if block.is_session]
    whole = [replace(parts[0], text="\n".join(part.text for part in parts))] if parts else []
    return sorted([block for block in blocks if not block.is_session] + whole, key=lambda block: block.line)

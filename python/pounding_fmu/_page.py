"""The page in one HTML file: libraries, a scene and its record put into the template that ``ci/page`` makes.

Nothing of this package is needed for it: ``ci/page`` reads this file by itself.
"""

from __future__ import annotations

import base64
import gzip
import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

LIBRARIES = (".so", ".dll", ".dylib")


def assembled(
    template: str,
    libraries: Mapping[str, bytes],
    scene: Mapping[str, str] | None = None,
    records: Mapping[str, bytes] | None = None,
) -> str:
    """The page with libraries by their platforms, a scene to begin with (``file`` and ``text``), and records by the
    paths that the scene has for them. The same content gives the same bytes."""
    page = with_element(template, "libraries", {name: packed(content) for name, content in sorted(libraries.items())})
    if scene is not None:
        page = with_element(page, "given", dict(scene))
    if records:
        known: dict[str, str] = json.loads(element(page, "records")[1])
        page = with_element(page, "records", known | {name: packed(content) for name, content in records.items()})
    return page


def libraries_in(folder: Path) -> dict[str, bytes]:
    """The libraries of a folder, ``PLATFORM/pounding.so`` and the like, by their platforms."""
    files = sorted(file for file in folder.glob("*/pounding.*") if file.suffix in LIBRARIES)
    return {file.parent.name: file.read_bytes() for file in files}


def element(page: str, name: str) -> re.Match[str]:
    """What an element of the page holds."""
    found = re.search(rf'(?<=<script type="application/json" id="{name}">)([^<]*)(?=</script>)', page)
    if found is None:
        raise ValueError(f"the template has no place for {name}: it is not of this version")
    return found


def with_element(page: str, name: str, value: Any) -> str:
    start, end = element(page, name).span()
    return page[:start] + spoken(value) + page[end:]


def packed(content: bytes) -> str:
    """As the page unpacks it."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode("ascii")


def unpacked(text: str) -> bytes:
    return gzip.decompress(base64.b64decode(text))


def spoken(value: Any) -> str:
    """JSON that no text of a scene can end: ``<`` is escaped."""
    return json.dumps(value).replace("<", "\\u003c")

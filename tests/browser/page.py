"""Uses the page (page/web) in a browser as a person would, by clicks and keys, and leaves pictures of it.

    "$(ci/environment tests/browser)" tests/browser/page.py [NAME ...]

Needs target/page/template.html, which ci/page makes, and a Chromium as report.py does. A name runs what has it in its name
alone. Pictures go to target/browser; page.png among them is the picture of docs/page.md. page_bits.py compares what the engine
in the page computes.
"""

import sys
import time

from browser import started
from pages import everyone, hostile, results, rows, saved, scene, visit


def main():
    visit.make_page()
    looks = [look for module in (scene, results, rows, saved, everyone, hostile) for look in module.LOOKS]
    wanted = [look for look in looks if not sys.argv[1:] or any(name in look.__name__ for name in sys.argv[1:])]
    with started(viewport=visit.WIDE) as context:
        browser = context.browser
        for look in wanted:
            begun = time.monotonic()
            look(browser)
            print(f"{look.__name__.replace('_', ' ')}: well, {time.monotonic() - begun:.1f} s", flush=True)


if __name__ == "__main__":
    main()

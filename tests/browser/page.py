"""Uses the page (page/web) in a browser as a person would, by clicks and keys, and leaves pictures of it.

    "$(ci/environment tests/browser)" tests/browser/page.py [NAME ...]

Needs target/page/template.html, which ci/page makes, and a Chromium as report.py does. A name runs what has it in its name
alone. As many browsers as there are processors look at once. Pictures go to target/browser; page.png among them is the picture of
docs/page.md. page_bits.py compares what the engine in the page computes.
"""

import os
import sys
import time
from multiprocessing import Pool

from browser import started
from pages import everyone, hostile, results, rows, saved, scene, visit

LOOKS = {look.__name__: look for module in (scene, results, rows, saved, everyone, hostile) for look in module.LOOKS}


def main():
    visit.make_page()
    wanted = [name for name in LOOKS if not sys.argv[1:] or any(part in name for part in sys.argv[1:])]
    browsers = max(1, min(len(wanted), os.cpu_count()))
    with Pool(browsers) as pool:
        pool.map(look_at, [wanted[first::browsers] for first in range(browsers)], chunksize=1)


def look_at(names):
    """These looks, one after the other, in a browser of their own."""
    with started(viewport=visit.WIDE) as context:
        for name in names:
            begun = time.monotonic()
            LOOKS[name](context.browser)
            print(f"{name.replace('_', ' ')}: well, {time.monotonic() - begun:.1f} s", flush=True)


if __name__ == "__main__":
    main()

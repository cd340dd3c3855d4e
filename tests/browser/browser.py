"""A headless Chromium for the programs in this folder, and what no page may do in it."""

import os
import shutil
import sys
from contextlib import contextmanager

NAMES = ["chromium", "chromium-headless-shell", "chromium-browser", "google-chrome", "google-chrome-stable"]


@contextmanager
def started(**context):
    """A context of the browser, offline; ends the program where there is none."""
    program = os.environ.get("BROWSER") or next(filter(None, map(shutil.which, NAMES)), None)
    if program is None:
        sys.exit(f"no browser here: apt-get install chromium (looked for {', '.join(NAMES)}; BROWSER names another)")
    from playwright.sync_api import sync_playwright

    arguments = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=program, args=arguments)
        yield chromium.new_context(offline=True, **context)
        print(f"in {program} {chromium.version}")
        chromium.close()


def listen(page, *schemes):
    """What a page must not do: report errors, open dialogs, load anything but itself (and what has one of `schemes`)."""
    troubles, own = [], ("file:", *schemes)
    page.on("pageerror", lambda error: troubles.append(f"error: {error}"))
    page.on("console", lambda message: message.type == "error" and troubles.append(f"console: {message.text}"))
    page.on("dialog", lambda dialog: (troubles.append(f"dialog: {dialog.message}"), dialog.dismiss()))
    page.on("request", lambda request: request.url.startswith(own) or troubles.append(f"request: {request.url}"))
    return troubles

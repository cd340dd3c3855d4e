"""What leaves the page: files, each as the browser saves it."""

import csv
import io
import zipfile
from pathlib import Path

from .visit import FOLDER, LIBRARIES, says, visit


def saves_the_scene_and_tables(browser):
    with visit(browser) as page:
        text = page.locator("#scene").input_value()
        assert saved(page, "#save-scene", "FeupFrames.toml") == text.encode()
        rows = list(csv.DictReader(io.StringIO(saved(page, "#save-csv", "FeupFrames.csv").decode())))
        assert len(rows) == 2001 and rows[-1]["impacts"] == "108"
        page.locator("#csv-of").select_option("impacts")
        rows = list(csv.DictReader(io.StringIO(saved(page, "#save-csv", "FeupFrames.impacts.csv").decode())))
        assert len(rows) == 108 and rows[0]["contact"] == "2"
        report = saved(page, "#save-report", "FeupFrames.html").decode()
        assert report.startswith("<!DOCTYPE html>") and "108 impacts" not in report[:500] and "FeupFrames" in report
        picture = saved(page, "#save-picture", "FeupFrames.png")
        assert picture.startswith(b"\x89PNG")
        (FOLDER / "page_picture.png").write_bytes(picture)


def saves_fmus_for_all_platforms(browser):
    with visit(browser) as page:
        for version, name in [("2", "FeupFrames.fmu"), ("3", "FeupFrames.fmi3.fmu")]:
            page.locator("#fmi").select_option(version)
            fmu = zipfile.ZipFile(io.BytesIO(saved(page, "#save-fmu", name)))
            description = fmu.read("modelDescription.xml").decode()
            assert f'fmiVersion="{version}.0"' in description
            binaries = [entry for entry in fmu.namelist() if entry.startswith("binaries/") and not entry.endswith("/")]
            assert sorted(map(fmu.read, binaries)) == sorted(LIBRARIES.values()), binaries


def saves_nothing_of_a_scene_with_mistakes(browser):
    with visit(browser) as page:
        page.locator("#scene").fill("name = 3")
        says(page, "mistake")
        page.locator("#save-fmu").click()
        says(page, "has mistakes.*Nothing is saved", at="#saved")


def saves_the_text_as_it_stands(browser):
    """Right after an edit, when nothing has been checked or run yet."""
    with visit(browser) as page:
        text = page.locator("#scene").input_value().replace('name = "FeupFrames"', 'name = "Other"')
        page.locator("#scene").fill(text)
        assert saved(page, "#save-scene", "Other.toml") == text.encode()
        page.locator("#scene").fill(text.replace("Other", "Third"))
        saved(page, "#save-csv", "Third.csv")


def saved(page, button, name):
    """The bytes of the file that a button saves."""
    with page.expect_download() as waiting:
        page.locator(button).click()
    assert waiting.value.suggested_filename == name, waiting.value.suggested_filename
    return Path(waiting.value.path()).read_bytes()


LOOKS = [saves_the_scene_and_tables, saves_fmus_for_all_platforms, saves_nothing_of_a_scene_with_mistakes, saves_the_text_as_it_stands]

#!/usr/bin/env python3
"""Measures headless Chromium with the page of a probe kit, using only the keyboard: probe_page.py STRATA

The page must draw without an error on the console, load no other file, report what it cannot draw, and offer an archive that `strata infer` reads.
The inferred profile must draw every pixel of the kit and of twenty unseen scenes like the browser. STRATA_KEEP=FOLDER stores the answers and the
inferred profile there. Skips with a message and exit status 77 without Chromium, its driver or Selenium (Debian: chromium, chromium-driver,
python3-selenium).
"""
import json
import os
import subprocess
import sys
import tempfile

import pages

# The fields of a profile that determine coverage.
COVERAGE = ["raster.subpixel_bits", "raster.snap", "raster.tie_rule"]


def answers(driver, folder, downloads):
    """Opens the kit's page, presses Enter twice, and returns the downloaded archive."""
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait
    driver.get("file://" + os.path.join(folder, "probe.html"))
    active = lambda: driver.switch_to.active_element
    active().send_keys(Keys.TAB)
    assert active().get_attribute("id") == "start", "the first key leads to the button"
    active().send_keys(Keys.ENTER)
    pages.wait_until_ready(driver, 500)
    status = driver.find_element("id", "status").text
    assert driver.execute_script("return document.body.dataset.ready") == "yes", status
    assert active().get_attribute("id") == "download", "the keyboard stands on the archive"
    active().send_keys(Keys.ENTER)
    path = os.path.join(downloads, "answers.tar")
    WebDriverWait(driver, 60).until(lambda d: os.path.exists(path))
    if "STRATA_SCREENSHOTS" in os.environ:
        driver.save_screenshot(os.path.join(os.environ["STRATA_SCREENSHOTS"], "probe.png"))
    kept = os.path.join(folder, "answers.tar")
    os.rename(path, kept)
    bars = driver.execute_script("const p = document.getElementById('progress'); return [p.value, p.max]")
    assert bars[0] == bars[1], "all scenes are counted"
    return kept, status


def check_quiet(driver):
    errors, loaded = pages.console(driver, "ReadPixels"), pages.loaded(driver)  # slow read-back is not an error
    return [f"the console says {errors}"] * bool(errors) + [f"the page loaded {loaded}"] * bool(loaded)


def infer(strata, archive, profile):
    ended = subprocess.run([strata, "infer", archive, "--y", "down", "-o", profile, "--json"], capture_output=True, text=True, check=True)
    return json.loads(ended.stdout)


def compared(strata, archive, profile, count):
    """Compares every unseen scene: the number of pixels, and the number that differ."""
    ended = subprocess.run([strata, "probe", "--unseen", str(count), "--y", "down", "--profile", profile, "--compare", archive, "--json"],
                           capture_output=True, text=True)
    return json.loads(ended.stdout)["scenes"]


def main():
    strata = os.path.abspath(sys.argv[1])
    if pages.missing():
        print(pages.missing())
        return pages.SKIPPED
    wrong = []
    with tempfile.TemporaryDirectory() as work:
        folder = os.environ.get("STRATA_KEEP", work)
        downloads = os.path.join(work, "downloads")
        os.makedirs(downloads)
        kit, unseen, profile = os.path.join(folder, "kit"), os.path.join(folder, "unseen"), os.path.join(folder, "profile.json")
        subprocess.run([strata, "probe", "-o", kit], check=True)
        subprocess.run([strata, "probe", "--unseen", "20", "-o", unseen], check=True)
        driver = pages.browser("--use-angle=swiftshader", "--enable-unsafe-swiftshader", size="900,900", downloads=downloads)
        try:
            archive, status = answers(driver, kit, downloads)
            wrong += check_quiet(driver)
            print(status)
            beside, _ = answers(driver, unseen, downloads)
            wrong += check_quiet(driver)
        finally:
            driver.quit()
        found = infer(strata, archive, profile)
        with open(os.path.join(folder, "inferred.json"), "w", encoding="utf-8") as file:
            json.dump(found, file, indent=1)
        states = {f["field"]: f["state"] for f in found["fields"]}
        wrong += [f"{key} is {states[key]}" for key in COVERAGE if states[key] != "inferred"]
        wrong += [f"{key} is broken" for key in states if states[key] == "broken"]
        wrong += [f"{found['pixels'] - found['agree']} pixels of the kit differ"] * (found["pixels"] != found["agree"])
        for scene in compared(strata, beside, profile, 20):
            print(json.dumps(scene))
            for what in ("coverage", "depth", "color"):
                if scene[f"{what}_differ"] != 0:
                    wrong.append(f"{scene['name']}: {scene[f'{what}_differ']} pixels differ in {what}")
        print(json.dumps({"fields": {s: list(states.values()).count(s) for s in set(states.values())},
                          "pixels": found["pixels"], "agree": found["agree"]}))
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

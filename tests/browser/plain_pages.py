#!/usr/bin/env python3
"""Opens the page of every command with --report, and those of the experiments, in headless Chromium: plain_pages.py STRATA

Each page must have text, show its pictures, load no other file, log nothing to the console, violate no rule of axe-core (STRATA_AXE), fit a screen
390 pixels wide, and its tables must sort by keyboard. STRATA_SCREENSHOTS=FOLDER stores pictures there. Skips with a message and exit status 77
without Chromium, its driver or Selenium.
"""
import os
import subprocess
import sys
import tempfile

import pages

# A shell command, and the page that it writes.
PAGES = {
    "render": ("strata render teapot --size 320x300 --algorithm dual,unsorted,a_buffer -q --report render.html", "render.html"),
    "passes": ("strata passes teapot --size 96x72 -o passes --report passes.html", "passes.html"),
    "compare": ("strata render teapot --size 96x72 -q --algorithm dual,unsorted -o t.png;"
                "strata compare t.dual.png t.unsorted.png --report compare.html", "compare.html"),
    "compare-folders": ("strata golden teapot --size 48x36 --algorithm dual,front_to_back -o pack > out.txt;"
                        "strata golden teapot --size 48x36 --algorithm dual --orbit 31,20 -o other > out.txt;"
                        "mkdir -p mine; cp -r other/expected/dual mine/dual; strata compare pack mine --report folders.html", "folders.html"),
    "hardware-check": ("mkdir -p captures/Clear; strata render showroom --size 640x480 --algorithm unsorted -q -o captures/Clear/C00000000_Depth_y.png;"
                       "strata hardware-check captures -o captured > out.txt; LAB/hardware_check/page.py captured --whole -o captures.html", "captures.html"),
    "diagnose": ("strata render showroom --size 64x64 -q --algorithm unsorted -o mine.png; strata diagnose showroom mine.png --report diagnose.html", "diagnose.html"),
    "cost": ("strata cost planes:count=3 --size 32x24 --knob average_count --repeat 1 -o cost; LAB/cost/page.py cost -o cost.html", "cost.html"),
    "hard-cases": ("strata hard-cases coincident --algorithm dual,painter --profile ideal --depth-format d16,d32f --no-moves -o hard;"
                   "LAB/hard_cases/whole_page.py hard --strata $(command -v strata) -o hard.html", "hard.html"),
    "invariance": ("strata invariance planes:gap=8 --size 32x24 --remedy none,bias:4 -o pairs; LAB/invariance/report.py pairs", "pairs/index.html"),
    "reproduce": ("strata reproduce everitt2001 --size 32 -o everitt; LAB/reproduce/page.py everitt", "everitt/index.html"),
}


def column(driver, number):
    return driver.execute_script("return [...document.querySelector('table.sorts').tBodies[0].rows].map((r) => r.cells[arguments[0]].textContent)", number)


def check_sorting(driver):
    """Sorts by the first heading of the first table with the keyboard, ascending and descending."""
    from selenium.webdriver.common.keys import Keys
    buttons = driver.find_elements("css selector", "table.sorts th button")
    if not buttons:
        return []
    before = column(driver, 0)
    rising = sorted(before, key=float) if all(v.replace(".", "").isdigit() for v in before) else sorted(before)
    wrong = []
    for state in ("ascending", "descending"):
        buttons[0].send_keys(Keys.ENTER)
        wanted = rising if state == "ascending" else rising[::-1]
        head = driver.find_element("css selector", "table.sorts th")
        if head.get_attribute("aria-sort") != state or column(driver, 0) != wanted:
            wrong.append(f"a heading does not sort, {state}")
    return wrong


def check_phone(driver):
    """Checks that the page is not wider than a screen of 390 pixels, and that numbers of a scale do not overlap there."""
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 390, "height": 800, "deviceScaleFactor": 1, "mobile": True})
    wrong = [] if driver.execute_script("return document.documentElement.scrollWidth") <= 390 else ["wider than a phone"]
    wrong += driver.execute_script("return [...document.querySelectorAll('caption, figcaption')].filter((c) => c.getBoundingClientRect().right > 390)"
                                   ".map((c) => 'off a phone: ' + c.textContent)")
    ends = driver.execute_script("return [...document.querySelectorAll('.scale span')].map((s) => s.getBoundingClientRect()).map((b) => [b.top, b.left, b.right])")
    wrong += ["numbers of a scale overlap" for (top, _, right), (other, left, _) in zip(ends, ends[1:]) if top == other and left <= right]
    driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    return wrong


def check(driver, name, path):
    driver.get("file://" + path)
    pages.wait_until_ready(driver)
    wrong = [f"axe-core: {rule}" for rule in pages.violations(driver)]
    broken = driver.execute_script("return [...document.images].filter((i) => !i.complete || i.naturalWidth === 0).map((i) => i.alt)")
    wrong += [f"no picture of {alt}" for alt in broken]
    wrong += check_phone(driver)
    wrong += [f"loaded {what}" for what in pages.loaded(driver)]
    if not driver.title or not driver.find_elements("tag name", "h1"):
        wrong.append("no title")
    if name != "render":  # report_page.py tests the controls of this page
        wrong += check_sorting(driver)
    wrong += [f"the console says {line}" for line in pages.console(driver)]
    if "STRATA_SCREENSHOTS" in os.environ:
        driver.save_screenshot(os.path.join(os.environ["STRATA_SCREENSHOTS"], f"page.{name}.png"))
    return [f"{name}: {sentence}" for sentence in wrong]


def main():
    strata = os.path.abspath(sys.argv[1])
    if pages.skips():
        return pages.SKIPPED
    driver, wrong = pages.browser("--disable-gpu"), []
    lab = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "lab")
    environment = {**os.environ, "PATH": os.path.dirname(strata) + os.pathsep + os.environ["PATH"]}
    try:
        with tempfile.TemporaryDirectory() as folder:
            for name, (line, page) in PAGES.items():
                subprocess.run(["sh", "-c", line.replace("LAB/", lab + "/")], cwd=folder, env=environment, check=False, stdout=subprocess.DEVNULL)
                wrong += check(driver, name, os.path.join(folder, page))
    finally:
        driver.quit()
    print("\n".join(wrong))
    print(f"{len(PAGES)} pages, {len(wrong)} faults")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Opens a report in headless Chromium, uses all of its controls, and compares what it shows with the program's output: report_page.py STRATA

The page must draw without an error on the console, its numbers must be those of `strata explain` and `strata render`, it must be usable with only the
keyboard and load no other file. With STRATA_AXE=FILE (axe.min.js of the npm package axe-core) it is checked for accessibility;
STRATA_SCREENSHOTS=FOLDER stores pictures there. Skips with a message and exit status 77 without Chromium, its driver or Selenium (Debian:
chromium, chromium-driver, python3-selenium).
"""
import json
import os
import re
import subprocess
import sys
import tempfile

import pages

SCENES = [
    ["teapot", "--size", "96x72"],
    ["volume-beam:slices=8", "--size", "64x48", "--profile", "ideal", "--color-space", "linear"],
    ["random:triangles=200", "--size", "48x64", "--profile", "geforce3"],
]


class Page:
    """A report in a browser, and the program that wrote it."""

    def __init__(self, driver, strata, scene, folder):
        self.driver, self.strata, self.scene, self.wrong = driver, strata, scene, []
        subprocess.run([strata, "report", *scene, "-o", folder], check=True, stdout=subprocess.DEVNULL)
        driver.get("file://" + os.path.join(folder, "report.html"))
        pages.wait_until_ready(driver)

    def expect(self, what, found, expected):
        if found != expected:
            self.wrong.append(f"{self.scene[0]}: {what}: expected {str(expected)[:300]!r}, found {str(found)[:300]!r}")

    def js(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def pixels(self, canvas):
        return self.js("const c = document.getElementById(arguments[0]);"
                       "return Array.from(c.getContext('2d').getImageData(0, 0, c.width, c.height).data)", canvas)

    def set(self, control, value):
        self.js("const e = document.getElementById(arguments[0]); e.value = arguments[1];"
                "e.dispatchEvent(new Event('input')); e.dispatchEvent(new Event('change'))", control, str(value))

    def text(self, place):
        return self.js("return document.getElementById(arguments[0]).textContent", place)

    def check_pictures(self):
        """Checks that the picture of the last algorithm, to the right of a divider at 0, has the codes that render writes."""
        names = [c for c in self.js("return [...document.getElementById('right').options].map((o) => o.value)")]
        self.set("divide", 0)
        for name in names:
            self.set("right", name)
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "out.png")
                subprocess.run([self.strata, "render", *self.scene, "--algorithm", name, "--no-audit", "-o", path], check=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                drawn = self.pixels("compare")
                wanted = self.js("""const done = arguments[arguments.length - 1]; return new Promise((resolve) => { const i = new Image();
                    i.onload = () => { const c = document.createElement('canvas'); c.width = i.width; c.height = i.height;
                    const x = c.getContext('2d'); x.drawImage(i, 0, 0);
                    resolve(Array.from(x.getImageData(0, 0, c.width, c.height).data)); };
                    i.src = 'data:image/png;base64,' + arguments[0]; })""", base64_of(path))
                apart = max(abs(a - b) for a, b in zip(drawn, wanted)) if len(drawn) == len(wanted) else 256
                # The script's own pow encodes linear light.
                limit = 1 if "linear" in self.scene else 0
                if apart > limit:
                    self.wrong.append(f"{self.scene[0]}: {name}: the page's picture differs from render's by {apart}")
        return names

    def check_controls(self):
        """Checks that every control changes the part of the page that it controls."""
        before = self.pixels("layer-color")
        if int(self.js("return document.getElementById('layer').max")) > 0:
            self.set("layer", 1)
            self.expect("the layer slider moves", self.pixels("layer-color") != before, True)
        depth = self.pixels("layer-depth")
        self.set("far", float(self.js("return document.getElementById('near').value")) + 1e-3)
        self.expect("the depth range moves", self.pixels("layer-depth") != depth, True)
        self.js("document.getElementById('fit').click()")
        self.expect("fit gives the range back", self.pixels("layer-depth"), depth)
        seen = set()
        for name in self.js("return [...document.getElementById('map').options].map((o) => o.value)"):
            self.set("map", name)
            seen.add(self.text("map-text"))
        self.expect("every map has a text of its own", len(seen), len(self.js("return [...document.getElementById('map').options]")))
        self.js("document.querySelectorAll('#numbers th button')[1].click()")
        column = [int(v) for v in self.js("return [...document.querySelectorAll('#numbers tr td:nth-child(2)')].map((c) => c.textContent)")]
        self.expect("passes are sorted", column, sorted(column))

    def check_pixel(self):
        """Compares the pixel selected first, then by mouse and by keyboard, with strata explain."""
        from selenium.webdriver.common.keys import Keys
        x, y = int(self.js("return document.getElementById('x').value")), int(self.js("return document.getElementById('y').value"))
        canvas = self.driver.find_element("id", "map-canvas")
        canvas.send_keys(Keys.ARROW_RIGHT)
        self.expect("the arrow key moves", int(self.js("return document.getElementById('x').value")), min(x + 1, self.js("return width") - 1))
        self.set("x", x)
        algorithm = self.js("return history.algorithm")
        told = subprocess.run([self.strata, "explain", *self.scene, "--algorithm", algorithm, "--pixel", f"{x},{y}"], check=True,
                              capture_output=True, text=True).stdout
        found = self.text("history")
        if not found.startswith("The whole history"):
            self.expect("the history is explain's", found, told)
        bits = sorted(re.findall(r"z [^ ]+ \(([0-9a-f]{8})\)", told))
        shown = sorted(self.js("return [...document.querySelectorAll('#fragments tr td:nth-child(6)')].map((c) => c.textContent)"))
        self.expect("depths in hexadecimal are explain's", shown, bits)
        # Dual merges fragments, which are compared one by one; other algorithms are compared by name.
        takes = len(re.findall(r"takes #", told))
        table = self.js("return [...document.querySelectorAll('#fragments tr')].map((r) => [...r.cells].map((c) => c.textContent))")
        column = table[0].index(algorithm) if algorithm in table[0] else None
        if column is not None:
            taken = {row[column] for row in table[1:] if row[column] != "never"}
            told_takes = {f"pass {p}, {end} end" for p, end in re.findall(r"pass (\d+): takes .* at the (near|far) end", told)}
            self.expect("passes and ends of the fragments are explain's", taken, told_takes)
        self.expect("explain took some", takes > 0, True)

    def check_access(self):
        """Checks that the page violates no rule of axe-core, if STRATA_AXE names axe.min.js."""
        self.expect("axe-core finds nothing", pages.violations(self.driver), [])

    def check_quiet(self):
        # The warning about reading pictures back is caused by this test.
        self.expect("the console is empty", pages.console(self.driver, "willReadFrequently"), [])
        self.expect("nothing was loaded", pages.loaded(self.driver), [])


def check_without_exact(driver, strata):
    """Checks that a report without a_buffer shows no difference images, because black ones would mean that all is right, and gives the reason."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([strata, "report", "planes:count=3", "--size", "32x24", "--algorithm", "dual,unsorted", "-q", "-o", folder], check=True)
        driver.get("file://" + os.path.join(folder, "report.html"))
        pages.wait_until_ready(driver)
        wrong = [] if len(driver.find_elements("css selector", ".card canvas")) == 2 else ["without a_buffer: expected a picture an algorithm"]
        if "a_buffer" not in driver.find_element("id", "sheet-text").text or driver.find_element("id", "gain-row").is_displayed():
            wrong.append("without a_buffer: the page does not say that differences are missing")
        return wrong + [f"axe-core: {rule}" for rule in pages.violations(driver)]


def base64_of(path):
    import base64
    with open(path, "rb") as file:
        return base64.b64encode(file.read()).decode()


def main():
    strata = os.path.abspath(sys.argv[1])
    if pages.skips():
        return pages.SKIPPED
    driver, wrong = pages.browser("--disable-gpu"), []
    try:
        for number, scene in enumerate(SCENES):
            with tempfile.TemporaryDirectory() as folder:
                page = Page(driver, strata, scene, folder)
                page.check_pixel()
                names = page.check_pictures()
                page.check_controls()
                page.check_quiet()
                page.check_access()
                wrong += page.wrong
                print(json.dumps({"scene": scene[0], "algorithms": len(names), "wrong": len(page.wrong)}))
                if "STRATA_SCREENSHOTS" in os.environ:
                    os.makedirs(os.environ["STRATA_SCREENSHOTS"], exist_ok=True)
                    driver.set_window_size(1280, 5200)
                    driver.save_screenshot(os.path.join(os.environ["STRATA_SCREENSHOTS"], f"report.{number}.png"))
                    driver.set_window_size(1280, 1000)
        wrong += check_without_exact(driver, strata)
    finally:
        driver.quit()
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

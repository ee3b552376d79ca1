#!/usr/bin/env python3
"""Makes the README's picture of a report: the head of the page and its first row of algorithms, in headless Chromium.

    /usr/bin/python3 tools/docs/pictures/report.py STRATA    (Debian's chromium, chromium-driver and python3-selenium)
"""
import base64
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parents[2] / "tests/browser"))
import pages  # noqa: E402

WIDTH = 1130
FIRST_ROW = """const cards = [...document.querySelectorAll(".card")].map((card) => card.getBoundingClientRect());
return Math.max(...cards.filter((card) => card.top === cards[0].top).map((card) => card.bottom));"""


def main():
    strata = os.path.abspath(sys.argv[1])
    driver = pages.browser("--disable-gpu", "--hide-scrollbars")
    try:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([strata, "report", "teapot", "--alpha", "0.75", "--background", "1,1,1", "--size", "256x192", "--camera",
                            str(HERE / "teapot.json"), "--algorithm", "unsorted,weighted_average,front_to_back,dual,a_buffer", "-q", "-o", folder],
                           check=True)
            driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": WIDTH, "height": 800, "deviceScaleFactor": 0.8, "mobile": False})
            driver.get("file://" + os.path.join(folder, "report.html"))
            pages.wait_until_ready(driver)
            clip = {"x": 0, "y": 0, "width": WIDTH, "height": driver.execute_script(FIRST_ROW) + 8, "scale": 1}
            shot = driver.execute_cdp_cmd("Page.captureScreenshot", {"clip": clip, "captureBeyondViewport": True})
            (HERE / "report.png").write_bytes(base64.b64decode(shot["data"]))
    finally:
        driver.quit()


if __name__ == "__main__":
    main()

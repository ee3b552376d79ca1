#!/usr/bin/env python3
"""Compares the profile swiftshader with the SwiftShader renderer of headless Chromium: swiftshader_page.py STRATA

Chromium's SwiftShader draws the kit and thirty unseen scenes on its page; the profile must reproduce every pixel of them: coverage, colours (8 bits,
binary16, binary32, blended too) and depths (16 bits and binary32, and the binary32 that buffers of 24 bits hold). Skips with a message and exit
status 77 without Chromium, its driver or Selenium (Debian: chromium, chromium-driver, python3-selenium).
"""
import json
import os
import subprocess
import sys
import tarfile
import tempfile

import pages
import probe_page

UNSEEN = 30


def drawn(driver, strata, folder, downloads, *what):
    subprocess.run([strata, "probe", *what, "-o", folder], check=True)
    archive, _ = probe_page.answers(driver, folder, downloads)
    return archive


def differing(strata, archive, *what):
    """The names of scenes that differ and how, and the numbers of pixels and scenes compared."""
    ended = subprocess.run([strata, "probe", *what, "--y", "down", "--profile", "swiftshader", "--compare", archive, "--json"],
                           capture_output=True, text=True)
    scenes = json.loads(ended.stdout)["scenes"]
    wrong = [f"{s['name']}: {s['coverage_differ']} in coverage, {s['color_differ']} in colour, {s['depth_differ']} in depth"
             for s in scenes if s["coverage_differ"] + s["color_differ"] + s["depth_differ"] > 0]
    return wrong, sum(s["pixels"] for s in scenes), len(scenes)


def float_depths(strata, kit, archive, folder):
    """The names of scenes with a 24-bit depth buffer whose texels differ in any bit from the depths that the profile stores."""
    subprocess.run([strata, "probe", "--profile", "swiftshader", "-o", folder], check=True)
    with open(os.path.join(kit, "kit.json"), encoding="utf-8") as file:
        names = [item["name"] for item in json.load(file)["items"] if item["depth"] == "d24"]
    wrong, compared = [], 0
    with tarfile.open(archive) as answers:
        for name in names:
            path = f"probe/down/{name}/depth.npy"
            with open(os.path.join(folder, path), "rb") as file:
                compared += 1
                if file.read() != answers.extractfile(path).read():
                    wrong.append(f"{name}: its 24-bit depths are not the profile's binary32")
    return wrong, compared


def main():
    strata = os.path.abspath(sys.argv[1])
    if pages.missing():
        print(pages.missing())
        return pages.SKIPPED
    with tempfile.TemporaryDirectory() as work:
        downloads, kit = os.path.join(work, "downloads"), os.path.join(work, "kit")
        os.makedirs(downloads)
        driver = pages.browser("--use-angle=swiftshader", "--enable-unsafe-swiftshader", size="900,900", downloads=downloads)
        try:
            archive = drawn(driver, strata, kit, downloads)
            unseen = drawn(driver, strata, os.path.join(work, "unseen"), downloads, "--unseen", str(UNSEEN))
        finally:
            driver.quit()
        wrong, pixels, scenes = differing(strata, archive)
        more, unseen_pixels, unseen_scenes = differing(strata, unseen, "--unseen", str(UNSEEN))
        bits, buffers = float_depths(strata, kit, archive, os.path.join(work, "profile"))
    print(f"kit: {pixels} pixels of {scenes} scenes; unseen: {unseen_pixels} of {unseen_scenes}; buffers of 24 bits: {buffers}")
    wrong += more + bits
    wrong += ["too few scenes were drawn"] * (scenes < 40 or unseen_scenes < UNSEEN or buffers < 5)
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

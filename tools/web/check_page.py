#!/usr/bin/env python3
"""Opens the browser's page in headless Chromium and compares it with the program: check_page.py STRATA PAGE_FOLDER

Eleven scenes by every algorithm: each digest is the one that `strata render` prints, each refusal has its sentence. Then the test uses the controls: the
orbit, the layers, the pixel, a file. STRATA_SCREENSHOTS=FOLDER stores pictures; STRATA_AXE=FILE (axe.min.js of the npm package axe-core) checks
accessibility; STRATA_MODEL=FILE.glb is dropped onto the page and timed at 512x512. Skips with a message and exit status 77 without Chromium, its
driver or Selenium.
"""
import functools
import http.server
import json
import os
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tests", "browser"))
import pages  # noqa: E402

# With the options of the command; the page is given the same.
SCENES = [
    ("teapot", {"size": [64, 48]}),
    ("teapot:tessellation=3", {"size": [48, 48], "alpha": 0.5, "profile": "ideal"}),
    ("volume-beam:slices=8", {"size": [48, 40]}),
    ("volume-beam:slices=5,order=near", {"size": [40, 40], "profile": "geforce3"}),
    ("random:triangles=300", {"size": [64, 64], "background": [0.25, 0.5, 1]}),
    ("random:seed=7,triangles=60", {"size": [33, 17], "color_space": "linear", "profile": "ideal"}),
    ("planes:count=5", {"size": [32, 32], "orbit": [75, -10]}),
    ("shadow-demo", {"size": [48, 36]}),
    ("showroom", {"size": [64, 64], "profile": "geforce3"}),
    ("random:triangles=40", {"size": [32, 32], "options": {"samples": 4, "sort": "exact", "clip_depth": "zero-to-one"}}),
    ("hard:case=planes-1-unit", {"size": [40, 30], "profile": "llvmpipe"}),
]


def options_of(question):
    options = ["--size", "x".join(map(str, question["size"]))]
    for name, value in question.items():
        if name in ("alpha", "profile", "color_space"):
            options += ["--" + name.replace("_", "-"), str(value)]
        if name == "options":
            options += [word for key, text in value.items() for word in ("--" + key.replace("_", "-"), str(text))]
        if name in ("background", "orbit"):
            options += ["--" + name, ",".join(map(str, value))]
    return options


def told_by(strata, scene, question):
    """Digests by algorithm, as the command prints them; None for those that it refuses."""
    run = subprocess.run([strata, "render", scene, *options_of(question), "--algorithm", "all", "--no-audit", "--stats", "-"],
                         capture_output=True, text=True, check=False)
    return {row["algorithm"]: row["digest"]["color"] or None for row in json.loads(run.stdout)}


def serve(folder):
    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_port}/"


class Page:
    def __init__(self, driver, strata):
        self.driver, self.strata, self.wrong = driver, strata, []
        self.compared = self.refused = 0

    def expect(self, what, found, expected):
        if found != expected:
            self.wrong.append(f"{what}: expected {str(expected)[:300]!r}, found {str(found)[:300]!r}")

    def js(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def wait(self, mark="ready"):
        from selenium.webdriver.support.ui import WebDriverWait
        WebDriverWait(self.driver, 300).until(lambda d: d.execute_script("return document.body.dataset[arguments[0]] === 'yes'", mark))

    def ask(self, question):
        return self.driver.execute_async_script(
            "const done = arguments[1]; ask(arguments[0]).then((a) => done(a.answer))", question)

    def check_digests(self):
        for scene, settings in SCENES:
            for algorithm, digest in told_by(self.strata, scene, settings).items():
                answer = self.ask({"do": "render", "scene": scene, "algorithm": algorithm, **settings})
                self.expect(f"{scene} by {algorithm}", answer.get("digest", answer.get("error")), digest)
                self.compared += 1 if digest else 0
                self.refused += 0 if digest else 1

    def check_controls(self):
        from selenium.webdriver.common.keys import Keys
        digest = lambda: self.js("return document.getElementById('digest').textContent")
        first = digest()
        told = told_by(self.strata, "teapot", {"size": [320, 240]})
        self.expect("the first digest", first, told["dual"])
        self.driver.find_element("id", "picture").send_keys(Keys.ARROW_LEFT)
        self.wait()
        self.expect("a turn", digest(), told_by(self.strata, "teapot", {"size": [320, 240], "orbit": [20, 20]})["dual"])
        before = self.js("return document.getElementById('layer-text').textContent")
        self.js("const l = document.getElementById('layer'); l.value = 1; l.dispatchEvent(new Event('input'))")
        self.expect("the layer slider moves", self.js("return document.getElementById('layer-text').textContent") != before, True)
        self.js("document.getElementById('y').value = 120; const e = document.getElementById('x'); e.value = 160; e.dispatchEvent(new Event('change'))")
        self.wait("inspected")
        explained = subprocess.run([self.strata, "explain", "teapot", "--size", "320x240", "--orbit", "20,20", "--algorithm", "dual",
                                    "--pixel", "160,120"], capture_output=True, text=True, check=True).stdout
        self.expect("the pixel's history", self.js("return document.getElementById('history').textContent"), explained)

    def check_mistakes(self):
        """Tests that errors are reported in a sentence."""
        for scene, word in [("teapott", "teapot"), ("teapot:tessellation=0", "tessellation")]:
            error = self.ask({"do": "render", "scene": scene, "algorithm": "dual", "size": [8, 8]}).get("error", "")
            self.expect(f"{scene} is told of", word in error and "expected" in error, True)

    def check_model(self):
        path = os.environ.get("STRATA_MODEL")
        if not path:
            print("SKIPPED: no model of one's own, for STRATA_MODEL names no file")
            return
        self.driver.find_element("id", "file").send_keys(os.path.abspath(path))
        time.sleep(0.1)
        self.wait()
        settings = {"size": [512, 512], "alpha": 0.5}
        name = os.path.basename(path)
        found = self.ask({"do": "render", "scene": name, "algorithm": "dual", **settings})
        self.expect(f"{name} by dual", found.get("digest", found.get("error")), told_by_one(self.strata, path, settings))
        best = self.driver.execute_async_script("""const [q, done] = arguments; (async () => { let best = Infinity;
            for (let i = 0; i < 10; ++i) { const t = performance.now(); await ask(q); best = Math.min(best, performance.now() - t); }
            done(best); })()""", {"do": "render", "scene": name, "algorithm": "dual", **settings})
        print(f"{name} at 512x512 by dual: {best:.0f} ms, the best of ten")

    def check_access(self):
        if "STRATA_AXE" not in os.environ:
            print("SKIPPED: axe-core, for STRATA_AXE names no file")
            return
        self.expect("axe-core finds nothing", pages.violations(self.driver), [])


def told_by_one(strata, scene, question):
    run = subprocess.run([strata, "render", scene, *options_of(question), "--algorithm", "dual", "--no-audit", "--stats", "-"],
                         capture_output=True, text=True, check=False)
    return json.loads(run.stdout)[0]["digest"]["color"]


def main():
    strata, folder = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    if pages.missing():
        print(pages.missing())
        return pages.SKIPPED
    size = sum(os.path.getsize(os.path.join(folder, name)) for name in os.listdir(folder))
    driver = pages.browser("--disable-gpu", size="1280,1600")
    driver.set_script_timeout(300)
    page = Page(driver, strata)
    try:
        page.expect("at most 3.25 MiB", size <= 13 << 18, True)
        driver.get(serve(folder))
        page.wait()
        page.check_controls()
        page.check_access()
        if "STRATA_SCREENSHOTS" in os.environ:
            driver.save_screenshot(os.path.join(os.environ["STRATA_SCREENSHOTS"], "web.png"))
        page.check_digests()
        page.check_mistakes()
        page.check_model()
        page.expect("the console is empty", pages.console(driver), [])
    finally:
        driver.quit()
    print("\n".join(page.wrong))
    print(f"{page.compared} pictures and {page.refused} refusals of {len(SCENES)} scenes, {len(page.wrong)} wrong; the page has {size / 1024:.0f} KiB")
    return 1 if page.wrong else 0


if __name__ == "__main__":
    sys.exit(main())

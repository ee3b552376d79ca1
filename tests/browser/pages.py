"""Functions that the browser tests share: is Chromium installed, how is it started without a window, and checks for every page.

With STRATA_AXE=FILE (axe.min.js of the npm package axe-core) a page is also checked for accessibility.
"""
import os
import shutil

SKIPPED = 77


def missing():
    """The package that this machine lacks for a browser test, as a sentence; "" if nothing is missing."""
    try:
        import selenium  # noqa: F401
    except ImportError:
        return "SKIPPED: python3-selenium was not found"
    if not shutil.which("chromedriver") or not shutil.which("chromium"):
        return "SKIPPED: chromium or chromium-driver was not found"
    return ""


def skips():
    """Prints what is missing; returns True if the test must be skipped."""
    if missing():
        print(missing())
        return True
    if "STRATA_AXE" not in os.environ:
        print("SKIPPED: axe-core, for STRATA_AXE names no file")
    return False


def browser(*more, size="1280,1000", downloads=None):
    """Starts headless Chromium with additional command-line arguments."""
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    options = Options()
    for argument in ["--headless=new", "--no-sandbox", f"--window-size={size}", *more]:
        options.add_argument(argument)
    if downloads:
        options.add_experimental_option("prefs", {"download.default_directory": downloads})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))


def console(driver, *allowed):
    """Errors and warnings on the console, except those that contain one of the `allowed` words."""
    return [e["message"] for e in driver.get_log("browser")
            if e["level"] in ("SEVERE", "WARNING") and not any(word in e["message"] for word in allowed)]


def loaded(driver):
    """Addresses from which the page has loaded something other than itself."""
    names = driver.execute_script("return performance.getEntriesByType('resource').map((e) => e.name)")
    return [name for name in names if not name.startswith("data:")]


def violations(driver):
    """The rules of axe-core that the page violates; empty if STRATA_AXE is not set."""
    if "STRATA_AXE" not in os.environ:
        return []
    with open(os.environ["STRATA_AXE"], encoding="utf-8") as file:
        driver.execute_script(file.read())
    driver.set_script_timeout(120)
    return driver.execute_async_script(
        "const done = arguments[0]; axe.run().then((r) => done(r.violations.map((v) => v.id + ': ' + v.help)))")


def wait_until_ready(driver, seconds=60):
    from selenium.webdriver.support.ui import WebDriverWait
    WebDriverWait(driver, seconds).until(lambda d: d.execute_script("return document.body.dataset.ready"))

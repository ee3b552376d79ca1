"""What the tests in a browser share: whether there is one, Chromium without a window, and what must hold of every page.

With STRATA_AXE=FILE (axe.min.js of the npm package axe-core) a page is searched for what keeps people out.
"""
import os
import shutil

SKIPPED = 77


def missing():
    """What this machine lacks for such a test, as a sentence; "" if it has all."""
    try:
        import selenium  # noqa: F401
    except ImportError:
        return "SKIPPED: python3-selenium was not found"
    if not shutil.which("chromedriver") or not shutil.which("chromium"):
        return "SKIPPED: chromium or chromium-driver was not found"
    return ""


def skips():
    """Says what is missing. True if the test cannot run."""
    if missing():
        print(missing())
        return True
    if "STRATA_AXE" not in os.environ:
        print("SKIPPED: axe-core, for STRATA_AXE names no file")
    return False


def browser(*more, size="1280,1000", downloads=None):
    """Headless Chromium, with further arguments of its command line."""
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
    """Errors and warnings of the console but those that hold one of the `allowed` words."""
    return [e["message"] for e in driver.get_log("browser")
            if e["level"] in ("SEVERE", "WARNING") and not any(word in e["message"] for word in allowed)]


def loaded(driver):
    """What the page has fetched from anywhere but itself."""
    names = driver.execute_script("return performance.getEntriesByType('resource').map((e) => e.name)")
    return [name for name in names if not name.startswith("data:")]


def violations(driver):
    """Rules of axe-core that the page breaks; none where STRATA_AXE names no file."""
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

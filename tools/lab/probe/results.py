#!/usr/bin/env python3
"""Measures drivers and writes two pages: results.py BUILD [-o RESULTS.md] [--whole build/probe/RESULTS.md] [--browser FOLDER]

RESULTS.md is introduction.md and a row for each device; the whole page has every field of a profile with its evidence.
BUILD has strata and strata_port_probe (-DSTRATA_PORT=ON). FOLDER is the folder STRATA_KEEP of tests/browser/probe_page.py. Each device renders the
kit and twenty other scenes; its profile is inferred only from the kit, and predicts the twenty.
"""
import argparse
import json
import os
import subprocess
import tempfile

DRIVERS = ["llvmpipe", "llvmpipe_sse", "softpipe"]
UNSEEN = 20
HERE = os.path.dirname(os.path.abspath(__file__))


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, check=False)


def checked(*words):
    ended = run(*words)
    if ended.returncode != 0:
        raise SystemExit(f"{' '.join(words)}: {ended.stderr}")
    return ended.stdout


def measured(strata, kit_answers, unseen_answers, orientation, folder):
    """The inferred profile, and its results for the twenty scenes."""
    profile = os.path.join(folder, "profile.json")
    found = json.loads(checked(strata, "infer", kit_answers, "--y", orientation, "-o", profile, "--json"))
    beside = json.loads(run(strata, "probe", "--unseen", str(UNSEEN), "--y", orientation, "--profile", profile,
                            "--compare", unseen_answers, "--json").stdout)
    return found, beside["scenes"]


def states(found):
    rules = [f for f in found["fields"] if f["state"] != "stated" and not f["field"].startswith(("has_", "max_"))]
    return {s: [f["field"] for f in rules if f["state"] == s] for s in ("inferred", "broken", "open", "idle", "unprobed")}


def row(name, orientation, found, scenes):
    s = states(found)
    total = {key: sum(scene[key] for scene in scenes) for key in ("pixels", "coverage_differ", "depth_differ", "color_differ")}
    share = f"{len(s['inferred'])} of {sum(len(s[k]) for k in ('inferred', 'broken', 'open'))}"
    return (f"| {name} | {orientation} | {share} | {found['agree']:,} of {found['pixels']:,} | {total['pixels']:,} | "
            f"{total['coverage_differ']:,} | {total['depth_differ']:,} | {total['color_differ']:,} |")


def details(name, orientation, found):
    s = states(found)
    lines = [f"### {name}, {orientation}", "", "| field | value | state | evidence | runners-up |", "|---|---|---|---|---|"]
    for f in found["fields"]:
        if f["state"] in ("inferred", "broken"):
            others = ", ".join(f"{v['value']} {v['agree']:,}" for v in f["runners_up"][:2])
            lines.append(f"| {f['field']} | {f['value']} | {f['state']} | {f['agree']:,} of {f['places']:,} | {others} |")
    lines += ["", "Open: " + ("; ".join(f"{f['field']} ({f['reason']})" for f in found["fields"] if f["state"] == "open") or "none") + ".",
              "No effect beside the others: " + (", ".join(s["idle"]) or "none") + "."]
    if found["unexplained"]:
        lines += ["", "| not explained | pixels that differ | the change that explains most, and the pixels that still differ |", "|---|---|---|"]
        for u in found["unexplained"]:
            nearest = f"{u['nearest']}: {u['left']:,}" if u["nearest"] else "none explains more"
            lines.append(f"| {u['scene']} | {u['differ']:,} of {u['pixels']:,} | {nearest} |")
    if found["not_drawn"]:
        lines += ["", "Not rendered: " + "; ".join(f"{n['scene']} ({n['reason']})" for n in found["not_drawn"]) + "."]
    return lines + [""]


DEVICE_HEAD = ["| device | +y | fields inferred | pixels of the kit that agree | pixels of 20 other scenes | coverage differs | depth differs | colour differs |",
               "|---|---|---|---|---|---|---|---|"]
HOW = """
## The whole table

    tools/lab/probe/results.py build/release --browser ANSWERS

The command needs `strata_port_probe` (`-DSTRATA_PORT=ON`); ANSWERS is the folder STRATA_KEEP of `tests/browser/probe_page.py`. It also writes
`build/probe/RESULTS.md` with each field of each profile, its evidence and the next best values.
"""


def write_pages(short, whole, rows, pages):
    with open(os.path.join(HERE, "introduction.md"), encoding="utf-8") as file:
        head = file.read()
    with open(short, "w", encoding="utf-8") as file:
        file.write("\n".join([head, *DEVICE_HEAD, *rows, HOW]))
    os.makedirs(os.path.dirname(os.path.abspath(whole)), exist_ok=True)
    with open(whole, "w", encoding="utf-8") as file:
        file.write("\n".join(["# The probe kit on software drivers, field by field", "", *DEVICE_HEAD, *rows, "", "## Field by field", "", *pages]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("-o", "--output", default=os.path.join(HERE, "RESULTS.md"))
    parser.add_argument("--whole", default=os.path.join(HERE, "..", "..", "build", "probe", "RESULTS.md"))
    parser.add_argument("--browser")
    options = parser.parse_args()
    strata, client = (os.path.join(options.build, name) for name in ("strata", "strata_port_probe"))
    rows, pages = [], []
    with tempfile.TemporaryDirectory() as folder:
        kit, unseen = os.path.join(folder, "kit"), os.path.join(folder, "unseen")
        checked(strata, "probe", "-o", kit)
        checked(strata, "probe", "--unseen", str(UNSEEN), "-o", unseen)
        devices = []
        for driver in DRIVERS:
            answers = [os.path.join(folder, f"{driver}.{k}") for k in ("kit", "unseen")]
            checked(client, kit, "-o", answers[0], "--driver", driver)
            checked(client, unseen, "-o", answers[1], "--driver", driver)
            devices += [(driver, y, *answers) for y in ("up", "down")]
        if options.browser:
            archives = [os.path.join(options.browser, k, "answers.tar") for k in ("kit", "unseen")]
            devices.append(("Chromium's WebGL 2", "down", *archives))
        for name, orientation, *answers in devices:
            found, scenes = measured(strata, *answers, orientation, folder)
            rows.append(row(name, orientation, found, scenes))
            pages += details(name, orientation, found)
    write_pages(options.output, options.whole, rows, pages)


if __name__ == "__main__":
    main()

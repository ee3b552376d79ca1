#!/usr/bin/env python3
"""Puts what was found, a picture of all verdicts, and what was asked, at the head of the page that `strata hard-cases` wrote.

usage: page.py FOLDER -o RESULTS.md

The picture is RESULTS.verdicts.svg beside the page.

Counts lines of results.jsonl, pictures, and sentences of the page; processor_seconds is what make_page.sh noted of its shards.
"""
import argparse
import glob
import json
import os
from collections import Counter

import verdict_map

UNSTABLE = ("a peel that compares with < for <= is called failed and unstable, planes anchored at the window's corner unstable: "
            '`hard_cases_test "*peel that compares*,planes anchored*"`')


def content_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return file.read()


def is_excess(line):
    return max(line["difference"], line["difference_at_ties"]) > line["bound"]


def ties(lines, depth):
    """Of planes-1-unit on ideal: pixels where two depths are one."""
    return next(line["fragments"]["tied_pixels"] for line in lines if (line["case"], line["profile"], line["depth"], line["algorithm"])
                == ("planes-1-unit", "ideal", depth, "front_to_back"))


def minutes(folder):
    path = os.path.join(folder, "processor_seconds")
    if not os.path.exists(path):
        return "not noted"
    return f"{sum(float(line) for line in content_of(folder, 'processor_seconds').split()) / 60:.1f} minutes of processor time in two shards"


def share(some, all_of):
    return f"{100 * some / all_of:.0f} %"


def found_of_verdicts(ran):
    verdicts = Counter(line["verdict"] for line in ran)
    return (f"Of {len(ran)} combinations of case, algorithm, device and depth format {verdicts['failed'] or 'none'} failed: "
            f"{verdicts['stable']} are stable, {verdicts['degrades gracefully']} degrade gracefully, and "
            f"{verdicts['breaks as the hardware did']} break as the hardware did, which a diagnostic says.")


def found_of_algorithms(ran):
    tried = Counter(line["algorithm"] for line in ran)
    broken = Counter(line["algorithm"] for line in ran if line["verdict"] in ("breaks as the hardware did", "failed"))
    ranked = sorted(tried, key=lambda name: (broken[name] / tried[name], name))
    never = [name for name in ranked if broken[name] == 0]
    most = [f"{name} ({share(broken[name], tried[name])})" for name in ranked[:-4:-1]]
    return f"Never broken are {', '.join(never) or 'none'}; most often broken are {', '.join(most)}."


def found_of_flicker(ran):
    """Flips in layer order along the path of 64 frames, with depth_units, which every device can run."""
    flips, rows = Counter(), Counter()
    for line in ran:
        if line["flicker"] and line["depth"] == "d24" and line["algorithm"] == "depth_units":
            flips[line["profile"]] += line["flicker"]["order"]
            rows[line["profile"]] += 1
    figures = ", ".join(f"{flips[name] / rows[name]:.0f} times on {name}" for name in rows)
    return f"Along a camera path depth_units at D24 flips layers where exact geometry does not, a case {figures}."


def asked_and_found(folder, page, lines):
    ran = [line for line in lines if line["outcome"] == "done"]

    def of(key):
        return len({line[key] for line in lines})

    failed = [line for line in ran if line["verdict"] == "failed"]
    wrong = [line for line in ran if line["fragments"]["wrong_pixels"] > 0]
    excess = [line for line in ran if is_excess(line)]
    yield "at least 50 cases by all algorithms on four devices", (
        f"{of('case')} cases by {of('algorithm')} algorithms on {of('profile')} devices at {of('depth')} depth formats: {len(ran)} ran, "
        f"{len(lines) - len(ran)} are refused by a sentence, {len(failed)} failed")
    yield "(a) no NaN that was not put in", f"{sum(line['nan_values'] > 0 for line in failed)} of {len(ran)} combinations have one"
    yield "(b) every fragment once, or the fault named with its pixels", (
        f"{len(wrong)} combinations lose, repeat or misplace fragments; {sum(line['verdict'] != 'failed' for line in wrong)} of them have "
        "a diagnostic of exactly as many pixels")
    beyond = Counter(line["verdict"] for line in excess)
    yield "(c) within the bound that the case states", (
        f"{len(ran) - len(excess)} of {len(ran)} combinations are within it; of the {len(excess)} beyond, "
        f"{beyond['breaks as the hardware did']} break with a diagnostic that says why, "
        f"{beyond['degrades gracefully']} degrade (no order is "
        f"promised, keys are equal, or the device steps its planes), {beyond['stable']} differ only where two true depths are equal, which "
        f"leaves their order open, and {beyond['failed']} have no reason")
    yield "(f) the same bits in every way of running, for every case, algorithm, device and depth format", (
        f"{sum(bool(line['unlike']) for line in ran)} of {len(ran)} combinations have others; each runs literally, on two threads, with "
        "all effects, and on each instruction set, up to 4,000 layers at 8 x 8")
    yield "a picture a case, by one command", (
        f"{len(glob.glob(os.path.join(folder, 'pictures', '*.png')))} pictures by `make_page.sh`; a case that every device refuses has none")
    yield "at least 10 cases: amplification and flicker of two devices side by side, and why they differ", (
        f"{page.count('The reason:')} sections")
    yield "what is unstable on purpose is called so", UNSTABLE
    yield "a figure that contradicts what one expects", (
        f"`planes-1-unit` on ideal: {ties(lines, 'd32f')} pixels tie in a binary32 buffer and {ties(lines, 'd24')} in one of 24 bits; why, "
        "and four more, stands in [README.md](README.md)")
    yield "(d), (e) and all the above within 30 minutes on two cores", minutes(folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("-o", dest="page", required=True)
    words = parser.parse_args()
    page = content_of(words.folder, "RESULTS.md")
    lines = [json.loads(line) for line in content_of(words.folder, "results.jsonl").splitlines()]
    ran = [line for line in lines if line["outcome"] == "done"]
    title, rest = page.split("\n", 1)
    method, rest = rest.split("\n\n", 1)
    found = " ".join([found_of_verdicts(ran), found_of_algorithms(ran), found_of_flicker(ran)])
    picture = os.path.splitext(words.page)[0] + ".verdicts.svg"
    verdict_map.write_map(lines, picture)
    shown = f"![the worst verdict of each case by each algorithm on each device]({os.path.basename(picture)})"
    table = ["| asked | found |", "|---|---|", *(f"| {asked} | {found} |" for asked, found in asked_and_found(words.folder, page, lines))]
    with open(words.page, "w", encoding="utf-8") as file:
        file.write("\n\n".join([title, found, shown, method, "\n".join(table), rest]))


if __name__ == "__main__":
    main()

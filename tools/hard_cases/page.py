#!/usr/bin/env python3
"""Puts what was asked and what was found at the head of the page that `strata hard-cases` wrote.

usage: page.py FOLDER -o RESULTS.md

Counts lines of results.jsonl, pictures, and sentences of the page; processor_seconds is what make_page.sh noted of its shards.
"""
import argparse
import glob
import json
import os

DEEP = "Not run here with "
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


def asked_and_found(folder, page):
    lines = [json.loads(line) for line in content_of(folder, "results.jsonl").splitlines()]
    ran = [line for line in lines if line["outcome"] == "done"]

    def of(key):
        return len({line[key] for line in lines})

    failed = [line for line in ran if line["verdict"] == "failed"]
    wrong = [line for line in ran if line["fragments"]["wrong_pixels"] > 0]
    excess = [line for line in ran if is_excess(line)]
    deep = [part.split("\n", 1)[0] for part in page.split("\n## ")[1:] if DEEP in part]
    yield "at least 50 cases by all algorithms on four devices", (
        f"{of('case')} cases by {of('algorithm')} algorithms on {of('profile')} devices at {of('depth')} depth formats: {len(ran)} ran, "
        f"{len(lines) - len(ran)} are refused by a sentence, {len(failed)} failed")
    yield "(a) no NaN that was not put in", f"{sum(line['nan_values'] > 0 for line in failed)} of {len(ran)} combinations have one"
    yield "(b) every fragment once, or the fault named with its pixels", (
        f"{len(wrong)} combinations lose, repeat or misplace fragments; {sum(line['verdict'] != 'failed' for line in wrong)} of them have "
        "a diagnostic of exactly as many pixels")
    yield "(c) within the bound that the case states", (
        f"{len(ran) - len(excess)} are; {sum(line['verdict'] != 'failed' for line in excess)} of the other {len(excess)} have a reason: a "
        "diagnostic, no promise of order, or planes that the device steps")
    yield "(f) the same bits in every way of running", (
        f"{sum(bool(line['unlike']) for line in ran)} combinations have others; too deep for some ways, which their sections name: "
        + ", ".join(deep))
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
    head, rest = page.split("\n\n", 1)
    table = ["| asked | found |", "|---|---|", *(f"| {asked} | {found} |" for asked, found in asked_and_found(words.folder, page))]
    with open(words.page, "w", encoding="utf-8") as file:
        file.write("\n\n".join([head, "\n".join(table), rest]))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Writes the short page of the hard cases and its picture, from the folder that `strata hard-cases` wrote.

usage: page.py FOLDER -o RESULTS.md

RESULTS.md has at most 600 words; the picture, RESULTS.verdicts.svg, is in its folder.
"""
import argparse
import os
import pathlib
import sys
from collections import Counter

import verdict_map

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import pages  # noqa: E402

VERDICTS = ("stable", "degrades gracefully", "breaks as the hardware did", "failed", "refused")


def is_excess(line):
    return max(line["difference"], line["difference_at_ties"]) > line["bound"]


def minutes(folder):
    """Of all rows, on one processor."""
    return f"{sum(line['seconds'] for line in pages.lines_in(os.path.join(folder, 'timings.jsonl'))) / 60:.0f}"


def share(some, all_of):
    return f"{100 * some / all_of:.0f} %"


def verdict_rows(lines):
    """A row of counts for each device: how often each verdict was given."""
    yield "| device | " + " | ".join(VERDICTS) + " |"
    yield "|---" + "|---:" * len(VERDICTS) + "|"
    for profile in dict.fromkeys(line["profile"] for line in lines):
        counts = Counter(line["verdict"] if line["outcome"] == "done" else "refused" for line in lines if line["profile"] == profile)
        yield f"| {profile} | " + " | ".join(f"{counts[verdict]:,}" for verdict in VERDICTS) + " |"


def sentence_on_algorithms(ran):
    tried = Counter(line["algorithm"] for line in ran)
    broken = Counter(line["algorithm"] for line in ran if line["verdict"] in ("breaks as the hardware did", "failed"))
    ranked = sorted(tried, key=lambda name: (broken[name] / tried[name], name))
    never = [f"`{name}`" for name in ranked if broken[name] == 0]
    most = [f"`{name}` ({share(broken[name], tried[name])} of its cells)" for name in ranked[:-4:-1] if broken[name] > 0]
    return f"Algorithms that never break: {', '.join(never) or 'none'}. Those that break most often: {', '.join(most) or 'none'}."


def sentence_on_flicker(ran):
    """The changes of layer order along the path of 64 frames, with depth_units, which every device supports."""
    flips, rows = Counter(), Counter()
    for line in ran:
        if line["flicker"] and line["depth"] == "d24" and line["algorithm"] == "depth_units":
            flips[line["profile"]] += line["flicker"]["order"]
            rows[line["profile"]] += 1
    figures = ", ".join(f"{name} {flips[name] / rows[name]:,.0f}" for name in rows)
    return ("Along a camera path of 64 frames, `depth_units` at D24 changes the order of two layers where exact geometry does not. Changes per case, on average: "
            f"{figures}.")


def check_rows(lines):
    """The properties that must hold in every cell, and the number of cells in which they do not."""
    ran = [line for line in lines if line["outcome"] == "done"]
    wrong = [line for line in ran if line["fragments"]["wrong_pixels"] > 0]
    excess = [line for line in ran if is_excess(line)]
    beyond = Counter(line["verdict"] for line in excess)
    of_all = f"of {len(ran):,} cells"
    yield "| property | result |"
    yield "|---|---|"
    yield f"| no NaN unless the scene has one | violated in {sum(line['nan_values'] > 0 for line in ran if line['verdict'] == 'failed')} {of_all} |"
    yield ("| every fragment is composited once, or a diagnostic counts the wrong pixels | "
           f"{len(wrong)} {of_all} lose, repeat or misplace fragments; {sum(line['verdict'] != 'failed' for line in wrong)} of these are diagnosed at every wrong pixel |")
    yield (f"| colours stay within the error bound of the case | {len(excess):,} {of_all} exceed it: {beyond['breaks as the hardware did']:,} break with a "
           f"diagnostic, {beyond['degrades gracefully']:,} degrade, {beyond['stable']} differ only at equal depths, {beyond['failed']} are unexplained |")
    yield ("| the same bits in literal execution, on two threads, with all effects and with every instruction set | "
           f"violated in {sum(bool(line['unlike']) for line in ran)} {of_all} |")


def page_of(folder, lines, picture):
    ran = [line for line in lines if line["outcome"] == "done"]

    def of(key):
        return len({line[key] for line in lines})

    return "\n".join([
        "# Results: scenes on which rasterizers and depth peels break", "",
        "Does a peel still give the right picture where geometry is degenerate, depths nearly or exactly coincide, coordinates are extreme, or counts",
        f"exceed their range? `strata hard-cases` renders {of('case')} small scenes, each with a known right answer, by {of('algorithm')} algorithms on",
        f"{of('profile')} devices, which it emulates on a CPU, with {of('depth')} depth formats: {len(ran):,} cells; {len(lines) - len(ran):,} further cells are refused because the device lacks a",
        "feature. `layer-ladder`, `counts-past-2048` and `frame-8192x8192` are left out: each takes minutes to half an hour, or 6 GiB, and has a command of",
        "its own ([README.md](README.md)).", "",
        f"![the worst verdict of each case by each algorithm on each device]({picture})", "",
        "*Degrades gracefully*: every fragment is composited once, but rounding gives the device other fragments or another order than exact",
        "geometry has, or the algorithm guarantees no order. *Breaks as the hardware did*: fragments are lost, repeated or out of order, and a",
        "diagnostic counts the pixels. *Failed*: the same without a diagnostic, a NaN, or bits that depend on threads, execution or instruction",
        "set. *Stable*: none of these.", "",
        *verdict_rows(lines), "",
        sentence_on_algorithms(ran), "", sentence_on_flicker(ran), "",
        *check_rows(lines), "",
        "Unexpected results, for instance that a 24-bit buffer can separate two planes that a binary32 buffer cannot, are explained in",
        "[FINDINGS.md](FINDINGS.md).", "",
        "## The whole table", "",
        "    tools/lab/hard_cases/make_page.sh", "",
        f"The command takes {minutes(folder)} minutes on one processor and writes this page. It also writes `build/hard_cases/RESULTS.html` with a section for every",
        "case (the picture, the right answer, the verdicts, an example of each fault, and the tables of moved geometry and of the camera path), and",
        "`build/hard_cases/results.csv` with a row for each combination.", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("-o", dest="page", required=True)
    words = parser.parse_args()
    lines = pages.lines_in(os.path.join(words.folder, "results.jsonl"))
    picture = os.path.splitext(words.page)[0] + ".verdicts.svg"
    verdict_map.write_map(lines, picture)
    with open(words.page, "w", encoding="utf-8") as file:
        file.write(page_of(words.folder, lines, os.path.basename(picture)))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Makes the short page and its plot from the table of suites that `strata hardware-check -o` wrote: head.py TABLE.md RESULTS.svg.

The page, at most 600 words, is printed.
"""
import os
import sys

COLORS = {"equal": "#2a7f3f", "within bound": "#e0a030", "differ": "#c03030", "not modelled": "#a0a0a0"}
LINE, LEFT, UNIT = 15, 260, 14


def suites_of(path):
    """Name; numbers of pictures that are equal, within their bound, beyond it and not modelled; pixels compared and different; the largest
    difference."""
    found, inside = [], False
    with open(path, encoding="utf-8") as file:
        for line in file:
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if cells[:2] == ["suite", "pictures"]:
                inside = True
            elif inside and not line.startswith("|"):
                break
            elif inside and cells[1].isdigit():
                found.append((cells[0], [int(cell) for cell in cells[2:6]], *map(int, cells[6:9])))
    if not found:
        raise SystemExit(f"{path}: expected a table of suites, found none")
    return found


def plot(suites):
    height = LINE * (len(suites) + 2)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="800" height="{height}" font-family="sans-serif" font-size="11">',
             f'<rect width="800" height="{height}" fill="white"/>']
    place = LEFT
    for name, color in COLORS.items():
        parts.append(f'<rect x="{place}" y="4" width="10" height="10" fill="{color}"/><text x="{place + 14}" y="13">{name}</text>')
        place += 110
    for row, (name, counts, *_) in enumerate(suites, 1):
        top, place = LINE * row + 8, LEFT
        parts.append(f'<text x="{LEFT - 6}" y="{top + 10}" text-anchor="end">{name}</text>')
        scale = min(UNIT, (790 - LEFT) / max(sum(counts) for _, counts, *_ in suites))
        for count, color in zip(counts, COLORS.values()):
            parts.append(f'<rect x="{place:g}" y="{top}" width="{count * scale:g}" height="{LINE - 3}" fill="{color}"/>')
            place += count * scale
    return "\n".join(parts + ["</svg>", ""])


def row(name, suites):
    pictures = [sum(counts[i] for _, counts, *_ in suites) for i in range(4)]
    pixels, off = (sum(suite[i] for suite in suites) for i in (2, 3))
    figures = [sum(pictures), *pictures, pixels, off, max(suite[4] for suite in suites)]
    return f"| {name} | " + " | ".join(f"{figure:,}" for figure in figures) + " |"


def table(suites):
    """A row for each suite with a picture that is not equal, and one for all others."""
    yield "| suite | pictures | equal | within bound | outside | not modelled | pixels compared | pixels that differ | largest difference |"
    yield "|---" + "|---:" * 8 + "|"
    equal = [suite for suite in suites if not any(suite[1][1:])]
    yield from (row(suite[0], [suite]) for suite in suites if any(suite[1][1:]))
    if equal:
        yield row(f"{len(equal)} other suites", equal)


def page(suites, unknown_suites, plot_name):
    equal, within, differ, unknown = (sum(counts[i] for _, counts, *_ in suites) for i in range(4))
    pixels, off = (sum(suite[i] for suite in suites) for i in (2, 3))
    return "\n".join([
        "# The profile geforce3 against a real chip", "",
        "Does the profile `geforce3` give the same bits as a chip of that generation? `strata hardware-check` renders the pictures of a public test suite",
        "from their names alone, and compares every pixel outside the labels with captures of an NV2A, the GeForce3-class GPU of the Xbox",
        "(abaire/nxdk_pgraph_tests_golden_results, CC0 1.0).", "",
        f"Of {equal + within + differ + unknown} captures {equal} are equal in every bit, {within} are within the bound of their suite, and {differ} are outside. {unknown} show features that are not",
        f"modelled. Of {pixels:,} compared pixels {off:,} differ. {len(unknown_suites)} further suites, with {sum(sum(s[1]) for s in unknown_suites)} captures, show no modelled feature.", "",
        f"![Pictures by suite: equal, within their bound, outside, not modelled]({plot_name})", "",
        *table(suites), "",
        "Differences are in codes of a colour channel or of the stored depth. *Within bound*: few pixels differ, by few codes, and the cause is known",
        "except for its last bits; the bounds are in [suites](suites). *Outside*: the w buffer with a slope or with float depth, the last bits of whose",
        "weights are not known. [open_questions.md](open_questions.md) lists what is not known, and what was tried.", "",
        "The captures are not in this repository. `tests/tools/hardware_check/hardware_digests.txt` has a digest of each equal picture, which tests",
        "compare with the picture of the present profile.", "",
        "## The whole table", "",
        "    tools/hardware_check/make_page.sh CAPTURES", "",
        "CAPTURES has the files SUITE/NAME.png of the archive, or some of them. The command writes this page, and `build/hardware_check/RESULTS.md` with",
        "the subject of each suite, the first different pixel of every picture that is not equal, and each rule of the profile compared with its",
        "alternatives."])


def main():
    found = suites_of(sys.argv[1])
    suites = [suite for suite in found if any(suite[1][:3])]
    print(page(suites, [suite for suite in found if suite not in suites], os.path.basename(sys.argv[2])))
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(plot(suites))
    return 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""The first sentences and the plot of RESULTS.md, from the table of its suites: head.py TABLE.md RESULTS.svg; the sentences are printed."""
import sys

COLORS = {"equal": "#2a7f3f", "within bound": "#e0a030", "differ": "#c03030", "not modelled": "#a0a0a0"}
LINE, LEFT, UNIT = 15, 260, 14


def suites_of(path):
    """Name, and how many pictures are equal, within their bound, differ and are not modelled, and the pixels compared and off."""
    found, inside = [], False
    with open(path, encoding="utf-8") as file:
        for line in file:
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if cells[:2] == ["suite", "pictures"]:
                inside = True
            elif inside and not line.startswith("|"):
                break
            elif inside and cells[1].isdigit():
                found.append((cells[0], [int(cell) for cell in cells[2:6]], int(cells[6]), int(cells[7])))
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
    for row, (name, counts, _, _) in enumerate(suites, 1):
        top, place = LINE * row + 8, LEFT
        parts.append(f'<text x="{LEFT - 6}" y="{top + 10}" text-anchor="end">{name}</text>')
        scale = min(UNIT, (790 - LEFT) / max(sum(counts) for _, counts, _, _ in suites))
        for count, color in zip(counts, COLORS.values()):
            parts.append(f'<rect x="{place:g}" y="{top}" width="{count * scale:g}" height="{LINE - 3}" fill="{color}"/>')
            place += count * scale
    return "\n".join(parts + ["</svg>", ""])


def main():
    suites = suites_of(sys.argv[1])
    equal, within, differ, unknown = (sum(counts[i] for _, counts, _, _ in suites) for i in range(4))
    pixels, off = (sum(suite[i] for suite in suites) for i in (2, 3))
    print(f"Of {equal + within + differ + unknown} pictures that a real chip drew, {equal} come out equal in every bit, {within} within the bounds below, {differ} beyond them.\n"
          f"{unknown} show what is not modelled; each is named below with the reason. Of {pixels:,} pixels compared {off:,} differ.\n\n"
          "![Pictures by suite: equal, within their bound, beyond it, not modelled](RESULTS.svg)\n")
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(plot(suites))
    return 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Writes tools/port/BLIND.md: what `strata diagnose` says of mistakes of the port that a seed draws, on scenes that the seed draws, too.

    tools/port/blind.py SEED [--driver llvmpipe]

Drawn are 15 single mistakes that the catalogue has, 5 that it has not, and 5 pairs of such as it has; for each a scene with its size, formats,
background and opacity. A scene is drawn again while the port's own picture of it does not change: the oracle is not asked for that, and its
answers change nothing. The diagnosis has the pack and the candidate's files alone. No row is left out or made again. Exit status 1: a
right port is not named right.
"""
import argparse
import json
import pathlib
import random
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
import mistaken  # noqa: E402
import packs  # noqa: E402

HERE, ROOT = mistaken.HERE, mistaken.ROOT
DRAWS = 30  # scenes for one mistake at most
SINGLE, OUTSIDE, PAIRS = 15, 5, 5


def scene_of(draw):
    """A scene's words, by the generator alone."""
    width, height = draw.randrange(24, 73), draw.randrange(20, 57)
    kind = draw.choice(["random", "random", "random", "teapot", "planes", "coincident", "close", "opaque", "deep"])
    if kind == "deep":  # more layers than a byte counts
        width, height = draw.randrange(4, 9), draw.randrange(4, 9)
    words = {"random": [f"random:seed={draw.randrange(1000)},triangles={draw.randrange(20, 121)}"],
             "teapot": ["teapot", "--alpha", f"0.{draw.randrange(2, 9)}"],
             "planes": [f"planes:count={draw.randrange(2, 9)}"],
             "coincident": ["hard:case=coincident"],
             "close": [f"hard:case={draw.choice(['planes-1-unit-of-16-bits', 'planes-8-close'])}"],
             "opaque": ["hard:case=opaque-crossing"],
             "deep": [f"volume-beam:slices={draw.randrange(200, 321)},order={draw.choice(['near', 'far'])}"]}[kind]
    words += ["--size", f"{width}x{height}", "--depth", draw.choice(["d24", "d32f"])]
    words += ["--color-format", draw.choice(["rgba8", "rgba8", "rgba16f"])]
    if draw.randrange(2) == 1:
        words += ["--background", ",".join(f"0.{draw.randrange(10)}" for _ in range(3))]
    return words


def drawn_cases(draw, known):
    """(names, algorithm) of each case: the port's own list says which algorithm shows a mistake."""
    algorithm = {name: shows for name, shows, _ in known}
    inside = [name for name, _, _ in known if name in mistaken.NAMES]
    outside = [name for name, _, _ in known if name not in mistaken.NAMES]
    cases = [("single", (name,)) for name in draw.sample(inside, SINGLE)]
    cases += [("outside", (name,)) for name in draw.sample(outside, OUTSIDE)]
    while len(cases) < SINGLE + OUTSIDE + PAIRS:
        pair = tuple(draw.sample(inside, 2))
        if algorithm[pair[0]] == algorithm[pair[1]] and ("pair", pair) not in cases and ("pair", pair[::-1]) not in cases:
            cases.append(("pair", pair))
    return [(kind, names, algorithm[names[0]]) for kind, names in cases]


class Bench:
    def __init__(self, build, folder, driver):
        self.build, self.folder, self.driver = build, folder, driver
        self.profile, self.number = packs.profile_file(folder, driver), 0

    def pack(self, words, algorithm):
        self.number += 1
        return packs.Pack(self.build, self.folder / f"pack{self.number}", words, self.profile, [algorithm])

    def candidate(self, pack, names, algorithm, picture_only):
        """A folder with what the port makes; the last one is gone."""
        folder = self.folder / "candidate"
        shutil.rmtree(folder, ignore_errors=True)
        return pack.candidate(folder, self.driver, ",".join(names), [algorithm], picture_only=picture_only)

    def picture(self, pack, names, algorithm):
        return (self.candidate(pack, names, algorithm, True) / algorithm / "picture.npy").read_bytes()

    def diagnose(self, pack, names, algorithm):
        candidate = self.candidate(pack, names, algorithm, False)
        words = [self.build / "strata", "diagnose", pack.folder, candidate, "--algorithm", algorithm, "--json", *packs.GIVES_UP]
        return json.loads(packs.run(words, allowed=(0, 1)))


def find_scene(bench, draw, names, algorithm):
    """A pack on which the port's picture changes with each of the mistakes, and with both of two as with neither alone; and how many
    scenes were drawn for it. Or None."""
    for tries in range(1, DRAWS + 1):
        words = scene_of(draw)
        try:
            pack = bench.pack(words, algorithm)
            ways = {(), names, *((name,) for name in names)}
            pictures = {bench.picture(pack, way, algorithm) for way in sorted(ways)}
        except packs.Failed:  # the profile or the port does not have this combination
            continue
        if len(pictures) == len(ways):
            return pack, words, tries
        shutil.rmtree(pack.folder)
    return None


def judged(kind, names, said):
    """first: named first. beside: another one that leaves the same output is named first. yes of those that the catalogue has not: none of
    mine. same output: what is named leaves this output to the last code. ranked first: the right one, but it leaves pixels unexplained."""
    best, unknown = said["findings"][0], said["verdict"] == "none_of_mine"
    if kind == "outside":
        return "none of mine" if unknown else "same output" if best["explained"] == said["differing"] else "no"
    known = [mistaken.NAMES[name] for name in names]
    def holds(found):
        return all(any(answer in found for answer in answers) for answers in known)
    if holds(best["mistakes"]) and len(best["mistakes"]) == len(names):
        return "ranked first" if unknown else "first"
    # Others beside the first that leave this picture and agree as far with the passes.
    beside = [found["mistakes"] for found in said["findings"] if found["agreeing"] == said["pixels"] and found["passes"] == best["passes"]]
    if not unknown and any(len(found) == len(names) and holds(found) for found in [*([m] for m in best["alike"]), *beside]):
        return "beside"
    return "no" if unknown or best["explained"] != said["differing"] else "same output"


def page(seed, driver, renderer, rows, right, drawn):
    def count(kind, *answers):
        return f"{sum(r[0] == kind and r[-1] in answers for r in rows)} of {sum(r[0] == kind for r in rows)}"

    lines = ["# Mistakes drawn by a seed", "",
             f"Made by `tools/port/blind.py {seed}` on {renderer}. The seed draws the mistakes and the scenes (the script says how); the oracle has the pack and",
             "what the port wrote, its passes and layers included. The figure is as it fell: no row was left out or made again, and no scene was chosen by hand.",
             f"A mistake that none of {DRAWS} scenes shows counts as not answered.", "",
             "| | answered rightly | of these named first, or as none of mine | beside another one that leaves the same output | another one is named, which leaves the same output |",
             "|---|---|---|---|---|"]
    for kind, words in (("single", "single mistakes that the catalogue has"), ("outside", "single mistakes that it has not"), ("pair", "pairs")):
        lines.append(f"| {words} | {count(kind, 'first', 'beside', 'none of mine')} | {count(kind, 'first', 'none of mine')} | {count(kind, 'beside')} | {count(kind, 'same output')} |")
    lines += ["", f"The right port is named right on {right} of these scenes. Scenes drawn: {drawn}.", "",
              "| kind | mistake | algorithm | scene | verdict | named first | explains | first class of pixels | answer |", "|" + "---|" * 9]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seed", type=int)
    parser.add_argument("--build", default=str(ROOT / "build/release"), help="where strata and strata_port are")
    parser.add_argument("--driver", default="llvmpipe", help="whose profile has the same name")
    parser.add_argument("--out", default=str(HERE / "BLIND.md"))
    options = parser.parse_args()
    print("seed", options.seed, flush=True)
    draw, build = random.Random(options.seed), pathlib.Path(options.build)
    rows, right, wrong, drawn, renderer = [], 0, 0, 0, options.driver
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(build, pathlib.Path(folder), options.driver)
        for kind, names, algorithm in drawn_cases(draw, mistaken.listed(build)):
            found = find_scene(bench, draw, names, algorithm)
            if found is None:
                rows.append([kind, ", ".join(names), algorithm, f"none of {DRAWS} shows it", "", "", "", "", "not shown"])
                print(*rows[-1], sep=" | ", flush=True)
                continue
            pack, words, tries = found
            drawn += tries
            said = bench.diagnose(pack, (), algorithm)
            is_right = said["verdict"] == "right"
            right, wrong = right + is_right, wrong + (not is_right)
            said = bench.diagnose(pack, names, algorithm)
            renderer = json.loads((bench.folder / "candidate/candidate.json").read_text())["made_by"].removeprefix("strata_port, ")
            best, kinds = said["findings"][0], said["comparison"]["kinds"]
            first = f"{kinds[0]['kind']} {kinds[0]['pixels']}" if kinds else ""
            rows.append([kind, ", ".join(names), algorithm, " ".join(words), said["verdict"].replace("_", " "), ", ".join(best["mistakes"]),
                         f"{best['explained']} of {said['differing']}", first, judged(kind, names, said)])
            print(*rows[-1], sep=" | ", flush=True)
            shutil.rmtree(pack.folder)
    pathlib.Path(options.out).write_text(page(options.seed, options.driver, renderer, rows, f"{right} of {right + wrong}", drawn))
    return 0 if wrong == 0 else 1


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Writes tools/port/mistakes/BLIND.md: the diagnoses of `strata diagnose` for mistakes of the port and scenes that are both chosen at random.

    tools/port/mistakes/blind.py SEED [--driver llvmpipe]

The seed chooses 15 single mistakes of the catalogue, 5 that are not in it, and 5 pairs of mistakes of the catalogue; and for each three scenes with
sizes, formats, backgrounds and opacities, because the author of a port has several. A scene is replaced if the mistake does not change the port's own
picture of it; the oracle has no influence on this. A mistake that fewer than three of 30 scenes show is listed, and replaced by another one. The
diagnosis is given only the packs and the candidates' files. No row is omitted or repeated. Exit status 1: a right port is not called right.
"""
import argparse
import json
import pathlib
import random
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
import mistaken  # noqa: E402  adds the folder of packs
import packs  # noqa: E402

HERE, ROOT = mistaken.HERE, mistaken.ROOT
SCENES = 3
DRAWS = 30  # scenes for one mistake at most
WANTED = {"single": 15, "outside": 5, "pair": 5}


def scene_of(draw):
    """The command-line words of a random scene."""
    width, height = draw.randrange(24, 73), draw.randrange(20, 57)
    kind = draw.choice(["random", "random", "random", "teapot", "planes", "coincident", "close", "opaque", "deep"])
    if kind == "deep":  # more layers than a byte can count
        width, height = draw.randrange(4, 9), draw.randrange(4, 9)
    words = {"random": [f"random:seed={draw.randrange(1000)},triangles={draw.randrange(20, 121)}"],
             "teapot": ["teapot", "--alpha", f"0.{draw.randrange(2, 9)}"],
             "planes": [f"planes:count={draw.randrange(2, 9)}"],
             "coincident": ["hard:case=coincident"],
             "close": [f"hard:case={draw.choice(['planes-1-unit-of-16-bits', 'planes-8-close'])}"],
             "opaque": ["hard:case=opaque-crossing"],
             "deep": [f"volume-beam:slices={draw.randrange(200, 321)},order={draw.choice(['near', 'far'])}"]}[kind]
    words += ["--size", f"{width}x{height}", "--depth-format", draw.choice(["d24", "d32f"])]
    words += ["--color-format", draw.choice(["rgba8", "rgba8", "rgba16f"])]
    if draw.randrange(2) == 1:
        words += ["--background", ",".join(f"0.{draw.randrange(10)}" for _ in range(3))]
    return words


def drawn_cases(draw, known):
    """Yields (kind, names, algorithm) without end, in the order of kinds; the port's own list names the algorithm that shows a mistake."""
    algorithm = {name: shows for name, shows, _ in known}
    inside = [name for name, _, _ in known if name in mistaken.NAMES]
    outside = [name for name, _, _ in known if name not in mistaken.NAMES]
    pairs = [(one, other) for one in inside for other in inside if one < other and algorithm[one] == algorithm[other]]
    orders = {"single": [(name,) for name in draw.sample(inside, len(inside))],
              "outside": [(name,) for name in draw.sample(outside, len(outside))], "pair": draw.sample(pairs, len(pairs))}
    return [(kind, names, algorithm[names[0]]) for kind, all_names in orders.items() for names in all_names]


class Bench:
    def __init__(self, build, folder, driver):
        self.build, self.folder, self.driver = build, folder, driver
        self.profile, self.number = packs.profile_file(folder, driver), 0

    def new_set(self):
        self.number += 1
        self.set = self.folder / f"set{self.number}"
        self.set.mkdir()

    def pack(self, words, algorithm):
        """Makes a further pack of the set."""
        return packs.Pack(self.build, self.set / f"scene{len(list(self.set.iterdir())) + 1}", words, self.profile, [algorithm])

    def candidate(self, pack, names, algorithm, picture_only):
        """A folder with the results of the port; the previous one is deleted."""
        folder = self.folder / "candidates" / pack.folder.name
        shutil.rmtree(folder, ignore_errors=True)
        return pack.candidate(folder, self.driver, ",".join(names), [algorithm], picture_only=picture_only)

    def picture(self, pack, names, algorithm):
        return (self.candidate(pack, names, algorithm, True) / algorithm / "picture.npy").read_bytes()

    def diagnose(self, found, names, algorithm):
        """The diagnosis of the whole set."""
        shutil.rmtree(self.folder / "candidates", ignore_errors=True)
        for pack in found:
            candidate = self.candidate(pack, names, algorithm, False)
        self.made_by = json.loads((candidate / "candidate.json").read_text())["made_by"].removeprefix("strata_port, ")
        words = [self.build / "strata", "diagnose", self.set, self.folder / "candidates", "--algorithm", algorithm, "--json", *packs.GIVES_UP]
        return json.loads(packs.run(words, allowed=(0, 1)))


def find_scenes(bench, draw, names, algorithm):
    """Packs for which each of the mistakes changes the port's picture, and for two mistakes differently from either alone; their words; and the
    number of scenes that were chosen for this."""
    bench.new_set()
    found, all_words = [], []
    for tries in range(1, DRAWS + 1):
        words = scene_of(draw)
        try:
            pack = bench.pack(words, algorithm)
            ways = {(), names, *((name,) for name in names)}
            pictures = {bench.picture(pack, way, algorithm) for way in sorted(ways)}
        except packs.Failed:  # the profile or the port does not support this combination
            continue
        if len(pictures) != len(ways):
            shutil.rmtree(pack.folder)
            continue
        found.append(pack)
        all_words.append(" ".join(words))
        if len(found) == SCENES:
            break
    return found, all_words, tries


def judged(kind, names, said):
    """first: named first. beside: another one with the same output in all scenes is named first. no known mistake: the right answer for mistakes that
    are not in the catalogue. same output: the named one gives all codes of this output."""
    best, unknown = said["findings"][0], said["verdict"] == "unknown_mistake"
    if kind == "outside":
        return "no known mistake" if unknown else "same output"
    known = [mistaken.NAMES[name] for name in names]
    def holds(found):
        return len(found) == len(names) and all(any(answer in found for answer in answers) for answers in known)
    if holds(best["mistakes"]):
        return "ranked first" if unknown else "first"
    # Others besides the first that fit all scenes and agree with as many passes.
    beside = [[mistake] for mistake in best["alike"]]
    beside += [found["mistakes"] for found in said["findings"] if all(found["fits"]) and found["targets_alike"] == best["targets_alike"]]
    if not unknown and any(map(holds, beside)):
        return "beside"
    return "no" if unknown else "same output"


def page(seed, driver, renderer, rows, right, drawn):
    def count(kind, *answers):
        asked = [r for r in rows if r[0] == kind and r[-1] != "not shown"]
        return f"{sum(r[-1] in answers for r in asked)} of {len(asked)}"

    lines = ["# Diagnosis of mistakes chosen at random", "",
             "How often does `strata diagnose` name the mistake of an OpenGL port if the mistake and the scenes are chosen at random? A seed determines the",
             f"mistakes and {SCENES} scenes for each ([blind.py](blind.py)); the diagnosis is given the packs and the results of the port, with its passes and",
             f"layers. `tools/port/mistakes/blind.py {seed}` (seed {seed}) on {renderer}:", "",
             '| | right answers | the mistake is named first, or "no known mistake" | it and another with the same output are named | only another with the same output is named |',
             "|---|---|---|---|---|"]
    for kind, words in (("single", "one mistake of the catalogue"), ("outside", "one mistake that is not in the catalogue"), ("pair", "two mistakes")):
        lines.append(f"| {words} | {count(kind, 'first', 'beside', 'no known mistake')} | {count(kind, 'first', 'no known mistake')} | {count(kind, 'beside')} | {count(kind, 'same output')} |")
    hidden = [row[1] for row in rows if row[-1] == "not shown"]
    lines += ["", f"The right port is called right on {right} sets of scenes; {drawn} scenes were chosen. No row was omitted or repeated, but a mistake is replaced if",
              f"fewer than {SCENES} of {DRAWS} scenes show it: {'; '.join(f'`{names}`' for names in hidden) or 'none'}.", "",
              "[SEEDS.md](SEEDS.md) has the results of earlier seeds, and the improvements after each.", "",
              "## The whole table", "", f"    tools/port/mistakes/blind.py {seed}", "",
              "The command needs a build with `-DSTRATA_PORT=ON` and the driver. It also writes `build/port/BLIND.md` with a row for each mistake: its scenes,",
              "the verdict, the mistakes that are named, and the number of pixels that differ."]
    return "\n".join(lines) + "\n"


def whole_page(seed, rows):
    return "\n".join([f"# Diagnosis of the random mistakes of seed {seed}", "",
                      "| kind | mistake | algorithm | scenes | verdict | named first | pixels that differ | first class of pixels | answer |", "|" + "---|" * 9,
                      *("| " + " | ".join(row) + " |" for row in rows), ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seed", type=int)
    parser.add_argument("--build", default=str(ROOT / "build/release"), help="where strata and strata_port are")
    parser.add_argument("--driver", default="llvmpipe", help="whose profile has the same name")
    parser.add_argument("--out", default=str(HERE / "BLIND.md"))
    parser.add_argument("--whole", type=pathlib.Path, default=ROOT / "build" / "port" / "BLIND.md")
    options = parser.parse_args()
    print("seed", options.seed, flush=True)
    draw, build = random.Random(options.seed), pathlib.Path(options.build)
    rows, right, wrong, drawn, renderer = [], 0, 0, 0, options.driver
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(build, pathlib.Path(folder), options.driver)
        asked = {kind: 0 for kind in WANTED}
        for kind, names, algorithm in drawn_cases(draw, mistaken.listed(build)):
            if asked[kind] == WANTED[kind]:
                continue
            found, words, tries = find_scenes(bench, draw, names, algorithm)
            drawn += tries
            if len(found) < SCENES:
                rows.append([kind, ", ".join(names), algorithm, f"{len(found)} of {DRAWS} show it", "", "", "", "", "not shown"])
                print(*rows[-1], sep=" | ", flush=True)
                continue
            asked[kind] += 1
            is_right = bench.diagnose(found, (), algorithm)["verdict"] == "right"
            right, wrong = right + is_right, wrong + (not is_right)
            said = bench.diagnose(found, names, algorithm)
            best, kinds = said["findings"][0], [scene["kinds"][0]["kind"] for scene in said["scenes"] if scene["kinds"]]
            rows.append([kind, ", ".join(names), algorithm, "; ".join(words), said["verdict"].replace("_", " "), ", ".join(best["mistakes"]),
                         str(said["differing"]), ", ".join(dict.fromkeys(kinds)), judged(kind, names, said)])
            renderer = bench.made_by
            print(*rows[-1], sep=" | ", flush=True)
            shutil.rmtree(bench.set)
    pathlib.Path(options.out).write_text(page(options.seed, options.driver, renderer, rows, f"{right} of {right + wrong}", drawn))
    options.whole.parent.mkdir(parents=True, exist_ok=True)
    options.whole.write_text(whole_page(options.seed, rows))
    return 0 if wrong == 0 else 1


if __name__ == "__main__":
    sys.exit(main())

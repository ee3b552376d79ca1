#!/usr/bin/python3
"""Renders every scene with every engine, explains each picture from the engine's source, and writes two pages: the truth about each picture, whether
the rules of that source give it, and the verdict of `strata compare` without options. RESULTS.md has counts per engine and way, and the wrong
verdicts; build/engines/RESULTS.md has a row for each picture.

    table.py [--build FOLDER] [--only SCENE] [--lot FIRST..LAST] [--keep FOLDER] [-o FILE] [--whole FILE]

--lot uses the random scenes of these seeds instead. --keep is the folder in which packs and pictures are stored; existing ones are not rendered
again. Exit status 1 if a rule does not give its picture or truth.py contradicts the rules; 77, and a sentence, if a program or a package is missing.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import numpy  # noqa: F401
except ImportError:
    print("SKIPPED: python3-numpy was not found; tools/port/engines/install.sh installs it")
    sys.exit(77)
import draw  # noqa: E402
import fragments  # noqa: E402
import pack_scene  # noqa: E402
import pictures  # noqa: E402
import rules  # noqa: E402
import scenes  # noqa: E402
import truth  # noqa: E402
import web  # noqa: E402

BACKGROUND = [51, 51, 102]
HARD = {name: ["hard:case=" + name, "--size", "32x32"] for name in ("cyclic-overlap", "woven", "inside-out")}
CLOSE_ENOUGH = 2  # codes between a rule in binary64 and a picture of any format here
SAME = 0.01  # codes between two colours that count as equal
SHOWN = 2  # codes: in random scenes a mistake that changes no pixel by more is not expected to be detected


def words_of(name, folder):
    """The words for `strata golden` that describe the scene."""
    own = [folder / f"{name}.gltf", "--camera", folder / f"{scenes.camera_of(name)}.json", "--size", "128x96"]
    return HARD.get(name) or own


def run(words, allowed=(0,)):
    done = subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode not in allowed:
        sys.exit(f"table.py: {' '.join(map(str, words))}: exit status {done.returncode}: {done.stderr.strip()}")
    return done


def picture_of(folder, engine, scene_name, way):
    return folder / engine / f"{scene_name}.{way}.{'npy' if way == 'float' else 'png'}"


class Frame:
    """A scene's pack, its pixels and their right colours."""
    def __init__(self, pack):
        self.pack, self.scene = pack, pack_scene.read_scene(pack)
        self.background = [c / 255 for c in BACKGROUND]
        self.pixels = {mixes_light: fragments.pixels_of(self.scene, mixes_light) for mixes_light in (False, True)}
        self.right = [[None if pixel is None else rules.exact(pixel, self.background) for pixel in row] for row in self.pixels[False]]

    def explain(self, engine, way, picture):
        """The greatest distance between rule and picture, the distance between rule and right colours where they differ, and the number of pixels."""
        mixes_light = engine == "three" and way != "float"
        made = rules.rule_of(engine, way, self.scene)(self.pixels[mixes_light], self.background)
        decided = [(x, y) for y, row in enumerate(made) for x, color in enumerate(row) if color]
        worst = max(rules.distance(made[y][x], picture[y][x]) for x, y in decided)
        off = [min(rules.distance(made[y][x], right) for right in self.right[y][x]) for x, y in decided]
        return worst, [d for d in off if d > SAME], len(decided)


def verdict_of(strata, pack, picture):
    """Exit status and output of `strata compare`."""
    done = run([strata, "compare", pack, picture], allowed=(0, 1))
    return done.returncode, done.stdout.strip()


def rows_of(name, folder, strata, browser):
    pack = folder / "packs" / name
    if not (pack / "manifest.json").exists():
        background = ",".join(str(c / 255) for c in BACKGROUND)
        run([strata, "golden", *words_of(name, folder / "scenes"), "--background", background, "--algorithm", "dual", "-o", pack, "-q"])
    frame = Frame(pack)
    for engine, ways in draw.WAYS.items():
        for way in ways:
            if (engine, name) in truth.CANNOT:
                continue
            picture = picture_of(folder, engine, name, way)
            if not picture.exists():
                draw.write(draw.draw(engine, frame.scene, way, browser), picture, None)
            worst, off, decided = frame.explain(engine, way, pictures.read(picture))
            wrong = len(off)
            true = truth.of_scene(engine, way, name, max(off, default=0) > SHOWN)
            status, verdict = verdict_of(strata, pack, picture)
            yield {"scene": name, "engine": engine, "way": way, "wrong": wrong, "decided": decided, "worst": worst, "why": true.sentence if true else "",
                   "status": status, "verdict": verdict, "judgment": truth.judgment(true, status, verdict),
                   "consistent": worst <= CLOSE_ENOUGH and (bool(wrong) == bool(true) or name.startswith("lot-"))}


def sentence_of(verdict):
    """The verdict's first line; if several mistakes look the same, all of them."""
    lines = verdict.splitlines()
    if "look the same here" not in lines[0]:
        return lines[0]
    return "; ".join([lines[0], *(line.strip() for line in lines[1:] if line.startswith("  ") and line[2] != " ")][:4])


def line_of(row):
    true = f"wrong at {row['wrong']:,} of {row['decided']:,}: {row['why']}" if row["why"] else "right" if not row["wrong"] else f"wrong at {row['wrong']:,}, by at most {SHOWN} codes"
    return f"| {row['scene']} | {row['engine']}, {row['way']} | {true} | {row['worst']:.1f} | {sentence_of(row['verdict'])} | {row['judgment']} |"


LISTED = 5  # verdicts that are not true, on the short page
ROW_HEAD = ["| scene | engine, way | true | rule | verdict | which is |", "|---|---|---|---|---|---|"]


def tally_of(rows):
    """Verdicts by engine and way."""
    lines = ["| engine, way | pictures | right | wrong | " + " | ".join(truth.JUDGMENTS) + " |", "|---" + "|---:" * (3 + len(truth.JUDGMENTS)) + "|"]
    for name in [*dict.fromkeys(f"{row['engine']}, {row['way']}" for row in rows), "all"]:
        here = [row for row in rows if name in ("all", f"{row['engine']}, {row['way']}")]
        right = sum(row["wrong"] == 0 for row in here)
        counts = [len(here), right, len(here) - right, *(sum(row["judgment"] == judgment for row in here) for judgment in truth.JUDGMENTS)]
        lines.append(f"| {name} | " + " | ".join(map(str, counts)) + " |")
    return lines


def page_of(rows):
    """The short page: counts, and the rows whose verdict is not true."""
    explained = sum(row["consistent"] for row in rows)
    true = sum(row["judgment"] == "true" for row in rows)
    other = [row for row in rows if row["judgment"] != "true"]
    return "\n".join([
        "# Verdicts on pictures of four engines", "",
        "Given only a scene and an engine's picture of it, does `strata compare PACK PICTURE` decide without any option whether the picture is right, and",
        "name the mistake of a wrong one? VTK rendered with Mesa's llvmpipe, Babylon.js, Mol* and three.js with Chromium's SwiftShader, all on a CPU.", "",
        f"Of {len(rows)} verdicts {true} are true ({100 * true / len(rows):.1f} %). Each engine rendered {len({row['scene'] for row in rows})} scenes in each of its ways to render transparent",
        "surfaces. A verdict is true if it calls a right picture right, or names the mistake of a wrong one, alone or among those that give",
        "the same picture of this scene. If the engine differs only where several fragments have one depth, *right* is true if the verdict reports that",
        "it does not decide such pixels. *Not decided*: rounding can explain the picture, and the search for a mistake reached its limit. *Wrong without a",
        "name*: called wrong, without the cause. *False*: all others.", "",
        *tally_of(rows), "",
        "*Right* and *wrong* are from the engine's source, not from Strata: [fragments.py](fragments.py) computes every fragment in binary64, and",
        "[rules.py](rules.py) combines them like the engine's code. If that computation agrees with the picture within two codes of 8 bits, it",
        f"explains the picture: {explained} of {len(rows)} are explained. Pixels at edges are omitted.", "",
        "Verdicts that are not true: " + ("; ".join(f"{row['scene']} by {row['engine']}, {row['way']} ({row['why'] or 'right'}): {row['judgment']}" for row in other[:LISTED])
                                          or "none") + ("; and others" if len(other) > LISTED else "") + ".", "",
        "## The whole table", "",
        "    tools/port/engines/install.sh && tools/port/engines/table.py", "",
        "The commands install the engines (versions: [README.md](README.md)), render the pictures and write this page, and",
        "`build/engines/RESULTS.md` with a row for each picture and its complete verdict.", ""])


def whole_page_of(rows):
    return "\n".join(["# Verdicts on pictures of four engines, one by one", "", *ROW_HEAD, *map(line_of, rows), ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--build", default=str(draw.HERE.parents[2] / "build" / "release"), type=pathlib.Path)
    parser.add_argument("--only", action="append", choices=[*scenes.SCENES, *HARD])
    parser.add_argument("--lot", metavar="FIRST..LAST", type=lambda text: range(int(text.split("..")[0]), int(text.split("..")[1]) + 1), default=())
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("-o", dest="output", type=pathlib.Path, default=draw.HERE / "RESULTS.md")
    parser.add_argument("--whole", type=pathlib.Path, default=draw.HERE.parents[2] / "build" / "engines" / "RESULTS.md", help="gets a row a picture")
    given = parser.parse_args()
    lacking = [draw.missing(engine) for engine in draw.WAYS if draw.missing(engine)]
    if lacking:
        print("\n".join(lacking))
        return draw.SKIPPED
    if not os.environ.get("DISPLAY"):
        return draw.with_display()
    with tempfile.TemporaryDirectory() as temporary:
        folder = (given.keep or pathlib.Path(temporary)).resolve()
        scenes.main(folder / "scenes", given.lot)
        names = given.only or [f"lot-{seed}" for seed in given.lot] or [*scenes.SCENES, *HARD]
        with web.Browser(draw.PACKAGES) as browser:
            rows = [row for name in names for row in rows_of(name, folder, given.build / "strata", browser)]
    given.output.write_text(page_of(rows))
    given.whole.parent.mkdir(parents=True, exist_ok=True)
    given.whole.write_text(whole_page_of(rows))
    for row in rows:
        if not row["consistent"]:
            print(f"{row['scene']}, {row['engine']} {row['way']}: the rule is {row['worst']:.1f} codes from the picture, and wrong at {row['wrong']} pixels; truth.py says {row['why'] or 'right'!r}")
    return 0 if all(row["consistent"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())

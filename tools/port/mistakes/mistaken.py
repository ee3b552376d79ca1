#!/usr/bin/env python3
"""Writes tools/port/mistakes/MISTAKES.md, how often `strata diagnose` names the port's mistakes, and build/port/MISTAKES.md with a row for each picture.

    tools/port/mistakes/mistaken.py [--driver llvmpipe] [--only NAME]

The diagnosis is given only the pack and the candidate, without the port's own information. Exit status 1: the right port is not called right.
"""
import argparse
import json
import pathlib
import shutil
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))
import packs  # noqa: E402

ROOT = HERE.parents[2]
SCENES = {
    "teapot": ["teapot", "--alpha", "0.5", "--size", "64x48"],
    "random": ["random:seed=3,triangles=60", "--size", "64x48"],
    "coincident": ["hard:case=coincident", "--size", "48x48"],
    "opaque": ["hard:case=opaque-crossing", "--size", "48x48"],
    "close": ["hard:case=planes-1-unit-of-16-bits", "--size", "32x32"],
    "deep": ["hard:case=layers-256", "--size", "4x4"],
    "deep, far first": ["volume-beam:slices=300,order=far", "--size", "4x4"],
    "one sample": ["random:seed=3,triangles=60", "--size", "26x19"],
    "on grey": ["teapot", "--alpha", "0.5", "--background", "0.5,0.5,0.5", "--size", "64x48"],
}
SLOW = ["deep", "deep, far first"]  # their rows are last
MOST_LISTED = 8  # answers other than yes, on the short page
ALL_ALGORITHMS = ["teapot", "random", "coincident", "opaque", "close"]  # scenes that the right port renders with each algorithm
# The scenes that show a mistake, if not the teapot.
SHOWN_IN = {"less_equal": "coincident", "depth_epsilon": "random", "depth_16": "close", "opaque_ignored": "opaque", "background_lost": "on grey", "half_min_max": "opaque",
            "no_perspective": "random", "stencil_wraps": "deep, far first", "stencil_cleared": "deep", "query_above_1": "one sample",
            "last_layer_lost": "close", "other_clip_range": "opaque"}
PAIRS = [("flipped_rows,srgb_twice", "teapot", "front_to_back"), ("half_pixel,red_for_blue", "teapot", "front_to_back"),
         ("straight_layers,last_layer_lost", "close", "front_to_back"), ("min_max_cleared_to_0,red_for_blue", "teapot", "dual"),
         ("background_lost,alpha_twice", "on grey", "front_to_back"), ("factors_exchanged,culling_left_on", "teapot", "dual"),
         ("no_perspective,red_for_blue", "random", "front_to_back"), ("less_equal,straight_layers", "coincident", "front_to_back"),
         ("culling_left_on,alpha_twice", "teapot", "front_to_back"), ("under_not_separate,flat_colors", "teapot", "front_to_back")]


class Journal:
    """Finished rows, a line of JSON each; without a file none are stored."""
    def __init__(self, file):
        self.path = pathlib.Path(file) if file else None
        lines = self.path.read_text().splitlines() if self.path and self.path.exists() else []
        self.rows = {(cells[0], *cells[2:4]): cells for cells in map(json.loads, lines)}

    def find(self, *key):
        return self.rows.get(key)

    def append(self, cells):
        print(*cells, sep=" | ", flush=True)
        if self.path:
            with self.path.open("a") as file:
                file.write(json.dumps(cells) + "\n")


def listed(build):
    """The port's mistakes: name, the algorithm that shows it, and a description."""
    return [line.split(None, 2) for line in packs.run([build / "strata_port", "--mistakes"]).splitlines()]


def cases(build):
    """(names of mistakes, descriptions, scene, algorithm); the right port first."""
    known = listed(build)
    words = {name: text for name, _, text in known}
    wrong = [(name, text, SHOWN_IN.get(name, "teapot"), algorithm) for name, algorithm, text in known]
    wrong += [(names, "; ".join(words[n] for n in names.split(",")), scene, algorithm) for names, scene, algorithm in PAIRS]
    pictures = dict.fromkeys([(scene, algorithm) for scene in ALL_ALGORITHMS for algorithm in packs.ALGORITHMS] + [case[2:] for case in wrong])
    return sorted([("", "the right port", *picture) for picture in pictures] + wrong, key=lambda case: case[2] in SLOW)


# The catalogue's names of the port's mistakes; for the others the right answer is that the mistake is not in the catalogue.
NAMES = {"flipped_rows": {"upside_down", "flipped_rows"}, "other_clip_range": {"clip_zero_to_one"}, "half_pixel": {"half_pixel_down", "half_pixel_up", "half_pixel_right", "half_pixel_left"},
         "culling_left_on": {"culls_all_backs"}, "flat_colors": {"colors_flat"}, "no_perspective": {"colors_affine"},
         "less_equal": {"last_of_equals"}, "nearest_again": {"peels_again"}, "depth_16": {"depth_16"},
         "min_max_cleared_to_0": {"min_max_cleared_to_0"}, "opaque_ignored": {"opaque_depth_lost"}, "straight_layers": {"not_premultiplied"},
         "alpha_twice": {"premultiplied_twice"}, "cleared_to_opaque": {"front_cleared_wrong"}, "under_not_separate": {"one_blend_function"},
         "over_for_under": {"over_for_under", "premultiplied_over_for_under"}, "factors_exchanged": {"swapped_factors"}, "min_for_max": {"min_for_max"},
         "alpha_squared": {"alpha_squared"}, "background_lost": {"background_lost", "nothing_behind"}, "back_premultiplied": {"far_layer_premultiplied"},
         "sides_exchanged": {"front_is_clockwise"}, "count_in_a_byte": {"count_not_added"}, "srgb_twice": {"srgb_twice"},
         "red_for_blue": {"red_for_blue"}, "last_layer_lost": {"one_pass_too_few"}, "query_above_1": {"query_above_one"},
         "not_swapped": {"ping_pong_not_swapped"}, "stencil_wraps": {"stencil_wraps"}}


def diagnose(build, profile, scene, algorithm, picture):
    """The diagnosis of a picture. The scene has the size of the picture."""
    words = [build / "strata", "diagnose", *SCENES[scene], picture, "--algorithm", algorithm, "--profile", profile, "--json", *packs.GIVES_UP]
    return json.loads(packs.run(words, allowed=(0, 1)))


def judged(names, said):
    """yes: right, or the mistake or both of two are named, or none is if it is not in the catalogue. Else: same picture, if the named mistake gives
    the same picture in every pixel; nearest, if the right one is ranked first but does not explain some pixels; does not show, if the picture is
    right and called so; or no."""
    best = said["findings"][0] if said["findings"] else {"mistakes": [], "alike": [], "explained": 0}
    found, unknown = best["mistakes"] + best["alike"], said["verdict"] == "unknown_mistake"
    if said["differing"] == 0:
        return "no" if said["verdict"] != "right" else "does not show" if names else "yes"
    known = [NAMES.get(name) for name in names.split(",")]
    if None not in known and all(any(answer in found for answer in answers) for answers in known):
        return "nearest" if unknown else "yes"
    if None in known and unknown:
        return "yes"
    return "same picture" if not unknown and best["explained"] == said["differing"] else "no"


def row(names, words, scene, algorithm, said):
    best = said["findings"][0] if said["findings"] else {"mistakes": [], "agreeing": 0, "explained": 0}
    classes = ", ".join(f"{kind['kind']} {kind['pixels']}" for kind in said["comparison"]["kinds"])
    share = f"{best['explained']} of {said['differing']}" if said["differing"] else ""
    return [names.replace(",", ", ") or "(right)", words, scene, algorithm, said["verdict"].replace("_", " "),
            ", ".join(best["mistakes"]), share, classes, judged(names, said)]


def kinds_of(rows):
    """(description, rows) of the kinds of pictures, in the order of the table."""
    def is_single(cells):
        return cells[0] != "(right)" and "," not in cells[0]

    yield "the right port", [c for c in rows if c[0] == "(right)"]
    yield "one mistake of the catalogue", [c for c in rows if is_single(c) and c[0] in NAMES]
    yield "one mistake that is not in the catalogue", [c for c in rows if is_single(c) and c[0] not in NAMES]
    yield "two mistakes", [c for c in rows if "," in c[0]]


def whole_page(rows, driver):
    return "\n".join([f"# The port's mistakes, one by one, on {driver}", "",
                      "| mistake | what it is | scene | algorithm | verdict | named first | explains | classes of pixels | right |", "|" + "---|" * 9,
                      *("| " + " | ".join(cells) + " |" for cells in rows), ""])


def page(rows, driver):
    """The short page, at most 600 words, and whether the right port is always called right."""
    answers = ["yes", "same picture", "nearest", "does not show", "no"]
    table = [f"| {name} | {len(cells)} | " + " | ".join(str(sum(c[-1] == answer for c in cells)) for answer in answers) + " |" for name, cells in kinds_of(rows)]
    other = [f"- `{cells[0]}`, {cells[2]} by {cells[3]}: {cells[4]}{': ' if cells[5] else ''}{cells[5]} ({cells[-1]})" for cells in rows if cells[-1] != "yes"]
    text = "\n".join([
        "# Diagnosis of an OpenGL port with known mistakes", "",
        "Does `strata diagnose` name the mistake of an OpenGL port from the scene and the picture alone? The port ([mistakes.cpp](mistakes.cpp)) has",
        f"{len({c[0] for c in rows if c[0] != '(right)' and ',' not in c[0]})} mistakes, written before the oracle's catalogue was consulted. `tools/port/mistakes/mistaken.py` renders with the Mesa driver {driver},",
        "and the picture is diagnosed under that driver's profile. The scenes were chosen so that each mistake is visible, some of them after a first",
        "diagnosis; [BLIND.md](BLIND.md) has the rates on scenes chosen at random.", "",
        "| pictures | number | " + " | ".join(answers) + " |", "|---" + "|---:" * (1 + len(answers)) + "|", *table, "",
        "*Yes*: the mistake is named (or both of two; or none if it is not in the catalogue), or the right port is called right. *Same picture*: the named",
        "mistake gives the same picture in every pixel. *Nearest*: the right mistake is ranked first, but does not explain a few pixels. *Does not show*: the",
        "picture is right.", "",
        "Answers other than yes:", "", *(other[:MOST_LISTED] or ["- none"]), *(["- and others"] if len(other) > MOST_LISTED else []), "",
        "## The whole table", "",
        "    tools/port/mistakes/mistaken.py", "",
        "The command needs a build with `-DSTRATA_PORT=ON` and the driver. It also writes `build/port/MISTAKES.md` with a row for each picture: its",
        "mistake, the verdict, the mistakes that are named, and the number of pixels that these explain. Exit status 1 if the right port is not called right.", ""])
    right = next(cells for _, cells in kinds_of(rows))
    return text, all(c[-1] == "yes" for c in right) and bool(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=str(ROOT / "build/release"), help="where strata and strata_port are")
    parser.add_argument("--driver", default="llvmpipe", help="whose profile has the same name")
    parser.add_argument("--only", help="one mistake, or a pair with a comma between")
    parser.add_argument("--journal", help="a file of rows that are done: a run that was broken off goes on from there")
    parser.add_argument("--out", default=str(HERE / "MISTAKES.md"))
    parser.add_argument("--whole", type=pathlib.Path, default=ROOT / "build" / "port" / "MISTAKES.md")
    options = parser.parse_args()
    build, rows, made, journal = pathlib.Path(options.build), [], {}, Journal(options.journal)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        profile = packs.profile_file(folder, options.driver)
        for names, words, scene, algorithm in cases(build):
            if options.only is not None and names != options.only:
                continue
            if cells := journal.find(names.replace(",", ", ") or "(right)", scene, algorithm):
                rows.append(cells)
                continue
            if scene not in made:
                made[scene] = packs.Pack(build, folder / scene, SCENES[scene], profile)
            candidate = made[scene].candidate(folder / "candidate", options.driver, names, [algorithm], picture_only=True)
            said = diagnose(build, profile, scene, algorithm, candidate / algorithm / "picture.npy")
            rows.append(row(names, words, scene, algorithm, said))
            shutil.rmtree(candidate)
            journal.append(rows[-1])
    text, all_right = page(rows, options.driver)
    pathlib.Path(options.out).write_text(text)
    options.whole.parent.mkdir(parents=True, exist_ok=True)
    options.whole.write_text(whole_page(rows, options.driver))
    return 0 if all_right else 1


if __name__ == "__main__":
    sys.exit(main())

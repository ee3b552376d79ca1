#!/usr/bin/env python3
"""Writes tools/port/mistakes/SAMPLED_MISTAKES.md: what `strata diagnose` and `strata compare` say of a port's pictures with 4 samples per pixel.

    sampled_mistakes.py [--build build/release] [--quick] [--driver llvmpipe_sse] [-o PAGE]

The right port with three scenes and formats, then the mistakes that `strata_port --samples 4 --mistakes` lists, each by itself and with each
algorithm that it changes. The commands are given only the resolved picture. Exit status 1: a right picture is called wrong, a wrong one right, or
one of the five mistakes that QUICK lists is not named. With --quick only these five, on the teapot.
"""
import argparse
import base64
import json
import pathlib
import struct
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))
import packs  # noqa: E402

ROOT = HERE.parents[2]
SAMPLES = 4
PEELS, ALL = ["front_to_back", "dual"], ["front_to_back", "dual", "weighted_average"]
SCENES = {"teapot": ["teapot", "--alpha", "0.5", "--size", "97x73"], "random": ["random:seed=3,triangles=60", "--size", "64x48"],
          "cards": ["cards.gltf", "--size", "64x48"]}
# The algorithms that a mistake changes, and the catalogue's names for it; without any the right answer is that the mistake is not known.
MISTAKES = {"layers_resolved": (ALL, {"resolve_before_compositing"}),
            "peels_sample_0": (PEELS, {"peel_loads_sample_0"}),
            "composites_sample_0": (ALL, {"sample_0_for_all", "sample_0_shown"}),
            "no_sample_shading": (ALL, {"pixel_shading_loads_sample_0", "pixel_shading"}),
            "list_of_pixel": (["linked_list"], set()),
            "alpha_to_coverage": (["weighted_average"], {"alpha_to_coverage_on"}),
            "mask_left_set": (ALL, {"sample_mask_left_set"}),
            "shows_sample_0": (ALL, {"sample_0_shown", "sample_0_for_all"}),
            "resolved_in_linear_light": (ALL, {"resolved_in_linear_light"}),
            "opaque_resolved": (ALL, set()),
            "opaque_depth_of_sample_0": (PEELS, set())}
QUICK = [("layers_resolved", "front_to_back"), ("peels_sample_0", "dual"), ("composites_sample_0", "dual"), ("no_sample_shading", "front_to_back"),
         ("alpha_to_coverage", "weighted_average")]
RIGHT = {"right", "right_structure"}
# Made by a port that runs its programs once a pixel on purpose, and says so: the driver covers a sample by the alphas of all runs of a pixel.
ONCE_A_PIXEL = {"alpha_to_coverage"}


def write_cards(path):
    """Triangles without light or textures: an opaque one between two transparent ones, of which the nearer one crosses it."""
    cards = [((-1, -0.8, 0.3), (1, -0.9, -0.4), (0.1, 1, 0.1), (0.6, 0.7, 0.2, 1)),
             ((-0.9, 0.7, 0.5), (1, 0.8, -0.5), (0, -1, 0.6), (0.9, 0.2, 0.3, 0.6)),
             ((-1.1, 0.2, -0.8), (0.8, 1, -0.9), (1.1, -0.7, -0.7), (0.2, 0.4, 0.9, 0.4))]
    data = b"".join(struct.pack("<3f", *corner) for card in cards for corner in card[:3])
    views = [{"buffer": 0, "byteOffset": 36 * k, "byteLength": 36} for k in range(len(cards))]
    accessors = [{"bufferView": k, "componentType": 5126, "count": 3, "type": "VEC3", "min": [min(axis) for axis in zip(*card[:3])],
                  "max": [max(axis) for axis in zip(*card[:3])]} for k, card in enumerate(cards)]
    materials = [{"pbrMetallicRoughness": {"baseColorFactor": card[3]}, "alphaMode": "OPAQUE" if card[3][3] == 1 else "BLEND", "doubleSided": True,
                  "extensions": {"KHR_materials_unlit": {}}} for card in cards]
    primitives = [{"attributes": {"POSITION": k}, "material": k} for k in range(len(cards))]
    path.write_text(json.dumps({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_unlit"], "scene": 0, "scenes": [{"nodes": [0]}],
                                "nodes": [{"mesh": 0}], "meshes": [{"primitives": primitives}], "materials": materials, "accessors": accessors,
                                "bufferViews": views, "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}))


class Trial:
    def __init__(self, build, folder, driver):
        self.build, self.folder, self.driver = build, folder, driver
        self.profile = packs.profile_file(folder, driver)
        self.packs = {}
        write_cards(folder / "cards.gltf")

    def words(self, scene, extra=()):
        first, *others = SCENES[scene]
        return [self.folder / first if first.endswith(".gltf") else first, *others, *extra]

    def draw(self, scene, algorithm, mistake="", extra=(), is_once_a_pixel=False):
        """The resolved picture of the port."""
        key = (scene, algorithm, *extra)
        if key not in self.packs:
            folder = self.folder / f"pack{len(self.packs)}"
            self.packs[key] = packs.Pack(self.build, folder, self.words(scene, extra), self.profile, [algorithm])
        candidate = self.folder / f"{scene}.{algorithm}.{mistake}{len(list(self.folder.iterdir()))}"
        packs.run([self.build / "strata_port", self.packs[key].folder, "-o", candidate, "--driver", self.driver, "--algorithm", algorithm,
                   "--samples", SAMPLES, "--picture-only", "--max-passes", packs.MOST_PASSES, *(["--interpolate", "centre"] if is_once_a_pixel else []),
                   *(["--mistake", mistake] if mistake else [])])
        self.made_by = json.loads((candidate / "candidate.json").read_text())["made_by"].removeprefix("strata_port, ")
        return candidate / algorithm / "picture.npy"

    def ask(self, command, scene, algorithm, picture, extra=()):
        first, *others = self.words(scene, extra)
        limit = packs.GIVES_UP if command == "diagnose" else []
        return json.loads(packs.run([self.build / "strata", command, first, picture, *others, "--samples", SAMPLES, "--profile", self.profile,
                                     "--algorithm", algorithm, *limit, "--json", "-q"], allowed=(0, 1)))

    def compared(self, scene, algorithm, picture, extra=()):
        """The verdict, of algorithms that are exact."""
        return "" if algorithm == "weighted_average" else self.ask("compare", scene, algorithm, picture, extra)["verdict"]

    def diagnosed(self, scene, algorithm, picture, extra=()):
        """The verdict, the number of wrong pixels, whether all are edges, and the names of what explains the picture."""
        said = self.ask("diagnose", scene, algorithm, picture, extra)
        best = said["findings"][0]
        names = [] if said["verdict"] in RIGHT | {"unknown_mistake"} else [" and ".join(best["mistakes"]), *best["alike"]]
        return said["verdict"], said["differing"], said["differing"] == said["differing_at_edges"], names


def right_rows(trial):
    """(scene, algorithm, format, verdicts of compare and of diagnose)"""
    rows = []
    for scene in SCENES:
        for algorithm in [*ALL, "linked_list"]:
            for color in ["rgba8", "rgba32f"]:
                extra = ["--color-format", color]
                picture = trial.draw(scene, algorithm, "", extra)
                rows.append((scene, algorithm, color, trial.compared(scene, algorithm, picture, extra), trial.diagnosed(scene, algorithm, picture, extra)[0]))
                print(*rows[-1], flush=True)
    return rows


def wrong_rows(trial, cases):
    """(mistake, scene, algorithm, verdicts of compare and of diagnose, wrong pixels, edges only, names), of pictures that a mistake changes."""
    rows = []
    for mistake, scene, algorithm in cases:
        is_once = mistake in ONCE_A_PIXEL
        extra = ["--shading", "pixel", "--load-sample", "0"] if is_once else []
        picture = trial.draw(scene, algorithm, mistake, (), is_once)
        if picture.read_bytes() != trial.draw(scene, algorithm, "", (), is_once).read_bytes():
            rows.append((mistake, scene, algorithm, trial.compared(scene, algorithm, picture, extra), *trial.diagnosed(scene, algorithm, picture, extra)))
            print(*rows[-1], flush=True)
    return rows


def answer(row):
    """`named`, `another` mistake, `unknown`, or `right`."""
    if row[4] in RIGHT:
        return "right"
    return "named" if MISTAKES[row[0]][1] & set(row[7]) else "another" if row[7] else "unknown"


def faults(right, wrong):
    """What the exit status reports."""
    lines = [f"{' '.join(row[:3])}: a right picture is called wrong" for row in right if row[3] == "wrong" or row[4] not in RIGHT]
    lines += [f"{' '.join(row[:3])}: a wrong picture is called right" for row in wrong if row[3] == "right" or row[4] in RIGHT]
    return lines + [f"{' '.join(row[:3])}: not named" for row in wrong if (row[0], row[2]) in QUICK and row[1] == "teapot" and answer(row) != "named"]


def page(trial, right, wrong, words):
    answers = [answer(row) for row in wrong]
    judged = [row for row in wrong if row[3]]
    known = sum(bool(MISTAKES[row[0]][1]) for row in wrong)
    lines = ["# Mistakes of multisampling in an OpenGL port", "",
             "What do `strata diagnose` and `strata compare` say of pictures of the OpenGL port with 4 samples per pixel? Mistakes are introduced one at",
             "a time; the commands see the resolved picture only. `tools/port/mistakes/sampled_mistakes.py` writes this page, on a CPU with",
             f"{trial.made_by}.", "",
             f"The right port has {len(right)} pictures: three scenes (`teapot`, `random:seed=3,triangles=60`, and three cards of which one is opaque), four",
             f"algorithms, `rgba8` and `rgba32f`. `compare` calls {sum(row[3] == 'wrong' for row in right)} of the {sum(row[3] != '' for row in right)} "
             f"of exact algorithms wrong, `diagnose` {sum(row[4] not in RIGHT for row in right)} of all.", "",
             f"Of {len(wrong)} wrong pictures `compare` judges {len(judged)} and calls {sum(row[3] == 'right' for row in judged)} of them right. `diagnose` calls "
             f"{answers.count('right')} right. {known} are of mistakes",
             f"in its catalogue: it names {answers.count('named')}, and misdiagnoses {answers.count('another')} pictures. Pictures that a mistake leaves unchanged are omitted.", "",
             "| mistake | what the port does |", "|---|---|", *(f"| {name} | {words[name]} |" for name in MISTAKES), "",
             "| mistake | scene | algorithm | compare | wrong pixels | edges only | diagnose | names |", "|---|---|---|---|---:|---|---|---|"]
    for row, said in zip(wrong, answers):
        edges, names = "yes" if row[6] else "no", ", ".join(row[7]) or "-"
        lines.append(f"| {row[0]} | {row[1]} | {row[2]} | {row[3] or '-'} | {row[5]:,} | {edges} | {said} | {names} |")
    lines += ["", "alpha_to_coverage is made with per-pixel shading (`--shading pixel --load-sample 0`). Names that share a row have",
              "the same picture of that scene. *Unknown*: no mistake of the catalogue, and no two of them, have this picture."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--driver", default="llvmpipe", choices=["llvmpipe", "llvmpipe_sse"])
    parser.add_argument("--quick", action="store_true", help="five mistakes on one scene, and no page")
    parser.add_argument("-o", "--out", default=HERE / "SAMPLED_MISTAKES.md", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        trial = Trial(options.build, pathlib.Path(folder), options.driver)
        listed = packs.run([options.build / "strata_port", "--samples", SAMPLES, "--mistakes"]).splitlines()
        words = {name: text for name, _, text in (line.split(None, 2) for line in listed)}
        if options.quick:
            right, wrong = [], wrong_rows(trial, [(mistake, "teapot", algorithm) for mistake, algorithm in QUICK])
        else:
            right = right_rows(trial)
            wrong = wrong_rows(trial, [(m, scene, algorithm) for m, (algorithms, _) in MISTAKES.items() for scene in SCENES for algorithm in algorithms])
            options.out.write_text(page(trial, right, wrong, words))
    messages = faults(right, wrong)
    print(*messages, sep="\n", file=sys.stderr)
    return 1 if messages or len(wrong) < len(QUICK) else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Writes tools/lab/bench/DIFFERENCES.md: the number of pixels in which Strata differs from Mesa's drivers, for each scene.

    tools/lab/bench/driver_differences.py [--models ../shared/models] [--drivers llvmpipe,llvmpipe_sse,softpipe] [--quick]

Calls strata_port_beside (built as in tools/lab/bench/README.md). Exit status 0: no pixel differs; 1: some do. Needs only the standard library.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
DRIVERS = ["llvmpipe", "llvmpipe_sse", "softpipe"]
# No size is a power of two, for which half pixels would be exact.
SIZES = ["333x277", "500x375", "641x479", "999x333", "257x600"]
FORMATS = [("rgba8", "d32f"), ("rgba16f", "d24"), ("rgba32f", "d16"), ("rgba8", "d24"), ("rgba16f", "d16"), ("rgba32f", "d32f")]
MOST_PASSES = 12  # pictures of each peel in addition to its last one
JOBS = ["depth", "front_to_back", "dual", "coherent_stencil", "sums", "weighted_average", "weighted_average_pow"]


def camera(eye, center, near, far, fovy=42):
    return {"eye": eye, "center": center, "up": [0, 1, 0], "fovy_degrees": fovy, "near": near, "far": far}


def model_views(file, center, eye, near, far, alpha):
    """Views of the whole model; cut off at near and far; so close that it leaves the frame on all sides; so far that triangles are smaller than
    pixels."""
    span = [e - c for e, c in zip(eye, center)]
    at = lambda share: [c + share * s for c, s in zip(center, span)]
    middle = (near + far) / 2
    return [(file, "whole", alpha, camera(eye, center, near, far)),
            (file, "cut at near and far", alpha, camera(eye, center, 0.9 * middle, 1.03 * middle)),
            (file, "beyond every side", alpha, camera(at(0.35), center, near * 0.02, far)),
            (file, "sub-pixel triangles", alpha, camera(at(9), center, 9 * near - far, 10 * far))]


def scenes(models):
    found = []
    for name, center, eye, near, far in (("bunny.glb", [0, 0, 0], [0.6, 0.4, 3], 1.9, 4.2),
                                         ("dragon.glb", [-0.005, 0.122, -0.005], [0.03, 0.16, 0.275], 0.2, 0.4)):
        if (models / name).exists():
            found += model_views(str(models / name), center, eye, near, far, "0.37" if name == "bunny.glb" else "0.3")
    inside = [camera([0.1, 0.2, 0.3], [-1, 0.3, -0.5], 0.05, 1.0, 90), camera([0, 0, 1.1], [0, 0, 0], 0.3, 1.6, 70),
              camera([-0.6, 0.4, 0.5], [0.4, -0.2, 0], 0.4, 0.9, 100), camera([0.9, -0.9, 0.9], [0, 0, 0], 0.1, 3.0, 60)]
    for seed in range(1, 9):
        triangles = 400 if seed % 2 else 5000
        found.append((f"random:seed={seed},triangles={triangles}", "cut on every side", None, inside[seed % len(inside)]))
    found += [("random:seed=21,triangles=40000", "far off", None, camera([3, 2, 9], [0, 0, 0], 6, 13)),
              ("volume-beam:slices=24", "whole", None, camera([0.8, 0.6, 3.9], [0, 0, 0], 2.5, 5.5, 45)),
              ("volume-beam:slices=24", "from within", None, camera([0.2, 0.1, 0.9], [0, 0, 0], 0.05, 1.4, 80)),
              ("planes:count=12", "whole", None, None),
              ("teapot", "whole", "0.5", None)]
    return found


def run(program, scene, size, formats, driver, jobs, folder):
    spec, _, alpha, view = scene
    words = [program, spec, "--driver", driver, "--size", size, "--color", formats[0], "--depth", formats[1], "--check", "--compare",
             "--repeat", "1", "--warm-up", "0", "--each-pass", str(MOST_PASSES), "--algorithm", ",".join(jobs)]
    if alpha:
        words += ["--alpha", alpha]
    if view:
        path = pathlib.Path(folder) / "camera.json"
        path.write_text(json.dumps(view))
        words += ["--camera", str(path)]
    ended = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if ended.returncode not in (0, 1):
        sys.exit(f"driver_differences.py: {' '.join(words)}: {ended.stderr.strip()}")
    lines = [json.loads(line) for line in ended.stdout.splitlines()]
    return ended.stderr.strip().splitlines()[0], lines[:-1], lines[-1]["coverage"]


def cell(job):
    """Pixels that differ in the last picture, and in those of earlier passes; or the two numbers of passes if they differ."""
    text = str(job["strata"]["differ"] + job["each_pass"]["differ"])
    if job["algorithm"] != "depth" and job["geometry_passes"] != job["strata"]["geometry_passes"]:
        text += f" ({job['geometry_passes']} and {job['strata']['geometry_passes']} passes)"
    return text


class Journal:
    """Finished measurements, a line of JSON each; without a file none are stored."""
    def __init__(self, file):
        self.path = pathlib.Path(file) if file else None
        lines = self.path.read_text().splitlines() if self.path and self.path.exists() else []
        self.done = dict(json.loads(line) for line in lines)

    def once(self, name, measure):
        if name not in self.done:
            self.done[name] = measure()
            if self.path:
                with self.path.open("a") as file:
                    file.write(json.dumps([name, self.done[name]]) + "\n")
        return self.done[name]


class Table:
    """The rows of one driver, and their sums."""
    def __init__(self, driver):
        self.driver, self.rows, self.renderer = driver, [], ""
        self.pixels = self.fragments = self.clipped = self.wrong = 0
        self.differ = {"coverage": 0}  # by job
    def add(self, scene, size, formats, jobs, coverage):
        found = {job["algorithm"]: job for job in jobs}
        self.fragments += coverage["fragments"]
        self.clipped += coverage["clipped"]
        self.differ["coverage"] += coverage["differ"]
        for name, job in found.items():
            pictures = 1 + job["each_pass"]["pictures"]
            self.pixels += coverage["pixels"] * pictures
            self.differ[name] = self.differ.get(name, 0) + job["strata"]["differ"] + job["each_pass"]["differ"]
        self.wrong += coverage["differ"] + sum(found[job]["strata"]["differ"] + found[job]["each_pass"]["differ"] for job in found)
        name = f"{pathlib.Path(scene[0]).name}, {scene[1]}"
        self.rows.append([name, size, " ".join(formats), str(coverage["fragments"]), str(coverage["clipped"]), str(coverage["differ"]),
                          *(cell(found[job]) if job in found else "-" for job in JOBS)])

    def text(self):
        head = ["scene", "size", "formats", "fragments", "cut triangles", "coverage", *JOBS]
        total = ["all", "", "", str(self.fragments), str(self.clipped), *(str(self.differ.get(key, "-")) for key in ["coverage", *JOBS])]
        lines = [f"## {self.driver}", f"{self.renderer}: {len(self.rows)} scenes, {self.pixels:,} pixels of pictures compared.", ""]
        lines += ["| " + " | ".join(row) + " |" for row in [head, ["---"] * 3 + ["---:"] * (len(head) - 3), *self.rows, total]]
        return "\n".join(lines) + "\n"


def jobs_of(driver, scene, formats, index):
    """Omits coherent_stencil with D16, which has no stencil buffer in OpenGL, and for scenes of hundreds of passes. softpipe is slow: its colours are
    compared only for a few scenes of rgba8."""
    if driver == "softpipe":
        return [job for job in JOBS if job != "weighted_average_pow"] if index % 6 == 0 else ["depth"]
    coherent = formats[1] != "d16" and not scene[0].endswith("000")
    return [job for job in JOBS if job != "coherent_stencil" or coherent]


def page(tables):
    """The totals; the rows of all scenes are in build/bench/differences.txt."""
    head = ["driver", "scenes", "pixels compared", "coverage", *JOBS]
    rows = [[table.driver, str(len(table.rows)), f"{table.pixels:,}", *(str(table.differ.get(key, "-")) for key in ["coverage", *JOBS])] for table in tables]
    return "\n".join([
        "# Pixels that differ from Mesa's drivers", "",
        "Strata, under the profile of each name, compared with the software drivers of Mesa by `tools/lab/bench/driver_differences.py`, which also writes a row",
        "for each scene to `build/bench/differences.txt`. The columns count pixels of which any bit differs: in the number of fragments (coverage), the",
        f"nearest depth, and the picture of an algorithm or the pictures after 1 to {MOST_PASSES} geometry passes, which compare every layer separately.", "",
        *("| " + " | ".join(row) + " |" for row in [head, ["---"] + ["---:"] * (len(head) - 1), *rows]), "",
        *(f"{table.driver}: {table.renderer}" for table in tables), "",
        "- Scenes: bunny, dragon, teapot, planes, beams and random triangles, of which some cross every side of the view, in five sizes.",
        "- Formats: rgba8, rgba16f and rgba32f with d16, d24 and d32f. The depths of dual are binary32; the sums of the average are binary16 except in rgba32f.",
        "- weighted_average_pow is the average with GLSL's pow, compared with a model of llvmpipe's pow (pipeline/reference/mesa-rasterizers.md 2.10) on Strata's sums.",
        "- OpenGL has no stencil buffer with D16, and scenes with hundreds of iterations are omitted for coherent_stencil.",
        "- softpipe is slow: its colours are compared only in the scenes with rgba8 and d32f.", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", default=str(ROOT / "../shared/models"), help="folder with bunny.glb and dragon.glb")
    parser.add_argument("--program", default=str(ROOT / "build/release/strata_port_beside"), help="the built strata_port_beside")
    parser.add_argument("--drivers", default=",".join(DRIVERS), help="of %(default)s")
    parser.add_argument("--quick", action="store_true", help="every fifth scene: to try the script")
    parser.add_argument("--journal", help="a file of scenes that are done: a run that was broken off goes on from there")
    parser.add_argument("--out", default=str(HERE / "DIFFERENCES.md"))
    options = parser.parse_args()
    if not pathlib.Path(options.program).exists():
        sys.exit(f"driver_differences.py: --program: expected the built strata_port_beside, found nothing at {options.program}")
    tables, journal = [], Journal(options.journal)
    with tempfile.TemporaryDirectory() as folder:
        for driver in options.drivers.split(","):
            table = Table(driver)
            for index, scene in enumerate(scenes(pathlib.Path(options.models))):
                if options.quick and index % 5 != 0:
                    continue
                size, formats = SIZES[index % len(SIZES)], FORMATS[index % len(FORMATS)]
                table.renderer, jobs, coverage = journal.once(
                    f"{driver} {index}", lambda: run(options.program, scene, size, formats, driver, jobs_of(driver, scene, formats, index), folder))
                table.add(scene, size, formats, jobs, coverage)
                print(driver, *table.rows[-1], sep="  ", file=sys.stderr, flush=True)
            tables.append(table)
    rows = ROOT / "build/bench/differences.txt"
    rows.parent.mkdir(parents=True, exist_ok=True)
    rows.write_text("\n".join(table.text() for table in tables))
    pathlib.Path(options.out).write_text(page(tables))
    return 1 if any(table.wrong for table in tables) else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Measures Mesa's llvmpipe (strata_port_beside) and Strata (strata bench) alternately on the same scenes and prints the ratio of each pair.

Exit status 0: the programs drew the same fragments in the same number of passes; 1: they did not; 2: bad usage.
tools/lab/bench/README.md explains the fairness of the comparison."""
import argparse
import json
import os
import pathlib
import random
import resource
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "port"))
import shapes  # noqa: E402

LONG_JOB = 10  # seconds of one llvmpipe measurement: such a job is measured once

# The scenes of the table. With the camera of the dragon it spans the whole width of the picture.
SCENES = {
    "bunny": {"model": "bunny.glb", "alpha": "0.5",
              "camera": {"eye": [0.6, 0.4, 3], "center": [0, 0, 0], "up": [0, 1, 0],
                         "fovy_degrees": 42, "near": 1.9, "far": 4.2}},
    "dragon": {"model": "dragon.glb", "alpha": "0.5",
               "camera": {"eye": [0.03, 0.16, 0.275], "center": [-0.005, 0.122, -0.005], "up": [0, 1, 0],
                          "fovy_degrees": 42, "near": 0.2, "far": 0.4}},
    "planes": {"scene": "volume-beam:slices=256", "quick_scene": "volume-beam:slices=64", "alpha": None,
               "camera": {"eye": [0.8, 0.6, 3.9], "center": [0, 0, 0], "up": [0, 1, 0],
                          "fovy_degrees": 45, "near": 2.5, "far": 5.5}},
    # 1,047,554 triangles, most of them smaller than a pixel; only if requested by name.
    "dense": {"scene": "teapot:tessellation=128", "alpha": "0.5",
              "camera": {"eye": [0.2, 4.5, 6], "center": [0.2, 1.2, 0], "up": [0, 1, 0],
                         "fovy_degrees": 45, "near": 2, "far": 14}},
    # Generated: short line segments and points of one pixel anywhere in a cube.
    "segments": {"kind": shapes.LINES, "count": 1_000_000, "quick_count": 100_000, "alpha": None, "camera": shapes.CAMERAS["wide"]},
    "points": {"kind": shapes.POINTS, "count": 1_000_000, "quick_count": 100_000, "alpha": None, "camera": shapes.CAMERAS["wide"]},
}
LONGEST = 0.01  # half the extent of a segment's box, in units of the cube, whose sides are 2
# The profile under which Strata is timed: llvmpipe's coverage with planes, codes and blends that are rounded once, for which Strata has fast paths.
TIMED_PROFILE = {"base": "llvmpipe", "name": "llvmpipe_once",
                 "raster": {"clip": "guard_band", "viewport": "separate", "plane_rule": "exact", "depth_rounding": "nearest"},
                 "blend_rounding": "nearest", "unorm_rounding": "half_up", "half_rounding": "nearest_even"}
ALGORITHMS = ["depth", "weighted_average", "dual", "front_to_back"]

# The required ratios with 2 threads at 1024x1024.
ASKED = {(scene, job): ratio for scene in ("bunny", "dragon")
         for job, ratio in (("depth", 4), ("weighted_average", 3.5), ("dual", 20), ("front_to_back", 20))}
ASKED |= {("planes", "depth"): 1, ("planes", "weighted_average"): 2, ("planes", "dual"): 50, ("planes", "front_to_back"): 50,
          ("segments", "dual"): 5, ("points", "dual"): 5}


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", help="the folder with bunny.glb and dragon.glb")
    parser.add_argument("--build", default="build/release", help="where strata and strata_port_beside are (default build/release)")
    parser.add_argument("--strata", help="another program than BUILD/strata")
    parser.add_argument("--scenes", default=",".join(name for name in SCENES if name != "dense"), help="of %(default)s, dense")
    parser.add_argument("--algorithms", default=",".join(ALGORITHMS), help="of %(default)s")
    parser.add_argument("--pairs", type=int, default=5, help="runs of each program, in turn (default 5)")
    parser.add_argument("--repeat", type=int, default=7, help="times of each run, whose median counts (default 7)")
    parser.add_argument("--clock", choices=("wall", "processor"), default="wall",
                        help="processor: seconds that a frame keeps all threads busy, for a machine that does other work too")
    parser.add_argument("--threads", default="2")
    parser.add_argument("--size", default="1024x1024")
    parser.add_argument("--quick", action="store_true", help="peel 64 planes instead of 256, and a tenth of the lines and points")
    parser.add_argument("--json", help="write everything that was measured to this file")
    options = parser.parse_args()
    for name, known in (("scenes", list(SCENES)), ("algorithms", ALGORITHMS)):
        chosen = getattr(options, name).split(",")
        for word in chosen:
            if word not in known:
                parser.error(f"--{name}: expected {', '.join(known)}, found '{word}'")
        setattr(options, name, chosen)
    return options


def processor_seconds():
    """The processor time of all processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(words):
    """Returns the standard output; standard error is shown to the user."""
    ended = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if ended.returncode not in (0, 1):
        sys.exit(f"side_by_side.py: {' '.join(words)}: {ended.stderr.strip().splitlines()[-1:]}")
    return ended.stdout, ended.stderr


def write_shapes(folder, scene, quick):
    """Writes a generated scene of `count` lines or points once and returns its path."""
    lines, count = scene["kind"] == shapes.LINES, scene["quick_count" if quick else "count"]
    path = os.path.join(folder, f"{scene['kind']}.gltf")
    if not os.path.exists(path):
        lot, points = random.Random(58), []
        for _ in range(count):
            middle = shapes.anywhere(lot)
            points += [[x + lot.uniform(-LONGEST, LONGEST) for x in middle] for _ in range(2)] if lines else [middle]
        builder = shapes.scenes.Builder()
        shapes.shape(builder, points, scene["kind"], lot)
        with open(path, "w", encoding="ascii") as file:
            file.write(builder.text())
    return path


def timed_profile(folder):
    """Writes TIMED_PROFILE to a file."""
    path = os.path.join(folder, "timed.json")
    with open(path, "w", encoding="ascii") as file:
        json.dump(TIMED_PROFILE, file)
    return path


class Bench:
    def __init__(self, options, folder):
        self.options = options
        self.folder = folder
        self.profile = timed_profile(folder)

    def words(self, name, algorithm):
        """The options that both programs get."""
        scene, o = SCENES[name], self.options
        camera = os.path.join(self.folder, name + ".json")
        with open(camera, "w", encoding="ascii") as file:
            json.dump(scene["camera"], file)
        peels = algorithm in ("dual", "front_to_back")
        if "kind" in scene:
            spec = write_shapes(self.folder, scene, o.quick)
        else:
            spec = os.path.join(o.models, scene["model"]) if "model" in scene else scene["quick_scene" if o.quick and peels else "scene"]
        alpha = ["--alpha", scene["alpha"]] if scene["alpha"] else []
        return [spec, "--camera", camera, *alpha, "--size", o.size, "--threads", o.threads]

    def coverage(self, name):
        out, said = run([os.path.join(self.options.build, "strata_port_beside"), *self.words(name, ""), "--check"])
        return {"scene": name, "renderer": said.strip().splitlines()[-1], **json.loads(out)["coverage"]}

    def mesa(self, name, algorithm, *often):
        out, _ = run([os.path.join(self.options.build, "strata_port_beside"), *self.words(name, algorithm),
                      "--algorithm", algorithm, "--budget", str(LONG_JOB), *often])
        job = json.loads(out)
        return {"all": job["seconds"], "passes": job["geometry_passes"]}

    def strata(self, name, algorithm, *often):
        result = os.path.join(self.folder, "strata.json")
        program = self.options.strata or os.path.join(self.options.build, "strata")
        run([program, "bench", *self.words(name, algorithm), "--algorithm", algorithm,
             "--profile", "llvmpipe" if "kind" in SCENES[name] else self.profile,  # rounded once, lines have no rule
             "--execution", "replay", "--output", result, *often])
        with open(result, encoding="utf-8") as file:
            job = json.load(file)["jobs"][0]
        return {"all": job["seconds"]["all"], "passes": job["geometry_passes"]}

    def timed(self, program, name, algorithm):
        """The time of one frame of `program`: the median of its elapsed times, or the processor time of each further frame."""
        repeat = self.options.repeat
        if self.options.clock == "wall":
            found = program(name, algorithm, "--repeat", str(repeat))
            return {**found, "seconds": statistics.median(found["all"])}
        clock = [processor_seconds()]
        for count in (1, 1 + repeat):
            found = program(name, algorithm, "--repeat", str(count), "--warm-up", "0")
            clock.append(processor_seconds())
        one, all_of_them = clock[1] - clock[0], clock[2] - clock[1]
        further = max(len(found["all"]) - 1, 1)  # a job of many seconds ends early
        return {**found, "seconds": max(1e-6, all_of_them - one) / further}

    def job(self, name, algorithm):
        pairs = []
        while len(pairs) < self.options.pairs and not (pairs and pairs[-1]["llvmpipe"]["seconds"] > LONG_JOB):
            pair = {"llvmpipe": self.timed(self.mesa, name, algorithm), "strata": self.timed(self.strata, name, algorithm)}
            pairs.append({**pair, "ratio": pair["llvmpipe"]["seconds"] / pair["strata"]["seconds"]})
        return {"scene": name, "algorithm": algorithm, "asked": ASKED.get((name, algorithm)), "pairs": pairs,
                "ratio": statistics.median(pair["ratio"] for pair in pairs)}


def milliseconds(pairs, program):
    return f"{1000 * statistics.median(pair[program]['seconds'] for pair in pairs):.1f}"


def same_passes(job):
    return all(pair["llvmpipe"]["passes"] == pair["strata"]["passes"] for pair in job["pairs"])


def row(job):
    last = job["pairs"][-1]
    passes = str(last["llvmpipe"]["passes"])
    if not same_passes(job):
        passes += f" / {last['strata']['passes']}"
    return [job["scene"], job["algorithm"], passes, milliseconds(job["pairs"], "llvmpipe"),
            milliseconds(job["pairs"], "strata"), " ".join(f"{pair['ratio']:.1f}" for pair in job["pairs"]),
            f"{job['ratio']:.1f}", str(job["asked"] or "-")]


def print_table(rows):
    widths = [max(len(line[i]) for line in rows) for i in range(len(rows[0]))]
    for line in rows:
        cells = [cell.ljust(width) if i < 2 else cell.rjust(width) for i, (cell, width) in enumerate(zip(line, widths))]
        print("  ".join(cells).rstrip())


def main():
    options = parse()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options, folder)
        coverage = [bench.coverage(name) for name in options.scenes]
        print(coverage[0]["renderer"])
        for found in coverage:
            print(f"{found['scene']}: coverage: {found['differ']} of {found['pixels']} pixels differ, "
                  f"{found['fragments']} fragments", flush=True)
        jobs = []
        for name in options.scenes:
            for algorithm in options.algorithms:
                print(f"{name}, {algorithm}", file=sys.stderr, flush=True)
                jobs.append(bench.job(name, algorithm))
    print_table([["scene", "algorithm", "passes", "llvmpipe ms", "strata ms", "ratio of each pair", "median", "asked"],
                 *map(row, jobs)])
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"size": options.size, "threads": options.threads, "coverage": coverage, "jobs": jobs}, file, indent=2)
    return 0 if all(found["differ"] == 0 for found in coverage) and all(map(same_passes, jobs)) else 1


if __name__ == "__main__":
    sys.exit(main())

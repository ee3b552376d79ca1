#!/usr/bin/env python3
"""Tests bounds on times other than those of peels.py: of formats, devices, and commands with all algorithms.

    tools/lab/bench/bounds.py [--models ../shared/models] [--captures ../shared/nv2a] [--before STRATA] [--repeat 3] [--rows formats,...]

Needs only the standard library. Every ratio is of two times that are measured alternately, each the least of `--repeat`, on which other programs have
the least effect: the fastest of some frames on one thread for a job, the processor time for a whole command.
`--before` is a built command to compare whole commands with; without it their rows are omitted. Exit status 1 if a bound is exceeded.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from peels import ROOT, bench_command, frame_ms, processor_ms

MODEL_SIZE, SLICES = "1024x1024", "volume-beam:slices=64,order=near"
FRAMES = 5  # of a job in one measurement
LAYER_SIZE = {"planes": "96x96", "teapot": "256x256", "bunny": "256x256"}
LAYER_PROFILES = ("geforce3", "geforce8", "ideal")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--strata", default=str(ROOT / "build/release/strata"), help="the built command")
    parser.add_argument("--before", help="another build of it, for the rows that compare whole commands")
    parser.add_argument("--models", default=str(ROOT / "../shared/models"), help="folder with bunny.glb and dragon.glb")
    parser.add_argument("--captures", default=str(ROOT / "../shared/nv2a"), help="pictures for hardware-check")
    parser.add_argument("--size", default=MODEL_SIZE, help="of the models' frames")
    parser.add_argument("--repeat", type=int, default=3, help="pairs of a row")
    parser.add_argument("--rows", default="formats,devices,drivers,layers,check", help="which groups of rows")
    options = parser.parse_args()
    if not pathlib.Path(options.strata).exists():
        sys.exit(f"bounds.py: --strata: expected the built command, found nothing at {options.strata}")
    return options


class Table:
    def __init__(self, repeat):
        self.repeat, self.kept = repeat, True
        print("| what | first ms | second ms | ratio | bound | kept |\n|" + "---|" * 6)

    def row(self, what, first, second, bound, at_least=False):
        """`first` and `second` return milliseconds; the bound is on first / second."""
        pairs = [(first(), second()) for _ in range(self.repeat)]
        a, b = (min(of_side) for of_side in zip(*pairs))
        ratio = a / b
        keeps = ratio >= bound if at_least else ratio <= bound
        self.kept = self.kept and keeps
        print(f"| {what} | {a:.1f} | {b:.1f} | {ratio:.2f} | {'at least' if at_least else 'at most'} {bound} | "
              f"{'yes' if keeps else '**no**'} |", flush=True)


def models(options):
    for name in ("bunny", "dragon"):
        path = pathlib.Path(options.models) / f"{name}.glb"
        if path.exists():
            yield name, str(path)
        else:
            print(f"bounds.py: no {path}: its rows are missing", file=sys.stderr)


def frame(options, scene, size, profile, color_format, algorithm, extra=()):
    command = bench_command(options, scene, size, profile, color_format, extra)
    return lambda: frame_ms(command, algorithm, FRAMES)


def format_rows(options, table):
    scenes = [("64 planes", SLICES, "128x128", ()), *((n, p, options.size, ("--alpha", "0.5")) for n, p in models(options))]
    for name, scene, size, extra in scenes:
        for algorithm in ("dual", "weighted_average"):
            for color_format, bound in (("rgba16f", 1.5), ("rgba32f", 2)):
                table.row(f"{name}, {algorithm}, {color_format} to rgba8",
                          frame(options, scene, size, "geforce8_dx101", color_format, algorithm, extra),
                          frame(options, scene, size, "geforce8_dx101", "rgba8", algorithm, extra), bound)


def device_rows(options, table):
    alpha = ("--alpha", "0.5")
    for name, scene in models(options):
        for algorithm in ("depth", "depth_units"):
            table.row(f"{name}, {algorithm}, geforce3 to geforce8", frame(options, scene, options.size, "geforce3", "rgba8", algorithm, alpha),
                      frame(options, scene, options.size, "geforce8", "rgba8", algorithm, alpha), 1.5)
        # After its last layer depth_units draws no fragment; shadow_map draws layers again that lie behind themselves (2 and 0.6 million fragments of
        # the bunny in eight passes).
        for passes in (2, 8):
            limited = (*alpha, "--max-passes", str(passes))
            table.row(f"{name}, {passes} passes on geforce3, shadow_map to depth_units",
                      frame(options, scene, options.size, "geforce3", "rgba8", "shadow_map", limited),
                      frame(options, scene, options.size, "geforce3", "rgba8", "depth_units", limited), 1.5)


def driver_rows(options, table):
    """Profiles of Mesa's software drivers compared with one that has exact planes."""
    for name, scene in models(options):
        for algorithm in ("dual", "front_to_back"):
            times = lambda profile: frame(options, scene, options.size, profile, "rgba8", algorithm, ("--alpha", "0.5"))
            for driver in ("llvmpipe", "llvmpipe_sse", "softpipe"):
                table.row(f"{name}, {algorithm}, {driver} to geforce8", times(driver), times("geforce8"), 2)


def layers_command(strata, scene, size, profile, algorithm, extra, folder):
    return [strata, "layers", scene, "--size", size, "--profile", profile, "--algorithm", algorithm, "--threads", "1", *extra,
            "-o", f"{folder}/layers.exr", "--stats", f"{folder}/stats.json"]


def layered(options, profile, folder):
    """The algorithms whose layers both commands write with a profile."""
    listed = subprocess.run([options.strata, "list", "algorithms", "--json"], stdout=subprocess.PIPE, check=True)
    names = [each["name"] for each in json.loads(listed.stdout)]
    writes = lambda strata, name: subprocess.run(layers_command(strata, "teapot", "8x8", profile, name, (), folder),
                                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0
    return [name for name in names if writes(options.before, name) and writes(options.strata, name)]


def layer_rows(options, table):
    """Whole commands with audit, one for each algorithm: the sums of their times."""
    alpha = ("--alpha", "0.5")
    scenes = [("planes", SLICES, ()), ("teapot", "teapot", ()), *((n, p, alpha) for n, p in models(options) if n == "bunny")]
    with tempfile.TemporaryDirectory() as folder:
        for profile in LAYER_PROFILES:
            names = layered(options, profile, folder)
            print(f"bounds.py: layers on {profile}: {', '.join(names)}", file=sys.stderr)
            for name, scene, extra in scenes:
                times = lambda strata: lambda: sum(
                    processor_ms(layers_command(strata, scene, LAYER_SIZE[name], profile, a, extra, folder)) for a in names)
                table.row(f"strata layers, {name}, {profile}, {len(names)} algorithms, before to now", times(options.before),
                          times(options.strata), 2, at_least=True)


def check_rows(options, table):
    if not pathlib.Path(options.captures).is_dir():
        return print(f"bounds.py: no {options.captures}: its row is missing", file=sys.stderr)
    check = ["hardware-check", options.captures, "--json"]
    table.row("strata hardware-check, before to now", lambda: processor_ms([options.before, *check]),
              lambda: processor_ms([options.strata, *check]), 2, at_least=True)


def main():
    options = parse_arguments()
    table = Table(options.repeat)
    groups = {"formats": format_rows, "devices": device_rows, "drivers": driver_rows, "layers": layer_rows, "check": check_rows}
    for name in options.rows.split(","):
        if name not in groups:
            sys.exit(f"bounds.py: --rows: expected {', '.join(groups)}, found '{name}'")
        if name in ("layers", "check") and not options.before:
            print(f"bounds.py: no --before: the rows of {name} are missing", file=sys.stderr)
            continue
        groups[name](options, table)
    sys.exit(0 if table.kept else 1)


if __name__ == "__main__":
    main()

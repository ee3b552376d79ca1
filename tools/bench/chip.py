#!/usr/bin/env python3
"""The chip's own interpolators beside float32: geforce3's time over geforce8's, and shadow_map's pass over depth_units'.

    tools/bench/chip.py [--size 1024x1024] [--models ../shared/models] [--scenes bunny,dragon] [--repeat 8] [--count]

Standard library alone. Jobs by turns, on one thread: a job's time is that of its quickest turn, which other work on the machine disturbs least.
--count adds instructions (valgrind, on AVX2), which no other work on the machine changes. The exit status is 1 if a bound is missed.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import peels  # noqa: E402

MOST = 1.5
TURNS = 5
PASSES = 20  # of shadow_map, which never ends at D24
PAIRS = [("depth", "geforce3", "depth", "geforce8"), ("depth_units", "geforce3", "depth_units", "geforce8"),
         ("shadow_map", "geforce3", "depth_units", "geforce3")]


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--strata", default=str(peels.ROOT / "build/release/strata"), help="the built command")
    parser.add_argument("--models", default=str(peels.ROOT / "../shared/models"), help="folder with bunny.glb and dragon.glb")
    parser.add_argument("--scenes", default="bunny,dragon", help="which of the two")
    parser.add_argument("--size", default="1024x1024")
    parser.add_argument("--repeat", type=int, default=8, help="frames of a job that are timed together")
    parser.add_argument("--count", action="store_true", help="count instructions, too: a minute a row")
    options = parser.parse_args()
    if not pathlib.Path(options.strata).exists():
        sys.exit(f"chip.py: --strata: expected the built command, found nothing at {options.strata}")
    return options


def command_of(options, model, algorithm, profile):
    limit = ["--max-passes", str(PASSES)] if algorithm == "shadow_map" else []
    return [*peels.bench_command(options, str(model), options.size, profile, "rgba8", ["--alpha", "0.5"]), *limit]


def passes_of(command, algorithm):
    done = subprocess.run([*command, "--algorithm", algorithm, "--threads", "1", "--warm-up", "0", "--repeat", "1", "--json"],
                          stdout=subprocess.PIPE, text=True, check=True)
    return int(re.search(r'"geometry_passes": *(\d+)', done.stdout).group(1))


def instructions(command, algorithm, frames):
    """Of so many frames, with loading and starting."""
    with tempfile.NamedTemporaryFile() as out:
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out.name}", *command, "--algorithm", algorithm,
                               "--threads", "1", "--warm-up", "0", "--simd", "avx2", "--repeat", str(frames)],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if found is None:
        sys.exit(f"chip.py: valgrind counted nothing: {done.stderr.strip()[-300:]}")
    return int(found.group(1))


def main():
    options = parse_arguments()
    kept = True
    print(f"The quickest of {TURNS} turns of {options.repeat} frames at {options.size}, one thread, best instruction set; "
          f"shadow_map has {PASSES} passes, and its ratio is a pass over a pass.\n")
    print("| scene | job | ms | beside it | ms | ratio | most | kept |" + (" instructions | beside it | ratio |" if options.count else ""))
    print("|" + "---|" * (11 if options.count else 8))
    for scene in options.scenes.split(","):
        model = pathlib.Path(options.models) / f"{scene}.glb"
        if not model.exists():
            print(f"chip.py: no {model}: its rows are missing", file=sys.stderr)
            continue
        for job, profile, other, other_profile in PAIRS:
            own, beside = command_of(options, model, job, profile), command_of(options, model, other, other_profile)
            scale = passes_of(beside, other) / passes_of(own, job) if job != other else 1.0
            times = [(peels.frame_ms(own, job, options.repeat), peels.frame_ms(beside, other, options.repeat)) for _ in range(TURNS)]
            quickest = [min(of_job) for of_job in zip(*times)]
            ratio = scale * quickest[0] / quickest[1]
            keeps = ratio <= MOST
            kept = kept and keeps
            row = [scene, f"{job} {profile}", f"{quickest[0]:.1f}", f"{other} {other_profile}",
                   f"{quickest[1]:.1f}", f"{ratio:.2f}", MOST, "yes" if keeps else "**no**"]
            if options.count:
                a, b = (instructions(c, j, 2) - instructions(c, j, 1) for c, j in ((own, job), (beside, other)))
                row += [f"{a / 1e6:.1f} M", f"{b / 1e6:.1f} M", f"{scale * a / b:.2f}"]
            print("| " + " | ".join(str(cell) for cell in row) + " |", flush=True)
    sys.exit(0 if kept else 1)


if __name__ == "__main__":
    main()

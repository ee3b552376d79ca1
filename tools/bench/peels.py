#!/usr/bin/env python3
"""How long every peel takes beside the a_buffer of the same run: by device, format, layers and limits.

    tools/bench/peels.py [--slices 64,256] [--size 512x512] [--orders near] [--models ../shared/models] [--formats rgba8] [--repeat 3]

Standard library alone. A row is a job on one thread. Jobs of a profile, format and limit run by turns, `--repeat` frames a turn; a job's time is
that of its quickest frames (the tenth part), which other work on the machine disturbs least. Its ratio is over a_buffer's of the same profile, format and run. `most` is what the ratio is to keep to; the exit status is 1 if one does not. Where an
algorithm's own listing needs half as many iterations as there are layers, each over all that is left, `most` is in visits: fragments that
its programs may run on for each fragment of the stack, which is iterations times what one of them keeps.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FORMATS = {"geforce3": ["rgba8"], "geforce8": ["rgba8", "rgba16f", "rgba32f"], "geforce8_dx101": ["rgba8", "rgba16f", "rgba32f"],
           "ideal": ["rgba8", "rgba16f", "rgba32f"]}
PEELS = ["front_to_back", "dual", "dual_independent", "depth_units", "shadow_map_depth_replace", "layer_peel", "coherent_stencil",
         "coherent_blend", "coherent_ideal", "stencil_routed_k_buffer", "hybrid", "batched"]
MOST_ON_SLICES, MOST_ON_MODELS = 2.5, {"batched": 3.0, "stencil_routed_k_buffer": 3.0}
# FragmentWaves a fragment, iterations times what one keeps: coherent_stencil and coherent_blend keep eight at most for the two layers of an
# iteration (as long as the stencil counts all, up to 255 layers in one place), coherent_ideal five for its layer.
MOST_VISITS = {"coherent_stencil": 4, "coherent_blend": 4, "coherent_ideal": 5}
LIMIT = 20  # of the rows with --max-passes


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--strata", default=str(ROOT / "build/release/strata"), help="the built command")
    parser.add_argument("--slices", default="64,256", help="planes of the stack, with commas between")
    parser.add_argument("--orders", default="near,far", help="which end of the stack is drawn first")
    parser.add_argument("--profiles", default=",".join(FORMATS))
    parser.add_argument("--formats", default="rgba8,rgba16f,rgba32f", help="of those that a profile has")
    parser.add_argument("--limits", default=f"all,{LIMIT}", help="passes at most; all: to the last layer")
    parser.add_argument("--algorithms", default=",".join(PEELS))
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--model-size", default="1024x1024")
    parser.add_argument("--models", default=str(ROOT / "../shared/models"), help="folder with bunny.glb and dragon.glb; empty: none")
    parser.add_argument("--repeat", type=int, default=5, help="frames of a job in one turn")
    parser.add_argument("--turns", type=int, default=3)
    options = parser.parse_args()
    if not pathlib.Path(options.strata).exists():
        sys.exit(f"peels.py: --strata: expected the built command, found nothing at {options.strata}")
    return options


def processor_ms(command):
    """Processor time of one process."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"peels.py: {' '.join(command)} ended with status {status}")
    return (usage.ru_utime + usage.ru_stime) * 1e3


def frame_seconds(command, algorithm, frames):
    """Of each frame in one process, on one thread."""
    whole = [*command, "--algorithm", algorithm, "--threads", "1", "--warm-up", "0", "--repeat", str(frames), "--json"]
    done = subprocess.run(whole, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"peels.py: {' '.join(whole)} ended with exit status {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)["jobs"][0]["seconds"]["all"]


def quick_ms(seconds):
    """The slowest of the quickest tenth."""
    return sorted(seconds)[(len(seconds) - 1) // 10] * 1e3


def frame_ms(command, algorithm, frames):
    """Milliseconds of a frame, by one process."""
    return quick_ms(frame_seconds(command, algorithm, frames))


def bench_command(options, scene, size, profile, color_format, extra=()):
    return [options.strata, "bench", scene, "--size", size, "--profile", profile, "--color-format", color_format, *extra]


def jobs(options, scene, size, profile, color_format, extra):
    """Milliseconds by algorithm; what the profile refuses is missing."""
    tried = [*bench_command(options, "teapot", "8x8", profile, color_format, extra), "--algorithm", "a_buffer," + options.algorithms,
             "--repeat", "1", "--warm-up", "0", "--json"]
    done = subprocess.run(tried, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"peels.py: {' '.join(tried)} ended with exit status {done.returncode}: {done.stderr.strip()}")
    command = bench_command(options, scene, size, profile, color_format, extra)
    seconds = {job["algorithm"]: [] for job in json.loads(done.stdout)["jobs"]}
    for _ in range(options.turns):
        for algorithm, own in seconds.items():
            own += frame_seconds(command, algorithm, options.repeat)
    return {algorithm: quick_ms(own) for algorithm, own in seconds.items()}


def visits(options, scene, size, profile, color_format, extra, algorithm):
    """Fragments that the algorithm's programs run on, for each fragment of the list."""
    command = [*bench_command(options, scene, size, profile, color_format, extra), "--algorithm", f"unsorted,{algorithm}", "--repeat", "1",
               "--warm-up", "0", "--counters", "--json"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"peels.py: {' '.join(command)} ended with exit status {done.returncode}: {done.stderr.strip()}")
    once, job = json.loads(done.stdout)["jobs"]
    return job["visited"] / once["fragments"]


def scenes_of(options):
    for slices in filter(None, options.slices.split(",")):
        for order in options.orders.split(","):
            yield f"volume-beam:slices={slices},order={order}", options.size, [], MOST_ON_SLICES, {}, MOST_VISITS
    for model in ("bunny", "dragon") if options.models else ():
        path = pathlib.Path(options.models) / f"{model}.glb"
        if path.exists():
            yield str(path), options.model_size, ["--alpha", "0.5"], 2.0, MOST_ON_MODELS, {}
        else:
            print(f"peels.py: no {path}: its rows are missing", file=sys.stderr)


def finding(limit, found):
    """A sentence on all rows of a limit; `found`: by algorithm, pairs of a ratio and whether it is kept."""
    named = sorted((statistics.median(ratio for ratio, _ in pairs), algorithm, all(kept for _, kept in pairs)) for algorithm, pairs in found.items())
    said = {kept: ", ".join(f"{algorithm} {median:.1f}" for median, algorithm, keeps in named if keeps == kept) for kept in (True, False)}
    what = "Peeled to the last layer" if limit == "all" else f"Ended after {limit} passes"
    return (f"{what}, {'no peel keeps' if not said[True] else said[True] + ' keep'} the bound in every row (medians over a_buffer); "
            f"beyond it in some: {said[False] or 'none'}.")


def print_summary(ratios):
    """`ratios`: by algorithm and limit, pairs of a ratio and whether it is kept."""
    print()
    for limit in dict.fromkeys(limit for _, limit in ratios):
        print(finding(limit, {algorithm: pairs for (algorithm, own), pairs in ratios.items() if own == limit}))
    print("\n## By algorithm\n\n| job | passes | rows | least | median | greatest | kept |\n|" + "---|" * 7)
    for (algorithm, limit), found in ratios.items():
        values = [ratio for ratio, _ in found]
        print(f"| {algorithm} | {limit} | {len(found)} | {min(values):.2f} | {statistics.median(values):.2f} | {max(values):.2f} | "
              f"{sum(kept for _, kept in found)} |")


def main():
    options = parse_arguments()
    kept, ratios = True, {}
    print(f"# Every peel beside the oracle\n\nMade by `tools/bench/peels.py {' '.join(sys.argv[1:])}`: a frame on one thread, the quickest tenth of "
          f"{options.turns} x {options.repeat}; ratios over the a_buffer of the same profile, format and run. `most` is what a ratio is to keep to.\n")
    print("| scene | profile | format | passes | job | ms | a_buffer | ratio | visits | most | kept |")
    print("|" + "---|" * 11)
    for scene, size, extra, most, exceptions, most_visits in scenes_of(options):
        for profile in options.profiles.split(","):
            for color_format in [f for f in FORMATS.get(profile, ["rgba8"]) if f in options.formats.split(",")]:
                for limit in [[] if most_passes == "all" else ["--max-passes", most_passes] for most_passes in options.limits.split(",")]:
                    times = jobs(options, scene, size, profile, color_format, extra + limit)
                    base = times.pop("a_buffer")
                    for algorithm, ms in times.items():
                        bound = exceptions.get(algorithm, most)
                        keeps, found = ms <= bound * base, "-"
                        if algorithm in most_visits and not limit:
                            bound = most_visits[algorithm]
                            found = visits(options, scene, size, profile, color_format, extra + limit, algorithm)
                            keeps, bound, found = found <= bound, f"{bound} visits", f"{found:.2f}"
                        kept = kept and keeps
                        ratios.setdefault((algorithm, limit[1] if limit else "all"), []).append((ms / base, keeps))
                        print(f"| {pathlib.Path(scene).stem} | {profile} | {color_format} | {limit[1] if limit else 'all'} | {algorithm} | "
                              f"{ms:.1f} | {base:.1f} | {ms / base:.2f} | {found} | {bound} | {'yes' if keeps else '**no**'} |", flush=True)
    print_summary(ratios)
    sys.exit(0 if kept else 1)


if __name__ == "__main__":
    main()

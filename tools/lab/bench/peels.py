#!/usr/bin/env python3
"""Measures the time of every peel divided by that of a_buffer, by device, format, layers and limits.

    tools/lab/bench/peels.py [--slices 64,256] [--size 512x512] [--orders near] [--models ../shared/models] [--formats rgba8] [--repeat 3]

Writes PEELS.md, and a row for each job to build/bench/peels.txt. Needs only the standard library. A job has one thread. Jobs of a profile, format and
limit are measured alternately, `--repeat` frames at a time; a job's time is the slowest of its fastest tenth of frames, on which other programs have
the least effect. It is divided by the time of a_buffer with the same profile and format. The exit status is 1 if a ratio exceeds its bound.
coherent_* have no bound on planes: from far to near their listings need n / 2 or n iterations for n layers, each over all remaining fragments.
"""
import argparse
import json
import os
import pathlib
import shlex
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
FORMATS = {"geforce3": ["rgba8"], "geforce8": ["rgba8", "rgba16f", "rgba32f"], "geforce8_dx101": ["rgba8", "rgba16f", "rgba32f"],
           "ideal": ["rgba8", "rgba16f", "rgba32f"]}
PEELS = ["front_to_back", "dual", "dual_independent", "depth_units", "shadow_map_depth_replace", "layer_peel", "coherent_stencil",
         "coherent_blend", "coherent_ideal", "stencil_routed_k_buffer", "hybrid", "batched"]
MOST_ON_SLICES, MOST_ON_MODELS = 4.0, {"batched": 3.0, "stencil_routed_k_buffer": 3.0}  # of models: 2.0 for all others
UNBOUNDED_ON_SLICES = {"coherent_stencil", "coherent_blend", "coherent_ideal"}
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
    """Times of the frames of one process, on one thread."""
    whole = [*command, "--algorithm", algorithm, "--threads", "1", "--warm-up", "0", "--repeat", str(frames), "--json"]
    done = subprocess.run(whole, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"peels.py: {' '.join(whole)} ended with exit status {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)["jobs"][0]["seconds"]["all"]


def quick_ms(seconds):
    """The slowest of the fastest tenth."""
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


def scenes_of(options):
    for slices in filter(None, options.slices.split(",")):
        for order in options.orders.split(","):
            yield f"{slices} planes", f"volume-beam:slices={slices},order={order}", options.size, [], {name: None for name in UNBOUNDED_ON_SLICES}, MOST_ON_SLICES
    for model in ("bunny", "dragon") if options.models else ():
        path = pathlib.Path(options.models) / f"{model}.glb"
        if path.exists():
            yield model, str(path), options.model_size, ["--alpha", "0.5"], MOST_ON_MODELS, 2.0
        else:
            print(f"peels.py: no {path}: its rows are missing", file=sys.stderr)


def measure(options):
    """Rows of scene, profile, format, passes, algorithm, milliseconds, milliseconds of a_buffer, bound or None."""
    for name, scene, size, extra, own_bounds, most in scenes_of(options):
        for profile in options.profiles.split(","):
            for color_format in [f for f in FORMATS.get(profile, ["rgba8"]) if f in options.formats.split(",")]:
                for limit in options.limits.split(","):
                    passes = [] if limit == "all" else ["--max-passes", limit]
                    times = jobs(options, scene, size, profile, color_format, extra + passes)
                    base = times.pop("a_buffer")
                    for algorithm, ms in times.items():
                        row = [name, profile, color_format, limit, algorithm, ms, base, own_bounds.get(algorithm, most)]
                        print(*row, file=sys.stderr, flush=True)
                        yield row


def is_kept(row):
    *_, ms, base, most = row
    return most is None or ms <= most * base


def table(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows]) + "\n"


def page(options, rows):
    """The page: medians of the ratios to a_buffer by algorithm and scene, of peels to the last layer and with a limit of passes."""
    columns = list(dict.fromkeys((row[0], row[3]) for row in rows))
    body = []
    for algorithm in dict.fromkeys(row[4] for row in rows):
        cells = []
        for column in columns:
            own = [row for row in rows if row[4] == algorithm and (row[0], row[3]) == column]
            text = f"{statistics.median(row[5] / row[6] for row in own):.1f}" if own else "-"
            cells.append(text if all(is_kept(row) for row in own) else f"**{text}**")
        body.append([algorithm, *cells])
    beyond = [f"{row[4]} on {row[0]}, {row[1]}, {row[2]}: {row[5] / row[6]:.2f}" for row in rows if not is_kept(row)]
    head = ["algorithm", *(name if limit == "all" else f"{name}, {limit} passes" for name, limit in columns)]
    return f"""# All peels compared with the A-buffer

Each figure is the time of a frame, which Strata emulates on a CPU, divided by the time of a_buffer, which sorts all fragments of a pixel and
composites them in binary64; medians over profiles and formats. A bold figure exceeds its bound (planes 4; models 2, batched and
stencil_routed_k_buffer 3) in some row: {"; ".join(beyond) or "none"}.

{table(head, body)}
Made by `tools/lab/bench/peels.py {shlex.join(sys.argv[1:])}`, which writes every row to `build/bench/peels.txt`.

![time per layer against the number of layers](layers.svg)

The diagram is made by `tools/lab/bench/layers.py` (planes at 128x128, geforce8_dx101).

What determines the times:

- A tile's fragments are rasterized and recorded once, as for a_buffer, and sorted once; a pass processes only the fragments that it keeps.
- dual is resolved pixel by pixel from the sorted record, without passes.
- shadow_map_depth_replace keeps the colour and depth of every layer and computes r/q of every fragment.
- dual_independent runs three stages per fragment and pass on three targets.
- stencil_routed_k_buffer and hybrid process every fragment in all stages of a pass.
- For n planes that are submitted from far to near, coherent_stencil and coherent_blend need n / 2 iterations of six or five passes, and
  coherent_ideal n of two, each over all remaining fragments. From near to far, and for models, a pass processes each fragment once.
"""


def main():
    options = parse_arguments()
    rows = list(measure(options))
    head = ["scene", "profile", "format", "passes", "algorithm", "ms", "a_buffer ms", "ratio", "bound", "kept"]
    cells = [[*row[:5], f"{row[5]:.1f}", f"{row[6]:.1f}", f"{row[5] / row[6]:.2f}", str(row[7] or "-"), "yes" if is_kept(row) else "**no**"] for row in rows]
    for path, text in ((ROOT / "tools/lab/bench/PEELS.md", page(options, rows)), (ROOT / "build/bench/peels.txt", table(head, cells))):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    sys.exit(0 if all(is_kept(row) for row in rows) else 1)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Writes tools/lab/bench/PERFORMANCE.md and build/bench/performance.txt: times of `strata bench` for three scenes and, if it is built, the comparison
with Mesa.

    tools/lab/bench/performance.py [--models ../shared/models] [--size 1024x1024] [--repeat 5] [--quick]

Needs only the standard library. Compare ratios; times only show the scale. The numbers of a table are measured alternately.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
import side_by_side  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
ALGORITHMS = side_by_side.ALGORITHMS


class Scene:
    """One of side_by_side.py's scenes, with its camera in a file of `folder`."""
    def __init__(self, name, spec, folder):
        described = side_by_side.SCENES[name]
        camera = pathlib.Path(folder) / f"{name}.json"
        camera.write_text(json.dumps(described["camera"]))
        self.name, self.spec = name, spec
        self.options = ["--camera", str(camera), "--profile", side_by_side.timed_profile(folder)]
        if described["alpha"]:
            self.options += ["--alpha", described["alpha"]]


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--strata", default=str(ROOT / "build/release/strata"), help="the built command")
    parser.add_argument("--models", default=str(ROOT / "../shared/models"), help="folder with bunny.glb and dragon.glb")
    parser.add_argument("--size", default="1024x1024")
    parser.add_argument("--small", default="256x256", help="size where every pass of every algorithm is rasterized")
    parser.add_argument("--slices", type=int, default=256)
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--out", default=str(HERE / "PERFORMANCE.md"))
    parser.add_argument("--quick", action="store_true", help="128x128, 16 slices, one repetition: to try the script")
    options = parser.parse_args()
    if options.quick:
        options.size, options.small, options.slices, options.repeat = "128x128", "64x64", 16, 1
    if not pathlib.Path(options.strata).exists():
        sys.exit(f"performance.py: --strata: expected the built command, found nothing at {options.strata}")
    return options


def scenes_of(options, folder):
    found = []
    for model in ("bunny", "dragon"):
        path = pathlib.Path(options.models) / f"{model}.glb"
        if path.exists():
            found.append(Scene(model, str(path), folder))
        else:
            print(f"performance.py: no {path}: its rows are missing", file=sys.stderr)
    found.append(Scene("planes", f"volume-beam:slices={options.slices}", folder))
    return found


MEASURED = {}
NO_MEMORY = "replay, 0 bytes"  # every pass rasterized, tile by tile
TURNS = range(3)  # repetitions of alternately measured commands


def bench(options, scene, *, small=False, execution="replay", memory="256M", simd="best", effects="needed", threads=2, turn=0, counted=False):
    """The jobs of one `strata bench`, which is called once per turn. `small`: the size at which slow executions take acceptable time."""
    spec = f"volume-beam:slices={options.slices // 4}" if small and scene.name == "planes" else scene.spec
    command = [options.strata, "bench", spec, *scene.options, "--size", options.small if small else options.size,
               "--algorithm", ",".join(ALGORITHMS), "--execution", execution, "--fragment-memory", memory, "--simd", simd,
               "--effects", effects, "--threads", str(threads), "--repeat", str(options.repeat), "--json"]
    if counted:  # literally, each job in a process of its own
        command.insert(-1, "--counters")
    line = " ".join(command)
    if (line, turn) not in MEASURED:
        print(line, file=sys.stderr)
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(f"performance.py: strata bench ended with exit status {done.returncode}")
        MEASURED[line, turn] = json.loads(done.stdout)["jobs"]
    return MEASURED[line, turn]


def milliseconds(job):
    return job["seconds"]["median"] * 1e3


def in_turn(options, scene):
    """Milliseconds by algorithm, turn after turn, with one thread and with two, so that other programs affect both equally."""
    turns = {1: [], 2: []}
    for turn in TURNS:
        for threads, found in turns.items():
            jobs = bench(options, scene, threads=threads, turn=turn)
            found.append({job["algorithm"]: milliseconds(job) for job in jobs})
    return turns


def median_ratio(above, below):
    return statistics.median(a / b for a, b in zip(above, below))


def table(titles, rows):
    lines = ["| " + " | ".join(titles) + " |", "|" + "---|" * len(titles)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def times_section(options, scenes):
    rows = []
    for scene in scenes:
        for job in bench(options, scene, counted=True):
            ns = job["ns_per_fragment_pass"]
            rows.append([scene.name, job["algorithm"], job["geometry_passes"], f'{job["fragments"]:,}',
                         f"{milliseconds(job):.1f}", f'{job["seconds"]["min"] * 1e3:.1f} to {job["seconds"]["max"] * 1e3:.1f}',
                         f'{job["geometry_seconds"] * 1e3:.1f}', f'{ns:.2f}' if ns else "-",
                         f'{job["bytes_per_fragment"]:.0f}' if ns else "-"])
    return ("## Times\n\nReplay, the best instruction set, needed effects, 2 threads, " + options.size + ". A fragment-pass is "
            "one fragment of one pass of the literal definition, whether it was looked at again or not.\n\n" +
            table(["scene", "job", "passes", "fragment-passes", "median ms", "least to most", "geometry ms",
                   "ns a fragment-pass", "bytes a fragment-pass, on paper"], rows))


def within_section(options, scenes):
    ratios = [("dual", "depth"), ("dual", "weighted_average"), ("front_to_back", "depth")]
    rows = []
    for scene in scenes:
        turns = in_turn(options, scene)[2]
        rows.append([scene.name] + [f"{median_ratio([t[above] for t in turns], [t[below] for t in turns]):.2f}"
                                    for above, below in ratios])
    return (f"## The cost of exactness\n\nTimes to the last layer, divided by the time of one pass of the same scene; the median of {len(TURNS)} measurements.\n\n" +
            table(["scene"] + [f"{above} : {below}" for above, below in ratios], rows))


def side_by_side_of(jobs, key, values):
    """Rows of algorithm, milliseconds for each value of `key`, and each divided by the last."""
    rows = []
    for algorithm in ALGORITHMS:
        times = {job[key]: milliseconds(job) for job in jobs if job["algorithm"] == algorithm}
        used = [value for value in values if value in times]
        if used:
            rows.append([algorithm] + [f"{times[v]:.1f}" if v in times else "-" for v in values] +
                        [" : ".join(f"{times[v] / times[used[-1]]:.2f}" for v in used)])
    return rows


def ways_section(options, scenes, key, values, title, words):
    """A table per scene, at the small size, at which slow executions take acceptable time."""
    text = f"## {title}\n\n{words} {options.small}, a quarter of the planes, 2 threads, ms.\n"
    for scene in scenes:
        jobs = bench(options, scene, small=True, **{key: "all" if key == "simd" else ",".join(v for v in values if v != NO_MEMORY)})
        if NO_MEMORY in values:
            jobs = jobs + [{**job, key: NO_MEMORY} for job in bench(options, scene, small=True, memory="0")]
        shown = [v for v in values if any(job[key] == v for job in jobs)]
        text += f"\n**{scene.name}**\n\n" + table(["job", *shown, "ratio"], side_by_side_of(jobs, key, shown))
    return text


def scaling_section(options, scenes):
    rows, serial_shares = [], []
    for scene in scenes:
        turns = in_turn(options, scene)
        for algorithm in turns[1][0]:
            one, two = ([t[algorithm] for t in turns[threads]] for threads in (1, 2))
            speed_up = median_ratio(one, two)
            serial = min(1.0, 2 / speed_up - 1)  # Amdahl: t2 / t1 = s + (1 - s) / 2
            is_noise = serial < 0
            if not is_noise:
                serial_shares.append(serial)
            rows.append([scene.name, algorithm, f"{statistics.median(one):.1f}", f"{statistics.median(two):.1f}", f"{speed_up:.2f}",
                         "more than twice as fast" if is_noise else f"{serial:.3f}",
                         "-" if is_noise else f"{1 / (serial + (1 - serial) / 64):.1f}"])
    measured = len(serial_shares)
    worst = max(serial_shares, default=0.0)
    side = [int(n) for n in options.size.split("x")]
    tiles = -(-side[0] // 64) * -(-side[1] // 64)
    return (f"## Threads\n\nMedians of {len(TURNS)} runs of each in turn.\n\n" + table(["scene", "job", "1 thread ms", "2 threads ms", "speed-up", "serial share",
                                      "ceiling for 64"], rows) +
            f"""
The serial share s solves t2 / t1 = s + (1 - s) / 2 (Amdahl). It counts everything that does not double: joining sources in submission
order, the prefix sums of the bins, the last tiles, and the memory that both threads share. {measured} of {len(rows)} jobs show one, {worst:.3f} at
most; the others were more than twice as fast on two threads, which means that the share is below the noise. {options.size} has {tiles} tiles of 64
pixels: with 64 threads each has {tiles / 64:.0f}, and a frame takes as long as its costliest tile.
""")


def peak_mib(command):
    """Largest resident set of one process, MiB; Linux reports it in KiB."""
    print(" ".join(command), file=sys.stderr)
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"performance.py: {command[1]} ended with status {status}")
    return usage.ru_maxrss / 1024


def memory_section(options, scenes):
    fragment_memory = 256  # MiB, the default
    width, height = (int(n) for n in options.size.split("x"))
    targets = width * height * (4 + 1) * 4 / 2**20
    rows = []
    for scene in scenes:
        own = peak_mib([options.strata, "scene", scene.spec])
        bound = 1.5 * (own + targets + fragment_memory)
        for algorithm in ALGORITHMS:
            peak = peak_mib([options.strata, "bench", scene.spec, *scene.options, "--size", options.size,
                             "--algorithm", algorithm, "--threads", "2", "--repeat", "1"])
            rows.append([scene.name, algorithm, f"{peak:.0f}", f"{own:.0f}", f"{targets:.0f}", fragment_memory, f"{bound:.0f}",
                         "yes" if peak <= bound else "**no**"])
    return (f"## Memory\n\nThe largest resident set of a process that runs one job, {options.size}, 2 threads, in MiB. The bound is 1.5 times "
            "the sum of the scene's own data (the program that loads it and does no more), the targets (colour and depth, a word a "
            "code) and --fragment-memory.\n\n" +
            table(["scene", "job", "peak", "scene", "targets", "--fragment-memory", "bound", "kept"], rows))


STARTS = [["list", "algorithms"], ["render", "teapot", "--size", "64x64"], ["render", "teapot", "--size", "64x64", "-o", "FILE"]]
MOST_SECONDS, MOST_MB = 0.05, 30  # of a command that uses no PNG


def start_section(options, folder):
    """The time and memory of commands that do almost nothing; the last one loads the image module."""
    rows = []
    for words in STARTS:
        has_file = "FILE" in words
        command = [options.strata, *(str(pathlib.Path(folder) / "start.png") if word == "FILE" else word for word in words)]
        seconds = []
        for _ in range(1 if options.quick else 15):
            start = time.perf_counter()
            subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
            seconds.append(time.perf_counter() - start)
        median, megabytes = statistics.median(seconds), peak_mib(command) * 2**20 / 1e6
        kept = "-" if has_file else "yes" if median <= MOST_SECONDS and megabytes <= MOST_MB else "**no**"
        rows.append(["strata " + " ".join(words), f"{median:.3f}", f"{megabytes:.0f}", kept])
    return (f"## Start\n\nThe median of a process from its start to its end, and its largest resident set. Without a PNG it "
            f"keeps to {MOST_SECONDS} s and {MOST_MB} MB; PNG brings OpenImageIO.\n\n" +
            table(["command", "seconds", "MB", "kept"], rows))


def mesa_section(options):
    title = "## Compared with Mesa llvmpipe\n\n"
    build = pathlib.Path(options.strata).parent
    if not (build / "strata_port_beside").exists():
        return title + "Not built here (`-DSTRATA_PORT=ON`).\n"
    command = [sys.executable, str(HERE / "side_by_side.py"), options.models, "--build", str(build), "--size", options.size]
    if options.quick:
        command += ["--quick", "--pairs", "1", "--repeat", "1"]
    print(" ".join(command), file=sys.stderr)
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        return title + f"Failed here: side_by_side.py ended with exit status {done.returncode}.\n\n```\n{done.stdout}```\n"
    return title + f"Both are measured alternately, with the same scene, camera, size and threads ([README.md](README.md)).\n\n```\n{done.stdout}```\n"


def machine():
    names = [line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    return f"{names[0]}, {len(names)} threads" if names else "unknown processor"


def summary(options, scenes):
    """The most important results."""
    costs = [median_ratio([t["dual"] for t in turns], [t["depth"] for t in turns])
             for turns in (in_turn(options, scene)[2] for scene in scenes)]
    return (f"Strata emulates on a CPU. A dual peel to the last layer takes {min(costs):.1f} to {max(costs):.1f} times as long as one depth pass of the same scene. A pass "
            "processes the fragments that it keeps and only counts the others, so that time grows with the number of layers and not with its square. [PEELS.md](PEELS.md) "
            "compares all peels with the A-buffer.")


def page(options, scenes):
    return "\n".join([
        f"# Performance\n\n{summary(options, scenes)}\n\n![time per layer against the number of layers](layers.svg)\n\n"
        f"Made by `tools/lab/bench/performance.py` on {machine()}. Compare ratios, not milliseconds. Times, instruction sets, executions, threads, memory and "
        "start-up: `build/bench/performance.txt`, which the script also writes.\n",
        mesa_section(options), within_section(options, scenes)])


def tables(options, scenes, folder):
    """The tables that are not on the page."""
    return "\n".join([
        "# Performance: all tables\n", times_section(options, scenes),
        ways_section(options, scenes, "execution", ["literal", NO_MEMORY, "replay"], "literal : replay without memory : replay",
                     "The same bits three ways, each over replay."),
        ways_section(options, scenes, "simd", ["scalar", "avx2", "avx512"], "Instruction sets", "Each over the last."),
        scaling_section(options, scenes), memory_section(options, scenes), start_section(options, folder)])


def main():
    options = parse_arguments()
    with tempfile.TemporaryDirectory() as folder:
        scenes = scenes_of(options, folder)
        written = ((pathlib.Path(options.out), lambda: page(options, scenes)),
                   (ROOT / "build/bench/performance.txt", lambda: tables(options, scenes, folder)))
        for path, text in written:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text())
            print(f"wrote {path}", file=sys.stderr)


if __name__ == "__main__":
    main()

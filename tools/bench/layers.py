#!/usr/bin/env python3
"""Measures time against the number of layers for every peel: a table of microseconds per layer, and a diagram of it.

    tools/bench/layers.py [--slices 16,64,256] [--size 128x128] [--out tools/bench/layers.svg]

Needs only the standard library. A peel with a level line needs the same time for every layer; one that rises processes fragments again. a_buffer is
included for comparison. Times are of the fastest frames on one thread, on which other programs have the least effect.
"""
import argparse
import math
import pathlib
import sys

sys.dont_write_bytecode = True
import peels  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, HEIGHT, MARGIN, LEGEND = 560, 420, 56, 210
HUES = 14


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--strata", default=str(peels.ROOT / "build/release/strata"), help="the built command")
    parser.add_argument("--slices", default="16,64,256", help="planes of the stack, with commas between")
    parser.add_argument("--order", default="far", help="which end of the stack is drawn first")
    parser.add_argument("--profile", default="geforce8_dx101", help="one that runs all of --algorithms")
    parser.add_argument("--color-format", default="rgba8")
    parser.add_argument("--size", default="128x128")
    parser.add_argument("--algorithms", default=",".join(p for p in peels.PEELS if p not in ("shadow_map_depth_replace", "coherent_ideal")))
    parser.add_argument("--repeat", default="8", help="frames that are timed together")
    parser.add_argument("--out", default=str(HERE / "layers.svg"))
    return parser.parse_args()


def measure(options, slices):
    """Milliseconds of a frame by algorithm."""
    command = peels.bench_command(options, f"volume-beam:slices={slices},order={options.order}", options.size, options.profile,
                                  options.color_format)
    return {name: peels.frame_ms(command, name, int(options.repeat)) for name in ["a_buffer", *options.algorithms.split(",")]}


def picture(times, layers):
    """Microseconds per layer against layers, both axes logarithmic to base two."""
    points = {name: [(n, 1e3 * times[n][name] / n) for n in layers if name in times[n]] for name in times[layers[0]]}
    values = [y for line in points.values() for _, y in line]
    low, high = math.floor(math.log2(min(values))), math.ceil(math.log2(max(values)))
    first, last = math.log2(layers[0]), math.log2(layers[-1])
    across = lambda n: MARGIN + (WIDTH - 2 * MARGIN) * (math.log2(n) - first) / (last - first or 1)  # noqa: E731
    down = lambda y: HEIGHT - MARGIN - (HEIGHT - 2 * MARGIN) * (math.log2(y) - low) / (high - low or 1)  # noqa: E731
    text = lambda x, y, words, anchor="middle": f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{words}</text>'  # noqa: E731
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH + LEGEND}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
             f'<rect width="{WIDTH + LEGEND}" height="{HEIGHT}" fill="white"/>',
             text(WIDTH / 2, HEIGHT - 14, "layers"), text(WIDTH / 2, 24, "microseconds a layer")]
    for n in layers:
        lines.append(text(across(n), HEIGHT - MARGIN + 18, n))
    for power in range(low, high + 1):
        y = down(2.0**power)
        lines += [f'<line x1="{MARGIN}" y1="{y:.1f}" x2="{WIDTH - MARGIN}" y2="{y:.1f}" stroke="#ddd"/>',
                  text(MARGIN - 6, y + 4, f"{2.0**power:g}", "end")]
    for number, (name, line) in enumerate(points.items()):
        color = "black" if name == "a_buffer" else f"hsl({360 * number / HUES:.0f},70%,45%)"
        path = " ".join(f"{across(n):.1f},{down(y):.1f}" for n, y in line)
        lines += [f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="2"/>',
                  f'<rect x="{WIDTH - 20}" y="{MARGIN + 22 * number}" width="14" height="4" fill="{color}"/>',
                  text(WIDTH, MARGIN + 22 * number + 7, name, "start")]
    return "\n".join([*lines, "</svg>"]) + "\n"


def main():
    options = parse_arguments()
    if not pathlib.Path(options.strata).exists():
        sys.exit(f"layers.py: --strata: expected the built command, found nothing at {options.strata}")
    layers = [int(n) for n in options.slices.split(",")]
    times = {n: measure(options, n) for n in layers}
    print("| job | " + " | ".join(f"{n} layers, us a layer" for n in layers) + " | " + " | ".join(f"over a_buffer, {n}" for n in layers) + " |")
    print("|" + "---|" * (1 + 2 * len(layers)))
    for name in times[layers[0]]:
        print(f"| {name} | " + " | ".join(f"{1e3 * times[n][name] / n:.1f}" for n in layers) + " | " +
              " | ".join(f"{times[n][name] / times[n]['a_buffer']:.2f}" for n in layers) + " |")
    pathlib.Path(options.out).write_text(picture(times, layers))
    print(f"wrote {options.out}", file=sys.stderr)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Measures time against the number of layers for every peel: a table of microseconds per layer, and a diagram of it.

    tools/lab/bench/layers.py [--slices 16,64,256] [--size 128x128] [--out tools/lab/bench/layers.svg]

Needs matplotlib. A peel with a level line needs the same time for every layer; one that rises processes fragments again. a_buffer is
included for comparison. Times are of the fastest frames on one thread, on which other programs have the least effect.
"""
import argparse
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import peels  # noqa: E402
import plots  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent


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
    figure, (axes,) = plots.axes_of(8, 5, "", "layers", "microseconds a layer")
    for number, name in enumerate(times[layers[0]]):
        axes.plot(layers, [1e3 * times[n][name] / n for n in layers], label=name, color=plots.COLORS[number % len(plots.COLORS)],
                  linestyle=("-", "--")[number // len(plots.COLORS) % 2], marker=plots.MARKS[number % len(plots.MARKS)], markersize=4)
    axes.set_xscale("log", base=2)
    axes.set_yscale("log", base=2)
    axes.set_xticks(layers, [str(n) for n in layers])
    axes.yaxis.set_major_formatter("{x:g}")
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    return plots.svg_of(figure)


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

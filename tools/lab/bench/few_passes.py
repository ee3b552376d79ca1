#!/usr/bin/env python3
"""Measures the algorithms of few passes: those of one pass divided by weighted_average, lists and layers divided by a_buffer.

    tools/lab/bench/few_passes.py [--size 512x512] [--repeat 3] [--turns 3]

Writes FEW_PASSES.md. Needs only the standard library. Jobs have one thread and are measured alternately, as by peels.py. The exit status is 1 if a
ratio exceeds its bound: 2 of weighted_average, 3 of a_buffer. Algorithms of two and more passes that sum have no bound.
"""
import argparse
import pathlib
import sys

import peels

HERE = pathlib.Path(__file__).resolve().parent
SCENES = {"teapot": ["teapot", "--alpha", "0.5"], "64 planes": ["planes:count=64", "--alpha", "0.5"], "random": ["random:seed=7,triangles=400"]}
GROUPS = [("weighted_average", 2.0, ["weighted_blended", "weighted_blended_shared"]),
          ("a_buffer", 3.0, ["linked_list", "multi_layer", "k_buffer", "adaptive", "atomic_loop", "hybrid_transparency"]),
          ("weighted_average", None, ["moments", "moments_quantized", "stochastic"]),
          ("a_buffer", None, ["bucket_peel", "front_to_back", "dual", "front_to_back_ties", "dual_ties"])]


def milliseconds(options, words):
    """Milliseconds of a frame by algorithm."""
    command = [options.strata, "bench", *words, "--size", options.size, "--profile", "ideal"]
    seconds = {name: [] for base, _, names in GROUPS for name in [base, *names]}
    for _ in range(options.turns):
        for name, kept in seconds.items():
            kept += peels.frame_seconds(command, name, options.repeat)
    return {name: peels.quick_ms(kept) for name, kept in seconds.items()}


def page(options, times):
    rows, beyond = [], []
    for base, most, names in GROUPS:
        for name in names:
            ratios = {scene: of[name] / of[base] for scene, of in times.items()}
            beyond += [f"{name} on {scene}: {ratio:.2f}" for scene, ratio in ratios.items() if most is not None and ratio > most]
            cells = [f"**{ratio:.1f}**" if most is not None and ratio > most else f"{ratio:.1f}" for ratio in ratios.values()]
            rows.append([name, *cells, base, "-" if most is None else f"{most:g}"])
    text = f"""# Algorithms of few passes compared with weighted_average and with the A-buffer

How long does a frame take that Strata emulates on a CPU (profile `ideal`, rgba8, {options.size} pixels, one thread)? Figures are times divided by that of
the algorithm in the column *of*. A bold figure exceeds its bound: {"; ".join(beyond) or "none"}.

{peels.table(["algorithm", *times, "of", "bound"], rows)}
`weighted_average` adds its sums directly to the targets. `weighted_blended` computes a weight for every fragment and blends its two targets in
different ways: reading and writing them takes a quarter of its time on `random`. `moments` draws twice and finds the roots of a polynomial in binary64 for every fragment. `front_to_back_ties` and `dual_ties` visit every fragment in
every pass, because a program that reads the triangle's number may not select fragments (pipeline/reference/execution.md 7.1).

    tools/lab/bench/few_passes.py        # this page
"""
    return text, bool(beyond)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--strata", default=str(peels.ROOT / "build/release/strata"), help="the built command")
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--repeat", type=int, default=3, help="frames of a job in one turn")
    parser.add_argument("--turns", type=int, default=3)
    options = parser.parse_args()
    text, is_beyond = page(options, {scene: milliseconds(options, words) for scene, words in SCENES.items()})
    (HERE / "FEW_PASSES.md").write_text(text)
    sys.exit(1 if is_beyond else 0)


if __name__ == "__main__":
    main()

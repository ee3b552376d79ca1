#!/usr/bin/env python3
"""Writes tools/port/MISTAKES.md: what `strata diagnose` says of the port when it is right, and when it is wrong by one mistake or by two.

    tools/port/mistaken.py [--driver llvmpipe] [--only NAME]

The diagnosis has the pack and the candidate alone: what the port says of itself is left out. Exit status 1: the right port is not named right.
"""
import argparse
import json
import pathlib
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
import packs  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SCENES = {
    "teapot": ["teapot", "--alpha", "0.5", "--size", "64x48"],
    "random": ["random:seed=3,triangles=60", "--size", "64x48"],
    "coincident": ["hard:case=coincident", "--size", "48x48"],
    "opaque": ["hard:case=opaque-crossing", "--size", "48x48"],
    "close": ["hard:case=planes-1-unit-of-16-bits", "--size", "32x32"],
    "deep": ["hard:case=layers-256", "--size", "16x16"],
    "deep, far first": ["volume-beam:slices=300,order=far", "--size", "16x16"],
    "one pixel": ["hard:case=frame-1x1", "--size", "1x1"],
}
# Where a mistake shows, if not in the teapot.
SHOWN_IN = {"less_equal": "coincident", "depth_epsilon": "close", "depth_16": "close", "opaque_ignored": "opaque", "background_lost": "opaque",
            "no_perspective": "random", "stencil_wraps": "deep, far first", "stencil_cleared": "deep", "query_above_1": "one pixel",
            "last_layer_lost": "close", "other_clip_range": "opaque"}
PAIRS = [("flipped_rows,srgb_twice", "teapot", "front_to_back"), ("half_pixel,red_for_blue", "teapot", "front_to_back"),
         ("straight_layers,last_layer_lost", "close", "front_to_back"), ("back_premultiplied,half_min_max", "teapot", "dual"),
         ("background_lost,alpha_twice", "opaque", "front_to_back"), ("factors_exchanged,culling_left_on", "teapot", "dual")]


def listed(build):
    """The port's mistakes: name, the algorithm that shows it, and what it is."""
    return [line.split(None, 2) for line in packs.run([build / "strata_port", "--mistakes"]).splitlines()]


def cases(build):
    """(names of mistakes, what they are, scene, algorithm); the right port first."""
    known = listed(build)
    words = {name: text for name, _, text in known}
    yield from (("", "the right port", scene, "") for scene in SCENES)
    yield from ((name, text, SHOWN_IN.get(name, "teapot"), algorithm) for name, algorithm, text in known)
    yield from ((names, "; ".join(words[n] for n in names.split(",")), scene, algorithm) for names, scene, algorithm in PAIRS)

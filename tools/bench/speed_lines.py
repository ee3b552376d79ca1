#!/usr/bin/env python3
"""Counts the lines of the core that exist for speed alone: without them every frame is the same, and slower.

    tools/bench/speed_lines.py [--most 3693]

Names every file with what it buys and its lines; exit status 1 if they are more than `--most`.
"""
import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
GROUPS = {
    "closed forms of dual and front_to_back": ["peeling/closed/*"],
    "replay: fragments captured and recalled": [
        "pipeline/fragments/fragment_store.*", "pipeline/region/region_replay.cpp", "pipeline/region/tile_parts.*"],
    "selections: passes visit what they keep": [
        "pipeline/selections/*", "pipeline/frame/selection.h", "pipeline/region/region_layer.cpp", "pipeline/fragments/sorted_*",
        "pipeline/fragments/layer_lists.*", "pipeline/fragments/ends_course.h", "pipeline/fragments/stored_updates.cpp",
        "pipeline/region/repeated_pass.h",
        "pipeline/fragments/selected_fragments.h",
        "pipeline/fragments/compared_depths.cpp", "pipeline/fragments/first_that.h", "pipeline/fragments/earliest_index.h",
        "pipeline/fragments/sort_arrivals.h"],
    "rows: passes without batches": [
        "rasterizer/walk/*rows*", "rasterizer/walk/row_walk*", "rasterizer/walk/tiny_walk*", "pipeline/stages/tiny_colors*",
        "pipeline/region/region_rows.cpp", "pipeline/stages/sum_rows*"],
    "words: targets without gathers": [
        "pipeline/formats/image_words*", "pipeline/stages/lane_words.h", "pipeline/stages/layer_blend*", "pipeline/stages/stored_color*",
        "peeling/programs/average_words*"],
}


def files_of(patterns):
    return sorted({path for pattern in patterns for path in ROOT.glob(pattern) if path.suffix in (".h", ".cpp")})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--most", type=int, default=3693, help="lines that they may have")
    options = parser.parse_args()
    total = 0
    for group, patterns in GROUPS.items():
        files = files_of(patterns)
        if not files:
            sys.exit(f"speed_lines.py: {group}: expected files like {patterns[0]}, found none")
        lines = {path: len(path.read_text().splitlines()) for path in files}
        total += sum(lines.values())
        print(f"{sum(lines.values()):6}  {group}")
        for path, count in lines.items():
            print(f"{count:12}  {path.relative_to(ROOT)}")
    print(f"{total:6}  together, of {options.most}")
    sys.exit(0 if total <= options.most else 1)


if __name__ == "__main__":
    main()

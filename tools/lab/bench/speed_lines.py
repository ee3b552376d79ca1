#!/usr/bin/env python3
"""Counts the lines of the core that exist only for speed: without them every frame has the same bits and takes longer.

    tools/lab/bench/speed_lines.py [--most LINES]

Prints every file with its lines, grouped by their purpose; exit status 1 if there are more than `--most`.
"""
import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
MOST = 6500
GROUPS = {
    "peels to their end at once": ["peeling/loops/block_passes*", "peeling/loops/list_block.h", "peeling/loops/resolve.*"],
    "the record of a tile's fragments": [
        "pipeline/fragments/tile_fragments.*", "pipeline/fragments/record_rows*", "pipeline/region/region_source.cpp", "pipeline/fragments/tile_parts.*"],
    "passes visit what they keep": [
        "pipeline/fragments/sort*", "pipeline/fragments/find_fragments.*", "pipeline/fragments/fragment_waves.h",
        "pipeline/frame/selection.h", "pipeline/region/region_selected.cpp"],
    "rows: passes without batches": [
        "rasterizer/walk/*rows*", "rasterizer/walk/row_walk*",
        "pipeline/region/region_rows.cpp", "pipeline/stages/sum_rows*"],
    "targets without gathers": [
        "pipeline/formats/image_texels*", "pipeline/stages/lane_words.h", "pipeline/stages/stored_color*"],
    "triangles and pixels side by side": [
        "rasterizer/set_up/plain_*", "rasterizer/coverage/small_*", "rasterizer/values/chip_lanes*", "rasterizer/values/lane_kernels*",
        "rasterizer/set_up/depth_bound*"],
}


def files_of(patterns):
    return sorted({path for pattern in patterns for path in ROOT.glob(pattern) if path.suffix in (".h", ".cpp")})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--most", type=int, default=MOST, help=f"lines that they may have ({MOST})")
    options = parser.parse_args()
    total = 0
    for group, patterns in GROUPS.items():
        for pattern in patterns:
            if not files_of([pattern]):
                sys.exit(f"speed_lines.py: {group}: expected files like {pattern}, found none")
        lines = {path: len(path.read_text().splitlines()) for path in files_of(patterns)}
        total += sum(lines.values())
        print(f"{sum(lines.values()):6}  {group}")
        for path, count in lines.items():
            print(f"{count:12}  {path.relative_to(ROOT)}")
    print(f"{total:6}  together, of {options.most}")
    sys.exit(0 if total <= options.most else 1)


if __name__ == "__main__":
    main()

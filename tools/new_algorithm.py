#!/usr/bin/env python3
"""Writes the file of a new algorithm: head, passes and entry, to be filled in (tools/docs/CONTRIBUTING.md).

    tools/new_algorithm.py NAME [--folder FOLDER]

NAME is the algorithm's on the command line: small letters, digits and underscores. What stands in the file draws all fragments with OVER in
one pass, needs a fragment program, and is listed last. Exit status 2 if the name cannot be one, or its file exists.
"""
import argparse
import pathlib
import re
import sys

TEXT = '''\
// peeling/algorithms/NAME.cpp - one line: what it does.
// Author year, section; algorithms.md N.
//
// Needs      fragment programs.
// Passes     1.
// Invariant  what holds before each pass.
#include "peeling/algorithms/entry.h"
#include "peeling/programs/programs.h"

namespace strata::peeling::listing::NAME {

using namespace pipeline;

void run(Region& region) {
    const Target color = region.make_color();
    region.call(color, "color");
    region.copy(region.opaque_color(), color);
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.color[0] = color;
    state.blend[0] = blend_mode::over;
    state.blend[0].write_mask = 0x7;  // the final alpha stays 1
    region.begin_iteration();
    static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) {
        out.color[0] = in.color;
        // What the audit knows of the algorithm: which fragments it composites, by which key, from which side.
        out.traced = true;
        for (std::size_t i = 0; i < lanes(in); ++i) {
            out.side[i] = Side::back;
            out.key[i] = in.code[i];
        }
    }));
    region.publish(color);
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "NAME",
                      .listed = 1000,
                      .paper = "Author year",
                      .section = "section",
                      .summary = "one sentence",
                      .pass_formula = "1",
                      .ties = TiePolicy::none,
                      .key = DepthKey::stored_code,
                      .geometry_passes = one_pass,
                      .run = run,
                      .features = {fragment_programs}}};
}

}  // namespace strata::peeling::listing::NAME
'''


def fail(sentence):
    print(f"new_algorithm.py: {sentence}", file=sys.stderr)
    sys.exit(2)


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name")
    parser.add_argument("--folder", type=pathlib.Path, default=root / "peeling/algorithms")
    options = parser.parse_args()
    if not re.fullmatch(r"[a-z][a-z0-9_]*", options.name):
        fail(f"{options.name}: expected small letters, digits and underscores")
    file = options.folder / f"{options.name}.cpp"
    try:
        with file.open("x", encoding="utf-8") as text:
            text.write(TEXT.replace("NAME", options.name))
    except FileExistsError:
        fail(f"{file}: exists")
    except OSError as error:
        fail(f"{file}: {error.strerror}")
    print(f"wrote {file}")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Creates a new algorithm in the four files that name it (tools/docs/CONTRIBUTING.md).

    tools/new_algorithm.py NAME [--paper "Author year"] [--summary "half a sentence"] [--root CHECKOUT]

NAME is its name on the command line: lowercase letters, digits and underscores. The script writes its file peeling/algorithms/NAME.cpp, its test
tests/peeling/algorithms/NAME_test.cpp, the last section of peeling/reference/algorithms.md and the first line of CHANGELOG.md. The created algorithm
draws all fragments with OVER in one pass, needs a fragment program, and is listed last. Exit status 2 if the name is invalid or already used.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys

LISTING = '''\
// peeling/algorithms/NAME.cpp - SUMMARY.
// PAPER, section; algorithms.md NUMBER.
//
// Needs      fragment programs.
// Passes     1.
// Invariant  what holds before each pass.
#include "peeling/algorithms/entry.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::NAME {

using namespace pipeline;

void run(Region& region) {
    const Target color = region.make_color();
    region.set_name(color, "color");
    region.copy(region.opaque_color(), color);
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.color[0] = color;
    state.blend[0] = over_background(region.frame());
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
                      .listed = NUMBER0,
                      .paper = "PAPER",
                      .section = "section",
                      .summary = "SUMMARY",
                      .pass_formula = "1",
                      .ties = TiePolicy::none,
                      .key = DepthKey::stored_code,
                      .geometry_passes = one_pass,
                      .run = run,
                      .features = {fragment_programs}}};
}

}  // namespace strata::peeling::listing::NAME
'''


TEST = '''\
// NAME: what it shows. Expected value: one fragment over the background, by OVER's formula.
#include <bit>
#include <catch2/catch.hpp>

#include "tests/peeling/expectations.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;

// Its row of expectations.h: the smallest devices, geometry passes, names of targets; render_targets, samples and loses_ties where they are others.
const ExpectedRow expected_NAME{{.algorithm = "NAME",
    .devices = Devices::programmable,
    .passes = [](int) { return 1; },
    .targets = {"color"}}};

}  // namespace

TEST_CASE("NAME shows a fragment over the background") {
    FragmentScene scene{1, 1};
    scene.pixels[0].fragments = {{0.5f, {0.5f, 0.25f, 1, 0.25f}}};
    auto options = options_for(scene);
    options.background = {0, 0.5f, 0, 1};
    const auto result = render(scene, {"ideal", "NAME"}, options);
    const auto channel = [&](std::size_t c) { return std::bit_cast<float>(result.frame.color.codes[c]); };
    CHECK(channel(0) == 0.125f);
    CHECK(channel(1) == 0.4375f);
    CHECK(channel(2) == 0.25f);
}
'''

SECTION = '''
## NUMBER `NAME`
```
draw: test LESS opaque_depth, no write;  color OVER= c
```
Passes 1. What is exact, what ties do, what it reports; its alpha stands in 0.8. *Needs* fragment programs. *Source*: PAPER.
'''


def fail(sentence):
    print(f"new_algorithm.py: {sentence}", file=sys.stderr)
    sys.exit(2)


def read(path):
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        fail(f"{path}: {error.strerror}")


def texts(options):
    """The new text of each file, complete."""
    specification, news = options.root / "peeling/reference/algorithms.md", options.root / "CHANGELOG.md"
    sections, changes = read(specification), read(news)
    number = 1 + max(int(n) for n in re.findall(r"^## (\d+) ", sections, re.MULTILINE))

    def filled(text):
        for word, value in (("NUMBER", str(number)), ("NAME", options.name), ("PAPER", options.paper), ("SUMMARY", options.summary)):
            text = text.replace(word, value)
        return text

    version = re.search(r"^## .*\n\n", changes, re.MULTILINE)
    if version is None:
        fail(f"{news}: expected a version's heading, found none")
    return {options.root / "peeling/algorithms" / f"{options.name}.cpp": filled(LISTING),
            options.root / "tests/peeling/algorithms" / f"{options.name}_test.cpp": filled(TEST),
            specification: sections.rstrip("\n") + "\n" + filled(SECTION),
            news: changes[:version.end()] + filled("- Algorithm `NAME` (PAPER): SUMMARY.\n") + changes[version.end():]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name")
    parser.add_argument("--paper", default="Author year")
    parser.add_argument("--summary", default="what it does")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    options = parser.parse_args()
    if not re.fullmatch(r"[a-z][a-z0-9_]*", options.name):
        fail(f"{options.name}: expected small letters, digits and underscores")
    written = texts(options)
    for file in written:
        if options.name in file.name and file.exists():
            fail(f"{file}: exists")
    for file, text in written.items():
        try:
            file.write_text(text, encoding="utf-8")
        except OSError as error:
            fail(f"{file}: {error.strerror}")
        print(f"wrote {file}")
    sources = [str(file) for file in written if file.suffix == ".cpp"]
    if shutil.which("clang-format"):
        subprocess.run(["clang-format", "-i", *sources], check=True)


if __name__ == "__main__":
    main()
